"""The command `explore`: a page for browsers that shows what happens as quantities are moved."""

from __future__ import annotations

import argparse
from typing import Any

from surrogate.basics.files import check_outputs
from surrogate.basics.records import number
from surrogate.choosing.by_name import AUTO
from surrogate.cli.common import (
    Record,
    add_friction_and_stiffening,
    add_law_option,
    print_answer,
    quantity,
)
from surrogate.errors import InputError
from surrogate.explorer.numbers import GEL
from surrogate.explorer.page import write_explorer
from surrogate.identification.fit import Identification, identify
from surrogate.reading.material import Material, read_material
from surrogate.reading.measurements import Measurements, read_measurements
from surrogate.reading.plausibility import doubts_of_scene
from surrogate.reading.units import LENGTH, STRESS, TOUGHNESS
from surrogate.scene import NAMES, Scene

__all__ = ["DESCRIPTION", "EXAMPLES", "add_explore_options", "run_explore"]

DESCRIPTION = "A page for browsers: sliders, a map with a point to drag, forces and words."

EXAMPLES = """\
The page is one file that opens from disk and needs no network: send it to whom you like. It begins
with the quantities that you give, or else with the gel of the paper. With --cuts and a shear
modulus, toughness and wear strength are those that 'wirecut identify' finds, unless you give them.

examples:
  wirecut explore --out explorer.html
  wirecut explore --shear-modulus 685Pa --cuts cuts.csv --out explorer.html
  wirecut explore --material mine.json --toughness 1.6J/m2 --wear-strength 7.75kPa --out mine.html
"""

_MODEL = "table"
"""The model that the page computes with."""


def add_explore_options(command: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    add = command.add_argument
    add("--out", metavar="FILE", required=True, help="page to write, such as explorer.html")
    add("--material", metavar="FILE", help="properties of the gel (JSON), instead of options")
    add("--cuts", metavar="FILE", help="table of own cuts, as 'wirecut identify' reads it")
    add("--thickness", type=quantity(LENGTH), metavar="T", help="of the sample, for forces in N")
    for name, dimension, metavar, words in (
        ("shear-modulus", STRESS, "MU", "shear modulus mu"),
        ("toughness", TOUGHNESS, "GAMMA_O", "cleavage toughness Gamma_o"),
        ("wear-strength", STRESS, "TAU_W", "wear and adhesion shear strength tau_w"),
        ("wire-radius", LENGTH, "R_W", "radius of the wire that the page begins with"),
    ):
        add(f"--{name}", type=quantity(dimension), metavar=metavar, help=words)
    add_friction_and_stiffening(command, friction=None, stiffening=None)
    add_law_option(command, any_law=True)


def run_explore(options: argparse.Namespace) -> int:
    """Write the page and say with what it begins."""
    check_outputs({"--out": options.out}, [options.material, options.cuts])
    material = read_material(options.material) if options.material else Material()
    cuts = read_measurements(options.cuts, options.thickness) if options.cuts else None
    if options.thickness is not None and cuts is None:
        raise InputError("--thickness is for forces of --cuts in N; give --cuts, or leave it out.")
    known = _known(options, material)
    fit = _identified(options, known, cuts)
    if fit is not None:
        known |= {"toughness": fit.toughness, "wear_strength": fit.wear_strength, "law": fit.law}
    scene = _scene(known, cuts)
    write_explorer(options.out, scene, cuts, law=options.law, diameters=options.diameters)
    return print_answer(options, _record(options, scene, fit, material, cuts), _words)


def _known(options: argparse.Namespace, material: Material) -> dict[str, Any]:
    """Return what is told of the scene: by options, or else by the material's file."""
    names = ("shear_modulus", "friction_coefficient", "stiffening_exponent")
    told = {name: getattr(material, name) for name in names}
    told |= {
        name: value
        for name in (*names, "toughness", "wear_strength", "wire_radius")
        if (value := getattr(options, name)) is not None
    }
    return {name: value for name, value in told.items() if value is not None}


def _identified(
    options: argparse.Namespace, known: dict[str, Any], cuts: Measurements | None
) -> Identification | None:
    """Return what the cuts say of the solid, where nobody says it and its modulus is known."""
    if cuts is None or "shear_modulus" not in known or {"toughness", "wear_strength"} & {*known}:
        return None
    names = ("friction_coefficient", "stiffening_exponent")
    solid: dict[str, Any] = {name: known.get(name) for name in names}
    if options.law != AUTO:
        solid["law"] = options.law
    return identify(
        cuts.wire_radius,
        cuts.force,
        known["shear_modulus"],
        force_std=cuts.force_std,
        sample=cuts.samples,
        model=_MODEL,
        **solid,
    )


def _scene(known: dict[str, Any], cuts: Measurements | None) -> Scene:
    """Return the scene that the page begins with; what is not told is the paper's gel."""
    start = {
        "shear_modulus": GEL.shear_modulus,
        "toughness": GEL.toughness,
        "wire_radius": GEL.wire_radius,
        "wear_strength": GEL.wear_strength,
    }
    if cuts is not None and cuts.wire_radius.size:
        start["wire_radius"] = sorted(cuts.wire_radius.tolist())[cuts.wire_radius.size // 2]
    return Scene(**(start | known))


def _record(
    options: argparse.Namespace,
    scene: Scene,
    fit: Identification | None,
    material: Material,
    cuts: Measurements | None,
) -> Record:
    of_cuts = () if cuts is None else cuts.warnings
    of_fit = () if fit is None else fit.warnings
    return {
        "file": options.out,
        "law": options.law,
        "identified": fit is not None,
        **dict(zip(NAMES, scene.values(), strict=True)),
        "wire_diameter": 2.0 * float(scene.wire_radius),
        "diameters": options.diameters,
        "warnings": [*doubts_of_scene(scene.values()), *material.warnings, *of_cuts, *of_fit],
    }


def _words(record: Record) -> str:
    mu, tau = 1e-3 * record["shear_modulus"], 1e-3 * record["wear_strength"]
    symbol, wire = ("D", "wire_diameter") if record["diameters"] else ("R_w", "wire_radius")
    lines = [
        f"Written: {record['file']}",
        f"It begins with mu = {number(mu)} kPa, Gamma_o = {number(record['toughness'])} J/m2, "
        f"tau_w = {number(tau)} kPa, xi = {number(record['friction_coefficient'])}, "
        f"alpha = {number(record['stiffening_exponent'])}, "
        f"{symbol} = {number(1e3 * record[wire])} mm.",
    ]
    if record["identified"]:
        lines.append(
            "Gamma_o and tau_w are the best fit of the cuts; 'wirecut identify' tells their "
            "intervals, and what else the forces admit."
        )
    return "\n".join(lines)

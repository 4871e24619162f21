"""The command `wirecut design`: which wires to buy, from a guess or an earlier result."""

from __future__ import annotations

import argparse
import json
from dataclasses import asdict
from typing import Any

import numpy as np

from surrogate.basics.digits import rounded
from surrogate.basics.files import opened
from surrogate.basics.records import number, table
from surrogate.choosing.by_name import force_model
from surrogate.choosing.laws import LAWS
from surrogate.cli.common import (
    Record,
    add_friction_and_stiffening,
    add_model_option,
    print_record,
    quantity,
    share,
    whole_number,
)
from surrogate.errors import InputError
from surrogate.identification.wire_design import GOALS, WireDesign, design_wires
from surrogate.reading.material import read_material
from surrogate.reading.units import LENGTH, LINE_FORCE, STRESS, TOUGHNESS
from surrogate.scene import Scene

__all__ = ["add_design_options", "design_record", "design_text", "run_design"]

_FROM_RESULT = ("shear_modulus", "friction_coefficient", "stiffening_exponent")


def add_design_options(command: argparse.ArgumentParser) -> None:
    """Add the options of the command to its parser."""
    add = command.add_argument
    add(
        "--result",
        metavar="FILE",
        help="an earlier result, as 'wirecut identify ... --json' prints it, instead of a guess",
    )
    add("--material", metavar="FILE", help="properties of the gel (JSON), instead of options")
    add("--shear-modulus", type=quantity(STRESS), metavar="MU", help="shear modulus mu")
    for name, dimension, symbol in (
        ("toughness", TOUGHNESS, "Gamma_o"),
        ("wear-strength", STRESS, "tau_w"),
    ):
        add(
            f"--{name}",
            type=quantity(dimension),
            nargs="+",
            metavar="GUESS",
            help=f"{symbol} as you guess it; or several, the likeliest first",
        )
    add_friction_and_stiffening(command, friction=None, stiffening=None)
    add_model_option(command)
    command.set_defaults(rtol=None)
    add(
        "--law",
        choices=LAWS,
        help="law of friction and wear that toughness and wear strength are of; with coupled only "
        "wires are considered that its solutions reach (default that of --result, else projected)",
    )
    add("--cuts", type=whole_number, default=8, metavar="N", help="cuts in all (default 8)")
    add("--force-std", type=quantity(LINE_FORCE), metavar="STD", help="scatter of one cut in N/m")
    add("--relative-error", type=share, metavar="SHARE", help="or as a share of its force: 5%%")
    add(
        "--between",
        type=quantity(LENGTH),
        nargs=2,
        metavar=("THINNEST", "THICKEST"),
        help="range of wires that you can hold (default 20um 2mm)",
    )
    add(
        "--sizes",
        type=quantity(LENGTH),
        nargs="+",
        metavar="DIAMETER",
        help="diameters to choose from (default those commonly sold)",
    )
    add("--thickness", type=quantity(LENGTH), metavar="T", help="of the sample, for forces in N")
    add("--goal", choices=GOALS, default="both", help="whose error to make small (default both)")


def run_design(options: argparse.Namespace) -> None:
    """Print the wires and what they promise."""
    print_record(options, design_record(options), design_text)


def design_record(options: argparse.Namespace) -> Record:
    """Choose wires, and return them with what they promise."""
    model = options.model
    if options.result:
        expected, relative, of_result = _of_result(options)
        model = of_result if model == "auto" else model
    else:
        expected, relative = _guess(options), None
    if options.law is not None and expected.law not in (None, options.law):
        raise InputError(
            f"{options.result or options.material}: was identified by the law {expected.law!r}, "
            f"whose wear strength is not that of another; leave out --law {options.law}, or "
            "identify by that law."
        )
    if options.force_std is not None or options.relative_error is not None:
        relative = options.relative_error
    elif relative is None:
        raise InputError(
            "the scatter of a cut is missing; give --relative-error, such as 5%, or --force-std."
        )
    design = design_wires(
        expected,
        options.cuts,
        force_std=options.force_std,
        relative_force_std=relative,
        model=model,
        rtol=options.rtol,
        diameters=_sizes(options),
        thickness=options.thickness,
        goal=options.goal,
        law=options.law,
    )
    return {
        **asdict(design),
        "model": force_model(design.model).name,
        "law": design.law,
        "wires": [asdict(wire) | {"widest_sample": wire.widest_sample} for wire in design.wires],
        "cuts": options.cuts,
        "force_std": options.force_std,
        "relative_force_std": relative,
        "thickness": options.thickness,
        "answer": _answer(design),
    }


def _sizes(options: argparse.Namespace) -> Any:
    """Return the diameters to choose from, or None for all that are sold."""
    if options.between is None:
        return options.sizes
    low, high = options.between
    from surrogate.identification.further_wire import sold_radii

    sizes = 2.0 * sold_radii(0.5 * low, 0.5 * high) if options.sizes is None else options.sizes
    within = [size for size in sizes if low <= size * (1.0 + 1e-9) and size * (1.0 - 1e-9) <= high]
    if not within:
        raise InputError(
            f"no wire is from {1e3 * low:g} to {1e3 * high:g} mm across; give --between THINNEST "
            "THICKEST with wires between, or your own by --sizes."
        )
    return within


def _guess(options: argparse.Namespace) -> Scene:
    material = read_material(options.material) if options.material else None
    solid = {
        name: _first(getattr(options, name), getattr(material, name, None)) for name in _FROM_RESULT
    }
    toughness, wear, law = options.toughness, options.wear_strength, None
    if material is not None and toughness is None and wear is None:
        toughness, wear, law = _one(material.toughness), _one(material.wear_strength), material.law
    for value, option in (
        (solid["shear_modulus"], "--shear-modulus or --material"),
        (toughness, "--toughness"),
        (wear, "--wear-strength"),
    ):
        if value is None:
            raise InputError(
                f"a guess of the material is incomplete; give {option}, or --result FILE for an "
                "earlier one."
            )
    return _scene(toughness, wear, solid, law)


def _one(value: float | None) -> list[float] | None:
    return None if value is None else [value]


def _scene(toughness: Any, wear_strength: Any, solid: Record, law: str | None) -> Scene:
    """Return every toughness with every wear strength, those given first in front."""
    pairs = [(gamma, tau) for gamma in toughness for tau in wear_strength]
    given = {name: value for name, value in solid.items() if value is not None}
    return Scene(
        toughness=np.array([gamma for gamma, _ in pairs]),
        wear_strength=np.array([tau for _, tau in pairs]),
        wire_radius=1.0,
        law=law,
        **given,
    )


def _first(*values: Any) -> Any:
    return next((value for value in values if value is not None), None)


def _of_result(options: argparse.Namespace) -> tuple[Scene, float | None, str]:
    """Return the materials that an earlier result admits, the scatter of its cuts and its model."""
    unused = [
        name
        for name in ("material", "toughness", "wear_strength", *_FROM_RESULT)
        if getattr(options, name) is not None
    ]
    if unused:
        listed = ", ".join(f"--{name.replace('_', '-')}" for name in unused)
        raise InputError(f"{listed}: --result tells that already; leave out one of them.")
    with opened(options.result) as stream:
        try:
            record = json.loads(stream.read())
            solid = {name: record[name] for name in _FROM_RESULT}
            pairs = [(record["toughness"], record["wear_strength"])]
            low, high = (_ends(record, which) for which in (0, 1))
            modes = [m for m in record.get("modes", [])[1:] if m["admitted"]]
            pairs += [(mode["toughness"], mode["wear_strength"]) for mode in modes]
            pairs += [(low[0], high[1]), (high[0], low[1])]
            wires, model = record["wires"], str(record["model"]).partition(", law ")[0]
            shares = [wire["residual"] / wire["force"] for wire in wires]
            pairs = [pair for pair in pairs if None not in pair and min(pair) > 0.0]
            law, assumed = record["law"], record["assumed"]
        except (ValueError, KeyError, TypeError, ZeroDivisionError):
            raise InputError(
                f"{options.result}: is no result; write one by 'wirecut identify ... --json'."
            ) from None
    if law not in LAWS:
        raise InputError(
            f"{options.result}: is of the law {law!r}, where {', '.join(LAWS)} are known; write it "
            "again by 'wirecut identify ... --json'."
        )
    if "shear_modulus" in assumed:
        raise InputError(
            f"{options.result}: was identified without a shear modulus; identify with it."
        )
    if not pairs or pairs[0] != (record["toughness"], record["wear_strength"]):
        raise InputError(
            f"{options.result}: its toughness and wear strength are not both above 0; give a guess "
            "by --toughness and --wear-strength."
        )
    scene = Scene(
        toughness=np.array([gamma for gamma, _ in pairs]),
        wear_strength=np.array([tau for _, tau in pairs]),
        wire_radius=1.0,
        law=law,
        **solid,
    )
    dof = len(shares) - 2
    scatter = float(np.sqrt(np.sum(np.square(shares)) / dof)) if dof > 0 else 0.0
    return scene, scatter if scatter > 1e-6 else None, model


def _ends(record: Record, which: int) -> tuple[Any, Any]:
    """Return one end of both intervals; None where it is unknown or open."""
    intervals = (record["toughness_interval"], record["wear_strength_interval"])
    gamma, tau = (None if ends is None else ends[which] for ends in intervals)
    return gamma, tau


def _answer(design: WireDesign) -> str:
    """Return which wires to cut with and what they promise."""
    wires = ", ".join(f"{wire.cuts} with {1e3 * wire.diameter:.3g} mm" for wire in design.wires)
    gamma, tau = design.toughness_std, 1e-3 * design.wear_strength_std
    return (
        f"Cut {wires} (diameters): they promise Gamma_o = {rounded(design.toughness, gamma)} +- "
        f"{number(gamma, 2)} J/m2 and tau_w = {rounded(1e-3 * design.wear_strength, tau)} +- "
        f"{number(tau, 2)} kPa (standard errors), model {force_model(design.model)}"
    )


def design_text(record: Record) -> str:
    """Return what `design_record` says, for people."""
    thickness = record["thickness"]
    header = ["Diameter [mm]", "cuts", "g [-]", "F_ss/T [N/m]", "breaks at [N]"]
    header += ["T below [mm]"] if thickness is None else ["F_ss [N]"]
    rows = [
        (
            f"{1e3 * wire['diameter']:.3g}",
            str(wire["cuts"]),
            number(wire["dimensionless_toughness"], 3),
            number(wire["force"], 3),
            number(wire["breaking_force"], 2),
            number(
                1e3 * wire["widest_sample"] if thickness is None else thickness * wire["force"], 2
            ),
        )
        for wire in record["wires"]
    ]
    scatter = (
        f"{100.0 * record['relative_force_std']:.2g} % of the force"
        if record["force_std"] is None
        else f"{record['force_std']:.3g} N/m"
    )
    said = [f"A cut scatters by {scatter}. Steel wires; T below: where they carry twice the force."]
    if thickness is not None:
        said = [f"A cut scatters by {scatter}. Steel wires that carry twice the force."]
    said += [
        f"If Gamma_o = {number(gamma, 3)} J/m2 and tau_w = {number(1e-3 * tau, 3)} kPa are true: "
        f"+- {number(gamma_std, 2)} J/m2 and +- {number(1e-3 * tau_std, 2)} kPa."
        for gamma, tau, gamma_std, tau_std in record["others"]
    ]
    left_out = [f"{sentence[0].upper()}{sentence[1:]}." for sentence in record["left_out"]]
    return "\n".join([f"{record['answer']}.", table(tuple(header), rows), *said, *left_out])

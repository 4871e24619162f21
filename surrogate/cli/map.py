"""The command `wirecut map`: its options, and what it prints."""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from textwrap import fill
from types import MappingProxyType
from typing import Any

import numpy as np

from surrogate.basics.files import check_outputs, model_file
from surrogate.basics.records import number, table
from surrogate.choosing.by_name import AUTO
from surrogate.choosing.laws import PROJECTED
from surrogate.cli.common import add_law_option, add_notch_option, share, whole_number
from surrogate.cli.identify import add_table_options
from surrogate.cli.map_points import (
    Drawn,
    drawn_points,
    points_record,
    points_text,
    range_of,
    taken_from,
)
from surrogate.cutting.regimes import DOMINANT_SHARE
from surrogate.errors import InputError
from surrogate.identification.fit import identify
from surrogate.maps.axes import COORDINATES, coordinate
from surrogate.maps.belonging import require_the_same
from surrogate.maps.make import RegimeMap, regime_map
from surrogate.maps.points import MapPoints
from surrogate.maps.tables import map_summary
from surrogate.reading.material import read_material
from surrogate.reading.measurements import read_measurements
from surrogate.reading.units import (
    LENGTH,
    NUMBER,
    STRESS,
    TOUGHNESS,
    Dimension,
    parse_quantity,
)

__all__ = ["DESCRIPTION", "EXAMPLES", "PRESETS", "Preset", "add_options", "map_record", "map_text"]


@dataclass(frozen=True)
class Preset:
    """What a map is drawn over.

    Parameters
    ----------
    words : str
        What it shows.
    x, y : str
        Coordinates.
    ranges : pair of pairs of float
        Of x and of y [SI].
    fixed : mapping of str to float
        What else is given [SI].
    example : bool
        Whether the shipped experiment belongs on it.
    """

    words: str
    x: str
    y: str
    ranges: tuple[tuple[float, float], tuple[float, float]]
    fixed: Mapping[str, float]
    example: bool = False


def _known(**values: float) -> Mapping[str, float]:
    return MappingProxyType(values)


PRESETS: Mapping[str, Preset] = MappingProxyType(
    {
        "lengths": Preset(
            "the wire's radius beside both lengths of the material, xi = 0.1",
            "R_w/l_e",
            "R_w/l_w",
            ((1e-4, 1e2), (1e-2, 1e2)),
            _known(friction_coefficient=0.1),
        ),
        "groups": Preset(
            "the groups of the finite-element problem and of its friction, xi = 0.1",
            "g",
            "tau_w/(xi mu)",
            ((1e-2, 1e2), (1e-2, 1e2)),
            _known(friction_coefficient=0.1),
        ),
        "friction": Preset(
            "friction beside toughness for a solid with tau_w = mu/10",
            "R_w/l_e",
            "friction_coefficient",
            ((1e-2, 1e2), (1e-2, 1e1)),
            MappingProxyType({"tau_w/mu": 0.1}),
        ),
        "gel": Preset(
            "wires and toughnesses for a gel with the stiffness and wear of the paper's",
            "wire_radius",
            "toughness",
            ((1e-5, 1e-2), (5e-2, 5e1)),
            _known(shear_modulus=685.0, wear_strength=7750.0),
            example=True,
        ),
    }
)
"""Every preset by its name."""

DESCRIPTION = "Regime map over two quantities or dimensionless groups: figure, tables, boundaries."

_TWO_COLUMNS = 4.7
"""Width from which a map is laid out over two columns [inch]."""

_DIAMETERS = ("wire_diameter", "diameter", "D", "d_w", "2R_w")
"""Names by which an axis or what is fixed may be told in diameters."""

_DIMENSIONS: Mapping[str, Dimension] = {
    "m": LENGTH,
    "Pa": STRESS,
    "J/m^2": TOUGHNESS,
    "": NUMBER,
}

_NAMES = fill(
    f"NAME is a quantity or group: {', '.join(COORDINATES)}; or a letter: mu, Gamma_o, R_w, xi, "
    "tau_w, alpha; or wire_diameter, D. What a map needs and is not given is solved for.",
    96,
    break_on_hyphens=False,
)

EXAMPLES = f"""\
{_NAMES}

presets:
{table(("", "", ""), [("", name, preset.words) for name, preset in PRESETS.items()])[1:]}

examples:
  wirecut map --preset gel --out map.pdf
  wirecut map --points cuts.csv --material gel.json --out map.pdf
  wirecut map --x R_w 10um 10mm --y tau_w 1kPa 100kPa --fix mu=685Pa Gamma_o=1.6J/m2 --csv map.csv
"""


def add_options(command: argparse.ArgumentParser) -> None:
    """Add the options of the command to its parser."""
    add = command.add_argument
    add("--preset", choices=PRESETS, metavar="PRESET", help="a map that is often wanted, see below")
    for axis in "xy":
        add(f"--{axis}", nargs=3, metavar=("NAME", "LOW", "HIGH"), help=f"what {axis} shows")
    add("--linear", nargs="+", choices="xy", default=[], help="axes with a linear scale")
    add("--fix", nargs="+", default=[], metavar="NAME=VALUE", help="what else is given")
    add("--model", help="force model, see 'wirecut models' (default eq13, or that of --points)")
    add_law_option(command, any_law=True)
    add_notch_option(command)
    command.set_defaults(law=None)
    for option, metavar, default, words in (
        ("--threshold", "SHARE", DOMINANT_SHARE, "share from which a term dominates (default 2/3)"),
        ("--miss", "SHARE", 0.1, "share by which a limit may be off (default 0.1)"),
        (
            "--rtol",
            "ERROR",
            None,
            "error that has to be met with --model auto (default 0.02 where it can be had)",
        ),
    ):
        add(option, type=share, default=default, metavar=metavar, help=words)
    add(
        "--nodes",
        type=whole_number,
        default=201,
        metavar="N",
        help="nodes of each axis (default 201)",
    )
    add("--limits", nargs="+", default=[], metavar="MODEL", help="limits whose end is drawn")
    add("--error-of", metavar="MODEL", help="show this model's error beside the map's model")
    add("--no-contact", action="store_true", help="leave out where the wire touches the tip")
    add(
        "--points",
        nargs="+",
        default=[],
        metavar="FILE",
        help="draw your own cuts: the table that 'wirecut identify' reads, or what it prints with "
        "--json; without --preset, --x and --y the map is that of their gel",
    )
    add("--material", metavar="FILE", help="properties of the gel of --points (JSON)")
    add_table_options(command)
    add("--out", metavar="PICTURE", help="draw the map (.pdf, .svg, .png)")
    add("--csv", metavar="FILE", help="write the map, one line a node")
    add("--boundaries-csv", metavar="FILE", help="write the boundaries, one line a point")


def map_record(options: argparse.Namespace) -> dict[str, Any]:
    """Make the map, write what is wanted, and return what to print."""
    check_outputs(
        {
            "--out": options.out,
            "--csv": options.csv,
            "--boundaries-csv": options.boundaries_csv,
        },
        [*options.points, options.material],
    )
    _check_options(options)
    own = drawn_points(options, _fixed(options.fix)) if options.points else []
    made = run_map(options, own)
    points, notes = _points(PRESETS.get(options.preset), made, own)
    rows = points_record(own, points, made)
    if options.out:
        from surrogate.maps.figure import save_regime_map

        save_regime_map(
            made,
            options.out,
            points,
            limits=options.limits,
            contact=not options.no_contact,
            error_of=options.error_of,
            width="double" if (options.width or 0.0) > _TWO_COLUMNS else "single",
        )
    if options.csv:
        made.to_csv(options.csv)
    if options.boundaries_csv:
        made.boundaries_to_csv(options.boundaries_csv)
    files = [f for f in (options.out, options.csv, options.boundaries_csv) if f]
    read = [note for gel in own for note in gel.notes]
    doubted = [f"{gel.file}: {doubt}" for gel in own for doubt in gel.fit.warnings]
    summary = map_summary(made)
    doubts = [*[_NOWHERE] * (summary["in_domain"] == 0.0), *made.warnings]
    return {**summary, "files": files, "warnings": doubts} | {
        "notes": [
            *read,
            *doubted,
            *made.force.doubts,
            *(notes if options.out or own else []),
        ],
        "points": rows,
        "diameters": options.diameters,
    }


def _check_options(options: argparse.Namespace) -> None:
    """Refuse options that the others leave without a purpose."""
    for option, value in (("--limits", options.limits), ("--error-of", options.error_of)):
        if value and not options.out:
            raise InputError(f"{option} is for the picture; give --out as well, or leave it out.")
    for name in ("material", "thickness", "decimal", "delimiter", "encoding"):
        if getattr(options, name) is not None and not options.points:
            raise InputError(
                f"--{name} is for the table of --points; give --points FILE as well, or leave it "
                "out."
            )


def map_text(made: dict[str, Any]) -> str:
    """Return what `map_record` says, for people."""
    if made["diameters"]:
        made = _told_in_diameters(made)
    x, y = made["x"], made["y"]
    fixed = ", ".join(
        f"{n} = {number(v)} {COORDINATES[n].unit if n in COORDINATES else 'm'}".rstrip()
        for n, v in made["fixed"].items()
    )
    head = (
        f"Map over {_range(x)} and {_range(y)}, model {made['model']}\nfixed: {fixed or 'nothing'}"
    )
    shares = [(name, f"{100.0 * share:.1f} %") for name, share in made["regimes"].items()]
    rows = [
        (
            one["kind"],
            one["equation"],
            "closed form" if one["exact"] else "contour",
            _place(line["start"], x, y),
            _place(line["end"], x, y),
        )
        for one in made["boundaries"]
        for line in one["lines"]
    ]
    parts = [
        head,
        table(("dominant term", "of the map"), shares),
        _laws(made),
        _reach(made["in_domain"]),
        table(("boundary", "equation", "from", "start (x, y)", "end (x, y)"), rows),
    ]
    parts.insert(1, points_text(made["points"], x, y, made["diameters"]))
    parts += [fill(f"Note: {note}", 96, subsequent_indent="  ") for note in made["notes"]]
    if made["files"]:
        parts.append(f"Written: {', '.join(made['files'])}")
    return "\n\n".join(part for part in parts if part)


def _reach(share: float) -> str:
    """Say on how much of a map the model holds, and what the rest shows."""
    text = f"The model holds on {100.0 * share:.1f} % of the map"
    more = "; elsewhere it is continued (hatched in the picture), and the shares are of both."
    return fill(text + (more if share < 1.0 else "."), 96)


_NOWHERE = """\
the model under this law holds nowhere on the map, whose regimes are those of a continuation; \
change the ranges, --law or --model"""


def _laws(made: dict[str, Any]) -> str:
    """Return the laws of a map on which they were chosen, for people."""
    if len(made["laws"]) == 1:
        return f"Law: {next(iter(made['laws']))}."
    rows = [(name, f"{100.0 * share:.1f} %") for name, share in made["laws"].items()]
    return table(("law", "of the map"), rows)


def _told_in_diameters(made: dict[str, Any]) -> dict[str, Any]:
    """Return the record of a map with diameters of wires in place of radii."""
    radius, diameter = "wire_radius", "wire_diameter"
    factors = [2.0 if made[axis]["name"] == radius else 1.0 for axis in "xy"]
    told = dict(made)
    for axis, factor in zip("xy", factors, strict=True):
        one = made[axis]
        ends = {end: factor * one[end] for end in ("low", "high")}
        told[axis] = one | ends | ({"name": diameter} if factor == 2.0 else {})
    told["fixed"] = {
        (diameter if name == radius else name): (2.0 * value if name == radius else value)
        for name, value in made["fixed"].items()
    }
    told["boundaries"] = [
        one
        | {
            "lines": [
                {end: list(np.multiply(line[end], factors)) for end in ("start", "end")}
                for line in one["lines"]
            ]
        }
        for one in made["boundaries"]
    ]
    return told


def run_map(options: argparse.Namespace, own: Sequence[Drawn] = ()) -> RegimeMap:
    preset = PRESETS.get(options.preset)
    if own and preset is None and options.x is options.y is None:
        preset = _around(own)
    x, x_range = _axis(options.x, preset, 0)
    y, y_range = _axis(options.y, preset, 1)
    fixed = {**(preset.fixed if preset else {}), **_fixed(options.fix)}
    fixed |= taken_from(own, (x, y), fixed)
    return regime_map(
        x,
        y,
        (x_range, y_range),
        fixed,
        own[0].fit.model if own else options.model or "eq13",
        rtol=options.rtol,
        law=PROJECTED if own else options.law or AUTO,  # an identified model has its own
        scales=tuple("linear" if axis in options.linear else "log" for axis in "xy"),
        nodes=options.nodes,
        threshold=options.threshold,
        miss=options.miss,
        notch_radius=options.notch_radius,
    )


def _around(own: Sequence[Drawn]) -> Preset:
    """Return the map of a gel around its own cuts; of several, over groups that they share."""
    x, y = ("wire_radius", "toughness") if len(own) == 1 else ("R_w/l_e", "R_w/l_w")
    ranges = range_of(own, COORDINATES[x]), range_of(own, COORDINATES[y])
    return Preset("around the points", x, y, ranges, {})


def _axis(
    given: list[str] | None, preset: Preset | None, which: int
) -> tuple[str, tuple[float, float]]:
    if given is not None:
        name, factor = _in_radii(given[0])
        one = coordinate(name)
        low, high = (factor * parse_quantity(text, _DIMENSIONS[one.unit]) for text in given[1:])
        return one.name, (low, high)
    if preset is None:
        raise InputError(f"the map's {'xy'[which]} is missing; give --{'xy'[which]} or --preset.")
    return (preset.x, preset.y)[which], preset.ranges[which]


def _fixed(items: list[str]) -> dict[str, float]:
    fixed: dict[str, float] = {}
    for item in items:
        name, equals, text = item.partition("=")
        if not equals:
            raise InputError(f"{item!r} fixes nothing; write NAME=VALUE, for instance mu=685Pa.")
        radius_or_other, factor = _in_radii(name.strip())
        one = coordinate(radius_or_other)
        fixed[one.name] = factor * parse_quantity(text, _DIMENSIONS[one.unit])
    return fixed


def _in_radii(name: str) -> tuple[str, float]:
    """Return the coordinate of a name and by what its values become those of it."""
    return ("wire_radius", 0.5) if name in _DIAMETERS else (name, 1.0)


def _points(
    preset: Preset | None, made: RegimeMap, own: Sequence[Drawn]
) -> tuple[list[MapPoints], list[str]]:
    """Return what is to be drawn on a map, and why a preset's experiment does not belong there."""
    points, notes = [], []
    for gel in own:
        for mode, one in enumerate(gel.points):
            try:
                # the materials that fit are told apart by their values, whatever the errors
                require_the_same(replace(one, std={}, correlation={}) if mode else one, made)
            except InputError as error:
                if mode == 0:
                    raise
                notes.append(f"another material that fits is left out: {error}")
            else:
                points.append(one)
    if own or preset is None or not preset.example:
        return points, notes
    points = _example()
    try:
        for one in points:
            require_the_same(one, made)
    except InputError as error:
        return [], [f"the experiment is left out of the picture: {error}"]
    return points, []


def _example() -> list[MapPoints]:
    """Return the shipped experiment, with what Eq. (13) says about its gel."""
    cuts = read_measurements(model_file("paam-wire-cutting.csv"))
    material = read_material(model_file("paam-material.json"))
    fit = identify(cuts.wire_radius, cuts.force, material.shear_modulus or np.nan, model="eq13")
    return [MapPoints(fit.scene(cuts.wire_radius), "PAAm, Eq. (13)")]


def _range(axis: dict[str, Any]) -> str:
    unit = f" {axis['unit']}" if axis["unit"] else ""
    return f"{axis['name']} {number(axis['low'])} to {number(axis['high'])}{unit}"


def _place(point: list[float], x: dict[str, Any], y: dict[str, Any]) -> str:
    return ", ".join(
        f"{number(value)} {axis['unit']}".strip() for value, axis in zip(point, (x, y), strict=True)
    )

"""What `wirecut map --points` draws: a lab's own cuts, out of their table or an earlier result."""

from __future__ import annotations

import argparse
import json
import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from surrogate.basics.files import opened
from surrogate.basics.records import number, table
from surrogate.choosing.by_name import force_model
from surrogate.choosing.laws import PROJECTED
from surrogate.cli.common import Record, wire_rows
from surrogate.contact.closed_forms import ClosedForm
from surrogate.cutting.regimes import classify
from surrogate.errors import InputError
from surrogate.identification.fit import Identification, identify
from surrogate.maps.axes import COORDINATES, Coordinate
from surrogate.maps.identified import admitted_modes
from surrogate.maps.points import MapPoints, places, relative_std, value_of
from surrogate.maps.record import MapRecord
from surrogate.reading.material import Material, read_material
from surrogate.reading.measurements import read_measurements

__all__ = ["Drawn", "drawn_points", "points_record", "points_text", "range_of", "taken_from"]

_LARGEST_RESULT = 5_000_000
_SOLID = ("shear_modulus", "friction_coefficient", "stiffening_exponent")
_NODES = np.array([1.0, 2.0, 5.0, 10.0])
_WIDER = {"wire_radius": 4.0}
"""Times beyond the points that an axis goes; 10 for all others."""


@dataclass(frozen=True, eq=False)
class Drawn:
    """One gel whose cuts are drawn.

    Parameters
    ----------
    file : str
        Its table or result.
    fit : Identification
        What its forces say.
    points : tuple of MapPoints
        Its cuts, once for every material that the forces admit.
    notes : tuple of str
        How its table was read.
    """

    file: str
    fit: Identification
    points: tuple[MapPoints, ...]
    notes: tuple[str, ...]


def drawn_points(options: argparse.Namespace, fixed: Mapping[str, float]) -> list[Drawn]:
    """Return the gels of `--points`, identified under the law and model of the map.

    Parameters
    ----------
    options : argparse.Namespace
        Those of the command.
    fixed : mapping of str to float
        What `--fix` says, where it tells of the material what no file does [SI].

    Raises
    ------
    InputError
        If a file is neither a table nor a result, or its numbers should not be used.
    """
    results = {file: _result(file) for file in options.points}
    if not options.material:
        pass
    elif all(results.values()):
        raise InputError("--material: the results of --points tell that already; leave it out.")
    model = options.model or _common(results, "model") or "auto"
    law = options.law or _common(results, "law") or "projected"
    material = _material(options, fixed)
    drawn = []
    for file, record in results.items():
        notes: tuple[str, ...] = ()
        try:
            if record is not None:
                fit = _identified_again(record, model, law)
            else:
                fit, notes = _identified(options, file, material, model, law)
            label = os.path.splitext(os.path.basename(str((record or {}).get("file", file))))[0]
            modes = admitted_modes(fit)
            points = tuple(MapPoints.from_identification(fit, label, mode) for mode in modes)
        except InputError as error:
            text = str(error)
            raise InputError(text if text.startswith(file) else f"{file}: {text}") from None
        drawn.append(Drawn(file, fit, points, notes))
    return drawn


def _result(file: str) -> Record | None:
    """Return what `wirecut identify --json` wrote to a file; None where it is a table."""
    if os.path.isdir(file):
        raise InputError(
            f"{file} is a folder; write the table of its records by 'wirecut steady ... --out "
            "cuts.csv'."
        )
    with opened(file) as stream:
        content = stream.read(_LARGEST_RESULT)
    start = content[:64].lstrip(b"\xef\xbb\xbf\xff\xfe\0 \t\r\n")  # in UTF-16 as well
    if not start.startswith(b"{"):
        return None
    try:
        record = json.loads(content)
        if not {"wires", "known", "model", "law"} <= set(record):
            raise ValueError
    except ValueError:
        raise InputError(
            f"{file}: is neither a table of cuts nor a result; give the table that 'wirecut "
            "identify' reads, or what it prints with --json."
        ) from None
    return dict(record)


def _common(results: Mapping[str, Record | None], what: str) -> str | None:
    """Return the model or law of the results, which one map has in common."""
    # a model under another law is written with it, as "table, law slip"
    of = {str(record[what]).partition(",")[0]: file for file, record in results.items() if record}
    if len(of) > 1:
        (one, file), (other, second) = list(of.items())[:2]
        raise InputError(
            f"{file} is of the {what} {one} and {second} of {other}; name by --{what} the one that "
            "the map and all points are to have."
        )
    return next(iter(of), None)


def _identified_again(record: Record, model: str, law: str) -> Identification:
    """Return the identification of a result's own forces, of which every choice is in it."""
    wires = record["wires"]
    try:
        columns = {
            name: None if wires[0][name] is None else [wire[name] for wire in wires]
            for name in ("wire_radius", "force", "force_std", "sample")
        }
        assumed = set(record["assumed"])
        solid = {name: None if name in assumed else record[name] for name in _SOLID}
        stated = ("shear_modulus_std", "friction_std", "stiffening_std")
        facts: dict[str, Any] = {
            **solid,
            **{name: record[name] or 0.0 for name in stated},
            **record["known"],
            "confidence": record["confidence"],
        }
    except (KeyError, TypeError, IndexError):
        raise InputError(
            "is a result without all that it rests on; write it anew by 'wirecut identify ... "
            "--json'."
        ) from None
    return identify(
        columns["wire_radius"],
        columns["force"],  # type: ignore[arg-type]
        force_std=columns["force_std"],
        sample=columns["sample"],
        model=model,
        law=law,
        **facts,
    )


def _material(options: argparse.Namespace, fixed: Mapping[str, float]) -> Material:
    material = read_material(options.material) if options.material else Material()
    given: dict[str, Any] = {name: fixed[name] for name in _SOLID if name in fixed}
    stated = {name: value for name in given if (value := getattr(material, name)) is not None}
    if stated:
        name = next(iter(stated))
        unit = f" {COORDINATES[name].unit}".rstrip()
        raise InputError(
            f"{name} is {stated[name]:g}{unit} in {options.material} and {given[name]:g}{unit} by "
            "--fix; give it once."
        )
    return replace(material, **given)


def _identified(
    options: argparse.Namespace, file: str, material: Material, model: str, law: str
) -> tuple[Identification, tuple[str, ...]]:
    cuts = read_measurements(
        file,
        options.thickness,
        decimal=options.decimal,
        delimiter=options.delimiter,
        encoding=options.encoding,
    )
    if material.shear_modulus is None:
        raise InputError(
            "the shear modulus is missing; give --material FILE or --fix mu=685Pa, or the result "
            "of 'wirecut identify ... --json' instead of the table."
        )
    fit = identify(
        cuts.wire_radius,
        cuts.force,
        material.shear_modulus,
        friction_coefficient=material.friction_coefficient,
        stiffening_exponent=material.stiffening_exponent,
        shear_modulus_std=material.shear_modulus_std or 0.0,
        force_std=cuts.force_std,
        sample=cuts.samples,
        model=model,
        law=law,
    )
    return fit, cuts.notes


def taken_from(
    drawn: Sequence[Drawn], axes: Iterable[str], fixed: Mapping[str, float]
) -> dict[str, float]:
    """Return what a map that nothing else determines takes from the points' material [SI].

    The quantities that neither an axis nor what is fixed depends on.
    """
    if not drawn:
        return {}
    scene = drawn[0].points[0].scene
    touched = {quantity for name in (*axes, *fixed) for quantity in COORDINATES[name].powers}
    names = ["shear_modulus", "toughness", "friction_coefficient", "wear_strength"]
    if not isinstance(force_model(drawn[0].fit.model), ClosedForm):
        names.append("stiffening_exponent")
    return {name: float(getattr(scene, name)) for name in names if name not in touched}


def range_of(drawn: Sequence[Drawn], one: Coordinate) -> tuple[float, float]:
    """Return the range of an axis around points: a step of 1, 2 or 5 beyond a factor.

    Raises
    ------
    InputError
        If a point is at 0, which has no place on a logarithmic axis.
    """
    values, errors = zip(
        *((value_of(p, one), relative_std(p, one)) for gel in drawn for p in gel.points),
        strict=True,
    )
    low = min(float(np.min(value)) for value in values)
    high = max(
        float(np.max(value * (1.0 + error))) for value, error in zip(values, errors, strict=True)
    )
    if not 0.0 < low <= high < np.inf:
        raise InputError(
            f"{one.words} is {low:g} for one of the points, which has no place on a logarithmic "
            "axis; name axes by --x and --y."
        )
    factor = _WIDER.get(one.name, 10.0)
    return _step(low / factor, below=True), _step(high * factor, below=False)


def _step(value: float, below: bool) -> float:
    """Return the next 1, 2 or 5 times a power of ten."""
    power = 10.0 ** np.floor(np.log10(value))
    steps = _NODES * power
    last = steps[steps <= value * (1.0 + 1e-9)][-1]
    return float(f"{last if below else steps[steps >= value * (1.0 - 1e-9)][0]:.6g}")


def points_record(
    drawn: Sequence[Drawn], shown: Sequence[MapPoints], made: MapRecord
) -> list[Record]:
    """Return the places of the points shown, their standard errors and what dominates there."""
    rows = []
    for gel in drawn:
        for points in gel.points:
            if points not in shown:
                continue
            centre, error = places(points, made)
            model: Any = made.model  # which has its law, or is of the projected one
            regime = classify(
                points.scene, made.regime.threshold, model, extrapolate=True, law=PROJECTED
            )
            rows += [
                {"points": points.label, "file": gel.file, **row}
                for row in wire_rows(
                    wire_radius=points.scene.wire_radius,
                    x=centre[0],
                    y=centre[1],
                    x_std=error[0],
                    y_std=error[1],
                    dominant=regime.dominant,
                )
            ]
    return rows


def points_text(rows: Sequence[Record], x: Record, y: Record, diameters: bool) -> str:
    """Return what `points_record` says, for people."""
    if not rows:
        return ""
    symbol, factor = ("2R_w", 2.0) if diameters else ("R_w", 1.0)
    axes = [f"{axis['name']} [{axis['unit'] or '-'}]" for axis in (x, y)]
    apart = not any(axis["name"].startswith("wire_") for axis in (x, y))
    header = ("Points", *([f"{symbol} [mm]"] if apart else []), *axes, "dominant term")
    return table(
        header,
        [
            (
                row["points"],
                *([number(1e3 * factor * row["wire_radius"])] if apart else []),
                *(
                    f"{number(scale * row[axis], 3)} +- {number(scale * row[f'{axis}_std'], 2)}"
                    if row[f"{axis}_std"]
                    else number(scale * row[axis], 3)
                    for axis, scale in (
                        ("x", factor if x["name"].startswith("wire_") else 1.0),
                        ("y", factor if y["name"].startswith("wire_") else 1.0),
                    )
                ),
                row["dominant"],
            )
            for row in rows
        ],
    )

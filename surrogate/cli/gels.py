"""`wirecut identify`: one gel, or several beside each other with which of them differ."""

from __future__ import annotations

import argparse
import math
import os
import sys
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from textwrap import fill
from typing import Any

from surrogate.basics.files import check_outputs, write_csv
from surrogate.basics.records import table
from surrogate.choosing.by_name import force_model
from surrogate.choosing.laws import PROJECTED
from surrogate.cli.common import DOUBTED, Record, print_record
from surrogate.cli.identification_text import identification_record, identification_text
from surrogate.cli.identify import (
    identified,
    measurements_by_options,
    of_gel,
    outputs_of,
    run_one,
)
from surrogate.comparing.difference import Difference
from surrogate.comparing.gels import Comparison, GelPair, compare_gels
from surrogate.errors import InputError
from surrogate.identification.fit import Identification
from surrogate.identification.summary import law_in_words, quantity_ranges
from surrogate.reading.material import Material
from surrogate.reading.measurements import Measurements
from surrogate.version import __version__

__all__ = ["run_identify"]


@dataclass(frozen=True, eq=False)
class _Gel:
    """One of several gels: where its forces are from, what they say, and all that is told of it."""

    file: str
    measurements: Measurements
    fit: Identification
    record: Record


def run_identify(options: argparse.Namespace) -> int:
    """Identify one gel or several, print what they say, and return the exit code."""
    if options.example and (options.by or options.file):
        raise InputError("--example is one gel of its own; leave out --by and FILE.")
    if len(options.file) < 2 and not options.by:
        return run_one(options)
    if options.write_material:
        raise InputError("--write-material is for one gel, but there are several; leave it out.")
    pairs_file = _beside(options.csv) if options.csv else None
    check_outputs(
        {**outputs_of(options), "--csv, the pairs": pairs_file},
        [*options.file, *(options.material or [])],
    )
    gels = _gels(options)
    comparison = compare_gels({name: gel.fit for name, gel in gels.items()}, options.confidence)
    if options.plot:
        from surrogate.comparing.figure import save_gels

        save_gels(comparison.gels, options.plot)
    if options.csv:
        _write(gels, options.csv)
        _write_pairs(comparison, str(pairs_file))
    first = next(iter(gels.values())).fit
    record = {
        "version": __version__,
        "confidence": options.confidence,
        "model": force_model(first.model).name,
        "law": first.law,
        "law_words": law_in_words(first),
        "gels": {name: gel.record for name, gel in gels.items()},
        "comparisons": [_pair_record(pair, comparison) for pair in comparison.pairs],
        "comparisons_rest_on": list(comparison.rests_on),
        "written": [file for file in (options.plot, options.csv, pairs_file) if file],
    }
    print_record(options, record, lambda told: _text(told, gels, options.verbose))
    doubted = any(gel.record["objections"] or gel.measurements.warnings for gel in gels.values())
    return DOUBTED if doubted else 0


def _gels(options: argparse.Namespace) -> dict[str, _Gel]:
    """Return every gel by its name, in the order of the files and tables."""
    read = list(_tables(options))
    names = _names([(name, file) for name, file, _ in read])
    gels = {}
    identifications = _identified(options, names, [cuts for _, _, cuts in read])
    for name, (_, file, measurements), (fit, material) in zip(
        names, read, identifications, strict=True
    ):
        record = {
            "file": os.path.basename(os.path.normpath(file)),
            "notes": list(measurements.notes),
            "forces": "measured",
            "picture": None,
            "verbose": True,
            **identification_record(fit, material),
        }
        gels[name] = _Gel(file, measurements, fit, record)
    return gels


def _identified(
    options: argparse.Namespace, names: Sequence[str], read: Sequence[Measurements]
) -> list[tuple[Identification, Material]]:
    """Return what each gel says, all under one law, without which none can be compared."""
    fits = []
    for number, (name, cuts) in enumerate(zip(names, read, strict=True)):
        try:
            fits.append(identified(of_gel(options, number, len(read)), cuts))
        except InputError as error:
            raise InputError(f"{name}: {error}") from None
    if len({fit.law for fit, _ in fits}) < 2:
        return fits
    first = next(i for i, (fit, _) in enumerate(fits) if fit.law == PROJECTED)
    why = f"one law for all gels, and of {names[first]} {fits[first][0].law_reason}"
    common = argparse.Namespace(**{**vars(options), "law": PROJECTED})
    return [
        (replace(fit, law_reason=why), material)
        for fit, material in _identified(common, names, read)
    ]


def _tables(options: argparse.Namespace) -> Iterator[tuple[str, str, Measurements]]:
    """Yield name, file and measurements of each gel."""
    for place, file in enumerate(options.file):
        measurements = measurements_by_options(_of_file(options, place), file)
        for note in measurements.notes:
            print(f"note: {note}", file=sys.stderr)
        if options.by:
            for name, cuts in measurements.of_each_gel().items():
                yield name, file, replace(cuts, notes=measurements.notes)
        else:
            name = os.path.basename(os.path.normpath(file))
            yield name if os.path.isdir(file) else os.path.splitext(name)[0], file, measurements


def _of_file(options: argparse.Namespace, place: int) -> argparse.Namespace:
    """Return the options by which a file is read."""
    if not options.by:
        return of_gel(options, place, len(options.file))
    if os.path.isdir(options.file[place]):
        raise InputError(
            f"--by names a column of a table, but {options.file[place]} is a folder; leave it out."
        )
    if len(options.thickness or ()) > 1:
        raise InputError(
            "--thickness is given once with --by; give a column thickness_mm where gels differ."
        )
    thickness = options.thickness[0] if options.thickness else None
    return argparse.Namespace(**{**vars(options), "thickness": thickness})


def _names(gels: Sequence[tuple[str, str]]) -> list[str]:
    """Return one name for each gel: with its file where two have the same.

    Raises
    ------
    InputError
        If that does not tell them apart.
    """
    count = Counter(name for name, _ in gels)
    names = [name if count[name] == 1 else f"{name} ({file})" for name, file in gels]
    if len(set(names)) < len(names):
        twice = next(name for name in names if names.count(name) > 1)
        raise InputError(f"{twice} is given twice; give each gel once.")
    return names


def _pair_record(pair: GelPair, comparison: Comparison) -> Record:
    """Return what is told of a pair, null where nothing is to be told."""

    def of(one: Difference | None) -> Record | None:
        if one is None:
            return None
        kept = ("value", "interval", "p", "p_adjusted", "dof")
        differs = pair.differs(1.0 - comparison.confidence, one.quantity)
        return {name: getattr(one, name) for name in kept} | {"differs": differs}

    return {
        "first": pair.first,
        "second": pair.second,
        "answer": pair.words(comparison.confidence),
        "differ": None if pair.objections else pair.differs(1.0 - comparison.confidence),
        "p": pair.p,
        "p_adjusted": pair.p_adjusted,
        "toughness": of(pair.toughness),
        "wear_strength": of(pair.wear_strength),
        "objections": list(pair.objections),
    }


def _text(record: Record, gels: Mapping[str, _Gel], verbose: bool) -> str:
    """Return the results as a table, which gels differ, what is doubted, then all if asked for."""
    against = [one for name, gel in gels.items() for one in _against(name, gel)]
    parts = ["\n".join(map(_wrapped, against)), _results(record, gels)]
    parts.append("\n".join(_wrapped(f"{one['answer']}.") for one in record["comparisons"]))
    resting = [record["law_words"], *(f"{one}." for one in record["comparisons_rest_on"])]
    parts.append("\n".join(map(_wrapped, resting)))
    parts.append("\n".join(_wrapped(one) for name, gel in gels.items() for one in _said(name, gel)))
    if verbose:
        parts += [f"{name}\n\n{identification_text(gel.record)}" for name, gel in gels.items()]
    else:
        parts.append("--verbose prints all tables of each gel.")
    if record["written"]:
        parts.append(f"Written: {', '.join(record['written'])}")
    return "\n\n".join(part for part in parts if part)


def _wrapped(sentence: str) -> str:
    return fill(sentence, 96, subsequent_indent="  ")


def _results(record: Record, gels: Mapping[str, _Gel]) -> str:
    rows = []
    for name, gel in gels.items():
        ranges = [words.removeprefix("= ") for _, _, words in quantity_ranges(gel.fit)]
        if gel.record["objections"]:
            ranges = ["not to be used", ""]
        doubts = len(gel.record["warnings"]) + len(gel.record.get("undecided", ()))
        rows.append((name, *ranges, str(gel.fit.force.size), str(doubts) if doubts else "none"))
    percent = f"{100.0 * record['confidence']:.4g} %"
    header = ("Gel", "Gamma_o [J/m2]", "tau_w [kPa]", "cuts", "doubts")
    by = f"model {record['model']}, law {record['law']}"
    return f"{table(header, rows)}\nWith {percent} intervals, {by}."


def _against(name: str, gel: _Gel) -> Iterator[str]:
    """Yield what forbids the use of a gel's numbers."""
    yield from (f"Do not use the numbers of {name}: {one}." for one in gel.record["objections"])


def _said(name: str, gel: _Gel) -> Iterator[str]:
    """Yield what else is doubted or left open of one gel."""
    objections = gel.record["objections"]
    for sentence in gel.record["warnings"]:
        if sentence not in objections:
            yield f"{name}: warning: {sentence}."
    yield from (f"{name}: undecided: {sentence}." for sentence in gel.record.get("undecided", ()))


def _write(gels: Mapping[str, _Gel], file: str) -> None:
    """Write one row a gel; of one that should not be used without its numbers."""
    usable = [not gel.record["objections"] for gel in gels.values()]

    def column(values: Sequence[Any]) -> list[str]:
        return [
            f"{value!r}" if use and value is not None and math.isfinite(value) else ""
            for value, use in zip(values, usable, strict=True)
        ]

    records = [gel.record for gel in gels.values()]
    columns: dict[tuple[str, str], Any] = {
        ("gel", ""): list(gels),
        ("file", ""): [record["file"] for record in records],
        ("cuts", ""): [gel.fit.force.size for gel in gels.values()],
        ("usable", ""): ["yes" if use else "no" for use in usable],
    }
    for name, unit in (("toughness", "J/m^2"), ("wear_strength", "Pa")):
        intervals = [record[f"{name}_interval"] or (math.nan, math.nan) for record in records]
        columns[name, unit] = column([record[name] for record in records])
        columns[f"{name}_std", unit] = column([record[f"{name}_std"] for record in records])
        columns[f"{name}_low", unit] = column([low for low, _ in intervals])
        columns[f"{name}_high", unit] = column([high for _, high in intervals])
    for name, unit in (("shear_modulus", "Pa"), ("friction_coefficient", "")):
        columns[name, unit] = [repr(record[name]) for record in records]
    columns["doubts", ""] = ["; ".join(record["warnings"]) for record in records]
    first = next(iter(gels.values())).fit
    about = [
        f"several gels by wirecut identify {__version__}, model {force_model(first.model).name}, "
        f"law {first.law}",
        f"low and high are the ends of {100.0 * first.confidence:.4g} % intervals",
    ]
    write_csv(file, columns, about)


def _beside(file: str) -> str:
    """Return the name of the table of pairs beside that of the gels.

    Examples
    --------
    >>> _beside("out/gels.csv")
    'out/gels-pairs.csv'
    """
    stem, ending = os.path.splitext(file)
    return f"{stem}-pairs{ending}"


def _write_pairs(comparison: Comparison, file: str) -> None:
    """Write one row a pair; without numbers of one that is not compared."""
    pairs = comparison.pairs
    records = [_pair_record(pair, comparison) for pair in pairs]

    def column(values: Sequence[Any]) -> list[str]:
        return [
            "" if value is None or not math.isfinite(value) else repr(value) for value in values
        ]

    def differs(told: Sequence[Any]) -> list[str]:
        return [{None: "", True: "yes", False: "no"}[one] for one in told]

    columns: dict[tuple[str, str], Any] = {
        ("first", ""): [pair.first for pair in pairs],
        ("second", ""): [pair.second for pair in pairs],
        ("differ", ""): differs([record["differ"] for record in records]),
        ("p", ""): column([pair.p for pair in pairs]),
        ("p_adjusted", ""): column([pair.p_adjusted for pair in pairs]),
    }
    for name, unit in (("toughness", "J/m^2"), ("wear_strength", "Pa")):
        told = [record[name] or {} for record in records]
        ends = [one.get("interval", (math.nan, math.nan)) for one in told]
        columns[f"{name}_difference", unit] = column([one.get("value") for one in told])
        columns[f"{name}_low", unit] = column([low for low, _ in ends])
        columns[f"{name}_high", unit] = column([high for _, high in ends])
        columns[f"{name}_p_adjusted", ""] = column([one.get("p_adjusted") for one in told])
        columns[f"{name}_differs", ""] = differs([one.get("differs") for one in told])
    columns["not_compared", ""] = ["; ".join(pair.objections) for pair in pairs]
    about = [f"pairs of gels by wirecut identify {__version__}", *comparison.rests_on]
    write_csv(file, columns, about)

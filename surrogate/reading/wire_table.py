"""Tables of wires and forces: their header, whatever it is called, and what is below it."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from surrogate.errors import InputError
from surrogate.reading.before import thickness_before
from surrogate.reading.forms.cells import tidied
from surrogate.reading.forms.gauges import is_gauge, names_other_gauge
from surrogate.reading.forms.merged import merged_names, with_wires
from surrogate.reading.forms.remarks import SUMMARY, measurements_apart, sums_up
from surrogate.reading.headings import Heading, headings, is_units_row, meaning, split_unit
from surrogate.reading.sheet import Row, Sheet
from surrogate.reading.words.phrases import is_scatter
from surrogate.reading.words.spelling import plain
from surrogate.reading.words.wire_words import (
    COLUMNS,
    COUNT,
    DEVIATION,
    SAMPLE,
    WORDS,
    is_force,
)

__all__ = ["Table", "find_table", "has_table"]

_OF_STEADY = re.compile(
    "file|specimen number|trial|within record error of force|plateau (from|to|drift)|"
    "peak of force|stick slip drop|(offset|tare) subtracted"
)
"""Columns of `wirecut steady` that say how a force was taken."""


@dataclass(frozen=True)
class Table:
    """The columns of a table by quantity, its rows, and what of it is not used.

    Parameters
    ----------
    header : Row
        The names.
    columns : dict of str to list of Heading
        Those that are understood.
    rows : list of Row
        Those below the header, without that of units.
    width : int
        Number of columns.
    thickness : (float, str) or None
        That of the sample [m] and where it stands, above the header.
    sample, count, gel : int or None
        Indices of the columns that name samples, that count what a standard deviation is of, and
        that name gels where a column was asked for.
    notes : list of str
        What is not used.
    """

    header: Row
    columns: dict[str, list[Heading]]
    rows: list[Row]
    width: int
    thickness: tuple[float, str] | None
    sample: int | None
    count: int | None = None
    gel: int | None = None
    notes: list[str] = field(default_factory=list)


def has_table(sheet: Sheet) -> bool:
    """Whether a row or a column of a sheet names a wire."""
    return any(_is_wire(cell) for row in sheet.rows[:200] for cell in row.cells)


def find_table(sheet: Sheet, by: str | None = None) -> tuple[Sheet, Table]:
    """Return the table of measurements in a sheet, which it may turn by a quarter.

    Parameters
    ----------
    sheet : Sheet
        What was read.
    by : str, optional
        Name of the column that names the gel of each row.

    Raises
    ------
    InputError
        If it has no wire or no force, or one of them twice or without a unit, or no column `by`.
    """
    if not sheet.rows:
        raise InputError(
            f"{sheet.file} is empty; write a header such as "
            "wire_radius_mm,force_per_thickness_N_per_m and one line a wire."
        )
    start = _header(sheet)
    first, *others = [cell for cell in sheet.rows[start].cells if cell] or [""]
    if others and _known(first) and any(map(sheet.is_number, others)) and not _names(others):
        sheet = sheet.on_its_side()
        start = _header(sheet)
    header, units, body, notes = _parts(sheet, start)
    listed = headings(sheet, header, WORDS, units)
    gel = None if by is None else _named(sheet, header, listed, by)
    named = [one.number - 1 for one in listed if plain(one.name) in SAMPLE]
    sample = next((index for index in named if index != gel), None)
    before = thickness_before(sheet, sheet.rows[:start])
    columns = _by_quantity(sheet, header, listed)
    table = Table(header, columns, body, len(listed), before, sample, gel=gel)
    table.notes.extend((*sheet.notes, *notes))
    table = replace(table, count=_count(table, listed))
    besides = (table.sample, table.count, table.gel)
    unknown = [one for one in listed if not one.quantity and one.number - 1 not in besides]
    names = [str(one) for one in unknown if one.name or _filled(one, body)]
    _check_columns(sheet, table, names)
    names = [one for one in names if not _is_of_steady(one)]
    if names:
        table.notes.append(f"{sheet.file}: not used: {', '.join(names)}")
    return sheet, table


def _parts(sheet: Sheet, start: int) -> tuple[Row, Row | None, list[Row], list[str]]:
    """Return the names, the units below them, the measurements, and what else stands there."""
    header, body = sheet.rows[start], sheet.rows[start + 1 :]
    wire = next((i for i, cell in enumerate(header.cells) if _is_wire(cell)), None)
    forces = [i for i, cell in enumerate(header.cells) if is_force(cell)]
    notes: list[str] = []
    if body and wire is not None:
        below = body[0]
        summary = [i for i, cell in enumerate(below.cells) if SUMMARY.fullmatch(plain(cell))]
        names = merged_names(sheet, header, below, wire, forces, summary)
        if names:
            notes.append(f"{sheet.place(below)} is taken for the numbers of trials of one force")
            header, body = Row(header.line, names), body[1:]
            forces = [i for i, cell in enumerate(names) if is_force(cell)]
    units = body.pop(0) if body and is_units_row(sheet, body[0]) else None
    summing = [row for row in body if sums_up(row, wire)]
    body = [row for row in body if row not in summing]
    if summing:
        lines = ", ".join(f"{row.line} ({next(filter(None, row.cells))})" for row in summing)
        notes.append(f"{sheet.file}: sums up and not read: {sheet.line} {lines}")
    if wire is not None and forces:
        body, remarks = measurements_apart(sheet, body, wire, forces, _is_header)
        body, merged = with_wires(sheet, body, wire, forces)
        notes += remarks + merged
    header, units, body, taken = tidied(sheet, header, units, body)
    return header, units, body, notes + taken


def _is_header(row: Row) -> bool:
    return any(map(_is_wire, row.cells)) and any(map(is_force, row.cells))


def _is_wire(name: str) -> bool:
    meanings = meaning(split_unit(name, WORDS)[0], WORDS)[0]
    if meanings:
        return meanings[0][0] in ("wire_radius", "wire_diameter")
    return is_gauge(name)


def _named(sheet: Sheet, header: Row, listed: list[Heading], name: str) -> int:
    """Return the index of the column of a name."""
    for one in listed:
        if plain(one.name) == plain(name):
            return one.number - 1
    names = ", ".join(one.name for one in listed if one.name)
    raise InputError(
        f"{sheet.place(header)} has no column {name!r}; name one of {names} by --by (by= in "
        "Python), or leave it out where the table is of one gel."
    )


def _is_of_steady(column: str) -> bool:
    name = plain(column.partition("(")[2].removesuffix(")"))
    return any(_OF_STEADY.fullmatch(one) for one in (name, name.rpartition(" ")[0]))


def _count(table: Table, listed: list[Heading]) -> int | None:
    """Return the index of the column that tells how many cuts a standard deviation is of."""
    stds = [one for kind in ("force_std", "total_std") for one in table.columns.get(kind, ())]
    names = [split_unit(one.name, WORDS)[0] for one in stds]
    if not any(DEVIATION.search(plain(name)) or is_scatter(name) for name in names):
        return None
    return next((one.number - 1 for one in listed if plain(one.name) in COUNT), None)


def _filled(heading: Heading, body: list[Row]) -> bool:
    index = heading.number - 1
    return any(len(row.cells) > index and row.cells[index] for row in body)


def _known(name: str) -> bool:
    return bool(meaning(split_unit(name, WORDS)[0], WORDS)[0])


def _names(cells: Sequence[str]) -> bool:
    return any(map(_known, cells))


def _header(sheet: Sheet) -> int:
    """Return the index of the header: the row that names a wire, or else any quantity."""
    for wanted in ({"wire_radius", "wire_diameter"}, set(COLUMNS)):
        for index, row in enumerate(sheet.rows[:200]):
            means = [meaning(split_unit(cell, WORDS)[0], WORDS)[0] for cell in row.cells]
            named = any(one[0][0] in wanted for one in means if one)
            if len(row.cells) > 1 and (named or any(map(is_gauge, row.cells))):
                return index
    return 0


def _by_quantity(sheet: Sheet, header: Row, listed: list[Heading]) -> dict[str, list[Heading]]:
    columns: dict[str, list[Heading]] = {}
    for one in listed:
        if not one.quantity:
            continue
        earlier = columns.setdefault(one.quantity, [])
        if earlier and not (one.trial and earlier[0].trial):
            raise InputError(
                f"{sheet.place(header)}, {one} gives {one.quantity} again after {earlier[0]}; "
                "keep one of them."
            )
        earlier.append(one)
    return columns


def _check_columns(sheet: Sheet, table: Table, unknown: list[str]) -> None:
    columns, place = table.columns, sheet.place(table.header)
    others = f" (not known: {', '.join(unknown)})" if unknown else ""
    if ("wire_radius" in columns) == ("wire_diameter" in columns):
        state = "both a radius and a diameter" if "wire_radius" in columns else "no wire radius"
        gauge = (
            "; a gauge is no length by itself (name it AWG if it is the American wire gauge)"
            if names_other_gauge(unknown)
            else ""
        )
        raise InputError(
            f"{place} names {state}{others}{gauge}; keep wire_radius_<unit> or "
            "wire_diameter_<unit>."
        )
    if "force_per_thickness" not in columns and "force" not in columns:
        raise InputError(
            f"{place} names no force_per_thickness_<unit>{others}; divide the steady force by the "
            "sample's thickness and give it in one of the units N_per_m, mN_per_mm, J_per_m2, or "
            "give force_<unit> and thickness_<unit>; where each column is a gel of its own, write "
            "one line a cut with the gel's name in a column gel."
        )

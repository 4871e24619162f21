"""Cells of a table that hold more than a number: a unit, an error, a gauge, a percentage."""

from __future__ import annotations

import re

from surrogate.errors import InputError
from surrogate.reading.forms.gauges import gauge_diameter, is_gauge
from surrogate.reading.headings import bare, split_unit
from surrogate.reading.sheet import EMPTY, Row, Sheet
from surrogate.reading.units import FORCE, LENGTH, LINE_FORCE
from surrogate.reading.words.spelling import plain
from surrogate.reading.words.wire_words import COLUMNS, WORDS, is_force, means

__all__ = ["tidied"]

_RELATIVE = {"cv", "cov", "rsd", "rel sd", "variationskoeffizient", "coefficient of variation"}
"""Names of standard deviations as parts of the mean."""
_WITH_ERROR = re.compile(r"(.*[0-9.,])\s*(?:±|\+/?-)\s*([0-9.,].*)")
_WITH_UNIT = re.compile(r"([+-]?[0-9.,]*[0-9][0-9.,]*(?:[eE][+-]?[0-9]+)?)\s*([^\W\d].*|\")")


def tidied(
    sheet: Sheet, header: Row, units: Row | None, body: list[Row]
) -> tuple[Row, Row | None, list[Row], list[str]]:
    """Return a table whose cells hold a number of their unit alone, and how they were taken.

    Parameters
    ----------
    sheet : Sheet
        For its decimal sign and for messages.
    header, units : Row
        Names, and the units below them where there are.
    body : list of Row
        The measurements, whose cells may have a unit with the number, an error behind it, a number
        of the wire gauge, or percents of the force as its error.
    """
    names, below = list(header.cells), list(units.cells if units else [])
    below += [""] * (len(names) - len(below))
    rows = [list(row.cells) for row in body]
    for column in range(len(names)):
        errors = _errors_apart(rows, column)
        place = f"{sheet.place(header)}, column {column + 1} ({names[column]})"
        unit = _unit_apart(place, rows, column, names[column])
        below[column] = unit or below[column]
        if errors and is_force(names[column]):
            text = split_unit(names[column], WORDS)[1] or below[column]
            names.append(f"± [{text}]")
            below.append(text)
            for row, error in zip(rows, errors, strict=True):
                row += [""] * (len(names) - 1 - len(row)) + [error]
    notes = _gauges(sheet, names, below, body, rows)
    notes += _errors_of_forces(sheet, names, below, rows)
    tidy = [  # a row that was tidy is kept, which large tables are full of
        row if row.cells == cells else Row(row.line, cells)
        for row, cells in zip(body, rows, strict=True)
    ]
    line = units.line if units else header.line
    return Row(header.line, names), Row(line, below) if any(below) else None, tidy, notes


def _gauges(
    sheet: Sheet, names: list[str], below: list[str], body: list[Row], rows: list[list[str]]
) -> list[str]:
    """Put diameters in place of numbers of the American wire gauge."""
    column = next((i for i, name in enumerate(names) if is_gauge(name, below[i])), None)
    if column is None or any(
        means(name, "wire_diameter", "wire_radius") for name in names[:column]
    ):
        return []
    told: dict[str, float] = {}
    for row, cells in zip(body, rows, strict=True):
        if len(cells) > column and cells[column].casefold() not in EMPTY:
            place = f"{sheet.place(row)}, column {column + 1} ({names[column]})"
            diameter = told.setdefault(cells[column], gauge_diameter(place, cells[column]))
            cells[column] = repr(diameter).replace(".", sheet.decimal)
    pairs = ", ".join(f"{cell} is {1e3 * diameter:.4g} um" for cell, diameter in told.items())
    note = f"{sheet.file}: {names[column]} is read as diameters of ASTM B258: {pairs}"
    names[column], below[column] = "wire_diameter", "mm"
    return [note]


def _errors_of_forces(
    sheet: Sheet, names: list[str], below: list[str], rows: list[list[str]]
) -> list[str]:
    """Give errors of forces that have no unit that of the force, and percents their force."""
    forces = [i for i, name in enumerate(names) if is_force(name)]
    if len(forces) != 1:
        return []
    (force,) = forces
    unit = split_unit(names[force], WORDS)[1] or below[force]
    notes = []
    for column, name in enumerate(names):
        base, stated = split_unit(name, WORDS)
        stated = stated if stated is not None else bare(below[column])
        if stated == "" and means(name, "force_std"):
            below[column] = unit
            notes.append(
                f"{sheet.file}: column {column + 1} ({name}) has no unit and is taken in that of "
                f"{names[force]}"
            )
        elif stated == "%" and (means(name, "force_std") or plain(base) in _RELATIVE):
            for cells in rows:
                _take_percents(sheet, cells, column, force)
            kind = "sd" if plain(base) in _RELATIVE else base
            names[column], below[column] = f"{kind} [{unit}]", ""
            notes.append(f"{sheet.file}: column {column + 1} ({name}) is taken in % of the force")
    return notes


def _take_percents(sheet: Sheet, cells: list[str], column: int, force: int) -> None:
    if max(column, force) >= len(cells):
        return
    share, value = sheet.number(cells[column].rstrip("% ")), sheet.number(cells[force])
    if share is not None and value is not None:
        cells[column] = repr(share * value / 100.0).replace(".", sheet.decimal)


def _known(unit: str) -> bool:
    return unit != "" and any(kind.unit(unit) for kind in (LENGTH, FORCE, LINE_FORCE))


def _errors_apart(rows: list[list[str]], column: int) -> list[str]:
    """Take what stands behind ± out of a column and return it; nothing where nothing does."""
    matches = [_WITH_ERROR.fullmatch("".join(row[column : column + 1])) for row in rows]
    for row, match in zip(rows, matches, strict=True):
        if match:
            tail = _WITH_UNIT.fullmatch(match[2])
            row[column] = f"{match[1]} {tail[2]}" if tail else match[1]
    if not any(matches):
        return []
    return [_WITH_UNIT.sub(r"\1", match[2]) if match else "" for match in matches]


def _unit_apart(place: str, rows: list[list[str]], column: int, name: str) -> str:
    """Take the unit out of the cells of a column where all have the same, and return it."""
    cells = [row[column] for row in rows if len(row) > column and row[column]]
    matches = [_WITH_UNIT.fullmatch(cell) for cell in cells]
    units = {match[2].strip() if match else "" for match in matches}
    if len(units) > 1 and any(map(_known, units)) and means(name, *COLUMNS):
        listed = ", ".join(sorted(unit or "none" for unit in units))
        raise InputError(
            f"{place} has cells of several units ({listed}); write all in one, and name it behind "
            "the column's name."
        )
    if len(units) != 1 or "" in units:
        return ""
    (unit,) = units
    stated = split_unit(name, WORDS)[1]
    if not _known(unit) or stated not in (None, unit):
        return ""
    for row in rows:
        if len(row) > column:
            row[column] = _WITH_UNIT.sub(r"\1", row[column])
    return unit

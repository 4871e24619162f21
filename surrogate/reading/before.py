"""What the lines before a table tell: the sample's thickness, and the speed of the cut."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

from surrogate.errors import InputError
from surrogate.reading.headings import (
    Vocabulary,
    bare,
    is_units_row,
    split_bracketed,
    split_unit,
)
from surrogate.reading.sheet import Row, Sheet
from surrogate.reading.units import LENGTH, SPEED, Dimension
from surrogate.reading.words.spelling import plain

__all__ = ["Stated", "speed_before", "thickness_before", "thicknesses_by_specimen"]

Stated = tuple[float, str]
"""A value in SI units and where it stands."""

_THICKNESS = re.compile(
    r"(?<![a-z])(thickness|\w*dicke|epaisseur|espesor|spessore|espessura|dikte|grubosc|tjocklek|"
    r"厚度|厚さ|厚み)\b"
)
_SPEED = re.compile(
    r"(?<![a-z])(speed|crosshead rate|test rate|\w*geschwindigkeit|vitesse|velocidad|velocita|"
    r"velocidade|snelheid|predkosc|hastighet|速度|試験速度)\b"
)
# Other speeds than that of the cut: of the way there and back, and of the recording.
_OTHER_SPEED = re.compile(r"pre|post|return|approach|ruck|vor(?!schub)|data|sampl|abtast|acqui")


def thickness_before(sheet: Sheet, rows: Sequence[Row]) -> Stated | None:
    """Return the sample's thickness [m] out of the lines before a table.

    Raises
    ------
    InputError
        If a thickness has no unit or no number, or there are two that differ.
    """
    seen: dict[float, str] = {}
    for value, where in _stated(sheet, rows, _THICKNESS, LENGTH, "a thickness", "--thickness"):
        seen.setdefault(value, where)
    if len(seen) > 1:
        listed = ", ".join(f"{1e3 * value:g} mm in {where}" for value, where in seen.items())
        raise InputError(
            f"{sheet.file} has two thicknesses ({listed}); say which with --thickness "
            "(thickness= in Python)."
        )
    return next(iter(seen.items()), None)


def speed_before(sheet: Sheet, rows: Sequence[Row]) -> Stated | None:
    """Return the speed of the cut [m/s] out of the lines before a table.

    Raises
    ------
    InputError
        If a speed has no unit, or there are two that differ.
    """
    rows = [row for row in rows if not any(_OTHER_SPEED.search(plain(x)) for x in row.cells)]
    seen: dict[float, str] = {}
    for value, where in _stated(sheet, rows, _SPEED, SPEED, "a speed", "--speed"):
        seen.setdefault(value, where)
    if len(seen) > 1:
        listed = ", ".join(f"{1e3 * value:g} mm/s in {where}" for value, where in seen.items())
        raise InputError(
            f"{sheet.file} has two speeds ({listed}); say which with --speed (speed= in Python)."
        )
    return next(iter(seen.items()), None)


def thicknesses_by_specimen(sheet: Sheet, rows: Sequence[Row]) -> Mapping[int, Stated]:
    """Return the thickness [m] of each specimen, out of a table of results before the records.

    The specimen's number stands in the first column, or is that of the line.

    Raises
    ------
    InputError
        If the column of the thickness has no unit.
    """
    for index, row in enumerate(rows):
        for column, cell in enumerate(row.cells):
            if _THICKNESS.search(plain(cell)) and not _value_beside(sheet, row, column):
                below = rows[index + 1 :]
                units = below[0] if below and is_units_row(sheet, below[0]) else None
                listed = _column(sheet, row, column, units, below[units is not None :])
                if listed:
                    return listed
    return {}


def _column(
    sheet: Sheet, header: Row, column: int, units: Row | None, rows: Sequence[Row]
) -> dict[int, Stated]:
    name = header.cells[column]
    text = (split_bracketed(name) or split_unit(name, Vocabulary()))[1]
    if not text and units:
        text = bare("".join(units.cells[column : column + 1]))
    listed: dict[int, Stated] = {}
    for order, row in enumerate(rows, start=1):
        cell = "".join(row.cells[column : column + 1])
        first = row.cells[0]
        if not sheet.is_number(cell) or not (first.isdigit() or first == ""):
            break  # the end of the table, or a line of statistics below it
        unit = LENGTH.unit(text or "")
        if unit is None:
            raise _no_unit(sheet, header, "a thickness", "a length", "--thickness")
        value = sheet.number(cell, unit)
        if value is not None and 0.0 < value < float("inf"):
            listed[int(first or order)] = value, f"{sheet.line} {row.line}"
    return listed


def _value_beside(sheet: Sheet, row: Row, column: int) -> bool:
    return any(map(sheet.is_number, row.cells[column + 1 :]))


def _stated(
    sheet: Sheet,
    rows: Sequence[Row],
    words: re.Pattern[str],
    dimension: Dimension,
    quantity: str,
    option: str,
) -> Iterator[Stated]:
    """Yield each value in lines such as Thickness;20;mm, or Thickness (mm): 20."""
    for row in rows:
        for index, cell in enumerate(row.cells[:-1] or row.cells):
            if not words.search(plain(cell)):
                continue
            values = _behind(row.cells, index)
            if not values or not sheet.is_number(values[0]):
                continue
            inside = split_bracketed(cell)
            text = inside[1] if inside else bare(values[1]) if len(values) > 1 else ""
            unit = dimension.unit(text) if text else None
            if unit is None:
                raise _no_unit(sheet, row, f"{quantity} of {values[0]}", dimension.name, option)
            value = sheet.number(values[0], unit)
            if value is not None and 0.0 < value < float("inf"):
                yield value, f"{sheet.line} {row.line}"


def _behind(cells: Sequence[str], index: int) -> list[str]:
    """Return number and unit in the cells behind a name, or in its own after a colon."""
    values = [part for cell in cells[index + 1 :] for part in _number_and_unit(cell)]
    if not values and (colon := re.search(r"[:=]\s*([0-9].*)$", cells[index])):
        values = _number_and_unit(colon[1])
    return values


def _number_and_unit(cell: str) -> list[str]:
    match = re.fullmatch(r"([+-]?[0-9.,]+)\s*([^\d\s].*)?", cell)
    return [part for part in (match.groups() if match else (cell,)) if part]


def _no_unit(sheet: Sheet, row: Row, value: str, kind: str, option: str) -> InputError:
    return InputError(
        f"{sheet.place(row)} gives {value} in no unit of {kind.split()[-1]}; say it with "
        f"{option} ({option.strip('-')}= in Python)."
    )

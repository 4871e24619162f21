"""Where in an export of a testing machine the tables of displacement and force are."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from surrogate.errors import InputError
from surrogate.reading.headings import (
    Heading,
    headings,
    is_units_row,
    meaning,
    split_unit,
    vocabulary,
)
from surrogate.reading.sheet import EMPTY, Row, Sheet
from surrogate.reading.units import FORCE, LENGTH, TIME
from surrogate.reading.words.phrases import record_phrase
from surrogate.reading.words.spelling import plain

__all__ = ["LEAST_ROWS", "Block", "blocks"]

_WORDS = vocabulary(
    {
        "displacement": [("displacement", LENGTH)],
        "force": [("force", FORCE)],
        "time": [("time", TIME)],
    },
    {
        "displacement": "displacement,extension,distance,position,crosshead,stroke,travel,"
        "crosshead displacement,crosshead position,crosshead travel,crosshead extension,"
        "axial displacement,axial position,compressive extension,compressive displacement,"
        "compression extension,compression displacement,compression,compressive travel,"
        "standard travel,machine displacement,actuator displacement,actuator position,depth,"
        "penetration,penetration depth,cutting depth,disp,deformation,extensión,"
        "traversenweg,weg,standardweg,traversenweg absolut,absolute crosshead travel,verschiebung,"
        "verlangerung,kolbenweg,maschinenweg,eindringtiefe,position absolut,kompressionsweg,"
        "stauchung,druckverformung,verformung,"
        "deplacement,deplacement traverse,deplacement de la traverse,traverse,course,"
        "extension en compression,deplacement en compression,allongement,enfoncement,"
        "desplazamiento,desplazamiento del cabezal,extension de compresion,carrera,"
        "corsa,spostamento,spostamento traversa,deslocamento,curso,verplaatsing,slag,"
        "przemieszczenie,droga,förskjutning,forskydning,位移,行程,变形,変位,ストローク,変形",
        "force": "force,load,axial force,axial load,compressive load,compressive force,"
        "compression load,compression force,standard force,test force,normal force,primary force,"
        "machine load,load cell,loadcell,"
        "last,kraft,standardkraft,prufkraft,pruefkraft,druckkraft,drucklast,kompressionslast,"
        "axialkraft,normalkraft,belastung,"
        "charge,charge de compression,charge en compression,force de compression,force standard,"
        "effort,fuerza,carga,carga de compresion,fuerza de compresion,forza,carico,"
        "carico di compressione,forca,forca de compressao,kracht,belasting,siła,obciazenie,"
        "力,负荷,载荷,力值,荷重,試験力",
        "time": "time,zeit,test time,testzeit,prufzeit,pruefzeit,running time,elapsed time,"
        "total time,time stamp,timestamp,temps,temps ecoule,tiempo,tempo,tijd,czas,tid,t,"
        "时间,時間",
    },
    record_phrase,
)
_NEEDED = ("displacement", "force")
_OVER_TIME = ("time", "force")
LEAST_ROWS = 2
_SAME = 1e-3
"""Part of their range by which two channels of one quantity may differ."""


class Block(NamedTuple):
    """A table in a file: the lines before it, its columns for each specimen, its rows."""

    before: Sequence[Row]
    sides: list[list[Heading]]
    rows: list[Row]


def blocks(sheet: Sheet, columns: str | None) -> Iterator[Block]:
    """Yield every table of displacements and forces, or that whose columns the caller names.

    Where a file has none of them, those of times and forces are yielded.

    Raises
    ------
    InputError
        If a table has two columns of a quantity, no unit, or a row that breaks it.
    """
    if columns is not None:
        yield _named_by_caller(sheet, columns)
        return
    needed = _NEEDED if any(_is_header(row, _NEEDED) for row in sheet.rows) else _OVER_TIME
    yield from _tables(sheet, needed)


def _tables(sheet: Sheet, needed: Sequence[str]) -> Iterator[Block]:
    rows, start, index = sheet.rows, 0, 0
    optional = () if needed is _OVER_TIME else ("time",)
    while index < len(rows):
        row = rows[index]
        if not _is_header(row, needed):
            index += 1
            continue
        first = index + 1
        units = rows[first] if first < len(rows) and is_units_row(sheet, rows[first]) else None
        first += units is not None
        end = first
        while end < len(rows) and _is_data(sheet, rows[end], row):
            end += 1
        if end - first >= LEAST_ROWS:
            _check_end(sheet, rows, end, row)
            listed = headings(sheet, row, _WORDS, units, optional)
            sides = _sides(sheet, row, listed, needed, rows[first:end])
            yield Block(rows[start:index], sides, rows[first:end])
            start = end
        index = max(end, index + 1)


def _named_by_caller(sheet: Sheet, columns: str) -> Block:
    names = Row(0, [name.strip() for name in columns.split(",")])
    listed = headings(Sheet("columns", []), names, _WORDS)
    quantities = {one.quantity for one in listed}
    needed = _NEEDED if "displacement" in quantities else _OVER_TIME
    if not set(needed) <= quantities:
        raise InputError(
            f"columns {columns!r} name no force, or neither a displacement nor a time; write for "
            "instance time_s,displacement_mm,force_N, one name a column."
        )
    data = [row for row in sheet.rows if _is_data(sheet, row, names)]
    if not data:
        raise InputError(
            f"{sheet.file} has no rows of {len(names.cells)} numbers; name all its columns."
        )
    before = sheet.rows[: sheet.rows.index(data[0])]
    return Block(before, _sides(sheet, names, listed, needed, data), data)


def _is_header(row: Row, needed: Sequence[str]) -> bool:
    means = {one[0][0][0] for cell in row.cells if (one := meaning(_base(cell), _WORDS))[0]}
    return set(needed) <= means


def _base(cell: str) -> str:
    return split_unit(cell, _WORDS)[0]


def _is_data(sheet: Sheet, row: Row, header: Row) -> bool:
    """Whether a row holds numbers, at most as many words beside them, below a header."""
    filled = [cell for cell in row.cells if cell.casefold() not in EMPTY]
    numbers = sum(map(sheet.is_number, filled))
    enough = numbers >= 2 or (numbers == 1 and sheet.is_number(filled[0]))
    return enough and 2 * numbers >= len(filled) and len(row.cells) <= len(header.cells) + 1


def _check_end(sheet: Sheet, rows: list[Row], end: int, header: Row) -> None:
    """Refuse a table that one row breaks, so that the rest would be lost."""
    if end + 1 >= len(rows) or rows[end + 1].line != rows[end - 1].line + 2:
        return
    if _is_data(sheet, rows[end + 1], header) and len(rows[end + 1].cells) == len(header.cells):
        raise InputError(
            f"{sheet.place(rows[end])} is no row of numbers, and yet such rows follow; correct "
            "it or delete the line."
        )


def _sides(
    sheet: Sheet, header: Row, listed: list[Heading], needed: Sequence[str], rows: Sequence[Row]
) -> list[list[Heading]]:
    """Return the columns of each specimen in a table: a name that comes again begins the next."""
    known = [one for one in listed if one.quantity]
    names = [plain(one.name) for one in known]
    if len(set(names)) < len(names):
        repeats = [i for i, name in enumerate(names) if name == names[0]]
        sides = [known[i:j] for i, j in zip(repeats, [*repeats[1:], len(known)], strict=True)]
    else:
        sides = _numbered(known, needed)
    sides = [_told_once(sheet, side, rows) for side in sides]
    for side in sides:
        _check_side(sheet, header, side, needed)
    return sides


def _numbered(known: list[Heading], needed: Sequence[str]) -> list[list[Heading]]:
    """Return columns by the number behind their names, such as Force 1 and Force 2."""
    numbers = [plain(split_unit(one.name, _WORDS)[0]).split()[-1] for one in known]
    groups: dict[str, list[Heading]] = {}
    for number, one in zip(numbers, known, strict=True):
        groups.setdefault(number if one.trial else "", []).append(one)
    if len(groups) < 2 or not all(
        set(needed) <= {one.quantity for one in side} for side in groups.values()
    ):
        return [known]
    return list(groups.values())


def _told_once(sheet: Sheet, side: list[Heading], rows: Sequence[Row]) -> list[Heading]:
    """Return the columns without those that tell the same course as one before them."""
    kept: list[Heading] = []
    courses: dict[str, list[NDArray[np.float64]]] = {}
    for one in side:
        earlier = courses.setdefault(one.quantity, [])
        alone = sum(1 for other in side if other.quantity == one.quantity) == 1
        course = None if alone else _course(sheet, one, rows)
        if course is not None:
            if any(_agree(course, other) for other in earlier):
                continue
            earlier.append(course)
        kept.append(one)
    return kept


def _course(sheet: Sheet, one: Heading, rows: Sequence[Row]) -> NDArray[np.float64] | None:
    """Return a column from its first number on; None where it holds anything else."""
    assert one.unit is not None
    cells = [row.cells[one.number - 1] if len(row.cells) >= one.number else "" for row in rows]
    values = [sheet.number(cell, one.unit) for cell in cells]
    numbers = np.array([np.nan if value is None else value for value in values])
    return numbers - numbers[0] if np.isfinite(numbers).all() else None


def _agree(one: NDArray[np.float64], other: NDArray[np.float64]) -> bool:
    """Whether two courses differ by a small part of their range, whichever way they count."""
    range_ = max(float(np.ptp(one)), float(np.ptp(other)))
    apart = min(float(np.max(np.abs(one - sign * other))) for sign in (1.0, -1.0))
    return range_ > 0.0 and apart <= _SAME * range_


def _check_side(sheet: Sheet, header: Row, side: list[Heading], needed: Sequence[str]) -> None:
    for quantity in (*_NEEDED, "time"):
        columns = [one for one in side if one.quantity == quantity]
        if len(columns) > 1 or (not columns and quantity in needed):
            state = (
                "several columns of " + quantity + ": " + " and ".join(map(str, columns))
                if columns
                else f"no {quantity} for every specimen"
            )
            names = ",".join(name or "-" for name in header.cells)
            raise InputError(
                f"{sheet.place(header)} has {state}; name all columns yourself, and those not to "
                f"be read by '-', with --columns (columns= in Python) instead of {names}."
            )

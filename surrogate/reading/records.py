"""Raw records of testing machines: displacement and force, whatever the machine calls them."""

from __future__ import annotations

from dataclasses import dataclass
from os import PathLike

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.checks import SMALLEST, Quantity, one_number, shown
from surrogate.basics.checks import text as checked_text
from surrogate.basics.files import file_name
from surrogate.basics.records import Record
from surrogate.errors import InputError
from surrogate.reading.before import (
    Stated,
    speed_before,
    thickness_before,
    thicknesses_by_specimen,
)
from surrogate.reading.headings import Heading
from surrogate.reading.record_tables import LEAST_ROWS, Block, blocks
from surrogate.reading.sheet import EMPTY, Row, Sheet, read_sheets
from surrogate.reading.units import FORCE, LENGTH, TIME

__all__ = ["CutRecord", "read_record", "read_records"]

_SPEED = Quantity("speed", "m/s", "give the speed of the cut in metres a second", SMALLEST, 1e30)


@dataclass(frozen=True, eq=False)
class CutRecord(Record):
    """One cut as the testing machine recorded it.

    Parameters
    ----------
    displacement : ndarray, shape (n,)
        Travel of the wire, growing as it cuts [m].
    force : ndarray, shape (n,)
        Force on it, positive as it cuts [N]; nothing is subtracted.
    time : ndarray, shape (n,), or None
        Time [s].
    thickness : float or None
        Thickness of the sample, where the file's lines before the table tell it, for all of its
        specimens or one by one [m].
    file : str
        The file.
    specimen : int
        Which one of the file, from 1.
    understood : str
        What was understood, in one line: columns, units, sign, rows, encoding.
    notes : tuple of str
        What was left out, in words.

    Examples
    --------
    >>> cut = CutRecord(np.array([0.0, 1e-3]), np.array([0.0, 0.2]))
    >>> cut.specimen
    1
    """

    displacement: NDArray[np.float64]
    force: NDArray[np.float64]
    time: NDArray[np.float64] | None = None
    thickness: float | None = None
    file: str = ""
    specimen: int = 1
    understood: str = ""
    notes: tuple[str, ...] = ()


def read_record(
    path: str | PathLike[str],
    specimen: int | None = None,
    *,
    columns: str | None = None,
    sign: str | None = None,
    speed: float | None = None,
    decimal: str | None = None,
    delimiter: str | None = None,
    encoding: str | None = None,
) -> CutRecord:
    """Read the record of one cut from an export of a testing machine.

    Parameters
    ----------
    path : str or path-like
        Text or .xlsx, see `read_records`.
    specimen : int, optional
        Which specimen of the file, from 1, where it holds several.
    columns, sign, speed, decimal, delimiter, encoding : optional
        See `read_records`.

    Returns
    -------
    CutRecord
        The record in SI units.

    Raises
    ------
    InputError
        As `read_records`, and if the file holds several records and `specimen` is none of them.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = Path(folder, "cut.csv").write_text("Weg [mm];Kraft [N]\\n0,0;0,0\\n0,5;0,1\\n")
    ...     cut = read_record(Path(folder, "cut.csv"))
    >>> cut.displacement.tolist(), cut.force.tolist()
    ([0.0, 0.0005], [0.0, 0.1])
    """
    records = read_records(
        path,
        columns=columns,
        sign=sign,
        speed=speed,
        decimal=decimal,
        delimiter=delimiter,
        encoding=encoding,
    )
    if specimen is not None and (type(specimen) is not int or not 0 < specimen <= 10**6):
        raise InputError(f"specimen must be a whole number from 1 on, but is {shown(specimen)}.")
    if specimen is None and len(records) > 1:
        raise InputError(
            f"{file_name(path)} holds {len(records)} records; say which with specimen=1 to "
            f"{len(records)}, or read all with read_records."
        )
    for record in records:
        if record.specimen == (specimen or 1):
            return record
    raise InputError(
        f"{file_name(path)} holds {len(records)} record{'s' * (len(records) > 1)}, but specimen "
        f"{specimen!r} was asked for; count from 1."
    )


def read_records(
    path: str | PathLike[str],
    *,
    columns: str | None = None,
    sign: str | None = None,
    speed: float | None = None,
    decimal: str | None = None,
    delimiter: str | None = None,
    encoding: str | None = None,
) -> tuple[CutRecord, ...]:
    """Read every record in an export of a testing machine.

    A record is the table below a row that names a displacement and a force, in English, German and
    other languages (Extension, Crosshead, Stroke, Traversenweg, ...; Load, Standardkraft, ...),
    with units in brackets, behind the name or in the row below. Where the file has a time but no
    displacement, travel is time by speed. What stands before a table is searched for the sample's
    thickness and, where there is need, the speed. Tables below one another, side by side and on
    several sheets are several records. Force is turned where compression is counted as negative,
    displacement where it falls as the wire cuts, and what comes after the farthest travel is left
    out.

    Parameters
    ----------
    path : str or path-like
        Text in UTF-8, UTF-16 or CP1252, or .xlsx.
    columns : str, optional
        The names of all columns with their units, separated by commas, in place of those in the
        file or where it has none, such as ``time_s,displacement_mm,force_N``.
    sign : {"positive", "negative"}, optional
        How the file counts the force that cuts; by default it is read off the larger forces.
    speed : float, optional
        Speed of the cut [m/s], for files with a time and without a displacement.
    decimal, delimiter, encoding : str, optional
        Those of a text file; by default they are read off it.

    Returns
    -------
    tuple of CutRecord
        The records in SI units, in the order of the file.

    Raises
    ------
    InputError
        If the file cannot be read, no table or unit is understood, or something is ambiguous; the
        message says where, and what decides it.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = Path(folder, "cut.csv").write_text("Extension,Load\\n(mm),(N)\\n0,0\\n0.5,-0.1\\n")
    ...     (cut,) = read_records(Path(folder, "cut.csv"))
    >>> cut.force.tolist(), "compression negative, turned" in cut.understood
    ([0.0, 0.1], True)
    """
    for name, value in (("columns", columns), ("sign", sign)):
        if value is not None:
            checked_text(name, value, "leave it out, or give a text")
    if sign not in (None, "positive", "negative"):
        raise InputError(f"sign {sign!r} is not known; choose 'positive' or 'negative'.")
    speed = None if speed is None else one_number(_SPEED, speed)
    sheets = read_sheets(path, encoding, delimiter, decimal)
    tables = [(sheet, block) for sheet in sheets for block in blocks(sheet, columns)]
    if not tables:
        raise InputError(
            f"{sheets[0].file} has no row that names a displacement and a force; name all columns "
            "with their units by --columns time_s,displacement_mm,force_N (columns= in Python), or "
            "the file's encoding by --encoding (encoding= in Python)."
        )
    told = _Told(sheets, tables, speed)
    return tuple(
        _record(sheet, block, side, told.of(sheet, block, number), sign, number)
        for number, (sheet, block, side) in enumerate(
            ((sheet, block, side) for sheet, block in tables for side in block.sides), start=1
        )
    )


class _Told:
    """What a file tells of its specimens besides their records: thickness and speed."""

    def __init__(
        self, sheets: list[Sheet], tables: list[tuple[Sheet, Block]], speed: float | None
    ) -> None:
        self.option = None if speed is None else (speed, "as you say")
        with_tables = [sheet for sheet, _ in tables]
        apart = [(sheet, sheet.rows) for sheet in sheets if sheet not in with_tables]
        first = [(tables[0][0], tables[0][1].before)]
        self.common = [(sheet, rows) for sheet, rows in (*apart, *first) if rows]
        self.results: dict[int, Stated] = {}
        for sheet, rows in self.common:
            self.results.update(thicknesses_by_specimen(sheet, rows))

    def of(self, sheet: Sheet, block: Block, specimen: int) -> tuple[Stated | None, Stated | None]:
        """Return the thickness [m] of a specimen and, where there is need, its speed [m/s]."""
        places = [(sheet, block.before), *self.common]
        thickness = next((x for place in places if (x := thickness_before(*place))), None)
        if thickness is None and len(self.results) == 1:
            thickness = next(iter(self.results.values()))
        thickness = self.results.get(specimen, thickness)
        if any(one.quantity == "displacement" for one in block.sides[0]):
            return thickness, None
        speed = self.option or next((x for place in places if (x := speed_before(*place))), None)
        if speed is None:
            raise InputError(
                f"{sheet.file} has a force over the time and no displacement; give the speed of "
                "the cut with --speed 1mm/s (speed= in Python), or name the column of the "
                "displacement by --columns (columns= in Python)."
            )
        return thickness, speed


def _record(
    sheet: Sheet,
    block: Block,
    side: list[Heading],
    told: tuple[Stated | None, Stated | None],
    sign: str | None,
    specimen: int,
) -> CutRecord:
    thickness, speed = told
    columns = {one.quantity: one for one in side}
    notes: list[str] = []
    values = _values(sheet, block.rows, columns, notes)
    place = f"{sheet.file}, specimen {specimen}"
    if speed is not None:
        values["displacement"] = _travelled(place, values["time"], speed[0])
    force, turned = _turned_force(place, values["force"], sign)
    displacement, falling = _turned_displacement(place, values["displacement"])
    end = int(np.argmax(displacement)) + 1
    if end < len(force):
        notes.append(f"{place}: {len(force) - end} rows after the farthest travel are left out")
    if end < LEAST_ROWS:
        raise InputError(f"{place}: the displacement does not change; nothing was cut.")
    time = values.get("time")
    if time is not None and np.isnan(time).any():
        time = None
        notes.append(f"{place}: {columns['time']} is no plain number and not read")
    words = [
        f"{one.quantity} from {one.name!r} in {_unit_of(one, block)}" for one in columns.values()
    ]
    if speed is not None:
        words.append(f"displacement from time at {1e3 * speed[0]:g} mm/s ({speed[1]})")
    signs = ["compression negative, turned"] * turned + ["displacement falling, turned"] * falling
    words += signs or ["compression positive"]
    words += [f"{len(force)} rows from {sheet.line} {block.rows[0].line}"]
    if thickness:
        words.append(f"thickness {1e3 * thickness[0]:g} mm ({thickness[1]})")
    return CutRecord(
        displacement[:end],
        force[:end],
        None if time is None else time[:end],
        thickness[0] if thickness else None,
        sheet.file,
        specimen,
        f"{place}: {'; '.join(words)}; {sheet.form}",
        (*sheet.notes, *notes),
    )


def _travelled(place: str, time: NDArray[np.float64], speed: float) -> NDArray[np.float64]:
    if np.isnan(time).any():
        raise InputError(
            f"{place}: the time is no plain number of seconds, and the travel would follow from "
            "it; export the displacement."
        )
    travel: NDArray[np.float64] = (time - time[0]) * speed
    return travel


def _unit_of(one: Heading, block: Block) -> str:
    assert one.unit is not None
    dimension = {"force": FORCE, "displacement": LENGTH, "time": TIME}[one.quantity]
    names = (*dimension.powers, *dimension.others)
    return next(name for name in names if dimension.unit(name) == one.unit)


def _values(
    sheet: Sheet, rows: list[Row], columns: dict[str, Heading], notes: list[str]
) -> dict[str, NDArray[np.float64]]:
    kept: dict[str, list[float]] = {quantity: [] for quantity in columns}
    gaps = []
    for row in rows:
        cells = {
            quantity: row.cells[one.number - 1] if len(row.cells) >= one.number else ""
            for quantity, one in columns.items()
        }
        if any(cell.casefold() in EMPTY for cell in cells.values()):
            gaps.append(row.line)
            continue
        for quantity, one in columns.items():
            read = _time if quantity == "time" else _finite
            kept[quantity].append(read(sheet, row, one, cells[quantity]))
    if gaps and gaps[-1] - gaps[0] + 1 > len(gaps):
        notes.append(f"{sheet.file}: {len(gaps)} rows with an empty cell are skipped")
    if len(kept["force"]) < LEAST_ROWS:
        raise InputError(f"{sheet.place(rows[0])}: {columns['force']} holds no record.")
    return {quantity: np.array(numbers) for quantity, numbers in kept.items()}


def _finite(sheet: Sheet, row: Row, one: Heading, cell: str) -> float:
    assert one.unit is not None
    value = sheet.number(cell, one.unit)
    if value is None or not np.isfinite(value):
        raise InputError(
            f"{sheet.place(row)}, {one}: {cell[:40]!r} is not a number; correct it or delete the "
            "line."
        )
    return value


def _time(sheet: Sheet, row: Row, one: Heading, cell: str) -> float:
    value = sheet.number(cell, one.unit) if one.unit else None
    return np.nan if value is None else value


def _turned_force(
    place: str, force: NDArray[np.float64], sign: str | None
) -> tuple[NDArray[np.float64], bool]:
    """Return the force so that it is positive as the wire cuts, and whether it was turned."""
    if sign is None:
        signs = {_larger_side(force, start) for start in (0.0, _beginning(force))}
        if len(signs) > 1 or "" in signs:
            raise InputError(
                f"{place}: the force begins at {force[0]:g} N and goes from {force.min():g} to "
                f"{force.max():g} N, so that either end may be the cut; say how it is counted with "
                "--sign positive or --sign negative (sign= in Python)."
            )
        (sign,) = signs
    return (force, False) if sign == "positive" else (0.0 - force, True)


def _beginning(force: NDArray[np.float64]) -> float:
    return float(np.median(force[: max(1, len(force) // 100)]))


def _larger_side(force: NDArray[np.float64], start: float) -> str:
    """Return the sign of the forces that are farther from a start, "" where both are far."""
    low, high = (float(x) for x in np.percentile(force, (1.0, 99.0)))
    below, above = max(start - low, 0.0), max(high - start, 0.0)
    if min(below, above) > 0.5 * max(below, above):
        return ""
    return "positive" if above >= below else "negative"


def _turned_displacement(
    place: str, displacement: NDArray[np.float64]
) -> tuple[NDArray[np.float64], bool]:
    travel = displacement - displacement[0]
    farthest = travel[int(np.argmax(np.abs(travel)))]
    return (displacement, False) if farthest >= 0.0 else (0.0 - displacement, True)

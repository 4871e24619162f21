"""Raw records of testing machines: displacement and force, whatever the machine calls them."""

from __future__ import annotations

from dataclasses import dataclass
from os import PathLike

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.checks import shown
from surrogate.basics.checks import text as checked_text
from surrogate.basics.files import file_name
from surrogate.basics.records import Record
from surrogate.errors import InputError
from surrogate.reading.headings import Heading, thickness_before
from surrogate.reading.record_tables import LEAST_ROWS, Block, blocks
from surrogate.reading.sheet import EMPTY, Row, Sheet, read_sheet
from surrogate.reading.units import FORCE, LENGTH, TIME

__all__ = ["CutRecord", "read_record", "read_records"]


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
        Thickness of the sample, where the file's lines before the table tell it [m].
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
    columns, sign, decimal, delimiter, encoding : str, optional
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
    decimal: str | None = None,
    delimiter: str | None = None,
    encoding: str | None = None,
) -> tuple[CutRecord, ...]:
    """Read every record in an export of a testing machine.

    A record is the table below a row that names a displacement and a force, in English or German
    (Extension, Crosshead, Distance, Stroke, Traversenweg, ...; Load, Force, Standardkraft, ...),
    with units in brackets, behind the name or in the row below. What stands before it is only
    searched for the sample's thickness. Tables below one another and side by side are several
    records. Force is turned where compression is counted as negative, displacement where it falls
    as the wire cuts, and what comes after the farthest travel is left out.

    Parameters
    ----------
    path : str or path-like
        Text in UTF-8, UTF-16 or CP1252, or .xlsx.
    columns : str, optional
        The names of all columns with their units, separated by commas, in place of those in the
        file or where it has none, such as ``time_s,displacement_mm,force_N``.
    sign : {"positive", "negative"}, optional
        How the file counts the force that cuts; by default it is read off the larger forces.
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
    sheet = read_sheet(path, encoding, delimiter, decimal)
    records: list[CutRecord] = []
    general: tuple[float, str] | None = None
    for block in blocks(sheet, columns):
        thickness = thickness_before(sheet, block.before) or general
        general = general or thickness
        for side in block.sides:
            records.append(_record(sheet, block, side, thickness, sign, len(records) + 1))
    if not records:
        raise InputError(
            f"{sheet.file} has no row that names a displacement and a force; name all columns "
            "with their units by --columns time_s,displacement_mm,force_N (columns= in Python)."
        )
    return tuple(records)


def _record(
    sheet: Sheet,
    block: Block,
    side: list[Heading],
    thickness: tuple[float, str] | None,
    sign: str | None,
    specimen: int,
) -> CutRecord:
    columns = {one.quantity: one for one in side}
    notes: list[str] = []
    values = _values(sheet, block.rows, columns, notes)
    place = f"{sheet.file}, specimen {specimen}"
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

"""Which wire a record was cut with: from the name of its file, or from a table."""

from __future__ import annotations

import os
import re
from collections.abc import Callable
from dataclasses import dataclass
from os import PathLike

from surrogate.errors import InputError
from surrogate.reading.sheet import Sheet, read_sheet
from surrogate.reading.units import LENGTH, Unit, parse_number
from surrogate.reading.words.spelling import plain

__all__ = ["Wire", "wires_by_name", "wires_by_table"]

_EXAMPLE = "'wire_{diameter}mm_{trial}'"
_LENGTHS = ("diameter", "radius", "thickness")
_WORDS = ("trial", "sample")
_FIELD = re.compile(r"\{(\w*)\}([^\W\d_]*)")
_NUMBER = r"[0-9]+(?:[.,][0-9]+)?"


@dataclass(frozen=True)
class Wire:
    """The wire and the sample of one cut.

    Parameters
    ----------
    radius : float
        R_w [m].
    thickness : float or None
        Thickness of the sample [m], where it is told as well.
    trial, sample : str
        Names, empty where there are none.
    """

    radius: float
    thickness: float | None = None
    trial: str = ""
    sample: str = ""


Finder = Callable[[str, int], Wire]


def wires_by_name(pattern: str) -> Finder:
    """Return what reads wires off the names of files.

    Parameters
    ----------
    pattern : str
        The name without folder and ending, with {diameter} or {radius}, {thickness}, {trial} and
        {sample} in place of what changes, a length directly before its unit, and {} for whatever.

    Returns
    -------
    callable
        Takes a file's name and the number of the specimen in it and returns the `Wire`.

    Raises
    ------
    InputError
        If the pattern has no wire, or a length without a unit; later, if a name does not fit it.

    Examples
    --------
    >>> wires_by_name("wire_{diameter}mm_{trial}")("cuts/wire_0.2mm_3.csv", 1)
    Wire(radius=0.0001, thickness=None, trial='3', sample='')
    """
    units: dict[str, Unit] = {}
    expression, end = "", 0
    for field in _FIELD.finditer(pattern):
        expression += re.escape(pattern[end : field.start()]) + _group(pattern, field, units)
        end = field.end()
    fits = re.compile(expression + re.escape(pattern[end:]), re.IGNORECASE).fullmatch
    if ("diameter" in units) == ("radius" in units):
        raise InputError(
            f"--name {pattern!r} must hold one of {{diameter}} and {{radius}} before its unit; "
            f"write for instance {_EXAMPLE}."
        )

    def find(file: str, specimen: int) -> Wire:
        name = os.path.basename(file)
        match = fits(os.path.splitext(name)[0]) or fits(name)
        if match is None:
            raise InputError(
                f"{file}: the name does not fit --name {pattern!r}; change the pattern, put {{}} "
                "for what it leaves out, or give a table of wires by --wires."
            )
        told = match.groupdict()
        lengths = {key: parse_number(told[key].replace(",", "."), units[key]) for key in units}
        trial = told.get("trial") or (str(specimen) if specimen > 1 else "")
        return _wire(f"{file} by --name", lengths, trial, told.get("sample") or "")

    return find


def _group(pattern: str, field: re.Match[str], units: dict[str, Unit]) -> str:
    """Return the expression for one field, and note the unit of a length."""
    name, following = field[1], field[2]
    if not name:
        return ".*?" + re.escape(following)
    if name in _WORDS:
        return f"(?P<{name}>.+?)" + re.escape(following)
    if name not in _LENGTHS or name in units:
        state = "comes twice" if name in units else "is not known"
        raise InputError(
            f"--name {pattern!r}: {{{name}}} {state}; use {{diameter}}, {{radius}}, {{thickness}}, "
            "{trial}, {sample}, once each, and {} for whatever."
        )
    unit = LENGTH.unit(following) if following else None
    if unit is None:
        raise InputError(
            f"--name {pattern!r}: {{{name}}} is not followed by a unit of length; write for "
            f"instance {_EXAMPLE}, or give a table of wires by --wires."
        )
    units[name] = unit
    return rf"(?P<{name}>{_NUMBER})\s*" + re.escape(following)


def _wire(place: str, lengths: dict[str, float | None], trial: str, sample: str) -> Wire:
    for name, value in lengths.items():
        if value is None or not 0.0 < value < 1e30:
            raise InputError(f"{place}: {name} is not a positive number; correct it.")
    radius = lengths.get("radius")
    if radius is None:
        radius = 0.5 * (lengths.get("diameter") or 0.0)
    return Wire(radius, lengths.get("thickness"), trial, sample)


_COLUMNS = {
    **dict.fromkeys(
        ("file", "file name", "filename", "record", "name", "datei", "dateiname"), "file"
    ),
    **dict.fromkeys(
        ("diameter", "wire diameter", "d", "durchmesser", "drahtdurchmesser"), "diameter"
    ),
    **dict.fromkeys(("radius", "wire radius", "r", "drahtradius"), "radius"),
    **dict.fromkeys(("thickness", "sample thickness", "specimen thickness", "dicke"), "thickness"),
    **dict.fromkeys(("trial", "repeat", "versuch"), "trial"),
    **dict.fromkeys(("specimen", "specimen number", "probe"), "specimen"),
    **dict.fromkeys(("sample", "gel", "material"), "sample"),
}


def wires_by_table(path: str | PathLike[str]) -> Finder:
    """Return what looks wires up in a table.

    Parameters
    ----------
    path : str or path-like
        A table with the columns file, wire_diameter_mm or wire_radius_mm, and where there is need
        specimen (the number within the file), thickness_mm, trial, sample.

    Returns
    -------
    callable
        Takes a file's name and the number of the specimen in it and returns the `Wire`.

    Raises
    ------
    InputError
        If the table cannot be read, or lacks a column; later, if a file is not in it.
    """
    sheet = read_sheet(path)
    wires = dict(_lines(sheet))

    def find(file: str, specimen: int) -> Wire:
        name = os.path.basename(file).casefold()
        for key in (name, os.path.splitext(name)[0]):
            for number in (specimen, None):
                if (key, number) in wires:
                    return wires[key, number]
        raise InputError(
            f"{file}, specimen {specimen}, is not in {sheet.file}; add a line with "
            f"{os.path.basename(file)} in its column 'file'."
        )

    return find


def _lines(sheet: Sheet) -> list[tuple[tuple[str, int | None], Wire]]:
    if not sheet.rows:
        raise InputError(f"{sheet.file} is empty; write file,wire_diameter_mm and one line a file.")
    header, *body = sheet.rows
    columns = _columns(sheet)
    if "file" not in columns or ("diameter" in columns) == ("radius" in columns):
        raise InputError(
            f"{sheet.place(header)} must name a column file and one of wire_diameter_mm and "
            "wire_radius_mm (any unit of length)."
        )
    lines: dict[tuple[str, int | None], Wire] = {}
    for row in body:
        cells = {
            name: row.cells[number] if number < len(row.cells) else ""
            for name, (number, _) in columns.items()
        }
        lengths = {
            name: sheet.number(cells[name], columns[name][1])
            for name in _LENGTHS
            if cells.get(name) or (name in columns and name != "thickness")
        }
        number = cells.get("specimen", "")
        specimen = int(float(number)) if re.fullmatch(r"[0-9]{1,6}(\.0)?", number) else None
        key = cells["file"].casefold(), specimen
        if key in lines:
            raise InputError(
                f"{sheet.place(row)} names {cells['file']} again; keep one line of each file, or "
                "number its specimens in a column 'specimen'."
            )
        trial = cells.get("trial", "")
        lines[key] = _wire(sheet.place(row), lengths, trial, cells.get("sample", ""))
    return list(lines.items())


def _columns(sheet: Sheet) -> dict[str, tuple[int, Unit]]:
    """Return the place and the unit of each known column."""
    columns: dict[str, tuple[int, Unit]] = {}
    header = sheet.rows[0]
    for number, cell in enumerate(header.cells):
        base, text = _split(cell)
        name = _COLUMNS.get(base, "")
        if not name or name in columns:
            continue
        unit = LENGTH.unit(text) if text else None
        if name in _LENGTHS and unit is None:
            raise InputError(
                f"{sheet.place(header)}, column {number + 1} ({cell}) has no unit of length; write "
                f"for instance {cell}_mm."
            )
        columns[name] = number, unit or Unit()
    return columns


def _split(cell: str) -> tuple[str, str]:
    bracketed = re.fullmatch(r"(.*?)[\s_]*[\[(]\s*(.*?)\s*[\])]\s*", cell)
    if bracketed:
        return plain(bracketed[1]), bracketed[2]
    name, mark, unit = cell.rpartition("_" if "_" in cell else " ")
    if mark and LENGTH.unit(unit) is not None:
        return plain(name), unit
    return plain(cell), ""

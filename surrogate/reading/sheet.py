"""Rows of cells out of text, spreadsheets and data frames: the delimiter and the decimal sign.

Both are read off the rows that hold numbers. Where these leave the decimal sign open, as 1,234
does, which is a thousand in English and one and a bit in German, it is asked for.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import PurePath
from typing import Any, NamedTuple

from surrogate.basics.checks import text as checked_text
from surrogate.basics.extras import require_extra
from surrogate.basics.files import file_name
from surrogate.errors import InputError
from surrogate.reading.forms.lines import aligned_names, is_rule, joined, narrow
from surrogate.reading.text import read_lines
from surrogate.reading.units import SI, Unit, parse_number

__all__ = ["Row", "Sheet", "read_sheet", "read_sheets"]

_DELIMITERS = {"\t": "tab", ";": "semicolon", ",": "comma", "|": "bar", " ": "blank"}
_NUMBERISH = re.compile(r"[+-]?(?:[0-9][0-9.,]*|[.,][0-9]+)(?:[eE][+-]?[0-9]{1,4})?")
_WITH_UNIT = re.compile(
    rf"({_NUMBERISH.pattern})(?:\s*(?:\u00b1|\+/?-)\s*{_NUMBERISH.pattern})?(?:\s*[^\W\d]\S{{0,7}})?"
)
_GROUPED = re.compile(r"[+-]?[1-9][0-9]{0,2}(?P<mark>[.,])[0-9]{3}(?:(?P=mark)[0-9]{3})*")
_APART = re.compile(r"[+-]?[1-9][0-9]{0,2}(?:['\u2019 \xa0\u2009\u202f][0-9]{3})+(?![0-9])")
"""Thousands with an apostrophe or a blank between them."""
_COMMENT = re.compile(r'\s*"*#(?!"?\s*[,;\t])')
_SEPARATOR = re.compile(r"\s*\"?sep=(.)\"?\s*", re.IGNORECASE)
EMPTY = frozenset(("", "-", "--", "\u2013", "\u2014", "n/a", "#n/a", "na", "n.a."))
"""What stands in a cell without a number."""


class Row(NamedTuple):
    """A line's number and its cells, without quotes and blanks around."""

    line: int
    cells: list[str]


@dataclass(frozen=True)
class Sheet:
    """Rows of cells and how to read their numbers.

    Parameters
    ----------
    file : str
        Where they are from, for messages.
    rows : list of Row
        Those that are not empty and no comment.
    decimal : str
        The decimal sign, a point or a comma.
    form : str
        Encoding, delimiter and decimal sign, in words.
    notes : tuple of str
        What was left out.
    line : str
        What a row is called: a column, where the table lies on its side.
    """

    file: str
    rows: list[Row]
    decimal: str = "."
    form: str = ""
    notes: tuple[str, ...] = ()
    line: str = "line"

    def number(self, cell: str, unit: Unit = SI) -> float | None:
        """Return a cell's number in SI units; None if it is none."""
        return parse_number(_pointed(cell, self.decimal), unit)

    def is_number(self, cell: str) -> bool:
        """Whether a cell holds a number."""
        return self.number(cell) is not None

    def on_its_side(self) -> Sheet:
        """Return the same cells with rows and columns exchanged."""
        width = max(len(row.cells) for row in self.rows)
        padded = [row.cells + [""] * (width - len(row.cells)) for row in self.rows]
        rows = [
            Row(number, list(cells))
            for number, cells in enumerate(zip(*padded, strict=True), start=1)
            if any(cells)
        ]
        return replace(self, rows=rows, line="column")

    def beside(self, others: Sequence[Sheet]) -> Sheet:
        """Return this sheet with a note about others of the file, which are not read."""
        notes = (f"{one.file}: {one.form.partition(', ')[2]} is not read" for one in others)
        return replace(self, notes=(*self.notes, *notes))

    def place(self, row: Row) -> str:
        """Return where a row is, for messages."""
        return f"{self.file}, {self.line} {row.line}"


def read_sheet(
    source: Any,
    encoding: str | None = None,
    delimiter: str | None = None,
    decimal: str | None = None,
) -> Sheet:
    """Read a text file, the first sheet of a spreadsheet (.xlsx) or a data frame of pandas.

    What the other sheets are called stands in the notes; for the rest see `read_sheets`.
    """
    first, *others = read_sheets(source, encoding, delimiter, decimal)
    return first.beside(others)


def read_sheets(
    source: Any,
    encoding: str | None = None,
    delimiter: str | None = None,
    decimal: str | None = None,
) -> list[Sheet]:
    """Read a text file, every sheet of a spreadsheet (.xlsx), or a data frame of pandas.

    Parameters
    ----------
    source : str, path-like or pandas.DataFrame
        What to read.
    encoding, delimiter, decimal : str, optional
        Those of a text file; by default they are read off it.

    Returns
    -------
    list of Sheet
        Its rows; those of a spreadsheet that are not empty, at least one.

    Raises
    ------
    InputError
        If it cannot be read, or it is open what its numbers are.
    """
    pandas = sys.modules.get("pandas")
    if pandas is not None and isinstance(source, pandas.DataFrame):
        rows = [list(source.columns), *source.itertuples(index=False, name=None)]
        return [Sheet("the data frame", list(_rows_of(rows)), form="a data frame")]
    for name, value in (("encoding", encoding), ("delimiter", delimiter), ("decimal", decimal)):
        if value is not None:
            checked_text(name, value, "leave it out, or give a text")
    file = file_name(source)
    ending = PurePath(file).suffix.lower()
    if ending in (".xlsx", ".xlsm"):
        return _workbook(file)
    if ending in (".xls", ".ods"):
        raise InputError(f"{file} is a spreadsheet that is not read; save it as .xlsx or CSV.")
    return [_text_sheet(file, encoding, _delimiter(delimiter), _decimal(decimal))]


def _rows_of(rows: Iterable[Sequence[Any]]) -> Iterator[Row]:
    for line, values in enumerate(rows, start=1):
        cells = [_cell(value) for value in values]
        if any(cells):
            yield Row(line, cells)


def _cell(value: Any) -> str:
    """Return a spreadsheet's or a data frame's value as text; nan is nothing."""
    if value is None or value != value:
        return ""
    if isinstance(value, str):
        return " ".join(narrow(value).split())
    return repr(float(value)) if hasattr(value, "__float__") else str(value)


def _workbook(file: str) -> list[Sheet]:
    require_extra("openpyxl", f"{file}, a spreadsheet,", "excel")
    from openpyxl import load_workbook

    try:
        book = load_workbook(file, read_only=True, data_only=True)
        sheets = [
            (sheet.title, rows)
            for sheet in book.worksheets
            if (rows := list(_rows_of(sheet.iter_rows(values_only=True))))
        ]
        book.close()
    except Exception as error:  # zipfile's, xml's and openpyxl's own kinds
        raise InputError(
            f"{file} cannot be read as a spreadsheet ({type(error).__name__}: {error}); "
            "save it as .xlsx or CSV again."
        ) from None
    if not sheets:
        raise InputError(f"{file} is empty; write a header and one line a wire.")
    one = len(sheets) == 1
    return [
        Sheet(
            file,
            rows,
            form=f"spreadsheet, sheet {title!r}",
            line="line" if one else f"sheet {title!r}, line",
        )
        for title, rows in sheets
    ]


def _delimiter(text: str | None) -> str | None:
    mark = {"\\t": "\t", **{name: mark for mark, name in _DELIMITERS.items()}}.get(text or "", text)
    if mark is not None and mark not in _DELIMITERS:
        raise InputError(
            f"delimiter {text!r} is not known; choose one of {', '.join(_DELIMITERS.values())}."
        )
    return mark


def _decimal(text: str | None) -> str | None:
    mark = {"point": ".", "comma": ","}.get(text or "", text)
    if mark not in (None, ".", ","):
        raise InputError(f"decimal sign {text!r} is not known; choose '.' or ','.")
    return mark


def _text_sheet(
    file: str, encoding: str | None, delimiter: str | None, decimal: str | None
) -> Sheet:
    lines, name = read_lines(file, encoding)
    numbered = [
        (number, text)
        for number, line in joined(lines)
        if (text := narrow(line).strip(" \r\v\f")).strip()
        and not _COMMENT.match(text)
        and not is_rule(text)
    ]
    if numbered and (stated := _SEPARATOR.fullmatch(numbered[0][1])):
        delimiter = delimiter or stated[1]
        numbered = numbered[1:]
    mark = delimiter or _delimiter_of([text for _, text in numbered])
    rows = [Row(number, _split(text, mark)) for number, text in numbered]
    if mark == " ":
        rows = _with_aligned_names(numbered, rows)
    sign = decimal or _decimal_of(file, rows, mark)
    form = f"{name}, {_DELIMITERS[mark]}s, decimal {'point' if sign == '.' else 'comma'}"
    return Sheet(file, rows, sign, form)


def _split(text: str, delimiter: str) -> list[str]:
    if '"' not in text:
        cells = text.split() if delimiter == " " else text.split(delimiter)
        return [cell.strip() for cell in cells]
    import csv  # here, because few need it and it is not free to import

    if delimiter == " ":
        text = re.sub(r"\s+", " ", text)
    # A quote alone is an inch: it opens nothing.
    if text.count('"') % 2:
        return [cell.strip() for cell in text.split(delimiter)]
    try:
        (cells,) = csv.reader([text], delimiter=delimiter, skipinitialspace=True)
    except (csv.Error, ValueError):
        cells = text.split(delimiter)
    return [cell.strip().strip('"').strip() for cell in cells]


def _with_aligned_names(numbered: list[tuple[int, str]], rows: list[Row]) -> list[Row]:
    """Return rows between blanks, whose names may hold blanks where the numbers do not."""
    columns = {len(row.cells) for row in rows if all(map(_is_numberish, row.cells))}
    if len(columns) != 1:
        return rows
    (number,) = columns
    return [
        Row(row.line, names)
        if len(row.cells) > number
        and not _numbers(row.cells)
        and (names := aligned_names(text, number))
        else row
        for row, (_, text) in zip(rows, numbered, strict=True)
    ]


def _delimiter_of(lines: list[str]) -> str:
    """Return what separates the numbers in most lines that hold any.

    A tab or semicolon on most lines is never within a number, but a comma may be: it comes after
    them, and a blank last.
    """
    best, most = ",", 0.0
    for mark in _DELIMITERS:
        count = sum(_numbers(_split(line, mark)) for line in lines if mark in line)
        if count > 1.5 * most:
            best, most = mark, count
    return best


def _is_numberish(cell: str) -> bool:
    """Whether a cell looks like a number, with an error or a unit behind it or not."""
    return _WITH_UNIT.fullmatch(cell) is not None


def _numbers(cells: list[str]) -> int:
    """Return 1 for a line of at least two cells that is a row of numbers, with words or not."""
    numbers = sum(map(_is_numberish, cells))
    filled = sum(1 for cell in cells if cell)
    return int(len(cells) > 1 and numbers > 0 and 2 * numbers >= min(filled, 3))


def _decimal_of(file: str, rows: list[Row], delimiter: str) -> str:
    """Return the decimal sign that every number bears out, or ask for it."""
    numeric = (
        [row for row in rows if sum(map(_is_numberish, row.cells)) > 1 and _numbers(row.cells)]
        or [row for row in rows if _numbers(row.cells)]
        or rows
    )
    certain: dict[str, Row] = {}
    open_: dict[str, tuple[Row, str]] = {}
    for row in numeric:
        for cell in row.cells:
            mark = _sign_of(cell)
            if mark in (".", ","):
                certain.setdefault(mark, row)
            elif mark:
                open_.setdefault(mark[0], (row, cell))
    if len(certain) == 2:
        where = ", ".join(f"{mark!r} in line {row.line}" for mark, row in certain.items())
        raise InputError(
            f"{file} has two decimal signs ({where}); correct it, or say which one it is with "
            "--decimal (decimal= in Python)."
        )
    if certain:
        return next(iter(certain))
    if "," in open_ or ("." in open_ and delimiter == ";"):
        row, cell = open_.get(",", open_.get(".", (rows[0], "")))
        raise InputError(
            f"{file}, line {row.line}: {cell} may be thousands or a decimal fraction; say which "
            "with --decimal . or --decimal , (decimal= in Python)."
        )
    return "."


def _sign_of(cell: str) -> str:
    """Return a number's decimal sign, that sign and ? where it may mark thousands, or nothing."""
    match = _WITH_UNIT.fullmatch(_ungrouped(cell))
    if match is None:
        return ""
    cell = match[1]
    marks = [mark for mark in cell if mark in ".,"]
    if not marks:
        return ""
    if len(set(marks)) == 2:
        return marks[-1] if marks.count(marks[-1]) == 1 else ""
    if len(marks) > 1:  # thousands, whose mark is not the decimal sign
        return {".": ",", ",": "."}[marks[0]] if _GROUPED.fullmatch(cell) else ""
    return marks[0] + "?" if _GROUPED.fullmatch(cell) else marks[0]


def _ungrouped(cell: str) -> str:
    """Return a number without apostrophes or blanks between its thousands."""
    match = _APART.match(cell)
    return re.sub(r"['\u2019\s]", "", match[0]) + cell[match.end() :] if match else cell


def _pointed(cell: str, decimal: str) -> str:
    """Return a number with a decimal point and no marks of thousands."""
    cell = _ungrouped(cell.replace("\u2212", "-"))
    other = "," if decimal == "." else "."
    if other in cell:
        whole = cell.partition(decimal)[0]
        grouped = _GROUPED.fullmatch(whole)
        if grouped is None or grouped["mark"] != other:
            return ""
        cell = whole.replace(other, "") + cell[len(whole) :]
    return cell.replace(",", ".") if decimal == "," else cell

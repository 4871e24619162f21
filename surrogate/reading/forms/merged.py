"""Cells that a spreadsheet merged: exported, all but the first of them are empty."""

from __future__ import annotations

from collections.abc import Sequence

from surrogate.errors import InputError
from surrogate.reading.sheet import EMPTY, Row, Sheet
from surrogate.reading.words.phrases import table_phrase
from surrogate.reading.words.spelling import plain

__all__ = ["cell_of", "merged_names", "with_wires"]


def cell_of(row: Row, index: int) -> str:
    """Return a cell, "" where a row is shorter or the cell says that it is empty."""
    cell = row.cells[index] if index < len(row.cells) else ""
    return "" if cell.casefold() in EMPTY else cell


def merged_names(
    sheet: Sheet, header: Row, below: Row, wire: int, forces: Sequence[int], summary: Sequence[int]
) -> list[str] | None:
    """Return the names of columns whose name is that of several, and the numbers of trials below.

    Parameters
    ----------
    sheet : Sheet
        For messages.
    header, below : Row
        The row of names, and the one below it.
    wire : int
        Index of the wire's column.
    forces : sequence of int
        Indices of forces with a name.
    summary : sequence of int
        Indices of cells below that name a mean or a scatter.

    Returns
    -------
    list of str or None
        One name a column; None where none is merged.

    Raises
    ------
    InputError
        If what stands below the name of a force tells no trial.
    """
    names = list(header.cells) + [""] * (len(below.cells) - len(header.cells))
    spans = {index: _span(names, index) for index in forces}
    spans = {index: span for index, span in spans.items() if len(span) > 1}
    if (
        not spans
        or cell_of(below, wire)
        or not all(cell_of(below, one) for span in spans.values() for one in span)
    ):
        return None
    for index, span in spans.items():
        trials = [one for one in span if one not in summary]
        for order, one in enumerate(trials, start=1):
            label = cell_of(below, one)
            if label != str(order) and not table_phrase(plain(label)).trial:
                raise InputError(
                    f"{sheet.place(below)}: {label[:40]!r} stands below {names[index]!r}, which "
                    f"is the name of columns {span[0] + 1} to {span[-1] + 1}; write one name and "
                    "its unit a column, such as force_1_N, or one line a cut with the gel's name "
                    "in a column gel."
                )
        name, bracket, unit = names[index].partition("[" if "[" in names[index] else "(")
        for order, one in enumerate(trials, start=1):
            names[one] = f"{name.strip()} {order} {bracket}{unit}".strip()
        for one in set(span) - set(trials):
            names[one] = f"{cell_of(below, one)} {bracket}{unit}".strip()
    return names


def _span(names: Sequence[str], start: int) -> list[int]:
    end = start + 1
    while end < len(names) and not names[end]:
        end += 1
    return list(range(start, end))


def with_wires(
    sheet: Sheet, rows: list[Row], wire: int, forces: Sequence[int]
) -> tuple[list[Row], list[str]]:
    """Return the rows with the wire in every line where it stands in the first of several alone.

    It is taken for merged where two wires or more are followed by forces without a wire, and none
    stands in two lines, since means may then follow the cuts of a wire.
    """
    current, groups, filled = "", {}, []
    for row in rows:
        cell = cell_of(row, wire)
        if cell:
            if cell in groups:
                return rows, []
            current, groups[cell] = cell, 0
        elif current and any(sheet.is_number(cell_of(row, one)) for one in forces):
            groups[current] += 1
            cells = row.cells + [""] * (wire + 1 - len(row.cells))
            filled.append(Row(row.line, [*cells[:wire], current, *cells[wire + 1 :]]))
    if sum(1 for count in groups.values() if count) < 2:
        return rows, []
    by_line = {row.line: row for row in filled}
    lines = ", ".join(str(row.line) for row in filled[:6]) + ", ..." * (len(filled) > 6)
    note = f"{sheet.file}: merged cells: the wire of {sheet.line} {lines} is that above them"
    return [by_line.get(row.line, row) for row in rows], [note]

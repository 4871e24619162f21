"""Lines of text as tables: what a cell's quotes hold together, rules, names between blanks."""

from __future__ import annotations

import re
from collections.abc import Sequence

__all__ = ["aligned_names", "is_rule", "joined", "narrow"]

_WIDE = str.maketrans({code: code - 0xFEE0 for code in range(0xFF01, 0xFF5F)} | {0x3000: " "})
_RULE = re.compile(r"(?:[\s|+:]*[-=_\u2500-\u257f]){3}[\s|+:=_\u2500-\u257f-]*")
_OPENS = re.compile(r'(?:^|[,;\t])\s*"[^"]*$')
_MOST_LINES = 5
"""Of one cell."""


def narrow(line: str) -> str:
    """Return a line with the wide signs of East Asian keyboards as those of ASCII.

    Examples
    --------
    >>> narrow("線径（ｍｍ）")
    '線径(mm)'
    """
    return line if line.isascii() else line.translate(_WIDE)


def is_rule(line: str) -> bool:
    """Whether a line is drawn between a header and its table, as in Markdown.

    Examples
    --------
    >>> is_rule("|---|:--:|"), is_rule("-;-;-")
    (True, False)
    """
    return _RULE.fullmatch(line) is not None


def joined(lines: Sequence[str]) -> list[tuple[int, str]]:
    """Return lines with their numbers from 1; one that ends within quotes goes on in the next.

    Examples
    --------
    >>> joined(['"wire', '(mm)",F (N)', "0.1,2"])
    [(1, '"wire (mm)",F (N)'), (3, '0.1,2')]
    """
    whole: list[tuple[int, str]] = []
    index = 0
    while index < len(lines):
        end = _closed(lines, index) if '"' in lines[index] else index
        whole.append((index + 1, " ".join(lines[index : end + 1])))
        index = end + 1
    return whole


def _closed(lines: Sequence[str], start: int) -> int:
    """Return the index of the line that closes the quotes open at the end of a line."""
    if lines[start].count('"') % 2 == 0 or not _OPENS.search(lines[start].replace('""', "")):
        return start
    for index in range(start + 1, min(start + 1 + _MOST_LINES, len(lines))):
        if lines[index].count('"') % 2:
            return index if re.match(r'[^",;\t]*"\s*(?:[,;\t]|$)', lines[index]) else start
    return start


def aligned_names(line: str, columns: int) -> list[str] | None:
    """Return the names in a line above columns that blanks separate, None where they are open.

    Parameters
    ----------
    line : str
        Names that hold blanks themselves.
    columns : int
        How many there are.

    Examples
    --------
    >>> aligned_names("wire diameter (mm)   F/T (N/m)", 2)
    ['wire diameter (mm)', 'F/T (N/m)']
    >>> aligned_names("r (mm) F (N) T (mm)", 3)
    ['r (mm)', 'F (N)', 'T (mm)']
    """
    for mark in (r"\t+|\s{2,}", r"(?<=[)\]])\s+", r"\s+(?![(\[])"):
        names = [name for name in re.split(mark, line.strip()) if name]
        if len(names) == columns:
            return names
    return None

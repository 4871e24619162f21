"""Tables in Markdown, and the parts of a page that scripts keep up to date."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from surrogate.errors import InputError

__all__ = ["markdown_table", "plain", "update_page"]


def markdown_table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table, one line for each row: white space in a cell becomes single blanks.

    Examples
    --------
    >>> print(markdown_table(("alpha", "|x|"), [("2", "0.1")]))
    | alpha | \\|x\\| |
    | --- | --- |
    | 2 | 0.1 |
    """
    lines = [head, ["---"] * len(head), *rows]
    escaped = ([" ".join(cell.split()).replace("|", r"\|") for cell in line] for line in lines)
    return "\n".join(f"| {' | '.join(line)} |" for line in escaped)


def plain(value: float) -> str:
    """Return a number with two digits and without an exponent where it is not very large or small.

    Examples
    --------
    >>> plain(163.2), plain(0.0025), plain(100.0)
    ('160', '0.0025', '100')
    """
    return f"{float(f'{value:.2g}'):g}"


def update_page(page: Path, parts: Mapping[str, str]) -> None:
    """Replace what stands between the marks of each part of a page.

    Parameters
    ----------
    page : Path
        A Markdown file with the lines ``<!-- name: begin -->`` and ``<!-- name: end -->`` of each
        part.
    parts : mapping of str to str
        The text of each part by its name.

    Raises
    ------
    InputError
        If the page lacks a mark, or has it more than once; the page is then left as it was.
    """
    text = page.read_text(encoding="utf-8") if page.is_file() else ""
    for name, content in parts.items():
        begin, end = f"<!-- {name}: begin -->", f"<!-- {name}: end -->"
        if text.count(begin) != 1 or text.count(end) != 1:
            raise InputError(f"{page} lacks the lines {begin} and {end}, one of each; add them.")
        before, after = text[: text.index(begin)], text[text.index(end) :]
        text = f"{before}{begin}\n{content}\n{after}"
    page.write_text(text, encoding="utf-8")

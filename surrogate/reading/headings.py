"""Headings of columns: which quantity a name means, in which unit."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from surrogate.errors import InputError
from surrogate.reading.sheet import Row, Sheet
from surrogate.reading.units import (
    FORCE,
    LENGTH,
    LINE_FORCE,
    TIME,
    Dimension,
    Unit,
)

__all__ = [
    "Heading",
    "Vocabulary",
    "headings",
    "is_units_row",
    "meaning",
    "plain",
    "split_unit",
    "thickness_before",
    "vocabulary",
]

Vocabulary = Mapping[str, Sequence[tuple[str, Dimension]]]
"""What a name may mean, and the dimension that its unit must then have; the likeliest first."""

_BRACKETED = re.compile(r"(.*?)[\s_]*[\[({<]\s*([^\[\](){}<>]*?)\s*[\])}>]", re.DOTALL)
_ANY_UNIT = (LENGTH, FORCE, LINE_FORCE, TIME)


class Heading(NamedTuple):
    """One column: its number from 1, its name as written, and what it holds."""

    number: int
    name: str
    quantity: str = ""
    unit: Unit | None = None
    trial: bool = False

    def __str__(self) -> str:
        return f"column {self.number} ({self.name})"


def vocabulary(
    meanings: Mapping[str, Sequence[tuple[str, Dimension]]], names: Mapping[str, str]
) -> Vocabulary:
    """Return what each of many names means.

    Parameters
    ----------
    meanings : mapping of str to sequence of (str, Dimension)
        What a quantity is by the dimension of its unit.
    names : mapping of str to str
        Names of each quantity, separated by commas.
    """
    return {
        plain(name): meanings[quantity]
        for quantity, listed in names.items()
        for name in listed.split(",")
    }


def plain(name: str) -> str:
    """Return a name in small letters without accents, its marks as blanks.

    Examples
    --------
    >>> plain(" Prüf-Kraft_F_ss/T: ")
    'pruf kraft f ss/t'
    """
    letters = unicodedata.normalize("NFKD", name)
    letters = "".join(one for one in letters if not unicodedata.combining(one)).casefold()
    return " ".join(re.sub(r"[_\-.:;,\s#|]+", " ", letters).split()).replace(" / ", "/")


def headings(
    sheet: Sheet,
    row: Row,
    words: Vocabulary,
    units: Row | None = None,
    optional: Sequence[str] = (),
) -> list[Heading]:
    """Return what every column of a header holds; a quantity "" where a name is not known.

    Raises
    ------
    InputError
        If a known name comes without a unit, or with one of another quantity, unless another
        column tells the same, or it is one of the `optional` quantities: it is then not known.
    """
    below = units.cells if units else []
    listed: list[Heading] = []
    unclear: list[tuple[str, InputError]] = []
    for number, name in enumerate(row.cells, start=1):
        base, stated = split_unit(name, words)
        meanings, trial = meaning(base, words)
        text = stated if stated is not None else _bare("".join(below[number - 1 : number]))
        heading = _with_unit(Heading(number, name, trial=trial), meanings, text)
        if meanings and heading.unit is None and meanings[0][0] not in optional:
            error = _no_unit(f"{sheet.place(row)}, {heading}", *meanings[0], text)
            unclear.append((_kind(meanings[0][0]), error))
        listed.append(heading)
    kinds = {_kind(one.quantity) for one in listed}
    for kind, error in unclear:
        if kind not in kinds:  # else it is a remark, such as a wire's name beside its diameter
            raise error
    return listed


def _kind(quantity: str) -> str:
    """Return what a quantity tells, whichever way."""
    return {"wire_radius": "wire", "wire_diameter": "wire", "force_per_thickness": "force"}.get(
        quantity, quantity
    )


def _with_unit(heading: Heading, meanings: Sequence[tuple[str, Dimension]], text: str) -> Heading:
    for quantity, dimension in meanings:
        if text and (unit := dimension.unit(text)):
            return heading._replace(quantity=quantity, unit=unit)
    return heading


def _no_unit(place: str, quantity: str, dimension: Dimension, text: str) -> InputError:
    if text:
        return InputError(
            f"{place} does not end with a unit of {quantity} that is known; "
            f"write one of {dimension.spellings(quantity)}."
        )
    return InputError(
        f"{place} has no unit; write it behind the name, as {dimension.spellings(quantity)}, "
        "or in a row below the names."
    )


def split_unit(name: str, words: Vocabulary) -> tuple[str, str | None]:
    """Return a heading's name and the unit behind it, in brackets or after a mark."""
    name = name.strip(" :")
    bracketed = _BRACKETED.fullmatch(name)
    if bracketed:
        return bracketed[1], bracketed[2]
    if meaning(name, words)[0]:
        return name, None
    for mark in reversed(list(re.finditer(r"[_\s,/]+(?:in\s+)?", name))):
        left, right = name[: mark.start()], name[mark.end() :]
        meanings = meaning(left, words)[0]
        if meanings and right:
            known = any(dimension.unit(right) for _, dimension in meanings)
            exact = plain(left) == plain(meanings[0][0])
            if known or (exact and "_" in mark[0]):
                return left, right
    return name, None


def meaning(name: str, words: Vocabulary) -> tuple[Sequence[tuple[str, Dimension]], bool]:
    """Return what a name means, and whether it is one of several trials by its number.

    A word of the vocabulary that ends with n means something with a number only.
    """
    key = plain(name)
    if key in words:
        return words[key], False
    counted = re.fullmatch(r"(.*?) ?[0-9]{1,3}", key)
    base = counted[1] if counted else ""
    for name in (base, f"{base} n"):
        if base and name in words:
            return words[name], True
    return (), False


def _bare(cell: str) -> str:
    return re.sub(r"^[\[({<]\s*|\s*[\])}>]$", "", cell.strip())


def is_units_row(sheet: Sheet, row: Row) -> bool:
    """Whether a row holds units, with brackets or without, and no number."""
    filled = [_bare(cell) for cell in row.cells if cell]
    known = sum(any(kind.unit(text) for kind in _ANY_UNIT) for text in filled)
    return 2 * known >= len(filled) > 0 and not any(map(sheet.is_number, filled))


_THICKNESS = re.compile(
    r"(?<![a-z])(thickness|dicke|probendicke|materialdicke|schichtdicke|sample thickness)\b"
)


def thickness_before(sheet: Sheet, rows: Sequence[Row]) -> tuple[float, str] | None:
    """Return the sample's thickness [m] out of the lines before a table, and where it stands.

    Raises
    ------
    InputError
        If a thickness has no unit or no number, or there are two that differ.
    """
    seen: dict[float, str] = {}
    for row in rows:
        for index, cell in enumerate(row.cells[:-1] or row.cells):
            if _THICKNESS.search(plain(cell)):
                value = _thickness(sheet, row, index)
                if value is not None:
                    seen.setdefault(value, f"{sheet.line} {row.line}")
    if len(seen) > 1:
        listed = ", ".join(f"{1e3 * value:g} mm in {where}" for value, where in seen.items())
        raise InputError(
            f"{sheet.file} has two thicknesses ({listed}); say which with --thickness "
            "(thickness= in Python)."
        )
    return next(iter(seen.items()), None)


def _thickness(sheet: Sheet, row: Row, index: int) -> float | None:
    name = row.cells[index]
    inside = _BRACKETED.fullmatch(name)
    values = [part for cell in row.cells[index + 1 :] for part in _number_and_unit(cell)]
    if not values and (colon := re.search(r"[:=]\s*([0-9].*)$", name)):
        values = _number_and_unit(colon[1])
    if not values or not sheet.is_number(values[0]):
        return None
    text = inside[2] if inside else _bare(values[1]) if len(values) > 1 else ""
    unit = LENGTH.unit(text) if text else None
    if unit is None:
        raise InputError(
            f"{sheet.place(row)} gives a thickness of {values[0]} in no unit of length; say it "
            "with --thickness (thickness= in Python)."
        )
    value = sheet.number(values[0], unit)
    return value if value is not None and 0.0 < value < float("inf") else None


def _number_and_unit(cell: str) -> list[str]:
    match = re.fullmatch(r"([+-]?[0-9.,]+)\s*([^\d\s].*)?", cell)
    return [part for part in (match.groups() if match else (cell,)) if part]

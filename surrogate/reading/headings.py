"""Headings of columns: which quantity a name means, in which unit."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from surrogate.errors import InputError
from surrogate.reading.sheet import Row, Sheet
from surrogate.reading.units import FORCE, LENGTH, LINE_FORCE, TIME, Dimension, Unit
from surrogate.reading.words.phrases import Phrase
from surrogate.reading.words.spelling import plain

__all__ = [
    "AVERAGE",
    "Heading",
    "Vocabulary",
    "bare",
    "headings",
    "is_units_row",
    "meaning",
    "split_bracketed",
    "split_unit",
    "vocabulary",
]

Meanings = Sequence[tuple[str, Dimension]]
"""What a name may mean, and the dimension that its unit must then have; the likeliest first."""

_BRACKETED = re.compile(r"(.*?)[\s_]*[\[({<]\s*([^\[\](){}<>]*?)\s*[\])}>]", re.DOTALL)
_INSIDE = re.compile(r"(.*?)[\s_]*[\[(]\s*([^\[\]()]*?)\s*[\])]\s*(\w[\w .]*)")
AVERAGE = re.compile(
    r"^(mean|average|avg|mittelwert|mittlere|mittlerer|moyenne|media|srednia)( of| der| de la)? "
    r"|[ (]+(mean|average|avg|mittelwert|moyenne|media|srednia)\)?$"
)
"""Words beside a name that change nothing of what it means."""
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


def _nothing(_: str) -> Phrase:
    """Say that no name means anything."""
    return Phrase()


@dataclass(frozen=True)
class Vocabulary:
    """What names mean: those of a list, and what is put together of known words.

    Parameters
    ----------
    names : mapping of str to sequence of (str, Dimension)
        Meanings of whole names, as `plain` writes them. One that ends with n means something with
        a number only.
    meanings : mapping of str to sequence of (str, Dimension)
        What a quantity is by the dimension of its unit.
    phrase : callable
        Returns the quantity of any other name.
    """

    names: Mapping[str, Meanings] = field(default_factory=dict)
    meanings: Mapping[str, Meanings] = field(default_factory=dict)
    phrase: Callable[[str], Phrase] = _nothing


def vocabulary(
    meanings: Mapping[str, Meanings],
    names: Mapping[str, str],
    phrase: Callable[[str], Phrase],
) -> Vocabulary:
    """Return what names mean.

    Parameters
    ----------
    meanings : mapping of str to sequence of (str, Dimension)
        What a quantity is by the dimension of its unit.
    names : mapping of str to str
        Names of each quantity, separated by commas.
    phrase : callable
        Returns the quantity of any other name.
    """
    whole = {
        plain(name): meanings[quantity]
        for quantity, listed in names.items()
        for name in listed.split(",")
    }
    return Vocabulary(whole, meanings, phrase)


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
        text = stated if stated is not None else bare("".join(below[number - 1 : number]))
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


def split_bracketed(name: str) -> tuple[str, str] | None:
    """Return a name and what stands in brackets behind it; None where nothing does."""
    match = _BRACKETED.fullmatch(name)
    return (match[1], match[2]) if match else None


def split_unit(name: str, words: Vocabulary) -> tuple[str, str | None]:
    """Return a heading's name and the unit behind it, in brackets or after a mark."""
    name = name.strip(" :")
    bracketed = split_bracketed(name)
    if bracketed:
        return bracketed[0].rstrip(" /"), bracketed[1]
    inside = _INSIDE.fullmatch(name)
    if inside and meaning(behind := f"{inside[1]} {inside[3]}", words)[0]:
        return behind, inside[2]
    if meaning(name, words)[0]:
        return name, None
    for mark in reversed(list(re.finditer(r"[_\s,/:]+(?:in\s+)?", name))):
        left, right = name[: mark.start()], name[mark.end() :]
        meanings = meaning(left, words)[0]
        if meanings and right:
            known = any(dimension.unit(right) for _, dimension in meanings)
            exact = plain(left) == plain(meanings[0][0])
            if known or (exact and "_" in mark[0]):
                return left, right
    return name, None


def meaning(name: str, words: Vocabulary) -> tuple[Meanings, bool]:
    """Return what a name means, and whether it is one of several trials by its number."""
    key = plain(name)
    for known in (key, AVERAGE.sub("", key)):
        if known in words.names:
            return words.names[known], False
    counted = re.fullmatch(r"(.*?) ?[0-9]{1,3}", key)
    base = counted[1] if counted else ""
    for one in (base, f"{base} n"):
        if base and one in words.names:
            return words.names[one], True
    quantity, trial = words.phrase(key)
    return words.meanings.get(quantity, ()), trial


def bare(cell: str) -> str:
    """Return what stands in brackets, or a cell without them."""
    return re.sub(r"^[\[({<]\s*|\s*[\])}>]$", "", cell.strip())


def is_units_row(sheet: Sheet, row: Row) -> bool:
    """Whether a row holds units, with brackets or without, and no number."""
    filled = [bare(cell) for cell in row.cells if cell]
    known = sum(any(kind.unit(text) for kind in _ANY_UNIT) for text in filled)
    return 2 * known >= len(filled) > 0 and not any(map(sheet.is_number, filled))

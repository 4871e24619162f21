"""Frozen records of floats and arrays: equality, and how they are shown, as text and as HTML."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import fields
from typing import TYPE_CHECKING, Any

import numpy as np

from surrogate.basics.checks import shown

if TYPE_CHECKING:
    from typing_extensions import Self

__all__ = [
    "UNKNOWN",
    "LateRecord",
    "ReadOnly",
    "Record",
    "Shown",
    "html_of_record",
    "html_table",
    "number",
    "share",
    "table",
]


class ReadOnly(Mapping[Any, Any]):
    """A mapping that cannot be changed, but pickled and deep-copied, as a mappingproxy cannot.

    Examples
    --------
    >>> ReadOnly({"xi": 0.1})["xi"]
    0.1
    """

    __slots__ = ("_items",)

    def __init__(self, items: Mapping[Any, Any]) -> None:
        self._items = dict(items)

    def __getitem__(self, key: Any) -> Any:
        return self._items[key]

    def __iter__(self) -> Iterator[Any]:
        return iter(self._items)

    def __len__(self) -> int:
        return len(self._items)

    def __repr__(self) -> str:
        return f"ReadOnly({self._items!r})"


class Shown:
    """Base of dataclasses that notebooks show as a table of their fields."""

    __slots__ = ()

    def _repr_html_(self) -> str:
        """What notebooks show."""
        return html_of_record(self)


class Record(Shown):
    """Base of frozen dataclasses whose fields may be arrays: equal where all fields are.

    The comparison that a dataclass would write itself fails on arrays. Hashing works where all
    fields are hashable, which arrays are not.
    """

    __slots__ = ()

    def _values(self) -> tuple[Any, ...]:
        return tuple(getattr(self, field.name) for field in fields(self))  # type: ignore[arg-type]

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        return all(map(np.array_equal, self._values(), other._values()))

    def __hash__(self) -> int:
        return hash(self._values())


class LateRecord(Record):
    """Base of frozen dataclasses with fields that are computed when one of them is first asked for.

    Examples
    --------
    >>> from dataclasses import dataclass
    >>> @dataclass(frozen=True, slots=True, eq=False)
    ... class Square(LateRecord):
    ...     side: float
    ...     area: float
    >>> square = Square.without("area")(lambda: {"area": print("asked") or 9.0}, 3.0)
    >>> square.side
    3.0
    >>> square.area, square.area
    asked
    (9.0, 9.0)
    """

    __slots__ = ("_late",)

    @classmethod
    def without(cls, *names: str) -> Callable[..., Self]:
        """Return what makes records of a function, which tells these fields, and the other fields.

        They follow in their order.
        """
        others = ["_late", *(field.name for field in fields(cls) if field.name not in names)]  # type: ignore[arg-type]
        setters = [getattr(cls, name).__set__ for name in others]

        def record_of(*values: Any) -> Any:
            record = object.__new__(cls)
            for setter, value in zip(setters, values):  # noqa: B905 (every force passes here)
                setter(record, value)
            return record

        return record_of

    def __getattr__(self, name: str) -> Any:
        """Compute the fields that are not set yet."""
        if name != "_late" and name in {field.name for field in fields(self)}:  # type: ignore[arg-type]
            for late, value in self._late().items():
                object.__setattr__(self, late, value)
            return object.__getattribute__(self, name)
        raise AttributeError(f"{type(self).__name__!r} has no attribute {name!r}")


UNKNOWN = "unknown"


def number(value: float, digits: int = 4) -> str:
    """Return a few digits for people, without an exponent where none is needed.

    Examples
    --------
    >>> number(0.00123456), number(1.5e-9), number(float("nan"))
    ('0.001235', '1.5e-09', 'unknown')
    """
    if math.isnan(value):
        return UNKNOWN
    if 1e-3 <= abs(value) < 1e6:
        return np.format_float_positional(value, digits, fractional=False, trim="-")
    return f"{value:.{digits}g}"


def table(header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Return lines with columns of equal width.

    Examples
    --------
    >>> print(table(("name", "value"), [("a", "1"), ("longer", "2")]))
    name    value
    a       1
    longer  2
    """
    lines = [header, *rows]
    widths = [max(len(line[i]) for line in lines) for i in range(len(header))]
    return "\n".join(
        "  ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)).rstrip()
        for line in lines
    )


_MOST_WORDS = 4


def share(value: float) -> str:
    """Return a share for people: two thirds as 2/3.

    Examples
    --------
    >>> share(2.0 / 3.0), share(0.9)
    ('2/3', '0.9')
    """
    return "2/3" if abs(value - 2.0 / 3.0) < 1e-12 else f"{value:.3g}"


def html_table(title: str, rows: Iterable[tuple[str, str, str]]) -> str:
    """Return a table of name, value and unit.

    Examples
    --------
    >>> html_table("Scene", [("toughness", "1.6", "J/m^2")])[:48]
    '<table><caption>Scene</caption><tr><td>toughness'
    """
    from html import escape  # which notebooks need alone

    lines = "".join(
        "<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in row) + "</tr>" for row in rows
    )
    return f"<table><caption>{escape(title)}</caption>{lines}</table>"


def html_of_record(record: Any) -> str:
    """Return the fields of a dataclass with the units that its documentation gives.

    Examples
    --------
    >>> from surrogate import Scene
    >>> "<td>shear_modulus</td><td>685</td><td>Pa</td>" in html_of_record(Scene(685.0, 1.6, 1e-4))
    True
    """
    units = _units(type(record))
    rows = []
    for field in fields(record):
        value, unit = getattr(record, field.name), units.get(field.name, "")
        if isinstance(value, Mapping):
            rows += [(f"{field.name}: {key}", _short(part), unit) for key, part in value.items()]
        else:
            rows.append((field.name, _short(value), unit))
    return html_table(type(record).__name__, rows)


def _units(kind: type) -> dict[str, str]:
    """Return the units in square brackets of the documented parameters."""
    found: dict[str, str] = {}
    entries = re.split(r"^ {4}(?=\w[\w, ]* : )", kind.__doc__ or "", flags=re.MULTILINE)
    for entry in entries[1:]:
        names, _, text = entry.partition(" : ")
        unit = re.search(r"\[([^\]]*)\]", text)
        for name in names.split(", "):
            if unit and unit[1] != "-":
                found[name] = unit[1]
    return found


def _short(value: Any) -> str:
    """Return a value in one short line; of an array its shape and range."""
    if isinstance(value, float):
        return number(value)
    if not isinstance(value, np.ndarray):
        return (
            "unknown" if value is None else str(value) if isinstance(value, str) else shown(value)
        )
    shape = " x ".join(map(str, value.shape))
    if not value.size:
        return f"{shape} values"
    if value.dtype.kind in "Ub":
        kinds = [str(one) for one in np.unique(value)]
        words = ", ".join(kinds[:_MOST_WORDS])
        return f"{shape} values: {words}"
    with np.errstate(all="ignore"):
        finite = value[np.isfinite(value)]
    if not finite.size:
        return f"{shape} values, none finite"
    return f"{shape} values, {number(float(finite.min()))} to {number(float(finite.max()))}"

"""What the page needs to read a table: the names of columns, units and marks that Python knows."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from surrogate.reading.forms.remarks import SUMMARY
from surrogate.reading.headings import AVERAGE
from surrogate.reading.sheet import EMPTY
from surrogate.reading.units import FORCE, LENGTH, LINE_FORCE, SYNONYMS, Dimension
from surrogate.reading.words.wire_words import COUNT, DEVIATION, WORDS

__all__ = ["reading"]

_KINDS = {"length": LENGTH, "force": FORCE, "line": LINE_FORCE}


def reading() -> dict[str, Any]:
    """Return the words of tables of cuts, as the page's program is told them.

    Examples
    --------
    >>> reading()["units"]["length"]["mm"]
    [-3, 1.0]
    """
    return {
        "words": _words(),
        "units": {name: _units(dimension) for name, dimension in _KINDS.items()},
        "synonyms": SYNONYMS,
        "empty": sorted(EMPTY),
        "average": AVERAGE.pattern,
        "summary": f"^(?:{SUMMARY.pattern})$",
        "deviation": DEVIATION.pattern,
        "counts": sorted(COUNT),
    }


def _words() -> list[dict[str, Any]]:
    """Return the names of columns, those together that mean the same."""
    names: dict[tuple[tuple[str, str], ...], list[str]] = {}
    for name, meanings in WORDS.names.items():
        names.setdefault(_told(meanings), []).append(name)
    return [{"means": means, "names": listed} for means, listed in names.items()]


def _told(meanings: Sequence[tuple[str, Dimension]]) -> tuple[tuple[str, str], ...]:
    kinds = {id(dimension): name for name, dimension in _KINDS.items()}
    return tuple((quantity, kinds[id(dimension)]) for quantity, dimension in meanings)


def _units(dimension: Dimension) -> dict[str, list[float]]:
    """Return the power of ten and the factor of each unit."""
    powers = {name: [power, 1.0] for name, power in dimension.powers.items()}
    return powers | {name: list(unit) for name, unit in dimension.others.items()}

"""Wires by their gauge: numbers of the American wire gauge as diameters."""

from __future__ import annotations

import re
from collections.abc import Sequence

from surrogate.errors import InputError
from surrogate.reading.words.spelling import plain

__all__ = ["gauge_diameter", "is_gauge", "names_other_gauge"]

_NUMBER = re.compile(r"(?:awg\s*#?)?\s*([0-9]{1,2})(?:\.0)?\s*(?:awg)?", re.IGNORECASE)
_GAUGE = re.compile(r"\b(gauge|gage|swg|bwg|g|ga)\b")
_LARGEST = 60


def is_gauge(name: str, unit: str = "") -> bool:
    """Whether a column holds numbers of the American wire gauge, by its name or unit."""
    return "awg" in re.split(r"[^a-z]+", f"{plain(name)} {plain(unit)}")


def names_other_gauge(names: Sequence[str]) -> bool:
    """Whether a name speaks of a gauge that may be any of several."""
    return any(_GAUGE.search(plain(name)) for name in names)


def gauge_diameter(place: str, cell: str) -> float:
    """Return the diameter of a number of the American wire gauge [mm], ASTM B258.

    Parameters
    ----------
    place : str
        Where it stands, for the message.
    cell : str
        The number, with or without AWG.

    Raises
    ------
    InputError
        If it is no whole number from 0 to 60.

    Examples
    --------
    >>> round(gauge_diameter("", "AWG 36"), 9)
    0.127
    """
    match = _NUMBER.fullmatch(cell.strip())
    if match is None or int(match[1]) > _LARGEST:
        raise InputError(
            f"{place}: {cell[:40]!r} is no number of the American wire gauge from 0 to {_LARGEST}; "
            "write the wire's diameter in a column wire_diameter_mm."
        )
    return float(0.127 * 92.0 ** ((36 - int(match[1])) / 39.0))

"""Tables of text for people."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

__all__ = ["UNKNOWN", "number", "table"]

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

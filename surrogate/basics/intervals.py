"""Intervals of numbers: what a formula is between where each of its quantities is in a range.

Sums and products of intervals contain all sums and products of their members. Where a quantity
occurs twice they contain more; they become sharp as the ranges are halved.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["Interval"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Interval:
    """Arrays of intervals, which add and multiply with each other and with numbers.

    Parameters
    ----------
    low, high : ndarray
        The ends.

    Examples
    --------
    >>> both = Interval(np.array([-1.0]), np.array([2.0])) * 3.0 + 1.0
    >>> both.low, both.high
    (array([-2.]), array([7.]))
    """

    low: Array
    high: Array

    __array_ufunc__ = None  # so that numbers of numpy leave sums and products to this class

    def __add__(self, other: Any) -> Interval:
        low, high = _ends(other)
        return Interval(self.low + low, self.high + high)

    __radd__ = __add__

    def __mul__(self, other: Any) -> Interval:
        low, high = _ends(other)
        corners = [a * b for a in (self.low, self.high) for b in (low, high)]
        return Interval(np.minimum.reduce(corners), np.maximum.reduce(corners))

    __rmul__ = __mul__


def _ends(value: Any) -> tuple[Any, Any]:
    return (value.low, value.high) if isinstance(value, Interval) else (value, value)

"""The cells of a table over (ln g, ln alpha), and where points are in them.

Along g the cells are equal in ln g from the lowest g to g_touch(alpha), and equal in ln(g/g_touch)
from there on; along alpha they are equal in ln alpha.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from surrogate.contact.coordinates import log_touch, log_touch_slope, touch_range

__all__ = ["Grid", "Place"]


class Place(NamedTuple):
    """Cells and how far points are in them, 0 to 1, along g and along alpha; x = ln(g/g_touch).

    The cell along alpha and the place in it are floats where alpha is one number.
    """

    along_g: Any
    in_g: Any
    along_alpha: Any
    in_alpha: Any
    x: Any


@dataclass(frozen=True)
class Grid:
    """The cells.

    Parameters
    ----------
    log_g : float
        ln g at which the first cell begins.
    beyond : float
        ln(g/g_touch) at which the last cell ends.
    log_alpha : tuple of float
        The ends in ln alpha.
    touch : tuple of float
        Coefficients of ln g_touch in powers of ln alpha.
    short, past, stiffening : int
        Cells along g short of and past the touch, and along alpha.
    """

    log_g: float
    beyond: float
    log_alpha: tuple[float, float]
    touch: tuple[float, ...]
    short: int
    past: int
    stiffening: int

    @property
    def cells(self) -> int:
        """Number of cells along g."""
        return self.short + self.past

    def place(self, log_g: Any, log_alpha: Any) -> Place:
        """Return where points are, floats or arrays."""
        touch = log_touch(self.touch, log_alpha)
        x = log_g - touch
        along = self._rate(x, touch)
        along *= x
        along += float(self.short)
        low, high = self.log_alpha
        across = log_alpha - low
        across *= self.stiffening / (high - low)
        return Place(*_cell(along, self.short + self.past), *_cell(across, self.stiffening), x)

    def touched(self, g: tuple[float, float], alpha: tuple[float, float]) -> tuple[slice, slice]:
        """Return the cells along g and along alpha that a part of the domain touches.

        The number of a cell along g falls as g_touch grows.
        """
        low, high = touch_range(self.touch, alpha)
        first = self._along(math.log(g[0]), math.log(high))
        last = self._along(math.log(g[1]), math.log(low))
        begin, end = self.log_alpha
        per_alpha = self.stiffening / (end - begin)
        left, right = ((math.log(each) - begin) * per_alpha for each in alpha)
        return _cells_of(first, last, self.cells), _cells_of(left, right, self.stiffening)

    def _along(self, log_g: float, touch: float) -> float:
        x = log_g - touch
        return float(self._rate(x, touch) * x + self.short)

    def _rate(self, x: Any, touch: Any) -> Any:
        """Return cells per unit of ln g, in an array that may be changed."""
        if type(x) is float:
            return self.short / (touch - self.log_g) if x < 0.0 else self.past / self.beyond
        before = self.short / (touch - self.log_g)
        return np.where(x < 0.0, before, self.past / self.beyond)

    def slopes(self, place: Place, log_alpha: Any) -> tuple[Any, Any, float]:
        """Return d cells along g/d ln g and d ln alpha, and d cells along alpha/d ln alpha."""
        touch, bend = log_touch(self.touch, log_alpha), log_touch_slope(self.touch, log_alpha)
        rate = self._rate(place.x, touch)
        # before the touch the cells widen with it: place = short (ln g - low)/(touch - low)
        widening = place.x / (touch - self.log_g)
        moved = -rate * bend * (1.0 + np.where(place.x < 0.0, widening, 0.0))
        low, high = self.log_alpha
        return rate, moved, self.stiffening / (high - low)

    def nodes(self) -> tuple[Any, Any]:
        """Return the nodes along g, counted from the touch, and ln alpha of those along alpha."""
        return (
            np.arange(self.cells + 1.0) - self.short,
            np.linspace(*self.log_alpha, self.stiffening + 1),
        )

    def log_g_of(self, node: Any, log_alpha: Any) -> Any:
        """Return ln g of a node along g."""
        touch = log_touch(self.touch, log_alpha)
        short = node * (touch - self.log_g) / self.short
        return touch + np.where(node < 0.0, short, node * self.beyond / self.past)


def _cells_of(first: float, last: float, cells: int) -> slice:
    """Return the cells between two places, a rounding more on either side."""
    low, high = (min(max(int(place), 0), cells - 1) for place in (first - 1e-9, last + 1e-9))
    return slice(low, high + 1)


def _cell(place: Any, cells: int) -> tuple[Any, Any]:
    """Return the cell of a place and how far it is in it, from 0 to 1; an array is changed."""
    if type(place) is float:
        number = int(place) if 0.0 <= place < cells else (cells - 1 if place >= cells else 0)
        return number, place - number
    cell = place.astype(np.intp)
    np.minimum(np.maximum(cell, 0, out=cell), cells - 1, out=cell)
    place -= cell
    return cell, place

"""Functions of ln g at one alpha: the table's cubic pieces, alone or summed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from surrogate.contact.table import CellTable, cubics

__all__ = ["Line", "line_of", "summed"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Line:
    """Cubic pieces over x = ln(g/g_touch), equal on either side of the touch.

    Parameters
    ----------
    touch : float
        ln g_touch.
    before, after : float
        Pieces per ln g short of and past the touch.
    short : int
        Number of pieces short of the touch.
    pieces : ndarray, shape (pieces + 1, 4)
        Coefficients of powers of the place in a piece, 0 to 1. The last row continues the piece
        before it, so that the very end has a piece of its own.

    Examples
    --------
    >>> line = Line(0.0, 1.0, 1.0, 1, np.array([[1.0, 2.0, 0.0, 0.0], [3.0, 1.0, 0.0, 0.0]]))
    >>> line.number(-0.5)
    2.0
    >>> line.at(np.array([-1.0, -0.5, 0.5]))
    array([1. , 2. , 3.5])
    """

    touch: float
    before: float
    after: float
    short: int
    pieces: Array

    @cached_property
    def rows(self) -> list[tuple[float, ...]]:
        """The coefficients by piece, as numbers."""
        return [tuple(row) for row in self.pieces.tolist()]

    def number(self, log_g: float) -> float:
        """Return the value at one ln g."""
        x = log_g - self.touch
        t = (self.before if x < 0.0 else self.after) * x + self.short
        piece = int(t)
        t -= piece
        a, b, c, d = self.rows[piece]
        return a + t * (b + t * (c + t * d))

    def place(self, x: Array, side: int = 0) -> tuple[NDArray[np.intp], Array]:
        """Return pieces and places in them of ln(g/g_touch), an array that is changed.

        `side` is -1 or 1 where all points are known to be short of or past the touch.
        """
        if side:
            x *= self.before if side < 0 else self.after
        else:
            past = self.after * x  # both cross at the touch, and the quicker way to choose is this
            x *= self.before
            (np.minimum if self.before >= self.after else np.maximum)(x, past, out=x)
        x += self.short
        whole = np.trunc(x)
        x -= whole
        return whole.astype(np.intp), x

    def values(self, piece: NDArray[np.intp], t: Array) -> Array:
        """Return the values at places in pieces."""
        result = np.empty(t.shape)
        cubics(self.pieces, piece, t, result, np.empty((*t.shape, 4)))
        return result

    def at(self, log_g: Array) -> Array:
        """Return the values at ln g."""
        return self.values(*self.place(log_g - self.touch))

    def between(self, low: Array, high: Array) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
        """Return bounds of the values and of the slopes in intervals of ln g, each in one piece.

        A polynomial is between the least and the largest of its Bernstein coefficients.
        """
        middle = 0.5 * (low + high) - self.touch
        rate = np.where(middle < 0.0, self.before, self.after)
        piece = np.floor(rate * middle + self.short).astype(np.intp)
        begin, end = (
            np.clip(rate * (edge - self.touch) + self.short - piece, 0.0, 1.0)
            for edge in (low, high)
        )
        a, b, c, d = self.pieces[piece].T
        width = end - begin
        a = a + begin * (b + begin * (c + begin * d))
        b = width * (b + begin * (2.0 * c + 3.0 * begin * d))
        c, d = width**2 * (c + 3.0 * begin * d), width**3 * d
        per_x = rate / np.where(width > 0.0, width, 1.0)
        return (
            _bounds(a, a + b / 3.0, a + (2.0 * b + c) / 3.0, a + b + c + d),
            _bounds(*(per_x * each for each in (b, b + c, b + 2.0 * c + 3.0 * d))),
        )

    def with_pieces(self, pieces: Array) -> Line:
        """Return a line of other coefficients."""
        return Line(self.touch, self.before, self.after, self.short, pieces)


def _bounds(*values: Array) -> tuple[Array, Array]:
    return np.minimum.reduce(values), np.maximum.reduce(values)


def line_of(table: CellTable, name: str, log_alpha: float) -> Line:
    """Return a function of the table at one alpha.

    Examples
    --------
    >>> from surrogate.contact.shipped import shipped
    >>> import math
    >>> line = line_of(shipped().table, "arc", math.log(2.0))
    >>> 0.0 < line.number(0.0) < 2.0
    True
    """
    grid = table.grid
    place = grid.place(0.0, log_alpha)
    j, s = place.along_alpha, place.in_alpha
    c = table.cells(name).reshape(-1, grid.stiffening, 4, 4)[:, j].transpose(2, 1, 0)
    pieces = (c[0] + s * (c[1] + s * (c[2] + s * c[3]))).T
    touch = 0.0 - place.x
    short = grid.short / (touch - grid.log_g)
    return Line(touch, short, grid.past / grid.beyond, grid.short, _ended(pieces))


def _ended(pieces: Array) -> Array:
    a, b, c, d = pieces[-1]
    last = [a + b + c + d, b + 2.0 * c + 3.0 * d, c + 3.0 * d, d]
    return np.ascontiguousarray(np.vstack([pieces, last]))


def summed(lines: Mapping[str, Line], factors: Mapping[str, float]) -> Line:
    """Return a sum of functions at the same alpha."""
    first = next(iter(lines.values()))
    total: Any = sum(factors[name] * line.pieces for name, line in lines.items())
    return first.with_pieces(total)

"""Piecewise bicubic functions of (ln g, ln alpha) that may bend where the tip touches the wire.

The grid follows the touch, see `surrogate.contact.grid`. In every cell a function is a polynomial
of degree three in each direction. Values and slopes agree at the edges of cells, but the slopes
across the touch need not.

Floats, arrays with one alpha and arrays of both take ways of different speed through the same
operations on the same numbers, so that they agree to the last bit.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.elementwise import where
from surrogate.contact.coordinates import POWER, log_touch, vertex
from surrogate.contact.domain import Domain
from surrogate.contact.fitted import PROJECTED, FittedModel
from surrogate.contact.grid import Grid, Place

__all__ = ["CellTable", "TableModel", "cubics"]

Array = NDArray[np.float64]

_BERNSTEIN = np.array([[1, 0, 0, 0], [1, 1 / 3, 0, 0], [1, 2 / 3, 1 / 3, 0], [1, 1, 1, 1]])
"""Bernstein coefficients of a cubic from its powers."""
_KEPT = 24  # collapsed tables, some kilobytes each


class NumberLine(NamedTuple):
    """Where numbers are along g at one alpha, and the cubics of functions that were asked for."""

    touch: float
    before: float
    past: float
    short: int
    rows: int
    along_alpha: int
    in_alpha: float
    cubics: dict[tuple[str, int], tuple[float, ...]]


class Slopes(NamedTuple):
    """Values at the nodes of one side of the touch, with derivatives by the counts of nodes."""

    values: Array
    by_g: Array
    by_alpha: Array
    mixed: Array


@dataclass(frozen=True, eq=False)
class CellTable:
    """Functions on one grid.

    Parameters
    ----------
    grid : Grid
        The cells.
    nodes : mapping of str to tuple of ndarray, shape (nodes along g, nodes along alpha)
        For each function its values at the nodes on either side of the touch, which is the last
        node of the first array and the first of the second. The slopes are those of cubic splines.
    """

    grid: Grid
    nodes: Mapping[str, tuple[Array, Array]]
    _sides: dict[str, list[Slopes]] = field(default_factory=dict, init=False, repr=False)
    _cells: dict[str, Array] = field(default_factory=dict, init=False, repr=False)
    _bounds: dict[str, tuple[Array, Array]] = field(default_factory=dict, init=False, repr=False)
    _quarters: dict[str, list[Array]] = field(default_factory=dict, init=False, repr=False)
    _rows: dict[str, dict[int, tuple[float, ...]]] = field(
        default_factory=dict, init=False, repr=False
    )
    _lines: dict[float, NumberLine] = field(default_factory=dict, init=False, repr=False)
    _collapsed: dict[tuple[str, int, float], Array] = field(
        default_factory=dict, init=False, repr=False
    )

    def at(self, names: Sequence[str], log_g: Any, log_alpha: Any) -> tuple[Any, list[Any]]:
        """Return x = ln(g/g_touch) and functions at points: floats, or arrays and one alpha."""
        if type(log_g) is float:
            return self._number(names, log_g, log_alpha)
        if type(log_alpha) is float:
            place = self.grid.place(log_g, log_alpha)
            return place.x, [self._along(name, place) for name in names]
        if "numba" in sys.modules:
            return self._compiled(names, log_g, log_alpha)
        place = self.grid.place(log_g, log_alpha)
        return place.x, self._scattered(names, place)

    def slopes(self, name: str, log_g: Any, log_alpha: Any) -> tuple[Any, Any, Any, Any]:
        """Return x, a function and its derivatives by ln g and by ln alpha."""
        place = self.grid.place(log_g, log_alpha)
        index = place.along_g * self.grid.stiffening + place.along_alpha
        rows = self.cells(name).reshape(-1, 4, 4)[index]
        c = np.moveaxis(rows, (-2, -1), (0, 1))
        t, s = place.in_g, place.in_alpha
        power = [c[k][0] + s * (c[k][1] + s * (c[k][2] + s * c[k][3])) for k in range(4)]
        across = [c[k][1] + s * (2.0 * c[k][2] + s * (3.0 * c[k][3])) for k in range(4)]
        value = power[0] + t * (power[1] + t * (power[2] + t * power[3]))
        by_cell = power[1] + t * (2.0 * power[2] + t * (3.0 * power[3]))
        by_row = across[0] + t * (across[1] + t * (across[2] + t * across[3]))
        in_g, moved, in_alpha = self.grid.slopes(place, log_alpha)
        return place.x, value, by_cell * in_g, by_row * in_alpha + by_cell * moved

    def cells(self, name: str) -> Array:
        """Return the sixteen coefficients of every cell of a function, one row each."""
        if name not in self._cells:
            self._cells[name] = np.concatenate([_coefficients(side) for side in self.sides(name)])
        return self._cells[name]

    def between(
        self, name: str, g: tuple[float, float], alpha: tuple[float, float]
    ) -> tuple[float, float]:
        """Return bounds of a function all over a part of the domain: of the cells that it touches.

        A polynomial is between the least and the largest of its Bernstein coefficients.
        """
        rows, columns = self.grid.touched(g, alpha)
        least, most = self._ends(name)
        return float(least[rows, columns].min()), float(most[rows, columns].max())

    def _ends(self, name: str) -> tuple[Array, Array]:
        """Return bounds of a function in every cell."""
        if name not in self._bounds:
            bernstein = _BERNSTEIN @ self.cells(name).reshape(-1, 4, 4) @ _BERNSTEIN.T
            shape = self.grid.cells, self.grid.stiffening
            self._bounds[name] = (
                bernstein.min(axis=(1, 2)).reshape(shape),
                bernstein.max(axis=(1, 2)).reshape(shape),
            )
        return self._bounds[name]

    def sides(self, name: str) -> list[Slopes]:
        """Return a function at the nodes on either side of the touch, with its derivatives."""
        if name not in self._sides:
            self._sides[name] = [_with_slopes(side) for side in self.nodes[name]]
        return self._sides[name]

    def _by_power(self, name: str) -> list[Array]:
        """Return the coefficients of every cell by their power along g, in rows of four."""
        if name not in self._quarters:
            cells = self.cells(name).reshape(-1, 4, 4)
            self._quarters[name] = [np.ascontiguousarray(cells[:, k]) for k in range(4)]
        return self._quarters[name]

    def _row(self, name: str, cell: int) -> tuple[float, ...]:
        """Return the coefficients of one cell as numbers, which are kept.

        They are those of `cells`, without computing all of them for whoever needs one.
        """
        rows = self._rows.setdefault(name, {})
        if cell not in rows:
            i, j = divmod(cell, self.grid.stiffening)
            past = i >= self.grid.short
            i -= self.grid.short * past
            four = [each[i : i + 2, j : j + 2].tolist() for each in self.sides(name)[past]]
            rows[cell] = _polynomial(four)
        return rows[cell]

    def _number(
        self, names: Sequence[str], log_g: float, log_alpha: float
    ) -> tuple[float, list[float]]:
        """Do the same as `Grid.place` and `_along` for one point, in one piece for speed."""
        line = self._lines.get(log_alpha) or self._line(log_alpha)
        touch, before, past, short, rows, _, _, cubics_of = line
        x = log_g - touch
        t = (before if x < 0.0 else past) * x + short
        row = int(t)
        if not 0 <= row < rows:
            row = 0 if row < 0 else rows - 1
        t -= row
        values = []
        for name in names:
            a, b, c, d = cubics_of.get((name, row)) or self._cubic(line, name, row)
            values.append(a + t * (b + t * (c + t * d)))
        return x, values

    def _line(self, log_alpha: float) -> NumberLine:
        """Return what numbers need of the grid at one alpha; the latest are kept."""
        grid, (low, high) = self.grid, self.grid.log_alpha
        touch = log_touch(grid.touch, log_alpha)
        s = (log_alpha - low) * (grid.stiffening / (high - low))
        column = min(max(int(s), 0), grid.stiffening - 1)
        if len(self._lines) >= _KEPT:
            self._lines.clear()
        rates = grid.short / (touch - grid.log_g), grid.past / grid.beyond
        line = NumberLine(touch, *rates, grid.short, grid.cells, column, s - column, {})
        self._lines[log_alpha] = line
        return line

    def _cubic(self, line: NumberLine, name: str, row: int) -> tuple[float, ...]:
        """Return the cubic along g of a cell at one alpha, which is kept."""
        s, cell = line.in_alpha, row * self.grid.stiffening + line.along_alpha
        a, a1, a2, a3, b, b1, b2, b3, c, c1, c2, c3, d, d1, d2, d3 = self._row(name, cell)
        cubic = line.cubics[name, row] = (
            a + s * (a1 + s * (a2 + s * a3)),
            b + s * (b1 + s * (b2 + s * b3)),
            c + s * (c1 + s * (c2 + s * c3)),
            d + s * (d1 + s * (d2 + s * d3)),
        )
        return cubic

    def _compiled(
        self, names: Sequence[str], log_g: Array, log_alpha: Array
    ) -> tuple[Array, list[Array]]:
        from surrogate.contact.compiled import at_points

        grid = self.grid
        low, high = grid.log_alpha
        counts = grid.short, grid.past, grid.stiffening
        steps = grid.log_g, grid.past / grid.beyond, low, grid.stiffening / (high - low)
        cells = tuple(self.cells(name) for name in names)
        x, values = at_points(cells, log_g, log_alpha, np.array(grid.touch), counts, steps)
        return x, list(values)

    def _scattered(self, names: Sequence[str], place: Place) -> list[Array]:
        index = place.along_g * self.grid.stiffening
        index += place.along_alpha
        t, s = place.in_g, place.in_alpha
        power, taken = np.empty(t.shape), np.empty((*t.shape, 4))
        found = []
        for name in names:
            quarters, result = self._by_power(name), np.empty(t.shape)
            cubics(quarters[3], index, s, result, taken)
            for quarter in quarters[2::-1]:
                cubics(quarter, index, s, power, taken)
                result *= t
                result += power
            found.append(result)
        return found

    def _along(self, name: str, place: Place) -> Array:
        """Return the function along g at one alpha."""
        result, taken = np.empty(place.in_g.shape), np.empty((*place.in_g.shape, 4))
        rows = self._collapse(name, place.along_alpha, place.in_alpha)
        cubics(rows, place.along_g, place.in_g, result, taken)
        return result

    def _collapse(self, name: str, j: int, s: float) -> Array:
        """Return the cubics that are left of the table at one alpha; the latest are kept."""
        found = self._collapsed.get((name, j, s))
        if found is None:
            c = self.cells(name).reshape(-1, self.grid.stiffening, 4, 4)[:, j].transpose(2, 0, 1)
            found = np.ascontiguousarray(c[0] + s * (c[1] + s * (c[2] + s * c[3])))
            if len(self._collapsed) >= _KEPT:
                self._collapsed.clear()
            self._collapsed[name, j, s] = found
        return found


def cubics(rows: Array, index: Any, x: Any, result: Array, taken: Array) -> None:
    """Put cubics into `result`, whose coefficients are rows of an array, by rising powers.

    Parameters
    ----------
    rows : ndarray, shape (cells, 4)
        The coefficients.
    index, x : ndarray, shape (points,)
        The row of each point, and where.
    result, taken : ndarray, shape (points,) and (points, 4)
        Where to put the values, and room for the rows of the points: to copy rows and to read them
        with strides takes less time than to gather each coefficient.

    Examples
    --------
    >>> result = np.empty(1)
    >>> row, first = np.array([[1.0, 2.0, 3.0, 4.0]]), np.array([0])
    >>> cubics(row, first, np.array([2.0]), result, np.empty((1, 4)))
    >>> result
    array([49.])
    """
    rows.take(index, axis=0, out=taken, mode="clip")  # clipping takes less time than checking
    np.multiply(taken[..., 3], x, out=result)
    result += taken[..., 2]
    for power in (1, 0):
        result *= x
        result += taken[..., power]


def _with_slopes(values: Array) -> Slopes:
    """Return values at nodes with the slopes of cubic splines."""
    by_g, by_alpha = _slopes(values.shape[0]) @ values, _slopes(values.shape[1])
    return Slopes(values, by_g, values @ by_alpha.T, by_g @ by_alpha.T)


def _coefficients(side: Slopes) -> Array:
    """Return the sixteen coefficients of powers along g and along alpha, one row for each cell."""
    rows, columns = side.values.shape
    corners = [
        [[nodes[i : rows - 1 + i, j : columns - 1 + j] for j in (0, 1)] for i in (0, 1)]
        for nodes in side
    ]
    return np.stack(_polynomial(corners), axis=-1).reshape(-1, 16)


def _polynomial(corners: Any) -> tuple[Any, ...]:
    """Return the coefficients of cells from value, slopes and mixed slope at their corners.

    Parameters
    ----------
    corners : sequence
        In the order of `Slopes`, each first by the end along g, then by that along alpha: floats,
        or arrays over cells, with the same digits.

    Returns
    -------
    tuple
        Of powers along g (slow) and along alpha (quick).
    """
    value, by_g, by_alpha, mixed = corners
    ends = [
        [_cubic(*plain[end], *slope[end]) for end in (0, 1)]
        for plain, slope in ((value, by_alpha), (by_g, mixed))
    ]
    powers = [_cubic(ends[0][0][m], ends[0][1][m], ends[1][0][m], ends[1][1][m]) for m in range(4)]
    return tuple(powers[m][k] for k in range(4) for m in range(4))


def _cubic(first: Any, last: Any, slope: Any, other: Any) -> tuple[Any, ...]:
    """Return the coefficients of the cubic of Hermite, of values and slopes at 0 and 1."""
    rise = last - first
    return (
        first,
        slope,
        3.0 * rise - 2.0 * slope - other,
        slope + other - 2.0 * rise,
    )


@cache
def _slopes(nodes: int) -> Array:
    """Return the matrix that makes slopes of the values at evenly spaced nodes, 4 or more.

    It is that of the cubic spline whose third derivative does not jump at the last nodes but one.
    """
    below, above = np.eye(nodes, k=-1), np.eye(nodes, k=1)
    left, right = 4.0 * np.eye(nodes) + below + above, 3.0 * (above - below)
    left[0, :2], right[0, :3] = (1.0, 2.0), (-2.5, 2.0, 0.5)
    left[-1, -2:], right[-1, -3:] = (2.0, 1.0), (-0.5, -2.0, 2.5)
    return np.asarray(np.linalg.solve(left, right))


@dataclass(frozen=True, eq=False)
class TableModel(FittedModel):
    """A, B and (delta/R_w - 1)/|x|^(7/4) on the cells of a grid, x = ln(g/g_touch).

    Parameters
    ----------
    limits : Domain
        Its domain.
    table : CellTable
        The functions "arc", "normal_load" and "distance".
    """

    limits: Domain
    table: CellTable = field(repr=False)
    name: str = "table"
    equation: str = "bicubic cells of the gp's mean"
    law: str = PROJECTED

    @property
    def functions(self) -> tuple[str, ...]:  # type: ignore[override]
        """Names of the functions that `contact` takes."""
        return tuple(self.table.nodes)

    def inside(self, names: Sequence[str], log_g: Any, log_alpha: Any, g: Any) -> list[Any]:
        x, values = self.table.at(names, log_g, log_alpha)
        if "distance" in names:
            which = names.index("distance")
            values[which] = 1.0 + vertex(x) * values[which]
        return values

    def inside_slopes(self, name: str, log_g: Any, log_alpha: Any) -> tuple[Any, Any, Any]:
        x, value, in_g, in_alpha = self.table.slopes(name, log_g, log_alpha)
        if name != "distance":
            return value, in_g, in_alpha
        _, bend = self.limits.log_touch_slopes(log_alpha)
        inner = where(x < 0.0, x, 1.0)
        shape = vertex(x)
        steep = POWER * shape / inner  # d |x|^(7/4)/dx
        return (
            1.0 + shape * value,
            where(x < 0.0, shape * in_g + steep * value, 0.0),
            where(x < 0.0, shape * in_alpha - steep * value * bend, 0.0),
        )

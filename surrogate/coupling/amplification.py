"""How many times its first order the force of friction and wear is, as they act on the body.

F_d = 2 mu R_w [(tau_w/mu) A* + xi B*] kappa(g, alpha, xi, tau_w/mu), with kappa = 1 without load:
ln kappa is a polynomial of x = ln(g/g_touch), y = ln alpha, xi and w = ln(1 + tau_w/mu) without
terms free of xi and w. It was fitted to coupled finite-element solutions in which the tip does not
touch the wire, and is known up to a share of 1 of the loads that they reach.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.elementwise import dense, log, taken, where
from surrogate.contact.bounds import interval
from surrogate.contact.coordinates import log_touch, log_touch_slope
from surrogate.coupling.polynomial import Polynomial

__all__ = ["LEAST_SHARE", "Amplification", "Place", "edge_of", "load_of"]

Array = NDArray[np.float64]

LEAST_SHARE = 0.3
"""Share of the largest known load below which the bound of kappa's error falls no further."""


class Place(NamedTuple):
    """Where loads are among the coupled solutions: what all else is looked up by.

    Parameters
    ----------
    known : bool or ndarray of bool
        Whether solutions reach to g, alpha and the load; also without a load only where they
        reach to g and alpha.
    x, y, xi, w : float or ndarray
        The variables of the polynomial.
    share : float or ndarray
        The load over the largest one that is known there; nan where none is.
    """

    known: Any
    x: Any
    y: Any
    xi: Any
    w: Any
    share: Any

    def at(self, mask: NDArray[np.bool_]) -> Place:
        """Return some of the places."""
        return Place(*taken(self, mask))


@dataclass(frozen=True, eq=False)
class Amplification:
    """The logarithm of kappa, where it is known, and how far it may be off.

    Parameters
    ----------
    touch : tuple of float
        Coefficients of ln g_touch in powers of ln alpha.
    polynomial : Polynomial
        ln kappa of x, y, xi and w.
    axes : tuple of ndarray
        Nodes in x, in y and of the direction of the load, which is 0 for friction alone and 1 for
        wear alone; where `reach` is known.
    reach : ndarray, shape of the axes
        The size of the largest load of each direction that is known.
    load_unit : tuple of float
        xi and tau_w/mu of a load of size 1 [-].
    edges : tuple of tuple of float
        Of the cells in x and in y.
    errors : ndarray, shape (cells in x, cells in y)
        Bound of |ln kappa - that of finite elements| at the largest load that is known; in
        proportion to the load down to 0.3 of that, and the same below.
    growth : ndarray, shape (cells in x, cells in y)
        Largest |ln kappa| over xi + w/10.
    about : mapping
        What is told of the data and the fit.
    lowest, highest : float
        The lowest and the highest g at which kappa is known [-].
    """

    touch: tuple[float, ...]
    polynomial: Polynomial
    axes: tuple[Array, Array, Array]
    reach: Array
    load_unit: tuple[float, float]
    edges: tuple[tuple[float, ...], tuple[float, ...]]
    errors: Array
    growth: Array
    about: Mapping[str, Any] = field(default_factory=dict, repr=False)
    lowest: float = 0.0
    highest: float = sys.float_info.max

    def most_wear(self, alpha: float) -> float:
        """Return the largest tau_w/mu of any steady solution near alpha, whatever the rest.

        nan where the file does not tell, or where wear was followed to the end of the campaign.
        """
        for low, high, wear in self.about.get("most_wear", ()):
            if low <= alpha <= high:
                return float(wear)
        return float("nan")

    def log_factor(self, g: Any, alpha: Any, xi: Any, wear: Any) -> Any:
        """Return ln kappa; with the nearest load, g and alpha that are known where these are not.

        Parameters
        ----------
        g, alpha, xi, wear : float or ndarray
            Gamma_o/(mu R_w), the stiffening exponent, the friction and tau_w/mu [-].
        """
        return self.polynomial(*self._at(g, alpha, xi, wear)[0])

    def factor_and_known(self, g: Any, alpha: Any, xi: Any, wear: Any) -> tuple[Any, Any]:
        """Return ln kappa, and whether it is known there or without any load."""
        variables, free = self._at(g, alpha, xi, wear)
        unloaded = (xi == 0.0) & (wear == 0.0)
        return self.polynomial(*variables), free | unloaded

    def slopes(self, g: Any, alpha: Any, xi: Any, wear: Any) -> tuple[Any, Any, Any, Any]:
        """Return the derivatives of ln kappa by ln g, ln alpha, xi and tau_w/mu."""
        variables, free = self._at(g, alpha, xi, wear)
        by_x, by_y, by_xi, by_w = (one(*variables) for one in self.polynomial.derivatives)
        in_g = where(free, by_x, 0.0)
        bend = log_touch_slope(self.touch, log(alpha))
        return (
            in_g,
            where(free, by_y - by_x * bend, 0.0),
            where(free, by_xi, 0.0),
            where(free, by_w / (1.0 + wear), 0.0),
        )

    def load_slopes(self, g: Any, alpha: Any, xi: Any, wear: Any) -> tuple[Any, Any, Any]:
        """Return ln kappa and its derivatives by xi and tau_w/mu, 0 beyond what is known."""
        variables, free = self._at(g, alpha, xi, wear)
        _, _, by_xi, by_w = self.polynomial.derivatives
        return (
            self.polynomial(*variables),
            where(free, by_xi(*variables), 0.0),
            where(free, by_w(*variables) / (1.0 + wear), 0.0),
        )

    def share(self, g: Any, alpha: Any, xi: Any, wear: Any) -> Any:
        """Return the load over the largest one that is known there; infinite outside g and alpha.

        0 without any load.
        """
        return self._share(*self._place(g, alpha), xi, wear)

    def share_at(self, x: Any, y: Any, xi: Any, wear: Any) -> Any:
        """Return the same at x = ln(g/g_touch) and y = ln alpha."""
        return self._share(x, y, x + log_touch(self.touch, y), xi, wear)

    def _share(self, x: Any, y: Any, log_g: Any, xi: Any, wear: Any) -> Any:
        inside = self._inside(x, y, log_g)
        size, direction = load_of(xi, wear, self.load_unit)
        with np.errstate(all="ignore"):
            share = np.divide(size, self.reach_at(*self._clamped(x, y), direction))
        return where(size == 0.0, 0.0, where(inside, share, np.inf))

    def error(self, g: Any, alpha: Any, xi: Any, wear: Any) -> Any:
        """Return the bound of the error of ln kappa; nan where it is not known."""
        return self._where_known(self.error_at, g, alpha, xi, wear)

    def most(self, g: Any, alpha: Any, xi: Any, wear: Any) -> Any:
        """Return a bound of |ln kappa|; nan where it is not known."""
        return self._where_known(self.most_at, g, alpha, xi, wear)

    def _where_known(self, bound: Callable[[Place], Any], *load: Any) -> Any:
        """Return a bound, nan where kappa is not known and 0 without load, where it is 1."""
        place = self.place(*load)
        value = bound(place) if np.any(place.known) else np.nan
        unloaded = np.equal(load[2], 0.0) & np.equal(load[3], 0.0)
        value = where(unloaded, 0.0, where(place.known, value, np.nan))
        shape = np.broadcast_shapes(*map(np.shape, load))
        return value + np.zeros(shape) if shape else value

    def place(self, g: Any, alpha: Any, xi: Any, wear: Any) -> Place:
        """Return where a load is, and whether solutions reach there.

        Examples
        --------
        >>> from surrogate.coupling.shipped import amplification
        >>> kappa = amplification()
        >>> here = kappa.place(0.1, 6.0, 0.01, 0.02)
        >>> here.known, kappa.log_at(here) == kappa.log_factor(0.1, 6.0, 0.01, 0.02)
        (True, True)
        """
        size, direction = load_of(xi, wear, self.load_unit)
        near = size <= self._largest_reach
        if near is False or not (near is True or np.any(near)):
            return Place(False, g, alpha, xi, wear, np.nan)
        x, y, log_g = self._place(g, alpha)
        inside = self._inside(x, y, log_g)
        if inside is False or not (inside is True or np.any(inside)):
            return Place(inside, x, y, xi, wear, np.nan)
        reach = self.reach_at(*self._clamped(x, y), direction)
        if type(reach) is type(size) is float:
            share = size / reach if reach else where(size == 0.0, 0.0, np.inf)
        else:
            with np.errstate(all="ignore"):
                share = where(size == 0.0, 0.0, np.divide(size, reach))
        return Place(inside & (size <= reach), x, y, xi, _log1p(wear), share)

    @cached_property
    def _largest_reach(self) -> float:
        return float(self.reach.max())

    def log_at(self, place: Place) -> Any:
        """Return ln kappa at places that are known."""
        return self.polynomial(*place[1:5])

    def error_at(self, place: Place) -> Any:
        """Return the bound of the error of ln kappa at places that are known."""
        bound = self._in_cell(self._errors, place.x, place.y)
        return bound * _between(place.share, LEAST_SHARE, 1.0)

    def most_at(self, place: Place) -> Any:
        """Return a bound of |ln kappa| at places that are known."""
        return self._in_cell(self._growth, place.x, place.y) * (place.xi + 0.1 * place.w)

    @cached_property
    def _errors(self) -> CellValues:
        return CellValues(self.errors)

    @cached_property
    def _growth(self) -> CellValues:
        return CellValues(self.growth)

    def _in_cell(self, table: CellValues, x: Any, y: Any) -> Any:
        return table.at(*self._cell(x, y))

    def _inside(self, x: Any, y: Any, log_g: Any) -> Any:
        (left, right), (low, high), (first, last) = self._ends
        inside = (x >= left) & (x <= right) & (y >= low) & (y <= high)
        return inside & (log_g >= first) & (log_g <= last)

    def drift(self, g: Any, alpha: Any, xi: Any, wear: Any) -> Any:
        """Return how far ln kappa of the nearest load and g that are known may be off beyond them.

        Over the load that is not reached it may go on at the largest rate of the cell, and so for
        each factor e in g; 0 where kappa is known, infinite at alphas where it is not.
        """
        left_x, left_y, log_g = self._place(g, alpha)
        x, y = self._clamped(left_x, left_y)
        size, direction = load_of(xi, wear, self.load_unit)
        whole = self._in_cell(self._growth, left_x, left_y) * (xi + 0.1 * _log1p(wear))
        low, high = self._ends[2]
        with np.errstate(all="ignore"):
            left = np.maximum(size - self.reach_at(x, y, direction), 0.0) / size
            apart = np.maximum(np.abs(left_x - x), np.maximum(low - log_g, log_g - high))
            drift = np.where(left_y == y, whole * (left + apart), np.inf)
        return np.where(np.equal(size, 0.0), 0.0, drift)

    @property
    def exponents(self) -> tuple[float, float]:
        """The smallest and the largest alpha at which kappa is known."""
        low, high = self._ends[1]
        return float(np.exp(low)), float(np.exp(high))

    def near_error(self, g: Any, alpha: Any) -> Any:
        """Return the bound of the error of ln kappa in the nearest cell, whatever the load."""
        x, y, _ = self._place(g, alpha)
        return self._in_cell(self._errors, x, y)

    def _place(self, g: Any, alpha: Any) -> tuple[Any, Any, Any]:
        """Return ln(g/g_touch), ln alpha and ln g."""
        log_g, y = log(g), log(alpha)
        return log_g - log_touch(self.touch, y), y, log_g

    @cached_property
    def _ends(self) -> tuple[tuple[float, float], tuple[float, float], tuple[float, float]]:
        """The ends of what is known in x, in y and in ln g."""
        x, y, _ = self.axes
        with np.errstate(divide="ignore"):
            ends = float(np.log(self.lowest)) - 1e-9, float(np.log(self.highest)) + 1e-9
        return (float(x[0]), float(x[-1])), (float(y[0]), float(y[-1])), ends

    def _clamped(self, x: Any, y: Any) -> tuple[Any, Any]:
        (left, right), (low, high), _ = self._ends
        return _between(x, left, right), _between(y, low, high)

    def _at(self, g: Any, alpha: Any, xi: Any, wear: Any) -> tuple[tuple[Any, ...], Any]:
        """Return the variables of the polynomial, and whether they are free to move."""
        x, y, log_g = self._place(g, alpha)
        inside = self._inside(x, y, log_g)
        x, y = self._clamped(x, y)
        size, direction = load_of(xi, wear, self.load_unit)
        reach = self.reach_at(x, y, direction)
        known = size <= reach
        if known is not True:
            most = edge_of(direction, self.load_unit)
            xi, wear = where(known, xi, reach * most[0]), where(known, wear, reach * most[1])
        return (x, y, xi, _log1p(wear)), inside & known

    def reach_at(self, x: Any, y: Any, direction: Any) -> Any:
        """Return the reach between its nodes, linear in each of the three."""
        along_x, along_y, around = self._steps
        (i, s), (j, t), (k, u) = _node(along_x, x), _node(along_y, y), _node(around, direction)
        if type(j) is int and type(k) is int:
            if type(i) is int:
                rows = self._rows
                first, last = _across(rows[i], j, k, t, u), _across(rows[i + 1], j, k, t, u)
            else:  # which leaves a function of x
                along = _across(self.reach.transpose(1, 2, 0), j, k, t, u)
                first, last = along[i], along[i + 1]
        else:
            first, last = (
                _across(self.reach.transpose(1, 2, 0), *np.broadcast_arrays(j, k), t, u, i + a)
                for a in (0, 1)
            )
        return (1.0 - s) * first + s * last

    @cached_property
    def _steps(self) -> list[tuple[float, float, int]]:
        """Of each axis the first node, the step and the number of the last interval."""
        return [(float(a[0]), float(a[1] - a[0]), len(a) - 2) for a in self.axes]

    @cached_property
    def _rows(self) -> list[list[list[float]]]:
        """The reach as numbers."""
        return self.reach.tolist()  # type: ignore[no-any-return]

    def in_cell(self, cell: tuple[int, int], x: Array, y: Array) -> NDArray[np.bool_]:
        """Return which points are in a cell of `errors` and `growth`."""
        rows, columns = self._cell(x, y)
        return np.asarray((rows == cell[0]) & (columns == cell[1]))

    def _cell(self, x: Any, y: Any) -> tuple[Any, Any]:
        return interval(self.edges[0], x), interval(self.edges[1], y)


class CellValues:
    """A number for each cell, of points in some cells.

    Parameters
    ----------
    values : ndarray, shape (cells in x, cells in y)
        The numbers.

    Examples
    --------
    >>> of = CellValues(np.array([[1.0, 2.0], [3.0, 4.0]]))
    >>> of.at(1, 0), of.at(np.array([0, 1]), 1).tolist()
    (3.0, [2.0, 4.0])
    """

    def __init__(self, values: Array) -> None:
        self._columns = values.shape[1]
        self._flat = values.ravel()
        self._numbers: list[float] = self._flat.tolist()

    def at(self, row: Any, column: Any) -> Any:
        """Return the numbers of cells."""
        if type(row) is type(column) is int:
            return self._numbers[row * self._columns + column]
        return self._flat.take(np.multiply(row, self._columns, dtype=np.intp) + column)


def load_of(xi: Any, wear: Any, largest: tuple[float, float]) -> tuple[Any, Any]:
    """Return the size of loads, the larger of both in their units, and their direction.

    The direction is 0 for friction alone and 1 for wear alone.

    Examples
    --------
    >>> load_of(0.25, 2.5, (0.5, 10.0))
    (0.5, 0.25)
    """
    rubbed, worn = xi / largest[0], wear / largest[1]
    if type(rubbed) is float and type(worn) is float:  # the same, and quicker
        if rubbed > worn:
            return rubbed, 0.5 * worn / rubbed
        return worn, 1.0 - 0.5 * rubbed / (worn or 1.0)
    size = where(np.greater(rubbed, worn), rubbed, worn)
    with np.errstate(all="ignore"):
        by_wear, by_friction = (
            0.5 * part / where(size == 0.0, 1.0, size) for part in (worn, rubbed)
        )
        direction = where(np.greater(rubbed, worn), by_wear, 1.0 - by_friction)
    return size, direction


def _across(table: Any, j: Any, k: Any, t: Any, u: Any, *i: Any) -> Any:
    """Return a table between its nodes in y and in the direction."""
    if i:
        a, b, c, d = (table[(j + m, k + n, *i)] for m in (0, 1) for n in (0, 1))
    else:
        near, far = table[j], table[j + 1]
        a, b, c, d = near[k], near[k + 1], far[k], far[k + 1]
    return (1.0 - t) * ((1.0 - u) * a + u * b) + t * ((1.0 - u) * c + u * d)


def edge_of(direction: Any, largest: tuple[float, float]) -> tuple[Any, Any]:
    """Return the load of size 1 in a direction.

    Examples
    --------
    >>> edge_of(0.25, (0.5, 10.0))
    (0.5, 5.0)
    """
    return (
        largest[0] * _between(2.0 - 2.0 * direction, 0.0, 1.0),
        largest[1] * _between(2.0 * direction, 0.0, 1.0),
    )


def _between(value: Any, low: float, high: float) -> Any:
    if type(value) is float:
        return value if low <= value <= high else min(max(value, low), high)
    return np.minimum(np.maximum(value, low), high)


def _node(axis: tuple[float, float, int], value: Any) -> tuple[Any, Any]:
    """Return the number of the interval of an even axis and the place in it."""
    first, step, last = axis
    place = (value - first) / step
    if type(place) is float:
        number = int(place) if place == place else 0
        if not 0 <= number <= last:
            number = 0 if number < 0 else last
        return number, place - number
    numbers = np.fmin(np.fmax(place, 0.0), last).astype(np.intp)
    return numbers, place - numbers


def _log1p(x: Any) -> Any:
    return float(np.log1p(x)) if type(x) is float else np.log1p(dense(x))

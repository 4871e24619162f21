"""How far each model may be from finite elements: measured bounds over cells of (g, alpha)."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.elementwise import exp, log
from surrogate.contact.coordinates import log_touch

__all__ = ["Bounds", "interval"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Bounds:
    """Bounds of |ln(model/truth)| of A, B and delta, constant in each cell.

    Parameters
    ----------
    g, alpha : sequence of float
        Edges of the cells, rising; the outer ones are the ends of the domain [-].
    errors : mapping of str to mapping of str to ndarray
        By model and by function "arc", "normal_load" or "distance", shape (cells in g, cells in
        alpha) [-].
    touch : sequence of float
        Coefficients of ln g_touch in powers of ln alpha where the edges in g are those of
        g/g_touch, for functions that jump there; by default they are those of g itself.

    Examples
    --------
    >>> bounds = Bounds((0.01, 1.0, 100.0), (2.0, 9.0), {"eq13": {"arc": np.array([[0.5], [0.4]])}})
    >>> print(bounds.at("eq13", "arc", np.array([0.1, 1.0, 200.0]), np.array([2.0, 3.0, 2.0])))
    [0.5 0.4 inf]
    """

    g: Sequence[float]
    alpha: Sequence[float]
    errors: Mapping[str, Mapping[str, Array]]
    touch: Sequence[float] = ()

    @property
    def cells(self) -> int:
        """Number of cells, which is also the number of what is outside."""
        return (len(self.g) - 1) * (len(self.alpha) - 1)

    def cell(self, g: Any, alpha: Any) -> Any:
        """Return the number of the cell of points, floats or arrays."""
        if self.touch:
            g = exp(log(g) - log_touch(self.touch, log(alpha)))
        row, inside = _place(self.g, g)
        column, within = _place(self.alpha, alpha)
        columns = len(self.alpha) - 1
        if type(row) is int and type(column) is int:
            return row * columns + column if inside and within else self.cells
        cell = np.asarray(row, np.intp) * columns + column
        if inside is not True or within is not True:
            return np.where(np.logical_and(inside, within), cell, self.cells)
        return cell

    def by_cell(self, model: str, function: str) -> Array:
        """Return the bounds by the number of the cell, the last one infinite."""
        return np.append(self.errors[model][function].ravel(), np.inf)

    def at(self, model: str, function: str, g: Array, alpha: Array) -> Array:
        """Return the bound at points; infinite outside the domain."""
        return np.asarray(self.by_cell(model, function)[self.cell(g, alpha)])

    def largest(self, model: str, functions: Sequence[str]) -> float:
        """Return the largest bound of functions over all cells."""
        return max(float(np.max(self.errors[model][name])) for name in functions)

    def of_force(self, model: str) -> float:
        """Return the bound of the relative errors of A and B, and so of a force, over all cells."""
        return math.expm1(self.largest(model, ("arc", "normal_load")))

    def as_dict(self) -> dict[str, Any]:
        """Return plain lists, of which `from_dict` makes the bounds again."""
        errors = {
            model: {name: _plain(values) for name, values in functions.items()}
            for model, functions in self.errors.items()
        }
        return {
            "g": list(self.g),
            "alpha": list(self.alpha),
            "touch": list(self.touch),
            "errors": errors,
        }

    @classmethod
    def from_dict(cls, numbers: Mapping[str, Any]) -> Bounds:
        """Return the bounds of which `as_dict` gave the numbers."""
        shape = len(numbers["g"]) - 1, len(numbers["alpha"]) - 1
        errors = {
            model: {name: _known(values).reshape(shape) for name, values in each.items()}
            for model, each in numbers["errors"].items()
        }
        edges = tuple(numbers["g"]), tuple(numbers["alpha"])
        return cls(*edges, errors, tuple(numbers.get("touch", ())))


def _plain(values: Array) -> list[list[float | None]]:
    """Return rounded numbers, with None for an infinite one, where nothing is known."""
    rounded: list[list[float]] = np.round(values, 7).tolist()
    return [[number if math.isfinite(number) else None for number in row] for row in rounded]


def _known(values: Any) -> Array:
    numbers = np.array(values, float)
    return np.where(np.isnan(numbers), np.inf, numbers)


def _place(edges: Sequence[float], value: Any) -> tuple[Any, Any]:
    """Return the interval of values, and whether they are between the outer edges.

    The latter is True, no array, where all of them are.
    """
    first, last, place = edges[0], edges[-1], interval(edges, value)
    if type(value) is float:
        return place, first <= value <= last
    if not value.size or (value.min() >= first and value.max() <= last):
        return place, True
    return place, (value >= first) & (value <= last)


def interval(edges: Sequence[float], value: Any) -> Any:
    """Return the number of the interval that values are in, the first or last one if in none.

    Examples
    --------
    >>> interval((0.0, 1.0, 2.0), 1.0), interval((0.0, 1.0, 2.0), np.array([-1.0, 5.0])).tolist()
    (1, [0, 1])
    """
    if type(value) is float:
        return bisect_right(edges, value, 1, len(edges) - 1) - 1
    place = np.zeros(np.shape(value), np.uint8)  # of few bytes, for speed
    for edge in edges[1:-1]:
        place += np.greater_equal(value, edge).view(np.uint8)
    return place

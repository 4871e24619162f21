"""How far each model may be from finite elements: measured bounds over cells of (g, alpha)."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["Bounds"]

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

    Examples
    --------
    >>> bounds = Bounds((0.01, 1.0, 100.0), (2.0, 9.0), {"eq13": {"arc": np.array([[0.5], [0.4]])}})
    >>> print(bounds.at("eq13", "arc", np.array([0.1, 1.0, 200.0]), np.array([2.0, 3.0, 2.0])))
    [0.5 0.4 inf]
    """

    g: Sequence[float]
    alpha: Sequence[float]
    errors: Mapping[str, Mapping[str, Array]]

    def at(self, model: str, function: str, g: Array, alpha: Array) -> Array:
        """Return the bound at points; infinite outside the domain."""
        row, inside = _cell(self.g, g)
        column, within = _cell(self.alpha, alpha)
        return np.where(inside & within, self.errors[model][function][row, column], np.inf)

    def largest(self, model: str, functions: Sequence[str]) -> float:
        """Return the largest bound of functions over all cells."""
        return max(float(np.max(self.errors[model][name])) for name in functions)

    def of_force(self, model: str) -> float:
        """Return the bound of the relative errors of A and B, and so of a force, over all cells."""
        return math.expm1(self.largest(model, ("arc", "normal_load")))

    def as_dict(self) -> dict[str, Any]:
        """Return plain lists, of which `from_dict` makes the bounds again."""
        errors = {
            model: {name: np.round(values, 7).tolist() for name, values in functions.items()}
            for model, functions in self.errors.items()
        }
        return {"g": list(self.g), "alpha": list(self.alpha), "errors": errors}

    @classmethod
    def from_dict(cls, numbers: Mapping[str, Any]) -> Bounds:
        """Return the bounds of which `as_dict` gave the numbers."""
        shape = len(numbers["g"]) - 1, len(numbers["alpha"]) - 1
        errors = {
            model: {name: np.array(values, float).reshape(shape) for name, values in each.items()}
            for model, each in numbers["errors"].items()
        }
        return cls(tuple(numbers["g"]), tuple(numbers["alpha"]), errors)


def _cell(edges: Sequence[float], value: Array) -> tuple[NDArray[np.intp], NDArray[np.bool_]]:
    """Return the cell of values, and whether they are between the outer edges."""
    inner = np.asarray(edges)[1:-1]
    return np.searchsorted(inner, value, side="right"), (value >= edges[0]) & (value <= edges[-1])

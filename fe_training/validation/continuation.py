"""How far the models are off above their highest g, where their asymptotes continue them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fe_training.fitting.bounds import ALPHA_EDGES, SHARP
from fe_training.fitting.points import FitPoints
from surrogate.contact.bounds import Bounds
from surrogate.contact.coordinates import SLIP_QUANTITIES
from surrogate.contact.fitted import FittedModel
from surrogate.contact.shipped import Fitted

__all__ = ["FACTORS", "Continued", "continued"]

Floats = NDArray[np.float64]

FACTORS = (1.0, 1.5, 2.0, 3.0, 5.0, 10.0)
"""Edges of the cells, in g over the highest g."""

_ROUNDING = 1.0 + 1e-6


@dataclass(frozen=True, slots=True)
class Continued:
    """The errors above the highest g.

    Parameters
    ----------
    count : int
        Solutions there; none of them was used in fitting.
    bounds : Bounds
        By model and function, over g/(highest g) and alpha: the largest relative error of the
        solutions up to there, each with its own error bar [-]; infinite where no solution reaches
        the end of the cell.
    """

    count: int
    bounds: Bounds

    def as_dict(self) -> dict[str, Any]:
        """Return what goes into the file of the models."""
        return {"count": self.count, **self.bounds.as_dict()}


def continued(fitted: Fitted, points: FitPoints) -> Continued | None:
    """Return the errors at points above the highest g; None where there are none.

    Past the touch A* and B* at small alpha depend on the size of the tip: there they are unknown.

    Parameters
    ----------
    fitted : Fitted
        The models, fitted without these points.
    points : FitPoints
        Where the truth is known; those outside otherwise do not count.
    """
    first, last = fitted.limits.alpha
    ratio = points.g / fitted.limits.highest_g(points.alpha)
    above = (ratio > 1.0) & (points.alpha >= first) & (points.alpha <= last)
    if not np.any(above):
        return None
    points, ratio = points.taken(above), ratio[above]
    edges = (first, *(edge for edge in ALPHA_EDGES if first < edge < last), last)
    errors = {
        name: {
            function: _by_cell(off, ratio, points.alpha, edges, function)
            for function, off in _errors(model, points).items()
        }
        for name, model in fitted.models.items()
    }
    return Continued(len(points), Bounds(FACTORS, edges, errors))


def _errors(model: FittedModel, points: FitPoints) -> Mapping[str, Floats]:
    """Return relative errors of the functions of a model, with the solutions' own error bars."""
    found = model.contact(points.names, points.g, points.alpha)
    return {
        name: np.abs(value / getattr(points, name) - 1.0) + points.relative_std(name)
        for name, value in zip(points.names, found, strict=True)
    }


def _by_cell(
    errors: Floats, ratio: Floats, alpha: Floats, edges: tuple[float, ...], function: str
) -> Floats:
    """Return the largest error up to the end of each cell, infinite where none reaches it."""
    cells = np.full((len(FACTORS) - 1, len(edges) - 1), np.inf)
    for column, (low, high) in enumerate(pairwise(edges)):
        here = (alpha >= low) & (alpha <= high)
        if not here.any() or (function in SLIP_QUANTITIES and high <= SHARP):
            continue
        for row, end in enumerate(FACTORS[1:]):
            if ratio[here].max() * _ROUNDING >= end:
                cells[row, column] = errors[here & (ratio <= end * _ROUNDING)].max(initial=0.0)
    return cells

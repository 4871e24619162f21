"""How far the models are off above their highest g, where their asymptotes continue them."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from fe_training.fitting.bounds import ALPHA_EDGES, SHARP
from fe_training.fitting.points import FitPoints
from fe_training.validation.model_errors import Continued, contact_errors
from surrogate.contact.bounds import Bounds
from surrogate.contact.coordinates import SLIP_QUANTITIES
from surrogate.contact.shipped import Fitted

__all__ = ["FACTORS", "continued"]

Floats = NDArray[np.float64]

FACTORS = (1.0, 1.5, 2.0, 3.0, 5.0, 10.0)
"""Edges of the cells, in g over the highest g."""

_ROUNDING = 1.0 + 1e-6


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
            function: _by_cell(
                np.abs(off) + points.relative_std(function), ratio, points.alpha, edges, function
            )
            for function, off in contact_errors(model, points).items()
        }
        for name, model in fitted.models.items()
    }
    return Continued(len(points), Bounds(FACTORS, edges, errors))


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

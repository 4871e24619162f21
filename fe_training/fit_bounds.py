"""Bounds of the models' errors over cells of (g, alpha), from the campaign alone.

The processes and the table: the largest error of any point of a cell when it, or its whole alpha,
is predicted from the others. The formulas: their largest distance from the table on a fine grid of
the cell, and the table's own bound.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from surrogate.bounds import Bounds
from surrogate.force_models import FORCE_MODELS, ForceModel
from surrogate.gaussian_process import GaussianProcess
from surrogate.quantities import QUANTITIES

from .fit_gp import leave_out_errors
from .fit_points import FitPoints

__all__ = ["fit_bounds", "left_out_errors"]

Floats = NDArray[np.float64]

ALPHA_EDGES = (2.0, 3.0, 5.0, 9.0)
G_EDGES = (2.5e-3, 0.1, 0.5, 2.0, 10.0, 100.0)
_GRID = 24  # points of a cell along each direction


def fit_bounds(
    points: FitPoints,
    processes: Mapping[str, GaussianProcess],
    models: Mapping[str, ForceModel],
) -> Bounds:
    """Return the bounds of all models that "auto" chooses among.

    Parameters
    ----------
    points : FitPoints
        What was computed.
    processes : mapping of str to GaussianProcess
        The fitted processes.
    models : mapping of str to ForceModel
        The fitted models.

    Returns
    -------
    Bounds
    """
    g_edges = _edges(G_EDGES, points.g)
    alpha_edges = _edges(ALPHA_EDGES, points.alpha)
    shape = len(g_edges) - 1, len(alpha_edges) - 1
    left_out = left_out_errors(points, processes)
    errors: dict[str, dict[str, Floats]] = {
        name: {} for name in ("eq13", "power-law", "table", "gp")
    }
    formulas = {"eq13": FORCE_MODELS["eq13"], "power-law": models["power-law"]}
    for function in QUANTITIES:
        own = np.zeros(shape)
        for row, column in np.ndindex(shape):
            inside = _inside(points, g_edges[row : row + 2], alpha_edges[column : column + 2])
            some = left_out[function][inside]
            own[row, column] = np.max(some, initial=0.0)
        own[own == 0.0] = np.max(own)  # a cell without a point is as doubtful as the worst
        apart = {name: np.zeros(shape) for name in ("eq13", "power-law", "gp")}
        for row, column in np.ndindex(shape):
            g, alpha = _grid(g_edges[row : row + 2], alpha_edges[column : column + 2])
            truth = models["table"].contact((function,), g, alpha)[0]
            for name, model in (*formulas.items(), ("gp", models["gp"])):
                value = np.broadcast_to(model.contact((function,), g, alpha)[0], g.shape)
                apart[name][row, column] = np.max(np.abs(np.log(value / truth)))
        errors["gp"][function] = own
        errors["table"][function] = own + apart["gp"]
        for name in formulas:
            errors[name][function] = apart[name] + errors["table"][function]
    return Bounds(g_edges, alpha_edges, errors)


def left_out_errors(
    points: FitPoints, processes: Mapping[str, GaussianProcess]
) -> dict[str, Floats]:
    """Return |ln(predicted/computed)| of A, B and delta at each point left out.

    The larger one of leaving out the point and of leaving out its alpha; the first and last alpha
    are not left out, which would be extrapolation.
    """
    found = {}
    for name, process in processes.items():
        rows = _rows_of(process, points)
        alone = np.abs(leave_out_errors(process, np.arange(len(rows)))[0])
        alpha = points.alpha[rows]
        group = np.abs(leave_out_errors(process, alpha)[0])
        ends = (alpha == alpha.min()) | (alpha == alpha.max())
        error = np.where(ends, alone, np.maximum(alone, group))
        if name == "distance":
            # delta - 1 errs by this factor; near the touch and beyond, which the process does not
            # have, delta is given within what is left of it
            gap = points.distance - 1.0
            full = np.abs(gap)
            full[rows] = np.minimum(gap[rows] * np.expm1(error), 1e3)
            found[name] = np.log1p(full / points.distance)
        else:
            full = np.zeros(len(points))
            full[rows] = error
            found[name] = full
    return found


def _rows_of(process: GaussianProcess, points: FitPoints) -> NDArray[np.intp]:
    """Return which of the points a process has, in the order that it has them."""
    where = {
        pair: i for i, pair in enumerate(zip(np.log(points.g), np.log(points.alpha), strict=True))
    }
    return np.array([where[g, alpha] for g, alpha in process.inputs[:, :2]], dtype=np.intp)


def _edges(wanted: tuple[float, ...], values: Floats) -> tuple[float, ...]:
    """Return edges whose ends are those of the values."""
    low, high = float(values.min()), float(values.max())
    return (low, *(edge for edge in wanted if low < edge < high), high)


def _inside(points: FitPoints, g: tuple[float, ...], alpha: tuple[float, ...]) -> NDArray[np.bool_]:
    within = (points.g >= g[0]) & (points.g <= g[1])
    return np.asarray(within & (points.alpha >= alpha[0]) & (points.alpha <= alpha[1]))


def _grid(g: tuple[float, ...], alpha: tuple[float, ...]) -> tuple[Floats, Floats]:
    mesh = np.meshgrid(np.geomspace(g[0], g[1], _GRID), np.linspace(alpha[0], alpha[1], _GRID))
    return mesh[0].ravel(), mesh[1].ravel()

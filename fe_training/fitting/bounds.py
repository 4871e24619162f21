"""Bounds of the models' errors over cells of (g, alpha), from the campaign alone.

The processes and the table: the largest error of any point of a cell when it, or its whole alpha,
is predicted from the others, times a factor of safety; where the touch of the tip is in the cell,
also what its error does. The formulas: their largest distance from the table on a fine grid of
the cell, and the table's own bound.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from fe_training.fitting.points import FitPoints
from fe_training.fitting.process import leave_out_errors, rows_of
from fe_training.fitting.touch import Touch
from surrogate.contact.base import ForceModel
from surrogate.contact.bounds import Bounds
from surrogate.contact.closed_forms import FORCE_MODELS
from surrogate.contact.coordinates import (
    AT_THE_TIP,
    QUANTITIES,
    SLIP_QUANTITIES,
    coordinates_of,
    log_touch,
    tip_slope,
)
from surrogate.contact.process import GaussianProcess

__all__ = ["fit_bounds", "fit_slip_bounds", "left_out_errors"]

Floats = NDArray[np.float64]

ALPHA_EDGES = (2.0, 3.0, 5.0, 9.0)
G_EDGES = (2.5e-3, 0.1, 0.5, 2.0, 10.0, 100.0, 300.0, 1000.0)
PROJECTED_TWIN = dict(zip(SLIP_QUANTITIES, QUANTITIES, strict=False))
"""What the closed forms have in the place of A* and B*: A and B, whose errors count as theirs."""

SAFETY = 2.0
"""How many times the largest error of a few dozen points of a cell the largest of all may be."""

RATIO_EDGES = (1e-3, 1e-2, 0.1, 0.25, 0.5, 0.8), (1.5, 3.0, 10.0, 30.0)
"""Edges in g/g_touch of the cells of A* and B*, on either side of the touch."""

FEWEST_UNSEEN = 3
"""Points that no fit saw from which on a cell is judged by them."""

DOUBT = 2.0
"""How many standard errors of ln g_touch from it A* and B*, which jump there, are not known."""

SHARP = 3.0
"""Up to this alpha A* and B* past the touch have no limit, or none that is near, as the tip gets
sharper: by up to 13 % for each factor of e in its radius at alpha = 2, 3 % at 2.5, below 0.7 % from
3.1 on."""

_GRID = 24  # points of a cell along each direction


def fit_bounds(
    points: FitPoints,
    touch: Touch,
    processes: Mapping[str, GaussianProcess],
    models: Mapping[str, ForceModel],
) -> Bounds:
    """Return the bounds of all models that "auto" chooses among.

    Parameters
    ----------
    points : FitPoints
        What was computed.
    touch : Touch
        g_touch(alpha).
    processes : mapping of str to GaussianProcess
        The fitted processes.
    models : mapping of str to ForceModel
        The fitted models.

    Returns
    -------
    Bounds
    """
    edges = _edges(G_EDGES, points.g), _edges(ALPHA_EDGES, points.alpha)
    left_out = left_out_errors(points, processes)
    errors: dict[str, dict[str, Floats]] = {name: {} for name in ("eq13", *models)}
    for function in points.names:
        known = {"eq13": FORCE_MODELS["eq13"], **models}
        found = {name: np.zeros([len(each) - 1 for each in edges]) for name in known}
        own = _own_errors(points, left_out[function], edges)
        for cell in np.ndindex(own.shape):
            g, alpha = (each[i : i + 2] for each, i in zip(edges, cell, strict=True))
            bound = SAFETY * own[cell] + _bend_error(function, processes[function], touch, g, alpha)
            at = _grid(g, alpha)
            table = models["table"].contact((function,), *at)[0]
            apart = {name: _apart(model, function, at, table) for name, model in known.items()}
            found["gp"][cell] = bound
            found["table"][cell] = bound + apart["gp"]
            for name in apart.keys() - {"gp", "table"}:
                found[name][cell] = found["table"][cell] + apart[name]
        for name, values in found.items():
            errors[name][function] = values
    return Bounds(*edges, errors)


def fit_slip_bounds(
    points: FitPoints,
    touch: Touch,
    processes: Mapping[str, GaussianProcess],
    models: Mapping[str, ForceModel],
    off_grid: FitPoints | None = None,
) -> Bounds:
    """Return the bounds of A* and B* over g/g_touch, as both change abruptly where the tip touches.

    Nearer to the touch than a few of its own standard errors nothing is known, nor past it where
    the size of the tip decides. A cell with a few points that no fit saw has their largest error,
    others that of points and alphas left out, times the factor of safety.

    Parameters
    ----------
    points, touch, processes, models
        As for `fit_bounds`.
    off_grid : FitPoints, optional
        Points that no fit saw.

    Returns
    -------
    Bounds
        Infinite where nothing is known.
    """
    near = float(np.exp(DOUBT * touch.error))
    wanted = (*RATIO_EDGES[0], 1.0 / near, near, *RATIO_EDGES[1])
    edges = _edges(wanted, _corners(points, touch)), _edges(ALPHA_EDGES, points.alpha)
    left_out = left_out_errors(points, processes)
    scaled = replace(points, g=_ratio(points.g, points.alpha, touch))
    unseen = _unseen(off_grid, touch, models["gp"])
    judged = np.zeros([len(each) - 1 for each in edges], bool)
    if unseen is not None:
        judged = _counted(unseen[0], edges) >= FEWEST_UNSEEN
    errors: dict[str, dict[str, Floats]] = {name: {} for name in ("eq13", *models)}
    for function in SLIP_QUANTITIES:
        own = _own_errors(scaled, left_out[function], edges)
        if unseen is not None:
            others, errors_there = unseen
            own = np.where(judged, _own_errors(others, errors_there[function], edges), own)
        found = {name: np.full(own.shape, np.inf) for name in errors}
        for cell in np.ndindex(own.shape):
            q, alpha = (each[i : i + 2] for each, i in zip(edges, cell, strict=True))
            if (q[0] < 1.0 < q[1]) or (q[0] > 1.0 and alpha[1] <= SHARP):
                continue
            ratio, alphas = _grid(q, alpha)
            at = _inside(models["table"], ratio * _touching(alphas, touch), alphas)
            if not at[0].size:
                continue
            bound = SAFETY * float(own[cell])
            if not judged[cell]:  # else the points that no fit saw have that error too
                bound += _moved(function, processes[function], touch, *map(np.log, at))
            for name, of_model in _slip_errors(function, bound, at, models).items():
                found[name][cell] = of_model
        for name, values in found.items():
            errors[name][function] = values
    return Bounds(*edges, errors, touch.coefficients)


def _slip_errors(
    function: str, bound: float, at: tuple[Floats, Floats], models: Mapping[str, ForceModel]
) -> dict[str, float]:
    """Return the bounds of all models in a cell, that of the process being known."""
    table = models["table"].contact((function,), *at)[0]
    known = {"eq13": FORCE_MODELS["eq13"], **models}
    apart = {name: _apart(model, function, at, table) for name, model in known.items()}
    of_table = bound + apart["gp"]
    return {**{name: of_table + apart[name] for name in apart}, "gp": bound, "table": of_table}


def _inside(model: ForceModel, g: Floats, alpha: Floats) -> tuple[Floats, Floats]:
    """Return those of some points that are in the domain."""
    there = np.asarray(model.holds(g, alpha))
    return g[there], alpha[there]


def _touching(alpha: Floats, touch: Touch) -> Floats:
    """Return g_touch."""
    return np.asarray(np.exp(log_touch(touch.coefficients, np.log(alpha))))


def _ratio(g: Floats, alpha: Floats, touch: Touch) -> Floats:
    return g / _touching(alpha, touch)


def _unseen(
    off_grid: FitPoints | None, touch: Touch, model: ForceModel
) -> tuple[FitPoints, dict[str, Floats]] | None:
    """Return points that no fit saw, over g/g_touch, with the errors of a model there."""
    if off_grid is None or not {*SLIP_QUANTITIES} <= {*off_grid.names}:
        return None
    g, alpha = off_grid.g, off_grid.alpha
    values = model.contact(SLIP_QUANTITIES, g, alpha)
    inside = np.asarray(model.holds(g, alpha))
    errors = {
        name: np.where(inside, np.abs(np.log(value / getattr(off_grid, name))), 0.0)
        for name, value in zip(SLIP_QUANTITIES, values, strict=True)
    }
    ratio = np.where(inside, _ratio(g, alpha, touch), np.inf)
    return replace(off_grid, g=ratio), errors


def _counted(points: FitPoints, edges: tuple[tuple[float, ...], tuple[float, ...]]) -> Floats:
    """Return the number of points of each cell."""
    bins = [np.array(each) for each in edges]
    return np.asarray(np.histogram2d(points.g, points.alpha, bins)[0])


def _corners(points: FitPoints, touch: Touch) -> Floats:
    """Return the least and the largest g/g_touch of the domain, a rounding farther out."""
    touches = _touching(np.linspace(points.alpha.min(), points.alpha.max(), 200), touch)
    low, high = points.g.min() / touches.max(), points.g.max() / touches.min()
    return np.array([low * (1.0 - 1e-9), high * (1.0 + 1e-9)])


def _own_errors(
    points: FitPoints, errors: Floats, edges: tuple[tuple[float, ...], tuple[float, ...]]
) -> Floats:
    """Return the largest error of the points of each cell."""
    largest = np.zeros([len(each) - 1 for each in edges])
    for cell in np.ndindex(largest.shape):
        g, alpha = (each[i : i + 2] for each, i in zip(edges, cell, strict=True))
        inside = (points.g >= g[0]) & (points.g <= g[1])
        inside &= (points.alpha >= alpha[0]) & (points.alpha <= alpha[1])
        largest[cell] = np.max(errors[inside], initial=0.0)
    largest[largest == 0.0] = np.max(largest)  # a cell without a point is as doubtful as the worst
    return largest


def _bend_error(
    name: str,
    process: GaussianProcess,
    touch: Touch,
    g: tuple[float, ...],
    alpha: tuple[float, ...],
) -> float:
    """Return what an error of g_touch does where the function bends, if it does in this cell."""
    log_alpha = np.log(np.linspace(alpha[0], alpha[1], _GRID))
    touched = log_touch(touch.coefficients, log_alpha)
    here = (touched >= np.log(g[0])) & (touched <= np.log(g[1]))
    if not np.any(here):
        return 0.0
    return _moved(name, process, touch, touched[here], log_alpha[here])


def _moved(
    name: str, process: GaussianProcess, touch: Touch, log_g: Floats, log_alpha: Floats
) -> float:
    """Return how far twice the standard error of g_touch moves the function of a quantity."""
    touched = log_touch(touch.coefficients, log_alpha)
    slope = process.gradient(coordinates_of(name, log_g, log_alpha, touched))[:, 2]
    if name in AT_THE_TIP:
        slope = slope * tip_slope(log_g - touched)
    return float(2.0 * touch.error * np.max(np.abs(slope)))


def _apart(model: ForceModel, function: str, at: tuple[Floats, Floats], table: Floats) -> float:
    name = function if function in model.functions else PROJECTED_TWIN[function]
    value = model.contact((name,), *at)[0]
    return float(np.max(np.abs(np.log(np.broadcast_to(value, table.shape) / table))))


def left_out_errors(
    points: FitPoints, processes: Mapping[str, GaussianProcess]
) -> dict[str, Floats]:
    """Return |ln(predicted/computed)| of A, B and delta at each point left out.

    The larger one of leaving out the point and of leaving out its alpha, but neither where that
    would be extrapolation: no alpha is left out where no smaller or no larger one reaches as far in
    g, and no point at the lowest or the highest g of its alpha. A corner has what the fit leaves.
    """
    found, between = {}, _between_others(points)
    for name, process in processes.items():
        rows = rows_of(process, points)
        alone = np.abs(leave_out_errors(process, np.arange(len(rows)))[0])
        alpha = points.alpha[rows]
        group = np.abs(leave_out_errors(process, alpha)[0])
        fit = np.abs(process.predict_mean(process.inputs) - process.values)
        error = np.maximum(
            np.where(_inside_g(points)[rows], alone, fit), np.where(between[rows], group, fit)
        )
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


def _inside_g(points: FitPoints) -> NDArray[np.bool_]:
    """Return which points are not the first or the last of their alpha."""
    inside = np.ones(len(points), bool)
    for alpha in np.unique(points.alpha):
        rows = np.flatnonzero(points.alpha == alpha)
        inside[rows[[np.argmin(points.g[rows]), np.argmax(points.g[rows])]]] = False
    return inside


def _between_others(points: FitPoints) -> NDArray[np.bool_]:
    """Return which points have others of as high a g at a smaller and at a larger alpha."""
    highest = {a: float(points.g[points.alpha == a].max()) for a in np.unique(points.alpha)}
    between = [
        any(a < alpha and top >= g for a, top in highest.items())
        and any(a > alpha and top >= g for a, top in highest.items())
        for alpha, g in zip(points.alpha.tolist(), points.g.tolist(), strict=True)
    ]
    return np.array(between)


def _edges(wanted: tuple[float, ...], values: Floats) -> tuple[float, ...]:
    """Return edges whose ends are those of the values."""
    low, high = float(values.min()), float(values.max())
    return (low, *(edge for edge in wanted if low < edge < high), high)


def _grid(g: tuple[float, ...], alpha: tuple[float, ...]) -> tuple[Floats, Floats]:
    mesh = np.meshgrid(np.geomspace(g[0], g[1], _GRID), np.linspace(alpha[0], alpha[1], _GRID))
    return mesh[0].ravel(), mesh[1].ravel()

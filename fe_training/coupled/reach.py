"""Up to which load kappa is known: where the process knows it, and paths went.

First the loads at which the standard deviation of the force is small enough, but no larger ones
than those that the nearest paths reached. Then the reach is taken back from every load at which the
bound of the error, of rows left out, of the process or of its polynomial, is too large. What kappa
may be off counts in the force by the share that friction and wear have of it.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from fe_training.coupled.loads import samples_of
from fe_training.coupled.process import LoadProcess, variables
from fe_training.coupled.rows import FitRows
from fe_training.coupled.terms import polynomial_of
from surrogate import contact_functions
from surrogate.contact.coordinates import log_touch
from surrogate.coupling.amplification import LEAST_SHARE, Amplification, edge_of, load_of

__all__ = ["KNOWN", "MOST_ERROR", "bounds_of", "first_reach", "trimmed"]

Array = NDArray[np.float64]

#: Standard deviation of the force up to which kappa counts as known.
KNOWN = 0.01

#: The same with the base of a row left out, up to which its error counts.
_LEFT_OUT_KNOWN = 2.0 * KNOWN

#: Bound of the error of the force from which on the reach is taken back, by how much at a time, and
#: how often at most.
MOST_ERROR, _TAKEN_BACK, _ROUNDS = 0.03, 0.8, 25

#: Least share of the force that friction and wear are taken to have.
_LEAST_PART = 0.3

#: Factor of the error of a row, and of the standard deviation where there is none.
_SAFETY, _DEVIATIONS = 1.5, 3.0

_NODES = (16, 9, 9)
_STEPS = 60


def first_reach(
    process: LoadProcess, rows: FitRows, unit: tuple[float, float]
) -> tuple[tuple[Array, Array, Array], Array]:
    """Return the nodes, and the largest load of each up to which the process knows ln kappa."""
    x, y = rows.inputs[:, 0], rows.inputs[:, 1]
    axes = (
        np.linspace(x.min(), min(x.max(), 0.0), _NODES[0]),
        np.linspace(y.min(), y.max(), _NODES[1]),
        np.linspace(0.0, 1.0, _NODES[2]),
    )
    size, direction = load_of(rows.inputs[:, 2], np.expm1(rows.inputs[:, 3]), unit)
    reach = np.zeros(_NODES)
    shares = np.geomspace(1e-3, size.max(), _STEPS)
    for i, j, k in np.ndindex(*_NODES):
        xi, wear = edge_of(float(axes[2][k]), unit)
        ray = np.column_stack(
            [
                np.full(_STEPS, axes[0][i]),
                np.full(_STEPS, axes[1][j]),
                shares * xi,
                np.log1p(shares * wear),
            ]
        )
        mean, std = process.predict(ray)
        known = np.flatnonzero(std * part_of(ray, mean, process.touch) > KNOWN)
        last = (
            shares[known[0] - 1] if len(known) and known[0] else (0.0 if len(known) else shares[-1])
        )
        place = float(axes[0][i]), float(axes[1][j]), float(axes[2][k])
        near = _nearby(rows, size, direction, place, process)
        reach[i, j, k] = min(last, near)
    return axes, reach


def _nearby(
    rows: FitRows,
    size: Array,
    direction: Array,
    place: tuple[float, float, float],
    process: LoadProcess,
) -> float:
    """Return the load that the nearest rays reached, weighted by their nearness."""
    lengths = np.sqrt(process.lengths[0, :3] * process.lengths[1, :3])
    there = variables(np.array([[*place[:2], 0.0, 0.0]]), process.touch)[0, :3]
    found: list[tuple[float, float]] = []
    for base in np.unique(rows.base):
        here = rows.base == base
        gap = (variables(rows.inputs[here][:1], process.touch)[0, :3] - there) / lengths
        for ray in np.unique(direction[here].round(3)):
            on = here & (np.abs(direction - ray) < 2e-3)
            found.append((float((gap**2).sum() + (4.0 * (ray - place[2])) ** 2), size[on].max()))
    found.sort()
    weights = np.array([1.0 / (1e-3 + square) for square, _ in found[:6]])
    sizes = np.log([reached for _, reached in found[:6]])
    return float(np.exp(weights @ sizes / weights.sum()))


def part_of(points: Array, log_kappa: Array, touch: tuple[float, ...]) -> Array:
    """Return the share that friction and wear have of the force, 0.3 at least."""
    x, y, xi, w = points.T
    g = np.exp(x + log_touch(touch, y))
    contact = contact_functions(g, np.exp(y), extrapolate=True)
    drag = 2.0 * (np.expm1(w) * contact.slip_arc + xi * contact.slip_load) * np.exp(log_kappa)
    return np.asarray(np.maximum(drag / (g + drag), _LEAST_PART))


def trimmed(bare: Amplification, process: LoadProcess, rows: FitRows) -> Amplification:
    """Return kappa with its polynomial, the reach taken back from where it may be far off."""
    kappa = bare
    for _ in range(_ROUNDS):
        kappa = replace(kappa, polynomial=polynomial_of(kappa, process, rows))
        points, bound = bounds_of(kappa, process, rows)
        part = part_of(points, kappa.polynomial(*points.T), kappa.touch)
        bad = points[bound * part > MOST_ERROR]
        if not len(bad):
            break
        reach = kappa.reach.copy()
        _, direction = load_of(bad[:, 2], np.expm1(bad[:, 3]), kappa.load_unit)
        nodes = [
            np.clip(np.searchsorted(axis, at, side="right") - 1, 0, len(axis) - 2)
            for axis, at in zip(kappa.axes, (bad[:, 0], bad[:, 1], direction), strict=True)
        ]
        for corner in np.ndindex(2, 2, 2):
            around = tuple(np.add(nodes, np.array(corner)[:, None]))
            np.minimum.at(reach, around, _TAKEN_BACK * kappa.reach[around])
        kappa = replace(kappa, reach=reach)
    return kappa


def bounds_of(
    kappa: Amplification, process: LoadProcess, rows: FitRows, seed: int = 3
) -> tuple[Array, Array]:
    """Return rows and other known loads, and bounds of |ln kappa - that of finite elements| there.

    The error of a row is that of the process to which its whole base is not known, where that is
    not extrapolation, and how far the polynomial is from the process; anywhere else it is three
    standard deviations and that. It counts in proportion to the share of the reach that its load
    is.
    """
    error, std = process.left_out(rows.base)
    left_out = _SAFETY * np.where(std <= _LEFT_OUT_KNOWN, np.abs(error), 0.0)
    points = np.vstack([rows.inputs, samples_of(kappa, 4096, seed)])
    mean, own = process.predict(points)
    own[: len(rows)] = np.maximum(left_out, own[: len(rows)])
    own[len(rows) :] *= _DEVIATIONS
    x, y, xi, w = points.T
    share = np.asarray(kappa.share_at(x, y, xi, np.expm1(w)))
    bound = (own + np.abs(kappa.polynomial(x, y, xi, w) - mean)) / np.clip(share, LEAST_SHARE, 1.0)
    known = share <= 1.0
    return points[known], bound[known]

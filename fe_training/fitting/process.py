"""Gaussian processes of A, B, delta, A* and B*: scikit-learn fits them, plain arrays keep them."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fe_training.fitting.points import FitPoints
from fe_training.fitting.scatter import Scatter, likeliest_scatter, smoothed
from fe_training.fitting.touch import Touch
from surrogate.contact.coordinates import (
    POWER,
    coordinates_of,
    log_touch,
    vertex,
)
from surrogate.contact.process import GaussianProcess
from surrogate.contact.wedge import wedge_functions, wedge_load

__all__ = [
    "Hyperparameters",
    "fit_processes",
    "leave_out_errors",
    "process_with",
    "rows_of",
    "transformed",
]

Floats = NDArray[np.float64]

#: delta is fitted where ln(g_touch/g) is at least this: nearer, delta - 1 shows the errors of
#: g_touch and of the mesh at the tip.
NEAREST = 0.08

#: Points that carry the prediction: added while the prior variance that they leave, relative to the
#: whole, is above the first, and while they are fewer than the second.
_LEFT, MOST_ACTIVE = 1e-8, 240
_RESTARTS = 2

#: Where the search for the lengths of the coordinates begins.
_LENGTHS = np.array([2.0, 0.7, 2.0])

#: How often the prior and the scatter are fitted in turn.
_TURNS = 2


@dataclass(frozen=True, slots=True, eq=False)
class Hyperparameters:
    """What is found for one quantity: the prior, and how its values scatter.

    Parameters
    ----------
    mean, variance : float
        Of the prior.
    lengths : ndarray, shape (3,)
        Length scales of the coordinates.
    scatter : Scatter
        Of the values.
    """

    mean: float
    variance: float
    lengths: Floats
    scatter: Scatter


def transformed(points: FitPoints, touch: Touch) -> dict[str, tuple[Floats, Floats, Floats]]:
    """Return coordinates and values of each quantity, and the variances of the meshes' differences.

    The coordinates and the quantities are those of `surrogate.contact.coordinates`.
    """
    log_g, log_alpha = np.log(points.g), np.log(points.alpha)
    touched = log_touch(touch.coefficients, log_alpha)
    wedge = wedge_functions(log_g, wedge_load(log_g))
    x, gap = log_g - touched, points.distance - 1.0
    short = (x < -NEAREST) & (gap > 0.0)
    x, gap = np.where(short, x, -1.0), np.where(short, gap, 1.0)
    of_meshes = smoothed(log_g, points.alpha, (points.distance_std * points.distance / gap) ** 2)
    spread = of_meshes + (POWER * touch.error / x) ** 2
    distance = np.log(gap / (vertex(x) * wedge["distance"]))
    found = {
        name: (
            coordinates_of(name, log_g, log_alpha, touched),
            np.log(getattr(points, name) / wedge[name]),
            smoothed(log_g, points.alpha, points.mesh_variance(name)),
        )
        for name in points.names
    }
    at = coordinates_of("distance", log_g, log_alpha, touched)
    return {**found, "distance": (at[short], distance[short], spread[short])}


def fit_processes(
    points: FitPoints, touch: Touch, hyperparameters: Mapping[str, Hyperparameters] | None = None
) -> tuple[dict[str, GaussianProcess], dict[str, Hyperparameters]]:
    """Return a Gaussian process of each quantity, and its hyperparameters.

    Parameters
    ----------
    points : FitPoints
        What was computed.
    touch : Touch
        g_touch(alpha).
    hyperparameters : mapping, optional
        Those of an earlier fit, to be kept; they are fitted by default.

    Returns
    -------
    processes, hyperparameters : dict
        By the names of the quantities.
    """
    processes, found = {}, {}
    for name, (at, values, differences) in transformed(points, touch).items():
        kept = hyperparameters[name] if hyperparameters else _fitted(at, values, differences)
        processes[name], found[name] = process_with(kept, at, values, differences), kept
    return processes, found


def process_with(
    found: Hyperparameters, at: Floats, values: Floats, differences: Floats
) -> GaussianProcess:
    """Return the process of given hyperparameters, with the points that carry it chosen."""
    return GaussianProcess(
        inputs=at,
        values=values,
        noise=found.scatter.of(differences),
        active=_active(at / found.lengths),
        mean=found.mean,
        variance=found.variance,
        lengths=found.lengths,
    )


def _fitted(at: Floats, values: Floats, differences: Floats) -> Hyperparameters:
    """Return what makes the values the likeliest: by turns the prior and the scatter."""
    found = _likeliest_prior(at, values, differences)
    for _ in range(_TURNS):
        covariance = _covariance(at / found.lengths, found.variance)
        rest = values - found.mean
        scatter = likeliest_scatter(covariance, rest, differences, found.scatter)
        found = _likeliest_prior(at, values, differences, replace(found, scatter=scatter))
    return _calibrated(found, at, values, differences)


def _likeliest_prior(
    at: Floats, values: Floats, differences: Floats, start: Hyperparameters | None = None
) -> Hyperparameters:
    """Return the prior that scikit-learn finds, and the scatter beside a share of differences.

    The share is that of `start`, else 1; without a start several are tried.
    """
    from sklearn.exceptions import ConvergenceWarning
    from sklearn.gaussian_process import GaussianProcessRegressor
    from sklearn.gaussian_process.kernels import RBF, ConstantKernel, WhiteKernel

    mean, scale = float(np.mean(values)), float(np.std(values)) or 1.0
    first = start or Hyperparameters(mean, 3.0 * scale**2, _LENGTHS, Scatter(1.0, 1e-6 * scale**2))
    size, rest = first.variance / scale**2, max(first.scatter.extra / scale**2, 1e-10)
    kernel: Any = ConstantKernel(size, (1e-2, 1e4)) * RBF(first.lengths, (0.1, 50.0))
    kernel = kernel + WhiteKernel(rest, (1e-10, 1e-1))
    share = first.scatter.share
    regressor = GaussianProcessRegressor(
        kernel,
        alpha=share * differences / scale**2,
        n_restarts_optimizer=0 if start else _RESTARTS,
        random_state=0,
    )
    with warnings.catch_warnings():
        # a scatter of nothing, or a coordinate that does not matter, ends at a bound
        warnings.simplefilter("ignore", ConvergenceWarning)
        regressor.fit(at, (values - mean) / scale)
    signal, white = regressor.kernel_.k1, regressor.kernel_.k2
    return Hyperparameters(
        mean=mean,
        variance=float(signal.k1.constant_value) * scale**2,
        lengths=np.asarray(signal.k2.length_scale, dtype=float) * np.ones(at.shape[1]),
        scatter=Scatter(share, float(white.noise_level) * scale**2),
    )


def _calibrated(
    found: Hyperparameters, at: Floats, values: Floats, differences: Floats
) -> Hyperparameters:
    """Return hyperparameters whose standard deviations fit the errors of points left out.

    Between those by which 68 % are within one and 95 % within two: tails are heavier than normal
    ones. Prior and scatter change alike, so that the mean stays as it is.
    """
    error, std = leave_out_errors(
        process_with(found, at, values, differences), np.arange(len(values))
    )
    one, two = np.quantile(np.abs(error) / std, (0.683, 0.954))
    factor = float(one * two / 2.0)
    share, extra = found.scatter.share * factor, found.scatter.extra * factor
    return replace(found, variance=found.variance * factor, scatter=Scatter(share, extra))


def _covariance(at: Floats, variance: float) -> Floats:
    """Return the prior covariance of points, in lengths of the process."""
    apart = at[:, np.newaxis, :] - at[np.newaxis, :, :]
    return np.asarray(variance * np.exp(-0.5 * np.sum(apart**2, axis=2)))


def _active(at: Floats) -> NDArray[np.intp]:
    """Return the points that carry the prediction: a Cholesky factorisation with pivots."""
    left = np.ones(len(at))
    factor = np.zeros((min(MOST_ACTIVE, len(at)), len(at)))
    chosen: list[int] = []
    for row in range(len(factor)):
        pivot = int(np.argmax(left))
        if left[pivot] < _LEFT:
            break
        chosen.append(pivot)
        column = np.exp(-0.5 * np.sum((at - at[pivot]) ** 2, axis=1))
        factor[row] = (column - factor[:row, pivot] @ factor[:row]) / np.sqrt(left[pivot])
        left = np.maximum(left - factor[row] ** 2, 0.0)
        left[chosen] = 0.0
    return np.sort(np.array(chosen, dtype=np.intp))


def leave_out_errors(process: GaussianProcess, groups: NDArray[Any]) -> tuple[Floats, Floats]:
    """Return error and standard deviation of each point predicted without its group.

    Parameters
    ----------
    process : GaussianProcess
        The process of all points; its hyperparameters are kept.
    groups : sequence, shape (points,)
        Points of equal groups are left out together.

    Returns
    -------
    error, std : ndarray, shape (points,)
        Prediction less value; the standard deviation includes the noise.

    Notes
    -----
    From the inverse of the covariance with noise: the block of a group gives both at once.

    References
    ----------
    C. E. Rasmussen and C. K. I. Williams, Gaussian Processes for Machine Learning, MIT Press, 2006,
    section 5.4.2.
    """
    covariance = _covariance(process.inputs / process.lengths, process.variance)
    inverse = np.linalg.inv(covariance + np.diag(process.noise))
    weights = inverse @ (process.values - process.mean)
    names = np.asarray(groups)
    error, std = np.empty(len(names)), np.empty(len(names))
    for name in np.unique(names):
        rows = np.flatnonzero(names == name)
        block = np.linalg.inv(inverse[np.ix_(rows, rows)])
        error[rows] = -block @ weights[rows]
        std[rows] = np.sqrt(np.diag(block))
    return error, std


def rows_of(process: GaussianProcess, points: FitPoints) -> NDArray[np.intp]:
    """Return which of the points a process has, in the order that it has them."""
    pairs = zip(np.log(points.g), np.log(points.alpha), strict=True)
    row = {pair: i for i, pair in enumerate(pairs)}
    return np.array([row[g, alpha] for g, alpha in process.inputs[:, :2]], dtype=np.intp)

"""Gaussian processes of A, B, delta, A* and B*: scikit-learn fits them, plain arrays keep them."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fe_training.fitting.points import FitPoints
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
_LEFT, MOST_ACTIVE = 1e-9, 240
_RESTARTS = 2


@dataclass(frozen=True, slots=True, eq=False)
class Hyperparameters:
    """What scikit-learn finds for one quantity: the prior, and a noise beside the error bars.

    Parameters
    ----------
    mean, variance : float
        Of the prior.
    lengths : ndarray, shape (3,)
        Length scales of the coordinates.
    extra_noise : float
        Variance of the scatter that the points' own errors do not explain.
    """

    mean: float
    variance: float
    lengths: Floats
    extra_noise: float


def transformed(points: FitPoints, touch: Touch) -> dict[str, tuple[Floats, Floats, Floats]]:
    """Return the coordinates of `surrogate.contact.coordinates`, values and variances."""
    log_g, log_alpha = np.log(points.g), np.log(points.alpha)
    touched = log_touch(touch.coefficients, log_alpha)
    wedge = wedge_functions(log_g, wedge_load(log_g))
    x, gap = log_g - touched, points.distance - 1.0
    short = (x < -NEAREST) & (gap > 0.0)
    x, gap = np.where(short, x, -1.0), np.where(short, gap, 1.0)
    spread = np.hypot(points.distance_std * points.distance / gap, POWER * touch.error / x)
    distance = np.log(gap / (vertex(x) * wedge["distance"]))
    found = {
        name: (
            coordinates_of(name, log_g, log_alpha, touched),
            np.log(getattr(points, name) / wedge[name]),
            points.relative_std(name) ** 2,
        )
        for name in points.names
    }
    at = coordinates_of("distance", log_g, log_alpha, touched)
    return {**found, "distance": (at[short], distance[short], spread[short] ** 2)}


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
    for name, (at, values, noise) in transformed(points, touch).items():
        kept = hyperparameters[name] if hyperparameters else _fitted(at, values, noise)
        processes[name], found[name] = process_with(kept, at, values, noise), kept
    return processes, found


def process_with(
    found: Hyperparameters, at: Floats, values: Floats, noise: Floats
) -> GaussianProcess:
    """Return the process of given hyperparameters, with the points that carry it chosen."""
    return GaussianProcess(
        inputs=at,
        values=values,
        noise=noise + found.extra_noise,
        active=_active(at / found.lengths),
        mean=found.mean,
        variance=found.variance,
        lengths=found.lengths,
    )


def _fitted(at: Floats, values: Floats, noise: Floats) -> Hyperparameters:
    from sklearn.exceptions import ConvergenceWarning
    from sklearn.gaussian_process import GaussianProcessRegressor
    from sklearn.gaussian_process.kernels import RBF, ConstantKernel, WhiteKernel

    mean, scale = float(np.mean(values)), float(np.std(values)) or 1.0
    kernel: Any = ConstantKernel(3.0, (1e-2, 1e4)) * RBF([2.0, 0.7, 2.0], (0.1, 50.0))
    kernel = kernel + WhiteKernel(1e-6, (1e-10, 1e-1))
    regressor = GaussianProcessRegressor(
        kernel, alpha=noise / scale**2, n_restarts_optimizer=_RESTARTS, random_state=0
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
        extra_noise=float(white.noise_level) * scale**2,
    )


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
    apart = (process.inputs[:, None, :] - process.inputs[None, :, :]) / process.lengths
    covariance = process.variance * np.exp(-0.5 * np.sum(apart**2, axis=2))
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

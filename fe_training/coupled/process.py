"""A Gaussian process of ln kappa that vanishes with friction and wear, exactly.

    ln kappa = xi [ln(1 + 0.4 g) + f(p, xi, w)] + w h(p, xi, w)

with p = (ln g, ln alpha, (g/g_touch)^1/2) and w = ln(1 + tau_w/mu), and f and h independent
Gaussian processes with squared-exponential covariances, each with a length for every variable. Of
the places p the solutions show that kappa is a function of g far from the touch, and of g/g_touch
near it; the first term is about what friction alone does, and what is expected without data.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from surrogate.contact.coordinates import log_touch

__all__ = ["LoadProcess", "fit_process", "variables"]

Array = NDArray[np.float64]

_JITTER = 1e-10
_LENGTHS = ((0.5, 40.0), (0.1, 10.0), (0.05, 10.0), (0.05, 10.0), (0.1, 20.0))
_CAPSTAN = 0.4
_SIZES, _SCATTER = (1e-2, 1e2), (5e-4, 1e-2)


def variables(inputs: Array, touch: Sequence[float]) -> Array:
    """Return the three of the place, xi and w at inputs of shape (points, 4)."""
    x, y, xi, w = inputs.T
    return np.stack([x + log_touch(touch, y), y, np.exp(0.5 * x), xi, w], axis=1)


def _expected(at: Array) -> Array:
    """Return ln kappa as it is expected without data, at variables."""
    return np.asarray(at[:, 3] * np.log1p(_CAPSTAN * np.exp(at[:, 0])))


@dataclass(frozen=True, eq=False)
class LoadProcess:
    """The process with its data.

    Parameters
    ----------
    inputs : ndarray, shape (points, 4)
        x = ln(g/g_touch), y = ln alpha, xi and w.
    values, noise : ndarray, shape (points,)
        ln kappa and the variance of its error, beside that which all share.
    scatter : float
        Standard deviation of the error that all share.
    sizes : ndarray, shape (2,)
        Standard deviations of f and h.
    lengths : ndarray, shape (2, 5)
        Their lengths.
    touch : tuple of float
        Coefficients of ln g_touch in powers of ln alpha.
    calibration : float
        Factor of the standard deviation, found by leaving bases out.
    """

    inputs: Array
    values: Array
    noise: Array
    scatter: float
    sizes: Array
    lengths: Array
    touch: tuple[float, ...]
    calibration: float = 1.0

    def covariance(self, a: Array, b: Array) -> Array:
        """Return the prior covariance of ln kappa at points."""
        from scipy.spatial.distance import cdist

        a, b = variables(a, self.touch), variables(b, self.touch)
        total = np.zeros((len(a), len(b)))
        for column, size, length in zip((3, 4), self.sizes, self.lengths, strict=True):
            decay = np.exp(-0.5 * cdist(a / length, b / length, "sqeuclidean"))
            total += size**2 * np.outer(a[:, column], b[:, column]) * decay
        return total

    @cached_property
    def _unexpected(self) -> Array:
        return self.values - _expected(variables(self.inputs, self.touch))

    @cached_property
    def _factor(self) -> tuple[Any, Array]:
        from scipy.linalg import cho_factor, cho_solve

        matrix = self.covariance(self.inputs, self.inputs)
        matrix[np.diag_indices_from(matrix)] += self.noise + self.scatter**2 + _JITTER
        factor = cho_factor(matrix, lower=True)
        return factor, np.asarray(cho_solve(factor, self._unexpected))

    def predict(self, at: Array) -> tuple[Array, Array]:
        """Return mean and standard deviation of ln kappa at points of shape (n, 4)."""
        from scipy.linalg import solve_triangular

        factor, weights = self._factor
        across = self.covariance(at, self.inputs)
        prior = np.array([self.covariance(row[None], row[None])[0, 0] for row in at])
        spread = solve_triangular(factor[0], across.T, lower=True)
        variance = np.maximum(prior - (spread**2).sum(axis=0), 0.0)
        return _expected(variables(at, self.touch)) + across @ weights, self.calibration * np.sqrt(
            variance
        )

    def log_likelihood(self) -> float:
        """Return the logarithm of the marginal likelihood."""
        factor, weights = self._factor
        halves = np.log(np.diag(factor[0])).sum()
        return float(-0.5 * (self._unexpected) @ weights - halves)

    def log_likelihood_slopes(self) -> Array:
        """Return its derivatives by the logarithms of the scatter, two sizes and ten lengths.

        With K the covariance of the data and a = K^-1 values, (a a' - K^-1) : dK / 2.
        """
        from scipy.linalg import cho_solve

        factor, weights = self._factor
        excess = np.outer(weights, weights) - cho_solve(factor, np.eye(len(self.values)))
        by_size, by_length = [], []
        for part in range(2):
            alone = replace(self, sizes=np.where(np.arange(2) == part, self.sizes, 0.0))
            weighted = excess * alone.covariance(self.inputs, self.inputs)
            by_size.append(weighted.sum())
            for column, length in zip(
                variables(self.inputs, self.touch).T, self.lengths[part], strict=True
            ):
                scaled = column / length
                spread = scaled**2 @ weighted.sum(axis=1) - scaled @ weighted @ scaled
                by_length.append(spread)
        by_scatter = self.scatter**2 * np.trace(excess)
        return np.array([by_scatter, *by_size, *by_length])

    def left_out(self, groups: NDArray[Any]) -> tuple[Array, Array]:
        """Return error and standard deviation of each point, its whole group left out."""
        from scipy.linalg import cho_solve

        factor, weights = self._factor
        inverse = cho_solve(factor, np.eye(len(self.values)))
        error, std = np.empty(len(self.values)), np.empty(len(self.values))
        for group in np.unique(groups):
            rows = np.flatnonzero(groups == group)
            block = np.linalg.inv(inverse[np.ix_(rows, rows)])
            error[rows] = -block @ weights[rows]
            std[rows] = np.sqrt(
                np.maximum(np.diag(block) - self.noise[rows] - self.scatter**2, 0.0)
            )
        return error, self.calibration * std


def fit_process(
    inputs: Array, values: Array, noise: Array, touch: tuple[float, ...], starts: int = 3
) -> LoadProcess:
    """Return the process of the largest marginal likelihood.

    Parameters
    ----------
    inputs, values, noise, touch
        As those of `LoadProcess`.
    starts : int
        Searches, from different lengths.
    """
    from scipy.optimize import minimize

    bounds = [np.log(_SCATTER)] + [np.log(_SIZES)] * 2 + [np.log(pair) for pair in _LENGTHS] * 2

    def process(parameters: Array) -> LoadProcess:
        scatter, *sizes = np.exp(parameters[:3])
        lengths = np.exp(parameters[3:]).reshape(2, 5)
        return LoadProcess(inputs, values, noise, scatter, np.array(sizes), lengths, touch)

    def cost(parameters: Array) -> tuple[float, Array]:
        try:
            tried = process(parameters)
            return -tried.log_likelihood(), -tried.log_likelihood_slopes()
        except np.linalg.LinAlgError:
            return 1e10, np.zeros(len(parameters))

    best: Any = None
    for share in np.linspace(0.35, 0.75, starts):
        start = np.array([low + share * (high - low) for low, high in bounds])
        found = minimize(cost, start, jac=True, method="L-BFGS-B", bounds=bounds)
        if best is None or found.fun < best.fun:
            best = found
    return process(best.x)

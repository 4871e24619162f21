"""A Gaussian process evaluated in numpy from the points that it was fitted to.

The prior covariance of two points is `variance` times exp(-r^2/2) with r in units of a length for
each coordinate. Instead of all points, a chosen few carry the prediction (the deterministic
training conditional): with K_uu the covariance of these, K_uf that with all and N the noise, the
mean is k_u S K_uf N^-1 y with S = (K_uu + K_uf N^-1 K_fu)^-1, and the variance is
k - k_u K_uu^-1 k_u + k_u S k_u. Everything but the points and the parameters is computed once, at
the first use.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["GaussianProcess"]

Array = NDArray[np.float64]

ROWS = 64  # points at a time, always: so that no result depends on how many are asked for
JITTER = 1e-11


@dataclass(frozen=True, eq=False)
class GaussianProcess:
    """A Gaussian process of one quantity.

    Parameters
    ----------
    inputs : ndarray, shape (points, coordinates)
        Where the quantity is known.
    values, noise : ndarray, shape (points,)
        The quantity there and the variance of its error.
    active : ndarray of int, shape (active,)
        The points that carry the prediction.
    mean, variance : float
        Of the prior.
    lengths : ndarray, shape (coordinates,)
        Distances over which the quantity changes.
    calibration : float
        Factor of the standard deviation, found by leaving points out.

    Examples
    --------
    >>> x = np.linspace(0.0, 3.0, 7)[:, np.newaxis]
    >>> process = GaussianProcess(
    ...     x, np.sin(x[:, 0]), np.full(7, 1e-8), np.arange(7), 0.0, 1.0, np.array([1.5])
    ... )
    >>> mean, std = process.predict(np.array([[1.25]]))
    >>> print(f"{mean[0]:.3f}, {np.sin(1.25):.3f}, {std[0] < 1e-2}")
    0.949, 0.949, True
    """

    inputs: Array
    values: Array
    noise: Array
    active: NDArray[np.intp]
    mean: float
    variance: float
    lengths: Array
    calibration: float = 1.0
    _parts: dict[str, Any] = field(default_factory=dict, repr=False)

    def predict(self, at: Array) -> tuple[Array, Array]:
        """Return mean and standard deviation at points of shape (n, coordinates)."""
        self._prepare()
        mean, std = np.empty(len(at)), np.empty(len(at))
        for rows, block in _blocks(at):
            k = self._covariance(block)
            mean[rows] = self._mean(k)[: rows.stop - rows.start]
            spread = k @ self._parts["spread"]
            reached = len(self.active)
            lost = _sum(spread[:, :reached] ** 2) - _sum(spread[:, reached:] ** 2)
            variance = np.maximum(self.variance - lost, 0.0)
            std[rows] = self.calibration * np.sqrt(variance)[: rows.stop - rows.start]
        return mean, std

    def predict_mean(self, at: Array) -> Array:
        """Return the mean at points of shape (n, coordinates)."""
        self._prepare()
        mean = np.empty(len(at))
        for rows, block in _blocks(at):
            mean[rows] = self._mean(self._covariance(block))[: rows.stop - rows.start]
        return mean

    def gradient(self, at: Array) -> Array:
        """Return the derivatives of the mean by the coordinates, shape (n, coordinates)."""
        self._prepare()
        slopes = np.empty(at.shape)
        for rows, block in _blocks(at):
            weighted = self._covariance(block) * self._parts["weights"]
            for i, length in enumerate(self.lengths):
                apart = self._parts["active"][:, i] - block[:, i, np.newaxis]
                slope = _sum(weighted * apart) / length**2
                slopes[rows, i] = slope[: rows.stop - rows.start]
        return slopes

    def _mean(self, covariance: Array) -> Array:
        return self.mean + _sum(covariance * self._parts["weights"])

    def _covariance(self, at: Array) -> Array:
        exponent = np.zeros((len(at), len(self.active)))
        for i, length in enumerate(self.lengths):
            apart = (at[:, i, np.newaxis] - self._parts["active"][:, i]) / length
            exponent += apart * apart
        return self.variance * np.exp(-0.5 * exponent)

    def _prepare(self) -> None:
        if self._parts:
            return
        parts: dict[str, Any] = {"active": np.ascontiguousarray(self.inputs[self.active])}
        self._parts["active"] = parts["active"]
        k_uf = self._covariance(self.inputs).T
        k_uu = k_uf[:, self.active] + JITTER * self.variance * np.eye(len(self.active))
        whitening = np.linalg.inv(np.linalg.cholesky(k_uu))
        white = whitening @ k_uf
        precision = np.eye(len(self.active)) + (white / self.noise) @ white.T
        factor = np.linalg.inv(np.linalg.cholesky(precision))
        target = white @ ((self.values - self.mean) / self.noise)
        parts["weights"] = whitening.T @ (factor.T @ (factor @ target))
        parts["spread"] = np.hstack([whitening.T, (factor @ whitening).T])
        self._parts.update(parts)


def _sum(rows: Array) -> Array:
    return np.asarray(np.add.reduce(rows, axis=1))


def _blocks(at: Array) -> Any:
    """Yield slices and as many points, always `ROWS` of them: the last ones are repeated."""
    for start in range(0, len(at), ROWS):
        block = at[start : start + ROWS]
        stop = start + len(block)
        if len(block) < ROWS:
            block = np.concatenate(
                [block, np.broadcast_to(block[-1:], (ROWS - len(block), at.shape[1]))]
            )
        yield slice(start, stop), block

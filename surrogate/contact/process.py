"""A Gaussian process evaluated in numpy from the points that it was fitted to.

The prior covariance of two points is `variance` times exp(-r^2/2) with r in units of a length for
each coordinate. Instead of all points, a chosen few carry the prediction (the deterministic
training conditional): with K_uu the covariance of these, K_uf that with all and N the noise, the
mean is k_u S K_uf N^-1 y with S = (K_uu + K_uf N^-1 K_fu)^-1, and the variance is
k - k_u (K_uu^-1 - S) k_u. With K_uu = L L' and the eigenvalues q of L^-1 K_uf N^-1 K_fu L'^-1 the
middle is that of q/(1 + q), a square without differences, of which the triangular root is taken.
Everything but the points and the parameters is computed once, at the first use.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["GaussianProcess"]

Array = NDArray[np.float64]

ROWS = 128  # points at a time, always: so that no result depends on how many are asked for
COLUMNS = 28  # of a triangle at a time
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

    def predict(self, at: Array) -> tuple[Array, Array]:
        """Return mean and standard deviation at points of shape (n, coordinates)."""
        mean, std = np.empty(len(at)), np.empty(len(at))
        room, other, (weights, spread) = self._room(ROWS), self._room(ROWS), self._solved
        for rows, block in _blocks(self._factors(at)):
            covariance, number = self._covariance(block, room), rows.stop - rows.start
            mean[rows] = _sum(np.multiply(covariance, weights, out=other))[:number]
            _times_triangle(covariance, spread, other)
            std[rows] = _squares(other[:number])
        mean += self.mean
        np.subtract(self.variance, std, out=std)
        np.sqrt(np.maximum(std, 0.0, out=std), out=std)
        std *= self.calibration
        return mean, std

    def predict_mean(self, at: Array) -> Array:
        """Return the mean at points of shape (n, coordinates)."""
        mean, room, (weights, _) = np.empty(len(at)), self._room(ROWS), self._solved
        for rows, block in _blocks(self._factors(at)):
            weighted = np.multiply(self._covariance(block, room), weights, out=room)
            mean[rows] = _sum(weighted)[: rows.stop - rows.start]
        mean += self.mean
        return mean

    def gradient(self, at: Array) -> Array:
        """Return the derivatives of the mean by the coordinates, shape (n, coordinates)."""
        slopes, room, (weights, _) = np.empty(at.shape), self._room(ROWS), self._solved
        factors, coordinates = _blocks(self._factors(at)), _blocks(at)
        for (rows, block), (_, places) in zip(factors, coordinates, strict=True):
            weighted = np.multiply(self._covariance(block, room), weights, out=room)
            for i, length in enumerate(self.lengths):
                apart = self._active[0][:, i] - places[:, i, np.newaxis]
                slope = _sum(weighted * apart) / length**2
                slopes[rows, i] = slope[: rows.stop - rows.start]
        return slopes

    def _room(self, rows: int) -> Array:
        return np.empty((rows, len(self.active)))

    def _factors(self, at: Array) -> Array:
        """Return the left factors of `_covariance` of points."""
        # -r^2/2 of x and y is x y - (x^2 + y^2)/2: one product of matrices, where differences
        # would need a pass over all pairs for each coordinate
        x = (at - self._active[1]) / self.lengths
        return np.concatenate([x, np.full((len(x), 1), 1.0), _half_square(x)], axis=1)

    def _covariance(self, factors: Array, room: Array) -> Array:
        """Return the covariance of points with the active ones, in `room`."""
        np.matmul(factors, self._active[2], out=room)
        return np.exp(room, out=room)

    @cached_property
    def _active(self) -> tuple[Array, Array, Array]:
        """The points that carry the prediction, their centre, and factors of `_covariance`."""
        active = np.ascontiguousarray(self.inputs[self.active])
        centre = active.mean(axis=0)
        y = (active - centre) / self.lengths
        own = _half_square(y) + np.log(self.variance)
        return active, centre, np.concatenate([y, own, np.full(own.shape, 1.0)], axis=1).T.copy()

    @cached_property
    def _solved(self) -> tuple[Array, Array]:
        """The weights of the mean, and the lower triangle that gives the variance."""
        k_uf = self._covariance(self._factors(self.inputs), self._room(len(self.inputs))).T
        k_uu = k_uf[:, self.active] + JITTER * self.variance * np.eye(len(self.active))
        whitening = np.linalg.inv(np.linalg.cholesky(k_uu))
        white = whitening @ k_uf
        known, axes = np.linalg.eigh((white / self.noise) @ white.T)
        known = np.maximum(known, 0.0)
        target = white @ ((self.values - self.mean) / self.noise)
        weights = whitening.T @ (axes @ ((axes.T @ target) / (1.0 + known)))
        spread = whitening.T @ (axes * np.sqrt(known / (1.0 + known)))
        # another square root of the same matrix, of half as many numbers
        triangle = np.transpose(np.linalg.qr(spread.T, mode="r"))
        return weights, np.ascontiguousarray(triangle)


def _times_triangle(rows: Array, triangle: Array, result: Array) -> None:
    """Put rows times a lower triangle into `result`, without most of what is above it."""
    for start in range(0, len(triangle), COLUMNS):
        some = slice(start, start + COLUMNS)
        np.matmul(rows[:, start:], triangle[start:, some], out=result[:, some])


def _sum(rows: Array) -> Array:
    return np.asarray(np.add.reduce(rows, axis=1))  # by pairs: less rounding than a running sum


def _squares(rows: Array) -> Array:
    return np.asarray(np.einsum("ij,ij->i", rows, rows))


def _half_square(rows: Array) -> Array:
    """Return minus half the squared lengths of rows, as a column."""
    return np.asarray(-0.5 * np.add.reduce(rows * rows, axis=1, keepdims=True))


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

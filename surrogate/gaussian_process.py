"""A Gaussian process evaluated in numpy from the points that it was fitted to.

The prior covariance of two points is `variance` times exp(-r^2/2) with r in units of a length for
each coordinate. Instead of all points, a chosen few carry the prediction (the deterministic
training conditional): with K_uu the covariance of these, K_uf that with all and N the noise, the
mean is k_u S K_uf N^-1 y with S = (K_uu + K_uf N^-1 K_fu)^-1, and the variance is
k - k_u (K_uu^-1 - S) k_u. With K_uu = L L' and the eigenvalues q of L^-1 K_uf N^-1 K_fu L'^-1 the
middle is that of q/(1 + q), a square without differences. Everything but the points and the
parameters is computed once, at the first use.
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
        room = self._room(ROWS)
        for rows, block in _blocks(at):
            k, other = self._covariance(block, room)
            mean[rows] = self._mean(k, other)[: rows.stop - rows.start]
            spread = np.matmul(k, self._parts["spread"], out=other)
            spread *= spread
            variance = np.maximum(self.variance - _sum(spread), 0.0)
            std[rows] = self.calibration * np.sqrt(variance)[: rows.stop - rows.start]
        return mean, std

    def predict_mean(self, at: Array) -> Array:
        """Return the mean at points of shape (n, coordinates)."""
        self._prepare()
        mean, room = np.empty(len(at)), self._room(ROWS)
        for rows, block in _blocks(at):
            mean[rows] = self._mean(*self._covariance(block, room))[: rows.stop - rows.start]
        return mean

    def gradient(self, at: Array) -> Array:
        """Return the derivatives of the mean by the coordinates, shape (n, coordinates)."""
        self._prepare()
        slopes, room = np.empty(at.shape), self._room(ROWS)
        for rows, block in _blocks(at):
            weighted = self._covariance(block, room)[0] * self._parts["weights"]
            for i, length in enumerate(self.lengths):
                apart = self._parts["active"][:, i] - block[:, i, np.newaxis]
                slope = _sum(weighted * apart) / length**2
                slopes[rows, i] = slope[: rows.stop - rows.start]
        return slopes

    def _mean(self, covariance: Array, room: Array) -> Array:
        return self.mean + _sum(np.multiply(covariance, self._parts["weights"], out=room))

    def _room(self, rows: int) -> tuple[Array, Array]:
        shape = rows, len(self.active)
        return np.empty(shape), np.empty(shape)

    def _covariance(self, at: Array, room: tuple[Array, Array]) -> tuple[Array, Array]:
        """Return the covariance with the active points, and room to work in; both are `room`."""
        exponent, apart = room
        exponent[...] = np.log(self.variance)
        for i, length in enumerate(self.lengths * np.sqrt(2.0)):
            np.subtract((at[:, i] / length)[:, np.newaxis], self._parts["scaled"][i], out=apart)
            apart *= apart
            exponent -= apart
        return np.exp(exponent, out=exponent), apart

    def _prepare(self) -> None:
        if self._parts:
            return
        active = np.ascontiguousarray(self.inputs[self.active])
        scaled = (active / (self.lengths * np.sqrt(2.0))).T.copy()
        self._parts.update(active=active, scaled=scaled)
        k_uf = self._covariance(self.inputs, self._room(len(self.inputs)))[0].T
        k_uu = k_uf[:, self.active] + JITTER * self.variance * np.eye(len(self.active))
        whitening = np.linalg.inv(np.linalg.cholesky(k_uu))
        white = whitening @ k_uf
        known, axes = np.linalg.eigh((white / self.noise) @ white.T)
        known = np.maximum(known, 0.0)
        target = white @ ((self.values - self.mean) / self.noise)
        weights = whitening.T @ (axes @ ((axes.T @ target) / (1.0 + known)))
        spread = whitening.T @ (axes * np.sqrt(known / (1.0 + known)))
        self._parts.update(weights=weights, spread=spread)


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

"""What repeated cuts say about the scatter of forces: constant, proportional or both.

Cuts of the same wire differ by nothing but scatter. Its standard deviation is taken as
sqrt(c^2 + p^2 F^2) with F the mean force of the wire: p = 0 is a constant one, c = 0 one in
proportion. The likelihood of the differences within wires chooses, with one parameter's worth of
Akaike's penalty for the one that has both. Only the shape is used as weights; the size comes with
the fit. Where samples are named, the scatter between them is estimated as well.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["Scatter", "scatter_of_repeats"]

Array = NDArray[np.float64]
Numbers = NDArray[np.int64]

FEWEST_REPEATS = 3
"""Differences within wires from which the shape of the scatter can be chosen."""

SHARES = np.linspace(0.0, 1.0, 41)
"""Of the proportional part in the variance of a mean force."""

SAMPLE_RATIOS = np.concatenate([[0.0], np.geomspace(0.05, 20.0, 60)])
"""Standard deviation between samples over that within."""


@dataclass(frozen=True, eq=False)
class Scatter:
    """The scatter of single cuts, as the repeated ones have it.

    Parameters
    ----------
    kind : str
        "constant", "proportional" or "both".
    constant, proportional : float
        Standard deviation of one cut: sqrt(constant^2 + proportional^2 F^2), [N/m] and [-].
    dof : int
        Differences within wires that it is estimated from.
    weights : ndarray, shape (n,)
        One over the relative standard deviation of each force, about 1.
    pure_misfit : float
        Weighted sum of squares within wires [N2/m2].
    sample_ratio : float
        Standard deviation between samples over that within [-]; 0 where none are named.
    """

    kind: str
    constant: float
    proportional: float
    dof: int
    weights: Array
    pure_misfit: float
    sample_ratio: float = 0.0

    @property
    def words(self) -> str:
        """The scatter in words.

        Examples
        --------
        >>> Scatter("proportional", 0.0, 0.034, 20, np.ones(1), 1.0).words
        'proportional, 3.4 % of the force (from 20 differences between repeated cuts)'
        """
        parts = []
        if self.constant > 0.0:
            parts.append(f"{self.constant:.2g} N/m")
        if self.proportional > 0.0:
            parts.append(f"{100.0 * self.proportional:.2g} % of the force")
        size = " and ".join(parts) if parts else "0"
        if self.sample_ratio > 0.0:
            size += f", and between samples {self.sample_ratio:.2g} times that"
        return f"{self.kind}, {size} (from {self.dof} differences between repeated cuts)"


def scatter_of_repeats(
    radius: Array, force: Array, sample: Numbers | None = None
) -> Scatter | None:
    """Return what cuts of the same radius say, or None where too few are repeated.

    Parameters
    ----------
    radius, force : ndarray, shape (n,)
        R_w [m] and F_ss/T [N/m].
    sample : ndarray of int, shape (n,), optional
        Number of the sample of each cut.

    References
    ----------
    H. D. Patterson and R. Thompson, Biometrika 58 (1971) 545 (residual likelihood).

    Examples
    --------
    >>> radius = np.repeat([1e-4, 2e-4], 5)
    >>> force = np.array([0.9, 1.1, 1.0, 1.05, 0.95, 9.0, 11.0, 10.0, 10.5, 9.5])
    >>> scatter_of_repeats(radius, force).kind
    'proportional'
    """
    radii, places = np.unique(radius, return_inverse=True)
    places = places.reshape(-1)
    count = np.bincount(places)
    dof = int(radius.size - radii.size)
    mean = np.bincount(places, weights=force) / count
    squares = np.bincount(places, weights=(force - mean[places]) ** 2)
    if dof < FEWEST_REPEATS or not squares.sum() > 0.0:
        return None
    share, variance = _best_share(mean, squares, count - 1, dof)
    relative = _relative_variance(share, mean)
    weights = 1.0 / np.sqrt(relative)[places]
    between = 0.0 if sample is None else _between_samples(places, force * weights, weights, sample)
    pure = float((squares / relative).sum())
    if between > 0.0:
        variance = variance / (1.0 + between**2)
    return Scatter(
        kind={0.0: "constant", 1.0: "proportional"}.get(share, "both"),
        constant=float(np.sqrt((1.0 - share) * variance)),
        proportional=float(np.sqrt(share * variance) / _mean_square_root(mean)),
        dof=dof,
        weights=weights,
        pure_misfit=pure,
        sample_ratio=between,
    )


def _mean_square_root(mean: Array) -> float:
    return float(np.sqrt(np.mean(mean**2)))


def _relative_variance(share: float, mean: Array) -> Array:
    return (1.0 - share) + share * (mean / _mean_square_root(mean)) ** 2


def _best_share(mean: Array, squares: Any, dofs: Any, dof: int) -> tuple[float, float]:
    """Return the share of the proportional part, 0 or 1 unless both are clearly there."""
    fits = []
    for share in SHARES.tolist():
        relative = _relative_variance(share, mean)
        variance = float((squares / relative).sum() / dof)
        deviance = dof * np.log(variance) + float((dofs * np.log(relative)).sum())
        fits.append((deviance + (2.0 if 0.0 < share < 1.0 else 0.0), share, variance))
    _, share, variance = min(fits)
    return share, variance


def _between_samples(places: Any, values: Array, weights: Array, sample: Numbers) -> float:
    """Return the standard deviation between samples over that within, by residual likelihood.

    Wires have any means, so that only samples that several wires share, or wires that several
    samples share, tell; 0 where none does.
    """
    design = (places[:, np.newaxis] == np.unique(places)) * weights[:, np.newaxis]
    same = (sample[:, np.newaxis] == np.unique(sample)).astype(float)
    # residuals of the wires' means, in a basis of what is left of them
    left = np.linalg.svd(design.astype(float), full_matrices=True)[0][:, design.shape[1] :]
    data, shared = left.T @ values, left.T @ same
    if not np.any(np.abs(shared) > 1e-9):
        return 0.0
    variances, basis = np.linalg.eigh(shared @ shared.T)
    turned = (basis.T @ data) ** 2
    deviances = []
    for ratio in SAMPLE_RATIOS.tolist():
        total = 1.0 + ratio**2 * np.maximum(variances, 0.0)
        size = float(np.mean(turned / total))
        deviances.append(turned.size * np.log(size) + float(np.log(total).sum()))
    return float(SAMPLE_RATIOS[int(np.argmin(deviances))])

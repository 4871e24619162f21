"""How much values scatter about a smooth function: a share of the difference between the meshes.

The difference of one pair of solutions is one draw: often far too small, now and then too large.
Its root mean square over neighbours along g says how finely the mesh resolves there. The finer
mesh's values scatter by a share of that, which, like the other parameters of a process, has the
largest likelihood.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["Scatter", "likeliest_scatter", "smoothed"]

Floats = NDArray[np.float64]

#: Neighbours along ln g that are averaged over: the standard deviation of their weights.
_WIDTH = 0.7

_SMALLEST = 1e-10


@dataclass(frozen=True, slots=True)
class Scatter:
    """The variance of a value: `share` times that of the meshes' difference, and `extra`.

    Parameters
    ----------
    share : float
        Of the variance of the difference between the meshes [-].
    extra : float
        Variance that does not follow the meshes.
    """

    share: float = 1.0
    extra: float = 0.0

    def of(self, differences: Floats) -> Floats:
        """Return the variances of values from those of the meshes' differences."""
        return self.share * differences + self.extra


def smoothed(log_g: Floats, alpha: Floats, variances: Floats) -> Floats:
    """Return variances averaged over neighbours along g at the same alpha.

    Examples
    --------
    >>> smoothed(np.array([0.0, 0.1, 9.0]), np.full(3, 2.0), np.array([1.0, 3.0, 5.0])).round(2)
    array([1.99, 2.01, 5.  ])
    """
    averaged = np.empty(len(variances))
    for value in np.unique(alpha):
        here = np.flatnonzero(alpha == value)
        apart = (log_g[here, np.newaxis] - log_g[here]) / _WIDTH
        weights = np.exp(-0.5 * apart**2)
        averaged[here] = weights @ variances[here] / weights.sum(axis=1)
    return averaged


def likeliest_scatter(
    covariance: Floats, values: Floats, differences: Floats, start: Scatter
) -> Scatter:
    """Return the scatter by which the values of a process are the likeliest.

    Parameters
    ----------
    covariance : ndarray, shape (points, points)
        Prior covariance of the values without scatter.
    values : ndarray, shape (points,)
        The values less the prior's mean.
    differences : ndarray, shape (points,)
        Variances of the meshes' differences.
    start : Scatter
        Where the search begins.
    """
    from scipy.linalg import LinAlgError, cho_solve, cholesky
    from scipy.optimize import minimize

    def unlikely(logs: Floats) -> float:
        some = Scatter(*np.exp(logs))
        try:
            lower = cholesky(covariance + np.diag(some.of(differences)), lower=True)
        except LinAlgError:
            return 1e300
        misfit = values @ cho_solve((lower, True), values)
        return float(0.5 * misfit + np.sum(np.log(np.diag(lower))))

    at = np.log([start.share, max(start.extra, _SMALLEST)])
    found = minimize(unlikely, at, method="Nelder-Mead", options={"xatol": 0.02, "fatol": 0.02})
    return Scatter(*map(float, np.exp(found.x)))

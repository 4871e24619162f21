"""Linear least squares in a few unknowns of very different size."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["LinearFit", "solve_least_squares"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class LinearFit:
    """Solution of a least-squares problem whose values have unit variance.

    Parameters
    ----------
    estimate : ndarray, shape (p,)
        The unknowns.
    covariance : ndarray, shape (p, p)
        Their covariance for values of unit variance.
    leverage : ndarray, shape (n,)
        Weight of each value in its own prediction, between 0 and 1.
    condition : float
        Condition number of the design matrix with columns of unit length.
    """

    estimate: Array
    covariance: Array
    leverage: Array
    condition: float


def solve_least_squares(design: Array, values: Array) -> LinearFit:
    """Minimise |design x - values| by QR on columns scaled to unit length.

    Scaling makes the condition number, and so the digits that are left, independent of the
    unknowns' units.

    Parameters
    ----------
    design : ndarray, shape (n, p)
        Derivative of each value with respect to each unknown, n >= p.
    values : ndarray, shape (n,)
        The values to meet.

    Returns
    -------
    LinearFit
        Unknowns, covariance, leverages and condition; all nan where the columns are
        linearly dependent.

    References
    ----------
    A. Bjorck, Numerical Methods for Least Squares Problems, SIAM 1996, sections 2.4 and 2.9.

    Examples
    --------
    >>> fit = solve_least_squares(np.array([[1.0, 0.0], [1.0, 1.0], [1.0, 2.0]]), np.arange(3.0))
    >>> print(np.round(fit.estimate, 12) + 0.0)
    [0. 1.]
    """
    scale = np.linalg.norm(design, axis=0)
    q, r = np.linalg.qr(design / scale)
    condition = float(np.linalg.cond(r))
    if not condition < 1.0 / np.finfo(float).eps:
        unknown = np.full(design.shape[1], np.nan)
        return LinearFit(unknown, np.outer(unknown, unknown), values * np.nan, np.inf)
    inverse = np.linalg.inv(r) / scale[:, np.newaxis]
    return LinearFit(inverse @ (q.T @ values), inverse @ inverse.T, np.sum(q**2, axis=1), condition)

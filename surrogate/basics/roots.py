"""Where a condition that holds at one end of an interval ceases to, for many intervals at once."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

__all__ = ["narrowed"]

Array = NDArray[np.float64]

SECTIONS = 16


def narrowed(
    holds: Callable[[Array], NDArray[np.bool_]], yes: Array, no: Array, rtol: float = 0.0
) -> Array:
    """Return the last numbers at which a condition holds, between where it does and does not.

    All intervals are divided together, into sixteen parts at a time, until no number is between
    the last one at which the condition holds and the first one at which it does not.

    Parameters
    ----------
    holds : callable
        Whether the condition holds at each of `intervals` times 15 numbers, interval by interval.
    yes, no : ndarray, shape (intervals,)
        Where it holds and where it does not; either may be the larger one.
    rtol : float, default 0
        Width over size of an interval that will do.

    Returns
    -------
    ndarray, shape (intervals,)
        The last numbers at which it holds.

    Examples
    --------
    >>> root = narrowed(lambda x: x * x < 2.0, np.array([0.0]), np.array([2.0]))
    >>> print(f"{root[0]:.15f}")
    1.414213562373095
    """
    shares = np.linspace(0.0, 1.0, SECTIONS + 1)
    while np.any(
        ((middle := 0.5 * (yes + no)) != yes)
        & (middle != no)
        & (abs(yes - no) > rtol * abs(middle))
    ):
        x = yes[:, np.newaxis] + (no - yes)[:, np.newaxis] * shares
        x[:, -1] = no
        inner = holds(x[:, 1:-1].ravel()).reshape(yes.size, -1)
        first_no = 1 + np.argmin(np.column_stack([inner, np.zeros(yes.size, bool)]), axis=1)
        rows = np.arange(yes.size)
        yes, no = x[rows, first_no - 1], x[rows, first_no]
    return yes

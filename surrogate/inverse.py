"""The energy release rate at a given distance: the inverse of delta(g)."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from surrogate.elementwise import exp, where

__all__ = ["toughness_of"]

# Between these, ln of ln(g_touch/g): from g equal to g_touch in all digits to the smallest float.
_NEAREST, _FARTHEST = -36.0, 6.7
_HALVINGS = 60


def toughness_of(distance_of: Callable[[Any], Any], distance: Any, log_touch: Any) -> Any:
    """Return g at which delta/R_w, falling with g to 1 at g_touch, has a value.

    Halves the interval of ln ln(g_touch/g), in which ln(delta/R_w - 1) is close to a line, until
    nothing is left of it.

    Parameters
    ----------
    distance_of : callable
        delta/R_w of g.
    distance : float or ndarray
        delta/R_w, more than 1; 0 is the answer where it is infinite.
    log_touch : float or ndarray
        ln g_touch.

    Returns
    -------
    float or ndarray
        g.

    Examples
    --------
    >>> g = toughness_of(lambda g: max(g**-0.5, 1.0), 4.0, 0.0)
    >>> print(f"{g:.6f}")
    0.062500
    """
    low = where(np.equal(distance, distance) & (log_touch == log_touch), _NEAREST, np.nan)
    high = where(low == low, _FARTHEST, np.nan)
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        nearer = distance_of(exp(log_touch - exp(middle))) < distance
        low, high = where(nearer, middle, low), where(nearer, high, middle)
    return where(distance == np.inf, 0.0, exp(log_touch - exp(0.5 * (low + high))))

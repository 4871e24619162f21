"""The energy release rate at a given distance: the inverse of delta(g)."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from surrogate.elementwise import exp, log, where

__all__ = ["toughness_of"]

# Between these, ln of ln(g_touch/g): from g equal to g_touch in all digits to the smallest float.
_NEAREST, _FARTHEST = -36.0, 6.7
_MOST = 100
_CLOSE = 4e-16  # a few roundings


def toughness_of(distance_of: Callable[[Any], Any], distance: Any, log_touch: Any) -> Any:
    """Return g at which delta/R_w, falling with g to 1 at g_touch, has a value.

    ln ln(delta/R_w) is close to a line over ln ln(g_touch/g), from the touch to infinity, so that
    false positions with the Illinois rule meet it in about ten steps. Where a value is infinite the
    interval is halved. Every point ends by itself, whatever others are asked for.

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
    goal = _height(distance)
    close = _CLOSE * exp(-goal)  # what the rounding of a distance does to its height
    known = np.equal(distance, distance) & np.equal(log_touch, log_touch)
    low, high = where(known, _NEAREST, np.nan), where(known, _FARTHEST, np.nan)
    found = 0.5 * (low + high)
    below, above = where(known, -np.inf, np.nan), where(known, np.inf, np.nan)
    side = where(known, 0.0, np.nan)  # of the last value: -1 below the goal, 1 above
    busy: Any = known & np.less(distance, np.inf)
    for _ in range(_MOST):
        if not np.any(busy):
            break
        value = _height(distance_of(exp(log_touch - exp(found)))) - goal
        under, over = busy & (value < 0.0), busy & (value >= 0.0)
        # the Illinois rule: an end that stays twice counts half
        above = where(over, value, where(under & (side < 0.0), 0.5 * above, above))
        below = where(under, value, where(over & (side > 0.0), 0.5 * below, below))
        low, high = where(under, found, low), where(over, found, high)
        side = where(under, -1.0, where(over, 1.0, side))
        with np.errstate(all="ignore"):
            straight = low + (high - low) * (below / (below - above))
        inside = (straight > low) & (straight < high)
        following = where(inside, straight, 0.5 * (low + high))
        ended = (abs(value) <= close) | (abs(following - found) <= _CLOSE)
        found = where(busy & ~ended, following, found)
        busy = busy & ~ended
    return where(distance == np.inf, 0.0, exp(log_touch - exp(found)))


def _height(distance: Any) -> Any:
    """Return ln ln(delta/R_w), minus infinity at the touch."""
    with np.errstate(all="ignore"):
        inner = np.log1p(distance - 1.0)
        return log(float(inner) if type(distance) is float else inner)

"""Where the crack tip begins to touch the wire, and the coordinates that this gives the fits.

At g_touch(alpha) the deformed distance delta reaches R_w; it stays there while g rises further.
ln g_touch is a polynomial in ln alpha with fitted coefficients. It separates far-field cutting from
indentation cutting, and A, B and delta bend there.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

__all__ = ["log_touch", "log_touch_slope"]


def log_touch(coefficients: Sequence[float], log_alpha: Any) -> Any:
    """Return ln g_touch at ln alpha.

    Parameters
    ----------
    coefficients : sequence of float
        Of the powers of ln alpha, rising.
    log_alpha : float or ndarray
        ln alpha.

    Returns
    -------
    float or ndarray
        ln g_touch.

    Examples
    --------
    >>> print(f"{log_touch((0.5, 2.0), 1.5):.3f}")
    3.500
    """
    value = coefficients[-1] + 0.0 * log_alpha
    for coefficient in coefficients[-2::-1]:
        value *= log_alpha  # in place, if it is an array
        value += coefficient
    return value


def log_touch_slope(coefficients: Sequence[float], log_alpha: Any) -> Any:
    """Return d ln g_touch/d ln alpha.

    Examples
    --------
    >>> print(f"{log_touch_slope((0.5, 2.0, 1.0), 1.5):.3f}")
    5.000
    """
    powers = [i * c for i, c in enumerate(coefficients)][1:]
    return log_touch(powers or [0.0], log_alpha)

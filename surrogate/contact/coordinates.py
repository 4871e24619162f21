"""The transformed quantities in which A, B and delta are smooth enough to be fitted.

Coordinates are ln g, ln alpha and the toughness beyond the touch of the tip, max(0, x) with
x = ln(g/g_touch): functions of the three may bend at the touch. The quantities are

    ln(A/A_wedge),   ln(B/B_wedge),   ln[(delta/R_w - 1)/(|x|^(7/4) delta_wedge/R_w)],

the last one short of the touch only. It is finite there, because delta reaches R_w with a vertex of
about that power; beyond, delta is R_w. The slip arc A* and the slip load B* are taken like A and B,
which they become in the far field, where the face is not stretched. A* rises steeply before the
touch and jumps there: its third coordinate does both, see `tip_coordinate`.

Where the crack tip begins to touch the wire, and the coordinates that this gives the fits.

At g_touch(alpha) the deformed distance delta reaches R_w; it stays there while g rises further.
ln g_touch is a polynomial in ln alpha with fitted coefficients. It separates far-field cutting from
indentation cutting, and A, B and delta bend there.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "AT_THE_TIP",
    "LOADS",
    "POWER",
    "QUANTITIES",
    "RISE",
    "SLIP_QUANTITIES",
    "STEP",
    "WITHIN",
    "coordinates",
    "coordinates_of",
    "log_touch",
    "log_touch_slope",
    "tip_coordinate",
    "tip_slope",
    "touch_range",
    "vertex",
]

QUANTITIES = ("arc", "normal_load", "distance")
SLIP_QUANTITIES = ("slip_arc", "slip_load")
LOADS = ("normal_load", "slip_load")
"""What a finite body changes: integrals of the pressure."""

AT_THE_TIP = ("slip_arc",)
"""What feels the tip before it touches the wire: A*, to which its slip is added from then on."""

RISE, WITHIN, STEP = 3.0, 0.3, 4.0
"""The last coordinate of such a quantity: how far it rises before the touch, within which part of
ln g, and its jump there: some lengths of the process, so that what is before and beyond hardly know
of each other."""

POWER = 1.75


def coordinates(log_g: Any, log_alpha: Any, touch: Any) -> NDArray[np.float64]:
    """Return the coordinates of points as one array of shape (points, 3).

    Parameters
    ----------
    log_g, log_alpha : float or ndarray
        ln g and ln alpha.
    touch : float or ndarray
        ln g_touch there.

    Examples
    --------
    >>> coordinates(2.0, 1.0, 1.5)
    array([[2. , 1. , 0.5]])
    """
    beyond = np.maximum(np.subtract(log_g, touch), 0.0)
    return np.stack(np.broadcast_arrays(*np.atleast_1d(log_g, log_alpha, beyond)), axis=-1)


def coordinates_of(
    name: str, log_g: Any, log_alpha: Any, touch: Any, past: Any = None
) -> NDArray[np.float64]:
    """Return the coordinates in which a quantity is fitted.

    Parameters
    ----------
    name : str
        The quantity.
    log_g, log_alpha, touch
        As for `coordinates`.
    past : bool or ndarray of bool, optional
        Which points count as past the touch; from it on by default.

    Examples
    --------
    >>> coordinates_of("slip_arc", 2.0, 1.0, 1.5)
    array([[2. , 1. , 4.5]])
    """
    at = coordinates(log_g, log_alpha, touch)
    if name in AT_THE_TIP:
        x = np.subtract(log_g, touch)
        at[:, 2] = tip_coordinate(x, x >= 0.0 if past is None else past)
    return at


def tip_coordinate(x: Any, past: Any) -> Any:
    """Return the last coordinate of what feels the tip, at x = ln(g/g_touch).

    Examples
    --------
    >>> x = np.array([-9.0, -0.3, 0.0, 0.5])
    >>> tip_coordinate(x, x >= 0.0).round(3)
    array([-3.   , -1.896,  4.   ,  4.5  ])
    """
    before = RISE * np.expm1(np.minimum(x, 0.0) / WITHIN)
    return np.where(past, STEP + np.maximum(x, 0.0), before)


def tip_slope(x: Any) -> Any:
    """Return the derivative of `tip_coordinate` by x.

    Examples
    --------
    >>> tip_slope(np.array([-0.3, 0.5])).round(3)
    array([3.679, 1.   ])
    """
    before = RISE / WITHIN * np.exp(np.minimum(x, 0.0) / WITHIN)
    return np.where(np.greater_equal(x, 0.0), 1.0, before)


def vertex(x: Any) -> Any:
    """Return |x|^(7/4) where x is negative, else 0.

    Examples
    --------
    >>> print(f"{vertex(-0.5):.6f} {vertex(0.5):.6f}")
    0.297302 0.000000
    """
    if type(x) is float:
        short = max(-x, 0.0)
        half = math.sqrt(short)  # to the last bit as numpy's, which roots alone are
        return short * half * math.sqrt(half)
    short = np.maximum(-x, 0.0)
    half = np.sqrt(short)
    return short * half * np.sqrt(half)


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


def touch_range(coefficients: Sequence[float], alpha: tuple[float, float]) -> tuple[float, float]:
    """Return the lowest and the highest g_touch of a range of alpha; 1 without coefficients.

    Examples
    --------
    >>> low, high = touch_range((0.0, 1.0), (2.0, 3.0))
    >>> print(f"{low:.3f} {high:.3f}")
    2.000 3.000
    """
    if not coefficients:
        return 1.0, 1.0
    low, high = (float(np.log(a)) for a in alpha)
    roots: Any = np.polynomial.Polynomial(coefficients).deriv().roots()
    level = [row.real for row in roots if abs(row.imag) < 1e-9 and low < row.real < high]
    logs = [float(log_touch(coefficients, row)) for row in (low, high, *level)]
    return math.exp(min(logs)), math.exp(max(logs))

"""The far-field limit of the contact: a wire that opens a crack from far behind its tip.

In linear elasticity with a Hertz contact, all three functions follow from one number p(g),

    p ln(k p) = pi/3,   k = (32 sqrt(e/pi)/g)^(2/3),
    A = 4 sqrt(p/pi),   B = 4 p,   delta/R_w = 8 p^2/(pi g),

which Lambert's function solves: p = (pi/3)/W(k pi/3). It is written here in ln(k pi/3) = w + ln w,
which neither over- nor underflows. As g goes to 0 all three change by powers of ln g: A and B fall
to 0, however slowly, and delta rises a little less than 1/g does.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from surrogate.basics.elementwise import exp, log, where

__all__ = ["wedge_functions", "wedge_load", "wedge_slope", "wedge_slopes"]

THIRD = math.pi / 3.0
CONSTANT = math.log(THIRD) + math.log(32.0 * math.sqrt(math.e / math.pi)) * (2.0 / 3.0)
_STEPS = 3


def wedge_load(log_g: Any) -> Any:
    """Return p at ln g, 0 where that is minus infinity.

    Parameters
    ----------
    log_g : float or ndarray
        ln g, at most ln(1e4).

    Returns
    -------
    float or ndarray
        p = B/4 [-].

    References
    ----------
    F. N. Fritsch, R. E. Shafer and W. P. Crowley, Commun. ACM 16 (1973) 123 (the iteration).

    Examples
    --------
    >>> print(f"{wedge_load(math.log(1e-3)):.6f}")
    0.199297
    """
    return where(log_g == -math.inf, 0.0, THIRD / _lambert(log_g))


def wedge_slope(log_g: Any) -> Any:
    """Return d ln p/d ln g = (2/3)/(1 + W).

    Examples
    --------
    >>> print(f"{wedge_slope(math.log(1e-3)):.6f}")
    0.106591
    """
    return (2.0 / 3.0) / (1.0 + _lambert(log_g))


def wedge_functions(log_g: Any, p: Any) -> dict[str, Any]:
    """Return A, B and delta/R_w from ln g and p, and A* = A and B* = B; delta is infinite at g = 0.

    Examples
    --------
    >>> at = wedge_functions(math.log(1e-3), wedge_load(math.log(1e-3)))
    >>> print(*(f"{name} {value:.4f}" for name, value in at.items()))
    arc 1.0075 normal_load 0.7972 distance 101.1443 slip_arc 1.0075 slip_load 0.7972
    """
    root = np.sqrt(p / math.pi)
    arc, load = 4.0 * (root if isinstance(root, np.ndarray) else float(root)), 4.0 * p
    far = where(log_g == -math.inf, -1e3, log_g)
    with np.errstate(over="ignore"):
        distance = (8.0 / math.pi) * p * p * exp(-far)
    return {
        "arc": arc,
        "normal_load": load,
        "distance": where(log_g == -math.inf, math.inf, distance),
        "slip_arc": arc,
        "slip_load": load,
    }


def wedge_slopes(log_g: Any) -> dict[str, Any]:
    """Return d ln/d ln g of A, B, delta, A* and B*.

    Examples
    --------
    >>> print(*(f"{name} {value:.4f}" for name, value in wedge_slopes(math.log(1e-3)).items()))
    arc 0.0533 normal_load 0.1066 distance -0.7868 slip_arc 0.0533 slip_load 0.1066
    """
    slope = wedge_slope(log_g)
    return {
        "arc": 0.5 * slope,
        "normal_load": slope,
        "distance": 2.0 * slope - 1.0,
        "slip_arc": 0.5 * slope,
        "slip_load": slope,
    }


def _lambert(log_g: Any) -> Any:
    """Return w with w + ln w = CONSTANT - (2/3) ln g."""
    total = CONSTANT - (2.0 / 3.0) * log_g
    total = where(total > 1e3, 1e3, total)  # of g = 0, whose value is replaced
    far = where(total > 1.0, total, 1.0)
    w = where(total > 1.0, far - log(far) * (1.0 - 1.0 / far), _near(total))
    for _ in range(_STEPS):
        z = total - log(w) - w
        q = 2.0 * (1.0 + w) * (1.0 + w + (2.0 / 3.0) * z)
        w = w * (1.0 + z / (1.0 + w) * ((q - z) / (q - 2.0 * z)))
    return w


def _near(total: Any) -> Any:
    """Return a first guess of w where the total is at most 1; exp(total) far below."""
    low = where(total < -3.0, total, -3.0)
    inner = where(total > 1.0, 1.0, where(total < -3.0, -3.0, total))
    power = exp(low)
    middle = 0.5671 + inner * (0.3619 + inner * (0.0737 + inner * 0.0004))
    return where(total < -3.0, power, middle)

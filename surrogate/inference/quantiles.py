"""Quantiles that turn a standard error into a confidence interval, without scipy."""

from __future__ import annotations

import math
from statistics import NormalDist

import numpy as np

__all__ = [
    "chi_squared_limit",
    "exceeds_f",
    "normal_quantile",
    "student_limit",
    "student_quantile",
    "student_tail",
]

_LARGEST_SUMMED = 1000
"""Degrees of freedom up to which the finite sum is used; a series in 1/dof above."""


def normal_quantile(confidence: float) -> float:
    """Half width, in standard deviations, of the central interval of a normal distribution.

    Parameters
    ----------
    confidence : float
        Probability inside the interval [-], between 0 and 1.

    Returns
    -------
    float
        z with P(|Z| <= z) = `confidence` [-].

    References
    ----------
    M. J. Wichura, Applied Statistics 37 (1988) 477 (the standard library's algorithm).

    Examples
    --------
    >>> print(f"{normal_quantile(0.95):.6f}")
    1.959964
    """
    return -NormalDist().inv_cdf(0.5 * (1.0 - confidence))


def student_quantile(confidence: float, dof: int) -> float:
    """Half width, in standard errors, of the central interval of Student's t distribution.

    For up to 1000 degrees of freedom the distribution is the finite sum that an integer
    number of them allows, all of whose terms are positive; above, the expansion about the
    normal quantile to third order. Both hold 9 digits for confidences up to 0.999999.

    Parameters
    ----------
    confidence : float
        Probability inside the interval [-], between 0 and 1.
    dof : int
        Degrees of freedom, 1 or more.

    Returns
    -------
    float
        t with P(|T| <= t) = `confidence` [-].

    References
    ----------
    M. Abramowitz and I. A. Stegun, Handbook of Mathematical Functions, 26.7.3, 26.7.4, 26.7.5.

    Examples
    --------
    >>> print(f"{student_quantile(0.95, 3):.6f}")
    3.182446
    """
    if dof > _LARGEST_SUMMED:
        return _student_far(normal_quantile(confidence), dof)
    low, high = 0.0, 0.5 * math.pi
    while low < (angle := 0.5 * (low + high)) < high:
        if _student_probability(angle, dof) < confidence:
            low = angle
        else:
            high = angle
    return math.sqrt(dof) * math.tan(low)


def _student_probability(angle: float, dof: int) -> float:
    """P(|T| <= sqrt(dof) tan(angle)), Abramowitz and Stegun 26.7.3 and 26.7.4."""
    sine, cosine = math.sin(angle), math.cos(angle)
    powers = np.arange(3 if dof % 2 else 2, dof - 1, 2)
    terms = np.cumprod((1.0 - 1.0 / powers) * cosine**2)
    if dof % 2 == 0:
        return float(sine * (1.0 + terms.sum()))
    series = sine * cosine * (1.0 + terms.sum()) if dof > 1 else 0.0
    return float(2.0 / math.pi * (angle + series))


def _student_far(z: float, dof: int) -> float:
    first = (z**3 + z) / 4.0
    second = (5.0 * z**5 + 16.0 * z**3 + 3.0 * z) / 96.0
    third = (3.0 * z**7 + 19.0 * z**5 + 17.0 * z**3 - 15.0 * z) / 384.0
    return z + first / dof + second / dof**2 + third / dof**3


def chi_squared_limit(dof: int, probability: float) -> float:
    """Value that chi^2/dof exceeds with a probability, after Wilson and Hilferty.

    Parameters
    ----------
    dof : int
        Degrees of freedom.
    probability : float
        Of exceeding it [-].

    Examples
    --------
    >>> print(f"{chi_squared_limit(4, 0.01):.2f}")
    3.33
    """
    z = normal_quantile(1.0 - 2.0 * probability)
    variance = 2.0 / (9.0 * dof)
    return float((1.0 - variance + z * np.sqrt(variance)) ** 3)


def exceeds_f(ratio: float, dofs: tuple[int, int], probability: float) -> bool:
    """Whether a ratio of variances is above what F exceeds with a probability, after Paulson.

    Parameters
    ----------
    ratio : float
        Of the variances [-].
    dofs : tuple of int
        Degrees of freedom above and below.
    probability : float
        Of exceeding it [-].

    References
    ----------
    E. Paulson, Annals of Mathematical Statistics 13 (1942) 233.

    Examples
    --------
    >>> exceeds_f(4.0, (3, 20), 0.01), exceeds_f(6.0, (3, 20), 0.01)
    (False, True)
    """
    above, below = (2.0 / (9.0 * dof) for dof in dofs)
    root = ratio ** (1.0 / 3.0)
    z = ((1.0 - below) * root - (1.0 - above)) / math.sqrt(below * root**2 + above)
    return bool(z > normal_quantile(1.0 - 2.0 * probability))


def student_tail(t: float, dof: float) -> float:
    """Probability that Student's t is beyond t on either side, for any degrees of freedom.

    Parameters
    ----------
    t : float
        0 or more [-].
    dof : float
        Degrees of freedom above 0; infinite for the normal distribution.

    References
    ----------
    M. Abramowitz and I. A. Stegun, Handbook of Mathematical Functions, 26.5.8, 26.7.1.

    Examples
    --------
    >>> print(f"{student_tail(3.182446, 3.0):.6f} {student_tail(1.959964, math.inf):.6f}")
    0.050000 0.050000
    """
    if math.isinf(dof):
        return math.erfc(t / math.sqrt(2.0))
    x = dof / (dof + t * t)
    return _beta_share(x, 0.5 * dof, 0.5)


def student_limit(confidence: float, dof: float) -> float:
    """Half width, in standard errors, that Student's t is within, for any degrees of freedom.

    Examples
    --------
    >>> print(f"{student_limit(0.95, 3.0):.6f} {student_limit(0.95, math.inf):.6f}")
    3.182446 1.959964
    """
    if math.isinf(dof):
        return normal_quantile(confidence)
    low, high = 0.0, 1.0
    while student_tail(high, dof) > 1.0 - confidence and high < 1e150:
        low, high = high, 2.0 * high
    for _ in range(100):
        middle = 0.5 * (low + high)
        if student_tail(middle, dof) > 1.0 - confidence:
            low = middle
        else:
            high = middle
    return high


def _beta_share(x: float, a: float, b: float) -> float:
    """Return the regularised incomplete beta function, by its continued fraction."""
    if not 0.0 < x < 1.0:
        return min(max(x, 0.0), 1.0)
    if x > (a + 1.0) / (a + b + 2.0):
        return 1.0 - _beta_share(1.0 - x, b, a)
    front = math.lgamma(a + b) - math.lgamma(a) - math.lgamma(b)
    front += a * math.log(x) + b * math.log1p(-x)
    c, d = 1.0, 1.0 / (1.0 - (a + b) * x / (a + 1.0))
    total = d
    for m in range(1, 500):  # Lentz's method: an even and an odd step at a time
        for step in (
            m * (b - m) * x / ((a + 2 * m - 1.0) * (a + 2 * m)),
            -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1.0)),
        ):
            d, c = 1.0 / (1.0 + step * d), 1.0 + step / c
            total *= c * d
        if abs(c * d - 1.0) < 1e-15:
            break
    return math.exp(front) * total / a

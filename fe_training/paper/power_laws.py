"""What the finite-element results say beside the paper's scaling laws: exponents, fits, errors.

Everything here is arithmetic on arrays; nothing is solved.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fe_training.paper.curve import Curve
from surrogate import Scene
from surrogate.choosing.laws import of_law
from surrogate.cutting.force import force_of
from surrogate.equations import TABLE_1
from surrogate.errors import InputError

__all__ = [
    "COUPLED_FRICTION",
    "RANGES",
    "PowerFit",
    "eq13_beside_coupled",
    "eq13_error",
    "fit_power",
    "fits",
    "local_exponent",
    "over_lower_end",
    "reached_from",
]

Floats = NDArray[np.float64]

#: Friction coefficients at which Eq. (13) is held against the law "coupled".
COUPLED_FRICTION = (0.005, 0.02, 0.1)


@dataclass(frozen=True, slots=True)
class PowerFit:
    """A power law y = C x^n fitted by least squares in the logarithms.

    Parameters
    ----------
    exponent : float
        n [-].
    prefactor : float
        C, 1 where it was prescribed.
    r_squared : float
        Share of the variance of ln y that the law explains; negative where the mean does better.
    largest_error : float
        Largest |C x^n/y - 1| [-].
    points : int
        How many were fitted.
    """

    exponent: float
    prefactor: float
    r_squared: float
    largest_error: float
    points: int


def fit_power(x: ArrayLike, y: ArrayLike, unit_prefactor: bool = False) -> PowerFit:
    """Return the power law through points, least squares in ln x and ln y.

    Parameters
    ----------
    x, y : array_like, shape (points,)
        Positive numbers.
    unit_prefactor : bool
        Whether C = 1 is prescribed, as Eq. (9) of the paper is written.

    Returns
    -------
    PowerFit

    Raises
    ------
    InputError
        If there are fewer than three points, or if one is not positive.

    References
    ----------
    arXiv:2412.02021, Eq. (9) and Table 1.

    Examples
    --------
    >>> fit = fit_power([1.0, 2.0, 4.0], [3.0, 6.0, 12.0])
    >>> print(f"{fit.prefactor:.3f} x^{fit.exponent:.3f}, r^2 = {fit.r_squared:.3f}")
    3.000 x^1.000, r^2 = 1.000
    """
    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    if len(x) < 3 or not (np.all(x > 0.0) and np.all(y > 0.0)):
        raise InputError(
            f"a power law is fitted to three positive points or more; {len(x)} were given, "
            f"{int(np.sum(x > 0.0))} and {int(np.sum(y > 0.0))} positive ones."
        )
    log_x, log_y = np.log(x), np.log(y)
    if unit_prefactor:
        n, log_c = float(log_x @ log_y / (log_x @ log_x)), 0.0
    else:
        n, log_c = (float(value) for value in np.polyfit(log_x, log_y, 1))
    left = log_y - (n * log_x + log_c)
    spread = log_y - log_y.mean()
    return PowerFit(
        exponent=n,
        prefactor=float(np.exp(log_c)),
        r_squared=float(1.0 - left @ left / (spread @ spread)),
        largest_error=float(np.abs(np.expm1(-left)).max()),
        points=len(x),
    )


def local_exponent(x: ArrayLike, y: ArrayLike) -> Floats:
    """Return d ln y/d ln x at each point, by central differences of second order.

    Parameters
    ----------
    x, y : array_like, shape (points,)
        Positive numbers, x rising or falling.

    Returns
    -------
    ndarray, shape (points,)
        The slope in a double logarithmic plot [-].

    Examples
    --------
    >>> x = np.geomspace(1.0, 10.0, 5)
    >>> print(local_exponent(x, 3.0 * x**-2).round(6))
    [-2. -2. -2. -2. -2.]
    """
    log_x, log_y = (np.log(np.asarray(values, dtype=float)) for values in (x, y))
    return np.asarray(np.gradient(log_y, log_x))


def eq13_error(
    g: ArrayLike, arc: ArrayLike, normal_load: ArrayLike, xi: Any, wear_to_friction: Any
) -> Floats:
    """Return the error of Eq. (13) relative to the finite elements.

    Parameters
    ----------
    g : array_like
        Gamma_o/(mu R_w) [-].
    arc, normal_load : array_like
        A and B of the finite elements at this g [-].
    xi : float or array_like
        Friction coefficient [-].
    wear_to_friction : float or array_like
        tau_w/(mu xi) [-].

    Returns
    -------
    ndarray
        Eq. (13) over g + 2 xi [(tau_w/(mu xi)) A + B], the force in mu R_w, minus one [-].

    References
    ----------
    arXiv:2412.02021, Eqs. (6), (13) and (S2).

    Examples
    --------
    >>> print(f"{eq13_error(1.0, 2.0, 2.5, 0.5, 3.0):.6f}")
    0.000000
    """
    g, A, B = (np.asarray(values, dtype=float) for values in (g, arc, normal_load))
    xi, ratio = np.asarray(xi, dtype=float), np.asarray(wear_to_friction, dtype=float)
    paper = (1.0 + xi) * g + 4.0 * xi * (1.0 + ratio)
    return np.asarray(paper / (g + 2.0 * xi * (ratio * A + B)) - 1.0)


def eq13_beside_coupled(
    g: ArrayLike, alpha: float, xi: float, wear_to_friction: Any
) -> tuple[Floats, Floats]:
    """Return the error of Eq. (13) beside the law "coupled", and the bound of the latter's own.

    Parameters
    ----------
    g : array_like
        Gamma_o/(mu R_w) [-].
    alpha : float
        Stiffening exponent [-].
    xi : float
        Friction coefficient [-].
    wear_to_friction : float or array_like
        tau_w/(mu xi) [-].

    Returns
    -------
    error, own : ndarray
        Both relative [-]; nan where no coupled solution is near.

    References
    ----------
    arXiv:2412.02021, Eq. (13).

    Examples
    --------
    >>> error, own = eq13_beside_coupled([0.1, 1e3], 5.0, 0.01, 1.0)
    >>> bool(own[0] < error[0] < 0.3), bool(np.isnan(error[1]))
    (True, True)
    """
    scene = Scene(1.0, g, 1.0, xi, xi * np.asarray(wear_to_friction, dtype=float), alpha)
    coupled = force_of(scene, of_law("table", "coupled"), outside="nan")
    paper = np.asarray(force_of(scene, "eq13").total)
    return paper / np.asarray(coupled.total) - 1.0, np.asarray(coupled.relative_error)


def reached_from(size: ArrayLike, value: ArrayLike, limit: float, tolerance: float) -> float:
    """Return the size from which on a quantity stays within a tolerance of its limit.

    Parameters
    ----------
    size : array_like, shape (points,)
        Rising, for instance H/R_w.
    value : array_like, shape (points,)
        The quantity at each size.
    limit : float
        Its value at infinite size.
    tolerance : float
        Relative difference allowed.

    Returns
    -------
    float
        Interpolated in the logarithms of size and difference; the smallest size given where all
        are within the tolerance, infinity where the largest is not.

    Examples
    --------
    >>> print(f"{reached_from([10.0, 100.0, 1000.0], [1.1, 1.01, 1.001], 1.0, 0.05):.1f}")
    20.0
    """
    size = np.asarray(size, dtype=float)
    off = np.abs(np.asarray(value, dtype=float) / limit - 1.0)
    outside = np.flatnonzero(off > tolerance)
    if not len(outside):
        return float(size[0])
    last = int(outside[-1])
    if last == len(size) - 1:
        return float("inf")
    tiny = np.finfo(float).tiny
    ends = np.log(np.maximum(off[last : last + 2], tiny))
    share = (ends[0] - np.log(tolerance)) / (ends[0] - ends[1])
    return float(np.exp(np.log(size[last]) + share * np.log(size[last + 1] / size[last])))


RANGES = ((1.0, 100.0), (5.0, 100.0), (10.0, 100.0), (30.0, 100.0))
"""Ranges of g: all that can be called large, and less and less of it."""

_FEWEST = 3
_NAMES = (
    "alpha",
    "g_from",
    "g_to",
    "points",
    "n_table_1",
    "n",
    "C",
    "r2",
    "largest_error",
    "n_where_C_is_1",
    "r2_where_C_is_1",
    "largest_error_where_C_is_1",
)


def fits(curves: Sequence[Curve]) -> dict[str, Floats]:
    """Return Table 1 beside power laws C g^n fitted to 2 B, the friction without wear.

    Parameters
    ----------
    curves : sequence of Curve
        One for each alpha.

    Returns
    -------
    dict of str to ndarray
        One entry for each alpha and range in `RANGES`: alpha, the ends of g and the points between
        them; n of Table 1; n, C, r^2 and largest relative error of C g^n; the same with C = 1, as
        Eq. (9) is written [-].

    References
    ----------
    arXiv:2412.02021, Eqs. (9) and (S2), Table 1.
    """
    lines = [line for one in curves for line in _lines(one)]
    columns = np.array(lines, dtype=float).reshape(-1, len(_NAMES)).T
    return dict(zip(_NAMES, columns, strict=True))


def _lines(one: Curve) -> Iterator[tuple[Any, ...]]:
    for low, high in RANGES:
        chosen = one.between(low, high)
        if chosen.sum() < _FEWEST:
            continue
        free, bound = (fit_power(one.g[chosen], _friction(one)[chosen], c) for c in (False, True))
        yield (
            one.alpha,
            low,
            high,
            free.points,
            TABLE_1.get(one.alpha, np.nan),
            free.exponent,
            free.prefactor,
            free.r_squared,
            free.largest_error,
            bound.exponent,
            bound.r_squared,
            bound.largest_error,
        )


def over_lower_end(one: Curve, unit_prefactor: bool) -> tuple[Floats, Floats]:
    """Return n of a fit from each g to the largest one, over that g.

    Parameters
    ----------
    one : Curve
        The finite elements.
    unit_prefactor : bool
        Whether C = 1.

    Returns
    -------
    tuple of ndarray
        The lower ends, from g = 1 on as long as three points remain, and n [-].
    """
    starts = [i for i in np.flatnonzero(one.g >= 1.0) if len(one.g) - i >= _FEWEST]
    friction = _friction(one)
    n = [fit_power(one.g[i:], friction[i:], unit_prefactor).exponent for i in starts]
    return one.g[starts], np.array(n, dtype=float)


def _friction(one: Curve) -> Floats:
    """Return F_d/(xi mu R_w T) where tau_w = 0, Eq. (S2)."""
    return 2.0 * one.normal_load

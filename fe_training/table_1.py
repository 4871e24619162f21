"""Table 1 of the paper: power laws of the friction, over stated ranges and with both prefactors."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from surrogate.equations import TABLE_1

from .comparison import fit_power
from .curve import Curve

__all__ = ["RANGES", "fits", "over_lower_end"]

Floats = NDArray[np.float64]

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

"""Fitting the constants of the formula "power-law", and Eq. (9) for each alpha by itself."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from fe_training.fitting.points import FitPoints
from fe_training.fitting.touch import Touch
from surrogate.contact.coordinates import SLIP_QUANTITIES, log_touch
from surrogate.contact.formula import arc_formula, distance_formula, load_formula

__all__ = ["eq9_fits", "fit_blend"]

Floats = NDArray[np.float64]

_START = {
    "arc": (0.01, 2.0, -3.0, 0.33, 3.3, 1.0),
    "normal_load": (0.6, -2.3, 1.3, 1.2, 1.4, -0.5),
    "distance": (0.6, -0.6, 1.75, 3.0),
    "slip_arc": (0.6, -0.5, -1.0, 0.0, 1.0, -1.0),
    "slip_load": (0.6, -1.5, 1.0, 0.5, 1.9, -1.0),
}

#: Errors are made equal by raising them, in units of the first, to the second, which brings the
#: largest ones down.
_UNIT, _NORM = 0.02, 16

#: Eq. (9) is fitted from this g on, "much greater than 1" in the paper.
_HIGH = 10.0
_FARTHEST = 20.0
_GAP_FLOOR = 2e-3  # below this, delta - 1 is not what delta is to be judged by


def fit_blend(
    points: FitPoints, touch: Touch, start: Mapping[str, tuple[float, ...]] | None = None
) -> dict[str, tuple[float, ...]]:
    """Return the constants of `surrogate.contact.formula.BlendModel`.

    The largest relative errors of A and B and of delta - 1 are made small, not their squares.

    Parameters
    ----------
    points : FitPoints
        What was computed.
    touch : Touch
        g_touch(alpha).
    start : mapping of str to tuple of float, optional
        Constants of an earlier fit, from which less is left to do.

    Returns
    -------
    dict of str to tuple of float
        By the names of the quantities that the points have.
    """
    log_g, y = np.log(points.g), 1.0 - 2.0 / points.alpha
    touched = log_touch(touch.coefficients, np.log(points.alpha))
    gap = points.distance - 1.0
    far = (gap > _GAP_FLOOR) & (log_g < touched)

    def distance_misfit(c: Floats) -> Floats:
        value = distance_formula(c, log_g[far], y[far], touched[far])[0]
        return np.asarray(np.log(value) - np.log(points.distance[far]))

    def misfit_of(name: str) -> Callable[[Floats], Floats]:
        formula = arc_formula if name == "arc" else partial(load_formula, name=name)
        values = np.log(getattr(points, name))
        return lambda constants: np.log(formula(constants, log_g, y)[0]) - values

    misfits = {name: misfit_of(name) for name in points.names}
    misfits["distance"] = distance_misfit
    if start is not None:
        return {
            name: _fitted(misfit, start[name], (_NORM,), _farthest(name))
            for name, misfit in misfits.items()
        }
    norms = (2, 4, 8, _NORM)
    return {
        name: _fitted(misfit, _START[name], norms, _farthest(name))
        for name, misfit in misfits.items()
    }


def _farthest(name: str) -> float:
    """Return how far from 0 a constant may be: those of A* and B* are not all decided by them."""
    return _FARTHEST if name in SLIP_QUANTITIES else np.inf


def _fitted(
    misfit: Callable[[Floats], Floats],
    start: tuple[float, ...],
    norms: tuple[int, ...],
    farthest: float,
) -> tuple[float, ...]:
    """Return the constants that make a misfit small, in one norm after the other."""

    def raised(at: Floats, norm: int) -> Floats:
        with np.errstate(all="ignore"):
            error = np.nan_to_num(misfit(at), nan=1e3, posinf=1e3, neginf=-1e3)
        scaled = np.minimum(np.abs(error) / _UNIT, 1e3) ** (0.5 * norm)
        return np.asarray(np.sign(error) * scaled)

    constants = np.array(start)
    for norm in norms:
        bounds = -farthest, farthest
        constants = least_squares(raised, constants, bounds=bounds, max_nfev=500, args=(norm,)).x
    return tuple(map(float, constants))


def eq9_fits(points: FitPoints) -> list[dict[str, float]]:
    """Return for each alpha the power law of Eq. (9), F_d/(xi mu R_w T) = 2 B = c g^n.

    Parameters
    ----------
    points : FitPoints
        What was computed.

    Returns
    -------
    list of dict
        For each alpha: n and the factor c by least squares of ln 2B, r2 of that line, and
        `n_without_factor` with c = 1 as in Eq. (9) itself, with its r2; all for g from
        `lowest_g` to `highest_g`. Alphas with fewer than three points there are left out.
    """
    found = []
    for alpha in np.unique(points.alpha):
        here = points.taken((points.alpha == alpha) & (points.g >= _HIGH))
        if len(here) < 3:
            continue
        x, y = np.log(here.g), np.log(2.0 * here.normal_load)
        n, offset = np.polyfit(x, y, 1)
        bare = float(x @ y / (x @ x))
        found.append(
            {
                "alpha": float(alpha),
                "n": float(n),
                "factor": float(np.exp(offset)),
                "r2": _r2(y, n * x + offset),
                "n_without_factor": bare,
                "r2_without_factor": _r2(y, bare * x),
                "lowest_g": float(here.g[0]),
                "highest_g": float(here.g[-1]),
            }
        )
    return found


def _r2(y: Floats, fit: Floats) -> float:
    return float(1.0 - np.sum((y - fit) ** 2) / np.sum((y - y.mean()) ** 2))

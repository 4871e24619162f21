"""Fitting g_touch(alpha), the toughness from which on the crack tip touches the wire."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fe_training.fitting.points import FitPoints
from surrogate.contact.coordinates import POWER, log_touch
from surrogate.errors import InputError

__all__ = ["Touch", "fit_touch"]

Floats = NDArray[np.float64]

#: Below this delta - 1 is that of a tip in contact, which it meets within the solver's tolerance.
_TOUCHING = 1e-6

#: Smallest standard error of ln g_touch that is believed.
_SMALLEST_ERROR = 2e-3

#: Standard error of ln g_touch where it was not found and the line of the last two is followed.
_GUESS_ERROR = 0.3
_LARGEST_DEGREE = 4


@dataclass(frozen=True, slots=True, eq=False)
class Touch:
    """g_touch(alpha).

    Parameters
    ----------
    coefficients : tuple of float
        Of ln g_touch in powers of ln alpha, rising.
    alpha, g : ndarray, shape (alphas,)
        Stiffening exponents and the g_touch found at each [-].
    std : ndarray, shape (alphas,)
        Standard error of each ln g_touch [-].
    misfit : float
        Root mean square of ln g_touch - polynomial [-].
    """

    coefficients: tuple[float, ...]
    alpha: Floats
    g: Floats
    std: Floats
    misfit: float

    @property
    def error(self) -> float:
        """Standard error of ln g_touch at any alpha [-]."""
        return max(self.misfit, _SMALLEST_ERROR)


def fit_touch(points: FitPoints) -> Touch:
    """Return g_touch(alpha) from the distances on either side of the touch.

    For each alpha it is between the last point short of it and the first past it, where the line
    of (delta - 1)^(4/7) in ln g through the last two points before meets 0.

    Parameters
    ----------
    points : FitPoints
        What was computed.

    Returns
    -------
    Touch

    Raises
    ------
    InputError
        If fewer than two alphas have two points short of the touch and one past it.
    """
    found = []
    for alpha in np.unique(points.alpha):
        here = points.taken(points.alpha == alpha)
        short = here.distance - 1.0 > _TOUCHING
        last = int(np.max(np.flatnonzero(short), initial=-1))
        if last >= 1 and last + 1 < len(here):  # else the touch is not among the points
            found.append((alpha, *_touch_of(here.taken(slice(last - 1, last + 2)))))
    if len(found) < 2:
        raise InputError(
            f"{len(found)} alphas have two points short of the touch of the tip and one past it, "
            "but two are needed to find g_touch(alpha); solve more g, or more alphas."
        )
    alpha, g, std = np.array(found).T
    coefficients = _polynomial(np.log(alpha), np.log(g), std, np.log(np.unique(points.alpha)))
    misfit = float(np.sqrt(np.mean((log_touch(coefficients, np.log(alpha)) - np.log(g)) ** 2)))
    return Touch(coefficients, alpha, g, std, misfit)


def _polynomial(x: Floats, y: Floats, std: Floats, all_x: Floats) -> tuple[float, ...]:
    """Return the coefficients of y(x), which goes on straight to those x where y was not found."""
    left = all_x[all_x > x[-1] + 1e-9]
    slope = (y[-1] - y[-2]) / (x[-1] - x[-2])
    there = np.append(x, left), np.append(y, y[-1] + slope * (left - x[-1]))
    weight = 1.0 / np.append(std, np.full(len(left), _GUESS_ERROR))
    degree = min(_LARGEST_DEGREE, max(1, len(x) - 1), len(there[0]) - 1)
    return tuple(map(float, np.polynomial.polynomial.polyfit(*there, degree, w=weight)))


def _touch_of(three: FitPoints) -> tuple[float, float]:
    """Return g_touch from two points before it and one past it, and the error of its logarithm."""
    (one, two, past), gap = np.log(three.g), np.maximum(three.distance - 1.0, 0.0)
    first, last = gap[:2] ** (1.0 / POWER)
    way = last * (two - one) / max(first - last, 1e-300)
    log_g = float(np.clip(two + way, two, past))
    return float(np.exp(log_g)), float(np.hypot(0.25 * (log_g - two), _SMALLEST_ERROR))

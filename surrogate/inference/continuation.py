"""How far a model's A and B may be off at any g, beyond the model's range as well.

Inside its domain the bounds are those that were measured beside finite elements. Beyond it a fitted
model is continued by its asymptotes. What these leave out is a slope in ln g that is the same for
all wires: the error begins with the largest bound of the cells at that end and drifts away in
proportion to the distance in ln g, at the rate of the largest slope that the continuation drops at
that end for any alpha, and of no less than the bound for each factor e. That at one alpha is no
measure: where made-up solids went on otherwise, the intervals that rested on it held the truth too
seldom (`scripts/coverage`). No arc past the touch is longer than A = 2.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from surrogate.choosing.accuracy import contact_bounds, std_of_bound
from surrogate.contact.base import ForceModel
from surrogate.contact.fitted import FittedModel
from surrogate.coupling.frozen import FrozenLoad

__all__ = ["CORRELATION_LENGTH", "ContactError", "contact_error", "correlation", "is_continued"]

Array = NDArray[np.float64]

LARGEST_ERROR = float(np.log(2.0))
"""Of ln A: an arc past the touch is between 1 and 2."""

FARTHEST = 700.0
"""In ln g, where the smallest float is."""

_TINY = float(np.exp(-FARTHEST))

EXPONENTS = 15
"""At which the slopes at the ends are looked at."""

CORRELATION_LENGTH = 1.0
"""Distance in ln g over which a model's errors inside its domain go together. A fit follows
solutions that are closer than that, and its cells of bounds are wider. Errors of a longer reach
would only scale tau_w, those of a shorter one average out over the wires like scatter."""


@dataclass(frozen=True, eq=False)
class ContactError:
    """Standard deviations of the relative errors of A and B [-], each of the shape of g.

    Parameters
    ----------
    arc, load : ndarray
        Of the model at the nearest g inside its range.
    arc_drift, load_drift : ndarray
        Of the continuation beyond, the same for all wires but for this factor.
    below, above : ndarray of bool
        Beyond which end.
    factor, factor_drift : ndarray, or None
        Of what both are multiplied by under the law "coupled": within the reach of its solutions,
        and what comes on top beyond it, the same for all wires but for this factor.
    """

    arc: Array
    load: Array
    arc_drift: Array
    load_drift: Array
    below: NDArray[np.bool_]
    above: NDArray[np.bool_]
    factor: Array | None = None
    factor_drift: Array | None = None


def is_continued(model: ForceModel) -> bool:
    """Return whether a model may be evaluated beyond its range.

    Examples
    --------
    >>> from surrogate.choosing.by_name import force_model
    >>> is_continued(force_model("table")), is_continued(force_model("eq13"))
    (True, False)
    """
    return isinstance(model, FittedModel)


def contact_error(model: ForceModel, g: Array, alpha: float) -> ContactError | None:
    """Return the errors of A and B, finite at every g; None for a model that nobody measured.

    Bound over sqrt(3), that of an error which may be anything up to its bound.

    Parameters
    ----------
    model : ForceModel
        The model.
    g : ndarray
        Where [-].
    alpha : float
        Stiffening exponent within the model's range [-].

    References
    ----------
    JCGM 100:2008, Guide to the expression of uncertainty in measurement, section 4.3.7.

    Examples
    --------
    >>> from surrogate.choosing.by_name import force_model
    >>> error = contact_error(force_model("table"), np.array([1.0, 100.0, 1e3, 1e4]), 2.0)
    >>> error.arc_drift[:2].tolist(), bool(error.arc_drift[2] < error.arc_drift[3])
    ([0.0, 0.0], True)
    """
    if not isinstance(model, FittedModel):
        return None
    low, high = model.ends(alpha)
    inside = np.minimum(np.maximum(g, low), high)
    bounds = contact_bounds(model, inside, alpha)
    if bounds is None:
        return None
    near = [np.fmin(bound, LARGEST_ERROR) for bound in bounds]
    factors: tuple[Array, ...] = ()
    if isinstance(model, FrozenLoad):
        factors = tuple(
            std_of_bound(np.fmin(part, LARGEST_ERROR))
            for part in np.broadcast_arrays(*model.own_error(np.maximum(g, _TINY), alpha))
        )
    below, above = g < low, g > high
    drifts = []
    slip = model.slip if isinstance(model, FrozenLoad) else model
    for bound, rates in zip(near, _dropped_slopes(slip), strict=True):
        drift = np.zeros_like(g)
        if np.any(below) or np.any(above):
            with np.errstate(divide="ignore"):
                beyond = np.abs(np.log(g) - np.log(inside))  # infinite at g = 0
            rate = np.maximum(np.where(below, *rates), bound)
            drift = np.where(below | above, np.minimum(beyond, FARTHEST) * rate, 0.0)
        drifts.append(std_of_bound(np.minimum(drift, LARGEST_ERROR)))
    arc, load = map(std_of_bound, near)
    return ContactError(arc, load, drifts[0], drifts[1], below, above, *factors)


@lru_cache(maxsize=64)
def _dropped_slopes(model: FittedModel) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return the largest of `_dropped_slopes_at` over the exponents that the model covers."""
    first, last = model.limits.alpha
    slopes = [_dropped_slopes_at(model, alpha) for alpha in np.linspace(first, last, EXPONENTS)]
    arc, load = np.max(slopes, axis=0).tolist()
    return (arc[0], arc[1]), (load[0], load[1])


def _dropped_slopes_at(model: FittedModel, alpha: float) -> Array:
    """Return d ln/d ln g of A and of B inside less that outside, at the low and the high end."""
    step, (low, high) = 1e-6, model.ends(alpha)
    g = np.array([low / (1.0 + step), low * (1.0 + step), high / (1.0 + step), high * (1.0 + step)])
    return np.array(
        [
            np.abs(np.diff((g * slopes[0] / value).reshape(2, 2))).ravel()
            for slopes, value in (
                (model.arc_slopes(g, alpha), model.arc(g, alpha)),
                (model.normal_load_slopes(g, alpha), model.normal_load(g, alpha)),
            )
        ]
    )


def correlation(radius: Array) -> Array:
    """Return the correlation of a model's errors on wires of one material, shape (m, m)."""
    log_radius = np.log(radius)
    apart = np.abs(log_radius[:, np.newaxis] - log_radius)
    return np.asarray(np.exp(-apart / CORRELATION_LENGTH))

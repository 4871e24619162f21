"""How far a model's A and B may be off at any g, beyond the model's range as well.

Inside its domain the bounds are those that were measured beside finite elements. Beyond it a fitted
model is continued by its asymptotes, and the bound begins with the largest of the cells at that end
and grows with the distance in ln g: by the slope that the continuation leaves out at the end, and
by no less than the bound itself for each factor e. No arc is longer than A = 2, which ends it.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from surrogate.choosing.accuracy import contact_bounds
from surrogate.contact.base import ForceModel
from surrogate.contact.fitted import FittedModel

__all__ = ["CORRELATION_LENGTH", "contact_error", "correlation", "is_continued"]

Array = NDArray[np.float64]

LARGEST_ERROR = float(np.log(2.0))
"""Of ln A: an arc past the touch is between 1 and 2."""

CORRELATION_LENGTH = 1.0
"""Distance in ln g over which a model's errors go together. A fit follows solutions that are closer
than that and its cells of bounds are wider. A longer one would only scale tau_w, a shorter one would
average out over the wires like scatter: neither could pull the toughness as far."""


def is_continued(model: ForceModel) -> bool:
    """Return whether a model may be evaluated beyond its range.

    Examples
    --------
    >>> from surrogate.choosing.by_name import force_model
    >>> is_continued(force_model("table")), is_continued(force_model("eq13"))
    (True, False)
    """
    return isinstance(model, FittedModel)


def contact_error(model: ForceModel, g: Array, alpha: float) -> tuple[Array, Array] | None:
    """Return the standard deviations of the relative errors of A and B [-], finite at every g.

    Bound over sqrt(3), that of an error which may be anything up to its bound.

    Parameters
    ----------
    model : ForceModel
        The model.
    g : ndarray
        Where [-].
    alpha : float
        Stiffening exponent within the model's range [-].

    Returns
    -------
    tuple of ndarray, or None
        None for a model that nobody measured.

    References
    ----------
    JCGM 100:2008, Guide to the expression of uncertainty in measurement, section 4.3.7.

    Examples
    --------
    >>> from surrogate.choosing.by_name import force_model
    >>> arc, load = contact_error(force_model("table"), np.array([1.0, 100.0, 1e4]), 2.0)
    >>> bool(arc[0] < arc[1] < arc[2] < 0.5)
    True
    """
    if not isinstance(model, FittedModel) or contact_bounds(model, 1.0, alpha) is None:
        return None
    low, high = model.limits.g
    inside = np.clip(g, low, high)
    near = contact_bounds(model, inside, alpha)
    assert near is not None
    with np.errstate(divide="ignore"):
        beyond = np.abs(np.log(g) - np.log(inside))  # infinite at g = 0
    rates = np.where(np.asarray(g < low)[..., np.newaxis], *_dropped_slopes(model, alpha))
    arc, load = (
        np.minimum(bound + np.where(beyond > 0.0, beyond * np.maximum(rate, bound), 0.0), limit)
        / np.sqrt(3.0)
        for bound, rate, limit in zip(
            near, np.moveaxis(rates, -1, 0), (LARGEST_ERROR, np.inf), strict=True
        )
    )
    return arc, np.minimum(load, 1.0)


def _dropped_slopes(model: FittedModel, alpha: float) -> tuple[Array, Array]:
    """Return, at the low and at the high end, d ln/d ln g of A and B inside less that outside."""
    step, (low, high) = 1e-6, model.limits.g
    g = np.array([low / (1.0 + step), low * (1.0 + step), high / (1.0 + step), high * (1.0 + step)])
    slopes = [
        g * in_g / value
        for (in_g, _), value in (
            (model.arc_slopes(g, alpha), model.arc(g, alpha)),
            (model.normal_load_slopes(g, alpha), model.normal_load(g, alpha)),
        )
    ]
    jumps = np.abs([[each[0] - each[1], each[2] - each[3]] for each in slopes])
    return jumps[:, 0], jumps[:, 1]


def correlation(g: Array) -> Array:
    """Return the correlation of the errors at several g, shape (..., m, m) for g of (..., m)."""
    with np.errstate(divide="ignore", invalid="ignore"):
        log_g = np.maximum(np.log(g), -700.0)
    return np.asarray(
        np.exp(-np.abs(log_g[..., :, np.newaxis] - log_g[..., np.newaxis, :]) / CORRELATION_LENGTH)
    )

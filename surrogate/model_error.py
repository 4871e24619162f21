"""The errors of a model's own A and B, as they were measured or as the model knows them."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from surrogate.force_models import FITTED_NAMES, ForceModel

__all__ = ["contact_bounds", "contact_std"]

Array = NDArray[np.float64]


def contact_bounds(model: ForceModel, g: Any, alpha: Any) -> tuple[Array, Array] | None:
    """Return the measured bounds of the relative errors of A and B at points.

    Parameters
    ----------
    model : ForceModel
        The model.
    g, alpha : float or ndarray
        Where [-].

    Returns
    -------
    tuple of ndarray, or None
        Of A and of B [-], infinite outside the domain; None for a model that is not fitted.

    Examples
    --------
    >>> from surrogate.force_models import force_model
    >>> arc, load = contact_bounds(force_model("table"), 1.0, 2.0)
    >>> bool(0.0 < load < 0.05)
    True
    """
    if model.name not in FITTED_NAMES:
        return None
    from surrogate.choice import available

    points = np.broadcast_arrays(g, alpha)
    bounds = available()[1]
    found = (bounds.at(model.name, name, *points) for name in ("arc", "normal_load"))
    arc, load = (np.asarray(np.expm1(each)) for each in found)
    return arc, load


def contact_std(model: ForceModel, g: Any, alpha: Any) -> tuple[Any, Any] | None:
    """Return the standard deviations of A and B: the model's own, or bound/sqrt(3) times A and B.

    The latter is that of an error which may be anything up to its bound.

    Parameters
    ----------
    model : ForceModel
        The model.
    g, alpha : float or ndarray
        Where [-].

    Returns
    -------
    tuple of float or ndarray, or None
        Of A and of B [-], nan outside the domain; None for closed forms.

    References
    ----------
    JCGM 100:2008, Guide to the expression of uncertainty in measurement, section 4.3.7.

    Examples
    --------
    >>> from surrogate.force_models import force_model
    >>> arc, load = contact_std(force_model("table"), 1.0, 2.0)
    >>> bool(0.0 < arc < 0.05)
    True
    """
    bounds = None if model.uncertain else contact_bounds(model, g, alpha)
    if bounds is None:
        return model.contact_std(g, alpha)
    values = model.contact(("arc", "normal_load"), g, alpha)
    arc, load = (
        np.where(np.isfinite(bound), value * bound / np.sqrt(3.0), np.nan)
        for value, bound in zip(values, bounds, strict=True)
    )
    return arc, load

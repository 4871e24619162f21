"""The errors of a model's own A and B, as they were measured or as the model knows them.

The one model that "auto" stands for where a single toughness does not tell which will do.

A slope, a transition radius and an identification need A and B over a range of g that is known
only afterwards. There "auto" is the cheapest model that is exact enough all over its domain.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.checks import RTOL, one_number
from surrogate.choosing.by_name import force_model, is_auto
from surrogate.contact.base import ForceModel
from surrogate.contact.fitted import COUPLED, SLIP, FittedModel
from surrogate.errors import AccuracyError

if TYPE_CHECKING:
    from surrogate.choosing.candidates import Candidates

__all__ = ["contact_bounds", "contact_std", "one_model", "std_of_bound"]

Array = NDArray[np.float64]


DEFAULT_RTOL = 0.02
"""What will do where nobody says otherwise, and some model is as exact."""


def contact_bounds(
    model: ForceModel, g: Any, alpha: Any, known: Candidates | None = None
) -> tuple[Any, Any] | None:
    """Return the measured bounds of the relative errors of A and B at points.

    Parameters
    ----------
    model : ForceModel
        The model.
    g, alpha : float or ndarray
        Where [-].
    known : Candidates, optional
        The models of its law; by default those in use.

    Returns
    -------
    tuple of float or ndarray, or None
        Of A and of B [-], infinite outside the domain; None for a model that is not fitted.

    Examples
    --------
    >>> from surrogate.choosing.by_name import force_model
    >>> arc, load = contact_bounds(force_model("table"), 1.0, 2.0)
    >>> bool(0.0 < load < 0.05)
    True
    """
    if not isinstance(model, FittedModel):
        return None
    if known is None:
        from surrogate.choosing.candidates import candidates

        known = candidates(law=SLIP if model.law == COUPLED else model.law)
    if not type(g) is type(alpha) is float and np.ndim(g) == np.ndim(alpha) == 0:
        g, alpha = float(g), float(alpha)
    return known.errors_at(model.name, g, alpha)


def contact_std(model: ForceModel, g: Any, alpha: Any) -> tuple[Any, Any] | None:
    """Return the standard deviations of A and B: the model's own, or bound/sqrt(3) times A and B.

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

    Examples
    --------
    >>> from surrogate.choosing.by_name import force_model
    >>> arc, load = contact_std(force_model("table"), 1.0, 2.0)
    >>> bool(0.0 < arc < 0.05)
    True
    """
    bounds = None if model.uncertain else contact_bounds(model, g, alpha)
    if bounds is None:
        return model.contact_std(g, alpha)
    values = model.arc(g, alpha), model.normal_load(g, alpha)
    arc, load = (
        np.where(np.isfinite(bound), std_of_bound(value * bound), np.nan)
        for value, bound in zip(values, bounds, strict=True)
    )
    return arc, load


def std_of_bound(bound: Any) -> Any:
    """Return the standard deviation of an error that may be anything up to its bound.

    References
    ----------
    JCGM 100:2008, Guide to the expression of uncertainty in measurement, section 4.3.7.

    Examples
    --------
    >>> print(std_of_bound(np.sqrt(3.0)))
    1.0
    """
    return bound / np.sqrt(3.0)


def one_model(name: object, rtol: object = None) -> ForceModel:
    """Return the model of a name; for "auto" the cheapest one that meets rtol everywhere.

    Parameters
    ----------
    name : str
        Name of a model, or "auto".
    rtol : float, optional
        Relative error of A and B that will do with "auto" [-]; by default 0.02 where a model is as
        exact, else that of the most exact one.

    Returns
    -------
    ForceModel
        The model; for "auto" the first whose `error` in `models` is at most rtol.

    Raises
    ------
    UnknownModelError
        If there is no such model.
    AccuracyError
        If the name is "auto" and no model is as exact; the message names the best one.
    InputError
        If rtol is not positive, or a fitted model's file is missing or damaged.

    Examples
    --------
    >>> one_model("eq13", 0.02).equation, one_model("auto", 5.0).equation
    ('Eq. (13)', 'Eq. (13)')
    """
    tolerance = DEFAULT_RTOL if rtol is None else one_number(RTOL, rtol)
    if not is_auto(name):
        return force_model(name)
    from surrogate.basics.digits import rounded_up
    from surrogate.choosing.candidates import available

    models, bounds = available()
    errors = [bounds.of_force(model.name) for model in models]
    for model, error in zip(models, errors, strict=True):
        if error <= tolerance:
            return model
    best = min(range(len(models)), key=errors.__getitem__)
    if rtol is None:  # the table is as exact as what it was made from, and quicker
        return next(
            m for m, error in zip(models, errors, strict=True) if error < 1.1 * errors[best]
        )
    raise AccuracyError(
        f"rtol must be met by a model all over its domain, but rtol = {tolerance:g} is not: the "
        f"best is {models[best].name!r} with an error of up to {errors[best]:.2g}; give "
        f"rtol={rounded_up(errors[best])} or more, or name the model."
    )

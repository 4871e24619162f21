"""The one model that "auto" stands for where a single toughness does not tell which will do.

A slope, a transition radius and an identification need A and B over a range of g that is known
only afterwards. There "auto" is the cheapest model that is exact enough all over its domain.
"""

from __future__ import annotations

from surrogate.errors import AccuracyError
from surrogate.force_models import ForceModel, force_model, is_auto
from surrogate.validation import RTOL, one_number

__all__ = ["one_model"]


def one_model(name: object, rtol: object) -> ForceModel:
    """Return the model of a name; for "auto" the cheapest one that meets rtol everywhere.

    Parameters
    ----------
    name : str
        Name of a model, or "auto".
    rtol : float
        Relative error of A and B that will do with "auto" [-].

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
    tolerance = one_number(RTOL, rtol)
    if not is_auto(name):
        return force_model(name)
    from surrogate.choice import available, rounded_up

    models, bounds = available()
    errors = [bounds.of_force(model.name) for model in models]
    for model, error in zip(models, errors, strict=True):
        if error <= tolerance:
            return model
    best = min(range(len(models)), key=errors.__getitem__)
    raise AccuracyError(
        f"rtol must be met by a model all over its domain, but rtol = {tolerance:g} is not: the "
        f"best is {models[best].name!r} with an error of up to {errors[best]:.2g}; give "
        f"rtol={rounded_up(errors[best])} or more, or name the model."
    )

"""Under which law forces are identified where nobody names one, and how far that law is off.

"coupled" is the most faithful law, and its error is known as far as coupled solutions reach. It is
taken where they reach to all cuts at the estimate. Where they do not reach to one of them nobody
knows the error of any law, and "projected" is taken, the one with an experiment behind it. "slip"
is never taken: where it is known to be exact enough "coupled" is known as well, costs no more that
counts, and gives the same.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from surrogate.basics.checks import shown
from surrogate.basics.digits import rounded_up
from surrogate.basics.elementwise import ratio
from surrogate.choosing.accuracy import contact_bounds, one_model
from surrogate.choosing.by_name import AUTO, force_model, is_auto
from surrogate.choosing.laws import COUPLED, LAWS, PROJECTED, SLIP, of_law
from surrogate.contact.base import ForceModel
from surrogate.contact.fitted import FittedModel
from surrogate.coupling.model import CoupledModel
from surrogate.errors import AccuracyError, DomainError, InputError
from surrogate.inference.coupled_fit import coupled_fit
from surrogate.inference.inputs import Cuts

__all__ = ["LawfulFit", "lawful_fit", "require_law"]

Fitted = Callable[[str | ForceModel], dict[str, Any]]
Best = Callable[[ForceModel], tuple[float, float]]


@dataclass(frozen=True, eq=False)
class LawfulFit:
    """A fit, the model and law that it is of, and why these.

    Parameters
    ----------
    model : str or ForceModel
        A name where the law is "projected", else the model under its law.
    fit : dict
        What was fitted.
    reason : str
        Why it is this law, in words.
    error : float
        Largest bound over the cuts of what the law adds to the relative error of a force, beside
        finite elements on which the wire rubs [-]; nan where nobody knows it.
    """

    model: str | ForceModel
    fit: dict[str, Any]
    reason: str
    error: float


def require_law(law: object) -> None:
    """Raise an `InputError` unless the law is one, or "auto".

    Examples
    --------
    >>> require_law("auto")
    """
    if not isinstance(law, str) or law not in (*LAWS, AUTO):
        known = ", ".join((*LAWS, AUTO))
        raise InputError(f"law must be one of {known}, but is {shown(law)}; choose one.")


def lawful_fit(
    model: str | ForceModel, law: str, rtol: float | None, cuts: Cuts, best: Best, fitted: Fitted
) -> LawfulFit:
    """Return the fit under a law, or under the one that "auto" stands for.

    Parameters
    ----------
    model : str or ForceModel
        Name of a model, "auto", or a model.
    law : str
        "projected", "slip", "coupled" or "auto".
    rtol : float or None
        Relative error of A and B that will do, as in `identify` [-].
    cuts : Cuts
        The forces.
    best, fitted : callable
        As in `coupled_fit`.

    Raises
    ------
    DomainError
        If the law is "coupled" and its solutions do not reach to a cut.
    AccuracyError
        If rtol is not met.
    InputError
        If there is no such law, or the model does not have it.
    """
    require_law(law)
    if law != AUTO:
        return _named(model, law, rtol, cuts, best, fitted, "it was asked for")
    own = None if is_auto(model) else force_model(model)
    if own is not None and not isinstance(own, FittedModel):
        return _named(
            model, PROJECTED, rtol, cuts, best, fitted, f"model {own.name!r} has no other"
        )
    if own is not None and own.law != PROJECTED:
        return _named(own, own.law, rtol, cuts, best, fitted, "it is that of the model")
    try:
        return _named(model, COUPLED, rtol, cuts, best, fitted, "")
    except AccuracyError:
        raise
    except DomainError as error:
        why = str(error).rpartition("; ")[0]
    except InputError:
        why = "the models in use do not know the law 'coupled'"
    if rtol is not None and own is None:
        raise AccuracyError(
            f"rtol must be met beside finite elements on which the wire rubs, but how far rtol = "
            f"{rtol:g} is from being met nobody knows, as {why}; give law='projected', whose own "
            "finite elements rtol is beside then, or leave rtol out."
        )
    return _named(model, PROJECTED, rtol, cuts, best, fitted, why)


def _named(
    model: str | ForceModel,
    law: str,
    rtol: float | None,
    cuts: Cuts,
    best: Best,
    fitted: Fitted,
    why: str,
) -> LawfulFit:
    """Return the fit under one law."""
    lawful = one_model(of_law(model, law), rtol)
    if not isinstance(lawful, CoupledModel):
        by_name = lawful.law == PROJECTED and not isinstance(model, ForceModel)
        named = lawful.name if by_name else lawful
        fit = fitted(named)
        return LawfulFit(named, fit, why, _law_error(lawful, cuts, fit))
    _require_exponent(lawful, cuts)
    solved = coupled_fit(lawful, cuts, best, fitted)
    if solved.outside.any():
        raise DomainError(f"{solved.reach_in_words(cuts)}; choose law='slip' or law='projected'.")
    if rtol is not None and is_auto(model):
        _require_accuracy(lawful, cuts, solved.g, solved.relative_wear, rtol)
    every = "the cut" if cuts.force.size == 1 else f"all {cuts.force.size} cuts"
    words = f"coupled solutions reach to {every}"
    return LawfulFit(lawful, solved.fit, why or words, 0.0)


def _require_exponent(model: CoupledModel, cuts: Cuts) -> None:
    """Raise a `DomainError` where there are no coupled solutions of the gel's alpha."""
    low, high = model.amplification.exponents
    alpha = cuts.stiffening_exponent
    if not low <= alpha <= high:
        raise DomainError(
            f"coupled solutions are of alpha from {low:.3g} to {high:.3g}, but alpha = {alpha:.4g} "
            "here; choose law='slip' or law='projected'."
        )


def _require_accuracy(
    model: CoupledModel, cuts: Cuts, g: Any, relative_wear: float, rtol: float
) -> None:
    """Raise an `AccuracyError` where friction and wear at a cut may be further off than rtol."""
    alpha, load = cuts.stiffening_exponent, (cuts.friction_coefficient, relative_wear)
    if load == (0.0, 0.0):
        return
    bounds = contact_bounds(model, g, alpha)
    assert bounds is not None  # of a fitted model
    worst = float(np.max(np.fmax(*bounds) + np.expm1(model.amplification.error(g, alpha, *load))))
    if worst > rtol:
        raise AccuracyError(
            f"rtol must be met at all cuts, but rtol = {rtol:g} is not under the law 'coupled', "
            f"whose friction and wear are up to {worst:.2g} off; give rtol={rounded_up(worst)} or "
            "more, or leave rtol out."
        )


def _law_error(model: ForceModel, cuts: Cuts, fit: dict[str, Any]) -> float:
    """Return the largest bound over the cuts of what a law without kappa lacks."""
    gamma, wear = fit["toughness"], fit["wear_strength"]
    mu, xi, alpha = cuts.shear_modulus, cuts.friction_coefficient, cuts.stiffening_exponent
    if wear == 0.0 and xi == 0.0:
        return 0.0
    if model.law != SLIP or not (gamma >= 0.0 and wear >= 0.0):
        return float("nan")
    try:
        kappa = of_law("auto", COUPLED).amplification
    except InputError:
        return float("nan")
    with np.errstate(all="ignore"):
        friction, worn = model.terms(mu, gamma, cuts.wire_radius, xi, wear, alpha)
        drag = np.asarray(friction + worn)
        swing = np.expm1(kappa.most(gamma / (mu * cuts.wire_radius), alpha, xi, ratio(wear, mu)))
        error = drag * swing / np.fmin(gamma * (1.0 + swing) + drag, gamma + drag * (1.0 + swing))
    return float(np.max(error))

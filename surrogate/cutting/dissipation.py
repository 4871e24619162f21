"""The dimensionless dissipative force: friction and wear over mu R_w."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from surrogate.basics.checks import (
    FRICTION_COEFFICIENT,
    RTOL,
    FloatOrArray,
    Quantity,
    broadcast_shape,
    flag,
    one_number,
)
from surrogate.basics.elementwise import AT_ONCE, apply, evaluate_checked
from surrogate.choosing.by_name import AUTO, force_model, is_auto
from surrogate.choosing.effective import warn_of_law
from surrogate.choosing.laws import COUPLED, AnyLaw, of_law, require_known_load
from surrogate.contact.base import ForceModel
from surrogate.contact.fitted import FittedModel
from surrogate.cutting.outside import blanked, is_nan
from surrogate.equations import RELATIVE_WEAR_STRENGTH

__all__ = ["dissipative_force"]


def dissipative_force(
    g: ArrayLike,
    alpha: ArrayLike,
    friction_coefficient: ArrayLike,
    relative_wear_strength: ArrayLike,
    model: str | ForceModel = AUTO,
    rtol: float | None = None,
    extrapolate: bool = False,
    law: str = AUTO,
    outside: str = "raise",
) -> FloatOrArray:
    """Return the dimensionless dissipative force F_d/(mu R_w T), Eqs. (9), (11) and (13).

    Parameters
    ----------
    g : float or array_like
        Dimensionless toughness Gamma_o/(mu R_w) [-], finite.
    alpha : float or array_like
        Stiffening exponent [-], positive.
    friction_coefficient : float or array_like
        xi [-].
    relative_wear_strength : float or array_like
        tau_w/mu [-].
    model : str, default "auto"
        As in `cutting_force`.
    rtol : float, optional
        Relative error of this force that has to be met with "auto" [-]; by default 0.02 where it
        can be had.
    extrapolate : bool, default False
        As in `cutting_force`.
    law : str, default "auto"
        Which functions of the contact wear and friction follow, as in `cutting_force`; with "auto"
        the error that has to do is relative to this force, without the cleavage.
    outside : str, default "raise"
        As in `cutting_force`: "nan" for nan where the model does not hold, and not an error.

    Returns
    -------
    float or ndarray
        F_d/(mu R_w T) = 2 (tau_w A/mu + xi B) [-], of the common shape; with A* and B* under the
        law "slip", and kappa times that under "coupled".

    Raises
    ------
    InputError
        If an argument is out of range or the shapes do not broadcast.
    UnknownModelError
        If there is no such model.
    DomainError
        If alpha is outside Table 1, 2 to 9, and the model is "eq9"; if g or alpha is outside the
        domain of a fitted model and `extrapolate` is not set.
    AccuracyError
        If the model is "auto" and none is as exact as `rtol`.

    Warns
    -----
    UnknownErrorWarning
        Once, if the law is "auto" and at some points the projected one with effective strengths,
        as no solution with friction and wear is near.

    Notes
    -----
    Range of validity: that of the model, see `cutting_force`.

    References
    ----------
    arXiv:2412.02021, Eqs. (9), (11), (13), (S2) and Fig. 4.

    Examples
    --------
    >>> print(f"{dissipative_force(1.0, 6.0, 0.01, 0.1):.2f}")
    0.44
    >>> print(f"{dissipative_force(10.0, 2.0, 0.1, 11.31, law='projected'):.0f}")
    33
    >>> print(f"{dissipative_force(10.0, 2.0, 0.1, 11.31, model='eq13'):.4f}")
    46.6400
    >>> print(f"{dissipative_force(10.0, 2.0, 0.1, 11.31, model='eq9'):.4f}")
    1.5136
    """
    rtol = None if rtol is None else one_number(RTOL, rtol)
    extrapolate = flag("extrapolate", extrapolate)
    blank = is_nan(outside) and not extrapolate
    stays = blank or extrapolate
    values = (g, alpha, friction_coefficient, relative_wear_strength)
    wanted = of_law(model, law, any_law=True)
    any_law = isinstance(wanted, AnyLaw)
    chosen = force_model("table" if is_auto(wanted) else wanted.contact if any_law else wanted)
    fitted = isinstance(chosen, FittedModel)
    in_g, in_alpha = chosen.accepted(extrapolate or (blank and fitted))
    quantities = (in_g, _as_alpha(in_alpha), FRICTION_COEFFICIENT, RELATIVE_WEAR_STRENGTH)
    if any_law or is_auto(wanted):
        checked = tuple(q.checked(value) for q, value in zip(quantities, values, strict=True))
        broadcast_shape(tuple(q.name for q in quantities), checked)
        if any_law:
            return _lawful_dissipation(checked, wanted, rtol, stays, blank)
        return _automatic_dissipation(checked, rtol, stays, blank)

    def dissipation(g: Any, alpha: Any, xi: Any, relative_wear: Any) -> Any:
        friction, wear = chosen.terms(1.0, g, 1.0, xi, relative_wear, alpha)  # in units of mu R_w
        return friction + wear

    force = evaluate_checked(dissipation, quantities, values)
    if not (fitted and (blank or (chosen.law == COUPLED and not extrapolate))):
        return force
    g, alpha, xi, wear = (q.checked(v) for q, v in zip(quantities, values, strict=True))
    scene = 1.0, g, 1.0, xi, wear, alpha
    if blank:
        return blanked(force, chosen.in_domain(*scene))  # type: ignore[no-any-return]
    require_known_load(chosen, scene)
    return force


def _automatic_dissipation(
    values: tuple[Any, ...], rtol: float | None, stays: bool, blank: bool
) -> FloatOrArray:
    from surrogate.choosing.auto import AutomaticTerms

    scene = _of_unit_wire(values)
    automatic = AutomaticTerms(scene, rtol, of_dissipation=True)
    friction, wear, holds, *_ = apply(automatic, scene, automatic.dtypes, AT_ONCE)
    automatic.finish(stays)
    return blanked(friction + wear, holds if blank else True)  # type: ignore[no-any-return]


def _lawful_dissipation(
    values: tuple[Any, ...], model: AnyLaw, rtol: float | None, stays: bool, blank: bool
) -> FloatOrArray:
    from surrogate.choosing.auto_law import LawfulTerms

    scene = _of_unit_wire(values)
    lawful = LawfulTerms(scene, rtol, of_dissipation=True, named=model.named)
    friction, wear, holds, *_, of_law = apply(lawful, scene, lawful.dtypes, AT_ONCE)
    lawful.finish(stays)
    hidden = np.logical_not(holds) & blank
    warn_of_law(np.isnan(of_law) & ~hidden, "the dissipative force", depth=4)
    return blanked(friction + wear, ~hidden)  # type: ignore[no-any-return]


def _of_unit_wire(values: tuple[Any, ...]) -> tuple[Any, ...]:
    """Return a scene whose mu and R_w are 1."""
    g, alpha, xi, relative_wear = values
    return 1.0, g, 1.0, xi, relative_wear, alpha


@cache
def _as_alpha(stiffening: Quantity) -> Quantity:
    return replace(stiffening, name="alpha")

"""What friction that nobody gave would make of an identification."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from surrogate.basics.digits import rounded
from surrogate.choosing.by_name import force_model
from surrogate.contact.base import ForceModel
from surrogate.coupling.model import CoupledModel
from surrogate.errors import DomainError, InputError
from surrogate.identification.estimate import Estimate
from surrogate.inference.coupled_fit import coupled_fit
from surrogate.inference.line_fit import linear_form, solve_least_squares
from surrogate.inference.misfit import Misfit
from surrogate.inference.profile import smallest_misfit

__all__ = ["SUPPOSED", "WithFriction", "forgotten_friction_in_words", "with_friction"]

SUPPOSED = (0.1, 0.3)
"""Friction coefficients for which it is said what they would change."""


@dataclass(frozen=True)
class WithFriction:
    """The same forces with another friction coefficient.

    Parameters
    ----------
    friction_coefficient : float
        xi [-].
    toughness, wear_strength : float
        Gamma_o [J/m2] and tau_w [Pa].
    fits : bool
        Whether the forces are met as well as the interval without it asks for.
    """

    friction_coefficient: float
    toughness: float
    wear_strength: float
    fits: bool


def with_friction(fit: Estimate, friction: float) -> WithFriction:
    """Return what the forces of an identification say with another friction coefficient.

    Raises
    ------
    DomainError
        If the model covers no toughness for all of the wires, or the law is "coupled" and its
        solutions do not reach to a cut with this friction.
    InputError
        If the shear modulus is not known.

    Examples
    --------
    With Eq. (13), (1 + xi) Gamma_o and tau_w + xi mu stay as they are:

    >>> from surrogate.identification.fit import identify
    >>> fit = identify([1e-4, 2e-4, 4e-4, 5e-4], [4.7, 7.9, 13.9, 17.2], 685.0, model="eq13")
    >>> other = with_friction(fit, 0.1)
    >>> print(f"{other.toughness * 1.1:.4f} {other.wear_strength + 68.5:.1f}, {other.fits}")
    1.6250 7750.0, True
    """
    if "shear_modulus" in fit.assumed and friction:
        raise InputError(
            "friction needs the shear modulus, which was not given; give it to identify."
        )
    if fit.profile is None:
        return _on_a_line(fit, friction)
    cuts = replace(fit.cuts, friction_coefficient=friction)
    misfit, toughness, wear = _smallest(fit, replace(fit.misfit, cuts=cuts))
    fits = not misfit > fit.profile.threshold
    return WithFriction(friction, toughness, wear, fits)


def _smallest(fit: Estimate, misfit: Misfit) -> tuple[float, float, float]:
    """Return the lowest misfit, Gamma_o and tau_w; of the law "coupled" by its tangent there."""
    model = force_model(fit.model)
    if not isinstance(model, CoupledModel):
        return smallest_misfit(misfit)

    def best(at: ForceModel) -> tuple[float, float]:
        return smallest_misfit(replace(misfit, model=at))[1:]

    def fitted(at: ForceModel) -> dict[str, float]:
        least = smallest_misfit(replace(misfit, model=at))
        return dict(zip(("misfit", "toughness", "wear_strength"), least, strict=True))

    solved = coupled_fit(model, misfit.cuts, best, fitted)
    if solved.outside.any():
        raise DomainError(f"{solved.reach_in_words(misfit.cuts)}; give less friction.")
    return solved.fit["misfit"], solved.fit["toughness"], solved.fit["wear_strength"]


def _on_a_line(fit: Estimate, friction: float) -> WithFriction:
    columns, offset = linear_form(fit.model, fit.wire_radius, fit.shear_modulus, friction)
    weight = fit.cuts.weight
    line = solve_least_squares(columns * weight[:, np.newaxis], (fit.force - offset) * weight)
    toughness, wear = line.estimate.tolist()
    return WithFriction(friction, toughness, wear, wear >= 0.0)


def forgotten_friction_in_words(fit: Estimate) -> str:
    """Return what friction would change where nobody gave it; empty where it was, or plays no part.

    Examples
    --------
    >>> from surrogate.identification.fit import identify
    >>> fit = identify([1e-4, 2e-4, 4e-4, 5e-4], [4.7, 7.9, 13.9, 17.2], 30e3, model="eq13")
    >>> print(forgotten_friction_in_words(fit))
    Friction was taken to be 0: with xi = 0.1, Gamma_o = 1.48 J/m2 and tau_w = 4.75 kPa; xi = 0.3 \
does not fit the forces.
    """
    assumed = fit.assumed
    if "friction_coefficient" not in assumed or "shear_modulus" in assumed or not fit.has_scatter:
        return ""
    parts, beyond = [], []
    for friction in SUPPOSED:
        try:
            parts.append(_in_words(fit, with_friction(fit, friction)))
        except DomainError:
            beyond.append(f"{friction:g}")
    if beyond:
        is_or_are = "are" if len(beyond) > 1 else "is"
        parts.append(f"xi = {' and '.join(beyond)} {is_or_are} beyond what coupled solutions reach")
    told = "; ".join(filter(None, parts))
    return f"Friction was taken to be 0: {told}." if told else ""


def _in_words(fit: Estimate, other: WithFriction) -> str:
    if not other.fits:
        return f"xi = {other.friction_coefficient:g} does not fit the forces"
    parts = [
        f"{symbol} = {rounded(scale * value, 0.5 * scale * (high - low))} {unit}"
        for symbol, unit, scale, value, (low, high) in (
            ("Gamma_o", "J/m2", 1.0, other.toughness, fit.toughness_interval),
            ("tau_w", "kPa", 1e-3, other.wear_strength, fit.wear_strength_interval),
        )
        if low > 0.0 or fit.profile is None  # else the forces set an upper limit alone
    ]
    if not parts:
        return ""
    return f"with xi = {other.friction_coefficient:g}, {' and '.join(parts)}"

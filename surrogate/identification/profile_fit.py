"""Toughness and wear strength under any force model: the best minimum and all that is admitted."""

from __future__ import annotations

from typing import Any

import numpy as np

from surrogate.basics.checks import one_number, shown
from surrogate.choosing.accuracy import contact_bounds
from surrogate.choosing.by_name import force_model
from surrogate.errors import InputError
from surrogate.identification.further_wire import further_wire, range_of_wires
from surrogate.identification.inputs import WIRE_RADIUS, Array, Cuts, Known
from surrogate.identification.line_fit import solve_least_squares
from surrogate.identification.misfit import Misfit
from surrogate.identification.profile import profile_misfit
from surrogate.identification.quantiles import normal_quantile, student_quantile

__all__ = ["fit_profile"]


def fit_profile(
    cuts: Cuts, model: str, known: Known, confidence: float, further_radii: object = None
) -> dict[str, Any]:
    """Return what the profiled misfit says, by the names of an `Identification`.

    A toughness is admitted where the misfit exceeds the smallest one by no more than z^2, the
    quantile of chi^2 with one degree of freedom, where the forces' standard errors are known. Where
    they are not, by no more than t^2/dof times the smallest one, with Student's t: the quantile of
    F with 1 and dof degrees of freedom, which for a straight line gives Student's interval.

    Parameters
    ----------
    cuts : Cuts
        The forces.
    model : str
        Name of the force model.
    known : Known
        Facts besides the forces.
    confidence : float
        Probability of the intervals [-].
    further_radii : pair of float, optional
        Smallest and largest radius of a further wire [m].

    Raises
    ------
    InputError, DomainError
        As `identify`.
    """
    chosen = force_model(model)
    chosen.stiffening.checked(cuts.stiffening_exponent)
    searched = _searched(cuts, further_radii)
    misfit = Misfit(chosen, cuts, known)
    dof = cuts.force.size + known.facts - 2

    def threshold(smallest: float) -> float:
        if cuts.force_std is not None:
            return smallest + normal_quantile(confidence) ** 2
        if not dof:
            return np.nan
        return smallest * (1.0 + student_quantile(confidence, dof) ** 2 / dof)

    profile = profile_misfit(misfit, threshold)
    best = profile.modes[0]
    at_best = np.array([best.toughness])
    residuals = misfit.at(at_best).residuals[0]
    linearised = _linearised(misfit, best.toughness, best.wear_strength)
    scatter = np.full_like(residuals, np.sqrt(best.misfit / max(dof, 1)))
    std = scatter if cuts.force_std is None else cuts.force_std
    return {
        "toughness": best.toughness,
        "wear_strength": best.wear_strength,
        "residuals": residuals,
        "misfit": best.misfit,
        **linearised,
        "profile": profile,
        "further_wire": further_wire(misfit, profile, std, searched),
    }


def _searched(cuts: Cuts, further_radii: object) -> tuple[float, float]:
    if further_radii is None:
        return range_of_wires(cuts)
    if not isinstance(further_radii, (tuple, list)) or len(further_radii) != 2:
        raise InputError(
            f"further_radii must be a pair, but further_radii = {shown(further_radii)}; give the "
            "smallest and the largest radius of a wire that you could cut with, in metres."
        )
    smallest, largest = (one_number(WIRE_RADIUS, radius) for radius in further_radii)
    if smallest > largest:
        raise InputError(
            f"further_radii must begin with the smaller one, but are {smallest!r} and {largest!r} "
            "m; exchange them."
        )
    return smallest, largest


def _linearised(misfit: Misfit, toughness: float, wear_strength: float) -> dict[str, Any]:
    """Return what follows from the force's derivatives at the estimate.

    As if no limit held the estimate; all nan where a derivative is infinite, as at Gamma_o = 0.
    """
    at, known, weight = np.array([toughness]), misfit.known, misfit.cuts.weight
    slopes = misfit.force_slopes(at, np.array([wear_strength]))[0]
    design = (np.stack([slopes, misfit.arcs(at)[0]]) * weight).T
    for column, prior in enumerate((known.toughness_prior, known.wear_strength_prior)):
        if prior is not None:
            design = np.vstack([design, np.eye(2)[column] / prior[1]])
    free = slice(0, 1 if known.wear_strength is not None else 2)
    covariance = np.zeros((2, 2))
    if not np.all(np.isfinite(design)) or not np.all(np.any(design[:, free], axis=0)):
        return _named(covariance + np.nan, weight * np.nan, np.nan, (np.nan, np.nan))
    fit = solve_least_squares(design[:, free], design[:, 0])
    covariance[free, free] = fit.covariance
    bounds = _force_bounds(misfit, toughness, wear_strength)
    shifts = None
    if bounds is not None:  # each force off by its bound, all to the worse side
        per_force = np.abs(covariance @ design[: weight.size].T)
        gamma, tau = (per_force @ (weight * bounds)).tolist()
        shifts = gamma, tau
    return _named(covariance, fit.leverage[: weight.size], fit.condition, shifts)


def _named(
    covariance: Array, leverage: Array, condition: float, shifts: tuple[float, float] | None
) -> dict[str, Any]:
    return {
        "unit_covariance": covariance,
        "leverage": leverage,
        "condition": condition,
        "model_error": shifts,
    }


def _force_bounds(misfit: Misfit, toughness: float, wear_strength: float) -> Array | None:
    """Return how far off the model's force on each wire may be [N/m], or None if nobody knows."""
    cuts, model = misfit.cuts, misfit.model
    g = toughness / (cuts.shear_modulus * cuts.wire_radius)
    bounds = contact_bounds(model, g, cuts.stiffening_exponent)
    if bounds is None:
        return None
    arc, load = model.contact(("arc", "normal_load"), g, cuts.stiffening_exponent)
    stiffness = cuts.friction_coefficient * cuts.shear_modulus
    stress = wear_strength * arc * bounds[0] + stiffness * load * bounds[1]
    return np.asarray(2.0 * cuts.wire_radius * stress)

"""Toughness and wear strength under any force model: the best minimum and all that is admitted."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from surrogate.basics.checks import one_number, shown
from surrogate.choosing.by_name import force_model
from surrogate.contact.base import ForceModel
from surrogate.errors import InputError
from surrogate.identification.further_wire import further_wire, range_of_wires
from surrogate.inference.inputs import WIRE_RADIUS, Array, Cuts, Known
from surrogate.inference.line_fit import correlation_of, solve_least_squares, solve_with_shared
from surrogate.inference.misfit import Misfit
from surrogate.inference.profile import profile_misfit, smallest_misfit
from surrogate.inference.quantiles import normal_quantile, student_quantile

__all__ = ["best_fit", "fit_profile", "linearised"]

LEAST_SCATTER = 1e-4
"""Of the largest force; no forces are measured more exactly."""


def fit_profile(
    cuts: Cuts,
    model: str | ForceModel,
    known: Known,
    confidence: float,
    further_radii: object = None,
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
    dof = cuts.force.size + known.facts - 2
    misfit = _scaled(Misfit(chosen, cuts, known), dof)
    profile = profile_misfit(misfit, partial(_threshold, misfit, confidence, dof))
    best = profile.modes[0]
    residuals = misfit.at(np.array([best.toughness])).residuals[0]
    scale = np.sqrt(best.misfit / max(dof, 1)) if misfit.scale is None else misfit.scale
    std = scale / cuts.weight
    return {
        "toughness": best.toughness,
        "wear_strength": best.wear_strength,
        "residuals": residuals,
        "misfit": best.misfit,
        **linearised(misfit, best.toughness, best.wear_strength, scale if dof else np.nan),
        "profile": profile,
        "further_wire": further_wire(misfit, profile, std, searched),
        "scale": misfit.scale,
    }


def best_fit(cuts: Cuts, known: Known, model: ForceModel) -> tuple[float, float]:
    """Return Gamma_o [J/m2] and tau_w [Pa] of the smallest misfit alone, without intervals."""
    dof = cuts.force.size + known.facts - 2
    return smallest_misfit(_scaled(Misfit(model, cuts, known), dof))[1:]


def _scaled(misfit: Misfit, dof: int) -> Misfit:
    """Return the misfit with the errors that forces share, beside their own scatter.

    Where no standard error is known, the scatter is that about the best fit without such errors.
    """
    if misfit.cuts.force_std is not None:
        return replace(misfit, scale=1.0)
    if not dof or not replace(misfit, scale=1.0).shares_errors:
        return misfit
    scatter = float(np.sqrt(smallest_misfit(misfit)[0] / dof))
    return replace(misfit, scale=max(scatter, LEAST_SCATTER * float(misfit.cuts.force.max())))


def _threshold(misfit: Misfit, confidence: float, dof: int, smallest: float) -> float:
    """Return the largest misfit that is admitted beside the smallest one."""
    if misfit.cuts.force_std is not None:
        return smallest + normal_quantile(confidence) ** 2
    if not dof:
        return np.nan
    quantile = student_quantile(confidence, dof) ** 2
    if misfit.scale is None:
        return smallest * (1.0 + quantile / dof)
    return smallest + quantile * misfit.scale**2


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


def linearised(
    misfit: Misfit, toughness: float, wear_strength: float, scale: float
) -> dict[str, Any]:
    """Return what follows from the force's derivatives at the estimate.

    As if no limit held the estimate; all nan where a derivative is infinite, as at Gamma_o = 0.
    The standard error that each source of error brings is that of the same estimator, so that
    their squares add up to the diagonal of the covariance.
    """
    at, tau, known = np.array([toughness]), np.array([wear_strength]), misfit.known
    weight = misfit.cuts.weight
    slopes = misfit.force_slopes(at, tau)[0]
    design = (np.stack([slopes, misfit.arcs(at)[0]]) * weight).T
    for column, prior in enumerate((known.toughness_prior, known.wear_strength_prior)):
        if prior is not None:
            design = np.vstack([design, np.eye(2)[column] / prior[1]])
    free = slice(0, 1 if known.wear_strength is not None else 2)
    if not np.all(np.isfinite(design)) or not np.all(np.any(design[:, free], axis=0)):
        nothing = np.full((2, 2), np.nan)
        return _named(nothing, scale, weight * np.nan, np.nan, {}, np.full(2, np.nan))
    plain = solve_least_squares(design[:, free], design[:, 0])
    factors: dict[str, Array] = {}
    if misfit.scale is not None:
        for name, factor in misfit.shared(at, tau):
            rows = np.zeros((len(design), factor.shape[2]))
            rows[: weight.size] = weight[:, np.newaxis] * factor[0] / misfit.scale
            factors[name] = np.hstack([factors[name], rows]) if name in factors else rows
    fit, parts = solve_with_shared(design[:, free], design[:, 0], factors)
    contributions = {}
    for name, part in parts.items():
        std = np.zeros(2)
        std[free] = scale * part
        contributions[name] = (float(std[0]), float(std[1]))
    load = misfit.friction_slopes(at)[0] * weight
    shift = np.zeros(2)
    shift[free] = -np.linalg.lstsq(design[: weight.size, free], load, rcond=None)[0]
    covariance = np.zeros((2, 2))
    covariance[free, free] = fit.covariance
    return _named(
        covariance, scale, plain.leverage[: weight.size], plain.condition, contributions, shift
    )


def _named(
    covariance: Array,
    scale: float,
    leverage: Array,
    condition: float,
    contributions: dict[str, tuple[float, float]],
    shift: Array,
) -> dict[str, Any]:
    return {
        "covariance": scale**2 * covariance,
        "correlation": correlation_of(covariance),
        "leverage": leverage,
        "condition": condition,
        "contributions": contributions,
        "model_error": contributions.get("model"),
        "friction_sensitivity": (float(shift[0]), float(shift[1])),
    }

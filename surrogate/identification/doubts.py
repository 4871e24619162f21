"""What makes an identification doubtful, in words."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from surrogate.choosing.by_name import force_model
from surrogate.contact.base import ForceModel
from surrogate.contact.closed_forms import ClosedForm
from surrogate.contact.fitted import FittedModel
from surrogate.identification.estimate import OPEN_ENDS, Estimate
from surrogate.identification.outlier import outlier
from surrogate.identification.slips import slip_in_words
from surrogate.inference.continuation import contact_error
from surrogate.inference.line_fit import solve_least_squares
from surrogate.inference.profile import smallest_misfit
from surrogate.inference.quantiles import chi_squared_limit, exceeds_f, student_quantile
from surrogate.reading import plausibility
from surrogate.reading.plausibility import doubts

__all__ = ["exactness", "fit_warnings", "objections"]

LARGEST_CONDITION = 30.0
"""Of the design matrix with columns of unit length: beyond it, intercept and slope are hardly
told apart; met when the radii differ by less than about 7 % (one standard deviation)."""

FALSE_ALARM = 0.01
"""Probability that a sound experiment is given a warning of misfit."""

ALIKE = 1.2
"""Thickest wire over thinnest below which radii are alike."""

POOR = 0.5
"""R^2 below which the fit is not worth its numbers."""

SLIP_GAIN = 10.0
"""Times smaller that a slip's misfit must be where nothing else says what is acceptable."""


def objections(fit: Estimate) -> Iterator[str]:
    """Yield one sentence for each reason not to use an identification as it stands.

    Parameters
    ----------
    fit : Estimate
        The identification to look at.

    Yields
    ------
    str
        What is wrong, with the numbers, and what would help.

    Examples
    --------
    >>> from surrogate.identification.fit import identify
    >>> for sentence in objections(identify([1e-4, 2e-4, 4e-4], [9.0, 7.0, 4.0], model="eq13")):
    ...     print(sentence[:33])
    the toughness (10.5 J/m2) is abov
    the wear strength is negative (-4
    """
    for reasons in (_misfit, _physical, _negative, exactness, _implausible):
        yield from reasons(fit)


def fit_warnings(fit: Estimate) -> Iterator[str]:
    """Yield one sentence for each reason to doubt an identification: first the objections.

    Parameters
    ----------
    fit : Estimate
        The identification to look at.

    Yields
    ------
    str
        What is doubtful, with the numbers, and what would help.

    Examples
    --------
    >>> from surrogate.identification.fit import identify
    >>> for sentence in fit_warnings(identify([2e-4, 4e-4, 2e-4], [1.0, 1.1, 1.05], 1e5)):
    ...     print(sentence[:28])
    only 2 different radii: they
    """
    yield from objections(fit)
    for reasons in (
        _limits,
        _out_of_range,
        _unexplained,
        _outlier,
        _too_few_radii,
        _condition,
        _regime,
        _without_scatter,
    ):
        yield from reasons(fit)


def _implausible(fit: Estimate) -> Iterator[str]:
    yield from doubts(plausibility.RADIUS, fit.wire_radius)
    yield from doubts(plausibility.FORCE, fit.force)
    yield from doubts(plausibility.SHEAR_MODULUS, fit.shear_modulus)
    if np.isfinite(fit.known.toughness_max):
        yield from doubts(plausibility.TOUGHNESS, fit.known.toughness_max)
    if fit.known.wear_strength:
        yield from doubts(plausibility.WEAR_STRENGTH, fit.known.wear_strength)
    least = fit.toughness - fit.toughness_std  # what the forces hardly determine is not doubted
    if least > 0.0 and "shear_modulus" not in fit.assumed:
        yield from doubts(plausibility.COHESIVE_LENGTH, least / fit.shear_modulus)


def _too_few_radii(fit: Estimate) -> Iterator[str]:
    distinct = np.unique(fit.wire_radius).size
    if distinct == 1:
        yield (
            f"only one wire: it cannot show whether the forces lie on a {_shape(fit)}; cut with "
            "other wires as well"
        )
    elif distinct < 3:
        yield (
            f"only {distinct} different radii: they cannot show whether the forces lie on a "
            f"{_shape(fit)}; cut with a third radius between them"
        )


def _condition(fit: Estimate) -> Iterator[str]:
    if fit.condition > LARGEST_CONDITION:
        smallest, largest = fit.wire_radius.min(), fit.wire_radius.max()
        alike = largest < ALIKE * smallest
        yield (
            "toughness and wear change the forces of these wires in nearly the same way (condition "
            f"number {fit.condition:.0f}, limit {LARGEST_CONDITION:.0f}) and can hardly be told "
            "apart"
            + (
                f": the radii ({1e3 * smallest:.4g} to {1e3 * largest:.4g} mm) are too alike; add "
                "much thinner or thicker wires"
                if alike
                else f" near this estimate; the wires of {1e3 * smallest:.4g} to "
                f"{1e3 * largest:.4g} mm need thinner or thicker ones beside them"
            )
        )


def _negative(fit: Estimate) -> Iterator[str]:
    """Object to an interval below 0, which no scatter explains."""
    remedy = "check the units, the friction coefficient and that radii are not diameters"
    if fit.toughness < 0.0 and not fit.toughness_interval[1] >= 0.0:
        yield f"the toughness is negative ({fit.toughness:.4g} J/m2) and is not clipped; {remedy}"
    if fit.wear_strength < 0.0 and not fit.wear_strength_interval[1] >= 0.0:
        yield (
            f"the wear strength is negative ({fit.wear_strength:.4g} Pa) and is not clipped: "
            f"the force does not grow with the radius as much as friction alone asks; {remedy}"
        )


def _limits(fit: Estimate) -> Iterator[str]:
    profile = fit.profile
    if profile is None:
        return
    below, above = fit.toughness_limited_by
    if profile.modes[0].at_end and fit.toughness > 0.0:
        high = fit.toughness >= profile.searched[1]
        what = above if high else below
        yield (
            f"the toughness is at the {_end_in_words(fit, what)} ({fit.toughness:.4g} J/m2), "
            "beyond which the forces would be met better: it is "
            f"{'at least' if high else 'at most'} that, without a standard error{_remedy(what)}"
        )
    elif above in OPEN_ENDS or below in OPEN_ENDS:
        which = "above" if above in OPEN_ENDS else "below"
        what = above if above in OPEN_ENDS else below
        yield (
            f"nothing but the {_end_in_words(fit, what)} ends the toughness {which}: its interval "
            f"is one-sided{_remedy(what)}"
        )
    for name, value, known in (
        ("toughness", fit.toughness, False),
        ("wear strength", fit.wear_strength, fit.known.wear_strength is not None),
    ):
        if value == 0.0 and not known:
            yield f"the {name} is 0, its limit: no larger one meets the forces as well"


def _end_in_words(fit: Estimate, what: str) -> str:
    low, high = force_model(fit.model).ends(fit.stiffening_exponent)
    return {
        "model": f"end of what model '{fit.model}' covers for all wires (g from "
        f"{low:.4g} to {high:.4g})",
        "bound": "given bound",
        "search": "end of the search",
    }.get(what, "end of the search")


def _remedy(what: str) -> str:
    if what != "model":
        return ""
    return "; leave out the thinnest or thickest wire, or name another model"


def _out_of_range(fit: Estimate) -> Iterator[str]:
    """Name the wires for which a fitted model is continued beyond its range."""
    model = force_model(fit.model)
    if not isinstance(model, FittedModel) or fit.known.wear_strength == 0.0:
        return
    low, high = model.ends(fit.stiffening_exponent)
    g = fit.dimensionless_toughness
    outside = (g < low) | (g > high)
    if not np.any(outside):
        return
    radii = ", ".join(f"{1e3 * radius:.3g}" for radius in np.unique(fit.wire_radius[outside]))
    error = contact_error(fit.tangent, g[outside], fit.stiffening_exponent)
    assert error is not None
    share = 100.0 * float(np.max(np.hypot(error.arc, error.arc_drift)))
    yield (
        f"{np.count_nonzero(outside)} of {g.size} cuts (R_w = {radii} mm) are at g = "
        f"Gamma_o/(mu R_w) of {g[outside].min():.3g} to {g[outside].max():.3g}, beyond the range "
        f"of model '{fit.model}' ({low:g} to {high:g}): it is continued by its asymptotes, and an "
        f"error of up to {share:.2g} % of the arc of contact is part of the intervals; check the "
        "shear modulus, or leave these wires out if others remain"
    )


def _misfit(fit: Estimate) -> Iterator[str]:
    """Say that the forces are not met, and which slip would explain it."""
    if fit.dof <= 0 or fit.is_exact:
        return
    limit = chi_squared_limit(fit.dof, FALSE_ALARM)
    if fit.reduced_chi_squared is not None:
        if fit.reduced_chi_squared > limit:
            yield (
                f"chi^2/dof = {fit.reduced_chi_squared:.3g} is above {limit:.3g}: the forces "
                f"scatter about the {_shape(fit)} more than force_std allows; "
                f"{_cause(fit, limit * fit.dof)}the standard errors are too small"
            )
        return
    total = float(np.sum((fit.cuts.weight * fit.residuals) ** 2))
    scatter = fit.scatter
    groups = np.unique(fit.wire_radius).size
    if scatter is not None and groups > 2 and scatter.pure_misfit > 0.0:
        pure = scatter.pure_misfit / scatter.dof
        lack = max(_beside_shared(fit, total, pure) - scatter.pure_misfit, 0.0) / (groups - 2)
        if exceeds_f(lack / pure, (groups - 2, scatter.dof), FALSE_ALARM):
            acceptable = total if total <= 0 else pure * (fit.dof) * 2.0
            yield (
                f"the means of the wires are {np.sqrt(lack / pure):.2g} times as far off the "
                f"{_shape(fit)} as repeated cuts scatter: the {_shape(fit)} does not hold; "
                f"{_cause(fit, acceptable)}the intervals cannot be relied on"
            )
            return
    yield from _another_line(fit, total)


def _beside_shared(fit: Estimate, total: float, variance: float) -> float:
    """Return what is left of the misfit once errors that forces share have taken their part."""
    if fit.profile is None or fit.scale is None:
        return total
    return smallest_misfit(replace(fit.misfit, scale=float(np.sqrt(variance))))[0]


def _another_line(fit: Estimate, total: float) -> Iterator[str]:
    """Object where a straight line of any slope meets forces of unknown errors far better.

    Student's test of its slope, one-sided.
    """
    radius, weight, dof = fit.wire_radius, fit.cuts.weight, fit.force.size - 2
    if np.unique(radius).size < 3 or not fit.r_squared < POOR:
        return
    columns = np.stack([np.ones_like(radius), radius / radius.max()], axis=1)
    line = solve_least_squares(columns * weight[:, np.newaxis], fit.force * weight)
    if not np.isfinite(line.condition):
        return
    rest = float(np.sum((weight * (fit.force - columns @ line.estimate)) ** 2))
    if total > rest * (1.0 + student_quantile(1.0 - 2.0 * FALSE_ALARM, dof) ** 2 / dof):
        trend = "fall" if line.estimate[1] < 0.0 else "grow"
        yield (
            f"the forces {trend} with the radius as the {_shape(fit)} cannot (R^2 = "
            f"{max(fit.r_squared, 0.0):.2f}; a straight line of any slope leaves "
            f"{rest / total:.2g} of the sum of squares); {_cause(fit, total / SLIP_GAIN)}"
            "look at the forces before any number"
        )


def _unexplained(fit: Estimate) -> Iterator[str]:
    """Say that the forces hardly vary by more than they scatter."""
    if fit.force_std is None and fit.dof > 0 and not fit.is_exact and fit.r_squared < POOR:
        yield (
            f"the {_shape(fit)} explains {'nothing' if fit.r_squared <= 0.0 else 'little'} of how "
            f"the forces vary (R^2 = {max(fit.r_squared, 0.0):.2f}): they hardly differ by more "
            "than they scatter; cut with thinner and thicker wires, and repeat"
        )


def _cause(fit: Estimate, acceptable: float) -> str:
    words = slip_in_words(fit, acceptable)
    return "" if words is None else f"it would be explained if {words}; "


def _physical(fit: Estimate) -> Iterator[str]:
    least = fit.toughness - 2.0 * np.nan_to_num(fit.toughness_std)
    smallest = float(fit.force.min())
    if least > smallest:
        yield (
            f"the toughness ({fit.toughness:.4g} J/m2) is above the smallest force "
            f"({smallest:.4g} N/m), though no wire cuts with less than the toughness: check the "
            "shear modulus and the units"
        )


def _regime(fit: Estimate) -> Iterator[str]:
    chosen = force_model(fit.model)
    if isinstance(chosen, FittedModel):
        return
    if not isinstance(chosen, ClosedForm):
        yield from _domain(fit, chosen)
        return
    g = fit.dimensionless_toughness  # nan is not above
    if (beyond := int(np.count_nonzero(g > 1.0))) > 0:
        yield (
            f"{beyond} of {g.size} wires cut at g = Gamma_o/(mu R_w) above 1 "
            f"({g.min():.3g} to {g.max():.3g}): the wear term 4 tau_w R_w of model '{fit.model}' "
            "comes from Eq. 11, which the paper found for g <= 1, so that tau_w rests on an "
            "extrapolation; wires of a radius above "
            f"{1e3 * fit.toughness / fit.shear_modulus:.3g} mm would avoid it"
        )
    if fit.model == "friction-free" and fit.friction_coefficient > 0.0:
        yield (
            f"model 'friction-free' leaves out the friction coefficient "
            f"{fit.friction_coefficient:.3g} that was given; use 'eq13' to include it"
        )


def _domain(fit: Estimate, chosen: ForceModel) -> Iterator[str]:
    holds = np.broadcast_to(
        chosen.in_domain(
            fit.shear_modulus,
            fit.toughness,
            fit.wire_radius,
            fit.friction_coefficient,
            fit.wear_strength,
            fit.stiffening_exponent,
        ),
        fit.wire_radius.shape,
    )
    if (outside := int(np.count_nonzero(~holds))) > 0:
        yield (
            f"{outside} of {holds.size} wires are where model '{fit.model}' does not hold "
            f"(it holds for: {chosen.domain})"
        )


def exactness(fit: Estimate) -> Iterator[str]:
    """Yield why forces that are met to the last digit are no measurement; nothing of others.

    Examples
    --------
    >>> from surrogate.identification.fit import identify
    >>> for sentence in exactness(identify([1e-4, 2e-4, 4e-4], [2.0, 3.0, 5.0], model="eq13")):
    ...     print(sentence[:44])
    the forces lie on the line to the last digit
    """
    if fit.is_exact and fit.force_std is None:
        yield (
            f"the forces lie on the {_shape(fit)} to the last digit, which no measurement does: "
            "the residuals say nothing about the experiment's uncertainty; give the forces as "
            "they were measured, or their errors"
        )


def _without_scatter(fit: Estimate) -> Iterator[str]:
    if fit.force_std is None and fit.dof == 0:
        if fit.force.size == 1:
            yield (
                f"one force determines the {_shape(fit)} exactly and leaves no measure of scatter: "
                "the standard error is unknown; cut more often, or give force_std"
            )
            return
        yield (
            f"two forces determine the {_shape(fit)} exactly and leave no measure of scatter: "
            "standard errors are unknown; cut more often, or give force_std"
        )
    elif fit.is_exact and fit.force_std is not None:
        yield (
            f"the forces lie on the {_shape(fit)} to the last digit, which no measurement does: "
            "the intervals rest on force_std alone"
        )


def _outlier(fit: Estimate) -> Iterator[str]:
    if (bad := outlier(fit)) is not None:
        yield bad.words(_shape(fit))


def _shape(fit: Estimate) -> str:
    return "line" if isinstance(force_model(fit.model), ClosedForm) else "curve"

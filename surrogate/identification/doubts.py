"""What makes an identification doubtful, in words."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from surrogate.choosing.by_name import force_model
from surrogate.contact.base import ForceModel
from surrogate.contact.closed_forms import ClosedForm
from surrogate.contact.fitted import FittedModel
from surrogate.identification.estimate import OPEN_ENDS, Estimate
from surrogate.identification.slips import slip_in_words
from surrogate.inference.continuation import contact_error
from surrogate.inference.inputs import Array
from surrogate.inference.profile import without_each
from surrogate.inference.quantiles import (
    chi_squared_limit,
    exceeds_f,
    normal_quantile,
    student_quantile,
)
from surrogate.reading import plausibility
from surrogate.reading.plausibility import doubts

__all__ = ["fit_warnings"]

LARGEST_CONDITION = 30.0
"""Of the design matrix with columns of unit length: beyond it, intercept and slope are hardly
told apart; met when the radii differ by less than about 7 % (one standard deviation)."""

FALSE_ALARM = 0.01
"""Probability that a sound experiment, of however many cuts, is given an outlier warning; and
the same for a misfit warning."""

ALIKE = 1.2
"""Thickest wire over thinnest below which radii are alike."""

POOR = 0.5
"""R^2 below which the fit is not worth its numbers."""

SLIP_GAIN = 10.0
"""Times smaller that a slip's misfit must be where nothing else says what is acceptable."""

FEWEST_OTHERS = 3
"""Degrees of freedom from which the other cuts tell how far off one of them is."""

LEAST_SCATTER = 1e-3
"""Of the forces; others that agree better do so by chance or by rounding."""

EXACT = 1e-5
"""Of the forces; where forces share errors, what is met better is searched no further."""

_ROUNDING = 64.0 * np.finfo(float).eps


def fit_warnings(fit: Estimate) -> Iterator[str]:
    """Yield one sentence for each reason to doubt an identification.

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
    for reasons in (
        _limits,
        _out_of_range,
        _misfit,
        _physical,
        _negative_estimates,
        _outlier,
        _implausible,
        _too_few_radii,
        _condition,
        _regime,
        _scatter,
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
    if (distinct := np.unique(fit.wire_radius).size) < 3:
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


def _negative_estimates(fit: Estimate) -> Iterator[str]:
    remedy = "check the units, the friction coefficient and that radii are not diameters"
    if fit.toughness < 0.0:
        yield f"the toughness is negative ({fit.toughness:.4g} J/m2) and is not clipped; {remedy}"
    if fit.wear_strength < 0.0:
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
    error = contact_error(model, g[outside], fit.stiffening_exponent)
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
    if fit.dof <= 0 or _is_exact(fit):
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
        lack = max(total - scatter.pure_misfit, 0.0) / (groups - 2)
        if exceeds_f(lack / pure, (groups - 2, scatter.dof), FALSE_ALARM):
            acceptable = total if total <= 0 else pure * (fit.dof) * 2.0
            yield (
                f"the means of the wires are {np.sqrt(lack / pure):.2g} times as far off the "
                f"{_shape(fit)} as repeated cuts scatter: the {_shape(fit)} does not hold; "
                f"{_cause(fit, acceptable)}the intervals cannot be relied on"
            )
            return
    if fit.r_squared < POOR:
        yield (
            f"the {_shape(fit)} explains {'nothing' if fit.r_squared <= 0.0 else 'little'} of how "
            f"the forces vary (R^2 = {fit.r_squared:.2f}); "
            f"{_cause(fit, total / SLIP_GAIN)}look at the forces before any number"
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


def _scatter(fit: Estimate) -> Iterator[str]:
    if fit.force_std is None and fit.dof == 0:
        yield (
            f"two forces determine the {_shape(fit)} exactly and leave no measure of scatter: "
            "standard errors are unknown; cut more often, or give force_std"
        )
    elif _is_exact(fit):
        yield (
            f"the forces lie on the {_shape(fit)} to the last digit, which no measurement does: "
            "the residuals say nothing about the experiment's uncertainty"
        )


def _outlier(fit: Estimate) -> Iterator[str]:
    """Leave out each cut in turn, and name the one without which the misfit falls too far.

    By chi^2 of one degree of freedom where standard errors are known, else by that of the others;
    Bonferroni over cuts. Only the worst, because one bad cut drags the curve from the good ones.
    """
    few = fit.force_std is None and fit.dof < FEWEST_OTHERS
    if fit.dof < 2 or few or _is_exact(fit):
        return
    confidence = 1.0 - FALSE_ALARM / fit.force.size
    all_cuts, others = _left_out(fit)
    with np.errstate(all="ignore"):
        fall = np.maximum(all_cuts - others, 0.0)
        if fit.force_std is not None:
            limit, deviation = normal_quantile(confidence), np.sqrt(fall)
        else:
            least = (LEAST_SCATTER * fit.cuts.weight * fit.force).max() ** 2
            variance = np.maximum(others / (fit.dof - 1), least)
            limit = student_quantile(confidence, fit.dof - 1)
            deviation = np.sqrt(fall / variance)
    worst = int(np.argmax(deviation))
    if deviation[worst] > limit:
        yield (
            f"cut {worst + 1} (R_w = {1e3 * fit.wire_radius[worst]:.4g} mm, "
            f"{fit.force[worst]:.4g} N/m) is {deviation[worst]:.1f} standard deviations off the "
            f"{_shape(fit)} through the others (limit {limit:.1f}): an outlier; repeat that cut"
        )


def _left_out(fit: Estimate) -> tuple[float, Array]:
    """Return the misfit of all cuts and of all but each one, in the same units."""
    if fit.profile is not None:
        return fit.profile.modes[0].misfit, without_each(fit.misfit, fit.profile.toughness)
    weighted = fit.cuts.weight * fit.residuals
    total = float(weighted @ weighted)
    testable = np.maximum(1.0 - fit.leverage, 0.0)
    fall = np.divide(weighted**2, testable, out=np.zeros_like(weighted), where=testable > 1e-6)
    return total, np.maximum(total - fall, 0.0)


def _shape(fit: Estimate) -> str:
    return "line" if isinstance(force_model(fit.model), ClosedForm) else "curve"


def _is_exact(fit: Estimate) -> bool:
    least = _ROUNDING if fit.scale is None or fit.force_std is not None else EXACT
    return fit.dof > 0 and bool(np.max(np.abs(fit.residuals)) <= least * np.max(fit.force))

"""What makes an identification doubtful, in words."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from surrogate.choosing.by_name import force_model
from surrogate.contact.base import ForceModel
from surrogate.contact.closed_forms import ClosedForm
from surrogate.identification.estimate import Estimate
from surrogate.identification.further_wire import FurtherWire
from surrogate.inference.profile import Mode, Profile
from surrogate.inference.quantiles import normal_quantile, student_quantile
from surrogate.reading import plausibility
from surrogate.reading.plausibility import doubts

__all__ = ["undecided", "wire_in_words"]

LARGEST_CONDITION = 30.0
"""Of the design matrix with columns of unit length: beyond it, intercept and slope are hardly
told apart; met when the radii differ by less than about 7 % (one standard deviation)."""

FALSE_ALARM = 0.01
"""Probability that a sound experiment, of however many cuts, is given an outlier warning; and
the same for a misfit warning."""

CORNER = 1e-3
"""Cosine between residuals and slope from which the misfit counts as having a corner."""

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
        _implausible,
        _too_few_radii,
        _condition,
        _negative_estimates,
        _limits,
        _regime,
        _scatter,
        _outlier,
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
    if least > 0.0:
        yield from doubts(plausibility.COHESIVE_LENGTH, least / fit.shear_modulus)


def _too_few_radii(fit: Estimate) -> Iterator[str]:
    if (distinct := np.unique(fit.wire_radius).size) < 3:
        yield (
            f"only {distinct} different radii: they cannot show whether the forces lie on a "
            f"{_shape(fit)}; cut with a third radius between them"
        )


def _condition(fit: Estimate) -> Iterator[str]:
    if fit.condition > LARGEST_CONDITION:
        smallest, largest = 1e3 * fit.wire_radius.min(), 1e3 * fit.wire_radius.max()
        yield (
            f"the radii ({smallest:.4g} to {largest:.4g} mm) are too alike to tell toughness from "
            f"wear (condition number {fit.condition:.0f}, limit {LARGEST_CONDITION:.0f}); "
            "add much thinner or thicker wires"
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
    if fit.profile is None:
        return
    if fit.profile.modes[0].at_end:
        below = fit.toughness < fit.profile.searched[1]
        what = fit.profile.ends[0 if below else 1]
        limit = "given bound" if what == "bound" else f"end of what model '{fit.model}' covers"
        yield (
            f"the toughness is at the {limit} ({fit.toughness:.4g} J/m2), beyond which the forces "
            "would be met better"
        )
    for name, value, known in (
        ("toughness", fit.toughness, False),
        ("wear strength", fit.wear_strength, fit.known.wear_strength is not None),
    ):
        if value == 0.0 and not known:
            yield f"the {name} is 0, its limit: no larger one meets the forces as well"


def _regime(fit: Estimate) -> Iterator[str]:
    chosen = force_model(fit.model)
    if not isinstance(chosen, ClosedForm):
        yield from _domain(fit, chosen)
        return
    g = fit.dimensionless_toughness
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
    elif fit.reduced_chi_squared is not None and fit.dof > 0:
        limit = _reduced_chi_squared_limit(fit.dof)
        if fit.reduced_chi_squared > limit:
            yield (
                f"chi^2/dof = {fit.reduced_chi_squared:.3g} is above {limit:.3g}: the forces "
                f"scatter about the {_shape(fit)} more than force_std allows; the {_shape(fit)} "
                "does not hold, or force_std is too small, and so are the standard errors"
            )


def _outlier(fit: Estimate) -> Iterator[str]:
    """Compare the residuals with their own spread (Bonferroni over cuts), and name the worst.

    Only the worst, because one bad cut drags the line away from the good ones. Without known
    standard errors the spread is that of the other cuts, each left out in turn.
    """
    # at a limit, or where the curve has a corner, the residuals have another spread
    if _is_exact(fit) or any(_limits(fit)) or _at_corner(fit):
        return
    confidence = 1.0 - FALSE_ALARM / fit.force.size
    spread = np.sqrt(np.maximum(1.0 - fit.leverage, 0.0))
    testable = spread > 1e-6  # a cut that the line must pass through cannot deviate
    deviation = np.zeros_like(fit.residuals)
    if fit.force_std is not None:
        scaled = fit.residuals / fit.force_std
        limit = normal_quantile(confidence)
        np.divide(scaled, spread, out=deviation, where=testable)
    elif fit.dof > 1:
        scaled = fit.residuals / np.sqrt(fit.residuals @ fit.residuals / fit.dof)
        limit = student_quantile(confidence, fit.dof - 1)
        np.divide(scaled, spread, out=deviation, where=testable)
        others = np.maximum(fit.dof - deviation**2, fit.dof * _ROUNDING)
        deviation *= np.sqrt((fit.dof - 1) / others)
    else:
        return
    worst = int(np.argmax(np.abs(deviation)))
    if abs(deviation[worst]) > limit:
        yield (
            f"cut {worst + 1} (R_w = {1e3 * fit.wire_radius[worst]:.4g} mm, "
            f"{fit.force[worst]:.4g} N/m) is {abs(deviation[worst]):.1f} standard deviations off "
            f"the {_shape(fit)} (limit {limit:.1f}): an outlier; repeat that cut"
        )


def _at_corner(fit: Estimate) -> bool:
    """Return whether the misfit has a corner at the estimate, as where the tip touches a wire.

    At a smooth minimum the weighted residuals are at right angles to the force's slope.
    """
    if fit.profile is None or fit.known.toughness_prior is not None:
        return False
    weight = fit.cuts.weight
    slope, residuals = weight * fit.force_slopes(fit.wire_radius)[:, 0], weight * fit.residuals
    size = float(np.linalg.norm(slope) * np.linalg.norm(residuals))
    return bool(abs(slope @ residuals) > CORNER * size)


def _shape(fit: Estimate) -> str:
    return "line" if isinstance(force_model(fit.model), ClosedForm) else "curve"


def _is_exact(fit: Estimate) -> bool:
    return fit.dof > 0 and bool(np.max(np.abs(fit.residuals)) <= _ROUNDING * np.max(fit.force))


def _reduced_chi_squared_limit(dof: int) -> float:
    """Value that chi^2/dof exceeds with probability FALSE_ALARM, after Wilson and Hilferty."""
    z = normal_quantile(1.0 - 2.0 * FALSE_ALARM)
    variance = 2.0 / (9.0 * dof)
    return float((1.0 - variance + z * np.sqrt(variance)) ** 3)


VAGUE = 3.0
"""Ratio of an interval's ends from which its quantity counts as undecided."""


def undecided(fit: Estimate) -> Iterator[str]:
    """Yield one sentence for each question that the forces leave open.

    Parameters
    ----------
    fit : Estimate
        The identification to look at; without a `profile` there is nothing to say.

    Yields
    ------
    str
        What is not decided, with the numbers; last, the further wire that would tell most.
    """
    if fit.profile is None:
        return
    sentences = [
        *_several(fit, fit.profile),
        *_toughness_ends(fit, fit.profile),
        *_wear_ends(fit, fit.profile),
        *_wide(fit),
    ]
    yield from sentences
    if sentences and fit.further_wire is not None:
        yield wire_in_words(fit.further_wire)


def wire_in_words(wire: FurtherWire) -> str:
    """Return which further wire would tell most, and how clearly."""
    low, high = wire.forces
    kind = "both materials" if wire.modes else "the ends of the toughness's interval"
    sentence = (
        f"a wire of radius {1e3 * wire.wire_radius:.3g} mm would tell most: {low:.4g} N/m for "
        f"Gamma_o = {wire.toughnesses[0]:.3g} J/m2, {high:.4g} N/m for {wire.toughnesses[1]:.3g} "
        f"J/m2 ({kind}; searched from {1e3 * wire.searched[0]:.3g} to "
        f"{1e3 * wire.searched[1]:.3g} mm)"
    )
    if np.isinf(wire.separation):
        return sentence
    if wire.separation >= 2.0:
        return f"{sentence}, {wire.separation:.1f} standard errors of one cut apart"
    if wire.cuts <= 1000:
        return (
            f"{sentence}, but only {wire.separation:.2g} standard errors of one cut apart: it "
            f"takes the mean of {wire.cuts:.0f} cuts to tell them by two"
        )
    return f"{sentence}, but no wire in that range tells them apart with a thousand cuts"


def _several(fit: Estimate, profile: Profile) -> Iterator[str]:
    admitted = [mode for mode in profile.modes if mode.admitted]
    if len(admitted) > 1:
        listed = "; ".join(_mode_in_words(fit, mode) for mode in admitted)
        yield f"{len(admitted)} materials fit the forces within the confidence asked for: {listed}"


def _mode_in_words(fit: Estimate, mode: Mode) -> str:
    misfit = "sum of squares" if fit.force_std is None else "chi^2"
    return (
        f"Gamma_o = {mode.toughness:.4g} J/m2 with tau_w = {1e-3 * mode.wear_strength:.4g} kPa "
        f"({misfit} {mode.misfit:.3g})"
    )


def _toughness_ends(fit: Estimate, profile: Profile) -> Iterator[str]:
    if not profile.toughness_intervals:
        return
    low, high = fit.toughness_interval
    (first, last), (below, above) = profile.searched, profile.ends
    if low == 0.0:
        up_to = profile.toughness_intervals[0][1]
        yield (
            f"the forces set no lower limit to the toughness: anything up to {up_to:.3g} J/m2 fits"
        )
    elif below == "model" and low <= first:
        yield (
            f"the toughness may be smaller than {low:.3g} J/m2, where model '{fit.model}' ends for "
            "the thickest wire"
        )
    if high >= last and above == "model":
        yield (
            f"the toughness may be larger than {high:.3g} J/m2, where model '{fit.model}' ends for "
            "the thinnest wire"
        )
    elif high >= last and above == "bound":
        yield f"it is the bound of {high:.4g} J/m2, not the forces, that limits the toughness above"


def _wear_ends(fit: Estimate, profile: Profile) -> Iterator[str]:
    low, high = fit.wear_strength_interval
    if fit.known.wear_strength is not None:
        return
    if low == 0.0:
        up_to = 1e-3 * profile.wear_strength_intervals[0][1]
        yield f"whether the solid wears at all: any tau_w up to {up_to:.3g} kPa fits"
    if np.isinf(high):
        yield "the forces set no upper limit to the wear strength"


def _wide(fit: Estimate) -> Iterator[str]:
    for name, scale, unit, (low, high) in (
        ("toughness", 1.0, "J/m2", fit.toughness_interval),
        ("wear strength", 1e-3, "kPa", fit.wear_strength_interval),
    ):
        if VAGUE * low < high < np.inf and low > 0.0:
            yield (
                f"the {name} is only known to be between {scale * low:.3g} and "
                f"{scale * high:.3g} {unit}"
            )

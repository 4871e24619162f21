"""Which cut is an outlier, and what the others say without it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from surrogate.identification.estimate import Estimate
from surrogate.inference.inputs import Array
from surrogate.inference.line_fit import solve_least_squares
from surrogate.inference.profile import without_each
from surrogate.inference.quantiles import normal_quantile, student_quantile

__all__ = ["Outlier", "outlier"]

FALSE_ALARM = 0.03
"""Probability that a sound experiment, of however many cuts, is said to have an outlier."""

FEWEST_OTHERS = 3
"""Degrees of freedom from which the other cuts tell how far off one of them is: with fewer, 60
standard deviations would be no surprise."""

LEAST_SCATTER = 1e-3
"""Of the forces; others that agree better do so by chance or by rounding."""


@dataclass(frozen=True)
class Outlier:
    """A cut that the others leave too far off.

    Parameters
    ----------
    cut : int
        Its place, from 0.
    wire_radius, force : float
        R_w [m] and F_ss/T [N/m] of it.
    deviation, limit : float
        Its residual from the fit of the others, in standard deviations, and what it may be [-].
    toughness, wear_strength : float
        What the others alone say [J/m2], [Pa].
    """

    cut: int
    wire_radius: float
    force: float
    deviation: float
    limit: float
    toughness: float
    wear_strength: float

    def words(self, shape: str) -> str:
        """Return the finding in words; `shape` is what the others lie on."""
        return (
            f"cut {self.cut + 1} (R_w = {1e3 * self.wire_radius:.4g} mm, {self.force:.4g} N/m) is "
            f"{self.deviation:.1f} standard deviations off the {shape} through the others (limit "
            f"{self.limit:.1f}): an outlier; repeat that cut. Without it Gamma_o = "
            f"{self.toughness:.3g} J/m2 and tau_w = {1e-3 * self.wear_strength:.3g} kPa"
        )


def outlier(fit: Estimate) -> Outlier | None:
    """Return the cut that the others leave farthest off, if it is too far for scatter.

    Each is left out in turn. Its residual from the fit of the others, over its standard error from
    the scatter of the others, follows Student's t; of all cuts the largest is judged, by
    Bonferroni's bound. For a straight line and one outlier no other test of the same rate of false
    alarms sees more. Where standard errors are known, they take the place of the scatter. Only the
    worst is named, because one bad cut drags the curve away from the good ones.

    How much that sees depends on how many others there are: of cuts that are 10 standard deviations
    off, it misses about one in thirty among 8 cuts, one in ten among 7, a third among 6 and two
    thirds among 5 where neither `force_std` nor repeats tell the scatter; with fewer it sees none.

    Parameters
    ----------
    fit : Estimate
        The identification.

    References
    ----------
    R. D. Cook, S. Weisberg, Residuals and Influence in Regression, 1982, section 2.2.2.
    T. S. Ferguson, Proc. Fourth Berkeley Symposium 1 (1961) 253.

    Examples
    --------
    >>> from surrogate.identification.fit import identify
    >>> radius, force = [1e-4, 2e-4, 3e-4, 4e-4, 5e-4], [3.0, 5.0, 9.0, 9.01, 10.99]
    >>> outlier(identify(radius, force, model="eq13")).cut
    2
    """
    few = fit.force_std is None and fit.dof < FEWEST_OTHERS
    if fit.dof < 2 or few or fit.is_exact:
        return None
    total, (misfit, toughness, wear) = _left_out(fit)
    confidence = 1.0 - FALSE_ALARM / fit.force.size
    with np.errstate(all="ignore"):
        fall = np.maximum(total - misfit, 0.0)
        if fit.force_std is not None:
            limit, deviation = normal_quantile(confidence), np.sqrt(fall)
        else:
            least = (LEAST_SCATTER * fit.cuts.weight * fit.force).max() ** 2
            variance = np.maximum(misfit / (fit.dof - 1), least)
            limit = student_quantile(confidence, fit.dof - 1)
            deviation = np.sqrt(fall / variance)
    worst = int(np.argmax(deviation))
    if not deviation[worst] > limit:
        return None
    return Outlier(
        worst,
        float(fit.wire_radius[worst]),
        float(fit.force[worst]),
        float(deviation[worst]),
        limit,
        float(toughness[worst]),
        float(wear[worst]),
    )


def _left_out(fit: Estimate) -> tuple[float, Array]:
    """Return the misfit of all cuts; and misfit, toughness, wear strength of all but each one."""
    if fit.profile is not None:
        return fit.profile.modes[0].misfit, without_each(fit.misfit, fit.profile.toughness)
    weight, columns = fit.cuts.weight, fit.force_slopes(fit.wire_radius)
    design, weighted = columns * weight[:, np.newaxis], weight * fit.residuals
    testable = np.maximum(1.0 - fit.leverage, 0.0)
    deleted = np.divide(weighted, testable, out=np.zeros_like(weighted), where=testable > 1e-6)
    # what leaving a cut out does to the estimates: Cook and Weisberg, section 3.4
    shift = solve_least_squares(design, weighted).covariance @ design.T * deleted
    estimates = np.array([[fit.toughness], [fit.wear_strength]]) - shift
    total = float(weighted @ weighted)
    return total, np.vstack([np.maximum(total - weighted * deleted, 0.0), estimates])

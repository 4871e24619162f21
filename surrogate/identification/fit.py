"""Cleavage toughness and wear strength out of forces cut with wires of several radii."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from surrogate.basics.checks import LARGEST, Quantity, one_number
from surrogate.basics.records import html_table, number
from surrogate.choosing.accuracy import one_model
from surrogate.choosing.by_name import AUTO
from surrogate.choosing.laws import PROJECTED
from surrogate.contact.base import ForceModel
from surrogate.identification.doubts import fit_warnings, objections
from surrogate.identification.estimate import Estimate
from surrogate.identification.friction import WithFriction, with_friction
from surrogate.identification.open_questions import undecided
from surrogate.identification.profile_fit import best_fit, fit_profile
from surrogate.identification.summary import answer, summary
from surrogate.inference.inputs import (
    FRICTION_COEFFICIENT,
    NOTHING_KNOWN,
    Array,
    known,
    material_of,
    series_of_cuts,
    stated_errors,
)
from surrogate.inference.law import lawful_fit, require_law
from surrogate.inference.line_fit import fit_line, is_linear
from surrogate.inference.scatter import scatter_of_repeats

__all__ = ["Identification", "identify"]

CONFIDENCE = Quantity(
    "confidence", "", "give 0.95 for 95 %", lower=1e-30, upper=1.0 - np.finfo(float).epsneg
)


@dataclass(frozen=True, eq=False, repr=False)
class Identification(Estimate):
    """What a series of wire cuts says about a material; see `identify`.

    Parameters
    ----------
    toughness, wear_strength : float
        Estimates of Gamma_o [J/m2] and tau_w [Pa]; with `profile` None, negative where the data
        say so.
    covariance : ndarray, shape (2, 2)
        Of (toughness, wear_strength), near the estimate; nan where the data leave no measure of
        scatter.
    correlation : float
        Of the two estimates [-]; nan where one of them was given.
    residuals : ndarray, shape (n,)
        Measured minus fitted F_ss/T [N/m].
    r_squared : float
        Share of the forces' variation that the fit explains [-]; nan where they do not vary.
    reduced_chi_squared : float or None
        Sum of squared residuals in units of `force_std`, per degree of freedom [-]; None
        without `force_std`, nan without degrees of freedom.
    condition : float
        Condition number of the design matrix with columns of unit length [-].
    leverage : ndarray, shape (n,)
        Weight of each force in its own prediction [-].
    wire_radius, force, force_std : ndarray, shape (n,)
        The measurements [m], [N/m], [N/m]; `force_std` may be None.
    shear_modulus, friction_coefficient, stiffening_exponent : float
        What was given: mu [Pa], xi [-], alpha [-].
    model : str
        Name of the force model.
    confidence : float
        Probability that each interval states [-].
    known : Known
        What was given besides the forces.
    profile : Profile or None
        The misfit along the toughness, with all its minima (`modes`) and the pieces of the
        intervals; None where the force is a straight line in both unknowns and nothing else was
        given.
    further_wire : FurtherWire or None
        The wire that would tell most about what `undecided` names; None without `profile`.
    model_error : tuple of float, or None
        Standard errors that the measured error bounds of a fitted model's A and B bring to
        Gamma_o [J/m2] and tau_w [Pa]; part of the intervals. None for closed forms, whose errors
        nobody states.
    contributions : mapping of str to tuple of float
        Standard errors of Gamma_o [J/m2] and tau_w [Pa] that each source brings: "scatter",
        "model", "shear_modulus", "friction_coefficient", "stiffening_exponent", "sample".
    scale : float or None
        Standard error of a force of weight 1 [N/m] that was set against what forces share.
    friction_sensitivity : tuple of float
        dGamma_o/dxi [J/m2] and dtau_w/dxi [Pa], to first order; nan where the force has no
        derivative at the estimate, as at Gamma_o = 0.
    shear_modulus_std, friction_std, stiffening_std : float
        Their standard errors, as given [Pa], [-], [-].
    sample : None, or ndarray of int
        Number of the sample of each cut.
    scatter : Scatter or None
        What repeated cuts say about the scatter of forces, where `force_std` was not given.
    assumed : tuple of str
        Names of what nobody gave: "friction_coefficient" of 0, "stiffening_exponent" of 2, or
        "shear_modulus", which plays no part then.
    law_reason : str
        Why the forces were identified under `law`, in words.
    law_error : float
        Largest bound over the cuts of what the law adds to the relative error of a force, beside
        finite elements on which the wire rubs [-]: 0 under "coupled", whose own error is part of
        `model_error`; nan where nobody knows it. It is in no interval.

    Notes
    -----
    Standard errors and intervals contain the forces' scatter, the model's own error and what was
    given as uncertain: mu, xi, alpha. `contributions` says how much each adds. Where the end of a
    model, a bound, the search or 0 holds an estimate or an end of an interval,
    `toughness_limited_by` and `wear_strength_limited_by` say so, and the standard error is nan.

    With `profile`, intervals and `band` come from the misfit itself, and may be lopsided; standard
    errors and covariance are those of the force's derivatives at the estimate.

    Standard errors of lengths come from the covariance by first-order propagation. They hold where
    the standard error of tau_w is small beside tau_w.

    References
    ----------
    arXiv:2412.02021, Eqs. (10) to (15).

    Examples
    --------
    >>> from surrogate import identify
    >>> fit = identify([1e-4, 2e-4, 4e-4, 5e-4], [4.7, 7.9, 13.9, 17.2], 685.0, model="eq13")
    >>> print(f"l_w = {1e6 * fit.wear_length:.1f} +- {1e6 * fit.wear_length_std:.1f} um")
    l_w = 209.7 +- 18.5 um
    """

    @property
    def objections(self) -> tuple[str, ...]:
        """Why the result should not be used as it stands, in words; empty where it may be."""
        return tuple(objections(self))

    @property
    def warnings(self) -> tuple[str, ...]:
        """What makes the result doubtful, in words; the objections first."""
        return tuple(fit_warnings(self))

    @property
    def undecided(self) -> tuple[str, ...]:
        """What the forces do not decide, and which further wire would, in words."""
        return tuple(undecided(self))

    def with_friction(self, friction_coefficient: float) -> WithFriction:
        """Return toughness and wear strength of the same forces with another friction coefficient.

        Parameters
        ----------
        friction_coefficient : float
            xi [-].

        Raises
        ------
        InputError
            If it is negative or no number, or if the shear modulus is not known.
        DomainError
            If the model covers no toughness for all of the wires, or the law is "coupled" and its
            solutions do not reach to a cut with this friction.
        """
        return with_friction(self, one_number(FRICTION_COEFFICIENT, friction_coefficient))

    def summary(self) -> str:
        """Return the answer, the doubts and what both rest on, in at most 25 lines."""
        return summary(self)

    def __str__(self) -> str:
        """The same: what `print` shows."""
        return self.summary()

    def __repr__(self) -> str:
        """One line, without the arrays."""
        return f"<Identification: {answer(self)}>"

    def _repr_html_(self) -> str:
        """What notebooks show."""
        return _html(self)


def identify(
    wire_radius: ArrayLike | None,
    force: ArrayLike,
    shear_modulus: float | None = None,
    *,
    friction_coefficient: float | None = None,
    stiffening_exponent: float | None = None,
    force_std: ArrayLike | None = None,
    relative_error: float | None = None,
    wire_diameter: ArrayLike | None = None,
    sample: ArrayLike | None = None,
    shear_modulus_std: float = 0.0,
    friction_std: float = 0.0,
    stiffening_std: float = 0.0,
    model: str | ForceModel = AUTO,
    rtol: float | None = None,
    confidence: float = 0.95,
    toughness_max: float | None = None,
    wear_strength: float | None = None,
    toughness_prior: tuple[float, float] | None = None,
    wear_strength_prior: tuple[float, float] | None = None,
    further_radii: tuple[float, float] | None = None,
    law: str = AUTO,
) -> Identification:
    """Identify cleavage toughness and wear strength from steady wire-cutting forces.

    With A and B of the force model at g = Gamma_o/(mu R_w),

        F_ss/T = Gamma_o + 2 R_w (tau_w A + xi mu B),

    the misfit is followed along Gamma_o of 0 or more, with the best tau_w of 0 or more for each,
    over all that the forces, the model and a bound allow. It may have several minima, because A
    rises and falls with g: the best one is the estimate, all are in `profile.modes`. Intervals hold
    what the misfit admits.

    The paper's closed forms are linear in Gamma_o and tau_w: Eq. (13) is
    F_ss/T - 4 xi mu R_w = (1 + xi) Gamma_o + 4 R_w tau_w. With them, and where no bound, value or
    prior is given, the two are found by weighted linear least squares.

    The friction coefficient CANNOT be identified: in Eq. (13) it only multiplies terms that
    Gamma_o and tau_w already have, so that any xi fits equally well. It has to be given.

    Parameters
    ----------
    wire_radius : array_like, shape (n,), or None
        R_w [m], n of 2 or more; None where `wire_diameter` is given. One wire is enough where
        `wear_strength` or a prior is given.
    force : array_like, shape (n,)
        Steady-state cutting force per thickness F_ss/T [N/m].
    shear_modulus : float, optional
        mu [Pa]; needed for g and, with friction, for the stiffness term. Eq. (13) without friction
        needs none.
    friction_coefficient : float, optional
        xi [-]; assumed to be 0 where it is not given.
    stiffening_exponent : float, optional
        alpha of the Ogden solid, Eq. (1) [-]; assumed to be 2 where it is not given. A negative one
        counts as its absolute value: in plane strain an incompressible solid has l_1 = 1/l_2, so
        that both are the same solid.
    force_std : array_like, shape (n,) or scalar, optional
        Standard error of each force [N/m]: for a mean of m cuts that scatter by s,
        s/sqrt(m). Given, it is taken as known: it weights the fit, intervals use normal
        quantiles and the covariance is NOT rescaled by chi^2/dof, which is reported instead.
        Not given, every force weighs the same, the residuals' variance sets the scale and
        intervals use Student's t.
    relative_error : float, optional
        Standard error of each force over the force [-], instead of `force_std`.
    wire_diameter : array_like, shape (n,), optional
        2 R_w [m], instead of `wire_radius`.
    sample : sequence, shape (n,), optional
        Name of the sample that each cut was made in; the scatter between samples is estimated.
    shear_modulus_std, friction_std, stiffening_std : float, default 0
        Standard errors of mu [Pa], xi [-] and alpha [-], which become part of the intervals.
    model : str, default "auto"
        Any force model that has wear, see `models`. "auto" is one model for all toughnesses: the
        cheapest whose A and B meet `rtol` all over its domain. "eq13", "low-toughness" (Eq. 12)
        and "friction-free" (Eq. 15) are linear in both unknowns.
    rtol : float, optional
        Relative error of A and B that will do with "auto" [-]; by default 0.02 where a model is as
        exact, else that of the most exact one. What it may do to the estimates is said by
        `model_error` and is part of the intervals.
    confidence : float, default 0.95
        Probability that each interval states, of each estimate by itself [-].
    toughness_max : float, optional
        Bound of Gamma_o [J/m2], for instance the toughness Gamma of pure shear.
    wear_strength : float, optional
        tau_w where it is known [Pa], for instance the work of fracture W_f.
    toughness_prior : tuple of float, optional
        Mean and standard deviation of what is known of Gamma_o [J/m2]; needs `force_std`.
    wear_strength_prior : tuple of float, optional
        Mean and standard deviation of what is known of tau_w [Pa]; needs `force_std`.
    further_radii : tuple of float, optional
        Smallest and largest radius of a further wire that you could cut with [m]; by default from
        a fifth of the thinnest to five times the thickest of the wires, but from 20 um to 2 mm
        across as far as theirs allow.
    law : str, default "auto"
        Which functions of the contact wear and friction follow, as in `cutting_force`; a wear
        strength that was identified by one law does not belong into another. "auto" is one law
        for all cuts: "coupled", the most faithful one, where coupled solutions reach to each of
        them at the estimate; else "projected", the only one with an experiment behind it, under
        which tau_w is an effective strength of unknown error. `law` and `law_reason` of the result
        say which and why. Closed forms are "projected".

    Returns
    -------
    Identification
        Estimates with their uncertainty, derived lengths, warnings in words and, where the misfit
        was followed along Gamma_o, its minima and what is left undecided.

    Raises
    ------
    InputError
        If radius and diameter are both given or both missing; if a number is not positive and
        finite; if the lengths of the arrays differ; if there are fewer than two different radii;
        if the model has no wear; or if the bound excludes all that the model covers.
    UnknownModelError
        If there is no such model.
    DomainError
        If the model does not reach to alpha, or covers no toughness for all of the wires; under the
        law "coupled" if coupled solutions do not reach to the friction and wear of a cut.
    AccuracyError
        If the model is "auto" and none is as exact as `rtol`, or with the law "auto" nobody knows.

    Notes
    -----
    Intervals of the followed misfit S hold each Gamma_o with S <= S_min + z^2 where `force_std` is
    given, and S <= S_min (1 + t^2/dof) where not: the quantile of chi^2 with one degree of freedom,
    and that of F with 1 and dof. They are the same as above where the force is linear, and right to
    the order of the curvature where it is not. Near the limits Gamma_o = 0 and tau_w = 0 they hold
    the truth at least about as often as stated.

    Range of validity: that of the force model. A fitted one is continued by its asymptotes for
    wires beyond its domain, with an error that grows with ln g and is part of the intervals, and a
    warning names these wires. Eq. (13) takes its wear term from Eq. (11), which
    the paper found for g <= 1; beyond it a warning is given. A negative estimate is reported as it
    is.

    References
    ----------
    arXiv:2412.02021, Eqs. (10) to (15), (S1), (S2).
    S. A. Murphy and A. W. van der Vaart, J. Am. Stat. Assoc. 95 (2000) 449 (profile likelihood).

    Examples
    --------
    By Eq. (13):

    >>> radius, force = [1e-4, 2e-4, 4e-4, 5e-4], [4.7, 7.9, 13.9, 17.2]
    >>> fit = identify(radius, force, shear_modulus=685.0, model="eq13")
    >>> print(f"{fit.toughness:.4f} +- {fit.toughness_std:.4f} J/m2")
    1.6250 +- 0.1257 J/m2
    >>> print(f"{fit.wear_strength:.1f} +- {fit.wear_strength_std:.1f} Pa")
    7750.0 +- 92.7 Pa
    >>> print(f"{fit.wear_transition_radius:.4e} m")
    5.2419e-05 m

    With a toughness of at most 1.5 J/m2:

    >>> fit = identify(radius, force, 685.0, model="eq13", toughness_max=1.5)
    >>> print(f"{fit.toughness:.4f} J/m2, {fit.wear_strength:.1f} Pa")
    1.5000 J/m2, 7831.5 Pa

    By finite elements more than one toughness may fit:

    >>> len(identify(radius, force, 685.0).profile.modes) > 1
    True
    """
    require_law(law)
    needing = one_model(model, rtol).name if law == PROJECTED else model
    given = known(
        toughness_max,
        wear_strength,
        toughness_prior,
        wear_strength_prior,
        force_std is not None or relative_error is not None,
    )
    modulus, material, assumed = material_of(
        needing, shear_modulus, friction_coefficient, stiffening_exponent
    )
    cuts = series_of_cuts(
        wire_radius,
        wire_diameter,
        force,
        stated_errors(force, force_std, relative_error),
        (modulus, *material),
        fewest_radii=1 if given.facts else 2,
        stds=(shear_modulus_std, friction_std, stiffening_std),
        sample=sample,
    )
    scatter = None
    if cuts.force_std is None:
        scatter = scatter_of_repeats(cuts.wire_radius, cuts.force, cuts.sample)
    if scatter is not None:
        cuts = replace(cuts, weights=scatter.weights, sample_ratio=scatter.sample_ratio)
    probability = one_number(CONFIDENCE, confidence)

    def fitted(model: str | ForceModel) -> dict[str, Any]:
        if is_linear(model) and given == NOTHING_KNOWN:
            return fit_line(cuts, model)
        return fit_profile(cuts, model, given, probability, further_radii)

    solved = lawful_fit(model, law, rtol, cuts, partial(best_fit, cuts, given), fitted)
    fit = solved.fit
    weight, residuals = cuts.weight, fit["residuals"]
    dof = cuts.force.size + given.facts - 2
    misfit = fit.pop("misfit")
    mean = np.average(cuts.force, weights=weight**2)
    total_sum = _square_sum((cuts.force - mean) * weight)
    identification = Identification(
        **fit,
        r_squared=(
            1.0 - _square_sum(residuals * weight) / total_sum if total_sum > 0.0 else np.nan
        ),
        reduced_chi_squared=(None if cuts.force_std is None else misfit / dof if dof else np.nan),
        wire_radius=cuts.wire_radius,
        force=cuts.force,
        force_std=cuts.force_std,
        shear_modulus=cuts.shear_modulus,
        friction_coefficient=cuts.friction_coefficient,
        stiffening_exponent=cuts.stiffening_exponent,
        shear_modulus_std=cuts.shear_modulus_std,
        friction_std=cuts.friction_std,
        stiffening_std=cuts.stiffening_std,
        sample=cuts.sample,
        scatter=scatter,
        assumed=assumed,
        model=solved.model,
        confidence=probability,
        known=given,
        law_reason=solved.reason,
        law_error=solved.error,
    )
    if identification.at_limit:
        return replace(identification, covariance=fit["covariance"] * np.nan)
    return identification


def _html(fit: Identification) -> str:
    """Return estimates with intervals, lengths, and everything that is to be said about them."""

    def interval(low: float, high: float, scale: float) -> str:
        ends = number(scale * low), "any" if high >= LARGEST else number(scale * high)
        return f" ({100.0 * fit.confidence:.3g} %: {ends[0]} to {ends[1]})"

    rows = [
        ("model", str(fit.model), ""),
        (
            "cleavage toughness",
            number(fit.toughness) + interval(*fit.toughness_interval, 1.0),
            "J/m2",
        ),
        (
            "wear strength",
            number(1e-3 * fit.wear_strength) + interval(*fit.wear_strength_interval, 1e-3),
            "kPa",
        ),
        ("l_w = Gamma_o/tau_w", number(1e6 * fit.wear_length), "um"),
        *(("warning", warning, "") for warning in fit.warnings),
        *(("undecided", sentence, "") for sentence in fit.undecided),
    ]
    return html_table("Identification", rows)


def _square_sum(values: Array) -> float:
    return float(values @ values)

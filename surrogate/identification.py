"""Cleavage toughness and wear strength out of forces cut with wires of several radii."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from surrogate import validation
from surrogate.errors import InputError
from surrogate.fit_warnings import fit_warnings
from surrogate.force_models import force_model
from surrogate.least_squares import solve_least_squares
from surrogate.radii import transition_radius, wear_transition_radius
from surrogate.scene import Scene
from surrogate.statistics import normal_quantile, student_quantile
from surrogate.validation import Quantity, one_number

__all__ = ["Identification", "identify"]

Array = NDArray[np.float64]

# Within these limits no square or product of a fit leaves the range of a float.
_SMALLEST, _LARGEST = 1e-30, 1e30


def _limited(quantity: Quantity, smallest: float = _SMALLEST) -> Quantity:
    return replace(quantity, lower=smallest, upper=_LARGEST)


WIRE_RADIUS = _limited(validation.WIRE_RADIUS)
PREDICTED_RADIUS = _limited(validation.WIRE_RADIUS, smallest=0.0)
WIRE_DIAMETER = _limited(Quantity("wire_diameter", "m", "give the wire's diameter in metres"))
FORCE = _limited(
    Quantity(
        "force", "N/m", "give the steady cutting force per thickness, cutting counted positive"
    )
)
FORCE_STD = _limited(Quantity("force_std", "N/m", "give the standard error of each force"))
SHEAR_MODULUS = _limited(validation.SHEAR_MODULUS)
FRICTION_COEFFICIENT = _limited(validation.FRICTION_COEFFICIENT, smallest=0.0)
CONFIDENCE = Quantity(
    "confidence", "", "give 0.95 for 95 %", lower=_SMALLEST, upper=1.0 - np.finfo(float).epsneg
)


@dataclass(frozen=True, eq=False)
class Identification:
    """What a series of wire cuts says about a material; see `identify`.

    Parameters
    ----------
    toughness, wear_strength : float
        Estimates of Gamma_o [J/m2] and tau_w [Pa]; negative where the data say so.
    covariance : ndarray, shape (2, 2)
        Of (toughness, wear_strength); nan where the data leave no measure of scatter.
    correlation : float
        Of the two estimates [-]; a matter of the radii alone.
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

    Notes
    -----
    Standard errors of lengths come from the covariance by first-order propagation, with mu and xi
    taken as exact. They hold where the standard error of tau_w is small beside tau_w.

    References
    ----------
    arXiv:2412.02021, Eqs. (10) to (15).

    Examples
    --------
    >>> fit = identify([1e-4, 2e-4, 4e-4, 5e-4], [4.7, 7.9, 13.9, 17.2], shear_modulus=685.0)
    >>> print(f"l_w = {1e6 * fit.wear_length:.1f} +- {1e6 * fit.wear_length_std:.1f} um")
    l_w = 209.7 +- 18.5 um
    """

    toughness: float
    wear_strength: float
    covariance: Array
    correlation: float
    residuals: Array
    r_squared: float
    reduced_chi_squared: float | None
    condition: float
    leverage: Array
    wire_radius: Array
    force: Array
    force_std: Array | None
    shear_modulus: float
    friction_coefficient: float
    stiffening_exponent: float
    model: str
    confidence: float

    @property
    def warnings(self) -> tuple[str, ...]:
        """What makes the result doubtful, in words."""
        return tuple(fit_warnings(self))

    @property
    def dof(self) -> int:
        """Degrees of freedom: measurements less the two unknowns."""
        return self.force.size - 2

    @property
    def toughness_std(self) -> float:
        """Standard error of the toughness [J/m2]."""
        return float(np.sqrt(self.covariance[0, 0]))

    @property
    def wear_strength_std(self) -> float:
        """Standard error of the wear strength [Pa]."""
        return float(np.sqrt(self.covariance[1, 1]))

    @property
    def toughness_interval(self) -> tuple[float, float]:
        """Confidence interval of the toughness [J/m2]."""
        return self._interval(self.toughness, self.toughness_std)

    @property
    def wear_strength_interval(self) -> tuple[float, float]:
        """Confidence interval of the wear strength [Pa]."""
        return self._interval(self.wear_strength, self.wear_strength_std)

    @property
    def dimensionless_toughness(self) -> Array:
        """g = Gamma_o/(mu R_w) of each wire [-], shape (n,)."""
        return self.toughness / (self.shear_modulus * self.wire_radius)

    @property
    def is_physical(self) -> bool:
        """Whether neither estimate is negative."""
        return self.toughness >= 0.0 and self.wear_strength >= 0.0

    @property
    def wear_length(self) -> float:
        """l_w = Gamma_o/tau_w [m]; nan where an estimate is negative."""
        return 4.0 * self.wear_transition_radius

    @property
    def wear_transition_radius(self) -> float:
        """l_w/4 [m]; nan where an estimate is negative."""
        return float(wear_transition_radius(self.scene(1.0))) if self.is_physical else np.nan

    @property
    def transition_radius(self) -> float:
        """Radius at which the two terms of Eq. (13) are equal [m]; nan if one is negative."""
        return float(transition_radius(self.scene(1.0))) if self.is_physical else np.nan

    @property
    def wear_length_std(self) -> float:
        """Standard error of l_w [m]; nan where l_w is infinite or nan."""
        return self._length_std(1.0, 0.0)

    @property
    def wear_transition_radius_std(self) -> float:
        """Standard error of l_w/4 [m]; nan where that is infinite or nan."""
        return 0.25 * self.wear_length_std

    @property
    def transition_radius_std(self) -> float:
        """Standard error of the transition radius of Eq. (13) [m]; nan where that is no number."""
        xi = self.friction_coefficient
        return self._length_std(0.25 * (1.0 + xi), xi * self.shear_modulus)

    def _length_std(self, factor: float, stress: float) -> float:
        """Standard error of factor Gamma_o/(stress + tau_w) [m], to first order."""
        stress += self.wear_strength
        if not self.is_physical or stress == 0.0:
            return np.nan
        gradient = (factor / stress) * np.array([1.0, -self.toughness / stress])
        return float(np.sqrt(gradient @ self.covariance @ gradient))

    def scene(self, wire_radius: ArrayLike) -> Scene:
        """Return the scene of the identified material and a wire of any radius [m].

        Raises
        ------
        InputError
            If an estimate is negative.
        """
        return Scene(
            shear_modulus=self.shear_modulus,
            toughness=self.toughness,
            wire_radius=wire_radius,
            friction_coefficient=self.friction_coefficient,
            wear_strength=self.wear_strength,
            stiffening_exponent=self.stiffening_exponent,
        )

    def predict(self, wire_radius: ArrayLike) -> Array:
        """Return the fitted F_ss/T [N/m] for wires of any radius [m], 0 included.

        Raises
        ------
        InputError
            If a radius is negative or not a number.
        """
        columns, offset = self._linear_form(wire_radius)
        return np.asarray(offset + columns @ np.array([self.toughness, self.wear_strength]))

    def predict_std(self, wire_radius: ArrayLike) -> Array:
        """Return the standard error of the fitted F_ss/T [N/m] for wires of any radius [m]."""
        columns, _ = self._linear_form(wire_radius)
        variance = np.einsum("...i,ij,...j", columns, self.covariance, columns)
        return np.asarray(np.sqrt(np.maximum(variance, 0.0)))

    def band(self, wire_radius: ArrayLike) -> tuple[Array, Array]:
        """Return the confidence band of the fitted line [N/m] at any radius [m]."""
        half_width = self._quantile * self.predict_std(wire_radius)
        line = self.predict(wire_radius)
        return line - half_width, line + half_width

    @property
    def _quantile(self) -> float:
        if self.force_std is not None:
            return normal_quantile(self.confidence)
        return student_quantile(self.confidence, self.dof) if self.dof > 0 else np.nan

    def _interval(self, estimate: float, std: float) -> tuple[float, float]:
        half_width = self._quantile * std
        return estimate - half_width, estimate + half_width

    def _linear_form(self, wire_radius: ArrayLike) -> tuple[Array, Array]:
        return linear_form(
            self.model,
            np.asarray(PREDICTED_RADIUS.checked(wire_radius)),
            self.shear_modulus,
            self.friction_coefficient,
            self.stiffening_exponent,
        )


def identify(
    wire_radius: ArrayLike | None,
    force: ArrayLike,
    shear_modulus: float,
    *,
    friction_coefficient: float = 0.0,
    stiffening_exponent: float = 2.0,
    force_std: ArrayLike | None = None,
    wire_diameter: ArrayLike | None = None,
    model: str = "eq13",
    confidence: float = 0.95,
) -> Identification:
    """Identify cleavage toughness and wear strength from steady wire-cutting forces.

    With A and B of the force model at g = Gamma_o/(mu R_w),

        F_ss/T = Gamma_o + 2 R_w (tau_w A + xi mu B),

    which is linear in Gamma_o and tau_w for the paper's closed forms: for Eq. (13),
    F_ss/T - 4 xi mu R_w = (1 + xi) Gamma_o + 4 R_w tau_w. The two are found by weighted linear
    least squares.

    The friction coefficient CANNOT be identified: in Eq. (13) it only multiplies terms that
    Gamma_o and tau_w already have, so that any xi fits equally well. It has to be given.

    Parameters
    ----------
    wire_radius : array_like, shape (n,), or None
        R_w [m], n of 2 or more; None where `wire_diameter` is given.
    force : array_like, shape (n,)
        Steady-state cutting force per thickness F_ss/T [N/m].
    shear_modulus : float
        mu [Pa]; needed for g and, with friction, for the stiffness term.
    friction_coefficient : float, default 0
        xi [-].
    stiffening_exponent : float, default 2
        alpha of the Ogden solid, Eq. (1) [-].
    force_std : array_like, shape (n,) or scalar, optional
        Standard error of each force [N/m]: for a mean of m cuts that scatter by s,
        s/sqrt(m). Given, it is taken as known: it weights the fit, intervals use normal
        quantiles and the covariance is NOT rescaled by chi^2/dof, which is reported instead.
        Not given, every force weighs the same, the residuals' variance sets the scale and
        intervals use Student's t.
    wire_diameter : array_like, shape (n,), optional
        2 R_w [m], instead of `wire_radius`.
    model : str, default "eq13"
        A force model that is linear in both unknowns: "eq13", "low-toughness" (Eq. 12) or
        "friction-free" (Eq. 15).
    confidence : float, default 0.95
        Probability that each interval states, of each estimate by itself [-].

    Returns
    -------
    Identification
        Estimates with their uncertainty, derived lengths and warnings in words.

    Raises
    ------
    InputError
        If radius and diameter are both given or both missing; if a number is not positive and
        finite; if the lengths of the arrays differ; if there are fewer than two different radii;
        or if the model is not linear in both unknowns.

    Notes
    -----
    Range of validity: that of the force model. Eq. (13) takes its wear term from Eq. (11), which
    the paper found for g <= 1; beyond it a warning is given. A negative estimate is reported as it
    is.

    References
    ----------
    arXiv:2412.02021, Eqs. (10) to (15).

    Examples
    --------
    >>> fit = identify([1e-4, 2e-4, 4e-4, 5e-4], [4.7, 7.9, 13.9, 17.2], shear_modulus=685.0)
    >>> print(f"{fit.toughness:.4f} +- {fit.toughness_std:.4f} J/m2")
    1.6250 +- 0.1257 J/m2
    >>> print(f"{fit.wear_strength:.1f} +- {fit.wear_strength_std:.1f} Pa")
    7750.0 +- 92.7 Pa
    >>> print(f"{fit.wear_transition_radius:.4e} m")
    5.2419e-05 m
    """
    radius = _radius(wire_radius, wire_diameter)
    forces = column(FORCE, force)
    std = None if force_std is None else column(FORCE_STD, force_std)
    if std is not None and std.size == 1:
        std = np.full(forces.shape, std[0])
    _check_shapes(radius, forces, std)
    modulus = one_number(SHEAR_MODULUS, shear_modulus)
    friction = one_number(FRICTION_COEFFICIENT, friction_coefficient)
    exponent = one_number(validation.STIFFENING_EXPONENT, stiffening_exponent)
    columns, offset = linear_form(model, radius, modulus, friction, exponent)

    weight = np.ones_like(forces) if std is None else 1.0 / std
    fit = solve_least_squares(columns * weight[:, np.newaxis], (forces - offset) * weight)
    if not np.isfinite(fit.condition):
        raise InputError(
            f"the radii differ by rounding only ({radius.min():.17g} to {radius.max():.17g} m): "
            "toughness and wear cannot be told apart; cut with at least two different wires."
        )
    residuals = forces - offset - columns @ fit.estimate
    residual_sum = _square_sum(residuals * weight)
    dof = forces.size - 2
    variance = residual_sum / dof if dof else np.nan
    mean = np.average(forces, weights=weight**2)
    total_sum = _square_sum((forces - mean) * weight)
    return Identification(
        toughness=float(fit.estimate[0]),
        wear_strength=float(fit.estimate[1]),
        covariance=fit.covariance * (variance if std is None else 1.0),
        correlation=float(fit.covariance[0, 1] / np.sqrt(np.prod(np.diag(fit.covariance)))),
        residuals=residuals,
        r_squared=1.0 - residual_sum / total_sum if total_sum > 0.0 else np.nan,
        reduced_chi_squared=None if std is None else variance,
        condition=fit.condition,
        leverage=fit.leverage,
        wire_radius=radius,
        force=forces,
        force_std=std,
        shear_modulus=modulus,
        friction_coefficient=friction,
        stiffening_exponent=exponent,
        model=model,
        confidence=one_number(CONFIDENCE, confidence),
    )


def column(quantity: Quantity, values: ArrayLike) -> Array:
    """Return validated numbers as a read-only array of one axis, one number a cut."""
    numbers = np.array(quantity.checked(values), ndmin=1)  # a copy: the caller's may change
    if numbers.ndim > 1:
        raise InputError(
            f"{quantity.name} must be a list of numbers, but has the shape {numbers.shape}; "
            "give one number a cut."
        )
    numbers.flags.writeable = False
    return numbers


def _radius(wire_radius: ArrayLike | None, wire_diameter: ArrayLike | None) -> Array:
    if wire_radius is not None and wire_diameter is None:
        return column(WIRE_RADIUS, wire_radius)
    if wire_diameter is not None and wire_radius is None:
        return column(WIRE_DIAMETER, wire_diameter) / 2.0
    state = "neither is given" if wire_radius is None else "both are given"
    raise InputError(
        f"wire_radius or wire_diameter is needed, but {state}; give exactly one, and None for "
        "wire_radius where the diameter is given."
    )


def _check_shapes(radius: Array, force: Array, std: Array | None) -> None:
    sizes = {"radii": radius.size, "forces": force.size}
    if std is not None:
        sizes["standard errors"] = std.size
    if len(set(sizes.values())) > 1:
        listed = ", ".join(f"{size} {name}" for name, size in sizes.items())
        raise InputError(f"there are {listed}; give one of each a cut.")
    if radius.size == 0:
        raise InputError("there are no measurements; give one radius and one force a cut.")
    if np.unique(radius).size < 2:
        raise InputError(
            f"one wire, of radius {radius[0]:.4g} m, cannot tell toughness from wear; "
            "cut with at least two different wires, better three."
        )


def linear_form(
    model: str, radius: Array, shear_modulus: float, friction: float, exponent: float
) -> tuple[Array, Array]:
    """Return columns and offset with F_ss/T = offset + columns @ (toughness, wear_strength).

    Such a form exists where A does not depend on g and B is a straight line in it.
    """
    forms = force_model(model)
    arcs, loads = (
        [function(g, exponent) for g in (0.0, 1.0, 2.0)]
        for function in (forms.arc, forms.normal_load)
    )
    if not (arcs[0] == arcs[1] == arcs[2] > 0.0 and loads[2] - loads[1] == loads[1] - loads[0]):
        raise InputError(
            f"model {model!r} is not linear in both toughness and wear strength, so that it "
            "cannot be fitted here; choose 'eq13', 'low-toughness' or 'friction-free'."
        )
    slope = loads[1] - loads[0]
    columns = np.empty((*radius.shape, 2))
    columns[..., 0] = 1.0 + 2.0 * friction * slope
    columns[..., 1] = 2.0 * radius * arcs[0]
    return columns, 2.0 * friction * shear_modulus * radius * loads[0]


def _square_sum(values: Array) -> float:
    return float(values @ values)

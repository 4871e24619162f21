"""What the forces of several wires say about a material, in numbers."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from surrogate.basics.checks import LARGEST, Quantity
from surrogate.choosing.by_name import force_model
from surrogate.contact.base import ForceModel
from surrogate.coupling.frozen import frozen
from surrogate.coupling.model import CoupledModel
from surrogate.cutting.transition_radius import (
    transition_radius_of,
    wear_transition_radius_of,
)
from surrogate.errors import DomainError
from surrogate.identification.further_wire import FurtherWire, forces_of
from surrogate.inference.continuation import is_continued
from surrogate.inference.inputs import (
    NOTHING_KNOWN,
    PREDICTED_RADIUS,
    Array,
    Cuts,
    Known,
)
from surrogate.inference.line_fit import linear_form
from surrogate.inference.misfit import Misfit
from surrogate.inference.profile import Interval, Profile
from surrogate.inference.quantiles import normal_quantile, student_quantile
from surrogate.inference.scatter import Scatter
from surrogate.scene import Scene

__all__ = ["OPEN_ENDS", "Estimate"]

OPEN_ENDS = ("model", "search")
"""What ends a search but says nothing about the material."""

EXACT = 1e-5
"""Of the forces; where forces share errors, what is met better is searched no further."""

_ROUNDING = 64.0 * np.finfo(float).eps

_BY_FORCES, _UNKNOWN_ENDS = ("forces", "forces"), ("unknown", "unknown")


@dataclass(frozen=True, eq=False)
class Estimate:
    """The numbers of an identification; its subclass `Identification` documents the fields."""

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
    model: str | ForceModel
    confidence: float
    known: Known = NOTHING_KNOWN
    profile: Profile | None = None
    further_wire: FurtherWire | None = None
    model_error: tuple[float, float] | None = None
    contributions: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    scale: float | None = None
    friction_sensitivity: tuple[float, float] = (np.nan, np.nan)
    shear_modulus_std: float = 0.0
    friction_std: float = 0.0
    stiffening_std: float = 0.0
    sample: NDArray[np.int64] | None = None
    scatter: Scatter | None = None
    assumed: tuple[str, ...] = ()
    law_reason: str = ""
    law_error: float = np.nan

    @property
    def cuts(self) -> Cuts:
        """The measurements and what was given of the material."""
        return Cuts(
            self.wire_radius,
            self.force,
            self.force_std,
            self.shear_modulus,
            self.friction_coefficient,
            self.stiffening_exponent,
            self.shear_modulus_std,
            self.friction_std,
            self.stiffening_std,
            self.sample,
            0.0 if self.scatter is None else self.scatter.sample_ratio,
            None if self.scatter is None else self.scatter.weights,
        )

    @property
    def law(self) -> str:
        """The law of dissipation that the estimates belong to."""
        return force_model(self.model).law

    @property
    def misfit(self) -> Misfit:
        """The misfit that was searched."""
        return Misfit(self.tangent, self.cuts, self.known, self.scale)

    @property
    def tangent(self) -> ForceModel:
        """The model, and of the law "coupled" its tangent in tau_w at the estimate."""
        model = force_model(self.model)
        if not isinstance(model, CoupledModel):
            return model
        return frozen(model, self.friction_coefficient, self.wear_strength / self.shear_modulus)

    @property
    def dof(self) -> int:
        """Degrees of freedom: measurements and other facts less the two unknowns."""
        return self.force.size + self.known.facts - 2

    @property
    def is_exact(self) -> bool:
        """Whether more forces than needed are met but for rounding, as no measured ones are."""
        least = _ROUNDING if self.scale is None or self.force_std is not None else EXACT
        largest = float(np.max(np.abs(self.residuals)))
        return self.dof > 0 and largest <= least * float(np.max(self.force))

    @property
    def has_scatter(self) -> bool:
        """Whether something tells the forces' scatter, without which no interval means anything."""
        return self.force_std is not None or (self.dof > 0 and not self.is_exact)

    @property
    def toughness_std(self) -> float:
        """Standard error of the toughness [J/m2]; nan where a limit holds the estimate."""
        return float(np.sqrt(self.covariance[0, 0]))

    @property
    def wear_strength_std(self) -> float:
        """Standard error of the wear strength [Pa]."""
        return float(np.sqrt(self.covariance[1, 1]))

    @property
    def toughness_interval(self) -> tuple[float, float]:
        """Confidence interval of the toughness [J/m2]; around all pieces that `profile` has.

        0 below or infinite above where `toughness_limited_by` says that no force ends it there.
        """
        if self.profile is not None:
            low, high = _hull(self.profile.toughness_intervals)
            below, above = self.toughness_limited_by
            return (
                0.0 if below in OPEN_ENDS else low,
                np.inf if above in OPEN_ENDS else high,
            )
        return self._interval(0)

    @property
    def wear_strength_interval(self) -> tuple[float, float]:
        """Confidence interval of the wear strength [Pa]; around all pieces that `profile` has."""
        if self.profile is not None:
            low, high = _hull(self.profile.wear_strength_intervals)
            below, above = self.wear_strength_limited_by
            return (
                0.0 if below in OPEN_ENDS else low,
                np.inf if above in OPEN_ENDS else high,
            )
        return self._interval(1)

    @property
    def toughness_limited_by(self) -> tuple[str, str]:
        """What ends the toughness's interval below and above.

        "forces", or what stands in for them: "zero", "model" (the end of its range), "bound" or
        "search"; "unknown" where the scatter is.
        """
        profile = self.profile
        if profile is None:
            return _UNKNOWN_ENDS if np.isnan(self.toughness_std) else _BY_FORCES
        if not profile.toughness_intervals:
            return _UNKNOWN_ENDS
        return profile.limits_of(*_hull(profile.toughness_intervals))

    @property
    def wear_strength_limited_by(self) -> tuple[str, str]:
        """What ends the wear strength's interval below and above; see `toughness_limited_by`.

        "given" where tau_w was; what ends the toughness's interval where the end of tau_w lies
        there; "none" above where any tau_w fits.
        """
        profile = self.profile
        if self.known.wear_strength is not None:
            return "given", "given"
        if profile is None or not profile.wear_strength_intervals:
            return _UNKNOWN_ENDS if np.isnan(self.wear_strength_std) else _BY_FORCES
        low, high = _hull(profile.wear_strength_intervals)
        below = "zero" if low == 0.0 else self._end_in_toughness(low, 1)
        return below, "none" if np.isinf(high) else self._end_in_toughness(high, 2)

    def _end_in_toughness(self, end: float, row: int) -> str:
        """Return what limits the toughness where the wear strength has its end."""
        assert self.profile is not None
        gamma, limits = self.profile.admitted[0], self.toughness_limited_by
        values = self.profile.admitted[row]
        place = int(np.argmin(values) if row == 1 else np.argmax(values))
        if place == 0 and gamma[0] > 0.0:
            return limits[0]
        return limits[1] if place == gamma.size - 1 else "forces"

    @property
    def at_limit(self) -> bool:
        """Whether an end of the model, a bound, the search or 0 holds the estimate."""
        if self.profile is None:
            return False
        free_wear = self.known.wear_strength is None
        return (
            self.profile.modes[0].at_end
            or self.toughness == 0.0
            or (free_wear and self.wear_strength == 0.0)
        )

    @property
    def dimensionless_toughness(self) -> Array:
        """g = Gamma_o/(mu R_w) of each wire [-], shape (n,); nan where mu is not known."""
        if "shear_modulus" in self.assumed:
            return np.full_like(self.wire_radius, np.nan)
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
        return float(wear_transition_radius_of(self.scene(1.0))) if self.is_physical else np.nan

    @property
    def transition_radius(self) -> float:
        """Radius at which the two terms of Eq. (13) are equal [m]; nan if one is negative."""
        return float(transition_radius_of(self.scene(1.0), "eq13")) if self.is_physical else np.nan

    @property
    def model_transition_radius(self) -> float:
        """Radius at which both parts of the model's force are equal [m]; nan beyond the model."""
        with suppress(DomainError):
            if self.is_physical:
                return float(transition_radius_of(self.scene(1.0), self.model))
        return np.nan

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
        with np.errstate(over="ignore", invalid="ignore"):  # of a subnormal stress it is nan
            gradient = (factor / stress) * np.array([1.0, -self.toughness / stress])
            return float(np.sqrt(gradient @ self.covariance @ gradient))

    def scene(self, wire_radius: ArrayLike) -> Scene:
        """Return the scene of the identified material and a wire of any radius [m].

        It knows the law that it was identified under: a force of it is by that law, and by another
        only with a warning.

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
            law=self.law,
        )

    def predict(self, wire_radius: ArrayLike) -> Array:
        """Return the fitted F_ss/T [N/m] for wires of any radius [m], 0 included.

        Raises
        ------
        InputError
            If a radius is negative or not a number.
        DomainError
            If the model does not reach to g = Gamma_o/(mu R_w) of a wire; a fitted model is
            continued by its asymptotes.
        """
        if self.profile is not None:
            radius = np.asarray(PREDICTED_RADIUS.checked(wire_radius))
            at = np.array([self.toughness]), np.array([self.wear_strength])
            return np.asarray(self._forces(*at, radius)[0].reshape(radius.shape))
        columns, offset = self._linear_form(wire_radius)
        return np.asarray(offset + columns @ np.array([self.toughness, self.wear_strength]))

    def predict_std(self, wire_radius: ArrayLike) -> Array:
        """Return the standard error of the fitted F_ss/T [N/m] for wires of any radius [m]."""
        columns = self.force_slopes(wire_radius)
        variance = np.einsum("...i,ij,...j", columns, self.covariance, columns)
        return np.asarray(np.sqrt(np.maximum(variance, 0.0)))

    def band(self, wire_radius: ArrayLike) -> tuple[Array, Array]:
        """Return the confidence band of the fitted force [N/m] at any radius [m].

        With `profile`, from the smallest to the largest force of any material that it admits.
        """
        if self.profile is not None:
            radius = np.asarray(PREDICTED_RADIUS.checked(wire_radius))
            if not self.profile.admitted.size:
                return np.full(radius.shape, np.nan), np.full(radius.shape, np.nan)
            gamma, low, high = self.profile.admitted
            return (
                self._forces(gamma, low, radius).min(axis=0).reshape(radius.shape),
                self._forces(gamma, high, radius).max(axis=0).reshape(radius.shape),
            )
        half_width = self._quantile * self.predict_std(wire_radius)
        line = self.predict(wire_radius)
        return line - half_width, line + half_width

    def _forces(self, toughness: Array, wear_strength: Array, radius: Array) -> Array:
        model = force_model(self.model)
        if not is_continued(model) and (model.g.lower > 0.0 or model.g.upper < LARGEST):
            self._radii_of(model.g, toughness).checked(radius)
        return forces_of(model, self.cuts, toughness, wear_strength, radius.reshape(-1))

    def _radii_of(self, g: Quantity, toughness: Array) -> Quantity:
        """Return the radii for which g of all toughnesses is within a range, but for rounding."""
        rounding = 1e-12
        with np.errstate(all="ignore"):
            thinnest, thickest = (
                float(gamma / (self.shear_modulus * limit))
                for gamma, limit in ((toughness.max(), g.upper), (toughness.min(), g.lower))
            )
        return replace(
            PREDICTED_RADIUS,
            lower=max(PREDICTED_RADIUS.lower, (1.0 - rounding) * thinnest),
            upper=min(PREDICTED_RADIUS.upper, (1.0 + rounding) * thickest),
            error=DomainError,
            remedy=f"model {self.model!r} reaches no further, from g = {g.lower:.4g} to "
            f"{g.upper:.4g}: give radii between, or identify with model='eq13'",
        )

    def force_slopes(self, wire_radius: ArrayLike) -> Array:
        """Return the derivatives of the force by toughness [-] and wear strength [m], last axis 2.

        Raises
        ------
        InputError
            If a radius is negative or not a number.
        """
        if self.profile is None:
            return self._linear_form(wire_radius)[0]
        radius = np.asarray(PREDICTED_RADIUS.checked(wire_radius))
        at = self.shear_modulus, self.toughness, radius, self.friction_coefficient
        with np.errstate(all="ignore"):
            slopes = force_model(self.model).gradient(
                *at, self.wear_strength, self.stiffening_exponent
            )
        both = [np.broadcast_to(slopes[i], radius.shape) for i in (1, 4)]
        return np.asarray(np.stack(both, axis=-1))

    @property
    def _quantile(self) -> float:
        if self.force_std is not None:
            return normal_quantile(self.confidence)
        return student_quantile(self.confidence, self.dof) if self.dof > 0 else np.nan

    def _interval(self, which: int) -> tuple[float, float]:
        """Return the interval of a line: Student's for the scatter, normal for what is stated."""
        estimate = (self.toughness, self.wear_strength)[which]
        half_width = self._half_width(
            {name: part[which] for name, part in self.contributions.items()}
        )
        return estimate - half_width, estimate + half_width

    def _half_width(self, parts: Mapping[str, float]) -> float:
        squares = {name: std**2 for name, std in parts.items()}
        scatter = squares.pop("scatter", np.nan)
        stated = normal_quantile(self.confidence) ** 2 * sum(squares.values())
        return float(np.sqrt(self._quantile**2 * scatter + stated))

    def _linear_form(self, wire_radius: ArrayLike) -> tuple[Array, Array]:
        radius = np.asarray(PREDICTED_RADIUS.checked(wire_radius))
        return linear_form(self.model, radius, self.shear_modulus, self.friction_coefficient)


def _hull(intervals: tuple[Interval, ...]) -> tuple[float, float]:
    """Return the smallest and the largest of all ends; nan where there are none."""
    ends = [end for interval in intervals for end in interval]
    return min(ends, default=np.nan), max(ends, default=np.nan)

"""The misfit of forces under any force model, with the best wear strength for each toughness.

    F_ss/T = Gamma_o + 2 R_w [tau_w A(g) + xi mu B(g)],   g = Gamma_o/(mu R_w),

is linear in tau_w >= 0 once Gamma_o is given, so that a search along Gamma_o alone finds all.

What else is uncertain moves several forces together: the model's A and B, mu, xi, alpha. Each is
one more unknown with a prior, linearised about what is given, and is profiled out: the misfit is
r' C^-1 r with C the covariance of the forces from all of it. The part of C that grows with tau_w is
taken at the wear strength that fits best without it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from surrogate.contact.base import ForceModel
from surrogate.coupling.frozen import FrozenLoad
from surrogate.inference.continuation import contact_error, correlation, is_continued
from surrogate.inference.inputs import Cuts, Known

__all__ = ["SOURCES", "Misfit", "Profiled"]

Array = NDArray[np.float64]

SOURCES = ("model", "shear_modulus", "friction_coefficient", "stiffening_exponent", "sample")
"""What the forces share besides their own scatter."""


@dataclass(frozen=True, eq=False)
class Profiled:
    """The best wear strength at each of several toughnesses.

    Parameters
    ----------
    wear_strength, misfit : ndarray, shape (m,)
        tau_w of 0 or more, or as known [Pa], and the misfit with it.
    free_wear_strength, free_misfit : ndarray, shape (m,)
        The same without the limit at 0.
    curvature : ndarray, shape (m,)
        Growth of the misfit over the square of a step in tau_w from the free one; infinite
        where tau_w is known.
    residuals : ndarray, shape (m, n)
        Measured less predicted force of each cut [N/m].
    """

    wear_strength: Array
    misfit: Array
    free_wear_strength: Array
    free_misfit: Array
    curvature: Array
    residuals: Array

    def wear_strength_range(self, threshold: float) -> tuple[Array, Array]:
        """Return the smallest and the largest tau_w of a misfit up to the threshold."""
        with np.errstate(all="ignore"):
            room = np.maximum(threshold - self.free_misfit, 0.0) / self.curvature
            half = np.where(self.curvature > 0.0, np.sqrt(room), np.inf)
        low = np.maximum(self.free_wear_strength - half, 0.0)
        return low, self.free_wear_strength + half


@dataclass(frozen=True, eq=False)
class Misfit:
    """Sum of squared residuals, in units of their standard errors where these are known.

    Parameters
    ----------
    model : ForceModel
        A and B.
    cuts : Cuts
        The forces.
    known : Known
        Facts besides them; priors add their own squares.
    scale : float or None
        What makes `cuts.weight` the inverse of a standard error: that of a force of weight 1 [N/m];
        None leaves out all that the forces share but for samples.
    """

    model: ForceModel
    cuts: Cuts
    known: Known
    scale: float | None = None

    @cached_property
    def _radii(self) -> tuple[Array, NDArray[np.intp]]:
        radii, places = np.unique(self.cuts.wire_radius, return_inverse=True)
        return radii, places.reshape(-1)

    @cached_property
    def shares_errors(self) -> bool:
        """Whether something besides the scatter of each force is uncertain."""
        return any(True for _ in self.shared(np.ones(1), np.ones(1)))

    @cached_property
    def _root(self) -> Array:
        """A square root of the correlation of the model's errors over the different wires."""
        radii = self._radii[0]
        return np.asarray(np.linalg.cholesky(correlation(radii) + 1e-12 * np.eye(radii.size)))

    def at(self, toughness: Array) -> Profiled:
        """Return the best wear strengths at toughnesses [J/m2] of shape (m,)."""
        base, arc = self._parts(toughness)
        target = self.cuts.force - base
        weighted = self._weighted(toughness, target, base, arc)
        return self._best(toughness, target, arc, *weighted)

    def _best(
        self, toughness: Array, target: Array, arc: Array, of_target: Array, of_arc: Array
    ) -> Profiled:
        """Return the best tau_w from forces to meet, arcs, and C^-1 times either."""
        if self.known.wear_strength is not None:
            wear = np.full(toughness.shape, self.known.wear_strength)
            tau = wear[:, np.newaxis]
            residuals = target - tau * arc
            misfit = self._sum(residuals, of_target - tau * of_arc, toughness, wear)
            return Profiled(wear, misfit, wear, misfit, np.full_like(wear, np.inf), residuals)
        curvature, moment = (arc * of_arc).sum(axis=1), (arc * of_target).sum(axis=1)
        if self.known.wear_strength_prior is not None:
            mean, std = self.known.wear_strength_prior
            curvature, moment = curvature + std**-2, moment + mean * std**-2
        free = np.divide(moment, curvature, out=np.zeros_like(moment), where=curvature > 0.0)
        wear = np.maximum(free, 0.0)
        tau, free_tau = wear[:, np.newaxis], free[:, np.newaxis]
        residuals = target - tau * arc
        return Profiled(
            wear,
            self._sum(residuals, of_target - tau * of_arc, toughness, wear),
            free,
            self._sum(target - free_tau * arc, of_target - free_tau * of_arc, toughness, free),
            curvature,
            residuals,
        )

    def _weighted(
        self, toughness: Array, target: Array, base: Array, arc: Array
    ) -> tuple[Array, Array]:
        """Return C^-1 times the forces to meet and times the arcs, each of shape (m, n)."""
        weight = self.cuts.weight**2
        of_target, of_arc = weight * target, weight * arc
        if self.scale is None and not self.cuts.sample_ratio:
            return of_target, of_arc
        wear = self._best(toughness, target, arc, of_target, of_arc).wear_strength
        factors = [factor for _, factor in self._shared(toughness, wear, base, arc)]
        if not factors:
            return of_target, of_arc
        # Woodbury: C^-1 = W - W K (1 + K' W K)^-1 K' W, with K in units of the scale
        shared = np.concatenate(factors, axis=2) / (self.scale or 1.0)
        heavy = weight[:, np.newaxis] * shared
        inner = np.eye(shared.shape[2]) + np.swapaxes(shared, 1, 2) @ heavy
        both = np.stack([target, arc], axis=2)
        try:
            absorbed = np.linalg.solve(inner, np.swapaxes(heavy, 1, 2) @ both)
        except np.linalg.LinAlgError:
            return of_target, of_arc
        less = heavy @ absorbed
        return of_target - less[:, :, 0], of_arc - less[:, :, 1]

    def shared(self, toughness: Array, wear_strength: Array) -> Iterator[tuple[str, Array]]:
        """Yield what moves forces together: a source, and by how much in standard deviations.

        Each of shape (m, n, k) [N/m], for k independent errors of unit variance.
        """
        yield from self._shared(toughness, wear_strength, *self._parts(toughness))

    def _shared(
        self, toughness: Array, wear_strength: Array, base: Array, arc: Array
    ) -> Iterator[tuple[str, Array]]:
        yield from self._of_samples(toughness)
        if self.scale is None:
            return
        cuts, wear = self.cuts, wear_strength[:, np.newaxis]
        yield from self._of_model(toughness, wear * arc, base - toughness[:, np.newaxis])
        for name, std in (
            ("shear_modulus", cuts.shear_modulus_std),
            ("stiffening_exponent", cuts.stiffening_std),
        ):
            if std > 0.0:
                yield name, self._secant(toughness, wear, name, std)
        if cuts.friction_std > 0.0:
            slopes = self.friction_slopes(toughness)
            yield "friction_coefficient", (cuts.friction_std * slopes)[:, :, np.newaxis]

    def _secant(self, toughness: Array, wear: Array, name: str, std: float) -> Array:
        """Return half the change of the forces over two standard errors of mu or alpha."""
        value = getattr(self.cuts, name)
        up, down = (self._with(name, value * np.exp(step)) for step in (std / value, -std / value))
        (base, arc), (less_base, less_arc) = up._parts(toughness), down._parts(toughness)
        return np.asarray(0.5 * (base - less_base + wear * (arc - less_arc))[:, :, np.newaxis])

    def _with(self, name: str, value: float) -> Misfit:
        """Return the misfit with another mu or alpha; tau_w of a coupled law's kappa stays."""
        model = self.model
        if isinstance(model, FrozenLoad) and name == "shear_modulus":
            relative = model.relative_wear * (self.cuts.shear_modulus / value)
            model = replace(model, relative_wear=relative)
        another: dict[str, Any] = {name: value}
        return replace(self, model=model, cuts=replace(self.cuts, **another))

    def _of_samples(self, toughness: Array) -> Iterator[tuple[str, Array]]:
        cuts = self.cuts
        if cuts.sample is not None and cuts.sample_ratio > 0.0:
            same = cuts.sample[:, np.newaxis] == np.unique(cuts.sample)
            weight = cuts.weight[:, np.newaxis]
            unit = np.divide(1.0, weight, out=np.zeros_like(weight), where=weight > 0.0)
            factor = cuts.sample_ratio * (self.scale or 1.0) * np.where(same, unit, 0.0)
            yield "sample", np.broadcast_to(factor, (toughness.size, *factor.shape))

    def _of_model(
        self, toughness: Array, worn: Array, friction: Array
    ) -> Iterator[tuple[str, Array]]:
        """Yield the model's own errors, in proportion to what wear and friction add to a force."""
        error = contact_error(self.model, self._g(toughness), self.cuts.stiffening_exponent)
        if error is None or not (self.known.wear_strength != 0.0 or np.any(friction)):
            return
        root = self._root[self._radii[1]]
        parts = [(worn, error.arc, error.arc_drift)]
        if self.cuts.friction_coefficient:
            parts.append((friction, error.load, error.load_drift))
        for part, near, drift in parts:
            yield "model", (part * self._per_cut(near))[:, :, np.newaxis] * root
            for beyond in (error.below, error.above):
                if np.any(beyond):
                    drifts = part * self._per_cut(np.where(beyond, drift, 0.0))
                    yield "model", drifts[:, :, np.newaxis]
        if error.factor is not None and error.factor_drift is not None:
            both = worn + friction
            yield "model", (both * self._per_cut(error.factor))[:, :, np.newaxis] * root
            yield "model", (both * self._per_cut(error.factor_drift))[:, :, np.newaxis]

    def slope(self, toughness: Array) -> Array:
        """Return the derivative of the misfit by the toughness, with the best wear strength.

        That the wear strength changes along adds nothing: the misfit is stationary in it. Where
        errors are shared their covariance changes along as well, and differences are taken.
        """
        if self.shares_errors:
            step = 1e-6
            up, down = self.at(toughness * (1.0 + step)), self.at(toughness * (1.0 - step))
            return np.asarray((up.misfit - down.misfit) / (2.0 * step * toughness))
        best = self.at(toughness)
        in_toughness = self.force_slopes(toughness, best.wear_strength)
        slope = -2.0 * (self.cuts.weight**2 * best.residuals * in_toughness).sum(axis=1)
        if self.known.toughness_prior is not None:
            mean, std = self.known.toughness_prior
            slope = slope + 2.0 * (toughness - mean) / std**2
        return np.asarray(slope)

    def force_slopes(self, toughness: Array, wear_strength: Array) -> Array:
        """Return dF/dGamma_o of each cut [-], shape (m, n)."""
        mu, xi, alpha = self._material
        slope = np.ones((toughness.size, self._radii[0].size))
        g = self._g(toughness)
        with np.errstate(all="ignore"):
            if np.any(wear_strength):
                relative = (wear_strength / mu)[:, np.newaxis]
                arc_slope = np.broadcast_to(self.model.arc_slopes(g, alpha)[0], g.shape)
                slope += 2.0 * np.where(relative == 0.0, 0.0, relative * arc_slope)
            if xi:
                slope += 2.0 * xi * self.model.normal_load_slopes(g, alpha)[0]
        return self._per_cut(slope)

    def friction_slopes(self, toughness: Array) -> Array:
        """Return dF/dxi = 2 R_w mu B of each cut [N/m], shape (m, n)."""
        g = self._g(toughness)
        if isinstance(self.model, FrozenLoad):
            with np.errstate(all="ignore"):
                slope = self.model.friction_slope(g, self.cuts.stiffening_exponent)
            load = self._per_cut(np.broadcast_to(slope, g.shape))
        else:
            load = self._per_cut(self._load(g))
        return np.asarray(2.0 * self.cuts.wire_radius * self.cuts.shear_modulus * load)

    def arcs(self, toughness: Array) -> Array:
        """Return dF/dtau_w = 2 R_w A of each cut [m], shape (m, n)."""
        return self._parts(toughness)[1]

    def bases(self, toughness: Array) -> Array:
        """Return the forces without wear, Gamma_o and friction [N/m], shape (m, n)."""
        return self._parts(toughness)[0]

    @property
    def is_continued(self) -> bool:
        """Whether wires beyond the model's range do not end the search."""
        return is_continued(self.model)

    @property
    def _material(self) -> tuple[float, float, float]:
        cuts = self.cuts
        return cuts.shear_modulus, cuts.friction_coefficient, cuts.stiffening_exponent

    def _g(self, toughness: Array) -> Array:
        return toughness[:, np.newaxis] / (self.cuts.shear_modulus * self._radii[0])

    def _per_cut(self, values: Array) -> Array:
        return values[:, self._radii[1]]

    def _load(self, g: Array) -> Array:
        load = self.model.normal_load(g, self.cuts.stiffening_exponent)
        return np.asarray(np.broadcast_to(load, g.shape))

    def _parts(self, toughness: Array) -> tuple[Array, Array]:
        """Return Gamma_o and friction, and 2 R_w A, of each cut; A and B only where needed."""
        mu, xi, alpha = self._material
        radii, _ = self._radii
        g = self._g(toughness)
        arc: Any = 0.0
        base = np.broadcast_to(toughness[:, np.newaxis], g.shape)
        if isinstance(self.model, FrozenLoad):
            with np.errstate(all="ignore"):
                slope, rubbed = self.model.linearised(g, alpha)
                base, arc = base + 2.0 * radii * mu * rubbed, 2.0 * radii * slope
            return self._per_cut(base), self._per_cut(np.broadcast_to(arc, g.shape))
        with np.errstate(all="ignore"):
            if self.known.wear_strength != 0.0:
                arc = 2.0 * radii * self.model.arc(g, alpha)
            if xi:
                base = base + 2.0 * radii * xi * mu * self._load(g)
        return self._per_cut(base), self._per_cut(np.broadcast_to(arc, g.shape))

    def _sum(self, residuals: Array, weighted: Array, toughness: Array, wear: Array) -> Array:
        total = (residuals * weighted).sum(axis=1)
        for prior, value in (
            (self.known.toughness_prior, toughness),
            (self.known.wear_strength_prior, wear),
        ):
            if prior is not None:
                total = total + ((value - prior[0]) / prior[1]) ** 2
        return np.asarray(np.maximum(total, 0.0))

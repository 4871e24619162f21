"""The misfit of forces under any force model, with the best wear strength for each toughness.

    F_ss/T = Gamma_o + 2 R_w [tau_w A(g) + xi mu B(g)],   g = Gamma_o/(mu R_w),

is linear in tau_w >= 0 once Gamma_o is given, so that a search along Gamma_o alone finds all.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from surrogate.contact.base import ForceModel
from surrogate.identification.inputs import Cuts, Known

__all__ = ["Misfit", "Profiled"]

Array = NDArray[np.float64]


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
    """

    model: ForceModel
    cuts: Cuts
    known: Known

    @cached_property
    def _radii(self) -> tuple[Array, NDArray[np.intp]]:
        radii, places = np.unique(self.cuts.wire_radius, return_inverse=True)
        return radii, places.reshape(-1)

    def at(self, toughness: Array) -> Profiled:
        """Return the best wear strengths at toughnesses [J/m2] of shape (m,)."""
        base, arc = self._parts(toughness)
        weight = self.cuts.weight**2
        target = self.cuts.force - base
        if self.known.wear_strength is not None:
            wear = np.full(toughness.shape, self.known.wear_strength)
            residuals = target - wear[:, np.newaxis] * arc
            misfit = self._sum(residuals, toughness, wear)
            return Profiled(wear, misfit, wear, misfit, np.full_like(wear, np.inf), residuals)
        curvature, moment = (weight * arc**2).sum(axis=1), (weight * arc * target).sum(axis=1)
        if self.known.wear_strength_prior is not None:
            mean, std = self.known.wear_strength_prior
            curvature, moment = curvature + std**-2, moment + mean * std**-2
        free = np.divide(moment, curvature, out=np.zeros_like(moment), where=curvature > 0.0)
        wear = np.maximum(free, 0.0)
        residuals = target - wear[:, np.newaxis] * arc
        return Profiled(
            wear,
            self._sum(residuals, toughness, wear),
            free,
            self._sum(target - free[:, np.newaxis] * arc, toughness, free),
            curvature,
            residuals,
        )

    def slope(self, toughness: Array) -> Array:
        """Return the derivative of the misfit by the toughness, with the best wear strength.

        That the wear strength changes along adds nothing: the misfit is stationary in it.
        """
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
        return slope[:, self._radii[1]]

    def arcs(self, toughness: Array) -> Array:
        """Return dF/dtau_w = 2 R_w A of each cut [m], shape (m, n)."""
        return self._parts(toughness)[1]

    @property
    def _material(self) -> tuple[float, float, float]:
        cuts = self.cuts
        return cuts.shear_modulus, cuts.friction_coefficient, cuts.stiffening_exponent

    def _g(self, toughness: Array) -> Array:
        return toughness[:, np.newaxis] / (self.cuts.shear_modulus * self._radii[0])

    def _parts(self, toughness: Array) -> tuple[Array, Array]:
        """Return Gamma_o and friction, and 2 R_w A, of each cut; A and B only where needed."""
        mu, xi, alpha = self._material
        radii, places = self._radii
        g = self._g(toughness)
        arc: Any = 0.0
        base = np.broadcast_to(toughness[:, np.newaxis], g.shape)
        with np.errstate(all="ignore"):
            if self.known.wear_strength != 0.0:
                arc = 2.0 * radii * self.model.arc(g, alpha)
            if xi:
                base = base + 2.0 * radii * xi * mu * self.model.normal_load(g, alpha)
        return base[:, places], np.broadcast_to(arc, g.shape)[:, places]

    def _sum(self, residuals: Array, toughness: Array, wear_strength: Array) -> Array:
        total = ((self.cuts.weight * residuals) ** 2).sum(axis=1)
        for prior, value in (
            (self.known.toughness_prior, toughness),
            (self.known.wear_strength_prior, wear_strength),
        ):
            if prior is not None:
                total = total + ((value - prior[0]) / prior[1]) ** 2
        return np.asarray(total)

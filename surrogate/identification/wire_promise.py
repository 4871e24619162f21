"""What a choice of wires promises of an identification, and the exchange that improves it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import permutations

import numpy as np
from numpy.typing import NDArray

from surrogate.choosing.by_name import force_model
from surrogate.contact.base import ForceModel
from surrogate.coupling.frozen import frozen
from surrogate.coupling.model import CoupledModel
from surrogate.identification.further_wire import forces_of
from surrogate.inference.inputs import NOTHING_KNOWN, Cuts
from surrogate.inference.misfit import Misfit

__all__ = [
    "FEWEST_WIRES",
    "Losses",
    "Materials",
    "covariance_of",
    "exchanged",
    "has_middle",
    "promised",
]

Array = NDArray[np.float64]

FEWEST_WIRES = 3
"""Different ones: two forces lie on every curve, only a third shows that it does not hold."""

MIDDLE = (0.25, 0.75)
"""Part of the span in ln R_w that holds one of the wires at least."""

WORTH_A_SIZE = 0.02
"""Of the loss, a logarithm of variance: for a standard error that is 1 % smaller nobody buys one
more size of wire."""

EXPERIMENTS = 1000
"""Made-up ones behind the promised standard errors, whose own are then 2 to 3 %."""

NODES_A_DECADE, DECADES, BEYOND = 40, 9.0, 1.5
"""Toughnesses at which a made-up experiment is fitted, below so many times the largest force."""

NEAR, NODES_NEAR = 5.0, 400
"""Standard errors about the expected toughness where they are closer, and how many there."""


@dataclass(frozen=True, eq=False)
class Materials:
    """What is expected: the first material, and others that may be true as well."""

    toughness: Array
    wear_strength: Array
    cuts: Cuts  # the properties of the solid; its wires play no part

    def forces(self, model: str | ForceModel, radius: Array) -> Array:
        """Return F_ss/T [N/m] of each material on each wire."""
        return forces_of(force_model(model), self.cuts, self.toughness, self.wear_strength, radius)

    def reached(self, model: str | ForceModel, radius: Array) -> NDArray[np.bool_]:
        """Return on which wires the law knows the force of the first material."""
        lawful, one, cuts = force_model(model), np.ones(radius.shape), self.cuts
        if not isinstance(lawful, CoupledModel):
            return np.ones(radius.shape, dtype=bool)
        solid = cuts.friction_coefficient, self.wear_strength[0], cuts.stiffening_exponent
        scene = cuts.shear_modulus * one, self.toughness[0] * one, radius, *solid
        return np.asarray(lawful.in_domain(*scene))

    def g(self, radius: Array) -> Array:
        """Return Gamma_o/(mu R_w) [-] of each material and wire."""
        return np.asarray(self.toughness[:, np.newaxis] / (self.cuts.shear_modulus * radius))


def covariance_of(
    materials: Materials,
    model: str | ForceModel,
    radii: Array,
    noise: tuple[float, float],
    which: int,
) -> Array:
    """Return the covariance of the estimates to first order, the model's own error included."""
    one = slice(which, which + 1)
    gamma, tau = materials.toughness[one], materials.wear_strength[one]
    misfit = _misfit(materials, model, radii, noise, which)
    total = np.diag(misfit.cuts.weight**-2.0)
    for _, factor in misfit.shared(gamma, tau):
        total = total + factor[0] @ factor[0].T
    slopes = np.stack([misfit.force_slopes(gamma, tau)[0], misfit.arcs(gamma)[0]], axis=1)
    scale = np.linalg.norm(slopes, axis=0)
    information = (slopes / scale).T @ np.linalg.solve(total, slopes / scale)
    if not np.linalg.cond(information) < 1e14:
        return np.full((2, 2), np.inf)
    return np.asarray(np.linalg.inv(information) / np.outer(scale, scale))


def _misfit(
    materials: Materials,
    model: str | ForceModel,
    radii: Array,
    noise: tuple[float, float],
    which: int,
) -> Misfit:
    """Return the misfit of the forces that a material is expected to give."""
    force = materials.forces(model, radii)[which]
    std = np.hypot(noise[0], noise[1] * force)
    solid = replace(
        materials.cuts, wire_radius=radii, force=force, force_std=std, weights=None, sample=None
    )
    lawful = force_model(model)
    if isinstance(lawful, CoupledModel):  # whose tangent in tau_w is what intervals are of
        relative = float(materials.wear_strength[which]) / solid.shear_modulus
        lawful = frozen(lawful, solid.friction_coefficient, relative)
    return Misfit(lawful, solid, NOTHING_KNOWN, 1.0)


@dataclass(frozen=True, eq=False)
class Losses:
    """What is made small by exchanging cuts among candidates."""

    materials: Materials
    model: str | ForceModel
    radius: Array
    noise: tuple[float, float]
    goal: str

    def of(self, picked: Sequence[int]) -> float:
        """Return the mean logarithm of the goal's variance over the materials."""
        radii = np.sort(self.radius[list(picked)])
        if not has_middle(radii):
            return np.inf
        losses = []
        for which in range(self.materials.toughness.size):
            covariance = covariance_of(self.materials, self.model, radii, self.noise, which)
            value = {
                "both": np.linalg.det(covariance / np.outer(*2 * [self._size(which)])),
                "toughness": covariance[0, 0],
                "wear_strength": covariance[1, 1],
            }[self.goal]
            losses.append(np.log(value) if value > 0.0 and np.isfinite(value) else np.inf)
        return float(np.mean(losses))

    def _size(self, which: int) -> Array:
        return np.array([self.materials.toughness[which], self.materials.wear_strength[which]])


def has_middle(radii: Array) -> bool:
    """Return whether a wire in the middle shows if the forces do not lie on the curve.

    Examples
    --------
    >>> has_middle(np.array([1e-4, 2e-4, 8e-4])), has_middle(np.array([1e-4, 8e-4]))
    (True, False)
    """
    if radii.size < FEWEST_WIRES:
        return False
    log_radius = np.log(radii)
    part = (log_radius - log_radius[0]) / max(log_radius[-1] - log_radius[0], 1e-300)
    return bool(np.any((part >= MIDDLE[0]) & (part <= MIDDLE[1])))


def exchanged(losses: Losses, count: int) -> list[int]:
    """Return candidates, one a cut: each is exchanged for the best other until none is better.

    Begins with cuts spread over all candidates.
    """
    size = losses.radius.size
    picked: list[int] = np.round(np.linspace(0, size - 1, count)).astype(int).tolist()
    best, improved = losses.of(picked), True
    while improved:
        improved = False
        for place in range(count):
            for other in range(size):
                trial = [*picked[:place], other, *picked[place + 1 :]]
                if (loss := losses.of(trial)) < best - 1e-9:
                    picked, best, improved = trial, loss, True
    return _with_fewer_sizes(losses, picked, best + WORTH_A_SIZE)


def _with_fewer_sizes(losses: Losses, picked: list[int], limit: float) -> list[int]:
    """Return the same with sizes replaced by others of them, as far as that costs little."""
    for size, other in permutations(sorted(set(picked)), 2):
        trial = [other if one == size else one for one in picked]
        if losses.of(trial) <= limit:
            return _with_fewer_sizes(losses, trial, limit)
    return picked


def promised(
    materials: Materials,
    model: str | ForceModel,
    radii: Array,
    noise: tuple[float, float],
    which: int,
) -> tuple[float, float]:
    """Return the standard deviations of the estimates of made-up experiments with one material.

    Fitted as `identify` does where errors are stated: the best wear strength of 0 or more at each
    toughness of a scan, with the model's errors as they are for the expected material.
    """
    std = float(np.sqrt(covariance_of(materials, model, radii, noise, which)[0, 0]))
    misfit, one = _misfit(materials, model, radii, noise, which), slice(which, which + 1)
    gamma, tau = materials.toughness[one], materials.wear_strength[one]
    total = np.diag(misfit.cuts.weight**-2.0)
    for _, factor in misfit.shared(gamma, tau):
        total = total + factor[0] @ factor[0].T
    root = np.linalg.cholesky(total)
    random = np.random.default_rng(0)
    forces = misfit.cuts.force + random.standard_normal((EXPERIMENTS, radii.size)) @ root.T
    scan = _scan(float(gamma[0]), std, BEYOND * float(misfit.cuts.force.max()))
    lowest = np.full(EXPERIMENTS, np.inf)
    estimates = np.empty((2, EXPERIMENTS))
    whitened = np.linalg.solve(root, forces.T)
    for node, base, arc in zip(
        scan,
        np.linalg.solve(root, (misfit.bases(scan)).T).T,
        np.linalg.solve(root, misfit.arcs(scan).T).T,
        strict=True,
    ):
        target = whitened - base[:, np.newaxis]
        wear = np.maximum(arc @ target / (arc @ arc), 0.0)
        height = ((target - np.outer(arc, wear)) ** 2).sum(axis=0)
        better = height < lowest
        lowest[better] = height[better]
        estimates[:, better] = np.stack([np.full(EXPERIMENTS, node), wear])[:, better]
    return float(estimates[0].std()), float(estimates[1].std())


def _scan(toughness: float, std: float, top: float) -> Array:
    """Return toughnesses: all that forces may admit, closer about the expected one."""
    far = np.geomspace(top * 10.0**-DECADES, top, int(NODES_A_DECADE * DECADES))
    low, high = max(toughness - NEAR * std, far[0]), min(toughness + NEAR * std, top)
    return np.unique(np.concatenate([far, np.linspace(low, high, NODES_NEAR)]))

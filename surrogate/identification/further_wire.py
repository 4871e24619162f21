"""Which further wire would tell most about what a series of cuts leaves open."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from surrogate.contact.base import ForceModel
from surrogate.inference.inputs import Cuts
from surrogate.inference.misfit import Misfit
from surrogate.inference.profile import Profile

__all__ = ["FurtherWire", "forces_of", "further_wire", "range_of_wires"]

Array = NDArray[np.float64]

BEYOND = 5.0
"""Factor by which a further wire may be thinner or thicker than those of the cuts."""

DIAMETERS = tuple(
    1e-3 * diameter
    for diameter in (
        *(0.02, 0.025, 0.03, 0.04, 0.05, 0.06, 0.07, 0.08, 0.09, 0.1, 0.11, 0.12, 0.14, 0.16, 0.18),
        *(0.2, 0.22, 0.25, 0.28, 0.3, 0.32, 0.36, 0.4, 0.45, 0.5, 0.56, 0.6, 0.65, 0.7, 0.75, 0.8),
        *(0.85, 0.9, 0.95, 1.0, 1.1, 1.2, 1.25, 1.3, 1.4, 1.5, 1.6, 1.7, 1.8, 1.9, 2.0),
    )
)
"""Diameters in which drawn steel wire is commonly sold [m]: thinner than 20 um it can hardly be
held, thicker than 2 mm it is no wire beside most samples."""

SOLD = (0.5 * DIAMETERS[0], 0.5 * DIAMETERS[-1])
"""Radii of the thinnest and of the thickest of them [m]."""

STEEL_STRENGTH = 2e9
"""Breaking stress of drawn steel wire [Pa]; EN 10270-1 has 1.8 to 3 GPa below 1 mm."""


@dataclass(frozen=True)
class FurtherWire:
    """The wire whose force differs most between materials that the cuts do not tell apart.

    Parameters
    ----------
    wire_radius : float
        R_w [m].
    forces : tuple of float
        Force on it with the lowest and with the highest toughness compared [N/m].
    toughnesses : tuple of float
        These toughnesses [J/m2].
    separation : float
        Difference of the forces over the standard error of one cut [-]; infinite where the
        forces of the cuts have no scatter.
    searched : tuple of float
        Smallest and largest radius that was considered [m].
    modes : bool
        Whether the materials compared are minima of the misfit, and not ends of an interval.
    """

    wire_radius: float
    forces: tuple[float, float]
    toughnesses: tuple[float, float]
    separation: float
    searched: tuple[float, float]
    modes: bool

    @property
    def breaking_force(self) -> float:
        """Force at which a steel wire of this radius breaks [N]."""
        return breaking_force(self.wire_radius)

    @property
    def cuts(self) -> float:
        """Cuts with it whose mean tells the two apart by two standard errors."""
        if self.separation < 1e-9:
            return np.inf
        return max(1.0, float(np.ceil((2.0 / self.separation) ** 2)))


def range_of_wires(cuts: Cuts) -> tuple[float, float]:
    """Return the radii [m] from a fifth of the thinnest to five times the thickest wire.

    As far as such wires are sold, from 20 um to 2 mm across, and as far as those of the cuts.

    Examples
    --------
    >>> wires = np.array([1e-4, 4e-4])
    >>> low, high = range_of_wires(Cuts(wires, wires, None, 1.0, 0.0, 2.0))
    >>> print(f"{low:.1e} {high:.1e}")
    2.0e-05 1.0e-03
    """
    thinnest, thickest = float(cuts.wire_radius.min()), float(cuts.wire_radius.max())
    return (
        min(thinnest, max(thinnest / BEYOND, SOLD[0])),
        max(thickest, min(thickest * BEYOND, SOLD[1])),
    )


def breaking_force(wire_radius: float) -> float:
    """Return the force at which a steel wire breaks [N]; hung at both ends it carries more.

    Examples
    --------
    >>> print(f"{breaking_force(0.1e-3):.0f} N")
    63 N
    """
    return STEEL_STRENGTH * float(np.pi) * wire_radius**2


def sold_radii(smallest: float, largest: float) -> Array:
    """Return the radii of wires that are sold, from one to another [m]; may be none.

    Examples
    --------
    >>> print(1e3 * sold_radii(0.1e-3, 0.15e-3))
    [0.1   0.11  0.125 0.14  0.15 ]
    """
    rounding = 1e-9
    radii = 0.5 * np.array(DIAMETERS)
    within = radii >= smallest * (1.0 - rounding)
    return np.asarray(radii[within & (radii <= largest * (1.0 + rounding))])


def forces_of(
    model: ForceModel, cuts: Cuts, toughness: Array, wear_strength: Array, wire_radius: Array
) -> Array:
    """Return F_ss/T [N/m] of materials (m,) on wires (k,), shape (m, k)."""
    gamma, tau = toughness[:, np.newaxis], wear_strength[:, np.newaxis]
    modulus, friction, exponent = (
        cuts.shear_modulus,
        cuts.friction_coefficient,
        cuts.stiffening_exponent,
    )
    with np.errstate(all="ignore"):
        parts = model.terms(modulus, gamma, wire_radius, friction, tau, exponent)
        return np.asarray(gamma + np.zeros(wire_radius.shape) + parts[0] + parts[1])


def further_wire(
    misfit: Misfit, profile: Profile, std: Array, searched: tuple[float, float]
) -> FurtherWire | None:
    """Return the wire that tells most, of those that are sold and for which the model holds.

    Compared are the minima that are admitted, where there are several; else the two ends of the
    toughness's interval, each with its best wear strength. The error of a force is taken as the
    same share of the force as at the nearest wires of the cuts.

    Parameters
    ----------
    misfit : Misfit
        The cuts so far, and the model.
    profile : Profile
        What they say.
    std : ndarray, shape (n,)
        Standard error of each of their forces [N/m]; all 0 where they have no scatter.
    searched : tuple of float
        Smallest and largest radius to consider [m]; where no wire between is sold, these two.

    Returns
    -------
    FurtherWire or None
        None where the cuts leave nothing open, or the model holds for no such wire.
    """
    gamma, modes = _toughnesses(profile)
    if gamma.size < 2:
        return None
    model, cuts, tau = misfit.model, misfit.cuts, misfit.at(gamma).wear_strength
    radius = sold_radii(*searched)
    if not radius.size:
        radius = np.unique(searched)
    # every toughness that is admitted, not only those compared, stays within the model's range
    ends = profile.admitted[0, [0, -1]] if profile.admitted.size else gamma[[0, -1]]
    g = ends[:, np.newaxis] / (cuts.shear_modulus * radius)
    low, high = model.ends(cuts.stiffening_exponent)
    inside = np.all((g >= low) & (g <= high), axis=0)
    if not np.any(inside):  # as where nothing bounds the toughness below
        inside = g[-1] <= high
    radius = radius[inside]
    if not radius.size:
        return None
    forces = forces_of(model, cuts, gamma, tau, radius)
    apart = forces.max(axis=0) - forces.min(axis=0)
    error = _relative_std(cuts, std, radius) * forces.mean(axis=0)
    scattered = bool(np.any(std > 0.0))
    best = int(np.argmax(apart / (error if scattered else forces.mean(axis=0))))
    return FurtherWire(
        wire_radius=float(radius[best]),
        forces=(float(forces[0, best]), float(forces[-1, best])),
        toughnesses=(float(gamma[0]), float(gamma[-1])),
        separation=float(apart[best] / error[best]) if scattered else np.inf,
        searched=searched,
        modes=modes,
    )


def _toughnesses(profile: Profile) -> tuple[Array, bool]:
    """Return the toughnesses of the materials to tell apart, and whether they are minima."""
    minima = sorted(mode.toughness for mode in profile.modes if mode.admitted)
    if len(minima) > 1:
        return np.array(minima), True
    return np.unique(profile.admitted[0, [0, -1]] if profile.admitted.size else []), False


def _relative_std(cuts: Cuts, std: Array, radius: Array) -> Array:
    known, places = np.unique(cuts.wire_radius, return_inverse=True)
    count = np.bincount(places.reshape(-1))
    share = np.bincount(places.reshape(-1), weights=std / cuts.force) / count
    return np.interp(np.log(radius), np.log(known), share)

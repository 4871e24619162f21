"""What the forces of one gel say of any toughness and wear strength, in units of their scatter.

The height of a pair of Gamma_o and tau_w is how far its misfit is above the smallest one, over the
square of a force's standard error: 0 at the estimate, 1 one standard error away. At each toughness
it is a parabola in the wear strength, because the force is linear in tau_w.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.roots import narrowed
from surrogate.identification.fit import Identification
from surrogate.inference.profile import Profile

__all__ = ["QUANTITIES", "Evidence", "Sampled", "evidence_of", "lowest"]

Array = NDArray[np.float64]
Heights = Callable[[Array], Array]

QUANTITIES = ("toughness", "wear_strength")

ZOOMS, PARTS = 3, 9
"""Each finer by a factor of four, before a parabola through the three lowest values."""

FINE = 0.1
"""How much a parabola may add where values stand as closely as after the zooms."""

SAMPLES, WEAR_SAMPLES = 801, 61
"""Values at which an interval is looked at."""

BEYOND = 4.0
"""Times the end of the search to which a toughness is followed where forces end it."""


@dataclass(frozen=True, eq=False)
class Sampled:
    """A quantity where its height is within a limit.

    Parameters
    ----------
    values, heights : ndarray, shape (n,)
        In SI units, and over the square of a standard error [-].
    open_above : bool
        Whether nothing ends it above.
    """

    values: Array
    heights: Array
    open_above: bool = False


@dataclass(frozen=True, eq=False)
class Evidence(ABC):
    """What one gel's forces say.

    Parameters
    ----------
    fit : Identification
        Its identification.
    """

    fit: Identification

    @property
    def dof(self) -> float:
        """Degrees of freedom of the scatter; infinite where the forces' errors were stated."""
        return np.inf if self.fit.force_std is not None else float(self.fit.dof)

    @property
    @abstractmethod
    def nodes(self) -> Array:
        """Toughnesses between which heights are smooth [J/m2]."""

    @property
    @abstractmethod
    def least_wear(self) -> float:
        """Below which no wear strength is admitted [Pa]."""

    @abstractmethod
    def valley(self, toughness: Array) -> tuple[Array, Array, Array]:
        """Return height and place [Pa] of the best wear strength, and how fast heights grow."""

    @abstractmethod
    def sampled(self, quantity: str, limit: float) -> Sampled:
        """Return a quantity where its height is within a limit."""

    def heights(self, quantity: str) -> Heights:
        """Return the function that gives the least height of a quantity's values."""
        return self.of_toughness if quantity == "toughness" else self.of_wear

    def at(self, toughness: Array, wear_strength: Array) -> Array:
        """Return the heights of pairs."""
        floor, free, growth = self.valley(toughness)
        return np.asarray(floor + growth * (wear_strength - free) ** 2)

    def of_toughness(self, toughness: Array) -> Array:
        """Return the heights with the best wear strength."""
        floor, free, growth = self.valley(toughness)
        return np.asarray(floor + growth * np.maximum(self.least_wear - free, 0.0) ** 2)

    def of_wear(self, wear_strength: Array) -> Array:
        """Return the heights with the best toughness."""
        floor, free, growth = self._valley_of_nodes
        x = np.broadcast_to(self.nodes, (wear_strength.size, self.nodes.size))
        heights = floor + growth * (wear_strength[:, np.newaxis] - free) ** 2
        for _ in range(ZOOMS):
            x = _around(x, np.argmin(heights, axis=1))
            repeated = np.repeat(wear_strength, PARTS)
            heights = self.at(x.ravel(), repeated).reshape(x.shape)
        return np.array([_bottom(row)[0] for row in heights])

    @cached_property
    def _valley_of_nodes(self) -> tuple[Array, Array, Array]:
        return self.valley(self.nodes)


@dataclass(frozen=True, eq=False)
class _OfLine(Evidence):
    """Of forces that are linear in both: a normal distribution, also below 0."""

    @cached_property
    def nodes(self) -> Array:
        return self.fit.toughness + self.fit.toughness_std * np.linspace(-40.0, 40.0, 161)

    @property
    def least_wear(self) -> float:
        return -np.inf

    def valley(self, toughness: Array) -> tuple[Array, Array, Array]:
        (gamma, both), (_, tau) = self.fit.covariance
        off = toughness - self.fit.toughness
        growth = gamma / (gamma * tau - both**2)
        free = self.fit.wear_strength + both / gamma * off
        return off**2 / gamma, free, np.full_like(off, growth)

    def of_wear(self, wear_strength: Array) -> Array:
        off = wear_strength - self.fit.wear_strength
        return np.asarray(off**2 / self.fit.covariance[1, 1])

    def sampled(self, quantity: str, limit: float) -> Sampled:
        shares = np.linspace(-1.0, 1.0, SAMPLES)
        std = getattr(self.fit, f"{quantity}_std")
        values = getattr(self.fit, quantity) + std * np.sqrt(limit) * shares
        return Sampled(values, limit * shares**2)


@dataclass(frozen=True, eq=False)
class _OfProfile(Evidence):
    """Of any model: the misfit that was followed along the toughness."""

    @property
    def profile(self) -> Profile:
        assert self.fit.profile is not None
        return self.fit.profile

    @cached_property
    def _variance(self) -> float:
        """Squared standard error of a force of weight 1, the unit of the misfit."""
        if self.fit.force_std is not None:
            return 1.0
        best = self.profile.modes[0].misfit
        return self.fit.scale**2 if self.fit.scale else best / self.fit.dof

    @cached_property
    def nodes(self) -> Array:
        last = self.profile.searched[1]
        beyond = np.geomspace(last, BEYOND * last, 40) if self._goes_on else np.empty(0)
        return np.unique(np.concatenate([self.profile.toughness, self.profile.admitted[0], beyond]))

    @property
    def _goes_on(self) -> bool:
        return self.profile.ends[1] == "forces"

    @property
    def least_wear(self) -> float:
        return 0.0

    def valley(self, toughness: Array) -> tuple[Array, Array, Array]:
        first, last = self.profile.searched
        last = BEYOND * last if self._goes_on else last
        inside = (toughness >= first) & (toughness <= last)
        best = self.fit.misfit.at(np.clip(toughness, first, last))
        floor = (best.free_misfit - self.profile.modes[0].misfit) / self._variance
        # a wear strength that was given is never looked for elsewhere
        growth = np.where(np.isfinite(best.curvature), best.curvature, 0.0) / self._variance
        return np.where(inside, floor, np.inf), best.free_wear_strength, growth

    def sampled(self, quantity: str, limit: float) -> Sampled:
        return self._toughnesses(limit) if quantity == "toughness" else self._wears(limit)

    def _toughnesses(self, limit: float) -> Sampled:
        nodes = self.nodes
        inside = self.of_toughness(nodes) <= limit
        starts = np.flatnonzero(inside & ~np.append(False, inside[:-1]))
        stops = np.flatnonzero(inside & ~np.append(inside[1:], False))
        lows, highs = nodes[starts], nodes[stops]
        begins, ends = starts > 0, stops < nodes.size - 1
        edges = narrowed(
            lambda x: self.of_toughness(x) <= limit,
            np.concatenate([lows[begins], highs[ends]]),
            np.concatenate([nodes[starts[begins] - 1], nodes[stops[ends] + 1]]),
            1e-6,
        )
        lows[begins], highs[ends] = np.split(edges, [np.count_nonzero(begins)])
        modes = [mode.toughness for mode in self.profile.modes]
        pieces = [np.linspace(low, high, SAMPLES) for low, high in zip(lows, highs, strict=True)]
        values = np.unique(np.concatenate([*pieces, modes]))
        open_above = bool(inside[-1]) and self.profile.ends[1] != "bound"
        return _within(values, self.of_toughness(values), limit, open_above)

    def _wears(self, limit: float) -> Sampled:
        modes = np.array([mode.wear_strength for mode in self.profile.modes if mode.admitted])
        low, high = self.fit.wear_strength_interval
        low, open_below = self._followed(float(modes.min()), low, limit)
        high, open_above = self._followed(float(modes.max()), high, limit)
        assert not open_below
        grid = np.unique(np.concatenate([np.linspace(low, high, WEAR_SAMPLES), modes]))
        fine = np.unique(np.concatenate([np.linspace(low, high, SAMPLES), modes]))
        heights = np.interp(fine, grid, self.of_wear(grid))
        return _within(fine, heights, limit, open_above)

    def _followed(self, start: float, end: float, limit: float) -> tuple[float, bool]:
        """Return the first of ever farther ends that is beyond the limit, or whether none is."""
        if not np.isfinite(end):
            return (BEYOND * start, True)
        reach = end - start if end != start else 0.1 * start * np.sign(end - start or 1.0)
        for _ in range(40):
            end = max(start + reach, 0.0)
            if end == 0.0 or self.of_wear(np.array([end]))[0] > limit:
                return end, False
            reach *= 1.5
        return end, True


def _within(values: Array, heights: Array, limit: float, open_above: bool) -> Sampled:
    inside = heights <= limit * (1.0 + 1e-4)
    return Sampled(values[inside], heights[inside], open_above)


def evidence_of(fit: Identification) -> Evidence:
    """Return what an identification's forces say of any pair.

    Examples
    --------
    >>> from surrogate.identification.fit import identify
    >>> fit = identify([1e-4, 2e-4, 4e-4], [4.7, 7.9, 13.9], 685.0, model="eq13")
    >>> gamma = fit.toughness + np.array([0.0, 2.0]) * fit.toughness_std
    >>> evidence_of(fit).of_toughness(gamma).round(9).tolist()
    [0.0, 4.0]
    """
    return _OfLine(fit) if fit.profile is None else _OfProfile(fit)


def lowest(heights: Heights, nodes: Array) -> tuple[float, float]:
    """Return the least height near the best of several nodes, and where it is.

    Examples
    --------
    >>> height, place = lowest(lambda x: (x - 2.2) ** 2, np.arange(5.0))
    >>> print(f"{height:.6f} {place:.3f}")
    0.000000 2.200
    """
    for _ in range(ZOOMS):
        nodes = _around(nodes[np.newaxis], np.array([np.argmin(heights(nodes))]))[0]
    values = heights(nodes)
    height, shift = _bottom(values)
    best = int(np.argmin(values))
    return height, float(nodes[best] + shift * (nodes[1] - nodes[0]))


def _around(x: Array, best: NDArray[np.intp]) -> Array:
    """Return places between the neighbours of the best of each row."""
    rows = np.arange(best.size)
    low = x[rows, np.maximum(best - 1, 0)][:, np.newaxis]
    high = x[rows, np.minimum(best + 1, x.shape[1] - 1)][:, np.newaxis]
    return np.asarray(low + (high - low) * np.linspace(0.0, 1.0, PARTS))


def _bottom(heights: Array) -> tuple[float, float]:
    """Return the bottom of the parabola through the least of evenly spaced heights, and its place.

    The place in steps from the least one, which is the bottom itself at an end.
    """
    best = int(np.argmin(heights))
    if not 0 < best < heights.size - 1:
        return float(heights[best]), 0.0
    left, here, right = heights[best - 1 : best + 2].tolist()
    bend = left - 2.0 * here + right
    if not 0.0 < bend < np.inf:
        return here, 0.0
    shift = 0.5 * (left - right) / bend
    less = 0.25 * (left - right) * shift
    if less > FINE * max(here, 1.0):  # no parabola: a height that is beyond all others beside it
        return here, 0.0
    return max(here - less, 0.0), shift

"""The misfit along the toughness: every minimum, and the intervals that the forces admit."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.roots import narrowed
from surrogate.errors import DomainError, InputError
from surrogate.inference.misfit import Misfit

__all__ = ["Mode", "Profile", "profile_misfit", "smallest_misfit", "without_each"]

Array = NDArray[np.float64]
Interval = tuple[float, float]

POINTS_A_DECADE = 48
WIDE_POINTS = 6
"""A decade where every force is as good as without toughness and every arc far from the touch."""

NEGLIGIBLE, SHORT_OF_TOUCH = 1e-4, 1e-3
"""Toughness over the largest force, and g of the thinnest wire, that begin the closer points."""

DECADES = 15.0
"""Below the largest force; a smaller toughness is lost in the rounding of the forces."""

BEYOND = 2.0
"""Times the largest force to which the toughness is searched where the forces share errors."""

ROUNDING = 1e3 * np.finfo(float).eps
"""Height, over the forces' own sum of squares, from which a barrier between minima counts."""

SHARED_RTOL = 1e-7
"""Of toughnesses where errors are shared, far below what any force tells."""

ZOOMS = 5
"""Each finer by about a factor of eight, to the square root of rounding."""

INSIDE = 64
"""Toughnesses at which each admitted interval is looked at, besides those of the scan."""


@dataclass(frozen=True)
class Mode:
    """One minimum of the misfit.

    Parameters
    ----------
    toughness, wear_strength : float
        Gamma_o [J/m2] and the best tau_w with it [Pa].
    misfit : float
        chi^2 [-] where the forces' standard errors are known, else the sum of squares [N2/m2].
    admitted : bool
        Whether it is within the confidence interval.
    at_end : bool
        Whether the misfit would fall further beyond the end of the search.
    """

    toughness: float
    wear_strength: float
    misfit: float
    admitted: bool
    at_end: bool


@dataclass(frozen=True, eq=False)
class Profile:
    """The misfit with the best wear strength, along the toughness.

    Parameters
    ----------
    modes : tuple of Mode
        All minima, the best first.
    toughness, misfit : ndarray, shape (m,)
        The scan: Gamma_o [J/m2], from the smallest on, and the misfit there.
    threshold : float
        Misfit up to which a toughness is admitted; nan where the scatter is unknown.
    toughness_intervals, wear_strength_intervals : tuple of (float, float)
        What is admitted: several pieces where the misfit has several minima [J/m2], [Pa].
    admitted : ndarray, shape (3, k)
        Toughnesses that are admitted, and the smallest and largest wear strength with each.
    searched : tuple of float
        Ends of the search [J/m2].
    ends : tuple of str
        What ends the search below, "zero" or "model", and above, "forces", "model" or "bound".
    """

    modes: tuple[Mode, ...]
    toughness: Array
    misfit: Array
    threshold: float
    toughness_intervals: tuple[Interval, ...]
    wear_strength_intervals: tuple[Interval, ...]
    admitted: Array
    searched: Interval
    ends: tuple[str, str]

    def limits_of(self, low: float, high: float) -> tuple[str, str]:
        """Return what ends an interval of the toughness: "forces", or what ends the search."""
        first, last = self.searched
        below = self.ends[0] if low <= first else "forces"
        above = "search" if self.ends[1] == "forces" else self.ends[1]
        return below, above if high >= last else "forces"


def profile_misfit(misfit: Misfit, threshold: Callable[[float], float]) -> Profile:
    """Search all toughnesses that the forces, the model and the bound allow.

    The scan takes 48 toughnesses a decade over 15 decades below the largest force, and 0 where
    the model goes there; each change of sign of the misfit's slope is then narrowed down to
    rounding, and so are the ends of the intervals. No force is smaller than the toughness, so
    that beyond the largest force the misfit grows; the search ends where it has passed the
    threshold.

    Parameters
    ----------
    misfit : Misfit
        The misfit of the forces.
    threshold : callable
        Gives the largest admitted misfit from the smallest one.

    Returns
    -------
    Profile
        Minima and intervals.

    Raises
    ------
    DomainError
        If the model covers no toughness for all of the wires.
    InputError
        If the bound excludes all toughnesses that the model covers, or the model has no wear.
    """
    lowest, highest, ends = _limits(misfit)
    largest_force = float(misfit.cuts.force.max())
    first = max(largest_force, lowest)
    scan = _nodes(misfit, lowest, min(first, highest))
    reach = np.sqrt(threshold(float(misfit.at(scan).misfit.min())) / np.sum(misfit.cuts.weight**2))
    top = first + (float(reach) if np.isfinite(reach) else first)
    if misfit.shares_errors:  # which let the forces be smaller together than the toughness
        top = max(top, BEYOND * first)
    if top < highest:
        highest, ends = top, (ends[0], "forces")
    scan = _nodes(misfit, lowest, highest)
    values = misfit.at(scan)
    if misfit.known.wear_strength is None and not np.any(values.curvature > 0.0):
        raise InputError(
            f"model {misfit.model.name!r} has no wear, so that it is not linear in both toughness "
            "and wear strength and tells nothing of the latter; choose another model, or give "
            "wear_strength."
        )
    minima = _minima(misfit, scan, values.misfit)
    best = misfit.at(minima)
    limit = threshold(float(best.misfit.min()))
    points, order = np.unique(np.concatenate([scan, minima]), return_index=True)
    heights = np.concatenate([values.misfit, best.misfit])[order]
    modes = sorted(
        (
            Mode(gamma, tau, height, not height > limit, _at_end(gamma, scan))
            for gamma, tau, height in zip(
                minima.tolist(), best.wear_strength.tolist(), best.misfit.tolist(), strict=True
            )
        ),
        key=lambda mode: mode.misfit,
    )
    pieces = _pieces(misfit, points, heights, limit)
    samples = [_sampled(misfit, points, piece, limit) for piece in pieces]
    return Profile(
        modes=tuple(modes),
        toughness=points,
        misfit=heights,
        threshold=limit,
        toughness_intervals=tuple(pieces),
        wear_strength_intervals=_merged([_wear_interval(misfit, each, limit) for each in samples]),
        admitted=np.concatenate([*samples, np.empty((3, 0))], axis=1),
        searched=(float(scan[0]), float(scan[-1])),
        ends=ends,
    )


def smallest_misfit(misfit: Misfit) -> tuple[float, float, float]:
    """Return the lowest misfit of the search, its Gamma_o [J/m2] and tau_w [Pa], no other minima.

    Raises
    ------
    DomainError, InputError
        As `profile_misfit`.
    """
    lowest, highest, _ = _limits(misfit)
    first = max(float(misfit.cuts.force.max()), lowest)
    return _lowest(misfit, _nodes(misfit, lowest, min(first, highest)))


def without_each(misfit: Misfit, toughness: Array) -> Array:
    """Return the best fits with each cut left out in turn, near toughnesses of a scan.

    Parameters
    ----------
    misfit : Misfit
        The misfit of all cuts.
    toughness : ndarray, shape (m,)
        Where to look [J/m2].

    Returns
    -------
    ndarray, shape (3, n)
        The misfit, Gamma_o [J/m2] and tau_w [Pa].
    """
    weight = misfit.cuts.weight
    left_out = (np.where(np.arange(weight.size) == i, 0.0, weight) for i in range(weight.size))
    return np.array(
        [
            _lowest(replace(misfit, cuts=replace(misfit.cuts, weights=w)), toughness)
            for w in left_out
        ]
    ).T


def _lowest(misfit: Misfit, gamma: Array) -> tuple[float, float, float]:
    """Return the smallest misfit near toughnesses of a scan, its toughness and wear strength."""
    smallest = np.inf, np.nan, np.nan
    for _ in range(ZOOMS):
        values = misfit.at(gamma)
        best = int(np.argmin(values.misfit))
        if values.misfit[best] < smallest[0]:
            here = values.misfit[best], gamma[best], values.wear_strength[best]
            smallest = float(here[0]), float(here[1]), float(here[2])
        gamma = np.linspace(gamma[max(best - 1, 0)], gamma[min(best + 1, gamma.size - 1)], 17)
    return smallest


def _limits(misfit: Misfit) -> tuple[float, float, tuple[str, str]]:
    """Return the ends of the toughness that model and bound set, and what sets them."""
    cuts, g, bound = misfit.cuts, misfit.model.g, misfit.known.toughness_max
    lowest, highest = 0.0, np.inf
    if not misfit.is_continued:
        lowest = float(g.lower * (cuts.shear_modulus * cuts.wire_radius.max()))
        with np.errstate(over="ignore"):
            highest = float(g.upper * (cuts.shear_modulus * cuts.wire_radius.min()))
    if lowest > highest:
        thinnest, thickest = 1e3 * cuts.wire_radius.min(), 1e3 * cuts.wire_radius.max()
        raise DomainError(
            f"model {misfit.model.name!r} must hold for all wires with one toughness, but it holds "
            f"for g from {g.lower:.4g} to {g.upper:.4g} and the wires of {thinnest:.4g} to "
            f"{thickest:.4g} mm differ more than that; leave out the thinnest or the thickest, or "
            "choose a model that holds for any g, such as 'eq13'."
        )
    if bound < lowest:
        raise InputError(
            f"toughness_max must be within what model {misfit.model.name!r} covers, but "
            f"toughness_max = {bound:.4g} J/m2 and for these wires the model begins at "
            f"{lowest:.4g} J/m2 (g = {g.lower:.4g}); give a larger bound or choose another model."
        )
    by_bound = bound <= highest
    ends = ("model" if lowest > 0.0 else "zero", "bound" if by_bound else "model")
    return lowest, min(highest, bound), ends


def _nodes(misfit: Misfit, lowest: float, highest: float) -> Array:
    """Return the toughnesses of the scan, with 0 where that is the lowest.

    Closely where the force or the arc of a wire changes with the toughness, else with wide steps.
    """
    cuts = misfit.cuts
    first = max(lowest, 10.0**-DECADES * min(float(cuts.force.max()), highest))
    small = cuts.shear_modulus * float(cuts.wire_radius.min())
    close = min(max(first, min(NEGLIGIBLE * cuts.force.max(), SHORT_OF_TOUCH * small)), highest)
    nodes = [_spaced(first, close, WIDE_POINTS), _spaced(close, highest, POINTS_A_DECADE)]
    return np.unique(np.concatenate([[lowest], *nodes]))


def _spaced(first: float, last: float, a_decade: int) -> Array:
    count = 2 + int(np.ceil(a_decade * np.log10(last / first)))
    nodes = np.geomspace(first, last, count)
    nodes[0], nodes[-1] = first, last
    return nodes


def _rtol(misfit: Misfit) -> float:
    """Return how closely a toughness is narrowed down: misfits by differences allow no more."""
    return SHARED_RTOL if misfit.shares_errors else 0.0


def _at_end(gamma: float, scan: Array) -> bool:
    return gamma > 0.0 and gamma in (*scan[scan > 0.0][:1], scan[-1])


def _minima(misfit: Misfit, scan: Array, heights: Array) -> Array:
    """Return the toughnesses of all minima but those that rounding makes."""
    interior = scan[scan > 0.0]
    slope = misfit.slope(interior)
    turns = (slope[:-1] < 0.0) & (slope[1:] >= 0.0)
    falling = narrowed(
        lambda x: misfit.slope(x) < 0.0, interior[:-1][turns], interior[1:][turns], _rtol(misfit)
    )
    found = [np.nextafter(falling, np.inf)]
    has_zero = interior.size < scan.size
    if has_zero and heights[0] <= heights[1] and (slope[0] >= 0.0 or heights[0] == heights.min()):
        found.append(scan[:1])
    elif slope[0] >= 0.0:
        found.append(interior[:1])
    if slope[-1] < 0.0:
        found.append(interior[-1:])
    return _without_ripples(misfit, np.unique(np.concatenate(found)), scan, heights)


def _without_ripples(misfit: Misfit, minima: Array, scan: Array, heights: Array) -> Array:
    """Drop the higher of two neighbours whose barrier is not above rounding."""
    noise = ROUNDING * float(np.sum((misfit.cuts.weight * misfit.cuts.force) ** 2))
    kept: list[tuple[float, float]] = []
    for gamma, depth in zip(minima.tolist(), misfit.at(minima).misfit.tolist(), strict=True):
        if kept:
            between = heights[(scan >= kept[-1][0]) & (scan <= gamma)]
            if between.max(initial=-np.inf) <= max(depth, kept[-1][1]) + noise:
                kept[-1] = min(kept[-1], (gamma, depth), key=lambda mode: mode[1])
                continue
        kept.append((gamma, depth))
    return np.array([gamma for gamma, _ in kept])


def _pieces(misfit: Misfit, points: Array, heights: Array, limit: float) -> list[Interval]:
    """Return the intervals of toughness whose misfit is at most the limit."""
    if not np.isfinite(limit):
        return []
    inside = heights <= limit
    inside[np.argmin(heights)] = True
    starts = np.flatnonzero(inside & ~np.append(False, inside[:-1]))
    stops = np.flatnonzero(inside & ~np.append(inside[1:], False))
    lows, highs = points[starts], points[stops]
    to_zero = points[0] == 0.0 and starts[0] == 1
    # to 0 where A may jump, and which no force can tell from its limit
    begins, ends = starts > int(to_zero), stops < points.size - 1
    edges = narrowed(
        lambda x: misfit.at(x).misfit <= limit,
        np.concatenate([lows[begins], highs[ends]]),
        np.concatenate([points[starts[begins] - 1], points[stops[ends] + 1]]),
        _rtol(misfit),
    )
    lows[begins], highs[ends] = np.split(edges, [np.count_nonzero(begins)])
    if to_zero:
        lows[0] = 0.0
    return list(zip(lows.tolist(), highs.tolist(), strict=True))


def _sampled(misfit: Misfit, points: Array, piece: Interval, limit: float) -> Array:
    """Return toughnesses of an interval and the wear strengths admitted with each."""
    low, high = piece
    scanned = points[(points >= low) & (points <= high)]
    gamma = np.unique(np.concatenate([[low, high], scanned, np.linspace(low, high, INSIDE)]))
    values = misfit.at(gamma)
    if gamma.size > 1 and not values.misfit[0] <= limit:
        gamma = gamma[1:]  # an end at 0 that is only a limit
        values = misfit.at(gamma)
    return np.stack([gamma, *values.wear_strength_range(limit)])


def _wear_interval(misfit: Misfit, sampled: Array, limit: float) -> Interval:
    """Return the extremes of the wear strength over an interval of toughness."""
    gamma, smallest, largest = sampled

    def extreme(values: Array, sign: float) -> float:
        x, y = gamma, sign * values
        for _ in range(5):
            best = int(np.argmax(y))
            x = np.linspace(x[max(best - 1, 0)], x[min(best + 1, x.size - 1)], 17)
            bounds = misfit.at(x).wear_strength_range(limit)
            y = sign * bounds[1 if sign > 0.0 else 0]
        return float(sign * y.max())

    return extreme(smallest, -1.0), extreme(largest, 1.0)


def _merged(intervals: list[Interval]) -> tuple[Interval, ...]:
    """Return the union of intervals, those that overlap as one."""
    union: list[Interval] = []
    for low, high in sorted(intervals):
        if union and low <= union[-1][1]:
            union[-1] = (union[-1][0], max(union[-1][1], high))
        else:
            union.append((low, high))
    return tuple(union)

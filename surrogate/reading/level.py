"""Where a force runs level: contact, noise and the longest stretch without trend.

The stroke after contact is divided into cells of equal travel, whose mean forces are looked at. A
stretch of them is level where the line fitted to it changes by no more than the tolerance, and none
of its four quarters is off its mean by more than half of that; the longest one is taken. The peak
at which cutting begins does not pass; stick-slip does, because it averages out. What is left of the
peak's decay is then cut off where the mean is better known without it. `scripts/compare-plateaus`
holds this against four other ways on records of known answers: it is among the nearest on every
kind of record and refuses none of them, while the best piecewise line fails on stick-slip and
correlated noise, the least standard error alone takes a piece of a drift, and the longest level
stretch alone keeps a piece of the peak.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from surrogate.errors import InputError

__all__ = [
    "Cells",
    "Contact",
    "cells_of",
    "contact_of",
    "cut_off",
    "far_off",
    "level_stretch",
    "lone_forces",
    "noise_of",
]

Array = NDArray[np.float64]

MOST_CELLS = 120
FEWEST_CELLS = 12
FEWEST_SAMPLES = 40
SHORTEST = 0.2
"""Least length of a plateau, as a part of the travel under load."""
_FEWEST_CUT_OFF = 15
"""Forces one after another; waves of few samples may stay at their crest for less."""
LOADED = 0.1
"""Part of the largest force above which the wire is in the sample."""


def noise_of(force: Array) -> float:
    """Return the scatter from sample to sample, robustly; a slope leaves it as it is.

    Examples
    --------
    >>> noise_of(np.arange(100.0))
    0.0
    """
    if force.size < 3:
        return 0.0
    second = np.abs(np.diff(force, 2))
    median = float(np.median(second))
    # Of a force in coarse steps most differences are 0, and the median says nothing.
    spread = median / 0.6745 if median > 0.0 else float(np.sqrt(np.mean(second**2)))
    return float(spread / np.sqrt(6.0))


def cut_off(force: Array) -> NDArray[np.bool_]:
    """Return which forces stand at the end of the load cell's range; none where it is not seen.

    They are the largest, one after another, to the last digit, while the others scatter by more
    than the steps in which forces are recorded.

    Examples
    --------
    >>> load = np.linspace(0.0, 1.0, 100) + 0.01 * np.random.default_rng(1).normal(size=100)
    >>> int(cut_off(load).sum()), int(cut_off(np.minimum(load, 0.5)).sum())
    (0, 51)
    """
    largest: NDArray[np.bool_] = force == np.max(force)
    others = force[~largest]
    ends = np.flatnonzero(np.diff(np.r_[False, largest, False].astype(int)))
    if np.max(ends[1::2] - ends[::2]) < _FEWEST_CUT_OFF or others.size < FEWEST_SAMPLES // 2:
        return np.zeros(force.shape, bool)
    steps = np.diff(np.unique(others))
    seen = steps.size > 0 and noise_of(others) > 2.0 * float(np.min(steps))
    return largest if seen else np.zeros(force.shape, bool)


def far_off(force: Array) -> NDArray[np.bool_]:
    """Return which forces of a level stretch are far from all the others, one in twenty at most.

    Examples
    --------
    >>> np.flatnonzero(far_off(np.r_[np.tile([1.0, 1.1], 30), 9.0])).tolist()
    [60]
    """
    middle = float(np.median(force))
    apart = np.abs(force - middle)
    scatter = float(np.median(apart)) / 0.6745
    far: NDArray[np.bool_] = apart > max(10.0 * scatter, 0.5 * abs(middle))
    return far if np.count_nonzero(far) <= 0.05 * force.size else np.zeros(force.shape, bool)


def lone_forces(force: Array, least: float = 0.5) -> NDArray[np.bool_]:
    """Return which forces leave those before and after them by a multiple of what is usual.

    Examples
    --------
    >>> np.flatnonzero(lone_forces(np.r_[np.ones(30), 9.0, np.ones(30)])).tolist()
    [30]
    """
    windows = np.lib.stride_tricks.sliding_window_view(np.pad(force, 2, "edge"), 5)
    near = np.median(windows, axis=1)
    usual = float(np.percentile(np.abs(near), 95.0))
    lone: NDArray[np.bool_] = np.abs(force - near) > max(40.0 * noise_of(near), least * usual)
    return lone


@dataclass(frozen=True)
class Contact:
    """What is before the wire meets the sample.

    Parameters
    ----------
    index : int
        First sample under load; 0 where the record begins with it.
    offset : float
        Mean force before [N]; 0 where the record has no such stretch.
    offset_error : float
        Standard error of the offset [N].
    """

    index: int
    offset: float
    offset_error: float


def contact_of(force: Array) -> Contact:
    """Find the contact: where the force leaves its first level for good.

    Parameters
    ----------
    force : ndarray, shape (n,)
        Force, cutting counted positive [N].

    Examples
    --------
    >>> contact_of(np.r_[np.full(50, 0.01), np.linspace(0.01, 1.0, 50)]).index
    54
    """
    width = max(5, force.size // 100)
    if force.size < 2 * width:
        return Contact(0, 0.0, 0.0)
    smooth = _running_mean(force, width)
    least = max(6.0 * noise_of(force) / np.sqrt(width), 0.02 * float(np.max(smooth) - smooth[0]))
    above = smooth > smooth[0] + least
    index = int(np.argmax(above)) + width if above.any() else 0
    free = _without_trend(force[: max(index - 2 * width, 0)])
    if free.size < 10:
        return Contact(0 if index <= 3 * width else index, 0.0, 0.0)
    return Contact(index, float(np.mean(free)), float(np.std(free, ddof=1) / np.sqrt(free.size)))


def _without_trend(free: Array) -> Array:
    """Return what comes before a force begins to rise, however slowly: a ramp is no offset."""
    while free.size >= 10:
        x = np.arange(free.size) - 0.5 * (free.size - 1.0)
        slope = float(np.dot(x, free) / np.dot(x, x))
        scatter = float(np.std(free - np.mean(free) - slope * x))
        rounding = 1e-12 * float(np.max(np.abs(free)))
        if abs(slope) * np.sqrt(np.dot(x, x)) <= 3.0 * scatter + rounding:
            break
        free = free[: free.size // 2]
    return free


@dataclass(frozen=True)
class Cells:
    """Mean forces of equal pieces of travel.

    Parameters
    ----------
    edges : ndarray, shape (k + 1,)
        Ends of the pieces [m].
    force : ndarray, shape (k,)
        Mean force of each [N].
    """

    edges: Array
    force: Array

    @property
    def loaded(self) -> int:
        """How many cells the wire is in the sample."""
        return int(np.count_nonzero(self.force >= LOADED * np.max(self.force)))


def cells_of(displacement: Array, force: Array) -> Cells:
    """Divide a stroke into cells of equal travel with five samples or more on average.

    A cell without a sample gets what lies between its neighbours.
    """
    number = min(MOST_CELLS, force.size // 5)
    edges = np.linspace(float(displacement[0]), float(np.max(displacement)), number + 1)
    cell = np.clip(np.searchsorted(edges, displacement, side="right") - 1, 0, number - 1)
    count = np.bincount(cell, minlength=number)
    filled = np.flatnonzero(count)
    means = np.bincount(cell, force, minlength=number)[filled] / count[filled]
    return Cells(edges, np.interp(np.arange(number), filled, means))


@dataclass(frozen=True)
class _Stretches:
    """Every stretch of a row of cells: begins, ends, and whether it is level."""

    begin: NDArray[np.intp]
    end: NDArray[np.intp]
    mean: Array
    level: NDArray[np.bool_]


def _stretches(force: Array, shortest: int, tolerance: float) -> _Stretches:
    begin, end = np.triu_indices(force.size + 1, shortest)
    sums = np.r_[0.0, np.cumsum(force)]
    moments = np.r_[0.0, np.cumsum(force * np.arange(force.size))]
    length = (end - begin).astype(float)
    mean = (sums[end] - sums[begin]) / length
    middle = begin + 0.5 * (length - 1.0)
    moment = moments[end] - moments[begin] - middle * length * mean
    slope = moment / (length * (length**2 - 1.0) / 12.0)
    level = (mean >= LOADED * np.max(force)) & (np.abs(slope) * length <= tolerance * mean)
    quarters = np.linspace(begin, end, 5).round().astype(int)
    for left, right in pairwise(quarters):
        part = (sums[right] - sums[left]) / (right - left)
        level &= np.abs(part - mean) <= 0.5 * tolerance * mean
    return _Stretches(begin, end, mean, level)


def level_stretch(cells: Cells, tolerance: float) -> tuple[float, float]:
    """Return the ends of the longest level stretch [m].

    Parameters
    ----------
    cells : Cells
        The stroke after contact.
    tolerance : float
        Change of force along the stretch that counts as none, as a part of its mean.

    Raises
    ------
    InputError
        If there is none of a fifth of the travel under load, or another one of at least half its
        length has another level.
    """
    force = cells.force
    shortest = max(6, int(np.ceil(SHORTEST * cells.loaded)))
    if force.size < shortest + 1:
        raise InputError("the cut is too short; cut further, or record more points")
    stretches = _stretches(force, shortest, tolerance)
    if not stretches.level.any():
        raise InputError(_no_level(cells, tolerance))
    length = np.where(stretches.level, stretches.end - stretches.begin, 0)
    best = int(np.argmax(length))
    _refuse_another_level(cells, stretches, best, tolerance)
    begin, end = trimmed(force, int(stretches.begin[best]), int(stretches.end[best]))
    return float(cells.edges[begin]), float(cells.edges[end])


def trimmed(force: Array, begin: int, end: int) -> tuple[int, int]:
    """Return the part of a stretch whose mean is best known, of at least half its length.

    That is the part with the least sum of squares about its mean over the square of its length: a
    longer one pays off until it takes in what is left of the peak. It is the rule by which
    simulations drop their transients (White, Simulation 69 (1997) 323-334), for both ends.

    Examples
    --------
    >>> trimmed(np.r_[1.4, 1.2, 1.1, np.tile([1.0, 1.01], 20)], 0, 43)
    (3, 43)
    """
    cells = force[begin:end] - np.mean(force[begin:end])
    first, last = np.triu_indices(cells.size + 1, -(-cells.size // 2))
    sums, squares = np.r_[0.0, np.cumsum(cells)], np.r_[0.0, np.cumsum(cells**2)]
    length = (last - first).astype(float)
    spread = squares[last] - squares[first] - (sums[last] - sums[first]) ** 2 / length
    # Forces that are equal to rounding are no better known than that.
    rounding = (1e-9 * float(np.max(np.abs(force[begin:end])))) ** 2
    best = int(np.argmin((np.maximum(spread, 0.0) + length * rounding) / length**2))
    return begin + int(first[best]), begin + int(last[best])


def _running_mean(values: Array, size: int) -> Array:
    return np.convolve(values, np.full(size, 1.0 / size), mode="valid")


def _no_level(cells: Cells, tolerance: float) -> str:
    """Say why no stretch is level: the force rises or falls to the end, or something else."""
    under_load = np.flatnonzero(cells.force >= LOADED * np.max(cells.force))
    if not under_load.size:
        return "no force is above zero after the offset and the tare; check both, and the sign"
    last = cells.force[under_load[-1] + 1 - max(4, under_load.size // 4) : under_load[-1] + 1]
    slope = float(np.polyfit(np.arange(last.size), last, 1)[0])
    change = slope * last.size / max(abs(float(np.mean(last))), 5e-324)
    if abs(change) > 0.5 * tolerance:
        way, remedy = ("rises", "cut further") if change > 0.0 else ("falls", "check the sample")
        return (
            f"the force still {way} at the end of the cut, by {100.0 * abs(change):.2g} % over its "
            f"last quarter; {remedy}"
        )
    return f"no fifth of the cut is level within {100.0 * tolerance:g} %"


def _refuse_another_level(cells: Cells, all_: _Stretches, best: int, tolerance: float) -> None:
    begin, end, mean = all_.begin[best], all_.end[best], all_.mean[best]
    apart = (all_.end <= begin) | (all_.begin >= end)
    other = all_.level & apart & (np.abs(all_.mean - mean) > tolerance * mean)
    other &= 2 * (all_.end - all_.begin) >= end - begin
    if not other.any():
        return
    second = int(np.argmax(np.where(other, all_.end - all_.begin, 0)))
    first, last = sorted((best, second), key=lambda index: int(all_.begin[index]))
    spans = " and ".join(
        f"{all_.mean[one]:.4g} N from {1e3 * cells.edges[all_.begin[one]]:.3g} to "
        f"{1e3 * cells.edges[all_.end[one]]:.3g} mm"
        for one in (first, last)
    )
    if _one_trend(cells.force[all_.begin[first] : all_.end[last]], tolerance):
        way = "rises" if all_.mean[last] > all_.mean[first] else "falls"
        raise InputError(f"the force {way} along the whole cut: {spans}")
    raise InputError(f"the force has two plateaus: {spans}")


def _one_trend(force: Array, tolerance: float) -> bool:
    """Whether a line describes the force better than a step does."""
    x = np.arange(force.size)
    line = float(np.sum((force - np.polyval(np.polyfit(x, force, 1), x)) ** 2))
    sums, squares = np.cumsum(force), np.cumsum(force**2)
    n = x[1:-1]
    steps = squares[-1] - sums[n] ** 2 / (n + 1.0)
    steps -= (sums[-1] - sums[n]) ** 2 / (force.size - n - 1.0)
    return line <= float(np.min(steps))

"""Whether two gels differ: likelihood ratios of their profiles, each gel with its own scatter.

That two gels have one toughness costs heights: the least of h_1(Gamma) + h_2(Gamma), T. With known
errors T is chi^2 with one degree of freedom. Where each scatter was estimated, T is the square of
Welch's t: for straight lines it is (Gamma_1 - Gamma_2)^2/(V_1 + V_2), and the shares h_i/T at the
best common value are V_i/(V_1 + V_2), of which Satterthwaite's degrees of freedom are made. So
neither a straight line nor a single minimum is asked for. What the error of one model does to both
gels is taken out of V_1 + V_2 to first order.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from surrogate.comparing.evidence import QUANTITIES, Evidence, Sampled, lowest
from surrogate.comparing.shared_error import covariance_between
from surrogate.inference.quantiles import student_limit, student_tail

__all__ = ["Difference", "alike", "difference_of"]

Array = NDArray[np.float64]

BETWEEN = 33
"""Values between two estimates at which a common one is looked for."""

NOTHING = 1e-9
"""Of a squared standard error: a height that rounding makes."""


@dataclass(frozen=True)
class Difference:
    """How much two gels differ in one quantity.

    Parameters
    ----------
    quantity : str
        "toughness" or "wear_strength".
    value : float
        That of the first gel less that of the second [J/m2] or [Pa].
    interval : tuple of float
        Confidence interval, around all pieces where several materials fit [J/m2] or [Pa]; infinite
        where nothing ends it.
    p : float
        Probability of a difference at least as clear between equal gels [-].
    p_adjusted : float
        The same for the clearest of all pairs that were compared, after Holm [-].
    dof : float
        Degrees of freedom of the scatter; infinite where all errors were stated.
    """

    quantity: str
    value: float
    interval: tuple[float, float]
    p: float
    p_adjusted: float
    dof: float


def difference_of(
    one: Evidence, other: Evidence, quantity: str, confidence: float
) -> Difference | None:
    """Return how two gels differ in a quantity; None where it was given for one of them.

    Parameters
    ----------
    one, other : Evidence
        What the forces of either say.
    quantity : str
        "toughness" or "wear_strength".
    confidence : float
        Probability of the interval [-].

    Examples
    --------
    >>> from surrogate.comparing.evidence import evidence_of
    >>> from surrogate.identification.fit import identify
    >>> radii, forces = [1e-4, 2e-4, 4e-4, 5e-4], np.array([4.7, 7.9, 13.9, 17.2])
    >>> fits = [identify(radii, f, model="eq13", force_std=0.1) for f in (forces, forces + 0.3)]
    >>> found = difference_of(*map(evidence_of, fits), "toughness", 0.95)
    >>> print(f"{found.value:.2f} J/m2, p = {found.p:.3f}")
    -0.30 J/m2, p = 0.048
    """
    if quantity == "wear_strength" and _is_given(one, other):
        return None
    first, second = one.heights(quantity), other.heights(quantity)
    height, place = lowest(lambda x: first(x) + second(x), _nodes(one, other, quantity))
    at = np.array([place])
    dof = _dof(one, other, float(first(at)[0]), float(second(at)[0]))
    weight = _less_shared(one, other, np.eye(2)[QUANTITIES.index(quantity)])
    limit = student_limit(confidence, dof) ** 2 / weight
    p = student_tail(math.sqrt(max(height, 0.0) * weight), dof)
    ends = _ends(one.sampled(quantity, limit), other.sampled(quantity, limit), limit)
    value = getattr(one.fit, quantity) - getattr(other.fit, quantity)
    return Difference(quantity, float(value), ends, p, p, dof)


def alike(one: Evidence, other: Evidence) -> float:
    """Return the probability that one material in both shows a difference at least as clear.

    Of toughness and wear strength together: F with 2 and Satterthwaite's degrees of freedom.
    """
    if _is_given(one, other):
        return math.nan
    least = max(one.least_wear, other.least_wear)

    def common(gamma: Array) -> Array:
        (floor, free, growth), (floor2, free2, growth2) = one.valley(gamma), other.valley(gamma)
        with np.errstate(invalid="ignore"):
            tau = (growth * free + growth2 * free2) / (growth + growth2)
        tau = np.maximum(np.where(np.isfinite(tau), tau, 0.0), least)
        parts = growth * (tau - free) ** 2 + growth2 * (tau - free2) ** 2
        return np.asarray(floor + floor2 + parts)

    height, gamma = lowest(common, _nodes(one, other, "toughness"))
    at = np.array([gamma])
    (_, free, growth), (_, free2, growth2) = one.valley(at), other.valley(at)
    tau = np.maximum((growth * free + growth2 * free2) / (growth + growth2), least)
    dof = _dof(one, other, float(one.at(at, tau)[0]), float(other.at(at, tau)[0]))
    apart = np.array(
        [getattr(one.fit, name) - getattr(other.fit, name) for name in QUANTITIES], dtype=float
    )
    height = max(height, 0.0) * _less_shared(one, other, apart, joint=True)
    if math.isinf(dof):
        return math.exp(-0.5 * height)
    return float((1.0 + height / dof) ** (-0.5 * dof))


def _is_given(one: Evidence, other: Evidence) -> bool:
    return any(each.fit.known.wear_strength is not None for each in (one, other))


def _nodes(one: Evidence, other: Evidence, quantity: str) -> Array:
    """Return where a common value is looked for, closely between the estimates."""
    values = [getattr(each.fit, quantity) for each in (one, other)]
    nodes = [np.linspace(min(values), max(values), BETWEEN)]
    for each in (one, other):
        if quantity == "toughness":
            nodes.append(each.nodes)
        elif each.fit.profile is not None:
            nodes.append(np.array([mode.wear_strength for mode in each.fit.profile.modes]))
            ends = np.array(each.fit.wear_strength_interval)
            if np.all(np.isfinite(ends)):
                nodes.append(np.linspace(ends[0], ends[1], 17))
    return np.unique(np.concatenate(nodes))


def _dof(one: Evidence, other: Evidence, height: float, height2: float) -> float:
    """Return Satterthwaite's degrees of freedom from the shares of two variances in their sum."""
    total = height + height2
    if not total > NOTHING:
        return min(one.dof, other.dof)
    spent = (height / total) ** 2 / one.dof + (height2 / total) ** 2 / other.dof
    return math.inf if spent == 0.0 else 1.0 / spent


def _less_shared(one: Evidence, other: Evidence, apart: Array, joint: bool = False) -> float:
    """Return by how much heights grow where the two gels share the error of the model.

    For one quantity, the variance of a difference as if nothing were shared over what it is; for
    both together the same along the difference of the estimates.
    """
    independent = one.fit.covariance + other.fit.covariance
    between = covariance_between(one.fit, other.fit)
    shared = independent - between - between.T
    if not np.all(np.isfinite(shared)) or not np.any(between):
        return 1.0
    if not joint:
        before, after = apart @ independent @ apart, apart @ shared @ apart
        return float(before / after) if after > 0.0 else 1.0
    size = np.sqrt(np.diag(independent))
    matrices = [each / np.outer(size, size) for each in (shared, independent)]
    if np.linalg.eigvalsh(matrices[0]).min() <= 0.0 or not np.any(apart):
        return 1.0
    grown, plain = (apart / size @ np.linalg.solve(m, apart / size) for m in matrices)
    return float(grown / plain)


def _ends(one: Sampled, other: Sampled, limit: float) -> tuple[float, float]:
    """Return the least and the largest difference of values whose heights are within a limit."""
    together = one.heights[:, np.newaxis] + other.heights <= limit * (1.0 + 1e-4)
    apart = np.where(together, one.values[:, np.newaxis] - other.values, np.nan)
    if not together.any():  # each alone is within it at its own estimate, which has no height
        return -np.inf, np.inf
    low, high = float(np.nanmin(apart)), float(np.nanmax(apart))
    return (-np.inf if other.open_above else low, np.inf if one.open_above else high)

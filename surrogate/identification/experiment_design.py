"""Which wires to cut with, so that few cuts say most about toughness and wear strength."""

from __future__ import annotations

import operator
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from surrogate.basics.checks import Quantity, one_number, shown
from surrogate.basics.records import Shown
from surrogate.cutting.force import force_of
from surrogate.errors import InputError
from surrogate.inference.inputs import FORCE_STD, WIRE_RADIUS, column
from surrogate.inference.line_fit import linear_form, solve_least_squares
from surrogate.scene import Scene, require_scene

__all__ = ["Design", "Noise", "design_radii", "whole_number"]

Array = NDArray[np.float64]
Goal = Literal["both", "toughness", "wear_strength"]

RELATIVE_FORCE_STD = Quantity(
    "relative_force_std", "", "give 0.05 for cuts that scatter by 5 %", lower=1e-30, upper=1e30
)
MOST_CUTS = 10_000


@dataclass(frozen=True)
class Noise:
    """Scatter of one cut's force: the same for every wire, or in proportion to the force.

    Parameters
    ----------
    force_std : float or None
        Standard deviation of F_ss/T of one cut [N/m].
    relative_force_std : float or None
        The same as a fraction of the force [-]; needs `expected`.
    expected : Scene or None
        The material that is expected, for the forces of Eq. (13) and for its friction
        coefficient; its wire radius plays no part. None means xi = 0.
    """

    force_std: float | None
    relative_force_std: float | None
    expected: Scene | None

    def std(self, wire_radius: Array) -> Array:
        """Return the standard deviation of one cut's F_ss/T [N/m] at each radius [m]."""
        if self.force_std is not None:
            return np.full(wire_radius.shape, self.force_std)
        assert self.expected is not None
        assert self.relative_force_std is not None
        scene = replace(self.expected, wire_radius=wire_radius)
        force = force_of(scene, "eq13").total  # the line that is designed for
        return np.asarray(FORCE_STD.checked(self.relative_force_std * np.asarray(force)))


@dataclass(frozen=True, eq=False)
class Design(Shown):
    """Radii to cut with and what they promise; see `design_radii`.

    Parameters
    ----------
    wire_radius : ndarray, shape (cuts,)
        R_w of each cut [m], in ascending order.
    toughness_std : float
        Standard error that Gamma_o will have [J/m2].
    wear_strength_std : float
        Standard error that tau_w will have [Pa].
    noise : Noise
        Scatter of one cut that the standard errors assume.

    Examples
    --------
    >>> design = design_radii(1e-4, 5e-4, cuts=5, force_std=0.5)
    >>> print(f"{design.toughness_std:.3f} J/m2, {design.wear_strength_std:.1f} Pa")
    0.437 J/m2, 312.5 Pa
    """

    wire_radius: Array
    toughness_std: float
    wear_strength_std: float
    noise: Noise

    def gain_over(self, wire_radius: ArrayLike) -> tuple[float, float]:
        """Return how many times smaller the standard errors are than with other radii.

        Parameters
        ----------
        wire_radius : array_like, shape (n,)
            R_w of each cut of the other design [m]; at least two different ones.

        Returns
        -------
        tuple of float
            Standard error with the other radii over that with these, of the toughness and of
            the wear strength [-].

        Raises
        ------
        InputError
            If a radius is not a positive finite number or all are the same.

        Examples
        --------
        >>> spread = [1e-4, 2e-4, 3e-4, 4e-4, 5e-4]
        >>> gains = design_radii(1e-4, 5e-4, cuts=5, force_std=0.5).gain_over(spread)
        >>> print("{:.3f} {:.3f}".format(*gains))
        1.201 1.265
        """
        radii = column(WIRE_RADIUS, wire_radius)
        if np.unique(radii).size < 2:
            raise InputError("one radius cannot tell toughness from wear; give at least two.")
        other = _standard_errors(radii, self.noise)
        return other[0] / self.toughness_std, other[1] / self.wear_strength_std


def design_radii(
    smallest_radius: float,
    largest_radius: float,
    cuts: int = 5,
    *,
    force_std: float | None = None,
    relative_force_std: float | None = None,
    expected: Scene | None = None,
    goal: Goal = "both",
    line_test_cuts: int = 1,
) -> Design:
    """Choose the radii that give Gamma_o and tau_w of Eq. (13) the smallest standard errors.

    The force of Eq. (13) is a straight line in R_w, so the most informative cuts are at the two
    ends of the range that you can cut, not spread over it; this holds for either kind of noise.
    How many go to each end depends on the goal: the determinant of the covariance ("both",
    D-optimal), the variance of the intercept ("toughness") or of the slope ("wear_strength").
    Every allocation is tried.

    Two radii always lie on a line. Only a third one can show that the forces do NOT, which is
    the assumption that all the rest stands on. So `line_test_cuts` cuts go to the middle of the
    range, where a curved law departs most from the line; they cost some precision.

    Parameters
    ----------
    smallest_radius, largest_radius : float
        Range of R_w that can be cut [m].
    cuts : int, default 5
        Number of cuts, `line_test_cuts` included.
    force_std : float
        Scatter of one cut, the same for every radius [N/m]; or give the next.
    relative_force_std : float
        Scatter of one cut as a fraction of its force [-]; needs `expected`.
    expected : Scene, optional
        The expected material; its wire radius plays no part. Without it xi = 0.
    goal : {"both", "toughness", "wear_strength"}, default "both"
        Whose error to make small.
    line_test_cuts : int, default 1
        Cuts in the middle of the range, to test the line.

    Returns
    -------
    Design
        Radii of the cuts and the standard errors that they promise.

    Raises
    ------
    InputError
        If a number is not positive, the range is empty, fewer than two cuts are left for the
        ends, both or neither kind of scatter is given, or relative scatter lacks `expected`.

    Notes
    -----
    Range of validity: that of Eq. (13); the standard errors are those of independent cuts.

    References
    ----------
    arXiv:2412.02021, Eq. (13).
    A. C. Atkinson, A. N. Donev, R. D. Tobias, Optimum Experimental Designs, Oxford 2007, ch. 10
    (D-optimality) and 17 (errors of single parameters).

    Examples
    --------
    Against the paper's five radii, as many cuts between the same limits have errors that are
    1.19 times (toughness) and 1.25 times (wear strength) smaller, worth 1.4 and 1.6 times as many
    cuts. All five cuts at the ends would give 1.17 and 1.37, but could not test the line.

    >>> paper = [0.125e-3, 0.210e-3, 0.275e-3, 0.390e-3, 0.470e-3]
    >>> design = design_radii(min(paper), max(paper), cuts=5, force_std=0.5)
    >>> print(design.wire_radius)
    [0.000125  0.000125  0.0002975 0.00047   0.00047  ]
    >>> print("{:.3f} {:.3f}".format(*design.gain_over(paper)))
    1.189 1.250
    """
    noise = _noise(force_std, relative_force_std, expected)
    smallest = one_number(WIRE_RADIUS, smallest_radius)
    largest = one_number(WIRE_RADIUS, largest_radius)
    if not smallest < largest:
        raise InputError(
            f"the range from smallest_radius = {smallest!r} m to largest_radius = {largest!r} m is "
            "empty; give two different radii, the smaller one first."
        )
    cuts = whole_number("cuts", cuts)
    line_test_cuts = whole_number("line_test_cuts", line_test_cuts)
    ends = cuts - line_test_cuts
    if line_test_cuts < 0 or ends < 2 or cuts > MOST_CUTS:
        raise InputError(
            f"cuts = {shown(cuts)} with line_test_cuts = {shown(line_test_cuts)} leaves "
            f"{shown(ends)} for the ends of the range, where 2 are needed and {MOST_CUTS} are the "
            "most; change either number."
        )
    groups = np.array([smallest, 0.5 * (smallest + largest), largest])
    at_smallest = np.arange(1, ends)
    counts = np.stack([at_smallest, np.full(ends - 1, line_test_cuts), ends - at_smallest])
    weight = counts / noise.std(groups)[:, np.newaxis] ** 2
    loss = _loss(goal, weight, groups / largest)
    radii = np.repeat(groups, counts[:, np.argmin(loss)])
    return Design(radii, *_standard_errors(radii, noise), noise)


def _noise(
    force_std: float | None, relative_force_std: float | None, expected: Scene | None
) -> Noise:
    if (force_std is None) == (relative_force_std is None):
        raise InputError(
            "exactly one of force_std and relative_force_std is needed; give the scatter of one "
            "cut in N/m, or as a fraction of its force."
        )
    if expected is not None:
        require_scene(expected, "expected")
        if replace(expected, wire_radius=1.0).shape != ():
            raise InputError(
                "expected must be one material, but holds arrays; give a scene of numbers."
            )
    if force_std is not None:
        return Noise(one_number(FORCE_STD, force_std), None, expected)
    if expected is None:
        raise InputError(
            "relative_force_std needs expected, the scene whose forces it is a fraction of; "
            "give it, or force_std in N/m."
        )
    return Noise(None, one_number(RELATIVE_FORCE_STD, relative_force_std), expected)


def whole_number(name: str, value: object) -> int:
    """Return a validated number of cuts.

    Examples
    --------
    >>> whole_number("cuts", 8)
    8
    """
    try:
        if not isinstance(value, bool):
            return operator.index(value)  # type: ignore[arg-type]
    except TypeError:
        pass
    raise InputError(
        f"{name} must be a whole number, but {name} = {shown(value)} ({type(value).__name__}); "
        "give the number of cuts."
    )


def _loss(goal: str, weight: Array, radius: Array) -> Array:
    """Return what to minimise, up to a factor, for each column of weights of the radii.

    The determinant of the normal equations is a sum over pairs of radii, all terms positive.
    """
    zeroth, second = weight.sum(axis=0), radius**2 @ weight
    determinant = sum(
        weight[i] * weight[j] * (radius[i] - radius[j]) ** 2 for i in range(3) for j in range(i)
    )
    numerators = {"both": np.ones_like(zeroth), "toughness": second, "wear_strength": zeroth}
    if not isinstance(goal, str) or goal not in numerators:
        raise InputError(f"goal is {shown(goal)}; choose one of {', '.join(numerators)}.")
    return np.asarray(numerators[goal] / determinant)


def _standard_errors(wire_radius: Array, noise: Noise) -> tuple[float, float]:
    """Return the standard errors of Gamma_o [J/m2] and tau_w [Pa] of Eq. (13)."""
    friction = 0.0 if noise.expected is None else float(noise.expected.friction_coefficient)
    columns, _ = linear_form("eq13", wire_radius, 1.0, friction)
    fit = solve_least_squares(columns / noise.std(wire_radius)[:, np.newaxis], wire_radius)
    toughness, wear_strength = np.sqrt(np.diag(fit.covariance))
    return float(toughness), float(wear_strength)

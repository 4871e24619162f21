"""Which of the wires that are sold to cut with, under any force model, and what they promise."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from surrogate.basics.checks import Quantity, one_number, shown
from surrogate.basics.records import Shown
from surrogate.choosing.accuracy import one_model
from surrogate.choosing.by_name import AUTO, force_model
from surrogate.choosing.laws import PROJECTED, of_law
from surrogate.contact.base import ForceModel
from surrogate.errors import InputError
from surrogate.identification.experiment_design import RELATIVE_FORCE_STD, whole_number
from surrogate.identification.fit import Identification
from surrogate.identification.further_wire import breaking_force, sold_radii
from surrogate.identification.wire_promise import (
    FEWEST_WIRES,
    Losses,
    Materials,
    covariance_of,
    exchanged,
    has_middle,
    promised,
)
from surrogate.inference.inputs import FORCE_STD, WIRE_DIAMETER, Cuts, column
from surrogate.scene import Scene, require_scene

__all__ = ["DesignedWire", "WireDesign", "design_wires"]

Array = NDArray[np.float64]

GOALS = ("both", "toughness", "wear_strength")

MOST_CUTS = 100

SAFETY = 2.0
"""Times the predicted force that a wire must carry."""

THICKNESS = Quantity("thickness", "m", "give the width of the sample along the wire", 1e-30, 1e30)


@dataclass(frozen=True)
class DesignedWire:
    """One size of wire.

    Parameters
    ----------
    diameter : float
        2 R_w [m].
    cuts : int
        How many cuts to make with it.
    dimensionless_toughness : float
        g of the expected material [-].
    force : float
        F_ss/T that is expected [N/m].
    breaking_force : float
        Force at which a steel wire breaks [N].
    """

    diameter: float
    cuts: int
    dimensionless_toughness: float
    force: float
    breaking_force: float

    @property
    def widest_sample(self) -> float:
        """Thickness T of the sample [m] up to which it carries twice the expected force."""
        return self.breaking_force / (SAFETY * self.force)


@dataclass(frozen=True, eq=False)
class WireDesign(Shown):
    """Wires to buy, and what they promise; see `design_wires`.

    Parameters
    ----------
    wires : tuple of DesignedWire
        The thinnest first.
    toughness, wear_strength : float
        What is expected [J/m2], [Pa].
    toughness_std, wear_strength_std : float
        Standard errors that the identification will have [J/m2], [Pa], its model's own error
        included: those of made-up experiments with these wires.
    first_order_std : tuple of float
        The same from the derivatives of the force at what is expected, by which the wires were
        chosen.
    model : str
        Name of the force model.
    others : tuple of (float, float, float, float)
        Toughness [J/m2] and wear strength [Pa] of what else is expected, and their standard errors
        with these wires.
    left_out : tuple of str
        Why wires that are sold were not considered, in words.

    Examples
    --------
    >>> gel = Scene(30e3, 1.6, 1e-4, wear_strength=12e3)
    >>> design = design_wires(gel, cuts=3, relative_force_std=0.05, diameters=[1e-4, 3e-4, 1e-3])
    >>> print(1e3 * design.wire_radius)  # mm
    [0.05 0.15 0.5 ]
    """

    wires: tuple[DesignedWire, ...]
    toughness: float
    wear_strength: float
    toughness_std: float
    wear_strength_std: float
    first_order_std: tuple[float, float]
    model: str | ForceModel
    others: tuple[tuple[float, float, float, float], ...] = ()
    left_out: tuple[str, ...] = ()

    @property
    def law(self) -> str:
        """The law of dissipation that is expected."""
        return force_model(self.model).law

    @property
    def wire_radius(self) -> Array:
        """R_w of each cut [m]."""
        radii = [0.5 * wire.diameter for wire in self.wires]
        return np.repeat(radii, [wire.cuts for wire in self.wires])


def design_wires(
    expected: Scene | Identification,
    cuts: int = 8,
    *,
    force_std: float | None = None,
    relative_force_std: float | None = None,
    model: str | None = None,
    rtol: float | None = None,
    diameters: ArrayLike | None = None,
    thickness: float | None = None,
    goal: str = "both",
    law: str | None = None,
) -> WireDesign:
    """Choose wires and the number of cuts with each, so that identification errs least.

    Of the wires that are sold those are considered that carry twice the force and whose g is within
    the model's range for the first material, and not above it for any that is expected. The cuts
    are exchanged among them until the standard errors to first order, averaged over all materials,
    fall no further (D-optimal for "both"); one cut at least stays in the middle, because two forces
    lie on every curve. What is promised comes from made-up experiments with the wires chosen.

    Parameters
    ----------
    expected : Scene or Identification
        A guess, whose toughness and wear strength may be arrays of several, the likeliest first
        (its wire radius plays no part); or an earlier result, with all that its forces admit.
    cuts : int, default 8
        How many in all, from 3 to 100.
    force_std : float
        Scatter of one cut, the same for every wire [N/m]; or give the next.
    relative_force_std : float
        Scatter of one cut as a fraction of its force [-].
    model : str, optional
        Any force model that has wear; that of the earlier result, or "auto".
    rtol : float, optional
        Relative error of A and B that will do with "auto" [-]; by default 0.02 where a model is as
        exact, else that of the most exact one.
    diameters : array_like, optional
        Sizes to choose from [m]; those commonly sold, 20 um to 2 mm, by default.
    thickness : float, optional
        Thickness T of the sample [m], to leave out wires that would break.
    goal : {"both", "toughness", "wear_strength"}, default "both"
        Whose error to make small.
    law : str, optional
        The law of dissipation, "projected", "slip" or "coupled", of what is expected; by default
        that of the earlier result or of the scene's parameters, and else "projected". Under
        "coupled" only wires to whose forces coupled solutions reach are considered.

    Returns
    -------
    WireDesign
        Wires, cuts, expected forces and the standard errors that they promise.

    Raises
    ------
    InputError
        If a number is out of range, both or neither kind of scatter is given, or no thin,
        thick and middle wires are left to choose from.
    UnknownModelError, DomainError, AccuracyError
        As `identify`.

    Notes
    -----
    Range of validity: that of the model. The promise is for the first material; those for what else
    is expected are in `others`.

    References
    ----------
    A. C. Atkinson, A. N. Donev, R. D. Tobias, Optimum Experimental Designs, Oxford 2007, ch. 10,
    12 (exchange) and 18 (expectation over a prior).

    Examples
    --------
    >>> gel = Scene(30e3, 1.6, 1e-4, wear_strength=12e3)
    >>> design = design_wires(gel, cuts=8, relative_force_std=0.05)
    >>> sum(wire.cuts for wire in design.wires), len(design.wires) >= 3
    (8, True)
    """
    materials, chosen = _materials(expected, model, rtol, law)
    noise = _noise(force_std, relative_force_std)
    count = _checked_count(cuts, goal)
    radius, left_out = _candidates(materials, chosen, diameters, thickness)
    picked = exchanged(Losses(materials, chosen, radius, noise, goal), count)
    radii = np.sort(radius[picked])
    std, *others = (
        promised(materials, chosen, radii, noise, which)
        for which in range(materials.toughness.size)
    )
    expectations = zip(materials.toughness[1:], materials.wear_strength[1:], others, strict=True)
    first = covariance_of(materials, chosen, radii, noise, 0)
    return WireDesign(
        wires=tuple(_wires(materials, chosen, radii)),
        toughness=float(materials.toughness[0]),
        wear_strength=float(materials.wear_strength[0]),
        toughness_std=std[0],
        wear_strength_std=std[1],
        first_order_std=(float(np.sqrt(first[0, 0])), float(np.sqrt(first[1, 1]))),
        model=chosen,
        others=tuple((float(gamma), float(tau), *errors) for gamma, tau, errors in expectations),
        left_out=left_out,
    )


def _wires(materials: Materials, model: str | ForceModel, radii: Array) -> Iterator[DesignedWire]:
    for radius, count in zip(*np.unique(radii, return_counts=True), strict=True):
        one = np.array([radius])
        yield DesignedWire(
            diameter=2.0 * float(radius),
            cuts=int(count),
            dimensionless_toughness=float(materials.g(one)[0, 0]),
            force=float(materials.forces(model, one)[0, 0]),
            breaking_force=breaking_force(float(radius)),
        )


def _materials(
    expected: Scene | Identification,
    model: str | ForceModel | None,
    rtol: float | None,
    law: str | None,
) -> tuple[Materials, str | ForceModel]:
    """Return what is expected and the model, by its name where the law is the projected one."""
    if isinstance(expected, Identification):
        own = model is None and law is None
        named = force_model(expected.model).name if model is None else model
        chosen = (
            expected.model if own else _under(named, expected.law if law is None else law, rtol)
        )
        if "shear_modulus" in expected.assumed:
            raise InputError(
                "expected must have a shear modulus, but none was given to identify; give it there."
            )
        toughness, wear = _admitted(expected)
        return Materials(toughness, wear, expected.cuts), chosen
    require_scene(expected, "expected")
    own_law = expected.law or PROJECTED
    chosen = _under(AUTO if model is None else model, own_law if law is None else law, rtol)
    solid = (expected.shear_modulus, expected.friction_coefficient, expected.stiffening_exponent)
    if not all(isinstance(value, float) for value in solid):
        raise InputError(
            "expected must have one modulus, friction coefficient and stiffening exponent, but "
            "has arrays; give numbers, and arrays of toughness and wear strength only."
        )
    toughness, wear = (
        np.ravel(value) for value in np.broadcast_arrays(expected.toughness, expected.wear_strength)
    )
    if not toughness.size or not np.all(toughness > 0.0) or not np.all(wear > 0.0):
        raise InputError(
            "expected must have a toughness and a wear strength above 0, but has 0; guess both."
        )
    one = np.ones(1)
    return Materials(toughness, wear, Cuts(one, one, None, *map(float, solid))), chosen  # type: ignore[arg-type]


def _under(model: str | ForceModel, law: str, rtol: float | None) -> str | ForceModel:
    """Return a model under a law, by its name where that is the projected one."""
    lawful = one_model(of_law(model, law), rtol)
    return lawful.name if law == PROJECTED else lawful


def _admitted(fit: Identification) -> tuple[Array, Array]:
    """Return materials that an identification admits: the estimate, other minima and the ends."""
    pairs = [(fit.toughness, fit.wear_strength)]
    if fit.profile is not None:
        pairs += [(m.toughness, m.wear_strength) for m in fit.profile.modes[1:] if m.admitted]
        gamma, low, high = fit.profile.admitted
        for place in (0, -1) if gamma.size else ():
            pairs.append((float(gamma[place]), float(0.5 * (low[place] + high[place]))))
    else:
        (low_gamma, high_gamma), (low_tau, high_tau) = (
            fit.toughness_interval,
            fit.wear_strength_interval,
        )
        pairs += [(low_gamma, high_tau), (high_gamma, low_tau)]
    values = np.array([pair for pair in pairs if min(pair) > 0.0 and np.all(np.isfinite(pair))])
    if not values.size or tuple(values[0]) != pairs[0]:
        raise InputError(
            f"expected must have a toughness and a wear strength above 0, but has "
            f"{fit.toughness:.4g} J/m2 and {fit.wear_strength:.4g} Pa; give a guess instead."
        )
    return values[:, 0], values[:, 1]


def _noise(force_std: float | None, relative: float | None) -> tuple[float, float]:
    """Return the constant [N/m] and the proportional [-] scatter of one cut; one is 0."""
    if (force_std is None) == (relative is None):
        raise InputError(
            "exactly one of force_std and relative_force_std is needed; give the scatter of one "
            "cut in N/m, or as a fraction of its force."
        )
    if force_std is not None:
        return one_number(FORCE_STD, force_std), 0.0
    return 0.0, one_number(RELATIVE_FORCE_STD, relative)


def _checked_count(cuts: int, goal: str) -> int:
    count = whole_number("cuts", cuts)
    if not FEWEST_WIRES <= count <= MOST_CUTS:
        raise InputError(
            f"cuts must be from {FEWEST_WIRES} to {MOST_CUTS}, but cuts = {shown(cuts)}; give how "
            "many you will make in all."
        )
    if not isinstance(goal, str) or goal not in GOALS:
        raise InputError(f"goal is {shown(goal)}; choose one of {', '.join(GOALS)}.")
    return count


def _candidates(
    materials: Materials,
    model: str | ForceModel,
    diameters: ArrayLike | None,
    thickness: float | None,
) -> tuple[Array, tuple[str, ...]]:
    """Return the radii to choose from, and why others are not."""
    if diameters is None:
        radius = sold_radii(0.0, np.inf)
    else:
        radius = np.unique(0.5 * column(WIRE_DIAMETER, diameters))
    g = materials.g(radius)
    low, high = force_model(model).ends(materials.cuts.stiffening_exponent)
    # below its range a model is continued with a small error, and what may be near 0 is there
    inside = np.all(g <= high, axis=0) & (g[0] >= low)
    left_out = list(_named(radius, inside, f"g is beyond the range of model '{model}'"))
    holds = np.ones_like(inside)
    if thickness is not None:
        force = one_number(THICKNESS, thickness) * materials.forces(model, radius).max(axis=0)
        holds = np.array([breaking_force(r) for r in radius]) >= SAFETY * force
        left_out += _named(radius, holds, "a steel wire would not carry twice the force")
    known = materials.reached(model, radius)
    left_out += _named(radius, known, "no coupled solution is near their friction and wear")
    radius = radius[inside & holds & known]
    if not has_middle(radius):
        raise InputError(
            f"{radius.size} wires are left to choose from, where three are needed: a thin one, a "
            "thick one and one between"
            + "".join(f"; {words}" for words in left_out)
            + ": give other diameters, a thinner sample, a narrower guess, or model='eq13'."
        )
    return radius, tuple(left_out)


def _named(radius: Array, kept: NDArray[np.bool_], reason: str) -> Iterator[str]:
    if np.all(kept):
        return
    if not np.any(kept):
        yield f"all {radius.size} wires were left out: {reason}"
        return
    low, high = radius[kept].min(), radius[kept].max()
    sides = [
        f"{words} than {2e3 * end:.3g} mm"
        for words, end, outside in (
            ("thinner", low, radius < low),
            ("thicker", high, radius > high),
        )
        if np.any(outside)
    ]
    yield f"wires {' or '.join(sides) or 'between'} were left out: {reason}"

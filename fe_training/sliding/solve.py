"""Configurations of a wire that rubs and wears, by toughness, friction and wear."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from copy import copy
from math import isfinite

from fe_training.sliding.cut import SlidingCut, SlidingEndError
from fe_training.sliding.leg import Point
from fe_training.sliding.path import SlidingStalledError, Steps
from fe_training.sliding.record import SlidingOutcome, SlidingRecord
from fe_training.sliding.shear import Load
from fe_training.solver.cut import Cut, Settings
from fe_training.solver.path import PathStalledError
from fe_training.solver.solve import ALPHA_RANGE, G_RANGE, frictionless_state
from fe_training.solver.state import State
from surrogate.errors import InputError

#: Friction and wear that the engine is made for, from 0.
MOST_FRICTION, MOST_WEAR, MOST_TAPER = 5.0, 100.0, 10.0

#: Radii of the notch from which the tip is a tip and the wire touches the face beyond it [R_w].
NOTCH_RANGE = 1e-6, 0.1

_STEPS = Steps(first=0.02, largest=0.5, smallest=1e-2)

Report = Callable[[SlidingRecord], None]


def _checked(name: str, value: float, low: float, high: float) -> float:
    value = float(value)
    if not (isfinite(value) and low <= value <= high):
        raise InputError(
            f"{name} = {value:.6g} is outside what the engine is made for, {low:g} to {high:g}"
        )
    return value


def _load(friction: float, wear: float, taper: float = 0.0) -> Load:
    return Load(
        _checked("friction_coefficient", friction, 0.0, MOST_FRICTION),
        _checked("relative_wear_strength", wear, 0.0, MOST_WEAR),
        taper,
    )


def solve_rays(
    alpha: float,
    g: float,
    rays: Sequence[Sequence[tuple[float, float]]],
    settings: Settings | None = None,
    report: Report | None = None,
    taper: float = 0.0,
) -> list[SlidingRecord]:
    """Return the configurations along several ways from the frictionless one at one g.

    Parameters
    ----------
    alpha : float
        Strain-stiffening exponent [-], 1 to 20.
    g : float
        J/(mu R_w) [-], held while the load grows.
    rays : sequence of sequences of (float, float)
        On each way the values of (xi, tau_w/mu) that are wanted, passed in this order.
    settings : Settings, optional
        Mesh, body, solver.
    report : callable, optional
        Called with each record as soon as it is finished.
    taper : float
        How gently wear rises at the ends of the contact, see
        :class:`fe_training.sliding.shear.Load` [-].

    Returns
    -------
    list of SlidingRecord
        One for each load, way after way.  Those that a way did not reach have its outcome and
        reason, and the numbers of its last equilibrium.

    Raises
    ------
    InputError
        If a value is outside the range of the engine.
    """
    alpha, g = _checked("alpha", alpha, *ALPHA_RANGE), _checked("g", g, *G_RANGE)
    taper = _checked("taper", taper, 0.0, MOST_TAPER)
    settings = settings or Settings()
    _checked("notch_radius", settings.notch_radius, *NOTCH_RANGE)
    ways = [[Point(g, _load(*pair, taper)) for pair in ray] for ray in rays]
    records: list[SlidingRecord] = []

    def tell(record: SlidingRecord) -> None:
        records.append(record)
        if report is not None:
            report(record)

    begun, reason = _begun(alpha, g, settings)
    for way in ways:
        if begun is None:
            for point in way:
                tell(_unreached(alpha, point, reason))
            continue
        cut, state = begun
        _follow(SlidingCut(copy(cut), state, taper), way, tell)
    return records


def _begun(alpha: float, g: float, settings: Settings) -> tuple[tuple[Cut, State] | None, str]:
    """Return the frictionless configuration, or why there is none."""
    try:
        begun = frictionless_state(alpha, g, settings)
    except PathStalledError as error:
        return None, str(error)
    return begun, "no mesh had the wire in its fine part"


def _unreached(alpha: float, point: Point, reason: str) -> SlidingRecord:
    return SlidingRecord(
        alpha=alpha,
        target=point.g,
        target_friction=point.load.friction,
        target_wear=point.load.wear,
        outcome=SlidingOutcome.NOT_REACHED,
        reason=reason,
    )


def _follow(sliding: SlidingCut, way: Sequence[Point], tell: Report) -> None:
    """Report the record of each point of a way."""
    held, end = sliding.point.g, None
    for target in way:
        if end is None:
            point = Point(held, target.load)
            try:
                for _ in sliding.moved(point, _STEPS):
                    pass
            except SlidingEndError as error:
                end = error
            except SlidingStalledError as error:
                end = SlidingEndError(SlidingOutcome.STALLED, str(error))
        if end is None:
            tell(sliding.record(target))
        else:
            tell(sliding.failure(target, end))


def solve(
    alpha: float,
    *,
    g: float,
    friction_coefficient: float = 0.0,
    relative_wear_strength: float = 0.0,
    settings: Settings | None = None,
    taper: float = 0.0,
) -> SlidingRecord:
    """Return one configuration of a wire that rubs and wears.

    Parameters
    ----------
    alpha : float
        Strain-stiffening exponent [-], 1 to 20.
    g : float
        J/(mu R_w) [-].
    friction_coefficient : float
        xi [-].
    relative_wear_strength : float
        tau_w/mu [-].
    settings : Settings, optional
        Mesh, body, solver.
    taper : float
        How gently wear rises at the ends of the contact, see
        :class:`fe_training.sliding.shear.Load` [-].

    Returns
    -------
    SlidingRecord
        Its outcome says whether there is steady sliding at this load.

    Raises
    ------
    InputError
        If a value is outside the range of the engine.
    """
    way = [(friction_coefficient, relative_wear_strength)]
    return solve_rays(alpha, g, [way], settings, taper=taper)[0]

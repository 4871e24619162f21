"""Configurations of the wire in the crack, by distance, by insertion or by energy release rate.

Two branches meet at a distance of about two wire radii.  Close to the tip (indentation) the wire is
raised once and then driven along the cut on one mesh.  Far from the tip it is raised afresh at
each distance, on a mesh that is fine below it.  The branch is chosen here.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace

from fe_training.mechanics.analytic import (
    far_field_wedge,
    far_field_wedge_from_energy_release_rate,
)
from fe_training.mechanics.mesh import MeshSpec
from fe_training.solver import path
from fe_training.solver.adapt import ends_are_sharp
from fe_training.solver.cut import Cut, Settings
from fe_training.solver.equilibrium import Control, State, control_value
from fe_training.solver.guide import Guide
from fe_training.solver.path import PathStalledError, Steps
from fe_training.solver.record import Outcome, Record
from surrogate.errors import InputError

#: Stiffening exponents and dimensionless toughnesses that the engine is made for.
ALPHA_RANGE, G_RANGE = (1.0, 20.0), (1e-5, 1e4)

#: Reference position at which the wire is raised on the indentation branch [R_w].
_START = -2.2
_APPROACH = Steps(0.1, 0.2)

#: Step along the cut after the tip is touched, relative to the way gone so far.
_PUSH_FIRST, _PUSH_LARGEST = 0.08, 0.15

#: Half width of the fine part of a far-field mesh [R_w].
_WINDOW = 1.6
_TRIES = 4

#: Far from the tip 2 F_h is a small difference of large forces: elements grow more slowly away from
#: the contact, and those at its ends are split this often: the first time may leave 6e-3 of F_h.
_FAR_FIELD_GROWTH, _SHARPENINGS = 0.25, 2

#: Below this g the wire is raised afresh without trying the indentation branch.
_SURELY_FAR = 0.15

#: The mesh that mesh errors are measured with, and how near in g the two solutions have to be.
_COARSER, _SAME_G = 1.5, 1e-5


def _checked(name: str, value: float, low: float, high: float, unit: str) -> float:
    value = float(value)
    if not low <= value <= high:
        raise InputError(
            f"{name} = {value:.6g} {unit} is outside what the engine is made for, "
            f"{low:g} to {high:g} {unit}"
        )
    return value


def indentation_cut(alpha: float, settings: Settings) -> Cut:
    """Return the body on the mesh of the indentation branch."""
    spec = MeshSpec(
        notch_radius=settings.notch_radius,
        outer_radius=settings.outer_radius,
        sectors=settings.sectors,
        contact_end=3.6,
        contact_spacing=settings.contact_spacing,
    )
    return Cut(alpha, spec, settings)


def far_field_cut(alpha: float, depth: float, settings: Settings) -> Cut:
    """Return the body on a mesh that is fine around the distance `depth` from the tip [R_w]."""
    spec = MeshSpec(
        notch_radius=min(5e-4 * depth, 0.02),
        outer_radius=settings.outer_radius,
        sectors=settings.sectors,
        contact_start=max(depth - _WINDOW, 0.0),
        contact_end=depth + _WINDOW,
        contact_spacing=settings.contact_spacing,
        growth=_FAR_FIELD_GROWTH,
    )
    return Cut(alpha, spec, replace(settings, polar=0.0))


def indentation_states(cut: Cut) -> Iterator[State]:
    """Yield the states of the indentation branch without end, from the raised wire inwards."""
    state = cut.raised(_START)
    yield state
    while True:
        here = float(state.centre[0])
        if here < 2.0:
            end, steps = 2.0, _APPROACH
        else:
            end, steps = 1.5 * here, Steps(_PUSH_FIRST * here, _PUSH_LARGEST * here)
        for reached in cut.moved(state, Control.POSITION, end, steps):
            yield reached
            state = reached


def _indentation(
    alpha: float,
    targets: list[float],
    settings: Settings,
    report: Callable[[Record], None],
    shift: bool,
) -> tuple[list[Record], list[float]]:
    """Return the records at rising values of g, and the values below the start of the branch."""
    cut = indentation_cut(alpha, settings)
    records: list[Record] = []
    below: list[float] = []
    waiting = deque(sorted(targets))
    try:
        guide = Guide(cut, _START)
        while waiting and waiting[0] < guide.start:
            below.append(waiting.popleft())
        while waiting:
            state = guide.at(waiting[0])
            records.append(cut.record(state, waiting.popleft(), shift))
            report(records[-1])
    except PathStalledError as error:
        for g in waiting:
            records.append(cut.failure(error, g))
            report(records[-1])
    return records, below


def _far_field(alpha: float, g: float, settings: Settings, shift: bool) -> Record:
    """Return the record at a small g: found on a rough mesh, then solved on a fine one."""
    cut = far_field_cut(alpha, _far_depth(g), settings)
    try:
        reached = far_field_state(cut, g)
        if reached is None:
            reason = f"g = {g:.6g}: no mesh had the wire in its fine part after {_TRIES} tries"
            return Record(alpha=alpha, outcome=Outcome.NOT_REACHED, target=g, reason=reason)
        cut, state = reached
        return cut.record(state, g, shift)
    except PathStalledError as error:
        return cut.failure(error, g)


def _far_depth(g: float) -> float:
    return float(far_field_wedge_from_energy_release_rate(g).distance) - 0.4


def far_field_state(cut: Cut, g: float) -> tuple[Cut, State] | None:
    """Return the body and its state at a small g; None where no mesh fits the wire's position."""
    alpha, settings, depth = cut.body.alpha, cut.settings, _far_depth(g)
    for _ in range(_TRIES):
        rough = cut.rough() or cut
        state = rough.raised(-depth)
        wanted = depth + _way_to(rough, state, g)
        if abs(wanted - depth) < 0.5 * _WINDOW:
            break
        depth, cut = wanted, far_field_cut(alpha, wanted, settings)
    else:
        return None
    state = _landed(rough, state, g)
    cut = far_field_cut(alpha, -float(state.centre[0]), settings)
    state = _landed(cut, cut.sharply_taken_over(rough, state, _SHARPENINGS), g)
    if not ends_are_sharp(cut.body, state):
        state = cut.sharpened(state, Control.POSITION, _SHARPENINGS)
    return cut, state


def frictionless_state(alpha: float, g: float, settings: Settings) -> tuple[Cut, State] | None:
    """Return a body and its state at J = g on either branch; None where no mesh fits.

    Raises
    ------
    PathStalledError
        If the path to it stalled.
    """
    if g >= _SURELY_FAR:
        cut = indentation_cut(alpha, settings)
        guide = Guide(cut, _START)
        if guide.start <= g:
            return cut, guide.at(g)
    return far_field_state(far_field_cut(alpha, _far_depth(g), settings), g)


def _way_to(cut: Cut, state: State, g: float) -> float:
    """Return how much farther from the tip J is g, if J goes on as the linear wedge's does."""
    here = control_value(cut.body, state, Control.DISTANCE)
    linear = float(far_field_wedge(here).energy_release_rate)
    ratio = cut.energy_release_rate(state) / linear
    return float(far_field_wedge_from_energy_release_rate(g / ratio).distance) - here


def _landed(cut: Cut, state: State, g: float) -> State:
    """Return the state with J = g, near a state on the far-field branch."""
    J, position = cut.energy_release_rate(state), float(state.centre[0])
    if abs(J / g - 1.0) < cut.settings.tolerance:
        return state
    # a second, estimated point farther from the goal than the first: only its slope is used
    points = [(position, J), (position - 3.0 * _way_to(cut, state, g), J * (g / J) ** 3)]
    solver, tolerance = cut.solver, cut.settings.tolerance
    measure = cut.energy_release_rate
    return path.land(cut.body, state, Control.POSITION, measure, g, points, solver, tolerance)


def solve_path(
    alpha: float,
    g: Iterable[float],
    settings: Settings | None = None,
    report: Callable[[Record], None] | None = None,
    shift: bool = False,
    mesh_error: bool = False,
) -> list[Record]:
    """Return the configurations at several energy release rates, J = g mu R_w.

    Parameters
    ----------
    alpha : float
        Strain-stiffening exponent [-], 1 to 20; verified from 2 to 9.
    g : iterable of float
        Wanted values of J/(mu R_w) [-]; verified from 2.5e-3 to 100.
    settings : Settings, optional
        Mesh, body, solver.
    report : callable, optional
        Called with each record as soon as it is finished.
    shift : bool
        Add -2 dU/dc by a true shift of the tip, at the cost of two more equilibria each.
    mesh_error : bool
        Add the relative difference of F_v from the same configuration on a mesh 1.5 times coarser,
        which is solved first; both then meet g within 1e-5.

    Returns
    -------
    list of Record
        One for each value, in rising order of g.  A configuration that was not reached has its
        outcome and reason.

    Raises
    ------
    InputError
        If `alpha` or a value of `g` is outside the range of the engine.
    """
    settings = settings or Settings()
    alpha = _checked("alpha", alpha, *ALPHA_RANGE, "[-]")
    targets = sorted(_checked("g", value, *G_RANGE, "[-]") for value in g)
    report = report or (lambda record: None)
    if mesh_error:
        settings = replace(settings, tolerance=min(settings.tolerance, _SAME_G))
        coarser = solve_path(alpha, targets, settings.refined(1.0 / _COARSER))
        loads = {record.target: record.vertical_force for record in coarser}

        def compared(record: Record) -> Record:
            error = abs(loads[record.target] / record.vertical_force - 1.0)
            return replace(record, mesh_error=error)

        tell = report
        records = solve_path(alpha, targets, settings, lambda record: tell(compared(record)), shift)
        return [compared(record) for record in records]
    far = [value for value in targets if value < _SURELY_FAR]
    near = targets[len(far) :]
    inner, below = _indentation(alpha, near, settings, report, shift) if near else ([], [])
    outer: list[Record] = []
    for value in far + below:
        outer.append(_far_field(alpha, value, settings, shift))
        report(outer[-1])
    return outer + inner


def solve(
    alpha: float,
    *,
    g: float | None = None,
    distance: float | None = None,
    insertion: float | None = None,
    settings: Settings | None = None,
    shift: bool = False,
    mesh_error: bool = False,
) -> Record:
    """Return one configuration.

    Parameters
    ----------
    alpha : float
        Strain-stiffening exponent [-].
    g : float
        Wanted J/(mu R_w) [-]; or
    distance : float
        wanted deformed distance delta from the wire's centre to the tip [R_w], above 1; or
    insertion : float
        wanted position x_w of the wire's centre relative to the reference tip [R_w].
    settings : Settings, optional
        Mesh, body, solver.
    shift : bool
        Add -2 dU/dc by a true shift of the tip, at the cost of two more equilibria.
    mesh_error : bool
        Add the relative difference of F_v on a coarser mesh at the same g, see :func:`solve_path`;
        only where g is given.

    Returns
    -------
    Record

    Raises
    ------
    InputError
        If not exactly one of the three is given, or one is outside the range of the engine.
    """
    given = [x for x in (g, distance, insertion) if x is not None]
    if len(given) != 1:
        raise InputError(
            f"solve needs exactly one of g, distance and insertion; {len(given)} were given"
        )
    if g is not None:
        return solve_path(alpha, [g], settings, shift=shift, mesh_error=mesh_error)[0]
    if mesh_error:
        raise InputError("mesh_error compares two meshes at one g; give g instead")
    settings = settings or Settings()
    alpha = _checked("alpha", alpha, *ALPHA_RANGE, "[-]")
    if distance is not None:
        distance = _checked("distance", distance, 1.0 + 1e-3, 1e3, "[R_w]")
        return _solve_to(alpha, Control.DISTANCE, distance, -(distance - 0.5), settings, shift)
    assert insertion is not None
    insertion = _checked("insertion", insertion, -1e3, 1e4, "[R_w]")
    return _solve_to(alpha, Control.POSITION, insertion, insertion, settings, shift)


def _solve_to(
    alpha: float,
    control: Control,
    target: float,
    position: float,
    settings: Settings,
    shift: bool,
) -> Record:
    """Return the record at a target of a control; `position` is about where the wire will be."""
    if position < _START - 0.3:
        cut = far_field_cut(alpha, -position, settings)
        try:
            state = cut.last(cut.raised(position), control, target, _APPROACH)
            return cut.record(cut.sharpened(state, control, _SHARPENINGS), shift=shift)
        except PathStalledError as error:
            return cut.failure(error)
    cut = indentation_cut(alpha, settings)
    previous: State | None = None
    sign = 1.0 if control is Control.POSITION else -1.0
    try:
        for state in indentation_states(cut):
            if sign * (control_value(cut.body, state, control) - target) >= 0:
                start = previous or state
                return cut.record(cut.last(start, control, target, _APPROACH), shift=shift)
            previous = state
    except PathStalledError as error:
        return cut.failure(error)
    raise AssertionError("the indentation branch has no end")

"""Configurations of the wire in the crack, by distance, by insertion or by energy release rate.

Two branches meet at a distance of about two wire radii.  Close to the tip (indentation) the wire is
raised once and then driven along the cut on one mesh.  Far from the tip it is raised afresh at
each distance, on a mesh that is fine below it.  The branch is chosen here.
"""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from surrogate.errors import InputError

from . import observe, path
from .body import Body
from .energy_release import domain_integral, strain_energy
from .equilibrium import Control, NewtonOutcome, State, control_value, undeformed
from .mesh import MeshSpec, crack_mesh
from .path import PathStalledError, Steps
from .record import Outcome, Record
from .reference import far_field_wedge, far_field_wedge_from_energy_release_rate
from .solvers import LinearSolver, make_solver

#: Stiffening exponents and dimensionless toughnesses that the engine is made for.
ALPHA_RANGE, G_RANGE = (1.0, 20.0), (1e-5, 1e4)

_RAISE = Steps(0.1, 0.15)
#: Reference position at which the wire is raised on the indentation branch [R_w].
_START = -1.2
_APPROACH = Steps(0.1, 0.2)
#: Step along the cut after the tip is touched, relative to the way gone so far.
_PUSH_FIRST, _PUSH_LARGEST = 0.08, 0.15
#: Half width of the fine part of a far-field mesh [R_w].
_WINDOW = 2.2
_TRIES = 4
#: The far-field contact is meshed more finely: there 2 F_h is a small difference of large forces.
_FAR_FIELD_SPACING = 0.5
#: Below this g the wire is raised afresh without trying the indentation branch.
_SURELY_FAR = 0.3
#: Share of B that a truncation at L takes away is taken to be this times sqrt(g R_w / L); assumed,
#: not yet measured with this engine.
TRUNCATION_FACTOR = 0.5


@dataclass(frozen=True, slots=True)
class Settings:
    """How finely and with what a configuration is solved.

    Parameters
    ----------
    sectors : int
        Sectors of the mesh over the half circle.
    contact_spacing : float
        See :class:`fe_training.mesh.MeshSpec`.
    notch_radius : float
        Radius of the notch on the indentation branch [R_w].
    outer_radius : float
        Radius of the body [R_w].
    bulk : float
        Bulk term beside the pressure [mu]; without it elements fold in the sheared layer behind
        the contact at high toughness.
    solver : str or None
        Linear solver; the fastest one installed by default.
    tolerance : float
        Relative error allowed in the wanted value of g.
    """

    sectors: int = 24
    contact_spacing: float = 0.1
    notch_radius: float = 5e-4
    outer_radius: float = 1e7
    bulk: float = 1.0
    solver: str | None = None
    tolerance: float = 1e-4

    def refined(self, factor: float = 1.5) -> Settings:
        """Return settings with elements smaller by `factor`."""
        return replace(
            self,
            sectors=round(self.sectors * factor),
            contact_spacing=self.contact_spacing / factor,
        )


class Cut:
    """A body of one material on one mesh, with what is needed to make records of its states.

    Parameters
    ----------
    alpha : float
        Strain-stiffening exponent [-].
    spec : MeshSpec
        The mesh.
    settings : Settings
        Bulk term and solver.
    """

    def __init__(self, alpha: float, spec: MeshSpec, settings: Settings) -> None:
        self.spec, self.settings = spec, settings
        self.body = Body(crack_mesh(spec), alpha, settings.bulk)
        self.solver: LinearSolver = make_solver(settings.solver)
        self._clock = time.perf_counter()

    def raised(self, position: float) -> State:
        """Return the state with the wire raised to the symmetry plane at `position`."""
        return self.last(undeformed(self.body, position), Control.HEIGHT, 0.0, _RAISE)

    def last(self, state: State, control: Control, end: float, steps: Steps) -> State:
        """Return the last state of a path."""
        reached = deque(path.follow(self.body, state, control, end, steps, self.solver), maxlen=1)
        return reached.pop() if reached else state

    def supports(self, state: State) -> list[tuple[float, float]]:
        """Return the supports of the domain integrals, nearest first.

        The first is free of contact wherever there is room between the notch and the contact.
        """
        r0 = self.spec.notch_radius
        near = 40.0 * r0
        touching = self.body.face[state.active.wire]
        if len(touching):
            contact = float(np.hypot(*self.body.nodes[touching[0]]))
            near = max(near, 0.5 * contact)
        far = 2.0 * max(5.0, self.spec.contact_end)
        return [(max(4.0 * r0, 0.1 * near), near), (near, far), (far, 10.0 * far)]

    def energy_release_rate(self, state: State) -> float:
        """Return J/(mu R_w) on the nearest support."""
        return domain_integral(self.body, state, *self.supports(state)[0])

    def record(self, state: State) -> Record:
        """Return the record of an equilibrium."""
        body = self.body
        J, *across = [domain_integral(body, state, *s) for s in self.supports(state)]
        arc = observe.contact_arc(body, state)
        ahead = observe.stress_ahead(body, state)
        tip = body.face[0]
        now = time.perf_counter()
        elapsed, self._clock = now - self._clock, now
        record = Record(
            alpha=body.alpha,
            outcome=Outcome.CONVERGED,
            energy_release_rate=J,
            distance=control_value(body, state, Control.DISTANCE),
            insertion=float(state.centre[0]),
            horizontal_force=state.horizontal_force,
            vertical_force=state.vertical_force,
            theta_1=arc.theta_1,
            theta_2=arc.theta_2,
            strain_energy=strain_energy(body, state),
            tip_position=float(body.nodes[tip, 0] + state.u[tip, 0]),
            energy_release_rate_across=tuple(across),
            residual=state.residual,
            iterations=state.iterations,
            min_determinant=path.least_determinant(body, state, body.beyond_notch),
            max_stretch=float(observe.principal_stretch(body, state).max()),
            touches_plane=bool(state.active.plane.any()),
            unknowns=int(body.free.sum()),
            mesh=self.spec.as_dict(),
            bulk=self.settings.bulk,
            solver=self.solver.name,
            truncation_error=TRUNCATION_FACTOR * float(np.sqrt(max(J, 0.0) / body.outer_radius)),
            wall_time=elapsed,
            pressure_angle=arc.theta,
            pressure=arc.pressure,
            ahead_reference=ahead.reference,
            ahead_deformed=ahead.deformed,
            ahead_stress=ahead.opening,
        )
        if record.within_evidence:
            return record
        return replace(record, outcome=Outcome.OUTSIDE_EVIDENCE)

    def failure(self, error: PathStalledError) -> Record:
        """Return the record of a configuration that was not reached."""
        folded = error.outcome is NewtonOutcome.CONVERGED
        return Record(
            alpha=self.body.alpha,
            outcome=Outcome.FOLDED if folded else Outcome.STALLED,
            reason=str(error),
            unknowns=int(self.body.free.sum()),
            mesh=self.spec.as_dict(),
            bulk=self.settings.bulk,
            solver=self.solver.name,
        )


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
        contact_end=2.6,
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
        contact_spacing=_FAR_FIELD_SPACING * settings.contact_spacing,
    )
    return Cut(alpha, spec, settings)


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
        for reached in path.follow(cut.body, state, Control.POSITION, end, steps, cut.solver):
            yield reached
        state = reached


def _indentation(
    alpha: float, targets: list[float], settings: Settings, report: Callable[[Record], None]
) -> tuple[list[Record], list[float]]:
    """Return the records at rising values of g, and the values below the start of the branch."""
    cut = indentation_cut(alpha, settings)
    records: list[Record] = []

    def keep(record: Record) -> None:
        records.append(record)
        report(record)

    measure = cut.energy_release_rate
    passed: list[tuple[float, float]] = []
    below: list[float] = []
    waiting = sorted(targets)
    try:
        for state in indentation_states(cut):
            passed.append((float(state.centre[0]), measure(state)))
            if len(passed) == 1:
                below = [g for g in waiting if g < passed[0][1]]
                waiting = waiting[len(below) :]
            while waiting and len(passed) > 1 and waiting[0] <= passed[-1][1]:
                g = waiting.pop(0)
                landed = path.land(
                    cut.body,
                    state,
                    Control.POSITION,
                    measure,
                    g,
                    passed[-3:],
                    cut.solver,
                    settings.tolerance,
                )
                keep(cut.record(landed))
            if not waiting:
                break
    except PathStalledError as error:
        for _ in waiting:
            keep(cut.failure(error))
    return records, below


def _far_field(alpha: float, g: float, settings: Settings, ratio: float) -> tuple[Record, float]:
    """Return the record at a small g, and J over its linear-elastic estimate.

    `ratio` is that quotient for a neighbouring g; it places the mesh.
    """
    depth = float(far_field_wedge_from_energy_release_rate(g / ratio).distance) - 0.4
    for _ in range(_TRIES):
        cut = far_field_cut(alpha, depth, settings)
        try:
            state = cut.raised(-depth)
            J = cut.energy_release_rate(state)
            # J falls about like 1/distance: where the wire should be
            wanted = depth * (J / g) ** 0.9
            if abs(wanted - depth) < 0.5 * _WINDOW:
                # a second, estimated point well away from the one wanted: only its slope is used
                slope = [(-depth, J), (-2.0 * depth, J * 0.5 ** (1 / 0.9))]
                state = path.land(
                    cut.body,
                    state,
                    Control.POSITION,
                    cut.energy_release_rate,
                    g,
                    slope,
                    cut.solver,
                    settings.tolerance,
                )
                record = cut.record(state)
                linear = far_field_wedge(record.distance).energy_release_rate
                return record, float(record.energy_release_rate / linear)
            depth = wanted
        except PathStalledError as error:
            return cut.failure(error), ratio
    failed = Record(alpha=alpha, outcome=Outcome.NOT_REACHED, reason=f"g = {g:.6g}")
    return failed, ratio


def solve_path(
    alpha: float,
    g: Iterable[float],
    settings: Settings | None = None,
    report: Callable[[Record], None] | None = None,
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
    far = [value for value in targets if value < _SURELY_FAR]
    near = targets[len(far) :]
    inner, below = _indentation(alpha, near, settings, report) if near else ([], [])
    outer: list[Record] = []
    ratio = 1.0
    for value in far + below:
        record, ratio = _far_field(alpha, value, settings, ratio)
        outer.append(record)
        report(record)
    return outer + inner


def solve(
    alpha: float,
    *,
    g: float | None = None,
    distance: float | None = None,
    insertion: float | None = None,
    settings: Settings | None = None,
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
        return solve_path(alpha, [g], settings)[0]
    settings = settings or Settings()
    alpha = _checked("alpha", alpha, *ALPHA_RANGE, "[-]")
    if distance is not None:
        distance = _checked("distance", distance, 1.0 + 1e-3, 1e3, "[R_w]")
        return _solve_to(alpha, Control.DISTANCE, distance, -(distance - 0.5), settings)
    assert insertion is not None
    insertion = _checked("insertion", insertion, -1e3, 1e4, "[R_w]")
    return _solve_to(alpha, Control.POSITION, insertion, insertion, settings)


def _solve_to(
    alpha: float, control: Control, target: float, position: float, settings: Settings
) -> Record:
    """Return the record at a target of a control; `position` is about where the wire will be."""
    if position < _START - 0.3:
        cut = far_field_cut(alpha, -position, settings)
        try:
            state = cut.raised(position)
            return cut.record(cut.last(state, control, target, _APPROACH))
        except PathStalledError as error:
            return cut.failure(error)
    cut = indentation_cut(alpha, settings)
    previous: State | None = None
    sign = 1.0 if control is Control.POSITION else -1.0
    try:
        for state in indentation_states(cut):
            if sign * (control_value(cut.body, state, control) - target) >= 0:
                start = previous or state
                return cut.record(cut.last(start, control, target, _APPROACH))
            previous = state
    except PathStalledError as error:
        return cut.failure(error)
    raise AssertionError("the indentation branch has no end")

"""A body of one material that is cut, adapted to what happens in it, and the records of its states.

The mesh is refined along the path wherever the determinant of the deformation gradient scatters too
much: at high toughness the elements around the wire are stretched a hundredfold, and where they
must be small depends on the toughness and on the material.
"""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fe_training.mechanics.body import Body
from fe_training.mechanics.mesh import MeshSpec, crack_mesh
from fe_training.solver import observe, path
from fe_training.solver.adapt import as_fine_as, determinant_scatter, refined, transferred
from fe_training.solver.energy_release import domain_integral, plateau, strain_energy
from fe_training.solver.equilibrium import (
    Control,
    NewtonOutcome,
    State,
    control_value,
    equilibrate,
    undeformed,
)
from fe_training.solver.linear_solvers import LinearSolver, make_solver
from fe_training.solver.path import PathStalledError, Steps
from fe_training.solver.record import Outcome, Record

_RAISE = Steps(0.15, 0.35)

#: The wire is raised on a mesh as coarse as this, where it takes many steps.
_ROUGH_SECTORS, _ROUGH_SPACING, _ROUGH_GROWTH = 12, 0.2, 0.5

#: First step of the horizontal force, relative to it.
_FORCE_STEP = 0.26

_CORRECTIONS = 8

#: Elements are split from this share of the scatter that is allowed, so that the next ones are
#: not due at once.
_SPLIT_SHARE = 0.5

#: Face nodes on either side of an end of the contact that belong to it.
_END = 5

#: Refinements after one step; what is left is refined after the next one.
_ROUNDS = 2

#: Refinements in a row that are tried where a path stalls.
_RESCUES = 2

#: No element becomes shorter than this, relative to its distance from the tip.
_SMALLEST = 0.02

#: Elements nearer than this to the tip, in notch radii, are not split: the notch is no crack tip.
_NOTCH_RINGS = 4.0

#: A path ends rather than take a larger body [unknowns]: some 4 GB, and minutes a value.
MOST_UNKNOWNS = 400_000

#: Half the way that the tip moves for the rate of a true shift [R_w].
_TIP_SHIFT = 0.01

#: Share of B that a truncation at L takes away is taken to be this times sqrt(g R_w / L). Bodies of
#: 1e4 to 1e6 R_w gave 0.18 to 0.32 for g of 1 to 30 and less below; this is an upper bound.
TRUNCATION_FACTOR = 0.5


@dataclass(frozen=True, slots=True)
class Settings:
    """How finely and with what a configuration is solved.

    Parameters
    ----------
    sectors : int
        Sectors of the mesh over the half circle.
    contact_spacing : float
        See :class:`fe_training.mechanics.mesh.MeshSpec`.
    notch_radius : float
        Radius of the notch on the indentation branch [R_w].
    outer_radius : float
        Radius of the body [R_w].
    bulk : float
        Bulk term beside the pressure [mu]; without it the incompressibility of the mixed element
        leaks where stretches are large.
    polar : float
        Elements within this distance from the tip interpolate polar coordinates [R_w].
    scatter : float
        Root mean square of det F - 1 in an element from which on it is split [-].
    solver : str or None
        Linear solver; the fastest one installed by default.
    tolerance : float
        Relative error allowed in the wanted value of g.
    """

    sectors: int = 28
    contact_spacing: float = 0.05
    notch_radius: float = 5e-4
    outer_radius: float = 1e7
    bulk: float = 1.0
    polar: float = 1.0
    scatter: float = 0.2
    solver: str | None = None
    tolerance: float = 1e-3

    def refined(self, factor: float = 1.5) -> Settings:
        """Return settings with elements smaller by `factor`."""
        return replace(
            self,
            sectors=round(self.sectors * factor),
            contact_spacing=self.contact_spacing / factor,
        )


class MeshTooLargeError(PathStalledError):
    """The path asks for a finer mesh than is worth its time."""


Build = Callable[[float, MeshSpec, Settings], Body]


def at_ends(body: Body, state: State) -> NDArray[np.int64]:
    """Return the elements at the ends of the contact, and their neighbours."""
    touching = np.flatnonzero(state.active.wire)
    ends = [i for end in (touching[0], touching[-1]) for i in range(end - _END, end + _END + 1)]
    near = np.zeros(len(body.nodes), dtype=bool)
    near[body.face[np.clip(ends, 0, len(body.face) - 1)]] = True
    for _ in range(2):
        split = np.flatnonzero(near[body.connectivity].any(axis=1))
        near[body.connectivity[split]] = True
    return split


def _cracked(alpha: float, spec: MeshSpec, settings: Settings) -> Body:
    return Body(crack_mesh(spec), alpha, settings.bulk, polar=settings.polar)


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
    build : callable, optional
        Makes a body of another shape from `alpha`, `spec` and `settings`.
    """

    def __init__(
        self, alpha: float, spec: MeshSpec, settings: Settings, build: Build | None = None
    ) -> None:
        self.spec, self.settings, self._build = spec, settings, build or _cracked
        self.body = self._build(alpha, spec, settings)
        self._first = self.body
        self.solver: LinearSolver = make_solver(settings.solver)
        self._clock = time.perf_counter()

    def raised(self, position: float) -> State:
        """Return the state with the wire raised to the symmetry plane at `position`."""
        rough = self.rough()
        if rough is None:
            return self.last(undeformed(self.body, position), Control.HEIGHT, 0.0, _RAISE)
        return self.taken_over(rough, rough.raised(position))

    def rough(self) -> Cut | None:
        """Return the body on a much coarser mesh; None where its own is as coarse."""
        spec = replace(
            self.spec,
            sectors=min(self.spec.sectors, _ROUGH_SECTORS),
            contact_spacing=max(self.spec.contact_spacing, _ROUGH_SPACING),
            growth=max(self.spec.growth, _ROUGH_GROWTH),
        )
        if spec == self.spec:
            return None
        return Cut(self.body.alpha, spec, self.settings, self._build)

    def coarser(self, factor: float) -> Cut:
        """Return the body on a mesh with elements longer by `factor`."""
        return Cut(self.body.alpha, self.spec.refined(1.0 / factor), self.settings, self._build)

    def taken_over(self, other: Cut, state: State) -> State:
        """Return the equilibrium at a position of the wire that another mesh has reached."""
        position = float(state.centre[0])
        carried = self.carried(other, state, Control.POSITION)
        return carried or self.last(undeformed(self.body, position), Control.HEIGHT, 0.0, _RAISE)

    def carried(self, other: Cut, state: State, control: Control) -> State | None:
        """Return the equilibrium at the value of a control that another mesh has reached.

        None where Newton's method does not get from that mesh's state to this one's.
        """
        value = control_value(other.body, state, control)
        body = as_fine_as(self.body, other.body) if other.was_split else self.body
        solver = self.solver if body is self.body else make_solver(self.settings.solver)
        start = transferred(other.body, state, body)
        found, _ = path.attempt(body, start, control, value, solver)
        if found is not None:
            self.body, self.solver = body, solver
        return found

    @property
    def was_split(self) -> bool:
        """Whether elements have been split since the mesh was made."""
        return self.body is not self._first

    def moved(self, state: State, control: Control, end: float, steps: Steps) -> Iterator[State]:
        """Yield the states of a path, the mesh adapted on the way.

        Where the path stalls, the mesh is refined once more, and the path tried again.
        """
        rescues = 0
        while True:
            try:
                for reached in path.follow(self.body, state, control, end, steps, self.solver):
                    adapted = self._adapted(reached, control)
                    state, rescues = adapted or reached, 0
                    yield state
                    if adapted is not None:
                        break
                else:
                    return
            except MeshTooLargeError:
                raise
            except PathStalledError:
                rescues += 1
                share = _SPLIT_SHARE ** (1 + rescues)
                split = self.scattered(state, share * self.settings.scatter)
                if rescues > _RESCUES or not len(split) or control is Control.HEIGHT:
                    raise
                state = replace(self._split(state, control, split), step=steps.first)

    def scattered(self, state: State, least: float) -> NDArray[np.int64]:
        """Return the elements whose determinant scatters by more, as far as they may be split."""
        scatter = determinant_scatter(self.body, state)
        return np.flatnonzero((scatter > least) & self._splittable())

    def _adapted(self, state: State, control: Control) -> State | None:
        """Return the state on a mesh refined for it, or None if the mesh is fine enough."""
        allowed, adapted = self.settings.scatter, None
        for _ in range(_ROUNDS):
            if not len(self.scattered(state, allowed)):
                break
            split = self.scattered(state, _SPLIT_SHARE * allowed)
            state = adapted = self._split(state, control, split)
        return adapted

    def sharply_taken_over(self, other: Cut, state: State, times: int) -> State:
        """Return the state of another mesh at its position, the ends of the contact split."""
        try:
            start = transferred(other.body, state, self.body)
            return self.sharpened(start, Control.POSITION, times)
        except PathStalledError:
            return self.sharpened(self.taken_over(other, state), Control.POSITION, times)

    def sharpened(self, state: State, control: Control, times: int = 1) -> State:
        """Return the state on a mesh whose elements at the ends of the contact are split."""
        value = control_value(self.body, state, control)
        body, carried = self.body, state
        for _ in range(times):
            body, carried = refined(body, carried, at_ends(body, carried))
        return self._settled(body, carried, state, control, value)

    def _split(self, state: State, control: Control, elements: NDArray[np.int64]) -> State:
        """Split elements, and let the body settle at the same value of a control."""
        value = control_value(self.body, state, control)
        body, carried = refined(self.body, state, elements)
        return self._settled(body, carried, state, control, value)

    def _settled(
        self, body: Body, carried: State, state: State, control: Control, value: float
    ) -> State:
        """Go over to a finer body, on which a state was carried over; return its equilibrium."""
        if int(body.free.sum()) > MOST_UNKNOWNS:
            raise MeshTooLargeError(state, control, value, NewtonOutcome.STALLED)
        solver = make_solver(self.settings.solver)
        found, outcome = equilibrate(body, carried, control, value, solver, guarded=False)
        if outcome is not NewtonOutcome.CONVERGED:
            raise PathStalledError(state, control, value, outcome)
        self.body, self.solver = body, solver
        return replace(found, step=state.step)

    def _splittable(self) -> NDArray[np.bool_]:
        """Return the elements that are neither in the notch nor very small."""
        corners = self.body.mesh.p[:, self.body.mesh.t]
        distance = np.hypot(*corners.mean(axis=1))
        longest = np.hypot(*(corners - np.roll(corners, 1, axis=1))).max(axis=0)
        beyond = distance > _NOTCH_RINGS * self.spec.notch_radius
        return np.asarray(beyond & (longest > _SMALLEST * distance))

    def last(self, state: State, control: Control, end: float, steps: Steps) -> State:
        """Return the last state of a path."""
        reached = deque(self.moved(state, control, end, steps), maxlen=1)
        return reached.pop() if reached else state

    def at(self, state: State, g: float) -> State:
        """Return the state at which J = g mu R_w, by the horizontal force, which is half of it."""
        for _ in range(_CORRECTIONS):
            if abs(self.energy_release_rate(state) / g - 1.0) < self.settings.tolerance:
                return state
            force = self.force_at(g, state)
            state = self.pulled(state, force)
        raise PathStalledError(state, Control.FORCE, force, NewtonOutcome.STALLED)

    def force_at(self, g: float, state: State) -> float:
        """Return F_h at J = g mu R_w: J/(2 F_h) changes slowly along a path."""
        return g * state.horizontal_force / self.energy_release_rate(state)

    def pulled(self, state: State, force: float) -> State:
        """Return the state at a horizontal force, with steps that follow the contact."""
        steps = Steps(_FORCE_STEP * abs(state.horizontal_force), np.inf)
        return self.last(state, Control.FORCE, force, steps)

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

    def shifted_energy_release_rate(self, state: State) -> float:
        """Return -2 dU/dc: the crack tip moves by a little, the wire stays, the body settles.

        Everything around the tip and the contact moves rigidly in the reference configuration; the
        elements farther out give way.
        """
        body, (inner, outer) = self.body, self.supports(state)[-1]
        q, position = plateau(body, inner, outer), float(state.centre[0])
        energies = []
        for shift in (_TIP_SHIFT, -_TIP_SHIFT):
            points = body.mesh.p.copy()
            points[0] += shift * q
            moved = body.at(points)
            found, outcome = equilibrate(
                moved, replace(state, tangent=None), Control.POSITION, position, self.solver
            )
            if outcome is not NewtonOutcome.CONVERGED:
                raise PathStalledError(state, Control.POSITION, position, outcome)
            energies.append(strain_energy(moved, found))
        return -(energies[0] - energies[1]) / _TIP_SHIFT

    def record(self, state: State, target: float = np.nan, shift: bool = False) -> Record:
        """Return the record of an equilibrium; with the rate of a true shift if asked for."""
        body = self.body
        J, *across = [domain_integral(body, state, *s) for s in self.supports(state)]
        arc = observe.contact_arc(body, state)
        ahead = observe.stress_ahead(body, state)
        tip = body.face[0]
        record = Record(
            alpha=body.alpha,
            outcome=Outcome.CONVERGED,
            target=target,
            energy_release_rate=J,
            distance=control_value(body, state, Control.DISTANCE),
            insertion=float(state.centre[0]),
            horizontal_force=state.horizontal_force,
            vertical_force=state.vertical_force,
            theta_1=arc.theta_1,
            theta_2=arc.theta_2,
            slip_arc=arc.slip_arc,
            slip_load=arc.slip_load,
            strain_energy=strain_energy(body, state),
            tip_position=float(body.nodes[tip, 0] + state.u[tip, 0]),
            energy_release_rate_across=tuple(across),
            energy_release_rate_shift=self.shifted_energy_release_rate(state) if shift else np.nan,
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
            wall_time=self._elapsed(),
            pressure_angle=arc.theta,
            pressure=arc.pressure,
            stretch=arc.stretch,
            ahead_reference=ahead.reference,
            ahead_deformed=ahead.deformed,
            ahead_stress=ahead.opening,
        )
        if record.within_evidence:
            return record
        return replace(record, outcome=Outcome.OUTSIDE_EVIDENCE)

    def _elapsed(self) -> float:
        """Return the seconds since the last record."""
        now = time.perf_counter()
        elapsed, self._clock = now - self._clock, now
        return elapsed

    def failure(self, error: PathStalledError, target: float = np.nan) -> Record:
        """Return the record of a configuration that was not reached."""
        outcome, reason = Outcome.STALLED, str(error)
        if isinstance(error, MeshTooLargeError):
            outcome = Outcome.TOO_LARGE
            reason = f"more than {MOST_UNKNOWNS:,} unknowns beyond {error.control.value} = "
            reason += f"{error.value:.6g}"
        elif error.outcome is NewtonOutcome.CONVERGED:
            outcome = Outcome.FOLDED
        return Record(
            alpha=self.body.alpha,
            outcome=outcome,
            target=target,
            reason=reason,
            wall_time=self._elapsed(),
            unknowns=int(self.body.free.sum()),
            mesh=self.spec.as_dict(),
            bulk=self.settings.bulk,
            solver=self.solver.name,
        )


#: From quick looks to convergence checks.  A coarse mesh has a blunt notch in a small body: its
#: |J - 2 F_h|/J may be above the bounds of the evidence.
RESOLUTIONS: dict[str, Settings] = {
    "coarse": Settings(sectors=16, contact_spacing=0.15, notch_radius=5e-3, outer_radius=1e5),
    "standard": Settings(),
    "fine": Settings().refined(),
}

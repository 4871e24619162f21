"""Newton's method for the body in contact, with one control parameter.

The wire is moved by one scalar at a time.  Besides its height or its position along the cut, the
control may be a result: the distance to the tip or the horizontal contact force.  The position of
the wire is then one more unknown and the wanted value one more equation (bordering), so that no
configuration is hidden behind a fold.  Touching nodes are turned into normal and tangential
directions, and their normal displacement is prescribed; there are no multipliers in the matrix.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from fe_training.mechanics import active_set as contact
from fe_training.mechanics import ogden
from fe_training.mechanics.active_set import ActiveSet, Geometry
from fe_training.mechanics.body import Body
from fe_training.solver.linear_solvers import LinearSolver

Array = NDArray[np.float64]

#: Residual relative to the contact force, at which a state counts as in equilibrium.
RESIDUAL_GOAL = 1e-8

#: Rounding at large stretch can hold the residual above the goal; a residual that stagnates below
#: this bound is accepted, and recorded.
RESIDUAL_BOUND = 1e-6
_DIVERGED = 1e8

#: Contact forces below this count as this much in relative residuals [mu R_w].
_LEAST_FORCE = 1e-3

#: Share of det F that a quadrature point keeps in one step, and halvings tried for it.
_LEAST_SHARE, _HALVINGS = 0.2, 6


class Control(Enum):
    """The scalar that is prescribed; its value is in wire radii, or mu R_w for the force."""

    HEIGHT = "height of the wire's centre above the symmetry plane"
    POSITION = "position of the wire's centre along the cut"
    DISTANCE = "deformed distance from the wire's centre to the crack tip"
    FORCE = "horizontal contact force on the half model"


class NewtonOutcome(Enum):
    """How an attempt ended."""

    CONVERGED = "equilibrium found"
    STALLED = "the iterations ran out"
    DIVERGED = "the iterations diverged"
    CYCLED = "the set of touching nodes repeats itself"


@dataclass(frozen=True, slots=True, eq=False)
class State:
    """One configuration of the body and the wire.

    Parameters
    ----------
    u : ndarray, shape (nodes, 2)
        Displacements [R_w].
    p : ndarray, shape (vertices,)
        Pressures [mu].
    centre : ndarray, shape (2,)
        Centre of the wire [R_w].
    active : ActiveSet
        Touching face nodes.
    force : ndarray, shape (face nodes,)
        Normal contact forces [mu R_w].
    normal : ndarray, shape (face nodes, 2)
        Their directions, away from the wire.
    tangent : State or None
        Derivative of displacements, pressures, centre and forces with respect to `control`.
    control : Control or None
        What the tangent refers to.
    residual : float
        Residual relative to the contact force.
    iterations : int
        Newton iterations that led here.
    step : float
        Size of the next step of `control` on the path that led here, in its own unit; 0 if none.
    """

    u: Array
    p: Array
    centre: Array
    active: ActiveSet
    force: Array
    normal: Array
    tangent: State | None = None
    control: Control | None = None
    residual: float = np.nan
    iterations: int = 0
    step: float = 0.0

    @property
    def horizontal_force(self) -> float:
        """F_h, the component along the cut of the force on the body from the wire [mu R_w]."""
        return float(self.force[self.active.wire] @ self.normal[self.active.wire, 0])

    @property
    def vertical_force(self) -> float:
        """F_v, the component that opens the cut [mu R_w]."""
        return float(self.force[self.active.wire] @ self.normal[self.active.wire, 1])


def undeformed(body: Body, position: float) -> State:
    """Return the body at rest with the wire just below it at `position` [R_w]."""
    n = len(body.face)
    return State(
        np.zeros((len(body.nodes), 2)),
        np.zeros(len(body.pressure_places)),
        np.array([position, -1.0]),
        contact.no_contact(body),
        np.zeros(n),
        np.zeros((n, 2)),
    )


def control_value(body: Body, state: State, control: Control) -> float:
    """Return the present value of a control."""
    if control is Control.HEIGHT:
        return float(state.centre[1])
    if control is Control.POSITION:
        return float(state.centre[0])
    if control is Control.DISTANCE:
        tip = body.face[0]
        return float(body.nodes[tip, 0] + state.u[tip, 0] - state.centre[0])
    return state.horizontal_force


@dataclass(frozen=True, slots=True, eq=False)
class _Direction:
    """A change of the unknowns: displacements, pressures and normal forces."""

    u: Array
    p: Array
    force: Array

    def plus(self, other: _Direction, factor: float) -> _Direction:
        return _Direction(
            self.u + factor * other.u,
            self.p + factor * other.p,
            self.force + factor * other.force,
        )


def _axis(control: Control) -> Array:
    """Return the direction in which the wire moves under a control."""
    return np.array([0.0, 1.0]) if control is Control.HEIGHT else np.array([1.0, 0.0])


def _force_slope(geo: Geometry, active: ActiveSet, force: Array) -> Array:
    """Return dF_h/d(position of each touching node) due to the turning of its normal."""
    share = np.where(active.wire, force / geo.wire_distance, 0.0)
    turn = np.array([1.0, 0.0]) - geo.normal * geo.normal[:, :1]
    return np.asarray(share[:, None] * turn)


def _control_rate(
    body: Body, control: Control, d: _Direction, axis: Array, geo: Geometry, state: State
) -> float:
    """Return the change of a control's value along a direction with the wire moving by `axis`."""
    if control is Control.HEIGHT:
        return float(axis[1])
    if control is Control.POSITION:
        return float(axis[0])
    if control is Control.DISTANCE:
        return float(d.u[body.face[0], 0] - axis[0])
    slope = _force_slope(geo, state.active, state.force)
    moved = d.u[body.face] - axis
    turned = np.einsum("ij,ij->", slope, moved)
    wire = state.active.wire
    return float(d.force[wire] @ geo.normal[wire, 0] + turned)


class _Linearisation:
    """Residual and tangent at one state, in the turned directions of its touching nodes."""

    def __init__(self, body: Body, state: State, axis: Array) -> None:
        self.body, self.axis = body, axis
        active = state.active
        self.geo = contact.geometry(body, state.u, state.centre, active)
        element_r, element_k = body.element_forces(state.u, state.p, state.centre)
        internal = body.gather(element_r)
        self.force = contact.nodal_forces(body, internal, self.geo, active)
        self.state = replace(state, force=self.force, normal=self.geo.normal)
        touching = np.flatnonzero(active.any)
        self.touching = touching
        self.nodes = body.face[touching]
        normal = self.geo.normal[touching]
        # columns: normal and tangential direction
        self.turn = np.stack([normal, np.stack([-normal[:, 1], normal[:, 0]], axis=1)], axis=2)
        self.centre_rate = body.centre_rate(element_k, axis)
        self._turn(self.centre_rate)
        self._turn_elements(element_k)
        self.residual = internal
        self._turn(self.residual)
        wire = active.wire[touching]
        self.curvature = np.where(
            wire, self.force[touching] / self.geo.wire_distance[touching], 0.0
        )
        self._bend_elements(element_k)
        self.matrix = body.matrix(element_k)
        self.prescribed = np.zeros(body.size, dtype=bool)
        self.prescribed[2 * self.nodes] = True
        self.wire = wire

    def _turn(self, vector: Array) -> None:
        pairs = vector[: self.body.displacements].reshape(-1, 2)
        pairs[self.nodes] = np.einsum("nij,ni->nj", self.turn, pairs[self.nodes])

    def _turn_back(self, vector: Array) -> None:
        pairs = vector[: self.body.displacements].reshape(-1, 2)
        pairs[self.nodes] = np.einsum("nij,nj->ni", self.turn, pairs[self.nodes])

    def _turn_elements(self, tangent: Array) -> None:
        """Turn rows and columns of the elements that hold touching nodes."""
        body = self.body
        place = np.full(len(body.nodes), -1)
        place[self.nodes] = np.arange(len(self.nodes))
        local = place[body.connectivity]
        self.elements = np.flatnonzero((local >= 0).any(axis=1))
        self.local = local[self.elements]
        m = tangent.shape[1]
        T = np.broadcast_to(np.eye(m), (len(self.elements), m, m)).copy()
        e, a = np.nonzero(self.local >= 0)
        turn = self.turn[self.local[e, a]]
        for i in range(2):
            for j in range(2):
                T[e, 2 * a + i, 2 * a + j] = turn[:, i, j]
        K = tangent[self.elements]
        tangent[self.elements] = T.transpose(0, 2, 1) @ K @ T

    def _bend_elements(self, tangent: Array) -> None:
        """Add the curvature of the wire, -force/distance, to the tangential stiffness."""
        e, a = np.nonzero(self.local >= 0)
        _, first = np.unique(self.local[e, a], return_index=True)  # each node once
        e, a = e[first], a[first]
        node = self.local[e, a]
        tangent[self.elements[e], 2 * a + 1, 2 * a + 1] -= self.curvature[node]

    def norm(self) -> float:
        """Return the residual of what must vanish, relative to the contact force."""
        open_ = self.body.free & ~self.prescribed
        r = (self.residual * self.body.scale)[open_]
        total = max(float(np.abs(self.force).sum()), _LEAST_FORCE)
        gaps = np.abs(self.geo.gap[self.touching]).max(initial=0.0)
        return float(np.sqrt(r @ r) / total + gaps)

    def directions(self, solver: LinearSolver) -> tuple[_Direction, _Direction]:
        """Return the Newton step at a fixed wire, and the response to a unit move of the wire."""
        body, axis = self.body, self.axis
        known = np.zeros((body.size, 2))
        known[2 * self.nodes, 0] = -self.geo.gap[self.touching]
        known[2 * self.nodes, 1] = np.where(self.wire, self.turn[:, :, 0] @ axis, 0.0)
        right = np.zeros((body.size, 2))
        right[:, 0] = -self.residual
        right[:, 1] = -self.centre_rate
        right[2 * self.nodes + 1, 1] -= self.curvature * (self.turn[:, :, 1] @ axis)
        free, fixed = body.free, self.prescribed[body.free]
        scale = body.scale[free][:, None]
        known_free = known[free] / scale
        right_free = right[free] * scale - self.matrix @ known_free
        right_free[fixed] = known_free[fixed]
        solver.factorize(body.eliminate(self.matrix, fixed))
        x = solver.solve(right_free)
        normal_force = np.zeros((body.size, 2))
        normal_force[free] = self.matrix @ x / scale
        normal_force[:, 1] += self.centre_rate
        full = np.zeros((body.size, 2))
        full[free] = x * scale
        return self._direction(full[:, 0], normal_force[:, 0]), self._direction(
            full[:, 1], normal_force[:, 1]
        )

    def _direction(self, x: Array, reaction: Array) -> _Direction:
        force = np.zeros(len(self.body.face))
        force[self.touching] = reaction[2 * self.nodes]
        self._turn_back(x)
        d = self.body.displacements
        return _Direction(x[:d].reshape(-1, 2), x[d:], force)


def predicted(body: Body, state: State, control: Control, target: float) -> State:
    """Return the state moved along its tangent towards the target, as a starting point."""
    if state.tangent is None or state.control is not control:
        return state
    t = state.tangent
    step = target - control_value(body, state, control)
    step *= _admissible(body, state, step * t.u, step * t.centre)
    return replace(
        state,
        u=state.u + step * t.u,
        p=state.p + step * t.p,
        centre=state.centre + step * t.centre,
    )


def _admissible(body: Body, state: State, step: Array, move: Array) -> float:
    """Return the length of a step that leaves every element a share of its area.

    It is needed where steps are large, as while the wire is raised.  At high toughness it does
    harm: elements at the end of the contact that fold for an iteration make it crawl.  Each
    quadrature point may lose at most most of its determinant in one step; the determinant is
    smooth in the length, so a few halvings suffice.
    """
    watched = body.beyond_notch
    u, centre = state.u, state.centre
    before = ogden.volume_change(body.displacement_gradient(u, watched, centre)) + 1.0
    # where an element is folded already, all that is asked for is that it stays near
    floor = np.where(before > 0.0, np.minimum(_LEAST_SHARE * before, _LEAST_SHARE), before - 1.0)
    t = 1.0
    for _ in range(_HALVINGS):
        there = body.displacement_gradient(u + t * step, watched, centre + t * move)
        after = ogden.volume_change(there) + 1.0
        if (after > floor).all():
            return t
        t *= 0.5
    return t


def equilibrate(
    body: Body,
    start: State,
    control: Control,
    target: float,
    solver: LinearSolver,
    max_iterations: int = 30,
    guarded: bool = True,
) -> tuple[State, NewtonOutcome]:
    """Return the equilibrium at which a control has its target value.

    Parameters
    ----------
    body : Body
        The discretised half body.
    start : State
        Where the iterations begin.
    control : Control
        What is prescribed.
    target : float
        Its value, see :class:`Control`.
    solver : LinearSolver
        Used for every linear system; its analysis is reused.
    max_iterations : int
        Newton iterations allowed.
    guarded : bool
        Shorten steps in which elements lose most of their area.

    Returns
    -------
    state : State
        The last iterate; an equilibrium only if the outcome says so.
    outcome : NewtonOutcome
    """
    state = predicted(body, start, control, target)
    axis = _axis(control)
    previous = np.inf
    seen: set[bytes] = set()
    settled = False
    tangent: State | None = None
    with np.errstate(all="ignore"):  # a diverging iterate is caught by its residual
        for iteration in range(max_iterations + 1):
            lin = _Linearisation(body, state, axis)
            state = lin.state
            norm = lin.norm()
            if not norm < _DIVERGED:
                return state, NewtonOutcome.DIVERGED
            error = control_value(body, state, control) - target
            met = abs(error) < 1e-9 * max(1.0, abs(target))
            stagnant = norm < RESIDUAL_BOUND and norm > 0.2 * previous
            if settled and met and (norm < RESIDUAL_GOAL or stagnant):
                done = replace(
                    state,
                    tangent=tangent,
                    control=control,
                    residual=norm,
                    iterations=iteration,
                )
                return done, NewtonOutcome.CONVERGED
            if iteration == max_iterations:
                break
            newton, move = lin.directions(solver)
            nothing = np.zeros(2)
            rate = _control_rate(body, control, move, axis, lin.geo, state)
            drift = _control_rate(body, control, newton, nothing, lin.geo, state)
            length = -(error + drift) / rate
            step = newton.plus(move, length)
            tangent = State(
                move.u / rate, move.p / rate, axis / rate, state.active, move.force, state.normal
            )
            t = 1.0
            if guarded:
                t = _admissible(body, state, step.u, length * axis)
            u, centre = state.u + t * step.u, state.centre + t * length * axis
            force = state.force + t * step.force
            active = contact.updated(body, u, centre, state.active, force)
            settled = active.same(state.active) and t == 1.0
            if not settled and t == 1.0 and norm < RESIDUAL_BOUND:
                if active.key() in seen:
                    return state, NewtonOutcome.CYCLED
                seen.add(active.key())
            previous = norm if settled else np.inf
            state = State(u, state.p + t * step.p, centre, active, force, state.normal)
    return state, NewtonOutcome.STALLED

"""Newton's method for the body in contact, with one control parameter.

The wire is moved by one scalar at a time.  Besides its height or its position along the cut, the
control may be a result: the distance to the tip or the horizontal contact force.  The position of
the wire is then one more unknown and the wanted value one more equation (bordering), so that no
configuration is hidden behind a fold.  Touching nodes are turned into normal and tangential
directions, and their normal displacement is prescribed; there are no multipliers in the matrix.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from fe_training.mechanics import active_set as contact
from fe_training.mechanics.active_set import Geometry
from fe_training.mechanics.body import Body
from fe_training.solver.linear_solvers import LinearSolver
from fe_training.solver.predictor import admissible, predicted
from fe_training.solver.state import (
    Control,
    Direction,
    NewtonOutcome,
    State,
    control_rate,
    control_value,
    undeformed,
)

__all__ = ["Control", "NewtonOutcome", "State", "control_value", "equilibrate", "undeformed"]

Array = NDArray[np.float64]

#: Residual relative to the contact force, at which a state counts as in equilibrium.
RESIDUAL_GOAL = 1e-8

#: Rounding at large stretch can hold the residual above the goal; a residual that stagnates below
#: this bound is accepted, and recorded.
RESIDUAL_BOUND = 1e-6
_DIVERGED = 1e8

#: Contact forces below this count as this much in relative residuals [mu R_w].
_LEAST_FORCE = 1e-3

#: Corrections with the factors of one iteration, and what each has to leave of the residual; they
#: go on to this residual while they do.
_CORRECTIONS, _CONTRACTION, AIM = 8, 0.3, 1e-9

#: Nodes that may meet or leave the wire before the tangent is factorised anew, and iterations in
#: which that is tried: where the set of nodes does not settle, every iteration has its own factors.
_MOST_CHANGED, _TRIED = 12, 6

#: Residual of a state that is only passed by: the next one starts from it and its tangent.
PASSED_BY = 1e-4


def _axis(control: Control) -> Array:
    """Return the direction in which the wire moves under a control."""
    return np.array([0.0, 1.0]) if control is Control.HEIGHT else np.array([1.0, 0.0])


class Residual:
    """Residual at one state, in the turned directions of its touching nodes."""

    def __init__(self, body: Body, state: State, tangents: bool = False) -> None:
        self.body, active = body, state.active
        self.geo = contact.geometry(body, state.u, state.centre, active)
        element_r, self._tangents = body.element_forces(state.u, state.p, state.centre, tangents)
        self.residual = body.gather(element_r)
        self.force = contact.nodal_forces(body, self.residual, self.geo, active)
        self.state = replace(state, force=self.force, normal=self.geo.normal)
        self.touching = np.flatnonzero(active.any)
        self.nodes = body.face[self.touching]
        normal = self.geo.normal[self.touching]
        # columns: normal and tangential direction
        self.turn = np.stack([normal, np.stack([-normal[:, 1], normal[:, 0]], axis=1)], axis=2)
        self._turn(self.residual)

    def norm(self) -> float:
        """Return the residual of what must vanish, relative to the contact force."""
        open_ = self.body.free.copy()
        open_[2 * self.nodes] = False
        r = (self.residual * self.body.scale)[open_]
        total = max(float(np.abs(self.force).sum()), _LEAST_FORCE)
        gaps = np.abs(self.geo.gap[self.touching]).max(initial=0.0)
        return float(np.sqrt(r @ r) / total + gaps)

    def direction(self, x: Array, reaction: Array) -> Direction:
        """Return the change of the unknowns of which `x` and `reaction` are the turned form."""
        force = np.zeros(len(self.body.face))
        force[self.touching] = reaction[2 * self.nodes]
        self._turn_back(x)
        d = self.body.displacements
        return Direction(x[:d].reshape(-1, 2), x[d:], force)

    def _turn(self, vector: Array) -> None:
        pairs = vector[: self.body.displacements].reshape(-1, 2)
        pairs[self.nodes] = np.einsum("nij,ni->nj", self.turn, pairs[self.nodes])

    def _turn_back(self, vector: Array) -> None:
        pairs = vector[: self.body.displacements].reshape(-1, 2)
        pairs[self.nodes] = np.einsum("nij,nj->ni", self.turn, pairs[self.nodes])


class Linearisation(Residual):
    """Residual and tangent at one state."""

    def __init__(self, body: Body, state: State, axis: Array) -> None:
        super().__init__(body, state, tangents=True)
        self.axis, element_k = axis, self._tangents
        self.centre_rate = body.centre_rate(element_k, axis)
        self._turn(self.centre_rate)
        self._turn_elements(element_k)
        touching = self.touching
        wire = state.active.wire[touching]
        self.curvature = np.where(
            wire, self.force[touching] / self.geo.wire_distance[touching], 0.0
        )
        self._bend_elements(element_k)
        self.matrix = body.matrix(element_k)
        prescribed = np.zeros(body.size, dtype=bool)
        prescribed[2 * self.nodes] = True
        self.fixed = prescribed[body.free]
        self.wire = wire

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

    def directions(self, solver: LinearSolver) -> tuple[Direction, Direction]:
        """Return the Newton step at a fixed wire, and the response to a unit move of the wire."""
        body, axis = self.body, self.axis
        known = np.zeros((body.size, 2))
        known[2 * self.nodes, 0] = -self.geo.gap[self.touching]
        known[2 * self.nodes, 1] = np.where(self.wire, self.turn[:, :, 0] @ axis, 0.0)
        right = np.zeros((body.size, 2))
        right[:, 0] = -self.residual
        right[:, 1] = -self.centre_rate
        right[2 * self.nodes + 1, 1] -= self.curvature * (self.turn[:, :, 1] @ axis)
        solver.factorize(body.eliminate(self.matrix, self.fixed))
        x, reaction = self.solved(solver, known, right)
        reaction[:, 1] += self.centre_rate
        self.move = x[:, 1].copy(), reaction[:, 1]
        newton, move = (self.direction(x[:, i], reaction[:, i]) for i in range(2))
        return newton, move

    def correction(self, solver: LinearSolver, at: Residual) -> Direction:
        """Return the step at a fixed wire from another state with the factors of this one."""
        known = np.zeros((self.body.size, 1))
        known[2 * self.nodes, 0] = -at.geo.gap[self.touching]
        x, reaction = self.solved(solver, known, -at.residual[:, None])
        return at.direction(x[:, 0], reaction[:, 0])

    def solved(self, solver: LinearSolver, known: Array, right: Array) -> tuple[Array, Array]:
        """Return solutions with known normal displacements, and what they do to those rows."""
        free = self.body.free
        scale = self.body.scale[free][:, None]
        known_fixed = known[free][self.fixed] / scale[self.fixed]
        right_free = right[free] * scale - self._fixed_rows.T @ known_fixed
        right_free[self.fixed] = known_fixed
        x = solver.solve(right_free)
        full, reaction = np.zeros(right.shape), np.zeros(right.shape)
        full[free] = x * scale
        reaction[self._fixed_unknowns] = (self._fixed_rows @ x) / scale[self.fixed]
        return full, reaction

    @cached_property
    def _fixed_rows(self) -> sp.csr_matrix:
        """Rows of the matrix, and by its symmetry columns, of what is prescribed."""
        return self.matrix[np.flatnonzero(self.fixed)]

    @cached_property
    def _fixed_unknowns(self) -> NDArray[np.int64]:
        return np.flatnonzero(self.body.free)[self.fixed]


class ChangedSet:
    """The factors of one linearisation, made to serve a state at which other nodes touch.

    A node that has left the wire is a known displacement that becomes unknown, and one that has
    met it a force; both are columns beside the factors, and a small dense system tells their sizes.

    Parameters
    ----------
    lin : Linearisation
        Whose factors the solver holds.
    solver : LinearSolver
    at : Residual
        A state with the same nodes on the symmetry plane.
    """

    def __init__(self, lin: Linearisation, solver: LinearSolver, at: Residual) -> None:
        self.lin, self.solver, self.active = lin, solver, at.state.active
        self.left = np.flatnonzero(~np.isin(lin.nodes, at.nodes))
        self.met = np.flatnonzero(~np.isin(at.nodes, lin.nodes))
        self.left_nodes, self.met_nodes = lin.nodes[self.left], at.nodes[self.met]
        self.normal = at.turn[self.met, :, 0]
        count, size = len(self.left), lin.body.size
        known, right = np.zeros((2, size, count + len(self.met)))
        known[2 * self.left_nodes, np.arange(count)] = 1.0
        for i in range(2):
            right[2 * self.met_nodes + i, count + np.arange(len(self.met))] = self.normal[:, i]
        self.x, self.reaction = lin.solved(solver, known, right)
        self.reaction[2 * self.met_nodes, count + np.arange(len(self.met))] = 1.0
        self.system = np.concatenate([self.reaction[2 * self.left_nodes], self._along(self.x)])

    def _along(self, x: Array) -> Array:
        """Return displacements of nodes that have met the wire along their normals."""
        pairs = np.stack([x[2 * self.met_nodes], x[2 * self.met_nodes + 1]])
        return np.asarray(np.einsum("ni,in...->n...", self.normal, pairs))

    def _completed(
        self, x: Array, reaction: Array, pull: Array, closing: Array, at: Residual
    ) -> Direction:
        """Return the change that has wanted forces where nodes left and motions where they met."""
        wanted = [pull - reaction[2 * self.left_nodes], closing - self._along(x)]
        sizes = np.linalg.solve(self.system, np.concatenate(wanted))
        x, reaction = x + self.x @ sizes, reaction.copy()
        reaction[2 * self.met_nodes] = 0.0
        reaction += self.reaction @ sizes
        pairs = x[: at.body.displacements].reshape(-1, 2)
        left, met = self.lin.turn[self.left], at.turn[self.met]
        pairs[self.left_nodes] = np.einsum("nij,nj->ni", left, pairs[self.left_nodes])
        pairs[self.met_nodes] = np.einsum("nij,ni->nj", met, pairs[self.met_nodes])
        return at.direction(x, reaction)

    def correction(self, at: Residual) -> Direction:
        """Return the step at a fixed wire from a state with these nodes."""
        lin, residual = self.lin, at.residual.copy()
        pairs = residual[: at.body.displacements].reshape(-1, 2)
        left, met = lin.turn[self.left], at.turn[self.met]
        pairs[self.left_nodes] = np.einsum("nij,ni->nj", left, pairs[self.left_nodes])
        pairs[self.met_nodes, 0] = 0.0  # the force itself
        pairs[self.met_nodes] = np.einsum("nij,nj->ni", met, pairs[self.met_nodes])
        known = np.zeros((at.body.size, 1))
        known[2 * at.nodes, 0] = -at.geo.gap[at.touching]
        known[2 * self.met_nodes] = 0.0
        x, reaction = lin.solved(self.solver, known, -residual[:, None])
        closing = -at.geo.gap[at.touching][self.met]
        pull = -residual[2 * self.left_nodes]
        return self._completed(x[:, 0], reaction[:, 0], pull, closing, at)

    def response(self, at: Residual) -> Direction:
        """Return the response to a unit move of the wire with these nodes."""
        closing = self.normal @ self.lin.axis
        return self._completed(*self.lin.move, np.zeros(len(self.left)), closing, at)


def equilibrate(
    body: Body,
    start: State,
    control: Control,
    target: float,
    solver: LinearSolver,
    max_iterations: int = 30,
    guarded: bool = True,
    enough: float = AIM,
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
    enough : float
        Relative residual, and miss of the target, with which the iterations may end.

    Returns
    -------
    state : State
        The last iterate; an equilibrium only if the outcome says so.
    outcome : NewtonOutcome
    """
    with np.errstate(all="ignore"):  # a diverging iterate is caught by its residual
        return _Newton(body, control, target, solver, guarded, enough).solve(
            predicted(body, start, control, target), max_iterations
        )


class _Newton:
    """Newton's method towards one value of a control; see :func:`equilibrate`."""

    def __init__(
        self,
        body: Body,
        control: Control,
        target: float,
        solver: LinearSolver,
        guarded: bool,
        enough: float,
    ) -> None:
        self.body, self.control, self.target, self.enough = body, control, target, enough
        self.solver, self.guarded, self.axis = solver, guarded, _axis(control)

    def solve(self, state: State, max_iterations: int) -> tuple[State, NewtonOutcome]:
        body, axis = self.body, self.axis
        seen: set[bytes] = set()
        for iteration in range(max_iterations):
            lin = Linearisation(body, state, axis)
            state, norm = lin.state, lin.norm()
            if not norm < _DIVERGED:
                return state, NewtonOutcome.DIVERGED
            newton, move = lin.directions(self.solver)
            tangent = self._tangent(move, lin)
            there, whole = self._stepped(state, newton, tangent, lin.geo, self.guarded)
            settled = whole and there.active.same(state.active)
            if not settled and whole and norm < RESIDUAL_BOUND:
                if there.active.key() in seen:
                    return state, NewtonOutcome.CYCLED
                seen.add(there.active.key())
            state = there
            # corrections are never guarded: where steps need it, they keep to their nodes
            most = 0 if self.guarded or iteration >= _TRIED else _MOST_CHANGED
            if settled or (whole and most):
                state, residual, tangent = self._corrected(lin, state, tangent, norm, most)
                if residual is not None:
                    done = replace(
                        state,
                        tangent=tangent,
                        control=self.control,
                        residual=residual,
                        iterations=iteration + 1,
                    )
                    return done, NewtonOutcome.CONVERGED
        return state, NewtonOutcome.STALLED

    def _tangent(self, move: Direction, at: Residual) -> State:
        """Return the derivative to the control, by the response to a unit move of the wire."""
        state, axis = at.state, self.axis
        rate = control_rate(self.body, self.control, move, axis, at.geo, state)
        u, p, force = move.u / rate, move.p / rate, move.force / rate
        return State(u, p, axis / rate, state.active, force, state.normal)

    def _missed(self, state: State) -> float:
        return control_value(self.body, state, self.control) - self.target

    def _stepped(
        self, state: State, newton: Direction, tangent: State, geo: Geometry, guarded: bool
    ) -> tuple[State, bool]:
        """Return the state after a step that meets the control, and whether it is a whole one."""
        drift = control_rate(self.body, self.control, newton, np.zeros(2), geo, state)
        change = -(self._missed(state) + drift)
        step = newton.plus(Direction(tangent.u, tangent.p, tangent.force), change)
        move, t = change * tangent.centre, 1.0
        if guarded:
            t = admissible(self.body, state, step.u, move)
        u, centre, force = (
            state.u + t * step.u,
            state.centre + t * move,
            state.force + t * step.force,
        )
        active = contact.updated(self.body, u, centre, state.active, force)
        return State(u, state.p + t * step.p, centre, active, force, state.normal), t == 1.0

    def _corrected(
        self, lin: Linearisation, state: State, tangent: State, previous: float, most: int
    ) -> tuple[State, float | None, State]:
        """Return the state corrected with the factors at hand, its residual if it converged.

        As long as that converges quickly: a correction takes a fifth of the time of an iteration.
        The third is the tangent, with the nodes that touch in the end; at most so many of them may
        be others than those of the factors.
        """
        changed, unchanged = None, tangent
        settled = state.active.same(lin.state.active)
        for correction in range(_CORRECTIONS):
            at = Residual(self.body, state)
            norm = at.norm()
            met = abs(self._missed(at.state)) < self.enough * max(1.0, abs(self.target))
            slow = not norm < _CONTRACTION * previous
            bound = RESIDUAL_GOAL if correction else RESIDUAL_BOUND
            if settled and met and (norm < self.enough or (slow and norm < bound)):
                return at.state, norm, tangent
            if slow or not self._near(lin, at, most):
                return state, None, tangent
            if at.state.active.same(lin.state.active):
                newton, tangent = lin.correction(self.solver, at), unchanged
                changed = None
            else:
                if changed is None or not changed.active.same(at.state.active):
                    changed = ChangedSet(lin, self.solver, at)
                    tangent = self._tangent(changed.response(at), at)
                newton = changed.correction(at)
            there, _ = self._stepped(at.state, newton, tangent, at.geo, guarded=False)
            settled, state, previous = there.active.same(state.active), there, norm
        return state, None, tangent

    def _near(self, lin: Linearisation, at: Residual, most: int) -> bool:
        """Return whether so many nodes at most touch that do not in the factors, or the reverse."""
        of, now = lin.state.active, at.state.active
        same_plane = bool((of.plane == now.plane).all())
        return same_plane and int((of.wire != now.wire).sum()) <= most

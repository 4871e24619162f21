"""Residual and tangent of the body that slides: the frictionless ones with the shear added.

Touching nodes are turned into a normal and a tangential direction, which points backwards along
the wire.  The tangential residual ``r_m`` of a node that slides is balanced by the shear force
``xi N + tau_w l`` against it.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from fe_training.mechanics.body import Body
from fe_training.sliding.rows import ChangedRows
from fe_training.sliding.shear import (
    Load,
    angle_slopes,
    face_lengths,
    length_operator,
)
from fe_training.sliding.state import Slide, SlidingState
from fe_training.solver.equilibrium import Linearisation, Residual

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

_AXIS = np.array([1.0, 0.0])


class _Shear:
    """The shear forces of one state, which it adds to the residual of that state.

    A grazing node has its normal residual, which must vanish, in the tangential row instead.
    """

    def __init__(self, residual: Residual, load: Load, grazing: Flags) -> None:
        body, state = residual.body, residual.state
        self.load, self.sliders = load, np.flatnonzero(state.active.wire)
        self.normal_rows = 2 * body.face[self.sliders]
        self.rows = self.normal_rows + 1
        self.grazing = grazing[self.sliders]
        self.held = ~body.free[self.rows]  # the tip itself stays in the plane
        self.force = residual.force[self.sliders]
        self.length = face_lengths(body, state)[self.sliders]
        self.friction, self.wear = load.slopes(self.force, self.length)
        self.drag = residual.residual[self.rows].copy()
        law = load.on(self.force, self.length)
        self.amount = np.where(self.held, law, -self.drag)
        residual.residual[self.rows] = np.where(self.grazing, self.force, self.drag + law)

    def on_face(self, count: int) -> Array:
        """Return the shear forces of all face nodes."""
        amounts = np.zeros(count)
        amounts[self.sliders] = self.amount
        return amounts


class SlidingResidual(Residual):
    """Residual at one state and load, in the turned directions of its touching nodes."""

    def __init__(self, body: Body, state: SlidingState, load: Load) -> None:
        super().__init__(body, state)
        self.shear = _Shear(self, load, state.grazing)
        self.sliding = _known(state, self, self.shear)


def _known(state: SlidingState, residual: Residual, shear: _Shear) -> SlidingState:
    """Return a state with the forces that its residual shows."""
    at, forces = residual.state, shear.on_face(len(state.force))
    return replace(state, force=at.force, normal=at.normal, shear=forces)


class SlidingLinearisation(Linearisation):
    """Residual and tangent at one state and load."""

    def __init__(self, body: Body, state: SlidingState, load: Load) -> None:
        super().__init__(body, state, _AXIS)
        self.shear = _Shear(self, load, state.grazing)
        self.sliding = _known(state, self, self.shear)
        self._slopes = angle_slopes(body, self.state)
        self._number = np.cumsum(body.free) - 1
        lengths = self._length_slopes()
        self._length_rate = -(lengths @ np.tile(_AXIS, len(body.nodes)))
        self.additions = self._added_rows(sp.csr_matrix(lengths @ self._turns()))

    @property
    def places(self) -> NDArray[np.int64]:
        """Where the rows with additions are among the free unknowns."""
        return np.asarray(self._number[self.shear.rows[~self.shear.held]])

    def _length_slopes(self) -> sp.csr_matrix:
        """Return the derivatives of the sliders' lengths to all displacements."""
        body, count = self.body, len(self.body.face)
        columns = (2 * body.face[:, None] + np.arange(2)).ravel()
        entries = (self._slopes.ravel(), (np.repeat(np.arange(count), 2), columns))
        angles = sp.csr_matrix(entries, shape=(count, body.displacements))
        return length_operator(count)[self.shear.sliders] @ angles

    def _turns(self) -> sp.csr_matrix:
        """Return the matrix that makes displacements of turned ones, and takes no pressures."""
        body, n = self.body, self.body.displacements
        plain = np.ones(n)
        plain[2 * self.nodes] = plain[2 * self.nodes + 1] = 0.0
        i = 2 * self.nodes[:, None] + np.array([0, 0, 1, 1])
        j = 2 * self.nodes[:, None] + np.array([0, 1, 0, 1])
        unturned = np.flatnonzero(plain)
        entries = np.concatenate([self.turn.ravel(), plain[unturned]])
        places = [np.concatenate([k.ravel(), unturned]) for k in (i, j)]
        return sp.csr_matrix((entries, tuple(places)), shape=(n, body.size))

    def _added_rows(self, lengths: sp.csr_matrix) -> sp.csr_matrix:
        """Return what the shear adds to the tangential rows of the free, scaled unknowns."""
        body, shear, number = self.body, self.shear, self._number
        normal, own = self.matrix[number[shear.normal_rows]], self.matrix[number[shear.rows]]
        graze = shear.grazing.astype(float)
        friction, wear = self._slid_shares()
        added = sp.diags(friction) @ normal + sp.diags(wear) @ lengths[:, body.free]
        added = added - sp.diags(graze) @ own
        # as a node goes round the wire, its normal turns towards the drag
        bent = friction * shear.drag / self.geo.wire_distance[shear.sliders]
        turned = sp.csr_matrix((bent, (np.arange(len(bent)), number[shear.rows])), added.shape)
        return sp.csr_matrix((added + turned)[~shear.held])

    def _slid_shares(self) -> tuple[Array, Array]:
        """Return how much of the normal residuals and of the lengths the tangential rows hold."""
        shear = self.shear
        return np.where(shear.grazing, 1.0, shear.friction), np.where(
            shear.grazing, 0.0, shear.wear
        )

    def slides(self, solver: ChangedRows, growth: Load) -> tuple[Slide, Slide, Slide]:
        """Return the Newton step, the responses to a unit move of the wire and to the load."""
        body, shear = self.body, self.shear
        friction, wear = self._slid_shares()
        known, right = np.zeros((body.size, 3)), np.zeros((body.size, 3))
        known[2 * self.nodes, 0] = -self.geo.gap[self.touching]
        known[2 * self.nodes, 1] = np.where(self.wire, self.turn[:, :, 0] @ _AXIS, 0.0)
        turning = self._slopes[shear.sliders] @ _AXIS
        right[:, 0] = -self.residual
        right[:, 1] = -self.centre_rate
        moving = np.where(shear.grazing, 0.0, self.centre_rate[shear.rows] + shear.force * turning)
        moving += friction * (self.centre_rate[shear.normal_rows] - shear.drag * turning)
        right[shear.rows, 1] = -(moving + wear * self._length_rate)
        growing = shear.load.growth(growth, shear.force, shear.length)
        right[shear.rows, 2] = np.where(shear.grazing, 0.0, -growing)
        self._factorize(solver)
        x, reaction = self._slid(solver, known, right)
        newton, move, grow = (
            self._slide(x[:, i], reaction[:, i], moved, self)
            for i, moved in enumerate((0.0, 1.0, 0.0))
        )
        return newton, move, grow

    def correction(  # type: ignore[override]
        self, solver: ChangedRows, at: SlidingResidual
    ) -> Slide:
        """Return the step at a fixed wire from another state with the factors of this one."""
        known = np.zeros((self.body.size, 1))
        known[2 * self.nodes, 0] = -at.geo.gap[self.touching]
        x, reaction = self._slid(solver, known, -at.residual[:, None])
        return self._slide(x[:, 0], reaction[:, 0], 0.0, at)

    def _slide(self, x: Array, reaction: Array, moved: float, at: Residual) -> Slide:
        """Return the change of which `x` and `reaction` are the turned form at a state."""
        shear, sliders = self.shear, self.shear.sliders
        pull = reaction[shear.rows] + moved * self.centre_rate[shear.rows]
        pull += moved * shear.force * (self._slopes[sliders] @ _AXIS)
        push = reaction[2 * self.nodes] + moved * self.centre_rate[2 * self.nodes]
        reaction[2 * self.nodes] = push
        d = at.direction(x, reaction)
        went = d.u[self.body.face[sliders]] - moved * _AXIS
        d.force[sliders] += shear.drag * np.einsum("ij,ij->i", self._slopes[sliders], went)
        amounts = np.zeros(len(d.force))
        amounts[sliders] = np.where(shear.held, shear.friction * d.force[sliders], -pull)
        return Slide(d.u, d.p, moved, d.force, amounts)

    def _factorize(self, solver: ChangedRows) -> None:
        additions = self.additions.copy()
        additions.data[self.fixed[additions.indices]] = 0.0
        solver.factorize(self.body.eliminate(self.matrix, self.fixed), self.places, additions)

    def _slid(self, solver: ChangedRows, known: Array, right: Array) -> tuple[Array, Array]:
        """Return solutions with known normal displacements, and what they do to the residual."""
        free = self.body.free
        scale = self.body.scale[free][:, None]
        known_free = known[free] / scale
        right_free = right[free] * scale - self.matrix @ known_free
        right_free[self.places] -= self.additions @ known_free
        right_free[self.fixed] = known_free[self.fixed]
        x = solver.solve(right_free)
        full, reaction = np.zeros(right.shape), np.zeros(right.shape)
        full[free] = x * scale
        reaction[free] = self.matrix @ x / scale
        return full, reaction

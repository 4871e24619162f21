"""A configuration of the body and the wire, and the scalar that moves it."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fe_training.mechanics import active_set as contact
from fe_training.mechanics.active_set import ActiveSet, Geometry
from fe_training.mechanics.body import Body

Array = NDArray[np.float64]


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

    def about(self, body: Body, nodes: NDArray[Any]) -> Array:
        """Return places of nodes relative to the wire's centre [R_w]."""
        return np.asarray(body.nodes[nodes] + self.u[nodes] - self.centre)

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
class Direction:
    """A change of the unknowns: displacements, pressures and normal forces."""

    u: Array
    p: Array
    force: Array

    def plus(self, other: Direction, factor: float) -> Direction:
        return Direction(
            self.u + factor * other.u,
            self.p + factor * other.p,
            self.force + factor * other.force,
        )


def _force_slope(geo: Geometry, active: ActiveSet, force: Array) -> Array:
    """Return dF_h/d(position of each touching node) due to the turning of its normal."""
    share = np.where(active.wire, force / geo.wire_distance, 0.0)
    turn = np.array([1.0, 0.0]) - geo.normal * geo.normal[:, :1]
    return np.asarray(share[:, None] * turn)


def control_rate(
    body: Body, control: Control, d: Direction, axis: Array, geo: Geometry, state: State
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

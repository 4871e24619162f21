"""Frictionless contact as an exact bound: which face nodes touch, their normals and their forces.

A node of the crack face may touch the wire (distance to its centre >= 1) or the symmetry plane
(y >= 0).  The touching set is found by a primal-dual active set: a touching node that would pull
is let go, a free node that would penetrate is taken in.  No penalty parameter enters.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fe_training.mechanics.body import Body

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

#: Pull and penetration below these count as rounding [of the total contact force; R_w].
_PULL, _PENETRATION = 1e-9, 1e-11

#: The symmetry plane is watched this far behind the wire [R_w]; further out the truncated body
#: may bend below it by an amount of no consequence.
_PLANE_REACH = 100.0


@dataclass(frozen=True, slots=True)
class ActiveSet:
    """Face nodes in contact, in the order of ``Body.face``.

    Parameters
    ----------
    wire, plane : ndarray of bool, shape (face nodes,)
        Nodes that touch the wire, and nodes that touch the symmetry plane.
    """

    wire: Flags
    plane: Flags

    @property
    def any(self) -> Flags:
        """Nodes that touch either."""
        return self.wire | self.plane

    def same(self, other: ActiveSet) -> bool:
        """Return whether the two sets hold the same nodes."""
        return bool((self.wire == other.wire).all() and (self.plane == other.plane).all())

    def key(self) -> bytes:
        """Return a hashable form."""
        return np.packbits([self.wire, self.plane]).tobytes()


def no_contact(body: Body) -> ActiveSet:
    """Return the empty set."""
    nothing = np.zeros(len(body.face), dtype=bool)
    return ActiveSet(nothing, nothing.copy())


@dataclass(frozen=True, slots=True)
class Geometry:
    """Face nodes seen from the wire: gaps and outward normals of what each node touches."""

    gap: Array
    normal: Array
    wire_distance: Array


def geometry(body: Body, u: Array, centre: Array, active: ActiveSet) -> Geometry:
    """Return gap and normal of every face node towards its own obstacle.

    Parameters
    ----------
    body : Body
    u : ndarray, shape (nodes, 2)
        Displacements [R_w].
    centre : ndarray, shape (2,)
        Centre of the wire in the deformed frame [R_w].
    active : ActiveSet
        Nodes on the plane take the plane's normal, all others the wire's.
    """
    position = body.nodes[body.face] + u[body.face]
    arm = position - centre
    distance = np.hypot(*arm.T)
    plane = active.plane
    normal = np.where(plane[:, None], [0.0, 1.0], arm / distance[:, None])
    return Geometry(np.where(plane, position[:, 1], distance - 1.0), normal, distance)


def nodal_forces(body: Body, residual: Array, geo: Geometry, active: ActiveSet) -> Array:
    """Return the normal force of each touching face node, positive when pressed [mu R_w]."""
    force = residual[: body.displacements].reshape(-1, 2)[body.face]
    return np.where(active.any, np.einsum("ij,ij->i", force, geo.normal), 0.0)


def updated(body: Body, u: Array, centre: Array, active: ActiveSet, force: Array) -> ActiveSet:
    """Return the active set after a Newton step that gave displacements `u` and forces `force`."""
    pull = -_PULL * max(float(np.abs(force).sum()), 1e-12)
    position = body.nodes[body.face] + u[body.face]
    penetrates = np.hypot(*(position - centre).T) < 1.0 - _PENETRATION
    holds = active.any & (force > pull)
    wire = np.where(active.any, holds & active.wire, penetrates)
    near = body.nodes[body.face, 0] > -_PLANE_REACH
    below = (position[:, 1] < -_PENETRATION) & near & ~body.held[body.face, 1]
    plane = np.where(active.any, holds & active.plane, below & ~penetrates)
    return ActiveSet(wire, plane)

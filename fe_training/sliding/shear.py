"""The shear traction of friction and wear on the face that slides along the wire.

The solid slips backwards along the face wherever it touches the wire, so that the traction on it,
``xi P + tau_w`` per current length, always pulls it along: from the back of the wire to its front.
A node of the face carries ``xi N_i + tau_w l_i``, with N_i its normal force and l_i the current
length that belongs to it: the integral of its shape function along the arc.  That is linear in
the angles of the nodes about the wire's centre, which the elements around the tip interpolate.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from fe_training.mechanics.body import Body
from fe_training.solver.state import State

Array = NDArray[np.float64]
Index = NDArray[np.int64]

#: Integrals of N_i dN_j over a quadratic edge: its first node, its middle, its last.
_EDGE = np.array([[-1 / 2, 2 / 3, -1 / 6], [-2 / 3, 0.0, 2 / 3], [1 / 6, -2 / 3, 1 / 2]])


@dataclass(frozen=True, slots=True)
class Load:
    """What rubs, or how fast it grows along a path.

    Parameters
    ----------
    friction : float
        Coefficient of friction xi [-].
    wear : float
        Shear stress tau_w of wear, relative to the shear modulus [-].
    taper : float
        How gently wear rises from nothing at the ends of the contact, as ``tau_w tanh(P / P_0)``
        with ``P_0 = taper tau_w``: near an end it is a friction of 1/taper [-].  0 is the full
        stress wherever there is contact.
    """

    friction: float = 0.0
    wear: float = 0.0
    taper: float = 0.0

    @property
    def total(self) -> float:
        """A size by which loads of one direction are compared [-]."""
        return self.friction + self.wear

    def __str__(self) -> str:
        return f"xi = {self.friction:.4g}, tau_w/mu = {self.wear:.4g}"

    @property
    def ramp(self) -> float:
        """The pressure P_0 [mu]."""
        return self.taper * self.wear

    @property
    def jumps(self) -> bool:
        """Whether the shear jumps from nothing where the contact begins."""
        return self.wear > 0.0 and self.taper == 0.0

    def plus(self, other: Load, factor: float = 1.0) -> Load:
        """Return this load and a multiple of another one, with the taper of this one."""
        friction = self.friction + factor * other.friction
        return replace(self, friction=friction, wear=self.wear + factor * other.wear)

    def on(self, force: Array, length: Array) -> Array:
        """Return the shear forces of nodes with normal forces and lengths [mu R_w]."""
        return self.friction * force + self.wear * length * self._grip(force, length)[0]

    def growth(self, by: Load, force: Array, length: Array) -> Array:
        """Return how fast these shear forces grow as the load does [mu R_w]."""
        # P_0 grows with tau_w, as l does at the same force: both lower P / P_0 alike
        return by.friction * force + by.wear * length * self._lasting_grip(force, length)[0]

    def slopes(self, force: Array, length: Array) -> tuple[Array, Array]:
        """Return the derivatives of the shear forces to normal forces and to lengths."""
        lasting, rise = self._lasting_grip(force, length)
        return self.friction + self.wear * rise, self.wear * lasting

    def _lasting_grip(self, force: Array, length: Array) -> tuple[Array, Array]:
        """Return the grip less what P / P_0 falling with its inverse takes, and its rise."""
        grip, rise = self._grip(force, length)
        return grip - rise * (force / length), rise

    def _grip(self, force: Array, length: Array) -> tuple[Array, Array]:
        """Return the share of tau_w that acts, and its derivative to the pressure."""
        if self.ramp == 0.0:
            return np.ones_like(force), np.zeros_like(force)
        grip = np.tanh(np.maximum(force / length, 0.0) / self.ramp)
        return grip, (1.0 - grip * grip) / self.ramp


#: The frictionless wire.
NO_LOAD = Load()


def length_operator(count: int) -> sp.csr_matrix:
    """Return the matrix that makes lengths of the angles of `count` face nodes."""
    first = np.arange(0, count - 2, 2)
    i = first[:, None, None] + np.arange(3)[:, None]
    j = first[:, None, None] + np.arange(3)
    rows, columns = np.broadcast_arrays(i, j)
    values = np.broadcast_to(_EDGE, rows.shape)
    return sp.csr_matrix((values.ravel(), (rows.ravel(), columns.ravel())), shape=(count, count))


def face_angles(body: Body, state: State) -> Array:
    """Return the angles of the face nodes about the wire's centre, from the cutting direction."""
    arm = state.about(body, body.face)
    return np.unwrap(np.arctan2(arm[:, 1], arm[:, 0]))


def face_lengths(body: Body, state: State) -> Array:
    """Return the arc of the wire, of radius one, that belongs to each face node [R_w]."""
    return np.asarray(length_operator(len(body.face)) @ face_angles(body, state))


def angle_slopes(body: Body, state: State) -> Array:
    """Return the derivative of each face node's angle to its place, shape (face nodes, 2)."""
    x, y = state.about(body, body.face).T
    return np.asarray(np.stack([-y, x], axis=1) / (x * x + y * y)[:, None])

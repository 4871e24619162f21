"""Energy release rate and force balance of a body that slides.

The domain integral of a field q that is one at the tip takes in the power of the shear wherever it
holds contact: with lambda the stretch of the face, the slip per unit advance of the wire,

    2 int (F^T P - W I) e_1 . grad q = J + 2 int q tau lambda ds,

and over all of the body it is the steady force itself, ``F_ss = J + 2 int tau lambda ds``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fe_training.mechanics.body import Body
from fe_training.sliding.shear import face_angles
from fe_training.sliding.state import SlidingState
from fe_training.solver.energy_release import domain_integral
from fe_training.solver.observe import face_stretch

Array = NDArray[np.float64]


def slip_power(body: Body, state: SlidingState, within: Array | float = 1.0) -> float:
    """Return 2 int q tau lambda ds, both halves counted [mu R_w]; q at the face nodes."""
    power = state.shear * face_stretch(body, state)
    return float(2.0 * np.sum(within * power))


def steady_force(body: Body, state: SlidingState) -> float:
    """Return F_ss, the force along the cut on both halves of the body [mu R_w]."""
    forwards = np.sin(face_angles(body, state))
    return 2.0 * (state.horizontal_force + float(state.shear @ forwards))


@dataclass(frozen=True, slots=True)
class Support:
    """Where q falls from one to zero with the logarithm of the distance from the tip [R_w]."""

    inner: float
    outer: float

    def on_face(self, body: Body) -> Array:
        """Return q at the face nodes, straight along each element's side."""
        r = np.hypot(*body.nodes[body.face].T)
        q = np.clip(np.log(self.outer / r) / np.log(self.outer / self.inner), 0.0, 1.0)
        q[1::2] = 0.5 * (q[:-1:2] + q[2::2])
        return np.asarray(q)

    def energy_release_rate(self, body: Body, state: SlidingState) -> float:
        """Return J/(mu R_w) of the whole body."""
        whole = domain_integral(body, state, self.inner, self.outer)
        if not state.active.wire.any() or not state.shear.any():
            return whole
        return whole - slip_power(body, state, self.on_face(body))

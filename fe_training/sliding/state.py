"""A configuration of the body that slides along the wire, and how it changes."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from fe_training.mechanics.body import Body
from fe_training.solver.state import State

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, eq=False)
class SlidingState(State):
    """One configuration with shear on its face.

    Parameters
    ----------
    shear : ndarray, shape (face nodes,)
        Forces that pull the nodes forwards along the face [mu R_w].
    grazing : ndarray of bool, shape (face nodes,)
        Nodes at an end of the contact that touch without pressure.  Wear jumps from 0 to tau_w as
        a node meets the wire; where it would lose the wire with the one and penetrate it with the
        other, it carries what lies between.
    position_rate : float
        dJ/dx_w at a constant load [mu]; a load that has a maximum has it where this vanishes.
    share : float
        How far along its leg the load is; the tangent is the derivative to it, or to the position
        of the wire where that is the `control`.
    pace : float
        Derivative of the share to what the tangent refers to.
    heading : float
        Which way the wire moves on steps in its position, 1 or -1; 0 before there was one.
    """

    shear: Array = field(default_factory=lambda: np.empty(0))
    grazing: Flags = field(default_factory=lambda: np.empty(0, dtype=bool))
    position_rate: float = np.nan
    share: float = 0.0
    pace: float = 1.0
    heading: float = 0.0


def without_shear(body: Body, state: State) -> SlidingState:
    """Return a state to begin from, with no shear and no tangent."""
    count = len(body.face)
    return SlidingState(
        state.u,
        state.p,
        state.centre,
        state.active,
        state.force,
        state.normal,
        shear=np.zeros(count),
        grazing=np.zeros(count, dtype=bool),
    )


@dataclass(frozen=True, slots=True, eq=False)
class Slide:
    """A change of the unknowns: displacements, pressures, position of the wire, nodal forces."""

    u: Array
    p: Array
    position: float
    force: Array
    shear: Array

    def plus(self, other: Slide, factor: float) -> Slide:
        """Return the sum of this change and a multiple of another one."""
        return Slide(
            self.u + factor * other.u,
            self.p + factor * other.p,
            self.position + factor * other.position,
            self.force + factor * other.force,
            self.shear + factor * other.shear,
        )

    def applied(self, state: SlidingState, factor: float = 1.0) -> SlidingState:
        """Return a state changed by a multiple of this."""
        return replace(
            state,
            u=state.u + factor * self.u,
            p=state.p + factor * self.p,
            centre=state.centre + factor * self.position * np.array([1.0, 0.0]),
            force=state.force + factor * self.force,
            shear=state.shear + factor * self.shear,
        )

    def as_tangent(self, state: SlidingState) -> SlidingState:
        """Return the change in the form in which a state keeps its tangent."""
        rate = np.array([self.position, 0.0])
        return replace(
            state,
            u=self.u,
            p=self.p,
            centre=rate,
            force=self.force,
            shear=self.shear,
            tangent=None,
        )

"""Newton's method for the body that slides, its energy release rate held at the toughness.

The position of the wire is one more unknown and ``J = g`` one more equation (bordering).  Where the
position no longer decides J it is prescribed, and the load is the unknown.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fe_training.mechanics.body import Body
from fe_training.sliding.balance import Support
from fe_training.sliding.ends import Ends
from fe_training.sliding.leg import Leg
from fe_training.sliding.rows import ChangedRows
from fe_training.sliding.state import Slide, SlidingState
from fe_training.sliding.tangent import SlidingLinearisation, SlidingResidual
from fe_training.solver.equilibrium import RESIDUAL_BOUND, RESIDUAL_GOAL
from fe_training.solver.state import Control, NewtonOutcome

Array = NDArray[np.float64]

_DIVERGED = 1e8

#: Relative error allowed in J.
_SAME = 1e-8

#: Part of the deformation by which states are moved for the derivative of J.
_NUDGE = 1e-5

#: As in the frictionless problem: corrections with the factors of one iteration, what each has to
#: leave of the residual, and where they end.
_CORRECTIONS, _CONTRACTION, _AIM = 8, 0.3, 1e-9


@dataclass(frozen=True, slots=True, eq=False)
class Problem:
    """What stays the same along a leg.

    Parameters
    ----------
    body : Body
    support : Support
        On which J is held.
    solver : ChangedRows
    """

    body: Body
    support: Support
    solver: ChangedRows

    def energy_release_rate(self, state: SlidingState) -> float:
        """Return J/(mu R_w)."""
        return self.support.energy_release_rate(self.body, state)

    def rate(self, state: SlidingState, d: Slide) -> np.float64:
        """Return the change of J along a change of the state."""
        step = self._nudge(state, d)
        ahead, behind = (self.energy_release_rate(d.applied(state, t)) for t in (step, -step))
        return np.float64(ahead - behind) / (2.0 * step)

    def _nudge(self, state: SlidingState, d: Slide) -> float:
        """Return a small step along a change, as seen by the elements of the support."""
        body, tip = self.body, self.body.face[0]
        near = np.hypot(*body.nodes.T) < self.support.outer
        places = body.nodes[near] + state.u[near] - body.nodes[tip] - state.u[tip]
        size, pace = np.abs(places).max(), np.abs(d.u[near] - d.u[tip]).max()
        return float(_NUDGE * min(size / max(pace, 1e-300), 1.0 / max(abs(d.position), 1e-300)))


def equilibrate(
    problem: Problem,
    start: SlidingState,
    leg: Leg,
    share: float,
    position: float | None = None,
    max_iterations: int = 15,
) -> tuple[SlidingState, NewtonOutcome]:
    """Return the equilibrium at a share of a leg, or at a position of the wire.

    Parameters
    ----------
    problem : Problem
    start : SlidingState
        Where the iterations begin.
    leg : Leg
    share : float
        How far along the leg, 0 to 1; with a position only where the iterations begin.
    position : float, optional
        x_w, at which the share that belongs to it is looked for [R_w].
    max_iterations : int
        Newton iterations allowed.

    Returns
    -------
    state : SlidingState
        The last iterate; an equilibrium, with its tangent along the leg, only if the outcome says
        so.
    outcome : NewtonOutcome
    """
    with np.errstate(all="ignore"):  # a diverging iterate is caught by its residual
        return _Newton(problem, leg, share, position).solve(start, max_iterations)


class _Newton:
    """Newton's method at one point of a leg; see :func:`equilibrate`."""

    def __init__(
        self, problem: Problem, leg: Leg, share: float, position: float | None = None
    ) -> None:
        self.problem, self.body, self.leg, self.position = problem, problem.body, leg, position
        self.share, self.goal = share, leg.at(share)
        self.ends = Ends(self.body, self.goal.load)

    def _load_by(self, change: float) -> None:
        """Move along the leg."""
        self.share += change
        self.goal = self.leg.at(self.share)
        self.ends.load = self.goal.load

    def solve(self, state: SlidingState, max_iterations: int) -> tuple[SlidingState, NewtonOutcome]:
        for iteration in range(max_iterations):
            lin = SlidingLinearisation(self.body, state, self.goal.load)
            norm = lin.norm()
            if not norm < _DIVERGED:
                return state, NewtonOutcome.DIVERGED
            there = self._stepped(lin.sliding, self._newton(lin))
            settled = self.ends.settled(state, there)
            state = there
            if settled:
                state, residual = self._corrected(lin, state, norm)
                if residual is not None:
                    done = replace(
                        state,
                        **self._onwards(state),
                        residual=residual,
                        position_rate=float(self.per_move),
                        iterations=iteration + 1,
                    )
                    return done, NewtonOutcome.CONVERGED
            if self.ends.cycled:
                return state, NewtonOutcome.CYCLED
        return state, NewtonOutcome.STALLED

    def _newton(self, lin: SlidingLinearisation) -> Slide:
        """Return the Newton step at a fixed wire; keep the responses to the wire and the load."""
        newton, self.move, self.grow = lin.slides(self.problem.solver, self.leg.growth)
        self.per_move = self.problem.rate(lin.sliding, self.move)
        self.per_load = self.problem.rate(lin.sliding, self.grow)
        return newton

    def _onwards(self, state: SlidingState) -> dict[str, Any]:
        """Return the derivative of the state to the share of the leg or to the position."""
        if self.position is None:
            control, pace = None, 1.0
            slide = self.grow.plus(self.move, self._lacking / self.per_move)
        else:
            control, pace = Control.POSITION, float(self.per_move / self._lacking)
            slide = self.move.plus(self.grow, pace)
        tangent = slide.as_tangent(state)
        return {"tangent": tangent, "control": control, "share": self.share, "pace": pace}

    @property
    def _lacking(self) -> np.float64:
        """How fast J falls behind g along the leg, the wire at rest."""
        return np.float64(self.leg.toughening(self.share) - self.per_load)

    def _missing(self, state: SlidingState) -> float:
        return self.goal.g - self.problem.energy_release_rate(state)

    def _stepped(self, state: SlidingState, newton: Slide) -> SlidingState:
        """Return the state after a step that meets J = g."""
        change = self._missing(state) - self.problem.rate(state, newton)
        if self.position is None:
            step = newton.plus(self.move, float(change / self.per_move))
        else:
            move = self.position - state.centre[0]
            load = float((self.per_move * move - change) / self._lacking)
            step = newton.plus(self.move, move).plus(self.grow, load)
            self._load_by(load)
        return self.ends.updated(step.applied(state))

    def _corrected(
        self, lin: SlidingLinearisation, state: SlidingState, previous: float
    ) -> tuple[SlidingState, float | None]:
        """Return the state corrected with the factors at hand, and its residual if it converged."""
        for correction in range(_CORRECTIONS):
            at = SlidingResidual(self.body, state, self.goal.load)
            norm = at.norm()
            met = abs(self._missing(at.sliding)) < _SAME * self.goal.g
            slow = not norm < _CONTRACTION * previous
            bound = RESIDUAL_GOAL if correction else RESIDUAL_BOUND
            if met and (norm < _AIM or (slow and norm < bound)):
                return at.sliding, norm
            if slow:
                return state, None
            there = self._stepped(at.sliding, lin.correction(self.problem.solver, at))
            settled, state, previous = self.ends.settled(state, there), there, norm
            if not settled:
                break
        return state, None

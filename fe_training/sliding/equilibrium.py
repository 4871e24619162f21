"""Newton's method for the body that slides, its energy release rate held at the toughness.

The position of the wire is one more unknown and ``J = g`` one more equation (bordering).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fe_training.mechanics import active_set as contact
from fe_training.mechanics.body import Body
from fe_training.sliding.balance import Support
from fe_training.sliding.leg import Leg
from fe_training.sliding.rows import ChangedRows
from fe_training.sliding.shear import NO_LOAD, Load
from fe_training.sliding.tangent import SlidingLinearisation, SlidingResidual
from fe_training.solver.equilibrium import RESIDUAL_BOUND, RESIDUAL_GOAL
from fe_training.solver.state import Direction, NewtonOutcome, State

Array = NDArray[np.float64]

_AXIS = np.array([1.0, 0.0])
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

    def energy_release_rate(self, state: State, load: Load) -> float:
        """Return J/(mu R_w)."""
        return self.support.energy_release_rate(self.body, state, load)

    def rate(self, state: State, load: Load, d: Direction, moved: float, growth: Load) -> float:
        """Return the change of J along a direction in which the wire moves and the load grows."""
        step = self._nudge(state, d, moved)
        ahead, behind = (
            self.energy_release_rate(_moved(state, d, t, moved), load.plus(growth, t))
            for t in (step, -step)
        )
        return (ahead - behind) / (2.0 * step)

    def _nudge(self, state: State, d: Direction, moved: float) -> float:
        """Return a small step along a direction, as seen by the elements of the support."""
        body, tip = self.body, self.body.face[0]
        near = np.hypot(*body.nodes.T) < self.support.outer
        places = body.nodes[near] + state.u[near] - body.nodes[tip] - state.u[tip]
        size, pace = np.abs(places).max(), np.abs(d.u[near] - d.u[tip]).max()
        return float(_NUDGE * min(size / max(pace, 1e-300), 1.0 / max(abs(moved), 1e-300)))


def _moved(state: State, d: Direction, step: float, moved: float) -> State:
    return replace(
        state,
        u=state.u + step * d.u,
        p=state.p + step * d.p,
        force=state.force + step * d.force,
        centre=state.centre + step * moved * _AXIS,
    )


def equilibrate(
    problem: Problem, start: State, leg: Leg, share: float, max_iterations: int = 15
) -> tuple[State, NewtonOutcome]:
    """Return the equilibrium at a share of a leg.

    Parameters
    ----------
    problem : Problem
    start : State
        Where the iterations begin.
    leg : Leg
    share : float
        How far along the leg, 0 to 1.
    max_iterations : int
        Newton iterations allowed.

    Returns
    -------
    state : State
        The last iterate; an equilibrium, with its tangent along the leg, only if the outcome says
        so.
    outcome : NewtonOutcome
    """
    with np.errstate(all="ignore"):  # a diverging iterate is caught by its residual
        return _Newton(problem, leg, share).solve(start, max_iterations)


class _Newton:
    """Newton's method at one point of a leg; see :func:`equilibrate`."""

    def __init__(self, problem: Problem, leg: Leg, share: float) -> None:
        self.problem, self.body, self.leg, self.share = problem, problem.body, leg, share
        self.goal = leg.at(share)

    def solve(self, state: State, max_iterations: int) -> tuple[State, NewtonOutcome]:
        seen: set[bytes] = set()
        for iteration in range(max_iterations):
            lin = SlidingLinearisation(self.body, state, self.goal.load)
            state, norm = lin.state, lin.norm()
            if not norm < _DIVERGED:
                return state, NewtonOutcome.DIVERGED
            newton = self._directions(lin)
            there = self._stepped(state, newton)
            settled = there.active.same(state.active)
            if not settled and norm < RESIDUAL_BOUND:
                if there.active.key() in seen:
                    return state, NewtonOutcome.CYCLED
                seen.add(there.active.key())
            state = there
            if settled:
                state, residual = self._corrected(lin, state, norm)
                if residual is not None:
                    done = replace(
                        state,
                        tangent=self._tangent(lin.state),
                        control=None,
                        residual=residual,
                        iterations=iteration + 1,
                    )
                    return done, NewtonOutcome.CONVERGED
        return state, NewtonOutcome.STALLED

    def _directions(self, lin: SlidingLinearisation) -> Direction:
        """Return the Newton step at a fixed wire; keep the responses to the wire and the load."""
        problem, load, growth = self.problem, self.goal.load, self.leg.growth
        newton, self.move, self.grow = lin.sliding_directions(problem.solver, growth)
        self.per_move = problem.rate(lin.state, load, self.move, 1.0, NO_LOAD)
        self.per_load = problem.rate(lin.state, load, self.grow, 0.0, growth)
        return newton

    def _tangent(self, state: State) -> State:
        """Return the derivative of the state to the share of the leg."""
        way = (self.leg.toughening(self.share) - self.per_load) / self.per_move
        d = self.grow.plus(self.move, way)
        return State(d.u, d.p, way * _AXIS, state.active, d.force, state.normal)

    def _missing(self, state: State) -> float:
        return self.goal.g - self.problem.energy_release_rate(state, self.goal.load)

    def _stepped(self, state: State, newton: Direction) -> State:
        """Return the state after a step that meets J = g."""
        drift = self.problem.rate(state, self.goal.load, newton, 0.0, NO_LOAD)
        change = (self._missing(state) - drift) / self.per_move
        step = newton.plus(self.move, change)
        there = _moved(state, step, 1.0, 0.0)
        centre = state.centre + change * _AXIS
        active = contact.updated(self.body, there.u, centre, state.active, there.force)
        return replace(there, centre=centre, active=active)

    def _corrected(
        self, lin: SlidingLinearisation, state: State, previous: float
    ) -> tuple[State, float | None]:
        """Return the state corrected with the factors at hand, and its residual if it converged."""
        for correction in range(_CORRECTIONS):
            at = SlidingResidual(self.body, state, self.goal.load)
            norm = at.norm()
            met = abs(self._missing(at.state)) < _SAME * self.goal.g
            slow = not norm < _CONTRACTION * previous
            bound = RESIDUAL_GOAL if correction else RESIDUAL_BOUND
            if met and (norm < _AIM or (slow and norm < bound)):
                return at.state, norm
            if slow:
                return state, None
            newton = lin.sliding_correction(self.problem.solver, at)
            there = self._stepped(at.state, newton)
            settled, state, previous = there.active.same(state.active), there, norm
            if not settled:
                break
        return state, None

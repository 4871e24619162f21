"""Following a leg: predictor along the tangent, step control.

Steps are in the load, until the position of the wire hardly decides J any more: from there on they
are in the position, which goes on where the load has a maximum.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import copysign

from fe_training.mechanics.active_set import ActiveSet
from fe_training.sliding.equilibrium import Problem, equilibrate
from fe_training.sliding.leg import Leg
from fe_training.sliding.state import SlidingState
from fe_training.solver.path import LEAST_DETERMINANT, least_determinant
from fe_training.solver.predictor import moved_around, share_step, will_touch
from fe_training.solver.state import Control, NewtonOutcome

#: Nodes that may meet or leave the wire in one step, relative to those that touch it.
_SHARE = 0.15
_QUICK, _GROWTH = 4, 1.5


class SlidingStalledError(RuntimeError):
    """No acceptable equilibrium was found at the smallest step.

    Parameters
    ----------
    share : float
        How far along the leg it was tried.
    outcome : NewtonOutcome
        How the last attempt ended; CONVERGED means that the state found had folded elements.
    """

    def __init__(self, share: float, outcome: NewtonOutcome) -> None:
        self.share, self.outcome = share, outcome
        super().__init__(f"no equilibrium at {share:.6g} of the leg ({outcome.value})")


@dataclass(frozen=True, slots=True)
class Steps:
    """Sizes of steps, as shares of a leg."""

    first: float = 0.05
    largest: float = 0.25
    smallest: float = 1e-4


#: Sizes of steps in the position of the wire [R_w].
_IN_POSITION = Steps(first=0.05, largest=0.5, smallest=1e-4)


def by_position(state: SlidingState) -> SlidingState:
    """Return a state whose tangent and steps are by the wire's position instead of the load."""
    t = state.tangent
    if t is None or state.control is Control.POSITION:
        return state
    assert isinstance(t, SlidingState)
    rate = float(t.centre[0])
    along = replace(
        t,
        u=t.u / rate,
        p=t.p / rate,
        centre=t.centre / rate,
        force=t.force / rate,
        shear=t.shear / rate,
    )
    heading = state.heading or copysign(1.0, rate)
    step = heading * (abs(state.step * rate) or _IN_POSITION.first)
    return replace(
        state,
        tangent=along,
        control=Control.POSITION,
        pace=1.0 / rate,
        step=step,
        heading=heading,
    )


def predicted(problem: Problem, state: SlidingState, step: float) -> SlidingState:
    """Return the state moved along its tangent."""
    if state.tangent is None or step == 0.0:
        return state
    body, t = problem.body, state.tangent
    touching = will_touch(body, state, step)
    return replace(
        state,
        u=moved_around(body, state, step),
        p=state.p + step * t.p,
        centre=state.centre + step * t.centre,
        active=ActiveSet(touching.wire | state.grazing, touching.plane),
    )


def attempt(
    problem: Problem,
    start: SlidingState,
    leg: Leg,
    share: float,
    position: float | None = None,
) -> tuple[SlidingState | None, NewtonOutcome]:
    """Return the equilibrium at a share of a leg or at a position, or None if none is sound."""
    reached, outcome = equilibrate(problem, start, leg, share, position)
    if outcome is not NewtonOutcome.CONVERGED:
        return None, outcome
    if least_determinant(problem.body, reached, problem.body.beyond_notch) < LEAST_DETERMINANT:
        return None, outcome
    return reached, outcome


def settled(problem: Problem, start: SlidingState, leg: Leg) -> SlidingState:
    """Return the equilibrium where a state is on its leg, by what its steps are in.

    Raises
    ------
    SlidingStalledError
    """
    position = float(start.centre[0]) if start.control is Control.POSITION else None
    reached, outcome = attempt(problem, start, leg, start.share, position)
    if reached is None:
        raise SlidingStalledError(start.share, outcome)
    return reached


def follow(
    problem: Problem,
    state: SlidingState,
    leg: Leg,
    steps: Steps | None = None,
    flat: float = 0.0,
) -> Iterator[SlidingState]:
    """Yield equilibria along a leg, the last of them at its end.

    Parameters
    ----------
    problem : Problem
    state : SlidingState
        An equilibrium on the leg, with its tangent along it.
    leg : Leg
    steps : Steps
    flat : float
        dJ/dx_w below which steps are in the position of the wire [mu]; 0 where it scatters, so that
        its sign tells nothing.

    Raises
    ------
    SlidingStalledError
    """
    steps = steps or Steps()
    while state.share < 1.0:
        if abs(state.position_rate) < flat:
            state = by_position(state)
        state = _next(problem, state, leg, _IN_POSITION if state.control else steps, flat > 0.0)
        yield state


def _next(
    problem: Problem, state: SlidingState, leg: Leg, steps: Steps, smooth: bool
) -> SlidingState:
    """Return the next equilibrium along a leg, with the size of the step after it."""
    size, sign = abs(state.step) or steps.first, copysign(1.0, state.step or 1.0)
    reach = share_step(problem.body, state, sign, _SHARE) if state.tangent else size
    outcome = NewtonOutcome.STALLED
    while size >= steps.smallest:
        step = max(min(size, reach), steps.smallest)
        start, share, position = _ahead(problem, state, sign * step)
        reached, outcome = attempt(problem, start, leg, share, position)
        if reached is None or (smooth and _on_the_other_side(state, reached)):
            size = 0.5 * step
        elif reached.control is not state.control:
            return replace(reached, step=0.0)
        else:
            grown = _GROWTH if reached.iterations <= _QUICK else 1.0
            return replace(reached, step=sign * min(grown * size, steps.largest))
    raise SlidingStalledError(state.share, outcome)


def _on_the_other_side(state: SlidingState, reached: SlidingState) -> bool:
    """Return whether a step in the load led to the branch beyond the maximum of the load."""
    return reached.control is None and state.position_rate * reached.position_rate < 0.0


def _ahead(
    problem: Problem, state: SlidingState, step: float
) -> tuple[SlidingState, float, float | None]:
    """Return a state a step further, or at the end of the leg, its share, and its position."""
    share = state.share + step * state.pace
    if share + 0.2 * step * state.pace > 1.0:
        return predicted(problem, state, (1.0 - state.share) / state.pace), 1.0, None
    position = None if state.control is None else float(state.centre[0]) + step
    return predicted(problem, state, step), share, position

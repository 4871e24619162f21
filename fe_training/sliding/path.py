"""Following a leg: predictor along the tangent, step control."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from fe_training.mechanics.active_set import ActiveSet
from fe_training.sliding.equilibrium import Problem, equilibrate
from fe_training.sliding.leg import Leg
from fe_training.sliding.state import SlidingState
from fe_training.solver.path import LEAST_DETERMINANT, least_determinant
from fe_training.solver.predictor import moved_around, share_step, will_touch
from fe_training.solver.state import NewtonOutcome

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
    problem: Problem, start: SlidingState, leg: Leg, share: float
) -> tuple[SlidingState | None, NewtonOutcome]:
    """Return the equilibrium at a share of a leg, or None if there is none that is sound."""
    reached, outcome = equilibrate(problem, start, leg, share)
    if outcome is not NewtonOutcome.CONVERGED:
        return None, outcome
    if least_determinant(problem.body, reached, problem.body.beyond_notch) < LEAST_DETERMINANT:
        return None, outcome
    return reached, outcome


def follow(
    problem: Problem,
    state: SlidingState,
    leg: Leg,
    steps: Steps | None = None,
    here: float = 0.0,
) -> Iterator[tuple[float, SlidingState]]:
    """Yield shares and equilibria along a leg, the last of them at its end.

    Parameters
    ----------
    problem : Problem
    state : SlidingState
        The equilibrium at `here`, with its tangent along the leg.
    leg : Leg
    steps : Steps
    here : float

    Raises
    ------
    SlidingStalledError
    """
    steps = steps or Steps()
    size = state.step or steps.first
    while here < 1.0:
        step = min(size, share_step(problem.body, state, 1.0, _SHARE)) if state.tangent else size
        step = max(step, steps.smallest)
        there = 1.0 if here + 1.2 * step > 1.0 else here + step
        start = predicted(problem, state, there - here)
        reached, outcome = attempt(problem, start, leg, there)
        if reached is None:
            size = 0.5 * min(size, there - here)
            if size < steps.smallest:
                raise SlidingStalledError(there, outcome)
            continue
        if reached.iterations <= _QUICK:
            size = min(size * _GROWTH, steps.largest)
        state, here = replace(reached, step=size), there
        yield here, state

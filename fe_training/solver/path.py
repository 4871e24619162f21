"""Following a path of equilibria: step control, acceptance, and landing on a wanted value."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fe_training.mechanics import ogden
from fe_training.mechanics.body import Body
from fe_training.solver.equilibrium import (
    AIM,
    PASSED_BY,
    Control,
    NewtonOutcome,
    State,
    control_value,
    equilibrate,
)
from fe_training.solver.linear_solvers import LinearSolver
from fe_training.solver.predictor import contact_step

#: A state with an element turned inside out by more than this is another branch.  Single elements
#: at the end of the contact fold a little.
LEAST_DETERMINANT = -2.0
_QUICK = 8
_GROWTH = 1.3
_SMALLEST_SHARE = 1 / 64
_SECANTS = 12

#: Nodes that may meet or leave the wire in one step, relative to those that touch it, and the
#: largest relative change of the horizontal force.
_SHARE, _FORCE_STEP = 0.15, 0.26


class PathStalledError(RuntimeError):
    """No acceptable equilibrium was found at the smallest step.

    Parameters
    ----------
    state : State
        The last equilibrium.
    control : Control
        What was moved.
    value : float
        Where it was tried.
    outcome : NewtonOutcome
        How the last attempt ended; CONVERGED means that the state found had folded elements.
    """

    def __init__(
        self, state: State, control: Control, value: float, outcome: NewtonOutcome
    ) -> None:
        self.state, self.control, self.value, self.outcome = state, control, value, outcome
        super().__init__(f"{control.value}: no equilibrium at {value:.6g} ({outcome.value})")


def least_determinant(
    body: Body, state: State, elements: NDArray[np.int64] | slice = slice(None)
) -> float:
    """Return the smallest det F over the quadrature points of some elements, by default all."""
    H = body.displacement_gradient(state.u, elements, state.centre)
    return float(1.0 + ogden.volume_change(H).min())


@dataclass(frozen=True, slots=True)
class Steps:
    """Step sizes of one stretch of a path.

    Parameters
    ----------
    first, largest : float
        In the unit of the control; a path that goes on keeps the size that it had.
    """

    first: float
    largest: float


def attempt(
    body: Body,
    state: State,
    control: Control,
    target: float,
    solver: LinearSolver,
    enough: float = AIM,
    guarded: bool = True,
) -> tuple[State | None, NewtonOutcome]:
    """Return the equilibrium at one value of a control, None unless it is to be accepted."""
    # forces are prescribed at high toughness, where the guard would make Newton's method crawl
    guarded = guarded and control is not Control.FORCE
    found, outcome = equilibrate(
        body, state, control, target, solver, guarded=guarded, enough=enough
    )
    if outcome is not NewtonOutcome.CONVERGED:
        return None, outcome
    if least_determinant(body, found, body.beyond_notch) < LEAST_DETERMINANT:
        return None, outcome
    return found, outcome


def _bound(body: Body, state: State, control: Control, sign: float) -> float:
    """Return the largest step of a control from here, infinite for all but the force."""
    if control is not Control.FORCE:
        return np.inf
    relative = _FORCE_STEP * abs(state.horizontal_force)
    return min(relative, contact_step(body, state, control, sign, _SHARE))


def in_one_step(body: Body, state: State, control: Control, end: float) -> bool:
    """Return whether one step from a state with a tangent may reach a value of its control."""
    way = end - control_value(body, state, control)
    return state.tangent is not None and abs(way) <= _bound(body, state, control, np.sign(way))


def follow(
    body: Body,
    state: State,
    control: Control,
    end: float,
    steps: Steps,
    solver: LinearSolver,
) -> Iterator[State]:
    """Yield states on the way to `end`, the last of them the equilibrium there.

    Those that are only passed by have residuals below :data:`PASSED_BY`.

    Parameters
    ----------
    body : Body
    state : State
        Where the path begins; not yielded.
    control : Control
        What is moved.
    end : float
        Where to.
    steps : Steps
        Step sizes; a step that fails is halved, one that converges quickly grows.
    solver : LinearSolver

    Raises
    ------
    PathStalledError
        If even 1/64 of the first step fails.
    """
    here = control_value(body, state, control)
    sign = np.sign(end - here)
    size = min(state.step, steps.largest) if state.control is control else 0.0
    size = size or steps.first
    while sign * (end - here) > 1e-12 * max(1.0, abs(end)):
        step = min(size, _bound(body, state, control, sign))
        there = here + sign * step
        if sign * (end - there) < 0.2 * step:
            there = end
        enough = AIM if there == end else PASSED_BY
        found, outcome = attempt(body, state, control, there, solver, enough)
        if found is None:
            size = 0.5 * min(size, abs(there - here))
            if size < _SMALLEST_SHARE * steps.first:
                raise PathStalledError(state, control, there, outcome)
            continue
        state, here = found, end if there == end else control_value(body, found, control)
        if state.iterations <= _QUICK:
            size = min(size * _GROWTH, steps.largest)
        state = replace(state, step=size)
        yield state


def land(
    body: Body,
    state: State,
    control: Control,
    measure: Callable[[State], float],
    target: float,
    known: list[tuple[float, float]],
    solver: LinearSolver,
    tolerance: float = 1e-6,
) -> State:
    """Return the equilibrium at which ``log(measure)`` meets its target, by the secant method.

    Parameters
    ----------
    body : Body
    state : State
        An equilibrium near the one wanted.
    control : Control
        What is moved to get there.
    measure : callable
        A positive, monotonic function of the state, such as J.
    target : float
        Its wanted value.
    known : list of (control value, measure)
        Two points at least, passed or estimated; the nearest two start the secant.
    solver : LinearSolver
    tolerance : float
        Relative error allowed.

    Raises
    ------
    PathStalledError
        If an equilibrium on the way is not found, or the target is not met in twelve steps.
    """
    miss = [(abs(np.log(m / target)), x, np.log(m)) for x, m in known]
    (_, x0, y0), (_, x1, y1) = sorted(miss)[:2]
    goal = np.log(target)
    for _ in range(_SECANTS):
        x = x0 + (goal - y0) * (x1 - x0) / (y1 - y0)
        found, outcome = attempt(body, state, control, x, solver, guarded=False)
        if found is None:
            raise PathStalledError(state, control, x, outcome)
        state = found
        x1, y1, x0, y0 = x0, y0, x, np.log(measure(state))
        if abs(y0 - goal) < tolerance:
            return state
    raise PathStalledError(state, control, x, NewtonOutcome.STALLED)

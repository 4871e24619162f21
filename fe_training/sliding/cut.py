"""A body that is cut by a wire that rubs: paths in the load, the mesh adapted, and records."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fe_training.mechanics.body import Body
from fe_training.sliding.balance import Support, slip_power, steady_force
from fe_training.sliding.equilibrium import Problem
from fe_training.sliding.leg import Leg, Point
from fe_training.sliding.path import SlidingStalledError, Steps, follow, settled
from fe_training.sliding.record import (
    BALANCE_BOUND,
    CREASE_STRETCH,
    SlidingOutcome,
    SlidingRecord,
)
from fe_training.sliding.rows import ChangedRows
from fe_training.sliding.shear import Load, face_angles
from fe_training.sliding.state import SlidingState, without_shear
from fe_training.solver import observe
from fe_training.solver.adapt import refined
from fe_training.solver.cut import Cut, at_ends
from fe_training.solver.path import least_determinant
from fe_training.solver.state import Control, NewtonOutcome, State, control_value

Array = NDArray[np.float64]

#: Shares of the scatter of det F from which on elements are split: after a step that leaves more
#: than the whole of it, and where a path stalls.
_SPLIT_SHARE, _RESCUE_SHARES = 0.5, (0.25,)

#: The stretch of the face is looked at beyond this many notch radii.
_NOTCH_REACH = 10.0

#: Current length of the pieces on which it is taken, relative to the distance from the tip along
#: the face where that is below one wire radius [R_w].
_PIECE = 0.05

#: Steps are in the position of the wire once dJ/dx_w is below this share of what it was at first.
_FLAT = 0.3

#: A load that fell to this share of the largest one has passed its maximum.
_FALLEN = 0.99

#: A path ends rather than take a larger body [unknowns].
MOST_UNKNOWNS = 120_000


class SlidingEndError(RuntimeError):
    """A path in the load came to its end; the outcome says why."""

    def __init__(self, outcome: SlidingOutcome, reason: str) -> None:
        self.outcome = outcome
        super().__init__(reason)


class Top(NamedTuple):
    """Where a path has its largest load."""

    body: Body
    problem: Problem
    state: SlidingState
    point: Point


class SlidingCut:
    """A body of one material at one g, with a wire whose friction and wear grow.

    Parameters
    ----------
    cut : Cut
        The body; its mesh is adapted on the way.
    state : State
        A frictionless equilibrium.
    taper : float
        How gently wear rises at the ends of the contact, see
        :class:`fe_training.sliding.shear.Load` [-].
    """

    def __init__(self, cut: Cut, state: State, taper: float = 0.0) -> None:
        self.cut = cut
        self._on(state)
        self.state = without_shear(cut.body, state)
        self.point = Point(self.problem.energy_release_rate(self.state), Load(taper=taper))
        arc = observe.contact_arc(cut.body, state)
        self.first_arc, self.first_load = arc.slip_arc, arc.slip_load
        self._top = Top(cut.body, self.problem, self.state, self.point)
        self.steps, self._rate, self._clock = 0, 0.0, time.process_time()

    def _on(self, state: State) -> None:
        """Take up the body of the cut."""
        support = Support(*self.cut.supports(state)[0])
        self.problem = Problem(self.cut.body, support, ChangedRows(self.cut.settings.solver))

    def moved(self, end: Point, steps: Steps | None = None) -> Iterator[float]:
        """Follow the straight way to another point; yield the share gone after each step.

        Raises
        ------
        SlidingEndError
            If the path ends before.
        """
        leg, rescues = Leg(self.point, end), 0
        start = replace(self.state, control=None, share=0.0)
        self._take(settled(self.problem, start, leg), leg)
        self._rate = self._rate or abs(self.state.position_rate)
        while self.state.share < 1.0:
            try:
                for state in follow(self.problem, self.state, leg, steps, self._flat(leg)):
                    rescues = 0
                    self.steps += 1
                    self._take(state, leg)
                    self._check()
                    adapted = self._adapted(leg)
                    yield self.state.share
                    if adapted:
                        break
            except SlidingStalledError as error:
                if rescues == len(_RESCUE_SHARES):
                    raise self._stalled(error) from None
                self._rescue(leg, _RESCUE_SHARES[rescues], error)
                rescues += 1

    def _flat(self, leg: Leg) -> float:
        """Return dJ/dx_w below which steps are in the position of the wire.

        Not where wear jumps at the ends of the contact: there dJ/dx_w scatters, and the load falls
        as a node leaves the wire.
        """
        return 0.0 if leg.end.load.jumps else _FLAT * self._rate

    def _take(self, state: SlidingState, leg: Leg) -> None:
        """Take up an equilibrium on a leg, and remember that of the largest load."""
        self.state, self.point = state, leg.at(state.share)
        if self._top.point.load.total <= self.point.load.total:
            self._top = Top(self.cut.body, self.problem, self.state, self.point)

    def _check(self) -> None:
        least, angle = self.least_stretch()
        load, largest = self.point.load, self._top.point.load
        if least < CREASE_STRETCH:
            raise SlidingEndError(
                SlidingOutcome.CREASED,
                f"the face is compressed to {least:.3f} of its length at "
                f"{np.degrees(angle):.0f} degrees, at {load}",
            )
        if load.total < _FALLEN * largest.total:
            raise SlidingEndError(
                SlidingOutcome.LIMIT,
                f"the load has its maximum at {largest}; as the wire went on it fell to {load}",
            )

    def _stalled(self, error: SlidingStalledError) -> SlidingEndError:
        folded = error.outcome is NewtonOutcome.CONVERGED
        return SlidingEndError(
            SlidingOutcome.FOLDED if folded else SlidingOutcome.STALLED,
            f"no equilibrium beyond {self.point.load} ({error.outcome.value})",
        )

    def _adapted(self, leg: Leg) -> bool:
        """Refine where det F scatters too much; return whether there was anything to refine."""
        allowed = self.cut.settings.scatter
        if not len(self.cut.scattered(self.state, allowed)):
            return False
        self._split(leg, self.cut.scattered(self.state, _SPLIT_SHARE * allowed))
        return True

    def _rescue(self, leg: Leg, share: float, error: SlidingStalledError) -> None:
        split = self.cut.scattered(self.state, share * self.cut.settings.scatter)
        ends = at_ends(self.cut.body, self.state)
        try:
            self._split(leg, np.union1d(split, ends))
        except SlidingStalledError:
            raise self._stalled(error) from None
        self.state = replace(self.state, step=0.0)

    def _split(self, leg: Leg, elements: NDArray[np.int64]) -> None:
        """Split elements, and let the body settle."""
        body, carried = refined(self.cut.body, self.state, elements)
        if int(body.free.sum()) > MOST_UNKNOWNS:
            raise SlidingEndError(
                SlidingOutcome.TOO_LARGE, f"the mesh has more than {MOST_UNKNOWNS:,} unknowns"
            )
        count = len(body.face)
        assert isinstance(carried, SlidingState)
        start = replace(carried, shear=np.zeros(count), grazing=np.zeros(count, dtype=bool))
        before, step = (self.cut.body, self.problem), self.state.step
        self.cut.body = body
        self._on(start)
        try:
            self._take(replace(settled(self.problem, start, leg), step=step), leg)
        except SlidingStalledError:
            self.cut.body, self.problem = before
            raise

    def least_stretch(self) -> tuple[float, float]:
        """Return the smallest stretch of the face beyond the notch, and its angle [rad].

        On the average of short pieces: strains are logarithmic where the shear of wear ends.
        """
        body, state = self.cut.body, self.state
        beyond = body.along_face > _NOTCH_REACH * body.notch_radius
        place = state.about(body, body.face)
        before = body.along_face
        after = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(place, axis=0).T))])
        half = 0.5 * _PIECE * np.minimum(after, 1.0)[beyond]
        back = np.interp(after[beyond] - half, after, before)
        front = np.interp(after[beyond] + half, after, before)
        stretch = 2.0 * half / (front - back)
        least = int(np.argmin(stretch))
        return float(stretch[least]), float(face_angles(body, state)[beyond][least])

    def record(self, target: Point) -> SlidingRecord:
        """Return the record of the configuration that was reached."""
        body, state, point = self.cut.body, self.state, self.point
        arc = observe.contact_arc(body, state)
        J, *across = [
            Support(*support).energy_release_rate(body, state)
            for support in self.cut.supports(state)
        ]
        least, angle = self.least_stretch()
        record = SlidingRecord(
            alpha=body.alpha,
            target=target.g,
            target_friction=target.load.friction,
            target_wear=target.load.wear,
            outcome=SlidingOutcome.CONVERGED,
            friction=point.load.friction,
            wear=point.load.wear,
            ramp=point.load.ramp,
            energy_release_rate=J,
            steady_force=steady_force(body, state),
            slip_power=slip_power(body, state),
            first_arc=self.first_arc,
            first_load=self.first_load,
            theta_1=arc.theta_1,
            theta_2=arc.theta_2,
            horizontal_force=state.horizontal_force,
            vertical_force=state.vertical_force,
            slip_arc=arc.slip_arc,
            slip_load=arc.slip_load,
            distance=control_value(body, state, Control.DISTANCE),
            insertion=float(state.centre[0]),
            energy_release_rate_across=tuple(across),
            least_stretch=least,
            least_stretch_angle=angle,
            position_rate=state.position_rate,
            touches_tip=bool(state.active.wire[0]),
            touches_plane=bool(state.active.plane.any()),
            grazing=int(state.grazing.sum()),
            pull=max(0.0, -float(state.force.min() / np.abs(state.force).sum())),
            residual=state.residual,
            iterations=state.iterations,
            steps=self.steps,
            min_determinant=least_determinant(body, state, body.beyond_notch),
            max_stretch=float(observe.principal_stretch(body, state).max()),
            notch_radius=self.cut.spec.notch_radius,
            unknowns=int(body.free.sum()),
            processor_time=self._elapsed(),
        )
        if record.balance_error <= BALANCE_BOUND:
            return record
        return replace(record, outcome=SlidingOutcome.OUTSIDE_EVIDENCE)

    def failure(self, target: Point, error: SlidingEndError) -> SlidingRecord:
        """Return the record of a configuration before which the path ended.

        It has the numbers of the largest load that was reached.
        """
        top = self._top
        self.cut.body, self.problem, self.state, self.point = (
            top.body,
            top.problem,
            top.state,
            top.point,
        )
        return replace(self.record(target), outcome=error.outcome, reason=str(error))

    def _elapsed(self) -> float:
        now = time.process_time()
        elapsed, self._clock = now - self._clock, now
        return elapsed

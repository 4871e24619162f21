"""A body that is cut by a wire that rubs: paths in the load, the mesh adapted, and records."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from fe_training.sliding.balance import Support, slip_power, steady_force
from fe_training.sliding.equilibrium import Problem
from fe_training.sliding.leg import Leg, Point
from fe_training.sliding.limit import limit_of
from fe_training.sliding.path import SlidingStalledError, Steps, attempt, follow
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

#: A path ends rather than take a larger body [unknowns].
MOST_UNKNOWNS = 120_000


class SlidingEndError(RuntimeError):
    """A path in the load came to its end; the outcome says why."""

    def __init__(self, outcome: SlidingOutcome, reason: str) -> None:
        self.outcome = outcome
        super().__init__(reason)


class SlidingCut:
    """A body of one material at one g, with a wire whose friction and wear grow.

    Parameters
    ----------
    cut : Cut
        The body; its mesh is adapted on the way.
    state : State
        A frictionless equilibrium.
    ramp : float
        Pressure over which wear rises at the ends of the contact, see
        :class:`fe_training.sliding.shear.Load` [mu].
    """

    def __init__(self, cut: Cut, state: State, ramp: float = 0.0) -> None:
        self.cut = cut
        self._on(state)
        self.state = without_shear(cut.body, state)
        self.point = Point(self.problem.energy_release_rate(self.state), Load(ramp=ramp))
        arc = observe.contact_arc(cut.body, state)
        self.first_arc, self.first_load = arc.slip_arc, arc.slip_load
        self.steps, self._clock = 0, time.process_time()
        self._rates: list[tuple[float, Load]] = []

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
        leg, here, rescues = Leg(self.point, end), 0.0, 0
        self.state = self._settled(self.state, leg, here)
        while here < 1.0:
            try:
                for share, state in follow(self.problem, self.state, leg, steps, here):
                    here, self.state, self.point, rescues = share, state, leg.at(share), 0
                    self._rates.append((state.position_rate, self.point.load))
                    self.steps += 1
                    self._check()
                    adapted = self._adapted(leg, here)
                    yield here
                    if adapted:
                        break
            except SlidingStalledError as error:
                if rescues == len(_RESCUE_SHARES):
                    raise self._ended(error) from None
                self._rescue(leg, here, _RESCUE_SHARES[rescues], error)
                rescues += 1

    def _check(self) -> None:
        least, angle = self.least_stretch()
        if least < CREASE_STRETCH:
            load = self.point.load
            raise SlidingEndError(
                SlidingOutcome.CREASED,
                f"the face is compressed to {least:.3f} of its length at "
                f"{np.degrees(angle):.0f} degrees, at xi = {load.friction:.4g} and "
                f"tau_w/mu = {load.wear:.4g}",
            )

    def _ended(self, error: SlidingStalledError) -> SlidingEndError:
        load, limit = self.point.load, limit_of(self._rates)
        if limit is not None:
            return SlidingEndError(
                SlidingOutcome.LIMIT,
                f"dJ/dx_w vanishes near xi = {limit.friction:.4g}, tau_w/mu = {limit.wear:.4g}; no "
                f"equilibrium beyond xi = {load.friction:.4g}, tau_w/mu = {load.wear:.4g}",
            )
        folded = error.outcome is NewtonOutcome.CONVERGED
        return SlidingEndError(
            SlidingOutcome.FOLDED if folded else SlidingOutcome.STALLED,
            f"no equilibrium beyond xi = {load.friction:.4g}, tau_w/mu = {load.wear:.4g} "
            f"({error.outcome.value})",
        )

    def _adapted(self, leg: Leg, here: float) -> bool:
        """Refine where det F scatters too much; return whether there was anything to refine."""
        allowed = self.cut.settings.scatter
        if not len(self.cut.scattered(self.state, allowed)):
            return False
        self._split(leg, here, self.cut.scattered(self.state, _SPLIT_SHARE * allowed))
        return True

    def _rescue(self, leg: Leg, here: float, share: float, error: SlidingStalledError) -> None:
        split = self.cut.scattered(self.state, share * self.cut.settings.scatter)
        ends = at_ends(self.cut.body, self.state)
        try:
            self._split(leg, here, np.union1d(split, ends))
        except SlidingStalledError:
            raise self._ended(error) from None
        self.state = replace(self.state, step=0.0)

    def _split(self, leg: Leg, here: float, elements: NDArray[np.int64]) -> None:
        """Split elements, and let the body settle."""
        body, carried = refined(self.cut.body, self.state, elements)
        if int(body.free.sum()) > MOST_UNKNOWNS:
            raise SlidingEndError(
                SlidingOutcome.TOO_LARGE, f"the mesh has more than {MOST_UNKNOWNS:,} unknowns"
            )
        count = len(body.face)
        assert isinstance(carried, SlidingState)
        start = replace(carried, shear=np.zeros(count), grazing=np.zeros(count, dtype=bool))
        before = self.cut.body, self.problem
        self.cut.body = body
        self._on(start)
        try:
            self.state = replace(self._settled(start, leg, here), step=self.state.step)
        except SlidingStalledError:
            self.cut.body, self.problem = before
            raise

    def _settled(self, start: SlidingState, leg: Leg, here: float) -> SlidingState:
        settled, outcome = attempt(self.problem, start, leg, here)
        if settled is None:
            raise SlidingStalledError(here, outcome)
        return settled

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
        """Return the record of a configuration before which the path ended: its last state."""
        return replace(self.record(target), outcome=error.outcome, reason=str(error))

    def _elapsed(self) -> float:
        now = time.process_time()
        elapsed, self._clock = now - self._clock, now
        return elapsed

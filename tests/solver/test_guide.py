"""States reached along a rougher mesh are those that the mesh's own path comes to."""

import numpy as np
import pytest

from fe_training.solver import path
from fe_training.solver.adapt import as_fine_as, ends_are_sharp, transferred
from fe_training.solver.cut import Cut, Settings
from fe_training.solver.equilibrium import Control, NewtonOutcome, control_value
from fe_training.solver.guide import Guide
from fe_training.solver.path import PathStalledError
from fe_training.solver.solve import far_field_cut, indentation_cut

START, G = -2.2, 2.0
SETTINGS = Settings(sectors=16, contact_spacing=0.12, notch_radius=5e-3, outer_radius=1e5)


@pytest.fixture(scope="module")
def own():
    """A cut and its state at one force, along its own path."""
    cut = indentation_cut(5.0, SETTINGS)
    return cut, cut.pulled(cut.raised(START), 0.5 * G)


def loads(state):
    return np.array([state.horizontal_force, state.vertical_force, *state.centre])


def test_a_state_carried_over_is_that_of_the_own_path(own):
    cut, there = own
    rough = cut.coarser(2.0)
    assert rough.body.free.sum() < 0.6 * cut.body.free.sum()
    ahead = rough.pulled(rough.raised(START), 0.5 * G)
    carried = cut.carried(rough, ahead, Control.FORCE)
    assert carried is not None
    assert carried.active.same(there.active)
    assert loads(carried) == pytest.approx(loads(there), rel=1e-8)
    assert abs(ahead.vertical_force / there.vertical_force - 1.0) > 1e-5  # another mesh


def test_what_touches_the_wire_on_one_mesh_does_on_the_other(own):
    """Near the tip elements are straight in polar coordinates: on the wire is on the wire."""
    cut, there = own
    other = cut.coarser(0.8).body
    carried = transferred(cut.body, there, other)
    polar = np.isin(other.face, other.connectivity[other.polar])
    touching = carried.active.wire & polar
    distance = np.hypot(*carried.about(other, other.face[touching]).T)
    assert touching.sum() > 10
    # but for the nodes between the last that touches and the first that does not
    assert np.median(abs(distance - 1.0)) < 1e-9
    assert abs(distance - 1.0).max() < 1e-3


def test_a_guided_value_takes_one_attempt_on_the_fine_mesh(own, monkeypatch):
    cut = indentation_cut(5.0, SETTINGS)
    guide, unknowns = Guide(cut, START), []
    plain = path.attempt

    def counted(body, *arguments, **options):
        unknowns.append(int(body.free.sum()))
        return plain(body, *arguments, **options)

    monkeypatch.setattr(path, "attempt", counted)
    state = guide.at(G)
    assert unknowns.count(int(cut.body.free.sum())) <= 2  # and one to meet J
    assert cut.energy_release_rate(state) == pytest.approx(G, rel=SETTINGS.tolerance)
    rough = sum(n < cut.body.free.sum() for n in unknowns)
    assert rough > 5
    near = guide.at(1.02 * G)  # within one step: the rough mesh is not asked
    assert sum(n < cut.body.free.sum() for n in unknowns) == rough
    assert near.horizontal_force > state.horizontal_force


def test_where_the_rough_path_stalls_the_own_one_is_followed(own, monkeypatch):
    _, there = own
    guide = Guide(indentation_cut(5.0, SETTINGS), START)
    pulled = Cut.pulled

    def stalls(self, state, force):
        if self is guide.cut:
            return pulled(self, state, force)
        raise PathStalledError(state, Control.FORCE, force, NewtonOutcome.STALLED)

    monkeypatch.setattr(Cut, "pulled", stalls)
    state = guide.at(G)
    assert guide.cut.energy_release_rate(state) == pytest.approx(G, rel=SETTINGS.tolerance)
    assert state.vertical_force == pytest.approx(there.vertical_force, rel=1e-3)


def test_a_value_below_the_start_is_told_by_the_rough_mesh(own):
    cut, _ = own
    start = cut.energy_release_rate(cut.raised(START))
    assert Guide(cut, START).start == pytest.approx(start, rel=0.02)


def test_far_from_the_tip_the_ends_are_split_before_the_mesh_is_solved_on():
    cut = far_field_cut(5.0, 6.0, SETTINGS)
    rough = cut.rough()
    state = rough.raised(-6.0)
    twice = cut.sharpened(cut.taken_over(rough, state), Control.POSITION, 2)
    other = far_field_cut(5.0, 6.0, SETTINGS)
    at_once = other.sharply_taken_over(rough, state, 2)
    assert not ends_are_sharp(rough.body, state)
    assert ends_are_sharp(other.body, at_once)
    assert control_value(other.body, at_once, Control.POSITION) == -6.0
    assert at_once.vertical_force == pytest.approx(twice.vertical_force, rel=1e-5)


def test_a_mesh_is_split_where_the_one_that_led_to_it_was(own):
    cut, _ = own
    other = cut.coarser(2.0)
    body = other.body
    for _ in range(3):
        near = np.hypot(*body.mesh.p[:, body.mesh.t].mean(axis=1)) < 0.3
        body = body.on(body.mesh.refined(np.flatnonzero(near)))
    finer = as_fine_as(cut.body, body)
    assert finer.free.sum() > 1.5 * cut.body.free.sum()
    assert as_fine_as(finer, body) is finer
    assert not other.was_split

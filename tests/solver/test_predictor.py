"""The predictor: tangents of every control, the order of its error, and when contact changes."""

from dataclasses import replace

import numpy as np
import pytest

from fe_training.solver.cut import Settings
from fe_training.solver.equilibrium import Control, NewtonOutcome, control_value, equilibrate
from fe_training.solver.predictor import admissible, contact_step, predicted, tangent_of
from fe_training.solver.solve import indentation_cut

COARSE = Settings(sectors=12, contact_spacing=0.2, notch_radius=0.02, outer_radius=1e4)
ALONG = (Control.POSITION, Control.DISTANCE, Control.FORCE)


@pytest.fixture(scope="module")
def near():
    """A wire beyond the touch of the tip, reached by its force, with the tangent of that."""
    cut = indentation_cut(5.0, COARSE)
    return cut, cut.at(cut.raised(-2.2), 2.0)


def solved(cut, state, control, target):
    found, outcome = equilibrate(cut.body, state, control, target, cut.solver, guarded=False)
    assert outcome is NewtonOutcome.CONVERGED
    return found


@pytest.mark.parametrize("control", ALONG)
def test_one_tangent_serves_all_controls_along_the_cut(near, control):
    cut, state = near
    t = tangent_of(cut.body, state, control)
    here, step = control_value(cut.body, state, control), 2e-5
    there = [solved(cut, state, control, here + sign * step) for sign in (-1.0, 1.0)]
    if not all(np.array_equal(s.active.wire, state.active.wire) for s in there):
        pytest.skip("a node meets the wire within the difference")
    slope = (there[1].u - there[0].u) / (2.0 * step)
    # the tangent is that of the last factors, which belong to the state before the last corrections
    assert np.abs(slope - t.u).max() == pytest.approx(0.0, abs=5e-3 * np.abs(t.u).max())
    moved = (there[1].centre - there[0].centre) / (2.0 * step)
    assert moved == pytest.approx(t.centre, rel=5e-3, abs=1e-8)


def test_no_tangent_of_the_height_serves_the_others(near):
    cut, state = near
    raised = replace(state, control=Control.HEIGHT)
    assert tangent_of(cut.body, raised, Control.FORCE) is None
    assert tangent_of(cut.body, replace(state, tangent=None), Control.FORCE) is None
    assert contact_step(cut.body, raised, Control.FORCE, 1.0, 0.1) == np.inf


def test_without_a_tangent_the_state_itself_is_the_guess(near):
    cut, state = near
    bare = replace(state, tangent=None)
    assert predicted(cut.body, bare, Control.FORCE, 2.0) is bare


def test_the_error_of_the_prediction_is_of_second_order(near):
    cut, state = near
    body, here = cut.body, state.horizontal_force
    errors = []
    for step in (0.04, 0.02, 0.01):
        guess = predicted(body, state, Control.FORCE, here + step)
        truth = solved(cut, state, Control.FORCE, here + step)
        errors.append(np.abs(guess.u - truth.u).max())
    assert errors[0] > 2.5 * errors[1] > 6.0 * errors[2]


def test_touching_nodes_stay_on_the_wire(near):
    cut, state = near
    guess = predicted(cut.body, state, Control.FORCE, 1.2 * state.horizontal_force)
    stays = state.active.wire & guess.active.wire
    arm = guess.about(cut.body, cut.body.face[stays])
    assert np.hypot(*arm.T) == pytest.approx(1.0, abs=1e-3)


def test_as_many_nodes_change_as_the_step_allows(near):
    cut, state = near
    body, share = cut.body, 0.15
    step = contact_step(body, state, Control.FORCE, 1.0, share)
    assert 0.0 < step < np.inf
    guess = predicted(body, state, Control.FORCE, state.horizontal_force + 0.99 * step)
    changed = np.sum(guess.active.wire != state.active.wire)
    assert changed <= share * state.active.wire.sum() + 1


def test_a_step_that_would_fold_elements_is_shortened(near):
    cut, state = near
    nothing = np.zeros_like(state.u)
    assert admissible(cut.body, state, nothing, np.zeros(2)) == 1.0
    inward = np.zeros_like(state.u)
    inward[:, 1] = -5.0 * cut.body.nodes[:, 1]  # turns every element inside out
    assert admissible(cut.body, state, inward, np.zeros(2)) < 0.5

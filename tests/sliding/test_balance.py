"""The balance of a steady cut, and the first-order laws that follow from it."""

import numpy as np
import pytest

from fe_training.sliding import tangent
from fe_training.sliding.balance import Support, slip_power, steady_force
from fe_training.sliding.shear import Load, face_lengths
from fe_training.solver.observe import face_stretch

LOADS = [Load(0.2, 0.0), Load(0.0, 0.7), Load(0.2, 0.7)]


def force(sliding, load):
    return steady_force(sliding.problem.body, sliding.at(load)[1])


@pytest.mark.parametrize("load", LOADS)
def test_the_wires_work_is_that_of_the_cut_and_of_the_slip(sliding, load):
    """F_ss = J + 2 int tau lambda ds, to what the mesh leaves: 1e-3 of F_ss is the bound."""
    body = sliding.problem.body
    point, state = sliding.at(load)
    F = steady_force(body, state)
    assert 1.1 * point.g < F
    assert pytest.approx(point.g + slip_power(body, state), rel=1e-3) == F
    # the projected law, which moves the shear's resultant alone, is far outside that bound
    projected = sliding.arc.force.sum()
    assert abs(point.g + 2 * load.friction * projected - F) > 1e-2 * F


@pytest.mark.parametrize("load", LOADS)
def test_energy_release_rate_does_not_depend_on_the_support(sliding, load):
    """Wider supports hold the whole contact; what is left is the mesh's error in the balance."""
    body = sliding.problem.body
    point, state = sliding.at(load)
    F = steady_force(body, state)
    for support in sliding.cut.supports(state)[1:]:
        J = Support(*support).energy_release_rate(body, state)
        assert pytest.approx(point.g, abs=1e-3 * F) == J


def test_slip_arc_and_slip_load_are_the_first_order(sliding):
    """dF/dxi = 2 B* and dF/dtau_w = 2 A* at fixed J.

    The discrete contact ends between two nodes, and the force of one that wear leaves there is
    that of a third of its edge: A* is as good as the longest edge at an end, B* much better.
    """
    arc, body, small = sliding.arc, sliding.problem.body, 1e-4
    base = force(sliding, Load())
    xi = (force(sliding, Load(small, 0.0)) - base) / small
    assert xi == pytest.approx(2.0 * arc.slip_load, rel=1e-2)
    wear = (force(sliding, Load(0.0, small)) - base) / small
    edges = face_lengths(body, sliding.state)[sliding.state.active.wire]
    assert wear == pytest.approx(2.0 * arc.slip_arc, abs=2 * edges.max() * arc.stretch.max())
    # the projected law's slopes are 2 F_v and 2 A
    assert abs(xi - 2.0 * sliding.state.vertical_force) > 2e-2 * xi


def test_two_load_paths_reach_one_state(sliding):
    """Slip is always backwards, so that the order of friction and wear cannot matter."""
    end = Load(0.2, 0.7)
    one = sliding.at(end, begin=sliding.at(Load(0.2, 0.0)))[1]
    other = sliding.at(end, begin=sliding.at(Load(0.0, 0.7)))[1]
    assert one.u == pytest.approx(other.u, abs=1e-7 * np.abs(other.u).max())
    assert one.centre == pytest.approx(other.centre, abs=1e-7)


def test_wear_per_reference_length_costs_the_arc_alone(sliding, monkeypatch):
    """Per reference length the slip arc would be int dtheta = theta_2 - theta_1, exactly.

    tau_w acting on ds/lambda has the power tau_w dtheta: the linear response of the same code,
    with lengths divided by the stretch, must be twice the angle of the contact.
    """
    body, state, small = sliding.problem.body, sliding.state, 1e-5
    stretch = face_stretch(body, state)
    whole = tangent.face_lengths

    def reference_lengths(body, state):
        return whole(body, state) / stretch

    monkeypatch.setattr(tangent, "face_lengths", reference_lengths)
    load = Load(0.0, small)
    slope = (force(sliding, load) - force(sliding, Load())) / small
    arc = sliding.arc
    edges = whole(body, state)[state.active.wire]
    assert slope == pytest.approx(2.0 * (arc.theta_2 - arc.theta_1), abs=2.0 * edges.max())
    assert abs(slope - 2.0 * arc.slip_arc) > 4.0 * edges.max()

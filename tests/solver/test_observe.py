"""The stretch of the crack face under the contact: slip arc and slip load."""

import numpy as np
import pytest

from fe_training.mechanics.analytic import far_field_wedge_from_energy_release_rate
from fe_training.solver.cut import Settings
from fe_training.solver.observe import contact_arc, face_stretch
from fe_training.solver.solve import indentation_cut, solve_path

COARSE = Settings(sectors=16, contact_spacing=0.1, notch_radius=2e-3, outer_radius=1e5)


@pytest.fixture(scope="module")
def near():
    """A wire near the tip of a neo-Hookean solid, not touching it."""
    cut = indentation_cut(2.0, COARSE)
    return cut.body, cut.at(cut.raised(-2.2), 0.5)


def test_a_wear_strength_per_reference_length_slips_over_the_contact_angle(near):
    """With tau_w per reference length, int tau_w lambda ds is tau_w (theta_2 - theta_1)."""
    body, state = near
    touching = np.flatnonzero(state.active.wire)
    arc = contact_arc(body, state)
    reference = -body.nodes[body.face, 0]
    # the reference length of each quadratic edge, and Simpson's rule on it
    inside = touching[touching % 2 == 1]
    inside = inside[(inside > touching[0]) & (inside < touching[-1])]
    stretch = face_stretch(body, state)
    length = reference[inside + 1] - reference[inside - 1]
    mean = (stretch[inside - 1] + 4.0 * stretch[inside] + stretch[inside + 1]) / 6.0
    first, last = inside[0] - 1 - touching[0], inside[-1] + 1 - touching[0]
    assert length @ mean == pytest.approx(arc.theta[last] - arc.theta[first], rel=2e-3)


def test_slip_exceeds_its_projection(near):
    """|F e_1| is at least its component along the path, which is sin(theta) there."""
    body, state = near
    arc = contact_arc(body, state)
    assert arc.slip_arc > arc.length
    assert arc.slip_load > state.vertical_force
    assert np.all(arc.stretch > np.sin(arc.theta))


def test_far_from_the_tip_slip_arc_and_load_are_the_wedges():
    """The face neither stretches nor tilts under a wire that is far away."""
    records = solve_path(2.0, [0.003, 0.03], COARSE)
    off = []
    for record in records:
        wedge = far_field_wedge_from_energy_release_rate(record.target)
        off.append(
            (
                record.slip_arc / wedge.contact_width - 1.0,
                record.slip_load / wedge.vertical_force - 1.0,
            )
        )
    # a limit that is neared slowly: a tenth of g takes more than a quarter of the difference away
    assert np.all(np.abs(off[0]) < 0.75 * np.abs(off[1]))
    assert np.all(np.abs(off[0]) < 0.1)


def test_at_the_tip_the_slip_arc_grows_with_the_logarithm_of_the_notch_radius():
    """For alpha = 2 the stretch is (g/(pi r))^(1/2): dA*/d ln(1/r0) = g/pi, derived."""
    values = []
    for notch_radius in (8e-3, 2e-3):
        cut = indentation_cut(2.0, Settings(16, 0.1, notch_radius, 1e5))
        state = cut.at(cut.raised(-2.2), 4.0)
        assert state.active.wire[0], "the tip has to touch the wire"
        arc = contact_arc(cut.body, state)
        assert arc.theta_1 == 0.0
        values.append(arc.slip_arc)
    # next order of the tip field: r0/(g R_w), and the tolerance of J, 1e-3 of 10
    assert (values[1] - values[0]) / np.log(4.0) == pytest.approx(4.0 / np.pi, rel=0.02)


def test_the_tip_is_an_end_of_the_contact_only_where_it_touches(near):
    body, state = near
    assert not state.active.wire[0]
    assert contact_arc(body, state).theta_1 > 0.1

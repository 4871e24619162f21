"""The shipped campaign: what slip arc and slip load are known to be."""

import numpy as np
import pytest

from fe_training.campaign.dataset import load_campaign


@pytest.fixture(scope="module")
def points():
    shipped = load_campaign().points
    use = shipped["use"].astype(bool)
    return {name: values[use] for name, values in shipped.columns.items()}


def test_a_sharper_tip_adds_the_slip_of_its_singularity(points):
    """At alpha = 2 lambda^2 = g/(pi r) at the tip, so that dA*/d ln(1/r) = g/pi once it touches."""
    here = (points["alpha"] == 2.0) & (points["g"] > 1.9)
    slope, g = points["slip_arc_notch_slope"][here], points["g"][here]
    assert len(g) > 10
    # the mesh errors of both levels, over ln 4
    error = 2.0 * points["slip_arc_error"][here] * points["slip_arc"][here] / np.log(4.0)
    assert np.all(np.abs(slope - g / np.pi) <= error + 0.01 * g / np.pi)


def test_before_the_touch_the_tip_does_not_matter(points):
    here = np.isfinite(points["slip_arc_notch_slope"]) & (points["distance"] > 1.01)
    assert np.count_nonzero(here) > 20
    assert np.all(np.abs(points["slip_arc_notch_slope"][here]) < 5e-3 * points["slip_arc"][here])


def test_slip_is_more_than_its_projection(points):
    assert np.all(points["slip_arc"] > points["arc"])
    assert np.all(points["slip_load"] > points["normal_load"])


def test_far_from_the_tip_slip_and_projection_come_together(points):
    for alpha in np.unique(points["alpha"]):
        here = (points["alpha"] == alpha) & (points["g"] < 0.3)
        ratio = points["slip_arc"][here] / points["arc"][here]
        assert np.all(np.diff(ratio) > 0.0)
        assert 1.0 < ratio[0] < 1.12


def test_the_design_is_the_shipped_one(points):
    """Exponents from 3 and from 5 on go farther, as the design says."""
    for alpha in np.unique(points["alpha"]):
        top = 100.0 if alpha < 3.0 else 300.0 if alpha < 5.0 else 1000.0
        assert points["g"][points["alpha"] == alpha].max() == top

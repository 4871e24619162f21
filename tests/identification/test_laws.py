"""Identification under each law, and by models that are not as exact as usually asked for."""

import numpy as np
import pytest

from surrogate import AccuracyError, Scene, cutting_force, identify
from surrogate.contact.bounds import Bounds


def test_each_law_finds_what_was_cut_under_it_and_says_which_it_is(installed):
    scene = Scene(1000.0, 2.0, np.geomspace(0.1e-3, 2e-3, 6), 0.0, 500.0, 3.0)
    found = {}
    for law in ("projected", "slip"):
        force = cutting_force(scene, "table", law=law).total
        for assumed in ("projected", "slip"):
            fit = identify(
                scene.wire_radius,
                force,
                1000.0,
                stiffening_exponent=3.0,
                friction_coefficient=0.0,
                model="table",
                law=assumed,
                force_std=0.01 * force,
            )
            assert fit.law == assumed
            found[law, assumed] = fit
    for law in ("projected", "slip"):
        own = found[law, law]
        assert own.toughness == pytest.approx(2.0, rel=1e-4)
        assert own.wear_strength == pytest.approx(500.0, rel=1e-4)
    # the projected law takes the whole of a larger force for a stronger wear
    assert found["slip", "projected"].wear_strength > 1.05 * 500.0
    assert "law slip" in found["slip", "slip"].summary()


def test_models_that_are_not_exact_enough_do_not_stop_an_identification(installed, monkeypatch):
    errors = dict.fromkeys(("eq13", "power-law", "gp"), 0.5) | {"table": 0.3}
    monkeypatch.setattr(Bounds, "of_force", lambda self, model: errors[model])
    scene = Scene(1000.0, 2.0, np.geomspace(0.1e-3, 2e-3, 6), 0.0, 500.0, 3.0)
    force = cutting_force(scene, "table", law="projected").total
    given = {"stiffening_exponent": 3.0, "friction_coefficient": 0.0, "force_std": 0.01 * force}
    assert identify(scene.wire_radius, force, 1000.0, **given).model == "table"
    with pytest.raises(AccuracyError, match=r"rtol = 0\.02"):
        identify(scene.wire_radius, force, 1000.0, rtol=0.02, **given)

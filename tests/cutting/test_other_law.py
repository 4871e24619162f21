"""Parameters that belong to a law: forces keep to it, and another law is warned of."""

import pickle
import re
import warnings
from dataclasses import replace

import numpy as np
import pytest

from surrogate import (
    InputError,
    OtherLawWarning,
    Scene,
    classify,
    cutting_force,
    force_gradient,
    identify,
    propagate,
    transition_radius,
)
from surrogate.choosing import laws
from surrogate.scene import LAWS

RADII = np.geomspace(0.1e-3, 0.6e-3, 5)


def gel(law, wear=1e3):
    return Scene(5e3, 1.0, RADII, 0.01, wear, 4.0, law)


def warned(function):
    """Return the result and the percent of each warning."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        result = function()
    texts = [str(w.message) for w in caught if w.category is OtherLawWarning]
    assert all(w.filename == __file__ for w in caught if w.category is OtherLawWarning)
    return result, [float(re.search(r"up to ([\d.e+-]+) %", text)[1]) for text in texts]


def test_scenes_keep_their_law():
    scene = gel("slip")
    for other in (pickle.loads(pickle.dumps(scene)), replace(scene, toughness=1.0)):
        assert other == scene
        assert other.law == "slip"
    assert scene != gel(None)
    assert gel(None).law is None
    assert laws.LAWS is LAWS
    assert LAWS == (laws.PROJECTED, laws.SLIP, laws.COUPLED)
    for wrong in ("auto", "", 1):
        with pytest.raises(InputError, match="law must be one of"):
            gel(wrong)


@pytest.mark.parametrize("own", ["projected", "slip"])
def test_auto_keeps_to_the_law_of_the_parameters(coupled, own):
    force, percent = warned(lambda: cutting_force(gel(own), law="auto"))
    assert percent == []
    assert force.law == own
    np.testing.assert_array_equal(force.total, cutting_force(gel(None), law=own).total)


def propagated(scene, **options):
    return propagate(scene, {"toughness": 0.1}, **options)


@pytest.mark.parametrize("function", [cutting_force, classify, force_gradient, propagated])
def test_another_law_is_warned_of_once_with_how_far_it_moves_the_force(coupled, function):
    forces = {law: cutting_force(gel(None), law=law, extrapolate=True).total for law in LAWS}
    for own in LAWS:
        for law in LAWS:
            _, percent = warned(
                lambda own=own, law=law: function(gel(own), law=law, extrapolate=True)
            )
            if law == own:
                assert percent == []
                continue
            moved = 100.0 * np.max(np.abs(forces[law] / forces[own] - 1.0))
            assert percent == [pytest.approx(moved, rel=0.1)]
            assert percent[0] >= moved * (1.0 - 1e-3)


def test_a_transition_radius_is_by_the_law_of_the_parameters(coupled):
    for own in ("projected", "slip"):
        radius = transition_radius(gel(own))
        np.testing.assert_array_equal(radius, transition_radius(gel(None), law=own))


def test_cheaper_laws_that_are_known_to_be_as_exact_stand_for_the_coupled_law(coupled):
    force, percent = warned(lambda: cutting_force(gel("coupled", wear=10.0), law="auto"))
    assert percent == []
    assert np.all(np.isfinite(force.law_error))
    force, percent = warned(lambda: cutting_force(gel("coupled", wear=5e5), law="auto"))
    assert np.all(np.isnan(force.law_error))
    assert len(percent) == 1


def test_without_friction_and_wear_no_law_matters(coupled):
    scene = Scene(5e3, 1.0, RADII, 0.0, 0.0, 4.0, "coupled")
    for law in LAWS:
        assert warned(lambda law=law: cutting_force(scene, law=law, extrapolate=True))[1] == []


def test_closed_forms_are_of_the_projected_law(coupled):
    assert warned(lambda: cutting_force(gel("projected"), "eq13"))[1] == []
    assert len(warned(lambda: cutting_force(gel("slip"), "eq13", law="projected"))[1]) == 1


def test_what_was_identified_carries_its_law(coupled):
    force = cutting_force(gel(None), "table", law="slip").total
    for law in LAWS:
        fit = identify(
            RADII, force, 5e3, friction_coefficient=0.01, stiffening_exponent=4.0, law=law
        )
        assert fit.scene(RADII).law == law
        _, percent = warned(lambda fit=fit: cutting_force(fit.scene(RADII), law="auto"))
        assert percent == []
        predicted = fit.predict(RADII)
        again = cutting_force(fit.scene(RADII), fit.model, law=law).total
        np.testing.assert_allclose(predicted, again, rtol=1e-9)

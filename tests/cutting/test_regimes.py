"""Regimes: dominating terms and contact, with their thresholds."""

from functools import partial

import numpy as np
import pytest

import surrogate
from surrogate import InputError, Scene, cutting_force
from surrogate.cutting.regimes import CONTACTS, DOMINANCES, PARTS

classify = partial(surrogate.classify, model="eq13")
transition_radius = partial(surrogate.transition_radius, model="eq13")


def test_by_default_the_parts_of_the_default_force_are_compared():
    gel = Scene(685.0, 1.6, [2.5e-5, 1e-4, 5e-4], [0.0, 0.0, 3.0], 7750.0)
    force, regime = cutting_force(gel), surrogate.classify(gel)
    for i, dominant in enumerate(regime.dominant):
        shares = [part[i] / force.total[i] for part in (force.cleavage, force.friction, force.wear)]
        largest = max(range(3), key=shares.__getitem__)
        above = shares[largest] >= regime.threshold
        assert dominant == (PARTS[1 + largest] if above else "transition")
    assert regime == surrogate.classify(gel, model="auto")
    with pytest.raises(surrogate.DomainError, match="extrapolate=True"):
        surrogate.classify(Scene(685.0, 1.6, 1e-6, wear_strength=7750.0))
    thin = surrogate.classify(Scene(685.0, 1.6, 1e-6, wear_strength=7750.0), extrapolate=True)
    assert thin.dominant == "cleavage"


def test_every_wire_of_the_paper_is_in_the_wear_regime_and_indents():
    radii = np.array([0.125, 0.210, 0.275, 0.390, 0.470]) * 1e-3
    regime = classify(Scene(685.0, 1.6, radii, wear_strength=7750.0))
    assert set(regime.dominant) == {"wear"}
    assert set(regime.contact) == {"indentation"}


def test_each_term_can_dominate():
    scene = Scene(685.0, 1.6, [1e-6, 1.0, 1.0, 5e-5], 0.1, [0.0, 7750.0, 0.0, 7750.0])
    expected = ["toughness-and-friction", "wear", "friction-stiffness", "transition"]
    assert classify(scene).dominant.tolist() == expected
    assert sorted(expected) == sorted(DOMINANCES)


def test_the_terms_are_in_transition_where_they_are_equal():
    gel = Scene(685.0, 1.6, 1.0, wear_strength=7750.0)
    at = transition_radius(gel)
    radii = at * np.array([0.49, 0.51, 1.0, 1.99, 2.01])
    regime = classify(Scene(685.0, 1.6, radii, wear_strength=7750.0))
    assert regime.dominant.tolist() == ["toughness-and-friction", *["transition"] * 3, "wear"]


def test_the_threshold_is_the_share_of_the_force():
    scene = Scene(1.0, 1.0, 1.0, 0.0, 1.0)  # wear has 4 of 5
    assert classify(scene, threshold=0.79).dominant == "wear"
    assert classify(scene, threshold=0.81).dominant == "transition"
    assert classify(scene, threshold=0.81).threshold == 0.81
    assert classify(Scene(1.0, 1.0, 1.0), threshold=1.0).dominant == "toughness-and-friction"


@pytest.mark.parametrize("threshold", [0.5, 0.0, 1.1, np.nan, [0.6, 0.7], "0.6", None])
def test_a_threshold_must_be_a_share_that_one_term_alone_can_have(threshold):
    with pytest.raises(InputError, match="threshold"):
        classify(Scene(1.0, 1.0, 1.0), threshold)


@pytest.mark.parametrize(
    ("g", "contact"), [(0.99, "far-field"), (1.0, "far-field"), (1.01, "indentation")]
)
def test_the_wire_touches_the_tip_above_g_of_one(g, contact):
    assert classify(Scene(1.0, g, 1.0)).contact == contact


def test_contact_at_the_extremes():
    assert classify(Scene(1.0, 1.0, 0.0)).contact == "indentation"
    assert classify(Scene(0.0, 0.0, 0.0)).contact == "far-field"
    assert classify(Scene(1e300, 1e300, 1e300)).contact == "far-field"
    assert sorted(CONTACTS) == ["far-field", "indentation"]


def test_no_force_and_overflow_have_no_dominating_term():
    assert classify(Scene(0.0, 0.0, 0.0)).dominant == "transition"
    assert classify(Scene(1.0, 1e308, 1.0, 1e10)).dominant == "transition"
    both = classify(Scene(1.0, [0.0, 1e308], 0.0, 1e10))
    assert both.dominant.tolist() == ["transition"] * 2


def test_scalars_give_strings_and_arrays_string_arrays():
    scalar, array = classify(Scene(1.0, 1.0, 1.0)), classify(Scene(1.0, [[1.0, 2.0]], 1.0))
    assert type(scalar.dominant) is str
    assert type(scalar.contact) is str
    assert array.dominant.shape == array.contact.shape == (1, 2)
    assert array.dominant.dtype.kind == "U"
    assert array == classify(Scene(1.0, [[1.0, 2.0]], 1.0))

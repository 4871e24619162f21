"""Transition radii: the paper's two values, and the third that Eq. (13) defines."""

from functools import partial

import numpy as np
import pytest

import surrogate
from surrogate import (
    DomainError,
    Scene,
    fracto_cohesive_transition_radius,
    wear_transition_radius,
)

cutting_force = partial(surrogate.cutting_force, model="eq13")
transition_radius = partial(surrogate.transition_radius, model="eq13")

GEL = Scene(685.0, 1.6, 0.25e-3, wear_strength=7750.0)


def test_published_radii():
    # 52 um follows from the paper's line; 92 um from l_f = 371 um as printed, which takes
    # W_f = 7 kJ/m^3, while 6.973 gives 93.2.
    assert wear_transition_radius(GEL) == pytest.approx(52e-6, abs=0.5e-6)
    assert fracto_cohesive_transition_radius(2.6, 7000.0) == pytest.approx(371e-6 / 4, rel=2e-3)
    assert fracto_cohesive_transition_radius(2.6, 6973.0) == pytest.approx(93.2e-6, abs=0.05e-6)


def test_the_wear_radius_is_the_frictionless_case():
    assert transition_radius(GEL) == pytest.approx(wear_transition_radius(GEL), rel=1e-15)


@pytest.mark.parametrize("xi", [0.0, 0.1, 2.0])
def test_the_terms_are_equal_at_the_transition(xi):
    radius = transition_radius(Scene(685.0, 1.6, 1.0, xi, 7750.0))
    constant = cutting_force(Scene(685.0, 1.6, 0.0, xi, 7750.0)).total
    linear = cutting_force(Scene(685.0, 0.0, radius, xi, 7750.0)).total
    assert linear == pytest.approx(constant, rel=1e-14)


def test_radii_of_arrays():
    scene = Scene(685.0, 1.6, np.ones((5, 1, 1)), [0.0, 0.1], [[7750.0], [0.0]])
    radii = transition_radius(scene)
    assert radii.shape == (2, 2)
    assert radii[1, 0] == np.inf
    assert radii[0, 1] == transition_radius(Scene(685.0, 1.6, 1e-4, 0.1, 7750.0))
    assert wear_transition_radius(scene).shape == (2, 1)


def test_nothing_linear_means_no_transition():
    scene = Scene(685.0, 1.6, 1e-4)
    assert transition_radius(scene) == wear_transition_radius(scene) == np.inf
    assert fracto_cohesive_transition_radius(2.6, 0.0) == np.inf


@pytest.mark.parametrize(
    "call",
    [
        lambda: transition_radius(Scene(685.0, 0.0, 1e-4)),
        lambda: wear_transition_radius(Scene(685.0, 0.0, 1e-4)),
        lambda: fracto_cohesive_transition_radius([1.0, 0.0], 0.0),
    ],
)
def test_no_terms_at_all_is_refused(call):
    with pytest.raises(DomainError, match="0/0"):
        call()


def test_a_large_friction_coefficient_leaves_a_quarter_of_the_elasto_cohesive_length():
    scene = Scene(1e200, 1e200, 1e-4, 1e200, 0.0)
    assert transition_radius(scene) == pytest.approx(0.25, rel=1e-15)

"""The transition radius under any model: one definition, its zeros, and where there are none."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

from surrogate import (
    DomainError,
    InputError,
    Scene,
    cutting_force,
    force_gradient,
    transition_radius,
)
from surrogate.basics.checks import Quantity
from surrogate.basics.roots import narrowed
from surrogate.cutting.regimes import touching_toughness
from surrogate.equations import DIMENSIONLESS_TOUGHNESS

GEL = Scene(685.0, 1.6, 0.25e-3, 0.1, 7750.0, 3.0)


@pytest.fixture(autouse=True)
def known_models(elements, bump):
    """Make the models of tests known."""


@pytest.mark.parametrize("model", ["eq13", "low-toughness", "friction-free", "elements", "bump"])
@pytest.mark.parametrize("xi", [0.0, 0.1, 0.5])
@pytest.mark.parametrize("tau", [100.0, 7750.0])
def test_the_two_parts_are_equal_there_and_the_radius_counts_less_before(model, xi, tau):
    scene = replace(GEL, friction_coefficient=xi, wear_strength=tau)
    radius = transition_radius(scene, model)
    at = replace(scene, wire_radius=radius)
    slope, total = force_gradient(at, model), cutting_force(at, model).total
    assert radius * slope.wire_radius == pytest.approx(0.5 * total, rel=1e-11)
    assert 1.6 * slope.toughness == pytest.approx(0.5 * total, rel=1e-11)
    thinner = replace(scene, wire_radius=radius * np.geomspace(1e-6, 0.999, 500))
    share = thinner.wire_radius * force_gradient(thinner, model).wire_radius
    assert np.all(share < 0.5 * cutting_force(thinner, model).total)


def test_the_constant_part_is_where_the_tangent_meets_the_axis():
    radius = transition_radius(GEL, "elements")
    near = radius * np.array([1 - 1e-6, 1 + 1e-6])
    low, high = cutting_force(replace(GEL, wire_radius=near), "elements").total
    tangent = (high - low) / (near[1] - near[0])
    total = cutting_force(replace(GEL, wire_radius=radius), "elements").total
    assert total - radius * tangent == pytest.approx(0.5 * total, rel=1e-6)


@pytest.mark.parametrize("xi", [0.0, 0.3])
def test_a_search_finds_what_a_closed_form_says(register, elements_like, xi):
    @dataclass(frozen=True)
    class AsEquation13(elements_like):
        name: str = "as-eq13"

        def arc(self, g, alpha):
            return 2.0 + 0.0 * g

        def normal_load(self, g, alpha):
            return 0.5 * g + 2.0

        def arc_slopes(self, g, alpha):
            return 0.0 * g, 0.0

        def normal_load_slopes(self, g, alpha):
            return 0.5 + 0.0 * g, 0.0

    register(AsEquation13())
    for tau in (0.0, 1e-20, 7750.0, 1e20):
        scene = replace(GEL, friction_coefficient=xi, wear_strength=tau)
        expected = pytest.approx(transition_radius(scene, "eq13"), rel=1e-13)
        assert transition_radius(scene, "as-eq13") == expected


def test_of_several_radii_the_smallest_is_returned(bump):
    """A narrow peak of A makes what grows with the radius large, then small, then large."""
    scene = Scene(685.0, 1.6, 1.0, 0.0, 3000.0)
    radii = np.geomspace(1e-5, 0.1, 20_001)
    at = replace(scene, wire_radius=radii)
    share = radii * force_gradient(at, "bump").wire_radius / cutting_force(at, "bump").total
    crossings = radii[1:][np.diff(share > 0.5)]
    assert crossings.size > 1
    assert transition_radius(scene, "bump") == pytest.approx(crossings[0], rel=1e-3)


@pytest.mark.parametrize("model", ["elements", "bump", "eq9", "low-toughness"])
def test_nothing_that_grows_means_no_transition(model):
    scene = replace(GEL, friction_coefficient=0.0, wear_strength=0.0)
    assert transition_radius(scene, model) == np.inf


@pytest.mark.parametrize("model", ["elements", "bump"])
def test_no_toughness_means_that_the_radius_always_counts(model):
    assert transition_radius(replace(GEL, toughness=0.0), model) == 0.0


@pytest.mark.parametrize("alpha", [2.0, 5.0, 9.0])
def test_friction_of_a_power_law_never_leaves_the_toughness_behind(alpha):
    """Its share (1 - n) xi g^(n - 1) of the toughness is negative, or small at any g met here."""
    assert transition_radius(replace(GEL, stiffening_exponent=alpha), "eq9") == np.inf


def test_no_terms_at_all_is_refused():
    scene = Scene(685.0, 0.0, 1e-4)
    for model in ("eq13", "low-toughness", "elements"):
        with pytest.raises(DomainError, match="0/0"):
            transition_radius(scene, model)


def test_a_model_over_g_needs_a_modulus():
    with pytest.raises(DomainError, match="must have a shear modulus"):
        transition_radius(replace(GEL, shear_modulus=0.0), "elements")


@pytest.mark.parametrize(("tau", "side"), [(1.0, "below 0.5"), (1e6, "above 30")])
def test_a_transition_beyond_the_model_is_refused(register, elements_like, tau, side):
    limits = Quantity("g", "", "choose another model", 0.5, 30.0, error=DomainError)
    register(elements_like(name="limited", g=limits))
    scene = replace(GEL, friction_coefficient=0.0)
    inside = replace(scene, wear_strength=2000.0)
    expected = pytest.approx(transition_radius(inside, "elements"), rel=1e-12)
    assert transition_radius(inside, "limited") == expected
    with pytest.raises(DomainError, match=f"at a g {side}"):
        transition_radius(replace(scene, wear_strength=tau), "limited")


def test_arrays_are_numbers_one_by_one():
    scene = Scene(
        [[685.0], [2000.0]], 1.6, np.ones((4, 1, 1)), [0.0, 0.1, 0.2], 7750.0, [2.0, 3.0, 3.0]
    )
    together = transition_radius(scene, "elements")
    assert together.shape == (2, 3)
    for i, mu in enumerate((685.0, 2000.0)):
        for j, (xi, alpha) in enumerate(((0.0, 2.0), (0.1, 3.0), (0.2, 3.0))):
            alone = transition_radius(Scene(mu, 1.6, 1.0, xi, 7750.0, alpha), "elements")
            assert together[i, j] == pytest.approx(alone, rel=1e-14)
            assert type(alone) is float
    assert transition_radius(Scene(685.0, np.ones((0, 2)), 1.0), "elements").shape == (0, 2)


@pytest.mark.parametrize("name", ["toughness", "wear_strength", "shear_modulus"])
@pytest.mark.parametrize("size", [5e-324, 1e-300, 1e300])
def test_numbers_of_any_size(name, size):
    radius = transition_radius(replace(GEL, **{name: size}), "elements")
    assert radius >= 0.0


@pytest.mark.parametrize(("alpha", "strongest"), [(2.0, 1e3), (2.25, 1e3), (2.5, 4.0)])
@pytest.mark.parametrize("xi", [0.0, 0.01, 0.1, 0.5, 2.0])
def test_under_the_law_of_slip_the_tip_does_not_touch_where_its_radius_would_count(
    alpha, strongest, xi
):
    tau = np.geomspace(0.02, strongest, 9)  # with less, thicker wires than the table knows
    radius = transition_radius(Scene(1.0, 1.0, 1.0, xi, tau, alpha), law="slip")
    assert np.all(1.0 / radius < touching_toughness("table", alpha))


def test_bad_input_is_refused():
    with pytest.raises(InputError, match="eq99"):
        transition_radius(GEL, "eq99")
    with pytest.raises(DomainError, match="Table 1"):
        transition_radius(replace(GEL, stiffening_exponent=9.5), "eq9")
    with pytest.raises(InputError, match="scene must be a Scene"):
        transition_radius(1.6, "elements")


def test_narrowing_ends_at_neighbours_whichever_way():
    bounds = np.array([0.1, 1e-300, 3.0, 1e30])
    yes, no = np.array([0.0, 0.0, 9.0, 1.0]), np.array([1.0, 1.0, 0.0, 1e300])
    sides = np.repeat(np.sign(no - yes), 15)
    ends = np.repeat(bounds, 15)
    found = narrowed(lambda x: sides * x <= sides * ends, yes, no)
    np.testing.assert_array_equal(found, bounds)
    assert narrowed(lambda x: x > 0, np.empty(0), np.empty(0)).size == 0
    assert DIMENSIONLESS_TOUGHNESS.lower == 0.0

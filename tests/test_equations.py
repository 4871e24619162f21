"""The paper's equations: published numbers, and routes that must agree."""

import numpy as np
import pytest

import surrogate
from surrogate.equations import TABLE_1

# The paper's gel and the line through its five wires; sections 2 and 4.
MU, GAMMA, TAU = 685.0, 1.6, 7750.0
RADII = np.array([0.125, 0.210, 0.275, 0.390, 0.470]) * 1e-3


def test_general_force_is_the_published_line_without_friction():
    force = surrogate.general_force(MU, GAMMA, RADII, 0.0, TAU)
    slope, intercept = np.polyfit(RADII, force, 1)
    assert slope == pytest.approx(31e3, rel=1e-12)
    assert intercept == pytest.approx(1.6, rel=1e-12)


def test_relative_wear_strength_of_the_gel_is_the_published_one():
    assert pytest.approx(11.31, abs=0.005) == TAU / MU
    assert surrogate.low_toughness_dissipation(0.0, TAU / MU) == pytest.approx(4 * 11.31, abs=0.02)


@pytest.mark.parametrize("xi", [0.0, 0.1, 3.0])
def test_relative_force_is_the_general_one_over_the_toughness(xi):
    relative = surrogate.relative_force(RADII, GAMMA / MU, xi, TAU / MU)
    general = surrogate.general_force(MU, GAMMA, RADII, xi, TAU)
    np.testing.assert_allclose(GAMMA * relative, general, rtol=1e-14)


def test_friction_free_force_is_the_relative_one_without_friction():
    free = surrogate.friction_free_relative_force(RADII, GAMMA / TAU)
    relative = surrogate.relative_force(RADII, GAMMA / MU, 0.0, TAU / MU)
    np.testing.assert_allclose(free, relative, rtol=1e-14)


def test_low_toughness_force_adds_the_dissipation_to_the_toughness():
    dissipation = surrogate.low_toughness_dissipation(0.1, TAU / MU)
    force = surrogate.low_toughness_force(MU, GAMMA, RADII, 0.1, TAU)
    np.testing.assert_allclose(GAMMA + MU * RADII * dissipation, force, rtol=1e-14)


def test_general_force_is_that_of_high_toughness_plus_the_dissipation_of_low_toughness():
    parts = surrogate.high_toughness_force(
        GAMMA, 0.1
    ) + MU * RADII * surrogate.low_toughness_dissipation(0.1, TAU / MU)
    force = surrogate.general_force(MU, GAMMA, RADII, 0.1, TAU)
    np.testing.assert_allclose(parts, force, rtol=1e-14)


def test_far_field_falls_with_the_square_of_the_distance():
    distance = np.array([1.0, 2.0, 15.0, np.inf])
    rate = surrogate.far_field_energy_release_rate(distance)
    np.testing.assert_allclose(rate, [1.0, 0.25, 1 / 225, 0.0], rtol=1e-15)


def test_far_field_ends_where_the_wire_touches_the_tip():
    with pytest.raises(surrogate.DomainError, match=r"relative_distance\[1\] = 0\.9"):
        surrogate.far_field_energy_release_rate([2.0, 0.9])


def test_exponents_are_those_of_table_1_and_linear_between():
    nodes = np.array(list(TABLE_1))
    exact = surrogate.power_law_exponent(nodes)
    assert exact.tolist() == list(TABLE_1.values())
    halfway = surrogate.power_law_exponent((nodes[1:] + nodes[:-1]) / 2)
    np.testing.assert_allclose(halfway, (exact[1:] + exact[:-1]) / 2, rtol=1e-15)


@pytest.mark.parametrize("alpha", [np.nextafter(2.0, 0.0), np.nextafter(9.0, 10.0), 1.0, 20.0])
def test_table_1_is_not_extrapolated(alpha):
    with pytest.raises(surrogate.DomainError, match="Table 1"):
        surrogate.power_law_exponent(alpha)


def test_power_law_has_its_exponent_as_logarithmic_slope():
    g = np.array([10.0, 100.0])
    force = surrogate.power_law_dissipation(g, 0.3, 1.06)
    assert np.log10(force[1] / force[0]) == pytest.approx(1.06, rel=1e-14)
    assert surrogate.power_law_dissipation(1.0, 0.3, 1.06) == 0.3


def test_power_law_without_friction_is_nothing_even_where_the_power_overflows():
    assert surrogate.power_law_dissipation(1e300, 0.0, 1.18) == 0.0
    assert surrogate.power_law_dissipation([1e300], [0.0, 1.0], 1.18).tolist() == [0.0, np.inf]


def test_power_law_with_exponent_one_is_the_high_toughness_friction():
    dissipation = surrogate.power_law_dissipation(GAMMA / (MU * RADII), 0.1, 1.0)
    friction = surrogate.high_toughness_force(GAMMA, 0.1) - GAMMA
    np.testing.assert_allclose(MU * RADII * dissipation, friction, rtol=1e-14)

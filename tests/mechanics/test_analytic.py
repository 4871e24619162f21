"""The closed forms: each against the equation that it solves, by another route."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from fe_training.mechanics import analytic as reference
from surrogate.errors import InputError


@pytest.mark.parametrize("distance", [1.0, 3.0, 50.0, 1e4, 1e12])
def test_wedge_solves_the_implicit_equation(distance):
    def opening(p):
        a = np.sqrt(4 * p / np.pi)
        return 2 * p / np.pi * (np.log(8 * distance / a) + 0.5) - 1.0

    p = brentq(opening, 1e-6, 2.0, xtol=1e-15)
    wedge = reference.far_field_wedge(distance)
    assert wedge.vertical_force == pytest.approx(4 * p, rel=1e-12)
    contact = reference.hertz_line_contact(wedge.vertical_force)
    assert wedge.contact_width == pytest.approx(2 * contact.half_width, rel=1e-14)
    rate = reference.point_force_energy_release_rate(wedge.vertical_force, distance)
    assert wedge.energy_release_rate == pytest.approx(rate, rel=1e-14)


def test_wedge_opens_the_crack_by_the_radius_at_the_middle_of_its_pressure():
    """The opening of the crack by point forces, summed over the Hertz pressure."""
    distance = 1e3
    wedge = reference.far_field_wedge(distance)
    a = wedge.contact_width / 2

    def share(s):  # opening at `distance` from a point force at `distance + s`, E' = 4
        root, other = np.sqrt(distance), np.sqrt(distance + s)
        pressure = 2 * wedge.vertical_force / (np.pi * a) * np.sqrt(1 - (s / a) ** 2)
        return pressure * 2 / (np.pi * 4) * np.log((root + other) / abs(root - other))

    opening = quad(share, -a, 0, epsabs=1e-10)[0] + quad(share, 0, a, epsabs=1e-10)[0]
    # the closed form drops terms of relative order (a/delta)^2 = 1e-7
    assert opening == pytest.approx(1.0, abs=1e-6)


def test_wedge_at_a_rate_inverts_the_wedge_at_a_distance():
    distance = np.geomspace(1.0, 1e50, 40)
    wedge = reference.far_field_wedge(distance)
    back = reference.far_field_wedge_from_energy_release_rate(wedge.energy_release_rate)
    np.testing.assert_allclose(back.distance, distance, rtol=1e-12)
    np.testing.assert_allclose(back.vertical_force, wedge.vertical_force, rtol=1e-12)
    np.testing.assert_allclose(back.contact_width, wedge.contact_width, rtol=1e-12)


def test_numbers_give_floats_and_arrays_arrays():
    assert type(reference.far_field_wedge(5).distance) is float
    assert type(reference.crack_tip_opening(1, 2)) is float
    assert reference.rigid_strip_energy_release_rate([0.1, 0.2], 1.0).shape == (2,)


@pytest.mark.parametrize(
    ("function", "arguments", "name"),
    [
        (reference.far_field_wedge, (0.5,), "distance"),
        (reference.far_field_wedge_from_energy_release_rate, (10.0,), "energy_release_rate"),
        (reference.far_field_wedge_from_energy_release_rate, (0.0,), "energy_release_rate"),
        (reference.hertz_line_contact, (0.0,), "force"),
        (reference.stretched_strip_energy_release_rate, (0.0, 1.0, 2.0), "stretch"),
        (reference.stretched_strip_energy_release_rate, (2.0, 1.0, 0.5), "alpha"),
        (reference.rigid_strip_energy_release_rate, (0.1, 0.0), "distance"),
        (reference.crack_tip_opening, (-1.0, 1.0), "energy_release_rate"),
    ],
)
def test_numbers_out_of_range_are_refused_by_name(function, arguments, name):
    with pytest.raises(InputError, match=name):
        function(*arguments)


def test_strip_is_the_energy_of_the_slice_ahead():
    rate = reference.stretched_strip_energy_release_rate(1.5, 2.0, 5.0)
    assert rate == pytest.approx(2 * 2.0 * 2 / 25 * (1.5**5 + 1.5**-5 - 2), rel=1e-14)
    tiny = reference.stretched_strip_energy_release_rate(1 + 1e-9, 1.0, 5.0)
    # linear: 2 H E' strain^2/2; the strain itself is 1e-9 to 1e-7 relative in floating point
    assert tiny == pytest.approx(reference.PLANE_STRAIN_MODULUS * 1e-18, rel=1e-6)


def test_hertz_pressure_carries_the_force_and_is_uniform_in_shape():
    contact = reference.hertz_line_contact([0.1, 0.4], [1.0, 2.0])
    np.testing.assert_allclose(
        np.pi / 2 * contact.half_width * contact.peak_pressure, [0.1, 0.4], rtol=1e-14
    )
    # the cylinder's curvature 1/R is that of the half-space's surface, 4 p_max / (E' 2 a)
    modulus = reference.PLANE_STRAIN_MODULUS
    curvature = 2 * contact.peak_pressure / (modulus * contact.half_width)
    np.testing.assert_allclose(curvature, [1.0, 0.5], rtol=1e-14)


def test_crack_tip_opening_has_the_rate_of_its_harmonic_field():
    """J as the flux of configurational force of y = b sqrt(r) sin(theta/2), W = |grad y|^2/2."""
    rate, r = 2.0, 0.3
    b = reference.crack_tip_opening(rate, 1.0)

    def flux(theta):  # W n_1 - (n . grad y) dy/dX, on half a circle of radius r
        radial = 0.5 * b / np.sqrt(r) * np.sin(theta / 2)
        hoop = 0.5 * b / np.sqrt(r) * np.cos(theta / 2)
        along = radial * np.cos(theta) - hoop * np.sin(theta)
        return (0.5 * (radial**2 + hoop**2) * np.cos(theta) - radial * along) * r

    assert 2 * quad(flux, 0, np.pi)[0] == pytest.approx(rate, rel=1e-12)

"""What errors of the wires' radii do to an identification, and when it is said."""

import numpy as np
import pytest

from surrogate import identify
from surrogate.identification.summary import budget, errors_of_wires

RADII = np.array([0.05, 0.1, 0.2, 0.3, 0.4]) * 1e-3
TOUGHNESS, WEAR = 1.6, 3e3


def force(radius):
    """Eq. (13) without friction [N/m]."""
    return TOUGHNESS + 4.0 * radius * WEAR


def fit_of(radius, forces, **options):
    return identify(radius, forces, 3e3, model="eq13", friction_coefficient=0.0, **options)


@pytest.mark.parametrize("repeats", [1, 5])
def test_the_errors_are_the_scatter_of_estimates_from_wires_of_other_radii(repeats):
    random, share, draws = np.random.default_rng(3), 0.02, 400
    told = np.repeat(RADII, repeats)
    std = 0.03 * force(told)
    estimates = []
    for _ in range(draws):
        true = np.repeat(RADII * (1.0 + share * random.normal(size=RADII.size)), repeats)
        fit = fit_of(told, force(true), force_std=std)
        estimates.append((fit.toughness, fit.wear_strength))
    errors = errors_of_wires(fit_of(told, force(told), force_std=std), share)
    # A standard deviation of n draws is known to 1 in sqrt(2 n): four of these.
    np.testing.assert_allclose(errors, np.std(estimates, axis=0), rtol=4.0 / np.sqrt(2.0 * draws))


def test_they_are_said_where_repeats_or_stated_errors_hide_them():
    random = np.random.default_rng(5)
    told = np.repeat(RADII, 8)
    forces = force(told) * (1.0 + 0.01 * random.normal(size=told.size))
    assert "however often you cut with it" in budget(fit_of(told, forces))
    stated = budget(fit_of(RADII, force(RADII), force_std=0.01 * force(RADII)))
    assert "if each wire's had a standard error of 2 %" in stated
    assert "Radii" not in budget(fit_of(RADII, forces[::8]))  # their scatter has them in it
    wide = force(told) * (1.0 + 0.3 * random.normal(size=told.size))
    assert "Radii" not in budget(fit_of(told, wide))

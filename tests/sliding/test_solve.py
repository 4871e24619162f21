"""Asking for configurations that rub: bad input, the frictionless case, and where paths end."""

import re
from dataclasses import replace

import numpy as np
import pytest

from fe_training.sliding.record import BALANCE_BOUND, CREASE_STRETCH, SlidingOutcome
from fe_training.sliding.solve import solve, solve_rays
from fe_training.solver.cut import Settings
from fe_training.solver.solve import solve as solve_frictionless
from surrogate.errors import InputError

COARSE = Settings(sectors=14, contact_spacing=0.15, notch_radius=5e-3, outer_radius=1e5)


@pytest.mark.parametrize(
    "bad",
    [
        {"friction_coefficient": -0.1},
        {"friction_coefficient": np.nan},
        {"friction_coefficient": np.inf},
        {"relative_wear_strength": -1.0},
        {"relative_wear_strength": 1e300},
        {"g": 0.0},
        {"alpha": 0.5},
        {"taper": -1.0},
    ],
)
def test_input_outside_the_range_is_refused_with_its_name(bad):
    name, value = next(iter(bad.items()))
    with pytest.raises(InputError, match=re.escape(f"{name} = {value:.6g}")):
        solve(**{"alpha": 5.0, "g": 2.0, **bad})


@pytest.mark.parametrize("radius", [0.0, -1e-3, 0.5, np.nan])
def test_a_notch_that_is_none_or_as_large_as_the_contact_is_refused(radius):
    with pytest.raises(InputError, match=f"notch_radius = {radius:.6g} is outside"):
        solve(5.0, g=1.0, settings=replace(COARSE, notch_radius=radius))


def test_without_load_it_is_the_frictionless_configuration():
    record = solve(5.0, g=2.0, settings=COARSE)
    plain = solve_frictionless(5.0, g=2.0, settings=COARSE)
    assert record.outcome is SlidingOutcome.CONVERGED
    assert record.amplification == 1.0
    assert record.steady_force == pytest.approx(2.0 * plain.horizontal_force, rel=1e-7)
    assert record.first_arc == pytest.approx(plain.slip_arc, rel=1e-7)
    assert record.first_load == pytest.approx(plain.slip_load, rel=1e-7)


def test_a_way_that_ends_says_why_and_keeps_what_it_reached():
    """So much wear compresses the face in front of the contact until it creases."""
    reached, *beyond = solve_rays(5.0, 0.5, [[(0.0, 0.3), (0.0, 20.0), (0.0, 30.0)]], COARSE)
    assert reached.outcome is SlidingOutcome.CONVERGED
    assert reached.wear == 0.3
    for record, wear in zip(beyond, (20.0, 30.0), strict=True):
        assert record.outcome not in (SlidingOutcome.CONVERGED, SlidingOutcome.OUTSIDE_EVIDENCE)
        assert record.target_wear == wear
        assert 0.3 < record.wear < 20.0  # the last equilibrium, not the one asked for
        assert record.reason
        assert not record.is_reached
        # the crease or close to it, whichever is met first on this mesh
        assert record.least_stretch < CREASE_STRETCH + 0.1


def test_a_load_with_a_maximum_is_followed_around_it():
    """With the tip in contact friction alone has a limit: the wire goes on, and xi falls."""
    first, last = solve_rays(3.0, 4.0, [[(0.1, 0.0), (0.5, 0.0)]], COARSE)
    assert (first.outcome, first.friction) == (SlidingOutcome.CONVERGED, 0.1)
    assert last.outcome is SlidingOutcome.LIMIT
    assert 0.1 < last.friction < 0.5
    # the row is that of the maximum, where the position no longer decides J
    assert abs(last.position_rate) < 0.1 * first.position_rate
    assert last.amplification > first.amplification
    assert last.balance_error < BALANCE_BOUND
    largest, fallen = map(float, re.findall(r"xi = ([0-9.]+)", last.reason))
    assert largest == pytest.approx(last.friction, rel=1e-3)
    assert fallen < 0.995 * largest


def test_tapered_wear_costs_a_part_of_the_shear_at_the_ends_alone():
    (whole,), (tapered,) = (
        solve_rays(5.0, 2.0, [[(0.0, 0.3)]], COARSE, taper=taper) for taper in (0.0, 0.5)
    )
    assert (whole.ramp, tapered.ramp) == (0.0, pytest.approx(0.15))
    assert tapered.balance_error < BALANCE_BOUND
    drag, less = (record.steady_force - 2.0 for record in (whole, tapered))
    assert 0.95 * drag < less < drag


@pytest.mark.slow
def test_a_node_that_finds_no_rest_does_not_end_the_path():
    """Here the midside node behind the front of the contact is pulled, whatever its shear."""
    coarse = Settings(sectors=12, contact_spacing=0.15, notch_radius=5e-3, outer_radius=1e3)
    first, second = solve_rays(4.0, 6.0, [[(0.05, 0.2), (0.1, 0.4)]], coarse)
    assert (first.pull, second.friction) == (0.0, 0.1)
    assert 0.0 < second.pull < 1e-3
    assert second.amplification > first.amplification

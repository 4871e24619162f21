"""Configurations by energy release rate, by distance and by insertion, on coarse meshes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fe_training.mechanics.analytic import far_field_wedge
from fe_training.solver import cut
from fe_training.solver.cut import Settings
from fe_training.solver.record import Outcome, Record
from fe_training.solver.solve import solve, solve_path
from surrogate.errors import InputError

COARSE = Settings(sectors=16, contact_spacing=0.15, notch_radius=5e-3, outer_radius=1e5)


@pytest.fixture(scope="module")
def path() -> list[Record]:
    """Return a path that crosses both branches."""
    return solve_path(5.0, [2.0, 0.02, 0.8], COARSE, shift=True)


def test_records_come_in_rising_order_at_the_values_wanted(path):
    assert [r.energy_release_rate for r in path] == pytest.approx([0.02, 0.8, 2.0], rel=1e-3)


def test_results_move_as_the_mechanics_says(path):
    distance = [r.distance for r in path]
    load = [r.normal_load for r in path]
    assert distance == sorted(distance, reverse=True)
    assert load == sorted(load)
    assert all(0 <= r.theta_1 < r.theta_2 < np.pi for r in path)
    assert all((r.pressure > -1e-6 * r.pressure.max()).all() for r in path)


def test_the_configurational_balance_holds(path):
    # coarse meshes: the shipped bounds are for the standard ones
    near = path[1:]
    assert all(r.force_mismatch < 5e-3 for r in near)
    assert all(r.support_spread < 5e-3 for r in near)


def test_each_record_says_what_was_wanted(path):
    assert [r.target for r in path] == [0.02, 0.8, 2.0]


def test_a_true_shift_of_the_tip_releases_the_same_energy(path):
    # a discretised body: its energy knows the mesh, as J and 2 F_h do
    for r in path:
        assert r.energy_release_rate_shift == pytest.approx(r.energy_release_rate, rel=0.01)


def test_the_mesh_error_is_the_difference_of_two_meshes():
    told = []
    (record,) = solve_path(9.0, [0.7], COARSE, told.append, mesh_error=True)
    assert [t.mesh_error for t in told] == [record.mesh_error]
    coarser = solve(9.0, g=0.7, settings=replace(COARSE.refined(1 / 1.5), tolerance=1e-5))
    assert coarser.unknowns < record.unknowns
    expected = abs(coarser.normal_load / record.normal_load - 1)
    assert record.mesh_error == pytest.approx(expected, rel=1e-6)
    assert 0 < record.mesh_error < 0.01
    with pytest.raises(InputError, match="g instead"):
        solve(9.0, distance=2.0, settings=COARSE, mesh_error=True)


def test_the_far_field_is_the_linear_wedge(path):
    far = path[0]
    wedge = far_field_wedge(far.distance)
    assert far.normal_load == pytest.approx(wedge.vertical_force, rel=0.02)
    assert far.energy_release_rate == pytest.approx(wedge.energy_release_rate, rel=0.05)


def test_the_pressure_carries_the_vertical_force(path):
    for r in path:
        order = np.argsort(r.pressure_angle)
        theta, pressure = r.pressure_angle[order], r.pressure[order]
        load = pressure * np.sin(theta)
        force = 0.5 * (load[1:] + load[:-1]) @ np.diff(theta)
        assert force == pytest.approx(r.normal_load, rel=0.05)


def test_the_same_configuration_by_distance_and_by_insertion(path):
    wanted = path[1]
    by_distance = solve(5.0, distance=wanted.distance, settings=COARSE)
    by_insertion = solve(5.0, insertion=wanted.insertion, settings=COARSE)
    for other in (by_distance, by_insertion):
        assert other.energy_release_rate == pytest.approx(wanted.energy_release_rate, rel=1e-4)
        assert other.normal_load == pytest.approx(wanted.normal_load, rel=1e-4)


@pytest.mark.parametrize(
    ("arguments", "word"),
    [
        ({"alpha": 0.5, "g": 1.0}, "alpha"),
        ({"alpha": 2.0, "g": -1.0}, "g"),
        ({"alpha": 2.0, "g": np.nan}, "g"),
        ({"alpha": 2.0, "distance": 0.9}, "distance"),
        ({"alpha": 2.0}, "exactly one"),
        ({"alpha": 2.0, "g": 1.0, "distance": 2.0}, "exactly one"),
    ],
)
def test_bad_input_is_named(arguments, word):
    with pytest.raises(InputError, match=word):
        solve(**arguments)


def test_every_outcome_but_success_has_a_remedy():
    assert all(bool(o.remedy) != (o is Outcome.CONVERGED) for o in Outcome)


def test_a_path_that_asks_for_too_large_a_mesh_ends_with_that_outcome(monkeypatch):
    within = solve(5.0, g=0.5, settings=COARSE)
    monkeypatch.setattr(cut, "MOST_UNKNOWNS", within.unknowns)
    reached, failed = solve_path(5.0, [0.5, 5.0], replace(COARSE, scatter=0.003))
    assert failed.outcome is Outcome.TOO_LARGE
    assert f"{within.unknowns:,} unknowns" in failed.reason
    assert failed.target == 5.0
    assert failed.wall_time > 0.0
    assert reached.unknowns <= within.unknowns

"""The laws "coupled" and "auto": their forces, errors and slopes, and who falls back to what."""

import shutil
from dataclasses import replace

import numpy as np
import pytest

from surrogate import (
    AccuracyError,
    DomainError,
    InputError,
    Scene,
    classify,
    cutting_force,
    dissipative_force,
    force_gradient,
    identify,
    propagate,
    transition_radius,
)
from surrogate.choosing.laws import coupled as under_coupled
from surrogate.contact.shipped import in_use
from surrogate.scene import NAMES

SOLID = Scene(5e3, 1.0, [0.5e-3, 2e-3, 8e-3], 0.02, 500.0, 4.0)


def kappa_of(kappa, scene):
    g = scene.toughness / (scene.shear_modulus * np.asarray(scene.wire_radius))
    relative = scene.wear_strength / scene.shear_modulus
    at = g, scene.stiffening_exponent, scene.friction_coefficient, relative
    return np.exp(kappa.log_factor(*at)), kappa.share(*at), kappa.error(*at)


@pytest.mark.parametrize("model", ["power-law", "table", "gp"])
def test_coupled_is_kappa_times_slip(coupled, model):
    slip = cutting_force(SOLID, model, law="slip")
    force = cutting_force(SOLID, model, law="coupled")
    factor, share, _ = kappa_of(coupled, SOLID)
    assert np.all(share < 1.0)
    assert np.all(factor > 1.01)
    assert force.friction == pytest.approx(slip.friction * factor, rel=1e-13)
    assert force.wear == pytest.approx(slip.wear * factor, rel=1e-13)
    assert force.law == "coupled"
    assert np.all(force.law_error == 0.0)
    assert np.all(force.relative_error >= slip.fit_error * slip.total / force.total)


def test_without_friction_and_wear_every_law_is_the_toughness(coupled):
    bare = replace(SOLID, friction_coefficient=0.0, wear_strength=0.0)
    for law in ("projected", "slip", "coupled", "auto"):
        force = cutting_force(bare, law=law)
        assert force.total.tolist() == [1.0, 1.0, 1.0]
        assert np.all(force.relative_error == 0.0)
        far = replace(bare, wire_radius=1e-9)  # where no model reaches
        assert cutting_force(far, law=law).total == 1.0


def test_one_number_and_many_agree(coupled):
    for law in ("coupled", "auto"):
        many = cutting_force(SOLID, law=law)
        for i, radius in enumerate(SOLID.wire_radius.tolist()):
            one = cutting_force(replace(SOLID, wire_radius=radius), law=law)
            assert type(one.total) is float
            assert (one.total, one.relative_error) == (many.total[i], many.relative_error[i])
            assert one.laws == np.broadcast_to(many.laws, 3)[i]


def test_auto_takes_slip_where_the_load_does_little_and_kappa_where_it_does_more(coupled):
    light = replace(SOLID, friction_coefficient=1e-4, wear_strength=1.0)
    force = cutting_force(light, law="auto")
    assert "coupled" not in force.laws
    assert np.all(force.relative_error <= 0.02)
    heavy = cutting_force(SOLID, law="auto")
    assert set(heavy.laws) <= {"slip", "coupled"}
    assert "coupled" in heavy.laws
    same = heavy.laws == "coupled"
    exact = cutting_force(SOLID, "table", law="coupled")
    off = np.abs(heavy.total[same] / exact.total[same] - 1.0)
    assert np.all(off <= heavy.relative_error[same] + exact.relative_error[same])


def test_auto_is_within_its_error_of_the_coupled_table(coupled):
    rng = np.random.default_rng(2)
    for _ in range(20):
        scene = Scene(
            5e3,
            rng.uniform(0.2, 5.0, 40),
            10.0 ** rng.uniform(-3.3, -2.0, 40),
            rng.uniform(0.0, 0.03),
            rng.uniform(0.0, 600.0),
            float(rng.uniform(3.1, 8.0)),
        )
        force = cutting_force(scene, law="auto", outside="nan")
        exact = cutting_force(scene, "table", law="coupled", outside="nan")
        known = np.isfinite(force.relative_error) & np.isfinite(exact.total)
        off = np.abs(force.total / exact.total - 1.0)[known]
        assert known.sum() > 10
        assert np.all(off <= (force.relative_error + exact.relative_error)[known] + 1e-12)


def test_outside_the_solutions_auto_is_the_projected_law_with_an_unknown_error(coupled):
    beyond = replace(SOLID, friction_coefficient=0.4)
    force = cutting_force(beyond, law="auto")
    assert np.all(kappa_of(coupled, beyond)[1] > 1.0)
    assert np.array_equal(force.total, cutting_force(beyond, law="projected").total)
    assert np.unique(force.laws).tolist() == ["projected"]
    assert np.isnan(force.relative_error).all()
    assert np.isnan(force.law_error).all()
    with pytest.raises(AccuracyError, match="is known to nobody"):
        cutting_force(beyond, law="auto", rtol=0.05)
    with pytest.raises(DomainError, match="times it"):
        cutting_force(beyond, law="coupled")


def test_a_promise_is_met_or_refused(coupled):
    assert np.all(cutting_force(SOLID, law="auto", rtol=0.2).relative_error <= 0.2)
    with pytest.raises(AccuracyError, match="on which the wire rubs"):
        cutting_force(SOLID, law="auto", rtol=1e-4)


def test_points_outside_are_no_number_if_that_is_asked_for(coupled):
    wires = replace(SOLID, wire_radius=[1e-9, 2e-3])
    for law in ("projected", "slip", "coupled", "auto"):
        with pytest.raises(DomainError):
            cutting_force(wires, law=law)
        force = cutting_force(wires, law=law, outside="nan")
        assert np.isnan([force.total[0], force.friction[0], force.wear[0]]).all()
        assert force.in_domain.tolist() == [False, True]
        assert force.total[1] == cutting_force(replace(SOLID, wire_radius=2e-3), law=law).total
    alone = cutting_force(replace(SOLID, wire_radius=1e-9), outside="nan")
    assert np.isnan(alone.total)
    assert alone.cleavage == 1.0
    with pytest.raises(InputError, match="outside must be 'raise' or 'nan'"):
        cutting_force(SOLID, outside="ignore")


def test_extrapolated_kappa_is_that_of_the_nearest_load(coupled):
    beyond = replace(SOLID, friction_coefficient=0.4)
    force = cutting_force(beyond, "table", law="coupled", extrapolate=True)
    slip = cutting_force(beyond, "table", law="slip")
    assert force.friction == pytest.approx(slip.friction * kappa_of(coupled, beyond)[0], rel=1e-13)
    assert not force.in_domain.any()
    assert np.isnan(force.relative_error).all()


@pytest.mark.parametrize("name", NAMES)
def test_slopes_of_coupled_are_those_of_its_force(coupled, name):
    scene = replace(SOLID, wire_radius=2.1e-3)
    h = 1e-5 * getattr(scene, name)
    up, down = (replace(scene, **{name: getattr(scene, name) + d}) for d in (h, -h))
    force = [cutting_force(each, "table", law="coupled").total for each in (up, down)]
    slope = getattr(force_gradient(scene, "table", law="coupled"), name)
    assert slope == pytest.approx((force[0] - force[1]) / (2 * h), rel=1e-5, abs=1e-9)


def test_the_dimensionless_force_is_that_of_a_scene(coupled):
    g = SOLID.toughness / (SOLID.shear_modulus * SOLID.wire_radius)
    for law in ("coupled", "auto"):
        drag = dissipative_force(
            g, 4.0, 0.02, 0.1, "table" if law == "coupled" else "auto", law=law
        )
        force = cutting_force(SOLID, "table", law="coupled")
        scale = SOLID.shear_modulus * SOLID.wire_radius
        assert drag == pytest.approx((force.friction + force.wear) / scale, rel=0.05)


def test_transition_radius_parts_the_coupled_force(coupled):
    scene = replace(SOLID, wire_radius=1e-3)
    radius = transition_radius(scene, "table", law="coupled")
    there = replace(scene, wire_radius=radius)
    slope = force_gradient(there, "table", law="coupled")
    assert scene.toughness * slope.toughness == pytest.approx(radius * slope.wire_radius, rel=1e-6)
    assert radius != pytest.approx(transition_radius(scene, "table", law="slip"), rel=1e-3)


def test_an_identification_finds_the_solid_that_made_the_forces(coupled):
    radii = np.array([0.5e-3, 1e-3, 2e-3, 4e-3, 8e-3])
    scene = replace(SOLID, wire_radius=radii)
    forces = cutting_force(scene, "table", law="coupled").total
    known = {"friction_coefficient": 0.02, "stiffening_exponent": 4.0, "model": "table"}
    fit = identify(radii, forces, 5e3, force_std=0.01 * forces, law="coupled", **known)
    assert fit.law == "coupled"
    assert fit.toughness == pytest.approx(1.0, rel=1e-4)
    assert fit.wear_strength == pytest.approx(500.0, rel=1e-4)
    other = identify(radii, forces, 5e3, force_std=0.01 * forces, law="slip", **known)
    assert other.wear_strength > 1.01 * fit.wear_strength
    much = cutting_force(replace(scene, wear_strength=4e4), "table", law="slip").total
    with pytest.raises(DomainError, match="coupled solutions do not reach"):
        identify(radii, much, 5e3, force_std=0.01 * much, law="coupled", **known)


def test_regime_and_propagation_know_the_law(coupled):
    assert classify(SOLID, law="coupled").contact.tolist() == ["far-field"] * 3
    assert classify(SOLID, law="auto").dominant.shape == (3,)
    std = {"toughness": 0.05, "wear_strength": 30.0}
    slip, full = (propagate(SOLID, std, "table", law=law) for law in ("slip", "coupled"))
    assert np.all(full.std > slip.std)
    assert np.all(full.model_std > slip.model_std)


def test_without_its_file_the_law_is_refused_with_the_remedy(installed, fitted_file, tmp_path):
    for name in (fitted_file.name, f"{fitted_file.name}.sha256"):
        shutil.copy(fitted_file.parent / name, tmp_path / name)
    with in_use(tmp_path):
        _require_refusal()


def _require_refusal():
    with pytest.raises(InputError, match=r"coupled\.npz"):
        cutting_force(SOLID, law="coupled")
    for model in ("auto", "table"):
        force = cutting_force(SOLID, model)
        assert np.array_equal(force.total, cutting_force(SOLID, model, law="projected").total)
        assert np.isnan(force.law_error).all()
        assert len(force.doubts) == 1
    assert force_gradient(SOLID) == replace(
        force_gradient(SOLID, law="projected"),
        laws=np.full(3, "projected"),
        doubts=force.doubts,
    )
    assert under_coupled.__name__ == "coupled"

"""The cuts of an identification on a map: where they are, and how far that is known."""

import numpy as np
import pytest

from surrogate import InputError, MapPoints, Scene, cutting_force, identify, regime_map
from surrogate.maps.belonging import require_the_same
from surrogate.maps.points import places

MU, GAMMA, TAU, XI = 2000.0, 3.0, 9000.0, 0.2
RADII = np.array([3e-5, 1e-4, 2e-4, 4e-4, 6e-4])


def forces(mu=MU, xi=XI, model="eq13"):
    return np.asarray(cutting_force(Scene(mu, GAMMA, RADII, xi, TAU), model).total)


def fitted(force, mu=MU, xi=XI, **known):
    options = {"friction_coefficient": xi, "model": "eq13", "relative_error": 0.02} | known
    return identify(RADII, force, mu, **options)


def test_each_wire_is_a_point_with_what_was_identified():
    fit = fitted(forces() * [1.01, 0.99, 1.0, 1.02, 0.98], shear_modulus_std=50.0)
    points = MapPoints.from_identification(fit, "gel")
    assert points.scene.wire_radius.tolist() == RADII.tolist()
    assert (points.scene.toughness, points.scene.wear_strength) == (
        fit.toughness,
        fit.wear_strength,
    )
    assert points.std["toughness"] == fit.toughness_std
    assert points.std["shear_modulus"] == 50.0
    assert points.correlation["toughness", "wear_strength"] == fit.correlation
    assert (points.label, points.law) == ("gel", "projected")


def test_repeated_cuts_are_one_point():
    force = np.repeat(forces(), 2) * np.tile([0.99, 1.01], RADII.size)
    fit = identify(np.repeat(RADII, 2), force, MU, friction_coefficient=XI, model="eq13")
    assert np.shape(MapPoints.from_identification(fit).scene.wire_radius) == (RADII.size,)


@pytest.mark.parametrize("axes", [("R_w/l_e", "R_w/l_w"), ("g", "tau_w/(xi mu)")])
def test_bars_are_the_scatter_of_repeated_experiments(axes):
    """Forces, mu and xi are drawn anew with their errors, and identified each time."""
    rng, cuts = np.random.default_rng(3), 2000
    stds = {"shear_modulus_std": 0.03 * MU, "friction_std": 0.01}
    made = regime_map(*axes, ((1e-4, 1e4), (1e-4, 1e4)), {"xi": XI}, nodes=5)
    there = []
    for _ in range(cuts):
        force = forces() * (1.0 + 0.02 * rng.standard_normal(RADII.size))
        mu, xi = MU + 0.03 * MU * rng.standard_normal(), XI + 0.01 * rng.standard_normal()
        fit = fitted(force, mu, xi, force_std=0.02 * forces(), relative_error=None, **stds)
        there.append(made.locate(fit.scene(RADII)))
    spread = np.std(np.array([np.broadcast_arrays(*one) for one in there]), axis=0)
    truth = fitted(forces(), force_std=0.02 * forces(), relative_error=None, **stds)
    bars = places(MapPoints.from_identification(truth), made)[1]
    # 2000 draws tell a standard deviation to 1.6 %, of which three; relative errors are up to 6 %,
    # and what first order leaves out is of the size of their squares
    assert bars == pytest.approx(spread, rel=0.06)


def test_what_is_held_or_unknown_has_no_bar_and_the_legend_says_so():
    two = identify(RADII[:2], forces()[:2], MU, friction_coefficient=XI, model="eq13")
    points = MapPoints.from_identification(two, "gel")
    assert points.label == "gel (errors unknown)"
    assert not points.std
    curve = identify([1e-4, 4e-4], [4.7, 13.9], 685.0)
    for mode, _ in enumerate(curve.profile.modes):
        assert not MapPoints.from_identification(curve, mode=mode).std
    given = fitted(forces() * [1.01, 0.99, 1.0, 1.02, 0.98], wear_strength=TAU)
    assert set(MapPoints.from_identification(given).std) == {"toughness"}


def test_several_materials_are_told_apart():
    gel = [1e-4, 2e-4, 4e-4, 5e-4], [4.7, 7.9, 13.9, 17.2]
    fit = identify(*gel, 685.0, force_std=[0.2, 0.2, 0.3, 0.3])
    first, second = (MapPoints.from_identification(fit, "gel", mode=mode) for mode in (0, 1))
    assert first.label == "gel (1 of 2 materials)"
    assert second.label == "gel (2 of 2 materials)"
    assert second.scene.toughness == fit.profile.modes[1].toughness != first.scene.toughness
    low, high = fit.profile.toughness_intervals[0]
    height = fit.profile.threshold - fit.profile.modes[1].misfit
    assert second.std["toughness"] == pytest.approx(0.5 * (high - low) / np.sqrt(height))
    ends = fit.misfit.at(np.array([low, high])).misfit
    assert ends - fit.profile.modes[1].misfit == pytest.approx(height, rel=1e-3)
    for mode in (2, -1, True, "1", 0.5):
        with pytest.raises(InputError, match="mode must be one of the materials"):
            MapPoints.from_identification(fit, mode=mode)


@pytest.mark.parametrize(
    ("fit", "words"),
    [
        (lambda: fitted(forces()[::-1]), "may be used, but"),
        (lambda: identify(RADII, forces() * 1.01, model="eq13", relative_error=0.1), "modulus"),
        (lambda: 3.0, "must be what identify returned, but is 3"),
    ],
)
def test_what_should_not_be_used_is_not_drawn(fit, words):
    with pytest.raises(InputError, match=words):
        MapPoints.from_identification(fit())


def test_a_map_of_its_own_gel_takes_them_and_others_do_not():
    fit = fitted(forces() * [1.01, 0.99, 1.0, 1.02, 0.98])
    points = MapPoints.from_identification(fit, "gel")
    own = {"mu": MU, "xi": XI, "tau_w": fit.wear_strength}
    span = ("R_w", "Gamma_o", ((1e-5, 1e-2), (0.05, 50.0)))
    require_the_same(points, regime_map(*span, own, nodes=5))
    for name in ("xi", "tau_w"):  # what is not fixed is 0 on a map
        others = {key: value for key, value in own.items() if key != name}
        with pytest.raises(InputError, match="where the map has, as nothing fixes it, 0"):
            require_the_same(points, regime_map(*span, others, nodes=5))


def test_the_law_and_the_exponent_must_be_the_maps():
    scene = Scene(685.0, 1.6, [1e-4], wear_strength=7e3, stiffening_exponent=3.0)
    span = ("R_w", "Gamma_o", ((1e-5, 1e-2), (0.05, 50.0)), {"mu": 685.0, "tau_w": 7e3})
    require_the_same(MapPoints(scene, "gel"), regime_map(*span, nodes=5))
    with pytest.raises(InputError, match="stiffening exponent is 3"):
        require_the_same(MapPoints(scene, "gel"), regime_map(*span, "table", nodes=5))
    with pytest.raises(InputError, match="identified by the law 'slip'"):
        require_the_same(MapPoints(scene, "gel", law="slip"), regime_map(*span, nodes=5))
    with pytest.raises(InputError, match="law of map points must be one of"):
        MapPoints(scene, "gel", law="gravity")

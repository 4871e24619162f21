"""No sharp interval around a wrong number: limits, misfits, slips, what an interval contains."""

import copy
import pickle

import numpy as np
import pytest
from torture.coverage import drawn, outcome

from surrogate import InputError, Scene, contact_functions, cutting_force, identify
from surrogate.identification.outlier import outlier

RADII = np.array([0.125e-3, 0.210e-3, 0.275e-3, 0.390e-3, 0.470e-3])
NOISE = np.array([0.03, -0.02, 0.01, 0.02, -0.03])
MODULUS = 3e4


def forces(radius, toughness=2.0, wear_strength=7e3, modulus=MODULUS, friction=0.0):
    scene = Scene(modulus, toughness, radius, friction, wear_strength)
    return np.asarray(cutting_force(scene, "table", extrapolate=True, law="projected").total)


NOISY = forces(RADII) * (1.0 + NOISE)


# Wires beyond the model's range


def test_needles_above_the_domain_do_not_cap_the_toughness():
    """Four needles in a liver-like solid, two of them beyond the range; Eq. (13) gives 165 J/m2."""
    radius = 0.5e-3 * np.array([0.7, 1.0, 1.4, 2.1])
    fit = identify(radius, [172.0, 175.0, 181.0, 186.0], 3e3, force_std=9.0)
    paper = identify(radius, [172.0, 175.0, 181.0, 186.0], 3e3, force_std=9.0, model="eq13")
    low, high = fit.toughness_interval
    assert low < paper.toughness < high
    assert fit.toughness_limited_by == ("forces", "forces")
    assert "2 of 4 cuts (R_w = 0.35, 0.5 mm)" in fit.warnings[0]


def test_a_thin_wire_does_not_fool_the_papers_gel():
    radius = np.append(RADII, 1e-5)
    fit = identify(radius, forces(radius, 1.6, 7750.0, 685.0), 685.0, force_std=0.1)
    assert fit.toughness == pytest.approx(1.6, rel=1e-6)
    assert fit.toughness_interval[0] < 1.6 < fit.toughness_interval[1]


@pytest.mark.parametrize("g", [1e-5, 1e3])
def test_exact_forces_far_out_of_range_give_back_the_material(g):
    toughness = g * MODULUS * RADII[2]
    exact = forces(RADII, toughness, 7e3)
    fit = identify(RADII, exact, MODULUS, force_std=1e-3 * exact)
    low, high = fit.toughness_interval
    assert low <= toughness <= high


def test_a_modulus_far_above_the_range_is_told_and_does_not_move_the_answer():
    """Where A hardly changes over the wires any modulus gives the line's answer, less its slope."""
    radius, force = [1e-4, 2e-4, 4e-4, 5e-4], [4.7, 7.9, 13.9, 17.2]
    low, high = identify(radius, force, model="eq13").toughness_interval
    inside, far = (identify(radius, force, mu) for mu in (3e4, 1e7))
    assert inside.toughness < far.toughness < high
    assert low < far.toughness
    assert far.warnings[0].startswith("4 of 4 cuts (R_w = 0.1, 0.2, 0.4, 0.5 mm) are at g = ")
    assert "xi = 0.1 does not fit the forces" in far.summary()  # it alone would need 10 times them


# What an interval contains


@pytest.mark.parametrize("model", ["table", "eq13"])
def test_other_friction_is_that_of_another_identification(model):
    fit = identify(RADII, NOISY, 3e3, model=model, force_std=0.2)
    other = fit.with_friction(0.2)
    told = identify(RADII, NOISY, 3e3, model=model, force_std=0.2, friction_coefficient=0.2)
    nodes = 10.0 ** (1 / 48) / 8**4  # spacing of the scan after four zooms by 8
    assert other.toughness == pytest.approx(told.toughness, rel=nodes)
    assert other.wear_strength == pytest.approx(told.wear_strength, rel=nodes)
    assert other.fits
    assert "Friction was taken to be 0: with xi = 0.1, Gamma_o = " in fit.summary()
    assert "Friction was taken" not in told.summary()
    with pytest.raises(InputError, match="friction_coefficient must be"):
        fit.with_friction(-0.1)


def test_every_source_of_error_widens_the_intervals_and_is_told():
    options = {"force_std": 0.05 * NOISY, "friction_coefficient": 0.2, "law": "projected"}
    plain = identify(RADII, NOISY, MODULUS, **options)
    for name, std in (
        ("shear_modulus", {"shear_modulus_std": 0.1 * MODULUS}),
        ("friction_coefficient", {"friction_std": 0.1}),
        ("stiffening_exponent", {"stiffening_std": 0.5}),
    ):
        wider = identify(RADII, NOISY, MODULUS, **options, **std)
        assert wider.contributions[name][1] > 0.0
        assert wider.wear_strength_std > plain.wear_strength_std
        squares = np.sum([np.square(part) for part in wider.contributions.values()], axis=0)
        np.testing.assert_allclose(squares, np.diag(wider.covariance), rtol=1e-9)
    assert set(plain.contributions) == {"scatter", "model"}


def test_a_line_with_uncertain_friction_is_propagated_in_closed_form():
    fit = identify(RADII, NOISY, MODULUS, force_std=0.2, model="eq13", friction_std=0.1)
    exact = identify(RADII, NOISY, MODULUS, force_std=0.2, model="eq13")
    # Gamma_o (1 + xi) and tau_w + xi mu are what the forces tell
    np.testing.assert_allclose(
        fit.contributions["friction_coefficient"], [0.1 * exact.toughness, 0.1 * MODULUS], rtol=1e-6
    )
    assert fit.toughness == pytest.approx(exact.toughness, rel=1e-9)


@pytest.mark.parametrize("model", ["table", "eq13"])
def test_the_sensitivity_to_friction_is_that_of_another_identification(model):
    exact = forces(RADII)
    first, second = (
        identify(RADII, exact, MODULUS, model=model, force_std=0.1, friction_coefficient=xi)
        for xi in (0.0, 1e-3)
    )
    moved = [second.toughness - first.toughness, second.wear_strength - first.wear_strength]
    np.testing.assert_allclose(1e-3 * np.array(first.friction_sensitivity), moved, rtol=0.02)
    assert first.assumed == ("stiffening_exponent",)


def test_repeats_tell_the_scatter_and_samples_what_is_between_them():
    random = np.random.default_rng(5)
    radius = np.repeat(RADII, 12)
    exact = forces(radius)
    for kind, std in (("proportional", 0.05 * exact), ("constant", np.full(60, 0.3))):
        fit = identify(radius, exact + std * random.standard_normal(60), MODULUS)
        assert fit.scatter.kind == kind
        size = fit.scatter.proportional if kind == "proportional" else fit.scatter.constant
        assert size == pytest.approx(0.05 if kind == "proportional" else 0.3, rel=0.3)  # 3 of 55
    sample = np.tile(np.arange(12), 5)
    shift = 0.6 * random.standard_normal(12)[sample]
    noisy = exact + shift + 0.2 * random.standard_normal(60)
    named = identify(radius, noisy, MODULUS, sample=sample.astype(str), model="eq13")
    assert 1.5 < named.scatter.sample_ratio < 6.0
    assert named.contributions["sample"][0] > 0.0


def test_errors_of_the_forces_can_be_a_share():
    stated = identify(RADII, NOISY, MODULUS, relative_error=0.05)
    np.testing.assert_allclose(stated.force_std, 0.05 * NOISY)
    with pytest.raises(InputError, match="give one of them"):
        identify(RADII, NOISY, MODULUS, relative_error=0.05, force_std=0.1)


# Misfits and slips


@pytest.mark.parametrize(("slip", "words"), [(1e-3, "too small"), (1e3, "too large"), (1.0, None)])
def test_a_slip_that_explains_the_misfit_is_named(slip, words):
    """Materials whose wires are near the touch, where the curve says what the modulus is."""
    radius = np.geomspace(2e-5, 1e-3, 7)
    exact = forces(radius, 30.0, 1e5)
    fit = identify(radius, exact, slip * MODULUS, force_std=0.01 * exact)
    told = [sentence for sentence in fit.warnings if "it would be explained if" in sentence]
    assert len(told) == (words is not None)
    assert all(f"the shear modulus is 1000 times {words}" in sentence for sentence in told)


def test_forces_that_fall_with_the_radius_are_doubted_before_any_number():
    fit = identify([1e-4, 2e-4, 4e-4, 5e-4], [9.0, 7.0, 5.0, 4.0], 685.0)
    assert fit.wear_strength == 0.0
    assert np.isnan(fit.toughness_std)
    assert "the forces fall with the radius as the curve cannot" in fit.objections[0]
    assert any("above the smallest force" in sentence for sentence in fit.objections)
    assert str(fit).startswith("Do not use the numbers below: the forces fall")
    line = identify([1e-4, 2e-4, 4e-4, 5e-4], [9.0, 7.0, 5.0, 4.0], 685.0, model="eq13")
    assert not any("standard deviations off" in sentence for sentence in line.warnings)


def test_repeats_that_agree_on_another_curve_are_a_misfit():
    radius = np.repeat(RADII, 5)
    bent = 2.0 + 2e8 * (radius - 3e-4) ** 2
    fit = identify(radius, bent * (1.0 + 0.01 * np.tile([-1, 0.5, 0, -0.5, 1], 5)), MODULUS)
    assert "as far off the curve as repeated cuts scatter" in fit.warnings[0]


@pytest.mark.parametrize("std", [None, 0.1])
def test_an_outlier_is_named_by_a_curve_too(std):
    radius = np.repeat(RADII, 2)
    force = forces(radius) + 0.1 * np.random.default_rng(2).standard_normal(10)
    force[3] += 2.0
    fit = identify(radius, force, MODULUS, force_std=std)
    told = next(sentence for sentence in fit.warnings if sentence.startswith("cut 4 "))
    others = np.arange(10) != 3
    less = identify(radius[others], force[others], MODULUS, force_std=std)
    assert f"Without it Gamma_o = {less.toughness:.3g} J/m2" in told
    assert f"tau_w = {1e-3 * less.wear_strength:.3g} kPa" in told


def test_a_line_without_a_cut_is_that_of_the_others():
    force = forces(np.append(RADII, 6e-4)) + np.array([0.0, 0.1, -0.1, 3.0, 0.1, 0.0])
    fit = identify(np.append(RADII, 6e-4), force, model="eq13")
    bad, others = outlier(fit), np.arange(6) != 3
    less = identify(np.append(RADII, 6e-4)[others], force[others], model="eq13")
    assert bad.cut == 3
    assert bad.toughness == pytest.approx(less.toughness, rel=1e-9)
    assert bad.wear_strength == pytest.approx(less.wear_strength, rel=1e-9)


# What may be left out, and what a result is


def test_a_negative_exponent_is_the_same_solid():
    """l_1 = 1/l_2 in plane strain, so that alpha and -alpha give the same energy."""
    one, other = (identify(RADII, NOISY, MODULUS, stiffening_exponent=a) for a in (3.0, -3.0))
    assert (one.toughness, one.wear_strength) == (other.toughness, other.wear_strength)
    scenes = [Scene(MODULUS, 2.0, RADII, 0.1, 7e3, alpha) for alpha in (3.0, -3.0)]
    assert scenes[1].stiffening_exponent == 3.0
    np.testing.assert_array_equal(*(cutting_force(scene).total for scene in scenes))
    many = Scene(MODULUS, 2.0, 1e-4, stiffening_exponent=[-3.0, 2.0, -4])
    np.testing.assert_array_equal(many.stiffening_exponent, [3.0, 2.0, 4.0])
    for model in ("table", "eq9"):
        arcs = [contact_functions(3.0, alpha, model).arc for alpha in (3.0, -3.0)]
        assert arcs[0] == arcs[1]
    for bad in (0.0, -np.inf, np.nan, [-2.0, 0.0]):
        with pytest.raises(InputError, match="finite and positive"):
            Scene(MODULUS, 2.0, 1e-4, stiffening_exponent=bad)
    stretch, (plus, minus) = np.linspace(0.5, 3.0, 20), (3.0, -3.0)
    energy = [(stretch**a + stretch**-a - 2.0) / a**2 for a in (plus, minus)]
    np.testing.assert_allclose(*energy, rtol=1e-15)


def test_a_line_without_friction_needs_no_modulus():
    free = identify(RADII, NOISY, model="eq13")
    given = identify(RADII, NOISY, MODULUS, model="eq13")
    assert free.toughness == given.toughness
    assert free.wear_strength_interval == given.wear_strength_interval
    assert free.assumed[0] == "shear_modulus"
    assert np.isnan(free.dimensionless_toughness).all()
    for options in ({}, {"model": "eq13", "friction_coefficient": 0.1}):
        with pytest.raises(InputError, match="shear modulus is missing"):
            identify(RADII, NOISY, **options)


def test_a_result_is_printed_pickled_and_copied():
    fit = identify(RADII, NOISY, MODULUS)
    assert str(fit) == fit.summary()
    assert str(fit).startswith("Gamma_o = ")
    assert len(str(fit).splitlines()) <= 25
    assert len(repr(fit).splitlines()) == 1
    for again in (pickle.loads(pickle.dumps(fit)), copy.deepcopy(fit)):
        assert str(again) == str(fit)


# Coverage, the short form of scripts/coverage


def test_intervals_hold_the_truth_in_and_out_of_range():
    """150 experiments: 95 % less three standard errors of that count; nothing is refused."""
    random = np.random.default_rng(7)
    outcomes = [outcome(drawn(random)) for _ in range(150)]
    inside = np.mean([one.inside for one in outcomes], axis=0)
    assert np.all(inside > 0.95 - 3.0 * np.sqrt(0.95 * 0.05 / 150)), inside

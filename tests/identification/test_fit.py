"""Identification: exact lines come back, intervals cover, and every doubt is put into words."""

from functools import partial

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import surrogate
from surrogate import Scene
from surrogate.basics.files import model_file
from surrogate.errors import InputError
from surrogate.inference.line_fit import solve_least_squares
from surrogate.reading.measurements import read_measurements

identify = partial(surrogate.identify, model="eq13")
cutting_force = partial(surrogate.cutting_force, model="eq13")

PAPER_RADII = np.array([0.125e-3, 0.210e-3, 0.275e-3, 0.390e-3, 0.470e-3])
MODULUS = 685.0
FAR = 1e6  # a shear modulus for which g < 1 at all of these radii, where no regime warning is due

toughnesses = st.floats(0.01, 1e3)
strengths = st.floats(1.0, 1e6)
frictions = st.floats(0.0, 1.5)
radius_sets = st.lists(st.integers(1, 10_000), min_size=3, max_size=12, unique=True).map(
    lambda numbers: np.array(numbers) * 1e-6
)


def forces(radius, toughness, wear_strength, friction=0.0, modulus=MODULUS, model="eq13"):
    scene = Scene(modulus, toughness, radius, friction, wear_strength)
    return np.asarray(cutting_force(scene, model=model, law="projected").total)


def test_paper_experiment():
    measurements = read_measurements(model_file("paam-wire-cutting.csv"))
    fit = identify(measurements.wire_radius, measurements.force, MODULUS)
    assert fit.toughness == pytest.approx(1.6, rel=1e-13)
    assert fit.wear_strength == pytest.approx(7750.0, rel=1e-13)
    assert fit.wear_length == pytest.approx(1.6 / 7750.0)
    assert fit.wear_transition_radius == pytest.approx(51.6e-6, abs=0.05e-6)
    assert fit.transition_radius == pytest.approx(fit.wear_transition_radius)  # since xi = 0
    assert fit.dimensionless_toughness[[0, -1]] == pytest.approx([18.69, 4.97], abs=0.01)


@pytest.mark.parametrize("model", ["eq13", "low-toughness", "friction-free"])
@settings(max_examples=50)
@given(radius=radius_sets, toughness=toughnesses, strength=strengths, friction=frictions)
def test_exact_line_is_recovered(model, radius, toughness, strength, friction):
    force = forces(radius, toughness, strength, friction, model=model)
    fit = identify(radius, force, MODULUS, friction_coefficient=friction, model=model)
    # A rounding of the forces, magnified by the design's condition, in units of each estimate.
    rounding = 1e-14 * fit.condition * force.max()
    assert fit.toughness == pytest.approx(toughness, abs=rounding)
    assert fit.wear_strength == pytest.approx(strength, abs=rounding / radius.max())
    np.testing.assert_allclose(fit.predict(radius), force, rtol=0, atol=rounding)


@settings(max_examples=50)
@given(radius=radius_sets, seed=st.integers(0, 2**32 - 1), length=st.sampled_from([1e-3, 1e3]))
def test_units_do_not_matter(radius, seed, length):
    """Stretch lengths by a factor at the same stresses: toughness scales alike, tau_w stays."""
    force = forces(radius, 2.0, 5e3) * np.random.default_rng(seed).uniform(0.9, 1.1, radius.size)
    fit = identify(radius, force, MODULUS)
    scaled = identify(radius * length, force * length, MODULUS)
    digits = 1e-12 * fit.condition**2
    scale = force.max()
    assert scaled.toughness / length == pytest.approx(fit.toughness, abs=digits * scale)
    assert scaled.wear_strength == pytest.approx(
        fit.wear_strength, abs=digits * scale / radius.max()
    )
    assert scaled.r_squared == pytest.approx(fit.r_squared, abs=1e-9)


@settings(max_examples=50)
@given(order=st.permutations(range(5)), weighted=st.booleans())
def test_order_of_the_cuts_does_not_matter(order, weighted):
    force = np.array([5.6, 8.0, 10.3, 13.5, 16.3])
    std = np.array([0.2, 0.3, 0.2, 0.5, 0.4]) if weighted else None
    fit = identify(PAPER_RADII, force, MODULUS, force_std=std)
    other = identify(
        PAPER_RADII[order], force[order], MODULUS, force_std=None if std is None else std[order]
    )
    assert other.toughness == pytest.approx(fit.toughness, rel=1e-12)
    np.testing.assert_allclose(other.covariance, fit.covariance, rtol=1e-11)
    np.testing.assert_allclose(other.residuals, fit.residuals[order], rtol=0, atol=1e-13)


def test_diameter_is_two_radii():
    force = np.array([5.6, 8.0, 10.3, 13.5, 16.3])
    by_radius = identify(PAPER_RADII, force, MODULUS)
    by_diameter = identify(None, force, MODULUS, wire_diameter=2.0 * PAPER_RADII)
    assert by_diameter.toughness == by_radius.toughness
    assert by_diameter.wear_strength == by_radius.wear_strength


def test_unweighted_fit_is_scipys():
    linregress = pytest.importorskip("scipy.stats").linregress
    force = np.array([5.6, 8.0, 10.3, 13.5, 16.3])
    line = linregress(PAPER_RADII, force)
    fit = identify(PAPER_RADII, force, MODULUS)
    assert fit.toughness == pytest.approx(line.intercept, rel=1e-12)
    assert fit.toughness_std == pytest.approx(line.intercept_stderr, rel=1e-12)
    assert fit.wear_strength == pytest.approx(line.slope / 4.0, rel=1e-12)
    assert fit.wear_strength_std == pytest.approx(line.stderr / 4.0, rel=1e-12)
    assert fit.r_squared == pytest.approx(line.rvalue**2, rel=1e-12)


def test_weighted_fit_is_scipys_with_absolute_sigma():
    curve_fit = pytest.importorskip("scipy.optimize").curve_fit
    force = np.array([5.6, 8.0, 10.3, 13.5, 16.3])
    std = np.array([0.2, 0.3, 0.2, 0.5, 0.4])
    millimetres = 1e3 * PAPER_RADII
    values, covariance = curve_fit(
        lambda r, a, b: a + 4 * b * r, millimetres, force, sigma=std, absolute_sigma=True
    )
    fit = identify(PAPER_RADII, force, MODULUS, force_std=std)
    to_pascal = np.array([1.0, 1e3])
    assert [fit.toughness, fit.wear_strength] == pytest.approx(values * to_pascal, rel=1e-6)
    expected = covariance * np.outer(to_pascal, to_pascal)
    np.testing.assert_allclose(fit.covariance, expected, rtol=1e-5)
    assert fit.reduced_chi_squared == pytest.approx(np.sum((fit.residuals / std) ** 2) / 3)
    assert fit.correlation == pytest.approx(
        expected[0, 1] / np.sqrt(expected[0, 0] * expected[1, 1])
    )


def test_equal_standard_errors_do_not_move_the_estimate():
    force = np.array([5.6, 8.0, 10.3, 13.5, 16.3])
    free = identify(PAPER_RADII, force, MODULUS)
    known = identify(PAPER_RADII, force, MODULUS, force_std=0.2)
    assert known.toughness == pytest.approx(free.toughness, rel=1e-12)
    np.testing.assert_allclose(
        free.covariance, known.covariance * known.reduced_chi_squared, rtol=1e-11
    )


@pytest.mark.parametrize("known", [False, True])
def test_intervals_cover_the_truth_and_sound_experiments_seldom_warn(known):
    """1500 synthetic experiments: 95 % +- 1.7 %, three standard errors of that count."""
    random = np.random.default_rng(20241202)
    std = 0.05 * forces(PAPER_RADII, 1.6, 7750.0)
    covered, warned, count = np.zeros(2), 0, 1500
    for _ in range(count):
        noise = random.normal(size=5) * (std if known else 0.4)
        force = forces(PAPER_RADII, 1.6, 7750.0) + noise
        fit = identify(PAPER_RADII, force, FAR, force_std=std if known else None)
        for i, (low, high), truth in (
            (0, fit.toughness_interval, 1.6),
            (1, fit.wear_strength_interval, 7750.0),
        ):
            covered[i] += low <= truth <= high
        warned += any("outlier" in sentence or "chi^2" in sentence for sentence in fit.warnings)
    assert covered / count == pytest.approx(0.95, abs=0.017)
    due = 0.04 if known else 0.03  # 3 % for an outlier, 1 % for a misfit of known errors
    assert warned / count < due + 3.0 * np.sqrt(due * (1.0 - due) / count)


def test_friction_cannot_be_identified():
    """Two very different friction coefficients fit the same forces equally well."""
    force = forces(PAPER_RADII, 1.6, 7750.0, friction=0.2) + np.array([0.1, -0.2, 0.0, 0.2, -0.1])
    free = identify(PAPER_RADII, force, MODULUS, friction_coefficient=0.0)
    rough = identify(PAPER_RADII, force, MODULUS, friction_coefficient=0.5)
    np.testing.assert_allclose(free.residuals, rough.residuals, rtol=0, atol=1e-12)
    assert rough.toughness == pytest.approx(free.toughness / 1.5)
    assert rough.wear_strength == pytest.approx(free.wear_strength - 0.5 * MODULUS)


@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_standard_errors_of_lengths_are_those_of_repeated_experiments(friction):
    """2 % scatter of the forces: what first order leaves out is (std/estimate)^2, below 1 %."""
    random = np.random.default_rng(11)
    options = {"friction_coefficient": friction, "force_std": 0.02 * forces(PAPER_RADII, 8.0, 5e3)}
    exact = forces(PAPER_RADII, 8.0, 5e3, friction)
    fits = [
        identify(PAPER_RADII, exact + random.normal(0.0, options["force_std"]), MODULUS, **options)
        for _ in range(2000)
    ]
    for name in ("wear_length", "wear_transition_radius", "transition_radius"):
        scatter = np.std([getattr(fit, name) for fit in fits])
        stated = np.mean([getattr(fit, f"{name}_std") for fit in fits])
        # The scatter of 2000 values is itself known to 1/sqrt(2 x 2000) = 1.6 %; four of those.
        assert stated == pytest.approx(scatter, rel=0.064), name


def test_standard_errors_of_lengths_that_are_no_numbers_are_unknown():
    flat = identify(PAPER_RADII, [2.0] * 4 + [2.0 - 1e-9], MODULUS)
    two = identify([1e-4, 2e-4], [2.0, 3.0], MODULUS)
    for fit in (flat, two):
        assert np.isnan(fit.wear_length_std)
        assert np.isnan(fit.transition_radius_std)


def test_the_prediction_for_no_wire_is_the_cleavage_toughness():
    fit = identify(PAPER_RADII, forces(PAPER_RADII, 2.0, 5e3), MODULUS)
    assert fit.predict(0.0) == fit.toughness
    assert fit.predict_std(0.0) == fit.toughness_std


def test_band_at_the_intercept_is_the_toughness_interval():
    force = np.array([5.6, 8.0, 10.3, 13.5, 16.3])
    fit = identify(PAPER_RADII, force, MODULUS)
    low, high = fit.band(1e-12)
    assert (float(low), float(high)) == pytest.approx(fit.toughness_interval, rel=1e-6)
    assert fit.predict(1e-4).shape == ()
    assert fit.predict([1e-4, 2e-4])[0] == fit.predict(1e-4)


def test_the_record_does_not_change_with_the_callers_arrays():
    radius, force = PAPER_RADII.copy(), forces(PAPER_RADII, 1.6, 7750.0)
    fit = identify(radius, force, MODULUS)
    force[0] = 99.0
    assert fit.force[0] == pytest.approx(5.475)
    with pytest.raises(ValueError, match="read-only"):
        fit.force[0] = 1.0


SOUND = np.array([5.5, 8.0, 10.2, 13.6, 16.2])
OUTLYING = np.array([5.5, 8.0, 12.2, 13.6, 16.2])


@pytest.mark.parametrize(
    ("radius", "force", "options", "words"),
    [
        (PAPER_RADII, SOUND, {}, None),
        (PAPER_RADII, SOUND, {"force_std": 0.2}, None),
        (PAPER_RADII[:2], SOUND[:2], {}, "only 2 different radii"),
        (PAPER_RADII[:2], SOUND[:2], {}, "leave no measure of scatter"),
        (PAPER_RADII[[0, 0, 1]], [5.5, 5.3, 8.0], {}, "only 2 different radii"),
        (2e-4 + 1e-7 * np.arange(5), SOUND, {}, "too alike"),
        (PAPER_RADII, SOUND - 5.0, {}, "toughness is negative"),
        (PAPER_RADII, 10.0 - 0.3 * SOUND, {}, "wear strength is negative"),
        (PAPER_RADII, SOUND, {"shear_modulus": MODULUS}, "5 of 5 wires"),
        (PAPER_RADII, SOUND, {"shear_modulus": 5000.0}, "3 of 5 wires"),
        (PAPER_RADII, OUTLYING, {"force_std": 0.2}, "cut 3"),
        (PAPER_RADII, OUTLYING, {"force_std": 0.2}, "chi^2/dof"),
        (np.arange(1, 9) * 1e-4, [1.1, 2, 2.9, 4.1, 9, 6, 7.1, 7.9], {}, "cut 5"),
        (PAPER_RADII, 1.6 + 31e3 * PAPER_RADII, {}, "to the last digit"),
        (
            PAPER_RADII,
            SOUND,
            {"model": "friction-free", "friction_coefficient": 0.1},
            "leaves out the friction",
        ),
    ],
)
def test_warnings_come_when_and_only_when_due(radius, force, options, words):
    fit = identify(radius, force, **{"shear_modulus": FAR, **options})
    if words is None:
        assert fit.warnings == ()
    else:
        assert sum(words in sentence for sentence in fit.warnings) == 1


def test_negative_estimates_are_reported_and_lengths_are_not_made_up():
    fit = identify(PAPER_RADII, SOUND - 5.0, MODULUS)
    assert fit.toughness == pytest.approx(identify(PAPER_RADII, SOUND, MODULUS).toughness - 5.0)
    assert np.isnan(fit.wear_length)
    assert np.isnan(fit.transition_radius)


def test_forces_that_do_not_vary():
    fit = identify([1e-4, 2e-4, 3e-4], [2.0, 2.0, 2.0], FAR)
    assert fit.toughness == pytest.approx(2.0)
    assert np.isnan(fit.r_squared)


@pytest.mark.parametrize(
    ("arguments", "options", "words"),
    [
        ((PAPER_RADII, SOUND, MODULUS), {"wire_diameter": PAPER_RADII}, "both are given"),
        ((None, SOUND, MODULUS), {}, "neither is given"),
        ((PAPER_RADII, SOUND[:3], MODULUS), {}, "5 radii, 3 forces"),
        ((PAPER_RADII, SOUND, MODULUS), {"force_std": [1, 2]}, "2 standard errors"),
        (([], [], MODULUS), {}, "no measurements"),
        ((2e-4, 1.0, MODULUS), {}, "one wire"),
        (([2e-4, 2e-4], [1.0, 2.0], MODULUS), {}, "one wire"),
        (([2e-4, 2e-4 * (1 + 4e-16)], [1.0, 2.0], MODULUS), {}, "by rounding only"),
        ((PAPER_RADII * 0.0, SOUND, MODULUS), {}, "wire_radius must be"),
        ((PAPER_RADII, -SOUND, MODULUS), {}, "cutting counted positive"),
        ((PAPER_RADII, SOUND * np.nan, MODULUS), {}, "force must be"),
        ((PAPER_RADII, SOUND, 0.0), {}, "shear_modulus must be"),
        ((PAPER_RADII, SOUND, [1.0, 2.0]), {}, "must be one number, but is an array of shape (2,)"),
        (([PAPER_RADII], SOUND, MODULUS), {}, "one number a cut"),
        ((PAPER_RADII, SOUND, MODULUS), {"force_std": 0.0}, "force_std must be"),
        ((PAPER_RADII, SOUND, MODULUS), {"confidence": 95.0}, "give 0.95"),
        ((PAPER_RADII, SOUND, MODULUS), {"confidence": 1.0}, "give 0.95"),
        ((PAPER_RADII, SOUND, MODULUS), {"model": "eq9"}, "not linear in both"),
        ((PAPER_RADII, SOUND, MODULUS), {"model": "high-toughness"}, "not linear in both"),
        ((PAPER_RADII, SOUND, MODULUS), {"model": "eq99"}, "eq99"),
    ],
)
def test_bad_input_is_refused_in_words(arguments, options, words):
    with pytest.raises(InputError) as caught:
        identify(*arguments, **options)
    assert words in str(caught.value)


@settings(max_examples=50)
@given(
    exponents=st.tuples(*[st.floats(-30, 29.9)] * 3),
    std_exponent=st.none() | st.floats(-30, 30),
    friction=st.sampled_from([0.0, 1e-30, 1.0, 1e30]),
)
def test_every_size_of_number_gives_numbers(exponents, std_exponent, friction):
    radius_size, force_size, modulus = (10.0**e for e in exponents)
    fit = identify(
        radius_size * np.array([1.0, 1.3, 1.9, 2.0]) / 2.0 + 1e-30,
        force_size * np.array([1.0, 1.5, 1.8, 2.2]) / 2.0 + 1e-30,
        modulus,
        friction_coefficient=friction,
        force_std=None if std_exponent is None else 10.0**std_exponent,
    )
    assert np.all(np.isfinite([fit.toughness, fit.wear_strength, fit.correlation]))
    assert np.all(np.isfinite(fit.covariance))
    assert isinstance(fit.warnings, tuple)


def test_least_squares_with_dependent_columns_has_no_answer():
    fit = solve_least_squares(np.ones((3, 2)), np.arange(3.0))
    assert np.all(np.isnan(fit.estimate))
    assert np.isinf(fit.condition)

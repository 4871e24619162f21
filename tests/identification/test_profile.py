"""Identification under models that are not linear: minima, intervals, bounds, words."""

from functools import partial
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import surrogate
from surrogate import DomainError, InputError, Scene, cutting_force
from surrogate.basics.checks import Quantity
from surrogate.choosing.by_name import force_model
from surrogate.contact.closed_forms import FORCE_MODELS, ClosedForm
from surrogate.equations import DIMENSIONLESS_TOUGHNESS
from surrogate.inference.inputs import Known
from surrogate.inference.misfit import Misfit

identify = partial(surrogate.identify, model="eq13")

RADII = np.array([0.125e-3, 0.210e-3, 0.275e-3, 0.390e-3, 0.470e-3])
WIDE = np.geomspace(0.02e-3, 2e-3, 6)
MODULUS = 685.0
SOUND = np.array([5.5, 8.0, 10.2, 13.6, 16.2])


@pytest.fixture(autouse=True)
def known_models(elements, bump):
    """Make the models of tests known."""


def forces(radius, toughness, wear_strength, friction=0.0, model="elements"):
    scene = Scene(MODULUS, toughness, radius, friction, wear_strength)
    return np.asarray(cutting_force(scene, model, law="projected").total)


# The minimum


@pytest.mark.parametrize("model", ["eq13", "elements", "bump"])
@pytest.mark.parametrize("friction", [0.0, 0.2])
@pytest.mark.parametrize("toughness", [0.05, 0.9, 3.0, 20.0])
def test_exact_forces_give_back_the_material(model, friction, toughness):
    force = forces(WIDE, toughness, 7750.0, friction, model)
    options = {"model": model, "friction_coefficient": friction, "toughness_max": 1e3}
    fit = identify(WIDE, force, MODULUS, **options)
    assert fit.toughness == pytest.approx(toughness, rel=1e-9)
    assert fit.wear_strength == pytest.approx(7750.0, rel=1e-9)
    np.testing.assert_allclose(fit.predict(WIDE), force, rtol=1e-9)
    assert np.max(np.abs(fit.residuals)) < 1e-9 * force.max()


@pytest.mark.parametrize("std", [None, 0.2, [0.2, 0.3, 0.2, 0.5, 0.4]])
@pytest.mark.parametrize("friction", [0.0, 0.3])
@pytest.mark.parametrize("model", ["eq13", "low-toughness", "friction-free"])
def test_a_line_followed_along_the_toughness_is_the_linear_fit(std, friction, model):
    """Two routes to every number: least squares, and the profile that a bound asks for."""
    options = {"force_std": std, "friction_coefficient": friction, "model": model}
    linear = identify(RADII, SOUND, MODULUS, **options)
    followed = identify(RADII, SOUND, MODULUS, toughness_max=1e3, **options)
    assert linear.profile is None
    assert followed.profile is not None
    for name in ("toughness", "wear_strength", "toughness_std", "wear_strength_std"):
        assert getattr(followed, name) == pytest.approx(getattr(linear, name), rel=1e-10), name
    for name in ("toughness_interval", "wear_strength_interval", "r_squared", "correlation"):
        assert getattr(followed, name) == pytest.approx(getattr(linear, name), rel=1e-8), name
    np.testing.assert_allclose(followed.covariance, linear.covariance, rtol=1e-9)
    np.testing.assert_allclose(followed.leverage, linear.leverage, rtol=1e-9)
    np.testing.assert_allclose(followed.residuals, linear.residuals, rtol=0, atol=1e-12)
    np.testing.assert_allclose(followed.band(RADII), linear.band(RADII), rtol=2e-3)
    np.testing.assert_allclose(followed.predict_std(RADII), linear.predict_std(RADII), rtol=1e-9)
    assert followed.reduced_chi_squared == (
        None if std is None else pytest.approx(linear.reduced_chi_squared)
    )


@pytest.mark.parametrize("model", ["elements", "bump"])
@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_the_slope_of_the_misfit_is_that_of_finite_differences(model, friction):
    cuts = identify(RADII, SOUND, MODULUS, force_std=0.2, friction_coefficient=friction).cuts
    known = Known(toughness_prior=(2.0, 0.7), wear_strength_prior=(6e3, 2e3))
    misfit = Misfit(force_model(model), cuts, known)
    gamma = np.array([1e-3, 0.1, 0.8, 2.0, 7.0])
    step = 1e-5 * gamma
    up, down = misfit.at(gamma + step).misfit, misfit.at(gamma - step).misfit
    scale = misfit.at(gamma).misfit / gamma
    assert np.all(np.abs(misfit.slope(gamma) - (up - down) / (2 * step)) < 1e-6 * scale)


def test_the_best_of_a_fine_grid_is_no_better():
    random = np.random.default_rng(8)
    for model in ("elements", "bump"):
        for _ in range(10):
            force = forces(RADII, random.uniform(0.1, 6.0), 7750.0, model=model)
            force = force * random.normal(1.0, 0.1, 5)
            fit = identify(RADII, force, MODULUS, model=model, force_std=0.3)
            misfit = Misfit(force_model(model), fit.cuts, Known())
            grid = misfit.at(np.geomspace(1e-9, force.max(), 20_000)).misfit
            assert fit.profile.modes[0].misfit <= grid.min() * (1 + 1e-12)
            lowest = np.flatnonzero((grid[1:-1] < grid[:-2]) & (grid[1:-1] < grid[2:]))
            found = [mode.misfit for mode in fit.profile.modes]
            for depth in grid[1:-1][lowest]:
                assert min(abs(depth - each) for each in found) < 1e-4 * (1.0 + depth)


def test_order_and_units_do_not_matter():
    fit = identify(RADII, SOUND, MODULUS, model="elements", force_std=0.2)
    turned = identify(RADII[::-1], SOUND[::-1], MODULUS, model="elements", force_std=0.2)
    assert turned.toughness == pytest.approx(fit.toughness, rel=1e-12)
    assert turned.toughness_interval == pytest.approx(fit.toughness_interval, rel=1e-9)
    scaled = identify(RADII * 1e3, SOUND * 1e9, MODULUS * 1e6, model="elements", force_std=0.2e9)
    assert scaled.toughness == pytest.approx(fit.toughness * 1e9, rel=1e-9)
    assert scaled.wear_strength == pytest.approx(fit.wear_strength * 1e6, rel=1e-9)
    expected = pytest.approx(1e6 * np.array(fit.wear_strength_interval), rel=1e-6)
    assert scaled.wear_strength_interval == expected


# Several minima


def test_two_materials_that_fit_are_both_reported_and_a_wire_between_them_named():
    force = forces(RADII[[0, 2, 4]], 1.0, 3000.0, model="bump")
    fit = identify(RADII[[0, 2, 4]], force, MODULUS, model="bump", force_std=0.6)
    admitted = [mode for mode in fit.profile.modes if mode.admitted]
    assert len(admitted) > 1
    assert fit.toughness == admitted[0].toughness == pytest.approx(1.0, rel=1e-6)
    assert [mode.misfit for mode in fit.profile.modes] == sorted(
        mode.misfit for mode in fit.profile.modes
    )
    assert f"{len(admitted)} materials fit the forces" in fit.undecided[0]
    assert f"tau_w = {1e-3 * admitted[1].wear_strength:.4g} kPa" in fit.undecided[0]
    wire = fit.further_wire
    assert wire.modes
    assert f"a wire {2e3 * wire.wire_radius:.3g} mm across" in fit.undecided[-1]
    # No other wire in the range tells them apart better.
    ends = sorted(admitted, key=lambda mode: mode.toughness)
    grid = np.geomspace(*wire.searched, 5000)
    both = [
        forces(grid, mode.toughness, mode.wear_strength, model="bump")
        for mode in (ends[0], ends[-1])
    ]
    spread = np.interp(np.log(grid), np.log(RADII[[0, 2, 4]]), 0.6 / force)
    separation = np.abs(both[1] - both[0]) / (spread * np.mean(both, axis=0))
    assert wire.separation >= 0.999 * separation.max() * (len(admitted) == 2)
    assert wire.forces == pytest.approx([np.interp(wire.wire_radius, grid, f) for f in both], 1e-3)


def test_the_named_wire_decides():
    radius = RADII[[0, 2, 4]]
    fit = identify(
        radius, forces(radius, 1.0, 3000.0, model="bump"), MODULUS, model="bump", force_std=0.6
    )
    more = np.append(radius, np.full(4, fit.further_wire.wire_radius))
    again = identify(
        more, forces(more, 1.0, 3000.0, model="bump"), MODULUS, model="bump", force_std=0.6
    )
    assert sum(mode.admitted for mode in again.profile.modes) == 1
    assert again.toughness == pytest.approx(1.0, rel=1e-6)


def test_intervals_in_pieces():
    force = forces(RADII, 1.0, 3000.0, model="bump")
    fit = identify(RADII, force, MODULUS, model="bump", force_std=0.35)
    pieces = fit.profile.toughness_intervals
    misfit = Misfit(force_model("bump"), fit.cuts, Known())
    for low, high in pieces:
        ends = misfit.at(np.array([low, high])).misfit
        assert ends == pytest.approx(fit.profile.threshold, rel=1e-9)
        inside = misfit.at(np.linspace(low, high, 50)[1:-1]).misfit
        assert np.all(inside < fit.profile.threshold)
    between = [(a[1], b[0]) for a, b in pairwise(pieces)]
    for low, high in between:
        assert np.all(misfit.at(np.linspace(low, high, 50)[1:-1]).misfit > fit.profile.threshold)
    assert fit.toughness_interval == (pieces[0][0], pieces[-1][1])


def test_the_wear_strengths_interval_is_its_own_profile():
    """The smallest misfit over all toughnesses reaches the threshold at the interval's ends."""
    for model, std in (("elements", 0.4), ("bump", 0.35)):
        fit = identify(RADII, SOUND, MODULUS, model=model, force_std=std)
        at = fit.cuts
        gamma = np.geomspace(1e-6, SOUND.max(), 40_001)
        for low, high in fit.profile.wear_strength_intervals:
            for end in (low, high):
                fixed = Misfit(force_model(model), at, Known(wear_strength=end))
                smallest = fixed.at(gamma).misfit.min()
                assert smallest == pytest.approx(fit.profile.threshold, rel=1e-4), (model, end)


# What the intervals promise


@pytest.mark.parametrize(
    ("model", "radius", "toughness", "known"),
    [
        ("elements", RADII, 1.6, True),
        ("elements", RADII, 1.6, False),
        ("elements", WIDE, 0.3, True),
        ("bump", RADII, 1.0, True),
    ],
)
def test_intervals_cover_the_truth(model, radius, toughness, known):
    """400 synthetic experiments: 95 % +- 3.3 %, three standard errors of that count.

    More than 95 % is no fault where a limit or another minimum widens the interval.
    """
    random = np.random.default_rng(20250111)
    exact = forces(radius, toughness, 7750.0, model=model)
    std = 0.03 * exact if known else np.full(exact.shape, 0.15)
    covered, count = np.zeros(2), 400
    for _ in range(count):
        force = exact + random.normal(size=exact.size) * std
        fit = identify(radius, force, MODULUS, model=model, force_std=std if known else None)
        for i, (pieces, truth) in enumerate(
            (
                (fit.profile.toughness_intervals, toughness),
                (fit.profile.wear_strength_intervals, 7750.0),
            )
        ):
            covered[i] += any(low <= truth <= high for low, high in pieces)
    assert np.all(covered / count > 0.95 - 0.033), covered / count
    assert np.all(covered / count < 0.95 + 0.033), covered / count


def test_the_band_holds_the_force_of_every_admitted_material():
    fit = identify(RADII, SOUND, MODULUS, model="elements", force_std=0.4)
    low, high = fit.band(WIDE)
    assert np.all(low < fit.predict(WIDE))
    assert np.all(fit.predict(WIDE) < high)
    for gamma, smallest, largest in fit.profile.admitted.T:
        for tau in (smallest, largest):
            force = forces(WIDE, gamma, tau)
            assert np.all(force >= low * (1 - 1e-12))
            assert np.all(force <= high * (1 + 1e-12))


# Bounds, values, priors


def test_a_bound_holds_and_is_told():
    fit = identify(RADII, SOUND, MODULUS, model="elements", force_std=0.2, toughness_max=1.2)
    assert fit.toughness == 1.2
    assert fit.toughness_interval[1] == 1.2
    assert fit.profile.ends == ("zero", "bound")
    assert any("given bound" in sentence for sentence in fit.warnings)
    assert any("bound of 1.2 J/m2, not the forces" in sentence for sentence in fit.undecided)
    free = identify(RADII, SOUND, MODULUS, model="elements", force_std=0.2)
    loose = identify(RADII, SOUND, MODULUS, model="elements", force_std=0.2, toughness_max=9.0)
    assert loose.toughness == pytest.approx(free.toughness, rel=1e-12)
    assert not any("bound" in sentence for sentence in (*loose.warnings, *loose.undecided))


def test_a_known_wear_strength_leaves_one_unknown():
    fit = identify(RADII, SOUND, MODULUS, force_std=0.2, wear_strength=7e3)
    weighted = SOUND - 4 * 7e3 * RADII
    assert fit.toughness == pytest.approx(weighted.mean(), rel=1e-12)
    assert fit.toughness_std == pytest.approx(0.2 / np.sqrt(5), rel=1e-12)
    half = 1.959964 * 0.2 / np.sqrt(5)
    expected = pytest.approx([weighted.mean() - half, weighted.mean() + half], rel=1e-6)
    assert fit.toughness_interval == expected
    assert (fit.wear_strength, fit.wear_strength_std, fit.dof) == (7e3, 0.0, 4)
    assert fit.wear_strength_interval == (7e3, 7e3)
    assert np.isnan(fit.correlation)


def test_one_wire_and_a_known_wear_strength_give_a_toughness():
    fit = identify([2e-4], forces(2e-4, 2.0, 7e3), MODULUS, model="elements", wear_strength=7e3)
    assert fit.toughness == pytest.approx(2.0, rel=1e-9)
    assert np.isnan(fit.toughness_interval).all()


def test_priors_weigh_as_so_many_measurements():
    """For a line, against generalised least squares with one more row for each prior."""
    std = np.array([0.2, 0.3, 0.2, 0.5, 0.4])
    design = np.column_stack([np.ones(5), 4 * RADII]) / std[:, np.newaxis]
    rows = np.vstack([design, [1 / 0.3, 0.0], [0.0, 1 / 400.0]])
    values = np.concatenate([SOUND / std, [2.2 / 0.3, 7000.0 / 400.0]])
    expected, misfit, *_ = np.linalg.lstsq(rows, values, rcond=None)
    fit = identify(
        RADII,
        SOUND,
        MODULUS,
        force_std=std,
        toughness_prior=(2.2, 0.3),
        wear_strength_prior=(7000.0, 400.0),
    )
    assert [fit.toughness, fit.wear_strength] == pytest.approx(expected, rel=1e-10)
    np.testing.assert_allclose(fit.covariance, np.linalg.inv(rows.T @ rows), rtol=1e-9)
    assert fit.profile.modes[0].misfit == pytest.approx(misfit[0], rel=1e-9)
    assert fit.dof == 5
    assert fit.reduced_chi_squared == pytest.approx(misfit[0] / 5)
    half = 1.959964 * fit.toughness_std
    expected = pytest.approx([fit.toughness - half, fit.toughness + half], rel=1e-6)
    assert fit.toughness_interval == expected


def test_a_prior_decides_between_two_minima():
    radius = RADII[[0, 2, 4]]
    force = forces(radius, 1.0, 3000.0, model="bump")
    free = identify(radius, force, MODULUS, model="bump", force_std=0.6)
    other = next(mode for mode in free.profile.modes[1:] if mode.admitted)
    prior = (other.toughness, 0.05 * abs(other.toughness - free.toughness))
    fit = identify(radius, force, MODULUS, model="bump", force_std=0.6, toughness_prior=prior)
    assert fit.toughness == pytest.approx(other.toughness, abs=3 * prior[1])


# Limits


def test_forces_in_proportion_to_the_radius_set_no_lower_limit():
    fit = identify(RADII, 31e3 * RADII, MODULUS, force_std=0.3, toughness_max=5.0)
    assert fit.toughness == 0.0
    assert fit.toughness_interval[0] == 0.0
    assert any("no lower limit to the toughness" in sentence for sentence in fit.undecided)
    assert any("toughness is 0, its limit" in sentence for sentence in fit.warnings)


def test_forces_that_do_not_grow_leave_wear_open():
    fit = identify(RADII, [3.0, 3.1, 2.9, 3.05, 3.0], MODULUS, model="bump", force_std=0.2)
    assert fit.wear_strength_interval[0] == 0.0
    assert any("whether the solid wears at all" in sentence for sentence in fit.undecided)
    falling = identify(RADII, [9.0, 7.0, 6.0, 5.0, 4.0], MODULUS, model="elements", force_std=0.2)
    assert falling.wear_strength == 0.0
    assert any("wear strength is 0, its limit" in sentence for sentence in falling.warnings)
    assert any("chi^2/dof" in sentence for sentence in falling.warnings)


class Guarded:
    """Fails where a model is asked for a g outside its range."""

    def __init__(self, model):
        self.model = model

    def __call__(self, g, alpha):
        assert np.all((g >= 0.5 * (1 - 1e-15)) & (g <= 30.0 * (1 + 1e-15)))
        return self.model(g, alpha)


def limited(elements_like):
    limits = Quantity("g", "", "choose another model", 0.5, 30.0, error=DomainError)

    class Limited(elements_like):
        def arc(self, g, alpha):
            return Guarded(super().arc)(g, alpha)

    return Limited(name="limited", g=limits)


def test_the_search_ends_where_the_model_does(register, elements_like):
    register(limited(elements_like))
    fit = identify(RADII, SOUND, MODULUS, model="limited", force_std=2.0)
    first, last = 0.5 * MODULUS * RADII.max(), 30.0 * MODULUS * RADII.min()
    assert fit.profile.searched == pytest.approx((first, last))
    assert fit.profile.ends == ("model", "model")
    assert fit.profile.toughness_intervals[0] == pytest.approx((first, last))
    assert fit.toughness_interval == (0.0, np.inf)
    assert fit.toughness_limited_by == ("model", "model")
    assert any("may be smaller than" in sentence for sentence in fit.undecided)
    assert any("may be larger than" in sentence for sentence in fit.undecided)
    wire = fit.further_wire
    assert first / (MODULUS * wire.wire_radius) >= 0.5
    assert last / (MODULUS * wire.wire_radius) <= 30.0
    with pytest.raises(DomainError, match=r"wire_radius must be .* from g = 0\.5 to 30"):
        fit.predict(1e-6)


def test_an_estimate_at_the_models_end_is_told(register, elements_like):
    register(limited(elements_like))
    force = forces(RADII, 4.0, 7750.0)
    fit = identify(RADII, force, MODULUS, model="limited", force_std=0.1)
    assert fit.toughness == pytest.approx(30.0 * MODULUS * RADII.min())
    assert any("end of what model 'limited' covers" in sentence for sentence in fit.warnings)


def test_wires_or_bounds_that_the_model_cannot_cover_are_refused(register, elements_like):
    register(limited(elements_like))
    with pytest.raises(DomainError, match=r"wires of 0\.001 to 1 mm differ more than that"):
        identify([1e-6, 1e-3], [2.0, 9.0], MODULUS, model="limited")
    with pytest.raises(InputError, match=r"the model begins at 0\.161 J/m2"):
        identify(RADII, SOUND, MODULUS, model="limited", toughness_max=0.1)


def test_two_forces_leave_no_interval():
    fit = identify(RADII[[0, 4]], SOUND[[0, 4]], MODULUS, model="elements")
    assert np.isnan([*fit.toughness_interval, *fit.wear_strength_interval]).all()
    assert np.isnan(fit.band(RADII)).all()
    assert fit.further_wire is None
    assert fit.undecided == ()
    assert sum("no measure of scatter" in sentence for sentence in fit.warnings) == 1


def test_the_range_of_further_wires_can_be_given():
    options = {"model": "elements", "force_std": 0.4}
    by_default = identify(RADII, SOUND, MODULUS, **options).further_wire
    assert by_default.searched == pytest.approx((RADII.min() / 5, 1e-3))
    own = identify(RADII, SOUND, MODULUS, further_radii=(2e-4, 3e-4), **options).further_wire
    assert own.searched == (2e-4, 3e-4)
    assert 2e-4 <= own.wire_radius <= 3e-4
    assert own.separation < by_default.separation
    assert own.cuts == max(1.0, np.ceil(4.0 / own.separation**2))


# Words


def test_warnings_of_a_curve_do_not_speak_of_equation_11():
    fit = identify(RADII, SOUND, MODULUS, model="elements", force_std=0.2)
    assert fit.warnings == ()
    off = SOUND + np.array([0.0, 0.0, 2.0, 0.0, 0.0])
    words = " ".join(identify(RADII, off, MODULUS, model="elements", force_std=0.2).warnings)
    assert "off the curve" in words
    assert "line" not in words


def test_a_linear_fit_has_nothing_undecided():
    fit = identify(RADII, SOUND, MODULUS)
    assert fit.undecided == ()
    assert fit.further_wire is None


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"model": "eq9"}, "has no wear"),
        ({"model": "high-toughness", "toughness_max": 5.0}, "has no wear"),
        ({"toughness_max": 0.0}, "toughness_max must be"),
        ({"toughness_max": -1.0}, "toughness_max must be"),
        ({"toughness_max": np.nan}, "toughness_max must be"),
        ({"toughness_max": [1.0, 2.0]}, "must be one number"),
        ({"wear_strength": -1.0}, "wear_strength must be"),
        ({"wear_strength": np.inf}, "wear_strength must be"),
        ({"toughness_prior": (2.0, 0.1)}, "needs force_std"),
        ({"toughness_prior": 2.0, "force_std": 0.2}, "must be a pair"),
        ({"toughness_prior": (2.0, 0.0), "force_std": 0.2}, "standard deviation of toughness_p"),
        ({"wear_strength_prior": (-2.0, 1.0), "force_std": 0.2}, "mean of wear_strength_prior"),
        (
            {"wear_strength": 1e3, "wear_strength_prior": (1e3, 1e2), "force_std": 0.2},
            "must not both be given",
        ),
        ({"model": "elements", "further_radii": 1e-4}, "further_radii must be a pair"),
        ({"model": "elements", "further_radii": (2e-4, 1e-4)}, "smaller one"),
        ({"model": "elements", "further_radii": (0.0, 1e-4)}, "wire_radius must be"),
        ({"model": "elements", "stiffening_exponent": 0.0}, "stiffening_exponent must be"),
        ({"model": "eq9", "stiffening_exponent": 9.5, "wear_strength": 0.0}, "Table 1"),
    ],
)
def test_bad_input_is_refused_in_words(options, words):
    with pytest.raises(InputError, match=words):
        identify(RADII, SOUND, MODULUS, **options)


def test_terms_that_are_not_there_are_not_evaluated(register, elements_like):
    class Counting(elements_like):
        def normal_load(self, g, alpha):
            raise AssertionError("no friction, no B")

        def arc(self, g, alpha):
            raise AssertionError("no wear, no A")

    register(Counting(name="counting"))
    with pytest.raises(AssertionError, match="no A"):
        identify(RADII, SOUND, MODULUS, model="counting")
    fit = identify(RADII, SOUND, MODULUS, model="eq9", wear_strength=0.0)
    assert fit.toughness == pytest.approx(SOUND.mean())


@settings(max_examples=25, deadline=None)
@given(
    exponents=st.tuples(*[st.floats(-30, 29.9)] * 3),
    std_exponent=st.none() | st.floats(-30, 30),
    friction=st.sampled_from([0.0, 1e-30, 1.0, 1e30]),
    bound_exponent=st.floats(-30, 30),
)
def test_every_size_of_number_gives_numbers(exponents, std_exponent, friction, bound_exponent):
    radius_size, force_size, modulus = (10.0**e for e in exponents)
    fit = identify(
        radius_size * np.array([1.0, 1.3, 1.9, 2.0]) / 2.0 + 1e-30,
        force_size * np.array([1.0, 1.5, 1.8, 2.2]) / 2.0 + 1e-30,
        modulus,
        friction_coefficient=friction,
        force_std=None if std_exponent is None else 10.0**std_exponent,
        toughness_max=10.0**bound_exponent,
    )
    assert 0.0 <= fit.toughness <= 10.0**bound_exponent
    assert 0.0 <= fit.wear_strength < np.inf
    low, high = fit.toughness_interval
    assert low <= fit.toughness <= high
    assert isinstance((*fit.warnings, *fit.undecided), tuple)


def test_every_closed_form_with_wear_is_linear():
    linear = {
        name
        for name, model in FORCE_MODELS.items()
        if isinstance(model, ClosedForm) and model.arc_2 > 0.0
    }
    assert linear == {"eq13", "low-toughness", "friction-free"}
    assert DIMENSIONLESS_TOUGHNESS.lower == 0.0

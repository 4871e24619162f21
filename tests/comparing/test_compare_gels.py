"""Whether two gels differ: what straight lines give exactly, and what curves and limits keep."""

import math

import numpy as np
import pytest
from made_up_gels import pair
from scipy import stats

from surrogate import InputError, Scene, compare_gels, cutting_force, identify
from surrogate.comparing import difference
from surrogate.comparing.difference import alike, difference_of
from surrogate.comparing.evidence import evidence_of
from surrogate.comparing.gels import _holm
from surrogate.comparing.shared_error import covariance_between

MU = 30e3
RADII = np.array([5e-5, 1e-4, 2e-4, 3e-4, 4e-4])
QUANTITIES = ("toughness", "wear_strength")


def gel(seed, gamma=2.0, tau=12e3, model="eq13", std=None, mu=MU, **options):
    scene = Scene(mu, gamma, RADII, wear_strength=tau)
    force = np.asarray(cutting_force(scene, model, law="projected").total)
    noise = 0.03 * force.mean() if std is None else std
    force = force + noise * np.random.default_rng(seed).standard_normal(force.size)
    return identify(RADII, force, mu, model=model, force_std=std, **options)


def both(one, other, quantity):
    return difference_of(evidence_of(one), evidence_of(other), quantity, 0.95)


@pytest.mark.parametrize("quantity", QUANTITIES)
@pytest.mark.parametrize("other", [{"std": 0.3}, {}], ids=["stated", "estimated"])
def test_straight_lines_give_welchs_t(quantity, other):
    one, two = gel(1), gel(2, gamma=2.6, **other)
    variances = [getattr(fit, f"{quantity}_std") ** 2 for fit in (one, two)]
    dofs = [3.0, math.inf if other else 3.0]
    spent = sum((v / sum(variances)) ** 2 / dof for v, dof in zip(variances, dofs, strict=True))
    apart = getattr(one, quantity) - getattr(two, quantity)
    expected = stats.t(1.0 / spent)
    made = both(one, two, quantity)
    assert made.value == apart
    assert made.dof == pytest.approx(1.0 / spent, rel=1e-6)
    assert made.p == pytest.approx(2.0 * expected.sf(abs(apart) / math.sqrt(sum(variances))))
    half = expected.ppf(0.975) * math.sqrt(sum(variances))
    # ends are taken from 801 values of each gel
    assert made.interval == pytest.approx((apart - half, apart + half), abs=half / 200)


def test_both_quantities_together_are_hotellings_form_where_errors_are_stated():
    one, two = gel(1, std=0.2), gel(2, gamma=2.3, std=0.3)
    apart = np.array([getattr(one, name) - getattr(two, name) for name in QUANTITIES])
    squared = apart @ np.linalg.solve(one.covariance + two.covariance, apart)
    assert alike(evidence_of(one), evidence_of(two)) == pytest.approx(math.exp(-0.5 * squared))


@pytest.mark.parametrize("quantity", QUANTITIES)
def test_a_followed_misfit_far_from_limits_says_what_the_line_says(quantity):
    known = {"std": 0.1, "toughness_max": 50.0}
    followed = both(gel(1, **known), gel(2, gamma=2.3, **known), quantity)
    line = both(gel(1, std=0.1), gel(2, gamma=2.3, std=0.1), quantity)
    assert followed.p == pytest.approx(line.p, rel=1e-3)
    assert followed.value == pytest.approx(line.value, rel=1e-6)
    width = line.interval[1] - line.interval[0]
    assert followed.interval == pytest.approx(line.interval, abs=width / 100)


def test_exchanging_two_gels_changes_signs_alone():
    one, two = (gel(seed, gamma, model="table") for seed, gamma in ((1, 2.0), (2, 2.5)))
    forth, back = compare_gels({"a": one, "b": two}), compare_gels({"b": two, "a": one})
    for name in QUANTITIES:
        first, second = (getattr(made.pairs[0], name) for made in (forth, back))
        assert second.value == -first.value
        assert second.p == pytest.approx(first.p, rel=1e-9)
        assert second.interval == pytest.approx((-first.interval[1], -first.interval[0]))
    assert forth.pairs[0].p == pytest.approx(back.pairs[0].p, rel=1e-9)


def test_a_gel_does_not_differ_from_itself():
    fit = gel(1, model="table")
    (one,) = compare_gels({"a": fit, "b": fit}).pairs
    assert one.p > 0.999
    assert not one.differs(0.05)
    for name in QUANTITIES:
        of = getattr(one, name)
        assert of.value == 0.0
        assert of.p > 0.999
        assert of.interval[0] < 0.0 < of.interval[1]


def test_a_limit_makes_an_interval_one_sided_and_not_a_difference():
    """Wires in the cleavage regime leave tau_w without an upper end, or hold it at 0."""
    scene = Scene(1e3, 50.0, RADII, wear_strength=1.0)
    force = np.asarray(cutting_force(scene, "table", extrapolate=True, law="projected").total)
    thin = identify(RADII, force, 1e3, model="table", force_std=0.05 * force)
    assert thin.wear_strength_interval[0] == 0.0
    made = both(thin, thin, "wear_strength")
    assert made.p > 0.99
    assert made.interval[0] < 0.0 < made.interval[1]


def test_the_models_error_cancels_as_far_as_it_is_shared(monkeypatch):
    same = [gel(seed, model="table", std=0.01) for seed in (1, 2)]
    alone = sum(fit.model_error[0] ** 2 for fit in same)
    assert covariance_between(*same)[0, 0] == pytest.approx(0.5 * alone, rel=0.05)
    softer = gel(3, gamma=0.2, tau=1.2e3, model="table", mu=3e3, std=0.001)  # the same g
    assert covariance_between(same[0], softer)[0, 0] > 0.0
    other = gel(2, model="table", std=0.01, stiffening_exponent=3.0)
    assert not covariance_between(same[0], other).any()
    assert not covariance_between(gel(1), gel(2)).any()  # of Eq. (13) nobody states an error
    shared = [both(*same, name) for name in QUANTITIES]
    monkeypatch.setattr(difference, "covariance_between", lambda *_: np.zeros((2, 2)))
    for one, name in zip(shared, QUANTITIES, strict=True):
        alone = both(*same, name)
        assert one.p < alone.p
        assert np.diff(one.interval) < 0.9 * np.diff(alone.interval)


def test_equal_gels_are_rarely_called_different():
    """Nor too rarely: within what 300 pairs at 5 % leave to chance, 0.1 % on both sides."""
    random, ps = np.random.default_rng(0), []
    for _ in range(300):
        fits = [gel(int(random.integers(1 << 30)), std=random.choice([None, 0.2])) for _ in "ab"]
        (one,) = compare_gels(dict(zip("ab", fits, strict=True))).pairs
        if not one.objections:  # one fit of a hundred is said not to hold
            ps.append([one.p, one.toughness.p, one.wear_strength.p])
    most = stats.binom(len(ps), 0.05).ppf(0.9995) / len(ps)
    least = stats.binom(len(ps), 0.05).ppf(0.0005) / len(ps)
    assert len(ps) > 280
    shares = np.mean(np.array(ps) < 0.05, axis=0)
    assert np.all(shares <= most), shares
    assert np.all(shares >= least), shares


def test_a_difference_is_seen_as_often_as_its_size_promises():
    """Three standard errors of known forces: found by 85 % of two-sided tests at 5 %."""
    std = 0.2
    stds = [gel(seed, std=std).toughness_std for seed in (0, 1)]
    apart = 3.0 * math.hypot(*stds)
    seen = []
    for seed in range(200):
        fits = gel(2 * seed, std=std), gel(2 * seed + 1, 2.0 + apart, std=std)
        (one,) = compare_gels(dict(zip("ab", fits, strict=True))).pairs
        if not one.objections:
            seen.append(one.toughness.p < 0.05)
    power = stats.norm.sf(1.96 - 3.0)
    spread = math.sqrt(power * (1.0 - power) / len(seen))
    assert abs(np.mean(seen) - power) < 3.5 * spread


def test_fitted_models_with_shared_errors_and_all_that_is_stated_alarm_rarely():
    """Of 30 pairs at 1 %, more than 3 alarms have a probability of 0.0002."""
    alarms = 0
    for seed in range(30):
        fits = [identify(**stated) for stated in pair(np.random.default_rng(seed)).stated]
        made = compare_gels(dict(zip("ab", fits, strict=True)))
        alarms += made.pairs[0].p < 0.01
    assert alarms <= 3


def test_several_pairs_are_taken_into_account():
    assert _holm([0.01, 0.04, 0.03]) == pytest.approx([0.03, 0.06, 0.06])
    assert _holm([]) == []
    made = compare_gels({"a": gel(1), "b": gel(2), "c": gel(3, gamma=6.0)})
    assert [(one.first, one.second) for one in made.pairs] == [("a", "b"), ("a", "c"), ("b", "c")]
    for one in made.pairs:
        assert one.p <= one.p_adjusted <= 1.0
        assert one.toughness.p <= one.toughness.p_adjusted
    assert "Holm's correction for 3 pairs" in made.summary()
    assert made.summary() == str(made)
    assert "a and c differ" in made._repr_html_()


def test_no_quantity_differs_where_the_gels_do_not():
    for seed in range(40):
        (one,) = compare_gels({"a": gel(seed), "b": gel(seed + 100)}).pairs
        for name in QUANTITIES:
            assert one.differs(0.05) or not one.differs(0.05, name)


def test_what_should_not_be_used_is_not_compared():
    falling = identify(RADII, np.linspace(9.0, 2.0, 5), MU, model="eq13")
    made = compare_gels({"a": gel(1), "b": falling, "c": gel(2)})
    first, usable, last = made.pairs
    for one in (first, last):
        assert one.toughness is one.wear_strength is None
        assert math.isnan(one.p)
        assert not one.differs(0.05)
        assert "are not compared: b should not be used (" in one.words(0.95)
    assert not made.is_usable
    assert usable.toughness is not None
    two = identify(RADII[:2], [3.0, 4.0], MU, model="eq13")
    (bare,) = compare_gels({"a": gel(1), "two": two}).pairs
    assert bare.objections[0].startswith("nothing tells the scatter of two")


def test_a_wear_strength_that_was_given_is_not_compared():
    (one,) = compare_gels({"a": gel(1, wear_strength=12e3), "b": gel(2)}).pairs
    assert one.wear_strength is None
    assert one.p == one.toughness.p


@pytest.mark.parametrize(
    ("gels", "words"),
    [
        ({}, "gels must be two or more, but are 0"),
        ({"a": gel(1)}, "gels must be two or more, but are 1"),
        ({"a": gel(1), "b": 3.0}, "must be names with what identify returned"),
        ({"a": gel(1), 2: gel(2)}, "must be names with what identify returned"),
        ({"a": gel(1), "b": gel(1, model="table")}, "under one model, but a is by 'eq13'"),
        ([1, 2], "identifications must be a mapping"),
    ],
)
def test_what_cannot_be_compared_is_refused(gels, words):
    with pytest.raises(InputError, match=words):
        compare_gels(gels)


def test_laws_are_not_mixed():
    gels = {law: gel(1, model="table", law=law) for law in ("projected", "slip")}
    with pytest.raises(InputError, match="under one law"):
        compare_gels(gels)


@pytest.mark.parametrize("confidence", [0.0, 1.0, math.nan, "much"])
def test_a_confidence_is_a_probability(confidence):
    with pytest.raises(InputError):
        compare_gels({"a": gel(1), "b": gel(2)}, confidence)


def test_gels_far_apart_differ_whatever_their_heights_are_where_the_toughness_vanishes():
    """There one of them is so high that no parabola runs through it and its neighbours."""
    radii = np.array([0.35e-3, 0.5e-3, 0.7e-3, 1.05e-3])
    soft = identify(radii, [13.4, 18.1, 25.2, 36.9], 685.0, force_std=0.5)
    tough = identify(radii, [169.0, 172.0, 176.0, 180.5], 685.0, force_std=2.0)
    (found,) = compare_gels({"tough": tough, "soft": soft}).pairs
    assert found.toughness.p < 1e-6
    assert found.p < 1e-6
    assert "differ" in found.words(0.95)

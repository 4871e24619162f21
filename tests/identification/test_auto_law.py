"""Which law "auto" is in an identification, what is said of it, and what its intervals contain."""

from dataclasses import replace

import numpy as np
import pytest

from surrogate import AccuracyError, DomainError, InputError, Scene, cutting_force, identify
from surrogate.choosing.by_name import force_model
from surrogate.choosing.laws import of_law
from surrogate.coupling.frozen import frozen
from surrogate.coupling.shipped import AMPLIFICATION_FILE, amplification
from surrogate.identification.summary import law_in_words
from surrogate.inference.continuation import contact_error
from surrogate.inference.coupled_fit import coupled_fit

MU, ALPHA = 5e3, 4.0
RADII = np.geomspace(0.1e-3, 0.6e-3, 6)
TRUTH = 1.0


def load_at(share, alpha=ALPHA):
    """Return xi and tau_w whose load is a share of what is known at the wire that allows least."""
    kappa = amplification()
    shares = kappa.share(TRUTH / (MU * RADII), alpha, 0.05, 0.2)
    factor = share / float(np.max(shares))
    return 0.05 * factor, 0.2 * MU * factor


def cuts(share, alpha=ALPHA, model="table"):
    xi, tau = load_at(share, alpha)
    scene = Scene(MU, TRUTH, RADII, xi, tau, alpha)
    force = cutting_force(scene, model, law="coupled", extrapolate=True).total
    return force, {"friction_coefficient": xi, "stiffening_exponent": alpha}, tau


def test_auto_is_coupled_where_its_solutions_reach_to_every_cut(coupled):
    force, gel, tau = cuts(0.5)
    fit = identify(RADII, force, MU, force_std=0.01 * force, **gel)
    assert fit.law == "coupled"
    assert fit.law_error == 0.0
    assert "all 6 cuts" in fit.law_reason
    assert fit.toughness == pytest.approx(TRUTH, rel=1e-5)
    assert fit.wear_strength == pytest.approx(tau, rel=1e-5)
    assert "law coupled" in fit.summary()
    named = identify(RADII, force, MU, force_std=0.01 * force, law="coupled", **gel)
    assert named.toughness_interval == fit.toughness_interval
    assert named.wear_strength_interval == fit.wear_strength_interval


def test_auto_is_projected_where_one_cut_is_beyond_them_and_says_so(coupled):
    force, gel, _ = cuts(3.0)
    fit = identify(RADII, force, MU, force_std=0.01 * force, **gel)
    assert fit.law == "projected"
    assert np.isnan(fit.law_error)
    assert "do not reach to" in fit.law_reason
    assert "effective strength" in law_in_words(fit)
    named = identify(RADII, force, MU, force_std=0.01 * force, law="projected", **gel)
    assert named.toughness == fit.toughness
    with pytest.raises(DomainError, match="do not reach to"):
        identify(RADII, force, MU, force_std=0.01 * force, law="coupled", **gel)


def test_an_exponent_without_coupled_solutions_is_named(coupled, monkeypatch):
    force, gel, _ = cuts(0.5)
    monkeypatch.setattr(type(coupled), "exponents", (2.5, 3.5))
    fit = identify(RADII, force, MU, **gel)
    assert fit.law == "projected"
    assert "alpha from 2.5 to 3.5, but alpha = 4" in fit.law_reason


def test_closed_forms_and_models_of_another_law_keep_theirs(coupled):
    force, gel, _ = cuts(0.5)
    fit = identify(RADII, force, MU, model="eq13", **gel)
    assert (fit.law, fit.law_reason) == ("projected", "model 'eq13' has no other")
    slip = identify(RADII, force, MU, model=of_law("table", "slip"), **gel)
    assert (slip.law, slip.law_reason) == ("slip", "it is that of the model")


def test_models_without_coupled_solutions_are_projected(fitted_file, tmp_path, monkeypatch):
    from surrogate import load_models

    for file in fitted_file.parent.iterdir():
        if not file.name.startswith(AMPLIFICATION_FILE):
            (tmp_path / file.name).write_bytes(file.read_bytes())
    load_models(tmp_path)
    try:
        fit = identify(RADII, 1.0 + 3e3 * RADII, MU, stiffening_exponent=ALPHA)
    finally:
        load_models()
    assert fit.law == "projected"
    assert "do not know the law 'coupled'" in fit.law_reason


def test_without_friction_and_wear_every_law_is_the_same(coupled):
    force = np.full(RADII.size, TRUTH)
    fit = identify(RADII, force, MU, wear_strength=0.0, stiffening_exponent=ALPHA, force_std=0.1)
    assert fit.law_error == 0.0
    assert "all laws are the same" in law_in_words(fit)


def test_an_accuracy_that_nobody_knows_to_be_met_is_refused(coupled):
    force, gel, _ = cuts(3.0)
    with pytest.raises(AccuracyError, match="law='projected'"):
        identify(RADII, force, MU, rtol=0.5, **gel)
    force, gel, _ = cuts(0.5)
    with pytest.raises(AccuracyError, match="under the law 'coupled'"):
        identify(RADII, force, MU, rtol=1e-6, **gel)
    assert identify(RADII, force, MU, rtol=0.9, **gel).law == "coupled"
    with pytest.raises(InputError, match="projected, slip, coupled, auto"):
        identify(RADII, force, MU, law="best", **gel)


def test_the_error_of_kappa_is_part_of_the_intervals_and_common_to_wear_and_friction(coupled):
    force, gel, _ = cuts(0.5)
    options = {"force_std": 0.01 * force, **gel}
    fit = identify(RADII, force, MU, **options)
    error = contact_error(fit.tangent, fit.dimensionless_toughness, ALPHA)
    bound = np.expm1(amplification().near_error(fit.dimensionless_toughness, ALPHA))
    np.testing.assert_allclose(error.factor, bound / np.sqrt(3.0))
    assert not error.factor_drift.any()
    without = frozen(fit.model, 0.0, 0.0).own_error(fit.dimensionless_toughness, ALPHA)
    assert not np.any(without[0])
    assert not np.any(without[1])
    ten_times = type(coupled).near_error
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(type(coupled), "near_error", lambda self, g, a: 10.0 * ten_times(self, g, a))
        wider = identify(RADII, force, MU, **options)
    assert wider.model_error[0] > fit.model_error[0]
    assert wider.model_error[1] > 2.0 * fit.model_error[1]


def test_the_error_of_kappa_grows_beyond_what_is_known_and_never_jumps(coupled):
    kappa = amplification()
    g = np.geomspace(1e-6, 10.0, 400)
    loads = np.linspace(0.0, 3.0, 61)[:, np.newaxis]
    drift = kappa.drift(g, ALPHA, 0.05 * loads, 0.2 * loads)
    assert np.all(drift >= 0.0)
    assert np.all(np.diff(drift, axis=0) >= -1e-12)
    inside = kappa.share(g, ALPHA, 0.05 * loads, 0.2 * loads) <= 1.0
    assert not drift[inside].any()
    assert drift[~inside & (loads > 0.0)].min() > 0.0
    assert np.isinf(kappa.drift(1.0, 20.0, 0.05, 0.2))


def test_the_tangent_has_the_value_and_the_slopes_of_the_law(coupled):
    model = of_law("table", "coupled")
    xi, tau = load_at(0.5)
    g, step = TRUTH / (MU * RADII), 1e-5
    at = frozen(model, xi, tau / MU)

    def drag(xi, relative):
        return sum(model.terms_at(g, 1.0, g, 1.0, xi, relative, ALPHA)) / 2.0

    arc, load = at.linearised(g, ALPHA)
    np.testing.assert_allclose(arc * tau / MU + load, drag(xi, tau / MU), rtol=1e-12)
    by_wear = (drag(xi, tau / MU + step) - drag(xi, tau / MU - step)) / (2.0 * step)
    np.testing.assert_allclose(arc, by_wear, rtol=1e-7)
    by_friction = (drag(xi + step, tau / MU) - drag(xi - step, tau / MU)) / (2.0 * step)
    np.testing.assert_allclose(at.friction_slope(g, ALPHA), by_friction, rtol=1e-7)


def test_a_search_that_does_not_settle_is_no_fit(coupled):
    force, gel, _ = cuts(0.5)
    fit = identify(RADII, force, MU, force_std=0.01 * force, **gel)
    wear = iter(np.resize([100.0, 200.0], 1000))
    with pytest.raises(DomainError, match="no fit to these forces"):
        coupled_fit(fit.model, fit.cuts, lambda at: (1.0, next(wear)), lambda at: {})


def test_another_friction_is_under_the_same_law_or_not_told(coupled):
    force, gel, _ = cuts(0.5)
    fit = identify(RADII, force, MU, force_std=0.01 * force, **gel)
    other = fit.with_friction(0.5 * fit.friction_coefficient)
    again = identify(
        RADII,
        force,
        MU,
        force_std=0.01 * force,
        law="coupled",
        **gel | {"friction_coefficient": 0.5 * fit.friction_coefficient},
    )
    assert other.toughness == pytest.approx(again.toughness, rel=1e-3)
    assert other.wear_strength == pytest.approx(again.wear_strength, rel=1e-3)
    with pytest.raises(DomainError, match="less friction"):
        fit.with_friction(0.5)


def test_slip_says_what_it_lacks_beside_coupled_solutions(coupled):
    force, gel, tau = cuts(0.5)
    fit = identify(RADII, force, MU, force_std=0.01 * force, law="slip", **gel)
    at = replace(fit.scene(RADII), law=None)
    both = [cutting_force(at, "table", law=law).total for law in ("slip", "coupled")]
    assert 0.0 < np.max(np.abs(both[0] / both[1] - 1.0)) <= fit.law_error
    assert "up to" in law_in_words(fit)
    assert fit.wear_strength > tau  # kappa is above 1 here
    assert force_model("table").law == "projected"

"""The choice among models of one law: what is evaluated, what is promised, what is refused."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from made_up import truth

import surrogate
from surrogate import AccuracyError, DomainError, InputError, Scene, contact_functions
from surrogate.choosing.auto import AutomaticTerms
from surrogate.choosing.candidates import candidates
from surrogate.contact.fitted import FittedModel

pytestmark = pytest.mark.usefixtures("installed")

RADIUS = 1e-4

cutting_force = partial(surrogate.cutting_force, law="projected")
dissipative_force = partial(surrogate.dissipative_force, law="projected")


def scene(g, alpha, xi, ratio):
    """Return a scene of these numbers, with tau_w/mu = ratio xi or, for xi = 0, ratio."""
    wear = 685.0 * ratio * np.where(np.equal(xi, 0.0), 1.0, xi)
    return Scene(685.0, 685.0 * RADIUS * np.asarray(g), RADIUS, xi, wear, alpha)


def true_force(cut):
    arc, load, _ = truth(cut.dimensionless_toughness, cut.stiffening_exponent)
    return cut.toughness + 2.0 * RADIUS * (
        cut.wear_strength * arc + cut.friction_coefficient * 685.0 * load
    )


@pytest.fixture
def counted(monkeypatch):
    """Count the points at which each function of each model is evaluated."""
    counts = {}
    for kind in FittedModel.__subclasses__():

        def counting(self, names, log_g, log_alpha, g, of=kind.inside):
            for name in names:
                key = self.name, name
                counts[key] = counts.get(key, 0) + np.size(log_g)
            return of(self, names, log_g, log_alpha, g)

        monkeypatch.setattr(kind, "inside", counting)
    return counts


def test_without_friction_no_load_is_evaluated(counted):
    cutting_force(scene(1.0, 3.0, 0.0, 2.0), "auto", rtol=0.02)
    assert {name for _, name in counted} == {"arc"}


def test_without_wear_no_arc_is_evaluated(counted):
    cutting_force(scene(1.0, 3.0, 0.5, 0.0), "auto", rtol=0.02)
    assert {name for _, name in counted} == {"normal_load"}


def test_with_neither_nothing_is_evaluated_anywhere(counted):
    force = cutting_force(scene([1e-9, 1.0, 1e9], 30.0, 0.0, 0.0), "auto", rtol=1e-12)
    assert not counted
    np.testing.assert_array_equal(force.total, force.cleavage)
    assert force.relative_error.tolist() == [0.0, 0.0, 0.0]
    assert force.model == "eq13"


def test_a_term_below_the_tolerance_is_not_evaluated(counted):
    """Friction of about 1e-4 of the force at rtol = 2 %, with its own bound far below that."""
    force = cutting_force(scene(1.0, 3.0, 1e-4, 1e4), "auto", rtol=0.02)
    assert {name for _, name in counted} == {"arc"}
    assert force.friction == cutting_force(scene(1.0, 3.0, 1e-4, 1e4), "eq13").friction
    assert force.fit_error <= 0.02


def test_where_the_closed_form_will_do_nothing_is_evaluated(counted):
    force = cutting_force(scene(50.0, 3.0, 0.0, 0.05), "auto", rtol=0.05)
    assert not counted
    assert (force.model, force.chosen) == ("eq13", "eq13")


@pytest.mark.parametrize("model", ["power-law", "table", "gp"])
def test_named_models_evaluate_what_the_scene_has(counted, model):
    cutting_force(scene([1.0, 2.0], 3.0, 0.0, 2.0), model)
    assert counted == {(model, "arc"): 2}
    cutting_force(scene([1.0, 2.0], 3.0, 0.1, 0.0), model)
    assert counted == {(model, "arc"): 2, (model, "normal_load"): 2}


def test_each_point_is_evaluated_by_one_model_only(counted):
    g = np.geomspace(6e-3, 50.0, 40)
    force = cutting_force(scene(g, 3.0, 0.3, 1.0), "auto", rtol=0.05)
    assert force.model == "auto"
    assert len(set(force.chosen.tolist())) > 1
    for model in set(force.chosen.tolist()) - {"eq13"}:
        points = np.count_nonzero(force.chosen == model)
        assert max(n for (name, _), n in counted.items() if name == model) <= points


@pytest.mark.parametrize("rtol", [0.3, 0.05, 0.02])
def test_the_promise_is_kept(rtol):
    random = np.random.default_rng(1)
    g, alpha = np.exp(random.uniform(np.log(5e-3), np.log(60.0), 400)), random.uniform(2, 9, 400)
    for xi in (0.0, 0.01, 0.5):
        for ratio in (0.0, 0.1, 1.0, 100.0):
            cut = scene(g, alpha, xi, ratio)
            force = cutting_force(cut, "auto", rtol=rtol)
            assert np.all(force.fit_error <= rtol)
            assert np.all(np.abs(force.total / true_force(cut) - 1.0) <= force.fit_error)


def test_more_is_asked_of_costlier_models():
    order = ["eq13", "power-law", "table", "gp"]
    cut = scene(1.0, 3.0, 0.3, 3.0)
    chosen = [cutting_force(cut, "auto", rtol=r).model for r in (1.0, 0.2, 0.02)]
    assert chosen == sorted(chosen, key=order.index)
    assert len(set(chosen)) == 3


def test_an_accuracy_that_none_has_is_an_error_that_names_the_best():
    message = (
        r"rtol = 1e-06 is not at g = 1, alpha = 3 \(1 of 1 points\), .*the best is 'gp'.*rtol="
    )
    with pytest.raises(AccuracyError, match=message) as caught:
        cutting_force(scene(1.0, 3.0, 0.1, 1.0), "auto", rtol=1e-6)
    offered = float(str(caught.value).partition("give rtol=")[2].partition(" ")[0])
    assert cutting_force(scene(1.0, 3.0, 0.1, 1.0), "auto", rtol=offered).model in (
        "table",
        "gp",
    )


@pytest.mark.parametrize("rtol", [0.0, -1.0, np.nan, np.inf, "small", [0.1, 0.2]])
def test_what_is_no_tolerance_is_refused(rtol):
    with pytest.raises(InputError, match="rtol must be"):
        cutting_force(scene(1.0, 3.0, 0.1, 1.0), "auto", rtol=rtol)


def test_outside_the_domain():
    with pytest.raises(DomainError, match="g = Gamma_o"):
        cutting_force(scene(1e-3, 3.0, 0.1, 1.0), "auto")
    force = cutting_force(scene([1e-3, 1.0], 3.0, 0.1, 1.0), "auto", extrapolate=True)
    assert force.in_domain.tolist() == [False, True]
    assert np.isnan(force.fit_error[0])
    expected = cutting_force(scene(1e-3, 3.0, 0.1, 1.0), "table", extrapolate=True).total
    assert force.total[0] == expected


def test_numbers_and_arrays_agree():
    g = np.geomspace(6e-3, 50.0, 12)
    together = cutting_force(scene(g, 3.0, 0.3, 1.0), "auto", rtol=0.1)
    for i, each in enumerate(g):
        alone = cutting_force(scene(float(each), 3.0, 0.3, 1.0), "auto", rtol=0.1)
        assert type(alone.total) is float
        assert (alone.total, alone.chosen) == (together.total[i], together.chosen[i])
        assert alone.fit_error == together.fit_error[i]


def test_dissipative_forces_are_within_the_tolerance_of_themselves():
    g = np.geomspace(6e-3, 50.0, 50)
    arc, load, _ = truth(g, 3.0)
    expected = 2.0 * (0.5 * arc + 0.1 * load)
    found = dissipative_force(g, 3.0, 0.1, 0.5, model="auto", rtol=0.02)
    assert np.max(np.abs(found / expected - 1.0)) <= 0.02


def test_contact_functions_within_a_tolerance():
    g = np.geomspace(6e-3, 50.0, 30)
    contact = contact_functions(g, 3.0, model="auto", rtol=0.02)
    for found, true in zip(
        (contact.arc, contact.normal_load, contact.delta), truth(g, 3.0), strict=True
    ):
        assert np.max(np.abs(found / true - 1.0)) <= 0.02
    alone = contact_functions(1.0, 3.0, model="auto", rtol=0.02)
    assert type(alone.arc) is float
    assert alone.model == alone.chosen == "table"
    with pytest.raises(AccuracyError):
        contact_functions(1.0, 3.0, model="auto", rtol=1e-9)


def test_above_the_highest_g_the_measured_error_of_the_asymptote_holds_as_far_as_it_was_measured(
    installed,
):
    cells = {"arc": [[0.03], [0.05], [None]], "normal_load": [[0.01], [0.02], [None]]}
    told = {"count": 5, "g": [1.0, 3.0, 8.0, 10.0], "alpha": [2.0, 9.0], "errors": {"table": cells}}
    known = candidates(replace(installed, about={**installed.about, "beyond": told}))
    high = installed.limits.highest_g(3.0)
    for factor, error in ((2.0, 0.03), (7.9, 0.05), (8.1, np.nan), (11.0, np.nan)):
        scene = (1.0, factor * high, 1.0, 0.0, 50.0, 3.0)
        friction, wear, inside, _, bound = AutomaticTerms(scene, None, known=known)(*scene)
        assert not inside
        assert friction == 0.0
        expected = 2.0 * error * wear / (factor * high + wear)
        assert bound == pytest.approx(expected, nan_ok=True)
        with np.errstate(all="ignore"):  # under which every kernel is evaluated
            many = AutomaticTerms(scene, None, known=known)(*(np.array([v, v]) for v in scene))
        assert np.array_equal(many[4], [bound, bound], equal_nan=True)
    below = (1.0, 0.5 * installed.limits.g[0], 1.0, 0.0, 50.0, 3.0)
    assert np.isnan(AutomaticTerms(below, None, known=known)(*below)[4])

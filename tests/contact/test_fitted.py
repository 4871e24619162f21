"""The fitted models through the functions that users call: values, seams, refusals, extremes."""

from dataclasses import replace

import numpy as np
import pytest
from made_up import log_touch, truth

import surrogate
from surrogate import (
    AccuracyError,
    DomainError,
    InputError,
    Scene,
    UnknownModelError,
    contact_functions,
    cutting_force,
    dissipative_force,
    energy_release_rate,
)
from surrogate.contact.wedge import wedge_functions, wedge_load

pytestmark = pytest.mark.usefixtures("installed")

MODELS = ("power-law", "table", "gp")
G = np.array([5e-3, 0.03, 0.4, 1.0, 3.0, 14.0, 60.0])
ALPHA = np.array([2.0, 2.3, 8.0, 3.0, 5.5, 9.0, 4.0])
every_model = pytest.mark.parametrize("model", MODELS)
NAMES = ("arc", "normal_load", "delta")


def values(contact):
    return [getattr(contact, name) for name in NAMES]


@every_model
def test_numbers_and_arrays_agree_to_the_last_bit(model):
    together = values(contact_functions(G, ALPHA, model=model))
    for i, (g, alpha) in enumerate(zip(G, ALPHA, strict=True)):
        alone = values(contact_functions(float(g), float(alpha), model=model))
        assert all(type(value) is float for value in alone)
        assert alone == [value[i] for value in together]
    one_alpha = values(contact_functions(G, 3.0, model=model))
    np.testing.assert_array_equal(one_alpha, values(contact_functions(G, [3.0], model=model)))
    shaped = contact_functions(G[:, np.newaxis], ALPHA, model=model)
    assert shaped.delta.shape == (7, 7)
    assert np.diag(shaped.arc) == pytest.approx(together[0], rel=0, abs=0)


@every_model
def test_blocks_change_no_bit(model, monkeypatch):
    at_once = values(contact_functions(G, ALPHA, model=model))
    monkeypatch.setattr("surrogate.contact.fitted.AT_ONCE", 3)
    np.testing.assert_array_equal(values(contact_functions(G, ALPHA, model=model)), at_once)


@pytest.mark.parametrize(("model", "within"), [("table", 5e-3), ("gp", 5e-3)])
def test_models_follow_the_contact_that_they_were_fitted_to(model, within):
    """Within ten times the errors of the points, of A that is 5 in 1000."""
    random = np.random.default_rng(8)
    alpha, g = random.uniform(2.0, 9.0, 500), np.exp(random.uniform(np.log(5e-3), np.log(60), 500))
    for found, true in zip(
        values(contact_functions(g, alpha, model=model)), truth(g, alpha), strict=True
    ):
        assert np.max(np.abs(found / true - 1.0)) < within


def test_the_table_follows_the_process():
    random = np.random.default_rng(9)
    alpha, g = random.uniform(2.0, 9.0, 500), np.exp(random.uniform(np.log(5e-3), np.log(60), 500))
    table, process = (contact_functions(g, alpha, model=model) for model in ("table", "gp"))
    for name in NAMES:
        assert np.max(np.abs(getattr(table, name) / getattr(process, name) - 1.0)) < 1e-4


def test_standard_deviations_are_those_of_the_processes_only():
    contact = contact_functions(G, ALPHA, model="gp")
    assert np.all(contact.arc_std > 0.0)
    assert np.all(contact.normal_load_std > 0.0)
    assert np.all(contact.delta_std[contact.delta > 1.0] > 0.0)
    assert np.all(contact.delta_std[contact.delta == 1.0] == 0.0)
    assert contact_functions(1.0, 2.0, model="gp").arc_std > 0.0
    assert np.isnan(contact_functions(1e-9, 2.0, model="gp", extrapolate=True).arc_std)
    assert contact_functions(G, ALPHA).arc_std is None


def test_what_the_finite_body_does_is_in_the_deviations_of_the_loads(installed):
    bare = replace(installed.models["gp"], truncation=0.0)
    taken_off = replace(bare, truncation=1e-3)
    for name in bare.functions:
        value = bare.contact((name,), G, ALPHA)[0]
        (one,), (other,) = (model.stds((name,), G, ALPHA) for model in (bare, taken_off))
        more = 1e-3 * np.sqrt(G) if name in ("normal_load", "slip_load") else 0.0
        assert other == pytest.approx(np.hypot(one, more * value), rel=1e-12)


@every_model
def test_outside_the_domain_is_an_error_that_names_argument_value_range_and_remedy(model):
    message = r"g must be .*60.* 0.005, but g = 61.0; .*extrapolate=True.*eq13"
    with pytest.raises(DomainError, match=message):
        contact_functions(61.0, 2.0, model=model)
    with pytest.raises(DomainError, match=r"alpha must be .*9.* 2, but alpha\[1\] = 1.9 \(1 of 2"):
        contact_functions(1.0, [2.0, 1.9], model=model)
    scene = Scene(685.0, 1.6, [1e-4, 1.0], 0.1)
    with pytest.raises(DomainError, match=r"g\[1\] = 0.002336 \(from .*wire_radius = 1.0 m, 1 of"):
        cutting_force(scene, model)
    with pytest.raises(DomainError, match=r"stiffening_exponent must be .* = 9.5"):
        cutting_force(Scene(685.0, 1.6, 1e-4, 0.1, 0.0, 9.5), model)
    with pytest.raises(DomainError, match="g = 1e-05"):
        dissipative_force(1e-5, 2.0, 0.1, 1.0, model=model)


@every_model
@pytest.mark.parametrize("alpha", [2.0, 4.0, 9.0])
def test_continuous_across_the_seams(model, alpha):
    """A step of 1e-9 in ln g changes nothing by more than a few 1e-9."""
    for end in (5e-3, 60.0):
        inside, outside = (
            values(contact_functions(end * (1.0 + s * 1e-9), alpha, model=model, extrapolate=True))
            for s in (-1.0, 1.0)
        )
        assert inside == pytest.approx(outside, rel=5e-9)
    edge, beyond = (
        values(contact_functions(G, a, model=model, extrapolate=True)) for a in (9.0, 12.0)
    )
    np.testing.assert_array_equal(edge, beyond)


@every_model
def test_what_is_continued_is_flagged(model):
    contact = contact_functions([1e-9, 1.0, 1e9], [2.0, 3.0, 3.0], model=model, extrapolate=True)
    assert contact.in_domain.tolist() == [False, True, False]
    assert contact_functions(1.0, 10.0, model=model, extrapolate=True).in_domain is False
    assert contact_functions(1.0, 9.0, model=model).in_domain is True


@every_model
def test_limits(model):
    tiny = contact_functions([1e-300, 1e-12], 3.0, model=model, extrapolate=True)
    for i, g in enumerate((1e-300, 1e-12)):
        wedge = wedge_functions(np.log(g), wedge_load(np.log(g)))
        # the correction is of the order of p, and A and B fall with ln g only
        for name, other in (("arc", "arc"), ("normal_load", "normal_load"), ("delta", "distance")):
            assert getattr(tiny, name)[i] == pytest.approx(
                wedge[other], rel=2.0 * wedge_load(float(np.log(g)))
            )
    zero = contact_functions(0.0, 3.0, model=model, extrapolate=True)
    assert (zero.arc, zero.normal_load, zero.delta) == (0.0, 0.0, np.inf)
    huge = contact_functions([1e20, 1e300], 3.0, model=model, extrapolate=True)
    seam = contact_functions(60.0, 3.0, model=model)
    assert huge.arc == pytest.approx(seam.arc)
    assert np.all(huge.delta == 1.0)
    assert np.all(np.isfinite(huge.normal_load))


@every_model
@pytest.mark.parametrize(
    ("function", "slopes"),
    [
        ("arc", "arc_slopes"),
        ("normal_load", "normal_load_slopes"),
    ],
)
def test_slopes_are_those_of_finite_differences(model, function, slopes, installed):
    """Of a process to fewer digits, as its large weights leave fewer to its mean."""
    chosen, h, within = installed.models[model], 1e-5, 1e-7
    if model == "gp":
        h, within = 1e-4, 1e-5
    g = np.array([1e-7, 1e-3, 0.01, 0.3, 2.5, 40.0, 80.0, 1e4])
    for alpha in (2.1, 4.4, 8.9):
        value, (in_g, in_alpha) = getattr(chosen, function), getattr(chosen, slopes)(g, alpha)
        difference = (value(g * (1 + h), alpha) - value(g * (1 - h), alpha)) / (2 * h * g)
        scale = value(g, alpha)
        assert np.all(np.abs(in_g - difference) <= within * scale / g)
        difference = (value(g, alpha + h) - value(g, alpha - h)) / (2 * h)
        assert np.all(np.abs(in_alpha - difference) <= within * scale)
        alone = [getattr(chosen, slopes)(float(x), alpha) for x in g]
        np.testing.assert_array_equal(np.array(alone).T, (in_g, in_alpha))
    assert getattr(chosen, slopes)(0.0, 3.0)[0] == np.inf
    assert getattr(chosen, slopes)(1.0, 11.0)[1] == 0.0


@every_model
def test_slopes_at_the_touch_are_those_from_above(model, installed):
    chosen = installed.models[model]
    touch = chosen.touch(3.0)
    at, above, below = (chosen.arc_slopes(touch * (1.0 + s), 3.0)[0] for s in (0.0, 1e-7, -1e-7))
    assert at == pytest.approx(above, rel=1e-4)
    if model != "power-law":
        assert abs(at - below) > 0.01 * abs(above)  # where the made-up A bends


@every_model
@pytest.mark.parametrize("slopes", ["arc_slopes", "normal_load_slopes"])
def test_slopes_of_arrays_of_any_shape_are_those_of_numbers(model, slopes, installed):
    function = getattr(installed.models[model], slopes)
    g = np.asfortranarray(np.tile(G[:6], 25).reshape(75, 2))
    alone = [function(float(x), 3.0) for x in g.ravel()]
    for alpha in (3.0, np.array(3.0), np.full((1, 2), 3.0)):
        found = function(g, alpha)
        assert [each.shape for each in found] == [g.shape] * 2
        np.testing.assert_array_equal(np.stack(found).reshape(2, -1).T, alone)
    for shape in ((0,), (2, 0, 3)):
        assert all(each.shape == shape for each in function(np.ones(shape), 3.0))
        assert all(each.shape == shape for each in function(1.0, np.ones(shape)))


@every_model
def test_forces_are_identified_propagated_and_differentiated(model):
    """With a series of cuts, that is in arrays of two axes, and without any."""
    scene = Scene(685.0, 1.0, np.array([1e-4, 2e-4, 4e-4]), 0.1, [7e3] * 3, 3.0)
    force = cutting_force(scene, model).total
    fit = surrogate.identify(
        scene.wire_radius,
        force,
        685.0,
        friction_coefficient=0.1,
        stiffening_exponent=3.0,
        force_std=0.01 * force,
        model=model,
    )
    low, high = fit.toughness_interval
    assert low <= 1.0 <= high
    uncertain = surrogate.propagate(scene, {"wear_strength": [500.0, 0.0, 500.0]}, model)
    assert uncertain.total.tolist() == force.tolist()
    assert np.all(uncertain.std >= uncertain.contributions["wear_strength"])
    empty = Scene(685.0, 1.0, np.ones((2, 0, 3)), 0.1, 7e3, 3.0)
    assert surrogate.propagate(empty, {"toughness": 0.1}, model).std.shape == (2, 0, 3)


@every_model
@pytest.mark.parametrize("name", ["toughness", "wire_radius"])
def test_a_g_that_overflows_is_outside_without_a_warning(model, name):
    given = {"shear_modulus": 10.0, "toughness": 1.6, "wire_radius": 1e-4, "wear_strength": 1.0}
    for value in (1.7e308, [1.7e308]):
        scene = Scene(**{**given, name: value})
        for function in (cutting_force, surrogate.classify):
            for chosen in (model, "auto"):
                with pytest.raises(DomainError, match="g"):
                    function(scene, model=chosen)
                function(scene, model=chosen, extrapolate=True)


@pytest.mark.parametrize("model", ["eq13", *MODELS])
def test_the_energy_release_rate_is_the_inverse_of_the_distance(model):
    for alpha in (2.0, 3.0):
        g = np.array([5.1e-3, 0.02, 0.3, 0.9])
        delta = contact_functions(g, alpha, model=model).delta
        assert energy_release_rate(delta, alpha, model=model) == pytest.approx(g, rel=1e-8)
        alone = energy_release_rate(float(delta[2]), alpha, model=model)
        assert type(alone) is float
        assert alone == energy_release_rate(delta, alpha, model=model)[2]


@pytest.mark.parametrize("model", ["eq13", *MODELS])
def test_at_distance_one_the_energy_release_rate_has_no_single_value(model):
    with pytest.raises(DomainError, match=r"no single value: the tip touches .* from J = "):
        energy_release_rate([2.0, 1.0], 3.0, model=model)
    with pytest.raises(InputError, match=r"delta must be finite and at least 1, but delta = 0.5"):
        energy_release_rate(0.5, 3.0, model=model)


def test_distances_outside_the_domain():
    with pytest.raises(DomainError, match=r"at this delta must be at most 60"):
        energy_release_rate(1e4, 3.0)
    far = energy_release_rate(1e4, 3.0, extrapolate=True)
    assert contact_functions(far, 3.0, extrapolate=True).delta == pytest.approx(1e4)


def test_the_touch(installed):
    for alpha in (2.0, 3.5):
        touch = installed.models["table"].touch(alpha)
        assert touch == pytest.approx(np.exp(log_touch(alpha)), rel=0.02)
        assert contact_functions(touch * 0.9, alpha).delta > 1.0
        assert contact_functions(touch * 1.01, alpha).delta == 1.0


@pytest.mark.parametrize("model", MODELS)
def test_the_force_is_made_of_the_contact(model):
    scene = Scene(685.0, 1.6, [1e-4, 4e-4], 0.1, 7750.0, [2.0, 5.0])
    contact = contact_functions(scene.dimensionless_toughness, [2.0, 5.0], model=model)
    force = cutting_force(scene, model, law="projected")
    radius = scene.wire_radius
    assert force.wear == pytest.approx(2.0 * radius * 7750.0 * contact.arc, rel=1e-14)
    assert force.friction == pytest.approx(2.0 * radius * 68.5 * contact.normal_load, rel=1e-14)
    np.testing.assert_array_equal(force.total, force.cleavage + force.friction + force.wear)
    assert (force.model, force.chosen) == (model, model)
    dissipation = dissipative_force(
        scene.dimensionless_toughness,
        [2.0, 5.0],
        0.1,
        7750.0 / 685.0,
        model=model,
        law="projected",
    )
    assert 685.0 * radius * dissipation == pytest.approx(force.friction + force.wear, rel=1e-13)


@pytest.mark.parametrize("model", MODELS)
def test_forces_at_the_ends_of_the_numbers(model):
    for name, size in [(n, s) for n in Scene.__slots__[:5] for s in (0.0, 5e-324, 1e300)]:
        sizes = {"shear_modulus": 685.0, "toughness": 1.6, "wire_radius": 1e-4}
        scene = Scene(**{**sizes, "friction_coefficient": 0.1, "wear_strength": 1.0, name: size})
        force = cutting_force(scene, model, extrapolate=True)
        assert force.total >= 0.0 or np.isnan(force.total) == (0.0 in (size,))
        bare = cutting_force(
            Scene(**{**sizes, name: size}) if name in sizes else scene, model, extrapolate=True
        )
        assert bare.total >= 0.0


def test_the_continued_friction_is_the_power_of_the_toughness():
    """Where g overflows, B does not: the friction is still 2 xi Gamma_o (B/g)."""
    steep = [
        cutting_force(Scene(1e-200, gamma, 1e-120, 0.1), "table", extrapolate=True).friction / gamma
        for gamma in (1.0, 10.0)
    ]
    near = contact_functions([6e3, 6e4], 2.0, extrapolate=True)
    n = np.log10(near.normal_load[1] / near.normal_load[0])
    assert np.log10(steep[1] / steep[0]) == pytest.approx(n - 1.0, abs=1e-9)


def test_rtol_of_a_named_model():
    assert contact_functions(1.0, 3.0, rtol=0.05).model == "table"
    with pytest.raises(AccuracyError, match="'power-law' may be off by"):
        contact_functions(1.0, 3.0, model="power-law", rtol=1e-3)
    with pytest.raises(AccuracyError, match="'eq9' has none"):
        contact_functions(1.0, 3.0, model="eq9", rtol=1e-3)


def test_unknown_models_are_listed():
    with pytest.raises(UnknownModelError, match=r"eq13, .*, power-law, table, gp"):
        contact_functions(1.0, 2.0, model="spline")


def test_every_model_is_described():
    for model in surrogate.models():
        assert model.name


@every_model
def test_a_toughness_that_is_0_over_0_has_no_contact_for_numbers_as_for_arrays(model):
    for radius in (1.0, [1.0]):
        scene = Scene(0.0, 0.0, radius, 0.1, 1.0, 3.0)
        force = cutting_force(scene, model, extrapolate=True)
        assert np.all(np.isnan(force.wear))
        assert np.all(np.isnan(force.total))

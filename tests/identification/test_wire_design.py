"""Which wires to buy: what a design promises, beside identifications of made-up experiments."""

from dataclasses import replace
from itertools import combinations_with_replacement

import numpy as np
import pytest

from surrogate import InputError, Scene, cutting_force, design_wires, identify
from surrogate.choosing.by_name import force_model
from surrogate.identification.further_wire import DIAMETERS, sold_radii
from surrogate.identification.wire_promise import WORTH_A_SIZE, Losses, Materials, has_middle
from surrogate.inference.continuation import contact_error, correlation
from surrogate.inference.inputs import Cuts

GEL = Scene(30e3, 1.6, 1.0, wear_strength=12e3)
SOFT = Scene(685.0, 1.6, 1.0, 0.1, 7750.0)


def made_up(scene, radius, relative, model, random):
    """Return forces of a solid that the model describes within its error, with their scatter."""
    chosen = force_model(model)
    mu, gamma, xi, tau = (
        scene.shear_modulus,
        scene.toughness,
        scene.friction_coefficient,
        scene.wear_strength,
    )
    g = gamma / (mu * radius)
    friction, wear = chosen.terms(mu, gamma, radius, xi, tau, 2.0)
    error = contact_error(chosen, g, 2.0)
    expected = gamma + friction + wear
    if error is not None:
        unique, places = np.unique(radius, return_inverse=True)
        root = np.linalg.cholesky(correlation(unique) + 1e-12 * np.eye(unique.size))
        arc, load = (
            (root @ random.standard_normal(unique.size))[places.reshape(-1)] for _ in range(2)
        )
        friction, wear = friction * (1.0 + error.load * load), wear * (1.0 + error.arc * arc)
    force = gamma + friction + wear
    return force + relative * expected * random.standard_normal(radius.size), relative * expected


@pytest.mark.parametrize(
    ("scene", "model", "cuts", "relative"),
    [(GEL, "table", 8, 0.05), (SOFT, "table", 6, 0.05), (GEL, "eq13", 8, 0.10)],
)
def test_the_promised_errors_are_those_of_identifications(scene, model, cuts, relative):
    """400 of them: their standard deviations are known to 3.5 %, the promise's to 2.2 %."""
    design = design_wires(scene, cuts, relative_force_std=relative, model=model)
    random, estimates = np.random.default_rng(1), []
    for _ in range(400):
        force, std = made_up(scene, design.wire_radius, relative, model, random)
        fit = identify(
            design.wire_radius,
            force,
            scene.shear_modulus,
            friction_coefficient=scene.friction_coefficient,
            force_std=std,
            model=model,
        )
        estimates.append((fit.toughness, fit.wear_strength))
    simulated = np.std(estimates, axis=0)
    promised = [design.toughness_std, design.wear_strength_std]
    np.testing.assert_allclose(simulated, promised, rtol=0.15)


def test_wires_are_sold_in_range_and_carry_the_force():
    design = design_wires(SOFT, 8, relative_force_std=0.05, thickness=20e-3)
    low, high = force_model(design.model).g.lower, force_model(design.model).g.upper
    for wire in design.wires:
        assert np.isclose(wire.diameter, DIAMETERS).any()
        assert low <= wire.dimensionless_toughness <= high
        assert wire.breaking_force >= 2.0 * 20e-3 * wire.force
        assert wire.widest_sample >= 20e-3
    assert sum(wire.cuts for wire in design.wires) == 8
    assert has_middle(design.wire_radius)
    assert "beyond the range of model 'table'" in design.left_out[0]
    wide = design_wires(SOFT, 8, relative_force_std=0.05, thickness=3.0)
    assert "wires thinner than 0.11 mm were left out: a steel wire" in wide.left_out[1]
    assert wide.wires[0].diameter > design.wires[0].diameter


@pytest.mark.parametrize("goal", ["both", "toughness", "wear_strength"])
def test_no_other_choice_of_few_wires_is_better(goal):
    sizes = 1e-3 * np.array([0.05, 0.1, 0.2, 0.5, 1.0])
    design = design_wires(GEL, 5, force_std=0.5, diameters=sizes, goal=goal, model="table")
    cuts = Cuts(np.ones(1), np.ones(1), None, 30e3, 0.0, 2.0)
    materials = Materials(np.array([1.6]), np.array([12e3]), cuts)
    losses = Losses(materials, "table", sizes / 2.0, (0.5, 0.0), goal)
    best = min(losses.of(picked) for picked in combinations_with_replacement(range(5), 5))
    places = np.searchsorted(sizes / 2.0, design.wire_radius * (1.0 - 1e-9)).tolist()
    assert losses.of(places) <= best + WORTH_A_SIZE


def test_an_earlier_result_keeps_all_that_it_admits_in_range():
    radius = np.array([0.125e-3, 0.210e-3, 0.275e-3, 0.390e-3, 0.470e-3])
    fit = identify(radius, 1.6 + 31e3 * radius, 685.0)
    design = design_wires(fit, 8, relative_force_std=0.05)
    assert design.model == fit.model
    assert design.toughness == fit.toughness
    assert len(design.others) == sum(mode.admitted for mode in fit.profile.modes[1:]) + 2
    thinnest = design.wires[0].diameter / 2.0
    assert fit.toughness_interval[1] / (685.0 * thinnest) <= force_model(fit.model).g.upper
    line = design_wires(identify(radius, 1.6 + 31e3 * radius, 685.0, model="eq13"), force_std=0.5)
    assert line.model == "eq13"


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({}, "exactly one of force_std and relative_force_std"),
        ({"force_std": 1.0, "relative_force_std": 0.1}, "exactly one"),
        ({"force_std": 1.0, "cuts": 2}, "from 3 to 100"),
        ({"force_std": 1.0, "cuts": 2.5}, "must be a whole number"),
        ({"force_std": 1.0, "goal": "best"}, "choose one of both, toughness, wear_strength"),
        (
            {"force_std": 1.0, "diameters": [1e-4, 2e-4]},
            "2 wires are left to choose from",
        ),
        ({"force_std": 1.0, "diameters": [1e-4, -2e-4]}, "wire_diameter must be"),
        ({"force_std": 1.0, "thickness": 1e9}, "would not carry twice the force"),
        ({"force_std": np.nan}, "force_std must be"),
    ],
)
def test_bad_input_is_refused_in_words(options, words):
    with pytest.raises(InputError, match=words):
        design_wires(GEL, **options)


def test_what_is_no_guess_is_refused():
    for expected, words in (
        (1.6, "expected must be a Scene"),
        (Scene(30e3, 0.0, 1.0, wear_strength=1e3), "above 0"),
        (Scene([30e3, 40e3], 1.0, 1.0, wear_strength=1e3), "one modulus"),
        (identify([1e-4, 2e-4, 3e-4], [4.0, 6.0, 8.5], model="eq13"), "shear modulus"),
    ):
        with pytest.raises(InputError, match=words):
            design_wires(expected, force_std=1.0)
    assert sold_radii(1.0, 2.0).size == 0


@pytest.mark.parametrize("law", ["slip", "coupled"])
def test_the_errors_to_first_order_are_those_of_an_identification_of_the_law(law):
    tissue = Scene(10e3, 5.0, 1.0, 0.02, 800.0, 5.0)
    design = design_wires(tissue, 6, relative_force_std=0.02, law=law)
    assert (design.law, force_model(design.model).name) == (law, "table")
    wires = replace(tissue, wire_radius=design.wire_radius)
    force = cutting_force(wires, "table", law=law).total
    fit = identify(
        design.wire_radius,
        force,
        10e3,
        friction_coefficient=0.02,
        stiffening_exponent=5.0,
        force_std=0.02 * force,
        law=law,
    )
    assert (fit.toughness, fit.wear_strength) == pytest.approx((5.0, 800.0), rel=1e-4)
    errors = fit.toughness_std, fit.wear_strength_std
    assert errors == pytest.approx(design.first_order_std, rel=2e-3)
    assert (design.toughness_std, design.wear_strength_std) == pytest.approx(errors, rel=0.15)
    again = design_wires(fit, 6, relative_force_std=0.02)
    assert again.law == law
    known = cutting_force(wires, law="coupled", outside="nan").in_domain
    assert np.all(known) == (law == "coupled") or law == "slip"


def test_a_scene_of_a_law_is_designed_for_under_it():
    tissue = Scene(10e3, 5.0, 1.0, 0.02, 800.0, 5.0, law="coupled")
    design = design_wires(tissue, 3, relative_force_std=0.05)
    assert design.law == "coupled"
    assert any("no coupled solution is near" in words for words in design.left_out)
    with pytest.raises(InputError, match="law must be one of"):
        design_wires(tissue, 3, relative_force_std=0.05, law="auto")
    much = replace(tissue, wear_strength=5e5)
    with pytest.raises(InputError, match="no coupled solution is near their friction and wear"):
        design_wires(much, 3, relative_force_std=0.05)

"""The cutting force: its parts, models, domains and limits."""

import numpy as np
import pytest

import surrogate
from surrogate import FORCE_MODELS, Scene, cutting_force, dissipative_force

MU, GAMMA, RADIUS, XI, TAU = 685.0, 1.6, 0.25e-3, 0.1, 7750.0
SCENE = Scene(MU, GAMMA, RADIUS, XI, TAU)


def test_parts_of_the_general_force():
    force = cutting_force(SCENE, "eq13")
    assert force.cleavage == GAMMA
    assert force.friction == pytest.approx(XI * (GAMMA + 4 * MU * RADIUS), rel=1e-15)
    assert force.wear == pytest.approx(4 * TAU * RADIUS, rel=1e-15)
    assert force.model == "eq13"
    assert force.relative_error is None
    assert force.in_domain is True


@pytest.mark.parametrize(
    ("model", "expected"),
    [
        ("eq13", surrogate.general_force(MU, GAMMA, RADIUS, XI, TAU)),
        ("high-toughness", surrogate.high_toughness_force(GAMMA, XI)),
        ("low-toughness", surrogate.low_toughness_force(MU, GAMMA, RADIUS, XI, TAU)),
        (
            "friction-free",
            GAMMA * surrogate.friction_free_relative_force(RADIUS, SCENE.wear_length),
        ),
        (
            "eq9",
            GAMMA
            + MU
            * RADIUS
            * surrogate.power_law_dissipation(SCENE.dimensionless_toughness, XI, 1.18),
        ),
    ],
)
def test_each_model_totals_its_equation(model, expected):
    # Two routes to one number, each of fewer than ten roundings.
    assert cutting_force(SCENE, model).total == pytest.approx(expected, rel=10 * 2.3e-16)


@pytest.mark.parametrize("model", FORCE_MODELS)
def test_terms_are_those_of_the_contact_functions(model):
    chosen, g = FORCE_MODELS[model], SCENE.dimensionless_toughness
    force = cutting_force(SCENE, model)
    wear = 2 * RADIUS * TAU * chosen.arc(g, 2.0)
    friction = 2 * RADIUS * XI * MU * chosen.normal_load(g, 2.0)
    assert force.wear == pytest.approx(wear, rel=1e-14)
    assert force.friction == pytest.approx(friction, rel=1e-14)


@pytest.mark.parametrize("model", FORCE_MODELS)
def test_dissipative_force_is_the_force_less_the_toughness(model):
    force = cutting_force(SCENE, model)
    dissipation = dissipative_force(SCENE.dimensionless_toughness, 2.0, XI, TAU / MU, model=model)
    assert MU * RADIUS * dissipation == pytest.approx(force.friction + force.wear, rel=1e-14)


@pytest.mark.parametrize(
    ("model", "scene", "holds"),
    [
        ("high-toughness", Scene(1.0, 10.0, 1.0), True),
        ("high-toughness", Scene(1.0, 9.99, 1.0), False),
        ("high-toughness", Scene(1.0, 1.0, 0.0), True),
        ("high-toughness", Scene(1.0, 0.0, 0.0), False),
        ("low-toughness", Scene(1.0, 1.0, 1.0), True),
        ("low-toughness", Scene(1.0, 1.01, 1.0), False),
        ("friction-free", Scene(1.0, 1.0, 1.0), True),
        ("friction-free", Scene(1.0, 1.0, 1.0, 0.1, 1.0), True),
        ("friction-free", Scene(1.0, 1.0, 1.0, 0.2, 10.0), False),
        ("friction-free", Scene(1.0, 1.0, 1.0, 0.1, 0.9), False),
        ("eq9", Scene(1.0, 10.0, 1.0), True),
        ("eq9", Scene(1.0, 9.0, 1.0), False),
        ("eq13", Scene(1.0, 9.0, 1.0), True),
    ],
)
def test_models_say_where_they_hold(model, scene, holds):
    assert cutting_force(scene, model).in_domain is holds


def test_domain_is_told_point_by_point():
    scene = Scene(1.0, [0.5, 2.0, 20.0], 1.0)
    assert cutting_force(scene, "low-toughness").in_domain.tolist() == [True, False, False]
    assert cutting_force(scene, "high-toughness").in_domain.tolist() == [False, False, True]
    assert cutting_force(scene, "eq13").in_domain.tolist() == [True] * 3


@pytest.mark.parametrize("alpha", [1.9, 9.1, [2.0, 10.0]])
def test_power_law_needs_a_tabulated_stiffening_exponent(alpha):
    scene = Scene(MU, GAMMA, RADIUS, XI, TAU, alpha)
    with pytest.raises(surrogate.DomainError, match=r"stiffening_exponent.*Table 1"):
        cutting_force(scene, "eq9")
    with pytest.raises(surrogate.DomainError, match=r"alpha.*Table 1"):
        dissipative_force(20.0, alpha, 0.1, 0.0, model="eq9")
    cutting_force(scene, "eq13")


@pytest.mark.parametrize("model", ["eq12", "", None, 13, ["eq13"], np.array(["eq13"])])
def test_unknown_models_are_told_the_known_ones(model):
    for call in (lambda: cutting_force(SCENE, model), lambda: dissipative_force(1, 2, 0, 0, model)):
        with pytest.raises(surrogate.UnknownModelError, match="eq13, high-toughness"):
            call()


@pytest.mark.parametrize("model", FORCE_MODELS)
def test_parts_of_like_size_add_up_to_the_last_bit(model):
    random = np.random.default_rng(7)
    force = cutting_force(Scene(*random.uniform(1.0, 2.0, (5, 1000))), model)
    np.testing.assert_array_equal(force.total, force.cleavage + force.friction + force.wear)


def test_a_scene_is_needed():
    with pytest.raises(surrogate.InputError, match="scene must be a Scene"):
        cutting_force(685.0)


def test_every_part_has_the_shape_of_the_scene():
    scene = Scene([[MU], [2 * MU]], GAMMA, [1e-4, 2e-4, 3e-4], XI, TAU)
    for model in FORCE_MODELS:
        force = cutting_force(scene, model)
        for part in (force.total, force.cleavage, force.friction, force.wear, force.in_domain):
            assert part.shape == (2, 3)
        assert force == cutting_force(scene, model)


def test_results_are_nobody_elses_arrays():
    toughness = np.array([1.0, 2.0])
    force = cutting_force(Scene(MU, toughness, RADIUS))
    force.cleavage[0] = 5.0
    assert toughness.tolist() == [1.0, 2.0]


# Limits: every quantity that vanishes leaves the exact sum of the others' terms.


@pytest.mark.parametrize("model", ["eq13", "low-toughness", "friction-free"])
def test_force_without_dissipation_is_the_toughness(model):
    assert cutting_force(Scene(MU, GAMMA, RADIUS), model).total == GAMMA


def test_vanishing_radius_leaves_toughness_and_friction():
    force = cutting_force(Scene(MU, GAMMA, 0.0, XI, TAU), "eq13")
    assert (force.total, force.wear) == (GAMMA + XI * GAMMA, 0.0)


def test_vanishing_modulus_leaves_wear_and_the_friction_of_the_toughness():
    force = cutting_force(Scene(0.0, GAMMA, RADIUS, XI, TAU), "eq13")
    assert (force.friction, force.wear) == (XI * GAMMA, 4 * (TAU * RADIUS))


def test_vanishing_toughness_leaves_the_linear_terms():
    force = cutting_force(Scene(MU, 0.0, RADIUS, XI, TAU), "eq13")
    assert force.cleavage == 0.0
    assert force.total == pytest.approx(4 * (XI * MU + TAU) * RADIUS, rel=1e-15)


@pytest.mark.parametrize("model", FORCE_MODELS)
def test_nothing_costs_nothing(model):
    assert cutting_force(Scene(0.0, 0.0, 0.0), model).total == 0.0


@pytest.mark.parametrize(("alpha", "friction"), [(2.0, np.inf), (7.4, XI * GAMMA), (9.0, 0.0)])
@pytest.mark.parametrize("thing", ["shear_modulus", "wire_radius"])
def test_power_law_friction_of_a_vanishing_radius_or_modulus(thing, alpha, friction):
    # xi Gamma_o g^(n-1) with g infinite: n = 1.18 diverges, n = 1 stays, n = 0.96 vanishes.
    quantities = {"shear_modulus": MU, "toughness": GAMMA, "wire_radius": RADIUS, thing: 0.0}
    scene = Scene(**quantities, friction_coefficient=XI, stiffening_exponent=alpha)
    assert cutting_force(scene, "eq9").friction == friction
    frictionless = Scene(**quantities, stiffening_exponent=alpha)
    assert cutting_force(frictionless, "eq9").friction == 0.0

"""Standard deviations of the force: by hand, by repeated draws, and refused nonsense."""

from dataclasses import replace

import numpy as np
import pytest

from surrogate import (
    FORCE_MODELS,
    DomainError,
    InputError,
    Scene,
    cutting_force,
    identify,
    propagate,
)
from surrogate.scene import NAMES

GEL = Scene(685.0, 1.6, 0.25e-3, 0.1, 7750.0, 3.0)
RELATIVE = dict(zip(NAMES, [0.01, 0.02, 0.005, 0.03, 0.02, 0.01], strict=True))
STD = {name: share * getattr(GEL, name) for name, share in RELATIVE.items()}


def test_eq13_by_hand():
    force = propagate(GEL, {"toughness": 0.2, "wire_radius": 5e-6}, "eq13")
    parts = {"toughness": 1.1 * 0.2, "wire_radius": 4 * (68.5 + 7750.0) * 5e-6}
    assert force.total == cutting_force(GEL, "eq13").total
    assert force.contributions == pytest.approx(parts)
    assert force.std == pytest.approx(np.hypot(*parts.values()))
    assert force.model_std is None
    assert force.model == "eq13"


def test_what_is_exact_adds_nothing():
    assert propagate(GEL, {}, "eq13").std == 0.0
    assert propagate(GEL, {"toughness": 0.0}, "eq13").contributions == {"toughness": 0.0}
    frictionless = replace(GEL, toughness=0.0, stiffening_exponent=9.0)  # an infinite slope
    assert propagate(frictionless, {"toughness": 0.0}, "eq9").std == 0.0
    assert propagate(frictionless, {"toughness": 1e-9}, "eq9").std == np.inf


@pytest.mark.parametrize("model", ["eq13", "eq9", "elements"])
def test_repeated_draws_scatter_as_stated(model, elements):
    """What first order leaves out is of the order of the squared relative errors, 1e-3."""
    random = np.random.default_rng(3)
    count = 20_000
    draws = Scene(*(random.normal(getattr(GEL, name), STD[name], count) for name in NAMES))
    scatter = np.std(cutting_force(draws, model).total)
    # The standard deviation of n draws is itself known to 1/sqrt(2 n) = 0.5 %; four of those.
    assert propagate(GEL, STD, model).std == pytest.approx(scatter, rel=0.02)


@pytest.mark.parametrize("model", [*FORCE_MODELS, "elements"])
@pytest.mark.parametrize("rho", [-1.0, -0.6, 0.0, 1.0])
def test_correlated_errors(model, rho, elements):
    pair = {name: STD[name] for name in ("toughness", "wear_strength")}
    force = propagate(GEL, pair, model, correlation={("wear_strength", "toughness"): rho})
    a, b = force.contributions.values()
    sign = np.sign(a) * np.sign(b)  # both slopes of these models are positive here
    assert force.std == pytest.approx(np.sqrt(a**2 + b**2 + 2 * rho * sign * a * b), abs=1e-8)


def test_the_error_of_an_identified_material_at_a_measured_wire_is_that_of_the_fit():
    radius = np.array([0.125e-3, 0.210e-3, 0.275e-3, 0.390e-3, 0.470e-3])
    fit = identify(radius, [5.5, 8.0, 10.2, 13.6, 16.2], 685.0, force_std=0.2, model="eq13")
    force = propagate(
        fit.scene(radius),
        {"toughness": fit.toughness_std, "wear_strength": fit.wear_strength_std},
        "eq13",
        correlation={("toughness", "wear_strength"): fit.correlation},
    )
    np.testing.assert_allclose(force.std, fit.predict_std(radius), rtol=1e-12)


def test_the_models_own_error_counts(register, elements_like):
    register(elements_like(errors=(0.05, 0.2)))
    force = propagate(GEL, {"toughness": 0.2}, "elements")
    own = np.hypot(2 * 0.25e-3 * 7750.0 * 0.05, 2 * 0.25e-3 * 0.1 * 685.0 * 0.2)
    assert force.model_std == pytest.approx(own)
    assert force.std == pytest.approx(np.hypot(own, force.contributions["toughness"]))
    plain = replace(GEL, friction_coefficient=0.0, wear_strength=0.0)
    assert propagate(plain, {}, "elements").std == 0.0


def test_arrays_broadcast_and_are_numbers_one_by_one(register, elements_like):
    register(elements_like(errors=(0.05, 0.2)))
    radii = [1e-4, 2e-4, 3e-4]
    scene = replace(GEL, wire_radius=radii)
    together = propagate(scene, {"wear_strength": 100.0, "toughness": [[0.1], [0.2]]}, "elements")
    assert together.std.shape == (2, 3)
    assert together.model_std.shape == (3,)
    for j, radius in enumerate(radii):
        alone = propagate(
            replace(GEL, wire_radius=radius), {"wear_strength": 100.0, "toughness": 0.2}, "elements"
        )
        assert together.std[1, j] == alone.std
        assert type(alone.std) is float


@pytest.mark.parametrize("size", [0.0, 5e-324, 1e-300, 1e300])
@pytest.mark.parametrize("name", NAMES)
def test_errors_of_any_size(name, size):
    other = "toughness" if name != "toughness" else "wire_radius"
    force = propagate(GEL, {name: size, other: 0.0}, "eq13")
    assert force.std == pytest.approx(force.contributions[name], rel=1e-14, abs=0.0)
    assert force.std >= 0.0


@pytest.mark.parametrize(
    ("scene", "std", "options", "words"),
    [
        (685.0, {}, {}, "scene must be a Scene"),
        (GEL, 0.2, {}, "std must be a mapping"),
        (GEL, {"gamma": 0.2}, {}, "std must name .* 'gamma'; choose from shear_modulus"),
        (GEL, {"toughness": -0.2}, {}, "std of toughness must be .* not negative"),
        (GEL, {"toughness": np.nan}, {}, "std of toughness"),
        (GEL, {"toughness": np.inf}, {}, "std of toughness"),
        (GEL, {"toughness": [1.0, 2.0], "wire_radius": [1e-5] * 3}, {}, "broadcast together"),
        (GEL, {"toughness": 0.1}, {"model": "eq99"}, "eq99"),
        (GEL, {"toughness": 0.1}, {"correlation": {"toughness": 0.5}}, "given for pairs"),
        (
            GEL,
            {"toughness": 0.1},
            {"correlation": {("toughness", "toughness"): 0.5}},
            "given for pairs",
        ),
        (
            GEL,
            {"toughness": 0.1},
            {"correlation": {("toughness", "wire_radius"): 0.5}},
            "correlation must name uncertain .* choose from toughness",
        ),
        (
            GEL,
            {"toughness": 0.1, "wire_radius": 1e-6},
            {"correlation": {("toughness", "wire_radius"): 1.5}},
            "from -1 to 1",
        ),
        (
            GEL,
            {"toughness": 0.1, "wire_radius": 1e-6, "shear_modulus": 1.0},
            {
                "correlation": {
                    ("toughness", "wire_radius"): 0.9,
                    ("toughness", "shear_modulus"): 0.9,
                    ("wire_radius", "shear_modulus"): -0.9,
                }
            },
            "contradict each other",
        ),
    ],
)
def test_nonsense_is_refused_in_words(scene, std, options, words):
    with pytest.raises(InputError, match=words):
        propagate(scene, std, **options)


def test_a_force_without_a_derivative_is_refused():
    with pytest.raises(DomainError, match="derivative by"):
        propagate(Scene(0.0, 0.0, 0.0, 0.1), {"toughness": 0.1}, "eq9")

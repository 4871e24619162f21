"""What holds for any material and wire: units, additivity, monotonicity, limits, arrays."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import surrogate
from surrogate import FORCE_MODELS, Scene, cutting_force, dissipative_force

EPS = np.finfo(float).eps
MODELS = st.sampled_from(sorted(FORCE_MODELS))


def magnitudes(low=-12, high=12):
    """Zero or a positive number of any magnitude between powers of ten."""
    return st.one_of(st.just(0.0), st.floats(low, high).map(lambda power: 10.0**power))


POSITIVE = st.floats(-12, 12).map(lambda power: 10.0**power)
SCENES = st.builds(
    Scene,
    shear_modulus=magnitudes(),
    toughness=magnitudes(),
    wire_radius=magnitudes(),
    friction_coefficient=magnitudes(-6, 2),
    wear_strength=magnitudes(),
    stiffening_exponent=st.floats(2.0, 9.0),
)
POSITIVE_SCENES = st.builds(
    Scene,
    shear_modulus=POSITIVE,
    toughness=POSITIVE,
    wire_radius=POSITIVE,
    friction_coefficient=magnitudes(-6, 2),
    wear_strength=POSITIVE,
    stiffening_exponent=st.floats(2.0, 9.0),
)


@given(SCENES, MODELS)
def test_the_parts_add_up_to_the_last_bit(scene, model):
    force = cutting_force(scene, model)
    assert force.total == force.cleavage + force.friction + force.wear
    assert min(force.cleavage, force.friction, force.wear) >= 0.0


@given(POSITIVE_SCENES, MODELS, POSITIVE, POSITIVE)
def test_units_do_not_matter(scene, model, length, stress):
    """In other units of length and stress, forces per length change by their product."""
    other = Scene(
        scene.shear_modulus * stress,
        scene.toughness * stress * length,
        scene.wire_radius * length,
        scene.friction_coefficient,
        scene.wear_strength * stress,
        scene.stiffening_exponent,
    )
    # The power law takes the logarithm of numbers that differ by up to 1e24 from the original.
    expected = pytest.approx(cutting_force(scene, model).total * stress * length, rel=100 * EPS)
    assert cutting_force(other, model).total == expected
    g = pytest.approx(scene.dimensionless_toughness, rel=10 * EPS)
    assert other.dimensionless_toughness == g
    radius = pytest.approx(surrogate.transition_radius(scene, "eq13") * length, rel=10 * EPS)
    assert surrogate.transition_radius(other, "eq13") == radius


@given(POSITIVE_SCENES, st.integers(-60, 60), st.integers(-60, 60))
def test_regimes_do_not_depend_on_units(scene, length, stress):
    other = Scene(  # powers of two round nothing
        scene.shear_modulus * 2.0**stress,
        scene.toughness * 2.0 ** (stress + length),
        scene.wire_radius * 2.0**length,
        scene.friction_coefficient,
        scene.wear_strength * 2.0**stress,
    )
    assert surrogate.classify(other, model="eq13") == surrogate.classify(scene, model="eq13")


@given(
    SCENES,
    st.sampled_from(["eq13", "high-toughness", "low-toughness", "friction-free"]),
    st.sampled_from(
        ["shear_modulus", "toughness", "wire_radius", "friction_coefficient", "wear_strength"]
    ),
    magnitudes(),
)
def test_force_never_falls_as_any_quantity_grows(scene, model, name, more):
    # Every operation of the closed forms rounds monotonically.
    grown = replace(scene, **{name: getattr(scene, name) + more})
    assert cutting_force(grown, model).total >= cutting_force(scene, model).total


@given(
    POSITIVE_SCENES,
    st.sampled_from(["toughness", "friction_coefficient", "stiffening_exponent"]),
    st.floats(1.0 + 1e-6, 2.0),
)
def test_power_law_grows_with_toughness_and_friction_and_falls_with_stiffening(scene, name, by):
    scene = replace(scene, stiffening_exponent=2.0 + 0.3 * (scene.stiffening_exponent - 2.0))
    grown = replace(scene, **{name: getattr(scene, name) * by})
    before = cutting_force(scene, "eq9").friction
    after = cutting_force(grown, "eq9").friction
    if name != "stiffening_exponent":
        assert after >= before
    elif scene.dimensionless_toughness > 1.0:  # g^n falls with n, which falls with alpha
        assert after <= before * (1 + 100 * EPS)


@given(POSITIVE_SCENES)
def test_the_general_force_tends_to_that_of_high_toughness(scene):
    linear = 4 * (scene.friction_coefficient * scene.shear_modulus + scene.wear_strength)
    sharp = replace(scene, wire_radius=0.25 * EPS * scene.toughness / linear)
    general = cutting_force(sharp, "eq13").total
    assert general == pytest.approx(cutting_force(sharp, "high-toughness").total, rel=2 * EPS)


@given(POSITIVE_SCENES)
def test_the_general_force_tends_to_that_of_low_toughness(scene):
    # They differ by xi Gamma_o, which 4 xi mu R_w outweighs by 4/g.
    soft = replace(scene, toughness=EPS * scene.shear_modulus * scene.wire_radius)
    general = cutting_force(soft, "eq13").total
    assert general == pytest.approx(cutting_force(soft, "low-toughness").total, rel=4 * EPS)


@given(POSITIVE_SCENES)
def test_without_friction_three_models_are_one(scene):
    frictionless = replace(scene, friction_coefficient=0.0)
    force = cutting_force(frictionless, "eq13")
    for model in ("low-toughness", "friction-free"):
        assert cutting_force(frictionless, model).total == force.total


@given(st.lists(SCENES, min_size=1, max_size=40), MODELS)
def test_forces_of_arrays_are_those_of_numbers_bit_for_bit(scenes, model):
    together = Scene(*zip(*(scene.values() for scene in scenes), strict=True))
    forces = cutting_force(together, model)
    for i, scene in enumerate(scenes):
        force = cutting_force(scene, model)
        for name in ("total", "cleavage", "friction", "wear", "in_domain"):
            assert getattr(forces, name)[i] == getattr(force, name)
    strided = Scene(*(np.repeat(value, 2)[::2] for value in together.values()))
    assert cutting_force(strided, model) == forces


@given(st.lists(SCENES, min_size=1, max_size=20))
def test_equations_and_regimes_of_arrays_are_those_of_numbers(scenes):
    together = Scene(*zip(*(scene.values() for scene in scenes), strict=True))
    forces = surrogate.general_force(*together.values()[:5])
    regimes = surrogate.classify(together, model="eq13")
    for i, scene in enumerate(scenes):
        assert forces[i] == surrogate.general_force(*scene.values()[:5])
        regime = surrogate.classify(scene, model="eq13")
        assert (regimes.dominant[i], regimes.contact[i]) == (regime.dominant, regime.contact)


@given(
    st.lists(st.tuples(magnitudes(), st.floats(2.0, 9.0), magnitudes(), magnitudes()), min_size=1),
    MODELS,
)
def test_dissipation_of_arrays_is_that_of_numbers(points, model):
    together = dissipative_force(*np.array(points).T, model=model)
    assert together.tolist() == [dissipative_force(*point, model=model) for point in points]


@given(SCENES)
def test_only_one_term_can_dominate_and_it_is_the_largest(scene):
    regime = surrogate.classify(scene, model="eq13")
    mu, gamma, radius, xi, wear, _ = scene.values()
    terms = {
        "toughness-and-friction": (1 + xi) * gamma,
        "wear": 4 * wear * radius,
        "friction-stiffness": 4 * xi * mu * radius,
    }
    largest = max(terms, key=terms.__getitem__)
    others = sum(terms.values()) - terms[largest]
    if regime.dominant == "transition":
        assert terms[largest] <= 2 * others * (1 + 10 * EPS)
    else:
        assert regime.dominant == largest
        assert terms[largest] >= 2 * others * (1 - 10 * EPS)

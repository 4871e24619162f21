"""Derivatives of the force: by finite differences, by hand, by Euler, and at the limits."""

import re
from dataclasses import replace

import numpy as np
import pytest

from surrogate import (
    FORCE_MODELS,
    DomainError,
    InputError,
    Scene,
    cutting_force,
    force_gradient,
)
from surrogate.scene import NAMES

SCENE = Scene(685.0, 1.6, 0.25e-3, 0.1, 7750.0, 3.0)
MODELS = [*FORCE_MODELS, "elements", "bump"]
CLOSED = ["eq13", "high-toughness", "low-toughness", "friction-free"]


@pytest.fixture(autouse=True)
def known(elements, bump):
    """Make the models of tests known."""


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("radius", [1e-6, 0.25e-3, 0.1])
def test_finite_differences(model, name, radius):
    scene = replace(SCENE, wire_radius=radius)
    value = getattr(scene, name)
    step = 1e-5 * value
    up, down = (
        cutting_force(replace(scene, **{name: value + h}), model).total for h in (step, -step)
    )
    # h^2 f'''/6 of the central difference and the rounding of two forces over 2 h.
    scale = cutting_force(scene, model).total / value
    assert getattr(force_gradient(scene, model), name) == pytest.approx(
        (up - down) / (2.0 * step), rel=0.0, abs=2e-9 * scale
    )


@pytest.mark.parametrize(
    ("model", "load", "slope", "arc"),
    [
        ("eq13", 4.0, 1.0, 4.0),
        ("high-toughness", 0.0, 1.0, 0.0),
        ("low-toughness", 4.0, 0.0, 4.0),
        ("friction-free", 0.0, 0.0, 4.0),
    ],
)
def test_closed_forms_by_hand(model, load, slope, arc):
    mu, gamma, radius, xi, tau, _ = SCENE.values()
    found = force_gradient(SCENE, model)
    assert found.shear_modulus == pytest.approx(load * xi * radius, rel=1e-15)
    assert found.toughness == pytest.approx(1.0 + slope * xi, rel=1e-15)
    assert found.wire_radius == pytest.approx(load * xi * mu + arc * tau, rel=1e-15)
    assert found.friction_coefficient == pytest.approx(slope * gamma + load * mu * radius)
    assert found.wear_strength == pytest.approx(arc * radius, rel=1e-15)
    assert found.stiffening_exponent == 0.0
    assert found.model == model


@pytest.mark.parametrize("model", MODELS)
def test_the_force_is_homogeneous(model):
    """Of degree one in (Gamma_o, R_w) and in (mu, Gamma_o, tau_w), after Euler."""
    found, total = force_gradient(SCENE, model), cutting_force(SCENE, model).total
    mu, gamma, radius, _, tau, _ = SCENE.values()
    of_lengths = gamma * found.toughness + radius * found.wire_radius
    of_stresses = mu * found.shear_modulus + gamma * found.toughness + tau * found.wear_strength
    assert of_lengths == pytest.approx(total, rel=1e-13)
    assert of_stresses == pytest.approx(total, rel=1e-13)


def test_the_chain_rule_agrees_with_the_closed_forms_own_derivatives():
    """Two routes: through g and A, B for any model, and term by term."""
    for model in FORCE_MODELS.values():
        general = super(type(model), model).gradient(*SCENE.values())
        for name, derivative in zip(NAMES, general, strict=True):
            own = getattr(force_gradient(SCENE, model.name), name)
            assert own == pytest.approx(derivative, rel=1e-13, abs=1e-18), (model.name, name)


@pytest.mark.parametrize("model", MODELS)
def test_arrays_are_numbers_bit_for_bit(model):
    random = np.random.default_rng(5)
    values = random.uniform(0.5, 2.0, (6, 40)) * np.array([[685, 1.6, 3e-4, 0.1, 7e3, 3.5]]).T
    values[1, 3] = values[3, 5] = values[4, 7] = 0.0
    values[5] = values[5].clip(2.0, 9.0)
    together = force_gradient(Scene(*values), model)
    for i in range(values.shape[1]):
        alone = force_gradient(Scene(*values[:, i].tolist()), model)
        for name in NAMES:
            assert getattr(together, name)[i] == getattr(alone, name), (i, name)
            assert type(getattr(alone, name)) is float


@pytest.mark.parametrize("model", CLOSED)
@pytest.mark.parametrize("gone", [[name] for name in NAMES[:5]] + [list(NAMES[:5])])
def test_closed_forms_have_derivatives_where_quantities_vanish(model, gone):
    scene = replace(SCENE, **dict.fromkeys(gone, 0.0))
    mu, gamma, radius, xi, tau, _ = scene.values()
    chosen = FORCE_MODELS[model]
    found = force_gradient(scene, model)
    assert found.toughness == 1.0 + chosen.load_2_slope * xi
    assert found.wire_radius == pytest.approx(chosen.load_2 * xi * mu + chosen.arc_2 * tau)
    assert found.shear_modulus == pytest.approx(chosen.load_2 * xi * radius)
    expected = pytest.approx(chosen.load_2_slope * gamma + chosen.load_2 * mu * radius)
    assert found.friction_coefficient == expected
    assert found.wear_strength == chosen.arc_2 * radius


@pytest.mark.parametrize(
    ("scene", "expected"),
    [
        # xi Gamma_o^n (mu R_w)^(1 - n), n = 1.18, 1 and 0.96 at alpha = 2, 7.4 and 9
        (Scene(1.0, 0.0, 1.0, 0.1, 1.0, 2.0), (0.0, 1.0, 0.0, 0.0, 0.0, 0.0)),
        (Scene(1.0, 0.0, 1.0, 0.1, 1.0, 7.4), (0.0, 1.1, 0.0, 0.0, 0.0, 0.0)),
        (Scene(1.0, 0.0, 1.0, 0.1, 1.0, 9.0), (0.0, np.inf, 0.0, 0.0, 0.0, 0.0)),
        (Scene(1.0, 0.0, 1.0, 0.0, 1.0, 9.0), (0.0, 1.0, 0.0, 0.0, 0.0, 0.0)),
        (Scene(1.0, 1.0, 0.0, 0.1, 1.0, 2.0), (-np.inf, np.inf, -np.inf, np.inf, 0.0, -np.inf)),
        (Scene(1.0, 1.0, 0.0, 0.1, 1.0, 9.0), (0.0, 1.0, np.inf, 0.0, 0.0, 0.0)),
        (Scene(0.0, 1.0, 1.0, 0.1, 1.0, 9.0), (np.inf, 1.0, 0.0, 0.0, 0.0, 0.0)),
        (Scene(1.0, 1.0, 0.0, 0.1, 1.0, 7.4), (0.0, 1.1, 0.0, 1.0, 0.0, -np.inf)),
        (Scene(0.0, 0.0, 0.0, 0.0, 0.0, 2.0), (0.0, 1.0, 0.0, 0.0, 0.0, 0.0)),
    ],
)
def test_limits_of_the_power_law(scene, expected):
    found = force_gradient(scene, "eq9")
    assert tuple(getattr(found, name) for name in NAMES) == pytest.approx(expected)


@pytest.mark.parametrize("model", ["elements", "bump"])
def test_limits_of_a_contact_model(model):
    """g A' and g B' vanish with g; what wear and friction are not there adds nothing."""
    found = force_gradient(replace(SCENE, toughness=0.0), model)
    arc = {"elements": 0.0, "bump": 0.3}[model]
    assert found.wear_strength == pytest.approx(2 * 0.25e-3 * arc)
    assert found.wire_radius == pytest.approx(2 * 7750.0 * arc)
    assert (found.shear_modulus, found.stiffening_exponent) == (0.0, 0.0)
    assert found.toughness == {"elements": np.inf, "bump": 1.0}[model]
    plain = force_gradient(Scene(685.0, 0.0, 0.25e-3), model)
    assert plain.toughness == 1.0


@pytest.mark.parametrize("thing", ["shear_modulus", "wire_radius"])
def test_a_derivative_without_a_limit_is_refused_in_words(thing):
    scene = replace(SCENE, toughness=[1.0, 0.0], **{thing: [1.0, 0.0]})
    with pytest.raises(DomainError, match=r"derivative by .* 0/0 at index \[1\]; give a tough"):
        force_gradient(scene, "eq9")
    with pytest.raises(DomainError, match="0/0"):
        force_gradient(scene, "elements")


@pytest.mark.parametrize("model", [*FORCE_MODELS, "elements"])
@pytest.mark.parametrize("name", NAMES[:5])
@pytest.mark.parametrize("size", [5e-324, 1e-300, 1e300])
def test_numbers_of_any_size_have_a_derivative_or_a_reason(model, name, size):
    scene = replace(SCENE, **{name: size})
    try:
        found = force_gradient(scene, model)
    except DomainError as error:
        assert re.search("derivative by .* 0/0", str(error))  # noqa: PT017 (no error is as good)
    else:
        array = force_gradient(replace(scene, **{name: [size]}), model)
        for each in NAMES:
            assert not np.isnan(getattr(found, each))
            assert getattr(array, each)[0] == getattr(found, each)


def test_what_is_no_scene_model_or_domain_is_refused():
    with pytest.raises(InputError, match="scene must be a Scene"):
        force_gradient(685.0)
    with pytest.raises(InputError, match="eq99"):
        force_gradient(SCENE, "eq99")
    with pytest.raises(DomainError, match="Table 1"):
        force_gradient(replace(SCENE, stiffening_exponent=9.5), "eq9")

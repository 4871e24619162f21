"""The one model that "auto" stands for in slopes, errors, radii and identifications."""

import numpy as np
import pytest
from made_up import truth

from surrogate import (
    AccuracyError,
    DomainError,
    InputError,
    Scene,
    cutting_force,
    force_gradient,
    identify,
    models,
    propagate,
    transition_radius,
)
from surrogate.choosing.accuracy import contact_bounds, contact_std, one_model
from surrogate.scene import NAMES

pytestmark = pytest.mark.usefixtures("installed")

GEL = Scene(685.0, 1.6, [0.1e-3, 0.25e-3, 2e-3], 0.1, 7750.0, 3.0)


def test_it_is_the_first_of_the_listed_ones_that_is_exact_enough(installed):
    listed = {each.name: each.error for each in models() if each.error is not None}
    for rtol in (3.0, *listed.values()):
        expected = next(name for name in ("eq13", *installed.models) if listed[name] <= rtol)
        assert one_model("auto", rtol).name == expected
    assert one_model("gp", 1e-9).name == "gp"


def test_an_accuracy_that_none_has_all_over_is_refused_with_one_that_does():
    with pytest.raises(AccuracyError, match=r"rtol = 1e-06 is not: the best is '(gp|table)'") as e:
        one_model("auto", 1e-6)
    offered = float(str(e.value).partition("give rtol=")[2].partition(" ")[0])
    assert one_model("auto", offered).name in ("table", "gp")
    with pytest.raises(InputError, match="rtol must be"):
        one_model("auto", -0.1)


def test_slopes_are_those_of_that_model_and_of_its_force():
    found = force_gradient(GEL)
    assert found.model == one_model("auto", 0.02).name
    assert found == force_gradient(GEL, found.model)
    step = 1e-6
    for i, name in enumerate(NAMES):
        ends = [list(GEL.values()) for _ in range(2)]
        for end, sign in zip(ends, (1.0, -1.0), strict=True):
            end[i] = np.multiply(end[i], 1.0 + sign * step)
        high, low = (cutting_force(Scene(*end), found.model).total for end in ends)
        expected = (high - low) / (2.0 * step * np.asarray(GEL.values()[i]))
        scale = np.abs(cutting_force(GEL, found.model).total / np.asarray(GEL.values()[i]))
        assert np.max(np.abs(getattr(found, name) - expected) / scale) < 1e-6


def test_slopes_do_not_depend_on_the_company():
    together = force_gradient(GEL)
    for i, radius in enumerate(GEL.wire_radius):
        alone = force_gradient(Scene(685.0, 1.6, float(radius), 0.1, 7750.0, 3.0))
        assert all(getattr(alone, name) == getattr(together, name)[i] for name in NAMES)


@pytest.mark.parametrize("call", [force_gradient, lambda s, **o: propagate(s, {}, **o)])
def test_outside_the_domain_slopes_and_errors_are_refused(call):
    thin = Scene(685.0, 1.6, 1e-7, 0.0, 0.0, 3.0)
    with pytest.raises(DomainError, match=r"g = Gamma_o/\(mu R_w\) must be from"):
        call(thin)
    assert call(thin, extrapolate=True).model == "table"


@pytest.mark.parametrize("model", ["power-law", "table", "gp", "auto"])
def test_the_models_own_error_is_part_of_the_forces(model):
    found = propagate(GEL, {"toughness": 0.1}, model)
    arc, load = contact_std(one_model(model, 0.02), GEL.dimensionless_toughness, 3.0)
    expected = 2.0 * GEL.wire_radius * np.hypot(7750.0 * arc, 0.1 * 685.0 * load)
    np.testing.assert_allclose(found.model_std, expected, rtol=1e-12)
    np.testing.assert_allclose(
        found.std, np.hypot(found.contributions["toughness"], expected), rtol=1e-12
    )
    assert np.all(found.model_std > 0.0)


def test_the_errors_of_the_models_that_know_none_are_within_their_bounds(installed):
    g = np.geomspace(6e-3, 50.0, 60)
    for name in ("power-law", "table"):
        model = installed.models[name]
        exact = truth(g, 3.0)
        values = model.contact(("arc", "normal_load"), g, 3.0)
        for value, true, bound, std in zip(
            values, exact, contact_bounds(model, g, 3.0), contact_std(model, g, 3.0), strict=False
        ):
            assert np.all(np.abs(value / true - 1.0) <= bound)
            np.testing.assert_allclose(std, value * bound / 3.0**0.5, rtol=1e-14)


def test_errors_that_nobody_knows():
    assert contact_bounds(one_model("eq13", 0.02), 1.0, 2.0) is None
    assert contact_std(one_model("eq13", 0.02), 1.0, 2.0) is None
    for name in ("table", "gp"):
        assert np.isnan(contact_std(one_model(name, 0.02), 1e4, 3.0)).all()
    outside = propagate(Scene(685.0, 1.6, 1e-7, 0.0, 10.0), {}, extrapolate=True)
    assert np.isnan(outside.model_std)
    assert np.isnan(outside.std)


def test_radii_and_materials_are_those_of_that_model():
    name = one_model("auto", 0.02).name
    assert np.array_equal(transition_radius(GEL), transition_radius(GEL, name))
    radius = np.array([1e-4, 2e-4, 4e-4, 5e-4])
    force = cutting_force(Scene(685.0, 1.6, radius, 0.1, 7750.0, 3.0), name).total
    options = {"friction_coefficient": 0.1, "stiffening_exponent": 3.0, "force_std": 0.1}
    fit = identify(radius, force, 685.0, **options)
    assert fit.model == name
    assert fit.toughness == pytest.approx(1.6)
    assert fit.wear_strength == pytest.approx(7750.0)
    for call in (
        lambda: identify(radius, force, 685.0, rtol=1e-9),
        lambda: transition_radius(GEL, rtol=1e-9),
    ):
        with pytest.raises(AccuracyError):
            call()


@pytest.mark.parametrize("known", [{}, {"wear_strength": 7750.0}])
@pytest.mark.parametrize("model", ["power-law", "table", "gp"])
def test_the_models_error_is_a_standard_error_within_what_the_bounds_can_do(
    installed, model, known
):
    """An error that may be anything up to its bound has the bound/sqrt(3) as standard deviation.

    Of n wires it moves an estimate by 1/sqrt(3) of the most that the bounds can do where the
    wires share it, and by no less than 1/sqrt(3 n) of it where they do not.
    """
    radius = np.array([1e-4, 2e-4, 4e-4, 5e-4])
    scene = Scene(685.0, 1.6, radius, 0.1, 7750.0, 3.0)
    exact = cutting_force(scene, model)
    options = {"friction_coefficient": 0.1, "stiffening_exponent": 3.0, "model": model, **known}
    fit = identify(radius, exact.total, 685.0, **options)
    bounds = contact_bounds(installed.models[model], scene.dimensionless_toughness, 3.0)
    off = 1e-3 * (exact.wear * bounds[0] + exact.friction * bounds[1])
    moved = []
    for signs in np.ndindex(2, 2, 2, 2):
        other = identify(
            radius, exact.total + (2.0 * np.array(signs) - 1.0) * off, 685.0, **options
        )
        moved.append((other.toughness - fit.toughness, other.wear_strength - fit.wear_strength))
    most = np.abs(moved).max(axis=0) / 1e-3
    least, largest = most / np.sqrt(3.0 * radius.size), most / np.sqrt(3.0)
    assert np.all(0.98 * least <= fit.model_error)
    assert np.all(fit.model_error <= 1.02 * largest)


def test_closed_forms_state_no_error():
    radius = [1e-4, 2e-4, 4e-4]
    assert identify(radius, [4.7, 7.9, 13.9], 685.0, model="eq13").model_error is None
    bounded = identify(radius, [4.7, 7.9, 13.9], 685.0, model="eq13", toughness_max=2.0)
    assert bounded.model_error is None

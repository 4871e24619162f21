"""Prepared forces on arrays of other libraries: array-api-strict, which has no more than the
standard, and jax."""

import boxes
import numpy as np
import pytest

from surrogate import DomainError, InputError, Scene, force_gradient, prepare
from surrogate.prepared.namespaces import SINGLE, SINGLE_COUPLED
from surrogate.scene import NAMES

GEL = boxes.GEL.scene
TISSUE = boxes.TISSUE.scene
VARYING = [*((name,) for name in NAMES), ("wire_radius", "stiffening_exponent"), NAMES]


def of(varying, model="table", **options):
    return prepare(GEL, varying, boxes.GEL.of(varying), model, **options)


def points(varying):
    return boxes.GEL.inner_points(varying)


@pytest.fixture(scope="module")
def strict():
    return pytest.importorskip("array_api_strict")


@pytest.fixture(scope="module")
def jax():
    jax = pytest.importorskip("jax")
    before = jax.config.jax_enable_x64
    jax.config.update("jax_enable_x64", True)
    yield jax
    jax.config.update("jax_enable_x64", before)


@pytest.mark.parametrize("model", ["table", "eq13"])
@pytest.mark.parametrize("varying", VARYING, ids=str)
def test_the_forces_are_those_of_numpy_and_stay_in_the_library(strict, varying, model):
    force, values = of(varying, model), points(varying)
    result = force(*map(strict.asarray, values))
    assert isinstance(result, type(strict.asarray(1.0)))
    np.testing.assert_allclose(np.asarray(result), force(*values), rtol=1e-13)
    single = force(*(strict.asarray(value, dtype=strict.float32) for value in values))
    assert single.dtype == strict.float32
    exact = force(*(value.astype(np.float32).astype(float) for value in values))
    np.testing.assert_allclose(np.asarray(single), exact, rtol=SINGLE)
    beyond = [strict.asarray(np.append(value, 9e9)) for value in values]
    some = np.asarray(force(*beyond, outside="nan"))
    assert (np.isnan(some[-1]), np.isnan(some[:-1]).any()) == (True, False)
    with pytest.raises(DomainError, match=rf"{varying[0]}\[60\] = 9000000000.0"):
        force(*beyond)


def test_they_stay_on_the_device(strict):
    for device in strict.__array_namespace_info__().devices():
        for varying in VARYING:
            values = [
                strict.asarray(value, device=device, dtype=strict.float32)
                for value in points(varying)
            ]
            assert of(varying)(*values).device == device
            assert of(varying)(*values, outside="nan").device == device


def test_kinds_of_arrays(strict):
    force = of(("toughness", "wire_radius"))
    radii = strict.asarray([2e-4, 5e-4])
    expected = force(1.0, np.array([2e-4, 5e-4]))
    numbers = (1.0, 1, np.float64(1.0), np.ones(2), strict.asarray(1), strict.asarray(1.0))
    for one in numbers:
        np.testing.assert_allclose(np.asarray(force(one, radii)), expected, rtol=1e-13)
    assert np.isnan(np.asarray(force(9.0, radii, outside="nan"))).all()
    empty = force(strict.asarray([]), strict.asarray([]), outside="nan")
    assert empty.shape == (0,)
    for bad in (strict.asarray([True, False]), strict.asarray([1.0 + 0.0j])):
        with pytest.raises(InputError, match="must be of float32, float64 or integers"):
            force(bad, bad)
    with pytest.raises(InputError, match="toughness must be a real number"):
        force("one", radii)
    with pytest.raises(InputError, match="out must be left out"):
        force(radii, radii, out=np.empty(2))


def amplified(varying):
    """Return a force under the law "coupled", and values of what varies."""
    force = prepare(TISSUE, varying, boxes.TISSUE.of(varying), law="coupled")
    return force, boxes.TISSUE.inner_points(varying)


@pytest.mark.parametrize("varying", VARYING, ids=str)
def test_coupled_forces_elsewhere(strict, jax, varying):
    force, values = amplified(varying)
    result = force(*map(strict.asarray, values))
    np.testing.assert_allclose(np.asarray(result), force(*values), rtol=1e-13)
    single = force(*(strict.asarray(value, dtype=strict.float32) for value in values))
    exact = force(*(value.astype(np.float32).astype(float) for value in values))
    np.testing.assert_allclose(np.asarray(single), exact, rtol=SINGLE_COUPLED)
    named = dict(zip(NAMES, TISSUE.values(), strict=True)) | dict(zip(varying, values, strict=True))
    slopes = force_gradient(Scene(**named), "table", law="coupled")
    arrays = tuple(map(jax.numpy.asarray, values))
    inside = jax.jit(
        jax.vmap(jax.grad(lambda *at: force(*at, outside="nan"), tuple(range(len(varying)))))
    )
    for name, slope in zip(varying, inside(*arrays), strict=True):
        wanted = getattr(slopes, name)
        scale = np.max(np.abs(wanted))
        # where the other one loses digits, in plain powers of up to 1e6 together
        np.testing.assert_allclose(slope, wanted, rtol=1e-9, atol=1e-10 * scale)


LAWS = [*((varying, "projected") for varying in VARYING), (("wire_radius",), "slip")]


@pytest.mark.parametrize(("varying", "law"), [*LAWS, (NAMES, "slip")], ids=str)
def test_jit_grad_and_vmap_of_jax(jax, varying, law):
    force, values = of(varying, law=law), points(varying)
    named = dict(zip(NAMES, GEL.values(), strict=True)) | dict(zip(varying, values, strict=True))
    scene = Scene(**named)
    arrays = list(map(jax.numpy.asarray, values))

    def inside(*numbers):
        return force(*numbers, outside="nan")

    expected = force(*values)
    for function in (force, jax.jit(inside), jax.jit(jax.vmap(inside))):
        result = function(*arrays)
        assert isinstance(result, jax.Array)
        np.testing.assert_allclose(result, expected, rtol=1e-13)
    slopes = force_gradient(scene, "table", law=law)
    by_position = tuple(range(len(varying)))
    for way in (jax.grad, jax.jacfwd):
        found = jax.jit(jax.vmap(way(inside, by_position)))(*arrays)
        for name, slope in zip(varying, found, strict=True):
            wanted = getattr(slopes, name)
            scale = np.max(np.abs(wanted))
            np.testing.assert_allclose(slope, wanted, rtol=1e-9, atol=1e-12 * scale)


def test_what_is_outside_has_no_derivative_in_jax(jax):
    force = of(("toughness", "wire_radius"))
    for gamma, radius in ((1.0, 9.0), (9.0, 2e-4), (np.nan, 2e-4), (1.0, np.inf), (1.0, -1.0)):
        slopes = jax.grad(lambda *at: force(*at, outside="nan"), (0, 1))(gamma, radius)
        assert np.isnan(slopes).any()
    both = jax.vmap(jax.grad(lambda x: of(("wire_radius",))(x, outside="nan")))
    slopes = np.asarray(both(jax.numpy.asarray([2e-4, 9.0, np.nan])))
    assert np.isnan(slopes).tolist() == [False, True, True]


def test_a_traced_program_of_jax_says_what_it_needs(jax):
    force = of(("wire_radius",))
    with pytest.raises(InputError, match="give outside='nan'"):
        jax.jit(force)(2e-4)
    with pytest.raises(DomainError, match=r"wire_radius\[1\] = 9.0"):
        force(jax.numpy.asarray([2e-4, 9.0]))


def test_jax_without_its_64_bits(jax):
    jax.config.update("jax_enable_x64", False)
    try:
        for varying in VARYING:
            force, values = of(varying), points(varying)
            single = jax.jit(lambda *at, force=force: force(*at, outside="nan"))(*values)
            assert single.dtype == np.float32
            exact = force(*(value.astype(np.float32).astype(float) for value in values))
            np.testing.assert_allclose(single, exact, rtol=SINGLE)
    finally:
        jax.config.update("jax_enable_x64", True)

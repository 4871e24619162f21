"""Scenes: what they hold, derive and refuse."""

import copy
import pickle
from dataclasses import FrozenInstanceError, replace

import numpy as np
import pytest

from surrogate import DomainError, InputError, Scene

GEL = Scene(685.0, 1.6, 0.25e-3, wear_strength=7750.0)


def test_derived_lengths_of_the_gel():
    # Section 4 gives l_e = 3.8 mm with the toughness 2.6 J/m^2 of the pure-shear test.
    assert Scene(685.0, 2.6, 1e-4).elasto_cohesive_length == pytest.approx(3.8e-3, abs=0.05e-3)
    assert GEL.wear_length == pytest.approx(1.6 / 7750.0, rel=1e-15)
    assert GEL.dimensionless_toughness == pytest.approx(1.6 / (685.0 * 0.25e-3), rel=1e-15)


def test_numbers_become_python_floats():
    scene = Scene(np.float32(2.0), 1, np.array(3.0), np.int8(0), wear_strength=np.longdouble(4.0))
    assert [type(value) for value in scene.values()] == [float] * 6
    assert scene.shape == ()


def test_arrays_broadcast_and_are_read_only():
    scene = Scene([[685.0], [1000.0], [2000.0]], 1.6, np.array([1e-4, 2e-4]))
    assert scene.shape == (3, 2)
    assert scene.dimensionless_toughness.shape == (3, 2)
    again = pickle.loads(pickle.dumps(scene))
    for one in (scene, again, copy.copy(scene), copy.deepcopy(scene), replace(scene)):
        for array in (one.shear_modulus, one.wire_radius):
            with pytest.raises(ValueError, match="read-only"):
                array[0] = 1.0


class Lender:
    """An object of another library that lends its own memory."""

    def __init__(self, numbers):
        self.numbers = numbers

    def __array__(self, dtype=None, copy=None):
        return self.numbers


@pytest.mark.parametrize(
    "lent",
    [
        np.asarray,
        memoryview,
        Lender,
        lambda numbers: numbers[:],
        lambda numbers: numbers[::-1],
        lambda numbers: np.broadcast_to(numbers, (2, 3)),
        lambda numbers: np.broadcast_to(numbers[:1], (3,)),
    ],
    ids=["array", "buffer", "lender", "view", "reversed", "broadcast", "one number"],
)
def test_a_scene_stays_as_it_was_when_the_array_changes(lent):
    numbers = np.array([1e-4, 2e-4, 3e-4])
    scene = Scene(685.0, 1.6, lent(numbers))
    before = scene.wire_radius.tolist()
    numbers[:] = 5e-4  # the caller's array stays the caller's
    assert scene.wire_radius.tolist() == before
    assert replace(scene, toughness=2.0).wire_radius is scene.wire_radius


def test_shapes_that_do_not_broadcast_are_named():
    with pytest.raises(InputError, match=r"toughness \(2,\), wire_radius \(3,\)"):
        Scene(685.0, [1.0, 2.0], [1.0, 2.0, 3.0])


def test_scenes_are_frozen():
    with pytest.raises(FrozenInstanceError):
        GEL.toughness = 2.0


def test_scenes_compare_by_value_and_copy():
    again = Scene(685, 1.6, 0.25e-3, 0, 7750)
    assert again == GEL
    assert hash(again) == hash(GEL)
    assert again != replace(GEL, toughness=2.0)
    assert again != "scene"
    arrays = replace(GEL, wire_radius=[1e-4, 2e-4])
    assert arrays == replace(GEL, wire_radius=np.array([1e-4, 2e-4]))
    assert arrays != GEL
    assert pickle.loads(pickle.dumps(arrays)) == copy.deepcopy(arrays) == arrays


def test_ratios_with_a_vanishing_divisor_are_infinite():
    assert Scene(0.0, 1.6, 1e-4).dimensionless_toughness == np.inf
    assert Scene(685.0, 1.6, 0.0).dimensionless_toughness == np.inf
    assert Scene(0.0, 1.6, 1e-4).elasto_cohesive_length == np.inf
    assert Scene(0.0, 1.6, 1e-4).wear_length == np.inf
    assert Scene(685.0, 1.6, [0.0, 1.0]).dimensionless_toughness[0] == np.inf


@pytest.mark.parametrize("toughness", [0.0, [1.0, 0.0]])
@pytest.mark.parametrize("name", ["dimensionless_toughness", "elasto_cohesive_length"])
def test_zero_over_zero_is_refused(name, toughness):
    scene = Scene(0.0, toughness, 1e-4)
    with pytest.raises(DomainError, match=f"{name} .* 0/0"):
        getattr(scene, name)


def test_ratios_survive_intermediate_over_and_underflow():
    assert Scene(1e300, 1e300, 1e300).dimensionless_toughness == pytest.approx(1e-300, rel=1e-15)
    assert Scene(1e-300, 1e-300, 1e-8).dimensionless_toughness == pytest.approx(1e8, rel=1e-15)
    tiny = Scene(np.array([1e-300, 1.0]), 1e-300, 1e-8).dimensionless_toughness
    np.testing.assert_allclose(tiny, [1e8, 1e-292], rtol=1e-15)

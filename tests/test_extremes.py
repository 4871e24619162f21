"""Extreme and hostile input: every public function, every argument, a documented answer each.

Warnings are errors in the tests, so that no answer comes with a bare numpy warning.
"""

import re
from fractions import Fraction
from functools import partial
from itertools import product

import mpmath
import numpy as np
import pytest

import surrogate
from surrogate import InputError, Scene
from surrogate.basics import elementwise

SCENE = {
    "shear_modulus": 685.0,
    "toughness": 1.6,
    "wire_radius": 0.25e-3,
    "friction_coefficient": 0.1,
    "wear_strength": 7750.0,
    "stiffening_exponent": 3.0,
}
FORCE = {name: value for name, value in SCENE.items() if name != "stiffening_exponent"}
DISSIPATION = {"g": 9.0, "alpha": 3.0, "friction_coefficient": 0.1, "relative_wear_strength": 11.0}


def some(*names):
    return {name: SCENE[name] for name in names}


def of_scene(function, **fixed):
    return lambda **quantities: function(Scene(**{**SCENE, **quantities}), **fixed)


def total(model):
    return lambda scene: surrogate.cutting_force(scene, model).total


FUNCTIONS = {
    "far_field_energy_release_rate": (
        surrogate.far_field_energy_release_rate,
        {"relative_distance": 2.0},
    ),
    "power_law_exponent": (surrogate.power_law_exponent, {"stiffening_exponent": 3.0}),
    "power_law_dissipation": (
        surrogate.power_law_dissipation,
        {"g": 9.0, "friction_coefficient": 0.1, "exponent": 1.1},
    ),
    "high_toughness_force": (
        surrogate.high_toughness_force,
        {"toughness": 1.6, "friction_coefficient": 0.1},
    ),
    "low_toughness_dissipation": (
        surrogate.low_toughness_dissipation,
        {"friction_coefficient": 0.1, "relative_wear_strength": 11.0},
    ),
    "low_toughness_force": (surrogate.low_toughness_force, FORCE),
    "general_force": (surrogate.general_force, FORCE),
    "relative_force": (
        surrogate.relative_force,
        {
            "wire_radius": 0.25e-3,
            "elasto_cohesive_length": 2e-3,
            "friction_coefficient": 0.1,
            "relative_wear_strength": 11.0,
        },
    ),
    "friction_free_relative_force": (
        surrogate.friction_free_relative_force,
        {"wire_radius": 0.25e-3, "wear_length": 2e-4},
    ),
    "fracto_cohesive_transition_radius": (
        surrogate.fracto_cohesive_transition_radius,
        {"toughness": 2.6, "work_of_fracture": 7e3},
    ),
    "transition_radius": (
        of_scene(partial(surrogate.transition_radius, model="eq13")),
        some("shear_modulus", "toughness", "friction_coefficient", "wear_strength"),
    ),
    "wear_transition_radius": (
        of_scene(surrogate.wear_transition_radius),
        some("toughness", "wear_strength"),
    ),
    "dimensionless_toughness": (
        of_scene(lambda scene: scene.dimensionless_toughness),
        some("shear_modulus", "toughness", "wire_radius"),
    ),
    "elasto_cohesive_length": (
        of_scene(lambda scene: scene.elasto_cohesive_length),
        some("shear_modulus", "toughness"),
    ),
    "classify": (of_scene(lambda scene: surrogate.classify(scene, model="eq13").dominant), SCENE),
    **{model: (of_scene(total(model)), SCENE) for model in surrogate.FORCE_MODELS},
    **{
        f"dissipative {model}": (
            lambda model=model, **arguments: surrogate.dissipative_force(**arguments, model=model),
            DISSIPATION,
        )
        for model in surrogate.FORCE_MODELS
    },
}
CELLS = [
    pytest.param(function, arguments, name, id=f"{label}-{name}")
    for label, (function, arguments) in FUNCTIONS.items()
    for name in arguments
]
every_cell = pytest.mark.parametrize(("function", "arguments", "name"), CELLS)

REFUSED = {
    "nan": np.nan,
    "negative": -1.0,
    "negative subnormal": -5e-324,
    "minus infinity": -np.inf,
    "bool": True,
    "numpy bool": np.bool_(True),
    "None": None,
    "text": "1.0",
    "bytes": b"1.0",
    "complex": 1.0 + 0j,
    "object": object(),
    "dict": {},
    "huge integer": 10**400,
    "integer without a representation": 10**5000,
    "nan within": [3.0, np.nan, 3.0],
    "negative within": np.array([[3.0, 3.0], [-1.0, 3.0]]),
    "bool array": np.array([True, False]),
    "text array": np.array(["1.0"]),
    "object array": np.array([3.0, None], dtype=object),
    "complex array": np.array([3.0 + 1j]),
    "date": np.datetime64("2024-01-01"),
    "masked array": np.ma.masked_array([3.0, 4.0], mask=[True, False]),
    "unmasked masked array": np.ma.masked_array([3.0, 4.0]),
    "ragged list": [[3.0], [3.0, 4.0]],
    "generator": (x for x in [3.0]),
    "unwilling": type("Unwilling", (), {"__array__": lambda *_, **__: 1 / 0})(),
}


EVEN, SIGNED = (
    ("stiffening_exponent", "alpha"),
    ("negative", "negative subnormal", "negative within"),
)


def answer(function, arguments):
    """Return what a function says as text; None where it refuses."""
    try:
        return str(function(**arguments))
    except InputError:
        return None


@every_cell
def test_the_sign_of_the_exponent_plays_no_part(function, arguments, name):
    if name not in EVEN:
        return
    for value in (REFUSED[kind] for kind in SIGNED):
        with_sign, without = ({**arguments, name: one} for one in (value, np.abs(value)))
        assert answer(function, with_sign) == answer(function, without)


@every_cell
def test_what_is_no_quantity_is_refused_by_name(function, arguments, name):
    for kind, value in REFUSED.items():
        if kind in SIGNED and name in EVEN and answer(function, {**arguments, name: np.abs(value)}):
            continue  # has an answer, that of the number without its sign
        with pytest.raises(InputError) as caught:
            function(**{**arguments, name: value})
        assert re.match(rf"{name} must be .* but {name}.*; .*\.$", str(caught.value)), kind


@every_cell
def test_infinity_is_an_answer_for_lengths_and_distances_only(function, arguments, name):
    call = {**arguments, name: np.inf}
    if name in ("relative_distance", "elasto_cohesive_length", "wear_length"):
        assert np.isfinite(function(**call))
    else:
        with pytest.raises(InputError, match=f"{name} = inf"):
            function(**call)


@every_cell
def test_numbers_of_any_size_have_a_value_or_a_reason(function, arguments, name):
    for size in (0.0, -0.0, 5e-324, 1e-300, 1e-20, 1.0, 1e20, 1e300):
        try:
            value = function(**{**arguments, name: size})
        except InputError as error:
            assert f"{name} = {size!r}" in str(error)  # noqa: PT017 (no error is as good)
        else:
            assert isinstance(value, str) or value >= 0.0, size
            array = function(**{**arguments, name: np.array([size])})
            assert array[0] == value, size


@every_cell
def test_kinds_of_numbers_and_arrays_agree(function, arguments, name):
    expected = function(**{**arguments, name: 3.0})
    for number in (3, np.int8(3), np.float32(3), np.float16(3), np.longdouble(3), np.array(3)):
        value = function(**{**arguments, name: number})
        assert type(value) is type(expected)
        assert value == expected
    threes = np.full(8, 3.0)
    read_only = threes.copy()
    read_only.flags.writeable = False
    kinds = {
        "list": [3] * 8,
        "tuple": (3.0,) * 8,
        "integers": np.full(8, 3),
        "unsigned": np.full(8, 3, dtype=np.uint8),
        "single": threes.astype(np.float32),
        "longdouble": threes.astype(np.longdouble),
        "big-endian": threes.astype(">f8"),
        "read-only": read_only,
        "strided": np.full(16, 3.0)[::2],
        "reversed": threes[::-1],
    }
    for kind, array in kinds.items():
        value = function(**{**arguments, name: array})
        assert value.shape == (8,), kind
        assert (value == expected).all(), kind


@every_cell
def test_shapes(function, arguments, name):
    expected = function(**{**arguments, name: 3.0})
    for shape in ((0,), (2, 0, 3), (1,), (2, 3), (1, 2, 1)):
        value = function(**{**arguments, name: np.full(shape, 3.0)})
        assert value.shape == shape
        assert np.all(value == expected)
    column_major = np.asfortranarray(np.full((3, 4), 3.0))
    assert np.all(function(**{**arguments, name: column_major}) == expected)


@pytest.mark.parametrize("label", FUNCTIONS)
def test_shapes_that_do_not_broadcast_are_refused(label):
    function, arguments = FUNCTIONS[label]
    names = list(arguments)
    if len(names) < 2:
        return
    call = {**arguments, names[0]: [3.0, 3.0], names[1]: [3.0, 3.0, 3.0]}
    with pytest.raises(InputError, match=rf"{names[0]} \(2,\), {names[1]} \(3,\)"):
        function(**call)


@pytest.mark.parametrize(
    "function",
    [
        surrogate.cutting_force,
        surrogate.classify,
        surrogate.transition_radius,
        surrogate.wear_transition_radius,
    ],
)
def test_what_is_no_scene_is_refused_in_one_line(function):
    message = r"^scene must be a Scene, but scene = .{1,99}; give.*$"
    for value in (None, 685.0, "gel", np.zeros((3, 3)), 10**5000):
        with pytest.raises(InputError, match=message):
            function(value)


def test_anything_that_numpy_reads_as_an_array_is_one():
    class Column:
        mask = None

        def __array__(self, dtype=None, copy=None):
            return np.array([1e-4, 2e-4])

    assert Scene(685.0, 1.6, Column()).shape == (2,)


def test_messages_say_what_where_how_much_and_what_to_do():
    with pytest.raises(InputError) as caught:
        Scene(685.0, 1.6, [[1e-4, 2e-4], [-3e-4, np.nan]])
    assert str(caught.value) == (
        "wire_radius must be finite and not negative, but wire_radius[1, 0] = -0.0003 m "
        "(2 of 4 values); give the radius of the wire in metres."
    )


# Accuracy at the extremes, against exact rational arithmetic.

SIZES = [0.0, 5e-324, 1e-300, 1e-20, 1.0, 1.5e20, 1e300]


def rounded(exact):
    try:
        return float(exact)
    except OverflowError:
        return np.inf


def test_general_force_is_accurate_at_every_size():
    gamma, tau = 1e-290, 3e-280
    for mu, radius, xi in product(SIZES, repeat=3):
        exact = Fraction(gamma) * (1 + Fraction(xi)) + 4 * Fraction(radius) * (
            Fraction(xi) * Fraction(mu) + Fraction(tau)
        )
        quantities = (mu, gamma, radius, xi, tau)
        force = surrogate.general_force(*quantities)
        assert force == pytest.approx(rounded(exact), rel=1e-15, abs=0), quantities
        total = surrogate.cutting_force(Scene(*quantities), "eq13").total
        assert total == pytest.approx(force, rel=1e-15, abs=0), quantities
        array = surrogate.general_force(*[np.array([value, 1.0]) for value in quantities])
        assert array[0] == force, quantities


def test_dimensionless_toughness_is_accurate_at_every_size():
    for gamma, mu, radius in product(SIZES, SIZES[1:], SIZES[1:]):
        exact = Fraction(gamma) / (Fraction(mu) * Fraction(radius))
        g = Scene(mu, gamma, radius).dimensionless_toughness
        assert g == pytest.approx(rounded(exact), rel=1e-15, abs=5e-324), (gamma, mu, radius)


def test_transition_radii_are_accurate_at_every_size():
    transition_radius = partial(surrogate.transition_radius, model="eq13")
    for mu, gamma, xi, tau in product(SIZES, SIZES[1:], SIZES, SIZES):
        stress = Fraction(xi) * Fraction(mu) + Fraction(tau)
        scene = Scene(mu, gamma, 1.0, xi, tau)
        quantities = (mu, gamma, xi, tau)
        for function, toughness, wear in (
            (transition_radius, (1 + Fraction(xi)) * Fraction(gamma), stress),
            (surrogate.wear_transition_radius, Fraction(gamma), Fraction(tau)),
        ):
            exact = rounded(toughness / (4 * wear)) if wear else np.inf
            assert function(scene) == pytest.approx(exact, rel=1e-15, abs=5e-324), quantities
        arrays = Scene(*[np.array([value, 1.0]) for value in (mu, gamma, 1.0, xi, tau)])
        assert transition_radius(arrays)[0] == transition_radius(scene)


@pytest.mark.parametrize("alpha", [2.0, 5.0, 9.0])
def test_power_law_is_accurate_at_every_size(alpha):
    for gamma, mu, radius in product(SIZES[2:], repeat=3):
        with mpmath.workdps(50):
            n = mpmath.mpf(surrogate.power_law_exponent(alpha))
            stiffness = mpmath.mpf(mu) * mpmath.mpf(radius)
            exact = float(mpmath.mpf(0.1) * stiffness * (mpmath.mpf(gamma) / stiffness) ** n)
        scene = Scene(mu, gamma, radius, 0.1, stiffening_exponent=alpha)
        friction = surrogate.cutting_force(scene, "eq9").friction
        assert friction == pytest.approx(exact, rel=1e-13, abs=1e-323), (gamma, mu, radius)


# Large arrays, which go another way.


@pytest.mark.parametrize("label", FUNCTIONS)
def test_blocks_change_no_bit(label, monkeypatch):
    function, arguments = FUNCTIONS[label]
    random = np.random.default_rng(3)
    rows, column = random.uniform(2.0, 3.0, (2, 3, 50)), random.uniform(2.0, 3.0, (3, 1))
    shapes = [rows[0], column, rows[1], rows[0, :1, ::-1], rows[1, 0], rows[0].T.copy().T]
    call = dict(zip(arguments, shapes, strict=False))
    at_once = function(**call)
    monkeypatch.setattr(elementwise, "WHOLE", 0)
    monkeypatch.setattr(elementwise, "BLOCK", 16)
    in_blocks = function(**call)
    assert in_blocks.shape == at_once.shape
    np.testing.assert_array_equal(in_blocks, at_once)


def test_blocks_of_real_size():
    radius = np.linspace(1e-4, 5e-4, elementwise.WHOLE + 3)
    force = surrogate.general_force(685.0, 1.6, radius, 0.1, 7750.0)
    for i in (0, elementwise.BLOCK - 1, elementwise.BLOCK, -1):
        assert force[i] == surrogate.general_force(685.0, 1.6, radius[i], 0.1, 7750.0)

"""The design against brute force and against experiments that use it."""

import itertools
from functools import partial

import numpy as np
import pytest

import surrogate
from surrogate import Scene
from surrogate.errors import InputError
from surrogate.identification.experiment_design import design_radii

identify = partial(surrogate.identify, model="eq13")

PAPER_RADII = np.array([0.125e-3, 0.210e-3, 0.275e-3, 0.390e-3, 0.470e-3])
EXPECTED = Scene(685.0, 1.6, 1.0, 0.1, 7750.0)
NOISES = [{"force_std": 0.5}, {"relative_force_std": 0.05, "expected": EXPECTED}]


@pytest.mark.parametrize("noise", NOISES)
@pytest.mark.parametrize("goal", ["both", "toughness", "wear_strength"])
def test_no_choice_of_five_among_seven_radii_is_better(goal, noise):
    best = design_radii(1e-4, 5e-4, 5, goal=goal, line_test_cuts=0, **noise)
    radii = itertools.combinations_with_replacement(np.linspace(1e-4, 5e-4, 7), 5)
    for other in radii:
        if len(set(other)) > 1:
            assert loss(goal, best.noise, other) >= loss(goal, best.noise, best.wire_radius) * (
                1 - 1e-12
            )


def loss(goal, noise, radius):
    """Straight from the normal equations."""
    radius = np.asarray(radius)
    columns = np.stack([np.ones(radius.size), radius / 1e-4], axis=1)
    columns /= noise.std(radius)[:, np.newaxis]
    covariance = np.linalg.inv(columns.T @ columns)
    return {
        "both": np.linalg.det(covariance),
        "toughness": covariance[0, 0],
        "wear_strength": covariance[1, 1],
    }[goal]


@pytest.mark.parametrize("noise", NOISES)
def test_promised_errors_are_those_of_an_identification(noise):
    design = design_radii(1e-4, 5e-4, 6, **noise)
    std = design.noise.std(design.wire_radius)
    friction = 0.1 if "expected" in noise else 0.0
    fit = identify(
        design.wire_radius,
        1.6 + 31e3 * design.wire_radius,
        685.0,
        force_std=std,
        friction_coefficient=friction,
    )
    assert design.toughness_std == pytest.approx(fit.toughness_std, rel=1e-12)
    assert design.wear_strength_std == pytest.approx(fit.wear_strength_std, rel=1e-12)


def test_the_middle_radius_tests_the_line():
    design = design_radii(1e-4, 5e-4, 7, force_std=1.0, line_test_cuts=3)
    assert np.count_nonzero(np.isclose(design.wire_radius, 3e-4)) == 3
    assert np.unique(design_radii(1e-4, 5e-4, 7, force_std=1.0).wire_radius).size == 3


def test_gain_over_itself_is_one_and_a_wider_range_is_better():
    design = design_radii(1e-4, 5e-4, 6, force_std=0.3)
    assert design.gain_over(design.wire_radius) == (1.0, 1.0)
    wider = design_radii(0.5e-4, 10e-4, 6, force_std=0.3)
    assert min(wider.gain_over(design.wire_radius)) > 1.0


def test_gain_does_not_depend_on_the_size_of_the_scatter():
    gains = [
        design_radii(1e-4, 5e-4, 5, force_std=std).gain_over(PAPER_RADII) for std in (0.1, 10.0)
    ]
    assert gains[0] == pytest.approx(gains[1], rel=1e-12)


@pytest.mark.parametrize(
    ("arguments", "options", "words"),
    [
        ((1e-4, 5e-4), {}, "exactly one of force_std"),
        ((1e-4, 5e-4), {"force_std": 1.0, "relative_force_std": 0.1}, "exactly one of force_std"),
        ((1e-4, 5e-4), {"relative_force_std": 0.1}, "needs expected"),
        ((5e-4, 1e-4), {"force_std": 1.0}, "the smaller one first"),
        ((1e-4, 1e-4), {"force_std": 1.0}, "is empty"),
        ((0.0, 1e-4), {"force_std": 1.0}, "wire_radius must be"),
        ((1e-4, 5e-4, 2), {"force_std": 1.0}, "leaves 1 for the ends"),
        ((1e-4, 5e-4, 5), {"force_std": 1.0, "line_test_cuts": -1}, "change either number"),
        ((1e-4, 5e-4, 10**9), {"force_std": 1.0}, "the most"),
        ((1e-4, 5e-4), {"force_std": 0.0}, "force_std must be"),
        ((1e-4, 5e-4), {"force_std": 1.0, "goal": "speed"}, "choose one of both"),
        ((1e-4, 5e-4), {"force_std": 1.0, "goal": ["both"]}, "choose one of both"),
        ((1e-4, 5e-4, 5.0), {"force_std": 1.0}, "cuts must be a whole number, but cuts = 5.0"),
        ((1e-4, 5e-4, True), {"force_std": 1.0}, "cuts must be a whole number"),
        ((1e-4, 5e-4), {"force_std": 1.0, "line_test_cuts": None}, "line_test_cuts must be a"),
        ((1e-4, 5e-4), {"force_std": 1.0, "expected": 685.0}, "expected must be a Scene"),
        (
            (1e-4, 5e-4),
            {"force_std": 1.0, "expected": Scene(685.0, 1.0, 1.0, [0.1, 0.2])},
            "one material",
        ),
        (
            (1e-4, 5e-4),
            {"relative_force_std": 0.1, "expected": Scene(685.0, [1.0, 2.0], 1.0)},
            "one material",
        ),
    ],
)
def test_bad_input_is_refused_in_words(arguments, options, words):
    with pytest.raises(InputError) as caught:
        design_radii(*arguments, **options)
    assert words in str(caught.value)


def test_gain_over_a_table_of_radii_is_refused():
    with pytest.raises(InputError, match="one number a cut"):
        design_radii(1e-4, 5e-4, force_std=1.0).gain_over([PAPER_RADII, PAPER_RADII])


def test_gain_over_one_radius_is_refused():
    design = design_radii(1e-4, 5e-4, force_std=1.0)
    with pytest.raises(InputError, match="at least two"):
        design.gain_over([1e-4, 1e-4])

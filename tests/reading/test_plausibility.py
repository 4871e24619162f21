"""Gross slips of units are said in words, and sound experiments are not doubted."""

from functools import partial

import numpy as np
import pytest

import surrogate
from surrogate import read_material, read_measurements
from surrogate.basics.files import model_file
from surrogate.reading import plausibility
from surrogate.reading.plausibility import Plausible, doubts

identify = partial(surrogate.identify, model="eq13")

RADII = np.array([0.125e-3, 0.21e-3, 0.275e-3, 0.39e-3, 0.47e-3])  # m, of the paper
FORCES = 1.6 + 31e3 * RADII + 0.01 * np.array([1.0, -2.0, 1.0, 1.0, -1.0])
QUANTITIES = [one for one in vars(plausibility).values() if isinstance(one, Plausible)]


def doubted(fit):
    return [sentence for sentence in fit.warnings if "hardly that" in sentence]


@pytest.mark.parametrize("quantity", QUANTITIES, ids=lambda one: one.words)
def test_the_ends_of_the_range_are_believed_and_nothing_beyond(quantity):
    assert list(doubts(quantity, [quantity.low, quantity.high])) == []
    assert len(list(doubts(quantity, np.nextafter(quantity.high, np.inf)))) == 1
    assert len(list(doubts(quantity, [quantity.low, 1.1 * quantity.high]))) == 1
    if quantity.low:
        assert len(list(doubts(quantity, np.nextafter(quantity.low, 0.0)))) == 1


@pytest.mark.parametrize("quantity", QUANTITIES, ids=lambda one: one.words)
def test_the_slip_named_is_one_that_explains_all_numbers(quantity):
    middle = np.sqrt(max(quantity.low, 1e-6) * quantity.high)
    for factor, words in quantity.slips:
        values = np.array([0.5, 2.0]) * middle / factor
        for sentence in doubts(quantity, values):
            named = [f for f, w in quantity.slips if f"likely {w}:" in sentence]
            assert len(named) == 1
            assert np.all(
                (named[0] * values >= quantity.low) & (named[0] * values <= quantity.high)
            )
            assert f"{values[0]:.4g} to {values[1]:.4g} {quantity.unit}" in sentence, words
    huge = list(doubts(quantity, [max(quantity.low, 1e-9), 1e30]))
    assert "likely" not in huge[0]


def test_sound_experiments_are_not_doubted():
    assert doubted(identify(RADII, FORCES, 685.0)) == []
    assert doubted(identify(RADII, FORCES, 685.0, toughness_max=2.6, force_std=0.1)) == []
    assert doubted(identify(RADII, FORCES, 685.0, wear_strength=0.0)) == []


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"wire_radius": 1e3 * RADII}, "the wire radius (0.125 to 0.47 m) is hardly"),
        ({"wire_radius": 1e3 * RADII}, "likely mm given as m"),
        ({"wire_radius": 1e6 * RADII}, "likely um given as m"),
        ({"wire_radius": 1e-3 * RADII}, "likely m given as mm"),
        ({"wire_radius": None, "wire_diameter": 2e3 * RADII}, "likely mm given as m"),
        ({"force": 1e6 * FORCES}, "the force per thickness"),
        ({"shear_modulus": 0.685}, "likely kPa given as Pa"),
        ({"shear_modulus": 1.5}, "elasto-cohesive length Gamma_o/mu"),
        ({"wear_strength": 7750e6}, "the wear strength (7.75e+09 Pa)"),
        ({"toughness_max": 2.6e9}, "the toughness (2.6e+09 J/m^2)"),
    ],
)
def test_gross_slips_are_said_once(change, words):
    given = {"wire_radius": RADII, "force": FORCES, "shear_modulus": 685.0}
    said = doubted(identify(**{**given, **change}))
    assert sum(words in sentence for sentence in said) == 1


@pytest.mark.parametrize("radius", np.geomspace(1.001e-5, 0.999e-3, 9))
@pytest.mark.parametrize("factor", [1e3, 1e-3, 1e6, 1e-6])
def test_every_usual_wire_is_doubted_where_it_is_off_by_a_thousand(radius, factor):
    assert len(list(doubts(plausibility.RADIUS, factor * radius))) == 1
    assert list(doubts(plausibility.RADIUS, radius)) == []


def test_what_the_forces_hardly_determine_is_not_doubted():
    noisy = FORCES + 3.0 * np.array([1.0, -1.0, 1.0, -1.0, 1.0])
    fit = identify(RADII, noisy, 2.0)
    assert 0.0 < fit.toughness < fit.toughness_std
    assert doubted(fit) == []


def test_a_diameter_given_as_the_radius_cannot_be_told():
    """Which the documentation says: Gamma_o is the same and tau_w half."""
    right, wrong = identify(RADII, FORCES, 685.0), identify(2.0 * RADII, FORCES, 685.0)
    assert wrong.toughness == pytest.approx(right.toughness)
    assert wrong.wear_strength == pytest.approx(0.5 * right.wear_strength)
    assert doubted(wrong) == []


def test_files_say_it_too(tmp_path):
    assert read_measurements(model_file("paam-wire-cutting.csv")).warnings == ()
    assert read_material(model_file("paam-material.json")).warnings == ()
    table = tmp_path / "cuts.csv"
    table.write_text("wire_diameter_m,force_per_thickness_kN_per_m\n0.2,4700\n0.8,13700\n")
    radius, force = read_measurements(table).warnings
    assert "(0.1 to 0.4 m)" in radius
    assert "likely mm given as m" in radius
    assert "(4.7e+06 to 1.37e+07 N/m)" in force
    material = tmp_path / "gel.json"
    material.write_text('{"schema": "wirecut-material-1", "shear_modulus_kPa": 685e-6}')
    (modulus,) = read_material(material).warnings
    assert "likely kPa given as Pa" in modulus

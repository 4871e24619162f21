"""Quantities of pint are accepted wherever numbers are, and cost nothing where pint is not used."""

import subprocess
import sys

import numpy as np
import pytest

from surrogate import (
    InputError,
    MapPoints,
    Scene,
    cutting_force,
    fracto_cohesive_transition_radius,
    general_force,
    identify,
    regime_map,
)
from surrogate.identification.curves import write_curve
from surrogate.maps.points import places

pint = pytest.importorskip("pint")
u = pint.UnitRegistry()


def test_a_scene_in_any_units():
    scene = Scene(
        shear_modulus=0.685 * u.kPa,
        toughness=1.6 * u.N / u.m,
        wire_radius=[125, 210] * u.um,
        wear_strength=7.75e3 * u.J / u.m**3,
        friction_coefficient=10 * u.percent,
    )
    expected = Scene(685.0, 1.6, [125e-6, 210e-6], 0.1, 7750.0)
    np.testing.assert_allclose(cutting_force(scene).total, cutting_force(expected).total, 1e-15)
    assert type(scene.shear_modulus) is float


def test_lists_of_quantities_and_mixed_with_numbers_in_si():
    scene = Scene(685.0, 1.6, [0.125 * u.mm, 210 * u.um, 3e-4])
    np.testing.assert_allclose(scene.wire_radius, [1.25e-4, 2.1e-4, 3e-4], rtol=1e-15)


def test_equations_identification_and_maps():
    force = general_force(685 * u.Pa, 1.6, 0.25 * u.mm, 0.1, 7.75 * u.kPa)
    assert force == pytest.approx(general_force(685.0, 1.6, 0.25e-3, 0.1, 7750.0), rel=1e-15)
    radius = fracto_cohesive_transition_radius(2.6 * u.J / u.m**2, 6.973 * u.kJ / u.m**3)
    assert radius == pytest.approx(9.3217e-5, rel=1e-4)
    fit = identify([0.1, 0.2, 0.4] * u.mm, [4.7, 7.9, 13.9] * u.N / u.m, 0.685 * u.kPa)
    plain = identify([1e-4, 2e-4, 4e-4], [4.7, 7.9, 13.9], 685.0)
    assert fit.toughness == pytest.approx(plain.toughness, rel=1e-12)
    made = regime_map("R_w", "g", ((1 * u.um, 1 * u.mm), (1, 10)), {"mu": 1 * u.kPa}, nodes=3)
    np.testing.assert_allclose(made.x.values[[0, -1]], [1e-6, 1e-3], rtol=1e-15)


def test_error_bars_on_maps_and_the_radii_of_exported_curves(tmp_path):
    scene = Scene(0.685 * u.kPa, 1.6, 0.2 * u.mm, wear_strength=7750.0)
    made = regime_map("R_w", "Gamma_o", ((1e-5, 1e-2), (0.1, 9)), {"mu": 685, "tau_w": 7750})
    std = {"toughness": 200 * u.mJ / u.m**2, "wire_radius": [10] * u.um}
    error = places(MapPoints(scene, "PAAm", std), made)[1]
    np.testing.assert_allclose(error, [[1e-5], [0.2]], rtol=1e-12)
    with pytest.raises(InputError, match="standard error of toughness must be a quantity in J/m"):
        MapPoints(scene, "PAAm", {"toughness": 0.2 * u.Pa})
    fit = identify([0.1, 0.2, 0.4] * u.mm, [4.7, 7.9, 13.9] * u.N / u.m, 0.685 * u.kPa)
    write_curve(fit, tmp_path / "curve.csv", [0.1, 0.2] * u.mm)
    lines = (tmp_path / "curve.csv").read_text().splitlines()[-2:]
    assert [float(line.split(",")[0]) for line in lines] == pytest.approx([1e-4, 2e-4], rel=1e-12)


@pytest.mark.parametrize(
    ("value", "words"),
    [
        (1.6 * u.Pa, "toughness must be a quantity in J/m^2, but is in pascal"),
        (1.6 * u.dimensionless, "but is in dimensionless"),
        ([1.6 * u.m], "but is in meter"),
        (-1.6 * u.J / u.m**2, "not negative"),
        (float("nan") * u.J / u.m**2, "finite"),
        ("1.6 J/m2", "real number"),
    ],
)
def test_another_dimension_is_refused_in_words(value, words):
    with pytest.raises(InputError, match=words.replace("^", r"\^")):
        Scene(685.0, value, 1e-4)
    with pytest.raises(InputError, match="a number without unit, but is in millimeter"):
        Scene(685.0, 1.6, 1e-4, friction_coefficient=1 * u.mm)


def test_nothing_loads_pint():
    code = "import sys, surrogate; surrogate.Scene(1, [1, 2], 1); print('pint' in sys.modules)"
    command = [sys.executable, "-c", code]
    assert subprocess.run(command, capture_output=True, text=True, check=True).stdout == "False\n"

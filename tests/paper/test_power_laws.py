"""The comparison with the paper: fits of known laws, tables, blocks of finite height."""

import dataclasses
import math
from pathlib import Path

import numpy as np
import pytest

from fe_training.paper import tables as tables
from fe_training.paper.curve import Curve
from fe_training.paper.power_laws import (
    eq13_error,
    fit_power,
    local_exponent,
    over_lower_end,
    reached_from,
)
from fe_training.paper.specimen import (
    Case,
    Result,
    add_result,
    block_table,
    cases,
    evidence,
    read_results,
    size_table,
)
from surrogate import Scene, cutting_force
from surrogate.basics.files import checksum_line, model_file
from surrogate.errors import InputError


def test_a_power_law_is_found_with_and_without_its_prefactor():
    g = np.geomspace(5.0, 100.0, 9)
    free = fit_power(g, 0.6 * g**1.18)
    assert (free.exponent, free.prefactor) == pytest.approx((1.18, 0.6))
    assert free.r_squared == pytest.approx(1.0)
    assert free.largest_error < 1e-12
    bound = fit_power(g, 0.6 * g**1.18, unit_prefactor=True)
    x, y = np.log(g), np.log(0.6) + 1.18 * np.log(g)
    assert bound.exponent == pytest.approx(float(np.linalg.lstsq(x[:, None], y, rcond=None)[0][0]))
    assert bound.prefactor == 1.0
    assert bound.r_squared < 1.0
    assert bound.largest_error == pytest.approx(
        np.abs(g**bound.exponent / (0.6 * g**1.18) - 1).max()
    )


def test_r_squared_is_that_of_the_logarithms():
    x, y = np.array([1.0, 2.0, 4.0, 8.0]), np.array([1.0, 3.0, 3.5, 9.0])
    assert fit_power(x, y).r_squared == pytest.approx(np.corrcoef(np.log(x), np.log(y))[0, 1] ** 2)


@pytest.mark.parametrize(
    ("x", "y"), [([1, 2], [1, 2]), ([1, 2, 0], [1, 2, 3]), ([1, 2, 3], [1, -2, 3])]
)
def test_what_cannot_be_fitted_is_refused(x, y):
    with pytest.raises(InputError, match="three positive points"):
        fit_power(x, y)


def test_the_local_exponent_of_a_changing_law():
    x = np.geomspace(0.1, 10.0, 400)
    found = local_exponent(x, 1.0 / (1.0 + x**2))
    assert found == pytest.approx(-2 * x**2 / (1 + x**2), abs=2e-3)


def test_the_error_of_eq13_is_that_of_the_force_models():
    g, A, B, xi, ratio = 7.0, 1.5, 4.0, 0.3, 2.0
    scene = Scene(1.0, g, 1.0, xi, ratio * xi)
    truth = g + 2.0 * (ratio * xi * A + xi * B)
    assert eq13_error(g, A, B, xi, ratio) == pytest.approx(
        cutting_force(scene, model="eq13").total / truth - 1
    )


def test_the_size_from_which_a_limit_holds():
    H = np.geomspace(5.0, 1000.0, 8)
    assert reached_from(H, 1 + 2.0 / H, 1.0, 0.05) == pytest.approx(40.0)
    assert reached_from(H, 3 - 3 * 2.0 / H, 3.0, 0.05) == pytest.approx(40.0)
    assert reached_from(H, np.full(8, 1.04), 1.0, 0.05) == 5.0
    assert math.isinf(reached_from(H, 1 + 2.0 / H, 1.0, 1e-3))


def specimens(file):
    """Write made-up results: B of blocks off by +-delta/H, J = 1/delta^2 where H is 20."""
    for side, height in (
        ("none", math.inf),
        *((s, h) for s in ("rollers", "free") for h in (20.0, 200.0, 2000.0)),
    ):
        for delta in (1.2, 2.0, 5.0, 10.0, 14.0):
            sign = {"none": 0, "rollers": 1, "free": -1}[side]
            off = 1 + sign * delta / height if sign else 1.0
            J = delta**-2 if height == 20.0 else delta**-1.5 * off
            add_result(
                file,
                Result(
                    Case(2.0, height, side, 2.0 * delta),
                    J,
                    delta,
                    1.2,
                    1.5 * off,
                    1e-4,
                    9,
                    "CONVERGED",
                ),
            )


@pytest.fixture
def blocks(tmp_path):
    """Made-up results of the study of specimens."""
    specimens(tmp_path / "specimens.csv")
    return read_results(tmp_path / "specimens.csv")


def cells(table):
    return [[cell.strip() for cell in line.split("|")[1:-1]] for line in table.splitlines()[2:]]


def test_the_exponents_of_blocks(blocks):
    found = {(row[1], row[2]): row for row in cells(block_table(blocks, (2.0,)))}
    assert float(found["20", "rollers"][4]) == pytest.approx(-2.0)
    assert float(found["-", "large body"][4]) == pytest.approx(-1.5)
    # "by reference" takes the distance before deformation, 2 delta in these results
    assert float(found["20", "free"][6]) == pytest.approx(-2.0)
    assert found["20", "rollers"][7] == "1.20 to 1.20"


def test_the_size_from_which_a_block_is_large(blocks):
    found = {row[0]: row[1:] for row in cells(size_table(blocks, 2.0))}
    assert found["A at g = 0.1"] == ["up from 20"] * 4
    # J is off by delta/H in blocks of 200 and 2000
    assert float(found["J at delta = 10"][1]) == pytest.approx(1000.0, rel=0.1)


def test_the_evidence_in_words(blocks):
    worst = dataclasses.replace(blocks[4], force_mismatch=0.02)
    lost = dataclasses.replace(blocks[1], energy_release_rate=math.nan)
    text = evidence([worst, lost, *blocks[2:4]])
    assert text.startswith("3 of 4 cases were reached.")
    assert "largest is 0.02, in the large body" in text


def test_a_curve_interpolates_only_inside_its_points():
    g = np.array([1.0, 10.0, 100.0])
    one = Curve(2.0, g, g, g, np.array([1.5, 1.0, 1.0]))
    assert one.at(np.log(g), 10.0**0.5) == pytest.approx(0.5 * np.log(10.0))
    assert one.at(g, 100.0 * (1 + 1e-12)) == 100.0
    assert math.isnan(one.at(g, 0.9))
    assert math.isnan(one.at(g, 101.0))
    assert one.far.tolist() == [True, False, False]


def test_the_tables_say_what_the_numbers_say():
    g = np.geomspace(0.0025, 100.0, 60)
    law = Curve(2.0, g, np.full(60, 2.0), 2.0 + g / 2.0, np.geomspace(50.0, 1.0, 60))
    (row,) = cells(tables.plateau_table([law]))
    assert row[1:3] == ["2.00", "2.00"]  # A and B at g = 0.0025
    assert row[7:9] == ["2.00", "2.50"]  # and at 1
    for row in cells(tables.eq13_table([law])):  # Eq. (13) is its own truth
        assert row[2].startswith("+0 %")
        assert row[3].startswith("+0 %")
        assert row[4] == "0 %"
    half = Curve(9.0, g, g, 0.5 * g**0.96, law.distance)
    for row in cells(tables.exponent_table([half])):
        assert row[2:6] == ["0.96", "0.96", "1.00", "1.000"]
        assert row[7] == "0.96"
    local = cells(tables.local_table([half]))[0]
    assert local[1] == "0.96, 1.00"
    assert local[-1] == f"0.96, {90**-0.04:.2f}"


def test_fits_of_table_1_over_their_lower_end():
    g = np.geomspace(0.1, 100.0, 30)
    one = Curve(5.0, g, g, 0.3 * g**1.06, g)
    lower, n = over_lower_end(one, False)
    assert lower[0] >= 1.0
    assert lower[-1] == pytest.approx(g[-3])
    assert n == pytest.approx(np.full(n.size, 1.06))
    assert np.all(over_lower_end(one, True)[1] < 1.06)  # 2 C = 0.6 pulls n down where C is 1


def test_the_shipped_study_is_whole_and_has_every_case():
    file = model_file("specimens.csv")
    results = read_results(Path(file))
    assert {one.case for one in results} == set(cases())
    expected = Path(f"{file}.sha256").read_bytes()
    assert checksum_line("specimens.csv", Path(file).read_bytes()) == expected

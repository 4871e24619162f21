"""The comparison with the paper: fits of known laws, and the script's page and pictures."""

import math
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from fake_engine import run

from fe_training.comparison import eq13_error, fit_power, local_exponent, reached_from
from fe_training.dataset import write_campaign
from fe_training.errors import InputError
from fe_training.specimen import Case, Result, add_result
from surrogate import Scene, cutting_force

ROOT = Path(__file__).resolve().parent.parent.parent


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
    assert eq13_error(g, A, B, xi, ratio) == pytest.approx(cutting_force(scene).total / truth - 1)


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
                    Case(2.0, height, side, delta), J, delta, 1.2, 1.5 * off, 1e-4, 9, "CONVERGED"
                ),
            )


NAMES = ("distance", "plateau", "exponents", "local exponents", "eq13", "blocks", "sizes")


def test_the_page_and_its_pictures(small, tmp_path):
    write_campaign(tmp_path / "campaign.h5", small, run(small, tmp_path / "store"))
    specimens(tmp_path / "specimens.csv")
    page = tmp_path / "page.md"
    page.write_text("\n".join(f"# {n}\n<!-- {n}: begin -->\nold\n<!-- {n}: end -->" for n in NAMES))
    options = [
        *("--data", tmp_path / "campaign.h5", "--specimens", tmp_path / "specimens.csv"),
        *("--page", page, "--figures", tmp_path / "fig"),
    ]
    command = [sys.executable, "-W", "error", "scripts/compare-paper", *map(str, options)]
    subprocess.run(command, cwd=ROOT, check=True)
    text = page.read_text()
    assert "old" not in text
    # the exponents of the made-up blocks, and 5 % of B from H = 20 delta on
    assert re.search(r"\| 20 \| rollers \|[^|]*\| -2\.00 \|", text)
    assert re.search(r"\| inf \| none \|[^|]*\| -1\.50 \|", text)
    # 2B = 4 + 0.6 g of the made-up engine at g = 1 ... 10
    assert re.search(r"\| 2 \| 1 to 100 \| 1\.18 \| 0\.\d+ \|", text)
    assert {f.name for f in (tmp_path / "fig").iterdir()} == {
        f"comparison-{n}.png" for n in ("distance", "contact", "friction", "eq13", "specimens")
    }

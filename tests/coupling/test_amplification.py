"""kappa: what it is where it is known and where not, its slopes, its file."""

from dataclasses import replace

import numpy as np
import pytest

from surrogate import InputError
from surrogate.contact.archive import read_fitted
from surrogate.coupling.polynomial import Polynomial
from surrogate.coupling.shipped import (
    AMPLIFICATION_FILE,
    amplification,
    amplification_of,
    content_of_amplification,
)

RNG = np.random.default_rng(5)


def places(kappa, count=200):
    """Return loads of which most are known."""
    x = RNG.uniform(-9.0, 0.0, count)
    alpha = RNG.uniform(2.0, 9.0, count)
    g = np.exp(x + np.polynomial.polynomial.polyval(np.log(alpha), kappa.touch))
    return g, alpha, RNG.uniform(0.0, 0.08, count), RNG.uniform(0.0, 1.5, count)


def test_a_polynomial_is_the_sum_of_its_terms():
    powers = np.array(
        [(a, b, c, d) for a in range(3) for b in range(2) for c in (0, 2) for d in (1, 3)]
    )
    coefficients = RNG.normal(size=len(powers))
    at = RNG.normal(size=(4, 50))
    terms = np.prod(at.T[:, None, :] ** powers, axis=2)
    made = Polynomial(powers, coefficients)
    assert made(*at) == pytest.approx(terms @ coefficients, rel=1e-12)
    assert [made(*column) for column in at.T.tolist()] == made(*at).tolist()
    for floats in range(16):  # some of them numbers, the others arrays
        mixed = [float(row[0]) if floats >> i & 1 else row for i, row in enumerate(at)]
        whole = [np.full(50, each) if isinstance(each, float) else each for each in mixed]
        assert np.array_equal(np.full(50, made(*mixed)), made(*whole))
    for i, derivative in enumerate(made.derivatives):
        up, down = at.copy(), at.copy()
        up[i] += 1e-6
        down[i] -= 1e-6
        slope = (made(*up) - made(*down)) / 2e-6
        assert derivative(*at) == pytest.approx(slope, rel=1e-6, abs=1e-8)


def test_kappa_is_one_without_load_wherever(coupled):
    for g in (0.0, 5e-324, 1.0, 1e300, np.inf):
        assert coupled.log_factor(g, 3.0, 0.0, 0.0) == 0.0
        assert coupled.share(g, 3.0, 0.0, 0.0) == 0.0


def test_numbers_and_arrays_agree_to_the_last_bit(coupled):
    at = places(coupled)
    together = coupled.log_factor(*at), coupled.share(*at), coupled.error(*at), coupled.most(*at)
    alone = [
        [method(*(float(v) for v in row)) for row in zip(*at, strict=True)]
        for method in (coupled.log_factor, coupled.share, coupled.error, coupled.most)
    ]
    for many, single in zip(together, alone, strict=True):
        assert np.array_equal(many, np.array(single), equal_nan=True)


def test_beyond_the_known_loads_kappa_is_that_of_the_nearest_of_the_same_direction(coupled):
    g, alpha, xi, wear = 1e-3, 3.0, 0.02, 0.4
    reach = 1.0 / coupled.share(g, alpha, xi, wear)
    edge = coupled.log_factor(g, alpha, xi * reach, wear * reach)
    for factor in (1.5, 1e3, 1e300):
        assert coupled.log_factor(g, alpha, xi * reach * factor, wear * reach * factor) == (
            pytest.approx(edge, rel=1e-12)
        )
        assert np.isnan(coupled.error(g, alpha, xi * reach * factor, wear * reach * factor))


@pytest.mark.parametrize("value", [0.0, 5e-324, 1e300, np.inf, np.nan])
@pytest.mark.parametrize("place", range(4))
def test_extremes_have_an_answer_without_a_warning(coupled, value, place):
    at = [1e-2, 3.0, 0.01, 0.2]
    at[place] = value
    factor, share = coupled.log_factor(*at), coupled.share(*at)
    with np.errstate(all="ignore"):  # under which every kernel is evaluated
        many = coupled.log_factor(*(np.array([each, each]) for each in at))
    assert np.array_equal(many, [factor, factor], equal_nan=True)
    if place == 1:  # no solid has such an exponent
        return
    assert np.isfinite(factor) or np.isnan(value)
    if np.isnan(value):
        assert not share <= 1.0


@pytest.mark.parametrize("variable", range(4))
def test_slopes_are_those_of_the_factor(coupled, variable):
    at = [
        each[coupled.share(*places_at) < 0.9][:20]
        for places_at in [places(coupled)]
        for each in places_at
    ]
    step = 1e-6
    up, down = list(at), list(at)
    up[variable], down[variable] = at[variable] * (1 + step), at[variable] * (1 - step)
    change = (coupled.log_factor(*up) - coupled.log_factor(*down)) / (2 * step)
    slopes = list(coupled.slopes(*at))
    slopes[2], slopes[3] = slopes[2] * at[2], slopes[3] * at[3]  # the first two are by logarithms
    assert slopes[variable] == pytest.approx(change, rel=1e-5, abs=1e-8)


def test_the_file_gives_back_the_same_numbers(coupled):
    read = amplification()
    at = places(coupled)
    assert np.array_equal(read.log_factor(*at), coupled.log_factor(*at))
    assert content_of_amplification(read) == content_of_amplification(coupled)


@pytest.mark.parametrize(
    "change",
    [
        {"reach": np.ones((2, 2, 2))},
        {"reach": -np.ones((4, 3, 5))},
        {"errors": np.ones((3, 1))},
        {"polynomial": Polynomial(np.array([[1, 0, 0, 0]]), np.ones(1))},
        {"polynomial": Polynomial(np.array([[1, 0, 1]]), np.ones(1))},
    ],
)
def test_a_file_with_other_shapes_or_a_kappa_without_load_is_refused(coupled, tmp_path, change):
    from surrogate.basics.files import checksum_line

    content = content_of_amplification(replace(coupled, **change))
    file = tmp_path / AMPLIFICATION_FILE
    file.write_bytes(content)
    (tmp_path / f"{AMPLIFICATION_FILE}.sha256").write_bytes(checksum_line(file.name, content))
    with pytest.raises(InputError, match="must be complete"):
        amplification_of(*read_fitted(str(file)))


def test_a_polynomial_of_some_of_its_variables_and_about_a_center():
    powers = np.array([(a, b, c) for a in range(3) for b in range(4) for c in (0, 1)])
    whole = Polynomial(powers, RNG.normal(size=len(powers)))
    x, y, z = RNG.normal(size=(3, 20))
    assert whole.collapsed((None, 0.7, None))(x, z) == pytest.approx(whole(x, 0.7, z), rel=1e-12)
    assert whole.collapsed((0.3, None, -2.0))(y) == pytest.approx(whole(0.3, y, -2.0), rel=1e-12)
    moved = whole.about([0.5, -1.0, 2.0])
    assert moved(x - 0.5, y + 1.0, z - 2.0) == pytest.approx(whole(x, y, z), rel=1e-10)

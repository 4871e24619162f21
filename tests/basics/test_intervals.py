"""Intervals contain what their members give, and become sharp."""

import numpy as np

from surrogate.basics.intervals import Interval
from surrogate.coupling.polynomial import Polynomial

RNG = np.random.default_rng(3)


def test_a_polynomial_of_intervals_contains_its_values_and_becomes_sharp():
    powers = np.array([(a, b) for a in range(4) for b in range(3)])
    polynomial = Polynomial(powers, RNG.normal(size=len(powers)))
    middle = RNG.normal(size=(2, 200))
    widths = []
    for half in (0.5, 0.05, 0.005):
        inner = middle + half * RNG.uniform(-1.0, 1.0, (500, 2, 200))
        values = polynomial(inner[:, 0], inner[:, 1])
        bounds = polynomial(*(Interval(row - half, row + half) for row in middle))
        assert np.all((bounds.low <= values) & (values <= bounds.high))
        widths.append(np.max(bounds.high - bounds.low))
    assert widths[2] < 0.02 * widths[0]


def test_numbers_of_numpy_leave_products_to_it():
    unit = Interval(np.array([-1.0]), np.array([2.0]))
    for product in (np.float64(-2.0) * unit, unit * np.array([-2.0]), np.array([-2.0]) * unit):
        assert (product.low.tolist(), product.high.tolist()) == ([-4.0], [2.0])
    assert (np.float64(1.0) + unit).low.tolist() == [0.0]

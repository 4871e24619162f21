"""What the table says of all points of a part of its domain at once."""

import numpy as np
import pytest

from surrogate.choosing.candidates import candidates
from surrogate.prepared.line import line_of

RNG = np.random.default_rng(8)


@pytest.mark.parametrize("name", ["arc", "normal_load", "slip_arc", "slip_load"])
def test_bounds_over_a_part_of_the_domain_contain_its_values(name):
    fitted = candidates().fitted
    table = fitted.models["table"].table
    for _ in range(60):
        alpha = np.sort(RNG.uniform(2.0, 9.0, 2))
        highest = min(float(fitted.limits.highest_g(end)) for end in alpha)
        g = np.sort(fitted.limits.g[0] * (highest / fitted.limits.g[0]) ** RNG.uniform(size=2))
        low, high = table.between(name, tuple(g), tuple(alpha))
        log_g, row = (np.log(RNG.uniform(*ends, 500)) for ends in (g, alpha))
        log_g[:2], row[:2] = np.log(g), np.log(alpha)
        values = table.at([name], log_g, row)[1][0]
        assert low * (1.0 - 1e-12) <= values.min() <= values.max() <= high * (1.0 + 1e-12)
    part = (1.0, 1.01), (3.0, 3.01)
    low, high = table.between(name, *part)
    assert high < 1.5 * low  # of few cells


def test_bounds_along_a_line_contain_values_and_slopes():
    table = candidates().fitted.models["table"].table
    for alpha in (2.0, 4.5, 9.0):
        line = line_of(table, "slip_load", float(np.log(alpha)))
        edges = line.touch + (np.arange(len(line.pieces)) - line.short) / np.where(
            np.arange(len(line.pieces)) < line.short, line.before, line.after
        )
        low = RNG.uniform(edges[:-1], edges[1:])
        high = RNG.uniform(low, edges[1:])
        values, slopes = line.between(low, high)
        inner = low + (high - low) * RNG.uniform(size=(200, 1))
        found = line.at(inner.ravel().copy()).reshape(inner.shape)
        room = 1e-9 * np.abs(found)
        assert np.all((values[0] <= found + room) & (found - room <= values[1]))
        steep = np.diff(line.at(np.stack([low, high])), axis=0)[0] / (high - low)
        room = 1e-6 * np.abs(steep)
        assert np.all((slopes[0] <= steep + room) & (steep - room <= slopes[1]))

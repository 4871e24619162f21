"""The error of a model beyond its range: none that is smaller than inside, and a growing one."""

import numpy as np
import pytest

from surrogate.choosing.accuracy import contact_bounds
from surrogate.choosing.by_name import force_model
from surrogate.inference.continuation import LARGEST_ERROR, contact_error


@pytest.mark.parametrize("alpha", [2.0, 4.5, 9.0])
@pytest.mark.parametrize("name", ["table", "power-law", "gp"])
def test_beyond_its_range_a_model_drifts_by_its_own_bound_for_each_factor_e(name, alpha):
    model = force_model(name)
    low, high = model.ends(alpha)
    away = np.array([0.5, 1.0, 2.0, 4.0])
    g = np.concatenate([low * np.exp(-away), high * np.exp(away)])
    error = contact_error(model, g, alpha)
    near = contact_bounds(model, np.clip(g, low, high), alpha)
    for bound, drift in zip(near, (error.arc_drift, error.load_drift), strict=True):
        least = np.minimum(np.tile(away, 2) * bound, LARGEST_ERROR) / np.sqrt(3.0)
        assert np.all(drift >= least * (1.0 - 1e-12))
        for side in (drift[:4], drift[4:]):
            assert np.all(np.diff(side) >= 0.0)
            assert side[1] > side[0]
    assert np.array_equal(error.below, g < low)
    assert np.array_equal(error.above, g > high)


def test_inside_there_is_no_drift_and_the_bound_is_what_was_measured():
    model = force_model("table")
    g = np.array([0.01, 1.0, 50.0])
    error = contact_error(model, g, 3.0)
    assert not np.any(error.arc_drift)
    assert not np.any(error.load_drift)
    arc, load = contact_bounds(model, g, 3.0)
    assert error.arc == pytest.approx(arc / np.sqrt(3.0))
    assert error.load == pytest.approx(load / np.sqrt(3.0))

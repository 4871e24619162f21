"""The process of ln kappa: nothing without load, its errors, a base left out."""

from dataclasses import replace

import numpy as np
import pytest
from made_up_coupled import log_kappa

from fe_training.coupled.process import LoadProcess, fit_process

RNG = np.random.default_rng(11)
TOUCH = (0.5, 0.2, 0.4)


def points(count):
    return np.column_stack(
        [
            RNG.uniform(-8.0, -0.5, count),
            RNG.uniform(np.log(2.2), np.log(8.8), count),
            RNG.uniform(0.0, 0.1, count),
            RNG.uniform(0.0, 1.0, count),
        ]
    )


@pytest.fixture(scope="module")
def noisy():
    """Places, values with a noise of 1e-3, and the process fitted to them."""
    inputs = points(70)
    values = log_kappa(*inputs.T) + RNG.normal(0.0, 1e-3, 70)
    return fit_process(inputs, values, np.full(70, 1e-6), TOUCH, starts=1)


def test_the_process_vanishes_without_load_exactly(noisy):
    places = points(50)
    places[:, 2:] = 0.0
    mean, std = noisy.predict(places)
    assert not mean.any()
    assert not std.any()


def test_a_made_up_kappa_is_recovered_within_its_deviations(noisy):
    places = points(400)
    mean, std = noisy.predict(places)
    off = np.abs(mean - log_kappa(*places.T)) / std
    # a share of 0.683 and 0.954 of a normal distribution, whose errors are of 70 points in common
    assert np.mean(off <= 1.0) > 0.5
    assert np.mean(off <= 3.0) > 0.95
    assert np.median(std) < 2e-3


def test_a_base_left_out_is_a_process_that_never_saw_it(noisy):
    groups = np.arange(70) // 7
    error, std = noisy.left_out(groups)
    for group in range(10):
        out = groups == group
        without = LoadProcess(
            noisy.inputs[~out],
            noisy.values[~out],
            noisy.noise[~out],
            noisy.scatter,
            noisy.sizes,
            noisy.lengths,
            TOUCH,
        )
        mean, own = without.predict(noisy.inputs[out])
        assert mean - noisy.values[out] == pytest.approx(error[out], rel=1e-5, abs=1e-8)
        # the jitter of 1e-10 on the diagonal stays in that of the points left out
        assert own**2 + 1e-10 == pytest.approx(std[out] ** 2, rel=1e-5, abs=1e-11)


def test_the_slopes_of_the_likelihood_are_its_differences(noisy):
    away = replace(noisy, sizes=1.3 * noisy.sizes, lengths=0.8 * noisy.lengths)
    logs, step = np.log([away.scatter, *away.sizes, *away.lengths.ravel()]), 1e-4

    def height(parameters):
        found = np.exp(parameters)
        scatter, sizes, lengths = found[0], found[1:3], found[3:].reshape(2, 5)
        return replace(away, scatter=scatter, sizes=sizes, lengths=lengths).log_likelihood()

    differences = [(height(logs + d) - height(logs - d)) / (2.0 * step) for d in step * np.eye(13)]
    # of the order of step**2 of heights of some hundreds, and their rounding over step
    assert away.log_likelihood_slopes() == pytest.approx(differences, rel=1e-4, abs=1e-3)


def test_the_calibration_scales_deviations_only(noisy):
    places = points(20)
    mean, std = noisy.predict(places)
    wider = replace(noisy, calibration=3.0)
    assert np.array_equal(wider.predict(places)[0], mean)
    assert wider.predict(places)[1] == pytest.approx(3.0 * std, rel=1e-12)

"""Intervals of the law "auto" hold truths of the coupled law as often as they say."""

import numpy as np
import pytest

from surrogate.inference.quantiles import normal_quantile
from torture.coupled_coverage import held_by, rubbed

MOST, FALSE_ALARM = 60, 1e-3


@pytest.mark.slow
def test_intervals_of_the_law_auto_hold_the_truth():
    random = np.random.default_rng(1)
    results = [held_by(rubbed(random)) for _ in range(MOST)]
    coupled = np.array([inside for law, inside in filter(None, results) if law == "coupled"])
    assert len(coupled) > MOST // 2
    # at least as often as a share of 95 % falls below by chance once in a thousand
    z = normal_quantile(1.0 - 2.0 * FALSE_ALARM)
    least = 0.95 - z * np.sqrt(0.95 * 0.05 / len(coupled)) - 0.5 / len(coupled)
    assert np.all(coupled.mean(axis=0) >= least)

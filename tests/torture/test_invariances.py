"""A part of `invariances`, on the closed forms and what fitted models are shipped."""

from .invariances import invariances
from .lines import lines


def test_random_points_are_the_same_in_every_company():
    part = invariances(number=50, processes=False)
    assert part.total > 1000
    assert not part.failures


def test_models_have_no_step_along_random_lines():
    part = lines(number=5)
    assert part.total > 150
    assert not part.failures

"""A part of `experiments`: few, of which only gross faults show."""

from .inverse import experiments


def test_made_up_experiments_are_identified_and_warned_of():
    part = experiments(number=300)
    assert not part.failures
    assert part.counts["all, toughness", "inside"] > 260

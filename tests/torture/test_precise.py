"""A few points of the formula and of the table against 50 digits; `make torture` has all."""

from .precise import precise


def test_fitted_models_agree_with_themselves_in_fifty_digits():
    part = precise(number=20, models=("power-law", "table"))
    assert not part.failures
    assert part.total == 40

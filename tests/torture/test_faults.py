"""A part of `faults`, without processes that are killed: one is in tests/campaign."""

import pytest

pytest.importorskip("joblib", reason="the extra 'train' is not installed")

from .faults import faults


def test_a_full_disk_a_locked_one_and_a_wrong_clock_lose_no_row():
    part = faults(kills=0)
    assert not part.failures
    assert part.total + 2 * len(part.notes) >= 5

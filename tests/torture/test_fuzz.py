"""A part of `fuzz`."""

from .fuzz import fuzz


def test_any_bytes_are_read_or_refused_in_words_in_little_memory():
    part = fuzz(number=60, size=200_000)
    assert part.total > 200
    assert not part.failures

"""What the tests of this room share with others."""

from bodies import cut, cut_of, framed_body, places, raised, relaxed, stiffening_cut
from designs import driver, row_bytes, small, small_file

__all__ = [
    "cut",
    "cut_of",
    "driver",
    "framed_body",
    "places",
    "raised",
    "relaxed",
    "row_bytes",
    "small",
    "small_file",
    "stiffening_cut",
]

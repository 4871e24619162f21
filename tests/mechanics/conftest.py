"""What the tests of this room share with others."""

from bodies import cut, cut_of, framed_body, places, raised, relaxed, stiffening_cut

__all__ = ["cut", "cut_of", "framed_body", "places", "raised", "relaxed", "stiffening_cut"]

"""Steady sliding: the shear tractions of friction and wear act on the body."""

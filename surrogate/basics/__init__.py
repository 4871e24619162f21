"""Checks, records, files, figures: what every room uses, about nothing in particular."""

"""Colours, hatches and words of regime maps."""

from __future__ import annotations

from surrogate.map_axes import MapAxis

__all__ = [
    "ERROR_COLOURS",
    "ERROR_LEVELS",
    "FILLS",
    "LINES",
    "NAMES",
    "POINT_MARKERS",
    "axis_label",
]

FILLS = {
    "transition": "#ffffff",
    "toughness-and-friction": "#cfe4f2",
    "cleavage": "#cfe4f2",
    "wear": "#efb37c",
    "friction-stiffness": "#6f9fc0",
    "friction": "#6f9fc0",
}
"""Fill of each regime: told apart by the colour-blind, and by their lightness in grey."""

NAMES = {
    "transition": "transition",
    "toughness-and-friction": "toughness\nand friction",
    "cleavage": "cleavage",
    "wear": "wear",
    "friction-stiffness": "friction\nand stiffness",
    "friction": "friction",
}
"""What is written into each region."""

LINES = ("-", (0, (3.5, 1.7)), (0, (4, 1.5, 1, 1.5)))
"""Dashes of the lines on which terms are equal."""

LIMIT_LINES = {
    "high-toughness": ("#8c1d18", (0, (1, 1))),
    "low-toughness": ("#0b5345", (0, (3, 1, 1, 1, 1, 1))),
    "friction-free": ("#4a235a", (0, (5, 1))),
    "eq13": ("#1b4f72", (0, (2, 2))),
}
"""Colour and dashes of the line on which a limit formula is off."""

POINT_MARKERS = ("s", "o", "D", "^", "v", "P")

ERROR_LEVELS = (0.0, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0)
"""Steps of the map of an error [%]."""

ERROR_COLOURS = ("#ffffff", "#fdf0d5", "#f9d99a", "#f2b45c", "#dd8a3c", "#b8612c", "#8a3f1f")
"""From no error to more than the largest step, darker with each."""

SHOWN_UNITS = {"m": (1e3, "mm"), "Pa": (1e-3, "kPa"), "J/m^2": (1.0, "J/m$^2$"), "": (1.0, "-")}
"""Factor and unit in which figures show a quantity in SI units."""


def axis_label(axis: MapAxis) -> str:
    """Return the words, symbol and unit of an axis as figures show them.

    Examples
    --------
    >>> from surrogate.map_axes import map_axis
    >>> axis_label(map_axis("wire_radius", (1e-5, 1e-3), "log", 3))
    'wire radius $R_w$ [mm]'
    """
    one = axis.coordinate
    return f"{one.words} ${one.symbol}$ [{SHOWN_UNITS[one.unit][1]}]"

"""Options of pictures that every command with a picture has: width, points an inch, legend."""

from __future__ import annotations

import argparse

from surrogate.basics.figures import WIDTHS
from surrogate.basics.picture_form import PictureForm
from surrogate.cli.common import quantity, whole_number
from surrogate.reading.units import LENGTH

__all__ = [
    "add_diameters_option",
    "add_picture_options",
    "add_single_panel_option",
    "picture_form_of",
]

_INCH = 0.0254
_NARROWEST, _WIDEST = 0.03, 0.6
_FEWEST_DOTS, _MOST_DOTS = 50, 2400


def add_picture_options(command: argparse.ArgumentParser) -> None:
    """Add what a picture's file is to be like."""
    group = command.add_argument_group("pictures (.png, .pdf, .svg, .tif)")
    group.add_argument(
        "--width",
        type=_width,
        metavar="WIDTH",
        help="single or double, as a journal's columns (86 and 178 mm), or a length such as 120mm",
    )
    group.add_argument("--dpi", type=_dots, default=300, metavar="N", help="of .png and .tif (300)")
    group.add_argument("--no-legend", action="store_true", help="leave the legend out")


def add_single_panel_option(command: argparse.ArgumentParser) -> None:
    """Add the choice of the first panel alone."""
    command.add_argument(
        "--single-panel", action="store_true", help="draw force over radius alone, without misfit"
    )


def add_diameters_option(command: argparse.ArgumentParser) -> None:
    """Add the choice of diameters instead of radii in what is printed and drawn."""
    command.add_argument(
        "--diameters", action="store_true", help="print and draw diameters instead of radii"
    )


def picture_form_of(options: argparse.Namespace) -> PictureForm:
    """Return how pictures are wanted by the options of a command, which may have none of them."""
    return PictureForm(
        getattr(options, "width", None),
        getattr(options, "dpi", 300),
        not getattr(options, "no_legend", False),
        getattr(options, "diameters", False),
        getattr(options, "single_panel", False),
    )


def _width(text: str) -> float:
    """Return a width in inches."""
    if text in WIDTHS:
        return WIDTHS[text]
    try:
        width = quantity(LENGTH)(text)
    except argparse.ArgumentTypeError as error:
        raise argparse.ArgumentTypeError(f"{error}, or single or double") from None
    if not _NARROWEST <= width <= _WIDEST:
        raise argparse.ArgumentTypeError(
            f"{text!r} is no width of a picture; give {1e3 * _NARROWEST:g} to {1e3 * _WIDEST:g} mm"
        )
    return width / _INCH


def _dots(text: str) -> int:
    dots = whole_number(text)
    if not _FEWEST_DOTS <= dots <= _MOST_DOTS:
        raise argparse.ArgumentTypeError(f"{text!r} is not from {_FEWEST_DOTS} to {_MOST_DOTS}")
    return dots

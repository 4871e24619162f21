"""What the subcommands share: quantities with units, common options, those of pictures, JSON."""

from __future__ import annotations

import argparse
import json
import math
import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from textwrap import fill
from typing import Any, TypeAlias

import numpy as np

from surrogate.basics.figures import WIDTHS
from surrogate.basics.picture_form import PictureForm
from surrogate.basics.records import number
from surrogate.errors import DomainError, InputError
from surrogate.reading.units import LENGTH, NUMBER, Dimension, parse_number, parse_quantity

__all__ = ["wire_rows"]

Record: TypeAlias = "dict[str, Any]"

DOUBTED = 3
"""Exit code where an answer was printed, but a doubt says that it should not be used."""


def wire_rows(**columns: Any) -> list[Record]:
    """Return one record for each wire out of numbers and arrays that broadcast together."""
    arrays = np.broadcast_arrays(*map(np.atleast_1d, columns.values()))
    return [
        dict(zip(columns, values, strict=True))
        for values in zip(*(array.tolist() for array in arrays), strict=True)
    ]


def quantity(dimension: Dimension, signed: bool = False) -> Callable[[str], float]:
    """Return what reads a number with its unit from the command line."""

    def parse(text: str) -> float:
        try:
            value = parse_quantity(text, dimension)
        except InputError as error:
            raise argparse.ArgumentTypeError(str(error).rstrip(".")) from None
        if math.isinf(value):
            raise argparse.ArgumentTypeError(f"{text!r} is beyond a computer's range")
        if value < 0.0 and not signed:
            raise argparse.ArgumentTypeError(f"{text!r} is negative, which it cannot be")
        return value

    return parse


def share(text: str) -> float:
    """Return a share that may be written with a percent sign.

    Examples
    --------
    >>> share("5%"), share("0.05")
    (0.05, 0.05)
    """
    number = parse_number(text.strip().removesuffix("%").rstrip())
    if number is None or math.isinf(number):
        raise argparse.ArgumentTypeError(f"{text!r} is not a share; write 5% or 0.05")
    return number / 100.0 if text.strip().endswith("%") else number


def whole_number(text: str) -> int:
    """Return a whole number."""
    try:
        return int(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is no whole number") from None


def add_friction_and_stiffening(
    command: argparse.ArgumentParser,
    friction: float | None,
    stiffening: float | None,
    action: str = "store",
) -> None:
    for option, symbol, default, shown in (
        ("--friction-coefficient", "XI", friction, "friction coefficient xi (default 0)"),
        ("--stiffening-exponent", "ALPHA", stiffening, "Ogden exponent alpha (default 2)"),
    ):
        command.add_argument(
            option,
            action=action,
            type=quantity(NUMBER),
            default=default,
            metavar=symbol,
            help=shown,
        )


def add_model_option(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--model",
        default="auto",
        help="force model, see 'wirecut models' (default auto: the cheapest that is exact enough)",
    )
    command.add_argument(
        "--rtol",
        type=share,
        metavar="ERROR",
        help="relative error that has to be met with --model auto (default 0.02 where it can be "
        "had, else the best there is)",
    )


def add_law_option(
    command: argparse.ArgumentParser, any_law: bool = False, coupled: bool = True
) -> None:
    default = "auto" if any_law else "projected"
    more = (
        "; auto: the cheapest whose error beside such solutions will do, and projected, with an "
        "unknown error, where there are none near"
        if any_law
        else ""
    )
    last = "; coupled: with the stresses acting on the solid" if coupled else ""
    command.add_argument(
        "--law",
        choices=("projected", "slip", *(["coupled"] if coupled else []), *(["auto"] * any_law)),
        default=default,
        help="projected: the paper's Eq. (S2); slip: the balance of energy to first order in wear "
        f"and friction, whose force is larger{last}{more} (default {default})",
    )


def add_notch_option(command: argparse.ArgumentParser) -> None:
    """Add the radius of the crack's tip."""
    command.add_argument(
        "--notch-radius",
        type=quantity(LENGTH),
        metavar="R_TIP",
        help="radius of the crack's tip, with --law slip: where the tip touches the wire at alpha "
        "up to 2.5, the force depends on it (default 0.0005 of the wire's radius)",
    )


def add_identified_law_option(command: argparse.ArgumentParser) -> None:
    """Add the law of an identification, which is one for all cuts of all gels."""
    command.add_argument(
        "--law",
        choices=("auto", "projected", "slip", "coupled"),
        default="auto",
        help="law of friction and wear that toughness and wear strength are to belong to. auto: "
        "coupled where its solutions reach to all cuts, else projected, and the answer says which "
        "and why; projected: the paper's Eq. (S2); slip: the balance of energy to first order; "
        "coupled: friction and wear act on the gel (default auto)",
    )


def add_extrapolate_option(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--extrapolate",
        action="store_true",
        help="continue a fitted model outside its domain by its asymptotes",
    )


def add_outside_option(command: argparse.ArgumentParser) -> None:
    """Add what becomes of wires to which a model or a law does not reach."""
    command.add_argument(
        "--outside",
        choices=("error", "nan"),
        default="error",
        help="what becomes of wires that the model or the law does not reach: error names the "
        "first and answers none; nan says 'unknown' for them (null with --json) and answers the "
        "others (default error)",
    )


def python_outside(options: argparse.Namespace) -> str:
    """Return `outside` as Python's functions take it.

    Raises
    ------
    InputError
        If the model is to be continued there as well.
    """
    if options.outside == "nan" and options.extrapolate:
        raise InputError(
            "--outside nan leaves out the wires where --extrapolate continues the model; give one "
            "of them."
        )
    return "nan" if options.outside == "nan" else "raise"


@contextmanager
def teaching_outside() -> Iterator[None]:
    """Say what `--outside` does where some wires of several are refused for their domain."""
    try:
        yield
    except DomainError as error:
        refused = re.search(r"\b([0-9]+) of ([0-9]+) values", str(error))
        if refused is None or int(refused[1]) >= int(refused[2]):
            raise
        raise DomainError(f"{error} With --outside nan the other wires are answered.") from None


def without_answer(record: Record, unknown: Any) -> list[str]:
    """Say which wires are not answered."""
    wires = [wire for wire, no in zip(record["wires"], np.atleast_1d(unknown), strict=True) if no]
    if not wires:
        return []
    g = [wire["dimensionless_toughness"] for wire in wires]
    span = number(g[0]) if min(g) == max(g) else f"{number(min(g))} to {number(max(g))}"
    return [
        f"no answer for {len(wires)} of {len(record['wires'])} wires (g = {span}), which model "
        f"{record['model']} or the law does not reach; without --outside nan the reason is told"
    ]


def print_record(
    options: argparse.Namespace, record: Record, text: Callable[[Record], str]
) -> None:
    if options.json:
        print(json.dumps(_finite(record), indent=2, allow_nan=False))
        return
    print(text(record))


def print_answer(options: argparse.Namespace, record: Record, text: Callable[[Record], str]) -> int:
    """Print an answer and what is doubted about it, and return the exit code."""
    doubts = record["warnings"]
    print_record(options, record, lambda record: "\n".join([text(record), *_warnings(doubts)]))
    return DOUBTED if doubts else 0


def _warnings(doubts: Sequence[str]) -> Iterator[str]:
    for doubt in doubts:
        yield fill(f"Warning: {doubt}.", 96, subsequent_indent="  ")


def _finite(value: Any) -> Any:
    """Replace nan and infinity, which JSON does not know, by null."""
    if isinstance(value, dict):
        return {key: _finite(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_finite(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


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

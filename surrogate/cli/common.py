"""What the subcommands share: quantities with units, common options, tables and JSON."""

from __future__ import annotations

import argparse
import json
import math
from collections.abc import Callable, Iterator, Sequence
from textwrap import fill
from typing import Any, TypeAlias

import numpy as np

from surrogate.errors import InputError
from surrogate.reading.units import NUMBER, Dimension, parse_number, parse_quantity

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
    command: argparse.ArgumentParser, friction: float | None, stiffening: float | None
) -> None:
    for option, symbol, default, shown in (
        ("--friction-coefficient", "XI", friction, "friction coefficient xi (default 0)"),
        ("--stiffening-exponent", "ALPHA", stiffening, "Ogden exponent alpha (default 2)"),
    ):
        command.add_argument(
            option, type=quantity(NUMBER), default=default, metavar=symbol, help=shown
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
    more = "; auto: the cheapest whose error beside such solutions will do" if any_law else ""
    last = "; coupled: with the stresses acting on the solid" if coupled else ""
    command.add_argument(
        "--law",
        choices=("projected", "slip", *(["coupled"] if coupled else []), *(["auto"] * any_law)),
        default="projected",
        help="projected: the paper's Eq. (S2); slip: the balance of energy to first order in wear "
        f"and friction, whose force is larger{last}{more} (default projected)",
    )


def add_extrapolate_option(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--extrapolate",
        action="store_true",
        help="continue a fitted model outside its domain by its asymptotes",
    )


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

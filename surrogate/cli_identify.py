"""What `wirecut identify` may be told besides the forces."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import Any

from surrogate.units import LENGTH, STRESS, TOUGHNESS, Dimension

__all__ = ["add_fact_options", "facts"]

Parser = Callable[[Dimension], Callable[[str], float]]


def add_fact_options(command: argparse.ArgumentParser, quantity: Parser) -> None:
    """Add bounds, values, priors and the range of further wires."""
    add = command.add_argument
    add(
        "--toughness-max",
        type=quantity(TOUGHNESS),
        metavar="GAMMA",
        help="bound of Gamma_o, for instance the toughness of pure shear",
    )
    add(
        "--wear-strength",
        type=quantity(STRESS),
        metavar="TAU_W",
        help="tau_w where it is known, for instance the work of fracture",
    )
    for name, dimension in (("toughness", TOUGHNESS), ("wear-strength", STRESS)):
        add(
            f"--{name}-prior",
            type=quantity(dimension),
            nargs=2,
            metavar=("MEAN", "STD"),
            help=f"what else is known of the {name.replace('-', ' ')}; needs forces with errors",
        )
    add(
        "--further-radii",
        type=quantity(LENGTH),
        nargs=2,
        metavar=("SMALLEST", "LARGEST"),
        help="radii of further wires to choose from (default 1/5 to 5 times those cut with)",
    )


def facts(options: argparse.Namespace) -> dict[str, Any]:
    """Return what was given, by the names of `identify`."""
    names = ("toughness_max", "wear_strength", "toughness_prior", "wear_strength_prior")
    return {name: getattr(options, name) for name in (*names, "further_radii")}

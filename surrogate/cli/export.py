"""The command `export`: a prepared force, or the whole table, as a program of another language."""

from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import Any

from surrogate.basics.checks import one_number
from surrogate.basics.files import written_whole
from surrogate.choosing.by_name import AUTO
from surrogate.choosing.laws import COUPLED, SLIP
from surrogate.cli.common import Record, add_law_option, add_model_option, print_answer, quantity
from surrogate.errors import InputError
from surrogate.prepared.preparing import prepare
from surrogate.prepared.source import LANGUAGES
from surrogate.prepared.whole_table import whole_table
from surrogate.reading.units import LENGTH, NUMBER, STRESS, TOUGHNESS
from surrogate.scene import QUANTITIES

__all__ = ["DESCRIPTION", "EXAMPLES", "add_export_options", "run_export"]

DESCRIPTION = "The force as a program of its own: C, JavaScript, MATLAB/Octave or Python."

EXAMPLES = """\
A quantity with one value is fixed, one with two varies between them: the program is a function of
what varies. It checks its ranges and tests itself; its first lines say what it is and how far it
may be off. --table writes the table itself instead, a function of all six quantities; with --law
coupled it answers up to the friction and wear that solutions reach, and nothing beyond.

Without --law the program has one law of friction and wear for all of its ranges: the cheapest that
is known to be within --rtol (2 %) of solutions in which the wire rubs. Where none is known, as for
much friction or wear, it is the projected law with an unknown error, and the first lines say so.

examples:
  wirecut export --format c --shear-modulus 685Pa --toughness 1.6J/m2 \\
    --wear-strength 7.75kPa --wire-radius 0.1mm 1mm --out force.c
  wirecut export --format javascript --table --out table.js
"""

_OPTIONS = (
    ("shear_modulus", STRESS, "MU", "shear modulus mu"),
    ("toughness", TOUGHNESS, "GAMMA_O", "cleavage toughness Gamma_o"),
    ("wire_radius", LENGTH, "R_W", "radius of the wire"),
    ("friction_coefficient", NUMBER, "XI", "friction coefficient xi (default 0)"),
    ("wear_strength", STRESS, "TAU_W", "wear and adhesion shear strength tau_w (default 0)"),
    ("stiffening_exponent", NUMBER, "ALPHA", "Ogden exponent alpha (default 2)"),
)


def add_export_options(command: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    add = command.add_argument
    add("--format", required=True, choices=LANGUAGES, help="language of the program")
    for name, dimension, metavar, words in _OPTIONS:
        add(
            f"--{name.replace('_', '-')}",
            type=quantity(dimension),
            nargs="+",
            metavar=metavar,
            help=f"{words}; two values where it varies",
        )
    add("--table", action="store_true", help="the whole table: all six quantities vary")
    add("--out", metavar="FILE", help="file to write; printed without it")
    add_model_option(command)
    add_law_option(command, any_law=True)
    command.set_defaults(rtol=None)  # which `prepare` reads as 0.02 where there is a choice
    command.set_defaults(law=AUTO)


def run_export(options: argparse.Namespace) -> int:
    """Write or print the program."""
    text, record = _table(options) if options.table else _force(options)
    if options.out is None:
        return print_answer(options, record | {"source": text}, lambda _: text.rstrip("\n"))
    with written_whole(options.out) as name:
        Path(name).write_text(text, encoding="utf-8")
    return print_answer(options, record | {"file": options.out}, _words)


def _table(options: argparse.Namespace) -> tuple[str, Record]:
    set_too = [name for name, *_ in _OPTIONS if getattr(options, name) is not None]
    if set_too:
        raise InputError(
            f"--table must stand without quantities, but --{set_too[0].replace('_', '-')} was "
            "given; leave out one of them."
        )
    names = "A* and B*" if options.law in (SLIP, COUPLED) else "A and B"
    names += ", times kappa" if options.law == COUPLED else ""
    what: Record = {"what": f"the table of {names}", "relative_error": math.nan, "warnings": []}
    return whole_table(options.format, options.law), what


def _force(options: argparse.Namespace) -> tuple[str, Record]:
    fixed, ranges = _quantities(options)
    if not ranges:
        raise InputError(
            "a quantity must vary, but each has one value; give two to one, such as "
            "--wire-radius 0.1mm 1mm."
        )
    force = prepare(fixed, tuple(ranges), ranges, options.model, options.rtol, options.law)
    return force.source(options.format), {
        "what": str(force),
        "law": force.law,
        "relative_error": force.relative_error,
        "fit_error": force.fit_error,
        "warnings": [],
    }


def _quantities(
    options: argparse.Namespace,
) -> tuple[dict[str, float], dict[str, tuple[float, float]]]:
    """Return the quantities that are fixed, and the ranges of those that vary."""
    known = {q.name: q for q in QUANTITIES}
    fixed: dict[str, float] = {}
    ranges: dict[str, tuple[float, float]] = {}
    for name, *_ in _OPTIONS:
        values: Any = getattr(options, name)
        option = f"--{name.replace('_', '-')}"
        if values is not None and len(values) > 2:
            raise InputError(
                f"{option} must have one value, or two between which it varies, but has "
                f"{len(values)}; leave out some."
            )
        if values is None:
            if known[name].name in ("shear_modulus", "toughness", "wire_radius"):
                raise InputError(f"{option} must be given; one value, or two if it varies.")
        elif len(values) == 1:
            fixed[name] = one_number(known[name], values[0])
        else:
            ranges[name] = min(values), max(values)
    return fixed, ranges


def _words(record: Record) -> str:
    return f"{record['what']}\nWritten to {record['file']}."

# PYTHON_ARGCOMPLETE_OK
"""The command `wirecut`: its subcommands, their descriptions and examples."""

from __future__ import annotations

import argparse
import sys
import warnings
from collections.abc import Sequence
from contextlib import nullcontext
from typing import Any

from surrogate.basics.command import OneLineParser, complete, run_command
from surrogate.basics.picture_form import pictures_as
from surrogate.cli import explore as cli_explore
from surrogate.cli import export as cli_export
from surrogate.cli import map as cli_map
from surrogate.cli.common import (
    add_diameters_option,
    add_picture_options,
    add_single_panel_option,
    picture_form_of,
    print_answer,
    print_record,
)
from surrogate.cli.design import add_design_options, run_design
from surrogate.cli.force import (
    add_force_options,
    add_models_options,
    add_regime_options,
    run_force,
    run_models,
    run_regime,
)
from surrogate.cli.gels import run_identify
from surrogate.cli.identify import add_identify_options
from surrogate.cli.language import in_options
from surrogate.cli.steady import add_steady_options, run_steady
from surrogate.contact.shipped import in_use
from surrogate.errors import ImplausibleInputWarning, WirecutError

_UNITS = """\
Quantities carry their unit, without a space or in quotes: 0.2mm, "0.2 mm", 7.75kPa, 1.6J/m2.
A number alone is in SI units (m, Pa, J/m2)."""

_EXIT_CODES = """\
Exit code: 0, or 2 after bad input, or 3 where a printed warning says not to use the answer"""

_DOUBTED = {
    "force": "(a quantity that is hardly that of a cut, such as a wire 0.4 m thick).",
    "regime": "(a quantity that is hardly that of a cut, such as a wire 0.4 m thick).",
    "explore": "(a quantity is hardly that of a cut, or the cuts do not settle the solid).",
    "map": "(what is fixed is hardly that of a cut, such as a modulus of 0.3 Pa).",
    "identify": "(a measured quantity is hardly that of a cut, or a record has no steady force).",
    "steady": "(records without a steady force).",
}

_DESCRIPTIONS = {
    "wirecut": "Wire cutting of soft solids: forces, toughness and regimes (arXiv:2412.02021).",
    "force": "Steady cutting force per sample thickness of each wire, and what it is made of.",
    "steady": "Steady force of every record of a testing machine: the plateau after cutting began.",
    "identify": "Cleavage toughness Gamma_o and wear strength tau_w from forces of several wires.",
    "design": "Which wires to buy and how often to cut with each, and how exact that will be.",
    "regime": "Which term dominates the force of each wire, and where the wire cuts.",
    "map": cli_map.DESCRIPTION,
    "explore": cli_explore.DESCRIPTION,
    "export": cli_export.DESCRIPTION,
    "models": "The force models that --model accepts.",
    "doctor": "What is installed, whether the shipped files are whole, and a self-test.",
}

_EXAMPLES = {
    "wirecut": """\
I have records of a testing machine, or forces of several wires:
  wirecut steady cuts/ --thickness 20mm --name 'wire_{diameter}mm_{trial}' --out cuts.csv
  wirecut identify cuts.csv --shear-modulus 685Pa --plot fit.pdf

I want to know a force, and what it is made of:
  wirecut force --shear-modulus 685Pa --toughness 1.6J/m2 --wear-strength 7.75kPa \\
    --wire-diameter 0.2mm 0.4mm --plot force.pdf

I want a map of what dominates:
  wirecut map --preset gel --out map.pdf

I want to move quantities and see what happens, in a browser:
  wirecut explore --out explorer.html

To try it at once, with the gel of the paper:
  wirecut identify --example
""",
    "force": f"""\
{_UNITS}

examples:
  wirecut force --shear-modulus 685Pa --toughness 1.6J/m2 \\
    --wear-strength 7.75kPa --wire-radius 0.2mm 0.4mm
  wirecut force --shear-modulus 685Pa --toughness 1.6J/m2 --wear-strength 7.75kPa \\
    --wire-diameter 0.2mm 0.8mm --thickness 20mm --plot force.pdf --width 120mm
""",
    "steady": f"""\
FILE is an export of a testing machine (Instron, Zwick, TA.XT, MTS, Shimadzu or plain columns; text
or .xlsx), or a folder of such files. How each was understood is printed: columns, units, sign.
The steady force is the mean along the longest stretch without trend after contact; what has none
is named with the reason, and the exit code is then 3.

A pattern tells the wire from a file's name: {{diameter}} or {{radius}} before its unit,
{{trial}}, {{sample}}, {{thickness}}, and {{}} for whatever.
{_UNITS}

examples:
  wirecut steady cuts/ --thickness 20mm --name 'wire_{{diameter}}mm_{{trial}}' \\
    --out cuts.csv --plot steady.pdf
  wirecut steady gel.csv --thickness 20mm --from 8mm --to 15mm
""",
    "identify": f"""\
FILE is a table with commas, whose header names quantity and unit, for instance cuts.csv:

  wire_radius_mm,force_per_thickness_N_per_m,force_std_N_per_m
  0.1,4.7,0.3
  0.2,7.9,0.4
  0.4,13.9,0.4
  0.5,17.2,0.5

wire_diameter_mm is understood as well; the last column is optional. The friction coefficient
cannot be identified from such data: give it, or it is taken to be 0.

The answer is the first sentence; doubts follow. Where a doubt says that the numbers should not be
used (units that cannot be, forces that the model does not meet, an impossible toughness, forces
without any scatter), it comes before them, and the exit code is 3; 0 otherwise, and 2 after bad
input.
{_UNITS}

Several files, or one table with a column that names the gel (--by), are gels beside each other: one
row of results each, one figure, and which of them differ. Options of the material are given once
for all, or again for each gel in their order.

examples:
  wirecut identify --example
  wirecut identify cuts.csv --shear-modulus 685Pa --friction-coefficient 0.05
  wirecut identify soft.csv stiff.csv --shear-modulus 685Pa --shear-modulus 2kPa --plot gels.pdf
""",
    "design": f"""\
From a guess of the material, or from an earlier result, the wires are chosen from which identify
will tell most, under the model that it uses: of sizes that are sold and hold twice the force, and
with one at least between the thinnest and the thickest, because only that shows whether the model
holds. The standard errors are those of 1000 made-up experiments with these wires.
{_UNITS}

examples:
  wirecut design --shear-modulus 30kPa --toughness 1.6J/m2 --wear-strength 12kPa --relative-error 5%
  wirecut identify --example --json > gel.json
  wirecut design --result gel.json --cuts 10 --relative-error 5% --thickness 20mm
""",
    "regime": f"""\
{_UNITS}

example:
  wirecut regime --shear-modulus 685Pa --toughness 1.6J/m2 \\
    --wear-strength 7.75kPa --wire-diameter 50um 0.5mm
""",
    "map": f"{_UNITS}\n\n{cli_map.EXAMPLES}",
    "explore": f"{_UNITS}\n\n{cli_explore.EXAMPLES}",
    "export": f"{_UNITS}\n\n{cli_export.EXAMPLES}",
    "models": """\
examples:
  wirecut models --json
  wirecut models --law coupled
      how far forces may be off beside solutions on which the wire rubs
""",
    "doctor": """\
example:
  wirecut doctor
""",
}


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit code.

    Parameters
    ----------
    arguments : sequence of str, optional
        The arguments after the command's name; those of the process by default.

    Returns
    -------
    int
        0, or 2 after bad input, with the reason in one line on the standard error stream, or 3
        where an answer was printed, but a doubt that is printed before it says not to use it, or
        records have no steady force.

    Examples
    --------
    >>> gel = ["--shear-modulus", "685Pa", "--toughness", "2 J/m2", "--wire-radius", "1mm"]
    >>> main(["force", *gel, "--model", "eq13"])  # doctest: +ELLIPSIS
    Model eq13, Eq. (13)
    R_w [mm]  g [-]  F_ss/T [N/m]  cleavage  friction  wear  model  fit error  law error  ...
    1         2.92   2             2         0         0     eq13   unknown    unknown    yes
    0
    """
    return run_command("wirecut", lambda: _run(arguments))


def _run(arguments: Sequence[str] | None) -> int:
    parser = _parser()
    complete(parser)
    if not (sys.argv[1:] if arguments is None else arguments):
        parser.print_help()
        return 0
    options = parser.parse_args(arguments)
    models = in_use(options.models) if options.models else nullcontext()
    try:
        with models, warnings.catch_warnings():  # the commands print the doubts with their answers
            warnings.simplefilter("ignore", ImplausibleInputWarning)
            with pictures_as(picture_form_of(options)):
                return options.run(options) or 0
    except WirecutError as error:
        raise WirecutError(in_options(str(error), options.parser)) from error


class _Parser(OneLineParser):
    """The parser of one command, with its description and examples."""

    def __init__(self, **options: Any) -> None:
        name = options["prog"].split()[-1]
        super().__init__(
            description=_DESCRIPTIONS[name],
            epilog=_epilog(name),
            formatter_class=argparse.RawDescriptionHelpFormatter,
            allow_abbrev=False,
            **options,
        )


def _epilog(name: str) -> str:
    """Return the end of a command's help: examples, and what its exit code says."""
    if name not in _DOUBTED:
        return _EXAMPLES[name]
    return f"{_EXAMPLES[name]}\n{_EXIT_CODES}\n{_DOUBTED[name]}"


class _Version(argparse.Action):
    """Prints the versions, which takes a look at every shipped file."""

    def __call__(self, parser: argparse.ArgumentParser, *_: Any) -> None:
        from surrogate.cli.doctor import version_text

        print(version_text())
        parser.exit()


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(prog="wirecut")
    parser.add_argument("--version", action=_Version, nargs=0, help="versions of code and data")
    commands = parser.add_subparsers(metavar="COMMAND", required=True, parser_class=_Parser)
    for name, add_options, run in (
        ("force", add_force_options, run_force),
        ("steady", add_steady_options, run_steady),
        ("identify", add_identify_options, run_identify),
        ("design", add_design_options, run_design),
        ("regime", add_regime_options, run_regime),
        ("map", lambda command: cli_map.add_options(command), run_map),
        ("explore", cli_explore.add_explore_options, cli_explore.run_explore),
        ("export", cli_export.add_export_options, cli_export.run_export),
        ("models", add_models_options, run_models),
        ("doctor", lambda command: None, run_doctor),
    ):
        command = commands.add_parser(name, help=_DESCRIPTIONS[name], prog=f"wirecut {name}")
        add_options(command)
        if name in ("force", "regime", "map", "explore"):
            add_diameters_option(command)
        if name in ("force", "steady", "identify", "map"):
            add_picture_options(command)
        if name == "identify":
            add_single_panel_option(command)
        command.add_argument(
            "--json",
            action="store_true",
            help="print JSON in SI units, null for what is unknown or infinite",
        )
        command.add_argument(
            "--models", metavar="PATH", help="take the fitted models of this file or folder"
        )
        command.set_defaults(run=run, parser=command)
    return parser


def run_map(options: argparse.Namespace) -> int:
    return print_answer(options, cli_map.map_record(options), cli_map.map_text)


def run_doctor(options: argparse.Namespace) -> int:
    from surrogate.cli.doctor import doctor_record, doctor_text

    record = doctor_record()
    print_record(options, record, doctor_text)
    return 0 if record["healthy"] else 1


if __name__ == "__main__":
    sys.exit(main())

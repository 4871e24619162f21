# PYTHON_ARGCOMPLETE_OK
"""The command `wirecut`: forces, identification and regimes without writing Python."""

from __future__ import annotations

import argparse
import json
import math
import os
import sys
from collections.abc import Callable, Sequence
from dataclasses import fields, replace
from typing import Any

from surrogate import cli_map
from surrogate.cli_identify import add_fact_options, facts
from surrogate.command import OneLineParser, complete, run_command
from surrogate.data import Material, read_material, read_measurements
from surrogate.errors import InputError
from surrogate.force import cutting_force
from surrogate.identification import identify
from surrogate.identification_report import identification_record, identification_text
from surrogate.paths import model_file
from surrogate.regimes import DOMINANT_SHARE, classify
from surrogate.report import (
    Record,
    force_record,
    force_text,
    models_record,
    models_text,
    regime_record,
    regime_text,
)
from surrogate.scene import Scene
from surrogate.units import (
    ENERGY_DENSITY,
    LENGTH,
    NUMBER,
    STRESS,
    TOUGHNESS,
    Dimension,
    parse_quantity,
)

_UNITS = """\
Quantities carry their unit, without a space or in quotes: 0.2mm, "0.2 mm", 7.75kPa, 1.6J/m2.
A number alone is in SI units (m, Pa, J/m2)."""

_DESCRIPTIONS = {
    "wirecut": "Wire cutting of soft solids: forces, toughness and regimes (arXiv:2412.02021).",
    "force": "Steady cutting force per sample thickness of each wire, and what it is made of.",
    "identify": "Cleavage toughness Gamma_o and wear strength tau_w from forces of several wires.",
    "regime": "Which term dominates the force of each wire, and where the wire cuts.",
    "map": cli_map.DESCRIPTION,
    "models": "The force models that --model accepts.",
    "doctor": "What is installed, whether the shipped files are whole, and a self-test.",
}

_EXAMPLES = {
    "wirecut": """\
example:
  wirecut identify --example
""",
    "force": f"""\
{_UNITS}

example:
  wirecut force --shear-modulus 685Pa --toughness 1.6J/m2 \\
    --wear-strength 7.75kPa --wire-radius 0.2mm 0.4mm
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
{_UNITS}

examples:
  wirecut identify --example
  wirecut identify cuts.csv --shear-modulus 685Pa --friction-coefficient 0.05
""",
    "regime": f"""\
{_UNITS}

example:
  wirecut regime --shear-modulus 685Pa --toughness 1.6J/m2 \\
    --wear-strength 7.75kPa --wire-diameter 50um 0.5mm
""",
    "map": f"{_UNITS}\n\n{cli_map.EXAMPLES}",
    "models": """\
example:
  wirecut models --json
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
        0, or 2 after bad input, with the reason in one line on the standard error stream.

    Examples
    --------
    >>> main(["force", "--shear-modulus", "685Pa", "--toughness", "2 J/m2", "--wire-radius", "1mm"])
    Model eq13, Eq. (13)
    R_w [mm]  g [-]  F_ss/T [N/m]  cleavage  friction  wear  model  error up to  model holds
    1         2.92   2             2         0         0     eq13   0 %          yes
    0
    """
    return run_command("wirecut", lambda: _run(arguments))


def _run(arguments: Sequence[str] | None) -> int:
    parser = _parser()
    complete(parser)
    options = parser.parse_args(arguments)
    return options.run(options) or 0


class _Parser(OneLineParser):
    """The parser of one command, with its description and examples."""

    def __init__(self, **options: Any) -> None:
        name = options["prog"].split()[-1]
        super().__init__(
            description=_DESCRIPTIONS[name],
            epilog=_EXAMPLES[name],
            formatter_class=argparse.RawDescriptionHelpFormatter,
            allow_abbrev=False,
            **options,
        )


class _Version(argparse.Action):
    """Prints the versions, which takes a look at every shipped file."""

    def __call__(self, parser: argparse.ArgumentParser, *_: Any) -> None:
        from surrogate.installation import version_text

        print(version_text())
        parser.exit()


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(prog="wirecut")
    parser.add_argument("--version", action=_Version, nargs=0, help="versions of code and data")
    commands = parser.add_subparsers(metavar="COMMAND", required=True, parser_class=_Parser)
    for name, add_options, run in (
        ("force", _add_force_options, _force),
        ("identify", _add_identify_options, _identify),
        ("regime", _add_regime_options, _regime),
        ("map", lambda command: cli_map.add_options(command, _quantity), _map),
        ("models", lambda command: None, _models),
        ("doctor", lambda command: None, _doctor),
    ):
        command = commands.add_parser(name, help=_DESCRIPTIONS[name], prog=f"wirecut {name}")
        add_options(command)
        command.add_argument(
            "--json",
            action="store_true",
            help="print JSON in SI units, null for what is unknown or infinite",
        )
        command.set_defaults(run=run)
    return parser


def _quantity(dimension: Dimension) -> Callable[[str], float]:
    def parse(text: str) -> float:
        try:
            return parse_quantity(text, dimension)
        except InputError as error:
            raise argparse.ArgumentTypeError(str(error).rstrip(".")) from None

    return parse


def _add_scene_options(command: argparse.ArgumentParser) -> None:
    add = command.add_argument
    add(
        "--shear-modulus",
        type=_quantity(STRESS),
        required=True,
        metavar="MU",
        help="shear modulus mu",
    )
    add(
        "--toughness",
        type=_quantity(TOUGHNESS),
        required=True,
        metavar="GAMMA_O",
        help="cleavage toughness Gamma_o",
    )
    add(
        "--wear-strength",
        type=_quantity(STRESS),
        default=0.0,
        metavar="TAU_W",
        help="wear and adhesion shear strength tau_w (default 0)",
    )
    _add_friction_and_stiffening(command, friction=0.0, stiffening=2.0)
    wire = command.add_mutually_exclusive_group(required=True)
    for name in ("radius", "diameter"):
        wire.add_argument(
            f"--wire-{name}",
            type=_quantity(LENGTH),
            nargs="+",
            metavar="LENGTH",
            help=f"{name} of one or more wires",
        )


def _add_friction_and_stiffening(
    command: argparse.ArgumentParser, friction: float | None, stiffening: float | None
) -> None:
    for option, symbol, default, shown in (
        ("--friction-coefficient", "XI", friction, "friction coefficient xi (default 0)"),
        ("--stiffening-exponent", "ALPHA", stiffening, "Ogden exponent alpha (default 2)"),
    ):
        command.add_argument(
            option, type=_quantity(NUMBER), default=default, metavar=symbol, help=shown
        )


def _add_force_options(command: argparse.ArgumentParser) -> None:
    _add_scene_options(command)
    _add_model_option(command)
    _add_extrapolate_option(command)


def _add_regime_options(command: argparse.ArgumentParser) -> None:
    _add_scene_options(command)
    command.add_argument(
        "--threshold",
        type=_quantity(NUMBER),
        default=DOMINANT_SHARE,
        metavar="SHARE",
        help="share of the force from which a term dominates (default 2/3)",
    )
    _add_model_option(command)
    _add_extrapolate_option(command)


def _add_model_option(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--model",
        default="auto",
        help="force model, see 'wirecut models' (default auto: the cheapest that is exact enough)",
    )
    command.add_argument(
        "--rtol",
        type=_quantity(NUMBER),
        default=0.02,
        metavar="ERROR",
        help="relative error that will do with --model auto (default 0.02)",
    )


def _add_extrapolate_option(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--extrapolate",
        action="store_true",
        help="continue a fitted model outside its domain by its asymptotes",
    )


def _add_identify_options(command: argparse.ArgumentParser) -> None:
    add = command.add_argument
    source = command.add_mutually_exclusive_group(required=True)
    source.add_argument("file", nargs="?", metavar="FILE", help="table of measurements (CSV)")
    source.add_argument(
        "--example", action="store_true", help="use the shipped gel of the paper (PAAm)"
    )
    add("--material", metavar="FILE", help="properties of the gel (JSON), instead of options")
    add("--shear-modulus", type=_quantity(STRESS), metavar="MU", help="shear modulus mu")
    _add_friction_and_stiffening(command, friction=None, stiffening=None)
    add(
        "--pure-shear-toughness",
        type=_quantity(TOUGHNESS),
        metavar="GAMMA",
        help="toughness Gamma of a fracture test, to compare with",
    )
    add(
        "--work-of-fracture",
        type=_quantity(ENERGY_DENSITY),
        metavar="W_F",
        help="energy density at tensile failure W_f, to compare with",
    )
    _add_model_option(command)
    add(
        "--confidence",
        type=_quantity(NUMBER),
        default=0.95,
        metavar="P",
        help="probability of the intervals (default 0.95)",
    )
    add_fact_options(command, _quantity)
    add("--plot", metavar="PICTURE", help="draw force against radius (.png, .pdf, .svg)")
    add("--csv", metavar="TABLE", help="write the fitted line and its band")


def _scene(options: argparse.Namespace) -> Scene:
    radius = options.wire_radius or [diameter / 2.0 for diameter in options.wire_diameter]
    return Scene(
        shear_modulus=options.shear_modulus,
        toughness=options.toughness,
        wire_radius=radius,
        friction_coefficient=options.friction_coefficient,
        wear_strength=options.wear_strength,
        stiffening_exponent=options.stiffening_exponent,
    )


def _force(options: argparse.Namespace) -> None:
    scene = _scene(options)
    force = cutting_force(scene, options.model, options.rtol, options.extrapolate)
    _print(options, force_record(scene, force), force_text)


def _regime(options: argparse.Namespace) -> None:
    scene = _scene(options)
    regime = classify(scene, options.threshold, options.model, options.rtol, options.extrapolate)
    record = regime_record(scene, regime, options.model)
    _print(options, record, regime_text)


def _map(options: argparse.Namespace) -> None:
    _print(options, cli_map.map_record(options), cli_map.map_text)


def _models(options: argparse.Namespace) -> None:
    _print(options, models_record(), models_text)


def _doctor(options: argparse.Namespace) -> int:
    from surrogate.installation import doctor_record, doctor_text

    record = doctor_record()
    _print(options, record, doctor_text)
    return 0 if record["healthy"] else 1


def _identify(options: argparse.Namespace) -> None:
    file = model_file("paam-wire-cutting.csv") if options.example else options.file
    measurements = read_measurements(file)
    material = _material(options)
    if material.shear_modulus is None:
        raise InputError("the shear modulus is missing; give --shear-modulus or --material.")
    fit = identify(
        measurements.wire_radius,
        measurements.force,
        material.shear_modulus,
        friction_coefficient=_given(material.friction_coefficient, 0.0),
        stiffening_exponent=_given(material.stiffening_exponent, 2.0),
        force_std=measurements.force_std,
        model=options.model,
        rtol=options.rtol,
        confidence=options.confidence,
        **facts(options),
    )
    origin = "read from the published line" if options.example else "measured"
    if options.plot:
        from surrogate.plots import save_identification

        save_identification(
            fit,
            options.plot,
            pure_shear_toughness=material.pure_shear_toughness,
            force_label=origin,
        )
    if options.csv:
        from surrogate.curves import write_curve

        write_curve(fit, options.csv)
    record = {"file": os.path.basename(file), "forces": origin, "picture": options.plot}
    record |= identification_record(fit, material)
    _print(options, record, identification_text)


def _material(options: argparse.Namespace) -> Material:
    """Return the properties of the material's file, replaced by those that options give."""
    material = Material()
    if options.example:
        material = read_material(model_file("paam-material.json"))
    if options.material:
        material = read_material(options.material)
    given = {
        field.name: value
        for field in fields(Material)
        if (value := getattr(options, field.name, None)) is not None
    }
    # A value from the command line comes without the standard error of the one it replaces.
    unknown = {f"{name}_std": None for name in given if hasattr(material, f"{name}_std")}
    return replace(material, **unknown, **given)


def _given(value: float | None, default: float) -> float:
    return default if value is None else value


def _print(options: argparse.Namespace, record: Record, text: Callable[[Record], str]) -> None:
    if options.json:
        print(json.dumps(_finite(record), indent=2, allow_nan=False))
        return
    print(text(record))


def _finite(value: Any) -> Any:
    """Replace nan and infinity, which JSON does not know, by null."""
    if isinstance(value, dict):
        return {key: _finite(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_finite(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


if __name__ == "__main__":
    sys.exit(main())

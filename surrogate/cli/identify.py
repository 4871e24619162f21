"""The command `wirecut identify`: its options, and what else it may be told than forces."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import numpy as np

from surrogate.basics.files import check_outputs, model_file, written_whole
from surrogate.cli.common import (
    DOUBTED,
    add_friction_and_stiffening,
    add_identified_law_option,
    add_model_option,
    print_record,
    quantity,
    share,
)
from surrogate.cli.identification_text import identification_record, identification_text
from surrogate.cli.steady import add_record_options, cuts_by_options
from surrogate.errors import InputError
from surrogate.identification.fit import Identification, identify
from surrogate.inference.inputs import WITHOUT_MODULUS
from surrogate.reading.cuts import measurements_of
from surrogate.reading.material import Material, read_material
from surrogate.reading.measurements import Measurements, read_measurements
from surrogate.reading.units import (
    ENERGY_DENSITY,
    LENGTH,
    NUMBER,
    STRESS,
    TOUGHNESS,
    Dimension,
)

__all__ = [
    "add_fact_options",
    "add_table_options",
    "facts",
    "identified",
    "measurements_by_options",
    "of_gel",
    "outputs_of",
    "run_one",
]

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
        help="radii of further wires to choose from (default 1/5 to 5 times those cut with, from "
        "20 um to 2 mm across)",
    )


def facts(options: argparse.Namespace) -> dict[str, Any]:
    """Return what was given, by the names of `identify`."""
    names = ("toughness_max", "wear_strength", "toughness_prior", "wear_strength_prior")
    return {name: getattr(options, name) for name in (*names, "further_radii")}


def add_identify_options(command: argparse.ArgumentParser) -> None:
    add = command.add_argument
    source = command.add_mutually_exclusive_group(required=True)
    source.add_argument(
        "file",
        nargs="*",
        metavar="FILE",
        default=[],
        help="table of measurements (CSV, .xlsx), or a folder of records as 'wirecut steady' "
        "reads; several are gels beside each other",
    )
    source.add_argument(
        "--example", action="store_true", help="use the shipped gel of the paper (PAAm)"
    )
    add(
        "--material",
        action="append",
        metavar="FILE",
        help="properties of the gel (JSON), instead of options; of several gels once for all, or "
        "again for each, as the options of the material",
    )
    add(
        "--by",
        metavar="COLUMN",
        help="column of the table that names the gel of each row, where it is of several",
    )
    add(
        "--shear-modulus",
        action="append",
        type=measured(STRESS),
        metavar="MU",
        help="shear modulus mu, with its standard error if you know it: 685+-30Pa",
    )
    add(
        "--youngs-modulus",
        action="append",
        type=measured(STRESS),
        metavar="E",
        help="Young's modulus, instead of mu = E/3 of what does not change its volume",
    )
    for name, symbol in (("friction", "xi"), ("stiffening", "alpha")):
        add(
            f"--{name}-std",
            type=quantity(NUMBER),
            metavar="STD",
            help=f"standard error of {symbol}, which becomes part of the intervals",
        )
    add(
        "--relative-error",
        type=share,
        metavar="SHARE",
        help="standard error of every force where only that is known: 5%%",
    )
    add("--verbose", action="store_true", help="print every table, not only the answer")
    add_friction_and_stiffening(command, friction=None, stiffening=None, action="append")
    add(
        "--pure-shear-toughness",
        type=quantity(TOUGHNESS),
        metavar="GAMMA",
        help="toughness Gamma of a fracture test, to compare with",
    )
    add(
        "--work-of-fracture",
        type=quantity(ENERGY_DENSITY),
        metavar="W_F",
        help="energy density at tensile failure W_f, to compare with",
    )
    add_model_option(command)
    command.set_defaults(rtol=None)
    add_identified_law_option(command)
    add(
        "--confidence",
        type=share,
        default=0.95,
        metavar="P",
        help="probability of the intervals (default 0.95)",
    )
    add_fact_options(command, quantity)
    add("--plot", metavar="PICTURE", help="draw force against radius (.png, .pdf, .svg)")
    add(
        "--csv",
        metavar="TABLE",
        help="write the fitted line and its band; of several gels one row of results for each, and "
        "into NAME-pairs.csv beside it one row for each pair",
    )
    add(
        "--write-material",
        metavar="FILE",
        help="write what is known of the gel, toughness, wear strength and their law with it "
        "(JSON), for 'wirecut force --material FILE'",
    )
    add_table_options(command, thickness="append")
    add_record_options(command)


def add_table_options(command: argparse.ArgumentParser, thickness: str = "store") -> None:
    """Add what a table may leave open."""
    add = command.add_argument
    add(
        "--thickness",
        action=thickness,
        type=quantity(LENGTH),
        metavar="T",
        help="of the sample, for forces in N",
    )
    add("--decimal", metavar="SIGN", help="decimal sign of FILE: . or ,")
    add("--delimiter", metavar="SIGN", help="what separates columns: , ; tab | or blank")
    add("--encoding", metavar="NAME", help="encoding of FILE, such as utf-16")


_OF_RECORDS = ("name", "wires", "tare", "start", "end", "sign", "speed", "columns")


def outputs_of(options: argparse.Namespace) -> dict[str, str | None]:
    """Return the files to write by the options that name them."""
    return {
        "--plot": options.plot,
        "--csv": options.csv,
        "--write-material": options.write_material,
    }


def measurements_by_options(options: argparse.Namespace, file: str) -> Measurements:
    """Return the forces of a table or, of a folder, those of its records."""
    if os.path.isdir(file):
        return measurements_of(cuts_by_options(options, [file], outputs_of(options))[0])
    unused = [name for name in _OF_RECORDS if getattr(options, name) is not None]
    if unused:
        listed = ", ".join({"start": "--from", "end": "--to"}.get(x, f"--{x}") for x in unused)
        raise InputError(f"{listed}: for a folder of records, but {file} is a table; leave it out.")
    return read_measurements(
        file,
        options.thickness,
        decimal=options.decimal,
        delimiter=options.delimiter,
        encoding=options.encoding,
        by=options.by,
    )


PER_GEL = (
    "material",
    "shear_modulus",
    "youngs_modulus",
    "friction_coefficient",
    "stiffening_exponent",
    "thickness",
)
"""Options that may be given once for all gels, or again for each."""


def of_gel(options: argparse.Namespace, gel: int, gels: int) -> argparse.Namespace:
    """Return the options of one gel of several.

    Raises
    ------
    InputError
        If an option is given neither once nor once for each gel.
    """
    one = argparse.Namespace(**vars(options))
    for name in PER_GEL:
        values = getattr(options, name)
        if values is None:
            continue
        if len(values) not in (1, gels):
            raise InputError(
                f"--{name.replace('_', '-')} is given {len(values)} times for {gels} "
                f"gel{'s' if gels > 1 else ''}; give it once"
                f"{' for all, or for each in their order' if gels > 1 else ''}."
            )
        setattr(one, name, values[gel if len(values) > 1 else 0])
    return one


def run_one(options: argparse.Namespace) -> int:
    """Identify one gel, and return the exit code."""
    file = model_file("paam-wire-cutting.csv") if options.example else options.file[0]
    options = of_gel(options, 0, 1)
    check_outputs(outputs_of(options), [file, options.material])
    measurements = measurements_by_options(options, os.fspath(file))
    for note in measurements.notes:
        print(f"note: {note}", file=sys.stderr)
    fit, material = identified(options, measurements)
    origin = "read from the published line" if options.example else "measured"
    if options.plot:
        from surrogate.identification.figure import save_identification

        save_identification(
            fit,
            options.plot,
            pure_shear_toughness=material.pure_shear_toughness,
            force_label=origin,
        )
    if options.csv:
        from surrogate.identification.curves import write_curve

        write_curve(fit, options.csv)
    record = {
        "file": os.path.basename(os.path.normpath(file)),
        "notes": list(measurements.notes),
        "forces": origin,
        "picture": options.plot,
    }
    if options.write_material:
        _write_material(options.write_material, os.fspath(file), material, fit)
    record |= identification_record(fit, material, options.example)
    record["verbose"] = options.verbose
    print_record(options, record, identification_text)
    return DOUBTED if record["objections"] or measurements.warnings else 0


def identified(
    options: argparse.Namespace, measurements: Measurements
) -> tuple[Identification, Material]:
    """Return what the forces of one gel say, and its properties."""
    material = _material(options)
    modulus, modulus_std = _modulus(options, material)
    if modulus is None and needs_modulus(options.model, material.friction_coefficient):
        raise InputError(
            "the shear modulus is missing; give --shear-modulus or --material (only --model eq13 "
            "without friction needs none)."
        )
    material = replace(material, shear_modulus=modulus, shear_modulus_std=modulus_std or None)
    fit = identify(
        measurements.wire_radius,
        measurements.force,
        modulus,
        friction_coefficient=material.friction_coefficient,
        stiffening_exponent=material.stiffening_exponent,
        shear_modulus_std=modulus_std,
        friction_std=_given(options.friction_std, 0.0),
        stiffening_std=_given(options.stiffening_std, 0.0),
        force_std=None if options.relative_error else measurements.force_std,
        relative_error=options.relative_error,
        sample=measurements.samples,
        model=options.model,
        rtol=options.rtol,
        law=options.law,
        confidence=options.confidence,
        **facts(options),
    )
    return fit, material


_NOT_OF_OPTIONS = ("shear_modulus", "toughness", "wear_strength", "law")
"""What an identification finds, or reads by itself: options of these names are something else."""


def _with_estimates(material: Material, fit: Identification) -> Material:
    """Return a material with what was identified, and the law that it is of."""
    std = fit.toughness_std, fit.wear_strength_std
    gamma, tau = (float(one) if np.isfinite(one) else None for one in std)
    return replace(
        material,
        friction_coefficient=fit.friction_coefficient,
        stiffening_exponent=fit.stiffening_exponent,
        toughness=fit.toughness,
        toughness_std=gamma,
        wear_strength=fit.wear_strength,
        wear_strength_std=tau,
        law=fit.law,
    )


def _write_material(file: str, measurements: str, material: Material, fit: Identification) -> None:
    """Write what is known of a gel, with what its cuts said, for `wirecut force --material`."""
    if min(fit.toughness, fit.wear_strength) < 0.0:
        raise InputError(
            f"{file} is not written, as an estimate is negative: toughness {fit.toughness:.4g} "
            f"J/m2, wear strength {fit.wear_strength:.4g} Pa; leave --write-material out."
        )
    name = os.path.splitext(os.path.basename(measurements))[0]
    source = f"wirecut identify {os.path.basename(measurements)}, law {fit.law}: {fit.law_reason}"
    with written_whole(file) as new:
        Path(new).write_text(
            _with_estimates(material, fit).to_json(name, source) + "\n", encoding="utf-8"
        )


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
        if field.name not in _NOT_OF_OPTIONS
        if (value := getattr(options, field.name, None)) is not None
    }
    # A value from the command line comes without the standard error of the one it replaces.
    unknown = {f"{name}_std": None for name in given if hasattr(material, f"{name}_std")}
    return replace(material, **unknown, **given)


def measured(dimension: Dimension) -> Callable[[str], tuple[float, float]]:
    """Return a parser of a quantity with or without its standard error, as 685+-30Pa.

    Examples
    --------
    >>> measured(STRESS)("0.685+-0.03kPa")
    (685.0, 30.0)
    """
    parse = quantity(dimension)

    def parsed(text: str) -> tuple[float, float]:
        value, sign, rest = text.replace("\u00b1", "+-").partition("+-")
        if not sign:
            return parse(text), 0.0
        unit = rest.lstrip().lstrip("0123456789.eE").strip()
        return parse(
            value.strip() if value.strip()[-1:].isalpha() else value.strip() + unit
        ), parse(rest.strip())

    return parsed


def needs_modulus(model: str, friction: float | None) -> bool:
    """Return whether the forces of a model depend on the shear modulus."""
    return model not in WITHOUT_MODULUS or bool(friction)


def _modulus(options: argparse.Namespace, material: Material) -> tuple[float | None, float]:
    """Return mu and its standard error [Pa]: of the options, else of the material's file."""
    if options.shear_modulus is not None and options.youngs_modulus is not None:
        raise InputError(
            "--shear-modulus and --youngs-modulus are both given, and E = 3 mu; give one of them."
        )
    if options.shear_modulus is not None:
        value, std = options.shear_modulus
        return value, std
    if options.youngs_modulus is not None:
        value, std = options.youngs_modulus
        return value / 3.0, std / 3.0
    return material.shear_modulus, _given(material.shear_modulus_std, 0.0)


def _given(value: float | None, default: float) -> float:
    return default if value is None else value

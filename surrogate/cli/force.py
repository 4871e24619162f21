"""The commands `force`, `regime` and `models`: options, records for machines, tables for people."""

from __future__ import annotations

import argparse
import math
from dataclasses import asdict

from surrogate.basics.checks import FloatOrArray
from surrogate.basics.records import UNKNOWN, number, table
from surrogate.choosing.auto import rounded_up
from surrogate.choosing.by_name import force_model, is_auto
from surrogate.choosing.catalogue import models
from surrogate.cli.common import (
    Record,
    add_extrapolate_option,
    add_friction_and_stiffening,
    add_model_option,
    print_answer,
    print_record,
    quantity,
    share,
    wire_rows,
)
from surrogate.cutting.force import CuttingForce, cutting_force
from surrogate.cutting.regimes import DOMINANT_SHARE, SPLIT_MODEL, Regime, classify
from surrogate.errors import DomainError
from surrogate.reading.plausibility import doubts_of_scene
from surrogate.reading.units import LENGTH, STRESS, TOUGHNESS
from surrogate.scene import Scene

__all__ = [
    "force_record",
    "force_text",
    "models_record",
    "models_text",
    "regime_record",
    "regime_text",
]


def force_record(scene: Scene, force: CuttingForce) -> Record:
    """Return the force on each wire [N/m] and its parts."""
    wires = wire_rows(
        wire_radius=scene.wire_radius,
        dimensionless_toughness=_dimensionless_toughness(scene),
        total=force.total,
        cleavage=force.cleavage,
        friction=force.friction,
        wear=force.wear,
        model=force.chosen,
        relative_error=math.nan if force.relative_error is None else force.relative_error,
        in_domain=force.in_domain,
    )
    return {"model": force.model, "wires": wires, "warnings": doubts_of_scene(scene.values())}


def force_text(record: Record) -> str:
    """Return a table of `force_record`."""
    parts = ("R_w [mm]", "g [-]", "F_ss/T [N/m]", "cleavage", "friction", "wear")
    rows = [
        (
            number(1e3 * wire["wire_radius"]),
            *(
                number(wire[key])
                for key in ("dimensionless_toughness", "total", "cleavage", "friction", "wear")
            ),
            wire["model"],
            _percent(wire["relative_error"]),
            "yes" if wire["in_domain"] else "no",
        )
        for wire in record["wires"]
    ]
    name = record["model"]
    words = "that of each wire" if is_auto(name) else force_model(name).equation
    header = (*parts, "model", "error up to", "model holds")
    return f"Model {name}, {words}\n" + table(header, rows)


def _percent(error: float | None) -> str:
    """Return a bound of a relative error for people."""
    return UNKNOWN if error is None or math.isnan(error) else f"{rounded_up(100.0 * error)} %"


def regime_record(scene: Scene, regime: Regime, model: str) -> Record:
    """Return the regime of each wire."""
    wires = wire_rows(
        wire_radius=scene.wire_radius,
        dimensionless_toughness=_dimensionless_toughness(scene),
        dominant=regime.dominant,
        contact=regime.contact,
    )
    doubts = doubts_of_scene(scene.values())
    return {"model": model, "threshold": regime.threshold, "wires": wires, "warnings": doubts}


def _dimensionless_toughness(scene: Scene) -> FloatOrArray:
    """Return g, or nan for all wires where one of them has 0/0, which no force minds."""
    try:
        return scene.dimensionless_toughness
    except DomainError:
        return math.nan


def regime_text(record: Record) -> str:
    """Return a table of `regime_record`."""
    header = ("R_w [mm]", "g [-]", "dominant term", "contact")
    rows = [
        (
            number(1e3 * wire["wire_radius"]),
            number(wire["dimensionless_toughness"]),
            wire["dominant"],
            wire["contact"],
        )
        for wire in record["wires"]
    ]
    model = "Eq. (13)" if record["model"] == SPLIT_MODEL else f"model {record['model']}"
    return table(header, rows) + (
        f"\nA term dominates where it is {record['threshold']:.3g} of the force of {model} or "
        "more; there is a transition where none is."
    )


def models_record() -> Record:
    """Return all models with domain, cost and error."""
    return {"models": [asdict(model) for model in models()]}


def models_text(record: Record) -> str:
    """Return a table of `models_record`."""
    rows = [
        (
            model["name"],
            model["equation"],
            model["domain"],
            _percent(model["error"]),
            UNKNOWN if model["cost"] is None else f"{model['cost']:.3g}",
        )
        for model in record["models"]
    ]
    return table(("model", "equation", "holds for", "error up to", "cost [ns]"), rows) + (
        "\nThe error is that of A and B over the domain, measured beside finite elements; the cost "
        "that of each\nof many points. Model auto takes the cheapest of those with an error that "
        "is exact enough."
    )


def _add_scene_options(command: argparse.ArgumentParser) -> None:
    add = command.add_argument
    add(
        "--shear-modulus",
        type=quantity(STRESS),
        required=True,
        metavar="MU",
        help="shear modulus mu",
    )
    add(
        "--toughness",
        type=quantity(TOUGHNESS),
        required=True,
        metavar="GAMMA_O",
        help="cleavage toughness Gamma_o",
    )
    add(
        "--wear-strength",
        type=quantity(STRESS),
        default=0.0,
        metavar="TAU_W",
        help="wear and adhesion shear strength tau_w (default 0)",
    )
    add_friction_and_stiffening(command, friction=0.0, stiffening=2.0)
    wire = command.add_mutually_exclusive_group(required=True)
    for name in ("radius", "diameter"):
        wire.add_argument(
            f"--wire-{name}",
            type=quantity(LENGTH),
            nargs="+",
            metavar="LENGTH",
            help=f"{name} of one or more wires",
        )


def add_force_options(command: argparse.ArgumentParser) -> None:
    _add_scene_options(command)
    add_model_option(command)
    add_extrapolate_option(command)


def add_regime_options(command: argparse.ArgumentParser) -> None:
    _add_scene_options(command)
    command.add_argument(
        "--threshold",
        type=share,
        default=DOMINANT_SHARE,
        metavar="SHARE",
        help="share of the force from which a term dominates (default 2/3)",
    )
    add_model_option(command)
    add_extrapolate_option(command)


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


def run_force(options: argparse.Namespace) -> int:
    scene = _scene(options)
    force = cutting_force(scene, options.model, options.rtol, options.extrapolate)
    return print_answer(options, force_record(scene, force), force_text)


def run_regime(options: argparse.Namespace) -> int:
    scene = _scene(options)
    regime = classify(scene, options.threshold, options.model, options.rtol, options.extrapolate)
    record = regime_record(scene, regime, options.model)
    return print_answer(options, record, regime_text)


def run_models(options: argparse.Namespace) -> None:
    print_record(options, models_record(), models_text)

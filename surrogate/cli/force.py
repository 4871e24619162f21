"""The commands `force`, `regime` and `models`: options, records for machines, tables for people."""

from __future__ import annotations

import argparse
import math
import re
import warnings
from collections.abc import Callable
from dataclasses import asdict, replace
from textwrap import fill
from typing import Any

import numpy as np

from surrogate.basics.checks import FloatOrArray
from surrogate.basics.digits import rounded_up
from surrogate.basics.picture_form import picture_form, pictures_as
from surrogate.basics.records import UNKNOWN, number, table
from surrogate.basics.records import share as share_in_words
from surrogate.choosing.by_name import AUTO, force_model, is_auto
from surrogate.choosing.catalogue import models
from surrogate.choosing.laws import LAWS, PROJECTED
from surrogate.cli.common import (
    Record,
    add_extrapolate_option,
    add_friction_and_stiffening,
    add_law_option,
    add_model_option,
    add_notch_option,
    add_outside_option,
    print_answer,
    print_record,
    python_outside,
    quantity,
    share,
    teaching_outside,
    wire_rows,
    without_answer,
)
from surrogate.cutting.force import CuttingForce, cutting_force
from surrogate.cutting.regimes import DOMINANT_SHARE, SPLIT_MODEL, Regime, classify
from surrogate.errors import (
    DomainError,
    ImplausibleInputWarning,
    InputError,
    OtherLawWarning,
)
from surrogate.reading.material import Material, read_material
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


def force_record(
    scene: Scene, force: CuttingForce, thickness: float | None = None, any_law: bool = False
) -> Record:
    """Return the force on each wire [N/m] and its parts, and on all of a sample's thickness [N].

    With `any_law` the law is "auto", and that of each wire is told.
    """
    size = math.nan if thickness is None else thickness
    wires = wire_rows(
        wire_radius=scene.wire_radius,
        wire_diameter=2.0 * np.asarray(scene.wire_radius),
        dimensionless_toughness=_dimensionless_toughness(scene),
        total=force.total,
        force=np.asarray(force.total) * size,
        cleavage=force.cleavage,
        friction=force.friction,
        wear=force.wear,
        model=force.chosen,
        relative_error=math.nan if force.relative_error is None else force.relative_error,
        law=force.laws,
        fit_error=math.nan if force.fit_error is None else force.fit_error,
        law_error=math.nan if force.law_error is None else _of_known(force.law_error, force.total),
        in_domain=force.in_domain,
    )
    return {
        "model": force.model,
        "law": AUTO if any_law else force.law,
        "thickness": thickness,
        "wires": wires,
        "notes": list(force.doubts),
        "warnings": doubts_of_scene(scene.values()),
    }


def _of_known(error: FloatOrArray, force: FloatOrArray) -> Any:
    """Return the error of forces, nan of those that are not known."""
    return np.where(np.isnan(force), np.nan, error)


def force_text(record: Record, diameters: bool = False) -> str:
    """Return a table of `force_record`."""
    thickness = record["thickness"]
    on_all = [] if thickness is None else [f"F_ss [N] on {number(1e3 * thickness)} mm"]
    rows = [
        (
            *_wire_cells(wire, diameters),
            number(wire["total"]),
            *([] if thickness is None else [number(wire["force"])]),
            *(number(wire[key]) for key in ("cleavage", "friction", "wear")),
            wire["model"],
            *([wire["law"]] if is_auto(record["law"]) else []),
            _percent(wire["fit_error"]),
            _percent(wire["law_error"]),
            "yes" if wire["in_domain"] else "no",
        )
        for wire in record["wires"]
    ]
    name = record["model"]
    words = "that of each wire" if is_auto(name) else force_model(name).equation
    parts = ("F_ss/T [N/m]", *on_all, "cleavage", "friction", "wear")
    which = ["law"] if is_auto(record["law"]) else []
    errors = ("fit error", "law error")
    header = (*_wire_header(diameters), *parts, "model", *which, *errors, "model holds")
    law = "" if record["law"] == PROJECTED else f", law {_LAW_WORDS[record['law']]}"
    tip = record.get("notch_radius")
    law = law if tip is None else f"{law}, tip of {number(1e3 * tip)} mm"
    text = f"Model {name}, {words}{law}\n" + table(header, rows)
    unknown = any(wire["fit_error"] != wire["fit_error"] for wire in record["wires"])
    if unknown and record["law"] in _UNKNOWN_ERROR:
        text = f"{text}\n{_UNKNOWN_ERROR[record['law']]}"
    if any(wire["fit_error"] == wire["fit_error"] for wire in record["wires"]):
        text = f"{text}\n{_ERRORS}"
    return "\n".join([text, *_notes(record)])


_ERRORS = """\
The force may be off by both errors together: by that of the fit beside finite elements of the same
law, and by that of the law beside ones on which the wire rubs."""


def _notes(record: Record) -> list[str]:
    return [fill(f"Note: {note}.", 96, subsequent_indent="  ") for note in record["notes"]]


_LAW_WORDS = {
    "slip": "of slip",
    "coupled": "with the stresses acting on the solid",
    "auto": "chosen for each wire",
    "projected": "of Eq. (S2)",
}

_UNKNOWN_ERROR = {
    "slip": """\
Where the error is unknown the crack's tip touches the wire: the force under the law of slip then
depends on how sharp the tip is, here a notch of 0.0005 R_w; with --notch-radius and alpha up to 2.5
the error is known.""",
    "coupled": "Where the error is unknown no solution with friction and wear is near.",
}


def _wire_header(diameters: bool) -> tuple[str, str]:
    return "2 R_w [mm]" if diameters else "R_w [mm]", "g [-]"


def _wire_cells(wire: Record, diameters: bool) -> tuple[str, str]:
    size = wire["wire_diameter"] if diameters else wire["wire_radius"]
    return number(1e3 * size), number(wire["dimensionless_toughness"])


def _percent(error: float | None) -> str:
    """Return a bound of a relative error for people."""
    return UNKNOWN if error is None or math.isnan(error) else f"{rounded_up(100.0 * error)} %"


def regime_record(scene: Scene, regime: Regime, model: str) -> Record:
    """Return the regime of each wire."""
    wires = wire_rows(
        wire_radius=scene.wire_radius,
        wire_diameter=2.0 * np.asarray(scene.wire_radius),
        dimensionless_toughness=_dimensionless_toughness(scene),
        dominant=regime.dominant,
        contact=regime.contact,
        law=regime.laws,
    )
    return {
        "model": model,
        "law": regime.law,
        "threshold": regime.threshold,
        "wires": wires,
        "notes": list(regime.doubts),
        "warnings": doubts_of_scene(scene.values()),
    }


def _dimensionless_toughness(scene: Scene) -> FloatOrArray:
    """Return g, or nan for all wires where one of them has 0/0, which no force minds."""
    try:
        return scene.dimensionless_toughness
    except DomainError:
        return math.nan


def regime_text(record: Record, diameters: bool = False) -> str:
    """Return a table of `regime_record`."""
    header = (*_wire_header(diameters), "dominant term", "contact", "law")
    rows = [
        (
            *_wire_cells(wire, diameters),
            wire["dominant"],
            wire["contact"],
            wire["law"],
        )
        for wire in record["wires"]
    ]
    model = "Eq. (13)" if record["model"] == SPLIT_MODEL else f"model {record['model']}"
    said = (
        f"A term dominates where it is {share_in_words(record['threshold'])} of the force of "
        f"{model} or more; there is a transition where none is."
    )
    return "\n".join([table(header, rows), said, *_notes(record)])


def models_record(law: str | None = None) -> Record:
    """Return all models with domain, cost and error, or those of a law with their errors."""
    return {"law": law, "models": [asdict(model) for model in models(law)]}


def models_text(record: Record) -> str:
    """Return a table of `models_record`."""
    if record["law"] is not None:
        return _models_of_law(record)
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
        "is exact enough. With --law\nthe errors of forces beside solutions on which the wire rubs."
    )


def _models_of_law(record: Record) -> str:
    """Return a table of the models of a law."""
    rows = [
        (
            model["name"],
            _percent(model["median_error"]),
            _percent(model["error"]),
            UNKNOWN if model["cost"] is None else f"{model['cost']:.3g}",
        )
        for model in record["models"]
    ]
    known = [model["domain"] for model in record["models"] if model["error"] is not None]
    text = table(("model", "error, median", "error up to", "cost [ns]"), rows)
    said = (
        f"Law {record['law']}: how far F_ss may be off beside finite elements on which the wire "
        "rubs, at the largest friction and wear for which there are such"
        + (f": {known[0]}" if known else "")
        + ". At smaller loads it is less: wirecut force prints it for yours. From the bounds in "
        "models/model-card.md and models/coupled-card.md."
    )
    return f"{text}\n{fill(said, 96)}"


def _add_scene_options(command: argparse.ArgumentParser) -> None:
    add = command.add_argument
    add(
        "--material",
        metavar="FILE",
        help="properties of the solid (JSON), as 'wirecut identify --write-material' writes them "
        "with the law that they are of; options go before",
    )
    add("--shear-modulus", type=quantity(STRESS), metavar="MU", help="shear modulus mu")
    add(
        "--toughness",
        type=quantity(TOUGHNESS),
        metavar="GAMMA_O",
        help="cleavage toughness Gamma_o",
    )
    add(
        "--wear-strength",
        type=quantity(STRESS),
        metavar="TAU_W",
        help="wear and adhesion shear strength tau_w (default 0)",
    )
    add_friction_and_stiffening(command, friction=None, stiffening=None)
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
    add_law_option(command, any_law=True)
    add_notch_option(command)
    add_extrapolate_option(command)
    add_outside_option(command)
    command.add_argument(
        "--thickness",
        type=quantity(LENGTH),
        metavar="T",
        help="thickness of the sample, for the force on all of it in N",
    )
    command.add_argument(
        "--plot", metavar="PICTURE", help="draw the force and its parts over the radius"
    )


def add_models_options(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--law",
        choices=LAWS,
        help="the models that have this law of friction and wear, with the errors of their forces "
        "beside finite elements on which the wire rubs; without it those of A and B beside "
        "frictionless ones",
    )


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
    add_law_option(command, any_law=True)
    add_notch_option(command)
    add_extrapolate_option(command)
    add_outside_option(command)


def _scene(options: argparse.Namespace) -> Scene:
    radius = options.wire_radius or [diameter / 2.0 for diameter in options.wire_diameter]
    material = read_material(options.material) if options.material else Material()
    given = {name: value for name in _OF_MATERIAL if (value := getattr(options, name)) is not None}
    if {"toughness", "wear_strength"} & given.keys():  # which are of no law in particular
        given["law"] = None
    material = replace(material, **given)
    for name in ("shear_modulus", "toughness"):
        if getattr(material, name) is None:
            raise InputError(
                f"--{name.replace('_', '-')} is missing; give it, or --material FILE with it."
            )
    return Scene.of_material(material, radius)


_OF_MATERIAL = (
    *("shear_modulus", "toughness", "wear_strength"),
    *("friction_coefficient", "stiffening_exponent"),
)


def _in_diameters(options: argparse.Namespace) -> bool:
    """Whether to print diameters: where they are asked for, or wires were given by them."""
    return bool(options.diameters or options.wire_diameter)


def _noting(function: Callable[[], Any]) -> tuple[Any, list[str]]:
    """Return what a function returns, and what it warns of another law, in options' words."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("ignore", ImplausibleInputWarning)
        warnings.simplefilter("always", OtherLawWarning)
        result = function()
    told = [str(each.message).rstrip(".") for each in caught]
    return result, [re.sub(r"\blaw='(\w+)'", r"--law \1", words) for words in told]


def run_force(options: argparse.Namespace) -> int:
    if options.thickness == 0.0:
        raise InputError("the sample's thickness must be positive; give --thickness 20mm or so.")
    scene = _scene(options)
    choice = options.model, options.rtol, options.extrapolate, options.law
    outside = python_outside(options)
    with teaching_outside():
        force, notes = _noting(lambda: cutting_force(scene, *choice, outside, options.notch_radius))
    wide = _in_diameters(options)
    if options.plot and options.notch_radius is not None:
        raise InputError(
            "--plot must stand without --notch-radius, as the picture has radii down to that of "
            "the tip; leave out one of them."
        )
    if options.plot:
        from surrogate.cutting.figure import save_force

        with pictures_as(replace(picture_form(), diameters=wide)):
            save_force(
                _reached(scene, force),
                options.plot,
                model=options.model,
                rtol=options.rtol,
                thickness=options.thickness,
                law=options.law,
            )
    any_law = options.law == AUTO and force.law_error is not None  # of closed forms it is none
    record = force_record(scene, force, options.thickness, any_law)
    record |= {"picture": options.plot, "notch_radius": options.notch_radius}
    record["notes"] += [*notes, *without_answer(record, np.isnan(force.total))]
    return print_answer(
        options, record, lambda record: _with_picture(force_text(record, wide), record)
    )


def _reached(scene: Scene, force: CuttingForce) -> Scene:
    """Return the scene with the wires that have a force, for its picture."""
    known = ~np.isnan(np.atleast_1d(force.total))
    if not known.any():
        raise InputError("no wire has a force to draw; leave out --plot, or --outside nan.")
    return replace(scene, wire_radius=np.atleast_1d(scene.wire_radius)[known])


def _with_picture(text: str, record: Record) -> str:
    return f"{text}\nWritten: {record['picture']}" if record["picture"] else text


def run_regime(options: argparse.Namespace) -> int:
    scene = _scene(options)
    choice = options.model, options.rtol, options.extrapolate, options.law, options.notch_radius
    outside = python_outside(options)
    with teaching_outside():
        regime, notes = _noting(lambda: classify(scene, options.threshold, *choice, outside))
    record = regime_record(scene, regime, options.model)
    record["notes"] += [*notes, *without_answer(record, np.asarray(regime.dominant) == UNKNOWN)]
    wide = _in_diameters(options)
    return print_answer(options, record, lambda record: regime_text(record, wide))


def run_models(options: argparse.Namespace) -> None:
    print_record(options, models_record(options.law), models_text)

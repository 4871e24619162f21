"""Results as records for machines (JSON, SI units) and as tables for people."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from textwrap import fill
from typing import Any, TypeAlias

import numpy as np

from surrogate.data import Material
from surrogate.errors import DomainError
from surrogate.force import CuttingForce
from surrogate.force_models import FORCE_MODELS
from surrogate.identification import Identification
from surrogate.linear_fit import is_linear
from surrogate.profile_report import profile_record, profile_text
from surrogate.radii import fracto_cohesive_transition_radius, transition_radius
from surrogate.regimes import Regime, classify
from surrogate.scene import Scene
from surrogate.tables import UNKNOWN
from surrogate.tables import number as _number
from surrogate.tables import table as _table
from surrogate.validation import FloatOrArray

Record: TypeAlias = "dict[str, Any]"

NO_SCATTER = "no scatter"


def force_record(scene: Scene, force: CuttingForce) -> Record:
    """Return the force on each wire [N/m] and its parts."""
    wires = _rows(
        wire_radius=scene.wire_radius,
        dimensionless_toughness=_dimensionless_toughness(scene),
        total=force.total,
        cleavage=force.cleavage,
        friction=force.friction,
        wear=force.wear,
        relative_error=force.relative_error,
        in_domain=force.in_domain,
    )
    return {"model": force.model, "wires": wires}


def force_text(record: Record) -> str:
    """Return a table of `force_record`."""
    header = ("R_w [mm]", "g [-]", "F_ss/T [N/m]", "cleavage", "friction", "wear", "model holds")
    rows = [
        (
            _number(1e3 * wire["wire_radius"]),
            *(
                _number(wire[key])
                for key in ("dimensionless_toughness", "total", "cleavage", "friction", "wear")
            ),
            "yes" if wire["in_domain"] else "no",
        )
        for wire in record["wires"]
    ]
    return f"Model {record['model']}, {FORCE_MODELS[record['model']].equation}\n" + _table(
        header, rows
    )


def regime_record(scene: Scene, regime: Regime) -> Record:
    """Return the regime of each wire."""
    wires = _rows(
        wire_radius=scene.wire_radius,
        dimensionless_toughness=_dimensionless_toughness(scene),
        dominant=regime.dominant,
        contact=regime.contact,
    )
    return {"threshold": regime.threshold, "wires": wires}


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
            _number(1e3 * wire["wire_radius"]),
            _number(wire["dimensionless_toughness"]),
            wire["dominant"],
            wire["contact"],
        )
        for wire in record["wires"]
    ]
    return _table(header, rows) + (
        f"\nA term dominates where it is {record['threshold']:.3g} of the force of Eq. (13) or "
        "more; there is a transition where none is."
    )


def models_record() -> Record:
    """Return the force models."""
    return {
        "models": [
            {"name": name, "equation": model.equation, "domain": model.domain}
            for name, model in FORCE_MODELS.items()
        ]
    }


def models_text(record: Record) -> str:
    """Return a table of `models_record`."""
    rows = [(model["name"], model["equation"], model["domain"]) for model in record["models"]]
    return _table(("model", "equation", "holds for"), rows)


def identification_record(fit: Identification, material: Material) -> Record:
    """Return estimates, lengths, transition radii, wires and warnings of an identification."""
    lengths = _lengths(fit, material)
    return {
        "model": fit.model,
        "friction_coefficient": fit.friction_coefficient,
        "shear_modulus": fit.shear_modulus,
        "shear_modulus_std": material.shear_modulus_std,
        "pure_shear_toughness": material.pure_shear_toughness,
        "pure_shear_toughness_std": material.pure_shear_toughness_std,
        "work_of_fracture": material.work_of_fracture,
        "work_of_fracture_std": material.work_of_fracture_std,
        "confidence": fit.confidence,
        "toughness": fit.toughness,
        "toughness_std": fit.toughness_std,
        "toughness_interval": fit.toughness_interval,
        "wear_strength": fit.wear_strength,
        "wear_strength_std": fit.wear_strength_std,
        "wear_strength_interval": fit.wear_strength_interval,
        "covariance": fit.covariance.tolist(),
        "correlation": fit.correlation,
        "r_squared": fit.r_squared,
        "reduced_chi_squared": fit.reduced_chi_squared,
        "lengths": lengths,
        "transition_radii": _transition_radii(fit, material, lengths),
        "wires": _identified_wires(fit),
        "warnings": list(fit.warnings),
        **profile_record(fit),
    }


def _lengths(fit: Identification, material: Material) -> Record:
    has_scatter = _is_more_than_rounding(fit.toughness_std, fit.toughness)
    toughnesses = {
        # Forces without scatter leave the error of Gamma_o unknown; it is not 0.
        "": ("Gamma_o", fit.toughness, fit.toughness_std if has_scatter else None),
        "_pure_shear": ("Gamma", material.pure_shear_toughness, material.pure_shear_toughness_std),
    }
    stresses = {
        "fracto_cohesive": ("l_f", "W_f", material.work_of_fracture, material.work_of_fracture_std),
        "elasto_cohesive": ("l_e", "mu", fit.shear_modulus, material.shear_modulus_std),
    }
    lengths = {"wear": _length("l_w = Gamma_o/tau_w", fit.wear_length, fit.wear_length_std)}
    for name, (length, unit, stress, stress_std) in stresses.items():
        for ending, (symbol, toughness, toughness_std) in toughnesses.items():
            if toughness is not None and stress:
                definition = f"{length} = {symbol}/{unit}"
                lengths[name + ending] = _quotient(
                    definition, toughness, toughness_std, stress, stress_std
                )
    return lengths


def _transition_radii(fit: Identification, material: Material, lengths: Record) -> Record:
    radii = {
        "eq13": _length(
            "Eq. (13), both terms equal", fit.transition_radius, fit.transition_radius_std
        ),
        "wear": _length("l_w/4", fit.wear_transition_radius, fit.wear_transition_radius_std),
    }
    if not is_linear(fit.model):
        with suppress(DomainError):  # beyond the model
            radius = transition_radius(fit.scene(1.0), fit.model)
            radii["model"] = _length(f"model '{fit.model}'", float(radius), None)
    if l_f := lengths.get("fracto_cohesive_pure_shear"):
        radius = fracto_cohesive_transition_radius(
            material.pure_shear_toughness,  # type: ignore[arg-type]
            material.work_of_fracture,  # type: ignore[arg-type]
        )
        std = None if l_f["std"] is None else 0.25 * l_f["std"]
        radii["fracto_cohesive"] = _length("l_f/4 with Gamma", float(radius), std)
    return radii


def _quotient(
    definition: str, value: float, std: float | None, divisor: float, divisor_std: float | None
) -> Record:
    """Return a length with the standard error of a quotient of independent measurements."""
    length = value / divisor
    if std is None or divisor_std is None:
        return _length(definition, length, None)
    return _length(definition, length, math.hypot(std, length * divisor_std) / divisor)


def _length(definition: str, value: float, std: float | None) -> Record:
    return {"definition": definition, "value": value, "std": std}


def _identified_wires(fit: Identification) -> list[Record]:
    regime: dict[str, Any] = {}
    if fit.is_physical:
        classes = classify(fit.scene(fit.wire_radius))
        regime = {"dominant": classes.dominant, "contact": classes.contact}
    return _rows(
        wire_radius=fit.wire_radius,
        dimensionless_toughness=fit.dimensionless_toughness,
        force=fit.force,
        residual=fit.residuals,
        **regime,
    )


def identification_text(record: Record) -> str:
    """Return what `identification_record` says, for people.

    The record also names the `file` and the origin of the `forces`, and the `picture` or None.
    """
    return "\n\n".join(
        section
        for section in (
            f"{len(record['wires'])} forces, {record['forces']}, from {record['file']}",
            _properties_text(record),
            _estimates_text(record),
            profile_text(record),
            _lengths_text("Length", record["lengths"]),
            _lengths_text("Transition radius R_w*", record["transition_radii"]),
            _wires_text(record["wires"]),
            _warnings_text(record["warnings"]),
            f"Figure written to {record['picture']}" if record["picture"] else "",
        )
        if section
    )


def _properties_text(record: Record) -> str:
    shown = [
        ("shear modulus mu", "shear_modulus", 1.0, "Pa"),
        ("toughness Gamma, pure shear", "pure_shear_toughness", 1.0, "J/m2"),
        ("work of fracture W_f", "work_of_fracture", 1e-3, "kJ/m3"),
        ("friction coefficient xi", "friction_coefficient", 1.0, "-"),
    ]
    rows = []
    for name, key, scale, unit in shown:
        if (value := record[key]) is not None:
            std = record.get(f"{key}_std")
            error = f" +- {_number(scale * std)}" if std is not None else ""
            rows.append((name, f"{_number(scale * value)}{error}", unit))
    return _table(("Given", "value", "unit"), rows)


def _estimates_text(record: Record) -> str:
    rows = []
    for name, key, scale, unit in (
        ("cleavage toughness Gamma_o", "toughness", 1.0, "J/m2"),
        ("wear strength tau_w", "wear_strength", 1e-3, "kPa"),
    ):
        low, high = record[f"{key}_interval"]
        std = _std_text(record[key], record[f"{key}_std"], scale)
        interval = f"{_number(scale * low)} to {_number(scale * high)}"
        if std in (NO_SCATTER, UNKNOWN):
            interval = std
        rows.append((name, _number(scale * record[key]), unit, std, interval))
    title, probability = f"Identified ({record['model']})", f"{100.0 * record['confidence']:.4g} %"
    header = (title, "value", "unit", "std. error", f"{probability} interval")
    quality = f"correlation {_number(record['correlation'])}"
    if not math.isnan(record["r_squared"]):
        quality += f", R^2 = {record['r_squared']:.4f}"
    if record["reduced_chi_squared"] is not None:
        quality += f", chi^2/dof = {_number(record['reduced_chi_squared'])}"
    return f"{_table(header, rows)}\n{quality}"


def _lengths_text(title: str, lengths: Mapping[str, Record]) -> str:
    rows = [
        (
            length["definition"],
            _number(1e6 * length["value"]),
            _std_text(length["value"], length["std"], scale=1e6),
        )
        for length in lengths.values()
    ]
    return _table((title, "um", "std. error"), rows)


def _wires_text(wires: Sequence[Record]) -> str:
    header = ("R_w [mm]", "g [-]", "F_ss/T [N/m]", "residual", "dominant term", "contact")
    rows = [
        (
            _number(1e3 * wire["wire_radius"]),
            _number(wire["dimensionless_toughness"]),
            _number(wire["force"], digits=5),
            _residual_text(wire["residual"], wire["force"]),
            wire.get("dominant", "-"),
            wire.get("contact", "-"),
        )
        for wire in wires
    ]
    return _table(header, rows)


def _warnings_text(warnings: Iterable[str]) -> str:
    return "\n".join(
        fill(f"Warning: {sentence}.", 96, subsequent_indent="  ") for sentence in warnings
    )


def _rows(**columns: Any) -> list[Record]:
    """Return one record for each wire out of numbers and arrays that broadcast together."""
    arrays = np.broadcast_arrays(*map(np.atleast_1d, columns.values()))
    return [
        dict(zip(columns, values, strict=True))
        for values in zip(*(array.tolist() for array in arrays), strict=True)
    ]


def _std_text(value: float, std: float | None, scale: float) -> str:
    """Two digits of a standard error, or why there are none."""
    if std is None or math.isnan(std):
        return UNKNOWN
    return _number(scale * std, digits=2) if _is_more_than_rounding(std, value) else NO_SCATTER


def _residual_text(value: float, force: float) -> str:
    return _number(value, digits=2) if _is_more_than_rounding(value, force) else "0"


def _is_more_than_rounding(value: float, reference: float) -> bool:
    """Return whether a value counts beside the reference; nan does not."""
    return abs(value) >= 1e-12 * abs(reference)

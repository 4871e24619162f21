"""An identification as a record for machines (JSON, SI units) and as tables for people."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict
from textwrap import fill
from typing import Any

from surrogate.basics.records import UNKNOWN, number, table
from surrogate.choosing.by_name import force_model
from surrogate.cli.alternatives import alternatives_record, alternatives_text, friction_records
from surrogate.cli.common import Record, wire_rows
from surrogate.cutting.regimes import classify
from surrogate.cutting.transition_radius import fracto_cohesive_transition_radius
from surrogate.identification.doubts import exactness
from surrogate.identification.fit import Identification
from surrogate.identification.open_questions import wire_in_words
from surrogate.identification.summary import (
    against_use,
    answer,
    brief,
    is_answer,
    rests_on,
)
from surrogate.inference.continuation import is_continued
from surrogate.inference.line_fit import is_linear
from surrogate.reading.material import Material
from surrogate.version import __version__

__all__ = ["identification_record", "identification_text", "profile_record", "profile_text"]


def profile_record(fit: Identification) -> dict[str, Any]:
    """Return minima, pieces of the intervals, what is undecided and the further wire.

    Examples
    --------
    >>> from surrogate.identification.fit import identify
    >>> fit = identify([1e-4, 2e-4, 4e-4], [4.7, 7.9, 13.9], 685.0, model="eq13", toughness_max=1.0)
    >>> [round(mode["toughness"], 3) for mode in profile_record(fit)["modes"]]
    [1.0]
    """
    if fit.profile is None:
        return {}
    wire = fit.further_wire
    words = None if wire is None else wire_in_words(wire)
    return {
        "modes": [asdict(mode) for mode in fit.profile.modes],
        "misfit": "sum of squares" if fit.force_std is None else "chi^2",
        "toughness_intervals": fit.profile.toughness_intervals,
        "wear_strength_intervals": fit.profile.wear_strength_intervals,
        "undecided": [sentence for sentence in fit.undecided if sentence != words],
        "further_wire": None if wire is None else asdict(wire) | {"cuts": wire.cuts},
        "further_wire_words": words,
    }


def profile_text(record: Mapping[str, Any]) -> str:
    """Return what `profile_record` says, for people; nothing where it is empty."""
    if "modes" not in record:
        return ""
    sections = [_modes_text(record)]
    if pieces := _pieces_text(record):
        sections.append(pieces)
    sentences = [f"Undecided: {sentence}." for sentence in record["undecided"]]
    if record["further_wire_words"]:
        purpose = "To decide" if sentences else "To know more"
        sentences.append(f"{purpose}: {record['further_wire_words']}.")
    sections += [fill(sentence, 96, subsequent_indent="  ") for sentence in sentences]
    return "\n".join(sections)


def _modes_text(record: Mapping[str, Any]) -> str:
    header = ("Minimum of the misfit", "Gamma_o [J/m2]", "tau_w [kPa]", record["misfit"], "")
    rows = [
        (
            str(place),
            number(mode["toughness"]),
            number(1e-3 * mode["wear_strength"]),
            number(mode["misfit"]),
            _remark(place, mode),
        )
        for place, mode in enumerate(record["modes"], start=1)
    ]
    return table(header, rows)


def _remark(place: int, mode: Mapping[str, Any]) -> str:
    remark = "the estimate" if place == 1 else "possible" if mode["admitted"] else "excluded"
    return f"{remark}, at the end of the search" if mode["at_end"] else remark


def _pieces_text(record: Mapping[str, Any]) -> str:
    lines = []
    for name, unit, scale, key in (
        ("Gamma_o", "J/m2", 1.0, "toughness_intervals"),
        ("tau_w", "kPa", 1e-3, "wear_strength_intervals"),
    ):
        pieces: Sequence[tuple[float, float]] = record[key]
        if len(pieces) > 1:
            listed = " or ".join(
                f"{number(scale * low)} to {number(scale * high)}" for low, high in pieces
            )
            lines.append(f"{name} is in one of {len(pieces)} intervals: {listed} {unit}")
    return "\n".join(lines)


NO_SCATTER = "no scatter"


EXAMPLE = (
    "the forces of the example are read from the line that the paper publishes, which the model "
    "meets to the last digit: that these are the paper's numbers is all that they say, and of an "
    "interval nothing is known"
)


def identification_record(fit: Identification, material: Material, example: bool = False) -> Record:
    """Return estimates, lengths, transition radii, wires and warnings of an identification.

    That forces are met exactly is no objection to an example of which it is known why.
    """
    objecting = [*_beside_pure_shear(fit, material), *fit.objections]
    doubting = [*_beside_pure_shear(fit, material), *fit.warnings]
    if example and (known := set(exactness(fit))):
        objecting = [sentence for sentence in objecting if sentence not in known]
        doubting = [EXAMPLE, *(sentence for sentence in doubting if sentence not in known)]
    lengths = _lengths(fit, material)
    alternatives = alternatives_record(fit, material)
    unknown = {f"{name}_{what}": None for name in _ESTIMATES for what in ("std", "interval")}
    return {
        "answer": answer(fit),
        "rests_on": rests_on(fit),
        "model": str(fit.model),
        "law": fit.law,
        "law_reason": fit.law_reason,
        "law_error": fit.law_error,
        "friction_coefficient": fit.friction_coefficient,
        "shear_modulus": fit.shear_modulus,
        "shear_modulus_std": fit.shear_modulus_std or None,
        "friction_std": fit.friction_std,
        "stiffening_exponent": fit.stiffening_exponent,
        "stiffening_std": fit.stiffening_std,
        "assumed": list(fit.assumed),
        "known": _known(fit),
        "scatter": _scatter(fit),
        "version": __version__,
        "pure_shear_toughness": material.pure_shear_toughness,
        "pure_shear_toughness_std": material.pure_shear_toughness_std,
        "work_of_fracture": material.work_of_fracture,
        "work_of_fracture_std": material.work_of_fracture_std,
        "confidence": fit.confidence,
        "toughness": fit.toughness,
        "toughness_std": fit.toughness_std,
        "toughness_interval": fit.toughness_interval,
        "toughness_limited_by": fit.toughness_limited_by,
        "wear_strength": fit.wear_strength,
        "wear_strength_std": fit.wear_strength_std,
        "wear_strength_interval": fit.wear_strength_interval,
        "wear_strength_limited_by": fit.wear_strength_limited_by,
        "contributions": dict(fit.contributions),
        "friction_sensitivity": fit.friction_sensitivity,
        "with_friction": friction_records(fit),
        "covariance": fit.covariance.tolist(),
        "correlation": fit.correlation,
        "r_squared": fit.r_squared,
        "reduced_chi_squared": fit.reduced_chi_squared,
        "lengths": lengths,
        "transition_radii": _transition_radii(fit, material, lengths),
        "wires": _identified_wires(fit),
        "objections": objecting,
        "warnings": doubting,
        "model_error": fit.model_error,
        **profile_record(fit),
        **alternatives,
        **({} if fit.has_scatter else unknown),
    }


_ESTIMATES = ("toughness", "wear_strength")


def _known(fit: Identification) -> Record:
    """Return the facts besides the forces; None where nothing bounds the toughness."""
    bound = fit.known.toughness_max
    return asdict(fit.known) | {"toughness_max": bound if math.isfinite(bound) else None}


def _scatter(fit: Identification) -> Record | None:
    if fit.scatter is None:
        return None
    return {
        name: getattr(fit.scatter, name)
        for name in ("kind", "constant", "proportional", "dof", "sample_ratio", "words")
    }


FAR_ABOVE = 2.0
"""Times the toughness of pure shear that Gamma_o, a part of it, cannot be."""


def _beside_pure_shear(fit: Identification, material: Material) -> Iterator[str]:
    gamma = material.pure_shear_toughness
    low = fit.toughness_interval[0]
    if gamma and not math.isnan(low) and low > FAR_ABOVE * gamma:
        yield (
            f"the toughness is at least {number(low, digits=3)} J/m2, far above the toughness of "
            f"pure shear ({number(gamma)} J/m2), of which it is a part: check the units of forces, "
            "radii and modulus"
        )


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
    if not is_linear(fit.model) and not math.isnan(fit.model_transition_radius):
        radii["model"] = _length(f"model '{fit.model}'", fit.model_transition_radius, None)
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
    if fit.is_physical and "shear_modulus" not in fit.assumed:
        continued = is_continued(force_model(fit.model))  # as the identification itself does
        scene = fit.scene(fit.wire_radius)
        classes = classify(scene, model=fit.model, extrapolate=continued, law=fit.law)
        regime = {"dominant": classes.dominant, "contact": classes.contact}
    return wire_rows(
        wire_radius=fit.wire_radius,
        dimensionless_toughness=fit.dimensionless_toughness,
        force=fit.force,
        force_std=fit.force_std,
        sample=fit.sample,
        residual=fit.residuals,
        **regime,
    )


def identification_text(record: Record) -> str:
    """Return what `identification_record` says, for people: the answer, doubts, then tables.

    The record also names the `file` and the origin of the `forces`, and the `picture` or None, and
    says whether it is to be `verbose`.
    """
    count = len(record["wires"])
    head = f"{count} force{'s' if count > 1 else ''}, {record['forces']}, from {record['file']}"
    picture = f"Figure written to {record['picture']}" if record["picture"] else ""
    if not record["verbose"]:
        return brief(
            [*_first(record), *_remarks(record)],
            [
                *record["rests_on"],
                f"{head}; --verbose prints all tables.",
                *filter(None, [picture]),
            ],
            "--verbose tells",
        )
    return "\n\n".join(
        section
        for section in (
            "\n".join(fill(s, 96, subsequent_indent="  ") for s in _first(record)),
            head,
            _warnings_text(_reservations(record)),
            _properties_text(record),
            _estimates_text(record),
            profile_text(record),
            alternatives_text(record),
            _lengths_text("Length", record["lengths"]),
            _lengths_text("Transition radius R_w*", record["transition_radii"]),
            _wires_text(record["wires"]),
            "\n".join(fill(s, 96, subsequent_indent="  ") for s in record["rests_on"]),
            picture,
        )
        if section
    )


def _first(record: Record) -> list[str]:
    """Return the answer, after what says that it should not be used."""
    return [*against_use(record["objections"]), f"{record['answer']}."]


def _reservations(record: Record) -> list[str]:
    return [sentence for sentence in record["warnings"] if sentence not in record["objections"]]


def _remarks(record: Record) -> list[str]:
    remarks = [f"Warning: {sentence}." for sentence in _reservations(record)]
    if record["objections"]:
        return remarks
    undecided = [each for each in record.get("undecided", ()) if not is_answer(each)]
    remarks += [f"Undecided: {sentence}." for sentence in undecided]
    if record.get("further_wire_words"):
        purpose = "To decide" if record["undecided"] else "To know more"
        remarks.append(f"{purpose}: {record['further_wire_words']}.")
    return remarks + [f"{verdict}." for verdict in record.get("verdicts", ())]


_MODULUS = ("shear modulus mu", "shear_modulus", 1.0, "Pa")


def _properties_text(record: Record) -> str:
    shown = [
        *([] if "shear_modulus" in record["assumed"] else [_MODULUS]),
        ("toughness Gamma, pure shear", "pure_shear_toughness", 1.0, "J/m2"),
        ("work of fracture W_f", "work_of_fracture", 1e-3, "kJ/m3"),
        ("friction coefficient xi", "friction_coefficient", 1.0, "-"),
    ]
    rows = []
    for name, key, scale, unit in shown:
        if (value := record[key]) is not None:
            std = record.get(f"{key}_std")
            error = f" +- {number(scale * std)}" if std is not None else ""
            rows.append((name, f"{number(scale * value)}{error}", unit))
    return table(("Given", "value", "unit"), rows)


def _estimates_text(record: Record) -> str:
    rows = []
    for name, key, scale, unit in (
        ("cleavage toughness Gamma_o", "toughness", 1.0, "J/m2"),
        ("wear strength tau_w", "wear_strength", 1e-3, "kPa"),
    ):
        low, high = record[f"{key}_interval"] or (math.nan, math.nan)
        std = _std_text(record[key], record[f"{key}_std"], scale)
        interval = f"{number(scale * low)} to {_end(scale * high)}"
        if math.isnan(low):
            interval = UNKNOWN
        rows.append((name, number(scale * record[key]), unit, std, interval))
    title, probability = f"Identified ({record['model']})", f"{100.0 * record['confidence']:.4g} %"
    header = (title, "value", "unit", "std. error", f"{probability} interval")
    quality = f"correlation {number(record['correlation'])}"
    if not math.isnan(record["r_squared"]):
        quality += f", R^2 = {record['r_squared']:.4f}"
    if record["reduced_chi_squared"] is not None:
        quality += f", chi^2/dof = {number(record['reduced_chi_squared'])}"
    return f"{table(header, rows)}\n{quality}"


def _end(high: float) -> str:
    return number(high) if math.isfinite(high) else "any"


def _lengths_text(title: str, lengths: Mapping[str, Record]) -> str:
    rows = [
        (
            length["definition"],
            number(1e6 * length["value"]),
            _std_text(length["value"], length["std"], scale=1e6),
        )
        for length in lengths.values()
    ]
    return table((title, "um", "std. error"), rows)


def _wires_text(wires: Sequence[Record]) -> str:
    header = ("R_w [mm]", "g [-]", "F_ss/T [N/m]", "residual", "dominant term", "contact")
    rows = [
        (
            number(1e3 * wire["wire_radius"]),
            number(wire["dimensionless_toughness"]),
            number(wire["force"], digits=5),
            _residual_text(wire["residual"], wire["force"]),
            wire.get("dominant", "-"),
            wire.get("contact", "-"),
        )
        for wire in wires
    ]
    return table(header, rows)


def _warnings_text(warnings: Iterable[str]) -> str:
    return "\n".join(
        fill(f"Warning: {sentence}.", 96, subsequent_indent="  ") for sentence in warnings
    )


def _std_text(value: float, std: float | None, scale: float) -> str:
    """Two digits of a standard error, or why there are none."""
    if std is None or math.isnan(std):
        return UNKNOWN
    return number(scale * std, digits=2) if _is_more_than_rounding(std, value) else NO_SCATTER


def _residual_text(value: float, force: float) -> str:
    return number(value, digits=2) if _is_more_than_rounding(value, force) else "0"


def _is_more_than_rounding(value: float, reference: float) -> bool:
    """Return whether a value counts beside the reference; nan does not."""
    return abs(value) >= 1e-12 * abs(reference)

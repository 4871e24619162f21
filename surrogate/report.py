"""Forces, regimes and models as records for machines (JSON, SI units) and tables for people."""

from __future__ import annotations

import math
from dataclasses import asdict
from typing import Any, TypeAlias

import numpy as np

from surrogate.catalogue import models
from surrogate.choice import rounded_up
from surrogate.errors import DomainError
from surrogate.force import CuttingForce
from surrogate.force_models import force_model, is_auto
from surrogate.regimes import SPLIT_MODEL, Regime
from surrogate.scene import Scene
from surrogate.tables import UNKNOWN, number, table
from surrogate.validation import FloatOrArray

__all__ = [
    "force_record",
    "force_text",
    "models_record",
    "models_text",
    "regime_record",
    "regime_text",
    "wire_rows",
]

Record: TypeAlias = "dict[str, Any]"


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
    return {"model": force.model, "wires": wires}


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
    return {"model": model, "threshold": regime.threshold, "wires": wires}


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


def wire_rows(**columns: Any) -> list[Record]:
    """Return one record for each wire out of numbers and arrays that broadcast together."""
    arrays = np.broadcast_arrays(*map(np.atleast_1d, columns.values()))
    return [
        dict(zip(columns, values, strict=True))
        for values in zip(*(array.tolist() for array in arrays), strict=True)
    ]

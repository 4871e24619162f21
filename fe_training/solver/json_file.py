"""Records as a file of JSON."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from dataclasses import fields
from pathlib import Path
from typing import TYPE_CHECKING, Any

from surrogate.errors import InputError
from surrogate.version import __version__

if TYPE_CHECKING:
    from fe_training.solver.record import Record


__all__ = ["write_json"]


def write_json(
    file: str, resolution: str, records: Sequence[Record], wanted: Sequence[tuple[str, float]]
) -> None:
    """Write records with what was wanted of them."""
    content = {
        "wirecut": __version__,
        "units": "lengths in R_w, stresses in mu, forces per thickness in mu R_w, angles in rad",
        "resolution": resolution,
        "configurations": [
            {
                "wanted": {name: value},
                "reached": record.is_reached,
                **{
                    field.name: plain_values(getattr(record, field.name))
                    for field in fields(record)
                },
                "arc": plain_values(record.arc),
                "normal_load": plain_values(record.normal_load),
                "force_mismatch": plain_values(record.force_mismatch),
            }
            for record, (name, value) in zip(records, wanted, strict=True)
        ],
    }
    try:
        Path(file).write_text(json.dumps(content, indent=1, allow_nan=False) + "\n")
    except OSError as error:
        raise InputError(f"{file} cannot be written ({error.strerror}).") from None


def plain_values(value: Any) -> Any:
    """Return what JSON knows: lists for arrays, names for outcomes, null for nan."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, dict):
        return {key: plain_values(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain_values(item) for item in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return getattr(value, "name", value)

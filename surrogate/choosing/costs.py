"""What the models cost, as it was measured: the order in which they are tried."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Iterable
from functools import cache
from typing import Any, TypeVar

from surrogate.basics.files import models_folder
from surrogate.contact.base import ForceModel
from surrogate.errors import InputError

__all__ = ["BULK", "COSTS_FILE", "COSTS_SCHEMA", "ONE", "by_cost", "read_costs"]

COSTS_FILE = "model-costs.json"
"""The measured costs, written by scripts/bench-tradeoff."""

COSTS_SCHEMA = "wirecut-model-costs-1"

BULK, ONE = "bulk_ns", "scalar_us"

Model = TypeVar("Model", bound=ForceModel)


def read_costs() -> dict[str, dict[str, float]]:
    """Return the measured costs by model; none where they are not shipped.

    Returns
    -------
    dict of str to dict
        For each model "bulk_ns", the time for each of A, B and delta at each of many points [ns],
        and "scalar_us", that of one number by itself [us].

    Raises
    ------
    InputError
        If the file is damaged.

    Examples
    --------
    >>> costs = read_costs()
    >>> costs["eq13"]["bulk_ns"] < costs["gp"]["bulk_ns"]
    True
    """
    return _read(models_folder())


def by_cost(models: Iterable[Model]) -> list[Model]:
    """Return models in rising order of their cost at many points; those not measured are last."""
    costs = read_costs()
    return sorted(models, key=lambda model: costs.get(model.name, {}).get(BULK, math.inf))


@cache
def _read(folder: str) -> dict[str, dict[str, float]]:
    file = os.path.join(folder, COSTS_FILE)
    if not os.path.isfile(file):
        return {}
    try:
        with open(file, encoding="utf-8") as reader:
            content: Any = json.load(reader)
        if content["schema"] != COSTS_SCHEMA:
            raise ValueError(f"the schema is {content['schema']!r}")
        return {
            name: {key: _positive(each[key]) for key in (BULK, ONE)}
            for name, each in content["models"].items()
        }
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise InputError(
            f"{file} must hold the measured costs of the models, but {error!r} was met; "
            "install wirecut again, or make it anew with scripts/bench-tradeoff."
        ) from None


def _positive(value: Any) -> float:
    number = float(value)
    if not 0.0 < number < math.inf:
        raise ValueError(f"{value} is no time")
    return number

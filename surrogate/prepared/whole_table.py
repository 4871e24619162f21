"""The table itself as a program: the force of all six quantities of a scene."""

from __future__ import annotations

from typing import Any

from surrogate.choosing.candidates import candidates
from surrogate.contact.closed_forms import FORCE_MODELS
from surrogate.prepared.function import ForceFunction
from surrogate.prepared.plan import ALPHA, GAMMA, MU, RADIUS, Plan
from surrogate.prepared.proof import force_error
from surrogate.scene import NAMES

__all__ = ["whole_table"]


def whole_table(language: str) -> str:
    """Return the table itself as a program: a force of all six quantities of a scene.

    Raises
    ------
    InputError
        If there is no such language, or no table.

    Examples
    --------
    >>> whole_table("python").count("def arc(g, alpha)")
    1
    """
    known, terms = candidates(), ("arc", "normal_load")
    ranges = {**_WIDE, ALPHA: known.limits.alpha}
    table: Any = known.fitted.models["table"]
    form: Any = FORCE_MODELS["eq13"]
    told = known.fitted.about.get("provenance", {})
    data = {
        "source": "table of finite elements",
        "data_date": str(told.get("data_date", "unknown")),
    }
    box = {**ranges, GAMMA: known.limits.g, MU: (1.0, 1.0), RADIUS: (1.0, 1.0)}
    functions = {term: term for term in terms}
    error = force_error(known, box, dict.fromkeys(terms, "table"), functions)
    return ForceFunction(Plan(NAMES, ranges, form, table, terms), error, data).source(language)


_WIDE = {
    MU: (1e-3, 1e12),
    GAMMA: (1e-9, 1e9),
    RADIUS: (1e-9, 1e3),
    "friction_coefficient": (0.0, 1e6),
    "wear_strength": (0.0, 1e12),
}
"""Ranges of all but alpha that no product leaves the range of numbers in."""

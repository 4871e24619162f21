"""The table itself as a program: the force of all six quantities of a scene."""

from __future__ import annotations

import math
from typing import Any

from surrogate.choosing.by_name import AUTO, force_model
from surrogate.choosing.candidates import FREE, OUTSIDE, TERMS, candidates
from surrogate.choosing.laws import COUPLED, PROJECTED, SLIP, of_law
from surrogate.contact.bounds import interval
from surrogate.contact.closed_forms import FORCE_MODELS
from surrogate.prepared.deciding import data_of
from surrogate.prepared.function import ForceFunction
from surrogate.prepared.plan import ALPHA, GAMMA, MU, RADIUS, Plan
from surrogate.prepared.proof import force_error
from surrogate.scene import NAMES

__all__ = ["whole_table"]


def whole_table(language: str, law: str = AUTO) -> str:
    """Return the table itself as a program: a force of all six quantities of a scene.

    Parameters
    ----------
    language : str
        "c", "javascript", "matlab" or "python".
    law : str, default "auto"
        The law of dissipation, "projected", "slip" or "coupled"; "auto" for "projected", as no
        other one is known all over the table. Under "coupled" the program answers up to the loads
        that coupled solutions reach, and no number beyond them.

    Raises
    ------
    InputError
        If there is no such language or law, or there is no table.

    Examples
    --------
    >>> whole_table("python").count("def arc(g, alpha)")
    1
    """
    law = PROJECTED if isinstance(law, str) and law == AUTO else law
    model: Any = of_law(force_model(OUTSIDE), law)
    kappa = model.amplification if law == COUPLED else None
    table = model if kappa is None else model.slip
    form: Any = FORCE_MODELS[FREE]
    plan = Plan(NAMES, _WIDE | {ALPHA: table.limits.alpha}, form, table, TERMS, law, kappa)
    error = _error(law, kappa)
    told = math.nan if kappa is None else error
    return ForceFunction(plan, told, data_of(table), error).source(language)


def _error(law: str, kappa: Any) -> float:
    """Return the bound of the force's error all over what is answered; nan where there is none."""
    if kappa is not None:
        bounds, (low, *_, high) = candidates(law=SLIP).bounds, kappa.axes[0]
        first, last = (interval(bounds.g, math.exp(x)) for x in (low, high))
        rows = slice(first, last + 1)
        worst = max(float(each[rows].max()) for each in bounds.errors[OUTSIDE].values())
        return math.expm1(worst + float(kappa.errors.max())) if worst < math.inf else math.nan
    if law != PROJECTED:
        return math.nan
    known = candidates()
    box = _WIDE | {ALPHA: known.limits.alpha, GAMMA: known.limits.g, MU: _ONE, RADIUS: _ONE}
    return force_error(known, box, dict.fromkeys(TERMS, OUTSIDE), {term: term for term in TERMS})


_ONE = 1.0, 1.0
_WIDE = {
    MU: (1e-3, 1e12),
    GAMMA: (1e-9, 1e9),
    RADIUS: (1e-9, 1e3),
    "friction_coefficient": (0.0, 1e6),
    "wear_strength": (0.0, 1e12),
}
"""Ranges of all but alpha that no product leaves the range of numbers in."""

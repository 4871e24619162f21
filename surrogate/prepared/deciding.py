"""What gives the terms of a prepared force: law, models and error, decided for all its ranges."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from surrogate.basics.digits import rounded_up
from surrogate.choosing.accuracy import DEFAULT_RTOL
from surrogate.choosing.auto_law import amplification_of_models
from surrogate.choosing.by_name import force_model
from surrogate.choosing.candidates import FREE, OUTSIDE, TERMS, Candidates, candidates
from surrogate.choosing.laws import COUPLED, PROJECTED, SLIP
from surrogate.contact.closed_forms import FORCE_MODELS, ClosedForm
from surrogate.contact.domain import Domain, g_range
from surrogate.contact.table import TableModel
from surrogate.coupling.amplification import Amplification
from surrogate.coupling.coverage import bounds_over, uncovered
from surrogate.coupling.model import CoupledModel
from surrogate.errors import AccuracyError, DomainError, InputError
from surrogate.prepared.function import ForceFunction
from surrogate.prepared.plan import ALPHA, Plan
from surrogate.prepared.proof import Beside, force_error, lowest_of_highest

__all__ = ["Parts", "Ranges", "cheapest", "data_of", "named", "of_any_law", "require", "with_law"]

Ranges = dict[str, tuple[float, float]]


@dataclass(frozen=True, eq=False)
class Parts:
    """What gives the terms: the table some of them, a closed form the others; and the errors.

    Parameters
    ----------
    name : str
        The model.
    of_table : tuple of str
        The terms that the table gives.
    table : TableModel or None
        The table, under its law.
    form : ClosedForm
        The closed form.
    error : float
        Bound of the force's relative error beside finite elements of the law [-]; nan without one.
    law : str
        The law of dissipation.
    kappa : Amplification, optional
        What the terms are multiplied by.
    promised : float
        The bound of that beside finite elements on which the wire rubs [-]; nan without one.
    """

    name: str
    of_table: tuple[str, ...]
    table: TableModel | None
    form: Any
    error: float
    promised: float = math.nan
    law: str = PROJECTED
    kappa: Amplification | None = None

    def force(self, varying: tuple[str, ...], box: Ranges) -> ForceFunction:
        """Return the force."""
        plan = Plan(varying, box, self.form, self.table, self.of_table, self.law, self.kappa)
        return ForceFunction(plan, self.promised, data_of(self.table), self.error)


def cheapest(box: Ranges, terms: list[str], rtol: float) -> Parts:
    """Return as few terms of the table as will do, under the projected law."""
    known = candidates()
    errors = {}
    for choice in _choices(terms):
        errors[choice] = _error_of(known, box, terms, choice)
        if errors[choice] <= rtol:
            return _parts(known.fitted.models[OUTSIDE], choice, box, errors[choice])
    if terms:
        _require_domain(known.limits, box)
    require(min(errors.values()), rtol, "the table")
    raise AssertionError("an error above rtol is refused")


def _choices(terms: list[str]) -> list[tuple[str, ...]]:
    """Return which terms the table may give, in rising order of the cost."""
    return list(dict.fromkeys([(), *((term,) for term in terms), tuple(terms)]))


def _error_of(
    known: Candidates,
    box: Ranges,
    terms: Sequence[str],
    of_table: Sequence[str],
    beside: Beside | None = None,
    stand_ins: Mapping[str, str] | None = None,
) -> float:
    """Return the bound of the force's error with some terms of the table, others of Eq. (13)."""
    models = {term: OUTSIDE if term in of_table else FREE for term in terms}
    functions = dict(zip(TERMS, known.terms, strict=True))
    return force_error(known, box, models, functions, beside, stand_ins)


def _parts(table: Any, of_table: tuple[str, ...], box: Ranges, error: float) -> Parts:
    """Return the terms of a table, beside Eq. (13)."""
    if of_table:
        _require_domain(table.limits, box)
    form = FORCE_MODELS[FREE]
    used = table if of_table else None
    return Parts(table.name, of_table, used, form, error, law=table.law)


def named(model: object, box: Ranges, terms: list[str]) -> Parts:
    """Return the terms of a model."""
    chosen = force_model(model)
    if isinstance(chosen, TableModel):
        return _parts(chosen, tuple(terms), box, _error_of_table(chosen, box, terms))
    if isinstance(chosen, CoupledModel) and isinstance(chosen.slip, TableModel):
        return _coupled(chosen.slip, chosen.amplification, box, terms)
    if not isinstance(chosen, ClosedForm):
        raise InputError(
            "model must be one that a force can be prepared by, but "
            f"{chosen.name!r} is neither the table nor a closed form without a power; choose "
            "model='auto', 'table' or 'eq13'."
        )
    error = math.nan
    if chosen.name == FREE:
        error = _error_of(candidates(), box, terms, ())
    error = error if error < math.inf else math.nan
    return Parts(chosen.name, (), None, chosen, error)


def _error_of_table(
    table: TableModel, box: Ranges, terms: list[str], beside: Beside | None = None
) -> float:
    """Return the bound of the force's error; nan where nobody knows it."""
    if not terms:
        return 0.0
    fitted = candidates().fitted
    if getattr(fitted.models[OUTSIDE], "table", None) is not table.table:
        return math.nan  # the bounds are of another table
    if table.law != PROJECTED and fitted.slip_bounds is None:
        return math.nan
    error = _error_of(candidates(law=table.law), box, terms, terms, beside)
    return error if error < math.inf else math.nan


def _coupled(slip: TableModel, kappa: Amplification, box: Ranges, terms: list[str]) -> Parts:
    """Return the terms of a table times kappa."""
    _require_reach(kappa, box)

    def beside(g: tuple[float, float], alpha: tuple[float, float]) -> tuple[float, float]:
        error, most = bounds_over(kappa, g, alpha, box)
        return error, error + most

    error = _error_of_table(slip, box, terms, beside)
    parts = _parts(slip, tuple(terms), box, error)
    return replace(parts, law=COUPLED, kappa=kappa if terms else None, promised=error)


def of_any_law(box: Ranges, terms: list[str], table: Any, rtol: float | None) -> Parts:
    """Return the terms of one law for all scenes: the cheapest that is known to be exact enough.

    Without `rtol` one of 0.02 will do, and else the most exact there is. Where none is known it is
    the projected law, with the error of its own finite elements.
    """
    parts = _known_law(box, terms, table, rtol)
    if parts is None:
        auto = table is None
        parts = cheapest(box, terms, DEFAULT_RTOL) if auto else named(table, box, terms)
        parts = replace(parts, promised=math.nan if terms else 0.0)
    if rtol is not None and not parts.promised <= rtol:
        raise AccuracyError(_not_met(box, rtol, parts))
    return parts


def _known_law(box: Ranges, terms: list[str], named_table: Any, rtol: float | None) -> Parts | None:
    """Return the terms by the cheapest law whose error is known; None where that of none is."""
    kappa = amplification_of_models(named_table) if terms else None
    if kappa is None or uncovered(kappa, box) is not None:
        return None
    slip: Any = (named_table or candidates().fitted.models[OUTSIDE]).under(SLIP)
    if not isinstance(slip, TableModel):
        return None

    wanted, left_out = DEFAULT_RTOL if rtol is None else rtol, _left_out(kappa, box)
    known, possible = candidates(law=SLIP), []
    for choice in _choices(terms) if named_table is None else [tuple(terms)]:
        error = _error_of(known, box, terms, choice, left_out)
        if error < math.inf:
            first = _parts(slip, choice, box, _error_of(known, box, terms, choice))
            law = SLIP if choice else PROJECTED
            possible.append(replace(first, promised=error, law=law))
        if error <= wanted:
            return possible[-1]
    amplified = _coupled(slip, kappa, box, terms)
    possible += [amplified] if amplified.error == amplified.error else []
    return min(possible, key=lambda each: each.promised, default=None)


def _left_out(kappa: Amplification, box: Ranges) -> Beside:
    """Return by how much the logarithm of a term is off without kappa, and its true one away."""

    def most(g: tuple[float, float], alpha: tuple[float, float]) -> tuple[float, float]:
        largest = bounds_over(kappa, g, alpha, box)[1]
        return largest, largest

    return most


def with_law(parts: Parts, box: Ranges, terms: list[str]) -> Parts:
    """Return parts of a named law with the error of the fit and of the law together.

    Unknown where `parts.error` is, or to the loads of some scenes no coupled solution reaches.
    """
    if parts.law == COUPLED or not terms or parts.error != parts.error:
        return parts if terms else replace(parts, promised=0.0)
    kappa = amplification_of_models(parts.table)
    if kappa is None or uncovered(kappa, box) is not None:
        return parts
    known = candidates(law=SLIP)
    stand_ins = dict(zip(known.terms, TERMS, strict=True)) if parts.law == PROJECTED else None
    left_out = _left_out(kappa, box)
    error = _error_of(known, box, terms, parts.of_table, left_out, stand_ins)
    return replace(parts, promised=error if error < math.inf else math.nan)


def _not_met(box: Ranges, rtol: float, parts: Parts) -> str:
    """Return why no law keeps a promise."""
    error = parts.promised
    text = (
        "rtol must be met beside finite elements on which the wire rubs, all over the ranges, but "
        f"rtol = {rtol:g} is not: "
    )
    remedy = "rtol=None for the best there is, law='projected' or 'slip' for that of a law"
    if error == error:
        best = f"the error of the best law, {parts.law!r}, is up to {error:.2g}"
        return f"{text}{best}; give rtol={rounded_up(error)} or more, or {remedy}."
    kappa = amplification_of_models()
    gap = None if kappa is None else uncovered(kappa, box)
    where = f", as at {_words(*gap)}" if gap else ""
    return f"{text}that error is known to nobody{where}; give narrower ranges, {remedy}."


def _words(scene: Mapping[str, float], share: float) -> str:
    """Return where a load is not known."""
    g = g_range({name: (value, value) for name, value in scene.items()})[0]
    load = "where no coupled solution is near" if share == math.inf else f"{share:.3g} times it"
    if share <= 1.0:
        load = "which was not proven to be within it"
    return (
        f"xi = {scene['friction_coefficient']:.4g}, tau_w/mu = "
        f"{scene['wear_strength'] / scene['shear_modulus']:.4g} at g = {g:.4g}, alpha = "
        f"{scene[ALPHA]:.4g}, {load}"
    )


def _require_reach(kappa: Amplification, box: Ranges) -> None:
    gap = uncovered(kappa, box)
    if gap is not None:
        raise DomainError(
            "friction and wear must be at most the load that coupled solutions reach before the "
            f"tip touches the wire, all over the ranges, but there is {_words(*gap)}; give "
            "narrower ranges, or law='slip' or 'projected'."
        )


def require(error: float, rtol: float | None, who: str, where: str = "") -> None:
    """Raise an `AccuracyError` where a bound over the ranges is more than was asked for."""
    if rtol is not None and not error <= rtol:
        known = f"is up to {error:.2g}" if error < math.inf else f"is known to nobody{where}"
        remedy = f"rtol={rounded_up(error)} or more" if error < math.inf else "rtol=None"
        raise AccuracyError(
            f"rtol must be met all over the ranges, but rtol = {rtol:g} is not: the error of {who} "
            f"{known}; give {remedy}, or narrower ranges."
        )


def _require_domain(limits: Domain, box: Ranges) -> None:
    alpha, g = box[ALPHA], g_range(box)
    limits.alpha_quantity.checked(alpha[0])
    limits.alpha_quantity.checked(alpha[1])
    low, high = limits.g[0], lowest_of_highest(limits, alpha)
    if not (low <= g[0] and g[1] <= high):
        raise DomainError(
            f"g = Gamma_o/(mu R_w) must be from {low:g} to {high:g} all over the ranges, but is "
            f"from {g[0]:.4g} to {g[1]:.4g}; give narrower ranges, or choose model='eq13'."
        )


def data_of(table: TableModel | None) -> dict[str, str]:
    """Return where the coefficients come from."""
    if table is None:
        return {"source": "closed form of arXiv:2412.02021"}
    told = candidates().fitted.about.get("provenance", {})
    return {
        "source": "table of finite elements",
        **{key: str(told[key]) for key in ("data_date", "date", "design_hash") if key in told},
    }

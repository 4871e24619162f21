"""Preparing a force: law, model, terms and coefficients decided once and proven over ranges."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from surrogate.basics.checks import RTOL, items, mapping, one_number
from surrogate.choosing.by_name import AUTO, force_model, is_auto
from surrogate.choosing.candidates import FREE, OUTSIDE, TERMS, candidates
from surrogate.choosing.choice import rounded_up
from surrogate.choosing.laws import COUPLED, PROJECTED, SLIP, of_law
from surrogate.contact.closed_forms import FORCE_MODELS, ClosedForm
from surrogate.contact.domain import Domain
from surrogate.contact.table import TableModel
from surrogate.errors import AccuracyError, DomainError, InputError
from surrogate.prepared.function import ForceFunction
from surrogate.prepared.plan import ALPHA, Plan
from surrogate.prepared.proof import force_error, g_range, lowest_of_highest
from surrogate.scene import NAMES, QUANTITIES, Scene

__all__ = ["data_of", "prepare"]

Ranges = dict[str, tuple[float, float]]
DEFAULT_RTOL = 0.02
_DEFAULTS = {"friction_coefficient": 0.0, "wear_strength": 0.0, "stiffening_exponent": 2.0}
_STRENGTHS = {"arc": "wear_strength", "normal_load": "friction_coefficient"}
_EXAMPLE = "{'wire_radius': (1e-4, 1e-3)}"


def prepare(
    fixed: Scene | Mapping[str, float],
    varying: Sequence[str] = ("wire_radius",),
    ranges: Mapping[str, tuple[float, float]] | None = None,
    model: str = AUTO,
    rtol: float | None = None,
    law: str = PROJECTED,
) -> ForceFunction:
    """Return the force as a function of the quantities that vary, decided and proven once.

    Model, terms and coefficients are settled here, for all scenes of the ranges. A call does only
    what is left: one cubic of ln g where a single quantity varies.

    Parameters
    ----------
    fixed : Scene or mapping of str to float
        The quantities that do not vary, in SI units: a scene of numbers, whose values of what
        varies are not looked at, or a mapping of their names, as `Scene` has them.
    varying : sequence of str, default ("wire_radius",)
        Names of the quantities that vary, in the order in which calls take them.
    ranges : mapping of str to tuple of float
        The lowest and the highest value of each of them, in SI units.
    model : str, default "auto"
        "auto" for what is cheapest and has a proven error of at most `rtol` all over the ranges,
        term by term; "table"; "eq13", "high-toughness", "low-toughness" or "friction-free". Under
        the law "slip" the table is what there is, and "auto" stands for it.
    rtol : float, optional
        Largest relative error of the force that will do [-]; None for any, which with "auto" and
        the law "projected" is 0.02.
    law : str, default "projected"
        The law of dissipation, as `cutting_force` takes it: "projected" for Eq. (S2), "slip" for
        the balance of energy to first order in tau_w and xi.

    Returns
    -------
    ForceFunction
        The function, with its range, bound of error, derivative and inverse.

    Raises
    ------
    InputError
        If a quantity is missing, unknown, out of range or no number, the model cannot be
        prepared, there is no such law, or the model does not have it.
    UnknownModelError
        If there is no such model.
    DomainError
        If the ranges leave the domain of the table and it is needed.
    AccuracyError
        If `rtol` is not met all over the ranges; the message names the best bound.

    Notes
    -----
    Range of validity: the ranges. The bound of error holds all over them: it is made of the
    measured bounds of all cells of (g, alpha) that they touch, not of samples. Under the law "slip"
    there is none, and it is nan, where the ranges come near the g at which the crack's tip touches
    the wire, and beyond it at alpha up to 3: the slip there depends on how sharp the tip is.

    References
    ----------
    arXiv:2412.02021, Eqs. (10), (12), (13), (15) and (S2).

    Examples
    --------
    >>> gel = Scene(685.0, 1.6, 0.25e-3, friction_coefficient=0.0, wear_strength=7750.0)
    >>> force = prepare(gel, ranges={"wire_radius": (1e-4, 1e-3)})
    >>> force.monotonic, force.terms, force.relative_error <= 0.02
    ('rising', {'wear': 'table'}, True)
    >>> print(f"{1e3 * force.radius_for(7.0):.3f} mm")
    0.244 mm
    """
    box = _box(fixed, varying, ranges)
    if isinstance(law, str) and law == COUPLED:
        raise InputError(
            f"law must be one of {PROJECTED}, {SLIP} to prepare a force, but is {law!r}; choose "
            f"one, or call cutting_force with law={law!r}."
        )
    chosen = of_law(model, law)
    tolerance = None if rtol is None else one_number(RTOL, rtol)
    terms = [term for term in TERMS if box[_STRENGTHS[term]][1] > 0.0]
    if is_auto(chosen):
        parts = _cheapest(box, terms, DEFAULT_RTOL if tolerance is None else tolerance)
    else:
        parts = _named(chosen, box, terms)
        where = "" if law == PROJECTED else ", as it is where the crack's tip touches the wire"
        _require(parts.error, tolerance, repr(parts.name), where)
    _require_numbers(box)
    plan = Plan(tuple(varying), box, parts.form, parts.table, parts.of_table, law)
    return ForceFunction(plan, parts.error, data_of(parts.table))


class _Parts(NamedTuple):
    """What gives the terms: the table some of them, a closed form the others; and the error."""

    name: str
    of_table: tuple[str, ...]
    table: TableModel | None
    form: Any
    error: float


def _box(fixed: Any, varying: Any, ranges: Any) -> Ranges:
    """Return the ends of all six quantities."""
    names = items("varying", varying, "('wire_radius',)")
    unknown = [name for name in names if not isinstance(name, str) or name not in NAMES]
    if unknown or not names or len(set(names)) < len(names):
        raise InputError(
            f"varying must name different quantities of a scene, but is {names!r}; choose among "
            f"{', '.join(NAMES)}."
        )
    wanted = dict(mapping("ranges", {} if ranges is None else ranges, _EXAMPLE))
    if set(wanted) != set(names):
        raise InputError(
            f"ranges must have the two ends of {', '.join(names)}, but have those of "
            f"{', '.join(map(str, wanted)) or 'nothing'}; give for instance {_EXAMPLE}."
        )
    values = _values(fixed, names)
    box = {}
    for quantity in QUANTITIES:
        if quantity.name in names:
            ends = items(f"ranges[{quantity.name!r}]", wanted[quantity.name], "(1e-4, 1e-3)")
            if len(ends) != 2:
                raise InputError(
                    f"ranges[{quantity.name!r}] must be two numbers, but are {len(ends)}; give the "
                    "lowest and the highest value."
                )
            low, high = (one_number(quantity, end) for end in ends)
            if not low < high:
                raise InputError(
                    f"ranges[{quantity.name!r}] must rise, but are from {low:g} to {high:g} "
                    f"{quantity.unit}; give the lowest value first."
                )
            box[quantity.name] = low, high
        else:
            value = one_number(quantity, values[quantity.name])
            box[quantity.name] = value, value
    return box


def _values(fixed: Any, varying: tuple[str, ...]) -> dict[str, Any]:
    """Return the quantities that do not vary."""
    if isinstance(fixed, Scene):
        return dict(zip(NAMES, fixed.values(), strict=True))
    values = {**_DEFAULTS, **mapping("fixed", fixed, "{'shear_modulus': 685.0}")}
    unknown = [name for name in values if name not in NAMES]
    missing = [name for name in NAMES if name not in values and name not in varying]
    if unknown or missing:
        what = f"{missing[0]} is missing" if missing else f"{unknown[0]!r} is unknown"
        raise InputError(
            f"fixed must have every quantity that does not vary, but {what}; give a Scene, or "
            f"some of {', '.join(NAMES)}."
        )
    return values


def _cheapest(box: Ranges, terms: list[str], rtol: float) -> _Parts:
    """Return as few terms of the table as will do."""
    known = candidates()
    choices = [(), *((term,) for term in terms), tuple(terms)]
    errors = {}
    for choice in dict.fromkeys(choices):
        models = {term: OUTSIDE if term in choice else FREE for term in terms}
        errors[choice] = force_error(known, box, models, {term: term for term in terms})
        if errors[choice] <= rtol:
            return _parts(known.fitted.models[OUTSIDE], choice, box, errors[choice])
    if terms:
        _require_domain(known.limits, box)
    _require(min(errors.values()), rtol, "the table")
    raise AssertionError("an error above rtol is refused")


def _parts(table: Any, of_table: tuple[str, ...], box: Ranges, error: float) -> _Parts:
    """Return the terms of a table, beside Eq. (13)."""
    if of_table:
        _require_domain(table.limits, box)
    return _Parts(table.name, of_table, table if of_table else None, FORCE_MODELS[FREE], error)


def _named(model: object, box: Ranges, terms: list[str]) -> _Parts:
    """Return the terms of a model."""
    chosen = force_model(model)
    if isinstance(chosen, TableModel):
        return _parts(chosen, tuple(terms), box, _error_of_table(chosen, box, terms))
    if not isinstance(chosen, ClosedForm):
        raise InputError(
            "model must be one that a force can be prepared by, but "
            f"{chosen.name!r} is neither the table nor a closed form without a power; choose "
            "model='auto', 'table' or 'eq13'."
        )
    error = math.nan
    if chosen.name == FREE:
        models, functions = dict.fromkeys(terms, FREE), {term: term for term in terms}
        error = force_error(candidates(), box, models, functions)
    return _Parts(chosen.name, (), None, chosen, error if error < math.inf else math.nan)


def _error_of_table(table: TableModel, box: Ranges, terms: list[str]) -> float:
    """Return the bound of the force's error; nan where nobody knows it."""
    if not terms:
        return 0.0
    fitted = candidates().fitted
    if getattr(fitted.models[OUTSIDE], "table", None) is not table.table:
        return math.nan  # the bounds are of another table
    if table.law != PROJECTED and fitted.slip_bounds is None:
        return math.nan
    known = candidates(law=table.law)
    functions = dict(zip(TERMS, known.terms, strict=True))
    error = force_error(known, box, dict.fromkeys(terms, OUTSIDE), functions)
    return error if error < math.inf else math.nan


def _require(error: float, rtol: float | None, who: str, where: str = "") -> None:
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


def _require_numbers(box: Ranges) -> None:
    """Refuse scenes whose products leave the range of numbers, so that no call has to look."""
    divisor = [box["shear_modulus"][i] * box["wire_radius"][i] for i in (0, 1)]
    strengths = box["wear_strength"][1] + box["friction_coefficient"][1] * box["shear_modulus"][1]
    largest = (
        1e3
        * (strengths * box["wire_radius"][1] + box["toughness"][1])
        * (1.0 + box["friction_coefficient"][1])
    )
    if divisor[0] < 1e-300 or not largest < 1e300 or not divisor[1] < 1e300:
        raise InputError(
            "the products of the ranges must be in the range of numbers, but mu R_w is from "
            f"{divisor[0]:g} to {divisor[1]:g} N/m; take cutting_force for such scenes."
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

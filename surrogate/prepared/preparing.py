"""Preparing a force: law, model, terms and coefficients decided once and proven over ranges."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from surrogate.basics.checks import RTOL, items, mapping, one_number
from surrogate.choosing.accuracy import DEFAULT_RTOL
from surrogate.choosing.by_name import AUTO, is_auto
from surrogate.choosing.candidates import TERMS
from surrogate.choosing.laws import SLIP, AnyLaw, of_law
from surrogate.errors import InputError
from surrogate.prepared.deciding import (
    Parts,
    Ranges,
    cheapest,
    named,
    of_any_law,
    require,
    with_law,
)
from surrogate.prepared.function import ForceFunction
from surrogate.scene import NAMES, QUANTITIES, Scene

__all__ = ["prepare"]

_DEFAULTS = {"friction_coefficient": 0.0, "wear_strength": 0.0, "stiffening_exponent": 2.0}
_STRENGTHS = {"arc": "wear_strength", "normal_load": "friction_coefficient"}
_EXAMPLE = "{'wire_radius': (1e-4, 1e-3)}"


def prepare(
    fixed: Scene | Mapping[str, float],
    varying: Sequence[str] = ("wire_radius",),
    ranges: Mapping[str, tuple[float, float]] | None = None,
    model: str = AUTO,
    rtol: float | None = None,
    law: str = AUTO,
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
        the laws "slip" and "coupled" the table is what there is, and "auto" stands for it.
    rtol : float, optional
        Largest relative error of the force that will do [-]. None for any, which with the model
        "auto" and the law "projected" is 0.02; with the law "auto" it is 0.02 where one is known to
        keep it, else the best there is. With the laws "auto" and "coupled" it is the error beside
        finite elements on which the wire rubs, with a named "projected" or "slip" `fit_error`.
    law : str, default "auto"
        The law of dissipation, as `cutting_force` takes it: "projected" for Eq. (S2), "slip" for
        the balance of energy to first order in tau_w and xi, "coupled" for the stresses acting on
        the body, which has to be known all over the ranges. "auto" takes one law for all scenes of
        the ranges: the cheapest whose error beside finite elements on which the wire rubs is proven
        to be at most `rtol` all over them. Where nobody knows that error it is "projected", with
        effective strengths tau_w and xi: `relative_error` is nan then, and `fit_error` that beside
        finite elements of this law. Closed forms are of the law "projected".

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
        If the ranges leave the domain of the table and it is needed, or under the law "coupled" the
        loads that its solutions reach.
    AccuracyError
        If `rtol` is not met all over the ranges; the message names the best bound.

    Notes
    -----
    Range of validity: the ranges. The bound of error holds all over them: it is made of the
    measured bounds of all cells of (g, alpha) that they touch, not of samples. That "coupled" is
    known all over them is proven in boxes of scenes, which are halved until the largest load of
    each is below its least reach, or one of their corners is beyond it. Under the law "slip" there
    is no bound, and it is nan, where the ranges come near the g at which the crack's tip touches
    the wire, and beyond it at alpha up to 3: the slip there depends on how sharp the tip is.

    References
    ----------
    arXiv:2412.02021, Eqs. (10), (12), (13), (15) and (S2).

    Examples
    --------
    >>> gel = Scene(685.0, 1.6, 0.25e-3, friction_coefficient=0.0, wear_strength=7750.0)
    >>> force = prepare(gel, ranges={"wire_radius": (1e-4, 1e-3)})
    >>> force.monotonic, force.terms, force.law, force.fit_error <= 0.02, force.relative_error
    ('rising', {'wear': 'table'}, 'projected', True, nan)
    >>> print(f"{1e3 * force.radius_for(7.0):.3f} mm")
    0.243 mm
    >>> tissue = Scene(10e3, 5.0, 0.5e-3, 0.02, 1500.0, 6.0)
    >>> force = prepare(tissue, ranges={"wire_radius": (4e-4, 1e-3)})
    >>> force.law, force.relative_error <= 0.05
    ('coupled', True)
    """
    box = _box(fixed, varying, ranges)
    tolerance = None if rtol is None else one_number(RTOL, rtol)
    terms = [term for term in TERMS if box[_STRENGTHS[term]][1] > 0.0]
    _require_numbers(box)
    return _decided(box, terms, model, law, tolerance).force(tuple(varying), box)


def _decided(box: Ranges, terms: list[str], model: Any, law: Any, rtol: float | None) -> Parts:
    chosen = of_law(model, law, any_law=True)
    if isinstance(chosen, AnyLaw):
        return of_any_law(box, terms, chosen.named, rtol)
    if is_auto(chosen):
        parts = cheapest(box, terms, DEFAULT_RTOL if rtol is None else rtol)
        return with_law(parts, box, terms)
    parts = named(chosen, box, terms)
    where = ", as it is where the crack's tip touches the wire" if law == SLIP else ""
    require(parts.error, rtol, repr(parts.name), where)
    return with_law(parts, box, terms)


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

"""Which boundaries a regime map has, and what holds on them.

Terms are those that can dominate: for Eq. (13) toughness with its friction, wear, and friction of
stiffness; for other models the parts of the force.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import combinations
from typing import Any

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.checks import items
from surrogate.basics.records import share
from surrogate.choosing.by_name import force_model
from surrogate.choosing.laws import AnyLaw
from surrogate.contact.base import ForceModel
from surrogate.contact.closed_forms import FORCE_MODELS, ClosedForm, formula_name
from surrogate.cutting.force import force_of
from surrogate.cutting.regimes import (
    CONTACTS,
    SPLIT_MODEL,
    TOUCHING_TOUGHNESS,
    touching_toughness,
)
from surrogate.maps.lines import Boundary, Lines, contours, exact_lines
from surrogate.maps.record import MapRecord
from surrogate.maps.scenes import Monomial

__all__ = ["LIMITS", "boundaries", "limit_names"]

Array = NDArray[np.float64]
Sum = tuple[Monomial, ...]

LIMITS = ("high-toughness", "low-toughness", "friction-free", "eq13")
"""Models that are limits of others: Eqs. (10), (12), (15) and (13)."""

_TEXT = {
    "toughness-and-friction": ("(1 + xi) Gamma_o", r"(1+\xi)\,\Gamma_o"),
    "wear": ("4 tau_w R_w", r"4\,\tau_w R_w"),
    "friction-stiffness": ("4 xi mu R_w", r"4\,\xi\mu R_w"),
}
_PART_TEXT = {
    "cleavage": ("Gamma_o", r"\Gamma_o"),
    "friction": ("2 xi mu R_w B", r"2\,\xi\mu R_w B"),
    "wear": ("2 tau_w R_w A", r"2\,\tau_w R_w A"),
}


def limit_names(limits: object) -> tuple[str, ...]:
    """Return validated names of models whose limits are wanted.

    Raises
    ------
    InputError
        If `limits` is no list.
    UnknownModelError
        If a limit is no model.

    Examples
    --------
    >>> limit_names(["eq13"])
    ('eq13',)
    """
    names = items("limits", limits, "['high-toughness']")
    for name in names:
        force_model(name, "a name in limits")
    return names


def boundaries(record: MapRecord, limits: tuple[str, ...]) -> tuple[Boundary, ...]:
    """Return every boundary that crosses the map.

    Raises
    ------
    WirecutError
        If contours are needed and contourpy is not installed.
    """
    found = [
        *_equal_terms(record),
        *_dominance(record, record.regime.threshold),
        *(_limit(record, limit, record.miss) for limit in limits if limit != record.model),
        _contact(record),
    ]
    return tuple(one for one in found if one.lines)


def _equal_terms(record: MapRecord) -> Iterator[Boundary]:
    sums = _term_sums(record)
    text = _texts(record.model)
    for one, other in combinations(record.term_shares, 2):
        lines = None
        if sums is not None:
            lines = exact_lines((*sums[one], *_times(-1.0, sums[other])), record.x, record.y)
        exact = lines is not None
        if lines is None:
            with np.errstate(all="ignore"):
                log_ratio = np.log(record.term_shares[one]) - np.log(record.term_shares[other])
            lines = _contours(record, log_ratio, 0.0)
        (left, left_symbol), (right, right_symbol) = text[one], text[other]
        yield Boundary(
            "equal-terms",
            (one, other),
            f"{left} = {right}",
            f"{left_symbol}={right_symbol}",
            exact,
            lines,
        )


def _dominance(record: MapRecord, threshold: float) -> Iterator[Boundary]:
    sums = _term_sums(record)
    text = _texts(record.model)
    for one in record.term_shares:
        lines = None
        if sums is not None:
            rest = [m for name in sums if name != one for m in _times(-threshold, sums[name])]
            own = _times(1.0 - threshold, sums[one])
            lines = exact_lines((*own, *rest), record.x, record.y)
        exact = lines is not None
        if lines is None:
            lines = _contours(record, record.term_shares[one], threshold)
        plain, symbol = text[one]
        yield Boundary(
            "dominance",
            (one,),
            f"{plain} = {share(threshold)} F_ss/T",
            rf"{symbol}={share(threshold)}\,F_{{ss}}/T",
            exact,
            lines,
        )


def _limit(record: MapRecord, limit: str, miss: float) -> Boundary:
    """Return where a limit is off by a share, above or below."""
    sums = _force_sum(record, limit), _force_sum(record, record.model)
    lines: Lines | None = None
    if None not in sums:
        pieces = [
            exact_lines(_collected((*sums[0], *_times(-factor, sums[1]))), record.x, record.y)  # type: ignore[misc, arg-type]
            for factor in (1.0 - miss, 1.0 + miss)
        ]
        if None not in pieces:
            lines = tuple(line for piece in pieces for line in piece)  # type: ignore[union-attr]
    exact = lines is not None
    if lines is None:
        force = force_of(record.scene, limit, extrapolate=True).total
        with np.errstate(all="ignore"):
            off = np.divide(force, record.force.total) - 1.0
        lines = (*_contours(record, off, -miss), *_contours(record, off, miss))
    name = formula_name(limit)
    part = f"{100.0 * miss:.3g}"
    equation, symbol = f"{name} is off by {part} %", rf"\mathrm{{{name}}}\ {part}\,\%"
    return Boundary("limit", (limit,), equation, symbol, exact, lines)


def _contact(record: MapRecord) -> Boundary:
    """Return where the wire begins to touch the crack tip."""
    touch = touching_toughness(record.model, record.scene.stiffening_exponent)
    of = record.quantities
    toughness = of["toughness"]
    stiffness = of["shear_modulus"] * of["wire_radius"]
    lines = None
    if isinstance(touch, float):
        lines = exact_lines((toughness, *_times(-touch, (stiffness,))), record.x, record.y)
    exact = lines is not None
    if lines is None:
        log_g = np.log((toughness * stiffness**-1)(record.x.values, record.y.values[:, np.newaxis]))
        lines = _contours(record, log_g - np.log(touch), 0.0)
    own = touch is not TOUCHING_TOUGHNESS
    value = ("g_touch", r"g_{\rm touch}") if own else ("1", "1")
    return Boundary("contact", CONTACTS, f"g = {value[0]}", f"g={value[1]}", exact, lines)


def _texts(model: str | ForceModel | AnyLaw) -> Mapping[str, tuple[str, str]]:
    return _TEXT if model == SPLIT_MODEL else _PART_TEXT


def _term_sums(record: MapRecord) -> dict[str, Sum] | None:
    """Return each term as a sum of monomials, or None where the model is no such sum."""
    parts = _part_sums(record, record.model)
    if parts is None or record.model != SPLIT_MODEL:
        return parts
    of_toughness, of_stiffness = parts["friction"]
    return {
        "toughness-and-friction": (*parts["cleavage"], of_toughness),
        "wear": parts["wear"],
        "friction-stiffness": (of_stiffness,),
    }


def _part_sums(record: MapRecord, model: str | ForceModel | AnyLaw) -> dict[str, Sum] | None:
    form = FORCE_MODELS.get(model) if isinstance(model, str) else model
    if not isinstance(form, ClosedForm):
        return None
    of = record.quantities
    xi, radius = of["friction_coefficient"], of["wire_radius"]
    return {
        "cleavage": (of["toughness"],),
        "friction": (
            *_times(form.load_2_slope, (xi * of["toughness"],)),
            *_times(form.load_2, (xi * of["shear_modulus"] * radius,)),
        ),
        "wear": _times(form.arc_2, (of["wear_strength"] * radius,)),
    }


def _force_sum(record: MapRecord, model: str | ForceModel | AnyLaw) -> Sum | None:
    parts = _part_sums(record, model)
    return None if parts is None else tuple(one for part in parts.values() for one in part)


def _times(factor: float, terms: Sum) -> Sum:
    return tuple(Monomial(factor * one.factor, one.p, one.q) for one in terms)


def _collected(terms: Sum) -> Sum:
    """Return the sum with one monomial for each pair of powers, so that equal ones cancel."""
    factors: dict[tuple[int, int], float] = {}
    for one in terms:
        factors[one.p, one.q] = factors.get((one.p, one.q), 0.0) + one.factor
    return tuple(Monomial(factor, *powers) for powers, factor in factors.items())


def _contours(record: MapRecord, values: Any, level: float) -> Lines:
    """Return where values at the nodes have a level."""
    whole = np.broadcast_to(
        np.asarray(values, dtype=float), (record.y.values.size, record.x.values.size)
    )
    return contours(whole, level, record.x, record.y)

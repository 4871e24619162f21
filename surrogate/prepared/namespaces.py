"""Prepared forces on arrays of other libraries, by the Array API: in their library and device.

Nothing but functions of the standard is called; it is tested with array-api-strict. Where a library
traces a program, values cannot be looked at: there `outside` must be "nan".
"""

from __future__ import annotations

from typing import Any

import numpy as np

from surrogate.errors import InputError
from surrogate.prepared.line import Line
from surrogate.prepared.plan import ALPHA, ARC, GAMMA, LOAD, MU, RADIUS, WEAR, XI

__all__ = ["evaluate_elsewhere"]


def evaluate_elsewhere(force: Any, xp: Any, values: list[Any], outside: str) -> Any:
    """Return the force of arrays of a namespace.

    Raises
    ------
    DomainError
        If a value is outside its range, and `outside` is "raise".
    InputError
        If `outside` is "raise" and the values cannot be looked at.
    """
    wrong: Any = None
    inside: dict[str, Any] = {}
    for quantity, value in zip(force.quantities, values, strict=True):
        bad = ~((value >= quantity.lower) & (value <= quantity.upper))
        if isinstance(value, (int, float)):
            inside[quantity.name] = quantity.checked(value)
            continue
        if outside == "raise":
            _refuse(xp, quantity, value, bad)
        else:
            wrong = bad if wrong is None else wrong | bad
            value = xp.where(bad, xp.full_like(value, quantity.lower), value)
        inside[quantity.name] = value
    result = _force(force.plan, xp, {**force.plan.fixed, **inside})
    return result if wrong is None else xp.where(wrong, xp.full_like(result, np.nan), result)


def _refuse(xp: Any, quantity: Any, value: Any, bad: Any) -> None:
    try:
        refused = bool(xp.any(bad))
    except Exception as error:  # every library has its own for values that are traced
        raise InputError(
            "outside must be 'nan' where the values cannot be looked at, as in a traced program "
            f"({type(error).__name__}); give outside='nan'."
        ) from None
    if refused:
        quantity.checked(np.asarray(value, float))


def _force(plan: Any, xp: Any, v: dict[str, Any]) -> Any:
    friction, worn = plan.form.terms(v[MU], v[GAMMA], v[RADIUS], v[XI], v[WEAR], 2.0)
    values = _functions(plan, xp, v) if plan.of_table else {}
    if ARC in values:
        worn = 2.0 * (v[WEAR] * v[RADIUS]) * values[ARC]
    if LOAD in values:
        friction = 2.0 * (v[RADIUS] * (v[XI] * v[MU])) * values[LOAD]
    zero = sum(0.0 * v[name] for name in plan.varying)  # the shape, where nothing else varies
    return v[GAMMA] + friction + worn + zero


def _functions(plan: Any, xp: Any, v: dict[str, Any]) -> dict[str, Any]:
    g = v[GAMMA] / (v[MU] * v[RADIUS])
    alpha = v[ALPHA]
    like = next(x for x in v.values() if not isinstance(x, (int, float)))
    log_g = xp.log(g) if not isinstance(g, float) else float(np.log(g))
    if plan.lines:
        return {t: _on_line(xp, line, log_g, like) for t, line in plan.lines.items()}
    grid, table = plan.table.table.grid, plan.table.table
    row = xp.log(alpha) if not isinstance(alpha, float) else float(np.log(alpha))
    touch = 0.0
    for coefficient in grid.touch[::-1]:
        touch = touch * row + coefficient
    x = log_g - touch
    t = xp.where(x < 0.0, grid.short / (touch - grid.log_g), grid.past / grid.beyond) * x
    cell, t = _cell(xp, t + grid.short, grid.cells - 1)
    low, high = grid.log_alpha
    column, s = _cell(xp, (row - low) * (grid.stiffening / (high - low)), grid.stiffening - 1)
    index = cell * grid.stiffening + column
    names = dict(zip((ARC, LOAD), plan.table.rubbing, strict=True))
    return {
        term: _bicubic(
            xp, xp.asarray(table.cells(names[term]).ravel(), dtype=like.dtype), index, t, s
        )
        for term in plan.of_table
    }


def _on_line(xp: Any, line: Line, log_g: Any, like: Any) -> Any:
    pieces = xp.asarray(line.pieces.ravel(), dtype=like.dtype)
    if isinstance(log_g, float):
        return line.number(log_g)
    x = log_g - line.touch
    t = xp.where(x < 0.0, line.before * x, line.after * x) + line.short
    piece, t = _cell(xp, t, len(line.pieces) - 1)
    return _cubic([_taken(xp, pieces, 4 * piece + k) for k in range(4)], t)


def _bicubic(xp: Any, cells: Any, index: Any, t: Any, s: Any) -> Any:
    rows = [
        _cubic([_taken(xp, cells, 16 * index + 4 * k + m) for m in range(4)], s) for k in range(4)
    ]
    return _cubic(rows, t)


def _cell(xp: Any, place: Any, last: int) -> tuple[Any, Any]:
    """Return the cell of places and how far they are in it."""
    number = xp.astype(xp.floor(place), xp.int32)
    number = xp.where(number < 0, xp.zeros_like(number), number)
    number = xp.where(number > last, xp.full_like(number, last), number)
    return number, place - xp.astype(number, place.dtype)


def _taken(xp: Any, values: Any, index: Any) -> Any:
    return xp.reshape(xp.take(values, xp.reshape(index, (-1,)), axis=0), index.shape)


def _cubic(c: list[Any], t: Any) -> Any:
    return c[0] + t * (c[1] + t * (c[2] + t * c[3]))

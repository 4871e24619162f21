"""Prepared forces on arrays of other libraries, by the Array API: in their library and device.

Nothing but functions of the standard is called; it is tested with array-api-strict and jax. Where a
library traces a program, as jax does for jit, grad and vmap, values cannot be looked at: there
`outside` must be "nan".

In float32 x = ln(g/g_touch) is off by up to about 100 roundings u = 2**-24: 4 u of the quotient,
|ln g| u, |x| u, 2 |x| u + 2 |ln(g_touch/g_low)| u of the place in a piece, with no logarithm above
17, and as much as |ln g_touch| u + 6 ln(alpha) u of g_touch where alpha varies. As the slope
|d ln F/d ln g| is at most about 1, the force is off by up to `SINGLE` of itself. About the middle
of what is known of kappa the terms of ln kappa are up to 500 together, mostly about 1, of which
each of up to 22 multiplications and additions loses 2 u: with kappa it is `SINGLE_COUPLED` at
worst.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np

from surrogate.errors import InputError
from surrogate.prepared.line import Line
from surrogate.prepared.plan import ALPHA, ARC, FACTORS, GAMMA, LOAD, MU, RADIUS

__all__ = ["SINGLE", "SINGLE_COUPLED", "evaluate_elsewhere", "is_foreign"]

SINGLE = 6e-6
SINGLE_COUPLED = 1.3e-3
"""Largest relative errors that float32 adds to a force, see above."""


def is_foreign(value: Any) -> bool:
    """Return whether a value is an array of another library's namespace."""
    if isinstance(value, (float, int, np.ndarray, np.generic)):
        return False
    return hasattr(value, "__array_namespace__")


def evaluate_elsewhere(force: Any, values: list[Any], outside: str) -> Any:
    """Return the force of values, the first foreign of which tells the namespace.

    Raises
    ------
    DomainError
        If a value is outside its range, and `outside` is "raise".
    InputError
        If an array has other numbers than floating-point ones of 32 or 64 bits or integers, or
        `outside` is "raise" and the values cannot be looked at.
    """
    like = next(filter(is_foreign, values))
    xp = like.__array_namespace__()
    dtype = _float_type(xp, like)
    arrays = [
        _converted(xp, quantity, value, like, dtype)
        for quantity, value in zip(force.quantities, values, strict=True)
    ]
    wrong: Any = None
    inside: dict[str, Any] = {}
    for quantity, value in zip(force.quantities, arrays, strict=True):
        bad = ~((value >= quantity.lower) & (value <= quantity.upper))
        if outside == "raise":
            _refuse(xp, quantity, value, bad)
        else:
            wrong = bad if wrong is None else wrong | bad
            value = xp.where(bad, xp.full_like(value, quantity.lower), value)
        inside[quantity.name] = value
    result = _force(force.plan, xp, {**force.plan.fixed, **inside})
    if wrong is None:
        return result
    # a factor of the values, so that the derivatives are nan there, too, and are none elsewhere
    zero = xp.zeros_like(result)
    return result + xp.where(wrong, xp.full_like(result, math.nan), zero) * _sum(arrays)


def _float_type(xp: Any, like: Any) -> Any:
    """Return the type to evaluate in: that of the array, or the library's own beside integers."""
    if xp.isdtype(like.dtype, "integral"):
        return xp.asarray(0.0).dtype
    if not xp.isdtype(like.dtype, "real floating") or xp.finfo(like.dtype).bits < 32:
        raise InputError(
            "the values must be of float32, float64 or integers, but are of "
            f"{like.dtype}; convert them."
        )
    return like.dtype


def _converted(xp: Any, quantity: Any, value: Any, like: Any, dtype: Any) -> Any:
    """Return a value as an array of the namespace."""
    if is_foreign(value):
        return value if value.dtype == dtype else xp.astype(value, dtype)
    anything = replace(quantity, lower=-np.inf, upper=np.inf)
    return _constant(xp, anything.checked(value), like, dtype)


def _constant(xp: Any, values: Any, like: Any, dtype: Any) -> Any:
    """Return numbers as an array on the device of another."""
    device = getattr(like, "device", None)  # which a traced array has not
    return xp.asarray(values, dtype=dtype, device=device)


def _sum(arrays: list[Any]) -> Any:
    total = arrays[0]
    for array in arrays[1:]:
        total = total + array
    return total


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
    total = 0.0 * _sum([v[name] for name in plan.varying])  # of the shape, whatever the terms
    for coefficient, names in plan.free:
        total = total + _product(coefficient, names, v)
    kappa = _kappa(plan, xp, v) if plan.load else 1.0
    for term, value in (_functions(plan, xp, v) if plan.of_table else {}).items():
        total = total + _product(2.0, FACTORS[term], v) * value * kappa
    return total


def _kappa(plan: Any, xp: Any, v: dict[str, Any]) -> Any:
    variables, polynomial = plan.load.variables(v, xp.log, xp.log1p), plan.load.polynomial
    log_kappa = polynomial(*variables)
    return math.exp(log_kappa) if isinstance(log_kappa, float) else xp.exp(log_kappa)


def _product(factor: Any, names: tuple[str, ...], v: dict[str, Any]) -> Any:
    for name in names:
        factor = factor * v[name]
    return factor


def _functions(plan: Any, xp: Any, v: dict[str, Any]) -> dict[str, Any]:
    g = v[GAMMA] / (v[MU] * v[RADIUS])
    alpha = v[ALPHA]
    like = next(x for x in v.values() if not isinstance(x, (int, float)))
    log_g = xp.log(g) if not isinstance(g, float) else float(np.log(g))
    if plan.lines:
        return {t: _on_line(xp, line, log_g, like) for t, line in plan.lines.items()}
    grid, table = plan.table.table.grid, plan.table.table
    row = xp.log(alpha) if not isinstance(alpha, float) else float(np.log(alpha))
    low, high = grid.log_alpha
    touch = _touch(grid.touch, 0.5 * (low + high), row)
    x = log_g - touch
    t = xp.where(x < 0.0, grid.short / (touch - grid.log_g), grid.past / grid.beyond) * x
    cell, t = _cell(xp, t + grid.short, grid.cells - 1)
    column, s = _cell(xp, (row - low) * (grid.stiffening / (high - low)), grid.stiffening - 1)
    index = cell * grid.stiffening + column
    names = dict(zip((ARC, LOAD), plan.table.rubbing, strict=True))
    found = {}
    for term in plan.of_table:
        c = _rows(xp, table.cells(names[term]), index, like)
        along = [_cubic([c[..., 4 * k + m] for m in range(4)], s) for k in range(4)]
        found[term] = _cubic(along, t)
    return found


def _touch(coefficients: tuple[float, ...], middle: float, row: Any) -> Any:
    """Return ln g_touch, about the middle of ln alpha, where terms do not cancel."""
    about = np.polynomial.Polynomial(coefficients)(np.polynomial.Polynomial([middle, 1.0]))
    value, away = 0.0, row - middle
    for coefficient in about.coef.tolist()[::-1]:
        value = value * away + coefficient
    return value


def _on_line(xp: Any, line: Line, log_g: Any, like: Any) -> Any:
    if isinstance(log_g, float):
        return line.number(log_g)
    x = log_g - line.touch
    t = xp.where(x < 0.0, line.before * x, line.after * x) + line.short
    piece, t = _cell(xp, t, len(line.pieces) - 1)
    c = _rows(xp, line.pieces, piece, like)
    return _cubic([c[..., k] for k in range(4)], t)


def _cell(xp: Any, place: Any, last: int) -> tuple[Any, Any]:
    """Return the cell of places and how far they are in it."""
    number = xp.astype(xp.floor(place), xp.int32)
    number = xp.where(number < 0, xp.zeros_like(number), number)
    number = xp.where(number > last, xp.full_like(number, last), number)
    return number, place - xp.astype(number, place.dtype)


def _rows(xp: Any, rows: Any, index: Any, like: Any) -> Any:
    """Return rows of numbers as an array of the shape of the index and one axis more."""
    taken = xp.take(_constant(xp, rows, like, like.dtype), xp.reshape(index, (-1,)), axis=0)
    return xp.reshape(taken, (*index.shape, rows.shape[1]))


def _cubic(c: list[Any], t: Any) -> Any:
    return c[0] + t * (c[1] + t * (c[2] + t * c[3]))

"""Evaluation of one formula on floats and on arrays, bit for bit alike.

A kernel is a function of validated floats that works as well where some are float64 blocks.
Large arrays are walked in blocks, so that a formula of any length needs no temporary of full
size.

`product`, `quotient` and `proportion` round like the plain expressions, but stay right where
only an intermediate result over- or underflows. Overflow of the result itself gives infinity,
the correctly rounded answer, silently.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterable, Sequence
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.checks import (
    LARGEST,
    FloatOrArray,
    Quantity,
    broadcast_shape,
    common_shape,
)

__all__ = [
    "AT_ONCE",
    "WHOLE",
    "Kernel",
    "all_normal",
    "apply",
    "dense",
    "evaluate",
    "evaluate_checked",
    "exp",
    "expm1",
    "larger",
    "log",
    "over_sum",
    "product",
    "proportion",
    "quotient",
    "ratio",
    "scaled",
    "where",
    "where_normal",
]

Kernel: TypeAlias = Callable[..., Any]

WHOLE = 2**20  # results up to this size are computed at once, in which numpy is quickest
BLOCK = 2**16  # larger ones this many numbers at a time, to save memory
AT_ONCE = 2**14  # points of long formulas at a time, whose temporaries stay in the cache
NORMAL = sys.float_info.min  # smaller numbers have lost digits
_FLOATS = {float}
NO_POWER = -99999  # power of two of zero: less than any product of a few numbers has


def evaluate(
    kernel: Kernel, quantities: Sequence[Quantity], values: tuple[object, ...]
) -> FloatOrArray:
    """Return `kernel(*values)`, validated; quick for floats from 0 to the largest.

    For quantities that admit every such float; `evaluate_checked` serves the others.
    """
    for value in values:
        if type(value) is not float or not 0.0 <= value <= 1.7976931348623157e308:
            return evaluate_checked(kernel, quantities, values)
    return kernel(*values)  # type: ignore[no-any-return]


def evaluate_checked(
    kernel: Kernel, quantities: Sequence[Quantity], values: tuple[object, ...]
) -> FloatOrArray:
    """Return `kernel(*values)`, validated against any quantities."""
    checked = tuple(q.checked(value) for q, value in zip(quantities, values, strict=True))
    broadcast_shape(tuple(q.name for q in quantities), checked)
    return apply(kernel, checked)  # type: ignore[no-any-return]


def apply(
    kernel: Kernel,
    values: Sequence[FloatOrArray],
    dtypes: Sequence[Any] = (float,),
    whole: int = WHOLE,
) -> Any:
    """Return `kernel(*values)` for validated values that broadcast.

    The kernel returns a tuple of as many results as there are dtypes, or one by itself, and
    never one of its arguments. Floats reach it as they are, so that what depends on them alone
    is computed once. More than `whole` points are walked in blocks.
    """
    if {*map(type, values)} == _FLOATS:
        return kernel(*values)
    shape = common_shape(values)
    if math.prod(shape) > whole:
        results = _in_blocks(kernel, values, dtypes, min(whole, BLOCK))
    else:
        with np.errstate(all="ignore"):
            at_once = kernel(*values)
        results = tuple(
            result if np.shape(result) == shape else np.full(shape, result)
            for result in (at_once if len(dtypes) > 1 else (at_once,))
        )
    return results if len(dtypes) > 1 else results[0]


def _in_blocks(
    kernel: Kernel, values: Sequence[FloatOrArray], dtypes: Sequence[Any], block: int
) -> tuple[NDArray[Any], ...]:
    arguments: list[Any] = list(values)
    places = [i for i, value in enumerate(values) if not isinstance(value, float)]
    operands: Any = [values[i] for i in places] + [None] * len(dtypes)
    op_flags: Any = [["readonly"]] * len(places) + [["writeonly", "allocate"]] * len(dtypes)
    iterator = np.nditer(
        operands,
        flags=["external_loop", "buffered"],
        op_flags=op_flags,
        op_dtypes=[np.float64] * len(places) + list(dtypes),
        buffersize=block,
    )
    with iterator, np.errstate(all="ignore"):
        for blocks in iterator:
            for place, values_of in zip(places, blocks, strict=False):
                arguments[place] = values_of
            results = kernel(*arguments)
            if len(dtypes) == 1:
                results = (results,)
            for out, result in zip(blocks[len(places) :], results, strict=True):
                out[...] = result
        return iterator.operands[len(places) :]


def product(a: Any, b: Any, c: Any) -> Any:
    """Return a (b c)."""
    inner = b * c
    if NORMAL <= inner <= LARGEST if type(inner) is float else all_normal(inner):
        return a * inner
    return where_normal(inner, a * inner, scaled((a, b, c), ()))


def quotient(a: Any, b: Any, c: Any) -> Any:
    """Return a / (b c): infinity where only the divisor is 0, nan where both are."""
    inner = b * c
    if NORMAL <= inner <= LARGEST if type(inner) is float else all_normal(inner):
        return a / inner
    with np.errstate(all="ignore"):
        return where_normal(inner, np.divide(a, inner), scaled((a,), (b, c)))


def proportion(a: Any, b: Any, c: Any) -> Any:
    """Return a (b / c) for positive c."""
    inner = b / c
    if all_normal(inner):
        return a * inner
    return where_normal(inner, a * inner, scaled((a, b), (c,)))


def ratio(a: Any, b: Any) -> Any:
    """Return a / b: infinity where only the divisor is 0, nan where both are."""
    if type(b) is not float:
        return a / np.abs(b)  # -0.0 is 0
    return a / b if b else scaled((a,), (b,))


def all_normal(x: Any) -> bool:
    """Return whether every number in `x` is neither too large nor too small for all its digits."""
    if type(x) is float:
        return NORMAL <= x <= LARGEST
    return not x.size or bool(x.min() >= NORMAL and x.max() <= LARGEST)


def where_normal(x: Any, plain: Any, rescued: Any) -> Any:
    """Return the plain result where `x`, on which it rests, is normal, else the rescued one."""
    if type(x) is float:
        return plain if all_normal(x) else rescued
    return np.where((x >= NORMAL) & (x <= LARGEST), plain, rescued)


def where(condition: Any, yes: Any, no: Any) -> Any:
    """Return `yes` where the condition holds, else `no`; for numbers a Python float."""
    if type(yes) is type(no) is float and type(condition) is bool:  # the same, and quicker
        return yes if condition else no
    if isinstance(condition, np.ndarray):
        return np.where(condition, yes, no)
    chosen = yes if condition else no
    return chosen if isinstance(chosen, np.ndarray) else float(chosen)


def taken(values: Iterable[Any], mask: Any) -> tuple[Any, ...]:
    """Return some of the points of values that broadcast to a mask; numbers as they are.

    Examples
    --------
    >>> taken((2.0, np.array([1.0, 3.0])), np.array([False, True]))
    (2.0, array([3.]))
    """
    return tuple(v if np.ndim(v) == 0 else np.broadcast_to(v, mask.shape)[mask] for v in values)


def log(x: Any) -> Any:
    """Return the natural logarithm; minus infinity of 0."""
    if type(x) is not float:
        return np.log(dense(x))
    return float(np.log(x)) if x else -math.inf


def exp(x: Any) -> Any:
    """Return the exponential."""
    return np.exp(dense(x)) if type(x) is not float else float(np.exp(x))


def expm1(x: Any) -> Any:
    """Return the exponential less 1."""
    return np.expm1(dense(x)) if type(x) is not float else float(np.expm1(x))


def larger(a: Any, b: Any) -> Any:
    """Return the larger of two, nan where one of them is.

    Examples
    --------
    >>> larger(1.0, 2.0), larger(1.0, np.array([0.0, 3.0])).tolist()
    (2.0, [1.0, 3.0])
    """
    if type(a) is type(b) is float:
        return a if a >= b or a != a else b
    return np.maximum(a, b)


def dense(x: Any) -> Any:
    """Return contiguous numbers: numpy's transcendental functions may round others differently.

    For the same reason there is no use of `math`, whose functions are not numpy's.
    """
    return np.ascontiguousarray(x) if isinstance(x, np.ndarray) else x


def scaled(factors: tuple[Any, ...], divisors: tuple[Any, ...]) -> Any:
    """Return the product of non-negative factors over that of divisors; only the end can overflow.

    Significands and exponents go separate ways until the last step.
    """
    with np.errstate(all="ignore"):
        significand, exponent = _significand_and_power(factors)
        below: Any = 1.0
        for divisor in divisors:
            fraction, power = np.frexp(divisor)
            below, exponent = below * np.abs(fraction), exponent - power
        result = np.ldexp(significand / below, exponent)
    return result if isinstance(result, np.ndarray) else float(result)


def over_sum(factors: tuple[Any, ...], terms: tuple[tuple[Any, ...], ...]) -> Any:
    """Return the product of non-negative factors over a sum of such products.

    Only the end can overflow. Infinite where only the sum is 0, nan where both are.

    Examples
    --------
    >>> print(over_sum((1e300, 1e-300), ((1e300, 1e300), (2e300, 1e300))))
    0.0
    >>> print(f"{over_sum((1e300, 1e300), ((1e300, 1e300), (3e300, 1e300))):.3f}")
    0.250
    """
    with np.errstate(all="ignore"):
        parts = [_significand_and_power(term) for term in terms]
        top: Any = NO_POWER
        for part, power in parts:
            top = np.maximum(top, np.where(part, power, NO_POWER))
        below: Any = 0.0
        for part, power in parts:
            below = below + np.abs(np.ldexp(part, power - top))  # -0.0 is 0
        significand, exponent = _significand_and_power(factors)
        result = np.ldexp(significand / below, exponent - top)
    return result if isinstance(result, np.ndarray) else float(result)


def _significand_and_power(factors: tuple[Any, ...]) -> tuple[Any, Any]:
    """Return a product as a number of moderate size and the power of two to multiply it by."""
    significand: Any = 1.0
    exponent: Any = 0
    for factor in reversed(factors):  # the order in which `product` rounds
        fraction, power = np.frexp(factor)
        significand, exponent = fraction * significand, exponent + power
    return significand, exponent

"""What becomes of points to which a model does not reach: an error, or nan for them alone."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.checks import shown
from surrogate.errors import DomainError, InputError

__all__ = ["blanked", "is_nan", "spared"]

Array = NDArray[np.float64]


def is_nan(outside: object) -> bool:
    """Return whether nan is asked for, and not an error.

    Examples
    --------
    >>> is_nan("raise"), is_nan("nan")
    (False, True)
    """
    if isinstance(outside, str) and outside in ("raise", "nan"):
        return outside == "nan"
    raise InputError(
        f"outside must be 'raise' or 'nan', but is {shown(outside)}; give 'nan' for no number "
        "where a model does not hold."
    )


def blanked(values: Any, holds: Any) -> Any:
    """Return values with nan where a model does not hold.

    Examples
    --------
    >>> blanked(np.array([1.0, 2.0]), np.array([True, False])), blanked(1.0, False)
    (array([ 1., nan]), nan)
    """
    if np.all(holds):
        return values
    result = np.where(holds, values, np.nan)
    return result if result.ndim else float(result)


def spared(
    function: Callable[[list[Array]], tuple[Array, ...]], columns: list[Array], number: int
) -> tuple[Array, ...]:
    """Return the results of rows, nan for those that are refused for their domain.

    Where a batch is refused its halves are tried, so that few bad rows cost few calls more.

    Parameters
    ----------
    function : callable
        Takes columns and returns some arrays of floats.
    columns : list of ndarray, each of shape (rows,)
        The arguments.
    number : int
        How many arrays it returns.

    Examples
    --------
    >>> def roots(columns):
    ...     if (columns[0] < 0.0).any():
    ...         raise DomainError("negative")
    ...     return (np.sqrt(columns[0]),)
    >>> spared(roots, [np.array([4.0, -1.0, 9.0])], 1)[0]
    array([ 2., nan,  3.])
    """
    rows = columns[0].size
    try:
        return function(columns)
    except DomainError:
        if rows < 2:
            return (np.full(rows, np.nan),) * number
    half = rows // 2
    parts = [spared(function, [c[some] for c in columns], number) for some in _halves(half)]
    return tuple(np.concatenate(pair) for pair in zip(*parts, strict=True))


def _halves(half: int) -> tuple[slice, slice]:
    return slice(None, half), slice(half, None)

"""The loops over points, compiled by numba for programs that have loaded it.

Every operation is that of `surrogate.contact.table` in the same order, for the same digits.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit

__all__ = ["along_line", "at_points"]

_SOME = 256
"""Points at a time, so that what one loop leaves for the next stays in the nearest cache."""


@njit(cache=True, error_model="numpy")
def at_points(
    cells: Any, log_g: Any, log_alpha: Any, touch: Any, counts: Any, steps: Any
) -> tuple[Any, Any]:
    """Return ln(g/g_touch) of points and polynomials of the cells that they are in.

    The loops of few operations are vectorised, the one that gathers coefficients cannot be.

    Parameters
    ----------
    cells : tuple of ndarray, shape (cells, 16)
        The coefficients of each function.
    log_g, log_alpha : ndarray, shape (points,)
        Where.
    touch : ndarray
        Coefficients of ln g_touch in powers of ln alpha.
    counts : tuple of int
        Cells short of the touch, past it, and along alpha.
    steps : tuple of float
        ln g at the first cell, cells per ln g past the touch, ln alpha at the first cell, cells
        per ln alpha.

    Examples
    --------
    >>> one, at = np.zeros((1, 16)), np.array([-0.5])
    >>> one[0, 5] = 2.0
    >>> at_points((one,), at, at, np.zeros(1), (1, 0, 1), (-1.0, 1.0, -1.0, 0.5))
    (array([-0.5]), array([[0.25]]))
    """
    short, past, across = counts
    low_g, after, low_alpha, per_alpha = steps
    last_row, last_column, columns = (
        np.int32(short + past - 1),
        np.int32(across - 1),
        np.int32(across),
    )
    x, results = np.empty(log_g.size), np.empty((len(cells), log_g.size))
    in_g, in_alpha, index = np.empty(_SOME), np.empty(_SOME), np.empty(_SOME, np.uint32)
    for begin in range(0, log_g.size, _SOME):
        end = min(begin + _SOME, log_g.size)
        k, row, y = log_g[begin:end], log_alpha[begin:end], x[begin:end]
        for n in range(y.size):
            y[n] = touch[-1] + 0.0 * row[n]
        for power in range(touch.size - 2, -1, -1):
            for n in range(y.size):
                y[n] = y[n] * row[n] + touch[power]
        for n in range(y.size):
            touching = y[n]
            y[n] = k[n] - touching
            before = short / (touching - low_g)
            in_g[n] = (before if y[n] < 0.0 else after) * y[n] + short
            in_alpha[n] = (row[n] - low_alpha) * per_alpha
        for n in range(y.size):
            i = min(max(np.int32(in_g[n]), np.int32(0)), last_row)
            j = min(max(np.int32(in_alpha[n]), np.int32(0)), last_column)
            index[n] = np.int32(i * columns + j)
            in_g[n] -= i
            in_alpha[n] -= j
        for function in range(len(cells)):
            of, result = cells[function], results[function, begin:end]
            for n in range(y.size):
                c, s, t = of[index[n]], in_alpha[n], in_g[n]
                c0 = c[0] + s * (c[1] + s * (c[2] + s * c[3]))
                c1 = c[4] + s * (c[5] + s * (c[6] + s * c[7]))
                c2 = c[8] + s * (c[9] + s * (c[10] + s * c[11]))
                c3 = c[12] + s * (c[13] + s * (c[14] + s * c[15]))
                result[n] = c0 + t * (c1 + t * (c2 + t * c3))
    return x, results


@njit(cache=True, error_model="numpy")
def along_line(
    x: Any,
    start: float,
    sign: float,
    before: float,
    after: float,
    short: int,
    rows: Any,
    result: Any,
) -> None:
    """Put the cubics of the pieces that points are in into `result`.

    Parameters
    ----------
    x : ndarray, shape (points,)
        What start + sign x is the ln(g/g_touch) of.
    start, sign : float
        As above.
    before, after : float
        Pieces per ln g short of and past the touch.
    short : int
        Number of pieces short of the touch.
    rows : ndarray, shape (pieces, 4)
        Coefficients of powers of the place in a piece, 0 to 1.
    result : ndarray, shape (points,)
        Changed.

    Examples
    --------
    >>> rows, result = np.zeros((6, 4)), np.empty(2)
    >>> rows[1], rows[5] = (1.0, 2.0, 3.0, 4.0), (7.0, 0.0, 0.0, 0.0)
    >>> along_line(np.array([1.5, -0.5]), 0.0, -1.0, 1.0, 4.0, 3, rows, result)
    >>> result
    array([3.25, 7.  ])
    """
    place, piece = np.empty(_SOME), np.empty(_SOME, np.uint32)
    for begin in range(0, x.size, _SOME):
        end = min(begin + _SOME, x.size)
        some, values = x[begin:end], result[begin:end]
        for n in range(some.size):
            y = start + sign * some[n]
            t = (before if y < 0.0 else after) * y + short
            whole = np.int32(t)
            piece[n] = whole
            place[n] = t - whole
        for n in range(some.size):
            row, t = rows[piece[n]], place[n]
            values[n] = row[0] + t * (row[1] + t * (row[2] + t * row[3]))

"""The loops over points, compiled by numba for programs that have loaded it.

Every operation is that of `surrogate.contact.table` in the same order, for the same digits.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit

__all__ = ["bicubic", "cubic", "line_places", "places"]


@njit(cache=True, error_model="numpy")
def places(log_g: Any, log_alpha: Any, touch: Any, counts: Any, steps: Any) -> Any:
    """Return ln(g/g_touch), the number of the cell and the places in it, along g and alpha.

    Parameters
    ----------
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
    >>> at = np.array([-0.5])
    >>> places(at, at, np.zeros(1), (1, 1, 1), (-1.0, 1.0, -1.0, 0.5))
    (array([-0.5]), array([0]), array([0.5]), array([0.25]))
    """
    short, past, across = counts
    low_g, after, low_alpha, per_alpha = steps
    points = log_g.size
    x, index = np.empty(points), np.empty(points, np.int64)
    t, s = np.empty(points), np.empty(points)
    # loops of few operations each, which are vectorised
    for n in range(points):
        x[n] = touch[-1] + 0.0 * log_alpha[n]
    for power in range(touch.size - 2, -1, -1):
        for n in range(points):
            x[n] = x[n] * log_alpha[n] + touch[power]
    for n in range(points):
        end = x[n]
        x[n] = log_g[n] - end
        before = short / (end - low_g)
        t[n] = (before if x[n] < 0.0 else after) * x[n] + short
        s[n] = (log_alpha[n] - low_alpha) * per_alpha
    for n in range(points):
        row = min(max(int(t[n]), 0), short + past - 1)
        column = min(max(int(s[n]), 0), across - 1)
        index[n] = row * across + column
        t[n] -= row
        s[n] -= column
    return x, index, t, s


@njit(cache=True, error_model="numpy")
def bicubic(cells: Any, index: Any, t: Any, s: Any) -> Any:
    """Return the polynomials of cells, shape (cells, 16), at places in them.

    Examples
    --------
    >>> one = np.zeros((1, 16))
    >>> one[0, 5] = 2.0
    >>> bicubic(one, np.array([0]), np.array([0.5]), np.array([0.25]))
    array([0.25])
    """
    result = np.empty(t.size)
    for n in range(t.size):
        c, y, x = cells[index[n]], s[n], t[n]
        c0 = c[0] + y * (c[1] + y * (c[2] + y * c[3]))
        c1 = c[4] + y * (c[5] + y * (c[6] + y * c[7]))
        c2 = c[8] + y * (c[9] + y * (c[10] + y * c[11]))
        c3 = c[12] + y * (c[13] + y * (c[14] + y * c[15]))
        result[n] = c0 + x * (c1 + x * (c2 + x * c3))
    return result


@njit(cache=True, error_model="numpy")
def line_places(
    x: Any, start: float, sign: float, before: float, after: float, short: int, piece: Any
) -> None:
    """Put the pieces of points and the places in them, 0 to 1, into `piece` and `x`.

    Parameters
    ----------
    x : ndarray, shape (points,)
        What start + sign x is the ln(g/g_touch) of; changed.
    start, sign : float
        As above.
    before, after : float
        Pieces per ln g short of and past the touch.
    short : int
        Number of pieces short of the touch.
    piece : ndarray of uint32, shape (points,)
        Changed.

    Examples
    --------
    >>> x, piece = np.array([1.5, -0.5]), np.empty(2, np.uint32)
    >>> line_places(x, 0.0, -1.0, 1.0, 4.0, 3, piece)
    >>> x, piece
    (array([0.5, 0. ]), array([1, 5], dtype=uint32))
    """
    for n in range(x.size):
        y = start + sign * x[n]
        t = (before if y < 0.0 else after) * y + short
        whole = np.int32(t)
        piece[n] = whole
        x[n] = t - whole


@njit(cache=True, error_model="numpy")
def cubic(rows: Any, index: Any, x: Any, result: Any) -> None:
    """Put the cubics of rows, shape (pieces, 4), at places in them into `result`.

    Examples
    --------
    >>> result = np.empty(1)
    >>> cubic(np.array([[1.0, 2.0, 3.0, 4.0]]), np.zeros(1, np.uint32), np.array([2.0]), result)
    >>> result
    array([49.])
    """
    for n in range(x.size):
        row, t = rows[index[n]], x[n]
        result[n] = row[0] + t * (row[1] + t * (row[2] + t * row[3]))

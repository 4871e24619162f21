"""The loop over cells, compiled by numba for programs that have loaded it."""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit

__all__ = ["bicubic"]


@njit(cache=True)
def bicubic(cells: Any, index: Any, t: Any, s: Any) -> Any:
    """Return the polynomials of cells at places in them; rounded as the plain expressions are.

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

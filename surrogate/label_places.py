"""Where a label fits into a region of a figure without touching anything."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["GRID", "best_place", "best_turned_place", "blocked_by_line"]

Mask = NDArray[np.bool_]

GRID = 160
"""Cells of the axes in each direction that labels are placed by."""

_SIZES = (2.5, 2.0, 1.6, 1.3, 1.1)  # room that a box may have, in its own size


def best_place(free: Mask, width: float, height: float) -> tuple[float, float] | None:
    """Return the centre of the place with the most room for a box, or None where it fits nowhere.

    Parameters
    ----------
    free : ndarray of bool, shape (n, n)
        Cells of the axes, rows from the bottom, in which the box may lie.
    width, height : float
        Of the box, in fractions of the axes.

    Returns
    -------
    tuple of float or None
        Fractions of the axes.

    Examples
    --------
    >>> free = np.zeros((100, 100), dtype=bool)
    >>> free[20:60, 40:80] = True
    >>> best_place(free, 0.2, 0.1)
    (0.6, 0.4)
    >>> best_place(free, 0.5, 0.1) is None
    True
    """
    n = free.shape[0]
    total = np.zeros((n + 1, n + 1), dtype=np.int64)
    total[1:, 1:] = np.cumsum(np.cumsum(free, axis=0), axis=1)
    rows, columns = np.nonzero(free)
    if not rows.size:
        return None
    middle = rows.mean(), columns.mean()
    for size in _SIZES:
        w, h = (max(1, int(np.ceil(size * side * n))) for side in (width, height))
        if w > n or h > n:
            continue
        inside = total[h:, w:] - total[:-h, w:] - total[h:, :-w] + total[:-h, :-w] == w * h
        bottom, left = np.nonzero(inside)
        if bottom.size:
            y, x = bottom + 0.5 * h, left + 0.5 * w
            best = np.argmin((y - middle[0] - 0.5) ** 2 + (x - middle[1] - 0.5) ** 2)
            return float(x[best] / n), float(y[best] / n)
    return None


def best_turned_place(
    free: Mask, box: tuple[float, float], window: tuple[float, float], angle: float
) -> tuple[float, float] | None:
    """Return the centre of the place with the most room for a turned box, or None if there is none.

    Parameters
    ----------
    free : ndarray of bool, shape (n, n)
        Cells of the axes, rows from the bottom, in which the box may lie.
    box, window : pair of float
        Width and height of the box and of the axes, in one unit of length.
    angle : float
        By which the box is turned, anticlockwise [rad].

    Returns
    -------
    tuple of float or None
        Fractions of the axes.

    Examples
    --------
    >>> band = blocked_by_line(np.array([0.0, 1.0]), np.array([0.0, 1.0]), 100, reach=8)
    >>> best_turned_place(band, (0.5, 0.1), (1.0, 1.0), np.pi / 4) is not None
    True
    >>> best_place(band, 0.5, 0.1) is None
    True
    """
    n = free.shape[0]
    side = float(np.hypot(*window))  # of the square that holds the axes at any angle
    along, across = np.meshgrid(*[((np.arange(n) + 0.5) / n - 0.5) * side] * 2)
    cos, sin = np.cos(angle), np.sin(angle)

    def fractions(u: Any, v: Any) -> tuple[Any, Any]:
        return 0.5 + (u * cos - v * sin) / window[0], 0.5 + (u * sin + v * cos) / window[1]

    x, y = fractions(along, across)
    inside = (x > 0.0) & (x < 1.0) & (y > 0.0) & (y < 1.0)
    columns, rows = (np.clip((n * each).astype(int), 0, n - 1) for each in (x, y))
    place = best_place(free[rows, columns] & inside, box[0] / side, box[1] / side)
    if place is None:
        return None
    x, y = fractions((place[0] - 0.5) * side, (place[1] - 0.5) * side)
    return float(x), float(y)


def blocked_by_line(
    x: NDArray[np.float64], y: NDArray[np.float64], n: int = GRID, reach: int = 1
) -> Mask:
    """Return the cells that a polyline in fractions of the axes passes through, and neighbours.

    Examples
    --------
    >>> int(blocked_by_line(np.array([0.0, 1.0]), np.array([0.5, 0.5]), 10).sum())
    30
    """
    mask = np.zeros((n, n), dtype=bool)
    if len(x) > 1:
        pieces = np.maximum(np.abs(np.diff(x)), np.abs(np.diff(y))) * 2 * n
        along = [np.linspace(0.0, 1.0, int(k) + 2) for k in np.minimum(pieces, 4 * n)]
        x = np.concatenate([a + t * (b - a) for a, b, t in zip(x, x[1:], along, strict=False)])
        y = np.concatenate([a + t * (b - a) for a, b, t in zip(y, y[1:], along, strict=False)])
    seen = (x >= 0.0) & (x <= 1.0) & (y >= 0.0) & (y <= 1.0)
    columns, rows = (np.minimum((n * v[seen]).astype(int), n - 1) for v in (x, y))
    for i in range(-reach, reach + 1):
        for j in range(-reach, reach + 1):
            mask[np.clip(rows + i, 0, n - 1), np.clip(columns + j, 0, n - 1)] = True
    return mask

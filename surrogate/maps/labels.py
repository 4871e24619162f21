"""The words of a regime map: its legend, and the names of its regions where nothing is."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.figures import SMALL, legend_above
from surrogate.maps.axes import MapAxis
from surrogate.maps.record import MapRecord

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = [
    "GRID",
    "NAMES",
    "add_legend",
    "best_place",
    "best_turned_place",
    "blocked_by_line",
    "name_regions",
]

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


NAMES = {
    "transition": "transition",
    "toughness-and-friction": "toughness\nand friction",
    "cleavage": "cleavage",
    "wear": "wear",
    "friction-stiffness": "friction\nand stiffness",
    "friction": "friction",
}
"""What is written into each region."""

Array = NDArray[np.float64]

_AWAY = 6
"""Cells between a name and an experiment, so that it is not read as the experiment's."""


def add_legend(ax: Axes, columns: int, handles: list[Any]) -> int:
    """Put a legend above the axes, no wider than they and their label; return its columns."""
    root = ax.figure.canvas.figure
    if old := ax.get_legend():
        old.remove()
    root.draw_without_rendering()
    window = ax.get_window_extent()
    whole = ax.get_tightbbox() or window  # none of invisible axes
    room = window.x1 - whole.x0
    for number in range(columns, 0, -1):
        legend_above(ax, number, handles, (whole.x0 - window.x0) / window.width)
        legend = ax.get_legend()
        if legend is None or legend.get_window_extent().width <= room:
            break
    return number


def name_regions(
    ax: Axes, made: MapRecord, lines: Sequence[Array], marks: Sequence[Array], coloured: bool
) -> list[str]:
    """Write each region's name where nothing is, upright or along a boundary where it fits only so.

    Return the names of regions that are too small.
    """
    root = ax.figure.canvas.figure
    root.draw_without_rendering()
    window = ax.get_window_extent()
    blocked = _under_legend(ax, window)
    for reach, drawn in ((1, lines), (_AWAY, marks)):
        for line in drawn:
            x, y = _fraction(made.x, line[:, 0]), _fraction(made.y, line[:, 1])
            blocked |= blocked_by_line(x, y, reach=reach)
    centres = (np.arange(GRID) + 0.5) / GRID
    columns, rows = (
        np.rint(centres * (axis.values.size - 1)).astype(int) for axis in (made.x, made.y)
    )
    labels = np.broadcast_to(made.regime.dominant, (made.y.values.size, made.x.values.size))
    region = labels[np.ix_(rows, columns)]
    busy = coloured or not np.all(made.force.in_domain)
    nameless = []
    for name in np.unique(region):
        text = ax.text(
            0.5,
            0.5,
            NAMES[name],
            transform=ax.transAxes,
            ha="center",
            va="center",
            fontsize=SMALL,
            style="italic" if name == "transition" else "normal",
            zorder=3,
            path_effects=[_halo()] if busy else None,
        )
        box = text.get_window_extent()
        size = box.width / window.width, box.height / window.height
        turned = box.height / window.width, box.width / window.height
        free = (region == name) & ~blocked
        if place := best_place(free, *size):
            text.set_position(place)
        elif place := best_place(free, *turned):
            text.set_position(place)
            text.set_rotation(90)
        elif along := _place_along(made, free, (box.width, box.height), window):
            text.set_position(along[0])
            text.set_rotation(along[1])
            text.set_transform_rotates_text(True)
        else:
            text.remove()
            nameless.append(str(name))
    return nameless


def _under_legend(ax: Axes, window: Any) -> NDArray[np.bool_]:
    """Return which cells a legend inside the axes covers; none where it stands above them."""
    covered = np.zeros((GRID, GRID), dtype=bool)
    legend = ax.get_legend()
    if legend is not None:
        box = legend.get_window_extent()
        columns = (np.array([box.x0, box.x1]) - window.x0) / window.width * GRID
        rows = (np.array([box.y0, box.y1]) - window.y0) / window.height * GRID
        (left, right), (low, high) = (
            np.clip([np.floor(one[0]), np.ceil(one[1])], 0, GRID).astype(int)
            for one in (columns, rows)
        )
        covered[low:high, left:right] = True
    return covered


def _halo() -> Any:
    """Return what keeps words readable on colours and hatches."""
    from matplotlib.patheffects import withStroke

    return withStroke(linewidth=2.5, foreground="white")


def _place_along(
    made: MapRecord, free: NDArray[np.bool_], box: tuple[float, float], window: Any
) -> tuple[tuple[float, float], float] | None:
    """Return a place along one of the boundaries, and the direction in fractions [degree]."""
    for across, up in _directions(made):
        angle = np.arctan2(up * window.height, across * window.width)
        place = best_turned_place(free, box, (window.width, window.height), float(angle))
        if place:
            return place, float(np.degrees(np.arctan2(up, across)))
    return None


def _directions(made: MapRecord) -> Iterator[tuple[float, float]]:
    """Yield the way from end to end of the lines between regions, to the right [fractions]."""
    for one in made.boundaries:
        for line in one.lines if one.kind in ("equal-terms", "dominance") else ():
            across = np.ptp(_fraction(made.x, line[[0, -1], 0]))
            up = np.diff(_fraction(made.y, line[[0, -1], 1]))[0]
            yield float(across), float(up if line[-1, 0] >= line[0, 0] else -up)


def _fraction(axis: MapAxis, values: Any) -> Array:
    low, high = axis.to_scale(axis.values[[0, -1]])
    return np.asarray((axis.to_scale(values) - low) / (high - low))

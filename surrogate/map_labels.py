"""The words of a regime map: its legend, and the names of its regions where nothing is."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from surrogate.figures import SMALL, legend_above
from surrogate.label_places import GRID, best_place, best_turned_place, blocked_by_line
from surrogate.map_axes import MapAxis
from surrogate.map_record import MapRecord
from surrogate.map_style import NAMES

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["add_legend", "name_regions"]

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
    blocked = np.zeros((GRID, GRID), dtype=bool)
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
            bbox={"fc": "white", "ec": "none", "alpha": 0.8, "pad": 1.0} if busy else None,
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

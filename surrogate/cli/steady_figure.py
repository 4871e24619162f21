"""The figure of `wirecut steady`: every record with its plateau."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from surrogate.basics.figures import GREY, RED, SMALL, WIDTHS, in_style, new_figure, save_figure
from surrogate.reading.cuts import Cut

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["save_steady"]

_COLUMNS, _HEIGHT = 4, 1.45


@in_style
def save_steady(cuts: Sequence[Cut], file: str) -> None:
    """Draw the force over the displacement of every record that could be read.

    Parameters
    ----------
    cuts : sequence of Cut
        The records.
    file : str
        Where to write; the ending chooses the format (.png, .pdf, .svg).

    Raises
    ------
    InputError
        If the file cannot be written.
    """
    shown = [cut for cut in cuts if cut.record is not None]
    columns = min(_COLUMNS, len(shown))
    rows = -(-len(shown) // columns)
    width = WIDTHS["double"] if columns > 2 else WIDTHS["single"]
    figure = new_figure((width, 0.5 + _HEIGHT * rows))
    for number, cut in enumerate(shown):
        ax = figure.add_subplot(rows, columns, number + 1)
        _draw(ax, cut)
        if number % columns == 0:
            ax.set_ylabel("force [N]", fontsize=SMALL)
        if number >= len(shown) - columns:
            ax.set_xlabel("displacement [mm]", fontsize=SMALL)
    save_figure(figure, file)


def _draw(ax: Axes, cut: Cut) -> None:
    record, steady = cut.record, cut.steady
    assert record is not None
    net = record.force - (steady.offset + steady.tare if steady else 0.0)
    ax.plot(1e3 * record.displacement, net, color=GREY, linewidth=0.6)
    if steady is not None:
        ends = 1e3 * np.array([steady.start, steady.end])
        ax.plot(ends, [steady.mean] * 2, color=RED, linewidth=1.4)
        ax.axvspan(*ends, color=RED, alpha=0.08, linewidth=0.0)
    name = os.path.splitext(os.path.basename(cut.file))[0]
    if cut.specimen > 1:
        name += f", {cut.specimen}"
    ax.set_title(name if steady else f"{name}: not steady", fontsize=SMALL)
    ax.tick_params(labelsize=SMALL)

"""What the figures of the comparison with the paper have in common."""

from __future__ import annotations

from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.figures import MEDIUM, SMALL
from surrogate.errors import MissingExtraError

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["ALPHAS", "DISTANCE", "STYLES", "TOUGHNESS", "Columns", "legend", "named", "panels"]

Columns = dict[tuple[str, str], Any]

ALPHAS = (2.0, 5.0, 9.0)
"""Stiffening exponents of the paper."""

STYLES: dict[float, dict[str, Any]] = {
    2.0: {"color": "#0072B2", "marker": "o", "ls": "-"},
    5.0: {"color": "#D55E00", "marker": "s", "ls": "--"},
    9.0: {"color": "#009E73", "marker": "^", "ls": "-."},
}
"""Colour, marker and line of each alpha of the paper."""

DISTANCE = r"distance to the tip $\delta/R_w$ [-]"
TOUGHNESS = r"$g = \Gamma_o/(\mu R_w)$ [-]"


def panels(figure: Figure, columns: int, rows: int = 1) -> NDArray[Any]:
    """Return the axes of panels side by side."""
    axes = np.atleast_1d(figure.subplots(rows, columns))
    for ax in axes.flat:
        ax.tick_params(which="both", labelsize=SMALL)
        ax.spines[["top", "right"]].set_visible(False)
    return np.asarray(axes)


def named(ax: Axes, x: str, y: str) -> None:
    """Name both axes."""
    ax.set_xlabel(x, fontsize=MEDIUM)
    ax.set_ylabel(y, fontsize=MEDIUM)


def legend(figure: Figure, handles: list[Any], columns: int) -> None:
    """Put one legend above all panels, where no data can be."""
    figure.legend(
        handles=handles, loc="outside upper left", ncols=columns, fontsize=SMALL, frameon=False
    )


MM = 1.0 / 25.4
SINGLE_COLUMN = 89.0 * MM
"""Width of a figure that fills one column of a journal [inch]."""

#: Okabe and Ito's colours, which the colour-blind tell apart, without the yellow.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000")
#: Of what stands behind the data: laws of others, and what was not reached.
GREY = "#555555"

MARKERS = ("o", "s", "^", "D", "v", "P", "X")


def require_matplotlib() -> None:
    if find_spec("matplotlib") is None:
        raise MissingExtraError(
            "drawing needs matplotlib; install it with: pip install 'wirecut[train]'"
        )


def new_axes(ratio: float) -> Axes:
    """Return the axes of a new single-column figure of a height relative to its width."""
    require_matplotlib()
    import matplotlib.pyplot as plt

    size = (SINGLE_COLUMN, ratio * SINGLE_COLUMN)
    return plt.subplots(figsize=size, layout="constrained")[1]


def label_axes(ax: Axes, x: str, y: str) -> None:
    ax.set_xlabel(x, fontsize=MEDIUM)
    ax.set_ylabel(y, fontsize=MEDIUM)
    ax.tick_params(which="both", labelsize=SMALL)


def add_legend(ax: Axes, columns: int) -> None:
    """Put the legend above the axes, where no data can be."""
    ax.spines[["top", "right"]].set_visible(False)
    ax.legend(
        loc="lower left",
        bbox_to_anchor=(-0.1, 1.0),
        ncols=columns,
        fontsize=SMALL,
        frameon=False,
        handlelength=1.8,
        columnspacing=1.0,
        borderaxespad=0.2,
    )

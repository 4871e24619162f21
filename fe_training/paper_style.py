"""What the figures of the comparison with the paper have in common."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from surrogate.figures import MEDIUM, SMALL

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

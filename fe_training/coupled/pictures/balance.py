"""The balance in one picture: what acts on the face, and how far it slips beside sin(theta)."""

from __future__ import annotations

import itertools
import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from fe_training.campaign.dataset import Campaign
from surrogate.basics.figures import (
    BLUE,
    COLOURS,
    FILLS,
    GREY,
    RED,
    SMALL,
    label_at_right,
    label_axes,
    panels,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["SIZE", "balance_figure"]

SIZE = (7.0, 2.9)
"""Size of the figure [inch]."""

#: The sketch: ends of the contact [rad], and the place of the tip [R_w].
_ENDS: tuple[float, float] = math.radians(40.0), math.radians(140.0)
_TIP = 1.45

#: Ends of the sketch [R_w].
_LEFT, _RIGHT = -2.5, 3.0

#: Exponent and toughnesses of the slips that are shown.
_ALPHA, _TOUGHNESSES = 5.0, (0.01, 0.1, 1.0)


def balance_figure(campaign: Campaign, figure: Figure) -> None:
    """Draw pressure and shear on the face, and its stretch beside the projection of the paper.

    Parameters
    ----------
    campaign : Campaign
        Frictionless configurations with their stretches.
    figure : matplotlib.figure.Figure
        Where to draw.
    """
    left, right = panels(figure, 2, width_ratios=[1.4, 1.0])[0]
    _sketch(left)
    _slips(right, campaign)


def _arrow(ax: Axes, start: Any, end: Any, colour: str, width: float = 1.0) -> None:
    form = {"arrowstyle": "-|>", "color": colour, "lw": width, "shrinkA": 0.0, "shrinkB": 0.0}
    ax.annotate("", end, start, arrowprops={**form, "mutation_scale": 7.0}, zorder=6)


def _words(ax: Axes, at: tuple[float, float], text: str, **form: Any) -> None:
    ax.text(*at, text, **{"fontsize": SMALL, "ha": "center", "va": "center", "zorder": 7, **form})


def _face(x: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the height of the face: behind the wire, on it, and in front of it to the tip."""
    front, rear = np.cos(np.array(_ENDS))
    behind = np.sin(_ENDS[1]) + 0.3 * (1.0 - np.exp(1.1 * (x - rear)))
    ahead = np.sin(_ENDS[0]) * np.sqrt(np.clip((_TIP - x) / (_TIP - front), 0.0, None))
    on = np.sqrt(np.clip(1.0 - x**2, 0.0, None))
    return np.asarray(np.where(x < rear, behind, np.where(x > front, ahead, on)))


def _sketch(ax: Axes) -> None:
    """Draw the upper half: the wire, the solid, the tractions on it, pieces of its face."""
    from matplotlib.patches import Circle, Polygon

    x = np.linspace(_LEFT, _TIP, 500)
    face = np.column_stack([x, _face(x)])
    corners = [[_RIGHT, 0.0], [_RIGHT, 1.9], [_LEFT, 1.9]]
    ax.add_patch(Polygon(np.vstack([face, corners]), fc=FILLS["cleavage"], ec="none"))
    ax.add_patch(Circle((0.0, 0.0), 1.0, fc="#d9c7a0", ec="#8a6d3b", lw=1.0, zorder=2))
    ax.plot(*face.T, color=GREY, lw=0.9, zorder=3)
    _pieces(ax)
    for angle in np.linspace(*_ENDS, 7)[::2]:
        radial = np.array([np.cos(angle), np.sin(angle)])
        along = np.array([radial[1], -radial[0]])
        _arrow(ax, 1.02 * radial, 1.32 * radial, GREY, 0.8)
        _arrow(ax, 1.14 * radial - 0.17 * along, 1.14 * radial + 0.17 * along, RED, 1.3)
    _words(ax, (0.0, 1.48), "pressure $P$", color=GREY)
    _words(ax, (1.62, 1.15), "shear\n" + r"$\tau = \xi P + \tau_w$", color=RED)
    _words(ax, (-0.05, 0.62), r"$dX$ is $\lambda\,dX$ long")
    _arrow(ax, (-0.5, 0.2), (0.55, 0.2), "black", 1.4)
    _words(ax, (-0.02, 0.36), r"$F_{ss}$, $dc$")
    _words(ax, (2.25, 0.2), r"new face: $J\,dc$", color=BLUE)
    _words(ax, (-1.85, 0.72), "slipped face", color=GREY)
    ax.plot([_LEFT, _RIGHT], [0.0, 0.0], color=GREY, lw=0.6, ls=":")
    ax.plot([_TIP], [0.0], "o", color=BLUE, ms=3.0, zorder=5)
    ax.set(xlim=(_LEFT, _RIGHT), ylim=(-0.05, 1.9), aspect="equal")
    ax.axis("off")


def _pieces(ax: Axes) -> None:
    """Draw the face as pieces that were of equal length, longest on top of the wire."""
    angles = np.linspace(*_ENDS, 400)
    passed = np.cumsum(1.0 / (1.0 + 0.9 * np.sin(angles) ** 4))  # an example's 1/lambda
    marks = np.interp(np.linspace(passed[0], passed[-1], 9), passed, angles)
    for i, (first, last) in enumerate(itertools.pairwise(marks)):
        arc = np.linspace(first, last, 20)
        colour = "black" if i % 2 else "white"
        ax.plot(np.cos(arc), np.sin(arc), color=colour, lw=2.6, solid_capstyle="butt", zorder=4)
    ax.plot(np.cos(angles), np.sin(angles), color="black", lw=3.4, zorder=3)


def _slips(ax: Axes, campaign: Campaign) -> None:
    """Draw the stretch of the face under the wire over the angle, and sin(theta)."""
    rows = campaign.rows
    there = np.isfinite(rows["stretch"]).sum(axis=1) > 3
    there &= np.isclose(rows["alpha"], _ALPHA) & np.isfinite(rows["energy_release_rate"])
    numbers = np.flatnonzero(there)
    rate = np.log(rows["energy_release_rate"][numbers])
    ends, names, colours = [], [], {}
    for g, colour in zip(_TOUGHNESSES, COLOURS, strict=False):
        row = numbers[np.argmin(np.abs(rate - np.log(g)))]
        degrees, stretch = np.degrees(rows["pressure_angle"][row]), rows["stretch"][row]
        name = rf"$\lambda$, $g$ = {rows['energy_release_rate'][row]:.2g}"
        ax.plot(degrees, stretch, color=colour, lw=1.3, label=name)
        names.append((float(stretch[np.nanargmax(degrees)]), name))
        colours[name] = colour
        ends.append((np.nanmin(degrees), np.nanmax(degrees)))
    low, high = min(one for one, _ in ends), max(one for _, one in ends)
    angle = np.linspace(low, high, 200)
    ax.plot(angle, np.sin(np.radians(angle)), "k--", lw=1.1)
    names.append((math.sin(math.radians(high)), r"$\sin\theta$, of Eq. (7)"))
    ax.set(ylim=(0.0, None), xlim=(low - 3.0, high + 1.0))
    label_at_right(ax, names, colours)
    label_axes(ax, r"place under the wire $\theta$ [degrees]", "slip for each advance [-]")
    ax.set_title(rf"$\alpha$ = {_ALPHA:g}, no shear", fontsize=SMALL, loc="right")

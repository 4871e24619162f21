"""Figures that the paper does not have: A and B, the error of Eq. (13), finite specimens."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from fe_training.figure_style import (
    DISTANCE,
    STYLES,
    TOUGHNESS,
    Columns,
    legend,
    named,
    panels,
)
from fe_training.mechanics.analytic import far_field_wedge
from fe_training.paper.curve import Curve, stacked
from fe_training.paper.power_laws import eq13_error
from fe_training.paper.specimen import Result, group
from surrogate.basics.figures import GREY, MEDIUM, SMALL
from surrogate.equations import far_field_energy_release_rate

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["contact_figure", "eq13_figure", "specimen_figure"]

Floats = NDArray[np.float64]

#: Friction coefficients of the panels of Eq. (13)'s error, and the range of tau_w/(mu xi).
_FRICTION = (0.1, 0.5, 1.0)
_RATIO = (0.01, 100.0)

#: Errors between the colours [%]; evenly spaced in colour, so that grey tells them as well.
_LEVELS = (-10, -5, 0, 5, 10, 20, 30, 50, 75, 100)
_OTHER = "#aaaaaa"


def contact_figure(curves: Sequence[Curve], figure: Figure) -> Columns:
    """Draw A and B over g beside Eq. (13)'s 2 and 2 + g/2 and the linear wedge.

    Parameters
    ----------
    curves : sequence of Curve
        One for each alpha; those that the paper does not have are thin.
    figure : matplotlib.figure.Figure
        Where to draw.

    Returns
    -------
    dict
        The curves as columns: alpha, g, A and B [-].

    References
    ----------
    arXiv:2412.02021, Eqs. (11), (13) and (S2).
    """
    left, right = panels(figure, 2)
    wedge = far_field_wedge(np.geomspace(2.0, 60.0, 100))
    g = np.geomspace(2.5e-3, 100.0, 100)
    handles: list[Any] = []
    for one in curves:
        if one.alpha not in STYLES:
            for ax, values in ((left, one.arc), (right, one.normal_load)):
                ax.plot(one.g, values, color=_OTHER, lw=0.4, zorder=1)
            continue
        style = {"lw": 1.2, **STYLES[one.alpha], "marker": ""}
        handles += left.plot(one.g, one.arc, **style, label=rf"$\alpha$ = {one.alpha:g}")
        right.plot(one.g, one.normal_load, **style)
    rate = wedge.energy_release_rate
    handles += left.plot(rate, wedge.contact_width, "k:", lw=0.9, label="linear wedge")
    right.plot(rate, wedge.vertical_force, "k:", lw=0.9)
    handles += left.plot(g, np.full_like(g, 2.0), "k-", lw=0.7, label="Eq. (13)")
    right.plot(g, 2.0 + g / 2.0, "k-", lw=0.7)
    if any(one.alpha not in STYLES for one in curves):
        handles += left.plot([], [], color=_OTHER, lw=0.6, label=r"other $\alpha$")
    left.set(xscale="log", ylim=(0.0, 2.1))
    right.set(xscale="log", yscale="log")
    named(left, TOUGHNESS, r"$A = \cos\theta_1 - \cos\theta_2$ [-]")
    named(right, TOUGHNESS, r"$B = F_v/(\mu R_w T)$ [-]")
    legend(figure, handles, 6)
    alpha, at, arc, load = stacked(curves, "g", "arc", "normal_load")
    return {("alpha", ""): alpha, ("g", ""): at, ("A", ""): arc, ("B", ""): load}


def eq13_figure(curves: Sequence[Curve], figure: Figure) -> Columns:
    """Draw the error of Eq. (13) in the force over g and tau_w/(mu xi).

    Parameters
    ----------
    curves : sequence of Curve
        One row of panels for each alpha; the columns are friction coefficients.
    figure : matplotlib.figure.Figure
        Where to draw.

    Returns
    -------
    dict
        Columns: alpha, xi, tau_w/(mu xi), g and the error [-].

    References
    ----------
    arXiv:2412.02021, Eqs. (6), (13) and (S2).
    """
    axes = panels(figure, len(_FRICTION), len(curves)).reshape(len(curves), len(_FRICTION))
    ratio = np.geomspace(*_RATIO, 41)
    parts: list[Columns] = []
    for line, one in zip(axes, curves, strict=True):
        for ax, xi in zip(line, _FRICTION, strict=True):
            error = eq13_error(one.g, one.arc, one.normal_load, xi, ratio[:, None])
            filled = _error_map(ax, one.g, ratio, 100.0 * error)
            ax.set_title(rf"$\alpha$ = {one.alpha:g}, $\xi$ = {xi:g}", fontsize=MEDIUM)
            named(ax, TOUGHNESS, r"$\tau_w/(\mu\xi)$ [-]")
            ax.label_outer()
            at, wear = np.meshgrid(one.g, ratio)
            parts.append(
                {
                    ("alpha", ""): np.full(at.size, one.alpha),
                    ("xi", ""): np.full(at.size, xi),
                    ("tau_w_over_mu_xi", ""): wear.ravel(),
                    ("g", ""): at.ravel(),
                    ("error_of_Eq_13", ""): error.ravel(),
                }
            )
    bar = figure.colorbar(filled, ax=axes, shrink=0.6, ticks=_LEVELS)
    bar.set_label("error of Eq. (13) in $F_{ss}$ [%]; dashed: none", fontsize=MEDIUM)
    bar.ax.tick_params(labelsize=SMALL)
    return {key: np.concatenate([part[key] for part in parts]) for key in parts[0]}


def _error_map(ax: Axes, g: Floats, ratio: Floats, error: Floats) -> Any:
    filled = ax.contourf(g, ratio, error, _LEVELS, cmap="cividis_r", norm=_norm(), extend="both")
    if error.min() < 0.0 < error.max():
        ax.contour(g, ratio, error, [0.0], colors="k", linewidths=0.8, linestyles="--")
    ax.set(xscale="log", yscale="log")
    return filled


def _norm() -> Any:
    from matplotlib.colors import BoundaryNorm

    return BoundaryNorm(_LEVELS, 256, extend="both")


def specimen_figure(results: Sequence[Result], figure: Figure) -> Columns:
    """Draw J(delta), A(g) and B(g) of blocks of several heights, alpha = 2.

    Parameters
    ----------
    results : sequence of Result
        The study.
    figure : matplotlib.figure.Figure
        Where to draw.

    Returns
    -------
    dict
        The curves as columns: H/R_w, delta/R_w, g, A and B [-].

    References
    ----------
    arXiv:2412.02021, Eqs. (5) and (11).
    """
    axes = panels(figure, 3)
    groups = group(results, 2.0)
    heights = sorted({height for _, height in groups if np.isfinite(height)})
    for (side, height), rows in groups.items():
        _draw_block(axes, rows, _block_style(side, height, heights))
    deltas = np.array([1.1, 20.0])
    axes[0].plot(deltas, far_field_energy_release_rate(deltas), "k:", lw=1.1, label="Eq. (5), (11)")
    for style, name in (("-", "sides on rollers"), ("--", "sides free")):
        axes[0].plot([], [], style, color=GREY, lw=0.9, label=name)
    axes[0].set(xscale="log", yscale="log", ylim=(1e-3, 3.0))
    named(axes[0], DISTANCE, r"$J/(\mu R_w)$ [-]")
    for ax, name in ((axes[1], "$A$ [-]"), (axes[2], "$B$ [-]")):
        ax.axhline(2.0, color="k", ls=":", lw=1.1)
        ax.set(xscale="log", xlim=(1e-3, 3.0), ylim=(0.0, None))
        named(ax, TOUGHNESS, name)
    legend(figure, axes[0].get_legend_handles_labels()[0], 6)
    everything = [one for rows in groups.values() for one in rows]
    return {
        ("H_over_R_w", ""): np.array([one.case.half_height for one in everything]),
        ("rollers", ""): np.array([float(one.case.side == "rollers") for one in everything]),
        ("delta_over_R_w", ""): np.array([one.distance for one in everything]),
        ("g", ""): np.array([one.energy_release_rate for one in everything]),
        ("A", ""): np.array([one.arc for one in everything]),
        ("B", ""): np.array([one.normal_load for one in everything]),
    }


def _block_style(side: str, height: float, heights: Sequence[float]) -> dict[str, Any]:
    from matplotlib import colormaps

    if not np.isfinite(height):
        return {"color": "k", "lw": 1.4, "label": "large body"}
    shade = 0.9 * heights.index(height) / max(len(heights) - 1, 1)
    rollers = side == "rollers"
    return {
        "color": colormaps["viridis"](shade),
        "ls": "-" if rollers else "--",
        "lw": 0.9,
        "label": rf"$H/R_w$ = {height:g}" if rollers else None,
    }


def _draw_block(axes: NDArray[Any], rows: Sequence[Result], style: dict[str, Any]) -> None:
    delta, J, A, B = (
        [getattr(one, name) for one in rows]
        for name in ("distance", "energy_release_rate", "arc", "normal_load")
    )
    for ax, x, y in ((axes[0], delta, J), (axes[1], J, A), (axes[2], J, B)):
        ax.plot(x, y, **style)

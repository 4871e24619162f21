"""Figures that the paper does not have: A and B, the error of Eq. (13), finite specimens."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from fe_training.figure_style import DISTANCE, STYLES, TOUGHNESS, Columns
from fe_training.mechanics.analytic import far_field_wedge
from fe_training.paper.curve import Curve, stacked
from fe_training.paper.power_laws import COUPLED_FRICTION, eq13_beside_coupled, eq13_error
from fe_training.paper.specimen import Result, group
from surrogate import contact_functions
from surrogate.basics.figures import GREY, MEDIUM, SMALL, label_axes, legend_over, panels
from surrogate.equations import far_field_energy_release_rate

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["contact_figure", "eq13_coupled_figure", "eq13_figure", "specimen_figure"]

Floats = NDArray[np.float64]

#: Friction coefficients of the panels of Eq. (13)'s error, and the range of tau_w/(mu xi).
_FRICTION = (0.1, 0.5, 1.0)
_RATIO = (0.01, 100.0)

#: Errors between the colours [%].
_LEVELS = (-10, -5, 0, 5, 10, 20, 30, 50, 75, 100)
_UNKNOWN = "#d9d9d9"
_OTHER = "#aaaaaa"
_OTHER_STYLE: dict[str, Any] = {"color": _OTHER, "lw": 0.4, "zorder": 1}

#: Depth of colour of an error between two levels, the same for both signs: 0.5 is the deepest.
_DEPTHS = (-0.24, -0.14, -0.05, 0.05, 0.14, 0.24, 0.31, 0.37, 0.42, 0.46, 0.5)


def contact_figure(curves: Sequence[Curve], figure: Figure) -> Columns:
    """Draw A and B over g beside Eq. (13)'s 2 and 2 + g/2 and the linear wedge.

    Lines are the model of Gaussian processes, marks every second point of the data.

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
    left, right = panels(figure, 2)[0]
    wedge = far_field_wedge(np.geomspace(2.0, 60.0, 100))
    g = np.geomspace(2.5e-3, max(one.g.max() for one in curves), 360)
    handles: list[Any] = []
    for one in curves:
        own = one.alpha in STYLES
        inside = g[(g >= one.g.min()) & (g <= one.g.max())]
        model = contact_functions(inside, one.alpha, "gp", extrapolate=True)
        style = {"lw": 1.2, **STYLES[one.alpha], "marker": ""} if own else _OTHER_STYLE
        label = rf"$\alpha$ = {one.alpha:g}"
        drawn = left.plot(inside, model.arc, **style, label=label)
        right.plot(inside, model.normal_load, **style)
        if own:
            handles += drawn
            marks = {
                "ls": "",
                "ms": 2.2,
                "color": style["color"],
                "marker": STYLES[one.alpha]["marker"],
            }
            left.plot(one.g, one.arc, **marks, markevery=2)
            right.plot(one.g, one.normal_load, **marks, markevery=2)
    rate = wedge.energy_release_rate
    handles += left.plot(rate, wedge.contact_width, "k:", lw=0.9, label="linear wedge")
    right.plot(rate, wedge.vertical_force, "k:", lw=0.9)
    handles += left.plot(g, np.full_like(g, 2.0), "k-", lw=0.7, label="Eq. (13)")
    right.plot(g, 2.0 + g / 2.0, "k-", lw=0.7)
    if any(one.alpha not in STYLES for one in curves):
        handles += left.plot([], [], color=_OTHER, lw=0.6, label=r"other $\alpha$")
    handles += left.plot([], [], "o", ms=2.2, color=GREY, label="finite elements")
    left.set(xscale="log", ylim=(0.0, 2.1))
    right.set(xscale="log", yscale="log")
    label_axes(left, TOUGHNESS, r"$A = \cos\theta_1 - \cos\theta_2$ [-]")
    label_axes(right, TOUGHNESS, r"$B = F_v/(\mu R_w T)$ [-]")
    legend_over(figure, handles, 7)
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
    axes = panels(figure, len(_FRICTION), len(curves))
    ratio = np.geomspace(*_RATIO, 41)
    parts: list[Columns] = []
    reach = min(one.g.min() for one in curves), max(one.g.max() for one in curves)
    for line, one in zip(axes, curves, strict=True):
        for ax, xi in zip(line, _FRICTION, strict=True):
            error = eq13_error(one.g, one.arc, one.normal_load, xi, ratio[:, None])
            filled = _error_map(ax, one.g, ratio, 100.0 * error)
            ax.set_xlim(reach)
            ax.set_title(rf"$\alpha$ = {one.alpha:g}, $\xi$ = {xi:g}", fontsize=MEDIUM)
            label_axes(ax, TOUGHNESS, r"$\tau_w/(\mu\xi)$ [-]")
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
    bar.set_label("error of Eq. (13) in $F_{ss}$ [%], dashed: 0", fontsize=MEDIUM)
    bar.ax.tick_params(labelsize=SMALL)
    return {key: np.concatenate([part[key] for part in parts]) for key in parts[0]}


def eq13_coupled_figure(alphas: Sequence[float], figure: Figure) -> Columns:
    """Draw the error of Eq. (13) beside the law "coupled" over g and tau_w/(mu xi).

    Parameters
    ----------
    alphas : sequence of float
        One row of panels for each; the columns are friction coefficients.
    figure : matplotlib.figure.Figure
        Where to draw.

    Returns
    -------
    dict
        Columns: alpha, xi, tau_w/(mu xi), g, the error and the bound of the coupled force's own
        [-]; nan where no coupled solution is near.

    References
    ----------
    arXiv:2412.02021, Eq. (13).
    """
    axes = panels(figure, len(COUPLED_FRICTION), len(alphas))
    g, ratio = np.geomspace(2.5e-3, 100.0, 121), np.geomspace(*_RATIO, 81)
    parts: list[Columns] = []
    for line, alpha in zip(axes, alphas, strict=True):
        for ax, xi in zip(line, COUPLED_FRICTION, strict=True):
            error, own = eq13_beside_coupled(g, alpha, xi, ratio[:, None])
            filled = _error_map(ax, g, ratio, 100.0 * error)
            ax.set_facecolor(_UNKNOWN)
            ax.set_title(rf"$\alpha$ = {alpha:g}, $\xi$ = {xi:g}", fontsize=MEDIUM)
            label_axes(ax, TOUGHNESS, r"$\tau_w/(\mu\xi)$ [-]")
            ax.label_outer()
            at, wear = np.meshgrid(g, ratio)
            parts.append(
                {
                    ("alpha", ""): np.full(at.size, alpha),
                    ("xi", ""): np.full(at.size, xi),
                    ("tau_w_over_mu_xi", ""): wear.ravel(),
                    ("g", ""): at.ravel(),
                    ("error_of_Eq_13", ""): error.ravel(),
                    ("bound_of_the_coupled_force", ""): own.ravel(),
                }
            )
    bar = figure.colorbar(filled, ax=axes, shrink=0.6, ticks=_LEVELS)
    bar.set_label("error of Eq. (13) in $F_{ss}$ [%], dashed: 0", fontsize=MEDIUM)
    bar.ax.tick_params(labelsize=SMALL)
    return {key: np.concatenate([part[key] for part in parts]) for key in parts[0]}


def _error_map(ax: Axes, g: Floats, ratio: Floats, error: Floats) -> Any:
    from matplotlib import colormaps

    colours = colormaps["RdBu_r"](0.5 + np.array(_DEPTHS))
    filled = ax.contourf(g, ratio, error, _LEVELS, colors=colours, extend="both")
    if np.nanmin(error) < 0.0 < np.nanmax(error):
        ax.contour(g, ratio, error, [0.0], colors="k", linewidths=0.8, linestyles="--")
    ax.set(xscale="log", yscale="log")
    return filled


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
    axes = panels(figure, 3)[0]
    groups = group(results, 2.0)
    heights = sorted({height for _, height in groups if np.isfinite(height)})
    colours = _height_colours(heights)
    handles: list[Any] = []
    for (side, height), rows in groups.items():
        large = not np.isfinite(height)
        colour = "k" if large else colours.to_rgba(height)
        line = _draw_block(
            axes, rows, colour, 1.4 if large else 0.9, "-" if side == "rollers" or large else "--"
        )
        if large:
            line.set_label("large body")
            handles.append(line)
    deltas = np.array([1.1, 20.0])
    eq5 = far_field_energy_release_rate(deltas)
    handles += axes[0].plot(deltas, eq5, "k:", lw=1.1, label="Eqs. (5), (11)")
    for style, name in (("-", "sides on rollers"), ("--", "sides free")):
        handles += axes[0].plot([], [], style, color=GREY, lw=0.9, label=name)
    axes[0].set(xscale="log", yscale="log", ylim=(1e-3, 3.0))
    label_axes(axes[0], DISTANCE, r"$J/(\mu R_w)$ [-]")
    for ax, name in ((axes[1], "$A$ [-]"), (axes[2], "$B$ [-]")):
        ax.axhline(2.0, color="k", ls=":", lw=1.1)
        ax.set(xscale="log", xlim=(1e-3, 3.0), ylim=(0.0, None))
        label_axes(ax, TOUGHNESS, name)
    bar = figure.colorbar(colours, ax=axes, pad=0.01)
    bar.set_label(r"half the height of the block, $H/R_w$ [-]", fontsize=MEDIUM)
    bar.set_ticks(heights, labels=[f"{height:g}" for height in heights])
    bar.ax.tick_params(labelsize=SMALL)
    bar.ax.minorticks_off()
    legend_over(figure, handles, 4)
    everything = [one for rows in groups.values() for one in rows]
    return {
        ("H_over_R_w", ""): np.array([one.case.half_height for one in everything]),
        ("rollers", ""): np.array([float(one.case.side == "rollers") for one in everything]),
        ("delta_over_R_w", ""): np.array([one.distance for one in everything]),
        ("g", ""): np.array([one.energy_release_rate for one in everything]),
        ("A", ""): np.array([one.arc for one in everything]),
        ("B", ""): np.array([one.normal_load for one in everything]),
    }


def _height_colours(heights: Sequence[float]) -> Any:
    """Return what gives each height its colour."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import LogNorm

    return ScalarMappable(LogNorm(0.8 * heights[0], 1.25 * heights[-1]), "viridis_r")


def _draw_block(
    axes: NDArray[Any], rows: Sequence[Result], colour: Any, width: float, dashes: str
) -> Any:
    """Draw a block's points, and a smooth curve through them; return that of the first panel."""
    delta, J, A, B = (
        np.array([getattr(one, name) for one in rows], dtype=float)
        for name in ("distance", "energy_release_rate", "arc", "normal_load")
    )
    lines = []
    for ax, x, y, log in (
        (axes[0], delta, J, True),
        (axes[1], J, A, False),
        (axes[2], J, B, False),
    ):
        ax.plot(x, y, "o", ms=1.3, color=colour)
        lines += ax.plot(*_smooth(x, y, log), color=colour, lw=width, ls=dashes)
    return lines[0]


def _smooth(x: Floats, y: Floats, log: bool) -> tuple[Floats, Floats]:
    """Return a curve without kinks or bumps through points, over ln x, of ln y where it is log."""
    from scipy.interpolate import PchipInterpolator

    order = np.argsort(x)
    known = order[np.isfinite(x[order]) & np.isfinite(y[order])]
    at, first = np.unique(np.log(x[known]), return_index=True)
    values = y[known][first]
    if at.size < 2:
        return np.exp(at), values
    fine = np.linspace(at[0], at[-1], 120)
    curve = PchipInterpolator(at, np.log(values) if log else values)(fine)
    return np.exp(fine), np.exp(curve) if log else curve

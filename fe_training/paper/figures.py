"""The paper's Figs. 2c, 3a and 4 and Table 1, remade from a campaign's data set.

Each function draws one figure, the paper's law beside the finite elements, and returns the curves
on it as columns for a table.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from fe_training.campaign.dataset import Campaign
from fe_training.figure_style import DISTANCE, STYLES, TOUGHNESS, Columns
from fe_training.mechanics.analytic import far_field_wedge
from fe_training.paper.curve import TOUCHED, Curve, stacked
from fe_training.paper.power_laws import fits, local_exponent, over_lower_end
from fe_training.solver.pictures import plot_stress_ahead
from fe_training.solver.record import Outcome, Record
from surrogate.basics.figures import MEDIUM, label_at_right, label_axes, legend_over, panels
from surrogate.equations import TABLE_1, far_field_energy_release_rate
from surrogate.errors import InputError

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = [
    "RATIOS",
    "dissipation_figure",
    "energy_release_figure",
    "exponent_figure",
    "stress_figure",
    "stress_records",
]

Floats = NDArray[np.float64]

RATIOS = (0.1, 1.0, 10.0)
"""tau_w/(mu xi) that Fig. 4 is drawn for here."""

FURTHEST = 16.0
"""delta/R_w up to which Fig. 2c goes."""

NEAR_ENOUGH = 0.3
"""|ln| of a distance over the wanted one up to which a row may stand for it."""


def energy_release_figure(curves: Sequence[Curve], figure: Figure) -> Columns:
    """Draw J/(mu R_w) over delta/R_w as in Fig. 2c, and its local exponent.

    Parameters
    ----------
    curves : sequence of Curve
        One for each alpha.
    figure : matplotlib.figure.Figure
        Where to draw.

    Returns
    -------
    dict
        The curves as columns: alpha, delta/R_w, J/(mu R_w), Eq. (5), the linear wedge, and
        d ln J/d ln delta, nan where the wire touches the tip [-].

    References
    ----------
    arXiv:2412.02021, Eq. (5) and Fig. 2c.
    """
    left, right = panels(figure, 2)[0]
    furthest = max(float(one.distance.max()) for one in curves)
    distance = np.geomspace(1.0, furthest, 300)
    wedge = np.asarray(far_field_wedge(distance).energy_release_rate)
    paper = far_field_energy_release_rate(distance)
    slopes = [_distance_exponent(one) for one in curves]
    handles = [
        *left.plot(distance, paper, "k-", lw=0.7, label="Eq. (5)"),
        *left.plot(distance, wedge, "k:", lw=1.1, zorder=3, label="linear wedge"),
    ]
    right.axhline(-2.0, color="k", lw=0.7)
    right.plot(distance[1:-1], local_exponent(distance, wedge)[1:-1], "k:", lw=1.1)
    for one, slope in zip(curves, slopes, strict=True):
        style = {"ms": 3.0, **STYLES[one.alpha]}
        label = rf"$\alpha$ = {one.alpha:g}"
        # evenly along the curve: at the tip the rows are too many to be told apart
        handles += left.plot(one.distance, one.g, **style, lw=0.8, markevery=0.05, label=label)
        right.plot(one.distance, slope, **style, lw=0.8)
    lowest = min(float(one.g[one.distance <= FURTHEST].min()) for one in curves)
    left.set_xlim(0.4, FURTHEST)
    left.set_ylim(0.5 * min(lowest, 1.0 / FURTHEST**2), 2.0 * max(one.g.max() for one in curves))
    left.set_yscale("log")
    right.set_xscale("log")
    right.set_ylim(-6.0, 0.0)
    right.set_xticks([1, 2, 5, 10, 20, 50], ["1", "2", "5", "10", "20", "50"])
    label_axes(left, DISTANCE, r"$J/(\mu R_w)$ [-]")
    label_axes(right, DISTANCE, r"$d\,\ln J/d\,\ln\delta$ [-]")
    legend_over(figure, handles, len(handles))
    alpha, at, rate = stacked(curves, "distance", "g")
    return {
        ("alpha", ""): alpha,
        ("delta_over_R_w", ""): at,
        ("J_over_mu_R_w", ""): rate,
        ("Eq_5", ""): far_field_energy_release_rate(np.maximum(at, 1.0)),
        ("linear_wedge", ""): far_field_wedge(np.maximum(at, 1.0)).energy_release_rate,
        ("local_exponent", ""): np.concatenate(slopes),
    }


def _distance_exponent(one: Curve) -> Floats:
    slope = np.full(one.g.size, np.nan)
    if one.far.sum() > 1:
        slope[one.far] = local_exponent(one.distance[one.far], one.g[one.far])
    return slope


def stress_records(
    data: Campaign, alpha: float, distances: Sequence[float] = (1.0, 15.0)
) -> list[Record]:
    """Return the rows of one alpha that are nearest to some distances, as records for a figure.

    Where the wire touches the tip, the first touch is taken.

    Parameters
    ----------
    data : Campaign
        The data.
    alpha : float
        One of its exponents [-].
    distances : sequence of float
        Wanted delta/R_w [-].

    Raises
    ------
    InputError
        If no row of this alpha was solved, or none near one of the distances.
    """
    rows = data.rows
    solved = np.flatnonzero(
        (rows["alpha"] == alpha)
        & np.isfinite(rows["energy_release_rate"])
        & (rows["level"] == list(data.design.levels)[-1])
    )
    if not solved.size:
        raise InputError(
            f"the data have no solved row of alpha = {alpha:g} on the finer mesh; let the "
            "campaign go on."
        )
    solved = solved[np.argsort(rows["energy_release_rate"][solved])]
    found = []
    for distance in distances:
        off = np.abs(np.log(np.maximum(rows["distance"][solved], 1.0 + TOUCHED) / distance))
        if off.min() > NEAR_ENOUGH:
            raise InputError(
                f"the data have no row of alpha = {alpha:g} near delta = {distance:g} R_w; the "
                f"nearest is at {rows['distance'][solved[np.argmin(off)]]:.3g}: let the campaign "
                "go on."
            )
        found.append(_record(data, int(solved[np.argmin(off)])))
    return found


def _record(data: Campaign, row: int) -> Record:
    rows = data.rows
    profile = {name: rows[name][row] for name in ("ahead_reference", "ahead_stress")}
    there = np.isfinite(profile["ahead_reference"])
    return Record(
        alpha=float(rows["alpha"][row]),
        outcome=Outcome[str(rows["outcome"][row])],
        energy_release_rate=float(rows["energy_release_rate"][row]),
        distance=float(rows["distance"][row]),
        mesh=json.loads(str(rows["mesh"][row])),
        **{name: values[there].astype(float) for name, values in profile.items()},
    )


def stress_figure(records: Sequence[Record], ax: Axes) -> Columns:
    """Draw sigma_22/mu over r/R_w ahead of the tip, as in Fig. 3a.

    Parameters
    ----------
    records : sequence of Record
        Configurations, see `stress_records`.
    ax : matplotlib.axes.Axes
        Where to draw.

    Returns
    -------
    dict
        The curves as columns: delta/R_w, g, r/R_w and sigma_22/mu [-].

    References
    ----------
    arXiv:2412.02021, Fig. 3a.
    """
    plot_stress_ahead(records, ax)
    sizes = [one.ahead_reference.size for one in records]
    return {
        ("alpha", ""): np.repeat([one.alpha for one in records], sizes),
        ("delta_over_R_w", ""): np.repeat([one.distance for one in records], sizes),
        ("g", ""): np.repeat([one.energy_release_rate for one in records], sizes),
        ("r_over_R_w", ""): np.concatenate([one.ahead_reference for one in records]),
        ("sigma_22_over_mu", ""): np.concatenate([one.ahead_stress for one in records]),
    }


def dissipation_figure(curves: Sequence[Curve], figure: Figure) -> Columns:
    """Draw F_d/(xi mu R_w T) over Gamma_o/(mu R_w) for several tau_w/(mu xi), as in Fig. 4.

    Parameters
    ----------
    curves : sequence of Curve
        One panel for each alpha.
    figure : matplotlib.figure.Figure
        Where to draw.

    Returns
    -------
    dict
        The curves as columns: alpha, tau_w/(mu xi), g, F_d/(xi mu R_w T) of the finite elements,
        of Eq. (13), and of Eq. (9) where Table 1 has the alpha, else nan [-].

    References
    ----------
    arXiv:2412.02021, Eqs. (9), (11), (13), (S2), Table 1 and Fig. 4.
    """
    axes = panels(figure, len(curves))[0]
    shades = ("#56B4E9", "#0072B2", "#001f3f")
    parts: list[Columns] = []
    top = max(_highest_dissipation(one) for one in curves)
    for ax, one in zip(axes, curves, strict=True):
        g = np.geomspace(one.g.min(), one.g.max(), 100)
        for ratio, colour, marker in zip(RATIOS, shades, ("o", "s", "^"), strict=True):
            force = 2.0 * (ratio * one.arc + one.normal_load)
            ax.plot(one.g, force, marker, ms=3.0, color=colour)
            ax.plot(g, g + 4.0 + 4.0 * ratio, color=colour, lw=0.9)
            parts.append(_dissipation_columns(one, ratio, force))
        if one.alpha in TABLE_1:
            high = g[g >= 1.0]
            ax.plot(high, high ** TABLE_1[one.alpha], "k--", lw=0.9)
        ax.set_title(rf"$\alpha$ = {one.alpha:g}", fontsize=MEDIUM)
        ax.set(xscale="log", yscale="log", ylim=(0.8, 1.5 * top))
        label_axes(ax, TOUGHNESS, r"$F_d/(\xi\mu R_w T)$ [-]")
        ax.label_outer()
    handles = []
    for ratio, colour, marker in zip(RATIOS, shades, ("o", "s", "^"), strict=True):
        label = rf"finite elements, $\tau_w/(\mu\xi)$ = {ratio:g}"
        handles += axes[0].plot([], [], marker, ms=3.0, color=colour, label=label)
    label = "Eq. (13), same colours"
    handles += axes[0].plot([], [], "-", color=shades[1], lw=0.9, label=label)
    handles += axes[0].plot([], [], "k--", lw=0.9, label="Eq. (9), Table 1")
    legend_over(figure, handles, 3)
    return {key: np.concatenate([part[key] for part in parts]) for key in parts[0]}


def _highest_dissipation(one: Curve) -> float:
    """Return the highest that is drawn of a curve: finite elements, Eq. (13) or Eq. (9)."""
    last, ratio = float(one.g.max()), max(RATIOS)
    elements = float(np.max(2.0 * (ratio * one.arc + one.normal_load)))
    power = last ** TABLE_1[one.alpha] if one.alpha in TABLE_1 else 0.0
    return max(elements, last + 4.0 + 4.0 * ratio, power)


def _dissipation_columns(one: Curve, ratio: float, force: Floats) -> Columns:
    n = TABLE_1.get(one.alpha, np.nan)
    return {
        ("alpha", ""): np.full(one.g.size, one.alpha),
        ("tau_w_over_mu_xi", ""): np.full(one.g.size, ratio),
        ("g", ""): one.g,
        ("finite_elements", ""): force,
        ("Eq_13", ""): one.g + 4.0 + 4.0 * ratio,
        ("Eq_9", ""): one.g**n,
    }


def exponent_figure(curves: Sequence[Curve], figure: Figure) -> Columns:
    """Draw the exponent of the friction: the local one, and fitted ones over their lower end.

    Parameters
    ----------
    curves : sequence of Curve
        One for each alpha.
    figure : matplotlib.figure.Figure
        Where to draw.

    Returns
    -------
    dict
        The fits of `fe_training.paper.power_laws.fits` as columns [-].

    References
    ----------
    arXiv:2412.02021, Eq. (9) and Table 1.
    """
    left, right = panels(figure, 2)[0]
    ends: list[list[tuple[float, str]]] = [[], []]
    names: dict[str, str] = {}
    for one in curves:
        style = {"lw": 1.1, **STYLES[one.alpha], "marker": ""}
        marks = {**style, "lw": 0.6, "marker": STYLES[one.alpha]["marker"], "ms": 3.0}
        slope = local_exponent(one.g, one.normal_load)
        high = one.g >= 0.5
        left.plot(one.g[high], slope[high], **style)
        free, fixed = over_lower_end(one, False), over_lower_end(one, True)
        right.plot(*free, **style)
        right.plot(*fixed, **marks, markevery=max(1, len(fixed[0]) // 6))
        names[rf"$\alpha$ = {one.alpha:g}"] = style["color"]
        for side, value in zip(ends, (slope[high][-1], free[1][-1]), strict=True):
            side.append((float(value), rf"$\alpha$ = {one.alpha:g}"))
        for ax in (left, right) if one.alpha in TABLE_1 else ():
            ax.axhline(TABLE_1[one.alpha], color=style["color"], ls=":", lw=0.9)
    for ax, side in zip((left, right), ends, strict=True):
        ax.set(xscale="log", ylim=(0.0 if ax is left else 0.6, 1.3))
        label_at_right(ax, side, names)
    handles = right.plot(
        [], [], "k-", lw=1.1, label="$d\\,\\ln B/d\\,\\ln g$, and $n$ with $C$ free"
    )
    handles += right.plot([], [], "ko-", lw=0.6, ms=3.0, label="$n$ with $C = 1$")
    handles += right.plot([], [], "k:", lw=0.9, label="Table 1")
    label_axes(left, TOUGHNESS, r"$d\,\ln B/d\,\ln g$ [-]")
    lowest = "lowest $g$ of the fit, up to the largest [-]"
    label_axes(right, lowest, r"$n$ of $2B = C\,g^{\,n}$ [-]")
    legend_over(figure, handles, len(handles))
    return {(name, ""): values for name, values in fits(curves).items()}

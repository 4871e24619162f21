"""The paper's figures, remade from the data sets: its laws beside the finite elements.

Each function draws one figure and returns the axes and the curves on it, as columns for a table.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from surrogate.equations import TABLE_1, far_field_energy_release_rate
from surrogate.figures import MEDIUM, SMALL, legend_above

from .comparison import fit_power
from .dataset import Campaign
from .errors import InputError
from .fit_points import points_of
from .plots import plot_stress_ahead
from .record import Outcome, Record
from .reference import far_field_wedge

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = [
    "Curve",
    "dissipation_figure",
    "energy_release_figure",
    "exponents",
    "stress_figure",
    "stress_records",
]

Floats = NDArray[np.float64]
Columns = dict[tuple[str, str], Any]

ALPHAS = (2.0, 5.0, 9.0)
"""Stiffening exponents of the paper."""

RATIOS = (0.1, 1.0, 10.0)
"""tau_w/(mu xi) that Fig. 4 is drawn for here."""

FURTHEST = 16.0
"""delta/R_w up to which Fig. 2c goes."""

FIT_RANGES = ((1.0, 100.0), (5.0, 100.0), (10.0, 100.0))
"""Ranges of g for which Eq. (9) is fitted."""

NEAR_ENOUGH = 0.3
"""|ln| of a distance over the wanted one up to which a row may stand for it."""

TOUCHED = 2e-3
"""delta/R_w - 1 below which the wire is taken to touch the tip."""

_COLOURS = {2.0: "#0072B2", 5.0: "#D55E00", 9.0: "#009E73"}
_MARKERS = {2.0: "o", 5.0: "s", 9.0: "^"}


@dataclass(frozen=True, eq=False)
class Curve:
    """A, B and delta of one alpha over g, rising.

    Parameters
    ----------
    alpha : float
        Strain-stiffening exponent [-].
    g, arc, normal_load, distance : ndarray, shape (points,)
        J/(mu R_w), A, B and delta/R_w [-].
    sure : ndarray of bool, shape (points,)
        Whether the evidence of each is within its bounds.
    """

    alpha: float
    g: Floats
    arc: Floats
    normal_load: Floats
    distance: Floats
    sure: NDArray[np.bool_]

    @classmethod
    def of(cls, data: Campaign, alpha: float, unsure: bool = False) -> Curve:
        """Return the curve of a data set.

        Parameters
        ----------
        data : Campaign
            The data.
        alpha : float
            One of its exponents [-].
        unsure : bool
            Whether to take points as well that only one mesh level has reached.

        Raises
        ------
        InputError
            If there are fewer than three points.
        """
        points = points_of(data, single_mesh=unsure)
        points = points.taken(points.alpha == alpha)
        if len(points) < 3:
            raise InputError(
                f"the data have {len(points)} points of alpha = {alpha:g} that may be used; "
                "a figure needs three or more: let the campaign go on."
            )
        used = data.points["use"].astype(bool) & (data.points["alpha"] == alpha)
        sure = np.isin(points.g, data.points["g"][used])
        return cls(alpha, points.g, points.arc, points.normal_load, points.distance, sure)

    @property
    def far(self) -> NDArray[np.bool_]:
        """Where the wire does not touch the tip."""
        return self.distance > 1.0 + TOUCHED


def energy_release_figure(curves: Sequence[Curve], ax: Axes) -> Columns:
    """Draw J/(mu R_w) over delta/R_w with a logarithmic axis of J, as in Fig. 2c.

    Parameters
    ----------
    curves : sequence of Curve
        One for each alpha.
    ax : matplotlib.axes.Axes
        Where to draw.

    Returns
    -------
    dict
        The curves as columns: alpha, delta/R_w, J/(mu R_w), Eq. (5) and the linear wedge [-].

    References
    ----------
    arXiv:2412.02021, Eq. (5) and Fig. 2c.
    """
    distance = np.linspace(1.0, FURTHEST, 200)
    wedge = np.asarray(far_field_wedge(distance).energy_release_rate)
    ax.plot(distance, far_field_energy_release_rate(distance), "k--", lw=0.9, label="Eq. (5)")
    ax.plot(distance, wedge, "k:", lw=1.1, label="linear wedge")
    for one in curves:
        near = one.distance <= FURTHEST
        _points(ax, one, one.distance, one.g, near)
    ax.set_yscale("log")
    ax.set_xlim(0.4, FURTHEST)
    lowest = min(float(one.g[one.distance <= FURTHEST].min()) for one in curves)
    ax.set_ylim(0.5 * min(lowest, 1.0 / FURTHEST**2), 2.0 * max(one.g.max() for one in curves))
    _finish(ax, r"distance to the tip $\delta/R_w$ [-]", r"$J/(\mu R_w)$ [-]", 3)
    alpha, at, rate = _stacked(curves, "distance", "g")
    return {
        ("alpha", ""): alpha,
        ("delta_over_R_w", ""): at,
        ("J_over_mu_R_w", ""): rate,
        ("Eq_5", ""): far_field_energy_release_rate(np.maximum(at, 1.0)),
        ("linear_wedge", ""): far_field_wedge(np.maximum(at, 1.0)).energy_release_rate,
    }


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
    axes = np.atleast_1d(figure.subplots(1, len(curves), sharex=True, sharey=True))
    shades = ("#56B4E9", "#0072B2", "#001f3f")
    parts: list[Columns] = []
    for ax, one in zip(axes, curves, strict=True):
        g = np.geomspace(one.g.min(), one.g.max(), 100)
        for ratio, colour, marker in zip(RATIOS, shades, ("o", "s", "^"), strict=True):
            force = 2.0 * (ratio * one.arc + one.normal_load)
            style = {"ms": 3.0, "mew": 0.7, "ls": "none", "mec": colour}
            ax.plot(one.g[~one.sure], force[~one.sure], marker, mfc="white", **style)
            ax.plot(one.g[one.sure], force[one.sure], marker, mfc=colour, **style)
            ax.plot(g, g + 4.0 + 4.0 * ratio, color=colour, lw=0.9)
            parts.append(_dissipation_columns(one, ratio, force))
        if one.alpha in TABLE_1:
            high = g[g >= 1.0]
            ax.plot(high, high ** TABLE_1[one.alpha], "k--", lw=0.9)
        ax.set_title(rf"$\alpha$ = {one.alpha:g}", fontsize=MEDIUM)
        ax.set_xscale("log")
        ax.set_yscale("log")
        ax.tick_params(which="both", labelsize=SMALL)
        ax.set_xlabel(r"$\Gamma_o/(\mu R_w)$ [-]", fontsize=MEDIUM)
        ax.spines[["top", "right"]].set_visible(False)
    axes[0].set_ylabel(r"$F_d/(\xi\mu R_w T)$ [-]", fontsize=MEDIUM)
    _dissipation_legend(figure, axes[0], shades)
    return {key: np.concatenate([part[key] for part in parts]) for key in parts[0]}


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


def _dissipation_legend(figure: Figure, ax: Axes, shades: Sequence[str]) -> None:
    handles = []
    for ratio, colour, marker in zip(RATIOS, shades, ("o", "s", "^"), strict=True):
        label = rf"finite elements, $\tau_w/(\mu\xi)$ = {ratio:g}"
        handles += ax.plot([], [], marker, ms=3.0, color=colour, label=label)
    handles += ax.plot([], [], "-", color=shades[1], lw=0.9, label="Eq. (13), same colours")
    handles += ax.plot([], [], "k--", lw=0.9, label="Eq. (9), Table 1")
    figure.legend(handles=handles, loc="outside upper left", ncols=3, fontsize=SMALL, frameon=False)


def exponents(curves: Sequence[Curve]) -> Columns:
    """Return Table 1 beside power laws fitted to 2 B, friction alone, over ranges of g.

    Parameters
    ----------
    curves : sequence of Curve
        One for each alpha.

    Returns
    -------
    dict
        Columns: alpha, ends of the range of g, n of Table 1, n and C of C g^n and its r^2, and n
        and r^2 where C = 1, as Eq. (9) is written [-].

    References
    ----------
    arXiv:2412.02021, Eq. (9) and Table 1.
    """
    names = (
        "alpha",
        "g_from",
        "g_to",
        "n_paper",
        "n",
        "C",
        "r2",
        "n_where_C_is_1",
        "r2_where_C_is_1",
    )
    lines = []
    for one in curves:
        for low, high in FIT_RANGES:
            chosen = (one.g >= low) & (one.g <= high)
            if chosen.sum() < 3:
                continue
            force = 2.0 * one.normal_load[chosen]
            free, bound = (fit_power(one.g[chosen], force, unit) for unit in (False, True))
            lines.append(
                (
                    one.alpha,
                    one.g[chosen].min(),
                    one.g[chosen].max(),
                    TABLE_1.get(one.alpha, np.nan),
                    free.exponent,
                    free.prefactor,
                    free.r_squared,
                    bound.exponent,
                    bound.r_squared,
                )
            )
    columns = np.array(lines).reshape(-1, len(names)).T
    return {(name, ""): values for name, values in zip(names, columns, strict=True)}


def _points(ax: Axes, one: Curve, x: Floats, y: Floats, chosen: NDArray[np.bool_]) -> None:
    colour, marker = _COLOURS.get(one.alpha, "#555555"), _MARKERS.get(one.alpha, "D")
    style: dict[str, Any] = {"ls": "none", "ms": 3.5, "mec": colour, "mew": 0.7, "zorder": 4}
    ax.plot(x[chosen & ~one.sure], y[chosen & ~one.sure], marker, mfc="white", **style)
    ax.plot(x[chosen & one.sure], y[chosen & one.sure], marker, mfc=colour, **style)
    label = rf"$\alpha$ = {one.alpha:g}"
    ax.plot([], [], marker, ms=3.5, color=colour, label=label)


def _finish(ax: Axes, x: str, y: str, columns: int) -> None:
    ax.set_xlabel(x, fontsize=MEDIUM)
    ax.set_ylabel(y, fontsize=MEDIUM)
    ax.tick_params(which="both", labelsize=SMALL)
    ax.spines[["top", "right"]].set_visible(False)
    legend_above(ax, columns)


def _stacked(curves: Sequence[Curve], *names: str) -> list[Floats]:
    alpha = np.concatenate([np.full(one.g.size, one.alpha) for one in curves])
    return [alpha, *(np.concatenate([getattr(one, name) for one in curves]) for name in names)]

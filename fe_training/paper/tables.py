"""The tables of the comparison with the paper, from the points of a campaign."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fe_training.campaign.dataset import Campaign
from fe_training.markdown import markdown_table, plain
from fe_training.mechanics.analytic import far_field_wedge
from fe_training.paper.curve import Curve
from fe_training.paper.power_laws import (
    COUPLED_FRICTION,
    eq13_beside_coupled,
    eq13_error,
    fits,
    local_exponent,
)
from surrogate.equations import far_field_energy_release_rate

__all__ = [
    "FRICTION",
    "WEAR_TO_FRICTION",
    "contact_table",
    "distance_table",
    "eq13_coupled_table",
    "eq13_table",
    "exponent_table",
    "local_table",
    "plateau_table",
]

Floats = NDArray[np.float64]

DISTANCES = (1.05, 1.2, 1.5, 2.0, 3.0, 5.0, 10.0, 20.0, 45.0)
PLATEAU_G = (0.0025, 0.01, 0.1, 1.0)
LOCAL_G = (1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 90.0)
WEAR_TO_FRICTION = (0.0, 0.1, 1.0, 10.0, 100.0)
"""tau_w/(mu xi) at which the error of Eq. (13) is looked at."""

FRICTION = (0.01, 0.1, 0.5, 1.0)
"""Friction coefficients at which it is."""

#: tau_w/mu of a wet gel without friction; the paper's gel has 11.3.
_FRICTION_FREE = 10.0


def distance_table(curves: Sequence[Curve]) -> str:
    """Return the local exponent of J(delta) and J over Eq. (5) at some distances.

    Parameters
    ----------
    curves : sequence of Curve
        One for each alpha; the linear wedge comes beside them.

    References
    ----------
    arXiv:2412.02021, Eq. (5).
    """
    deltas = np.geomspace(1.0 + 1e-6, 200.0, 400)
    wedge = np.asarray(far_field_wedge(deltas).energy_release_rate)
    lines = []
    for delta in DISTANCES:
        cells = [f"{delta:g}"]
        for one in curves:
            cells += _at_distance(one.distance[one.far], one.g[one.far], delta)
        lines.append([*cells, *_at_distance(deltas, wedge, delta)])
    head = [r"$\delta/R_w$"]
    for name in (*(rf"$\alpha$ = {one.alpha:g}" for one in curves), "linear wedge"):
        head += [f"exponent, {name}", "$J$/Eq. (5)"]
    return markdown_table(head, lines)


def _at_distance(distance: Floats, g: Floats, delta: float) -> list[str]:
    order = np.argsort(distance)
    x, y = distance[order], g[order]
    if not len(x) or not x[0] <= delta <= x[-1]:
        return ["-", "-"]
    exponent = np.interp(np.log(delta), np.log(x), local_exponent(x, y))
    rate = np.exp(np.interp(np.log(delta), np.log(x), np.log(y)))
    return [f"{exponent:.2f}", f"{rate / float(far_field_energy_release_rate(delta)):.2f}"]


def plateau_table(curves: Sequence[Curve]) -> str:
    """Return A and B at small g, where Eq. (11) has 2 for both, and the largest A.

    References
    ----------
    arXiv:2412.02021, Eqs. (11) and (S2).
    """
    lines = []
    for one in curves:
        cells = [f"{one.alpha:.3g}"]
        for g in PLATEAU_G:
            cells += [_number(one.at(values, g)) for values in (one.arc, one.normal_load)]
        lines.append(
            [*cells, f"{one.arc.max():.2f} at $g$ = {plain(float(one.g[one.arc.argmax()]))}"]
        )
    numbers = [f"${name}$ at $g$ = {g:g}" for g in PLATEAU_G for name in "AB"]
    head = [r"$\alpha$", *numbers, "largest $A$"]
    return markdown_table(head, lines)


def _number(value: float) -> str:
    return f"{value:.2f}" if np.isfinite(value) else "-"


def exponent_table(curves: Sequence[Curve]) -> str:
    """Return the fits of Eq. (9), see `fe_training.paper.power_laws.fits`."""
    table = fits(curves)
    lines = []
    for i, alpha in enumerate(table["alpha"]):
        line = {name: float(values[i]) for name, values in table.items()}
        lines.append(
            [
                f"{alpha:g}",
                f"{line['g_from']:g} to {line['g_to']:g}",
                _number(line["n_table_1"]),
                f"{line['n']:.2f}",
                f"{line['C']:.2f}",
                f"{line['r2']:.3f}",
                f"{100 * line['largest_error']:.0f} %",
                f"{line['n_where_C_is_1']:.2f}",
                f"{line['r2_where_C_is_1']:.3f}",
                f"{100 * line['largest_error_where_C_is_1']:.0f} %",
            ]
        )
    head = [r"$\alpha$", "$g$", "$n$ in Table 1", "$n$", "$C$", "$r^2$", "largest error"]
    return markdown_table(
        [*head, "$n$, $C = 1$", "$r^2$, $C = 1$", "largest error, $C = 1$"], lines
    )


def local_table(curves: Sequence[Curve]) -> str:
    """Return d ln B/d ln g, and 2 B/g where Eq. (10) has 1, at large g.

    References
    ----------
    arXiv:2412.02021, Eqs. (9) and (10).
    """
    lines = []
    for one in curves:
        slope = local_exponent(one.g, one.normal_load)
        cells = (
            (one.at(slope, g), one.at(np.log(2.0 * one.normal_load / one.g), g)) for g in LOCAL_G
        )
        lines.append(
            [f"{one.alpha:.3g}"]
            + ["-" if np.isnan(n) else f"{n:.2f}, {np.exp(log):.2f}" for n, log in cells]
        )
    return markdown_table([r"$\alpha$", *(f"$g$ = {g:g}" for g in LOCAL_G)], lines)


def contact_table(data: Campaign, alphas: Sequence[float]) -> str:
    """Return the largest A by two definitions of the contact's ends.

    Parameters
    ----------
    data : Campaign
        The data; its finer mesh is taken.
    alphas : sequence of float
        Exponents [-].

    References
    ----------
    arXiv:2412.02021, Eqs. (S1) and (S2): the ends are where the pressure vanishes.
    """
    rows = data.rows
    finer = (rows["level"] == list(data.design.levels)[-1]) & np.isfinite(rows["theta_1"])
    lines = []
    for alpha in alphas:
        here = np.flatnonzero(finer & (rows["alpha"] == alpha))
        angle = rows["pressure_angle"][here].astype(float)
        nodes = np.cos(np.nanmin(angle, axis=1)) - np.cos(np.nanmax(angle, axis=1))
        arc = np.cos(rows["theta_1"][here]) - np.cos(rows["theta_2"][here])
        lines.append(
            [
                f"{alpha:g}",
                f"{arc.max():.3f}",
                f"{nodes.max():.3f}",
                f"{abs(arc - nodes).max():.3f}",
            ]
        )
    head = [r"$\alpha$", "largest $A$, pressure vanishes", "largest $A$, outermost nodes"]
    return markdown_table([*head, "largest difference"], lines)


def eq13_table(curves: Sequence[Curve]) -> str:
    """Return the range of Eq. (13)'s error in the total force, with where its ends are.

    References
    ----------
    arXiv:2412.02021, Eq. (13).
    """
    lines = []
    for one in curves:
        for xi in FRICTION:
            error = np.array(
                [eq13_error(one.g, one.arc, one.normal_load, xi, r) for r in WEAR_TO_FRICTION]
            )
            lines.append([f"{one.alpha:g}", f"{xi:g}", *_ends(error, one.g)])
        paper = one.g + 4.0 * _FRICTION_FREE
        wear = paper / (one.g + 2.0 * _FRICTION_FREE * one.arc) - 1.0
        lines.append(
            [f"{one.alpha:g}", rf"0, $\tau_w$ = {_FRICTION_FREE:g} $\mu$", *_ends(wear, one.g)]
        )
    return markdown_table([r"$\alpha$", r"$\xi$", "lowest", "highest", "median of the size"], lines)


def eq13_coupled_table(alphas: Sequence[float]) -> str:
    """Return the range of Eq. (13)'s error beside the law "coupled", where that is known.

    References
    ----------
    arXiv:2412.02021, Eq. (13).
    """
    g, lines = np.geomspace(2.5e-3, 100.0, 121), []
    ratio = np.array(WEAR_TO_FRICTION)[:, np.newaxis]
    for alpha in alphas:
        for xi in COUPLED_FRICTION:
            error, own = eq13_beside_coupled(g, alpha, xi, ratio)
            known = np.isfinite(error)
            ends = _ends(np.where(known, error, np.nan), g)
            share = f"{100 * known.mean():.0f} %"
            lines.append([f"{alpha:g}", f"{xi:g}", share, *ends, f"{100 * np.nanmax(own):.0f} %"])
    head = [r"$\alpha$", r"$\xi$", "known", "lowest", "highest", "median of the size"]
    return markdown_table([*head, "the coupled force within"], lines)


def _ends(error: Any, g: Floats) -> Iterator[str]:
    error = np.atleast_2d(error)
    for place in (np.nanargmin(error), np.nanargmax(error)):
        row, column = np.unravel_index(place, error.shape)
        where = f"$g$ = {plain(float(g[column]))}"
        if len(error) > 1:
            where += rf", $\tau_w/(\mu\xi)$ = {WEAR_TO_FRICTION[row]:g}"
        yield f"{round(100 * error[row, column]):+d} % at {where}"
    yield f"{100 * np.nanmedian(np.abs(error)):.0f} %"

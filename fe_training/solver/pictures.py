"""Pictures of configurations and records; matplotlib is imported by the functions that need it.

Every function draws into the axes it is given, or into a new figure one journal column wide, and
returns the axes.  Nothing outside them is changed and nothing is shown on the screen.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from fe_training.mechanics.analytic import far_field_wedge
from fe_training.mechanics.body import Body
from fe_training.solver.equilibrium import Control, State, control_value
from fe_training.solver.observe import contact_arc, principal_stretch
from fe_training.solver.record import Outcome, Record
from surrogate.basics.figures import (
    COLOURS,
    GREY,
    MARKERS,
    MEDIUM,
    SINGLE_COLUMN,
    SMALL,
    label_axes,
    legend_above,
    new_axes,
    require_matplotlib,
)
from surrogate.equations import far_field_energy_release_rate
from surrogate.errors import InputError

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["plot_configuration", "plot_energy_release_rate", "plot_stress_ahead"]

Array = NDArray[np.float64]


_WIRE = "#c8c8c8"

#: Pressure peak in the picture of a configuration [R_w]: the normals stay inside the wire.
_LONGEST_NORMAL = 0.6
_MOST_NORMALS = 28

#: Curves that can be told apart, and named above one column.
_MOST_CURVES = 6

#: Edges of elements below this share of the window would only blacken it.
_SMALLEST_DRAWN = 0.012

#: Elements below this share of the window have no say in where the colours end.
_SMALLEST_COLOURED = 0.004

#: The notch, not a crack tip, rules the stress up to this many of its radii.
_NOTCH_REACH = 5.0

#: Corner and edge nodes of the four triangles that draw one quadratic triangle, and its outline.
_QUARTERS = np.array([[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]])
_OUTLINE = np.array([0, 3, 1, 4, 2, 5, 0])


def plot_configuration(body: Body, state: State, ax: Axes | None = None) -> Axes:
    """Draw the deformed mesh near the wire, coloured by the largest principal stretch.

    The half model is mirrored at the symmetry plane.  The wire is the grey disc; the lines in it
    stand on the contact arc along its normals and are as long as the contact pressure is high,
    the longest one 0.6 R_w.  Of elements too small for the picture the edges are left out.

    Parameters
    ----------
    body : Body
        The discretised half body; lengths are in R_w.
    state : State
        An equilibrium of it.
    ax : matplotlib.axes.Axes, optional
        Where to draw, with equal scales; a new single-column figure by default.

    Returns
    -------
    matplotlib.axes.Axes
        The axes; its figure has got a bar of colours, of stretch [-] on a log scale.

    Raises
    ------
    WirecutError
        If matplotlib is not installed.

    Examples
    --------
    >>> from fe_training.solver.equilibrium import undeformed
    >>> from fe_training.mechanics.mesh import MeshSpec, crack_mesh
    >>> from matplotlib.figure import Figure
    >>> spec = MeshSpec(notch_radius=0.05, outer_radius=30.0, sectors=8, contact_spacing=1.0)
    >>> body = Body(crack_mesh(spec), alpha=2.0)
    >>> ax = plot_configuration(body, undeformed(body, -2.0), Figure().add_subplot())
    >>> ax.get_xlabel()
    '$x/R_w$ [-]'
    """
    ax = ax or new_axes((SINGLE_COLUMN[0], 0.98 * SINGLE_COLUMN[0]))
    require_matplotlib()
    from matplotlib.collections import LineCollection, PolyCollection
    from matplotlib.colors import LogNorm
    from matplotlib.patches import Circle

    low, high = _window(body, state)
    position = body.nodes + state.u
    corners = position[body.connectivity[:, :6]]
    seen = (corners.max(axis=1) > [low[0], -1.0]).all(1) & (corners.min(axis=1) < high).all(1)
    corners, stretch = corners[seen], _element_stretch(body, state)[seen]
    triangles = np.repeat(stretch, len(_QUARTERS)), corners[:, _QUARTERS].reshape(-1, 3, 2)
    size = np.sqrt(_areas(corners))
    drawn = corners[size > _SMALLEST_DRAWN * (high - low).max()][:, _OUTLINE]
    visible = size > _SMALLEST_COLOURED * (high - low).max()
    norm = LogNorm(1.0, max(1.05, float(np.quantile(stretch[visible], 0.995))))
    for mirror in (np.array([1.0, 1.0]), np.array([1.0, -1.0])):
        filled = PolyCollection(
            triangles[1] * mirror,
            array=triangles[0],
            cmap="viridis",
            norm=norm,
            edgecolors="face",
            linewidths=0.1,
            rasterized=True,
        )
        ax.add_collection(filled, autolim=False)
        edges = LineCollection(drawn * mirror, colors="white", linewidths=0.15, alpha=0.6)
        ax.add_collection(edges, autolim=False)
    ax.add_patch(Circle(tuple(state.centre), 1.0, fc=_WIRE, ec=GREY, lw=0.5, zorder=3))
    peak = _draw_pressure(ax, body, state)
    if peak > 0:
        ax.set_title(rf"longest normal: $p = {peak:.3g}\,\mu$", fontsize=SMALL, pad=3)
    ax.set_xlim(low[0], high[0])
    ax.set_ylim(low[1], high[1])
    ax.set_aspect("equal")
    label_axes(ax, "$x/R_w$ [-]", "$y/R_w$ [-]")
    _stretch_bar(ax, filled)
    return ax


def _window(body: Body, state: State) -> tuple[Array, Array]:
    """Return the lower left and upper right corner: the wire, and the tip unless it is far."""
    distance = control_value(body, state, Control.DISTANCE)
    half = float(np.clip(0.5 * (distance + 3.6), 2.4, 4.0))
    left = float(state.centre[0]) - 1.8
    return np.array([left, -0.8 * half]), np.array([left + 2 * half, 0.8 * half])


def _element_stretch(body: Body, state: State) -> Array:
    """Return the largest principal stretch of each element, the mean over its points [-]."""
    mean: Array = np.exp(np.log(principal_stretch(body, state)).mean(axis=1))
    return mean


def _areas(corners: Array) -> Array:
    (ax, ay), (bx, by) = (corners[:, 1] - corners[:, 0]).T, (corners[:, 2] - corners[:, 0]).T
    area: Array = 0.5 * np.abs(ax * by - ay * bx)
    return area


def _draw_pressure(ax: Axes, body: Body, state: State) -> float:
    """Draw the pressure inside the wire along its normals; return its peak [mu]."""
    from matplotlib.collections import LineCollection

    arc = contact_arc(body, state)
    if not len(arc.theta):
        return 0.0
    order = np.argsort(arc.theta)
    theta, pressure = arc.theta[order], np.maximum(arc.pressure[order], 0.0)
    peak = float(pressure.max())
    count = int(np.clip(round(np.ptp(theta) / 0.06), 5, _MOST_NORMALS))
    angle = np.linspace(theta[0], theta[-1], count)

    def inner(at: Array) -> Array:
        radius = 1.0 - _LONGEST_NORMAL * np.interp(at, theta, pressure) / peak
        return np.asarray(radius[:, None] * np.stack([np.cos(at), np.sin(at)], axis=1))

    rim = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    for mirror in (np.array([1.0, 1.0]), np.array([1.0, -1.0])):
        normals = np.stack([rim, inner(angle)], axis=1) * mirror + state.centre
        lines = LineCollection(list(normals), colors="#D55E00", linewidths=0.5, zorder=4)
        ax.add_collection(lines, autolim=False)
        ax.plot(*(inner(theta) * mirror + state.centre).T, color="#D55E00", lw=0.9, zorder=4)
        fine = np.linspace(theta[0], theta[-1], 100)
        touching = np.stack([np.cos(fine), np.sin(fine)], axis=1) * mirror + state.centre
        ax.plot(*touching.T, color="#D55E00", lw=1.2, zorder=4)
    return peak


def _stretch_bar(ax: Axes, filled: Any) -> None:
    from matplotlib.ticker import FixedLocator, LogLocator, NullFormatter, ScalarFormatter

    bar = ax.figure.colorbar(filled, ax=ax, location="bottom", shrink=0.85, pad=0.02, extend="max")
    top = filled.norm.vmax
    bar.set_label(r"largest principal stretch $\lambda_1$ [-]", fontsize=MEDIUM)
    if top > 30.0:
        bar.locator = LogLocator(subs=(1.0,))
    else:
        bar.locator = FixedLocator(_stretch_ticks(top))
        bar.formatter = ScalarFormatter()
    bar.minorlocator = LogLocator(subs=range(2, 10)) if top > 30.0 else FixedLocator([])
    bar.update_ticks()
    bar.ax.xaxis.set_minor_formatter(NullFormatter())
    bar.ax.tick_params(labelsize=SMALL, length=2.5)
    bar.outline.set_linewidth(0.5)


def _stretch_ticks(top: float) -> list[float]:
    """Return round stretches from 1 to `top`, about five of them.

    >>> _stretch_ticks(2.2)
    [1.0, 1.2, 1.5, 2.0]
    >>> _stretch_ticks(12.0)
    [1.0, 2.0, 5.0, 10.0]
    """
    if top < 1.3:
        return [float(x) for x in np.round(np.linspace(1.0, 0.01 * int(100 * top), 4), 2)]
    steps = (1.0, 1.2, 1.5, 2.0, 3.0) if top < 4.0 else (1.0, 2.0, 5.0, 10.0, 20.0)
    return [x for x in steps if x <= top]


def plot_energy_release_rate(records: Sequence[Record], ax: Axes | None = None) -> Axes:
    """Draw J/(mu R_w) against delta/R_w, as in Fig. 2c.

    Beside the records stand Eq. (5), (R_w/delta)^2, and the linear-elastic limit of a wire far
    behind the tip of a crack in an infinite body.  Records that were not reached are left out;
    hollow markers have |J - 2 F_h|/J above its bound.

    Parameters
    ----------
    records : sequence of Record
        Any order, any exponents; each exponent gets its colour and marker.
    ax : matplotlib.axes.Axes, optional
        Where to draw; a new single-column figure by default.

    Returns
    -------
    matplotlib.axes.Axes
        The axes, both scales logarithmic.

    Raises
    ------
    InputError
        If no record has been reached.
    WirecutError
        If matplotlib is not installed.

    References
    ----------
    arXiv:2412.02021, Eq. (5) and Fig. 2c.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> record = Record(2.0, Outcome.CONVERGED, energy_release_rate=0.1, distance=3.0)
    >>> plot_energy_release_rate([record], Figure().add_subplot()).get_xscale()
    'log'
    """
    reached = _reached(records)
    ax = ax or new_axes((SINGLE_COLUMN[0], 0.8 * SINGLE_COLUMN[0]))
    require_matplotlib()
    largest = max(5.0, 1.5 * max(record.distance for record in reached))
    distance = np.geomspace(1.0, largest, 200)
    eq5 = far_field_energy_release_rate(distance)
    ax.plot(distance, eq5, "--", color=GREY, lw=0.9, label=r"Eq. (5), $(R_w/\delta)^2$")
    wedge = far_field_wedge(distance).energy_release_rate
    ax.plot(distance, wedge, ":", color="black", lw=1.1, label="linear wedge limit")
    for i, alpha in enumerate(sorted({record.alpha for record in reached})):
        mine = sorted((r for r in reached if r.alpha == alpha), key=lambda r: r.distance)
        colour, marker = COLOURS[i % len(COLOURS)], MARKERS[i % len(MARKERS)]
        points = np.array([(r.distance, r.energy_release_rate) for r in mine])
        sure = np.array([r.outcome is Outcome.CONVERGED for r in mine])
        style: dict[str, Any] = {"ls": "none", "ms": 4.0, "mec": colour, "mew": 0.8, "zorder": 4}
        ax.plot(*points[~sure].T, marker, mfc="white", **style)
        ax.plot(*points[sure].T, marker, mfc=colour, **style)
        ax.plot([], [], marker, ms=4.0, color=colour, label=rf"$\alpha$ = {alpha:g}")
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_xlim(0.93, largest)
    _plain_ticks(ax, largest)
    label_axes(ax, r"distance to the tip $\delta/R_w$ [-]", r"$J/(\mu R_w)$ [-]")
    legend_above(ax, 2)
    return ax


def plot_stress_ahead(records: Sequence[Record], ax: Axes | None = None) -> Axes:
    """Draw sigma_22/mu ahead of the tip against r/R_w, as in Fig. 3a.

    r is the distance from the tip before deformation, from five notch radii on.  Dashed lines of
    the same colour are the singular fields with the J of the record: that of linear elasticity,
    sqrt(2 J mu/(pi r)), and for alpha = 2 also that of finite strain, J/(pi r), dash-dotted.

    Parameters
    ----------
    records : sequence of Record
        Configurations; those that were not reached are left out, and of more than six, six are
        drawn that are spread evenly over the list in the order of alpha and distance.
    ax : matplotlib.axes.Axes, optional
        Where to draw; a new single-column figure by default.

    Returns
    -------
    matplotlib.axes.Axes
        The axes, both scales logarithmic.

    Raises
    ------
    InputError
        If no record has been reached.
    WirecutError
        If matplotlib is not installed.

    References
    ----------
    arXiv:2412.02021, Fig. 3a; R. A. Stephenson, J. Elasticity 12 (1982) 65-99.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> r = np.geomspace(0.01, 10.0, 20)
    >>> record = Record(5.0, Outcome.CONVERGED, energy_release_rate=0.1, distance=3.0,
    ...     ahead_reference=r, ahead_stress=0.25 / np.sqrt(r))
    >>> plot_stress_ahead([record], Figure().add_subplot()).get_ylabel()
    '$\\\\sigma_{22}/\\\\mu$ [-]'
    """
    reached = _reached(records)
    ax = ax or new_axes((SINGLE_COLUMN[0], 0.8 * SINGLE_COLUMN[0]))
    require_matplotlib()
    reached.sort(key=lambda r: (r.alpha, r.distance))
    chosen = np.linspace(0, len(reached) - 1, min(len(reached), _MOST_CURVES)).round()
    reached = [reached[int(i)] for i in chosen]
    several = len({record.alpha for record in reached}) > 1
    for i, record in enumerate(reached):
        colour, g = COLOURS[i % len(COLOURS)], record.energy_release_rate
        start = _NOTCH_REACH * float(record.mesh.get("notch_radius", 0.0))
        shown = (record.ahead_reference > start) & (record.ahead_stress > 0)
        r, stress = record.ahead_reference[shown], record.ahead_stress[shown]
        name = rf"$\alpha$ = {record.alpha:g}, " if several else ""
        name += rf"$\delta/R_w$ = {record.distance:.3g}, $g$ = {g:.2g}"
        ax.plot(r, stress, color=colour, lw=1.1, label=name, zorder=3)
        near = r[r <= max(0.3 * record.distance, 3.0 * r[0])] if len(r) else r
        ax.plot(near, np.sqrt(2.0 * g / (np.pi * near)), "--", color=colour, lw=0.7)
        if record.alpha == 2.0:
            near = r[r <= g]  # finite strain rules up to about J/mu
            ax.plot(near, g / (np.pi * near), "-.", color=colour, lw=0.7)
    ax.plot([], [], "--", color=GREY, lw=0.7, label=r"linear, $\sqrt{2J\mu/(\pi r)}$")
    if any(record.alpha == 2.0 for record in reached):
        ax.plot([], [], "-.", color=GREY, lw=0.7, label=r"neo-Hookean, $J/(\pi r)$")
    ax.set_xscale("log")
    ax.set_yscale("log")
    label_axes(ax, "distance ahead of the tip $r/R_w$ [-]", r"$\sigma_{22}/\mu$ [-]")
    legend_above(ax, 1 if several else 2)
    return ax


def _reached(records: Sequence[Record]) -> list[Record]:
    reached = [r for r in records if np.isfinite([r.energy_release_rate, r.distance]).all()]
    if not reached:
        raise InputError(
            f"none of the {len(records)} records has been reached; give one that has a distance "
            "and an energy release rate to draw"
        )
    return reached


def _plain_ticks(ax: Axes, largest: float) -> None:
    """Write distances as 1, 2, 5, 10, not as powers of ten."""
    from matplotlib.ticker import FixedLocator, NullFormatter, ScalarFormatter

    ticks = [m * 10.0**k for k in range(4) for m in (1, 2, 5) if m * 10.0**k <= largest]
    ax.xaxis.set_major_locator(FixedLocator(ticks))
    ax.xaxis.set_major_formatter(ScalarFormatter())
    ax.xaxis.set_minor_formatter(NullFormatter())

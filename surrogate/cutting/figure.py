"""The figure of a cutting force: its parts over the radius of the wire."""

from __future__ import annotations

from dataclasses import replace
from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.checks import SMALLEST, Quantity, one_number
from surrogate.basics.figures import (
    BLUE,
    FILLS,
    GREY,
    LARGEST_SHOWN,
    MEDIUM,
    SINGLE_COLUMN,
    SMALL,
    in_style,
    label_at_right,
    legend_above,
    new_axes,
    new_figure,
    picture_file,
    require_axes,
    save_figure,
)
from surrogate.basics.picture_form import picture_form
from surrogate.choosing.by_name import AUTO
from surrogate.choosing.laws import AnyLaw, of_law
from surrogate.contact.base import ForceModel
from surrogate.cutting.force import CuttingForce, force_of
from surrogate.cutting.other_law import law_for
from surrogate.errors import InputError
from surrogate.scene import Scene, require_scene

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["plot_force", "save_force"]

Array = NDArray[np.float64]

THICKNESS = Quantity(
    "thickness", "m", "give the sample's thickness in metres", SMALLEST, LARGEST_SHOWN
)
_POINTS = 240
_PARTS = {"cleavage": r"cleavage $\Gamma_o$", "friction": "friction", "wear": "wear"}


def plot_force(
    scene: Scene,
    ax: Axes | None = None,
    *,
    model: str | ForceModel = AUTO,
    rtol: float | None = None,
    thickness: float | None = None,
    law: str = AUTO,
) -> Axes:
    """Draw the steady cutting force of a solid and its parts over the radius of the wire.

    The parts stand on one another; the line on top is their sum, with a band as wide as the known
    bound of the model's error, dashed where the model does not hold and is continued. The wires of
    the scene are marked.

    Parameters
    ----------
    scene : Scene
        What is cut, and with which wires; all but the radius are single numbers.
    ax : matplotlib.axes.Axes, optional
        Where to draw; a new single-column figure by default.
    model : str, default "auto"
        As in `cutting_force`.
    rtol : float, optional
        Relative error that has to be met with "auto" [-]; by default 0.02 where it can be had.
    thickness : float, optional
        Thickness of the sample [m]: the force is then that on all of it [N].
    law : str, default "auto"
        Which functions of the contact wear and friction follow, as in `cutting_force`; with "auto"
        each radius has its own, the line is dotted where nobody knows the error of any, and jumps
        where the law changes to the projected one.

    Returns
    -------
    matplotlib.axes.Axes
        The axes, for instance for ``ax.figure.savefig("force.pdf")``.

    Raises
    ------
    InputError
        If `scene` is no `Scene` or has several materials, no wire or none with a radius, `ax` is no
        axes, the thickness is not positive, or a number is beyond 1e100.
    UnknownModelError
        If there is no such model.
    AccuracyError
        If the model is "auto" and none is as exact as `rtol`.
    WirecutError
        If matplotlib is not installed.

    References
    ----------
    arXiv:2412.02021, Eq. (S2).

    Examples
    --------
    >>> import matplotlib.figure
    >>> gel = Scene(685.0, 1.6, [0.1e-3, 0.4e-3], wear_strength=7750.0)
    >>> ax = plot_force(gel, matplotlib.figure.Figure().add_subplot())
    >>> ax.get_ylabel()
    'cutting force $F_{ss}/T$ [N/m]'
    """
    wires, model = _wires(scene), of_law(model, law_for(scene, law), any_law=True)
    size = 1.0 if thickness is None else one_number(THICKNESS, thickness)
    radius = np.linspace(0.0, 1.08 * _right_end(wires), _POINTS + 1)[1:]
    curve = force_of(replace(scene, wire_radius=radius), model, rtol, extrapolate=True)
    marks = force_of(replace(scene, wire_radius=wires), model, rtol, extrapolate=True)
    total = size * np.asarray(curve.total)
    _check_shown(total, radius)
    ax = new_axes(SINGLE_COLUMN) if ax is None else require_axes(ax)
    across = 2e3 if picture_form().diameters else 1e3
    labels = _draw_parts(ax, across * radius, size, curve)
    handles = _draw_total(ax, across * radius, total, curve, model)
    handles += ax.plot(
        across * wires, size * np.asarray(marks.total), "s", color=BLUE, mec="white", mew=0.5,
        ms=4.5, zorder=4, label="the wires", clip_on=False,
    )  # fmt: skip
    _label(ax, thickness, scene)
    ax.set_xlim(0.0, across * radius[-1])
    ax.set_ylim(0.0, _top(total))
    label_at_right(ax, labels)
    legend_above(ax, 2, handles, inside=(0.0, 0.86))  # below the words on what is fixed
    return ax


@in_style
def save_force(scene: Scene, file: str | PathLike[str], **options: Any) -> None:
    """Write the picture of `plot_force` to a file, one journal column wide.

    Parameters
    ----------
    scene : Scene
        As in `plot_force`.
    file : str or path-like
        Where to write; the ending chooses the format (.png, .pdf, .svg, .tif).
    **options
        The other options of `plot_force`, without axes.

    Raises
    ------
    InputError
        As `plot_force`, and if the format is unknown or the file cannot be written.
    """
    file = picture_file(file)
    figure = new_figure(SINGLE_COLUMN)
    plot_force(scene, figure.add_subplot(), **options)
    save_figure(figure, file)


def _wires(scene: Scene) -> Array:
    """Return the radii of the wires, if all else are single numbers."""
    require_scene(scene)
    mu, gamma, radius, *others = scene.values()
    if any(np.ndim(value) for value in (mu, gamma, *others)):
        raise InputError(
            "scene must be of one material for its figure, but has an array besides wire_radius; "
            "draw the materials one by one."
        )
    wires = np.ravel(np.asarray(radius))
    if not wires.size or not np.max(wires) > 0.0:
        raise InputError(
            "scene must have a wire with a radius for its figure; give one such as 0.2e-3 m."
        )
    return wires


def _right_end(wires: Array) -> float:
    """Return the largest radius to be shown, so that one wire alone stands in the middle."""
    largest = float(wires.max())
    return largest if largest > 2.0 * float(wires.min()) else 1.6 * largest


def _top(total: Array) -> float:
    """Return the top of the axes, with room for the words at the left above the force."""
    most, left = float(total.max()), float(total[: total.size * 2 // 3].max())
    return max(1.06 * most, 1.3 * left) or 1.0


def _check_shown(total: Array, radius: Array) -> None:
    largest = max(float(np.max(total)), float(radius[-1]))
    if not largest <= LARGEST_SHOWN or radius[0] < 1.0 / LARGEST_SHOWN:
        raise InputError(
            f"a figure's numbers must be below {LARGEST_SHOWN:g}, but the force is up to "
            f"{float(np.max(total)):.4g} and the radius {radius[-1]:.4g} m; check the units."
        )


def _draw_parts(ax: Axes, x: Array, size: float, force: CuttingForce) -> list[tuple[float, str]]:
    """Fill the parts from the bottom up; return the height and words of each at the right end."""
    below = np.zeros_like(x)
    labels = []
    for name, words in _PARTS.items():
        above = below + size * np.asarray(getattr(force, name))
        if np.any(above > below):
            ax.fill_between(x, below, above, color=FILLS[name], lw=0, zorder=1)
            labels.append((0.5 * float(below[-1] + above[-1]), words))
        below = above
    return labels


def _draw_total(
    ax: Axes, x: Array, total: Array, force: CuttingForce, model: str | ForceModel | AnyLaw
) -> list[Any]:
    holds = np.broadcast_to(force.in_domain, x.shape)
    unknown = np.zeros(x.shape, dtype=bool)
    if isinstance(model, AnyLaw) and force.law_error is not None:
        unknown = np.isnan(np.broadcast_to(force.law_error, x.shape)) & holds
    handles: list[Any] = []
    lines: tuple[tuple[Any, Any, float, str], ...] = (
        (holds & ~unknown, "-", 1.2, f"model {model}"),
        (unknown, (0, (1, 1)), 1.2, "projected, error unknown"),
        (~holds, "--", 0.9, "beyond its range"),
    )
    for where, dashes, width, label in lines:
        if where.any():
            line = _with_ends(where, holds, total)
            handles += ax.plot(x, line, "k", ls=dashes, lw=width, zorder=3, label=label)
    error, whose = _shown_error(force, x.shape)
    known = holds & np.isfinite(error) & (error > 0.0)
    if known.any():
        low, high = total * (1.0 - error), total * (1.0 + error)
        label = f"{whose}, up to {100.0 * float(np.max(error[known])):.2g} %"
        band = ax.fill_between(
            x, low, high, where=known, color=GREY, alpha=0.45, lw=0, zorder=2, label=label
        )
        handles.append(band)
    return handles


def _shown_error(force: CuttingForce, shape: tuple[int, ...]) -> tuple[Any, str]:
    """Return the error of force, or that of its fit where nobody knows that of the law."""
    if force.relative_error is None or force.fit_error is None:
        return np.full(shape, np.nan), ""
    if np.isfinite(force.relative_error).any():
        return np.broadcast_to(force.relative_error, shape), "its error"
    return np.broadcast_to(force.fit_error, shape), "fit's error"


def _with_ends(where: Any, holds: Any, total: Array) -> Array:
    """Return the total where a line is drawn, up to its neighbours where the model ends."""
    line = np.where(where, total, np.nan)
    if not np.any(where & holds):  # what continues the model begins at its last point
        edges = where[1:] != where[:-1]
        line[1:][edges], line[:-1][edges] = total[1:][edges], total[:-1][edges]
    return line


def _label(ax: Axes, thickness: float | None, scene: Scene) -> None:
    wide = picture_form().diameters
    ax.set_xlabel(
        "wire diameter $2R_w$ [mm]" if wide else "wire radius $R_w$ [mm]", fontsize=MEDIUM
    )
    force = "cutting force $F_{ss}/T$ [N/m]"
    if thickness is not None:
        force = rf"cutting force $F_{{ss}}$ [N] for $T$ = {1e3 * thickness:.4g} mm"
    ax.set_ylabel(force, fontsize=MEDIUM)
    ax.locator_params(nbins=6, steps=[1, 2, 5, 10])
    ax.tick_params(labelsize=SMALL)
    ax.spines[["top", "right"]].set_visible(False)
    values = [float(value) for value in scene.values()[:2] + scene.values()[3:]]
    mu, gamma, xi, tau, alpha = values
    ax.text(
        0.03,
        0.97,
        rf"$\mu$ = {1e-3 * mu:.4g} kPa, $\Gamma_o$ = {gamma:.4g} J/m$^2$,"
        "\n"
        rf"$\tau_w$ = {1e-3 * tau:.4g} kPa, $\xi$ = {xi:.4g}, $\alpha$ = {alpha:.4g}",
        transform=ax.transAxes,
        va="top",
        fontsize=SMALL,
        color=GREY,
    )

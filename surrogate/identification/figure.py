"""Figures; matplotlib is imported by the functions that need it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import cycle
from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.checks import TOUGHNESS, one_number, shown, text
from surrogate.basics.figures import (
    BLUE,
    GREY,
    LARGEST_SHOWN,
    MEDIUM,
    RED,
    SINGLE_COLUMN,
    SMALL,
    in_style,
    legend_above,
    new_axes,
    new_figure,
    panels,
    picture_file,
    require_axes,
    save_figure,
)
from surrogate.basics.picture_form import picture_form
from surrogate.choosing.by_name import force_model
from surrogate.errors import InputError
from surrogate.identification.curves import curve_radii, require_identification
from surrogate.identification.fit import Identification
from surrogate.identification.further_wire import forces_of
from surrogate.inference.profile import Mode, Profile

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["plot_identification", "plot_profile", "save_identification"]

SHOWN = 5.0
"""Height of the figure, in units of the threshold above the smallest misfit."""

DECADES = 4.0
"""Below the largest toughness shown; a toughness of less is not told from 0."""


def plot_profile(identification: Identification, ax: Axes | None = None) -> Axes:
    """Draw the misfit over the toughness, with its minima and what is admitted.

    Parameters
    ----------
    identification : Identification
        What `identify` returned, with a `profile`.
    ax : matplotlib.axes.Axes, optional
        Where to draw; a new single-column figure by default.

    Returns
    -------
    matplotlib.axes.Axes
        The axes.

    Raises
    ------
    InputError
        If `identification` is not one, or has no profile.
    WirecutError
        If matplotlib is not installed.

    Examples
    --------
    >>> import matplotlib.figure
    >>> from surrogate.identification.fit import identify
    >>> fit = identify([1e-4, 2e-4, 4e-4], [4.7, 7.9, 13.9], 685.0, toughness_max=5.0)
    >>> ax = plot_profile(fit, matplotlib.figure.Figure().add_subplot())
    >>> ax.get_xlabel()
    'cleavage toughness $\\\\Gamma_o$ [J/m$^2$]'
    """
    if not isinstance(identification, Identification) or identification.profile is None:
        raise InputError(
            "identification must be what identify returned with a model that is not linear, a "
            f"bound or a prior, but is {shown(identification)}; give such a one."
        )
    if ax is None:
        ax = new_axes(SINGLE_COLUMN)
    profile, known = identification.profile, identification.force_std is not None
    low, top = _heights(profile)
    right = _right_end(profile, top)
    left = max(right * 10.0**-DECADES, profile.searched[0])
    modes = [one for one in profile.modes if left <= one.toughness <= right and one.misfit <= top]
    handles = _draw(ax, profile, f"{100.0 * identification.confidence:.3g} %")
    handles += _draw_minima(ax, modes)
    ax.set_xscale("log")
    ax.set_xlim(left, right)
    ax.set_ylim(low, top)
    ax.set_xlabel(r"cleavage toughness $\Gamma_o$ [J/m$^2$]", fontsize=MEDIUM)
    ax.set_ylabel(r"misfit $\chi^2$" if known else r"sum of squares [N$^2$/m$^2$]", fontsize=MEDIUM)
    ax.tick_params(labelsize=SMALL)
    ax.spines[["top", "right"]].set_visible(False)
    legend_above(ax, 2, handles)
    return ax


def _heights(profile: Profile) -> tuple[float, float]:
    """Return the ends of the misfit shown: about 0, and some way above the threshold."""
    smallest = profile.modes[0].misfit
    above = profile.threshold - smallest
    if not above > 0.0:  # no scatter, or none known
        above = float(np.median(profile.misfit) - smallest) / SHOWN
    top = smallest + SHOWN * max(above, 1e-300)
    return -0.03 * top, top


def _right_end(profile: Profile, top: float) -> float:
    shown_points = profile.toughness[profile.misfit <= top]
    return 1.1 * float(min(1.5 * shown_points.max(), profile.searched[1]))


def _draw(ax: Axes, profile: Profile, confidence: str) -> list[Any]:
    handles: list[Any] = ax.plot(
        profile.toughness,
        profile.misfit,
        color=BLUE,
        lw=1.2,
        label=r"misfit where $\tau_w$ fits best",
    )
    label = None if np.isnan(profile.threshold) else f"{confidence} limit"
    if label:
        handles.append(ax.axhline(profile.threshold, color=GREY, lw=0.8, ls="--", label=label))
    for i, (low, high) in enumerate(profile.toughness_intervals):
        label = f"{confidence} interval"
        span = ax.axvspan(low, high, color=RED, alpha=0.15, lw=0, label=label)
        if i == 0:
            handles.append(span)
    return handles


def _draw_minima(ax: Axes, modes: Sequence[Mode]) -> list[Any]:
    handles = []
    for admitted, label in ((True, "minimum"), (False, "excluded minimum")):
        those = [mode for mode in modes if mode.admitted is admitted]
        if those:
            handles += ax.plot(
                [mode.toughness for mode in those],
                [mode.misfit for mode in those],
                "o",
                ms=4,
                mec=RED,
                mfc=RED if admitted else "white",
                label=label,
                clip_on=False,  # one at the end of the search is on the edge
                zorder=4,
            )
    return handles


PURE_SHEAR_TOUGHNESS = replace(
    TOUGHNESS,
    name="pure_shear_toughness",
    remedy="give Gamma in joules a square metre",
    upper=LARGEST_SHOWN,
)


def plot_identification(
    identification: Identification,
    ax: Axes | None = None,
    *,
    pure_shear_toughness: float | None = None,
    force_label: str = "measured",
) -> Axes:
    """Draw cutting force against wire radius with the fit and what it says, as in Fig. 1c.

    Shows the measurements (with bars of one standard error where known), the fitted
    line from the axis on, its confidence band, the identified toughness at the intercept, the
    transition radius of Eq. (13), and the toughness of another test where it is given. Changes
    nothing outside its axes and shows nothing on the screen.

    Parameters
    ----------
    identification : Identification
        What `identify` returned.
    ax : matplotlib.axes.Axes, optional
        Where to draw; a new single-column figure by default.
    pure_shear_toughness : float, optional
        Gamma of a fracture test, drawn as the dashed horizontal line [J/m2].
    force_label : str, default "measured"
        What the legend calls the forces.

    Returns
    -------
    matplotlib.axes.Axes
        The axes, for instance for ``ax.figure.savefig("fit.pdf")``.

    Raises
    ------
    InputError
        If `identification` is not one, the toughness not a number of 0 or more, `ax` no axes, or
        the label no text.
    WirecutError
        If matplotlib is not installed.

    References
    ----------
    arXiv:2412.02021, Fig. 1c.

    Examples
    --------
    >>> import matplotlib.figure
    >>> from surrogate.identification.fit import identify
    >>> fit = identify([1e-4, 2e-4, 4e-4, 5e-4], [4.7, 7.9, 13.9, 17.2], shear_modulus=685.0)
    >>> ax = plot_identification(fit, matplotlib.figure.Figure().add_subplot())
    >>> ax.get_xlabel()
    'wire radius $R_w$ [mm]'
    """
    require_identification(identification)
    if pure_shear_toughness is not None:
        pure_shear_toughness = one_number(PURE_SHEAR_TOUGHNESS, pure_shear_toughness)
    text("force_label", force_label, "give what the legend calls the forces")
    ax = new_axes(SINGLE_COLUMN) if ax is None else require_axes(ax)
    radius = curve_radii(identification, 1.08 * identification.wire_radius.max())
    handles = [
        _draw_measurements(ax, identification, force_label),
        *_draw_fit(ax, identification, radius),
        *_draw_other_minima(ax, identification, radius),
        *_draw_references(ax, identification, pure_shear_toughness),
    ]
    _label(ax, 1.08 * identification.wire_radius.max(), handles)
    return ax


@in_style
def save_identification(
    identification: Identification,
    file: str | PathLike[str],
    *,
    pure_shear_toughness: float | None = None,
    force_label: str = "measured",
) -> None:
    """Write the picture of `plot_identification` to a file, one journal column wide.

    Below it, that of `plot_profile` where the misfit was followed along the toughness, unless one
    panel is asked for.

    Parameters
    ----------
    identification : Identification
        What `identify` returned.
    file : str or path-like
        Where to write; the ending chooses the format (.png, .pdf, .svg).
    pure_shear_toughness : float, optional
        Gamma of a fracture test, drawn as the dashed horizontal line [J/m2].
    force_label : str, default "measured"
        What the legend calls the forces.

    Raises
    ------
    InputError
        If the format is unknown or the file cannot be written.
    WirecutError
        If matplotlib is not installed.

    Examples
    --------
    >>> from surrogate.identification.fit import identify
    >>> fit = identify([1e-4, 2e-4, 4e-4, 5e-4], [4.7, 7.9, 13.9, 17.2], shear_modulus=685.0)
    >>> save_identification(fit, "fit.doc")
    Traceback (most recent call last):
        ...
    surrogate.errors.InputError: fit.doc has no picture's ending; choose .png, .pdf or .svg.
    """
    file = picture_file(file)
    require_identification(identification)
    rows = 1 if identification.profile is None or picture_form().single_panel else 2
    figure = new_figure((SINGLE_COLUMN[0], rows * SINGLE_COLUMN[1]))
    places = panels(figure, 1, rows)[:, 0]
    if rows == 2:
        plot_profile(identification, places[1])
    plot_identification(
        identification,
        places[0],
        pure_shear_toughness=pure_shear_toughness,
        force_label=force_label,
    )
    if rows == 2:
        _letter_beside_legends(places)
    save_figure(figure, file)


def _letter_beside_legends(places: Any) -> None:
    """Write the letters of panels left of their legends, which stand where titles are."""
    for letter, ax in zip("ab", places, strict=True):
        ax.set_title("", loc="left")
        ax.annotate(
            f"({letter})",
            (0.0, 1.0),
            (-0.16, 1.0),
            xycoords="axes fraction",
            textcoords="axes fraction",
            ha="right",
            fontsize=MEDIUM,
        )


def _draw_measurements(ax: Axes, fit: Identification, label: str) -> Any:
    repeated = np.unique(fit.wire_radius).size < fit.wire_radius.size
    return ax.errorbar(
        1e3 * fit.wire_radius,
        fit.force,
        yerr=fit.force_std,
        fmt="s",
        ms=4,
        color=BLUE,
        mfc="none" if repeated else BLUE,  # so that cuts of one wire do not hide each other
        mec=BLUE if repeated else "white",
        mew=0.7 if repeated else 0.5,
        capsize=2,
        elinewidth=0.8,
        zorder=3,
        label=label,
    )


def _draw_fit(ax: Axes, fit: Identification, radius: NDArray[np.float64]) -> Iterator[Any]:
    line, (low, high) = fit.predict(radius), fit.band(radius)
    if radius[0] > 0.0 and not np.any(fit.cuts.friction_coefficient):  # without it Gamma_o is left
        ends = np.ravel(fit.profile.toughness_intervals) if fit.profile else np.array([])
        if ends.size:
            radius, line = np.append(0.0, radius), np.append(fit.toughness, line)
            low, high = np.append(ends.min(), low), np.append(ends.max(), high)
    label = (
        rf"$\Gamma_o$ = {fit.toughness:.3g} J/m$^2$, "
        rf"$\tau_w$ = {1e-3 * fit.wear_strength:.3g} kPa"
    )
    yield from ax.plot(1e3 * radius, line, color=RED, lw=1.2, label=label)
    ax.plot([0.0], [fit.toughness], "o", ms=4, mfc="white", mec=RED, zorder=4, clip_on=False)
    if np.any(high - low > 1e-9 * np.abs(line)):  # neither nan nor rounding
        label = f"{100.0 * fit.confidence:.3g} % band"
        yield ax.fill_between(1e3 * radius, low, high, color=RED, alpha=0.18, lw=0, label=label)


def _draw_other_minima(ax: Axes, fit: Identification, radius: NDArray[np.float64]) -> Iterator[Any]:
    """Draw the materials that are admitted besides the estimate."""
    modes = fit.profile.modes[1:] if fit.profile is not None else ()
    for mode, style in zip(
        (m for m in modes if m.admitted), cycle(("--", "-.", ":")), strict=False
    ):
        at = np.array([mode.toughness]), np.array([mode.wear_strength])
        line = forces_of(force_model(fit.model), fit.cuts, *at, radius)[0]
        label = rf"or $\Gamma_o$ = {mode.toughness:.2g} J/m$^2$"
        yield from ax.plot(1e3 * radius, line, color=RED, lw=0.8, ls=style, label=label)


def _draw_references(
    ax: Axes, fit: Identification, pure_shear_toughness: float | None
) -> Iterator[Any]:
    if pure_shear_toughness is not None:
        label = rf"$\Gamma$ = {pure_shear_toughness:.3g} J/m$^2$"
        yield ax.axhline(pure_shear_toughness, color="black", lw=0.8, ls="--", label=label)
    if np.isfinite(star := fit.model_transition_radius):
        label = rf"$R_w^*$ = {1e6 * star:.3g} µm"
        yield ax.axvline(1e3 * star, color=GREY, lw=0.8, ls=":", label=label)


def _label(ax: Axes, largest_radius: float, handles: list[Any]) -> None:
    ax.set_xlim(0.0, 1e3 * largest_radius)
    ax.set_ylim(bottom=min(0.0, ax.dataLim.y0))
    ax.set_xlabel("wire radius $R_w$ [mm]", fontsize=MEDIUM)
    ax.set_ylabel("cutting force $F_{ss}/T$ [N/m]", fontsize=MEDIUM)
    ax.locator_params(nbins=6, steps=[1, 2, 5, 10])
    ax.tick_params(labelsize=SMALL)
    ax.spines[["top", "right"]].set_visible(False)
    legend_above(ax, 2, handles)

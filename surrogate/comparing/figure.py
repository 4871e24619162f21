"""The figure of several gels in one panel; matplotlib is imported by the functions that need it."""

from __future__ import annotations

from collections.abc import Mapping
from os import PathLike
from typing import TYPE_CHECKING

import numpy as np

from surrogate.basics.checks import mapping, shown
from surrogate.basics.figures import (
    COLOURS,
    MARKERS,
    SINGLE_COLUMN,
    in_style,
    label_at_right,
    label_axes,
    new_axes,
    new_figure,
    picture_file,
    require_axes,
    save_figure,
)
from surrogate.errors import InputError
from surrogate.identification.curves import curve_radii
from surrogate.identification.fit import Identification

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["plot_gels", "save_gels"]

MOST = 14
"""Gels in one panel, of which each has a colour and a marker of its own."""

BAND = 0.15
"""Opacity of the confidence bands, which lie over each other."""


def plot_gels(identifications: Mapping[str, Identification], ax: Axes | None = None) -> Axes:
    """Draw force against radius of several gels with their fits and confidence bands.

    The name of each gel stands at the end of its curve, or beside its forces where its
    identification should not be used, which then has no curve. Bars are one standard error.

    Parameters
    ----------
    identifications : mapping of str to Identification
        What `identify` returned of each gel, by its name; up to 14.
    ax : matplotlib.axes.Axes, optional
        Where to draw; a new single-column figure by default.

    Returns
    -------
    matplotlib.axes.Axes
        The axes.

    Raises
    ------
    InputError
        If a name is no text, one is no identification, or there are none or too many.
    WirecutError
        If matplotlib is not installed.

    Examples
    --------
    >>> import matplotlib.figure
    >>> from surrogate.identification.fit import identify
    >>> fit = identify([1e-4, 2e-4, 4e-4, 5e-4], [4.7, 7.9, 13.9, 17.2], shear_modulus=685.0)
    >>> ax = plot_gels({"soft": fit}, matplotlib.figure.Figure().add_subplot())
    >>> [text.get_text() for text in ax.texts]
    ['soft']
    """
    gels = _checked(identifications)
    ax = new_axes(SINGLE_COLUMN) if ax is None else require_axes(ax)
    largest = 1.08 * max(float(fit.wire_radius.max()) for fit in gels.values())
    labels, colours = [], {}
    for i, (name, fit) in enumerate(gels.items()):
        colour = COLOURS[i % len(COLOURS)]
        _draw_cuts(ax, fit, colour, MARKERS[i % len(MARKERS)], hollow=i >= len(COLOURS))
        name = name.replace("$", r"\$")  # no formula
        words, end = f"{name} (not used)", float(fit.force[np.argmax(fit.wire_radius)])
        if not fit.objections:
            words, end = name, _draw_curve(ax, fit, largest, colour)
        labels.append((end, words))
        colours[words] = colour
    ax.set_xlim(0.0, 1e3 * largest)
    ax.set_ylim(bottom=min(0.0, ax.dataLim.y0))
    label_axes(ax, "wire radius $R_w$ [mm]", "cutting force $F_{ss}/T$ [N/m]")
    ax.locator_params(nbins=6, steps=[1, 2, 5, 10])
    label_at_right(ax, labels, colours)
    return ax


@in_style
def save_gels(identifications: Mapping[str, Identification], file: str | PathLike[str]) -> None:
    """Write the picture of `plot_gels` to a file, one journal column wide.

    Parameters
    ----------
    identifications : mapping of str to Identification
        What `identify` returned of each gel, by its name.
    file : str or path-like
        Where to write; the ending chooses the format (.png, .pdf, .svg, .tif).

    Raises
    ------
    InputError
        As `plot_gels`, or if the format is unknown or the file cannot be written.
    WirecutError
        If matplotlib is not installed.
    """
    file = picture_file(file)
    figure = new_figure(SINGLE_COLUMN)
    plot_gels(identifications, figure.add_subplot())
    save_figure(figure, file)


def _checked(identifications: object) -> dict[str, Identification]:
    gels = dict(mapping("identifications", identifications, "{'gel A': fit}"))
    for name, fit in gels.items():
        if not isinstance(name, str) or not isinstance(fit, Identification):
            raise InputError(
                f"gels must be names with what identify returned, but one is {shown(name)} with "
                f"{shown(fit)}; give for instance {{'gel A': fit}}."
            )
    if not 1 <= len(gels) <= MOST:
        raise InputError(
            f"gels in one figure must be from 1 to {MOST}, but are {len(gels)}; draw several."
        )
    return gels


def _draw_cuts(ax: Axes, fit: Identification, colour: str, marker: str, hollow: bool) -> None:
    ax.errorbar(
        1e3 * fit.wire_radius,
        fit.force,
        yerr=fit.force_std,
        fmt=marker,
        ms=4,
        color=colour,
        mfc="white" if hollow else colour,
        mec=colour if hollow else "white",
        mew=0.7 if hollow else 0.5,
        capsize=2,
        elinewidth=0.8,
        zorder=3,
    )


def _draw_curve(ax: Axes, fit: Identification, largest: float, colour: str) -> float:
    """Draw the fit with its band, and return the force at its end [N/m]."""
    radius = curve_radii(fit, min(largest, 1.08 * float(fit.wire_radius.max())))
    line = fit.predict(radius)
    ax.plot(1e3 * radius, line, color=colour, lw=1.2)
    low, high = fit.band(radius)
    if np.any(high - low > 1e-9 * np.abs(line)):  # neither nan nor rounding
        ax.fill_between(1e3 * radius, low, high, color=colour, alpha=BAND, lw=0)
    return float(line[-1])

"""The misfit over the toughness as a figure."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from surrogate.errors import InputError
from surrogate.figures import BLUE, GREY, MEDIUM, RED, SINGLE_COLUMN, SMALL, legend_above, new_axes
from surrogate.identification import Identification
from surrogate.profile import Mode, Profile
from surrogate.validation import shown

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["plot_profile"]

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
    >>> from surrogate.identification import identify
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
        profile.toughness, profile.misfit, color=BLUE, lw=1.2, label=r"with the best $\tau_w$"
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

"""Figures of the studies, one for each measure."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from fe_training.verification.studies import Finding, Measure, StudyResult
from surrogate.basics.figures import (
    COLOURS,
    GREY,
    MARKERS,
    SINGLE_COLUMN,
    WIDTHS,
    in_style,
    label_axes,
    legend_above,
    legend_over,
    new_axes,
    new_figure,
    panels,
    save_figure,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes


__all__ = ["plot_measure", "plot_truncation"]

#: What stands at the axes instead of the names of the tables.
_SYMBOLS = {
    "|J-2F_h|/J": r"$|J - 2F_h|/J$",
    "|J/g-1|": r"$|J/(g \mu R_w) - 1|$",
    "spread of J": r"spread of $J$",
    "|dB|/B": r"$|\Delta B|/B$",
    "|dA|": r"$|\Delta A|$",
    "|dJ|/J at equal delta": r"$|\Delta J|/J$ at equal $\delta$",
    "|-2dU/dc / J - 1|": r"$|-2\,(dU/dc)/J - 1|$",
    "|J / (F_v^2/(2 pi delta)) - 1|": r"$|2\pi\mu\delta J/F_v^2 - 1|$",
    "|B / wedge - 1|": r"$|B/B_{wedge} - 1|$",
    "|A / wedge - 1|": r"$|A/A_{wedge} - 1|$",
    "|J / wedge - 1|": r"$|J/J_{wedge} - 1|$",
}


#: Letters of names of which six stand side by side in a legend.
_SHORT = 16

#: Values below this are drawn on it: rounding.
_SMALLEST_DRAWN = 1e-8


@in_style
def draw_study(folder: Path, result: StudyResult) -> list[Path]:
    """Draw a panel for each measure of a study, and one legend for all of them."""
    names = list(dict.fromkeys(m.name for f in result.findings for m in f.measures))
    drawings: list[Callable[[Axes], object]] = [
        functools.partial(plot_measure, result, name) for name in names
    ]
    if result.facts:
        drawings.append(functools.partial(plot_truncation, result))
    rows = math.ceil(len(drawings) / 2)
    figure = new_figure((WIDTHS["double"], 0.33 * WIDTHS["double"] * rows + 0.5))
    places = panels(figure, 2, rows).ravel()
    handles: dict[str, Any] = {}
    for drawing, ax in zip(drawings, places, strict=False):
        drawing(ax)
        handles |= {one.get_label(): one for one in ax.get_legend_handles_labels()[0]}
        ax.get_legend().remove()
    long = any(len(name) > _SHORT for name in handles)
    legend_over(figure, list(handles.values()), 3 if long else 6)
    for ax in places[len(drawings) :]:
        ax.remove()
    figure.draw_without_rendering()
    figure.set_layout_engine("none")  # laid out once for all files
    files = [folder / f"{result.name}{ending}" for ending in (".pdf", ".png")]
    for file in files:
        save_figure(figure, file)
    return files


def plot_measure(result: StudyResult, name: str, ax: Axes | None = None) -> Axes:
    """Draw a measure of a study against g, with its bound.

    Where several variants are compared each has its colour, else each exponent; an exponent has
    its marker. A line joins the largest of all exponents. Hollow markers break the bound; crosses
    on the upper edge were not reached.

    Parameters
    ----------
    result : StudyResult
        The study.
    name : str
        One of its measures.
    ax : matplotlib.axes.Axes, optional
        Where to draw; a new single-column figure by default.

    Returns
    -------
    matplotlib.axes.Axes
        The axes, both scales logarithmic; findings without g stand at their exponent.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> row = Finding("mesh", "fine", 2.0, 1.0, "converged", (Measure("|dB|/B", 1e-3, 5e-3),), True)
    >>> ax = plot_measure(StudyResult("mesh", (row,)), "|dB|/B", Figure().add_subplot())
    >>> ax.get_ylabel()
    '$|\\\\Delta B|/B$ [-]'
    """
    ax = ax or new_axes((SINGLE_COLUMN[0], 0.8 * SINGLE_COLUMN[0]))
    rows = [(f, m) for f in result.findings if f.solved for m in f.measures if m.name == name]
    alphas = list(dict.fromkeys(one.alpha for one, _ in rows))
    variants = list(dict.fromkeys(one.variant for one, _ in rows))
    by_variant = len(variants) > 1 and result.name != "range"
    by_alpha = any(math.isnan(one.g) for one, _ in rows)
    lost = []
    for alpha in alphas:
        marker = _marker(alphas.index(alpha))
        for variant in variants if by_variant else [None]:
            colour = _colour(variants.index(variant) if variant else alphas.index(alpha))
            mine = [
                (one.alpha if by_alpha else one.g, measure, one)
                for one, measure in rows
                if one.alpha == alpha and variant in (None, one.variant)
            ]
            known = sorted(
                (x, max(m.value, _SMALLEST_DRAWN), m.passed is False)
                for x, m, _ in mine
                if math.isfinite(m.value)
            )
            lost += [(x, colour) for x, _, one in mine if _nothing_known(one)]
            for broken in (False, True):
                points = [(x, y) for x, y, failed in known if failed == broken]
                ax.plot(
                    *(zip(*points, strict=True) if points else ([], [])),
                    marker,
                    color=colour,
                    mfc="white" if broken else colour,
                    ms=3.5,
                    mew=0.8,
                    zorder=3,
                )
    for i, variant in enumerate(variants if by_variant else [None]):
        colour = _colour(i) if by_variant else GREY
        ax.plot(*_largest(rows, variant, by_alpha), "-", color=colour, lw=0.8, zorder=1)
    _draw_bounds(ax, rows, by_alpha)
    ax.set_xscale("linear" if by_alpha else "log")
    if any(math.isfinite(m.value) for _, m in rows):
        ax.set_yscale("log")
    for x, colour in lost:
        edge = ax.get_xaxis_transform()
        ax.plot([x], [1.0], "x", color=colour, ms=4.0, transform=edge, clip_on=False, zorder=4)
    ax.plot([], [], "x", color=GREY, ms=4.0, label="not reached") if lost else None
    for i, alpha in enumerate(alphas):
        colour = GREY if by_variant else _colour(i)
        ax.plot([], [], _marker(i), color=colour, ms=3.5, label=rf"$\alpha$ = {alpha:g}")
    for i, variant in enumerate(variants if by_variant else []):
        ax.plot([], [], "-", color=_colour(i), lw=1.5, label=variant.replace("_", " "))
    x_label = r"stiffening exponent $\alpha$ [-]" if by_alpha else "$g = J/(\\mu R_w)$ [-]"
    label_axes(ax, x_label, f"{_SYMBOLS.get(name, name)} [-]")
    legend_above(ax, 2 if by_variant else 3)
    return ax


def _largest(
    rows: Sequence[tuple[Finding, Measure]], variant: str | None, by_alpha: bool
) -> tuple[list[float], list[float]]:
    """Return the largest measure of all exponents over g, of one variant or of all."""
    largest: dict[float, float] = {}
    for one, measure in rows:
        if variant in (None, one.variant) and math.isfinite(measure.value):
            at = one.alpha if by_alpha else one.g
            largest[at] = max(measure.value, largest.get(at, _SMALLEST_DRAWN))
    return sorted(largest), [largest[at] for at in sorted(largest)]


def _nothing_known(finding: Finding) -> bool:
    """Return whether a configuration was not reached, rather than lacks a single measure."""
    return not any(math.isfinite(measure.value) for measure in finding.measures)


def _draw_bounds(ax: Axes, rows: Sequence[tuple[Finding, Measure]], by_alpha: bool) -> None:
    """Draw the bound where it holds, as a line of steps."""
    held = [(one, m.bound) for one, m in rows if m.bound is not None]
    if not held:
        return
    x, y = np.array(sorted({(one.alpha if by_alpha else one.g, bound) for one, bound in held})).T
    names = {one.variant for one, _ in held}
    some = len(names) == 1 and len({one.variant for one, _ in rows}) > 1 and "" not in names
    label = f"bound, {names.pop()}".replace("_", " ") if some else "bound"
    style: dict[str, Any] = {"color": GREY, "lw": 0.8, "label": label}
    if len(set(y)) == 1:
        ax.axhline(y[0], ls="--", **style)
    else:
        ax.plot(x, y, "--", drawstyle="steps-post", **style)


def _colour(number: int) -> str:
    return COLOURS[number % len(COLOURS)]


def _marker(number: int) -> str:
    """Return a marker; beyond those that there are, they meet other colours."""
    count = len(MARKERS)
    return MARKERS[(number + number // count) % count]


def plot_truncation(result: StudyResult, ax: Axes | None = None) -> Axes:
    """Draw the change of B with the radius of the body, and the law fitted to it.

    The law is |dB|/B = c sqrt(g R_w/L); the body of the default settings, of radius L_0, has an
    error of its own.

    Parameters
    ----------
    result : StudyResult
        The study `truncation`, with its fitted factor.
    ax : matplotlib.axes.Axes, optional
        Where to draw; a new single-column figure by default.

    Returns
    -------
    matplotlib.axes.Axes
        The axes, both scales logarithmic.
    """
    ax = ax or new_axes((SINGLE_COLUMN[0], 0.8 * SINGLE_COLUMN[0]))
    rows = [one for one in result.findings if one.data and math.isfinite(one.measures[0].value)]

    def law(one: Finding) -> float:
        L, L_0 = one.data["L/R_w"], one.data["L/R_w of the default"]
        return math.sqrt(one.g / L) - math.sqrt(one.g / L_0)

    for i, alpha in enumerate(dict.fromkeys(one.alpha for one in rows)):
        mine = [one for one in rows if one.alpha == alpha]
        y = [max(one.measures[0].value, _SMALLEST_DRAWN) for one in mine]
        style: dict[str, Any] = {"color": _colour(i), "ms": 3.5, "label": rf"$\alpha$ = {alpha:g}"}
        ax.plot([law(one) for one in mine], y, _marker(i), **style)
    ends = np.array([f(law(one) for one in rows) for f in (min, max)])
    factor = result.facts["factor c, median"]
    style = {"color": GREY, "lw": 0.9, "label": rf"law, $c$ = {factor:.2g}"}
    ax.plot(ends, factor * ends, "--", **style)
    ax.set_xscale("log")
    ax.set_yscale("log")
    label_axes(ax, r"$\sqrt{g R_w/L} - \sqrt{g R_w/L_0}$ [-]", f"{_SYMBOLS['|dB|/B']} [-]")
    legend_above(ax, 2)
    return ax

"""Tables and figures of the studies: Markdown, CSV, JSON and pictures in one folder."""

from __future__ import annotations

import csv
import functools
import json
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from fe_training.campaign.software import software
from fe_training.figure_style import (
    COLOURS,
    GREY,
    MARKERS,
    add_legend,
    label_axes,
    new_axes,
    require_matplotlib,
)
from fe_training.markdown import markdown_table
from fe_training.verification.studies import (
    STUDIES,
    Finding,
    Measure,
    Scope,
    Solved,
    StudyResult,
)
from surrogate.errors import InputError

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["Line", "plot_measure", "plot_truncation", "summary", "summary_table", "write_report"]

_VERDICTS = {True: "pass", False: "FAIL", None: "-"}
_DPI = 300
_DOUBLE_COLUMN = 183.0 / 25.4

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

#: Failures that the summary lists for each study; all of them are in its table.
_MOST_FAILURES = 12

#: Values below this are drawn on it: rounding.
_SMALLEST_DRAWN = 1e-8


@dataclass(frozen=True, slots=True)
class Line:
    """One line of the summary: a measure of a study at its worst.

    Parameters
    ----------
    study, variant, measure : str
        What was measured.
    worst : float
        The largest value, relative to its bound where there is one; nan if there is no value.
    bound : float or None
        Its bound.
    where : str
        The configuration of the worst value.
    failed, count : int
        Rows that break the bound or have no value, of how many.
    passed : bool or None
        Whether all rows keep the bound; None without one, or while rows are not solved.
    """

    study: str
    variant: str
    measure: str
    worst: float
    bound: float | None
    where: str
    failed: int
    count: int
    passed: bool | None


def summary(results: Sequence[StudyResult]) -> list[Line]:
    """Return the worst value of every measure of every study.

    Examples
    --------
    >>> row = Finding("mesh", "fine", 2.0, 1.0, "converged", (Measure("B", 0.1, 0.05),), False)
    >>> line, = summary([StudyResult("mesh", (row,))])
    >>> line.worst, line.passed
    (0.1, False)
    """
    lines = []
    for result in results:
        groups: dict[tuple[str, str, float | None], list[tuple[Finding, Measure]]] = {}
        for finding in result.findings:
            for one in finding.measures:
                groups.setdefault((finding.variant, one.name, one.bound), []).append((finding, one))
        for (variant, name, bound), rows in groups.items():
            known = [row for row in rows if math.isfinite(row[1].value)]
            worst = max(known, key=lambda row: row[1].value, default=None)
            solved = [row for row in rows if row[0].solved]
            failed = sum(one.passed is False for _, one in solved)
            complete = bound is not None and (failed or len(solved) == len(rows))
            lines.append(
                Line(
                    study=result.name,
                    variant=variant,
                    measure=name,
                    worst=worst[1].value if worst else math.nan,
                    bound=bound,
                    where=_where(worst[0]) if worst else "",
                    failed=failed,
                    count=len(solved),
                    passed=not failed if complete else None,
                )
            )
    return lines


def _where(finding: Finding) -> str:
    place = f"alpha = {finding.alpha:g}"
    return place if math.isnan(finding.g) else f"{place}, g = {finding.g:g}"


def summary_table(results: Sequence[StudyResult]) -> str:
    """Return the summary as a table in Markdown."""
    head = ["study", "variant", "measure", "worst", "bound", "at", "failed", "verdict"]
    rows = [
        [
            line.study,
            line.variant,
            line.measure,
            _number(line.worst),
            "" if line.bound is None else f"{line.bound:g}",
            line.where,
            "" if line.bound is None else f"{line.failed} of {line.count}",
            _VERDICTS[line.passed],
        ]
        for line in summary(results)
    ]
    return markdown_table(head, rows) + "\n"


def write_report(
    folder: Path, scope: Scope, results: Sequence[StudyResult], solved: Mapping[str, Solved]
) -> list[Path]:
    """Write `summary.md`, `verify.json`, and table and figure of each study.

    Parameters
    ----------
    folder : Path
        Where they go.
    scope : Scope
        What the studies cover.
    results : sequence of StudyResult
        The studies.
    solved : dict of str to Solved
        All solutions, for the fingerprints of the engine.

    Returns
    -------
    list of Path
        The files.

    Raises
    ------
    InputError
        If a file cannot be written.
    """
    files = []
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for result in results:
            files += _write_tables(folder, result)
            if any(one.solved for one in result.findings):
                files += _draw(folder, result)
        files.append(folder / "verify.json")
        files[-1].write_text(json.dumps(_content(scope, results, solved), indent=1) + "\n")
        files.append(folder / "summary.md")
        files[-1].write_text(_page(scope, results, solved), encoding="utf-8")
    except OSError as error:
        raise InputError(
            f"{error.filename or folder} cannot be written ({error.strerror}); "
            "choose another --out."
        ) from None
    return files


def _columns(result: StudyResult) -> tuple[list[str], list[list[Any]]]:
    """Return the head and the rows of a study's table, missing values as None."""
    measures = dict.fromkeys(m.name for f in result.findings for m in f.measures)
    data = dict.fromkeys(name for f in result.findings for name in f.data)
    head = ["variant", "alpha", "g", "outcome"]
    for name in measures:
        head += [name, f"bound of {name}"] if _has_bound(result, name) else [name]
    head += [*data, "verdict", "note"]
    rows = []
    for one in result.findings:
        known = {measure.name: measure for measure in one.measures}
        row: list[Any] = [one.variant, one.alpha, one.g, one.outcome]
        for name in measures:
            measure = known.get(name)
            row.append(measure and measure.value)
            if _has_bound(result, name):
                row.append(measure and measure.bound)
        row += [one.data.get(name) for name in data]
        rows.append([*row, _VERDICTS[one.passed], one.note])
    return head, rows


def _has_bound(result: StudyResult, name: str) -> bool:
    return any(m.bound is not None for f in result.findings for m in f.measures if m.name == name)


def _write_tables(folder: Path, result: StudyResult) -> list[Path]:
    head, rows = _columns(result)
    table = folder / f"{result.name}.csv"
    with table.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(head)
        writer.writerows([["" if _is_missing(x) else x for x in row] for row in rows])
    page = folder / f"{result.name}.md"
    text = f"# {result.name}\n\n{STUDIES[result.name]}\n\n"
    cells = [[_cell(name, x) for name, x in zip(head, row, strict=True)] for row in rows]
    text += markdown_table(head, cells)
    page.write_text(f"{text}\n{_facts(result)}", encoding="utf-8")
    return [table, page]


def _is_missing(value: Any) -> bool:
    return value is None or (isinstance(value, float) and math.isnan(value))


def _cell(name: str, value: Any) -> str:
    if _is_missing(value):
        return ""
    if isinstance(value, str):
        return value
    if name.startswith(("|", "spread", "signed")):
        return _number(value)
    return f"{value:.5g}" if isinstance(value, float) else f"{value}"


def _number(value: float) -> str:
    return "" if math.isnan(value) else f"{value:.2e}"


def _facts(result: StudyResult) -> str:
    return "".join(f"\n- {name}: {value:.4g}" for name, value in result.facts.items()) + "\n"


def _page(scope: Scope, results: Sequence[StudyResult], solved: Mapping[str, Solved]) -> str:
    """Return the summary for people to read."""
    settings = ", ".join(f"{name} {value}" for name, value in asdict(scope.base).items())
    versions = ", ".join(f"{name} {value}" for name, value in software().items())
    engines = sorted({one.engine for one in solved.values()})
    text = f"# Verification of the finite-element engine\n\nSettings: {settings}.\n\n"
    text += f"Software: {versions}; engine {', '.join(engines) or '-'}.\n\n"
    if len(engines) > 1:
        text += "**The solutions are of several versions of the engine.**\n\n"
    text += "| study | question | rows | failed | not solved | verdict |\n" + "|---" * 6 + "|\n"
    for result in results:
        missing = sum(not one.solved for one in result.findings)
        failed = sum(one.passed is False for one in result.findings)
        verdict = "pass" if result.passed else "FAIL" if failed else "incomplete"
        count = len(result.findings)
        text += f"| {result.name} | {STUDIES[result.name]} | {count} | {failed} | {missing} "
        text += f"| {verdict} |\n"
    text += "\n## Worst values\n\nWithout a bound a value is only reported.\n\n"
    text += summary_table(results)
    for result in results:
        if result.facts:
            text += f"\n## {result.name}\n{_facts(result)}"
    return text + _failures(results)


def _failures(results: Sequence[StudyResult]) -> str:
    text = ""
    for result in results:
        failed = [one for one in result.findings if one.passed is False]
        for one in failed[:_MOST_FAILURES]:
            broken = [
                f"{m.name} = {_number(m.value)}"
                for m in one.measures
                if m.passed is False and math.isfinite(m.value)
            ]
            what = "; ".join([one.outcome, *broken, *([one.note] if one.note else [])])
            name = f"{result.name}, {one.variant}" if one.variant else result.name
            text += f"- {name}, {_where(one)}: {what}\n"
        if len(failed) > _MOST_FAILURES:
            text += f"- {result.name}: {len(failed) - _MOST_FAILURES} more in {result.name}.md\n"
    return f"\n## What failed\n\n{text}" if text else "\nNothing failed.\n"


def _content(
    scope: Scope, results: Sequence[StudyResult], solved: Mapping[str, Solved]
) -> dict[str, Any]:
    content = {
        "software": software(),
        "engines": sorted({one.engine for one in solved.values()}),
        "scope": asdict(scope),
        "summary": [asdict(line) for line in summary(results)],
        "studies": {
            result.name: {
                "passed": result.passed,
                "facts": dict(result.facts),
                "findings": [asdict(one) for one in result.findings],
            }
            for result in results
        },
    }
    plain: dict[str, Any] = _plain(content)
    return plain


def _plain(value: Any) -> Any:
    """Return what JSON knows: null for nan."""
    if isinstance(value, Mapping):
        return {name: _plain(one) for name, one in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(one) for one in value]
    return None if _is_missing(value) else value


def _draw(folder: Path, result: StudyResult) -> list[Path]:
    """Draw a panel for each measure of a study."""
    from matplotlib.figure import Figure

    names = list(dict.fromkeys(m.name for f in result.findings for m in f.measures))
    panels: list[Callable[[Axes], object]] = [
        functools.partial(plot_measure, result, name) for name in names
    ]
    if result.facts:
        panels.append(functools.partial(plot_truncation, result))
    require_matplotlib()
    rows = math.ceil(len(panels) / 2)
    size = (_DOUBLE_COLUMN, 0.33 * _DOUBLE_COLUMN * rows + 0.7)
    figure = Figure(figsize=size, layout="constrained")
    places = figure.subplots(rows, 2, squeeze=False).ravel()
    for panel, ax in zip(panels, places, strict=False):
        panel(ax)
    for ax in places[1 : len(names)]:
        ax.get_legend().remove()  # the first panel names them all
    for ax in places[len(panels) :]:
        ax.remove()
    figure.draw_without_rendering()
    figure.set_layout_engine("none")  # laid out once for all files
    files = [folder / f"{result.name}{ending}" for ending in (".pdf", ".png")]
    for file in files:
        figure.savefig(file, dpi=_DPI)
    return files


def plot_measure(result: StudyResult, name: str, ax: Axes | None = None) -> Axes:
    """Draw a measure of a study against g, with its bound.

    Where several variants are compared each has its colour, else each exponent; an exponent has
    its marker.  Hollow markers break the bound; crosses on the upper edge were not reached.

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
    ax = ax or new_axes(0.8)
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
            ax.plot([x for x, *_ in known], [y for _, y, _ in known], "-", color=colour, lw=0.6)
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
    add_legend(ax, 2 if by_variant else 3)
    return ax


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
    ax = ax or new_axes(0.8)
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
    add_legend(ax, 2)
    return ax

"""Tables and figures of the studies: Markdown, CSV, JSON and pictures in one folder."""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fe_training.campaign.software import software
from fe_training.markdown import markdown_table
from fe_training.verification.cases import STUDIES, Scope, Solved
from fe_training.verification.studies import Finding, Measure, StudyResult
from surrogate.errors import InputError

if TYPE_CHECKING:
    pass

from fe_training.verification.figures import draw_study

__all__ = ["Line", "summary", "summary_table", "write_report"]

_VERDICTS = {True: "pass", False: "FAIL", None: "-"}


#: Failures that the summary lists for each study; all of them are in its table.
_MOST_FAILURES = 12


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
                files += draw_study(folder, result)
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

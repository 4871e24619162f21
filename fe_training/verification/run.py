"""Solving the cases of the studies: on processes, each solution durable as soon as it is there.

Solutions are lines of JSON in one file, with the key of their case.  A case that has a line is
not solved again, so a run that was interrupted goes on where it was.
"""

from __future__ import annotations

import functools
import hashlib
import json
import math
import os
from collections.abc import Iterable, Mapping, Sequence
from contextlib import AbstractContextManager
from dataclasses import fields
from pathlib import Path
from typing import Any

from fe_training.campaign.workers import Workers, backend, use_one_thread, watched
from fe_training.solver import solve as engine
from fe_training.solver.record import Outcome, Record
from fe_training.verification.cases import Case, Solved
from surrogate.errors import InputError, WirecutError

__all__ = ["estimated_seconds", "fingerprint", "read_solved", "solve_cases", "tasks_of"]

#: Rooms whose modules decide about a solution.
_ENGINE = ("mechanics", "solver")

#: Fields of a record that the studies do not need.
_PROFILES = {
    "pressure_angle",
    "pressure",
    "stretch",
    "ahead_reference",
    "ahead_deformed",
    "ahead_stress",
}

#: Below this g the engine raises the wire afresh for each value: those may be solved apart.
_AFRESH = 0.3

#: Seconds of one core for a value on a path, for one afresh and for the start of a path (alpha = 5,
#: 51,000 and 65,000 unknowns), and the mesh that they were taken on.
_ON_PATH, _APART, _START, _SECTORS, _SPACING = 16.0, 45.0, 12.0, 28, 0.05

#: Errors that are not about a case: they end the run instead of becoming a line.
_FATAL = (WirecutError, ImportError, NameError, MemoryError, OSError)


@functools.cache
def fingerprint() -> str:
    """Return a hash of the engine's source: solutions of another engine can be told apart."""
    content = hashlib.sha256()
    package = Path(__file__).resolve().parents[1]
    for room in _ENGINE:
        for module in sorted((package / room).glob("*.py")):
            content.update(module.read_bytes())
    return content.hexdigest()[:12]


def read_solved(file: Path) -> dict[str, Solved]:
    """Return the solutions in a file by the keys of their cases; the last one of a case counts.

    Lines that were torn by an interruption are passed over.
    """
    if not file.exists():
        return {}
    lines = file.read_text(encoding="utf-8").splitlines()
    return dict(one for one in map(_parsed, lines) if one is not None)


def _parsed(line: str) -> tuple[str, Solved] | None:
    try:
        row = json.loads(line)
        known = {one.name for one in fields(Record)}
        values = {name: value for name, value in row["record"].items() if name in known}
        values["outcome"] = Outcome[values["outcome"]]
    except (ValueError, KeyError, TypeError, AttributeError):
        return None
    for one in fields(Record):
        if values.get(one.name, "") is None:
            values[one.name] = math.nan
    across = values.get("energy_release_rate_across", ())
    values["energy_release_rate_across"] = tuple(math.nan if x is None else x for x in across)
    key = json.dumps(row["case"], sort_keys=True)
    return key, Solved(Record(**values), row.get("engine", ""), row.get("error", False))


def _line(case: Case, record: Record, error: bool) -> bytes:
    values = {one.name: getattr(record, one.name) for one in fields(Record)}
    row = {
        "case": json.loads(case.key),
        "engine": fingerprint(),
        "error": error,
        "record": {name: _plain(x) for name, x in values.items() if name not in _PROFILES},
    }
    return (json.dumps(row, allow_nan=False) + "\n").encode()


def _plain(value: Any) -> Any:
    """Return what JSON knows: null for nan, names of outcomes."""
    if isinstance(value, Outcome):
        return value.name
    if isinstance(value, dict):
        return {name: _plain(one) for name, one in value.items()}
    if isinstance(value, tuple):
        return [_plain(one) for one in value]
    if hasattr(value, "item"):
        value = value.item()
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _append(file: Path, line: bytes) -> None:
    """Add a line in a single write, so that lines of several processes do not mix."""
    handle = os.open(file, os.O_WRONLY | os.O_APPEND | os.O_CREAT, 0o644)
    try:
        os.write(handle, line)
        os.fsync(handle)
    finally:
        os.close(handle)


def tasks_of(cases: Iterable[Case]) -> list[tuple[Case, ...]]:
    """Return cases grouped so that those of a group are one path; the longest group comes first."""
    groups: dict[tuple[Any, ...], list[Case]] = {}
    for case in cases:
        far = case.g is None or case.g < _AFRESH
        one = (case.study, case.alpha, case.settings, case.shift, far, case.distance)
        groups.setdefault(one, []).append(case)
    return sorted(map(tuple, groups.values()), key=lambda group: -_seconds(group))


def estimated_seconds(cases: Iterable[Case]) -> float:
    """Return about how long cases take on one process, from their numbers and meshes [s]."""
    return sum(map(_seconds, tasks_of(cases)), 0.0)


def _seconds(group: Sequence[Case]) -> float:
    start = _START * _size(group[0]) if group[0].g is not None and group[0].g >= _AFRESH else 0.0
    return start + sum(map(_case_seconds, group))


def _case_seconds(case: Case) -> float:
    if case.g is None or case.g < _AFRESH:
        return _APART * _size(case)
    shifted = 2.0 if case.shift else 1.0
    return _ON_PATH * shifted * _size(case) * math.sqrt(max(1.0, case.g / 10.0))


def _size(case: Case) -> float:
    """Return about how much longer a step takes than with the default settings."""
    spacing = math.sqrt(_SPACING / case.settings.contact_spacing)
    return (case.settings.sectors / _SECTORS) ** 2 * spacing


def solve_cases(cases: Iterable[Case], file: Path, jobs: int = 1, retry: bool = False) -> None:
    """Solve the cases that a file does not hold yet, with a bar of progress.

    Parameters
    ----------
    cases : iterable of Case
        What is wanted.
    file : Path
        Solutions, a line each; it is made if there is none.
    jobs : int
        Processes, each with one thread.
    retry : bool
        Whether cases that were not reached are solved again.

    Raises
    ------
    InputError
        If the file cannot be written.
    WirecutError
        If a process died.
    """
    from joblib import Parallel, delayed

    solved = read_solved(file)
    if retry:
        solved = {key: one for key, one in solved.items() if one.reached}
    left = [case for case in cases if case.key not in solved]
    _mend(file)
    if not left:
        return
    tasks = tasks_of(left)
    with backend(Workers(jobs)), _watched(file, left):
        Parallel(batch_size=1, pre_dispatch="all")(
            delayed(solve_task)(task, str(file), os.getpid()) for task in tasks
        )


def _mend(file: Path) -> None:
    """Make sure that the file can be written and that its last line is complete."""
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        torn = file.exists() and file.read_bytes()[-1:] not in (b"", b"\n")
        _append(file, b"\n" if torn else b"")
    except OSError as error:
        raise InputError(
            f"{file} cannot be written ({error.strerror}); choose another --out."
        ) from None


def solve_task(task: Sequence[Case], file: str, driver: int) -> None:
    """Solve the cases of one path and add their lines to a file.

    Parameters
    ----------
    task : sequence of Case
        Of equal study, alpha, settings and shift; one distance or values of g.
    file : str
        Where the lines go.
    driver : int
        The process that started this one; without it the task ends at its next line.
    """
    use_one_thread()
    waiting = list(task)
    first = task[0]

    def keep(case: Case, record: Record, error: bool = False) -> None:
        waiting.remove(case)
        _append(Path(file), _line(case, record, error))
        if driver not in (os.getpid(), os.getppid()):
            os._exit(1)  # whoever started this is gone, and may be running again

    def report(record: Record) -> None:
        keep(next(case for case in waiting if case.g == record.target), record)

    reason = "the engine left this value out"
    try:
        if first.distance is not None:
            keep(
                first,
                engine.solve(
                    first.alpha,
                    distance=first.distance,
                    settings=first.settings,
                    shift=first.shift,
                ),
            )
        else:
            gs = [case.g for case in task if case.g is not None]
            engine.solve_path(first.alpha, gs, first.settings, report, first.shift)
    except _FATAL:
        raise
    except Exception as error:
        reason = f"{type(error).__name__}: {error}"
    for case in list(waiting):
        target = math.nan if case.g is None else case.g
        keep(case, Record(case.alpha, Outcome.STALLED, target=target, reason=reason), error=True)


def _watched(file: Path, left: Sequence[Case]) -> AbstractContextManager[None]:
    """Return a bar that counts cases as their lines come into the file, by their estimated time."""
    seconds: Mapping[str, float] = {case.key: _case_seconds(case) for case in left}
    total = sum(seconds.values())
    form = "{desc} {percentage:3.0f}%|{bar}| {elapsed} gone, {remaining} left {postfix}"
    start, finished = file.stat().st_size, 0

    def look(bar: Any) -> None:
        nonlocal start, finished
        with file.open("rb") as stream:
            stream.seek(start)
            content = stream.read()
        complete = content[: content.rfind(b"\n") + 1]
        start += len(complete)
        for line in complete.decode().splitlines():
            row = _parsed(line)
            if row is None or row[0] not in seconds:
                continue
            finished += 1
            bar.n = min(total, bar.n + seconds[row[0]])
            case = json.loads(row[0])
            where = f"{case['study']}, alpha = {case['alpha']:g}"
            where += "" if case["g"] is None else f", g = {case['g']:g}"
            bar.set_postfix_str(f"{where}: {row[1].outcome}", refresh=False)
        bar.set_description_str(f"{finished}/{len(left)}")

    return watched(total, form, look)

"""Running a campaign: what is left to solve, on how many processes, and each task's rows.

The processes that solve write their rows into the store themselves, each as soon as it is
finished, so a run that is killed at any moment loses the configurations in progress only. On
several machines the store's folder has to be on a file system that all of them share.
"""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from typing import Any

import numpy as np

from fe_training.campaign.design import STRATEGIES, CampaignDesign, Configuration, Task
from fe_training.campaign.software import software
from fe_training.campaign.store import Row, Store
from fe_training.campaign.workers import Workers, backend, use_one_thread, watched
from fe_training.solver.cut import Settings
from fe_training.solver.record import Outcome, Record
from fe_training.solver.solve import solve_path
from surrogate.errors import WirecutError

__all__ = ["Plan", "plan", "run_campaign", "run_task"]

SolvePath = Callable[[float, list[float], Settings, Callable[[Record], None]], list[Record]]

#: Seconds for a configuration at 24 sectors, alone and on a path, for the first estimate; they
#: grow with the square of the number of sectors. Finished rows of the store replace them.
_ALONE, _ON_PATH, _SECTORS = 60.0, 15.0, 24

#: Errors that are not about a configuration: they end the campaign instead of becoming a row.
_FATAL = (WirecutError, ImportError, AttributeError, NameError, TypeError, MemoryError, OSError)


@dataclass(frozen=True, slots=True)
class Plan:
    """What is finished and what is left of some configurations of a campaign.

    Parameters
    ----------
    rows : tuple of Row
        The rows in the store, failed ones included.
    waiting : tuple of (Configuration, int)
        What is to be solved, each with its attempt.
    seconds : dict of Configuration to float
        Estimated time of each configuration to be solved, on one process [s].
    """

    rows: tuple[Row, ...]
    waiting: tuple[tuple[Configuration, int], ...]
    seconds: Mapping[Configuration, float]


def plan(
    design: CampaignDesign,
    store: Store,
    configurations: Iterable[Configuration],
    retry: bool = True,
) -> Plan:
    """Return what is left to solve.

    Parameters
    ----------
    design : CampaignDesign
        The design.
    store : Store
        The rows finished so far.
    configurations : iterable of Configuration
        Those of the design that are wanted.
    retry : bool
        Whether failed configurations are tried again with the next strategy.

    Returns
    -------
    Plan
    """
    wanted = list(configurations)
    rows = store.rows(wanted)
    found = {row.configuration: row for row in rows}
    waiting = []
    for one in wanted:
        row = found.get(one)
        if row is None:
            waiting.append((one, 0))
        elif retry and not row.converged and row.tried < len(STRATEGIES):
            waiting.append((one, row.tried))
    seconds = _estimate(design, rows, waiting)
    return Plan(tuple(rows), tuple(waiting), seconds)


def _estimate(
    design: CampaignDesign, rows: Sequence[Row], waiting: Sequence[tuple[Configuration, int]]
) -> dict[Configuration, float]:
    """Return seconds for each configuration, from the mean of finished rows of its kind."""
    spent: dict[tuple[str, bool], list[float]] = {}
    for row in rows:
        if row.attempt == 0 and math.isfinite(row.record.wall_time):
            kind = row.configuration.level, row.configuration.target >= design.path_from
            spent.setdefault(kind, []).append(row.record.wall_time)
    seconds = {}
    for one, attempt in waiting:
        on_path = one.target >= design.path_from
        first = design.settings(one.level, 0).sectors
        known = spent.get((one.level, on_path))
        guess = (_ON_PATH if on_path else _ALONE) * (first / _SECTORS) ** 2
        refined = (design.settings(one.level, attempt).sectors / first) ** 2
        seconds[one] = refined * (float(np.mean(known)) if known else guess)
    return seconds


def run_campaign(
    design: CampaignDesign,
    store: Store,
    todo: Plan,
    workers: Workers | None = None,
    progress: bool = True,
    solve: SolvePath = solve_path,
) -> None:
    """Solve what a plan has left, each row durable as soon as it is finished.

    Parameters
    ----------
    design : CampaignDesign
        The design.
    store : Store
        Opened for the design, see `Store.opened`.
    todo : Plan
        What is left.
    workers : Workers, optional
        Where to solve; one process by default.
    progress : bool
        Whether to show a bar with an estimate of the time left.
    solve : callable
        Solves values of g at one alpha; that of the engine by default.

    Raises
    ------
    MissingExtraError
        If a Dask scheduler is named and Dask is not installed.
    WirecutError
        If the scheduler does not answer, or if workers died.
    """
    from joblib import Parallel, delayed

    workers = workers or Workers()
    tasks = design.tasks(todo.waiting)
    if not tasks:
        return
    driver = None if workers.scheduler else os.getpid()
    with backend(workers), _watched(store, todo.seconds) if progress else nullcontext():
        Parallel(batch_size=1, pre_dispatch="all")(
            delayed(run_task)(task, design, str(store.folder), solve, driver) for task in tasks
        )


def run_task(
    task: Task,
    design: CampaignDesign,
    folder: str,
    solve: SolvePath = solve_path,
    driver: int | None = None,
) -> None:
    """Solve the configurations of a task that the store has not yet, and write their rows.

    Parameters
    ----------
    task : Task
        The configurations and their attempt.
    design : CampaignDesign
        The design.
    folder : str
        The store.
    solve : callable
        Solves values of g at one alpha.
    driver : int, optional
        The process that started this one; without it the task ends at its next row.
    """
    use_one_thread()
    store = Store(folder)
    rows = {one: store.read(one) for one in design.together(task.configurations[0])}
    # Those of a path that were finished before an interruption are passed once more, so that
    # every row comes out as if there had been none.
    passed = [
        one
        for one, row in rows.items()
        if one in task.configurations or (row is not None and row.tried > task.attempt)
    ]
    left = {one for one in passed if (row := rows[one]) is None or row.tried <= task.attempt}
    if not left:
        return
    last = max(one.target for one in left)
    passed = [one for one in passed if one.target <= last]

    def keep(one: Configuration, record: Record) -> None:
        passed.remove(one)
        if one in left:
            row = Row(one, task.attempt, task.attempt + 1, software(), record)
            store.write(row.better(rows[one]))
        if driver is not None and driver not in (os.getpid(), os.getppid()):
            os._exit(1)  # whoever started this is gone, and may be running again

    alpha = passed[0].alpha
    reason = "the engine left this value out"
    try:
        solve(
            alpha,
            [one.target for one in passed],
            design.settings(passed[0].level, task.attempt),
            lambda record: keep(_asked_for(record, passed), record),
        )
    except _FATAL:
        raise
    except Exception as error:
        reason = f"{type(error).__name__}: {error}"
    for one in list(passed):
        keep(one, Record(alpha=alpha, outcome=Outcome.STALLED, reason=reason))


def _asked_for(record: Record, passed: Sequence[Configuration]) -> Configuration:
    """Return the configuration that a record answers."""
    return min(passed, key=lambda one: abs(math.log(one.target / record.target)))


def _watched(store: Store, seconds: Mapping[Configuration, float]) -> AbstractContextManager[None]:
    """Return a bar that counts rows as they come into the store, by their estimated time."""
    waiting = {one: store.stamp(one) for one in seconds}
    total = sum(seconds.values())

    def look(bar: Any) -> None:
        for one in [one for one, stamp in waiting.items() if store.stamp(one) != stamp]:
            del waiting[one]
        bar.n = total - sum(seconds[one] for one in waiting)
        bar.set_description_str(f"{len(seconds) - len(waiting)}/{len(seconds)} rows")

    form = "{desc} {percentage:3.0f}%|{bar}| {elapsed} gone, {remaining} left"
    return watched(total, form, look)

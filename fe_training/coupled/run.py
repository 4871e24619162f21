"""Running the campaign with friction and wear: base after base, on several processes."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

from fe_training.campaign.software import software
from fe_training.campaign.workers import Workers, backend, use_one_thread, watched
from fe_training.coupled.design import Base, CoupledDesign
from fe_training.coupled.store import CoupledStore
from fe_training.sliding.record import SlidingOutcome, SlidingRecord
from fe_training.sliding.solve import solve_rays
from fe_training.solver.cut import Settings
from surrogate.errors import WirecutError

Solve = Callable[..., list[SlidingRecord]]

#: Errors that are not about a configuration: they end the campaign instead of becoming a row.
_FATAL = (WirecutError, ImportError, AttributeError, NameError, TypeError, MemoryError, OSError)


def waiting(design: CoupledDesign, store: CoupledStore) -> list[Base]:
    """Return the bases that are not finished, in their order."""
    return [base for base in design.all_bases() if not store.is_finished(base)]


def run_coupled(
    design: CoupledDesign,
    store: CoupledStore,
    todo: Sequence[Base],
    workers: Workers | None = None,
    solve: Solve = solve_rays,
) -> None:
    """Solve bases, each row durable as soon as it is finished.

    Parameters
    ----------
    design : CoupledDesign
    store : CoupledStore
        Opened for the design.
    todo : sequence of Base
        What is left.
    workers : Workers, optional
        Where to solve; one process by default.
    solve : callable
        Solves rays of loads; that of the engine by default.
    """
    from joblib import Parallel, delayed

    if not todo:
        return
    rows = {base: sum(map(len, base.rays)) for base in todo}

    def look(bar: Any) -> None:
        there = {base: store.read(base) for base in todo}
        bar.n = sum(len(each.records) for each in there.values() if each is not None)
        bar.set_description_str(f"{bar.n}/{sum(rows.values())} rows")

    form = "{desc} {percentage:3.0f}%|{bar}| {elapsed} gone, {remaining} left"
    with backend(workers or Workers()), watched(sum(rows.values()), form, look):
        Parallel(batch_size=1, pre_dispatch="all")(
            delayed(run_base)(base, design.settings_of(base), str(store.folder), solve)
            for base in todo
        )


def again(design: CoupledDesign, store: CoupledStore) -> list[Base]:
    """Return what is solved a second time: first rays of bases that no fit sees, where they got.

    Parameters
    ----------
    design : CoupledDesign
    store : CoupledStore
        The rows of the campaign.
    """
    found = []
    for base in design.all_bases():
        rows = store.read(base) if base.held_out else None
        reached = {
            (row.target_friction, row.target_wear)
            for row in (rows.records if rows else ())
            if row.outcome is SlidingOutcome.CONVERGED
        }
        ray = tuple(load for load in base.rays[0] if load in reached)
        if ray:
            found.append(replace(base, rays=(ray,)))
    return found


def run_base(base: Base, settings: Settings, folder: str, solve: Solve = solve_rays) -> None:
    """Solve the loads of a base and write their rows."""
    use_one_thread()
    store, made_by = CoupledStore(folder), software()
    records: list[SlidingRecord] = []

    def keep(record: SlidingRecord) -> None:
        records.append(record)
        store.write(base, records, made_by)

    reason = "the engine left this load out"
    try:
        solve(base.alpha, base.g, base.rays, settings, keep, base.taper)
    except _FATAL:
        raise
    except Exception as error:
        reason = f"{type(error).__name__}: {error}"
    loads = [load for ray in base.rays for load in ray]
    for friction, wear in loads[len(records) :]:
        keep(_lost(base, friction, wear, reason))


def _lost(base: Base, friction: float, wear: float, reason: str) -> SlidingRecord:
    return SlidingRecord(
        alpha=base.alpha,
        target=base.g,
        target_friction=friction,
        target_wear=wear,
        outcome=SlidingOutcome.STALLED,
        reason=reason,
        processor_time=math.nan,
    )

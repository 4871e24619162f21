"""Solving a sample of a data set again, to see that it still comes out."""

from __future__ import annotations

import os
from dataclasses import dataclass

import numpy as np

from fe_training.campaign.dataset import Campaign
from fe_training.campaign.design import Configuration
from fe_training.campaign.run import Plan, SolvePath, run_campaign
from fe_training.campaign.store import Store
from fe_training.campaign.workers import Workers
from fe_training.solver.record import Record
from fe_training.solver.solve import solve_path
from surrogate.errors import InputError

__all__ = ["RowCheck", "check_rows"]

#: A, B and delta of a row may always differ by this, relative to the larger of 1 and the value:
#: J is met within the settings' tolerance, and a contact arc ends at a node.
_FLOOR = 1e-3


@dataclass(frozen=True, slots=True)
class RowCheck:
    """A row of the data set and what came out when it was solved again.

    Parameters
    ----------
    configuration : Configuration
        The row.
    names : tuple of str
        Symbols of the compared quantities.
    stored, solved, allowed : tuple of float
        Their values in the data set and now [-], and the differences that the error bars allow.
    outcome : str
        How the computation ended.
    """

    configuration: Configuration
    names: tuple[str, ...]
    stored: tuple[float, ...]
    solved: tuple[float, ...]
    allowed: tuple[float, ...]
    outcome: str

    @property
    def agrees(self) -> bool:
        """Whether all differences are within the error bars."""
        difference = np.abs(np.subtract(self.solved, self.stored))
        return bool(np.all(difference <= self.allowed))

    def __str__(self) -> str:
        values = ", ".join(
            f"{name} {stored:.5g} -> {solved:.5g} (+-{allowed:.1e})"
            for name, stored, solved, allowed in zip(
                self.names, self.stored, self.solved, self.allowed, strict=True
            )
        )
        verdict = "agrees" if self.agrees else f"DIFFERS ({self.outcome.lower()})"
        return f"{self.configuration}: {values}: {verdict}"


def check_rows(
    campaign: Campaign,
    number: int,
    seed: int,
    workers: Workers,
    folder: str | os.PathLike[str],
    solve: SolvePath = solve_path,
) -> list[RowCheck]:
    """Solve a random sample of the rows behind the usable points again.

    Parameters
    ----------
    campaign : Campaign
        The data.
    number : int
        How many rows; all if there are fewer.
    seed : int
        Of the sample.
    workers : Workers
        Where to solve.
    folder : str or path-like
        An empty folder for the new rows.
    solve : callable
        Solves values of g at one alpha; that of the engine by default.

    Returns
    -------
    list of RowCheck

    Raises
    ------
    InputError
        If no point of the data set may be used.
    """
    points, rows, design = campaign.points, campaign.rows, campaign.design
    usable = np.flatnonzero(points["use"])
    if not len(usable):
        raise InputError("no point of the data set is within its bounds, there is nothing to check")
    sample = np.random.default_rng(seed).permutation(usable)[:number]
    wanted = {}
    for point in sample:
        row = points["row"][point]
        one = Configuration(
            str(rows["level"][row]), float(rows["alpha"][row]), float(rows["target"][row])
        )
        wanted[one] = (point, row)
    store = Store(folder)
    waiting = tuple((one, int(rows["attempt"][row])) for one, (_, row) in wanted.items())
    with store.opened(design):
        run_campaign(
            design, store, Plan((), waiting, dict.fromkeys(wanted, 1.0)), workers, solve=solve
        )
        solved = {row.configuration: row.record for row in store.rows(wanted)}
    checks = []
    for one, (point, row) in wanted.items():
        record = solved[one]
        checks.append(_compared(campaign, one, point, row, record))
    return checks


def _compared(
    campaign: Campaign, one: Configuration, point: int, row: int, record: Record
) -> RowCheck:
    """Return the row of a point beside what came out now."""
    points, rows = campaign.points, campaign.rows
    arc = np.cos(rows["theta_1"][row]) - np.cos(rows["theta_2"][row])
    names = ["A", "B", "delta"]
    stored = [float(arc), float(rows["vertical_force"][row]), float(rows["distance"][row])]
    solved = [record.arc, record.normal_load, record.distance]
    errors = [
        float(points["arc_error"][point]),
        float(points["normal_load_error"][point]) * stored[1],
        float(points["distance_error"][point]) * stored[2],
    ]
    if "slip_arc" in rows.columns:
        names += ["A*", "B*"]
        stored += [float(rows["slip_arc"][row]), float(rows["slip_load"][row])]
        solved += [record.slip_arc, record.slip_load]
        relative = (points[f"{name}_error"][point] for name in ("slip_arc", "slip_load"))
        errors += [float(e) * s for e, s in zip(relative, stored[3:], strict=True)]
    allowed = tuple(e + _FLOOR * max(1.0, s) for e, s in zip(errors, stored, strict=True))
    return RowCheck(one, tuple(names), tuple(stored), tuple(solved), allowed, record.outcome.name)

"""Whether a point of the data set can be used: its values at the target, its errors and doubts."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fe_training.campaign.columns import POINT_COLUMNS
from fe_training.campaign.design import BLUNT, CampaignDesign, Configuration
from fe_training.campaign.store import Row
from fe_training.solver.record import Outcome, Record

__all__ = ["ARC_BOUND", "LOAD_BOUND", "TARGET_BOUND", "TRUNCATION_BOUND", "point_columns"]

Array = NDArray[Any]
Floats = NDArray[np.float64]

#: A point is used where the mesh levels differ by no more than this: B relatively, A absolutely.
LOAD_BOUND, ARC_BOUND = 5e-3, 0.01

#: ... where the finite body takes away no more than this share of B, ...
TRUNCATION_BOUND = 5e-3

#: ... and where J is this close to its target, so that the correction to the target is small.
TARGET_BOUND = 0.01


def point_columns(design: CampaignDesign, rows: Sequence[Row]) -> dict[str, Array]:
    """Return the columns of the points: the finer level's values and the levels' difference."""
    index = {row.configuration: i for i, row in enumerate(rows)}
    values = {level: _at_targets(rows, level, design) for level in design.names}
    coarse, fine = design.levels
    points: list[dict[str, Any]] = []
    for one in design.configurations():
        if one.level != fine:
            continue
        twin = replace(one, level=coarse)
        here = [c for c in (one, twin) if c in index]
        if not here:
            continue
        reached = [c for c in here if c in values[c.level]]
        chosen = (reached or here)[0]
        record = rows[index[chosen]].record
        nothing = np.full(5, np.nan)
        best = values[chosen.level].get(chosen, nothing)
        other = values[coarse].get(twin, nothing) if chosen is one else nothing
        errors = np.abs(other - best)
        point = {
            "alpha": one.alpha,
            "g": one.target,
            "arc": best[0],
            "normal_load": best[1],
            "distance": best[2],
            "slip_arc": best[3],
            "slip_load": best[4],
            "arc_error": errors[0],
            "normal_load_error": errors[1] / best[1],
            "distance_error": errors[2] / best[2],
            "slip_arc_error": errors[3] / best[3],
            "slip_load_error": errors[4] / best[4],
            **_notch_slopes(design, one, values),
            # of the values at the target, for which it grows as the root of g
            "truncation_error": round(
                record.truncation_error * np.sqrt(1.0 / _relative_to_target(one, record)), 12
            ),
            "force_mismatch": record.force_mismatch,
            "support_spread": record.support_spread if reached else np.nan,
            "row": index[chosen],
        }
        reason = _doubt(point, record) if reached else record.outcome.meaning
        points.append({**point, "use": not reason, "reason": reason})
    return {name: np.array([point[name] for point in points]) for name in POINT_COLUMNS}


def _relative_to_target(one: Configuration, record: Record) -> float:
    """Return J over what was wanted; 1 where nothing was reached."""
    ratio = record.energy_release_rate / one.target
    return float(ratio) if np.isfinite(ratio) else 1.0


def _notch_slopes(
    design: CampaignDesign,
    one: Configuration,
    values: Mapping[str, Mapping[Configuration, Floats]],
) -> dict[str, float]:
    """Return dA*/d ln(1/r) and dB*/d ln(1/r), r the notch radius, from the blunt level's twin."""
    coarse = next(iter(design.levels))
    sharp = values[coarse].get(replace(one, level=coarse))
    blunt = values.get(BLUNT, {}).get(replace(one, level=BLUNT))
    slopes = np.full(2, np.nan)
    if design.blunt and sharp is not None and blunt is not None:
        radii = design.blunt.notch_radius, design.levels[coarse].notch_radius
        slopes = (sharp[3:] - blunt[3:]) / np.log(radii[0] / radii[1])
    return {"slip_arc_notch_slope": slopes[0], "slip_load_notch_slope": slopes[1]}


def _doubt(point: Mapping[str, Any], record: Record) -> str:
    """Return why a point is not to be used, or nothing."""
    off = abs(record.energy_release_rate / point["g"] - 1.0)
    load_error, arc_error = point["normal_load_error"], point["arc_error"]
    truncation = point["truncation_error"]
    reasons = [
        (
            record.outcome is not Outcome.CONVERGED and record.within_evidence,
            record.outcome.meaning,
        ),
        (
            not record.within_evidence,
            f"|J - 2 F_h|/J is above its bound ({record.force_mismatch:.1e})",
        ),
        (off > TARGET_BOUND, f"J is off its target ({100 * off:.2g} %)"),
        (np.isnan(load_error), "only one mesh level was reached"),
        (load_error > LOAD_BOUND, f"B differs between the meshes ({100 * load_error:.2g} %)"),
        (arc_error > ARC_BOUND, f"A differs between the meshes ({arc_error:.2g})"),
        (
            not truncation <= TRUNCATION_BOUND,
            f"B is truncated by the finite body ({100 * truncation:.2g} %)",
        ),
    ]
    return "; ".join(text for doubtful, text in reasons if doubtful)


def _at_targets(
    rows: Iterable[Row], level: str, design: CampaignDesign
) -> dict[Configuration, Floats]:
    """Return A, B, delta, A* and B* of what one level reached, each at its row's target.

    The slopes with respect to log J come from the neighbouring rows of the same alpha.
    """
    found: dict[Configuration, Floats] = {}
    for alpha in design.alpha:
        here = [
            row
            for row in rows
            if (row.configuration.level, row.configuration.alpha) == (level, alpha)
            and np.isfinite(row.record.energy_release_rate)
        ]
        here.sort(key=lambda row: row.record.energy_release_rate)
        log_j = np.log([row.record.energy_release_rate for row in here])
        values = np.array([_functions(row.record) for row in here])
        slopes = np.zeros_like(values)
        if len(here) > 1 and np.all(np.diff(log_j) > 0.0):
            slopes = np.gradient(values, log_j, axis=0)
        for row, x, value, slope in zip(here, log_j, values, slopes, strict=True):
            found[row.configuration] = value + slope * (np.log(row.configuration.target) - x)
    return found


def _functions(record: Record) -> tuple[float, ...]:
    return (record.arc, record.normal_load, record.distance, record.slip_arc, record.slip_load)

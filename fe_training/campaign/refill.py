"""The rows of a data set, to go on with a campaign where the store that made it is gone."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import fields
from typing import Any

import numpy as np

from fe_training.campaign.columns import INNER
from fe_training.campaign.dataset import Campaign
from fe_training.campaign.design import CampaignDesign, Configuration
from fe_training.campaign.store import Row, Store
from fe_training.solver.record import Outcome, Record
from surrogate.errors import InputError

__all__ = ["refill", "require_same_meshes", "rows_of"]


def rows_of(campaign: Campaign) -> list[Row]:
    """Return the rows of a data set as a store holds them.

    Parameters
    ----------
    campaign : Campaign
        The data set.

    Returns
    -------
    list of Row
        Profiles are those of the data set: single precision, at no more points than it keeps.
        All else is as it was solved, so a data set made of these rows is the same again.
    """
    columns = campaign.rows.columns
    return [
        _row({name: values[i] for name, values in columns.items()}, campaign)
        for i in range(len(campaign.rows))
    ]


def _row(values: Mapping[str, Any], campaign: Campaign) -> Row:
    return Row(
        Configuration(str(values["level"]), float(values["alpha"]), float(values["target"])),
        attempt=int(values["attempt"]),
        tried=int(values["tried"]),
        software=dict(campaign.software[int(values["software"])]),
        record=Record(
            **{
                field.name: _restored(field.name, values[field.name])
                for field in fields(Record)
                if field.name in values  # earlier data sets have no stretches
            }
        ),
    )


def _restored(name: str, value: Any) -> Any:
    """Return a field of a record from its column's entry."""
    if name in INNER:
        whole = np.asarray(value, dtype=float)
        whole = whole[np.isfinite(whole)]  # nan pads
        return tuple(whole.tolist()) if name == "energy_release_rate_across" else whole
    if name == "outcome":
        return Outcome[str(value)]
    if name == "mesh":
        return json.loads(str(value))
    return value.item()


def require_same_meshes(design: CampaignDesign, campaign: Campaign) -> None:
    """Refuse a data set with rows on other meshes than a design's.

    Raises
    ------
    InputError
        If a level that both have differs, or they have none in common.
    """
    other = campaign.design
    common = [name for name in design.names if name in other.names]
    differing = [name for name in common if design.settings(name, 0) != other.settings(name, 0)]
    if differing or not common:
        what = f"of the level {differing[0]!r} differs" if differing else "has other levels"
        raise InputError(
            f"the mesh {what} between the data set and the design, whose rows must not mix; give "
            "--design one with the same meshes, or leave --continue-from out."
        )


def refill(store: Store, design: CampaignDesign, campaign: Campaign) -> int:
    """Put those rows of a data set that a design has into a store that lacks them.

    The data set may belong to another design, with other alphas or g, but on the same meshes.

    Parameters
    ----------
    store : Store
        Opened for the design.
    design : CampaignDesign
        Its design.
    campaign : Campaign
        The data set.

    Returns
    -------
    int
        How many rows were put in.

    Raises
    ------
    InputError
        If the meshes of the two designs differ.
    """
    require_same_meshes(design, campaign)
    wanted = set(design.configurations())
    rows = [row for row in rows_of(campaign) if row.configuration in wanted]
    lacking = [row for row in rows if not store.stamp(row.configuration)]
    for row in lacking:
        store.write(row)
    return len(lacking)

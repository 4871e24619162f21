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

__all__ = ["refill", "rows_of"]


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


def refill(store: Store, design: CampaignDesign, campaign: Campaign) -> int:
    """Put the rows of a data set into a store that lacks them.

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
        If the data set belongs to another design.
    """
    if campaign.design.hash != design.hash:
        raise InputError(
            f"the data set belongs to the design {campaign.design.hash}, not to {design.hash}; "
            "give --design the one that it was made with, or leave --continue-from out."
        )
    lacking = [row for row in rows_of(campaign) if not store.stamp(row.configuration)]
    for row in lacking:
        store.write(row)
    return len(lacking)

"""The points that surrogates are fitted to: A, B and delta over (alpha, g) with their errors."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from surrogate.errors import InputError

if TYPE_CHECKING:
    from fe_training.campaign.dataset import Campaign

__all__ = ["FitPoints", "points_of"]

Floats = NDArray[np.float64]

_ONE_LEVEL = "only one mesh level was reached"

#: Smallest standard errors that a difference between two meshes is believed to show: of A
#: absolutely, of B and delta relatively.
ARC_FLOOR, LOAD_FLOOR, DISTANCE_FLOOR = 5e-4, 1e-4, 1e-4


@dataclass(frozen=True, slots=True, eq=False)
class FitPoints:
    """What was computed at a number of configurations.

    Parameters
    ----------
    alpha, g : ndarray, shape (points,)
        Stiffening exponent and dimensionless toughness [-].
    arc, normal_load, distance : ndarray, shape (points,)
        A, B and delta/R_w [-].
    arc_std : ndarray, shape (points,)
        Standard error of A, absolute [-].
    normal_load_std, distance_std : ndarray, shape (points,)
        Standard errors of B and delta, relative [-].
    """

    alpha: Floats
    g: Floats
    arc: Floats
    normal_load: Floats
    distance: Floats
    arc_std: Floats
    normal_load_std: Floats
    distance_std: Floats

    def __len__(self) -> int:
        return len(self.alpha)

    def taken(self, chosen: Any) -> FitPoints:
        """Return some of the points, by a mask, a slice or indices."""
        return FitPoints(*(getattr(self, field.name)[chosen] for field in fields(self)))


def points_of(campaign: Campaign, single_mesh: bool = False) -> FitPoints:
    """Return the points of a campaign that may be used.

    Parameters
    ----------
    campaign : Campaign
        The data set.
    single_mesh : bool, default False
        Whether to take points that only one mesh level has reached as well, with errors that
        nobody measured: for trying out a fit before the campaign is complete.

    Returns
    -------
    FitPoints
        In rising order of alpha and g.

    Raises
    ------
    InputError
        If no point may be used.
    """
    points = campaign.points
    use = points["use"].astype(bool)
    if single_mesh:
        use = use | (points["reason"] == _ONE_LEVEL)
    if not use.any():
        raise InputError(
            "no point of the data set is within the bounds of its evidence, so there is nothing "
            "to fit; finish the campaign first."
        )
    columns = {name: np.asarray(values)[use] for name, values in points.columns.items()}
    truncation = columns["truncation_error"]
    found = FitPoints(
        alpha=columns["alpha"],
        g=columns["g"],
        arc=columns["arc"],
        normal_load=columns["normal_load"],
        distance=columns["distance"],
        arc_std=_at_least(columns["arc_error"], ARC_FLOOR, 2e-3),
        normal_load_std=np.hypot(
            _at_least(columns["normal_load_error"], LOAD_FLOOR, 5e-4), truncation
        ),
        distance_std=_at_least(columns["distance_error"], DISTANCE_FLOOR, 5e-4),
    )
    return found.taken(np.lexsort((found.g, found.alpha)))


def _at_least(errors: Floats, floor: float, unknown: float) -> Floats:
    return np.maximum(np.where(np.isnan(errors), unknown, errors), floor)

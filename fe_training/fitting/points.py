"""The points that surrogates are fitted to: A, B, delta, A* and B* over (alpha, g) with errors."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from surrogate.contact.coordinates import QUANTITIES, SLIP_QUANTITIES
from surrogate.errors import InputError

if TYPE_CHECKING:
    from fe_training.campaign.dataset import Campaign

__all__ = ["FitPoints", "points_of"]

Floats = NDArray[np.float64]

_ONE_LEVEL = "only one mesh level was reached"
_TRUNCATED = "B is truncated by the finite body"

#: Smallest standard errors that a difference between two meshes is believed to show: of A
#: absolutely, of B and delta relatively.
ARC_FLOOR, LOAD_FLOOR, DISTANCE_FLOOR = 5e-4, 1e-4, 1e-4

#: The same of A* and B*, relatively.
SLIP_ARC_FLOOR, SLIP_LOAD_FLOOR = 5e-4, 2e-4


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
    slip_arc, slip_load : ndarray, shape (points,), optional
        A* and B* [-]; data sets from before they were recorded have none.
    slip_arc_std, slip_load_std : ndarray, shape (points,), optional
        Their standard errors, relative [-].
    """

    alpha: Floats
    g: Floats
    arc: Floats
    normal_load: Floats
    distance: Floats
    arc_std: Floats
    normal_load_std: Floats
    distance_std: Floats
    slip_arc: Floats | None = None
    slip_load: Floats | None = None
    slip_arc_std: Floats | None = None
    slip_load_std: Floats | None = None

    def __len__(self) -> int:
        return len(self.alpha)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the quantities that there are."""
        return QUANTITIES if self.slip_arc is None else QUANTITIES + SLIP_QUANTITIES

    def relative_std(self, name: str) -> Floats:
        """Return the relative standard errors of a quantity [-]."""
        std: Floats = getattr(self, f"{name}_std")
        return std / self.arc if name == "arc" else std

    def taken(self, chosen: Any) -> FitPoints:
        """Return some of the points, by a mask, a slice or indices."""
        columns = {field.name: getattr(self, field.name) for field in fields(self)}
        some = {name: each[chosen] for name, each in columns.items() if each is not None}
        return FitPoints(**some)


def points_of(campaign: Campaign, single_mesh: bool = False, truncated: float = 0.0) -> FitPoints:
    """Return the points of a campaign that may be used.

    Parameters
    ----------
    campaign : Campaign
        The data set.
    single_mesh : bool, default False
        Whether to take points that only one mesh level has reached as well, with errors that
        nobody measured: for trying out a fit before the campaign is complete.
    truncated : float, default 0
        Relative error up to which points are taken as well whose B the finite body takes off, with
        that error in their standard errors [-]: to judge how models are continued, not to fit.

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
    if truncated > 0.0:
        taken_off = np.char.startswith(points["reason"].astype(str), _TRUNCATED)
        use = use | (taken_off & (points["truncation_error"] <= truncated))
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
        **_slip(columns, truncation),
    )
    return found.taken(np.lexsort((found.g, found.alpha)))


def _slip(columns: Mapping[str, Any], truncation: Floats) -> dict[str, Floats]:
    """Return A* and B* and their errors, where the data set has them."""
    if "slip_arc" not in columns:
        return {}
    load = _at_least(columns["slip_load_error"], SLIP_LOAD_FLOOR, 1e-3)
    return {
        "slip_arc": columns["slip_arc"],
        "slip_load": columns["slip_load"],
        "slip_arc_std": _at_least(columns["slip_arc_error"], SLIP_ARC_FLOOR, 2e-3),
        "slip_load_std": np.hypot(load, truncation),
    }


def _at_least(errors: Floats, floor: float, unknown: float) -> Floats:
    return np.maximum(np.where(np.isnan(errors), unknown, errors), floor)

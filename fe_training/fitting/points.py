"""The points that surrogates are fitted to: A, B, delta, A* and B* over (alpha, g) with errors."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from surrogate.contact.coordinates import LOADS, QUANTITIES, SLIP_QUANTITIES
from surrogate.errors import InputError

if TYPE_CHECKING:
    from fe_training.campaign.dataset import Campaign, Table

__all__ = ["FitPoints", "points_of"]

Floats = NDArray[np.float64]

_ONE_LEVEL = "only one mesh level was reached"
_DOUBTS = ("B is truncated by the finite body", "|J - 2 F_h|/J is above its bound")

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
    truncation : ndarray, shape (points,), optional
        What the finite body may take off B and B*, relative, which their standard errors have in
        them [-].
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
    truncation: Floats | None = None

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

    def mesh_variance(self, name: str) -> Floats:
        """Return the squares of the relative differences between the meshes of a quantity [-]."""
        square = self.relative_std(name) ** 2
        if self.truncation is None or name not in LOADS:
            return square
        return np.maximum(square - self.truncation**2, LOAD_FLOOR**2)

    @property
    def truncation_rate(self) -> float:
        """What the finite body does to B and B*, relative to sqrt(g) [-].

        Half the upper bound that the points have with them: bodies a hundred times as large gave
        0.3 to 0.5 of the bound between g = 0.5 and 200, and less outside.
        """
        if self.truncation is None:
            return 0.0
        return float(0.5 * np.median(self.truncation / np.sqrt(self.g)))

    def taken(self, chosen: Any) -> FitPoints:
        """Return some of the points, by a mask, a slice or indices."""
        columns = {field.name: getattr(self, field.name) for field in fields(self)}
        some = {name: each[chosen] for name, each in columns.items() if each is not None}
        return FitPoints(**some)


def points_of(campaign: Campaign, single_mesh: bool = False, doubtful: float = 0.0) -> FitPoints:
    """Return the points of a campaign that may be used.

    Parameters
    ----------
    campaign : Campaign
        The data set.
    single_mesh : bool, default False
        Whether to take points that only one mesh level has reached as well, with errors that
        nobody measured: for trying out a fit before the campaign is complete.
    doubtful : float, default 0
        Up to which share points are taken as well off whose B the finite body takes that much, or
        where J differs from 2 F_h by that much, with both in their standard errors [-]: to judge
        models, not to fit them.

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
    if doubtful > 0.0:
        use = use | _hardly_doubted(points, doubtful)
    if not use.any():
        raise InputError(
            "no point of the data set is within the bounds of its evidence, so there is nothing "
            "to fit; finish the campaign first."
        )
    columns = {name: np.asarray(values)[use] for name, values in points.columns.items()}
    truncation = columns["truncation_error"]
    if doubtful > 0.0:  # J, and so g, is known to that share only
        truncation = np.hypot(truncation, np.abs(columns["force_mismatch"]))
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
        truncation=truncation,
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


def _hardly_doubted(points: Table, share: float) -> NDArray[np.bool_]:
    """Return which points are doubted for nothing but truncation and J, each up to a share."""
    sizes = points["truncation_error"], np.abs(points["force_mismatch"])
    small: NDArray[np.bool_] = np.maximum(*sizes) <= share
    alone = [
        all(part.startswith(_DOUBTS) for part in str(reason).split("; "))
        for reason in points["reason"].astype(str)
    ]
    return np.logical_and(small, alone)


def _at_least(errors: Floats, floor: float, unknown: float) -> Floats:
    return np.maximum(np.where(np.isnan(errors), unknown, errors), floor)

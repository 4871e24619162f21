"""Whether points belong on a map: what it fixes must be theirs, or its regimes are not."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from surrogate.errors import InputError
from surrogate.maps.axes import COORDINATES, Coordinate

if TYPE_CHECKING:
    from surrogate.maps.points import MapPoints
    from surrogate.maps.record import MapRecord

__all__ = ["SAME", "require_the_same"]

SAME = 0.05
"""By how much a point may differ from what its map fixes: a node of some decades [-]."""


def require_the_same(points: MapPoints, made: MapRecord) -> None:
    """Refuse points of which a quantity or group is not what the map fixes.

    Parameters
    ----------
    points : MapPoints
        What is to be drawn.
    made : MapRecord
        The map.

    Raises
    ------
    InputError
        If what the map fixes differs by more than `SAME` and by more than two of the points'
        standard errors.
    """
    for name, fixed in made.fixed.items():
        group = COORDINATES[name]
        with np.errstate(all="ignore"):
            value = _value(points, group)
            allowed = np.fmax(SAME, 2.0 * _relative_std(points, group)) * fixed
            off = ~((np.abs(value - fixed) <= allowed) | np.equal(value, fixed))
        if np.any(off):
            unit = f" {group.unit}" if group.unit else ""
            other = np.ravel(np.broadcast_to(value, np.shape(off)))[np.argmax(np.ravel(off))]
            raise InputError(
                f"{points.label} must be of what the map is drawn for, but its {group.words} is "
                f"{other:.4g}{unit} where the map fixes {fixed:.4g}{unit}; draw the map for it, or "
                "leave the points out."
            )


def _value(points: MapPoints, group: Coordinate) -> Any:
    value: Any = 1.0
    for quantity, power in group.powers.items():
        value = value * np.power(getattr(points.scene, quantity), float(power))
    return value


def _relative_std(points: MapPoints, group: Coordinate) -> Any:
    """Return the relative standard error of a quantity or group, to first order."""
    variance: Any = 0.0
    for quantity, power in group.powers.items():
        std = np.asarray(points.std.get(quantity, 0.0))
        relative = np.divide(power * std, getattr(points.scene, quantity))
        variance = variance + np.where(std == 0.0, 0.0, relative**2)
    return np.sqrt(variance)

"""Materials and experiments to be drawn on a regime map, with their uncertainty."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from surrogate.basics.checks import Quantity, broadcast_shape, mapping, shown, text
from surrogate.basics.records import ReadOnly
from surrogate.errors import InputError
from surrogate.scene import NAMES, QUANTITIES, Scene, require_scene

if TYPE_CHECKING:
    from surrogate.maps.axes import MapAxis
    from surrogate.maps.record import MapRecord

__all__ = ["MapPoints", "places"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class MapPoints:
    """A material or an experiment that `plot_regime_map` draws.

    Parameters
    ----------
    scene : Scene
        What was cut, one point for each wire.
    label : str
        Its name in the legend.
    std : mapping of str to array_like, optional
        Standard errors of the scene's quantities by their names, in the unit of each [SI]. They
        become error bars to first order, as errors that do not depend on each other.

    Raises
    ------
    InputError
        If `scene` is no `Scene`, `label` no text, `std` no mapping, or an error is not that of one
        of its quantities, negative or no number.

    Examples
    --------
    >>> gel = Scene(685.0, 1.6, [0.125e-3, 0.470e-3], wear_strength=7750.0)
    >>> MapPoints(gel, "PAAm", std={"shear_modulus": 30.0}).label
    'PAAm'
    """

    scene: Scene
    label: str
    std: Mapping[str, ArrayLike] = field(default_factory=dict)

    def __post_init__(self) -> None:
        require_scene(self.scene, "the scene of map points")
        text("the label of map points", self.label, "give the name in the legend")
        checked = {}
        for name, value in mapping("std", self.std, "{'toughness': 0.2}").items():
            if name not in NAMES:
                raise InputError(
                    f"std must name quantities of the scene, but names {shown(name)}; choose "
                    f"from {', '.join(NAMES)}."
                )
            unit = QUANTITIES[NAMES.index(name)].unit
            error = Quantity(f"standard error of {name}", unit, "give the standard error")
            checked[name] = error.checked(value)
            broadcast_shape((error.name, *NAMES), (checked[name], *self.scene.values()))
        object.__setattr__(self, "std", ReadOnly(checked))


def places(points: MapPoints, made: MapRecord) -> tuple[Array, Array]:
    """Return places and standard errors on a map, each of shape (2, points) [units of its axes].

    Raises
    ------
    InputError
        If a point is outside the map.
    """
    found, errors = [], []
    for axis, value in zip((made.x, made.y), made.locate(points.scene), strict=True):
        variance: Any = 0.0
        for name, power in axis.coordinate.powers.items():
            std = np.asarray(points.std.get(name, 0.0))
            with np.errstate(all="ignore"):
                relative = np.divide(power * std, getattr(points.scene, name))
            variance = variance + np.where(std == 0.0, 0.0, relative**2)
        found.append(value)
        errors.append(value * np.sqrt(variance))
    arrays = [np.ravel(each) for each in np.broadcast_arrays(*found, *errors)]
    for axis, values in zip((made.x, made.y), arrays, strict=False):
        _require_inside(points.label, axis, values)
    return np.array(arrays[:2]), np.array(arrays[2:])


def _require_inside(label: str, axis: MapAxis, values: Array) -> None:
    low, high = axis.values[0], axis.values[-1]
    outside = values[~((values >= low) & (values <= high))]
    if outside.size:
        unit = f" {axis.unit}" if axis.unit else ""
        raise InputError(
            f"{label} must be on the map, but {axis.name} = {outside[0]:.4g}{unit} is outside "
            f"{low:.4g} to {high:.4g}{unit}; widen the map's range, or leave the point out."
        )

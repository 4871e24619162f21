"""Materials and experiments to be drawn on a regime map, with their uncertainty."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from surrogate.basics.checks import Quantity, broadcast_shape, mapping, shown, text
from surrogate.basics.records import ReadOnly
from surrogate.choosing.by_name import AUTO
from surrogate.choosing.laws import LAWS
from surrogate.cutting.uncertainty import correlation_matrix
from surrogate.errors import InputError
from surrogate.scene import NAMES, QUANTITIES, Scene, require_scene

if TYPE_CHECKING:
    from surrogate.identification.fit import Identification
    from surrogate.maps.axes import Coordinate, MapAxis
    from surrogate.maps.record import MapRecord

__all__ = ["MapPoints", "places", "relative_std", "value_of"]

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
        become error bars to first order.
    correlation : mapping of (str, str) to float, optional
        Correlation of the errors of pairs of these quantities [-]; 0 for those left out.
    law : str, optional
        The law of dissipation that the wear strength was identified by, "projected" or "slip": a
        map of the other refuses it; by default that of the scene. None where it belongs to any.

    Raises
    ------
    InputError
        If `scene` is no `Scene`, `label` no text, `std` no mapping, an error is not that of one
        of its quantities, negative or no number, the correlations contradict each other, or there
        is no such law.

    Examples
    --------
    >>> gel = Scene(685.0, 1.6, [0.125e-3, 0.470e-3], wear_strength=7750.0)
    >>> MapPoints(gel, "PAAm", std={"shear_modulus": 30.0}).label
    'PAAm'
    """

    scene: Scene
    label: str
    std: Mapping[str, ArrayLike] = field(default_factory=dict)
    correlation: Mapping[tuple[str, str], float] = field(default_factory=dict)
    law: str | None = None

    @classmethod
    def from_identification(
        cls, identification: Identification, label: str = "identified", mode: int = 0
    ) -> MapPoints:
        """Return the cuts of an identification as points, with the errors of what it found.

        Toughness and wear strength are the identified ones, with their standard errors and how
        these go together with each other and with those stated of mu, xi and alpha.

        Parameters
        ----------
        identification : Identification
            What `identify` returned.
        label : str, default "identified"
            Its name in the legend; what the bars do not show is added to it.
        mode : int, default 0
            Which of the materials that the forces admit, counted as in `profile.modes` [-]; 0 is
            the estimate.

        Returns
        -------
        MapPoints
            One point for each different wire [m].

        Raises
        ------
        InputError
            If `identification` is none or says that its numbers should not be used, knows no
            shear modulus, or does not admit that material.

        Examples
        --------
        >>> from surrogate import identify
        >>> fit = identify([1e-4, 2e-4, 4e-4, 5e-4], [4.7, 7.9, 13.9, 17.2], 685.0, model="eq13")
        >>> points = MapPoints.from_identification(fit, "my gel")
        >>> points.scene.wire_radius.tolist()
        [0.0001, 0.0002, 0.0004, 0.0005]
        >>> print(f"{points.std['toughness']:.3f} J/m2, {points.std['wear_strength']:.0f} Pa")
        0.126 J/m2, 93 Pa
        """
        from surrogate.maps.identified import identified_scene

        text("the label of map points", label, "give the name in the legend")
        scene, std, correlation, remark = identified_scene(identification, mode)
        return cls(scene, f"{label}{remark}", std, correlation, identification.law)

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
        correlation_matrix(list(checked), self.correlation)
        if self.law is None:
            object.__setattr__(self, "law", self.scene.law)
        if self.law is not None and self.law not in (*LAWS, AUTO):
            raise InputError(
                f"the law of map points must be one of {', '.join(LAWS)}, {AUTO}, or None, but is "
                f"{shown(self.law)}; choose one."
            )
        object.__setattr__(self, "std", ReadOnly(checked))
        object.__setattr__(self, "correlation", ReadOnly(self.correlation))


def places(points: MapPoints, made: MapRecord) -> tuple[Array, Array]:
    """Return places and standard errors on a map, each of shape (2, points) [units of its axes].

    Raises
    ------
    InputError
        If a point is outside the map.
    """
    values = made.locate(points.scene)
    axes = (made.x, made.y)
    errors = [
        value * relative_std(points, axis.coordinate)
        for axis, value in zip(axes, values, strict=True)
    ]
    arrays = [np.ravel(one) for one in np.broadcast_arrays(*values, *errors)]
    for axis, ravelled in zip(axes, arrays, strict=False):
        _require_inside(points.label, axis, ravelled)
    return np.array(arrays[:2]), np.array(arrays[2:])


def value_of(points: MapPoints, group: Coordinate) -> Any:
    """Return a quantity or group of points [SI]."""
    value: Any = 1.0
    for quantity, power in group.powers.items():
        value = value * np.power(getattr(points.scene, quantity), float(power))
    return value


def relative_std(points: MapPoints, group: Coordinate) -> Any:
    """Return the relative standard error of a quantity or group, to first order [-]."""
    names = [name for name in group.powers if name in points.std]
    rho = correlation_matrix(list(points.std), points.correlation)
    variance: Any = 0.0
    parts = [_relative(points, name, group.powers[name]) for name in names]
    places_of = [list(points.std).index(name) for name in names]
    for i, one in zip(places_of, parts, strict=True):
        for j, other in zip(places_of, parts, strict=True):
            if rho[i, j] != 0.0:
                variance = variance + rho[i, j] * one * other
    return np.sqrt(np.maximum(variance, 0.0))


def _relative(points: MapPoints, name: str, power: int) -> Any:
    std = np.asarray(points.std[name])
    with np.errstate(all="ignore"):
        relative = np.divide(power * std, getattr(points.scene, name))
    return np.where(std == 0.0, 0.0, relative)


def _require_inside(label: str, axis: MapAxis, values: Array) -> None:
    low, high = axis.values[0], axis.values[-1]
    outside = values[~((values >= low) & (values <= high))]
    if outside.size:
        unit = f" {axis.unit}" if axis.unit else ""
        raise InputError(
            f"{label} must be on the map, but {axis.name} = {outside[0]:.4g}{unit} is outside "
            f"{low:.4g} to {high:.4g}{unit}; widen the map's range, or leave the point out."
        )

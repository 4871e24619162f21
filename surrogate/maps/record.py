"""The numbers of a regime map, and where a scene is on it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from surrogate.basics.elementwise import ratio
from surrogate.choosing.laws import AnyLaw
from surrogate.contact.base import ForceModel
from surrogate.cutting.force import CuttingForce, force_of
from surrogate.cutting.regimes import Regime
from surrogate.errors import InputError
from surrogate.maps.axes import MapAxis
from surrogate.maps.lines import Boundary
from surrogate.maps.scenes import Monomial
from surrogate.reading.plausibility import SCENE, doubts_of_scene
from surrogate.scene import NAMES, Scene, require_scene

__all__ = ["MapRecord", "relative_difference", "scene_of"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class MapRecord:
    """The numbers of a regime map; its subclass `RegimeMap` documents the fields."""

    x: MapAxis
    y: MapAxis
    fixed: Mapping[str, float]
    model: str | ForceModel | AnyLaw
    units: tuple[str, ...]
    scene: Scene
    force: CuttingForce
    regime: Regime
    term_shares: Mapping[str, Array]
    miss: float
    boundaries: tuple[Boundary, ...]
    quantities: Mapping[str, Monomial]

    @property
    def force_unit(self) -> str:
        """Unit of the forces: N/m, or products of the quantities that are the map's units."""
        if not self.units:
            return "N/m"
        stress = "mu" if "shear_modulus" in self.units else "Pa"
        return f"{stress} {'R_w' if 'wire_radius' in self.units else 'm'}"

    @property
    def cleavage_share(self) -> Array:
        """Share of the cleavage toughness in the force [-]; nan where the force is 0."""
        return self._share(self.force.cleavage)

    @property
    def friction_share(self) -> Array:
        """Share of friction in the force [-]; nan where the force is 0."""
        return self._share(self.force.friction)

    @property
    def wear_share(self) -> Array:
        """Share of wear in the force [-]; nan where the force is 0."""
        return self._share(self.force.wear)

    @property
    def relative_force(self) -> Array:
        """F_ss/(Gamma_o T) [-]; infinite where the toughness is 0."""
        with np.errstate(all="ignore"):
            return ratio(self.force.total, np.asarray(self.scene.toughness))  # type: ignore[no-any-return]

    def _share(self, part: Any) -> Array:
        with np.errstate(all="ignore"):
            return ratio(part, np.asarray(self.force.total))  # type: ignore[no-any-return]

    def scene_at(self, x: ArrayLike, y: ArrayLike) -> Scene:
        """Return what is cut at places of the map [units of its axes].

        Raises
        ------
        InputError
            If a place is no admissible value of its coordinate.
        """
        places = [
            axis.coordinate.quantity.checked(value) for axis, value in ((self.x, x), (self.y, y))
        ]
        return scene_of(self.quantities, *places)

    def locate(self, scene: Scene) -> tuple[Any, Any]:
        """Return the places x and y of a scene on the map [units of its axes]; nan where none is.

        Only the two coordinates are looked at, not whether the scene has what the map holds fixed.

        Raises
        ------
        InputError
            If `scene` is not a `Scene`.
        """
        require_scene(scene)
        places = []
        for axis in (self.x, self.y):
            value: Any = 1.0
            with np.errstate(all="ignore"):
                for name, power in axis.coordinate.powers.items():
                    value = value * np.power(getattr(scene, name), float(power))
            places.append(value)
        return places[0], places[1]

    @property
    def warnings(self) -> tuple[str, ...]:
        """What can hardly be meant among what is fixed, or is all along an axis, in words."""
        known: dict[str, Any] = dict(self.fixed)
        for axis in (self.x, self.y):
            if axis.name in NAMES[: len(SCENE)]:
                quantity = SCENE[NAMES.index(axis.name)]
                low, high = axis.values[0], axis.values[-1]
                if low > quantity.high or high < quantity.low:
                    known[axis.name] = axis.values[[0, -1]]
        return tuple(doubts_of_scene([known.get(name) for name in NAMES[: len(SCENE)]]))

    def difference(self, model: str) -> Array:
        """Return how far another model is from the map's, F/F_map - 1 [-], at each node.

        Raises
        ------
        UnknownModelError
            If there is no such model.
        DomainError
            If it has no answer at a node.
        """
        other = force_of(self.scene, model, extrapolate=True)
        return relative_difference(other.total, self.force.total)


def relative_difference(one: Any, other: Any) -> Array:
    """Return one/other - 1; nan where both are 0 or infinite."""
    with np.errstate(all="ignore"):
        return np.asarray(np.divide(one, other) - 1.0)


def scene_of(quantities: Mapping[str, Monomial], x: Any, y: Any) -> Scene:
    """Return the scene at places of a map; what is solved for is neither 0 nor infinite."""
    axes = Monomial(1.0, 1, 0), Monomial(1.0, 0, 1)
    values = {name: quantities[name](x, y) for name in NAMES}
    for name, one in quantities.items():
        solved = (one.p or one.q) and one not in axes
        if solved and not (np.all(np.isfinite(values[name])) and np.all(values[name] > 0.0)):
            raise InputError(
                f"{name} must be positive and finite all over the map, but what is given makes it "
                "leave the range of numbers; narrow the ranges, or begin above 0."
            )
    return Scene(**values)

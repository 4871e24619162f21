"""The scenes of a regime map: every quantity as a function of the map's two coordinates.

Every coordinate is a product of powers of the scene's six quantities, so each quantity of a map's
scenes is c x^p y^q in the map's coordinates x and y. What a map does not give is solved for: with
g, mu and R_w, for instance, Gamma_o follows. Where only dimensionless groups are given, mu and R_w
serve as units.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from surrogate.errors import InputError
from surrogate.maps.axes import COORDINATES, Coordinate
from surrogate.scene import NAMES

__all__ = ["Monomial", "resolve"]

MU, GAMMA, RADIUS, XI, WEAR, ALPHA = NAMES

DIMENSIONS = {MU: (1, 0), GAMMA: (1, 1), RADIUS: (0, 1), WEAR: (1, 0)}
"""Powers of a stress and of a length in what has a dimension."""

DEFAULTS = {XI: 0.0, WEAR: 0.0, ALPHA: 2.0}
"""What a map takes for quantities that nothing given depends on, as `Scene` does."""

UNITS = (MU, RADIUS)
"""What is 1 where a map gives dimensionless groups only."""


@dataclass(frozen=True)
class Monomial:
    """A number times powers of the coordinates of a map, factor x^p y^q.

    Examples
    --------
    >>> one = Monomial(2.0, 1, 0) * Monomial(3.0, 0, -1)
    >>> one, float(one(5.0, 10.0))
    (Monomial(factor=6.0, p=1, q=-1), 3.0)
    """

    factor: float
    p: int = 0
    q: int = 0

    def __mul__(self, other: Monomial) -> Monomial:
        return Monomial(self.factor * other.factor, self.p + other.p, self.q + other.q)

    def __pow__(self, power: int) -> Monomial:
        with np.errstate(all="ignore"):
            factor = float(np.float64(self.factor) ** power)
        return Monomial(factor, power * self.p, power * self.q)

    def __call__(self, x: Any, y: Any) -> Any:
        """Return its value; plain x where that is what it is."""
        value = self.factor
        with np.errstate(all="ignore"):
            for power, base in ((self.p, x), (self.q, y)):
                if power:
                    value = value * np.power(base, float(power))
        return value


def resolve(
    x: str, y: str, fixed: Mapping[str, float]
) -> tuple[dict[str, Monomial], tuple[str, ...]]:
    """Return the scene's quantities as functions of x and y, and which of them are mere units.

    Parameters
    ----------
    x, y : str
        Names of the axes' coordinates.
    fixed : mapping of str to float
        What else is given, quantities and groups.

    Returns
    -------
    quantities : dict of str to Monomial
        The six quantities of the scene.
    units : tuple of str
        Those that were set to 1 because only dimensionless groups are given.

    Raises
    ------
    InputError
        If something is given twice, is missing, or cannot be solved for.

    Examples
    --------
    >>> quantities, units = resolve("wire_radius", "g", {"shear_modulus": 685.0})
    >>> quantities["toughness"]
    Monomial(factor=685.0, p=1, q=1)
    """
    given = {x: Monomial(1.0, 1, 0), y: Monomial(1.0, 0, 1)}
    if x == y:
        raise InputError(f"a map needs two different axes, but both are {x}; choose another.")
    for name, value in fixed.items():
        if name in given:
            raise InputError(f"{name} must be given once, but is an axis and fixed; drop one.")
        given[name] = Monomial(value)
    known = {name: given.pop(name) for name in NAMES if name in given}
    groups = {COORDINATES[name]: value for name, value in given.items()}
    _solve(groups, known)
    units = _choose_units(groups, known)
    touched = {name for group in groups for name in group.powers}
    for name, value in DEFAULTS.items():
        if name not in touched:
            known.setdefault(name, Monomial(value))
    if missing := [name for name in NAMES if name not in known]:
        raise InputError(
            f"a map over {x} and {y} must have all quantities of a scene, but lacks "
            f"{' and '.join(missing)}; give it in fixed, or a group that it belongs to."
        )
    return known, units


def _solve(groups: dict[Coordinate, Monomial], known: dict[str, Monomial]) -> None:
    """Move to `known` what groups with one unknown determine; drop those groups."""
    progress = True
    while progress:
        progress = False
        for group in list(groups):
            unknown = [name for name in group.powers if name not in known]
            if not unknown:
                raise InputError(
                    f"{group.name} must be free, but follows from what else is given; "
                    f"drop it, or one of {', '.join(group.powers)}."
                )
            if len(unknown) == 1:
                known[unknown[0]] = _solved(group, unknown[0], groups.pop(group), known)
                progress = True


def _solved(
    group: Coordinate, name: str, value: Monomial, known: Mapping[str, Monomial]
) -> Monomial:
    """Return the one unknown quantity of a group."""
    for other, power in group.powers.items():
        if other != name:
            if known[other].factor == 0.0:
                raise InputError(
                    f"{other} must be positive where {group.name} is given, but is 0; give a "
                    f"positive {other}, or {name} instead of {group.name}."
                )
            value = value * known[other] ** -power
    return value if group.powers[name] == 1 else value**-1


def _choose_units(
    groups: dict[Coordinate, Monomial], known: dict[str, Monomial]
) -> tuple[str, ...]:
    """Set to 1 what only sets the scale of stress or length, and solve for what follows."""
    units = []
    scaled = [name for name in known if name in DIMENSIONS and known[name].factor != 0.0]
    dimensions = [DIMENSIONS[name] for name in scaled]
    for name in UNITS:
        if name in known:
            continue
        rank = np.linalg.matrix_rank(dimensions) if dimensions else 0
        if np.linalg.matrix_rank([*dimensions, DIMENSIONS[name]]) > rank:
            units.append(name)
            dimensions.append(DIMENSIONS[name])
            known[name] = Monomial(1.0)
            _solve(groups, known)
    return tuple(units)

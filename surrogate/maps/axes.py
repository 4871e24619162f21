"""Axes of a regime map: the quantities and groups that can be varied."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from surrogate.basics.checks import SMALLEST, Quantity, one_number, shown
from surrogate.basics.records import ReadOnly, Record
from surrogate.errors import InputError
from surrogate.scene import NAMES, QUANTITIES

__all__ = ["COORDINATES", "Coordinate", "MapAxis", "coordinate", "map_axis"]

MU, GAMMA, RADIUS, XI, WEAR, ALPHA = NAMES


@dataclass(frozen=True, eq=False)
class Coordinate:
    """A quantity or dimensionless group that a map can be drawn over.

    Parameters
    ----------
    quantity : Quantity
        Name, unit and admissible range.
    symbol : str
        As matplotlib's mathematical text, without the dollars.
    words : str
        What it is.
    powers : mapping of str to int
        Of the scene's quantities that it is the product of.
    """

    quantity: Quantity
    symbol: str
    words: str
    powers: Mapping[str, int]

    @property
    def name(self) -> str:
        """Name, as `regime_map` takes it."""
        return self.quantity.name

    @property
    def unit(self) -> str:
        """Unit in the SI; empty for a group."""
        return self.quantity.unit


def _coordinates() -> Mapping[str, Coordinate]:
    symbols = (
        (MU, r"\mu", "shear modulus"),
        (GAMMA, r"\Gamma_o", "cleavage toughness"),
        (RADIUS, "R_w", "wire radius"),
        (XI, r"\xi", "friction coefficient"),
        (WEAR, r"\tau_w", "wear strength"),
        (ALPHA, r"\alpha", "stiffening exponent"),
    )
    found = [
        Coordinate(quantity, symbol, words, ReadOnly({name: 1}))
        for quantity, (name, symbol, words) in zip(QUANTITIES, symbols, strict=True)
    ]
    for name, symbol, words, powers in (
        ("g", r"\Gamma_o/(\mu R_w)", "toughness", {GAMMA: 1, MU: -1, RADIUS: -1}),
        ("R_w/l_e", "R_w/l_e", "radius over elasto-cohesive length", {RADIUS: 1, MU: 1, GAMMA: -1}),
        ("R_w/l_w", "R_w/l_w", "radius over wear length", {RADIUS: 1, WEAR: 1, GAMMA: -1}),
        ("tau_w/mu", r"\tau_w/\mu", "wear over stiffness", {WEAR: 1, MU: -1}),
        ("tau_w/(xi mu)", r"\tau_w/(\xi\mu)", "wear over friction", {WEAR: 1, XI: -1, MU: -1}),
    ):
        quantity = Quantity(name, "", "give a positive number without unit", lower=SMALLEST)
        found.append(Coordinate(quantity, symbol, words, ReadOnly(powers)))
    return ReadOnly({one.name: one for one in found})


COORDINATES = _coordinates()
"""Every quantity and group that a map can be drawn over, by its name."""

_SHORT = {"mu": MU, "Gamma_o": GAMMA, "R_w": RADIUS, "xi": XI, "tau_w": WEAR, "alpha": ALPHA}


def coordinate(name: object) -> Coordinate:
    """Return the coordinate of that name, the paper's letters included.

    Raises
    ------
    InputError
        If there is none; the message lists those that there are.

    Examples
    --------
    >>> coordinate("R_w").name, coordinate("g").words
    ('wire_radius', 'toughness')
    """
    if isinstance(name, str) and (full := _SHORT.get(name, name)) in COORDINATES:
        return COORDINATES[full]
    raise InputError(
        f"a map's coordinate must be a quantity of the scene or a group, but is {shown(name)}; "
        f"choose one of {', '.join(COORDINATES)}."
    )


@dataclass(frozen=True, slots=True, eq=False)
class MapAxis(Record):
    """One axis of a map.

    Parameters
    ----------
    name : str
        Name of the coordinate, see `regime_map`.
    scale : str
        "log" or "linear": how the nodes are spaced.
    values : ndarray, shape (n,)
        The nodes, rising, in the unit of the coordinate [SI].

    Examples
    --------
    >>> axis = map_axis("wire_radius", (1e-5, 1e-3), "log", 3)
    >>> axis.label, axis.values.tolist()
    ('wire radius $R_w$ [m]', [1e-05, 0.0001, 0.001])
    """

    name: str
    scale: str
    values: NDArray[np.float64]

    @property
    def coordinate(self) -> Coordinate:
        """What the axis shows."""
        return COORDINATES[self.name]

    @property
    def unit(self) -> str:
        """Unit in the SI; empty for a group."""
        return self.coordinate.unit

    @property
    def label(self) -> str:
        """Words, symbol and unit, with the symbol as mathematical text."""
        one = self.coordinate
        unit = one.unit.replace("m^2", "m$^2$") or "-"
        return f"{one.words} ${one.symbol}$ [{unit}]"

    def to_scale(self, values: ArrayLike) -> NDArray[np.float64]:
        """Return places along the axis: logarithms where the scale is."""
        with np.errstate(all="ignore"):
            return np.log(values) if self.scale == "log" else np.asarray(values, dtype=float)

    def from_scale(self, places: ArrayLike) -> NDArray[np.float64]:
        """Return values from places along the axis, inside its ends."""
        with np.errstate(all="ignore"):
            values = np.exp(places) if self.scale == "log" else np.asarray(places, dtype=float)
        return np.clip(values, self.values[0], self.values[-1])


def map_axis(name: str, limits: object, scale: str, nodes: int) -> MapAxis:
    """Return an axis with evenly spaced nodes between two limits.

    Raises
    ------
    InputError
        If the limits are not two numbers that the coordinate may take, rising, far enough apart
        for the nodes and, on a log scale, positive; or if the scale is neither "log" nor "linear".
    """
    chosen = coordinate(name)
    if not isinstance(scale, str) or scale not in ("log", "linear"):
        raise InputError(
            f"the scale of {chosen.name} must be 'log' or 'linear', but is {shown(scale)}; "
            "choose one of them."
        )
    try:
        low, high = (one_number(chosen.quantity, value) for value in limits)  # type: ignore[attr-defined]
    except InputError:
        raise
    except (TypeError, ValueError):
        raise InputError(
            f"the range of {chosen.name} must be two numbers, but is {shown(limits)}; "
            "give the lowest and the highest value."
        ) from None
    if scale == "log" and low == 0.0:
        raise InputError(
            f"the range of {chosen.name} must be positive on a log scale, but begins at 0; "
            "begin above 0, or choose scale 'linear'."
        )
    with np.errstate(all="ignore"):
        spaced = np.geomspace if scale == "log" else np.linspace
        values = spaced(low, high, nodes) if low < high else np.empty(0)
    if not (values.size and np.all(np.isfinite(values)) and np.all(np.diff(values) > 0.0)):
        raise InputError(
            f"the range of {chosen.name} must rise and hold {nodes} different nodes, but is "
            f"{low!r} to {high!r}; give the lowest value first, and a wider range."
        )
    values[0], values[-1] = low, high
    values.flags.writeable = False
    return MapAxis(chosen.name, scale, values)

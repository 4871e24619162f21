"""Whether numbers can be those of cutting a soft solid with a wire, or a unit was mistaken.

The ranges are wide, so that no sound experiment is doubted. A slip by 1000 or more is caught for
every wire of 10 um to 1 mm. What they cannot tell: a diameter that is given as the radius, a force
that was not divided by the sample's thickness, and any other slip whose numbers are still sound.
Diameters for radii change neither the toughness nor the goodness of a fit without friction, but
halve the wear strength: name the column wire_diameter, and it is halved for you.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from surrogate.basics.checks import BELIEVABLE, LONGEST_COHESIVE

__all__ = [
    "COHESIVE_LENGTH",
    "FORCE",
    "FRICTION",
    "RADIUS",
    "SHEAR_MODULUS",
    "TOUGHNESS",
    "WEAR_STRENGTH",
    "WORK_OF_FRACTURE",
    "Plausible",
    "doubts",
    "doubts_of_scene",
]


@dataclass(frozen=True)
class Plausible:
    """The range in which a quantity can be believed, and the slips that lead out of it.

    Parameters
    ----------
    words : str
        What it is.
    unit : str
        Its unit.
    low, high : float
        Ends of the range, in that unit.
    slips : tuple of (float, str)
        Factors that undo a slip, and the slip in words; the likeliest first.
    """

    words: str
    unit: str
    low: float
    high: float
    slips: tuple[tuple[float, str], ...]


_MU, _GAMMA, _RADIUS, _XI, _TAU = BELIEVABLE

_STRESS_SLIPS = (
    (1e3, "kPa given as Pa"),
    (1e6, "MPa given as Pa"),
    (1e-3, "Pa given as kPa"),
    (1e-6, "Pa given as MPa"),
)
_ENERGY_SLIPS = ((1e3, "kJ/m^2 given as J/m^2"), (1e-3, "mJ/m^2 given as J/m^2"))

RADIUS = Plausible(
    "the wire radius",
    "m",
    *_RADIUS,
    (
        (1e-3, "mm given as m"),
        (1e-6, "um given as m"),
        (1e3, "m given as mm"),
        (1e6, "m given as um"),
    ),
)
"""From a third of a carbon fibre to a rod that is 2 cm thick."""

FORCE = Plausible(
    "the force per thickness",
    "N/m",
    1e-3,
    1e6,
    ((1e3, "kN/m given as N/m"), (1e-3, "mN/m given as N/m"), (1e-6, "uN/m given as N/m")),
)
"""From the weakest gels, whose toughness is some mJ/m^2, to 1 kN on a millimetre."""

SHEAR_MODULUS = Plausible("the shear modulus", "Pa", *_MU, _STRESS_SLIPS)
"""From what flows under its own weight to what is no rubber any more."""

TOUGHNESS = Plausible("the toughness", "J/m^2", *_GAMMA, _ENERGY_SLIPS)
"""From the weakest gels to ten times the toughest rubbers."""

WEAR_STRENGTH = Plausible("the wear strength", "Pa", *_TAU, _STRESS_SLIPS)
"""Up to more than the shear strength of the strongest plastics."""

FRICTION = Plausible("the friction coefficient", "", *_XI, ((1e-2, "percent given as a number"),))
"""Up to that of clean rubber on a dry and smooth wire."""

COHESIVE_LENGTH = Plausible(
    "the elasto-cohesive length Gamma_o/mu",
    "m",
    0.0,
    LONGEST_COHESIVE,
    ((1e-3, "a modulus in kPa given as Pa"), (1e-6, "a modulus in MPa given as Pa")),
)
"""Up to some times that of the toughest and softest rubbers."""

WORK_OF_FRACTURE = Plausible(
    "the work of fracture",
    "J/m^3",
    1.0,
    1e9,
    ((1e3, "kJ/m^3 given as J/m^3"), (1e6, "MJ/m^3 given as J/m^3")),
)
"""From the weakest gels to the toughest silks."""


def doubts(quantity: Plausible, values: Any) -> Iterator[str]:
    """Yield a sentence where numbers are outside the range in which they can be believed.

    Parameters
    ----------
    quantity : Plausible
        What they are.
    values : float or array_like
        The numbers, in its unit.

    Yields
    ------
    str
        The numbers, the range and the likely slip; nothing where all can be believed.

    Examples
    --------
    >>> for sentence in doubts(RADIUS, [0.125, 0.47]):
    ...     print(sentence)
    the wire radius (0.125 to 0.47 m) is hardly that of a soft solid's cut, which is from 1e-06 to \
0.01 m; likely mm given as m: check the unit
    >>> list(doubts(RADIUS, 0.125e-3))
    []
    """
    if not np.size(values):
        return
    smallest, largest = float(np.min(values)), float(np.max(values))
    if quantity.low <= smallest and largest <= quantity.high:
        return
    shown = f"{smallest:.4g}" if smallest == largest else f"{smallest:.4g} to {largest:.4g}"
    unit = f" {quantity.unit}" if quantity.unit else ""
    yield (
        f"{quantity.words} ({shown}{unit}) is hardly that of a soft solid's cut, "
        f"which is from {quantity.low:g} to {quantity.high:g}{unit}; "
        f"{_slip(quantity, smallest, largest)}check the unit"
    )


def _slip(quantity: Plausible, smallest: float, largest: float) -> str:
    """Return the likeliest slip that would explain all numbers."""
    for factor, words in quantity.slips:
        if quantity.low <= factor * smallest and factor * largest <= quantity.high:
            return f"likely {words}: "
    return ""


SCENE = (SHEAR_MODULUS, TOUGHNESS, RADIUS, FRICTION, WEAR_STRENGTH)
"""What the first five quantities of a scene are."""


def doubts_of_scene(values: Sequence[Any]) -> list[str]:
    """Return what can hardly be meant among the quantities of a scene, in words.

    Parameters
    ----------
    values : sequence of float or array_like
        Modulus, toughness, radius, friction and wear of a scene, in its order [SI]; what is 0
        neglects something and is not doubted, and None is not known.

    Examples
    --------
    >>> for sentence in doubts_of_scene((685.0, 1.6, 0.2e-3, 3.0, 0.0)):
    ...     print(sentence)
    the friction coefficient (3) is hardly that of a soft solid's cut, which is from 0 to 2; \
likely percent given as a number: check the unit
    """
    sentences: list[str] = []
    for quantity, value in zip(SCENE, values, strict=False):
        if value is not None:
            sentences += doubts(quantity, _not_zero(quantity, value))
    mu, gamma = values[:2]
    if not sentences and mu is not None and gamma is not None:
        with np.errstate(all="ignore"):
            length = np.where(np.equal(mu, 0.0), 0.0, np.divide(gamma, mu))
        sentences += doubts(COHESIVE_LENGTH, length)
    return sentences


def _not_zero(quantity: Plausible, value: Any) -> Any:
    """Return values with a believable one in place of 0."""
    return np.where(np.equal(value, 0.0), quantity.high, value)

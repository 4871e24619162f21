"""Maps that are often wanted, ready to draw."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

__all__ = ["PRESETS", "Preset"]


@dataclass(frozen=True)
class Preset:
    """What a map is drawn over.

    Parameters
    ----------
    words : str
        What it shows.
    x, y : str
        Coordinates.
    ranges : pair of pairs of float
        Of x and of y [SI].
    fixed : mapping of str to float
        What else is given [SI].
    example : bool
        Whether the shipped experiment belongs on it.
    """

    words: str
    x: str
    y: str
    ranges: tuple[tuple[float, float], tuple[float, float]]
    fixed: Mapping[str, float]
    example: bool = False


def _known(**values: float) -> Mapping[str, float]:
    return MappingProxyType(values)


PRESETS: Mapping[str, Preset] = MappingProxyType(
    {
        "lengths": Preset(
            "the wire's radius beside both lengths of the material, xi = 0.1",
            "R_w/l_e",
            "R_w/l_w",
            ((1e-4, 1e2), (1e-2, 1e2)),
            _known(friction_coefficient=0.1),
        ),
        "groups": Preset(
            "the groups of the finite-element problem and of its friction, xi = 0.1",
            "g",
            "tau_w/(xi mu)",
            ((1e-2, 1e2), (1e-2, 1e2)),
            _known(friction_coefficient=0.1),
        ),
        "friction": Preset(
            "friction beside toughness for a solid with tau_w = mu/10",
            "R_w/l_e",
            "friction_coefficient",
            ((1e-2, 1e2), (1e-2, 1e1)),
            MappingProxyType({"tau_w/mu": 0.1}),
        ),
        "gel": Preset(
            "wires and toughnesses for a gel with the stiffness and wear of the paper's",
            "wire_radius",
            "toughness",
            ((1e-5, 1e-2), (5e-2, 5e1)),
            _known(shear_modulus=685.0, wear_strength=7750.0),
            example=True,
        ),
    }
)
"""Every preset by its name."""

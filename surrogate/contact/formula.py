"""The model "power-law": formulas of six constants each for A, B, A* and B*, of four for delta.

With y = 1 - 2/alpha, which is 0 for a neo-Hookean solid, and A_w, B_w and delta_w of the far-field
wedge (`surrogate.contact.wedge`),

    A = (2/k) sin[k A_w(g_A)/2] {1 - d exp[-ln^2(g/g_d)/2]},   g_A = g/[1 + (g/s)^2]^(1/2),
    k^2 = 1 + a_1 (alpha^2 - 4),   ln s = a_2 + a_3 y,   d = a_4 (1 - y),   ln g_d = a_5 + a_6 y,

    B = B_w(g_B) + b g^n,   g_B = g/(1 + g/e^b_1),
    ln b = b_2 + b_3 y + b_4 y^2,   n = b_5 + b_6 y,

    A* and B* as B, with A_w in the place of B_w for A*,

    delta/R_w = 1 + delta_w [1 - (g/g_touch)^c]^q   short of the touch,
    c = c_1 + c_2 y,   q = c_3 + c_4 y.

As g goes to 0, A and B become those of the wedge; 2 sin(A_w/2) is the arc whose chord has the
width of the contact, and k lets a solid that stiffens be indented less deeply. As g grows, the
wedge saturates: A becomes constant, B the power law of Eq. (9). The dip of A between is that of
small alpha, where the tip wraps the wire.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.elementwise import exp, log, where
from surrogate.contact.domain import Domain
from surrogate.contact.fitted import PROJECTED, FittedModel
from surrogate.contact.wedge import wedge_functions, wedge_load, wedge_slopes

__all__ = ["BlendModel", "arc_formula", "distance_formula", "load_formula"]

Constants: TypeAlias = "Sequence[float] | NDArray[np.float64]"


@dataclass(frozen=True, eq=False)
class BlendModel(FittedModel):
    """The formula.

    Parameters
    ----------
    limits : Domain
        Its domain.
    constants : mapping of str to tuple of float
        a_1 to a_6 as "arc", b_1 to b_6 as "normal_load", c_1 to c_4 as "distance", and as many
        as b as "slip_arc" and "slip_load".
    """

    limits: Domain
    constants: Mapping[str, tuple[float, ...]]
    name: str = "power-law"
    equation: str = "asymptotes joined"
    law: str = PROJECTED

    @property
    def functions(self) -> tuple[str, ...]:  # type: ignore[override]
        """Names of the functions that `contact` takes."""
        return tuple(self.constants)

    def inside(self, names: Sequence[str], log_g: Any, log_alpha: Any, g: Any) -> list[Any]:
        return [self.inside_slopes(name, log_g, log_alpha)[0] for name in names]

    def inside_slopes(self, name: str, log_g: Any, log_alpha: Any) -> tuple[Any, Any, Any]:
        y = 1.0 - 2.0 * exp(-log_alpha)
        constants = self.constants[name]
        if name == "arc":
            value, in_g, in_y = arc_formula(constants, log_g, y)
        elif name != "distance":
            value, in_g, in_y = load_formula(constants, log_g, y, name)
        else:
            touch, bend = self.limits.log_touch_slopes(log_alpha)
            value, in_g, in_y, in_touch = distance_formula(constants, log_g, y, touch)
            return value, in_g, in_y * (1.0 - y) + in_touch * bend
        return value, in_g, in_y * (1.0 - y)  # dy/d ln alpha = 2/alpha


def arc_formula(a: Constants, log_g: Any, y: Any) -> tuple[Any, Any, Any]:
    """Return A and its derivatives by ln g and y."""
    at, left = _saturated(log_g, a[1] + a[2] * y, 2.0)
    alpha = 2.0 / (1.0 - y)
    k = _root(1.0 + a[0] * (alpha * alpha - 4.0))
    angle = 0.5 * k * _wedge("arc", at)
    sine = 2.0 * _sin(angle) / k
    swell = angle * _tan_inverse(angle)  # d ln sine/d ln angle
    in_at = swell * wedge_slopes(at)["arc"]
    in_k = (swell - 1.0) * 0.5 * a[0] * (alpha * alpha * alpha) / (k * k)
    depth, x = a[3] * (1.0 - y), log_g - (a[4] + a[5] * y)
    bell = exp(-0.5 * x * x)
    dip = 1.0 - depth * bell
    return (
        sine * dip,
        sine * (in_at * left * dip + depth * bell * x),
        sine * ((in_at * (1.0 - left) * a[2] + in_k) * dip + bell * (a[3] - depth * x * a[5])),
    )


def load_formula(
    b: Constants, log_g: Any, y: Any, name: str = "normal_load"
) -> tuple[Any, Any, Any]:
    """Return B, A* or B*, as named, and its derivatives by ln g and y."""
    at, left = _saturated(log_g, b[0], 1.0)
    far = _wedge(name, at)
    n = b[4] + b[5] * y
    power = exp(b[1] + y * (b[2] + y * b[3]) + n * log_g)
    return (
        far + power,
        far * wedge_slopes(at)[name] * left + n * power,
        power * (b[2] + 2.0 * b[3] * y + b[5] * log_g),
    )


def distance_formula(c: Constants, log_g: Any, y: Any, touch: Any) -> tuple[Any, Any, Any, Any]:
    """Return delta/R_w and its derivatives by ln g, y and ln g_touch."""
    power, root, x = c[0] + c[1] * y, c[2] + c[3] * y, log_g - touch
    rest = exp(power * where(x < 0.0, x, -1.0))
    short = (x < 0.0) & (rest < 1.0)  # nearer the gap is below rounding, and so is delta - 1
    x, rest = where(short, x, -1.0), where(short, rest, 0.5)
    left = 1.0 - rest
    gap = _wedge("distance", log_g) * exp(root * log(left))
    bend = root * rest / left
    in_g = wedge_slopes(log_g)["distance"] - bend * power
    in_y = c[3] * log(left) - bend * c[1] * x
    return (
        where(short, 1.0 + gap, 1.0),
        where(short, gap * in_g, 0.0),
        where(short, gap * in_y, 0.0),
        where(short, gap * bend * power, 0.0),
    )


def _saturated(log_g: Any, log_end: Any, power: float) -> tuple[Any, Any]:
    """Return ln of g/[1 + (g/end)^power]^(1/power) and its derivative by ln g."""
    left = 1.0 / (1.0 + exp(power * (log_g - log_end)))
    return log_g + log(left) / power, left


def _wedge(name: str, log_g: Any) -> Any:
    return wedge_functions(log_g, wedge_load(log_g))[name]


def _root(x: Any) -> Any:
    return np.sqrt(x) if isinstance(x, np.ndarray) else float(np.sqrt(x))


def _sin(x: Any) -> Any:
    return np.sin(x) if isinstance(x, np.ndarray) else float(np.sin(x))


def _tan_inverse(x: Any) -> Any:
    return 1.0 / (np.tan(x) if isinstance(x, np.ndarray) else float(np.tan(x)))

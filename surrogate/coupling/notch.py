"""How slip arc and slip load depend on the size of the crack's tip, where it touches the wire.

Close to a sharp tip the face is stretched as lambda ~ x^(-1/alpha) at the distance x, so that what
a tip of radius r adds to the slip arc is

    dA*/d ln(1/r) = lambda^2 x = K(alpha) g^q r^(1-q),   q = 2/alpha, r in wire radii,

with K = 1/pi for alpha = 2, where A* grows without end as the tip becomes sharper. Above, K is
fitted, as a notch is no sharp tip. The slip there is under the pressure that the contact ends with,

    dB*/d ln(1/r) = P dA*/d ln(1/r),   P/mu = g a tanh[(ln(g/g_touch) - c (alpha - 2))/b],

also fitted. Integrated from the radius of the finite elements' notch to that of the tip, these are
what the tip adds to A* and B*.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from surrogate.contact.coordinates import log_touch, log_touch_slope

__all__ = ["ALPHA", "NEAR", "NotchSlip"]

ALPHA = 2.0
"""Where the stretch of a tip grows as a root, and its slip without end."""

NEAR = 1.05
"""From this times g_touch on the tip touches the wire for certain."""


@dataclass(frozen=True, eq=False)
class NotchSlip:
    """What a tip of another radius than the notch of the finite elements adds to A* and B*.

    Parameters
    ----------
    radius : float
        That of the notch which A* and B* are of [R_w].
    stretch : sequence of float
        K less 1/pi, by the powers of alpha - 2 from the first on.
    pressure : tuple of float
        a, b and c.
    touch : sequence of float
        Coefficients of ln g_touch in powers of ln alpha.
    alpha : float
        The highest alpha at which this is known, from 2 on.
    highest_g : float
        The highest g.
    most : float
        The largest g r: beyond, the opened tip is no small part of the wire.
    radii : sequence of float
        The smallest radius at which this is known [R_w], and the ends of the steps of the errors.
    errors : mapping of str to sequence of pairs of float
        By model, bounds of the relative errors of A* and B* in each step.

    Examples
    --------
    >>> fitted = (-0.3,), (0.57, 0.54, 0.27), (0.5,)
    >>> tip = NotchSlip(5e-4, *fitted, 2.5, 100.0, 0.3, (1e-4, 1e-2), {"table": ((0.01, 0.02),)})
    >>> arc, load = tip.added(10.0, 2.0, 5e-4 / np.e)
    >>> print(f"{np.pi * arc:.3f}")  # g, as the tip is sharper by the factor e
    10.000
    """

    radius: float
    stretch: Sequence[float]
    pressure: tuple[float, float, float]
    touch: Sequence[float]
    alpha: float
    highest_g: float
    most: float
    radii: Sequence[float]
    errors: Mapping[str, Sequence[Sequence[float]]]

    def touches(self, g: Any, alpha: Any) -> Any:
        """Return whether the tip touches the wire."""
        return np.greater_equal(g, np.exp(log_touch(self.touch, np.log(alpha))))

    def known(self, g: Any, alpha: Any, relative: Any) -> Any:
        """Return whether what a tip adds is known: always where it does not touch the wire."""
        inside = (
            np.greater_equal(alpha, ALPHA)
            & np.less_equal(alpha, self.alpha)
            & np.less_equal(g, self.highest_g)
            & np.less_equal(np.multiply(g, relative), self.most)
            & np.greater_equal(relative, self.radii[0])
            & np.less_equal(relative, self.radii[-1])
        )
        return inside | ~np.asarray(self.touches(g, alpha))

    def added(self, g: Any, alpha: Any, relative: Any) -> tuple[Any, Any]:
        """Return what a tip of a radius [R_w] adds to A* and B*; 0 before the touch."""
        return self._everything(g, alpha, relative)[:2]

    def slopes(self, g: Any, alpha: Any, relative: Any) -> tuple[tuple[Any, ...], tuple[Any, ...]]:
        """Return the derivatives of both by ln g, by alpha and by ln(1/r)."""
        return self._everything(g, alpha, relative)[2:]

    def _everything(self, g: Any, alpha: Any, relative: Any) -> tuple[Any, ...]:
        touches = self.touches(g, alpha) & self.known(g, alpha, relative)
        g, alpha = np.where(touches, g, 1.0), np.where(touches, alpha, ALPHA)
        sharper = np.log(self.radius / np.where(touches, relative, self.radius))
        arc, by_g, by_alpha, by_size = self._arc(g, alpha, sharper)
        pressure, press_g, press_alpha = self._pressure(g, alpha)
        found: tuple[Any, ...] = (
            arc,
            pressure * arc,
            by_g,
            by_alpha,
            by_size,
            pressure * by_g + press_g * arc,
            pressure * by_alpha + press_alpha * arc,
            pressure * by_size,
        )
        found = tuple(np.where(touches, each, 0.0) for each in found)
        return found[0], found[1], found[2:5], found[5:]

    def _arc(self, g: Any, alpha: Any, sharper: Any) -> tuple[Any, ...]:
        """Return what A* gains, and its derivatives by ln g, alpha and ln(1/r)."""
        q = 2.0 / alpha
        p, p_slope = 1.0 - q, q / alpha
        above = alpha - ALPHA
        powers = [1.0 / math.pi, *self.stretch]
        k = np.polynomial.polynomial.polyval(above, powers)
        k_slope = np.polynomial.polynomial.polyval(above, np.polynomial.polynomial.polyder(powers))
        scale = g**q * self.radius**p
        z = p * sharper
        whole, bend = sharper * _mean(z), -sharper * sharper * _bend(z)
        by_alpha = whole * (k_slope + k * p_slope * (math.log(self.radius) - np.log(g)))
        return (
            k * scale * whole,
            q * k * scale * whole,
            scale * (by_alpha + k * p_slope * bend),
            k * scale * np.exp(-z),
        )

    def _pressure(self, g: Any, alpha: Any) -> tuple[Any, Any, Any]:
        """Return the pressure at the tip [mu], and its derivatives by ln g and alpha."""
        a, b, c = self.pressure
        log_alpha = np.log(alpha)
        x = np.log(g) - log_touch(self.touch, log_alpha) - c * (alpha - ALPHA)
        rise = np.tanh(x / b)
        steep = (1.0 - rise * rise) / b
        shift = log_touch_slope(self.touch, log_alpha) / alpha + c
        return g * a * rise, g * a * (rise + steep), -g * a * steep * shift

    def bounds(self, model: str, g: Any, alpha: Any, relative: Any) -> tuple[Any, Any]:
        """Return the bounds of the relative errors of A* and B*; infinite where unknown."""
        errors = np.array(self.errors.get(model, [(np.inf, np.inf)] * (len(self.radii) - 1)))
        touch = np.exp(log_touch(self.touch, np.log(alpha)))
        sure = self.known(g, alpha, relative) & np.greater_equal(g, NEAR * touch)
        step = np.clip(np.searchsorted(self.radii[1:], relative), 0, len(errors) - 1)
        return np.where(sure, errors[step, 0], np.inf), np.where(sure, errors[step, 1], np.inf)


def _mean(z: Any) -> Any:
    """Return (1 - exp(-z))/z."""
    flat = np.equal(z, 0.0)
    return np.where(flat, 1.0, -np.expm1(-z) / np.where(flat, 1.0, z))


#: (n + 1)/(n + 2)! with alternating signs.
_SERIES = [(-1.0) ** n * (n + 1) / math.factorial(n + 2) for n in range(8)]


def _bend(z: Any) -> Any:
    """Return [1 - (1 + z) exp(-z)]/z^2, by its series where that loses digits."""
    small = np.less(np.abs(z), 0.05)
    far = np.where(small, 1.0, z)
    near = np.polynomial.polynomial.polyval(np.where(small, z, 0.0), _SERIES)
    return np.where(small, near, (1.0 - (1.0 + far) * np.exp(-far)) / (far * far))

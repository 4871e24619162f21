"""What the fitted models have in common: the functions of g and alpha inside and outside.

Inside the domain a model evaluates its own functions of ln g and ln alpha. Outside, they continue
from the nearest point inside, without a step:

- at lower g towards the far-field wedge: the logarithm of the ratio to it falls as p, which is
  proportional to the square of the contact's width, the order of the first correction;
- at higher g as A = constant, B, A* and B* as powers g^n(alpha), and delta follows its vertex to
  the touch;
- at other alpha with the value at the nearest end.

All methods work on validated floats as well as on float64 arrays, with one alpha or as many as g.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from surrogate.basics.checks import STIFFENING_EXPONENT, Quantity
from surrogate.basics.elementwise import AT_ONCE, exp, log, product, quotient, where
from surrogate.contact.base import ForceModel
from surrogate.contact.coordinates import (
    QUANTITIES,
    SLIP_QUANTITIES,
    log_touch,
    log_touch_slope,
    vertex,
)
from surrogate.contact.domain import Domain
from surrogate.contact.wedge import (
    wedge_functions,
    wedge_load,
    wedge_slope,
    wedge_slopes,
)
from surrogate.equations import DIMENSIONLESS_TOUGHNESS

if TYPE_CHECKING:
    from typing_extensions import Self

__all__ = [
    "COUPLED",
    "PROJECTED",
    "SLIP",
    "TERMS_OF_LAW",
    "FittedModel",
    "in_blocks",
    "toughness_of",
]

# Between these, ln of ln(g_touch/g): from g equal to g_touch in all digits to the smallest float.
_NEAREST, _FARTHEST = -36.0, 6.7
_MOST = 100
_CLOSE = 4e-16  # a few roundings


def toughness_of(distance_of: Callable[[Any], Any], distance: Any, log_touch: Any) -> Any:
    """Return g at which delta/R_w, falling with g to 1 at g_touch, has a value.

    ln ln(delta/R_w) is close to a line over ln ln(g_touch/g), from the touch to infinity, so that
    false positions with the Illinois rule meet it in about ten steps. Where a value is infinite the
    interval is halved. Every point ends by itself, whatever others are asked for.

    Parameters
    ----------
    distance_of : callable
        delta/R_w of g.
    distance : float or ndarray
        delta/R_w, more than 1; 0 is the answer where it is infinite.
    log_touch : float or ndarray
        ln g_touch.

    Returns
    -------
    float or ndarray
        g.

    Examples
    --------
    >>> g = toughness_of(lambda g: max(g**-0.5, 1.0), 4.0, 0.0)
    >>> print(f"{g:.6f}")
    0.062500
    """
    goal = _height(distance)
    close = _CLOSE * exp(-goal)  # what the rounding of a distance does to its height
    known = np.equal(distance, distance) & np.equal(log_touch, log_touch)
    low, high = where(known, _NEAREST, np.nan), where(known, _FARTHEST, np.nan)
    found = 0.5 * (low + high)
    below, above = where(known, -np.inf, np.nan), where(known, np.inf, np.nan)
    side = where(known, 0.0, np.nan)  # of the last value: -1 below the goal, 1 above
    busy: Any = known & np.less(distance, np.inf)
    for _ in range(_MOST):
        if not np.any(busy):
            break
        value = _height(distance_of(exp(log_touch - exp(found)))) - goal
        under, over = busy & (value < 0.0), busy & (value >= 0.0)
        # the Illinois rule: an end that stays twice counts half
        above = where(over, value, where(under & (side < 0.0), 0.5 * above, above))
        below = where(under, value, where(over & (side > 0.0), 0.5 * below, below))
        low, high = where(under, found, low), where(over, found, high)
        side = where(under, -1.0, where(over, 1.0, side))
        with np.errstate(all="ignore"):
            straight = low + (high - low) * (below / (below - above))
        inside = (straight > low) & (straight < high)
        following = where(inside, straight, 0.5 * (low + high))
        ended = (abs(value) <= close) | (abs(following - found) <= _CLOSE)
        found = where(busy & ~ended, following, found)
        busy = busy & ~ended
    return where(distance == np.inf, 0.0, exp(log_touch - exp(found)))


def _height(distance: Any) -> Any:
    """Return ln ln(delta/R_w), minus infinity at the touch."""
    with np.errstate(all="ignore"):
        inner = np.log1p(distance - 1.0)
        return log(float(inner) if type(distance) is float else inner)


PROJECTED, SLIP, COUPLED = "projected", "slip", "coupled"
"""The laws of dissipation: Eq. (S2) of the paper, the balance of energy to first order, and the
balance with the shear stress acting on the body."""

TERMS_OF_LAW = {PROJECTED: QUANTITIES[:2], SLIP: SLIP_QUANTITIES, COUPLED: SLIP_QUANTITIES}
"""Names of the functions that wear and friction follow under each law."""

_ARC, _LOAD, _DISTANCE = QUANTITIES


class FittedModel(ForceModel):
    """A model of A, B, delta, A* and B* that was fitted to finite-element solutions.

    `limits` is its domain; `inside` and `inside_slopes` are what the kinds of models differ in.
    Under the law "slip", `arc` and `normal_load` are A* and B*.
    """

    limits: Domain
    law: str = PROJECTED

    def under(self, law: str) -> Self:
        """Return the model under another law of dissipation."""
        return self if law == self.law else _under(self, law)

    @property
    def rubbing(self) -> tuple[str, str]:  # type: ignore[override]
        """Names of the functions that wear and friction follow."""
        return TERMS_OF_LAW[self.law]

    @abstractmethod
    def inside(self, names: Sequence[str], log_g: Any, log_alpha: Any, g: Any) -> list[Any]:
        """Return A, B or delta, as named, at points inside the domain."""

    @abstractmethod
    def inside_slopes(self, name: str, log_g: Any, log_alpha: Any) -> tuple[Any, Any, Any]:
        """Return a function and its derivatives by ln g and ln alpha, from above at the touch."""

    @property
    def domain(self) -> str:  # type: ignore[override]
        """The domain in words."""
        return str(self.limits)

    @property
    def g(self) -> Quantity:  # type: ignore[override]
        """The g that the model accepts."""
        return self.limits.g_quantity

    @property
    def stiffening(self) -> Quantity:  # type: ignore[override]
        """The alpha that the model accepts."""
        return self.limits.alpha_quantity

    def arc(self, g: Any, alpha: Any) -> Any:
        return self.contact((self.rubbing[0],), g, alpha)[0]

    def normal_load(self, g: Any, alpha: Any) -> Any:
        return self.contact((self.rubbing[1],), g, alpha)[0]

    def distance(self, g: Any, alpha: Any) -> Any:
        return self.contact((_DISTANCE,), g, alpha)[0]

    def touch(self, alpha: Any) -> Any:
        return exp(self.limits.log_touch(self.limits.clamped(0.0, log(alpha))[1]))

    touching_toughness = touch

    def holds(self, g: Any, alpha: Any) -> Any:
        return self.limits.holds(g, alpha)

    def highest_g(self, alpha: Any) -> Any:
        return self.limits.highest_g(alpha)

    def accepted(self, extrapolate: bool) -> tuple[Quantity, Quantity]:
        return (
            (DIMENSIONLESS_TOUGHNESS, STIFFENING_EXPONENT)
            if extrapolate
            else super().accepted(False)
        )

    def energy_release_rate(self, distance: Any, alpha: Any) -> Any:
        log_alpha = self.limits.clamped(0.0, log(alpha))[1]
        touch = self.limits.log_touch(log_alpha)
        return toughness_of(lambda g: self.distance(g, alpha), distance, touch)

    def contact(self, names: Sequence[str], g: Any, alpha: Any) -> list[Any]:
        """Return A, B or delta, as named."""
        if type(g) is float and type(alpha) is float:
            return self._contact(names, g, alpha)
        return in_blocks(lambda *at: self._contact(names, *at), len(names), g, alpha)

    def _contact(self, names: Sequence[str], g: Any, alpha: Any) -> list[Any]:
        log_g, log_alpha = log(g), log(alpha)
        if self.limits.surrounds(log_g, log_alpha):
            return self.inside(names, log_g, log_alpha, g)
        with np.errstate(all="ignore"):
            return self._outside(names, log_g, log_alpha, g)

    def _outside(self, names: Sequence[str], log_g: Any, log_alpha: Any, g: Any) -> list[Any]:
        """Return the functions where some points are outside the domain; nan where g is 0/0."""
        if type(log_g) is float and log_g != log_g:
            return [log_g] * len(names)
        at, row = self.limits.clamped(log_g, log_alpha)
        values = self.inside(names, at, row, g)
        low, high = self.limits.log_g[0], self.limits.log_highest(row)
        if _all(log_g >= low) and _all(log_g <= high):
            return values
        continued = [self._continued(*each, at, row, log_g) for each in zip(names, values)]  # noqa: B905
        outside = (log_g < low) | (log_g > high)
        return [where(outside, far, near) for far, near in zip(continued, values)]  # noqa: B905

    def _continued(self, name: str, value: Any, at: Any, row: Any, log_g: Any) -> Any:
        """Return what a function becomes away from its nearest value inside, at ln g = `at`."""
        low, high = self.limits.log_g[0], self.limits.log_highest(row)
        far = where(log_g < low, log_g, low)
        p, seam = wedge_load(far), wedge_load(low)
        ratio = log(value) - log(wedge_functions(low, seam)[name])
        with np.errstate(all="ignore"):
            below = wedge_functions(far, p)[name] * exp(ratio * (p / seam))
            over = where(log_g > high, log_g - high, 0.0)
            if name in self.limits.growth:
                above = value * exp(log_touch(self.limits.growth[name], row) * over)
            elif name != _DISTANCE:
                above = value
            else:
                x = self.limits.log_touch(row) - at
                left = where(x > over, 1.0 - over / where(x > 0.0, x, 1.0), 0.0)
                above = 1.0 + (value - 1.0) * vertex(-left)
        return where(log_g < low, below, above)

    def arc_slopes(self, g: Any, alpha: Any) -> tuple[Any, Any]:
        return self.slopes(self.rubbing[0], g, alpha)

    def normal_load_slopes(self, g: Any, alpha: Any) -> tuple[Any, Any]:
        return self.slopes(self.rubbing[1], g, alpha)

    def slopes(self, name: str, g: Any, alpha: Any) -> tuple[Any, Any]:
        """Return the derivatives of a function by g and alpha; infinite in g where g is 0."""
        if type(g) is float and type(alpha) is float:
            return self._slopes(name, g, alpha)
        in_g, in_alpha = in_blocks(lambda *at: self._slopes(name, *at), 2, g, alpha)
        return in_g, in_alpha

    def _slopes(self, name: str, g: Any, alpha: Any) -> tuple[Any, Any]:
        log_g, log_alpha = log(g), log(alpha)
        at, row = self.limits.clamped(log_g, log_alpha)
        value, in_g, in_alpha = self.inside_slopes(name, at, row)
        low, high = self.limits.log_g[0], self.limits.log_highest(row)
        with np.errstate(all="ignore"):
            in_g, in_alpha = in_g / value, in_alpha / value  # of the logarithm from here on
            far = where(log_g < low, log_g, low)
            p, seam = wedge_load(far), wedge_load(low)
            ratio = log(value) - log(wedge_functions(low, seam)[name])
            below = wedge_slopes(far)[name] + ratio * (p / seam) * wedge_slope(far)
            over = where(log_g > high, log_g - high, 0.0)
            powers = self.limits.growth.get(name, (0.0,))
            growth, bend = log_touch(powers, row), log_touch_slope(powers, row)
            # the nearest point inside moves with alpha along the upper end
            bend = bend * over + self.limits.log_highest_slope(row) * (in_g - growth)
            in_g = where(log_g < low, below, where(log_g > high, growth, in_g))
            in_alpha = where(
                log_g < low,
                in_alpha * (p / seam),
                where(log_g > high, in_alpha + bend, in_alpha),
            )
            there = self._contact((name,), g, alpha)[0]
            first, last = self.limits.log_alpha
            in_alpha = where((log_alpha >= first) & (log_alpha <= last), in_alpha, 0.0)
            by_g = where(g == 0.0, np.inf, there * in_g / where(g == 0.0, 1.0, g))
            return by_g, where(in_alpha == 0.0, 0.0, there * in_alpha / alpha)  # B may be infinite

    def terms(self, mu: Any, gamma: Any, radius: Any, xi: Any, wear: Any, alpha: Any) -> Any:
        g = quotient(gamma, mu, radius)
        return self.terms_at(g, mu, gamma, radius, xi, wear, alpha)

    def evaluated(self, mu: Any, gamma: Any, radius: Any, xi: Any, wear: Any, alpha: Any) -> Any:
        g = quotient(gamma, mu, radius)
        terms = self.terms_at(g, mu, gamma, radius, xi, wear, alpha)
        return *terms, self.limits.all_hold(g, alpha)

    def terms_at(
        self, g: Any, mu: Any, gamma: Any, radius: Any, xi: Any, wear: Any, alpha: Any
    ) -> tuple[Any, Any]:
        """Return friction and wear at a known g; what has no strength is not evaluated."""
        arc_name, load_name = self.rubbing
        wears, rubs = _some(wear), _some(xi)
        if not (wears or rubs):
            return 0.0, 0.0
        beyond = self.limits.beyond(g, alpha)
        friction = worn = arc = load = 0.0
        if beyond is False:
            values = self.contact((arc_name,) * wears + (load_name,) * rubs, g, alpha)
            arc, load = values[0], values[-1]
        else:
            arc = self.arc(g, alpha) if wears else 0.0
            at = where(beyond, self.limits.highest_g(alpha), g)
            load = self.normal_load(at, alpha) if rubs else 0.0
        if rubs:
            friction = 2.0 * product(radius, xi, mu) * load
            if beyond is not False:
                far = self._friction_beyond(load, mu, gamma, radius, xi, alpha)
                friction = where(beyond, far, friction)
            friction = _where_not_zero(xi, friction)
        if wears:
            worn = 2.0 * product(wear, radius, _where_not_zero(wear, arc))
        return friction, worn

    def _friction_beyond(
        self, load: Any, mu: Any, gamma: Any, radius: Any, xi: Any, alpha: Any
    ) -> Any:
        """Return 2 R_w xi mu B where g is high, which is 2 xi Gamma_o B/g; B* under "slip"."""
        high = self.limits.highest_g(alpha)
        log_alpha = self.limits.clamped(0.0, log(alpha))[1]
        excess = log_touch(self.limits.growth[self.rubbing[1]], log_alpha) - 1.0
        with np.errstate(all="ignore"):
            log_g = log(gamma) - (log(mu) + log(radius))  # which cannot overflow as g would
            power = exp(excess * (log_g - self.limits.log_highest(log_alpha)))
            return 2.0 * product(xi, gamma, power * (load / high))

    def in_domain(self, mu: Any, gamma: Any, radius: Any, xi: Any, wear: Any, alpha: Any) -> Any:
        return self.limits.holds(quotient(gamma, mu, radius), alpha)

    def bounds_of(self, scene: tuple[Any, ...], measured: tuple[Any, Any]) -> tuple[Any, Any]:
        """Return bounds of the relative errors of A and B: the measured ones, or better ones."""
        return measured


@lru_cache(16)
def _under(model: Any, law: str) -> Any:
    return replace(model, law=law)


def _all(condition: Any) -> bool:
    return condition if type(condition) is bool else bool(np.all(condition))


def _any(condition: Any) -> bool:
    return condition if type(condition) is bool else bool(np.any(condition))


def _some(strength: Any) -> bool:
    """Return whether any strength is not 0."""
    return strength != 0.0 if type(strength) is float else bool(np.any(strength))


def _where_not_zero(strength: Any, value: Any) -> Any:
    """Return the value, 0 where the strength is."""
    return value if type(strength) is float else np.where(strength == 0.0, 0.0, value)


def in_blocks(function: Callable[..., Sequence[Any]], number: int, g: Any, alpha: Any) -> list[Any]:
    """Return a number of functions at points, so many at a time that they stay in the cache."""
    shape = np.broadcast_shapes(np.shape(g), np.shape(alpha))
    one_alpha = type(alpha) is float or np.ndim(alpha) == 0
    flat = _flat(g, shape)
    row: Any = float(alpha) if one_alpha else _flat(alpha, shape)
    results = [np.empty(flat.size) for _ in range(number)]
    with np.errstate(all="ignore"):
        for start in range(0, flat.size, AT_ONCE):
            some = slice(start, start + AT_ONCE)
            values = function(flat[some], row if one_alpha else row[some])
            for result, value in zip(results, values, strict=True):
                result[some] = value
    return [result.reshape(shape) for result in results]


def _flat(values: Any, shape: tuple[int, ...]) -> Any:
    return np.ascontiguousarray(np.broadcast_to(values, shape)).ravel()

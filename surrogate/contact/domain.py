"""Where fitted models hold, and what continues them elsewhere."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from surrogate.basics.checks import STIFFENING_EXPONENT, FloatOrArray, Quantity
from surrogate.basics.elementwise import exp, log, quotient, where
from surrogate.contact.base import ForceModel
from surrogate.contact.coordinates import log_touch, log_touch_slope
from surrogate.equations import DIMENSIONLESS_TOUGHNESS
from surrogate.errors import DomainError

__all__ = ["ROUNDING", "Domain", "g_range", "require_below_highest", "require_inside"]

#: The highest g may be missed by this factor, as it comes from a logarithm.
ROUNDING = 1.0 + 1e-12


@dataclass(frozen=True)
class Domain:
    """The domain of fitted models.

    Parameters
    ----------
    g, alpha : tuple of float
        Ends in Gamma_o/(mu R_w) and in the stiffening exponent [-].
    touch : tuple of float
        Coefficients of ln g_touch in powers of ln alpha.
    growth : mapping of str to tuple of float
        By function, coefficients of d ln/d ln g above the highest g, in powers of ln alpha; a
        function that is not named stays as it is at the highest g.
    highest : tuple of tuple of float
        Pairs of alpha, rising, and the highest g there; ln g is straight in ln alpha between
        them and constant beyond. Without any the end in g is the same for all alphas.

    Examples
    --------
    >>> domain = Domain((0.01, 1e3), (2.0, 9.0), (0.5,), {}, ((3.0, 100.0), (5.0, 1e3)))
    >>> domain.holds(1.0, 2.0), domain.holds(500.0, 2.0), domain.holds(500.0, 6.0)
    (True, False, True)
    """

    g: tuple[float, float]
    alpha: tuple[float, float]
    touch: tuple[float, ...]
    growth: Mapping[str, tuple[float, ...]]
    highest: tuple[tuple[float, float], ...] = ()

    @cached_property
    def log_g(self) -> tuple[float, float]:
        """The ends in ln g; the upper one is the farthest of all alphas."""
        return float(np.log(self.g[0])), float(np.log(self.g[1]))

    @cached_property
    def log_alpha(self) -> tuple[float, float]:
        """The ends in ln alpha."""
        return float(np.log(self.alpha[0])), float(np.log(self.alpha[1]))

    @cached_property
    def g_quantity(self) -> Quantity:
        """The g that is inside."""
        remedy = "or extrapolate=True for the asymptotes, or model='eq13'"
        return _within(DIMENSIONLESS_TOUGHNESS, self.g, remedy)

    @cached_property
    def alpha_quantity(self) -> Quantity:
        """The alpha that is inside."""
        remedy = "or extrapolate=True for the nearest end, or model='eq13'"
        return _within(STIFFENING_EXPONENT, self.alpha, remedy)

    @cached_property
    def _nodes(self) -> tuple[list[float], list[float]]:
        alpha, g = zip(*self.highest, strict=True)
        return [math.log(a) for a in alpha], [math.log(each) for each in g]

    @cached_property
    def _shared(self) -> tuple[float, float]:
        """The ends in ln g that all alphas share."""
        return self.log_g[0], float(np.log(self._of_all[1]))

    def log_highest(self, log_alpha: Any) -> Any:
        """Return ln of the highest g at ln alpha inside the domain."""
        if not self.highest:
            return self.log_g[1]
        value = np.interp(log_alpha, *self._nodes)
        return float(value) if type(log_alpha) is float else value

    def log_highest_slope(self, log_alpha: Any) -> Any:
        """Return d ln/d ln alpha of the highest g, from above where it bends."""
        if not self.highest:
            return 0.0
        at, values = self._nodes
        slopes = np.concatenate([[0.0], np.diff(values) / np.diff(at), [0.0]])
        slope = slopes[np.searchsorted(at, log_alpha, side="right")]
        return float(slope) if type(log_alpha) is float else slope

    def highest_g(self, alpha: Any) -> Any:
        """Return the highest g at alpha, or at the nearest end of the domain."""
        if not self.highest:
            return self.g[1]
        row = _clamped(log(alpha), *self.log_alpha)
        return exp(self.log_highest(row))

    def holds(self, g: Any, alpha: Any) -> Any:
        """Return whether points are inside; nan is not."""
        low, high = self.g
        first, last = self.alpha
        inside = (g >= low) & (g <= high) & (alpha >= first) & (alpha <= last)
        if self.highest and np.any(inside):
            inside = inside & (g <= self.highest_g(where(inside, alpha, first)) * ROUNDING)
        return inside

    @cached_property
    def _of_all(self) -> tuple[float, float]:
        """The ends in g that all alphas share."""
        return self.g[0], min((g for _, g in self.highest), default=self.g[1])

    def all_hold(self, g: Any, alpha: Any) -> Any:
        """Return True where all points are inside, which is soon known, else what `holds` does."""
        low, high = self._of_all
        if type(g) is type(alpha) is float:  # the same, and quicker
            first, last = self.alpha
            return (low <= g <= high and first <= alpha <= last) or self.holds(g, alpha)
        return (_between(g, (low, high)) and _between(alpha, self.alpha)) or self.holds(g, alpha)

    def beyond(self, g: Any, alpha: Any) -> Any:
        """Return False where no g is above the highest, which is soon known, else which are."""
        if not (g > self._of_all[1] if type(g) is float else np.any(g > self._of_all[1])):
            return False
        return g > self.highest_g(alpha)

    def surrounds(self, log_g: Any, log_alpha: Any) -> bool:
        """Return whether all points are inside."""
        if type(log_g) is float and type(log_alpha) is float:  # the same, and quicker
            low, high = self._shared
            first, last = self.log_alpha
            if not first <= log_alpha <= last:
                return False
            return low <= log_g <= high or low <= log_g <= self.log_highest(log_alpha)
        if not _between(log_alpha, self.log_alpha):
            return False
        if _between(log_g, self._shared):
            return True
        if not self.highest or not _between(log_g, self.log_g):
            return False
        return bool(np.all(log_g <= self.log_highest(log_alpha)))

    def clamped(self, log_g: Any, log_alpha: Any) -> tuple[Any, Any]:
        """Return the nearest points inside."""
        row = _clamped(log_alpha, *self.log_alpha)
        return _clamped(log_g, self.log_g[0], self.log_highest(row)), row

    def log_touch(self, log_alpha: Any) -> Any:
        """Return ln g_touch at ln alpha inside the domain."""
        return log_touch(self.touch, log_alpha)

    def log_touch_slopes(self, log_alpha: Any) -> tuple[Any, Any]:
        """Return ln g_touch and its derivative by ln alpha."""
        return log_touch(self.touch, log_alpha), log_touch_slope(self.touch, log_alpha)

    def __str__(self) -> str:
        ends = f"{self.g[1]:g}"
        if self.highest:
            steps = {g: alpha for alpha, g in reversed(self.highest)}
            ends = ", ".join(f"{g:g} (alpha from {steps[g]:g})" for g in sorted(steps)[1:])
            ends = f"{min(steps):g}, {ends}"
        return f"g from {self.g[0]:g} to {ends}, alpha from {self.alpha[0]:g} to {self.alpha[1]:g}"


def g_range(ranges: Mapping[str, tuple[float, float]]) -> tuple[float, float]:
    """Return the ends of g = Gamma_o/(mu R_w) in a box of scenes; (0, 0) or infinite at zeros."""
    ends = []
    for i, j in ((0, 1), (1, 0)):
        divisor = ranges["shear_modulus"][j] * ranges["wire_radius"][j]
        gamma = ranges["toughness"][i]
        ends.append(gamma / divisor if divisor else (math.inf if gamma else 0.0))
    return ends[0], ends[1]


def _within(quantity: Quantity, ends: tuple[float, float], remedy: str) -> Quantity:
    low, high = ends
    return replace(
        quantity,
        lower=low,
        upper=high,
        error=DomainError,
        remedy=f"give {low:g} to {high:g}, {remedy}",
    )


def _between(value: Any, ends: tuple[float, float]) -> bool:
    """Return whether all values are between the ends; nan is not."""
    low, high = ends
    if type(value) is float:
        return low <= value <= high
    if not value.size:
        return True
    return bool(value.min() >= low and value.max() <= high)


def _clamped(value: Any, low: float, high: float) -> Any:
    if type(value) is float and type(high) is float:
        return low if math.isnan(value) else min(max(value, low), high)
    return np.minimum(np.maximum(value, low), high)


_NAMES = (("shear_modulus", "Pa"), ("toughness", "J/m^2"), ("wire_radius", "m"))


def require_inside(model: ForceModel, values: tuple[FloatOrArray, ...]) -> None:
    """Raise a `DomainError` where a scene needs the contact outside the domain of a model.

    The contact is not needed where neither friction nor wear has a strength and a radius.

    Parameters
    ----------
    model : ForceModel
        The model.
    values : tuple
        The six quantities of the scene, in its order.

    Raises
    ------
    DomainError
        If g or alpha is outside; the message says where, and from which quantities g follows.
    """
    mu, gamma, radius, xi, wear, alpha = values
    with np.errstate(all="ignore"):  # an infinite g is outside
        g = quotient(gamma, mu, radius)
    inside = model.holds(g, alpha)
    if inside is True or np.all(inside | (np.equal(xi, 0.0) & np.equal(wear, 0.0))):
        return
    shape = np.broadcast_shapes(*map(np.shape, values))
    g, alpha, matters = (
        np.broadcast_to(v, shape)
        for v in (g, alpha, np.not_equal(xi, 0.0) | np.not_equal(wear, 0.0))
    )
    some = model.stiffening.lower
    model.stiffening.checked(_plain(np.where(matters, alpha, some)))
    low = model.g.lower
    outside = matters & ~model.holds(g, alpha)
    index = tuple(int(i) for i in np.argwhere(outside)[0]) if shape else ()
    where = f"[{', '.join(map(str, index))}]" if index else ""
    given = ", ".join(
        f"{name} = {float(np.broadcast_to(value, shape)[index])!r} {unit}"
        for (name, unit), value in zip(_NAMES, values, strict=False)
    )
    many = f", {np.count_nonzero(outside)} of {outside.size} values" if shape else ""
    high = model.highest_g(float(alpha[index]))
    raise DomainError(
        f"g = Gamma_o/(mu R_w) must be from {low:g} to {high:g} for the model {model.name!r}, but "
        f"g{where} = {float(g[index]):.4g} (from {given}{many}); change the scene, give "
        "extrapolate=True to continue with the asymptotes, or choose model='eq13'."
    )


def require_below_highest(model: ForceModel, g: Any, alpha: Any) -> None:
    """Raise a `DomainError` where g is above what a model has at its alpha."""
    inside = model.holds(g, alpha)
    if inside is True or np.all(inside):
        return
    at = np.broadcast_arrays(inside, g, alpha)
    first = int(np.argmin(at[0]))
    g, alpha = (float(np.ravel(each)[first]) for each in at[1:])
    raise DomainError(
        f"g must be in {model.domain} for the model {model.name!r}, but g = {g:.4g} at alpha = "
        f"{alpha:.4g} is not; give extrapolate=True to continue with the asymptotes, or choose "
        "model='eq13'."
    )


def _plain(values: Any) -> Any:
    return values.item() if np.ndim(values) == 0 else values

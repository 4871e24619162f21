"""Where fitted models hold, and what continues them elsewhere."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from surrogate.basics.checks import STIFFENING_EXPONENT, FloatOrArray, Quantity
from surrogate.basics.elementwise import quotient
from surrogate.contact.base import ForceModel
from surrogate.contact.coordinates import log_touch, log_touch_slope
from surrogate.equations import DIMENSIONLESS_TOUGHNESS
from surrogate.errors import DomainError

__all__ = ["Domain", "require_inside"]


@dataclass(frozen=True)
class Domain:
    """The domain of fitted models.

    Parameters
    ----------
    g, alpha : tuple of float
        Ends in Gamma_o/(mu R_w) and in the stiffening exponent [-].
    touch : tuple of float
        Coefficients of ln g_touch in powers of ln alpha.
    growth : tuple of float
        Coefficients of d ln B/d ln g above the highest g, in powers of ln alpha.

    Examples
    --------
    >>> domain = Domain((0.01, 100.0), (2.0, 9.0), (0.5,), (1.1,))
    >>> domain.holds(1.0, 2.0), domain.holds(1e-3, 2.0)
    (True, False)
    """

    g: tuple[float, float]
    alpha: tuple[float, float]
    touch: tuple[float, ...]
    growth: tuple[float, ...]

    @cached_property
    def log_g(self) -> tuple[float, float]:
        """The ends in ln g."""
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

    def holds(self, g: Any, alpha: Any) -> Any:
        """Return whether points are inside; nan is not."""
        low, high = self.g
        first, last = self.alpha
        return (g >= low) & (g <= high) & (alpha >= first) & (alpha <= last)

    def all_hold(self, g: Any, alpha: Any) -> Any:
        """Return True where all points are inside, which is soon known, else what `holds` does."""
        return (_between(g, self.g) and _between(alpha, self.alpha)) or self.holds(g, alpha)

    def surrounds(self, log_g: Any, log_alpha: Any) -> bool:
        """Return whether all points are inside."""
        if type(log_g) is float and type(log_alpha) is float:  # the same, and quicker
            low, high = self.log_g
            first, last = self.log_alpha
            return low <= log_g <= high and first <= log_alpha <= last
        return _between(log_g, self.log_g) and _between(log_alpha, self.log_alpha)

    def clamped(self, log_g: Any, log_alpha: Any) -> tuple[Any, Any]:
        """Return the nearest points inside."""
        return _clamped(log_g, *self.log_g), _clamped(log_alpha, *self.log_alpha)

    def log_touch(self, log_alpha: Any) -> Any:
        """Return ln g_touch at ln alpha inside the domain."""
        return log_touch(self.touch, log_alpha)

    def log_touch_slopes(self, log_alpha: Any) -> tuple[Any, Any]:
        """Return ln g_touch and its derivative by ln alpha."""
        return log_touch(self.touch, log_alpha), log_touch_slope(self.touch, log_alpha)

    def __str__(self) -> str:
        return (
            f"g from {self.g[0]:g} to {self.g[1]:g}, "
            f"alpha from {self.alpha[0]:g} to {self.alpha[1]:g}"
        )


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
    if type(value) is float:
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
    low, high = model.g.lower, model.g.upper
    outside = matters & ~((g >= low) & (g <= high))
    index = tuple(int(i) for i in np.argwhere(outside)[0]) if shape else ()
    where = f"[{', '.join(map(str, index))}]" if index else ""
    given = ", ".join(
        f"{name} = {float(np.broadcast_to(value, shape)[index])!r} {unit}"
        for (name, unit), value in zip(_NAMES, values, strict=False)
    )
    many = f", {np.count_nonzero(outside)} of {outside.size} values" if shape else ""
    raise DomainError(
        f"g = Gamma_o/(mu R_w) must be from {low:g} to {high:g} for the model {model.name!r}, but "
        f"g{where} = {float(g[index]):.4g} (from {given}{many}); change the scene, give "
        "extrapolate=True to continue with the asymptotes, or choose model='eq13'."
    )


def _plain(values: Any) -> Any:
    return values.item() if np.ndim(values) == 0 else values

"""Where fitted models hold, and what continues them elsewhere."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from surrogate.equations import DIMENSIONLESS_TOUGHNESS
from surrogate.errors import DomainError
from surrogate.touch import log_touch, log_touch_slope
from surrogate.validation import STIFFENING_EXPONENT, Quantity

__all__ = ["Domain"]


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
    return bool(np.minimum.reduce(value) >= low and np.maximum.reduce(value) <= high)


def _clamped(value: Any, low: float, high: float) -> Any:
    if type(value) is float:
        return low if math.isnan(value) else min(max(value, low), high)
    return np.minimum(np.maximum(value, low), high)

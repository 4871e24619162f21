"""The closed forms of the paper as models of the contact: Eqs. (9), (10), (12), (13) and (15).

The friction of Eq. (9), xi Gamma_o g^(n - 1), is right at every size: the power g^(n - 1) is from
1e-172 to 1e172 whatever the numbers are, so that only the product with it can leave the range of
numbers.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, TypeAlias

import numpy as np

from surrogate.basics.checks import STIFFENING_EXPONENT, Quantity
from surrogate.basics.elementwise import (
    all_normal,
    exp,
    log,
    product,
    quotient,
    scaled,
    where,
    where_normal,
)
from surrogate.contact.base import ForceModel
from surrogate.equations import (
    TABLE_1,
    TABULATED_STIFFENING,
    power_law,
    table_1_exponent,
    table_1_slope,
)

__all__ = [
    "FORCE_MODELS",
    "MUCH_GREATER",
    "ClosedForm",
    "Condition",
    "PowerLaw",
    "always",
    "formula_name",
    "friction_free",
    "high_toughness",
    "low_toughness",
    "power_friction",
    "power_friction_slopes",
    "power_load",
    "power_load_slopes",
]

Condition: TypeAlias = Callable[[Any, Any, Any, Any, Any], Any]

MUCH_GREATER = 10.0
"""The factor that >> and << in the paper's conditions are taken to mean."""


def always(mu: Any, gamma: Any, radius: Any, xi: Any, wear: Any) -> Any:
    """Hold everywhere: Eq. (13)."""
    return True


def high_toughness(mu: Any, gamma: Any, radius: Any, xi: Any, wear: Any) -> Any:
    """Hold where Gamma_o >> mu R_w, and Gamma_o > 0: Eqs. (9) and (10)."""
    return (gamma >= MUCH_GREATER * (mu * radius)) & (gamma > 0.0)


def low_toughness(mu: Any, gamma: Any, radius: Any, xi: Any, wear: Any) -> Any:
    """Hold where Gamma_o <= mu R_w: Eq. (12)."""
    return gamma <= mu * radius


def friction_free(mu: Any, gamma: Any, radius: Any, xi: Any, wear: Any) -> Any:
    """Hold where xi << 1 and xi mu << tau_w, or xi = 0: Eq. (15)."""
    return (MUCH_GREATER * xi <= 1.0) & (MUCH_GREATER * (xi * mu) <= wear) | (xi == 0.0)


def power_load(g: Any, alpha: Any) -> Any:
    """Return B = g^n/2 [-].

    Examples
    --------
    >>> print(f"{power_load(20.0, 2.0):.4f}")
    17.1469
    """
    return power_law(g, 0.5, table_1_exponent(alpha))


def power_load_slopes(g: Any, alpha: Any) -> tuple[Any, Any]:
    """Return dB/dg and dB/dalpha, infinite in g where g = 0 and n < 1."""
    n = table_1_exponent(alpha)
    with np.errstate(all="ignore"):  # of 0 and of numbers whose power overflows
        log_g = log(g)
        in_g = 0.5 * n * where(n == 1.0, 1.0, exp((n - 1.0) * log_g))
        in_alpha = 0.5 * exp(n * log_g) * log_g * table_1_slope(alpha)
    return in_g, where(g == 0.0, 0.0, in_alpha)


def power_friction(mu: Any, gamma: Any, radius: Any, xi: Any, alpha: Any) -> Any:
    """Return xi Gamma_o g^(n - 1) [N/m]; none where Gamma_o = 0.

    Examples
    --------
    >>> print(f"{power_friction(1.0, 20.0, 1.0, 0.1, 2.0):.4f}")
    3.4294
    """
    power = _power(_log_g(mu, gamma, radius), table_1_exponent(alpha) - 1.0)
    return where((xi == 0.0) | (gamma == 0.0), 0.0, product(xi, gamma, power))


def power_friction_slopes(mu: Any, gamma: Any, radius: Any, xi: Any, alpha: Any) -> tuple[Any, ...]:
    """Return the derivatives of the friction by mu, Gamma_o, R_w, xi and alpha.

    Where a quantity is 0 they are those of Gamma_o^n (mu R_w)^(1 - n), nan where that has none.
    """
    n = table_1_exponent(alpha)
    excess = n - 1.0
    log_g = _log_g(mu, gamma, radius)
    power = _power(log_g, excess)
    no_change = (xi == 0.0) | (excess == 0.0)

    def by(divisor: Any, other: Any) -> Any:
        """Return the derivative by mu or R_w, the other one given."""
        with np.errstate(all="ignore"):
            steep = log(gamma) - log(divisor)
            limit = -excess * exp(n * steep - excess * log(other))  # 0 or infinite
        slope = scaled((-excess, xi, gamma, power), (divisor,))
        return where(no_change, 0.0, where_normal(power, slope, limit))

    with np.errstate(all="ignore"):
        bend = scaled((xi, gamma, power, log_g, table_1_slope(alpha)), ())
    return (
        by(mu, radius),
        where(xi == 0.0, 0.0, product(n, xi, power)),
        by(radius, mu),
        power_friction(mu, gamma, radius, 1.0, alpha),
        where((xi == 0.0) | (gamma == 0.0) | (power == 0.0), 0.0, bend),
    )


def _log_g(mu: Any, gamma: Any, radius: Any) -> Any:
    """Return ln g, from g itself where that is in the range of numbers."""
    with np.errstate(all="ignore"):
        g = quotient(gamma, mu, radius)
        if all_normal(g):
            return log(g)
        return where_normal(g, log(g), log(gamma) - (log(mu) + log(radius)))


def _power(log_g: Any, excess: Any) -> Any:
    with np.errstate(all="ignore"):
        return where(excess == 0.0, 1.0, exp(excess * log_g))


@dataclass(frozen=True)
class ClosedForm(ForceModel):
    """Constant A and a B that is linear in g: 2 A = `arc_2`, 2 B = `load_2` + `load_2_slope` g."""

    name: str
    equation: str
    domain: str
    arc_2: float
    load_2: float
    load_2_slope: float
    condition: Condition
    stiffening: Quantity = STIFFENING_EXPONENT

    def arc(self, g: Any, alpha: Any) -> Any:
        return 0.5 * self.arc_2

    def normal_load(self, g: Any, alpha: Any) -> Any:
        return 0.5 * (self.load_2 + self.load_2_slope * g)

    def arc_slopes(self, g: Any, alpha: Any) -> tuple[Any, Any]:
        return 0.0, 0.0

    def normal_load_slopes(self, g: Any, alpha: Any) -> tuple[Any, Any]:
        return 0.5 * self.load_2_slope, 0.0

    def terms(self, mu: Any, gamma: Any, radius: Any, xi: Any, wear: Any, alpha: Any) -> Any:
        # 2 R_w mu B = load_2 mu R_w + load_2_slope Gamma_o needs no g.
        friction = self.load_2_slope * (xi * gamma) if self.load_2_slope else 0.0
        if self.load_2:
            friction = friction + self.load_2 * product(radius, xi, mu)
        return friction, self.arc_2 * (wear * radius) if self.arc_2 else 0.0

    def gradient(
        self, mu: Any, gamma: Any, radius: Any, xi: Any, wear: Any, alpha: Any
    ) -> tuple[Any, ...]:
        return (
            self.load_2 * (xi * radius),
            1.0 + self.load_2_slope * xi,
            self.load_2 * (xi * mu) + self.arc_2 * wear,
            self.load_2_slope * gamma + self.load_2 * (mu * radius),
            self.arc_2 * radius,
            0.0,
        )

    def in_domain(self, mu: Any, gamma: Any, radius: Any, xi: Any, wear: Any, alpha: Any) -> Any:
        return self.condition(mu, gamma, radius, xi, wear)


@dataclass(frozen=True)
class PowerLaw(ForceModel):
    """Eq. (9) with the exponents of Table 1: A = 0, 2 B = g^n(alpha)."""

    name: str = "eq9"
    equation: str = "Eq. (9)"
    domain: str = (
        f"Gamma_o >= {MUCH_GREATER:g} mu R_w, alpha from {min(TABLE_1):g} to {max(TABLE_1):g}"
    )
    stiffening: Quantity = TABULATED_STIFFENING

    def arc(self, g: Any, alpha: Any) -> Any:
        return 0.0

    def normal_load(self, g: Any, alpha: Any) -> Any:
        return power_load(g, alpha)

    def arc_slopes(self, g: Any, alpha: Any) -> tuple[Any, Any]:
        return 0.0, 0.0

    def normal_load_slopes(self, g: Any, alpha: Any) -> tuple[Any, Any]:
        return power_load_slopes(g, alpha)

    def terms(self, mu: Any, gamma: Any, radius: Any, xi: Any, wear: Any, alpha: Any) -> Any:
        """Return friction xi Gamma_o g^(n - 1) and no wear; no friction where Gamma_o = 0."""
        return power_friction(mu, gamma, radius, xi, alpha), 0.0

    def gradient(
        self, mu: Any, gamma: Any, radius: Any, xi: Any, wear: Any, alpha: Any
    ) -> tuple[Any, ...]:
        """Return those of Gamma_o + xi Gamma_o^n (mu R_w)^(1 - n); nan where it has none."""
        in_mu, in_gamma, in_radius, in_xi, in_alpha = power_friction_slopes(
            mu, gamma, radius, xi, alpha
        )
        return in_mu, 1.0 + in_gamma, in_radius, in_xi, 0.0, in_alpha

    def in_domain(self, mu: Any, gamma: Any, radius: Any, xi: Any, wear: Any, alpha: Any) -> Any:
        return high_toughness(mu, gamma, radius, xi, wear)


def _by_name(*models: ForceModel) -> Mapping[str, ForceModel]:
    return MappingProxyType({model.name: model for model in models})


FORCE_MODELS = _by_name(
    ClosedForm("eq13", "Eq. (13)", "any", 4.0, 4.0, 1.0, always),
    ClosedForm(
        "high-toughness",
        "Eq. (10)",
        f"Gamma_o >= {MUCH_GREATER:g} mu R_w",
        0.0,
        0.0,
        1.0,
        high_toughness,
    ),
    ClosedForm("low-toughness", "Eq. (12)", "Gamma_o <= mu R_w", 4.0, 4.0, 0.0, low_toughness),
    ClosedForm(
        "friction-free",
        "Eq. (15)",
        f"{MUCH_GREATER:g} xi <= 1 and {MUCH_GREATER:g} xi mu <= tau_w",
        4.0,
        0.0,
        0.0,
        friction_free,
    ),
    PowerLaw(),
)
"""Every closed form by its name."""


def formula_name(model: str) -> str:
    """Return what figures call a model: the number of its equation, or its own name.

    Examples
    --------
    >>> formula_name("eq13"), formula_name("auto")
    ('Eq. (13)', 'auto')
    """
    form = FORCE_MODELS.get(model)
    return model if form is None else form.equation

"""Eq. (9) with the exponents of Table 1, as the friction xi Gamma_o g^(n - 1) of a scene.

Right at every size: the power g^(n - 1) is from 1e-172 to 1e172 whatever the numbers are, so that
only the product with it can leave the range of numbers.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from surrogate.elementwise import exp, log, product, quotient, scaled, where, where_normal
from surrogate.equations import power_law, table_1_exponent, table_1_slope

__all__ = ["power_friction", "power_friction_slopes", "power_load", "power_load_slopes"]


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
        return where_normal(g, log(g), log(gamma) - (log(mu) + log(radius)))


def _power(log_g: Any, excess: Any) -> Any:
    with np.errstate(all="ignore"):
        return where(excess == 0.0, 1.0, exp(excess * log_g))

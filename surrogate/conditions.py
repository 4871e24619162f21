"""The conditions under which the paper's closed forms hold, from mu, Gamma_o, R_w, xi and tau_w."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

__all__ = [
    "MUCH_GREATER",
    "Condition",
    "always",
    "friction_free",
    "high_toughness",
    "low_toughness",
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

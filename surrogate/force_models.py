"""Models of the contact between wire and solid, in the two functions that the force needs.

With g = Gamma_o/(mu R_w) and the contact arc from theta_1 to theta_2, Eqs. (S1) and (S2) give

    F_ss/T = Gamma_o + 2 R_w [tau_w A(g, alpha) + xi mu B(g, alpha)],

where A = cos theta_1 - cos theta_2 is the arc along which the solid wears and
B = F_v/(mu R_w T) the normal load which friction follows. A model is a choice of A and B.

All methods work on validated floats as well as on float64 blocks; nothing is checked here.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

import numpy as np

from surrogate.conditions import (
    MUCH_GREATER,
    Condition,
    always,
    friction_free,
    high_toughness,
    low_toughness,
)
from surrogate.elementwise import product, quotient, ratio, where
from surrogate.equations import DIMENSIONLESS_TOUGHNESS, TABLE_1, TABULATED_STIFFENING
from surrogate.errors import UnknownModelError
from surrogate.power_friction import (
    power_friction,
    power_friction_slopes,
    power_load,
    power_load_slopes,
)
from surrogate.validation import STIFFENING_EXPONENT, Quantity, shown

__all__ = [
    "AUTO",
    "FITTED_NAMES",
    "FORCE_MODELS",
    "ClosedForm",
    "ForceModel",
    "PowerLaw",
    "force_model",
    "is_auto",
]


class ForceModel(ABC):
    """What every model of the cutting force answers.

    The arguments are g [-], alpha [-], and the six quantities of a scene in its order.
    """

    __slots__ = ()

    name: str
    equation: str
    domain: str
    stiffening: Quantity  # the alpha that the model accepts
    g: Quantity = DIMENSIONLESS_TOUGHNESS  # and the g
    uncertain = False  # whether it knows its standard deviations

    @abstractmethod
    def arc(self, g: Any, alpha: Any) -> Any:
        """Return A = cos theta_1 - cos theta_2 [-]."""

    @abstractmethod
    def normal_load(self, g: Any, alpha: Any) -> Any:
        """Return B = F_v/(mu R_w T) [-]."""

    @abstractmethod
    def arc_slopes(self, g: Any, alpha: Any) -> tuple[Any, Any]:
        """Return dA/dg and dA/dalpha [-], from above where A bends."""

    @abstractmethod
    def normal_load_slopes(self, g: Any, alpha: Any) -> tuple[Any, Any]:
        """Return dB/dg and dB/dalpha [-], from above where B bends."""

    def distance(self, g: Any, alpha: Any) -> Any:
        """Return delta/R_w [-], 1 from the touch on; by Eq. (5) where a model has no own."""
        with np.errstate(all="ignore"):
            return where(g < 1.0, 1.0 / np.sqrt(np.abs(g)), 1.0)  # -0.0 is 0

    def energy_release_rate(self, distance: Any, alpha: Any) -> Any:
        """Return J/(mu R_w) [-] at delta/R_w above 1: the inverse of `distance`."""
        return (1.0 / distance) * (1.0 / distance)

    def touch(self, alpha: Any) -> Any:
        """Return g at which the tip begins to touch the wire [-]."""
        return 1.0

    def contact(self, names: Sequence[str], g: Any, alpha: Any) -> list[Any]:
        """Return "arc", "normal_load" or "distance", as named, and no other is evaluated."""
        return [getattr(self, name)(g, alpha) for name in names]

    def accepted(self, extrapolate: bool) -> tuple[Quantity, Quantity]:
        """Return the g and the alpha that the model takes."""
        return self.g, self.stiffening

    def holds(self, g: Any, alpha: Any) -> Any:
        """Return whether the model holds at g and alpha, as far as these decide."""
        return True

    def stds(self, names: Sequence[str], g: Any, alpha: Any) -> list[Any]:
        """Return the standard deviations of the functions named; none where the model has none."""
        return []

    def contact_std(self, g: Any, alpha: Any) -> tuple[Any, Any] | None:
        """Return the standard deviations of A and B [-], or None where the model knows none."""
        if not self.uncertain:
            return None
        arc, load = self.stds(("arc", "normal_load"), g, alpha)
        return arc, load

    @abstractmethod
    def terms(self, mu: Any, gamma: Any, radius: Any, xi: Any, wear: Any, alpha: Any) -> Any:
        """Return the friction 2 R_w xi mu B and the wear 2 R_w tau_w A [N/m].

        Exact where g is infinite or 0/0, which `arc` and `normal_load` cannot be.
        """

    def gradient(
        self, mu: Any, gamma: Any, radius: Any, xi: Any, wear: Any, alpha: Any
    ) -> tuple[Any, ...]:
        """Return the derivatives of F_ss/T by the six quantities, in their order.

        By the chain rule through g; nan where g is infinite or 0/0, but for those by xi and tau_w.
        """
        g, relative = quotient(gamma, mu, radius), ratio(wear, mu)
        (arc_g, arc_alpha), (load_g, load_alpha) = (
            self.arc_slopes(g, alpha),
            self.normal_load_slopes(g, alpha),
        )
        arc, load = self.arc(g, alpha), self.normal_load(g, alpha)
        # g dA/dg and g dB/dg vanish with g, even where a slope becomes infinite there.
        arc_log, load_log = (where(g == 0.0, 0.0, g * slope) for slope in (arc_g, load_g))
        return (
            2.0 * (product(radius, xi, load - load_log) - _times(relative * radius, arc_log)),
            1.0 + 2.0 * (_times(relative, arc_g) + _times(xi, load_g)),
            2.0 * (wear * (arc - arc_log) + product(xi, mu, load - load_log)),
            self.terms(mu, gamma, radius, 1.0, 0.0, alpha)[0],
            self.terms(mu, gamma, radius, 0.0, 1.0, alpha)[1],
            2.0 * (_times(wear * radius, arc_alpha) + _times(product(radius, xi, mu), load_alpha)),
        )

    @abstractmethod
    def in_domain(self, mu: Any, gamma: Any, radius: Any, xi: Any, wear: Any, alpha: Any) -> Any:
        """Return whether the model holds."""


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


def _times(factor: Any, slope: Any) -> Any:
    """Return the product, 0 where the factor is 0 and the slope perhaps infinite."""
    return where(factor == 0.0, 0.0, factor * slope)


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


AUTO = "auto"
"""The model that stands for the cheapest one that is exact enough."""

FITTED_NAMES = ("power-law", "table", "gp")
"""The models fitted to finite-element solutions."""


def is_auto(name: object) -> bool:
    """Return whether a name is the one that stands for the cheapest exact enough model.

    Examples
    --------
    >>> is_auto("auto"), is_auto("table")
    (True, False)
    """
    return isinstance(name, str) and name == AUTO


def force_model(name: object, argument: str = "model") -> ForceModel:
    """Return the model of that name, which is not "auto".

    Raises
    ------
    UnknownModelError
        If there is none; the message lists those that there are.
    InputError
        If the model is a fitted one and its file is missing or damaged.
    """
    if isinstance(name, str) and name in FORCE_MODELS:
        return FORCE_MODELS[name]
    if isinstance(name, str) and name in FITTED_NAMES:
        from surrogate.fitted import shipped  # which loads what the closed forms do not need

        return shipped().models[name]
    raise UnknownModelError(
        f"{argument} must be the name of a model, but {argument} = {shown(name)}; "
        f"choose one of {', '.join((*FORCE_MODELS, *FITTED_NAMES, AUTO))}."
    )

"""What every model of the contact between wire and solid answers.

With g = Gamma_o/(mu R_w) and the contact arc from theta_1 to theta_2, Eqs. (S1) and (S2) give

    F_ss/T = Gamma_o + 2 R_w [tau_w A(g, alpha) + xi mu B(g, alpha)],

where A = cos theta_1 - cos theta_2 is the arc along which the solid wears and
B = F_v/(mu R_w T) the normal load which friction follows. A model is a choice of A and B.

All methods work on validated floats as well as on float64 blocks; nothing is checked here.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import Any

import numpy as np

from surrogate.basics.checks import Quantity
from surrogate.basics.elementwise import product, quotient, ratio, where
from surrogate.contact.coordinates import QUANTITIES
from surrogate.equations import DIMENSIONLESS_TOUGHNESS

__all__ = ["ForceModel"]


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
    functions: tuple[str, ...] = QUANTITIES  # the names that `contact` takes
    rubbing: tuple[str, str] = QUANTITIES[:2]  # those of them that wear and friction follow
    law = "projected"

    def __str__(self) -> str:
        return self.name if self.law == "projected" else f"{self.name}, law {self.law}"

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

    def highest_g(self, alpha: Any) -> Any:
        """Return the highest g at which the model holds at alpha [-]."""
        return self.g.upper

    def ends(self, alpha: Any) -> tuple[Any, Any]:
        """Return the lowest and the highest g at which the model holds at alpha [-]."""
        return self.g.lower, self.highest_g(alpha)

    def stds(self, names: Sequence[str], g: Any, alpha: Any) -> list[Any]:
        """Return the standard deviations of the functions named; none where the model has none."""
        return []

    def contact_std(self, g: Any, alpha: Any) -> tuple[Any, Any] | None:
        """Return the standard deviations of A and B [-], or None where the model knows none."""
        if not self.uncertain:
            return None
        arc, load = self.stds(self.rubbing, g, alpha)
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

    def evaluated(self, mu: Any, gamma: Any, radius: Any, xi: Any, wear: Any, alpha: Any) -> Any:
        """Return friction, wear, and whether the model holds."""
        friction, worn = self.terms(mu, gamma, radius, xi, wear, alpha)
        return friction, worn, self.in_domain(mu, gamma, radius, xi, wear, alpha)

    def require_known(self, scene: tuple[Any, ...]) -> None:
        """Raise a `DomainError` where a scene is in the domain and its contact is not known."""
        return

    @abstractmethod
    def in_domain(self, mu: Any, gamma: Any, radius: Any, xi: Any, wear: Any, alpha: Any) -> Any:
        """Return whether the model holds."""


def _times(factor: Any, slope: Any) -> Any:
    """Return the product, 0 where the factor is 0 and the slope perhaps infinite."""
    return where(factor == 0.0, 0.0, factor * slope)

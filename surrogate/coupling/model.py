"""A fitted model under the law "coupled": its slip terms times kappa."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from surrogate.basics.elementwise import exp, quotient, ratio, where
from surrogate.contact.domain import Domain
from surrogate.contact.fitted import COUPLED, FittedModel
from surrogate.coupling.amplification import Amplification

__all__ = ["CoupledModel", "OverSlip"]


@dataclass(frozen=True, eq=False)
class OverSlip(FittedModel):
    """A model that starts from the slip terms of another one, whose A*, B* and domain it has.

    Parameters
    ----------
    slip : FittedModel
        The model under the law "slip".
    """

    slip: FittedModel

    @property
    def name(self) -> str:  # type: ignore[override]
        """Name of the model."""
        return self.slip.name

    @property
    def equation(self) -> str:  # type: ignore[override]
        """What it evaluates."""
        return self.slip.equation

    @property
    def limits(self) -> Domain:  # type: ignore[override]
        """The domain of A* and B*."""
        return self.slip.limits

    @property
    def functions(self) -> tuple[str, ...]:  # type: ignore[override]
        """Names of the functions that `contact` takes."""
        return self.slip.functions

    @property
    def uncertain(self) -> bool:  # type: ignore[override]
        """Whether A* and B* come with standard deviations."""
        return self.slip.uncertain

    def stds(self, names: Sequence[str], g: Any, alpha: Any) -> list[Any]:
        return self.slip.stds(names, g, alpha)

    def under(self, law: str) -> Any:
        """Return the model under another law of dissipation."""
        return self if law == self.law else self.slip.under(law)

    def inside(self, names: Sequence[str], log_g: Any, log_alpha: Any, g: Any) -> list[Any]:
        return self.slip.inside(names, log_g, log_alpha, g)

    def inside_slopes(self, name: str, log_g: Any, log_alpha: Any) -> tuple[Any, Any, Any]:
        return self.slip.inside_slopes(name, log_g, log_alpha)


@dataclass(frozen=True, eq=False)
class CoupledModel(OverSlip):
    """A model whose friction and wear act on the body.

    A* and B*, `arc` and `normal_load`, are those of the model itself: the first order.

    Parameters
    ----------
    slip : FittedModel
        The model under the law "slip".
    amplification : Amplification
        kappa.
    """

    amplification: Amplification
    law: str = COUPLED

    @property
    def equation(self) -> str:  # type: ignore[override]
        """What it evaluates."""
        return f"{self.slip.equation}, times kappa"

    def terms_at(
        self, g: Any, mu: Any, gamma: Any, radius: Any, xi: Any, wear: Any, alpha: Any
    ) -> tuple[Any, Any]:
        """Return friction and wear at a known g; kappa is that of the nearest load known."""
        friction, worn = self.slip.terms_at(g, mu, gamma, radius, xi, wear, alpha)
        with np.errstate(all="ignore"):
            kappa = exp(self.amplification.log_factor(g, alpha, xi, ratio(wear, mu)))
            return _times(friction, kappa), _times(worn, kappa)

    def gradient(
        self, mu: Any, gamma: Any, radius: Any, xi: Any, wear: Any, alpha: Any
    ) -> tuple[Any, ...]:
        """Return the derivatives of F_ss/T by the six quantities, in their order."""
        g, relative = quotient(gamma, mu, radius), ratio(wear, mu)
        friction, worn = self.slip.terms_at(g, mu, gamma, radius, xi, wear, alpha)
        first = self.slip.gradient(mu, gamma, radius, xi, wear, alpha)
        with np.errstate(all="ignore"):
            drag = friction + worn
            kappa = exp(self.amplification.log_factor(g, alpha, xi, relative))
            in_g, in_alpha, in_xi, in_wear = self.amplification.slopes(g, alpha, xi, relative)
            by_relative = in_wear * relative
            logs = (
                np.divide(-(in_g + by_relative), mu),
                in_g / where(np.equal(gamma, 0.0), 1.0, gamma),
                np.divide(-in_g, radius),
                in_xi,
                np.divide(in_wear, mu),
                in_alpha / alpha,
            )
            slopes = [
                kappa * (slope - (place == 1) + _times(drag, one))
                for place, (slope, one) in enumerate(zip(first, logs, strict=True))
            ]
            slopes[1] = slopes[1] + 1.0
            return tuple(float(each) if np.ndim(each) == 0 else each for each in slopes)

    def evaluated(self, mu: Any, gamma: Any, radius: Any, xi: Any, wear: Any, alpha: Any) -> Any:
        g = quotient(gamma, mu, radius)
        friction, worn = self.slip.terms_at(g, mu, gamma, radius, xi, wear, alpha)
        factor, known = self.amplification.factor_and_known(g, alpha, xi, ratio(wear, mu))
        kappa, inside = exp(factor), known & self.limits.all_hold(g, alpha)
        return _times(friction, kappa), _times(worn, kappa), inside

    def in_domain(self, mu: Any, gamma: Any, radius: Any, xi: Any, wear: Any, alpha: Any) -> Any:
        """Return whether the coupled solutions reach to the load; always where there is none."""
        with np.errstate(all="ignore"):
            g = quotient(gamma, mu, radius)
            share = self.amplification.share(g, alpha, xi, ratio(wear, mu))
            inside = np.less_equal(share, 1.0) & self.limits.holds(g, alpha)
        return bool(inside) if np.ndim(inside) == 0 else inside


def _times(term: Any, factor: Any) -> Any:
    """Return the product, 0 where the term is 0 and the factor perhaps no number."""
    return where(term == 0.0, 0.0, term * factor)

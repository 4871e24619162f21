"""A coupled law at one load: linear in wear and friction, as searches want it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from surrogate.basics.elementwise import exp
from surrogate.coupling.model import CoupledModel

__all__ = ["FrozenLoad", "frozen"]


@dataclass(frozen=True, eq=False)
class FrozenLoad(CoupledModel):
    """A coupled model whose kappa is that of one friction and one wear strength.

    A and B, `arc` and `normal_load`, are A* and B* times this kappa.

    Parameters
    ----------
    friction : float
        xi [-].
    relative_wear : float
        tau_w/mu [-].
    """

    friction: float = 0.0
    relative_wear: float = 0.0

    def arc(self, g: Any, alpha: Any) -> Any:
        return self.slip.arc(g, alpha) * self._kappa(g, alpha)

    def normal_load(self, g: Any, alpha: Any) -> Any:
        return self.slip.normal_load(g, alpha) * self._kappa(g, alpha)

    def arc_slopes(self, g: Any, alpha: Any) -> tuple[Any, Any]:
        return self._slopes_of(self.slip.arc(g, alpha), self.slip.arc_slopes(g, alpha), g, alpha)

    def normal_load_slopes(self, g: Any, alpha: Any) -> tuple[Any, Any]:
        load, slopes = self.slip.normal_load(g, alpha), self.slip.normal_load_slopes(g, alpha)
        return self._slopes_of(load, slopes, g, alpha)

    def linearised(self, g: Any, alpha: Any) -> tuple[Any, Any]:
        """Return A and xi B of a force linear in tau_w that has the law's value and slope here."""
        load = self.friction, self.relative_wear
        log_kappa, _, slope = self.amplification.load_slopes(g, alpha, *load)
        kappa, arc = exp(log_kappa), self.slip.arc(g, alpha)
        rubbed = self.friction * self.slip.normal_load(g, alpha) if self.friction else 0.0
        grown = slope * (self.relative_wear * arc + rubbed)
        return kappa * (arc + grown), kappa * (rubbed - self.relative_wear * grown)

    def friction_slope(self, g: Any, alpha: Any) -> Any:
        """Return the derivative of tau_w/mu A + xi B by xi: that of kappa counts as well."""
        load = self.friction, self.relative_wear
        log_kappa, slope, _ = self.amplification.load_slopes(g, alpha, *load)
        arc, pressed = self.slip.arc(g, alpha), self.slip.normal_load(g, alpha)
        drag = self.relative_wear * arc + self.friction * pressed
        return exp(log_kappa) * (pressed + slope * drag)

    def own_error(self, g: Any, alpha: Any) -> tuple[Any, Any]:
        """Return the bound of the relative error of kappa, and what comes on top beyond its reach.

        Both 0 without any load, where kappa is 1.
        """
        load = self.friction, self.relative_wear
        unloaded = self.friction == 0.0 and self.relative_wear == 0.0
        near = np.expm1(self.amplification.near_error(g, alpha)) * (not unloaded)
        with np.errstate(over="ignore"):
            return near, np.expm1(self.amplification.drift(g, alpha, *load))

    def reaches(self, g: Any, alpha: Any) -> Any:
        """Return whether coupled solutions reach to the load."""
        share = self.amplification.share(g, alpha, self.friction, self.relative_wear)
        return np.less_equal(share, 1.0)

    def terms_at(
        self, g: Any, mu: Any, gamma: Any, radius: Any, xi: Any, wear: Any, alpha: Any
    ) -> tuple[Any, Any]:
        friction, worn = self.slip.terms_at(g, mu, gamma, radius, xi, wear, alpha)
        kappa = self._kappa(g, alpha)
        return friction * kappa, worn * kappa

    def gradient(self, *scene: Any) -> tuple[Any, ...]:
        coupled = CoupledModel(self.slip, self.amplification)
        return coupled.gradient(*scene)

    def _kappa(self, g: Any, alpha: Any) -> Any:
        load = self.friction, self.relative_wear
        return exp(self.amplification.log_factor(g, alpha, *load))

    def _slopes_of(
        self, value: Any, slopes: tuple[Any, Any], g: Any, alpha: Any
    ) -> tuple[Any, Any]:
        load = self.friction, self.relative_wear
        in_g, in_alpha = self.amplification.slopes(g, alpha, *load)[:2]
        kappa = self._kappa(g, alpha)
        with np.errstate(all="ignore"):
            by_g = np.where(np.equal(in_g, 0.0), 0.0, value * in_g / g)
            return kappa * (slopes[0] + by_g), kappa * (slopes[1] + value * in_alpha / alpha)


def frozen(model: CoupledModel, friction: float, relative_wear: float) -> FrozenLoad:
    """Return a coupled model at one load."""
    return FrozenLoad(model.slip, model.amplification, model.law, friction, relative_wear)

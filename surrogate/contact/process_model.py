"""The model "gp": the means of Gaussian processes, which know their standard deviations."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.elementwise import log
from surrogate.contact.coordinates import (
    AT_THE_TIP,
    LOADS,
    POWER,
    coordinates,
    coordinates_of,
    tip_slope,
    vertex,
)
from surrogate.contact.domain import Domain
from surrogate.contact.fitted import PROJECTED, FittedModel, in_blocks
from surrogate.contact.wedge import wedge_functions, wedge_load, wedge_slopes

if TYPE_CHECKING:
    from surrogate.contact.process import GaussianProcess

__all__ = ["ProcessModel"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class ProcessModel(FittedModel):
    """The means of the processes, with their standard deviations.

    Parameters
    ----------
    limits : Domain
        Its domain.
    processes : mapping of str to GaussianProcess
        Of the quantities of `surrogate.contact.coordinates`.
    touch_error : float
        Standard error of ln g_touch, which the standard deviation of delta contains [-].
    truncation : float
        What the solutions' finite body does to B and B*, relative to sqrt(g), which their standard
        deviations contain [-].
    """

    limits: Domain
    processes: Mapping[str, GaussianProcess] = field(repr=False)
    touch_error: float = 0.0
    truncation: float = 0.0
    name: str = "gp"
    uncertain: bool = True
    equation: str = "Gaussian processes"
    law: str = PROJECTED

    @property
    def functions(self) -> tuple[str, ...]:  # type: ignore[override]
        """Names of the functions that `contact` takes."""
        return tuple(self.processes)

    def inside(self, names: Sequence[str], log_g: Any, log_alpha: Any, g: Any) -> list[Any]:
        at, scales = self._at(log_g, log_alpha)
        values = [
            _value(n, self.processes[n].predict_mean(self._for(n, at)), scales) for n in names
        ]
        return [float(v[0]) for v in values] if type(log_g) is float else values

    def inside_slopes(self, name: str, log_g: Any, log_alpha: Any) -> tuple[Any, Any, Any]:
        at, scales = self._at(log_g, log_alpha)
        at = self._for(name, at)
        process = self.processes[name]
        value = _value(name, process.predict_mean(at), scales)
        slopes = process.gradient(at)
        touch, bend = self.limits.log_touch_slopes(at[:, 1])
        x = at[:, 0] - touch
        past = (tip_slope(x) if name in AT_THE_TIP else x >= 0.0) * slopes[:, 2]
        in_g = wedge_slopes(at[:, 0])[name] + slopes[:, 0] + past
        in_alpha = slopes[:, 1] - bend * past
        size = value
        if name == "distance":
            size = value - 1.0
            with np.errstate(all="ignore"):
                steep = np.where(x < 0.0, POWER / x, 0.0)
            in_g, in_alpha = in_g + steep, in_alpha - steep * bend
        found = value, size * in_g, size * in_alpha
        return tuple(float(f[0]) for f in found) if type(log_g) is float else found  # type: ignore[return-value]

    def stds(self, names: Sequence[str], g: Any, alpha: Any) -> list[Any]:
        """Return the standard deviations of A, B or delta, as named; nan outside the domain."""
        scalar = type(g) is float and type(alpha) is float
        found = in_blocks(lambda *at: self._stds(names, *at), len(names), g, alpha)
        return [float(std) for std in found] if scalar else found

    def _stds(self, names: Sequence[str], g: Array, alpha: Any) -> list[Array]:
        at, scales = self._at(*self.limits.clamped(log(g), log(alpha)))
        inside = self.limits.holds(g, alpha)
        stds = []
        for name in names:
            mean, std = self.processes[name].predict(self._for(name, at))
            size = _value(name, mean, scales) - (1.0 if name == "distance" else 0.0)
            if name == "distance":
                x = np.minimum(at[:, 0] - self.limits.log_touch(at[:, 1]), -self.touch_error)
                std = np.hypot(std, POWER * self.touch_error / x)
            elif name in LOADS:
                std = np.hypot(std, self.truncated(at[:, 0]))
            stds.append(np.where(inside, size * std, np.nan))
        return stds

    def truncated(self, log_g: Array) -> Array:
        """Return what the solutions' finite body does to B and B*, relative."""
        return self.truncation * np.exp(0.5 * log_g)

    def _for(self, name: str, at: Array) -> Array:
        """Return the coordinates of points as the process of a quantity has them."""
        if name not in AT_THE_TIP:
            return at
        return coordinates_of(name, at[:, 0], at[:, 1], self.limits.log_touch(at[:, 1]))

    def _at(self, log_g: Any, log_alpha: Any) -> tuple[Array, dict[str, Array]]:
        """Return the coordinates of points, and A, B and delta - 1 where the quantities are 0."""
        touch = self.limits.log_touch(log_alpha)
        at = coordinates(log_g, log_alpha, touch)
        rows = at[:, 0]
        scales = wedge_functions(rows, wedge_load(rows))
        return at, scales | {"distance": scales["distance"] * vertex(rows - touch)}


def _value(name: str, quantity: Array, scales: Mapping[str, Array]) -> Array:
    value = scales[name] * np.exp(quantity)
    return 1.0 + value if name == "distance" else value

"""ln kappa of the law "coupled" in the ranges of a prepared force: a polynomial of what varies.

Its variables are x = ln(g/g_touch), y = ln alpha, xi and w = ln(1 + tau_w/mu). Those that do not
vary are put in once. The ranges are within the reach, as was proven before, so that nothing has to
be looked up at a call.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from surrogate.basics.elementwise import dense, exp, log
from surrogate.contact.coordinates import log_touch
from surrogate.coupling.amplification import Amplification
from surrogate.coupling.polynomial import Polynomial, horner, of_one_number
from surrogate.scene import NAMES

__all__ = ["Load", "Strength", "log1p"]

MU, GAMMA, RADIUS, XI, WEAR, ALPHA = NAMES
BLOCK = 2**13
"""Points at a time, which stay in the cache."""
_OF = {"x": {MU, GAMMA, RADIUS, ALPHA}, "y": {ALPHA}, "xi": {XI}, "w": {MU, WEAR}}
"""What each variable depends on."""


def log1p(x: Any) -> Any:
    """Return ln(1 + x).

    Examples
    --------
    >>> log1p(0.0)
    0.0
    """
    return float(np.log1p(x)) if type(x) is float else np.log1p(dense(x))


@dataclass(frozen=True, eq=False)
class Load:
    """The factor kappa of the quantities that vary.

    Parameters
    ----------
    kappa : Amplification
        The whole of it.
    fixed : mapping of str to float
        The quantities that do not vary.

    Examples
    --------
    >>> from surrogate.coupling.shipped import amplification
    >>> scene = dict(zip(NAMES, (5e3, 1.0, 0.1e-3, 0.001, 100.0, 6.0)))
    >>> load = Load(amplification(), {name: scene[name] for name in (MU, XI, WEAR, ALPHA)})
    >>> off = load.factor(scene) / np.exp(load.kappa.log_factor(2.0, 6.0, 0.001, 0.02)) - 1.0
    >>> load.varies, bool(abs(off) < 1e-9)
    (('x',), True)
    """

    kappa: Amplification
    fixed: Mapping[str, float]

    @cached_property
    def varies(self) -> tuple[str, ...]:
        """Which of "x", "y", "xi" and "w" vary."""
        moves = {variable: not names <= self.fixed.keys() for variable, names in _OF.items()}
        moves["w"] = moves["w"] and self.fixed.get(WEAR) != 0.0
        return tuple(variable for variable, does in moves.items() if does)

    @cached_property
    def polynomial(self) -> Polynomial:
        """ln kappa, of those that vary, x and y less their center."""
        filled = {name: self.fixed.get(name, 1.0) for name in NAMES}
        values = [
            None if variable in self.varies else self._one(variable, filled, log, log1p)
            for variable in _OF
        ]
        about = [self.center.get(variable, 0.0) for variable in _OF]
        return self.kappa.polynomial.about(about).collapsed(values)

    @cached_property
    def center(self) -> dict[str, float]:
        """The middle of what is known in x and y, about which the terms of ln kappa are small."""
        x, y, _ = self.kappa.axes
        return {"x": 0.5 * float(x[0] + x[-1]), "y": 0.5 * float(y[0] + y[-1])}

    @cached_property
    def touch(self) -> float:
        """ln g at the center of x, at the one alpha."""
        touch = log_touch(self.kappa.touch, log(self.fixed[ALPHA]))
        return float(touch) + self.center["x"]

    def variables(
        self,
        v: Mapping[str, Any],
        ln: Callable[[Any], Any] = log,
        ln1p: Callable[[Any], Any] = log1p,
    ) -> list[Any]:
        """Return the variables of the polynomial, by the logarithms of their namespace."""
        return [self._one(variable, v, ln, ln1p) for variable in self.varies]

    def _one(
        self,
        variable: str,
        v: Mapping[str, Any],
        ln: Callable[[Any], Any],
        ln1p: Callable[[Any], Any],
    ) -> Any:
        if variable == "xi":
            return v[XI]
        if variable == "w":
            relative = v[WEAR] / v[MU]
            return log1p(relative) if type(relative) is float else ln1p(relative)
        if variable == "y":
            return ln(v[ALPHA]) - self.center["y"]
        g = v[GAMMA] / (v[MU] * v[RADIUS])
        log_g = log(g) if type(g) is float else ln(g)
        if ALPHA in self.fixed:
            return log_g - self.touch
        return log_g - log_touch(self.kappa.touch, ln(v[ALPHA])) - self.center["x"]

    def factor(self, v: Mapping[str, Any]) -> Any:
        """Return kappa of six quantities, floats or blocks of numbers."""
        return exp(self.polynomial(*self.variables(v)))

    def powers(self) -> tuple[float, ...]:
        """Return ln kappa in rising powers of the one variable that varies."""
        row = np.zeros(int(self.polynomial.powers.max(initial=0)) + 1)
        np.add.at(row, self.polynomial.powers[:, 0], self.polynomial.coefficients)
        return tuple(row.tolist())


@dataclass(frozen=True, eq=False)
class Strength:
    """The force of xi or tau_w alone, rest + (constant + v slope) kappa.

    Parameters
    ----------
    rest, constant, slope : float
        As above [N/m].
    mu : float or None
        The shear modulus where v is tau_w, of which ln kappa has w = ln(1 + v/mu) [Pa].
    powers : tuple of float
        ln kappa in rising powers of v or w.

    Examples
    --------
    >>> force = Strength(1.0, 2.0, 4.0, None, (0.0, 0.0))
    >>> force.number(0.5), force.of(np.array([0.5]))
    (5.0, array([5.]))
    """

    rest: float
    constant: float
    slope: float
    mu: float | None
    powers: tuple[float, ...]

    @property
    def number(self) -> Callable[[float], float]:
        """The force of a float."""
        rest, constant, slope, mu = self.rest, self.constant, self.slope, self.mu
        log_kappa, exp_of, one_more = of_one_number(self.powers), np.exp, np.log1p

        def force(value: float) -> float:
            variable = value if mu is None else float(one_more(value / mu))
            return rest + (constant + value * slope) * float(exp_of(log_kappa(variable)))

        return force

    def of(self, values: Any, out: Any = None) -> Any:
        """Return the forces of an array of float64 or float32, or put them into `out`."""
        result = np.empty(values.shape) if out is None else out
        flat, target = np.ascontiguousarray(values).reshape(-1), result.reshape(-1)
        with np.errstate(all="ignore"):
            for begin in range(0, flat.size, BLOCK):
                some = slice(begin, begin + BLOCK)
                v = flat[some].astype(float)
                variable = v if self.mu is None else np.log1p(v / self.mu)
                log_kappa = horner(self.powers, variable, np.empty(v.shape))
                np.exp(log_kappa, out=log_kappa)
                v *= self.slope
                v += self.constant
                v *= log_kappa
                np.add(v, self.rest, out=target[some], casting="same_kind")
        return result

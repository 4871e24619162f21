"""What a prepared force does at a call, and how: floats and blocks of numbers through one plan.

    F_ss/T = Gamma_o + 2 R_w [tau_w A + xi mu B] kappa,

with A and B each of Eq. (13) (A = 2, B = 2 + g/2), or of another closed form, or of the table. At
one alpha the table is a `Line`; where also tau_w, xi and mu are fixed, both lines are one. kappa is
1 but under the law "coupled", where the table gives both terms.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from surrogate.basics.elementwise import log
from surrogate.contact.closed_forms import ClosedForm
from surrogate.contact.domain import g_range
from surrogate.contact.fitted import PROJECTED
from surrogate.contact.table import TableModel
from surrogate.coupling.amplification import Amplification
from surrogate.coupling.model import CoupledModel
from surrogate.prepared.line import Line, line_of, summed
from surrogate.prepared.load import Load, Strength
from surrogate.prepared.straight import Straight
from surrogate.scene import NAMES

__all__ = [
    "ALPHA",
    "ARC",
    "GAMMA",
    "LOAD",
    "MU",
    "RADIUS",
    "RUBBING",
    "WEAR",
    "WITHOUT_SHEAR",
    "XI",
    "Plan",
]

ARC, LOAD = "arc", "normal_load"
WITHOUT_SHEAR, RUBBING = "without shear on the wire", "on which the wire rubs"
"""The finite elements beside which an error is."""
ROUNDING = 1e-9
MU, GAMMA, RADIUS, XI, WEAR, ALPHA = NAMES
FACTORS = {ARC: (WEAR, RADIUS), LOAD: (RADIUS, XI, MU)}
"""What A and B, or what stands for them, are multiplied by, beside 2."""


@dataclass(frozen=True, eq=False)
class Plan:
    """How a force is evaluated.

    Parameters
    ----------
    varying : tuple of str
        Names of the quantities that vary.
    ranges : mapping of str to tuple of float
        The ends of all six quantities.
    form : ClosedForm
        What gives the terms that the table does not.
    table : TableModel or None
        What gives the terms named by `of_table`.
    of_table : tuple of str
        "arc" and "normal_load", as far as the table gives them.
    law : str
        The law of dissipation, which says what these are; that of the table.
    kappa : Amplification, optional
        What the terms of the table are multiplied by, known all over the ranges.
    """

    varying: tuple[str, ...]
    ranges: Mapping[str, tuple[float, float]]
    form: ClosedForm
    table: TableModel | None = field(repr=False)
    of_table: tuple[str, ...]
    law: str = PROJECTED
    kappa: Amplification | None = field(default=None, repr=False)

    @cached_property
    def load(self) -> Load | None:
        """kappa of what varies; None where it is 1."""
        return None if self.kappa is None else Load(self.kappa, self.fixed)

    @cached_property
    def fixed(self) -> dict[str, float]:
        """The quantities that do not vary."""
        return {name: self.ranges[name][0] for name in NAMES if name not in self.varying}

    @cached_property
    def lines(self) -> dict[str, Line]:
        """The functions of the table at the one alpha; none where alpha varies."""
        if self.table is None or ALPHA not in self.fixed:
            return {}
        cells, row = self.table.table, log(self.fixed[ALPHA])
        names = dict(zip((ARC, LOAD), self.table.rubbing, strict=True))
        return {term: line_of(cells, names[term], row) for term in self.of_table}

    @cached_property
    def one_line(self) -> Line | None:
        """2 (tau_w A + xi mu B) of the terms that the table gives, where it needs ln g alone."""
        if not self.lines or {MU, XI, WEAR} & set(self.varying):
            return None
        factors = {
            ARC: 2.0 * self.fixed[WEAR],
            LOAD: 2.0 * self.fixed[XI] * self.fixed[MU],
        }
        return summed(self.lines, factors)

    @cached_property
    def one_number(self) -> Callable[[float], float]:
        """The force of the one quantity that varies, as a function of a float."""
        (name,) = self.varying
        if self.straight is not None:
            return self.straight.number
        fixed = self.fixed
        return lambda value: float(self.of(**fixed, **{name: value}))

    @cached_property
    def straight(self) -> Straight | Strength | None:
        """The force of the one quantity that varies at one alpha; None elsewhere."""
        if len(self.varying) != 1 or self.varying == (ALPHA,):
            return None
        (name,) = self.varying
        if self.load and name == MU and self.fixed[WEAR]:
            return None  # kappa is of two variables then
        products = [(self._product(*term, name), name in term[1]) for term in self.free]
        constant = sum(value for value, contains in products if not contains)
        slope = sum(value for value, contains in products if contains)
        factors = self.factors(name)
        if name in (XI, WEAR):
            return self._of_strength(name, constant, slope, factors)
        return self._on_lines(name, constant, slope, factors)

    def _of_strength(
        self, name: str, constant: float, slope: float, factors: dict[str, float]
    ) -> Straight | Strength:
        """Return the force of xi or tau_w, at one g."""
        log_g = log(self._product(1.0, (GAMMA,)) / self._product(1.0, (MU, RADIUS)))
        rest, rate = (0.0, 0.0) if self.load else (constant, slope)
        for term, line in self.lines.items():
            value = factors[term] * line.number(log_g)
            rest, rate = (rest, rate + value) if name in FACTORS[term] else (rest + value, rate)
        if self.load is None:
            return Straight(rest, rate, 0.0, 1.0, None, None)
        mu = self.fixed[MU] if name == WEAR else None
        return Strength(constant, rest, rate, mu, self.load.powers())

    def _on_lines(
        self, name: str, constant: float, slope: float, factors: dict[str, float]
    ) -> Straight:
        """Return the force of a quantity that g depends on."""
        times, plain = (
            {term: line for term, line in self.lines.items() if (name in FACTORS[term]) is within}
            for within in (True, False)
        )
        if not self.lines:
            return Straight(constant, slope, 0.0, 1.0, None, None)
        above = self._product(1.0, (GAMMA,), name)
        start = log(above / self._product(1.0, (MU, RADIUS), name))
        touch = next(iter(self.lines.values())).touch
        return Straight(
            constant,
            slope,
            start - touch,
            1.0 if name == GAMMA else -1.0,
            summed(times, factors) if times else None,
            summed(plain, factors) if plain else None,
            self._side(touch),
            self.load.powers() if self.load else (),
            touch - self.load.touch if self.load else 0.0,
        )

    def factors(self, name: str) -> dict[str, float]:
        """Return what A and B are multiplied by, but for the one quantity that varies."""
        return {term: self._product(2.0, names, name) for term, names in FACTORS.items()}

    def _side(self, touch: float) -> int:
        """Return -1 or 1 where the whole range is short of or past the touch, else 0."""
        first, last = (g * float(np.exp(-touch)) for g in self.g_ends())
        return -1 if last < 1.0 - ROUNDING else 1 if first > 1.0 + ROUNDING else 0

    @cached_property
    def free(self) -> tuple[tuple[float, tuple[str, ...]], ...]:
        """What the table does not give: coefficients of products of quantities, by their names."""
        form = self.form
        terms: list[tuple[float, tuple[str, ...]]] = [(1.0, (GAMMA,))]
        if ARC not in self.of_table:
            terms += [(form.arc_2, FACTORS[ARC])]
        if LOAD not in self.of_table:
            terms += [(form.load_2, FACTORS[LOAD]), (form.load_2_slope, (XI, GAMMA))]
        return tuple(term for term in terms if term[0])

    def _product(self, coefficient: float, names: Sequence[str], without: str = "") -> float:
        for name in names:
            coefficient *= 1.0 if name == without else self.fixed[name]
        return coefficient

    def g_ends(self) -> tuple[float, float]:
        """Return the ends of g."""
        return g_range(self.ranges)

    def gradient(self, **values: Any) -> dict[str, Any]:
        """Return the derivatives of the force by all six quantities, by their names."""
        six = [values[name] for name in NAMES]
        plain, table = ([0.0, 1.0, 0.0, 0.0, 0.0, 0.0] for _ in range(2))
        if len(self.of_table) < 2:
            plain = self._part(self.form, six, [t for t in (ARC, LOAD) if t not in self.of_table])
        if self.table is not None:
            model = CoupledModel(self.table, self.kappa) if self.kappa else self.table
            table = self._part(model, six, list(self.of_table))
        slopes = dict(zip(NAMES, (a + b for a, b in zip(plain, table, strict=True)), strict=True))
        return slopes | {GAMMA: slopes[GAMMA] - 1.0}

    def _part(self, model: Any, six: list[Any], terms: list[str]) -> list[Any]:
        """Return the derivatives of the cleavage and of some terms by one model."""
        mu, gamma, radius, xi, wear, alpha = six
        slopes = list(
            model.gradient(
                mu,
                gamma,
                radius,
                xi if LOAD in terms else 0.0,
                wear if ARC in terms else 0.0,
                alpha,
            )
        )
        slopes[3] = slopes[3] if LOAD in terms else 0.0
        slopes[4] = slopes[4] if ARC in terms else 0.0
        return slopes

    def of(self, **values: Any) -> Any:
        """Return the force of the six quantities, floats or arrays of one shape."""
        mu, gamma, radius = values[MU], values[GAMMA], values[RADIUS]
        xi, wear, alpha = values[XI], values[WEAR], values[ALPHA]
        friction, worn = self.form.terms(mu, gamma, radius, xi, wear, alpha)
        total = gamma
        kappa = self.load.factor(values) if self.load and self.of_table else None
        if self.of_table:
            log_g = log(gamma / (mu * radius))
            if self.one_line is not None:
                value = self._line(self.one_line, log_g)
                total = total + _times(radius * value, kappa)
            else:
                arc, load = self._functions(log_g, alpha)
                if ARC in self.of_table:
                    total = total + _times(2.0 * (wear * radius) * arc, kappa)
                if LOAD in self.of_table:
                    total = total + _times(2.0 * (radius * (xi * mu)) * load, kappa)
        if LOAD not in self.of_table:
            total = total + friction
        if ARC not in self.of_table:
            total = total + worn
        return total

    def _functions(self, log_g: Any, alpha: Any) -> tuple[Any, Any]:
        """Return A and B, as far as the table gives them."""
        assert self.table is not None
        found: dict[str, Any] = {}
        if not self.lines:
            names = dict(zip((ARC, LOAD), self.table.rubbing, strict=True))
            wanted = [names[term] for term in self.of_table]
            row = log(alpha)
            if isinstance(log_g, np.ndarray) or isinstance(row, np.ndarray):
                log_g, row = (np.array(each) for each in np.broadcast_arrays(log_g, row))
            _, values = self.table.table.at(wanted, log_g, row)
            found = dict(zip(self.of_table, values, strict=True))
        elif isinstance(log_g, np.ndarray):
            first = next(iter(self.lines.values()))
            place = first.place(log_g - first.touch)
            found = {term: line.values(*place) for term, line in self.lines.items()}
        else:
            found = {term: line.number(log_g) for term, line in self.lines.items()}
        return found.get(ARC), found.get(LOAD)

    @staticmethod
    def _line(line: Line, log_g: Any) -> Any:
        if isinstance(log_g, np.ndarray):
            return line.values(*line.place(log_g - line.touch))
        return line.number(log_g)


def _times(term: Any, kappa: Any) -> Any:
    return term if kappa is None else term * kappa

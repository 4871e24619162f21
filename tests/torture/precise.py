"""The fitted models in 50 digits, each by its own definition, from the numbers in their file."""

import time
from functools import cached_property
from itertools import pairwise

import mpmath
import numpy as np

from surrogate.contact.coordinates import (
    AT_THE_TIP,
    QUANTITIES,
    RISE,
    SLIP_QUANTITIES,
    STEP,
    WITHIN,
)
from surrogate.contact.process import JITTER
from surrogate.contact.shipped import shipped

from .exact import mp
from .part import Part

__all__ = ["Precise", "precise"]

WANTED = 1e-9
"""Largest relative error of any function, and so of any force."""


def polynomial(coefficients, x):
    """Return a polynomial of rising powers."""
    value = mp(0)
    for coefficient in reversed(coefficients):
        value = value * x + mp(coefficient)
    return value


def wedge(log_g):
    """Return A, B, delta/R_w, A* and B* of the linear wedge."""
    third = mpmath.pi / 3
    k = (32 * mpmath.sqrt(mpmath.e / mpmath.pi)) ** (mp(2) / 3) * mpmath.exp(-2 * log_g / 3)
    p = third / mpmath.lambertw(k * third).real
    distance = 8 * p**2 / mpmath.pi * mpmath.exp(-log_g)
    arc, load = 4 * mpmath.sqrt(p / mpmath.pi), 4 * p
    names = QUANTITIES + SLIP_QUANTITIES
    return dict(zip(names, (arc, load, distance, arc, load), strict=True)), p


class Precise:
    """The models of one file."""

    def __init__(self, fitted):
        self.fitted, self.limits = fitted, fitted.limits

    def values(self, model, g, alpha):
        """Return every function anywhere, from the nearest point inside on."""
        log_g, log_alpha = mpmath.log(mp(g)), mpmath.log(mp(alpha))
        (low, high), (first, last) = (map(mpmath.log, ends) for ends in self._ends)
        row = min(max(log_alpha, first), last)
        at = min(max(log_g, low), min(high, self._highest(row)))
        inside = getattr(self, "_" + model.replace("-", "_"))(at, row)
        return {n: self._continued(n, inside[n], log_g, at, row) for n in self.names}

    @property
    def names(self):
        """The functions that the file has."""
        return tuple(self.fitted.processes)

    def _highest(self, row):
        """Return ln of the highest g at ln alpha, straight between its corners."""
        corners = [(mpmath.log(mp(a)), mpmath.log(mp(g))) for a, g in self.limits.highest]
        if not corners:
            return mpmath.log(mp(self.limits.g[1]))
        if row <= corners[0][0]:
            return corners[0][1]
        for (x0, y0), (x1, y1) in pairwise(corners):
            if row <= x1:
                return y0 + (y1 - y0) * (row - x0) / (x1 - x0)
        return corners[-1][1]

    @cached_property
    def _ends(self):
        return [[mp(end) for end in ends] for ends in (self.limits.g, self.limits.alpha)]

    def _continued(self, name, value, log_g, at, row):
        if log_g < at:
            (seam, p_seam), (far, p) = wedge(at), wedge(log_g)
            return far[name] * mpmath.exp(mpmath.log(value / seam[name]) * p / p_seam)
        if log_g > at and name in self.limits.growth:
            return value * mpmath.exp(polynomial(self.limits.growth[name], row) * (log_g - at))
        if log_g > at and name == "distance":
            way = self._touch(row) - at
            left = max(1 - (log_g - at) / way, mp(0)) if way > 0 else mp(0)
            return 1 + (value - 1) * left ** mp(1.75)
        return value

    def _touch(self, row):
        return polynomial(self.limits.touch, row)

    def _power_law(self, at, row):
        a, c = ([mp(x) for x in self.fitted.constants[name]] for name in ("arc", "distance"))
        y = 1 - 2 * mpmath.exp(-row)

        def saturated(log_end, power):
            return at - mpmath.log(1 + mpmath.exp(power * (at - log_end))) / power

        k = mpmath.sqrt(1 + a[0] * ((2 / (1 - y)) ** 2 - 4))
        arc = 2 / k * mpmath.sin(k * wedge(saturated(a[1] + a[2] * y, 2))[0]["arc"] / 2)
        dip = a[3] * (1 - y) * mpmath.exp(-((at - a[4] - a[5] * y) ** 2) / 2)

        def joined(name):
            b = [mp(x) for x in self.fitted.constants[name]]
            power = mpmath.exp(b[1] + b[2] * y + b[3] * y**2 + (b[4] + b[5] * y) * at)
            return wedge(saturated(b[0], 1))[0][name] + power + at_tip(name, b)

        def at_tip(name, b):
            if len(b) < 10 or at < self._touch(row):
                return mp(0)
            m = b[8] + b[9] * y
            below = mp(0) if name == "slip_arc" else mpmath.exp(m * self._touch(row))
            return mpmath.exp(b[6] + b[7] * y) * (mpmath.exp(m * at) - below)

        distance, x = mp(1), at - self._touch(row)
        if x < 0:
            left = 1 - mpmath.exp((c[0] + c[1] * y) * x)
            distance += wedge(at)[0]["distance"] * left ** (c[2] + c[3] * y)
        found = {name: joined(name) for name in self.names if name not in ("arc", "distance")}
        return {**found, "arc": arc * (1 - dip), "distance": distance}

    def _table(self, at, row):
        grid, touch = self.fitted.table.grid, self._touch(row)
        low, (first, last) = mp(grid.log_g), map(mp, grid.log_alpha)
        x = at - touch
        per_x = grid.short / (touch - low) if x < 0 else mp(grid.past) / mp(grid.beyond)
        t, s = per_x * x + grid.short, (row - first) * grid.stiffening / (last - first)
        i = min(max(int(t), 0), grid.cells - 1)
        j = min(max(int(s), 0), grid.stiffening - 1)
        found = {}
        for name in self.names:
            cell = self.fitted.table.cells(name)[i * grid.stiffening + j].reshape(4, 4)
            found[name] = polynomial([polynomial(row_of, s - j) for row_of in cell], t - i)
        found["distance"] = 1 + (-x) ** mp(1.75) * found["distance"] if x < 0 else mp(1)
        return found

    def _gp(self, at, row):
        x = at - self._touch(row)
        scales = wedge(at)[0]
        found = {}
        for name in self.names:
            last = max(x, mp(0))
            if name in AT_THE_TIP:
                last = x + STEP if x >= 0 else RISE * mpmath.expm1(x / mp(WITHIN))
            quantity = self._mean(name, [at, row, last])
            found[name] = scales[name] * mpmath.exp(quantity)
        found["distance"] = 1 + (-x) ** mp(1.75) * found["distance"] if x < 0 else mp(1)
        return found

    def _mean(self, name, at):
        process, points, weights = self._solved[name]
        return mp(process.mean) + mpmath.fdot(covariances(process, points, at), weights)

    @cached_property
    def _solved(self):
        return {name: solved(process) for name, process in self.fitted.processes.items()}


def covariances(process, points, at):
    """Return the prior covariances of points with one place."""
    lengths = [mp(length) for length in process.lengths]
    variance = mp(process.variance)

    def squared(one):
        return sum(((p - x) / w) ** 2 for p, x, w in zip(one, at, lengths, strict=True))

    return [variance * mpmath.exp(-squared(one) / 2) for one in points]


def solved(process):
    """Return a process, the points that carry its prediction, and their weights."""
    inputs = [[mp(x) for x in point] for point in process.inputs]
    active = [inputs[i] for i in process.active]
    values = [mp(v) - mp(process.mean) for v in process.values]
    k_uf = [covariances(process, inputs, point) for point in active]
    over = [[k / mp(n) for k, n in zip(row, process.noise, strict=True)] for row in k_uf]
    system = mpmath.matrix(len(active))
    for i, row in enumerate(over):
        for j in range(i + 1):
            known = mpmath.fdot(row, k_uf[j]) + k_uf[i][process.active[j]]
            system[i, j] = system[j, i] = known
        system[i, i] += mp(JITTER) * mp(process.variance)
    right = mpmath.matrix([mpmath.fdot(row, values) for row in over])
    return process, active, list(mpmath.lu_solve(system, right))


def precise(number=300, models=("power-law", "table", "gp"), seed=0):
    """Compare the fitted models with themselves in 50 digits, inside and outside their domain.

    Parameters
    ----------
    number : int
        Points for each model; a fifth of them outside the domain.
    models : sequence of str
        Their names.
    seed : int
        Of the points.
    """
    part = Part("precise", "Fitted models against themselves in 50 digits")
    start, random = time.monotonic(), np.random.default_rng(seed)
    fitted = shipped()
    reference, limits = Precise(fitted), fitted.limits
    log_g, alpha = random.uniform(*limits.log_g, number), random.uniform(*limits.alpha, number)
    log_g[: number // 5] = random.uniform(-690.0, 690.0, number // 5)
    alpha[: number // 10] = random.uniform(1.0, 20.0, number // 10)
    for model in models:
        worst = 0.0
        for g, a in zip(np.exp(log_g).tolist(), alpha.tolist(), strict=True):
            names = reference.names
            values = fitted.models[model].contact(names, g, a)
            exact = reference.values(model, g, a)
            errors = [abs(mp(v) / exact[n] - 1) for n, v in zip(names, values, strict=True)]
            error = float(max(errors))
            worst = max(worst, error)
            if not error <= WANTED:
                part.fail(model, "inexact", f"{model}(g = {g!r}, alpha = {a!r}): {error:.2g}")
            else:
                part.count(model, f"within {WANTED:g}")
        part.notes.append(f"{model}: relative errors of every function up to {worst:.1e}")
    part.seconds = time.monotonic() - start
    return part

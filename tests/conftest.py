"""Force models of tests only, whose A and B run like those of finite elements."""

from dataclasses import dataclass
from functools import wraps
from types import MappingProxyType

import numpy as np
import pytest

from surrogate.basics.checks import STIFFENING_EXPONENT, Quantity
from surrogate.basics.elementwise import quotient, where
from surrogate.choosing import by_name
from surrogate.contact.base import ForceModel
from surrogate.equations import DIMENSIONLESS_TOUGHNESS


def plain(function):
    """Return the function with Python floats for numbers, without numpy's warnings.

    Numbers are evaluated as arrays of one: a power of numbers may differ from one of arrays.
    """

    @wraps(function)
    def call(self, g, alpha):
        shape = np.broadcast_shapes(np.shape(g), np.shape(alpha))
        g, alpha = (np.atleast_1d(np.asarray(each, dtype=float)) for each in (g, alpha))
        with np.errstate(all="ignore"):
            result = function(self, g, alpha)
        if isinstance(result, tuple):
            return tuple(_shaped(each, shape) for each in result)
        return _shaped(result, shape)

    return call


def _shaped(values, shape):
    return values if shape and np.ndim(values) else float(np.asarray(values).reshape(-1)[0])


class TestModel(ForceModel):
    """Terms by the plain formula, defined wherever g is."""

    __test__ = False
    equation = "of a test"
    domain = "any"
    stiffening = STIFFENING_EXPONENT

    def terms(self, mu, gamma, radius, xi, wear, alpha):
        with np.errstate(all="ignore"):
            g = quotient(gamma, mu, radius)
            friction = where(xi == 0.0, 0.0, 2.0 * radius * xi * mu * self.normal_load(g, alpha))
            return friction, where(wear == 0.0, 0.0, 2.0 * radius * wear * self.arc(g, alpha))

    def in_domain(self, mu, gamma, radius, xi, wear, alpha):
        return gamma >= 0.0


@dataclass(frozen=True)
class Elements(TestModel):
    """A rises as the logarithm of the far-field wedge, peaks near 2 and falls; B grows."""

    name: str = "elements"
    g: Quantity = DIMENSIONLESS_TOUGHNESS
    errors: tuple[float, float] | None = None

    @plain
    def arc(self, g, alpha):
        return _stiffened(2.9 * self._rise(g) ** -0.5 * (1.0 + g / 25.0) ** -0.5, alpha)

    @plain
    def normal_load(self, g, alpha):
        return 2.4 / self._rise(g) + 0.5 * np.power(g, _exponent(alpha))

    @plain
    def arc_slopes(self, g, alpha):
        arc = self.arc(g, alpha)
        slope = arc * (-0.5 * self._rise_slope(g) / self._rise(g) - 0.5 / (25.0 + g))
        return np.where(g == 0.0, np.inf, slope), -0.1 * arc / alpha

    @plain
    def normal_load_slopes(self, g, alpha):
        n = _exponent(alpha)
        slope = -2.4 * self._rise_slope(g) / self._rise(g) ** 2 + 0.5 * n * np.power(g, n - 1.0)
        in_alpha = -0.015 * np.power(g, n) * np.log(g)
        return np.where(g == 0.0, np.inf, slope), np.where(g == 0.0, 0.0, in_alpha)

    def contact_std(self, g, alpha):
        return self.errors

    @staticmethod
    def _rise(g):
        return 1.0 + 0.5 * np.log1p(20.0 / g)

    @staticmethod
    def _rise_slope(g):
        return -10.0 / (g * (g + 20.0))


def _stiffened(value, alpha):
    return value * (0.5 * alpha) ** -0.1


def _exponent(alpha):
    return 1.18 - 0.03 * (alpha - 2.0)


@dataclass(frozen=True)
class Bump(TestModel):
    """A with one narrow peak, 2 at g = 5 and 0.3 far from it, and no B: two toughnesses fit."""

    name: str = "bump"
    g: Quantity = DIMENSIONLESS_TOUGHNESS
    base: float = 0.3

    @plain
    def arc(self, g, alpha):
        return self.base + (2.0 - self.base) * self._peak(g)

    @plain
    def normal_load(self, g, alpha):
        return 0.0

    @plain
    def arc_slopes(self, g, alpha):
        slope = -2.0 * (2.0 - self.base) * self._peak(g) * np.log(g / 5.0) / g
        return np.where(g == 0.0, 0.0, slope), 0.0

    @plain
    def normal_load_slopes(self, g, alpha):
        return 0.0, 0.0

    @staticmethod
    def _peak(g):
        return np.exp(-(np.log(g / 5.0) ** 2))


@pytest.fixture
def register(monkeypatch):
    """Return a function that makes a model known by its name for one test."""

    def add(model):
        known = {**by_name.FORCE_MODELS, model.name: model}
        monkeypatch.setattr(by_name, "FORCE_MODELS", MappingProxyType(known))
        return model

    return add


@pytest.fixture
def elements(register):
    return register(Elements())


@pytest.fixture
def bump(register):
    return register(Bump())


@pytest.fixture
def elements_like():
    """Return the class of `elements`, to make others."""
    return Elements


@pytest.fixture
def bump_like():
    return Bump

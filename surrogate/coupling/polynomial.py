"""A polynomial of four variables, for floats and arrays alike, with its derivatives.

It is evaluated by Horner's rule variable by variable, the first one outermost: what depends on
floats alone is collapsed to floats, so that an array of radii costs one polynomial of ln g.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["Polynomial", "horner", "of_one_number"]


@dataclass(frozen=True, eq=False)
class Polynomial:
    """A sum of coefficients times powers of variables.

    Parameters
    ----------
    powers : ndarray of int, shape (terms, variables)
        Of each variable in each term.
    coefficients : ndarray, shape (terms,)
        Of the terms.

    Examples
    --------
    >>> powers = np.array([[1, 0, 0, 2], [0, 3, 0, 0]])
    >>> cubic = Polynomial(powers, np.array([2.0, 1.0]))
    >>> cubic(2.0, 3.0, 5.0, 0.5)
    28.0
    >>> cubic.derivatives[3](2.0, 3.0, 5.0, 0.5)
    4.0
    """

    powers: NDArray[np.int64]
    coefficients: NDArray[np.float64]

    def __call__(self, *variables: Any) -> Any:
        """Return the value at floats or at arrays that broadcast."""
        first, *others = variables
        if type(first) is np.ndarray and all(
            type(other) is np.ndarray and other.shape == first.shape for other in others
        ):
            return self._in_place(*variables, *np.empty((len(variables), *first.shape)))
        return self._plain(*variables)

    @cached_property
    def _plain(self) -> Callable[..., Any]:
        """The value at floats, or at some arrays; what depends on floats alone is a float."""
        return self._written("{target} = {left} {sign} {right}")

    @cached_property
    def _in_place(self) -> Callable[..., Any]:
        """The same at arrays of one shape, with an array of that shape for each variable."""
        return self._written("{name}({left}, {right}, {target})")

    def _written(self, statement: str) -> Callable[..., Any]:
        """Return the rule of Horner as a program, which takes a sixth of the time of a loop."""
        steps: list[tuple[str, str, str, str]] = []
        result = _steps(self.nested, 0, steps)
        named = {"*": "multiply", "+": "add"}
        lines = [
            statement.format(target=target, left=left, sign=sign, right=right, name=named[sign])
            for target, left, sign, right in steps
        ]
        numbers = range(self.powers.shape[1])
        names = [f"x{i}" for i in numbers] + [f"v{i}=None" for i in numbers]
        scope: dict[str, Any] = {"multiply": np.multiply, "add": np.add}
        exec("\n    ".join([f"def of({', '.join(names)}):", *lines, f"return {result}"]), scope)
        return scope["of"]  # type: ignore[no-any-return]

    def collapsed(self, values: Sequence[float | None]) -> Polynomial:
        """Return the polynomial of the variables whose value is None, with the others put in.

        Examples
        --------
        >>> product = Polynomial(np.array([[1, 1], [0, 2]]), np.array([2.0, 1.0]))
        >>> product.collapsed((None, 3.0))(5.0)
        39.0
        """
        left = [i for i, value in enumerate(values) if value is None]
        total: dict[tuple[int, ...], float] = {}
        for row, coefficient in zip(self.powers.tolist(), self.coefficients.tolist(), strict=True):
            for power, value in zip(row, values, strict=True):
                coefficient *= 1.0 if value is None else value**power
            key = tuple(row[i] for i in left)
            total[key] = total.get(key, 0.0) + coefficient
        powers = np.array(list(total), np.int64).reshape(-1, len(left))
        return Polynomial(powers, np.array(list(total.values())))

    def about(self, center: Sequence[float]) -> Polynomial:
        """Return the polynomial of the variables less those of a center.

        Terms that cancel far from 0 do not there, so that it may be evaluated in fewer digits.

        Examples
        --------
        >>> square = Polynomial(np.array([[2]]), np.array([1.0]))
        >>> square.about([3.0])(0.5)
        12.25
        """
        terms = dict(zip(map(tuple, self.powers.tolist()), self.coefficients.tolist(), strict=True))
        for variable, middle in enumerate(center):
            moved: dict[tuple[int, ...], float] = {}
            for powers, coefficient in terms.items():
                power = powers[variable]
                for lower in range(power + 1):
                    key = (*powers[:variable], lower, *powers[variable + 1 :])
                    part = coefficient * math.comb(power, lower) * middle ** (power - lower)
                    moved[key] = moved.get(key, 0.0) + part
            terms = moved
        return Polynomial(np.array(list(terms)), np.array(list(terms.values())))

    @cached_property
    def nested(self) -> Any:
        """The coefficients as lists in lists: by the power of the first variable, and so on."""
        return _nested(self.powers.tolist(), self.coefficients.tolist())

    @cached_property
    def derivatives(self) -> tuple[Polynomial, ...]:
        """The derivatives by the variables."""
        return tuple(self._derivative(i) for i in range(self.powers.shape[1]))

    def _derivative(self, variable: int) -> Polynomial:
        there = self.powers[:, variable] > 0
        powers = self.powers[there].copy()
        factors = self.coefficients[there] * powers[:, variable]
        powers[:, variable] -= 1
        return Polynomial(powers, factors)


def horner(powers: Sequence[float], x: NDArray[np.float64], out: Any) -> Any:
    """Return a polynomial of one variable by its coefficients, in `out`.

    Examples
    --------
    >>> horner((1.0, 2.0), np.array([3.0]), np.empty(1))
    array([7.])
    """
    out[...] = powers[-1]
    for coefficient in powers[-2::-1]:
        out *= x
        out += coefficient
    return out


def of_one_number(powers: Sequence[float]) -> Callable[[float], float]:
    """Return a polynomial of one number by its coefficients, written out for speed.

    Examples
    --------
    >>> of_one_number((1.0, 2.0, 0.5))(2.0)
    7.0
    """
    text = repr(float(powers[-1]))
    for coefficient in powers[-2::-1]:
        text = f"({text}*x + {float(coefficient)!r})"
    return eval(f"lambda x: {text}")  # type: ignore[no-any-return]


def _nested(powers: Sequence[Sequence[int]], coefficients: Sequence[float]) -> Any:
    """Return the coefficients as lists in lists: by the power of the first variable, and so on."""
    if not powers:
        return 0.0
    if not powers[0]:
        return float(sum(coefficients))
    rows: list[Any] = []
    for power in range(max(row[0] for row in powers) + 1):
        some = [i for i, row in enumerate(powers) if row[0] == power]
        rows.append(_nested([powers[i][1:] for i in some], [coefficients[i] for i in some]))
    return rows


def _steps(rows: Any, level: int, steps: list[tuple[str, str, str, str]]) -> str:
    """Write what is to be done, variable x by variable, into values v, and return the result."""
    if type(rows) is float:
        return repr(rows)
    variable, target = f"x{level}", f"v{level}"
    value = _steps(rows[-1], level + 1, steps)
    for row in rows[-2::-1]:
        steps.append((target, value, "*", variable))
        value = target
        if row != 0.0:
            steps.append((target, value, "+", _steps(row, level + 1, steps)))
    return value

"""How far a force may be off anywhere in a box of scenes, proven from the bounds of the models.

A term of the force is the true one times exp(e) at most, with |e| up to its bound in the cell of
(g, alpha). With the true terms t over Gamma_o, the error of the force is up to

    sum t (exp(e) - 1) / (1 + sum t),

which is monotonic in each t as a quotient of linear functions. Eq. (13) with its own bounds says
between which numbers each t is in the box, so that the largest error is at one of the corners.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from itertools import product
from typing import Any, TypeAlias

import numpy as np

from surrogate.choosing.candidates import TERMS, Candidates
from surrogate.contact.domain import ROUNDING, Domain

__all__ = ["Ranges", "force_error", "g_range", "lowest_of_highest", "lowest_touch"]

Ranges: TypeAlias = "Mapping[str, tuple[float, float]]"


def g_range(ranges: Ranges) -> tuple[float, float]:
    """Return the ends of g = Gamma_o/(mu R_w) in a box of scenes; (0, 0) or infinite at zeros."""
    ends = []
    for i, j in ((0, 1), (1, 0)):
        divisor = ranges["shear_modulus"][j] * ranges["wire_radius"][j]
        gamma = ranges["toughness"][i]
        ends.append(gamma / divisor if divisor else (math.inf if gamma else 0.0))
    return ends[0], ends[1]


def lowest_of_highest(limits: Domain, alpha: tuple[float, float]) -> float:
    """Return the highest g up to which the domain reaches at every alpha of a range.

    It is that of `Domain.holds`, a rounding above the one that its logarithm gives.
    """
    inner = [a for a, _ in limits.highest if alpha[0] < a < alpha[1]]
    return min(float(limits.highest_g(a)) for a in (*alpha, *inner)) * ROUNDING


def lowest_touch(limits: Domain, alpha: tuple[float, float]) -> float:
    """Return the lowest g at which the crack's tip touches the wire at any alpha of a range."""
    low, high = (float(np.log(a)) for a in alpha)
    roots: Any = np.polynomial.Polynomial(limits.touch).deriv().roots()
    level = [row.real for row in roots if abs(row.imag) < 1e-9 and low < row.real < high]
    return math.exp(min(float(limits.log_touch(row)) for row in (low, high, *level)))


def force_error(
    known: Candidates, ranges: Ranges, models: Mapping[str, str], functions: Mapping[str, str]
) -> float:
    """Return the largest relative error of the force in a box of scenes [-].

    Parameters
    ----------
    known : Candidates
        The models with their bounds.
    ranges : mapping of str to tuple of float
        The ends of all six quantities of a scene.
    models : mapping of str to str
        The model of each term that there is, "arc" and "normal_load".
    functions : mapping of str to str
        The function of the models that each term follows, which depends on the law.

    Returns
    -------
    float
        The bound, infinite outside the domain.
    """
    if not models:
        return 0.0
    return max(
        _in_cell(known, cell, g, alpha, ranges, models, functions)
        for cell, g, alpha in _cells(known, g_range(ranges), ranges["stiffening_exponent"])
    )


def _cells(
    known: Candidates, g: tuple[float, float], alpha: tuple[float, float]
) -> Iterator[tuple[int, tuple[float, float], tuple[float, float]]]:
    """Yield the cells that a box touches, each with the part of the box in it."""
    bounds = known.bounds
    if not (bounds.g[0] <= g[0] and g[1] <= bounds.g[-1]) or not (
        bounds.alpha[0] <= alpha[0] and alpha[1] <= bounds.alpha[-1]
    ):
        yield bounds.cells, g, alpha
        return
    columns = len(bounds.alpha) - 1
    for row, column in product(range(len(bounds.g) - 1), range(columns)):
        in_g = max(g[0], bounds.g[row]), min(g[1], bounds.g[row + 1])
        in_alpha = max(alpha[0], bounds.alpha[column]), min(alpha[1], bounds.alpha[column + 1])
        if in_g[0] <= in_g[1] and in_alpha[0] <= in_alpha[1]:
            yield row * columns + column, in_g, in_alpha


def _in_cell(
    known: Candidates,
    cell: int,
    g: tuple[float, float],
    alpha: tuple[float, float],
    ranges: Ranges,
    models: Mapping[str, str],
    functions: Mapping[str, str],
) -> float:
    errors = {t: float(known.error(models[t], functions[t])[cell]) for t in models}
    if not all(map(math.isfinite, errors.values())):
        return math.inf
    shares = []
    for term in models:
        low, high = _estimate(term, g, ranges)
        least, most = known.least(functions[term])[cell], known.most(functions[term])[cell]
        shares.append((low * float(least), high * float(most)))
    return max(_error(corner, list(errors.values())) for corner in product(*shares))


def _estimate(term: str, g: tuple[float, float], ranges: Ranges) -> tuple[float, float]:
    """Return the ends of a term of Eq. (13) over Gamma_o, 4 tau_w/(mu g) or xi (1 + 4/g)."""
    if term == TERMS[1]:
        low, high = ranges["friction_coefficient"]
        return low * (1.0 + 4.0 / g[1]), high * (1.0 + 4.0 / g[0]) if g[0] else math.inf
    low, high = ranges["wear_strength"]
    (least_mu, most_mu) = ranges["shear_modulus"]
    return 4.0 * low / (most_mu * g[1]), 4.0 * high / (least_mu * g[0]) if g[0] else math.inf


def _error(terms: tuple[float, ...], errors: list[float]) -> float:
    """Return sum t e/(1 + sum t); of infinite terms the largest error."""
    if any(np.isinf(terms)):
        return max(errors)
    total = sum(terms)
    return sum(t * e for t, e in zip(terms, errors, strict=True)) / (1.0 + total)

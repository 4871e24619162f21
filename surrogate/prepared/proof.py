"""How far a force may be off anywhere in a box of scenes, proven from the bounds of the models.

A term of the force is the true one times exp(e) at most, with |e| up to its bound in the cell of
(g, alpha). With the true terms t over Gamma_o, the error of the force is up to

    sum t (exp(e) - 1) / (1 + sum t),

which is monotonic in each t as a quotient of linear functions. Eq. (13) with its own bounds says
between which numbers each t is in the box, so that the largest error is at one of the corners.
Where the cells are those of g/g_touch, as for A* and B*, the box of g touches those that it has at
any of its alphas.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise, product
from typing import Any, TypeAlias

import numpy as np

from surrogate.choosing.candidates import TERMS, Candidates
from surrogate.contact.coordinates import log_touch
from surrogate.contact.domain import ROUNDING, Domain

__all__ = ["Ranges", "force_error", "g_range", "lowest_of_highest"]

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


def _touch_range(coefficients: Sequence[float], alpha: tuple[float, float]) -> tuple[float, float]:
    """Return the lowest and the highest g_touch of a range of alpha; 1 without coefficients."""
    if not coefficients:
        return 1.0, 1.0
    low, high = (float(np.log(a)) for a in alpha)
    roots: Any = np.polynomial.Polynomial(coefficients).deriv().roots()
    level = [row.real for row in roots if abs(row.imag) < 1e-9 and low < row.real < high]
    logs = [float(log_touch(coefficients, row)) for row in (low, high, *level)]
    return math.exp(min(logs)), math.exp(max(logs))


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
    bounds, columns = known.bounds, len(known.bounds.alpha) - 1
    if not (bounds.alpha[0] <= alpha[0] and alpha[1] <= bounds.alpha[-1]):
        yield bounds.cells, g, alpha
        return
    for column, in_alpha in _parts(bounds.alpha, alpha):
        low, high = _touch_range(bounds.touch, in_alpha)
        off = ROUNDING if bounds.touch else 1.0
        ends = g[0] / (high * off), g[1] / low * off
        if not (bounds.g[0] <= ends[0] and ends[1] <= bounds.g[-1]):
            yield bounds.cells, g, in_alpha
        for row, part in _parts(bounds.g, ends):
            in_g = max(g[0], part[0] * low), min(g[1], part[1] * high)
            yield row * columns + column, in_g, in_alpha


def _parts(
    edges: Sequence[float], ends: tuple[float, float]
) -> Iterator[tuple[int, tuple[float, float]]]:
    """Yield the intervals between edges that a range touches, with its part; an edge is above."""
    last = len(edges) - 2
    for number, (low, high) in enumerate(pairwise(edges)):
        if low <= ends[1] and (ends[0] < high or number == last):
            yield number, (max(low, ends[0]), min(high, ends[1]))


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

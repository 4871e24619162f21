"""How far a force may be off anywhere in a box of scenes, proven from the bounds of the models.

A term of the force is the true one times exp(e) at most, with |e| up to its bound in the cell of
(g, alpha). With the true terms t over Gamma_o, the error of the force is up to

    sum t (exp(e) - 1) / (1 + sum t),

which is monotonic in each t as a quotient of linear functions. Eq. (13) and the table, each with
its own bounds, say between which numbers each t is in a part of the box, so that the largest error
there is at one of the corners. Beside solutions on which the wire rubs the true terms are those of
the first order times kappa: e has a part of it as well, of |ln kappa| where kappa is left out and
of its error where it is not. Where the cells are those of g/g_touch, as for A* and B*, the box of g
touches those that it has at any of its alphas.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import pairwise, product
from typing import Any, TypeAlias

import numpy as np

from surrogate.choosing.candidates import OUTSIDE, TERMS, Candidates
from surrogate.contact.coordinates import touch_range
from surrogate.contact.domain import ROUNDING, Domain, g_range
from surrogate.contact.table import TableModel

__all__ = ["Ranges", "force_error", "lowest_of_highest"]

Ranges: TypeAlias = "Mapping[str, tuple[float, float]]"
_NOTHING = 0.0, 0.0
_SLICE = 0.2  # of ln g


def lowest_of_highest(limits: Domain, alpha: tuple[float, float]) -> float:
    """Return the highest g up to which the domain reaches at every alpha of a range.

    It is that of `Domain.holds`, a rounding above the one that its logarithm gives.
    """
    inner = [a for a, _ in limits.highest if alpha[0] < a < alpha[1]]
    return min(float(limits.highest_g(a)) for a in (*alpha, *inner)) * ROUNDING


Beside: TypeAlias = "Callable[[tuple[float, float], tuple[float, float]], tuple[float, float]]"


def force_error(
    known: Candidates,
    ranges: Ranges,
    models: Mapping[str, str],
    functions: Mapping[str, str],
    beside: Beside | None = None,
    stand_ins: Mapping[str, str] | None = None,
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
    beside : callable, optional
        Of a range of g and one of alpha: by how much the logarithm of a term is off besides, and
        how far that of the true term may be from that of the function.
    stand_ins : mapping of str to str, optional
        Functions of the table that stand in for others, as A does for A* under the projected law.

    Returns
    -------
    float
        The bound, infinite outside the domain.
    """
    if not models:
        return 0.0
    largest = 0.0
    for cell, whole, alpha in _cells(known, g_range(ranges), ranges["stiffening_exponent"]):
        if cell == known.bounds.cells:
            return math.inf
        besides = beside(whole, alpha) if beside else _NOTHING
        for g in _slices(whole):
            part = g, alpha
            others = {
                term: _apart(known, stand_ins[name], name, part)
                for term, name in functions.items()
                if stand_ins and models.get(term) == OUTSIDE
            }
            found = _in_cell(known, cell, part, ranges, models, functions, besides, others)
            largest = max(largest, found)
    return largest


def _slices(g: tuple[float, float]) -> Iterator[tuple[float, float]]:
    """Yield parts of a range of g in which the functions hardly change."""
    count = max(math.ceil(math.log(g[1] / g[0]) / _SLICE), 1)
    edges = np.geomspace(*g, count + 1).tolist()
    yield from pairwise([g[0], *edges[1:-1], g[1]])


def _cells(
    known: Candidates, g: tuple[float, float], alpha: tuple[float, float]
) -> Iterator[tuple[int, tuple[float, float], tuple[float, float]]]:
    """Yield the cells that a box touches, each with the part of the box in it."""
    bounds, columns = known.bounds, len(known.bounds.alpha) - 1
    if not (bounds.alpha[0] <= alpha[0] and alpha[1] <= bounds.alpha[-1]):
        yield bounds.cells, g, alpha
        return
    for column, in_alpha in _parts(bounds.alpha, alpha):
        low, high = touch_range(bounds.touch, in_alpha)
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
    part: tuple[tuple[float, float], tuple[float, float]],
    ranges: Ranges,
    models: Mapping[str, str],
    functions: Mapping[str, str],
    besides: tuple[float, float],
    others: Mapping[str, tuple[float, float]],
) -> float:
    more, away = math.expm1(besides[0]), math.exp(besides[1])
    errors = {}
    for term in models:
        own = float(known.error(models[term], functions[term])[cell])
        if term in others:
            least, most = others[term]
            own = max(most * (1.0 + own) - 1.0, 1.0 - least * (1.0 - own))
        errors[term] = own + more * (1.0 + own)
    if not all(map(math.isfinite, errors.values())):
        return math.inf
    shares = []
    for term in models:
        low, high = _estimate(term, part[0], ranges)
        least, most = _between(known, cell, term, functions[term], part)
        shares.append((low * least / away, high * most * away))
    return max(_error(corner, list(errors.values())) for corner in product(*shares))


def _apart(
    known: Candidates,
    name: str,
    other: str,
    part: tuple[tuple[float, float], tuple[float, float]],
) -> tuple[float, float]:
    """Return between which numbers one function of the table over another one is."""
    table: Any = known.fitted.models[OUTSIDE]
    (low, high), (least, most) = (table.table.between(each, *part) for each in (name, other))
    return low / most, high / least


def _between(
    known: Candidates,
    cell: int,
    term: str,
    name: str,
    part: tuple[tuple[float, float], tuple[float, float]],
) -> tuple[float, float]:
    """Return between which numbers a true term over Eq. (13) is: that of (13), and the table."""
    least, most = float(known.least(name)[cell]), float(known.most(name)[cell])
    (g, alpha), off = part, float(known.error(OUTSIDE, name)[cell])
    table: Any = known.fitted.models[OUTSIDE]
    if not (isinstance(table, TableModel) and off < math.inf):
        return least, most
    ends = table.table.between(name, g, alpha)
    by_13 = (2.0, 2.0) if term == TERMS[0] else tuple(2.0 + 0.5 * each for each in g)
    low, high = ends[0] / by_13[1] / (1.0 + off), ends[1] / by_13[0] * (1.0 + off)
    return max(least, low), min(most, high)


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

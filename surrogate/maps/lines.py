"""Boundaries on a regime map as polylines: exact where there is a closed form, contours otherwise.

On a map every quantity is c x^p y^q, so a statement about closed forms, such as that two terms are
equal, is a sum of such monomials that is 0. Where it holds only two different powers of y (or of
x), it is solved for y (or x) node by node, and the ends of the line are found by bisection. All
other boundaries are contours of what the model answers at the map's nodes.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.extras import require_extra
from surrogate.maps.axes import MapAxis
from surrogate.maps.scenes import Monomial

__all__ = ["Boundary", "contours", "curves", "exact_lines"]

Array = NDArray[np.float64]
Lines = tuple[Array, ...]

_HALVINGS = 80


@dataclass(frozen=True, eq=False)
class Boundary:
    """A boundary on a regime map.

    Parameters
    ----------
    kind : str
        "equal-terms" where two terms of the force are equal; "dominance" where one term reaches
        the threshold from which it dominates; "limit" where a limit formula misses the map's
        model by the chosen share; "contact" where the wire begins to touch the crack tip.
    about : tuple of str
        The two terms, the one term, the name of the limit formula, or the two contacts.
    equation : str
        What holds on the boundary.
    symbol : str
        The same as mathematical text for figures.
    exact : bool
        Whether the lines come from a closed form; else they are contours between the map's nodes.
    lines : tuple of ndarray, shape (n, 2)
        Polylines of x and y, each in the unit of its axis [SI].

    Examples
    --------
    >>> from surrogate import regime_map
    >>> gel = {"shear_modulus": 685.0, "wear_strength": 7750.0}
    >>> made = regime_map("wire_radius", "toughness", ((1e-5, 1e-3), (0.1, 10.0)), gel)
    >>> print(made.boundaries[0].kind, made.boundaries[0].equation, made.boundaries[0].exact)
    equal-terms (1 + xi) Gamma_o = 4 tau_w R_w True
    """

    kind: str
    about: tuple[str, ...]
    equation: str
    symbol: str
    exact: bool
    lines: Lines


def exact_lines(terms: Sequence[Monomial], x: MapAxis, y: MapAxis) -> Lines | None:
    """Return where the sum of monomials is 0 on a map, or None where no closed form says it.

    Examples
    --------
    >>> from surrogate.maps.axes import map_axis
    >>> x, y = (map_axis(name, (0.1, 10.0), "log", 5) for name in ("g", "alpha"))
    >>> line, = exact_lines((Monomial(1.0, 1, 0), Monomial(-4.0, 0, 1)), x, y)
    >>> line[[0, -1]].round(3).tolist()
    [[0.4, 0.1], [10.0, 2.5]]
    """
    terms = [term for term in terms if term.factor != 0.0]
    if len({np.sign(term.factor) for term in terms}) < 2:
        return ()
    if len({(term.p, term.q) for term in terms}) == 1:
        return ()  # a constant
    along_x = _solve_along(x, y, [(t.factor, t.p, t.q) for t in terms])
    along_y = _solve_along(y, x, [(t.factor, t.q, t.p) for t in terms])
    swapped = None if along_y is None else tuple(line[:, ::-1] for line in along_y)
    if along_x is None or swapped is None:
        return swapped if along_x is None else along_x
    # a steep line is better told by its nodes on the other axis
    return max(along_x, swapped, key=lambda lines: sum(map(len, lines)))


def _solve_along(
    axis: MapAxis, other: MapAxis, terms: Sequence[tuple[float, int, int]]
) -> Lines | None:
    """Return the lines as functions of one axis, or None where the other cannot be solved for."""
    powers = sorted({q for _, _, q in terms})
    if len(powers) != 2:
        return None
    low, high = powers

    def solution(x: Any) -> Any:
        sums = [
            sum(c * np.power(x, float(p)) for c, p, q in terms if q == power) for power in powers
        ]
        return np.power(-sums[0] / sums[1], 1.0 / (high - low))

    return tuple(curves(axis, other, solution))


def curves(axis: MapAxis, other: MapAxis, solution: Callable[[Any], Any]) -> Iterator[Array]:
    """Yield the pieces of a curve that lie on the map, each up to the map's edge.

    Parameters
    ----------
    axis, other : MapAxis
        What the curve is a function of, and what it gives.
    solution : callable
        Of an array of values of `axis`; nan where there is no solution.

    Yields
    ------
    ndarray, shape (n, 2)
        Values of `axis` and `other`, 2 or more.
    """
    ends = other.values[0], other.values[-1]

    def inside(x: Any) -> Any:
        y = solution(x)
        return (y >= ends[0]) & (y <= ends[1])

    with np.errstate(all="ignore"):
        nodes = axis.values
        found = inside(nodes)
        edges = np.flatnonzero(found[1:] != found[:-1])
        starts: list[Array] = [] if not found[0] else [nodes[:1]]
        stops: list[Array] = []
        for i in edges:
            end = _edge(axis, inside, nodes[i], nodes[i + 1], bool(found[i]))
            (stops if found[i] else starts).append(end)
        if found[-1]:
            stops.append(nodes[-1:])
        for start, stop in zip(starts, stops, strict=True):
            between = nodes[(nodes > start[0]) & (nodes < stop[0])]
            x = np.concatenate([start, between, stop])
            if x[0] < x[-1]:
                yield np.stack([x, np.clip(solution(x), *ends)], axis=1) + 0.0  # no -0.0


def _edge(
    axis: MapAxis, inside: Callable[[Any], Any], left: float, right: float, from_inside: bool
) -> Array:
    """Return the last value inside between two nodes of which one is inside, by bisection."""
    here, there = axis.to_scale([left if from_inside else right, right if from_inside else left])
    good = np.array([left if from_inside else right])
    for _ in range(_HALVINGS):
        middle = 0.5 * (here + there)
        value = np.atleast_1d(axis.from_scale(middle))
        if inside(value)[0]:
            here, good = middle, value
        else:
            there = middle
    return good


def contours(values: Array, level: float, x: MapAxis, y: MapAxis) -> Lines:
    """Return where values at the map's nodes, of shape (y, x), have a level; nan is no value.

    Straight between neighbouring nodes, in the scale of the axes.

    Raises
    ------
    WirecutError
        If contourpy, which comes with matplotlib, is not installed.
    """
    if not np.any(values > level) or not np.any(values < level):
        return ()
    require_extra("contourpy", "a boundary of a model without closed form", "plot")
    from contourpy import contour_generator

    made = contour_generator(
        x.to_scale(x.values), y.to_scale(y.values), np.where(np.isfinite(values), values, np.nan)
    )
    lines: Any = made.lines(level)
    return tuple(
        np.stack([x.from_scale(line[:, 0]), y.from_scale(line[:, 1])], axis=1) for line in lines
    )

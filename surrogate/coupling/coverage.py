"""Where kappa is known all over a box of scenes, and what bounds it there: proven, not sampled.

Between its nodes the reach is linear in each of its three coordinates, so that its least value in
a box is at an end of the box or at a node. A box whose largest load leaves it unproven is halved
until it is proven, or one of its corners is beyond the reach.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from itertools import product
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.elementwise import log
from surrogate.contact.coordinates import touch_range
from surrogate.contact.domain import g_range
from surrogate.coupling.amplification import LEAST_SHARE, Amplification, load_of

__all__ = ["bounds_over", "is_beyond", "uncovered"]

Range: TypeAlias = "tuple[float, float]"
Box: TypeAlias = "Mapping[str, Range]"
_LOADS = "friction_coefficient", "wear_strength"
_MOST = 2000
"""Boxes that are looked at before a load counts as unproven."""
_ROUNDING = 1e-9  # of logarithms


def uncovered(kappa: Amplification, box: Box) -> tuple[dict[str, float], float] | None:
    """Return a scene whose load is not proven to be within the reach, or None.

    Parameters
    ----------
    kappa : Amplification
        What is known.
    box : mapping of str to tuple of float
        The ends of the six quantities of a scene, in SI units.

    Returns
    -------
    tuple or None
        The scene, and its load over the largest one that is known there; infinite where no coupled
        solution is near.
    """
    boxes = [dict(box)]
    for _ in range(_MOST):
        if not boxes:
            return None
        part = boxes.pop()
        if _is_covered(kappa, part):
            continue
        worst, share = _worst_corner(kappa, part)
        if share > 1.0:
            return worst, share
        boxes += _halves(kappa, part)
    return worst, share


def is_beyond(kappa: Amplification, box: Box) -> bool:
    """Return whether solutions reach to no scene of a box, as far as its ends tell.

    Examples
    --------
    >>> from surrogate.coupling.shipped import amplification
    >>> ends = (685.0, 1.6, 1e-3, 0.1, 7750.0, 2.0)
    >>> names = "shear_modulus toughness wire_radius friction_coefficient wear_strength".split()
    >>> names.append("stiffening_exponent")
    >>> is_beyond(amplification(), {name: (end, end) for name, end in zip(names, ends)})
    True
    """
    loads, g, alpha = _loads(box), g_range(box), box["stiffening_exponent"]
    least = max(part[0] / unit for part, unit in zip(loads, kappa.load_unit, strict=True))
    if least > float(kappa.reach.max()):
        return True
    return any(
        ends[1] < axis[0] - _ROUNDING or ends[0] > axis[-1] + _ROUNDING
        for axis, ends in zip(kappa.axes[:2], _place(kappa, g, alpha), strict=True)
    )


def _loads(box: Box) -> tuple[Range, Range]:
    """Return the ends of xi and tau_w/mu."""
    (least, most), mu = box["wear_strength"], box["shear_modulus"]
    return box["friction_coefficient"], (least / mu[1], most / mu[0])


def _place(kappa: Amplification, g: Range, alpha: Range) -> tuple[Range, Range]:
    """Return the ends of x = ln(g/g_touch) and y = ln alpha."""
    low, high = touch_range(kappa.touch, alpha)
    ends = (float(log(g[0])) - math.log(high), float(log(g[1])) - math.log(low))
    return ends, (float(log(alpha[0])), float(log(alpha[1])))


def _is_covered(kappa: Amplification, box: Box) -> bool:
    xi, wear = _loads(box)
    size, _ = load_of(xi[1], wear[1], kappa.load_unit)
    if size == 0.0:
        return True
    g, alpha = g_range(box), box["stiffening_exponent"]
    if not 0.0 < g[0] <= g[1] < math.inf or g[0] < kappa.lowest or g[1] > kappa.highest:
        return False
    inside = all(
        axis[0] <= ends[0] and ends[1] <= axis[-1]
        for axis, ends in zip(kappa.axes[:2], _place(kappa, g, alpha), strict=True)
    )
    return inside and size <= _least_reach(kappa, g, alpha, box)


def _least_reach(kappa: Amplification, g: Range, alpha: Range, box: Box) -> float:
    """Return the least reach in a part of a box, at the nearest places that are known."""
    xi, wear = _loads(box)
    # more of wear and less of friction is nearer to the direction of wear
    direction = tuple(
        load_of(*load, kappa.load_unit)[1] for load in ((xi[1], wear[0]), (xi[0], wear[1]))
    )
    places = (*_place(kappa, g, alpha), direction)
    nodes = [_with_nodes(axis, ends) for axis, ends in zip(kappa.axes, places, strict=True)]
    return float(np.min(kappa.reach_at(*np.meshgrid(*nodes))))


def _with_nodes(axis: NDArray[np.float64], ends: tuple[float, ...]) -> NDArray[np.float64]:
    inner = axis[(axis > ends[0]) & (axis < ends[1])]
    return np.asarray(np.clip(np.unique([*ends, *inner]), axis[0], axis[-1]))


def _worst_corner(kappa: Amplification, box: Box) -> tuple[dict[str, float], float]:
    """Return the corner whose load is the largest share of what is known there, and this share."""
    shares = []
    for corner in product(*(sorted({*ends}) for ends in box.values())):
        scene = dict(zip(box, corner, strict=True))
        g = g_range({name: (value, value) for name, value in scene.items()})[0]
        relative = scene["wear_strength"] / scene["shear_modulus"]
        load = scene["friction_coefficient"], relative
        share = float(kappa.share(g, scene["stiffening_exponent"], *load))
        shares.append((share, scene))
    share, worst = max(shares, key=lambda each: each[0])
    return worst, share


def _halves(kappa: Amplification, box: Box) -> list[dict[str, Range]]:
    """Return the two halves of a box across what varies most."""
    shares = {name: 1.0 - low / high if high else 0.0 for name, (low, high) in box.items()}
    xi, wear = _loads(box)
    size, _ = load_of(xi[1], wear[1], kappa.load_unit)
    for name, (_, high), most in zip(_LOADS, (xi, wear), kappa.load_unit, strict=True):
        shares[name] *= high / most / size  # what matters of the smaller load
    name = max(box, key=shares.__getitem__)
    low, high = box[name]
    middle = math.sqrt(low) * math.sqrt(high) if low else 0.5 * high
    return [{**box, name: (low, middle)}, {**box, name: (middle, high)}]


def bounds_over(kappa: Amplification, g: Range, alpha: Range, box: Box) -> tuple[float, float]:
    """Return the bounds of the error of ln kappa and of |ln kappa| in a part of a box.

    Parameters
    ----------
    kappa : Amplification
        What is known; all over the box.
    g, alpha : tuple of float
        The part of the box [-].
    box : mapping of str to tuple of float
        The ends of the six quantities, in SI units.

    Returns
    -------
    tuple of float
        The bounds [-].
    """
    cells = []
    for edges, (low, high) in zip(kappa.edges, _place(kappa, g, alpha), strict=True):
        ends = [low - _ROUNDING, high + _ROUNDING]
        first, last = np.searchsorted(edges[1:-1], ends, side="right")
        cells.append(slice(int(first), int(last) + 1))
    xi, wear = _loads(box)
    load, here = xi[1] + 0.1 * math.log1p(wear[1]), tuple(cells)
    size, _ = load_of(xi[1], wear[1], kappa.load_unit)
    share = size / (_least_reach(kappa, g, alpha, box) or 1.0)
    error = float(kappa.errors[here].max()) * min(max(share, LEAST_SHARE), 1.0)
    return error, float(kappa.growth[here].max()) * load

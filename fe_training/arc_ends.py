"""The ends of the contact arc from the pressure on it.

An arc that ends at a node is off by up to half a node's distance, and jumps from one configuration
to the next. The pressure falls to zero like a square root at a free end: its square is close to a
line there, and the angle at which that is zero follows from several nodes.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["arc_length"]

Floats = NDArray[np.float64]

#: Nodes that tell an end, the degree of theta as a polynomial of the pressure's square, and how
#: far beyond the last node the end may be, in distances of the last two nodes.
_NODES, _DEGREE, _FARTHEST = 10, 2, 2.5


def arc_length(theta: Floats, pressure: Floats) -> float:
    """Return A = cos theta_1 - cos theta_2 of a pressure profile.

    Parameters
    ----------
    theta, pressure : ndarray, shape (nodes,)
        Angles from the cutting direction, rising [rad], and pressures there; nan at the end is
        left out.

    Returns
    -------
    float
        A [-]; nan with too few nodes.

    Examples
    --------
    >>> theta = np.linspace(0.81, 2.19, 60)
    >>> pressure = np.sqrt((theta - 0.8) * (2.2 - theta))
    >>> print(f"{arc_length(theta, pressure):.3f} {np.cos(0.8) - np.cos(2.2):.3f}")
    1.284 1.285
    """
    known = np.isfinite(theta) & np.isfinite(pressure)
    theta, pressure = theta[known].astype(float), pressure[known].astype(float)
    if len(theta) < _NODES:
        return float("nan")
    first, last = _end(theta, pressure), _end(theta[::-1], pressure[::-1])
    return float(np.cos(max(first, 0.0)) - np.cos(last))


def _end(theta: Floats, pressure: Floats) -> float:
    """Return where the pressure vanishes, for nodes ordered from that end."""
    square = pressure[:_NODES] ** 2
    if not np.max(square) > 0.0:
        return float(theta[0])
    beyond = np.polyfit(square / np.max(square), theta[:_NODES] - theta[0], _DEGREE)[-1]
    farthest = _FARTHEST * abs(theta[1] - theta[0])
    return float(theta[0] + np.clip(beyond, -farthest, farthest))

"""The ends of the contact arc from the pressure on it.

An arc that ends at a node is off by up to half a node's distance, and jumps from one configuration
to the next. The pressure falls to zero like a square root at a free end: its square is close to a
line there, and the angle at which that is zero follows from several nodes.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["contact_ends"]

Floats = NDArray[np.float64]

#: Nodes that tell an end, the degree of theta as a polynomial of the pressure's square, and how
#: far beyond the last node the end may be, in distances of the last two nodes.
_NODES, _DEGREE, _FARTHEST = 10, 2, 2.5


def contact_ends(theta: Floats, pressure: Floats) -> tuple[float, float]:
    """Return theta_1 and theta_2, where the contact pressure vanishes.

    Parameters
    ----------
    theta, pressure : ndarray, shape (nodes,)
        Angles from the cutting direction, rising [rad], and pressures there.

    Returns
    -------
    tuple of float
        The first one is not negative [rad]; nan with fewer than two nodes.

    Examples
    --------
    >>> theta = np.linspace(0.81, 2.19, 60)
    >>> ends = contact_ends(theta, np.sqrt((theta - 0.8) * (2.2 - theta)))
    >>> print("{:.2f} {:.2f}".format(*ends))
    0.80 2.20
    """
    if len(theta) < 2:
        return np.nan, np.nan
    return max(_end(theta, pressure), 0.0), _end(theta[::-1], pressure[::-1])


def _end(theta: Floats, pressure: Floats) -> float:
    """Return where the pressure vanishes, for nodes ordered from that end."""
    square = pressure[:_NODES] ** 2
    if not np.max(square) > 0.0:
        return float(theta[0])
    degree = min(_DEGREE, len(square) - 1)
    beyond = np.polyfit(square / np.max(square), theta[:_NODES] - theta[0], degree)[-1]
    farthest = _FARTHEST * abs(theta[1] - theta[0])
    return float(theta[0] + np.clip(beyond, -farthest, farthest))

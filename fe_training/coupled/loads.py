"""Loads by their direction, and loads that fill what is known of kappa."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from surrogate.contact.coordinates import log_touch
from surrogate.coupling.amplification import Amplification

__all__ = ["LOAD_UNIT", "edge_of", "samples_of"]

Array = NDArray[np.float64]

#: xi and tau_w/mu in units of which a load has a size and a direction.
LOAD_UNIT = (0.5, 1.0)

#: Part of the samples that are put on either end of g, and of alpha.
_MARGIN = 0.06


def edge_of(direction: float, unit: tuple[float, float]) -> tuple[float, float]:
    """Return the load of size 1 in a direction."""
    return (
        unit[0] * min(1.0, 2.0 * (1.0 - direction)),
        unit[1] * min(1.0, 2.0 * direction),
    )


def samples_of(kappa: Amplification, count: int, seed: int = 1) -> Array:
    """Return points that fill the known loads, the ends of g and alpha among them."""
    from scipy.stats import qmc

    unit = qmc.Sobol(4, seed=seed).random_base2(int(np.log2(count)))
    place = np.clip((1.0 + 2.0 * _MARGIN) * unit[:, :2] - _MARGIN, 0.0, 1.0)
    y = kappa.axes[1][0] + place[:, 1] * (kappa.axes[1][-1] - kappa.axes[1][0])
    touch = log_touch(kappa.touch, y)
    low = np.maximum(np.log(kappa.lowest), kappa.axes[0][0] + touch)
    high = np.minimum(np.log(kappa.highest), kappa.axes[0][-1] + touch)
    x = low + place[:, 0] * (high - low) - touch
    edges = np.array([edge_of(z, kappa.largest) for z in unit[:, 2]])
    reach = kappa.reach_at(x, y, unit[:, 2])
    part = (reach * np.sqrt(unit[:, 3]))[:, None]
    xi, wear = (part * edges).T
    return np.column_stack([x, y, xi, np.log1p(wear)])

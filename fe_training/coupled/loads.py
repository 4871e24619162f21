"""Loads by their direction, and loads that fill what is known of kappa."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from surrogate.contact.coordinates import log_touch
from surrogate.coupling.amplification import Amplification, edge_of

__all__ = ["LOAD_UNIT", "samples_of"]

Array = NDArray[np.float64]

#: xi and tau_w/mu in units of which a load has a size and a direction.
LOAD_UNIT = (0.5, 1.0)

#: Part of the samples that are put on either end of g, and of alpha.
_MARGIN = 0.06


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
    part = kappa.reach_at(x, y, unit[:, 2]) * np.sqrt(unit[:, 3])
    xi, wear = (part * most for most in edge_of(unit[:, 2], kappa.load_unit))
    return np.column_stack([x, y, xi, np.log1p(wear)])

"""The rows of the campaign with friction and wear that kappa is fitted to.

They are those in which the tip does not touch the wire, the last equilibria before the ends of
paths among them. ln kappa is that of the integrals between the zeros of the pressure: sums over
touching nodes, which the balance is made of, miss the ends of the contact by parts of an element
(their difference is the error that a row is taken to have).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fe_training.coupled.dataset import CoupledData
from fe_training.sliding.record import BALANCE_BOUND
from surrogate.contact.coordinates import log_touch

__all__ = ["FitRows", "rows_of"]

Array = NDArray[np.float64]

#: The part of the difference between the integrals and the sums over nodes that remains in the
#: integrals.
_LEFT = 0.2

#: Largest |ln kappa| of a row that is used. Towards the limit of the load it grows without end, and
#: rows there would make the process expect as much everywhere.
MOST = 0.5


@dataclass(frozen=True, eq=False)
class FitRows:
    """What the fit sees of the rows.

    Parameters
    ----------
    inputs : ndarray, shape (rows, 4)
        x = ln(g/g_touch), y = ln alpha, xi, w = ln(1 + tau_w/mu).
    values, noise : ndarray, shape (rows,)
        ln kappa and the variance of its error.
    drag : ndarray, shape (rows,)
        The part of F_ss that is friction and wear [-].
    base : ndarray of int, shape (rows,)
        The number of the base.
    held_out : ndarray of bool, shape (rows,)
        Whether no fit sees the row.
    """

    inputs: Array
    values: Array
    noise: Array
    drag: Array
    base: NDArray[np.int64]
    held_out: NDArray[np.bool_]

    def taken(self, chosen: Any) -> FitRows:
        """Return some of the rows."""
        columns = self.inputs, self.values, self.noise, self.drag, self.base, self.held_out
        return FitRows(*(column[chosen] for column in columns))

    def __len__(self) -> int:
        return len(self.values)


def rows_of(data: CoupledData, touch: tuple[float, ...]) -> FitRows:
    """Return the equilibria of a data set in which the tip does not touch the wire.

    Parameters
    ----------
    data : CoupledData
        The rows.
    touch : tuple of float
        Coefficients of ln g_touch in powers of ln alpha.
    """
    friction, wear = data["friction"], data["wear"]
    first = 2.0 * (wear * data["first_arc"] + friction * data["first_load"])
    with np.errstate(all="ignore"):
        values = np.log(data.amplification)
        sums = np.log((data["steady_force"] - data["energy_release_rate"]) / first)
        drag = first * np.exp(values)
        noise = (_LEFT * np.abs(values - sums)) ** 2
        usable = np.isfinite(noise) & (data.balance_error <= BALANCE_BOUND)
        usable &= np.abs(values) <= MOST
    usable &= ~data["touches_tip"] & ~data.tapered & (friction + wear > 0.0)
    y = np.log(data["alpha"])
    x = np.log(data["target"]) - log_touch(touch, y)
    inputs = np.stack([x, y, friction, np.log1p(wear)], axis=1)
    share = drag / (data["target"] + drag)
    rows = FitRows(inputs, values, noise, share, data["base"], data["held_out"]).taken(usable)
    _, different = np.unique(
        np.column_stack([rows.base, rows.inputs]).round(9), axis=0, return_index=True
    )
    return rows.taken(np.sort(different))

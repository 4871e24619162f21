"""A, B and delta of one stiffening exponent over g, as the comparison with the paper needs them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fe_training.campaign.dataset import Campaign
from fe_training.fitting.points import points_of
from surrogate.errors import InputError

__all__ = ["TOUCHED", "Curve", "stacked"]

Floats = NDArray[np.float64]

TOUCHED = 2e-3
"""delta/R_w - 1 below which the wire is taken to touch the tip."""

#: Relative difference up to which two values of g are the same.
_SAME = 1e-9


@dataclass(frozen=True, eq=False)
class Curve:
    """A, B and delta of one alpha over g, rising, within the bounds of their evidence.

    Parameters
    ----------
    alpha : float
        Strain-stiffening exponent [-].
    g, arc, normal_load, distance : ndarray, shape (points,)
        J/(mu R_w), A, B and delta/R_w [-].
    """

    alpha: float
    g: Floats
    arc: Floats
    normal_load: Floats
    distance: Floats

    @classmethod
    def of(cls, data: Campaign, alpha: float) -> Curve:
        """Return the curve of a data set.

        Parameters
        ----------
        data : Campaign
            The data.
        alpha : float
            One of its exponents [-].

        Raises
        ------
        InputError
            If there are fewer than three points.
        """
        points = points_of(data)
        points = points.taken(points.alpha == alpha)
        if len(points) < 3:
            raise InputError(
                f"the data have {len(points)} points of alpha = {alpha:g} that may be used; "
                "a curve needs three or more: let the campaign go on."
            )
        return cls(alpha, points.g, points.arc, points.normal_load, points.distance)

    @property
    def far(self) -> NDArray[np.bool_]:
        """Where the wire does not touch the tip."""
        return self.distance > 1.0 + TOUCHED

    def between(self, low: float, high: float) -> NDArray[np.bool_]:
        """Return which points have a g of this range, its ends included."""
        return (self.g >= low * (1.0 - _SAME)) & (self.g <= high * (1.0 + _SAME))

    def at(self, values: Floats, g: float) -> float:
        """Return values of the points interpolated in ln g, nan outside the points."""
        if not self.between(g, np.inf).any() or not self.between(0.0, g).any():
            return float("nan")
        return float(np.interp(np.log(g), np.log(self.g), values))


def stacked(curves: Sequence[Curve], *names: str) -> list[Floats]:
    """Return alpha and fields of several curves, one after the other, as columns."""
    alpha = np.concatenate([np.full(one.g.size, one.alpha) for one in curves])
    return [alpha, *(np.concatenate([getattr(one, name) for one in curves]) for name in names)]

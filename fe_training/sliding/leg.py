"""A straight stretch of a path in toughness, friction and wear."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fe_training.sliding.shear import NO_LOAD, Load


@dataclass(frozen=True, slots=True)
class Point:
    """A configuration that is asked for.

    Parameters
    ----------
    g : float
        J/(mu R_w) of the whole body [-].
    load : Load
        Friction and wear.
    """

    g: float
    load: Load = NO_LOAD


@dataclass(frozen=True, slots=True)
class Leg:
    """The way from one point (0) to another (1), straight in the load and in ln g."""

    start: Point
    end: Point

    @property
    def growth(self) -> Load:
        """How fast the load grows along the leg."""
        return self.end.load.plus(self.start.load, -1.0)

    @property
    def _steepness(self) -> float:
        return float(np.log(self.end.g / self.start.g))

    def at(self, share: float) -> Point:
        """Return the point at a share of the way."""
        if share == 1.0:
            return self.end
        g = self.start.g * np.exp(share * self._steepness)
        return Point(float(g), self.start.load.plus(self.growth, share))

    def toughening(self, share: float) -> float:
        """Return dg/d(share) there."""
        return self.at(share).g * self._steepness

"""The limit of the load: where the position of the wire no longer decides J.

Along a path at constant J the wire advances by dx_w = -(dJ/dload)/(dJ/dx_w): where dJ/dx_w vanishes
it runs away, and beyond that load no steady cut is near.
"""

from __future__ import annotations

from collections.abc import Sequence

from fe_training.sliding.shear import Load

__all__ = ["limit_of"]

#: A path that ended has met the limit of the load if dJ/dx_w fell below this share of what it was
#: at first, and along a line to 0 would vanish within this share of the load.
RATE, REACH = 0.25, 0.25


def limit_of(rates: Sequence[tuple[float, Load]]) -> Load | None:
    """Return the load at which dJ/dx_w would vanish; None if the path did not end near one.

    Parameters
    ----------
    rates : sequence of (float, Load)
        dJ/dx_w at a constant load [mu], and the load, after each step.

    Examples
    --------
    >>> loads = [Load(0.1 * i, 0.2 * i) for i in range(1, 6)]
    >>> limit = limit_of(list(zip([1.0, 0.8, 0.6, 0.4, 0.2], loads, strict=True)))
    >>> print(f"{limit.friction:.2f} {limit.wear:.2f}")
    0.60 1.20
    """
    if len(rates) < 3:
        return None
    first, (before, earlier), (rate, load) = rates[0][0], *rates[-2:]
    if not rate < min(before, RATE * first):
        return None
    limit = load.plus(load.plus(earlier, -1.0), rate / (before - rate))
    near = limit.plus(load, -1.0)
    close = near.friction <= REACH * load.friction and near.wear <= REACH * load.wear
    return limit if close else None

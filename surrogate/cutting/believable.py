"""Whether a scene is believable, which every force asks before it says what to doubt."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from typing import Any

from surrogate.basics.checks import BELIEVABLE, LONGEST_COHESIVE
from surrogate.errors import ImplausibleInputWarning

__all__ = ["are_believable", "warn_of_scene"]

_MU, _GAMMA, _RADIUS, _XI, _TAU = BELIEVABLE


def are_believable(mu: Any, gamma: Any, radius: Any, xi: Any, tau: Any) -> bool:
    """Whether five numbers can be those of a cut; 0, which neglects something, always can.

    Examples
    --------
    >>> are_believable(685.0, 1.6, 0.2e-3, 0.0, 7750.0), are_believable(685.0, 1.6, 0.2, 0.0, 0.0)
    (True, False)
    """
    # without a loop: every force of one wire passes here
    return bool(
        (_MU[0] <= mu <= _MU[1] or mu == 0.0)
        and (_GAMMA[0] <= gamma <= _GAMMA[1] or gamma == 0.0)
        and (_RADIUS[0] <= radius <= _RADIUS[1] or radius == 0.0)
        and _XI[0] <= xi <= _XI[1]
        and (_TAU[0] <= tau <= _TAU[1] or tau == 0.0)
        and (gamma <= LONGEST_COHESIVE * mu or mu == 0.0)
    )


def warn_of_scene(values: Sequence[Any], depth: int = 3) -> None:
    """Warn of each doubt about a scene, as if the caller's caller did.

    Parameters
    ----------
    values : sequence of float or ndarray
        See `doubts_of_scene`.
    depth : int
        Whose line the warning names: 3 for that of the caller's caller.
    """
    mu, gamma, radius, xi, tau = values[:5]
    if type(mu) is type(gamma) is type(radius) is type(xi) is type(tau) is float and are_believable(
        mu, gamma, radius, xi, tau
    ):
        return
    from surrogate.reading.plausibility import doubts_of_scene  # which sound scenes do not need

    for sentence in doubts_of_scene(values):
        warnings.warn(f"{sentence}.", ImplausibleInputWarning, stacklevel=depth)

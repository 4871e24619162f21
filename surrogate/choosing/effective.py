"""What to say where the law "auto" falls back to the projected law, whose error nobody knows."""

from __future__ import annotations

import warnings
from functools import lru_cache
from typing import Any

import numpy as np

from surrogate.errors import UnknownErrorWarning

__all__ = ["doubt_of_law", "warn_of_law"]


def doubt_of_law(unknown: Any, whose: str = "the force") -> str | None:
    """Return one sentence about all points at which the law's error is unknown, or None.

    Parameters
    ----------
    unknown : bool or ndarray of bool
        At which points.
    whose : str
        What is by the projected law there.

    Examples
    --------
    >>> print(doubt_of_law(np.array([False, True, False])))
    at 1 of 3 points the error of the force is unknown, as no solution with friction and wear is \
near: the law is 'projected', Eq. (S2) of the paper, and tau_w and xi are effective strengths there
    >>> doubt_of_law(False) is None
    True
    """
    if unknown is False:
        return None
    if unknown is True:
        return _sentence(whose)
    count, size = int(np.count_nonzero(unknown)), int(np.size(unknown))
    if not count:
        return None
    if count == size:
        return _sentence(whose)
    return f"at {count} of {size} points {_sentence(whose)} there"


@lru_cache(16)
def _sentence(whose: str) -> str:
    return (
        f"the error of {whose} is unknown, as no solution with friction and wear is near: "
        "the law is 'projected', Eq. (S2) of the paper, and tau_w and xi are effective strengths"
    )


def warn_of_law(unknown: Any, whose: str, depth: int = 3) -> None:
    """Warn once of all points at which the law's error is unknown, as if the caller's caller did.

    Parameters
    ----------
    unknown, whose
        As in `doubt_of_law`.
    depth : int
        Whose line the warning names: 3 for that of the caller's caller.
    """
    if (doubt := doubt_of_law(unknown, whose)) is not None:
        warnings.warn(f"{doubt}.", UnknownErrorWarning, stacklevel=depth)

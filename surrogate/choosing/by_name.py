"""The models by their names, and the name that stands for the cheapest exact enough one."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.checks import shown
from surrogate.contact.base import ForceModel
from surrogate.contact.closed_forms import FORCE_MODELS
from surrogate.errors import UnknownModelError

__all__ = ["AUTO", "FITTED_NAMES", "force_model", "is_auto", "one_name"]

AUTO = "auto"
"""The model that stands for the cheapest one that is exact enough."""

FITTED_NAMES = ("power-law", "table", "gp")
"""The models fitted to finite-element solutions."""


def is_auto(name: object) -> bool:
    """Return whether a name is the one that stands for the cheapest exact enough model.

    Examples
    --------
    >>> is_auto("auto"), is_auto("table")
    (True, False)
    """
    return isinstance(name, str) and name == AUTO


@cache
def _shipped() -> Callable[[], Any]:
    from surrogate.contact.shipped import shipped  # which loads what closed forms do not need

    return shipped


def force_model(name: object, argument: str = "model") -> ForceModel:
    """Return the model of that name, which is not "auto"; a model itself is returned as it is.

    Raises
    ------
    UnknownModelError
        If there is none; the message lists those that there are.
    InputError
        If the model is a fitted one and its file is missing or damaged.
    """
    if isinstance(name, str):  # which takes less time than to ask for an abstract class
        if name in FORCE_MODELS:
            return FORCE_MODELS[name]
        if name in FITTED_NAMES:
            return _shipped()().models[name]  # type: ignore[no-any-return]
    elif isinstance(name, ForceModel):
        return name
    names = ", ".join((*FORCE_MODELS, *FITTED_NAMES, AUTO))
    raise UnknownModelError(
        f"{argument} must be the name of a model or a ForceModel of one's own, but {argument} = "
        f"{shown(name)}; choose one of {names}."
    )


def one_name(names: str | NDArray[np.str_]) -> str:
    """Return the name that all points share, or else "auto".

    Examples
    --------
    >>> one_name(np.array(["gp", "gp"])), one_name(np.array(["gp", "table"]))
    ('gp', 'auto')
    """
    if isinstance(names, str):
        return names
    if names.size and not any(names.strides):  # a view of one name
        return str(names.flat[0])
    first = names.flat[0] if names.size else AUTO
    return AUTO if np.any(names != first) else str(first)

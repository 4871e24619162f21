"""Validation of arguments that are no quantities: choices, texts, mappings and sequences."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from surrogate.errors import InputError
from surrogate.validation import shown

__all__ = ["flag", "items", "mapping", "text"]


def flag(name: str, value: object) -> bool:
    """Return a validated choice of yes or no, numpy's own included.

    Examples
    --------
    >>> flag("extrapolate", np.bool_(True))
    True
    >>> flag("extrapolate", "no")
    Traceback (most recent call last):
        ...
    surrogate.errors.InputError: extrapolate must be True or False, but extrapolate = 'no' (str); \
give one of them.
    """
    if value is True or value is False:
        return value
    if isinstance(value, np.bool_):
        return bool(value)
    raise _refused(name, "True or False", value, "give one of them")


def text(name: str, value: object, remedy: str) -> str:
    """Return a validated text.

    Examples
    --------
    >>> text("label", 3.0, "give the name in the legend")
    Traceback (most recent call last):
        ...
    surrogate.errors.InputError: label must be text, but label = 3.0 (float); give the name in the \
legend.
    """
    if isinstance(value, str):
        return value
    raise _refused(name, "text", value, remedy)


def mapping(name: str, value: object, example: str) -> Mapping[Any, Any]:
    """Return a validated mapping, of which the entries are not looked at.

    Examples
    --------
    >>> mapping("std", 0.2, "{'toughness': 0.2}")
    Traceback (most recent call last):
        ...
    surrogate.errors.InputError: std must be a mapping, but std = 0.2 (float); give for instance \
{'toughness': 0.2}.
    """
    if isinstance(value, Mapping):
        return value
    raise _refused(name, "a mapping", value, f"give for instance {example}")


def items(name: str, value: object, example: str) -> tuple[Any, ...]:
    """Return the entries of a list, tuple or other sequence, which are not looked at.

    A text is none, although Python would take it as a sequence of letters.

    Examples
    --------
    >>> items("limits", "eq13", "['eq13']")
    Traceback (most recent call last):
        ...
    surrogate.errors.InputError: limits must be a list, but limits = 'eq13' (str); give for \
instance ['eq13'].
    """
    if not isinstance(value, (str, bytes, Mapping)):
        try:
            return tuple(value)  # type: ignore[arg-type]
        except TypeError:
            pass
    raise _refused(name, "a list", value, f"give for instance {example}")


def _refused(name: str, what: str, value: object, remedy: str) -> InputError:
    return InputError(
        f"{name} must be {what}, but {name} = {shown(value)} ({type(value).__name__}); {remedy}."
    )

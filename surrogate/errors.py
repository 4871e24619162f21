"""The errors that this library raises on purpose; catch `WirecutError` for all of them."""

from __future__ import annotations

__all__ = [
    "AccuracyError",
    "DomainError",
    "ImplausibleInputWarning",
    "InputError",
    "MissingExtraError",
    "OtherLawWarning",
    "UnknownErrorWarning",
    "UnknownModelError",
    "WirecutError",
]


class WirecutError(Exception):
    """Base class of every error that this library raises on purpose."""


class InputError(WirecutError, ValueError):
    """An argument that no formula here can use; the message names it, its value and a remedy."""


class DomainError(InputError):
    """An admissible value at which the formula asked for has no answer."""


class UnknownModelError(InputError):
    """A model name that is not registered; the message lists those that are."""


class AccuracyError(InputError):
    """An accuracy that no model offers; the message names the best one and its error."""


class MissingExtraError(WirecutError, ImportError):
    """An optional dependency is needed that is not installed."""


class ImplausibleInputWarning(UserWarning):
    """A number that is hardly that of cutting a soft solid with a wire: check its unit."""


class UnknownErrorWarning(UserWarning):
    """A number by the projected law, as nobody knows how far any law is off there."""


class OtherLawWarning(UserWarning):
    """A force under another law than that by which toughness and wear strength were identified."""

"""Errors of the finite-element engine."""

from __future__ import annotations

from surrogate.errors import InputError, WirecutError


class MissingExtraError(WirecutError, ImportError):
    """An optional dependency is needed that is not installed."""


__all__ = ["InputError", "MissingExtraError", "WirecutError"]

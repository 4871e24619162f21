"""Offline finite-element training of the wire-cutting surrogates."""

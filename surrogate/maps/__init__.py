"""Regime maps: axes, scenes, boundaries, tables, figures."""

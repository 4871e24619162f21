"""Cutting forces, regimes and material identification for wire cutting of soft solids."""

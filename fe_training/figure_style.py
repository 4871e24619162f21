"""What the figures of the finite elements have of their own: exponents, symbols of the axes."""

from __future__ import annotations

from typing import Any

__all__ = ["ALPHAS", "DISTANCE", "STYLES", "TOUGHNESS", "Columns"]

Columns = dict[tuple[str, str], Any]

ALPHAS = (2.0, 5.0, 9.0)
"""Stiffening exponents of the paper."""

STYLES: dict[float, dict[str, Any]] = {
    2.0: {"color": "#0072B2", "marker": "o", "ls": "-"},
    5.0: {"color": "#D55E00", "marker": "s", "ls": "--"},
    9.0: {"color": "#009E73", "marker": "^", "ls": "-."},
}
"""Colour, marker and line of each alpha of the paper."""

DISTANCE = r"distance to the tip $\delta/R_w$ [-]"
TOUGHNESS = r"$g = \Gamma_o/(\mu R_w)$ [-]"

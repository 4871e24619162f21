"""The model "table": piecewise polynomials made from the Gaussian processes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from surrogate.cell_table import CellTable
from surrogate.domain import Domain
from surrogate.elementwise import where
from surrogate.fitted_models import FittedModel
from surrogate.quantities import POWER, vertex

__all__ = ["TableModel"]


@dataclass(frozen=True, eq=False)
class TableModel(FittedModel):
    """A, B and (delta/R_w - 1)/|x|^(7/4) on the cells of a grid, x = ln(g/g_touch).

    Parameters
    ----------
    limits : Domain
        Its domain.
    table : CellTable
        The functions "arc", "normal_load" and "distance".
    """

    limits: Domain
    table: CellTable = field(repr=False)
    name: str = "table"
    equation: str = "bicubic cells of the gp's mean"

    def inside(self, names: Sequence[str], log_g: Any, log_alpha: Any, g: Any) -> list[Any]:
        x, values = self.table.at(names, log_g, log_alpha)
        if "distance" in names:
            which = names.index("distance")
            values[which] = 1.0 + vertex(x) * values[which]
        return values

    def inside_slopes(self, name: str, log_g: Any, log_alpha: Any) -> tuple[Any, Any, Any]:
        x, value, in_g, in_alpha = self.table.slopes(name, log_g, log_alpha)
        if name != "distance":
            return value, in_g, in_alpha
        _, bend = self.limits.log_touch_slopes(log_alpha)
        inner = where(x < 0.0, x, 1.0)
        shape = vertex(x)
        steep = POWER * shape / inner  # d |x|^(7/4)/dx
        return (
            1.0 + shape * value,
            where(x < 0.0, shape * in_g + steep * value, 0.0),
            where(x < 0.0, shape * in_alpha - steep * value * bend, 0.0),
        )

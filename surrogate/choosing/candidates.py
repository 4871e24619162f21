"""The models among which "auto" chooses, with what it needs of their bounds in each cell."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.files import models_folder
from surrogate.choosing.costs import by_cost
from surrogate.contact.base import ForceModel
from surrogate.contact.bounds import Bounds
from surrogate.contact.closed_forms import FORCE_MODELS
from surrogate.contact.fitted import PROJECTED, TERMS_OF_LAW
from surrogate.contact.shipped import Fitted, shipped
from surrogate.errors import InputError

__all__ = ["FREE", "OUTSIDE", "TERMS", "Candidates", "available", "candidates"]

Array = NDArray[np.float64]

FREE = "eq13"
OUTSIDE = "table"  # what continues beyond the domain, where no bound is known
TERMS = TERMS_OF_LAW[PROJECTED]
SAFETY_BEYOND = 2.0  # how many times the largest error of some solutions that of all may be


class Candidates:
    """Models in rising order of their cost, and functions of the bounds e of |ln(model/truth)|.

    Parameters
    ----------
    fitted : Fitted
        The fitted models.
    law : str
        The law of dissipation whose terms they are to give.

    Examples
    --------
    >>> Candidates(shipped()).names[0]
    'eq13'
    """

    def __init__(self, fitted: Fitted, law: str = PROJECTED) -> None:
        self.fitted, self.limits, self.bounds = fitted, fitted.limits, _bounds(fitted, law)
        self.terms = TERMS_OF_LAW[law]
        under = (model.under(law) for model in by_cost(fitted.models.values()))
        self.models: list[ForceModel] = [FORCE_MODELS[FREE], *under]
        self.names = [model.name for model in self.models]
        self.outside = self.names.index(OUTSIDE)
        self._tables: dict[tuple[Any, str, str], Array] = {}

    def error(self, model: str, name: str) -> Array:
        """Return exp(e) - 1 of a function by a model, by the number of the cell."""
        return self._kept(np.expm1, model, name)

    def least(self, name: str) -> Array:
        """Return exp(-e) of a function by Eq. (13), by the number of the cell."""
        return self._kept(_reciprocal, FREE, name)

    def most(self, name: str) -> Array:
        """Return exp(e) of a function by Eq. (13), by the number of the cell."""
        return self._kept(np.exp, FREE, name)

    def _kept(self, function: Callable[[Any], Any], model: str, name: str) -> Array:
        key = function, model, name
        if key not in self._tables:
            self._tables[key] = np.asarray(function(self.bounds.by_cell(model, name)))
        return self._tables[key]

    def errors_at(self, model: str, g: Any, alpha: Any) -> tuple[Any, Any]:
        """Return exp(e) - 1 of a model's two terms at points, infinite outside the domain."""
        cell, holds = self.bounds.cell(g, alpha), self.limits.all_hold(g, alpha)
        if holds is not True:  # the cells, in g/g_touch, may go beyond
            cell = np.where(holds, cell, self.bounds.cells)
        elif type(cell) is int:
            row, number = self.of_cells[cell], self.names.index(model)
            return row[6][number - 1] if number else row[4:6]
        arc, load = (self.error(model, name).take(cell) for name in self.terms)
        return arc, load

    def beyond(self, g: Any, alpha: Any) -> tuple[Any, Any] | None:
        """Return how far the terms may be off above the highest g, as far as solutions told.

        Infinite elsewhere; None where the file of the models says nothing of it.
        """
        if self._measured_beyond is None:
            return None
        bounds, (arc, load) = self._measured_beyond
        cell = bounds.cell(*np.broadcast_arrays(g / self.limits.highest_g(alpha), alpha))
        return arc[cell], load[cell]

    @cached_property
    def _measured_beyond(self) -> tuple[Bounds, list[Array]] | None:
        """Bounds over g/(highest g) and alpha, and the errors of the terms by their cells."""
        told = self.fitted.about.get("beyond")
        if not told:
            return None
        bounds = Bounds.from_dict(told)
        unknown = np.full(bounds.cells + 1, np.inf)
        known = bounds.errors[OUTSIDE]
        return bounds, [
            SAFETY_BEYOND * bounds.by_cell(OUTSIDE, name) if name in known else unknown
            for name in self.terms
        ]

    @cached_property
    def of_cells(self) -> list[tuple[Any, ...]]:
        """For single points, by cell: `least`, `most` and `error` of Eq. (13) for the two terms.

        Then the pairs of `error` of the other models.
        """
        arc, load = self.terms
        columns = [kind(name) for name in self.terms for kind in (self.least, self.most)]
        errors = [(self.error(model, arc), self.error(model, load)) for model in self.names]
        numbers = np.stack([*columns, *(each for pair in errors for each in pair)], axis=1)
        return [
            (*row[:6], tuple(zip(row[6::2], row[7::2], strict=True))) for row in numbers.tolist()
        ]


def _bounds(fitted: Fitted, law: str) -> Bounds:
    bounds = fitted.bounds if law == PROJECTED else fitted.slip_bounds
    if bounds is None:
        raise InputError(
            f"law={law!r} must have models with measured errors of A* and B*, but the file of "
            "models has none; make it anew with regen-surrogate, or take the models that wirecut "
            "ships."
        )
    return bounds


def _reciprocal(bound: Any) -> Any:
    return np.exp(-bound)


def candidates(fitted: Fitted | None = None, law: str = PROJECTED) -> Candidates:
    """Return the models with measured errors of a law; the shipped ones by default.

    Raises
    ------
    InputError
        If no fitted models are shipped.
    """
    return _candidates(fitted or shipped(), law, models_folder())


@cache
def _candidates(fitted: Fitted, law: str, folder_of_costs: str) -> Candidates:
    return Candidates(fitted, law)


def available(fitted: Fitted | None = None) -> tuple[list[ForceModel], Bounds]:
    """Return the models with measured errors, cheapest at many points first, and the bounds.

    The order is the same for one point, so that numbers and arrays agree.

    Raises
    ------
    InputError
        If no fitted models are shipped.
    """
    known = candidates(fitted)
    return known.models, known.bounds

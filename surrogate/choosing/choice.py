"""Choosing the cheapest model that is exact enough, before any of them is evaluated.

For each term t of the force, 2 R_w tau_w A and 2 R_w xi mu B, Eq. (13) gives an estimate m_t for
nothing, and the measured bound e_t of |ln(m_t/truth)| tells between which numbers the truth is. So
the force is at least L = Gamma_o + sum m_t exp(-e_t), and a term errs by m_t (exp(e_t) - 1) at
most. A term that errs by less than a quarter of rtol L is left at its estimate; the rest is
evaluated by the first model, in rising order of cost, whose own bounds keep the sum below rtol L.

Bounds are constant in each cell of (g, alpha), so that what depends on them alone is looked up.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.checks import INFINITY, SMALLEST, FloatOrArray
from surrogate.basics.digits import rounded_up
from surrogate.choosing.candidates import FREE, Candidates, available, candidates
from surrogate.contact.base import ForceModel
from surrogate.contact.coordinates import QUANTITIES
from surrogate.errors import AccuracyError

__all__ = [
    "Chosen",
    "bounded",
    "choose_contact",
    "choose_number",
    "choose_terms",
    "chosen_terms",
    "require_accuracy",
    "require_met",
]

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

NEGLIGIBLE = 0.25  # share of rtol up to which a term's own error is left alone


@dataclass(frozen=True, eq=False)
class Chosen:
    """What was chosen for a number of points.

    Parameters
    ----------
    models : sequence of ForceModel
        In rising order of cost.
    code : ndarray of int, or int
        Which of them each point takes; one number where it is the same for all.
    bound : ndarray
        Bound of the relative error there [-]; nan outside the domain.
    short : ndarray of bool, or bool
        Where that is more than asked for, and no model is better.
    needed : mapping of str to ndarray of bool, or to bool
        Where each function has to be evaluated; one for all points where they agree.
    """

    models: Sequence[ForceModel]
    code: NDArray[np.intp] | int
    bound: Array
    short: Mask | bool
    needed: dict[str, Mask | bool]


def choose_terms(
    g: Array,
    alpha: Array,
    parts: Sequence[Array],
    rtol: float,
    known: Candidates | None = None,
    refuse: bool = True,
) -> Chosen:
    """Return models for the terms of forces.

    Parameters
    ----------
    g, alpha : ndarray, shape (points,)
        Where [-].
    parts : sequence of ndarray
        Gamma_o and the terms of wear and friction by Eq. (13) [N/m].
    rtol : float
        Relative error of their sum that will do [-].
    known : Candidates, optional
        The models to choose among; the shipped ones of the projected law by default.
    refuse : bool, default True
        Whether to raise an error where no model is as exact, and not take the best one.

    Raises
    ------
    AccuracyError
        If no model is as exact; the message names the best one.
    """
    known = known or candidates()
    with np.errstate(all="ignore"):
        chosen = chosen_terms(known, known.bounds.cell(g, alpha), parts, rtol)
    if refuse:
        require_met(chosen, g, alpha, rtol)
    return chosen


def chosen_terms(known: Candidates, cell: Any, parts: Sequence[Any], rtol: float) -> Chosen:
    """Return models for the terms of forces in cells, without a word where none is exact enough.

    Terms that are 0 as a float are left out.
    """
    terms = [
        _Term(known, name, cell, estimate)
        for name, estimate in zip(known.terms, parts[1:], strict=True)
        if type(estimate) is not float or estimate
    ]
    low = np.maximum(sum((term.least() for term in terms), parts[0]), SMALLEST)
    shape = np.broadcast_shapes(np.shape(cell), np.shape(low))
    together = sum((term.worst_over(low) for term in terms), np.zeros(shape))
    errors = [together]
    if not np.all(together <= rtol):
        short = together > rtol
        left = sum(term.left_over(short, rtol) for term in terms)
        for term in terms:
            term.share_of(low)
        for model in known.names[1:]:
            errors.append(_combined([term.error(model) for term in terms]) + left)
            if np.all(errors[-1] <= rtol):
                break
    return _best(known, errors, {term.name: term.needed for term in terms}, rtol)


class _Term:
    """A term of the force at points: its estimate by Eq. (13), in which cells, how far it errs."""

    def __init__(self, known: Candidates, name: str, cell: Any, estimate: Any) -> None:
        self.known, self.name, self.cell, self.estimate = known, name, cell, estimate
        self.outside = bool(np.max(cell, initial=0) == known.bounds.cells)
        self.needed: Any = False

    def _times(self, table: Array) -> Any:
        """Return the estimate times a number of its cell, 0 where it is 0 and that infinite."""
        value = table.take(self.cell, mode="clip") * self.estimate
        return np.where(np.equal(self.estimate, 0.0), 0.0, value) if self.outside else value

    def least(self) -> Any:
        """Return the least that it can be."""
        return self._times(self.known.least(self.name))

    def worst_over(self, low: Any) -> Any:
        """Return its largest error as a share of the least force."""
        self.worst = self._times(self.known.error(FREE, self.name)) / low
        return self.worst

    def left_over(self, short: Any, rtol: float) -> Any:
        """Return the error that it is left with, having decided where it is needed."""
        needed = short & (self.worst > NEGLIGIBLE * rtol)
        self.needed = True if np.all(needed) else needed
        return 0.0 if self.needed is True else np.where(needed, 0.0, self.worst)

    def share_of(self, low: Any) -> None:
        """Find the largest share that it can have of the least force."""
        self.share = np.minimum(self._times(self.known.most(self.name)) / low, 1.0)

    def error(self, model: str) -> tuple[Any, Any]:
        """Return its relative error by a model, 0 where not needed, and that times its share."""
        error = self.known.error(model, self.name).take(self.cell, mode="clip")
        if self.needed is not True:
            error = np.where(self.needed, error, 0.0)
        return error, self.share * error


def _combined(errors: Sequence[tuple[Any, Any]]) -> Any:
    """Return the bound of the sum of terms: a weighted mean is not above the largest of them."""
    if len(errors) == 1:
        return errors[0][1]
    (arc, arc_part), (load, load_part) = errors
    return np.minimum(arc_part + load_part, np.maximum(arc, load))


def _best(known: Candidates, bounds: list[Array], needed: dict[str, Any], rtol: float) -> Chosen:
    """Return the first model that is exact enough at each point, the best where there is none."""
    meets = bounds[0] <= rtol
    if len(bounds) == 2 and not meets.any() and np.all(bounds[1] <= rtol):
        return Chosen(known.models, 1, bounds[1], False, needed)
    if len(bounds) == 1:
        return Chosen(known.models, 0, bounds[0], False, needed)
    errors = np.array(bounds)
    meets = errors <= rtol
    met = np.any(meets, axis=0)
    outside = ~np.any(np.isfinite(errors), axis=0)
    code = np.where(met, np.argmax(meets, axis=0), np.argmin(errors, axis=0))
    bound = np.take_along_axis(errors, code[np.newaxis], 0)[0]
    return Chosen(
        known.models,
        np.where(outside, known.outside, code),
        np.where(outside, np.nan, bound),
        ~met & ~outside,
        needed,
    )


def choose_number(
    known: Candidates, cell: int, parts: Sequence[float], rtol: float
) -> tuple[int, float, bool, bool, bool]:
    """Do the same as `chosen_terms` for one point: its model, bound and which terms it needs.

    The number of the model comes with a True at the end where it is the best one, yet not exact
    enough.
    """
    cleavage, worn, rubbed = parts
    least_arc, most_arc, least_load, most_load, error_arc, error_load, others = known.of_cells[cell]
    low = cleavage + (worn * least_arc if worn else 0.0)
    low = max(low + (rubbed * least_load if rubbed else 0.0), SMALLEST)
    worst_arc = worn * error_arc / low if worn else 0.0
    worst_load = rubbed * error_load / low if rubbed else 0.0
    together = worst_arc + worst_load
    if together <= rtol:
        return 0, together, False, False, False
    enough = NEGLIGIBLE * rtol
    needs_arc = together > rtol and worst_arc > enough
    needs_load = together > rtol and worst_load > enough
    left = (0.0 if needs_arc else worst_arc) + (0.0 if needs_load else worst_load)
    share_arc = min(worn * most_arc / low, 1.0) if worn else 0.0
    share_load = min(rubbed * most_load / low, 1.0) if rubbed else 0.0
    best, least = 0, together
    for number, (arc, load) in enumerate(others, start=1):
        arc, load = arc if needs_arc else 0.0, load if needs_load else 0.0
        bound, largest = share_arc * arc + share_load * load, arc if arc > load else load
        bound = (largest if largest < bound else bound) + left
        if bound <= rtol:
            return number, bound, needs_arc, needs_load, False
        if bound < least:
            best, least = number, bound
    if least == INFINITY:
        return known.outside, math.nan, needs_arc, needs_load, False
    return best, least, needs_arc, needs_load, True


def require_met(chosen: Chosen, g: Array, alpha: Array, rtol: float) -> None:
    """Raise an `AccuracyError` where no model is as exact as asked for."""
    if not np.any(chosen.short):
        return
    point = int(np.flatnonzero(chosen.short)[0])
    best, error = np.ravel(chosen.code)[point], np.ravel(chosen.bound)[point]
    raise AccuracyError(
        f"rtol must be met by a model, but rtol = {rtol:g} is not at g = {np.ravel(g)[point]:.4g}, "
        f"alpha = {np.ravel(alpha)[point]:.4g} ({np.count_nonzero(chosen.short)} of "
        f"{np.size(chosen.short)} points), where "
        f"the best is {chosen.models[best].name!r} with an error of up to {error:.2g}; "
        f"give rtol={rounded_up(error)} or more."
    )


def choose_contact(g: Array, alpha: Array, rtol: float) -> Chosen:
    """Return models for A, B and delta at points, each of them within rtol."""
    known = candidates()
    cell = known.bounds.cell(g, alpha)
    found: list[Array] = []
    for model in known.names:
        if found and np.all(np.min(found, axis=0) <= rtol):
            break
        found.append(_of_functions(known, model, cell))
    chosen = _best(known, found, dict.fromkeys(QUANTITIES, True), rtol)
    require_met(chosen, g, alpha, rtol)
    return chosen


def bounded(model: ForceModel, g: Array, alpha: Array) -> Array:
    """Return the bound of the relative errors of A, B and delta of one model at points."""
    known = candidates()
    return _of_functions(known, model.name, known.bounds.cell(g, alpha))


def _of_functions(known: Candidates, model: str, cell: Any) -> Array:
    largest = np.max([known.error(model, name) for name in QUANTITIES], axis=0)
    return np.asarray(largest[cell])


def require_accuracy(model: ForceModel, g: FloatOrArray, alpha: FloatOrArray, rtol: float) -> None:
    """Raise an `AccuracyError` where a model's A, B or delta may be off by more than rtol."""
    models, _ = available()
    if model.name not in [each.name for each in models]:
        raise AccuracyError(
            f"rtol must be met by a model with measured errors, but {model.name!r} has none; "
            f"choose one of {', '.join(each.name for each in models)}, or rtol=None."
        )
    points = np.broadcast_arrays(np.atleast_1d(g), np.atleast_1d(alpha))
    error = float(np.max(bounded(model, points[0].ravel(), points[1].ravel()), initial=0.0))
    if not error <= rtol:
        raise AccuracyError(
            f"rtol must be met by the model, but {model.name!r} may be off by {error:.2g} there, "
            f"more than rtol = {rtol:g}; choose model='auto' or a larger rtol."
        )

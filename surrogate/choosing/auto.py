"""Forces and contacts by the cheapest model that is exact enough at each point."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.checks import FloatOrArray, common_shape
from surrogate.basics.elementwise import quotient
from surrogate.choosing.accuracy import DEFAULT_RTOL
from surrogate.choosing.candidates import FREE, Candidates, candidates
from surrogate.choosing.choice import (
    Chosen,
    choose_contact,
    choose_number,
    choose_terms,
    chosen_terms,
)
from surrogate.contact.base import ForceModel
from surrogate.contact.closed_forms import FORCE_MODELS
from surrogate.contact.domain import require_inside

WORTH = 0.6  # share of points that need both terms from which both are evaluated at once

__all__ = ["AutomaticTerms", "automatic_contact", "named", "terms_of_one"]


class AutomaticTerms:
    """Friction, wear, where in the domain, number of the model and bound: a kernel for `apply`.

    What the scene lacks is not evaluated: B where xi is 0, A where tau_w is 0, neither where
    Eq. (13) with its own bound is exact enough. Outside the domain the table continues, and the
    bound is nan. What is to be refused is kept in mind, and refused by `finish`.

    Parameters
    ----------
    values : tuple
        The six quantities of a scene.
    rtol : float or None
        Relative error of the force that will do [-]; None for 0.02 where a model is as exact, and
        else for the most exact one.
    of_dissipation : bool
        Whether `rtol` is relative to friction and wear alone, without the cleavage.
    known : Candidates, optional
        The models to choose among; the shipped ones of the projected law by default.

    Examples
    --------
    >>> scene = 685.0, 1.6, 0.25e-3, 0.1, 7750.0, 2.0
    >>> friction, wear, inside, number, bound = AutomaticTerms(scene, 0.02)(*scene)
    >>> print(f"{friction:.2f} {wear:.2f} {bound < 0.02}")
    0.16 5.59 True
    """

    dtypes = (float, float, bool, np.uint8, float)

    def __init__(
        self,
        values: tuple[FloatOrArray, ...],
        rtol: float | None,
        of_dissipation: bool = False,
        known: Candidates | None = None,
    ) -> None:
        self.values, self.of_dissipation = values, of_dissipation
        self.rtol, self.is_promise = DEFAULT_RTOL if rtol is None else rtol, rtol is not None
        self.known = known or candidates()
        self.surrounded, self.short = True, False

    def __call__(
        self, mu: Any, gamma: Any, radius: Any, xi: Any, wear: Any, alpha: Any
    ) -> tuple[Any, ...]:
        scene = mu, gamma, radius, xi, wear, alpha
        g = quotient(gamma, mu, radius)
        cleavage = 0.0 * gamma if self.of_dissipation else gamma
        if type(g) is type(cleavage) is type(xi) is type(wear) is type(alpha) is float:
            terms = terms_of_one(self.known, g, scene, cleavage, self.rtol)
            if terms is not None:
                friction, worn, number, bound, short = terms
                self.short = self.short or short
                return friction, worn, True, number, bound
        return self._of_points(g, scene, cleavage)

    def _of_points(self, g: Any, scene: tuple[Any, ...], cleavage: Any) -> tuple[Any, ...]:
        """Return the same of points some of which may be outside the domain."""
        alpha = scene[5]
        rubbed, worn = FORCE_MODELS[FREE].terms(*scene)
        parts = cleavage, worn, rubbed
        holds = self.known.limits.all_hold(g, alpha)
        cell = self.known.bounds.cell(g, alpha)
        if holds is not True:
            self.surrounded = False
            cell = np.where(holds, cell, self.known.bounds.cells)
            holds = np.logical_or(holds, np.equal(rubbed, 0.0) & np.equal(worn, 0.0))
        one = type(g) is float and type(alpha) is float and type(rubbed) is type(worn) is float
        choice = self._number if one else self._block
        friction, wear, number, bound = choice(g, cell, parts, scene)
        if holds is not True:
            bound = self._beyond(g, alpha, (parts[0], friction, wear), bound)
        return friction, wear, holds if holds is True or not one else bool(holds), number, bound

    def _beyond(self, g: Any, alpha: Any, parts: tuple[Any, Any, Any], bound: Any) -> Any:
        """Return the bound with what was measured of the asymptotes where there was none."""
        errors = self.known.beyond(g, alpha)
        if errors is None:
            return bound
        rest, friction, wear = parts
        with np.errstate(all="ignore"):
            off = np.where(np.equal(wear, 0.0), 0.0, wear * errors[0])
            off = off + np.where(np.equal(friction, 0.0), 0.0, friction * errors[1])
            share = off / (rest + friction + wear)
            measured = np.where(np.isfinite(share), share, np.nan)
        found = np.where(np.isnan(bound), measured, bound)
        return float(found) if type(bound) is float else found

    def _number(
        self, g: float, cell: int, parts: tuple[float, ...], scene: tuple[float, ...]
    ) -> Any:
        friction, worn, code, bound, short = _of_cell(self.known, g, cell, parts, scene, self.rtol)
        self.short = self.short or short
        return friction, worn, code, bound

    def _block(self, g: Any, cell: Any, parts: tuple[Any, ...], scene: tuple[Any, ...]) -> Any:
        chosen = chosen_terms(self.known, cell, parts, self.rtol)
        self.short = self.short or bool(np.any(chosen.short))
        _, worn, rubbed = parts
        if type(chosen.code) is int and chosen.code == 0:
            return rubbed, worn, 0, chosen.bound
        terms = _evaluated(self.known.terms, chosen, g, (rubbed, worn), scene)
        return *terms, chosen.code, chosen.bound

    def finish(self, extrapolate: bool) -> None:
        """Raise what is to be refused, after all points are done.

        Raises
        ------
        DomainError
            If a point whose contact matters is outside the domain and `extrapolate` is not set.
        AccuracyError
            If no model is as exact.
        """
        if not (self.surrounded or extrapolate):
            require_inside(self.known.models[1], self.values)
        if self.short and self.is_promise:
            self._refuse()

    def _refuse(self) -> None:
        arrays: Any = np.broadcast_arrays(*self.values)
        mu, gamma, radius, xi, wear, alpha = (np.ravel(values) for values in arrays)
        with np.errstate(all="ignore"):
            g = quotient(gamma, mu, radius)
            rubbed, worn = FORCE_MODELS[FREE].terms(mu, gamma, radius, xi, wear, alpha)
            parts = 0.0 * gamma if self.of_dissipation else gamma, worn, rubbed
            choose_terms(g, alpha, parts, self.rtol, self.known)

    def names(self, number: Any) -> Any:
        """Return the names of the models of these numbers."""
        return named(self.known.names, number)


def terms_of_one(
    known: Candidates, g: float, scene: tuple[float, ...], cleavage: float, rtol: float
) -> tuple[float, float, int, float, bool] | None:
    """Return friction and wear of one scene by the cheapest model that is exact enough.

    Parameters
    ----------
    known : Candidates
        The models.
    g : float
        Gamma_o/(mu R_w) [-].
    scene : tuple of float
        The six quantities.
    cleavage : float
        What the error is relative to, beside friction and wear [N/m].
    rtol : float
        Relative error that will do [-].

    Returns
    -------
    tuple or None
        Friction, wear, the number of the model, the bound, and whether that is not met; None
        outside the domain.
    """
    if known.limits.all_hold(g, scene[5]) is not True:
        return None
    rubbed, worn = FORCE_MODELS[FREE].terms(*scene)
    cell = known.bounds.cell(g, scene[5])
    return _of_cell(known, g, cell, (cleavage, worn, rubbed), scene, rtol)


def _of_cell(
    known: Candidates,
    g: float,
    cell: int,
    parts: tuple[float, ...],
    scene: tuple[float, ...],
    rtol: float,
) -> tuple[float, float, int, float, bool]:
    mu, gamma, radius, xi, wear, alpha = scene
    code, bound, arc, load, short = choose_number(known, cell, parts, rtol)
    _, worn, rubbed = parts
    if code > 0:
        model: Any = known.models[code]
        strengths = xi if load else 0.0, wear if arc else 0.0
        terms = model.terms_at(g, mu, gamma, radius, *strengths, alpha)
        rubbed, worn = terms[0] if load else rubbed, terms[1] if arc else worn
    return rubbed, worn, code, bound, short


def _evaluated(
    terms: tuple[str, str],
    chosen: Chosen,
    g: Any,
    estimates: tuple[Any, Any],
    scene: tuple[Any, ...],
) -> Any:
    """Return friction and wear of points by their models, as estimated where that will do."""
    needed = [chosen.needed.get(name, False) for name in reversed(terms)]
    shape = common_shape(scene)
    results = [np.broadcast_to(estimate, shape) for estimate in estimates]
    for number, model in enumerate(chosen.models[1:], start=1):
        here = [np.logical_and(chosen.code == number, mask) for mask in needed]
        counts = [np.count_nonzero(np.broadcast_to(mask, shape)) for mask in here]
        together = min(counts) > WORTH * max(counts)
        groups: list[tuple[int, ...]] = [(0, 1)] if together else [(0,), (1,)]
        for group in groups:
            if any(counts[i] for i in group):
                some = np.broadcast_to(np.logical_or(*here) if together else here[group[0]], shape)
                _put(results, model, group, (some, here), (g, *scene))
    return results


def _put(
    results: list[Any],
    model: Any,
    terms: tuple[int, ...],
    masks: tuple[Any, list[Any]],
    point: tuple[Any, ...],
) -> None:
    """Put terms of a model into the results, evaluated at some points, where they are needed."""
    some, needed = masks
    whole = bool(np.all(some))
    at = [v if type(v) is float or whole else np.broadcast_to(v, some.shape)[some] for v in point]
    for strength in {4, 5} - {4 + i for i in terms}:
        at[strength] = 0.0
    values = model.terms_at(*at)
    for i in terms:
        if whole:
            results[i] = (
                values[i] if np.all(needed[i]) else np.where(needed[i], values[i], results[i])
            )
        else:
            evaluated = np.array(results[i])
            inside = np.broadcast_to(needed[i], some.shape)[some]
            evaluated[some] = np.where(inside, values[i], evaluated[some])
            results[i] = evaluated


def automatic_contact(
    evaluate: Callable[[ForceModel, tuple[Any, Any]], Any],
    values: tuple[FloatOrArray, FloatOrArray],
    rtol: float,
) -> tuple[NDArray[np.str_], tuple[int, ...], list[tuple[Any, Any]]]:
    """Return the names for g and alpha, their shape, and for each model used mask and result."""
    shape = common_shape(values)
    g, alpha = (np.array(np.broadcast_to(v, shape), dtype=float).ravel() for v in values)
    chosen = choose_contact(g, alpha, rtol)
    code = np.broadcast_to(chosen.code, g.shape)
    results = []
    for number, model in enumerate(chosen.models):
        here = code == number
        if np.any(here):
            results.append((here, evaluate(model, (g[here], alpha[here]))))
    return np.array([model.name for model in chosen.models])[code], shape, results


def named(names: Sequence[str], number: Any) -> Any:
    """Return the names of numbers, as a view of one where all are the same.

    Examples
    --------
    >>> named(("gp", "table"), 1), named(("gp", "table"), np.array([0, 1])).tolist()
    ('table', ['gp', 'table'])
    """
    if type(number) is int:
        return names[number]
    known = np.array(names)
    if number.size and number.min() == number.max():
        return np.broadcast_to(known[number.flat[0]], number.shape)
    return known[number]

"""Choosing the cheapest model that is exact enough, before any of them is evaluated.

For each term t of the force, 2 R_w tau_w A and 2 R_w xi mu B, Eq. (13) gives an estimate m_t for
nothing, and the measured bound e_t of |ln(m_t/truth)| tells between which numbers the truth is. So
the force is at least L = Gamma_o + sum m_t exp(-e_t), and a term errs by m_t (exp(e_t) - 1) at
most. A term that errs by less than a quarter of rtol L is left at its estimate; the rest is
evaluated by the first model, in rising order of cost, whose own bounds keep the sum below rtol L.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.checks import FloatOrArray, common_shape
from surrogate.basics.elementwise import product, quotient
from surrogate.choosing.by_name import AUTO
from surrogate.choosing.catalogue import by_cost
from surrogate.contact.base import ForceModel
from surrogate.contact.bounds import Bounds
from surrogate.contact.closed_forms import FORCE_MODELS
from surrogate.contact.coordinates import QUANTITIES
from surrogate.contact.domain import require_inside
from surrogate.contact.shipped import Fitted, shipped
from surrogate.errors import AccuracyError

__all__ = [
    "Chosen",
    "automatic_contact",
    "automatic_terms",
    "available",
    "bounded",
    "choose_contact",
    "choose_terms",
    "one_name",
    "require_accuracy",
    "rounded_up",
    "scalar",
]

Array = NDArray[np.float64]

FREE = "eq13"
NEGLIGIBLE = 0.25  # share of rtol up to which a term's own error is left alone
OUTSIDE = "table"  # what continues beyond the domain, where no bound is known
TERMS = ("arc", "normal_load")


@dataclass(frozen=True, eq=False)
class Chosen:
    """What was chosen for a number of points.

    Parameters
    ----------
    models : sequence of ForceModel
        In rising order of cost.
    code : ndarray of int
        Which of them each point takes.
    bound : ndarray
        Bound of the relative error there [-]; nan outside the domain.
    inside : ndarray of bool
        Where g and alpha are in the domain.
    needed : mapping of str to ndarray of bool
        Where each function has to be evaluated.
    """

    models: Sequence[ForceModel]
    code: NDArray[np.intp]
    bound: Array
    inside: NDArray[np.bool_]
    needed: dict[str, NDArray[np.bool_]]

    @property
    def names(self) -> NDArray[np.str_]:
        """Names of the models."""
        return np.array([model.name for model in self.models])[self.code]


def available(fitted: Fitted | None = None) -> tuple[list[ForceModel], Bounds]:
    """Return the models with measured errors, cheapest at many points first, and the bounds.

    The order is the same for one point, so that numbers and arrays agree.

    Raises
    ------
    InputError
        If no fitted models are shipped.
    """
    fitted = fitted or shipped()
    return [FORCE_MODELS[FREE], *by_cost(fitted.models.values())], fitted.bounds


def choose_terms(
    g: Array,
    alpha: Array,
    parts: Sequence[Array],
    rtol: float,
    fitted: Fitted | None = None,
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
    fitted : Fitted, optional
        The models to choose among; the shipped ones by default.
    refuse : bool, default True
        Whether to raise an error where no model is as exact, and not take the best one.

    Raises
    ------
    AccuracyError
        If no model is as exact; the message names the best one.
    """
    models, bounds = available(fitted)
    cleavage, estimates = parts[0], dict(zip(TERMS, parts[1:], strict=True))
    with np.errstate(all="ignore"):
        free = {name: _bound(bounds, FREE, name, g, alpha, estimates[name]) for name in TERMS}
        low = cleavage + sum(estimates[name] * np.exp(-free[name]) for name in TERMS)
        worst = {name: _share(estimates[name] * np.expm1(free[name]), low) for name in TERMS}
        together = worst[TERMS[0]] + worst[TERMS[1]]
        needed = {name: (together > rtol) & (worst[name] > NEGLIGIBLE * rtol) for name in TERMS}
        left = sum(np.where(needed[name], 0.0, worst[name]) for name in TERMS)
        share = {n: _share(estimates[n] * np.exp(free[n]), low) for n in TERMS}
        found = [together]
        for model in models[1:]:
            if _met(found, rtol):
                break
            errors = [
                np.where(needed[n], _bound(bounds, model.name, n, g, alpha, estimates[n]), 0.0)
                for n in TERMS
            ]
            arc, load = (
                np.minimum(share[n], 1.0) * np.expm1(error)
                for n, error in zip(TERMS, errors, strict=True)
            )
            # a weighted mean of errors is not above the largest of them
            found.append(np.minimum(arc + load, np.expm1(np.maximum(*errors))) + left)
    return _chosen(models, np.array(found), needed, rtol, g, alpha, refuse)


def choose_contact(g: Array, alpha: Array, rtol: float) -> Chosen:
    """Return models for A, B and delta at points, each of them within rtol."""
    models, bounds = available()
    found: list[Array] = []
    for model in models:
        if found and _met(found, rtol):
            break
        largest = np.max([bounds.at(model.name, name, g, alpha) for name in QUANTITIES], axis=0)
        found.append(np.expm1(largest))
    everywhere = dict.fromkeys(QUANTITIES, np.ones(len(g), bool))
    return _chosen(models, np.array(found), everywhere, rtol, g, alpha)


def bounded(model: ForceModel, g: Array, alpha: Array) -> Array:
    """Return the bound of the relative errors of A, B and delta of one model at points."""
    _, bounds = available()
    largest = np.max([bounds.at(model.name, name, g, alpha) for name in QUANTITIES], axis=0)
    return np.asarray(np.expm1(largest))


def _bound(bounds: Bounds, model: str, name: str, g: Array, alpha: Array, term: Array) -> Array:
    """Return the bound of a function, 0 where its term is."""
    return np.asarray(np.where(term == 0.0, 0.0, bounds.at(model, name, g, alpha)))


def _met(found: Sequence[Array], rtol: float) -> bool:
    """Return whether some model is exact enough at every point, so that no other is asked."""
    return bool(np.all(np.min(found, axis=0) <= rtol))


def _share(term: Array, total: Array) -> Array:
    return np.asarray(np.where(term == 0.0, 0.0, term / total))


def _chosen(
    models: list[ForceModel],
    found: Array,
    needed: dict[str, NDArray[np.bool_]],
    rtol: float,
    g: Array,
    alpha: Array,
    refuse: bool = True,
) -> Chosen:
    meets = found <= rtol
    code = np.where(np.any(meets, axis=0), np.argmax(meets, axis=0), np.argmin(found, axis=0))
    outside = ~np.any(np.isfinite(found), axis=0)
    short = ~np.any(meets, axis=0) & ~outside
    if refuse and np.any(short):
        point = int(np.flatnonzero(short)[0])
        best = int(np.argmin(found[:, point]))
        error = found[best, point]
        raise AccuracyError(
            f"rtol must be met by a model, but rtol = {rtol:g} is not at g = {g[point]:.4g}, "
            f"alpha = {alpha[point]:.4g} ({np.count_nonzero(short)} of {short.size} points), where "
            f"the best is {models[best].name!r} with an error of up to {error:.2g}; "
            f"give rtol={rounded_up(error)} or more."
        )
    names = [model.name for model in models]
    code = np.where(outside, names.index(OUTSIDE), code)
    bound = np.where(outside, np.nan, np.take_along_axis(found, code[np.newaxis], 0)[0])
    return Chosen(models, code, bound, models[-1].holds(g, alpha), needed)


def rounded_up(error: float) -> str:
    """Return a number in two digits that is not below the error.

    Examples
    --------
    >>> rounded_up(0.01234), rounded_up(0.02)
    ('0.013', '0.02')
    """
    text = f"{error:.1e}"
    return f"{float(text if float(text) >= error else f'{1.05 * error:.1e}'):g}"


def automatic_terms(
    values: tuple[FloatOrArray, ...],
    rtol: float,
    extrapolate: bool,
    of_dissipation: bool = False,
    fitted: Fitted | None = None,
) -> Any:
    """Return friction, wear, where in the domain, model and bound of each point.

    What the scene lacks is not evaluated: B where xi is 0, A where tau_w is 0, neither where
    Eq. (13) with its own bound is exact enough.

    Parameters
    ----------
    values : tuple
        The six quantities of a scene.
    rtol : float
        Relative error of the force that will do [-].
    extrapolate : bool
        Whether points outside the domain are continued by the table; their bound is nan.
    of_dissipation : bool
        Whether `rtol` is relative to friction and wear alone, without the cleavage.
    fitted : Fitted, optional
        The models to choose among; the shipped ones by default.

    Raises
    ------
    AccuracyError
        If no model is as exact.
    DomainError
        If a point whose contact matters is outside the domain and `extrapolate` is not set.
    """
    shape = common_shape(values)
    mu, gamma, radius, xi, wear, alpha = (
        np.array(np.broadcast_to(v, shape), dtype=float).ravel() for v in values
    )
    with np.errstate(all="ignore"):
        g = quotient(gamma, mu, radius)
        free = FORCE_MODELS["eq13"].terms(mu, gamma, radius, xi, wear, alpha)
    friction, worn = (np.array(term, dtype=float) for term in np.broadcast_arrays(*free))
    matters = (friction > 0.0) | (worn > 0.0)
    models, _ = available(fitted)
    if not extrapolate:
        require_inside(models[1], values)
    chosen = choose_terms(
        g, alpha, (0.0 * gamma if of_dissipation else gamma, worn, friction), rtol, fitted
    )
    inside = chosen.inside | ~matters
    for code, model in enumerate(chosen.models[1:], start=1):
        here = chosen.code == code
        for name, term, given in (("arc", worn, wear), ("normal_load", friction, xi)):
            some = here & chosen.needed[name] & (given > 0.0)
            if not np.any(some):
                continue
            if name == "arc":
                value = model.arc(g[some], alpha[some])
                term[some] = 2.0 * product(wear[some], radius[some], value)
            else:
                mass = mu[some], gamma[some], radius[some], xi[some]
                term[some] = model.terms(*mass, 0.0, alpha[some])[0]
    return (
        *(scalar(np.reshape(v, shape)) for v in (friction, worn)),
        scalar(np.reshape(inside, shape)),
        scalar(np.reshape(chosen.names, shape)),
        scalar(np.reshape(chosen.bound, shape)),
    )


def automatic_contact(
    evaluate: Callable[[ForceModel, tuple[Any, Any]], Any],
    values: tuple[FloatOrArray, FloatOrArray],
    rtol: float,
) -> tuple[Chosen, tuple[int, ...], list[tuple[Any, Any]]]:
    """Return the choice for g and alpha, their shape, and for each model used mask and result."""
    shape = common_shape(values)
    g, alpha = (np.array(np.broadcast_to(v, shape), dtype=float).ravel() for v in values)
    chosen = choose_contact(g, alpha, rtol)
    found = []
    for code, model in enumerate(chosen.models):
        here = chosen.code == code
        if np.any(here):
            found.append((here, evaluate(model, (g[here], alpha[here]))))
    return chosen, shape, found


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


def one_name(names: str | NDArray[np.str_]) -> str:
    """Return the name that all points share, or else "auto".

    Examples
    --------
    >>> one_name(np.array(["gp", "gp"])), one_name(np.array(["gp", "table"]))
    ('gp', 'auto')
    """
    if isinstance(names, str):
        return names
    different = set(names.ravel().tolist())
    return different.pop() if len(different) == 1 else AUTO


def scalar(values: Any) -> Any:
    """Return an array of no axes as the Python number or text that it holds.

    Examples
    --------
    >>> scalar(np.array(2.5))
    2.5
    """
    return values.item() if np.ndim(values) == 0 else values

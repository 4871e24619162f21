"""The model "auto": each point by the cheapest model that is exact enough for it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from surrogate.choice import Chosen, available, bounded, choose_contact, choose_terms
from surrogate.elementwise import product, quotient
from surrogate.errors import AccuracyError
from surrogate.fitted import Fitted
from surrogate.force_models import FORCE_MODELS, ForceModel
from surrogate.inside import require_inside
from surrogate.validation import FloatOrArray, common_shape

__all__ = ["automatic_contact", "automatic_terms", "one_name", "require_accuracy", "scalar"]

Array = NDArray[np.float64]

AUTO = "auto"
"""The model that stands for the cheapest one that is exact enough."""


def automatic_terms(
    values: tuple[FloatOrArray, ...],
    rtol: object,
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
    rtol: object,
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

"""Toughness and wear strength where the force is linear in both: one weighted least squares."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from surrogate.choosing.by_name import force_model
from surrogate.contact.base import ForceModel
from surrogate.contact.closed_forms import ClosedForm
from surrogate.errors import InputError
from surrogate.inference.inputs import Cuts

__all__ = [
    "LinearFit",
    "correlation_of",
    "fit_line",
    "is_linear",
    "linear_form",
    "solve_least_squares",
    "solve_with_shared",
]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class LinearFit:
    """Solution of a least-squares problem whose values have unit variance.

    Parameters
    ----------
    estimate : ndarray, shape (p,)
        The unknowns.
    covariance : ndarray, shape (p, p)
        Their covariance for values of unit variance.
    leverage : ndarray, shape (n,)
        Weight of each value in its own prediction, between 0 and 1.
    condition : float
        Condition number of the design matrix with columns of unit length.
    """

    estimate: Array
    covariance: Array
    leverage: Array
    condition: float


def solve_least_squares(design: Array, values: Array) -> LinearFit:
    """Minimise |design x - values| by QR on columns scaled to unit length.

    Scaling makes the condition number, and so the digits that are left, independent of the
    unknowns' units.

    Parameters
    ----------
    design : ndarray, shape (n, p)
        Derivative of each value with respect to each unknown, n >= p.
    values : ndarray, shape (n,)
        The values to meet.

    Returns
    -------
    LinearFit
        Unknowns, covariance, leverages and condition; all nan where the columns are
        linearly dependent.

    References
    ----------
    A. Bjorck, Numerical Methods for Least Squares Problems, SIAM 1996, sections 2.4 and 2.9.

    Examples
    --------
    >>> fit = solve_least_squares(np.array([[1.0, 0.0], [1.0, 1.0], [1.0, 2.0]]), np.arange(3.0))
    >>> print(np.round(fit.estimate, 12) + 0.0)
    [0. 1.]
    """
    scale = np.linalg.norm(design, axis=0)
    q, r = np.linalg.qr(design / scale)
    condition = float(np.linalg.cond(r))
    if not condition < 1.0 / np.finfo(float).eps:
        unknown = np.full(design.shape[1], np.nan)
        return LinearFit(unknown, np.outer(unknown, unknown), values * np.nan, np.inf)
    inverse = np.linalg.inv(r) / scale[:, np.newaxis]
    return LinearFit(inverse @ (q.T @ values), inverse @ inverse.T, np.sum(q**2, axis=1), condition)


def solve_with_shared(
    design: Array, values: Array, factors: Mapping[str, Array]
) -> tuple[LinearFit, dict[str, Array]]:
    """Minimise r' (1 + sum of K K')^-1 r for r = design x - values, and tell the sources apart.

    Parameters
    ----------
    design, values : ndarray
        As `solve_least_squares`.
    factors : mapping of str to ndarray, shape (n, k)
        K of each source: what its k independent errors of unit variance do to the values.

    Returns
    -------
    LinearFit
        The solution.
    dict of str to ndarray, shape (p,)
        Standard errors that each source brings, "scatter" among them; their squares add up to the
        diagonal of the covariance.

    Examples
    --------
    >>> fit, parts = solve_with_shared(np.ones((4, 1)), np.ones(4), {"all": np.ones((4, 1))})
    >>> print(np.round([parts["scatter"][0], parts["all"][0]], 6))
    [0.5 1. ]
    """
    inverse: Array = np.eye(len(values))
    if factors:
        both = np.hstack(list(factors.values()))
        try:
            inverse = np.asarray(np.linalg.inv(inverse + both @ both.T), dtype=float)
            white = np.linalg.cholesky(inverse).T
        except np.linalg.LinAlgError:
            raise InputError(
                "what the forces share (the errors of mu, xi, alpha and of the model) must not "
                "exceed their own errors by more than 1e7 times, but does; give the forces' errors "
                "or smaller errors of the material."
            ) from None
    else:
        white = inverse
    fit = solve_least_squares(white @ design, white @ values)
    estimator = fit.covariance @ design.T @ inverse
    parts = {"scatter": estimator, **{name: estimator @ each for name, each in factors.items()}}
    return fit, {name: np.sqrt((part**2).sum(axis=1)) for name, part in parts.items()}


def correlation_of(covariance: Array) -> float:
    """Return the correlation of two unknowns, nan where one has no variance.

    Examples
    --------
    >>> correlation_of(np.array([[4.0, 1.0], [1.0, 1.0]]))
    0.5
    """
    scale = float(np.prod(np.sqrt(np.diag(covariance))))
    return float(covariance[0, 1]) / scale if scale > 0.0 else np.nan


def is_linear(model: str | ForceModel) -> bool:
    """Return whether the force of a model is linear in toughness and wear strength.

    Examples
    --------
    >>> is_linear("eq13"), is_linear("eq9")
    (True, False)
    """
    chosen = force_model(model)
    return isinstance(chosen, ClosedForm) and chosen.arc_2 > 0.0


def linear_form(
    model: str | ForceModel, radius: Array, shear_modulus: float, friction: float
) -> tuple[Array, Array]:
    """Return columns and offset with F_ss/T = offset + columns @ (toughness, wear_strength).

    Raises
    ------
    InputError
        If the model is not linear in both.

    Examples
    --------
    >>> columns, offset = linear_form("eq13", np.array([1e-4]), 685.0, 0.1)
    >>> print(columns, offset)
    [[1.1e+00 4.0e-04]] [0.0274]
    """
    chosen = force_model(model)
    if not isinstance(chosen, ClosedForm) or not is_linear(model):
        raise InputError(
            f"model {model!r} is not linear in both toughness and wear strength, so that it "
            "cannot be fitted here; choose 'eq13', 'low-toughness' or 'friction-free'."
        )
    columns = np.empty((*radius.shape, 2))
    columns[..., 0] = 1.0 + friction * chosen.load_2_slope
    columns[..., 1] = chosen.arc_2 * radius
    return columns, chosen.load_2 * (friction * shear_modulus * radius)


def fit_line(cuts: Cuts, model: str | ForceModel) -> dict[str, Any]:
    """Return what the fit of a straight line says, by the names of an `Identification`.

    Raises
    ------
    InputError
        If the radii are the same but for rounding.

    Examples
    --------
    >>> radius, force = np.array([1e-4, 2e-4, 3e-4]), np.array([3.0, 5.0, 7.0])
    >>> fit = fit_line(Cuts(radius, force, None, 685.0, 0.0, 2.0), "eq13")
    >>> print(f"{fit['toughness']:.6f} {fit['wear_strength']:.3f}")
    1.000000 5000.000
    """
    columns, offset = linear_form(
        model, cuts.wire_radius, cuts.shear_modulus, cuts.friction_coefficient
    )
    weight, target = cuts.weight, cuts.force - offset
    design, values = columns * weight[:, np.newaxis], target * weight
    plain = fit = solve_least_squares(design, values)
    if not np.isfinite(plain.condition):
        smallest, largest = cuts.wire_radius.min(), cuts.wire_radius.max()
        raise InputError(
            f"the radii differ by rounding only ({smallest:.17g} to {largest:.17g} m): "
            "toughness and wear cannot be told apart; cut with at least two different wires."
        )
    dof = cuts.force.size - 2
    misfit = _misfit(design, values, _of_samples(cuts))
    scale = _scale(cuts, misfit, dof)
    contributions = {"scatter": scale * np.sqrt(np.diag(plain.covariance))}
    factors = _factors(cuts, model, plain.estimate, scale)
    if factors:
        fit, parts = solve_with_shared(design, values, factors)
        contributions = {name: scale * part for name, part in parts.items()}
    residuals = target - columns @ fit.estimate
    return {
        "toughness": float(fit.estimate[0]),
        "wear_strength": float(fit.estimate[1]),
        "residuals": residuals,
        "misfit": misfit,
        "covariance": scale**2 * fit.covariance,
        "correlation": correlation_of(fit.covariance),
        "condition": plain.condition,
        "leverage": plain.leverage,
        "contributions": {name: (float(a), float(b)) for name, (a, b) in contributions.items()},
        "model_error": None,
        "friction_sensitivity": _friction_sensitivity(cuts, model, fit.estimate),
    }


def _friction_sensitivity(
    cuts: Cuts, model: str | ForceModel, estimate: Array
) -> tuple[float, float]:
    """Return d(estimates)/dxi: (1 + c xi) Gamma_o and tau_w + d xi mu stay as they are."""
    chosen = force_model(model)
    assert isinstance(chosen, ClosedForm)
    growth = chosen.load_2_slope
    gamma = -growth * float(estimate[0]) / (1.0 + growth * cuts.friction_coefficient)
    return gamma, -chosen.load_2 / chosen.arc_2 * cuts.shear_modulus


def _scale(cuts: Cuts, misfit: float, dof: int) -> float:
    """Return the standard error of a force of weight 1 [N/m]; nan where nothing tells it."""
    if cuts.force_std is not None:
        return 1.0
    return float(np.sqrt(misfit / dof)) if dof else np.nan


def _factors(
    cuts: Cuts, model: str | ForceModel, estimate: Array, scale: float
) -> dict[str, Array]:
    """Return what the errors that forces share do to the weighted forces, in units of the scale."""
    chosen = force_model(model)
    if not isinstance(chosen, ClosedForm) or not scale > 0.0:
        return {}
    stiffness = chosen.load_2 * cuts.wire_radius
    friction = chosen.load_2_slope * estimate[0] + stiffness * cuts.shear_modulus
    columns = {
        "shear_modulus": cuts.friction_coefficient * stiffness * cuts.shear_modulus_std,
        "friction_coefficient": friction * cuts.friction_std,
    }
    factors = {
        name: (cuts.weight * column / scale)[:, np.newaxis]
        for name, column in columns.items()
        if np.any(column)
    }
    return factors | _of_samples(cuts)


def _of_samples(cuts: Cuts) -> dict[str, Array]:
    if cuts.sample is None or not cuts.sample_ratio > 0.0:
        return {}
    same = cuts.sample[:, np.newaxis] == np.unique(cuts.sample)
    return {"sample": np.where(same, cuts.sample_ratio, 0.0)}


def _misfit(design: Array, values: Array, factors: dict[str, Array]) -> float:
    """Return the least r' (1 + sum of K K')^-1 r."""
    fit, _ = solve_with_shared(design, values, factors)
    residuals = values - design @ fit.estimate
    inverse: Array = np.eye(len(values))
    if factors:
        both = np.hstack(list(factors.values()))
        inverse = np.asarray(np.linalg.inv(inverse + both @ both.T), dtype=float)
    return float(residuals @ inverse @ residuals)

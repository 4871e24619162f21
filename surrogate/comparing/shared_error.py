"""What the error of one model does to two gels at once: it cancels in part from their difference.

A model's A is off by a share that depends on g and alpha alone. Two gels that are cut at the same
g are off together. The shares at two g go together as within one gel, the less the farther ln g is
apart; beyond an end of the model's range the continuation drifts away for both alike. At two
alphas nobody knows how they go together, and they are taken as independent, with which a
difference is less certain.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from surrogate.identification.fit import Identification
from surrogate.inference.continuation import CORRELATION_LENGTH, ContactError, contact_error

__all__ = ["covariance_between"]

Array = NDArray[np.float64]


def covariance_between(one: Identification, other: Identification) -> Array:
    """Return the covariance of (Gamma_o, tau_w) of two gels that the model's error brings.

    To first order, as `Identification.covariance`; 0 where no error of the model is known, or where
    a limit holds an estimate.

    Parameters
    ----------
    one, other : Identification
        Under the same model.

    Returns
    -------
    ndarray, shape (2, 2)
        Of the estimates of `one`, in rows, and of `other` [J/m2 and Pa].

    Examples
    --------
    >>> from surrogate.identification.fit import identify
    >>> fit = identify([1e-4, 2e-4, 4e-4, 5e-4], [4.7, 7.9, 13.9, 17.2], 685.0)
    >>> variance = covariance_between(fit, fit)[0, 0]
    >>> print(f"{variance**0.5 / fit.model_error[0]:.6f}")
    1.000000
    """
    nothing = np.zeros((2, 2))
    if one.stiffening_exponent != other.stiffening_exponent:
        return nothing
    parts = [_errors(fit) for fit in (one, other)]
    estimators = [_estimator(fit) for fit in (one, other)]
    if None in parts or not all(np.all(np.isfinite(each)) for each in estimators):
        return nothing
    (g, error, worn, friction), (g2, error2, worn2, friction2) = parts  # type: ignore[misc]
    apart = np.abs(np.log(g)[:, np.newaxis] - np.log(g2))
    together = np.exp(-apart / CORRELATION_LENGTH)
    for side in ("below", "above"):
        both = np.outer(getattr(error, side), getattr(error2, side))
        arc = worn * error.arc_drift, worn2 * error2.arc_drift
        load = friction * error.load_drift, friction2 * error2.load_drift
        nothing = nothing + _between(estimators, both * (np.outer(*arc) + np.outer(*load)))
    near = np.outer(worn * error.arc, worn2 * error2.arc)
    near = near + np.outer(friction * error.load, friction2 * error2.load)
    drag = worn + friction, worn2 + friction2
    if error.factor is not None and error2.factor is not None:
        near = near + np.outer(drag[0] * error.factor, drag[1] * error2.factor)
    if error.factor_drift is not None and error2.factor_drift is not None:
        drift = np.outer(drag[0] * error.factor_drift, drag[1] * error2.factor_drift)
        nothing = nothing + _between(estimators, drift)
    return nothing + _between(estimators, together * near)


def _between(estimators: list[Array], forces: Array) -> Array:
    return np.asarray(estimators[0] @ forces @ estimators[1].T)


def _errors(fit: Identification) -> tuple[Array, ContactError, Array, Array] | None:
    """Return g, the model's relative errors there, and wear and friction that they act on."""
    model, misfit = fit.tangent, fit.misfit
    g = np.asarray(fit.dimensionless_toughness)
    if fit.scale is None or not np.all(g > 0.0):
        return None
    error = contact_error(model, g, fit.stiffening_exponent)
    if error is None:
        return None
    at = np.array([fit.toughness])
    return g, error, fit.wear_strength * misfit.arcs(at)[0], misfit.bases(at)[0] - fit.toughness


def _estimator(fit: Identification) -> Array:
    """Return what turns changes of the forces into those of the estimates, shape (2, n)."""
    at, tau = np.array([fit.toughness]), np.array([fit.wear_strength])
    misfit, scale = fit.misfit, fit.scale or 1.0
    forces = np.diag((scale / fit.cuts.weight) ** 2)
    for _, factor in misfit.shared(at, tau):
        forces = forces + factor[0] @ factor[0].T
    free = slice(0, 1 if fit.known.wear_strength is not None else 2)
    design = fit.force_slopes(fit.wire_radius)[:, free]
    estimator = np.zeros((2, fit.force.size))
    if not np.all(np.isfinite(design)):
        return estimator * np.nan
    # columns of a size, because joules and pascals are orders of magnitude apart
    size = np.linalg.norm(design, axis=0)
    weighted = np.linalg.solve(forces, design / size)
    estimator[free] = (
        np.linalg.solve((design / size).T @ weighted, weighted.T) / size[:, np.newaxis]
    )
    return estimator

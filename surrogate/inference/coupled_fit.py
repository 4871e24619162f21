"""The fit under the law "coupled", whose force is not linear in the wear strength.

The law is replaced by its tangent in tau_w at the wear strength of the fit before, until both
agree: a Newton iteration, whose last tangent the intervals are of.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from surrogate.contact.base import ForceModel
from surrogate.coupling.frozen import FrozenLoad, frozen
from surrogate.coupling.model import CoupledModel
from surrogate.errors import DomainError
from surrogate.inference.inputs import Cuts

__all__ = ["CoupledFit", "coupled_fit"]

_MOST, _SAME, _SAME_IN_THE_END = 30, 1e-6, 1e-4


@dataclass(frozen=True, eq=False)
class CoupledFit:
    """A fit under the law "coupled", and the cuts that its solutions do not reach.

    Parameters
    ----------
    fit : dict
        What `fitted` returned at the estimate; empty where the search did not settle, which is
        only where some cuts are outside.
    outside : ndarray of bool, shape (n,)
        Cuts whose load no coupled solution is near to.
    g : ndarray, shape (n,)
        Of the cuts [-].
    relative_wear : float
        tau_w/mu [-].
    """

    fit: dict[str, Any]
    outside: NDArray[np.bool_]
    g: NDArray[np.float64]
    relative_wear: float

    def reach_in_words(self, cuts: Cuts) -> str:
        """Return which cuts coupled solutions do not reach, and their load."""
        first = int(np.argmax(self.outside))
        return (
            f"coupled solutions do not reach to {np.count_nonzero(self.outside)} of "
            f"{self.outside.size} cuts (first to R_w = {1e3 * cuts.wire_radius[first]:.4g} mm), "
            f"with xi = {cuts.friction_coefficient:.3g} and tau_w/mu = {self.relative_wear:.3g} "
            f"at g = {self.g[first]:.3g}, alpha = {cuts.stiffening_exponent:.3g}"
        )


def coupled_fit(
    model: CoupledModel,
    cuts: Cuts,
    best: Callable[[ForceModel], tuple[float, float]],
    fitted: Callable[[ForceModel], dict[str, Any]],
) -> CoupledFit:
    """Return the fit at the wear strength whose tangent it is of.

    Parameters
    ----------
    model : CoupledModel
        The law.
    cuts : Cuts
        The forces.
    best : callable
        Gives Gamma_o [J/m2] and tau_w [Pa] under a model that is linear in the wear strength.
    fitted : callable
        Fits such a model, with intervals and all.

    Raises
    ------
    DomainError
        If the iteration does not end.
    """
    mu, xi = cuts.shear_modulus, cuts.friction_coefficient
    wear, at = 0.0, frozen(model, xi, 0.0)
    for _ in range(_MOST):
        before, (gamma, wear) = wear, best(at)
        at = frozen(model, xi, wear / mu)
        if abs(wear - before) > _SAME * max(wear, before):
            continue
        fit = fitted(at)
        if abs(fit["wear_strength"] - wear) <= _SAME_IN_THE_END * wear:
            return _with_reach(at, cuts, fit["toughness"], fit)
        wear = float(fit["wear_strength"])
        at = frozen(model, xi, wear / mu)
    last = _with_reach(at, cuts, gamma, {})
    if last.outside.any():  # where kappa is that of the nearest load, a fit may not settle
        return last
    raise DomainError(
        f"the law 'coupled' has no fit to these forces that {_MOST} steps come to, the last at "
        f"tau_w/mu = {wear / mu:.3g}; choose law='slip' or law='projected'."
    )


def _with_reach(at: FrozenLoad, cuts: Cuts, toughness: float, fit: dict[str, Any]) -> CoupledFit:
    g = np.asarray(toughness / (cuts.shear_modulus * cuts.wire_radius))
    outside = np.broadcast_to(~np.asarray(at.reaches(g, cuts.stiffening_exponent)), g.shape)
    return CoupledFit(fit, outside, g, at.relative_wear)

"""The fit under the law "coupled", whose force is not linear in the wear strength.

kappa is taken at the wear strength of the fit before, until both agree. The intervals are those of
the law with that kappa.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from surrogate.contact.base import ForceModel
from surrogate.coupling.frozen import FrozenLoad, frozen
from surrogate.coupling.model import CoupledModel
from surrogate.errors import DomainError
from surrogate.inference.inputs import Cuts

__all__ = ["coupled_fit"]

_MOST, _SAME = 40, 1e-6


def coupled_fit(
    model: CoupledModel, cuts: Cuts, fitted: Callable[[ForceModel], dict[str, Any]]
) -> tuple[FrozenLoad, dict[str, Any]]:
    """Return the model at the wear strength that it fits with, and the fit.

    Parameters
    ----------
    model : CoupledModel
        The law.
    cuts : Cuts
        The forces.
    fitted : callable
        Fits a model that is linear in the wear strength.

    Raises
    ------
    DomainError
        If coupled solutions do not reach to the friction and wear of one of the cuts.
    """
    mu, xi = cuts.shear_modulus, cuts.friction_coefficient
    wear = 0.0
    for _ in range(_MOST):
        at = frozen(model, xi, wear / mu)
        fit = fitted(at)
        before, wear = wear, float(fit["wear_strength"])
        if abs(wear - before) <= _SAME * max(wear, before):
            break
    g = fit["toughness"] / (mu * cuts.wire_radius)
    outside = ~np.asarray(at.reaches(g, cuts.stiffening_exponent))
    if outside.any():
        first = float(cuts.wire_radius[outside][0])
        raise DomainError(
            f"coupled solutions do not reach to {np.count_nonzero(outside)} of {outside.size} cuts "
            f"(first to wire_radius = {first:.4g} m), with xi = {xi:.3g} and tau_w/mu = "
            f"{wear / mu:.3g} at g = {float(g[outside][0]):.3g}; choose law='slip' or 'projected'."
        )
    return at, fit

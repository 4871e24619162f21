"""How far a force is off that is of a named law: beside that law, and that law beside the coupled.

Beside its own law a force is off by the measured errors of its model. The law itself is off, to
first order, by how far its force is from the coupled one and by what is known of the errors of
both. Where no coupled solution is near nobody knows it.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from surrogate.basics.elementwise import exp, quotient, ratio
from surrogate.choosing.auto_law import amplification_of_models
from surrogate.choosing.laws import force_bound
from surrogate.contact.fitted import COUPLED, PROJECTED, SLIP, FittedModel

__all__ = ["fit_error", "law_error"]


def fit_error(model: FittedModel, scene: tuple[Any, ...]) -> Any:
    """Return the bound of a force's error beside finite elements of its model's law [-].

    Parameters
    ----------
    model : FittedModel
        Under its law.
    scene : tuple
        The six quantities.
    """
    with np.errstate(all="ignore"):
        return force_bound(model, scene, (scene[1], *model.terms(*scene)))


def law_error(model: FittedModel, scene: tuple[Any, ...]) -> Any:
    """Return the bound of the error of a model's law beside finite elements on which the wire rubs.

    0 where nothing rubs, and under "coupled", whose own error is that of the fit of kappa; nan
    where no coupled solution is near.

    Examples
    --------
    >>> from surrogate.choosing.by_name import force_model
    >>> scene = 10e3, 5.0, np.array([0.2e-3, 0.5e-3]), 0.01, 1e3, np.array([2.0, 6.0])
    >>> error = law_error(force_model("table"), scene)
    >>> np.isnan(error).tolist(), bool(0.05 < error[1] < 0.1)
    ([True, False], True)
    """
    shape = np.broadcast_shapes(*map(np.shape, scene))
    if model.law == COUPLED:
        return np.zeros(shape) if shape else 0.0
    with np.errstate(all="ignore"):
        error = _beside_coupled(model, scene)
        rubs = np.add(*model.terms(*scene)) != 0.0
    error = np.where(rubs, error, 0.0) + np.zeros(shape)
    return error if shape else float(error)


def _beside_coupled(model: FittedModel, scene: tuple[Any, ...]) -> Any:
    mu, gamma, radius, xi, wear, alpha = scene
    kappa = amplification_of_models(model)
    if kappa is None:
        return np.nan
    load = quotient(gamma, mu, radius), alpha, xi, ratio(wear, mu)
    slip = model.under(SLIP)
    factor = exp(kappa.log_factor(*load))
    drag = np.add(*slip.terms(*scene)) * factor
    exact = gamma + drag
    own = drag / exact * np.expm1(kappa.error(*load))  # nan where it is not known
    relative = (gamma + np.add(*model.terms(*scene))) / exact
    if model.law == PROJECTED:  # whose fit is another one than that of the coupled force
        own = own + fit_error(model, scene) + fit_error(slip, scene) * np.maximum(1.0, factor)
    return np.abs(relative - 1.0) + relative * own

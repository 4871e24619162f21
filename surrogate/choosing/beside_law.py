"""How far a model under a law may be off beside coupled solutions, all over where these reach."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np

from surrogate.basics.elementwise import exp
from surrogate.choosing.auto_law import amplification_of_models
from surrogate.choosing.beside import fit_error, law_error
from surrogate.choosing.by_name import force_model
from surrogate.choosing.candidates import FREE, OUTSIDE, candidates
from surrogate.choosing.laws import PROJECTED, SLIP, of_law
from surrogate.contact.base import ForceModel
from surrogate.contact.fitted import FittedModel
from surrogate.coupling.amplification import Amplification, edge_of

__all__ = ["errors_over_reach", "reach_in_words"]

_WITHIN = 0.999
"""Share of the largest known loads that are looked at."""


def errors_over_reach(model: ForceModel, law: str) -> tuple[float, float] | None:
    """Return the largest and the median bound of a force's error under a law.

    Beside finite elements on which the wire rubs, of the force at all nodes of the reach of these:
    friction alone, wear alone and mixtures, each at the largest load that is known.

    Parameters
    ----------
    model : ForceModel
        The model, of whatever law.
    law : str
        "projected", "slip" or "coupled".

    Returns
    -------
    tuple of float, or None
        The bounds [-]; None for closed forms but Eq. (13), of which nobody measured it.

    Examples
    --------
    >>> table = force_model("table")
    >>> coupled, slip = (errors_over_reach(table, law) for law in ("coupled", "slip"))
    >>> coupled < slip < errors_over_reach(table, "projected")
    True
    """
    kappa = amplification_of_models(model if isinstance(model, FittedModel) else None)
    if kappa is None:
        return None
    scenes = _scenes(kappa)
    if isinstance(model, FittedModel):
        one = of_law(model.under(PROJECTED), law)
        return _most_and_median(fit_error(one, scenes) + law_error(one, scenes))
    return _most_and_median(_of_formula(scenes, kappa)) if model.name == FREE else None


def _most_and_median(errors: Any) -> tuple[float, float]:
    return float(np.max(errors)), float(np.median(errors))


def _of_formula(scenes: tuple[Any, ...], kappa: Amplification) -> Any:
    """Return the same of Eq. (13), whose terms are as far from A* and B* as was measured."""
    _, g, _, xi, wear, alpha = scenes
    known, slip = candidates(law=SLIP), force_model(OUTSIDE)
    assert isinstance(slip, FittedModel)
    load = g, alpha, xi, wear
    factor = exp(kappa.log_factor(*load))
    off: Any = 0.0
    friction, worn = slip.under(SLIP).terms(*scenes)
    for name, term in zip(known.terms, (worn, friction), strict=True):
        bound = known.bounds.at(FREE, name, g, alpha) + kappa.most(*load)
        off = off + factor * term * np.expm1(bound)
    return off / (g + factor * (friction + worn))


@cache
def _scenes(kappa: Amplification) -> tuple[Any, ...]:
    """Return the scenes of the largest loads that are known, for mu = R_w = 1."""
    x, y, direction = (each.ravel() for each in np.meshgrid(*kappa.axes, indexing="ij"))
    size = _WITHIN * kappa.reach_at(x, y, direction)
    xi, wear = (size * each for each in edge_of(direction, kappa.load_unit))
    table = force_model(OUTSIDE)
    alpha = np.clip(np.exp(y), table.stiffening.lower, table.stiffening.upper)
    touch = table.touch(alpha)
    g = np.exp(x) * touch
    some = (size > 0.0) & (g > kappa.lowest) & (g < kappa.highest)
    some &= np.isfinite(kappa.error(g, alpha, xi, wear))
    one = np.ones(int(some.sum()))
    return one, g[some], one, xi[some], wear[some], alpha[some]


def reach_in_words() -> str:
    """Return over which loads `errors_over_reach` is."""
    kappa = amplification_of_models()
    assert kappa is not None  # whoever has errors has it
    _, g, _, xi, wear, alpha = _scenes(kappa)
    return (
        f"g from {g.min():.2g} to {g.max():.3g} below the touch of the tip, alpha from "
        f"{alpha.min():.2g} to {alpha.max():.2g}, xi up to {xi.max():.2g}, tau_w/mu up to "
        f"{wear.max():.2g}, as far as coupled solutions reach"
    )

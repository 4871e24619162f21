"""The laws of dissipation: which functions of the contact wear and friction follow.

"projected" is the paper's Eq. (S2): the shear stress counts by its component along the cut, A and
B, while the normal forces stay what they are without it. "slip" is the balance of energy to first
order in tau_w and xi: shear stress times the way that the solid slips, A* and B*. Eq. (S2) leaves
out that the normal forces grow as well, and so gives too small a force.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from surrogate.basics.checks import shown
from surrogate.choosing.accuracy import contact_bounds
from surrogate.choosing.by_name import force_model, is_auto
from surrogate.contact.fitted import PROJECTED, SLIP, TERMS_OF_LAW, FittedModel
from surrogate.errors import InputError

__all__ = ["LAWS", "PROJECTED", "SLIP", "force_bound", "of_law"]

LAWS = (PROJECTED, SLIP)
"""The laws that `law` may name."""

_BEST = "table"


def of_law(model: Any, law: object) -> Any:
    """Return what `model` is to be under a law: itself for "projected", else a model's object.

    Under "slip" the name "auto" is the table, the quickest of the fitted models at many points.

    Parameters
    ----------
    model : str or ForceModel
        A model, or "auto".
    law : str
        "projected" or "slip".

    Raises
    ------
    InputError
        If there is no such law, or the model does not have it.
    UnknownModelError
        If there is no such model.

    Examples
    --------
    >>> of_law("eq13", "projected")
    'eq13'
    """
    if not isinstance(law, str) or law not in LAWS:
        raise InputError(f"law must be one of {', '.join(LAWS)}, but is {shown(law)}; choose one.")
    if law == PROJECTED:
        return model
    chosen = force_model(_BEST if is_auto(model) else model)
    if not isinstance(chosen, FittedModel):
        raise InputError(
            f"law={law!r} must have a model fitted to finite elements, but {chosen.name!r} is of "
            f"the law {PROJECTED!r}; choose model='auto', or law={PROJECTED!r}."
        )
    if not {*TERMS_OF_LAW[law]} <= {*chosen.functions}:
        raise InputError(
            f"law={law!r} must have A* and B*, but the file of {chosen.name!r} has none; make it "
            "anew with regen-surrogate, or take the models that wirecut ships."
        )
    return chosen.under(law)


def force_bound(model: FittedModel, g: Any, alpha: Any, parts: tuple[Any, Any, Any]) -> Any:
    """Return the bound of the relative error of a force beside finite elements of its law.

    Parameters
    ----------
    model : FittedModel
        The model, under its law.
    g, alpha : float or ndarray
        Where [-].
    parts : tuple
        Cleavage, friction and wear [N/m].

    Returns
    -------
    float or ndarray
        The bound [-]; nan outside the domain, and under "slip" where the tip touches the wire and
        the slip there depends on how sharp it is.
    """
    bounds = contact_bounds(model, g, alpha)
    assert bounds is not None  # of a fitted model
    with np.errstate(all="ignore"):
        cleavage, friction, wear = parts
        off = np.where(friction == 0.0, 0.0, friction * bounds[1])
        off = off + np.where(wear == 0.0, 0.0, wear * bounds[0])
        known = np.isfinite(off)
        rubs = np.not_equal(friction, 0.0) | np.not_equal(wear, 0.0)
        bound = np.where(known | ~rubs, off / (cleavage + friction + wear), np.nan)
    return bound.item() if bound.ndim == 0 else bound

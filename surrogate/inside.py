"""Refusing scenes that are outside the domain of a fitted model."""

from __future__ import annotations

from typing import Any

import numpy as np

from surrogate.elementwise import quotient
from surrogate.errors import DomainError
from surrogate.force_models import ForceModel
from surrogate.validation import FloatOrArray

__all__ = ["require_inside"]

_NAMES = (("shear_modulus", "Pa"), ("toughness", "J/m^2"), ("wire_radius", "m"))


def require_inside(model: ForceModel, values: tuple[FloatOrArray, ...]) -> None:
    """Raise a `DomainError` where a scene needs the contact outside the domain of a model.

    The contact is not needed where neither friction nor wear has a strength and a radius.

    Parameters
    ----------
    model : ForceModel
        The model.
    values : tuple
        The six quantities of the scene, in its order.

    Raises
    ------
    DomainError
        If g or alpha is outside; the message says where, and from which quantities g follows.
    """
    mu, gamma, radius, xi, wear, alpha = values
    with np.errstate(all="ignore"):  # an infinite g is outside
        g = quotient(gamma, mu, radius)
    inside = model.holds(g, alpha)
    if inside is True or np.all(inside | (np.equal(xi, 0.0) & np.equal(wear, 0.0))):
        return
    shape = np.broadcast_shapes(*map(np.shape, values))
    g, alpha, matters = (
        np.broadcast_to(v, shape)
        for v in (g, alpha, np.not_equal(xi, 0.0) | np.not_equal(wear, 0.0))
    )
    some = model.stiffening.lower
    model.stiffening.checked(_plain(np.where(matters, alpha, some)))
    low, high = model.g.lower, model.g.upper
    outside = matters & ~((g >= low) & (g <= high))
    index = tuple(int(i) for i in np.argwhere(outside)[0]) if shape else ()
    where = f"[{', '.join(map(str, index))}]" if index else ""
    given = ", ".join(
        f"{name} = {float(np.broadcast_to(value, shape)[index])!r} {unit}"
        for (name, unit), value in zip(_NAMES, values, strict=False)
    )
    many = f", {np.count_nonzero(outside)} of {outside.size} values" if shape else ""
    raise DomainError(
        f"g = Gamma_o/(mu R_w) must be from {low:g} to {high:g} for the model {model.name!r}, but "
        f"g{where} = {float(g[index]):.4g} (from {given}{many}); change the scene, give "
        "extrapolate=True to continue with the asymptotes, or choose model='eq13'."
    )


def _plain(values: Any) -> Any:
    return values.item() if np.ndim(values) == 0 else values

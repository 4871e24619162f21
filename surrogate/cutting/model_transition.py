"""The transition radius under any force model: where its two parts of the force are equal.

The force is homogeneous of degree one in Gamma_o and R_w, so that by Euler's theorem

    F_ss/T = Gamma_o dF/dGamma_o + R_w dF/dR_w.

The first part is where the tangent of the force over the radius meets the axis of no radius: what
the radius does not change, (1 + xi) Gamma_o in Eq. (13). The second is what changes with it,
4 (xi mu + tau_w) R_w in Eq. (13). Over mu R_w, with a prime for d/dg, their difference is

    h(g) = g + 2 (tau_w/mu) (2 g A' - A) + 2 xi (2 g B' - B),

whose zeros g* do not depend on the radius: R_w* = Gamma_o/(mu g*).
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.checks import LARGEST, FloatOrArray, common_shape
from surrogate.basics.elementwise import apply, over_sum, quotient
from surrogate.basics.roots import narrowed
from surrogate.choosing.auto_law import amplification_of_models
from surrogate.choosing.laws import COUPLED, SLIP, coupled, require_known_load
from surrogate.choosing.parted import best_law
from surrogate.contact.base import ForceModel
from surrogate.contact.closed_forms import ClosedForm
from surrogate.contact.fitted import FittedModel
from surrogate.errors import DomainError

__all__ = ["transition_under", "under_best_law"]

Array = NDArray[np.float64]

POINTS_A_DECADE = 24
SMALLEST_G, LARGEST_G = 1e-30, 1e30
ROWS = 256
"""Materials whose zeros are bracketed at a time."""


def transition_under(chosen: ForceModel, quantities: tuple[FloatOrArray, ...]) -> FloatOrArray:
    """Return the smallest radius at which the part that grows with it reaches the other.

    Parameters
    ----------
    chosen : ForceModel
        A and B.
    quantities : tuple of float or ndarray
        mu [Pa], Gamma_o [J/m2], xi [-], tau_w [Pa] and alpha [-], which broadcast.

    Returns
    -------
    float or ndarray
        R_w* [m]; infinite where the part never reaches the other, nan where both are 0.

    Raises
    ------
    DomainError
        If the zero is not within the model's range of g, or mu is 0.

    Examples
    --------
    >>> from surrogate.contact.closed_forms import FORCE_MODELS
    >>> radius = transition_under(FORCE_MODELS["friction-free"], (685.0, 1.6, 0.0, 7750.0, 2.0))
    >>> print(f"{radius:.4e} m")
    5.1613e-05 m
    """
    if isinstance(chosen, ClosedForm):
        return _of_closed_form(chosen, *quantities[:4])
    shape = common_shape(quantities)
    columns = [np.broadcast_to(each, shape).astype(float).ravel() for each in quantities]
    radius = _radii_of(chosen, columns)
    return radius.reshape(shape) if shape else float(radius[0])


def _radii_of(chosen: ForceModel, columns: list[Array], refuse: bool = True) -> Array:
    """Return the radii of materials; nan where one is beyond the model if that is not refused."""
    radius = np.empty(columns[0].size)
    for alpha in np.unique(columns[4]):
        rows = np.flatnonzero(columns[4] == alpha)
        for start in range(0, rows.size, ROWS):
            block = rows[start : start + ROWS]
            mu, gamma, xi, wear = (each[block] for each in columns[:4])
            radius[block] = _radii(chosen, mu, gamma, xi, wear, float(alpha), refuse)
    return radius


def _of_closed_form(chosen: ClosedForm, mu: Any, gamma: Any, xi: Any, wear: Any) -> FloatOrArray:
    weight = chosen.load_2_slope

    def radius(mu: Any, gamma: Any, xi: Any, wear: Any) -> Any:
        stress = (chosen.load_2, xi, mu), (chosen.arc_2, wear)
        return over_sum((gamma, 1.0 + weight * xi), stress)

    return apply(radius, (mu, gamma, xi, wear))  # type: ignore[no-any-return]


def _radii(
    chosen: ForceModel,
    mu: Array,
    gamma: Array,
    xi: Array,
    wear: Array,
    alpha: float,
    refuse: bool,
) -> Array:
    acts = (wear > 0.0) | ((xi > 0.0) & (mu > 0.0))
    radius = np.where(acts, 0.0, np.inf)  # of no toughness, and of nothing else
    radius[~acts & (gamma == 0.0)] = np.nan
    rows = np.flatnonzero(acts & (gamma > 0.0))
    if np.any(mu[rows] == 0.0):
        raise DomainError(
            f"model {chosen.name!r} must have a shear modulus to say where the radius begins to "
            "count, but shear_modulus = 0 Pa; give one, or choose 'eq13'."
        )
    with np.errstate(all="ignore"):
        g = _zeros(chosen, wear[rows] / mu[rows], xi[rows], alpha, refuse)
        radius[rows] = quotient(gamma[rows], mu[rows], g)
    if not refuse:
        return radius
    between = rows[np.isfinite(g) & (g > 0.0)]
    of_rows = (mu[between], gamma[between], radius[between], xi[between], wear[between], alpha)
    require_known_load(chosen, of_rows)
    return radius


def _zeros(chosen: ForceModel, relative: Array, xi: Array, alpha: float, refuse: bool) -> Array:
    """Return the largest g of a zero; 0 where the toughness dominates at every g."""
    ends = chosen.ends(alpha)
    low, high = max(ends[0], SMALLEST_G), min(ends[1], LARGEST_G)
    count = 2 + int(np.ceil(POINTS_A_DECADE * np.log10(high / low)))
    grid = np.geomspace(low, high, count)
    grid[0], grid[-1] = low, high
    dominated = np.asarray(
        _difference(chosen, grid, relative[:, np.newaxis], xi[:, np.newaxis], alpha) <= 0.0
    )
    last = count - 1 - np.argmax(dominated[:, ::-1], axis=1)
    found = np.asarray(np.any(dominated, axis=1))
    if refuse:
        _check_ends(chosen, ends, found, found & (last == count - 1))
    zeros = np.where(found, high, 0.0)
    inner = np.flatnonzero(found & (last < count - 1))
    if inner.size:
        each = np.repeat(relative[inner], 15), np.repeat(xi[inner], 15)
        zeros[inner] = narrowed(
            lambda g: _difference(chosen, g, *each, alpha) <= 0.0,
            grid[last[inner]],
            grid[last[inner] + 1],
        )
    zeros[found & (last == count - 1)] = np.inf
    return zeros


def _difference(chosen: ForceModel, g: Array, relative: Array, xi: Array, alpha: float) -> Array:
    """Return h(g); A and B are evaluated only where wear and friction ask for them."""
    if chosen.law == COUPLED:
        return _difference_of(chosen, g, relative, xi, alpha)
    total: Any = g
    if np.any(relative):
        arc = 2.0 * g * chosen.arc_slopes(g, alpha)[0] - chosen.arc(g, alpha)
        total = total + 2.0 * relative * arc
    if np.any(xi):
        load = 2.0 * g * chosen.normal_load_slopes(g, alpha)[0] - chosen.normal_load(g, alpha)
        total = total + 2.0 * xi * load
    return np.asarray(np.broadcast_to(total, np.broadcast_shapes(g.shape, relative.shape)))


def _difference_of(chosen: ForceModel, g: Array, relative: Array, xi: Array, alpha: float) -> Array:
    """Return h(g) = 2 g f' - f of any force f(g) mu R_w."""
    friction, worn = chosen.terms(1.0, g, 1.0, xi, relative, alpha)
    slope = chosen.gradient(1.0, g, 1.0, xi, relative, alpha)[1]
    return np.asarray(2.0 * g * slope - (g + friction + worn))


def _check_ends(
    chosen: ForceModel,
    ends: tuple[float, float],
    found: NDArray[np.bool_],
    at_top: NDArray[np.bool_],
) -> None:
    """Refuse to say what is beyond the range of a model that has one."""
    below = ends[0] > 0.0 and not found.all()
    above = ends[1] < LARGEST and at_top.any()
    if below or above:
        end, side = (ends[0], "below") if below else (ends[1], "above")
        raise DomainError(
            f"the transition radius must be within what model {chosen.name!r} covers, but it would "
            f"be at a g {side} {end:.4g}, where the model ends; choose 'eq13' for an estimate."
        )


def under_best_law(
    model: FittedModel, quantities: tuple[FloatOrArray, ...]
) -> tuple[FloatOrArray, Any]:
    """Return the radius by the law "coupled" where that reaches to it, else by "projected".

    And where it is the former.
    """
    model.stiffening.checked(quantities[4])
    if amplification_of_models(model) is None:
        return transition_under(model, quantities), False
    shape = common_shape(quantities)
    mu, gamma, xi, wear, alpha = columns = [
        np.broadcast_to(each, shape).astype(float).ravel() for each in quantities
    ]
    radius = _radii_of(coupled(model.under(SLIP)), columns, refuse=False)
    with np.errstate(all="ignore"):
        known = best_law(model, (mu, gamma, radius, xi, wear, alpha))
    known = known & np.isfinite(radius) & (radius > 0.0)
    radius[~known] = _radii_of(model, [each[~known] for each in columns])
    if not shape:
        return float(radius[0]), bool(known[0])
    return radius.reshape(shape), known.reshape(shape)

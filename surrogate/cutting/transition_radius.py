"""The transition radii below which a sharper wire cuts no more easily: three definitions.

The paper writes R_w* for two of them and Eq. (13) defines the third; they differ. Each has the
common shape of the quantities that it depends on, whatever the shape of the wires' radii.

The transition radius under any force model: where its two parts of the force are equal.

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
from numpy.typing import ArrayLike, NDArray

from surrogate.basics.checks import (
    LARGEST,
    TOUGHNESS,
    WORK_OF_FRACTURE,
    FloatOrArray,
    common_shape,
    defined,
)
from surrogate.basics.elementwise import (
    all_normal,
    apply,
    evaluate_checked,
    over_sum,
    quotient,
    where_normal,
)
from surrogate.basics.roots import narrowed
from surrogate.choosing.accuracy import one_model
from surrogate.choosing.by_name import AUTO
from surrogate.choosing.laws import COUPLED, PROJECTED, of_law, require_known_load
from surrogate.contact.base import ForceModel
from surrogate.contact.closed_forms import ClosedForm
from surrogate.errors import DomainError
from surrogate.reading.plausibility import warn_of_scene
from surrogate.scene import Scene, require_scene

__all__ = [
    "fracto_cohesive_transition_radius",
    "transition_radius",
    "transition_radius_of",
    "transition_under",
    "wear_transition_radius",
    "wear_transition_radius_of",
]


def transition_radius(
    scene: Scene, model: str | ForceModel = AUTO, rtol: float | None = None, law: str = PROJECTED
) -> FloatOrArray:
    """Return the radius at which the two parts of the force are equal, those of Eq. (13) or others.

    The force is homogeneous of degree one in toughness and radius, so that by Euler's theorem it
    is the sum of Gamma_o dF/dGamma_o and R_w dF/dR_w: of what the radius does not change and what
    changes with it. The first is where the tangent of the force over the radius meets the axis.
    In Eq. (13) they are (1 + xi) Gamma_o and 4 (xi mu + tau_w) R_w.

    Parameters
    ----------
    scene : Scene
        What is cut, in SI units; mu [Pa], Gamma_o [J/m^2], xi [-], tau_w [Pa] and, for models
        that depend on it, alpha [-] play a part.
    model : str, default "auto"
        As in `cutting_force`, but that "auto" is one model for all radii: the cheapest whose A
        and B meet `rtol` all over its domain.
    rtol : float, optional
        Relative error of A and B that will do with "auto" [-]; by default 0.02 where
        a model is as exact, else that of the most exact one.
        slopes play a part, is not known.
    law : str, default "projected"
        Which functions of the contact wear and friction follow, as in `cutting_force`.

    Returns
    -------
    float or ndarray
        R_w* [m], for Eq. (13) (1 + xi) Gamma_o / (4 (xi mu + tau_w)). Where several radii would
        do, the smallest: for every thinner wire the radius matters less than the toughness.
        Infinite where the part that changes with the radius nowhere reaches the other, as where
        xi mu + tau_w = 0; 0 where it is larger for every wire, as where Gamma_o = 0.

    Raises
    ------
    InputError
        If `scene` is not a `Scene`.
    UnknownModelError
        If there is no such model.
    DomainError
        If Gamma_o and xi mu + tau_w are both 0: every radius would do; if the model does not
        reach to alpha or to the radius; or if it needs a shear modulus, which is 0.
    AccuracyError
        If the model is "auto" and none is as exact as `rtol`.

    Warns
    -----
    ImplausibleInputWarning
        If a quantity but the radius is hardly that of a soft solid's cut.

    Notes
    -----
    Range of validity: that of the model. With xi = 0 and Eq. (13) this is
    `wear_transition_radius`. For models other than closed forms the search takes 24 g a decade;
    of several radii that lie closer together it may miss two.

    References
    ----------
    arXiv:2412.02021, Eq. (13).

    Examples
    --------
    >>> gel = Scene(685.0, 1.6, 0.25e-3, 0.1, 7750.0)
    >>> print(f"{transition_radius(gel, model='eq13'):.4e} m")
    5.6277e-05 m
    >>> transition_radius(gel) > 5.7e-05
    True
    """
    require_scene(scene)
    mu, gamma, _, xi, tau = scene.values()[:5]
    warn_of_scene((mu, gamma, 0.0, xi, tau))  # the radius plays no part
    return transition_radius_of(scene, of_law(model, law), rtol)


def transition_radius_of(
    scene: Scene, model: str | ForceModel, rtol: float | None = None
) -> FloatOrArray:
    """Return what `transition_radius` does under the model's own law, without doubting the scene.

    Examples
    --------
    >>> print(f"{transition_radius_of(Scene(685.0, 1.6, 1.0, 0.1, 7750.0), 'eq13'):.4e} m")
    5.6277e-05 m
    """
    quantities = (
        scene.shear_modulus,
        scene.toughness,
        scene.friction_coefficient,
        scene.wear_strength,
    )
    chosen = one_model(model, rtol)
    if chosen.name == "eq13":
        radius = apply(_transition, quantities)
    else:
        radius = _under(chosen, (*quantities, scene.stiffening_exponent))
    return defined("transition_radius", radius, "give a toughness, a friction or a wear strength")


def wear_transition_radius(scene: Scene) -> FloatOrArray:
    """Return the transition radius without friction, a quarter of l_w, Eq. (15).

    Parameters
    ----------
    scene : Scene
        What is cut, in SI units; only Gamma_o [J/m^2] and tau_w [Pa] play a part.

    Returns
    -------
    float or ndarray
        R_w* = l_w/4 = Gamma_o/(4 tau_w) [m]; infinite where tau_w = 0.

    Raises
    ------
    InputError
        If `scene` is not a `Scene`.
    DomainError
        If Gamma_o and tau_w are both 0.

    Warns
    -----
    ImplausibleInputWarning
        If one of them is hardly that of a soft solid's cut.

    Notes
    -----
    Range of validity: that of Eq. (15), xi << 1 and xi mu << tau_w.

    References
    ----------
    arXiv:2412.02021, Eq. (15) and section 6.

    Examples
    --------
    >>> print(f"{wear_transition_radius(Scene(685.0, 1.6, 0.25e-3, 0.1, 7750.0)):.4e} m")
    5.1613e-05 m
    """
    require_scene(scene)
    warn_of_scene((0.0, scene.toughness, 0.0, 0.0, scene.wear_strength))
    return wear_transition_radius_of(scene)


def wear_transition_radius_of(scene: Scene) -> FloatOrArray:
    """Return what `wear_transition_radius` does, without doubting the scene.

    Examples
    --------
    >>> wear_transition_radius_of(Scene(685.0, 1.6, 1.0, wear_strength=8000.0))
    5e-05
    """
    radius = apply(_quarter, (scene.toughness, scene.wear_strength))
    return defined("wear_transition_radius", radius, "give a toughness or a wear strength")


def fracto_cohesive_transition_radius(
    toughness: ArrayLike, work_of_fracture: ArrayLike
) -> FloatOrArray:
    """Return a quarter of the fracto-cohesive length l_f, which is l_w with tau_w = W_f, Eq. (15).

    Parameters
    ----------
    toughness : float or array_like
        Toughness Gamma [J/m^2]: the paper's value takes it from a pure-shear test.
    work_of_fracture : float or array_like
        Strain energy density W_f at tensile failure [J/m^3].

    Returns
    -------
    float or ndarray
        R_w* = l_f/4 = Gamma/(4 W_f) [m]; infinite where W_f = 0.

    Raises
    ------
    InputError
        If an argument is out of range or the shapes do not broadcast.
    DomainError
        If both are 0.

    Notes
    -----
    Range of validity: that of Eq. (15), and where wear takes the work of fracture, tau_w = W_f.

    References
    ----------
    arXiv:2412.02021, sections 4 and 6.

    Examples
    --------
    >>> print(f"{fracto_cohesive_transition_radius(2.6, 6973.0):.4e} m")
    9.3217e-05 m
    """
    quantities = (TOUGHNESS, WORK_OF_FRACTURE)
    radius = evaluate_checked(_quarter, quantities, (toughness, work_of_fracture))
    remedy = "give a toughness or a work of fracture"
    return defined("fracto_cohesive_transition_radius", radius, remedy)


def _under(chosen: ForceModel, quantities: tuple[FloatOrArray, ...]) -> FloatOrArray:
    chosen.stiffening.checked(quantities[4])
    return transition_under(chosen, quantities)


def _transition(mu: Any, gamma: Any, xi: Any, wear: Any) -> Any:
    # Divided by 1 + xi, the denominator is a mean of mu and tau_w, which cannot overflow.
    mean = (xi / (1.0 + xi)) * mu + wear / (1.0 + xi)
    if all_normal(mean):
        return _quarter(gamma, mean)
    rescued = over_sum((0.25, gamma, 1.0 + xi), ((xi, mu), (wear,)))
    return where_normal(mean, _quarter(gamma, mean), rescued)


def _quarter(gamma: Any, stress: Any) -> Any:
    return quotient(gamma, 4.0, stress)


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
    radius = np.empty(columns[0].size)
    for alpha in np.unique(columns[4]):
        rows = np.flatnonzero(columns[4] == alpha)
        for start in range(0, rows.size, ROWS):
            block = rows[start : start + ROWS]
            mu, gamma, xi, wear = (each[block] for each in columns[:4])
            radius[block] = _radii(chosen, mu, gamma, xi, wear, float(alpha))
    return radius.reshape(shape) if shape else float(radius[0])


def _of_closed_form(chosen: ClosedForm, mu: Any, gamma: Any, xi: Any, wear: Any) -> FloatOrArray:
    weight = chosen.load_2_slope

    def radius(mu: Any, gamma: Any, xi: Any, wear: Any) -> Any:
        stress = (chosen.load_2, xi, mu), (chosen.arc_2, wear)
        return over_sum((gamma, 1.0 + weight * xi), stress)

    return apply(radius, (mu, gamma, xi, wear))  # type: ignore[no-any-return]


def _radii(
    chosen: ForceModel, mu: Array, gamma: Array, xi: Array, wear: Array, alpha: float
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
        g = _zeros(chosen, wear[rows] / mu[rows], xi[rows], alpha)
        radius[rows] = quotient(gamma[rows], mu[rows], g)
    between = rows[np.isfinite(g) & (g > 0.0)]
    of_rows = (mu[between], gamma[between], radius[between], xi[between], wear[between], alpha)
    require_known_load(chosen, of_rows)
    return radius


def _zeros(chosen: ForceModel, relative: Array, xi: Array, alpha: float) -> Array:
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

"""The transition radii below which a sharper wire cuts no more easily: three definitions.

The paper writes R_w* for two of them and Eq. (13) defines the third; they differ. Each has the
common shape of the quantities that it depends on, whatever the shape of the wires' radii.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from surrogate.basics.checks import (
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
from surrogate.choosing.accuracy import one_model
from surrogate.choosing.by_name import AUTO
from surrogate.choosing.effective import warn_of_law
from surrogate.choosing.laws import AnyLaw, of_law
from surrogate.contact.base import ForceModel
from surrogate.contact.fitted import FittedModel
from surrogate.cutting.believable import warn_of_scene
from surrogate.cutting.model_transition import transition_under, under_best_law
from surrogate.cutting.other_law import law_for
from surrogate.cutting.outside import is_nan, spared
from surrogate.scene import Scene, require_scene

__all__ = [
    "fracto_cohesive_transition_radius",
    "transition_radius",
    "transition_radius_of",
    "wear_transition_radius",
    "wear_transition_radius_of",
]


def transition_radius(
    scene: Scene,
    model: str | ForceModel = AUTO,
    rtol: float | None = None,
    law: str = AUTO,
    outside: str = "raise",
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
        Relative error of A and B that will do with "auto" [-]; by default 0.02 where a model is as
        exact, else that of the most exact one. That of the radius, in which slopes play a part, is
        not known.
    law : str, default "auto"
        Which functions of the contact wear and friction follow, as in `cutting_force`. Both parts
        are of one law: with "auto" of "coupled" where coupled solutions reach to the radius that
        it gives, and else of "projected", whose radius goes with an effective wear strength.
    outside : str, default "raise"
        What becomes of scenes whose radius the model does not reach or that have none: "raise" for
        an error, "nan" for nan.

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
    UnknownErrorWarning
        Once, if the law is "auto" and of some scenes the projected one, as no solution with
        friction and wear is near.

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
    >>> transition_radius(gel, law="projected") > 5.7e-05
    True
    """
    require_scene(scene)
    blank = is_nan(outside)
    mu, gamma, _, xi, tau = scene.values()[:5]
    warn_of_scene((mu, gamma, 0.0, xi, tau))  # the radius plays no part
    chosen = of_law(model, law_for(scene, law), any_law=True)
    one = one_model(chosen.named or AUTO if isinstance(chosen, AnyLaw) else chosen, rtol)
    quantities = mu, gamma, xi, tau, scene.stiffening_exponent
    if not (isinstance(chosen, AnyLaw) and isinstance(one, FittedModel)):
        if blank:
            return _spared(lambda columns: (_radius_under(one, tuple(columns)),), quantities, 1)[0]  # type: ignore[no-any-return]
        return _defined(_radius_under(one, quantities))
    if blank:
        radius, known = _spared(lambda columns: under_best_law(one, tuple(columns)), quantities, 2)
    else:
        radius, known = under_best_law(one, quantities)
    depends = np.isfinite(radius) & np.not_equal(radius, 0.0)
    warn_of_law(depends & np.not_equal(known, 1.0), "the transition radius")
    return radius if blank else _defined(radius)


def _spared(function: Any, quantities: tuple[FloatOrArray, ...], number: int) -> tuple[Any, ...]:
    """Return the results of scenes, nan for those that are refused."""
    shape = common_shape(quantities)
    columns = [np.array(np.broadcast_to(each, shape), dtype=float).ravel() for each in quantities]
    found = spared(function, columns, number)
    return tuple(each.reshape(shape) if shape else float(each[0]) for each in found)


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
        scene.stiffening_exponent,
    )
    return _defined(_radius_under(one_model(model, rtol), quantities))


def _radius_under(chosen: ForceModel, quantities: tuple[FloatOrArray, ...]) -> FloatOrArray:
    """Return the radius by a model; nan where every one would do."""
    if chosen.name == "eq13":
        return apply(_transition, quantities[:4])  # type: ignore[no-any-return]
    chosen.stiffening.checked(quantities[4])
    return transition_under(chosen, quantities)


def _defined(radius: FloatOrArray) -> FloatOrArray:
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


def _transition(mu: Any, gamma: Any, xi: Any, wear: Any) -> Any:
    # Divided by 1 + xi, the denominator is a mean of mu and tau_w, which cannot overflow.
    mean = (xi / (1.0 + xi)) * mu + wear / (1.0 + xi)
    if all_normal(mean):
        return _quarter(gamma, mean)
    rescued = over_sum((0.25, gamma, 1.0 + xi), ((xi, mu), (wear,)))
    return where_normal(mean, _quarter(gamma, mean), rescued)


def _quarter(gamma: Any, stress: Any) -> Any:
    return quotient(gamma, 4.0, stress)

"""The steady cutting force and its parts."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from surrogate.elementwise import apply, evaluate_checked
from surrogate.equations import DIMENSIONLESS_TOUGHNESS, RELATIVE_WEAR_STRENGTH
from surrogate.force_models import force_model
from surrogate.records import Record
from surrogate.scene import Scene, require_scene
from surrogate.validation import FRICTION_COEFFICIENT, FloatOrArray, Quantity

__all__ = ["CuttingForce", "cutting_force", "dissipative_force"]


@dataclass(frozen=True, slots=True, eq=False)
class CuttingForce(Record):
    """A steady cutting force per unit sample thickness and the parts that it is the sum of.

    Every quantity is a float where the scene's all are numbers, else an array of the scene's
    shape. `total` is `cleavage + friction + wear`, added in this order, to the last bit.

    Parameters
    ----------
    total : float or ndarray
        Steady cutting force F_ss/T [N/m].
    cleavage : float or ndarray
        Part of the cleavage toughness, Gamma_o [N/m].
    friction : float or ndarray
        Part of friction, 2 R_w xi mu B [N/m].
    wear : float or ndarray
        Part of wear, 2 R_w tau_w A [N/m].
    model : str
        Name of the model.
    relative_error : float, ndarray or None
        Known bound of the relative error of `total` [-]; None where nobody knows one.
    in_domain : bool or ndarray of bool
        Whether the model's own condition holds.

    References
    ----------
    arXiv:2412.02021, Eqs. (6), (7), (S1) and (S2).

    Examples
    --------
    >>> force = cutting_force(Scene(685.0, 1.6, 0.25e-3, 0.1, 7750.0))
    >>> force.total == force.cleavage + force.friction + force.wear
    True
    """

    total: FloatOrArray
    cleavage: FloatOrArray
    friction: FloatOrArray
    wear: FloatOrArray
    model: str
    relative_error: FloatOrArray | None
    in_domain: bool | NDArray[np.bool_]


def cutting_force(scene: Scene, model: str = "eq13") -> CuttingForce:
    """Return the steady cutting force per unit thickness of a scene and its parts, Eq. (13).

    Parameters
    ----------
    scene : Scene
        What is cut and with which wire, in SI units.
    model : str, default "eq13"
        "eq13" for Eq. (13), "high-toughness" for Eq. (10), "low-toughness" for Eq. (12),
        "friction-free" for Eq. (15), or "eq9" for Eq. (9) with the exponents of Table 1,
        linear in alpha between them.

    Returns
    -------
    CuttingForce
        Total, cleavage, friction and wear [N/m], and whether the model holds.

    Raises
    ------
    InputError
        If `scene` is not a `Scene`.
    UnknownModelError
        If there is no such model.
    DomainError
        If alpha is outside Table 1, 2 to 9, and the model is "eq9".

    Notes
    -----
    Range of validity: >> is taken to mean a factor of 10 (`MUCH_GREATER`). Outside its range a
    model answers all the same, with `in_domain` False. "eq13": any. "high-toughness" and
    "eq9": Gamma_o >= 10 mu R_w and Gamma_o > 0. "low-toughness": Gamma_o <= mu R_w.
    "friction-free": xi = 0, or 10 xi <= 1 and 10 xi mu <= tau_w.

    Limits at xi, tau_w, mu, R_w or Gamma_o = 0 are exact, at all of them together too; only
    "eq9", whose friction xi Gamma_o g^(n-1) has no limit where Gamma_o and mu R_w are both
    0 and n > 1, is then given no friction, as for any Gamma_o = 0.

    References
    ----------
    arXiv:2412.02021, Eqs. (9), (10), (12), (13) and (15), Table 1.

    Examples
    --------
    >>> force = cutting_force(Scene(685.0, 1.6, 0.25e-3, 0.1, 7750.0))
    >>> print(f"{force.total:.4f} = {force.cleavage:.4f} + {force.friction:.4f} + {force.wear:.4f}")
    9.5785 = 1.6000 + 0.2285 + 7.7500
    >>> limit = cutting_force(Scene(685.0, 1.6, 0.25e-3, 0.1, 7750.0), model="high-toughness")
    >>> print(f"{limit.total:.4f} N/m, in domain: {limit.in_domain}")
    1.7600 N/m, in domain: False
    """
    chosen = force_model(model)
    require_scene(scene)
    chosen.stiffening.checked(scene.stiffening_exponent)

    def parts(mu: Any, gamma: Any, radius: Any, xi: Any, tau: Any, alpha: Any) -> tuple[Any, ...]:
        cleavage = gamma + 0.0  # a copy, so that no result is the caller's array
        friction, wear = chosen.terms(mu, gamma, radius, xi, tau, alpha)
        holds = chosen.in_domain(mu, gamma, radius, xi, tau, alpha)
        return cleavage + friction + wear, cleavage, friction, wear, holds

    total, cleavage, friction, wear, holds = apply(
        parts, scene.values(), (float, float, float, float, bool)
    )
    return CuttingForce(total, cleavage, friction, wear, model, None, holds)


def dissipative_force(
    g: ArrayLike,
    alpha: ArrayLike,
    friction_coefficient: ArrayLike,
    relative_wear_strength: ArrayLike,
    model: str = "eq13",
) -> FloatOrArray:
    """Return the dimensionless dissipative force F_d/(mu R_w T), Eqs. (9), (11) and (13).

    Parameters
    ----------
    g : float or array_like
        Dimensionless toughness Gamma_o/(mu R_w) [-], finite.
    alpha : float or array_like
        Stiffening exponent [-], positive.
    friction_coefficient : float or array_like
        xi [-].
    relative_wear_strength : float or array_like
        tau_w/mu [-].
    model : str, default "eq13"
        As in `cutting_force`.

    Returns
    -------
    float or ndarray
        F_d/(mu R_w T) = 2 (tau_w A/mu + xi B) [-], of the common shape.

    Raises
    ------
    InputError
        If an argument is out of range or the shapes do not broadcast.
    UnknownModelError
        If there is no such model.
    DomainError
        If alpha is outside Table 1, 2 to 9, and the model is "eq9".

    Notes
    -----
    Range of validity: that of the model, see `cutting_force`.

    References
    ----------
    arXiv:2412.02021, Eqs. (9), (11), (13), (S2) and Fig. 4.

    Examples
    --------
    >>> print(f"{dissipative_force(10.0, 2.0, 0.1, 11.31):.4f}")
    46.6400
    >>> print(f"{dissipative_force(10.0, 2.0, 0.1, 11.31, model='eq9'):.4f}")
    1.5136
    """
    chosen = force_model(model)

    def dissipation(g: Any, alpha: Any, xi: Any, relative_wear: Any) -> Any:
        friction, wear = chosen.terms(1.0, g, 1.0, xi, relative_wear, alpha)  # in units of mu R_w
        return friction + wear

    return evaluate_checked(
        dissipation,
        (
            DIMENSIONLESS_TOUGHNESS,
            _as_alpha(chosen.stiffening),
            FRICTION_COEFFICIENT,
            RELATIVE_WEAR_STRENGTH,
        ),
        (g, alpha, friction_coefficient, relative_wear_strength),
    )


@cache
def _as_alpha(stiffening: Quantity) -> Quantity:
    return replace(stiffening, name="alpha")

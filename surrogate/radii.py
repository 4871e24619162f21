"""The transition radii below which a sharper wire cuts no more easily: three definitions.

The paper writes R_w* for two of them and Eq. (13) defines the third; they differ. Each has the
common shape of the quantities that it depends on, whatever the shape of the wires' radii.
"""

from __future__ import annotations

from typing import Any

from numpy.typing import ArrayLike

from surrogate.elementwise import apply, evaluate_checked, ratio
from surrogate.scene import Scene
from surrogate.validation import TOUGHNESS, WORK_OF_FRACTURE, FloatOrArray, defined

__all__ = ["fracto_cohesive_transition_radius", "transition_radius", "wear_transition_radius"]


def transition_radius(scene: Scene) -> FloatOrArray:
    """Return the radius at which the two terms of Eq. (13) are equal.

    Parameters
    ----------
    scene : Scene
        What is cut, in SI units; mu [Pa], Gamma_o [J/m^2], xi [-] and tau_w [Pa] play a part.

    Returns
    -------
    float or ndarray
        R_w* = (1 + xi) Gamma_o / (4 (xi mu + tau_w)) [m]; infinite where xi mu + tau_w = 0.

    Raises
    ------
    DomainError
        If Gamma_o and xi mu + tau_w are both 0: every radius would do.

    Notes
    -----
    Range of validity: that of Eq. (13). With xi = 0 this is `wear_transition_radius`.

    References
    ----------
    arXiv:2412.02021, Eq. (13).

    Examples
    --------
    >>> radius = transition_radius(Scene(685.0, 1.6, 0.25e-3, 0.1, 7750.0))
    >>> print(f"{radius:.4e} m")
    5.6277e-05 m
    """
    quantities = (
        scene.shear_modulus,
        scene.toughness,
        scene.friction_coefficient,
        scene.wear_strength,
    )
    radius = apply(_transition, quantities)
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
    DomainError
        If Gamma_o and tau_w are both 0.

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
    return 0.25 * scene.wear_length


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
    length = evaluate_checked(ratio, (TOUGHNESS, WORK_OF_FRACTURE), (toughness, work_of_fracture))
    remedy = "give a toughness or a work of fracture"
    return 0.25 * defined("fracto_cohesive_transition_radius", length, remedy)


def _transition(mu: Any, gamma: Any, xi: Any, wear: Any) -> Any:
    # Divided by 1 + xi, the denominator is a mean of mu and tau_w, which cannot overflow.
    mean = (xi / (1.0 + xi)) * mu + wear / (1.0 + xi)
    return 0.25 * ratio(gamma, mean)

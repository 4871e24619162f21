"""The paper's equations, one pure function each, on floats and arrays alike.

Equation numbers are those of B. Antarvedi Goda, Z. Ma, S. Fregonese and M. Bacca, "Cutting soft
matter: scaling relations controlled by toughness, friction, and wear", arXiv:2412.02021. They
describe steady cutting of a thick incompressible solid (plane strain, T >> R_w) by a rigid wire.

Every argument is a real number or an array of them; arrays broadcast together, and the result is
a float where all arguments are numbers, else a float64 array of the common shape. Arguments must
be finite and not negative unless said otherwise; anything else raises an `InputError` that names
the argument, its value, its unit and a remedy. Zeros give the exact limit, numbers that are too
large for floating point infinity; no warning is issued.

More than 450 lines because every equation carries its range, its limits and an example.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from surrogate.basics.checks import (
    FRICTION_COEFFICIENT,
    INFINITY,
    SHEAR_MODULUS,
    SMALLEST,
    TOUGHNESS,
    WEAR_STRENGTH,
    WIRE_RADIUS,
    FloatOrArray,
    Quantity,
)
from surrogate.basics.elementwise import (
    all_normal,
    dense,
    evaluate,
    evaluate_checked,
    product,
    proportion,
    scaled,
    where,
    where_normal,
)
from surrogate.errors import DomainError

__all__ = [
    "far_field_energy_release_rate",
    "friction_free_relative_force",
    "general_force",
    "high_toughness_force",
    "low_toughness_dissipation",
    "low_toughness_force",
    "power_law_dissipation",
    "power_law_exponent",
    "relative_force",
]

TABLE_1 = {2.0: 1.18, 5.0: 1.06, 9.0: 0.96}
"""Exponent n of Eq. (9) at the stiffening exponents alpha that the paper computed."""

RELATIVE_DISTANCE = Quantity(
    "relative_distance",
    "",
    "the wire touches the crack tip at delta/R_w = 1, where Eq. (5) ends",
    lower=1.0,
    upper=INFINITY,
    error=DomainError,
)

DIMENSIONLESS_TOUGHNESS = Quantity(
    "g", "", "give Gamma_o/(mu R_w), or cut with cutting_force where mu R_w is 0 and g infinite"
)

RELATIVE_WEAR_STRENGTH = Quantity(
    "relative_wear_strength", "", "give tau_w/mu, or 0 where wear is to be neglected"
)

EXPONENT = Quantity(
    "exponent", "", "give the exponent n of Table 1, see power_law_exponent", lower=SMALLEST
)

TABULATED_STIFFENING = Quantity(
    "stiffening_exponent",
    "",
    "Table 1 has no exponent outside alpha = 2 to 9, so choose a model that holds for any alpha",
    lower=min(TABLE_1),
    upper=max(TABLE_1),
    error=DomainError,
    even=True,
)

ELASTO_COHESIVE_LENGTH = Quantity(
    "elasto_cohesive_length",
    "m",
    "give l_e = Gamma_o/mu in metres",
    lower=SMALLEST,
    upper=INFINITY,
)

WEAR_LENGTH = Quantity(
    "wear_length", "m", "give l_w = Gamma_o/tau_w in metres", lower=SMALLEST, upper=INFINITY
)


def far_field_energy_release_rate(relative_distance: ArrayLike) -> FloatOrArray:
    """Return the dimensionless energy release rate J/(mu R_w) of far-field cutting, Eq. (5).

    Parameters
    ----------
    relative_distance : float or array_like
        Distance of the wire from the crack tip over its radius, delta/R_w [-], at least 1;
        infinity gives 0.

    Returns
    -------
    float or ndarray
        J/(mu R_w) = (R_w/delta)^2 [-].

    Raises
    ------
    DomainError
        If the distance is less than 1.

    Notes
    -----
    Range of validity: delta > R_w, that is J < mu R_w. The paper states a proportionality; its
    factor is taken as 1, so that J = mu R_w at delta = R_w.

    References
    ----------
    arXiv:2412.02021, Eq. (5) and Fig. 2c.

    Examples
    --------
    >>> print(f"{far_field_energy_release_rate(15.0):.6f}")
    0.004444
    """
    return evaluate_checked(_inverse_square, (RELATIVE_DISTANCE,), (relative_distance,))


def power_law_exponent(stiffening_exponent: ArrayLike) -> FloatOrArray:
    """Return the exponent n(alpha) of Eq. (9), linear in alpha between the nodes of Table 1.

    Parameters
    ----------
    stiffening_exponent : float or array_like
        alpha of the Ogden solid [-], from 2 to 9.

    Returns
    -------
    float or ndarray
        n [-], which is 1.18, 1.06 and 0.96 at alpha = 2, 5 and 9.

    Raises
    ------
    DomainError
        If alpha is outside 2 to 9: the paper has no exponent there.

    Notes
    -----
    The paper gives n at the three nodes only; the interpolation between them is this library's.

    References
    ----------
    arXiv:2412.02021, Table 1.

    Examples
    --------
    >>> print(f"{power_law_exponent(2.0):.3f} {power_law_exponent(3.0):.3f}")
    1.180 1.140
    """
    return evaluate_checked(table_1_exponent, (TABULATED_STIFFENING,), (stiffening_exponent,))


def power_law_dissipation(
    g: ArrayLike, friction_coefficient: ArrayLike, exponent: ArrayLike
) -> FloatOrArray:
    """Return the dimensionless dissipative force F_d/(mu R_w T) of high toughness, Eq. (9).

    Parameters
    ----------
    g : float or array_like
        Dimensionless toughness Gamma_o/(mu R_w) [-].
    friction_coefficient : float or array_like
        xi [-]; where it is 0, so is the force.
    exponent : float or array_like
        n [-], positive; `power_law_exponent` gives the paper's.

    Returns
    -------
    float or ndarray
        F_d/(mu R_w T) = xi g^n [-].

    Raises
    ------
    InputError
        If an argument is out of range.

    Notes
    -----
    Range of validity: g >> 1, where friction outweighs wear.

    References
    ----------
    arXiv:2412.02021, Eq. (9) and Fig. 4.

    Examples
    --------
    >>> print(f"{power_law_dissipation(20.0, 0.1, 1.18):.4f}")
    3.4294
    """
    quantities = (DIMENSIONLESS_TOUGHNESS, FRICTION_COEFFICIENT, EXPONENT)
    return evaluate_checked(power_law, quantities, (g, friction_coefficient, exponent))


def high_toughness_force(
    toughness: ArrayLike, friction_coefficient: ArrayLike = 0.0
) -> FloatOrArray:
    """Return the steady cutting force F_ss/T of high toughness, Eq. (10).

    Parameters
    ----------
    toughness : float or array_like
        Cleavage toughness Gamma_o [J/m^2].
    friction_coefficient : float or array_like, default 0
        xi [-].

    Returns
    -------
    float or ndarray
        F_ss/T = (1 + xi) Gamma_o [N/m], whatever the radius.

    Raises
    ------
    InputError
        If an argument is out of range.

    Notes
    -----
    Range of validity: Gamma_o >> mu R_w, where friction outweighs wear.

    References
    ----------
    arXiv:2412.02021, Eq. (10).

    Examples
    --------
    >>> print(f"{high_toughness_force(1.6, 0.1):.4f} N/m")
    1.7600 N/m
    """
    return evaluate(
        _high_toughness, (TOUGHNESS, FRICTION_COEFFICIENT), (toughness, friction_coefficient)
    )


def low_toughness_dissipation(
    friction_coefficient: ArrayLike, relative_wear_strength: ArrayLike
) -> FloatOrArray:
    """Return the dimensionless dissipative force F_d/(mu R_w T) of low toughness, Eq. (11).

    Parameters
    ----------
    friction_coefficient : float or array_like
        xi [-].
    relative_wear_strength : float or array_like
        tau_w/mu [-].

    Returns
    -------
    float or ndarray
        F_d/(mu R_w T) = 4 (xi + tau_w/mu) [-].

    Raises
    ------
    InputError
        If an argument is out of range.

    Notes
    -----
    Range of validity: Gamma_o <= mu R_w.

    References
    ----------
    arXiv:2412.02021, Eq. (11) and Fig. 4.

    Examples
    --------
    >>> print(f"{low_toughness_dissipation(0.1, 11.31):.4f}")
    45.6400
    """
    return evaluate(
        _low_toughness_dissipation,
        (FRICTION_COEFFICIENT, RELATIVE_WEAR_STRENGTH),
        (friction_coefficient, relative_wear_strength),
    )


def low_toughness_force(
    shear_modulus: ArrayLike,
    toughness: ArrayLike,
    wire_radius: ArrayLike,
    friction_coefficient: ArrayLike = 0.0,
    wear_strength: ArrayLike = 0.0,
) -> FloatOrArray:
    """Return the steady cutting force F_ss/T of low toughness, Eq. (12).

    Parameters
    ----------
    shear_modulus : float or array_like
        mu [Pa].
    toughness : float or array_like
        Cleavage toughness Gamma_o [J/m^2].
    wire_radius : float or array_like
        R_w [m].
    friction_coefficient : float or array_like, default 0
        xi [-].
    wear_strength : float or array_like, default 0
        tau_w [Pa].

    Returns
    -------
    float or ndarray
        F_ss/T = Gamma_o + 4 (tau_w + xi mu) R_w [N/m].

    Raises
    ------
    InputError
        If an argument is out of range.

    Notes
    -----
    Range of validity: Gamma_o <= mu R_w.

    References
    ----------
    arXiv:2412.02021, Eq. (12).

    Examples
    --------
    >>> print(f"{low_toughness_force(685.0, 1.6, 0.01, 0.1, 7750.0):.4f} N/m")
    314.3400 N/m
    """
    return evaluate(
        _low_toughness,
        _SCENE,
        (shear_modulus, toughness, wire_radius, friction_coefficient, wear_strength),
    )


def general_force(
    shear_modulus: ArrayLike,
    toughness: ArrayLike,
    wire_radius: ArrayLike,
    friction_coefficient: ArrayLike = 0.0,
    wear_strength: ArrayLike = 0.0,
) -> FloatOrArray:
    """Return the steady cutting force F_ss/T at any toughness, Eq. (13).

    Parameters
    ----------
    shear_modulus : float or array_like
        mu [Pa].
    toughness : float or array_like
        Cleavage toughness Gamma_o [J/m^2].
    wire_radius : float or array_like
        R_w [m].
    friction_coefficient : float or array_like, default 0
        xi [-].
    wear_strength : float or array_like, default 0
        tau_w [Pa].

    Returns
    -------
    float or ndarray
        F_ss/T = (1 + xi) Gamma_o + 4 (xi mu + tau_w) R_w [N/m], the sum of a term that the
        radius does not change and one linear in it.

    Raises
    ------
    InputError
        If an argument is out of range.

    Notes
    -----
    Range of validity: the paper joins Eqs. (10) and (11) and finds "all scenarios with good
    approximation"; it gives no error.

    References
    ----------
    arXiv:2412.02021, Eq. (13).

    Examples
    --------
    >>> print(f"{general_force(685.0, 1.6, 0.25e-3, 0.1, 7750.0):.4f} N/m")
    9.5785 N/m
    """
    return evaluate(
        _general,
        _SCENE,
        (shear_modulus, toughness, wire_radius, friction_coefficient, wear_strength),
    )


def relative_force(
    wire_radius: ArrayLike,
    elasto_cohesive_length: ArrayLike,
    friction_coefficient: ArrayLike = 0.0,
    relative_wear_strength: ArrayLike = 0.0,
) -> FloatOrArray:
    """Return the cutting force over the toughness, F_ss/(Gamma_o T), Eq. (14).

    Parameters
    ----------
    wire_radius : float or array_like
        R_w [m].
    elasto_cohesive_length : float or array_like
        l_e = Gamma_o/mu [m], positive; may be infinite.
    friction_coefficient : float or array_like, default 0
        xi [-].
    relative_wear_strength : float or array_like, default 0
        tau_w/mu [-].

    Returns
    -------
    float or ndarray
        F_ss/(Gamma_o T) = 1 + xi + 4 (xi + tau_w/mu) R_w/l_e [-].

    Raises
    ------
    InputError
        If an argument is out of range.

    Notes
    -----
    Range of validity: that of Eq. (13), of which this is another form.

    References
    ----------
    arXiv:2412.02021, Eq. (14).

    Examples
    --------
    >>> print(f"{relative_force(0.25e-3, 1.6 / 685.0, 0.1, 7750.0 / 685.0):.4f}")
    5.9866
    """
    return evaluate_checked(
        _relative,
        (WIRE_RADIUS, ELASTO_COHESIVE_LENGTH, FRICTION_COEFFICIENT, RELATIVE_WEAR_STRENGTH),
        (wire_radius, elasto_cohesive_length, friction_coefficient, relative_wear_strength),
    )


def friction_free_relative_force(wire_radius: ArrayLike, wear_length: ArrayLike) -> FloatOrArray:
    """Return the cutting force over the toughness without friction, F_ss/(Gamma_o T), Eq. (15).

    Parameters
    ----------
    wire_radius : float or array_like
        R_w [m].
    wear_length : float or array_like
        l_w = Gamma_o/tau_w [m], positive; may be infinite.

    Returns
    -------
    float or ndarray
        F_ss/(Gamma_o T) = 1 + 4 R_w/l_w [-].

    Raises
    ------
    InputError
        If an argument is out of range.

    Notes
    -----
    Range of validity: xi << 1 and xi mu << tau_w.

    References
    ----------
    arXiv:2412.02021, Eq. (15).

    Examples
    --------
    >>> print(f"{friction_free_relative_force(0.25e-3, 1.6 / 7750.0):.4f}")
    5.8437
    """
    return evaluate_checked(_friction_free, (WIRE_RADIUS, WEAR_LENGTH), (wire_radius, wear_length))


_SCENE = (SHEAR_MODULUS, TOUGHNESS, WIRE_RADIUS, FRICTION_COEFFICIENT, WEAR_STRENGTH)


def _inverse_square(x: Any) -> Any:
    return (1.0 / x) * (1.0 / x)  # x*x would overflow too soon


def table_1_exponent(alpha: Any) -> Any:
    (a0, n0), (a1, n1), (a2, n2) = TABLE_1.items()
    first = n0 + (n1 - n0) * ((alpha - a0) / (a1 - a0))
    second = n1 + (n2 - n1) * ((alpha - a1) / (a2 - a1))
    return where(alpha < a1, first, second)


def table_1_slope(alpha: Any) -> Any:
    (a0, n0), (a1, n1), (a2, n2) = TABLE_1.items()
    return where(alpha < a1, (n1 - n0) / (a1 - a0), (n2 - n1) / (a2 - a1))


def power_law(g: Any, xi: Any, n: Any) -> Any:
    with np.errstate(all="ignore"):
        power = _raised(g, n)
        force = xi * power
        if not all_normal(power):  # which the product with xi may be all the same
            root = _raised(g, 0.25 * n)
            force = where_normal(power, force, scaled((xi, root, root, root, root), ()))
    return where((xi == 0.0) | (g == 0.0), 0.0, force)


def _raised(g: Any, n: Any) -> Any:
    power = np.power(dense(g), dense(n))
    return power if isinstance(power, np.ndarray) else float(power)


def _high_toughness(gamma: Any, xi: Any) -> Any:
    return gamma + xi * gamma


def _low_toughness_dissipation(xi: Any, relative_wear: Any) -> Any:
    return 4.0 * (xi + relative_wear)


def _low_toughness(mu: Any, gamma: Any, radius: Any, xi: Any, wear: Any) -> Any:
    slope = 4.0 * (xi * mu + wear)
    linear = slope * radius if all_normal(slope) else _by_terms(slope, mu, radius, xi, wear)
    return gamma + linear


def _general(mu: Any, gamma: Any, radius: Any, xi: Any, wear: Any) -> Any:
    slope = 4.0 * (xi * mu + wear)
    linear = slope * radius if all_normal(slope) else _by_terms(slope, mu, radius, xi, wear)
    return (gamma + xi * gamma) + linear


def _by_terms(slope: Any, mu: Any, radius: Any, xi: Any, wear: Any) -> Any:
    """Return 4 (xi mu + tau_w) R_w where the sum in brackets over- or underflows."""
    terms = 4.0 * product(radius, xi, mu) + 4.0 * (wear * radius)
    return where_normal(slope, slope * radius, terms)


def _relative(radius: Any, length: Any, xi: Any, relative_wear: Any) -> Any:
    resistance = xi + relative_wear
    linear = proportion(resistance, radius, length)
    if not all_normal(resistance):  # the sum may overflow where its product with R_w/l_e does not
        terms = proportion(xi, radius, length) + proportion(relative_wear, radius, length)
        linear = where_normal(resistance, linear, terms)
    return (1.0 + xi) + 4.0 * linear


def _friction_free(radius: Any, length: Any) -> Any:
    return 1.0 + 4.0 * (radius / length)

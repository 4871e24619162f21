"""Closed-form solutions that the finite-element engine is held against, one function each.

Lengths are in wire radii R_w, or in any other one length where no wire occurs; moduli in mu,
energy release rates in mu R_w, forces per unit thickness in mu R_w.  The body is incompressible
and in plane strain; its small-strain plane-strain modulus is E' = 4 mu for every alpha.  Forces
are those of the half model, one face of the crack; energy release rates are of the whole body.

Arguments are numbers or arrays, which broadcast together; results are floats where all arguments
are numbers.  Numbers outside the range given raise an ``InputError``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import lambertw

from surrogate.basics.checks import SMALLEST, FloatOrArray, Quantity

__all__ = [
    "PLANE_STRAIN_MODULUS",
    "HertzContact",
    "Wedge",
    "crack_tip_opening",
    "far_field_wedge",
    "far_field_wedge_from_energy_release_rate",
    "hertz_line_contact",
    "point_force_energy_release_rate",
    "rigid_strip_energy_release_rate",
    "stretched_strip_energy_release_rate",
]

PLANE_STRAIN_MODULUS = 4.0
"""E'/mu = 2 mu (1 + nu)/(1 - nu^2)/mu at nu = 1/2, the same for every Ogden exponent [-]."""

_LARGEST_DISTANCE = 1e150

_WEDGE_DISTANCE = Quantity(
    "distance",
    "R_w",
    "give delta from 1, where the wire touches the tip, to 1e150",
    lower=1.0,
    upper=_LARGEST_DISTANCE,
)
_FORCE_DISTANCE = Quantity(
    "distance", "R_w", "give the distance from the tip to the force", lower=SMALLEST
)
_FORCE = Quantity("force", "mu R_w", "give the compressive force on the half model")
_STRETCH = Quantity("stretch", "", "give l = 1 for the unloaded strip", lower=SMALLEST)
_ALPHA = Quantity("alpha", "", "give the Ogden exponent, 2 for neo-Hookean", lower=1.0)
_HALF_HEIGHT = Quantity("half_height", "R_w", "give H of the unloaded strip", lower=SMALLEST)
_THICKNESS = Quantity("half_thickness", "R_w", "give h of the rigid strip")
_RADIUS = Quantity("radius", "R_w", "give the radius of the cylinder", lower=SMALLEST)
_RATE = Quantity("energy_release_rate", "mu R_w", "give J of the whole body")
_DISTANCE = Quantity("reference_distance", "R_w", "give the distance from the tip before loading")


def _plain(value: Any) -> FloatOrArray:
    """Return a float for anything without axes, else the array."""
    array: NDArray[np.float64] = np.asarray(value, dtype=np.float64)
    return array if array.ndim else float(array)


@dataclass(frozen=True, slots=True)
class Wedge:
    """A wire that opens a crack from far behind its tip, in linear elasticity.

    Parameters
    ----------
    distance : float or ndarray
        delta, from the wire's centre to the crack tip [R_w].
    vertical_force : float or ndarray
        B = F_v, the opening force on the half model [mu R_w].
    contact_width : float or ndarray
        A = cos theta_1 - cos theta_2, the projected width of the contact, 2 a [R_w].
    energy_release_rate : float or ndarray
        J of the whole body [mu R_w].
    """

    distance: FloatOrArray
    vertical_force: FloatOrArray
    contact_width: FloatOrArray
    energy_release_rate: FloatOrArray


def _wedge(distance: Any, p: Any) -> Wedge:
    return Wedge(
        _plain(distance),
        _plain(4.0 * p),
        _plain(4.0 * np.sqrt(p / np.pi)),
        _plain(8.0 * p**2 / (np.pi * distance)),
    )


def far_field_wedge(distance: ArrayLike) -> Wedge:
    """Return force, contact width and J of a wire at a distance behind the tip.

    The opening displacement of a semi-infinite crack under a Hertz pressure centred at `distance`
    is 1, the wire's radius, at the centre of the contact.  With ``p = F_v/4``::

        1 = (2 p/pi) (ln(8 delta/a) + 1/2),    a^2 = 4 p/pi,    J = 8 p^2/(pi delta).

    Parameters
    ----------
    distance : float or array_like
        delta, from the wire's centre to the crack tip [R_w], from 1 to 1e150.

    Returns
    -------
    Wedge
        The solution at this distance.

    Raises
    ------
    InputError
        If a distance is out of range.

    Notes
    -----
    Eliminating a leaves ``p ln(c/sqrt(p)) = pi/2`` with ``c = 4 sqrt(pi e) delta``, which the
    lower branch of Lambert's function solves: ``p = -pi/W(-pi/c^2)``.

    Range of validity: delta much larger than 1.  The relative error has a part of order
    ``(a/delta)^2``, from the pressure being a Hertz one, and one of the order of the strain under
    the wire, ``a``, which falls only as ``1/sqrt(ln delta)``: the solution is a limit, not an
    approximation of given order.

    References
    ----------
    H. Tada, P. C. Paris and G. R. Irwin, The Stress Analysis of Cracks Handbook, 3rd ed., ASME,
    2000 (opening of a semi-infinite crack under a pair of point forces); K. L. Johnson, Contact
    Mechanics, Cambridge, 1985, ch. 4 (line contact).

    Examples
    --------
    >>> wedge = far_field_wedge(50.0)
    >>> print(f"{wedge.vertical_force:.4f} {wedge.energy_release_rate:.6f}")
    0.8816 0.002474
    """
    delta: Any = _WEDGE_DISTANCE.checked(distance)
    squared = 16.0 * np.pi * np.e * delta**2
    return _wedge(delta, -np.pi / lambertw(-np.pi / squared, -1).real)


def far_field_wedge_from_energy_release_rate(energy_release_rate: ArrayLike) -> Wedge:
    """Return force, contact width and distance of a wire at a given J: `far_field_wedge` inverted.

    Parameters
    ----------
    energy_release_rate : float or array_like
        J of the whole body [mu R_w], positive and at most its value at delta = 1.

    Returns
    -------
    Wedge
        The solution at this J.

    Raises
    ------
    InputError
        If J is out of range.

    Notes
    -----
    With ``delta = 8 p^2/(pi J)`` the equation becomes ``p ln(k p) = pi/3`` where
    ``k = (32 sqrt(e)/(sqrt(pi) J))^(2/3)``, solved by ``p = (pi/3)/W(k pi/3)``, W being the
    principal branch of Lambert's function.  Range of validity: as `far_field_wedge`.

    References
    ----------
    As `far_field_wedge`.

    Examples
    --------
    >>> wedge = far_field_wedge_from_energy_release_rate(1e-3)
    >>> print(f"{wedge.distance:.3f}")
    101.144
    """
    largest = Quantity(
        "energy_release_rate",
        "mu R_w",
        "give J of a wire that does not touch the tip",
        lower=1e-100,
        upper=_LARGEST_WEDGE_RATE,
    )
    rate: Any = largest.checked(energy_release_rate)
    third = np.pi / 3.0
    k = (32.0 * np.sqrt(np.e / np.pi) / rate) ** (2.0 / 3.0)
    p = third / lambertw(k * third).real
    return _wedge(8.0 * p**2 / (np.pi * rate), p)


def point_force_energy_release_rate(force: ArrayLike, distance: ArrayLike) -> FloatOrArray:
    """Return J of a crack opened by a pair of point forces behind its tip.

    ``J = K^2/E'`` with ``K = F sqrt(2/(pi delta))``, that is ``J = F^2/(2 pi mu delta)``.

    Parameters
    ----------
    force : float or array_like
        F on the half model [mu R_w].
    distance : float or array_like
        delta, from the force to the crack tip [R_w], positive.

    Returns
    -------
    float or ndarray
        J of the whole body [mu R_w].

    Raises
    ------
    InputError
        If an argument is out of range.

    Notes
    -----
    Range of validity: linear elasticity, semi-infinite crack in an infinite body.

    References
    ----------
    H. Tada, P. C. Paris and G. R. Irwin, The Stress Analysis of Cracks Handbook, 3rd ed., ASME,
    2000.

    Examples
    --------
    >>> print(f"{point_force_energy_release_rate(1.0, 10.0):.6f}")
    0.015915
    """
    F: Any = _FORCE.checked(force)
    delta: Any = _FORCE_DISTANCE.checked(distance)
    return _plain(F**2 / (2.0 * np.pi * delta))


def stretched_strip_energy_release_rate(
    stretch: ArrayLike, half_height: ArrayLike, alpha: ArrayLike
) -> FloatOrArray:
    """Return J of a long crack along the middle of a stretched strip, ``J = 2 H W(l)``.

    The crack's growth by dc turns a slice of the strip from homogeneously stretched, with
    ``W = (2/alpha^2) (l^alpha + l^-alpha - 2)``, to unloaded, and the grips do no work.

    Parameters
    ----------
    stretch : float or array_like
        l, across the strip, far ahead of the tip [-], positive.
    half_height : float or array_like
        H, half the height of the unloaded strip [R_w], positive.
    alpha : float or array_like
        Ogden exponent [-], at least 1.

    Returns
    -------
    float or ndarray
        J of the whole body [mu R_w].

    Raises
    ------
    InputError
        If an argument is out of range.

    Notes
    -----
    Range of validity: any stretch above 1; crack and ligament several H long.  In plane strain
    the slice ahead of the tip contracts along the cut by 1/l, so the grips must let the strip
    slide along them: an incompressible strip glued to them could not be stretched at all.

    References
    ----------
    R. S. Rivlin and A. G. Thomas, Rupture of rubber I, J. Polym. Sci. 10 (1953) 291-318.

    Examples
    --------
    >>> print(f"{stretched_strip_energy_release_rate(2.0, 1.0, 2.0):.3f}")
    2.250
    """
    length: Any = _STRETCH.checked(stretch)
    H: Any = _HALF_HEIGHT.checked(half_height)
    exponent: Any = _ALPHA.checked(alpha)
    # l^a + l^-a - 2 = 4 sinh^2(a ln l/2) keeps its digits near l = 1
    return _plain(16.0 * H * (np.sinh(0.5 * exponent * np.log(length)) / exponent) ** 2)


def rigid_strip_energy_release_rate(half_thickness: ArrayLike, distance: ArrayLike) -> FloatOrArray:
    """Return J of a crack that a rigid strip fills up to a distance behind the tip.

    ``J = K^2/E'`` with ``K = E' h/sqrt(2 pi l)``, that is ``J = 2 mu h^2/(pi l)``.

    Parameters
    ----------
    half_thickness : float or array_like
        h of the frictionless strip [R_w].
    distance : float or array_like
        l, from the strip's end to the crack tip [R_w], positive.

    Returns
    -------
    float or ndarray
        J of the whole body [mu R_w].

    Raises
    ------
    InputError
        If an argument is out of range.

    Notes
    -----
    Range of validity: h much smaller than l (linear elasticity), body much larger than l.

    References
    ----------
    G. I. Barenblatt, The mathematical theory of equilibrium cracks in brittle fracture, Adv.
    Appl. Mech. 7 (1962) 55-129, on wedging.

    Examples
    --------
    >>> print(f"{rigid_strip_energy_release_rate(0.01, 1.0):.4e}")
    6.3662e-05
    """
    h: Any = _THICKNESS.checked(half_thickness)
    length: Any = _FORCE_DISTANCE.checked(distance)
    return _plain(2.0 * h**2 / (np.pi * length))


@dataclass(frozen=True, slots=True)
class HertzContact:
    """Frictionless contact of a rigid cylinder with a half-space.

    Parameters
    ----------
    half_width : float or ndarray
        a, half the width of the contact [R_w].
    peak_pressure : float or ndarray
        Pressure in its middle [mu]; it falls as ``sqrt(1 - (x/a)^2)``.
    """

    half_width: FloatOrArray
    peak_pressure: FloatOrArray


def hertz_line_contact(force: ArrayLike, radius: ArrayLike = 1.0) -> HertzContact:
    """Return width and peak pressure of Hertz's line contact.

    ``a^2 = 4 P R/(pi E') = P R/(pi mu)`` and ``p_max = 2 P/(pi a)``.

    Parameters
    ----------
    force : float or array_like
        P, compressive, per unit thickness [mu R_w], positive.
    radius : float or array_like
        R of the cylinder [R_w], positive.

    Returns
    -------
    HertzContact
        Half width and peak pressure.

    Raises
    ------
    InputError
        If an argument is out of range.

    Notes
    -----
    Range of validity: a much smaller than R; the strain is of order a/R.

    References
    ----------
    K. L. Johnson, Contact Mechanics, Cambridge, 1985, ch. 4.

    Examples
    --------
    >>> contact = hertz_line_contact(0.1)
    >>> print(f"{contact.half_width:.4f} {contact.peak_pressure:.4f}")
    0.1784 0.3568
    """
    P: Any = Quantity("force", "mu R_w", "give a pressing force", lower=SMALLEST).checked(force)
    R: Any = _RADIUS.checked(radius)
    a = np.sqrt(P * R / np.pi)
    return HertzContact(_plain(a), _plain(2.0 * P / (np.pi * a)))


def crack_tip_opening(
    energy_release_rate: ArrayLike, reference_distance: ArrayLike
) -> FloatOrArray:
    """Return the deformed height of a neo-Hookean crack face near its tip.

    ``y = sqrt(4 J r/(pi mu))`` at the reference distance r behind the tip: half the opening.

    Parameters
    ----------
    energy_release_rate : float or array_like
        J of the whole body [mu R_w].
    reference_distance : float or array_like
        r, from the tip to the point of the face, both in the reference configuration [R_w].

    Returns
    -------
    float or ndarray
        y, above the symmetry plane [R_w].

    Raises
    ------
    InputError
        If an argument is out of range.

    Notes
    -----
    Near the tip the neo-Hookean height y is harmonic in the reference coordinates and carries the
    energy, as in antiplane shear: ``y = b sqrt(r) sin(theta/2)`` has ``J = pi mu b^2/4``.  Linear
    elasticity has 2 J in place of 4 J.

    Range of validity: alpha = 2, finite strain; r much smaller than J/mu and than any length of
    the load.  A notch of radius r0 in place of the tip multiplies y by ``1 + r0/r``, the field
    of the same far height that has a traction-free circle.

    References
    ----------
    R. A. Stephenson, The equilibrium field near the tip of a crack for finite plane strain of
    incompressible elastic materials, J. Elasticity 12 (1982) 65-99.

    Examples
    --------
    >>> print(f"{crack_tip_opening(1.0, 0.01):.4f}")
    0.1128
    """
    J: Any = _RATE.checked(energy_release_rate)
    r: Any = _DISTANCE.checked(reference_distance)
    return _plain(np.sqrt(4.0 * J * r / np.pi))


_LARGEST_WEDGE_RATE = float(np.max(far_field_wedge(1.0).energy_release_rate))

"""How the cutting force answers to each quantity of a scene."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.checks import FloatOrArray, defined, flag
from surrogate.basics.elementwise import apply
from surrogate.basics.records import Record
from surrogate.choosing.by_name import AUTO
from surrogate.choosing.laws import PROJECTED, require_known_load
from surrogate.choosing.parted import parted
from surrogate.contact.base import ForceModel
from surrogate.contact.domain import require_inside
from surrogate.contact.fitted import FittedModel
from surrogate.cutting.believable import warn_of_scene
from surrogate.cutting.force import warn_if_other_law
from surrogate.cutting.other_law import law_for
from surrogate.cutting.outside import blanked, is_nan
from surrogate.scene import NAMES, Scene, require_scene

__all__ = ["ForceGradient", "force_gradient"]


@dataclass(frozen=True, slots=True, eq=False)
class ForceGradient(Record):
    """Derivatives of the steady cutting force F_ss/T by the quantities of a scene.

    Each is a float where the scene's quantities all are numbers, else an array of the scene's
    shape, and bears the name of the quantity by which the force is differentiated.

    Parameters
    ----------
    shear_modulus : float or ndarray
        By mu [m].
    toughness : float or ndarray
        By Gamma_o [-].
    wire_radius : float or ndarray
        By R_w [Pa].
    friction_coefficient : float or ndarray
        By xi [N/m].
    wear_strength : float or ndarray
        By tau_w [m].
    stiffening_exponent : float or ndarray
        By alpha [N/m].
    model : str
        Name of the model.
    law : str
        The law of dissipation; "auto" where the points have several.
    laws : str or ndarray of str
        That of each point.
    doubts : tuple of str
        What is to be doubted, in words, as in a `CuttingForce`.

    Examples
    --------
    The force is homogeneous of degree one in toughness and radius (Euler's theorem):

    >>> from surrogate.cutting.force import cutting_force
    >>> gel = Scene(685.0, 1.6, 0.25e-3, 0.1, 7750.0)
    >>> slope = force_gradient(gel, "eq13")
    >>> print(f"{1.6 * slope.toughness + 0.25e-3 * slope.wire_radius:.4f} N/m")
    9.5785 N/m
    >>> print(f"{cutting_force(gel, 'eq13').total:.4f} N/m")
    9.5785 N/m
    """

    shear_modulus: FloatOrArray
    toughness: FloatOrArray
    wire_radius: FloatOrArray
    friction_coefficient: FloatOrArray
    wear_strength: FloatOrArray
    stiffening_exponent: FloatOrArray
    model: str
    law: str = PROJECTED
    laws: str | NDArray[np.str_] = PROJECTED
    doubts: tuple[str, ...] = ()


def force_gradient(
    scene: Scene,
    model: str | ForceModel = AUTO,
    rtol: float | None = None,
    extrapolate: bool = False,
    law: str = AUTO,
    notch_radius: float | None = None,
    outside: str = "raise",
) -> ForceGradient:
    """Return the analytic derivatives of the cutting force by every quantity of a scene.

    With F_ss/T = Gamma_o + 2 R_w (tau_w A + xi mu B) at g = Gamma_o/(mu R_w), a prime for d/dg:

        by mu:      2 R_w [xi (B - g B') - (tau_w/mu) g A']
        by Gamma_o: 1 + 2 [(tau_w/mu) A' + xi B']
        by R_w:     2 [tau_w (A - g A') + xi mu (B - g B')]
        by xi:      2 R_w mu B
        by tau_w:   2 R_w A
        by alpha:   2 R_w [tau_w dA/dalpha + xi mu dB/dalpha]

    For Eq. (13), 2 A = 4 and 2 B = g + 4: 4 xi R_w, 1 + xi, 4 (xi mu + tau_w),
    Gamma_o + 4 mu R_w, 4 R_w and 0.

    Parameters
    ----------
    scene : Scene
        What is cut and with which wire, in SI units.
    model : str, default "auto"
        As in `cutting_force`, but that "auto" is one model for all points: the cheapest whose A
        and B meet `rtol` all over its domain.
    rtol : float, optional
        Relative error of A and B that will do with "auto" [-]; by default 0.02 where a model is as
        exact, else that of the most exact one. Of the slopes of A and B no error is known.
    extrapolate : bool, default False
        Whether to continue a fitted model outside its domain, as in `cutting_force`.
    law : str, default "auto"
        Which functions of the contact wear and friction follow, as in `cutting_force`; with "auto"
        "coupled" wherever coupled solutions reach, whose first order "slip" is, and "projected"
        elsewhere. The derivatives are those of the law at the point, also beside a point that has
        the other one.
    notch_radius : float, optional
        Radius of the crack's tip [m], with law="slip", as in `cutting_force`; it stays where the
        wire's radius changes.
    outside : str, default "raise"
        As in `cutting_force`: "nan" for nan where the model does not hold or a derivative has no
        limit, and not an error.

    Returns
    -------
    ForceGradient
        The six derivatives in SI units.

    Raises
    ------
    InputError
        If `scene` is not a `Scene`.
    UnknownModelError
        If there is no such model.
    AccuracyError
        If the model is "auto" and none is as exact as `rtol`.
    DomainError
        If alpha is outside Table 1 for "eq9"; if g or alpha is outside the domain of a fitted
        model and `extrapolate` is not set; or if a derivative has no limit, which is so only where
        Gamma_o = 0 or mu R_w = 0 and the model is not a closed form.

    Warns
    -----
    ImplausibleInputWarning
        If a quantity is hardly that of a soft solid's cut.

    Notes
    -----
    Range of validity: that of the model. Where A or B bends, the derivative is that from above.
    A force that rises with a vertical tangent has an infinite derivative: that of "eq9" where
    Gamma_o or mu R_w vanish and there is friction.

    References
    ----------
    arXiv:2412.02021, Eqs. (13), (S1) and (S2).

    Examples
    --------
    >>> slope = force_gradient(Scene(685.0, 1.6, 0.25e-3, 0.1, 7750.0), "eq13")
    >>> print(f"{slope.toughness:.3f} N/m more force for 1 J/m2 more toughness")
    1.100 N/m more force for 1 J/m2 more toughness
    >>> print(f"{1e-6 * slope.wire_radius:.6f} N/m more for 1 um more radius")
    0.031274 N/m more for 1 um more radius

    By finite elements far less reaches the force, as the tougher gel wears along a shorter arc:

    >>> slope = force_gradient(Scene(685.0, 1.6, 0.25e-3, 0.0, 7750.0))
    >>> slope.model, slope.toughness < 0.5
    ('table', True)
    """
    extrapolate = flag("extrapolate", extrapolate)
    blank = is_nan(outside) and not extrapolate
    require_scene(scene)
    law = law_for(scene, law)
    by_law = parted(model, law, rtol, scene.values(), notch_radius)
    chosen = by_law.model
    if not isinstance(chosen, FittedModel):
        chosen.stiffening.checked(scene.stiffening_exponent)
    elif blank:
        pass  # what is outside has no number in the end
    elif not extrapolate:  # the slopes by xi and tau_w need the contact where both are 0, too
        mu, gamma, radius, _, _, alpha = scene.values()
        require_inside(chosen, (mu, gamma, radius, 1.0, 1.0, alpha))
        require_known_load(chosen, scene.values())
    else:
        chosen.require_known(scene.values())
    with np.errstate(all="ignore"):
        slopes = by_law.evaluate(lambda one, part: apply(one.gradient, part, (float,) * 6))
    if blank and isinstance(chosen, FittedModel):
        holds = chosen.in_domain(*scene.values())
        slopes = tuple(blanked(slope, holds) for slope in slopes)
    remedy = "give a toughness, and a modulus and a radius of the wire, or choose 'eq13'"
    for name, slope in zip(NAMES, slopes, strict=True) if not blank else ():
        defined(f"derivative by {name}", slope, remedy)
    warn_of_scene(scene.values())
    warn_if_other_law(scene, model, law)
    return ForceGradient(
        **dict(zip(NAMES, slopes, strict=True)),
        model=chosen.name,
        law=by_law.law,
        laws=by_law.laws,
        doubts=by_law.doubts,
    )

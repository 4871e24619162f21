"""The steady cutting force and its parts."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.checks import (
    RTOL,
    FloatOrArray,
    flag,
    one_number,
)
from surrogate.basics.elementwise import AT_ONCE, WHOLE, apply
from surrogate.basics.records import LateRecord
from surrogate.choosing.by_name import AUTO, force_model, is_auto, one_name
from surrogate.choosing.effective import doubt_of_law
from surrogate.choosing.laws import (
    PROJECTED,
    AnyLaw,
    of_law,
    require_known_load,
)
from surrogate.contact.base import ForceModel
from surrogate.contact.domain import require_inside
from surrogate.contact.fitted import FittedModel
from surrogate.cutting.believable import warn_of_scene
from surrogate.cutting.other_law import law_for, warn_of_other_law
from surrogate.cutting.outside import is_nan
from surrogate.scene import Scene, require_scene

__all__ = ["CuttingForce", "cutting_force", "force_of", "warn_if_other_law"]


@dataclass(frozen=True, slots=True, eq=False)
class CuttingForce(LateRecord):
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
        Name of the model; "auto" where the points have several.
    relative_error : float, ndarray or None
        Known bound of the relative error of `total` beside finite elements on which the wire rubs
        [-], `fit_error` and `law_error` together; nan where nobody knows it, None for closed forms,
        of which nobody measured it.
    in_domain : bool or ndarray of bool
        Whether the model's own condition holds.
    chosen : str or ndarray of str
        Name of the model of each point.
    law : str
        The law of dissipation, "projected", "slip" or "coupled"; "auto" where the points have
        several.
    laws : str or ndarray of str
        Name of the law of each point.
    fit_error : float, ndarray or None
        The part of the model: beside finite elements of the law of the point [-]. nan outside the
        domain, and under "slip" where the tip touches the wire at alpha up to 3: the slip there
        depends on how sharp the tip is, a notch of 5e-4 R_w here. With `notch_radius` it is that
        beside finite elements with a notch of this radius.
    law_error : float, ndarray or None
        The part of the law: of its own force beside finite elements on which the wire rubs [-]. 0
        under "coupled", whose error is that of a fit, and where nothing rubs; nan where no such
        solution is near.
    doubts : tuple of str
        What is to be doubted, in words: one sentence where the law "auto" fell back to "projected",
        as the error of every law is unknown there.

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
    chosen: str | NDArray[np.str_] = ""
    law: str = PROJECTED
    laws: str | NDArray[np.str_] = PROJECTED
    fit_error: FloatOrArray | None = None
    law_error: FloatOrArray | None = None
    doubts: tuple[str, ...] = ()


_complete = CuttingForce.without()
_by_name = CuttingForce.without("relative_error", "fit_error", "law_error")
_without_errors = CuttingForce.without("relative_error", "fit_error", "law_error", "doubts")
_of_projected = CuttingForce.without("relative_error", "law_error")


def cutting_force(
    scene: Scene,
    model: str | ForceModel = AUTO,
    rtol: float | None = None,
    extrapolate: bool = False,
    law: str = AUTO,
    outside: str = "raise",
    notch_radius: float | None = None,
) -> CuttingForce:
    """Return the steady cutting force per unit thickness of a scene and its parts, Eq. (S2).

    Parameters
    ----------
    scene : Scene
        What is cut and with which wire, in SI units.
    model : str, default "auto"
        "auto" for the cheapest model that meets `rtol`, at each point by itself; "power-law",
        "table" or "gp" for those fitted to finite elements; "eq13" for Eq. (13), "high-toughness"
        for Eq. (10), "low-toughness" for Eq. (12), "friction-free" for Eq. (15), or "eq9" for
        Eq. (9) with the exponents of Table 1, linear in alpha between them.
    rtol : float, optional
        Relative error that has to be met with "auto" [-], else an `AccuracyError` is raised; by
        default 0.02 where it can be had, and else the best there is. `relative_error` of the result
        says which bound holds. With the law "auto" it is beside finite elements on which the wire
        rubs; with another one beside finite elements of that law, the `fit_error` of the result.
    extrapolate : bool, default False
        Whether to continue a fitted model outside its domain: with the asymptotes in g, and with
        the nearest alpha; and kappa with the nearest load.
    law : str, default "auto"
        Which functions of the contact wear and friction follow. "projected" for Eq. (S2) of the
        paper, whose A and B take the shear stress along the cut only; "slip" for the balance of
        energy to first order in tau_w and xi, with the slip arc A* and the slip load B* in their
        place, which needs a fitted model; "coupled" for the stresses acting on the body, kappa
        times the slip law. Eq. (S2) is too small by a tenth of F_d in the far field, by a quarter
        to a half at g = 1, and by more above. "auto" takes at each point the cheapest of them
        whose error beside coupled solutions will do. Where no such solution is near, nobody knows
        that error: the law is then "projected", which an experiment is described by, with
        effective strengths tau_w and xi, and `doubts` of the result says so. The closed forms are
        of the law "projected", and so are their forces.
    outside : str, default "raise"
        What becomes of points outside the domain of a fitted model: "raise" for an error that names
        the first, "nan" for nan in their total, friction and wear, and False in `in_domain`.
    notch_radius : float, optional
        Radius of the crack's tip [m], of the law "slip" alone: where the tip touches the wire at
        alpha up to 2.5, the slip grows as it becomes sharper, and `fit_error` is known with it.
        5e-5 to 0.03 of the wire's radius, and up to 0.3/g of it. Where the tip does not touch the
        wire it does not matter. Without it the tip is that of the finite elements, 5e-4 of the
        wire's radius.

    Returns
    -------
    CuttingForce
        Total, cleavage, friction and wear [N/m], and whether the model holds.

    Raises
    ------
    InputError
        If `scene` is not a `Scene`, `rtol` not a positive number, `extrapolate` not True or False,
        `outside` or `law` of another kind, or a fitted model's file is missing or damaged.
    UnknownModelError
        If there is no such model.
    DomainError
        If alpha is outside Table 1, 2 to 9, and the model is "eq9"; if g or alpha is outside the
        domain of a fitted model, or under the law "coupled" the load outside the coupled
        solutions, and `extrapolate` is not set; or if nobody knows the slip of a tip of this
        `notch_radius` that touches the wire.
    AccuracyError
        If `rtol` is given, the model or the law is "auto" and none is as exact, or none is known
        to be; the message names the best one.

    Warns
    -----
    ImplausibleInputWarning
        If a quantity is hardly that of a soft solid's cut, such as a radius of 0.2 m.
    OtherLawWarning
        If the scene's parameters were identified under another law, with how far that moves the
        force.

    Notes
    -----
    Range of validity: >> is taken to mean a factor of 10 (`MUCH_GREATER`). Outside its range a
    closed form answers all the same, with `in_domain` False. "eq13": any. "high-toughness" and
    "eq9": Gamma_o >= 10 mu R_w and Gamma_o > 0. "low-toughness": Gamma_o <= mu R_w.
    "friction-free": xi = 0, or 10 xi <= 1 and 10 xi mu <= tau_w. Those of the fitted models are
    given by `models`. Where xi = tau_w = 0 the force is Gamma_o by any of them.

    Limits of closed forms at xi, tau_w, mu, R_w or Gamma_o = 0 are exact, at all of them together
    too; only "eq9", whose friction xi Gamma_o g^(n-1) has no limit where Gamma_o and mu R_w are
    both 0 and n > 1, is then given no friction, as for any Gamma_o = 0.

    References
    ----------
    arXiv:2412.02021, Eqs. (9), (10), (12), (13), (15) and (S2), Table 1.

    Examples
    --------
    >>> tissue = Scene(10e3, 5.0, 0.5e-3, 0.01, 1e3, 6.0)
    >>> force = cutting_force(tissue)
    >>> print(f"{force.total:.1f} N/m")
    7.2 N/m
    >>> force.law in ("slip", "coupled"), force.relative_error <= 0.02
    (True, True)

    A neo-Hookean gel that wears more than any solution with friction and wear reaches:

    >>> gel = Scene(685.0, 1.6, 0.25e-3, 0.1, 7750.0)
    >>> force = cutting_force(gel)
    >>> print(f"{force.total:.1f} N/m by the law {force.law!r}, error {force.relative_error}")
    7.3 N/m by the law 'projected', error nan
    >>> force.fit_error <= 0.02  # beside finite elements of that law
    True
    >>> force = cutting_force(gel, model="eq13")
    >>> print(f"{force.total:.4f} = {force.cleavage:.4f} + {force.friction:.4f} + {force.wear:.4f}")
    9.5785 = 1.6000 + 0.2285 + 7.7500
    >>> limit = cutting_force(gel, model="high-toughness")
    >>> print(f"{limit.total:.4f} N/m, in domain: {limit.in_domain}")
    1.7600 N/m, in domain: False
    """
    law = law_for(scene, law)
    wanted = of_law(model, law, True, notch_radius)
    force = force_of(scene, wanted, rtol, extrapolate, outside)
    warn_of_scene(scene.values())
    warn_of_other_law(scene, law, force, _by_own_law)
    return force


def warn_if_other_law(scene: Scene, model: Any, law: Any, depth: int = 4) -> None:
    """Warn where another law is asked for than the scene's parameters were identified under.

    Of functions that give no force: by how far another law moves it says how much it matters.

    Parameters
    ----------
    scene, model
        As in `cutting_force`.
    law : str
        What was asked for, after `law_for`.
    depth : int
        Whose line the warning names: 4 for that of the caller's caller.
    """
    if scene.law is not None:
        force = force_of(scene, of_law(model, law, any_law=True), extrapolate=True)
        warn_of_other_law(scene, law, force, _by_own_law, depth)


def _by_own_law(scene: Scene) -> Any:
    """Return the total under the law of the scene's parameters [N/m]."""
    return force_of(scene, of_law(AUTO, scene.law), extrapolate=True).total


def force_of(
    scene: Scene,
    model: str | ForceModel | AnyLaw = AUTO,
    rtol: float | None = None,
    extrapolate: bool = False,
    outside: str = "raise",
) -> CuttingForce:
    """Return the force under the model's own law, of scenes that nobody gave as they are.

    Examples
    --------
    >>> force_of(Scene(1.0, 1.0, 1.0), "eq13").total
    1.0
    """
    rtol = None if rtol is None else one_number(RTOL, rtol)
    extrapolate = flag("extrapolate", extrapolate)
    stays = is_nan(outside) or extrapolate
    if isinstance(model, AnyLaw):
        require_scene(scene)
        return _blanked(_lawful(scene, model, rtol, stays), scene, stays and not extrapolate)
    if is_auto(model):
        require_scene(scene)
        return _blanked(_automatic(scene, rtol, stays), scene, stays and not extrapolate)
    chosen: Any = force_model(model)
    require_scene(scene)
    values = scene.values()
    fitted = isinstance(chosen, FittedModel)
    if not fitted:
        chosen.stiffening.checked(scene.stiffening_exponent)
    total, cleavage, friction, wear, holds = _summed(
        values, chosen.evaluated, (float, float, bool), AT_ONCE if fitted else WHOLE
    )
    if fitted and not (holds is True or np.all(holds)):
        if not stays:
            require_inside(chosen, values)
            require_known_load(chosen, values)
        elif extrapolate:
            chosen.require_known(values)
    name, law = chosen.name, chosen.law
    force = _by_name(
        lambda: _errors(chosen, scene),
        *(total, cleavage, friction, wear, name, holds, name, law, law, ()),
    )
    return _blanked(force, scene, fitted and stays and not extrapolate)


def _blanked(force: CuttingForce, scene: Scene, blank: bool) -> CuttingForce:
    """Return a force with nan where its model does not hold, if that is asked for."""
    if not blank or np.all(force.in_domain):
        return force
    if not scene.shape:
        return replace(force, total=np.nan, friction=np.nan, wear=np.nan)
    for values in (force.total, force.friction, force.wear):
        np.asarray(values)[~np.asarray(force.in_domain)] = np.nan
    return force


def _summed(values: tuple[Any, ...], terms: Any, dtypes: Any, whole: int = AT_ONCE) -> Any:
    """Return total, cleavage, friction, wear, and what else a kernel of terms says of points."""
    if {*map(type, values)} == {float}:
        return _parts(terms, values)
    return apply(lambda *scene: _parts(terms, scene), values, (float, float, *dtypes), whole)


def _parts(terms: Any, scene: tuple[Any, ...]) -> tuple[Any, ...]:
    cleavage = scene[1] + 0.0  # a copy, so that no result is the caller's array
    told = terms(*scene)
    return cleavage + told[0] + told[1], cleavage, *told


@cache
def _choosing() -> Any:
    """Return what chooses, which closed forms by name do not load."""
    from surrogate.choosing import auto_law

    return auto_law


def _lawful(scene: Scene, model: AnyLaw, rtol: float | None, extrapolate: bool) -> CuttingForce:
    choosing = _choosing()
    lawful = choosing.LawfulTerms(scene.values(), rtol, named=model.named)
    if lawful.single:
        return _lawful_one(lawful, extrapolate)
    if model.named is None:
        common = choosing.common_terms(lawful.values, rtol)
        if common is not None:
            return _of_common(scene, common)
    total, cleavage, friction, wear, holds, number, law, fit, of_law = _summed(
        lawful.values, lawful, lawful.dtypes
    )
    lawful.finish(extrapolate)
    names, laws = lawful.names(number), lawful.laws(law)
    doubt = doubt_of_law(of_law != of_law)
    return _complete(
        None,
        *(total, cleavage, friction, wear, one_name(names), fit + of_law, holds, names),
        *(one_name(laws), laws, fit, of_law, () if doubt is None else (doubt,)),
    )


def _lawful_one(lawful: Any, extrapolate: bool) -> CuttingForce:
    """Do the same for a scene of numbers alone, with nothing that only arrays need."""
    total, cleavage, friction, wear, holds, number, law, fit, of_law = _parts(lawful, lawful.values)
    lawful.finish(extrapolate)
    name, law = lawful.names(number), lawful.laws(law)
    doubt = doubt_of_law(of_law != of_law)
    return _complete(
        None,
        *(total, cleavage, friction, wear, name, fit + of_law, holds, name),
        *(law, law, fit, of_law, () if doubt is None else (doubt,)),
    )


def _of_common(scene: Scene, terms: Any) -> CuttingForce:
    """Return the force of scenes that share law and model, whose errors differ."""
    total, cleavage, friction, wear, holds = _summed(scene.values(), terms, terms.dtypes)
    name, law = terms.model.name, terms.model.law
    names, laws = (np.broadcast_to(np.array(each), scene.shape) for each in (name, law))
    return _without_errors(
        lambda: _errors_of_each(scene),
        *(total, cleavage, friction, wear, name, holds, names, law, laws),
    )


def _errors_of_each(scene: Scene) -> dict[str, Any]:
    lawful = _choosing().LawfulTerms(scene.values(), None)
    *_, fit, of_law = _summed(lawful.values, lawful, lawful.dtypes)
    doubt = doubt_of_law(of_law != of_law)
    return {
        "relative_error": fit + of_law,
        "fit_error": fit,
        "law_error": of_law,
        "doubts": () if doubt is None else (doubt,),
    }


def _automatic(scene: Scene, rtol: float | None, extrapolate: bool) -> CuttingForce:
    from surrogate.choosing.candidates import OUTSIDE

    automatic = _choosing().AutomaticTerms(scene.values(), rtol)
    total, cleavage, friction, wear, holds, number, bound = _summed(
        automatic.values, automatic, automatic.dtypes
    )
    automatic.finish(extrapolate)
    names = automatic.names(number)
    return _of_projected(
        lambda: _errors(automatic.known.fitted.models[OUTSIDE], scene, bound),
        *(total, cleavage, friction, wear, one_name(names), holds, names),
        *(PROJECTED, PROJECTED, bound, ()),
    )


def _errors(model: ForceModel, scene: Scene, fit: Any = None) -> dict[str, Any]:
    """Return the errors of a force by a model of a named law, or by ones of that law."""
    if not isinstance(model, FittedModel):
        return dict.fromkeys(("relative_error", "fit_error", "law_error"))
    from surrogate.choosing.beside import fit_error, law_error

    values = scene.values()
    fit = fit_error(model, values) if fit is None else fit
    of_law = law_error(model, values)
    return {"relative_error": fit + of_law, "fit_error": fit, "law_error": of_law}

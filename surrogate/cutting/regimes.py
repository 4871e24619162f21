"""Which term of the force dominates a cut, and whether the wire touches the crack tip."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.checks import (
    ABOVE_HALF,
    FloatOrArray,
    Quantity,
    flag,
    one_number,
)
from surrogate.basics.elementwise import AT_ONCE, apply, product, ratio
from surrogate.basics.records import Record
from surrogate.choosing.by_name import AUTO, force_model, is_auto
from surrogate.choosing.laws import PROJECTED, AnyLaw, of_law
from surrogate.contact.base import ForceModel
from surrogate.cutting.believable import warn_of_scene
from surrogate.cutting.force import CuttingForce, force_of, warn_if_other_law
from surrogate.cutting.other_law import law_for
from surrogate.scene import Scene, require_scene

__all__ = [
    "CONTACTS",
    "DOMINANCES",
    "PARTS",
    "Regime",
    "classify",
    "regime_of",
    "term_shares",
    "touching_toughness",
]

TRANSITION = "transition"
DOMINANCES = (TRANSITION, "toughness-and-friction", "wear", "friction-stiffness")
"""What can dominate by Eq. (13), whose friction has one part of toughness and one of stiffness."""

PARTS = (TRANSITION, "cleavage", "friction", "wear")
"""What can dominate by other models, whose friction is one term."""

UNKNOWN = "unknown"

CONTACTS = ("far-field", "indentation")

DOMINANT_SHARE = 2.0 / 3.0
"""Share of the force from which a term dominates: twice as much as the others together."""

TOUCHING_TOUGHNESS = 1.0
"""g above which the wire touches the crack tip: J > mu R_w, below Eq. (5)."""

SPLIT_MODEL = "eq13"
"""The model whose terms are `DOMINANCES`."""

THRESHOLD = Quantity(
    "threshold", "", "give a share that only one term can have", lower=ABOVE_HALF, upper=1.0
)


@dataclass(frozen=True, slots=True, eq=False)
class Regime(Record):
    """The regime of a cut; see `classify`.

    Parameters
    ----------
    dominant : str or ndarray of str
        One of `DOMINANCES`: "toughness-and-friction", "wear", "friction-stiffness", or
        "transition" where no term dominates; one of `PARTS` for other models than Eq. (13).
    contact : str or ndarray of str
        One of `CONTACTS`: "indentation" where the wire touches the crack tip, else "far-field".
    threshold : float
        Share of the force from which a term was taken to dominate [-].
    law : str
        The law of dissipation by which terms were compared; "auto" where the cuts have several.
    laws : str or ndarray of str
        That of each cut.
    doubts : tuple of str
        What is to be doubted, in words, as in a `CuttingForce`.

    References
    ----------
    arXiv:2412.02021, sections 3 to 6.

    Examples
    --------
    >>> regime = classify(Scene(685.0, 1.6, [1e-6, 5e-5, 1e-2], wear_strength=7750.0), model="eq13")
    >>> regime.dominant.tolist()
    ['toughness-and-friction', 'transition', 'wear']
    >>> regime.contact.tolist()
    ['indentation', 'indentation', 'far-field']
    """

    dominant: str | NDArray[np.str_]
    contact: str | NDArray[np.str_]
    threshold: float
    law: str = PROJECTED
    laws: str | NDArray[np.str_] = PROJECTED
    doubts: tuple[str, ...] = ()


def classify(
    scene: Scene,
    threshold: float = DOMINANT_SHARE,
    model: str | ForceModel = AUTO,
    rtol: float | None = None,
    extrapolate: bool = False,
    law: str = AUTO,
    notch_radius: float | None = None,
    outside: str = "raise",
) -> Regime:
    """Return which term of the force dominates, and whether the wire touches the crack tip.

    Parameters
    ----------
    scene : Scene
        What is cut and with which wire, in SI units.
    threshold : float, default 2/3
        Share of the force from which a term dominates [-]: more than 0.5, so that only one can,
        up to 1. The default asks for twice as much as the other terms together.
    model : str, default "auto"
        The force model, as in `cutting_force`.
    rtol : float, optional
        Relative error of the force that has to be met with "auto" [-]; by default 0.02 where it can
        be had.
    extrapolate : bool, default False
        Whether to continue a fitted model outside its domain, as in `cutting_force`.
    law : str, default "auto"
        Which functions of the contact wear and friction follow, as in `cutting_force`; with "auto"
        each cut is classified by the law of its own force, which `laws` of the result tells.
    notch_radius : float, optional
        Radius of the crack's tip [m], with law="slip", as in `cutting_force`.
    outside : str, default "raise"
        As in `cutting_force`: "nan" for the dominant term "unknown" where the model does not hold,
        and not an error.

    Returns
    -------
    Regime
        `dominant` is "cleavage", "friction" or "wear", the parts of a `CuttingForce`, or
        "transition" where none reaches the threshold or the force is 0 or overflows. By Eq. (13),
        model "eq13", whose friction has two parts, it is "toughness-and-friction" for
        (1 + xi) Gamma_o, which the radius does not change, "wear" for 4 tau_w R_w,
        "friction-stiffness" for 4 xi mu R_w, or "transition". `contact` is "indentation" where g
        is above the model's own value at which the wire touches the crack tip, 1 for closed forms,
        and "far-field" otherwise.

    Raises
    ------
    InputError
        If `scene` is not a `Scene`, the threshold not a number above 0.5 and at most 1, `rtol` not
        a positive number, `extrapolate` not True or False, or `law` of another kind.
    UnknownModelError
        If there is no such model.
    DomainError
        If the model has no answer there.
    AccuracyError
        If the model is "auto" and none is as exact as `rtol`.

    Warns
    -----
    ImplausibleInputWarning
        If a quantity is hardly that of a soft solid's cut.

    Notes
    -----
    Range of validity: that of the model. The two answers do not depend on each other: the paper's
    gel is cut by wear while the wire indents the crack tip.

    References
    ----------
    arXiv:2412.02021, Eqs. (5) and (13), sections 4 to 6.

    Examples
    --------
    >>> regime = classify(Scene(685.0, 1.6, 0.25e-3, wear_strength=7750.0))
    >>> regime.dominant, regime.contact
    ('wear', 'indentation')
    >>> classify(Scene(685.0, 1.6, 0.05e-3, wear_strength=7750.0), model="eq13").dominant
    'transition'
    >>> share = 4 * 7750.0 * 0.25e-3 / (1.6 + 4 * 7750.0 * 0.25e-3)
    >>> print(f"{share:.3f}")
    0.829
    """
    require_scene(scene)
    share = one_number(THRESHOLD, threshold)
    extrapolate = flag("extrapolate", extrapolate)
    law = law_for(scene, law)
    warn_if_other_law(scene, model, law)
    model = of_law(model, law, True, notch_radius)
    split = isinstance(model, str) and model == SPLIT_MODEL
    force = None if split else force_of(scene, model, rtol, extrapolate, outside)
    regime = regime_of(scene, force, share, model)
    warn_of_scene(scene.values())
    if force is None or not np.any(unknown := np.isnan(force.total)):
        return regime
    dominant = np.where(unknown, UNKNOWN, regime.dominant)
    return replace(regime, dominant=dominant if dominant.ndim else str(dominant))


def regime_of(
    scene: Scene, force: CuttingForce | None, share: float, model: str | ForceModel | AnyLaw
) -> Regime:
    """Return the regime of a scene whose force by the model is known; "eq13" needs none.

    Examples
    --------
    >>> scene = Scene(685.0, 1.6, 0.25e-3, wear_strength=7750.0)
    >>> regime_of(scene, force_of(scene, "table"), 0.6, "table").dominant
    'wear'
    """
    split = model == SPLIT_MODEL
    terms: Any = (0.0, 0.0, 0.0) if split or force is None else _parts(force)
    touch = touching_toughness(model, scene.stiffening_exponent)

    def codes(mu: Any, gamma: Any, radius: Any, *others: Any) -> tuple[Any, Any]:
        xi, wear, _, touch, *parts = others
        three = _terms(mu, gamma, radius, xi, wear) if split else parts
        total = three[0] + three[1] + three[2]
        # At most one comparison holds; 0/0 and inf/inf are nan, which makes none hold.
        held = (ratio(term, total) >= share for term in three)
        dominant = sum(_times(number, holds) for number, holds in enumerate(held, start=1))
        return dominant, gamma > touch * (mu * radius)

    values = (*scene.values(), touch, *terms)
    dominant, touching = apply(codes, values, (np.int8, bool), AT_ONCE)
    names = DOMINANCES if split else PARTS
    told = () if force is None else (force.law, force.laws, force.doubts)
    return Regime(_labels(names, dominant), _labels(CONTACTS, touching), share, *told)


def term_shares(
    scene: Scene, force: CuttingForce, model: str | ForceModel | AnyLaw
) -> dict[str, FloatOrArray]:
    """Return the share of the force [-] that each term has, by the names that `classify` uses.

    The force is that of the scene by the model. A share is nan where it is 0 or overflows.

    Examples
    --------
    >>> scene = Scene(685.0, 1.6, 0.25e-3, 0.1, 7750.0)
    >>> shares = term_shares(scene, force_of(scene, "eq13"), "eq13")
    >>> {name: round(share, 4) for name, share in shares.items()}
    {'toughness-and-friction': 0.1837, 'wear': 0.8091, 'friction-stiffness': 0.0072}
    """
    split = model == SPLIT_MODEL
    names, arguments = (DOMINANCES, scene.values()) if split else (PARTS, _parts(force))

    def shares(*values: Any) -> Any:
        three = _terms(*values[:5]) if split else values
        total = three[0] + three[1] + three[2]
        return tuple(ratio(term, total) for term in three)

    found = apply(shares, arguments, (float, float, float))
    return dict(zip(names[1:], found, strict=True))


def touching_toughness(model: str | ForceModel | AnyLaw, alpha: FloatOrArray) -> FloatOrArray:
    """Return g above which the wire touches the crack tip [-]: the model's own, or else 1.

    Examples
    --------
    >>> touching_toughness("eq13", 2.0)
    1.0
    """
    contact = model.contact if isinstance(model, AnyLaw) else model
    own = getattr(force_model("table" if is_auto(contact) else contact), "touching_toughness", None)
    return TOUCHING_TOUGHNESS if own is None else own(alpha)


def _terms(mu: Any, gamma: Any, radius: Any, xi: Any, wear: Any) -> tuple[Any, Any, Any]:
    """Return the three terms of Eq. (13) [N/m]."""
    return gamma + xi * gamma, 4.0 * (wear * radius), 4.0 * product(radius, xi, mu)


def _parts(force: CuttingForce) -> tuple[FloatOrArray, FloatOrArray, FloatOrArray]:
    return force.cleavage, force.friction, force.wear


def _times(number: int, holds: Any) -> Any:
    """Return the number where something holds, else 0, in single bytes if there are many."""
    if isinstance(holds, np.ndarray):
        return holds.view(np.int8) * np.int8(number)
    return number * holds


def _labels(names: tuple[str, ...], codes: Any) -> Any:
    if isinstance(codes, np.ndarray):
        return np.array(names).take(codes, mode="clip")  # which takes less time than to index
    return names[codes]

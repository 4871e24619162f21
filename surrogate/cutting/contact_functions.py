"""The contact between wire and solid by itself: A, B and the tip's distance over (g, alpha)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from surrogate.basics.checks import (
    RTOL,
    FloatOrArray,
    Quantity,
    broadcast_shape,
    flag,
    one_number,
)
from surrogate.basics.elementwise import apply
from surrogate.basics.records import Record
from surrogate.choosing.by_name import force_model, one_name
from surrogate.contact.base import ForceModel
from surrogate.contact.domain import require_below_highest
from surrogate.errors import DomainError

__all__ = ["ContactFunctions", "contact_functions", "energy_release_rate", "scalar"]

DEFAULT_RTOL = 0.02
_FLOATS = (
    "arc",
    "normal_load",
    "delta",
    "slip_arc",
    "slip_load",
    "arc_std",
    "normal_load_std",
    "delta_std",
    "slip_arc_std",
    "slip_load_std",
)

DISTANCE = Quantity(
    "delta",
    "",
    "give the distance of the crack tip from the wire's centre over R_w, which the wire's surface "
    "keeps from falling below 1",
    lower=1.0,
)


@dataclass(frozen=True, slots=True, eq=False)
class ContactFunctions(Record):
    """What a model says about the contact between wire and solid; see `contact_functions`.

    Every quantity is a float where g and alpha are numbers, else an array of their common shape.

    Parameters
    ----------
    arc : float or ndarray
        A = cos theta_1 - cos theta_2 [-], the arc along which the solid wears.
    normal_load : float or ndarray
        B = F_v/(mu R_w T) [-], the load that friction follows.
    delta : float or ndarray
        Deformed distance of the crack tip from the wire's centre over R_w [-]; 1 from the touch on.
    arc_std, normal_load_std, delta_std : float, ndarray or None
        Standard deviations of the three [-]; None where the model has none, nan outside its domain.
    in_domain : bool or ndarray of bool
        Whether g and alpha are in the domain of the model.
    model : str
        Name of the model; "auto" where the points have several.
    chosen : str or ndarray of str
        Name of the model of each point.
    slip_arc, slip_load : float, ndarray or None
        A* = int lambda dtheta and B* = int P lambda dtheta [-], with the stretch lambda of the face
        under the contact: the arc along which it slips, and the load times the slip. To first order
        in tau_w and xi the energy balance has them in the place of A and B. Where the tip touches
        the wire they depend on the size of the tip, which is that of the finite elements' notch,
        5e-4 R_w; forces under the law "slip" take another one as `notch_radius`. None where the
        model has none, as the closed forms.
    slip_arc_std, slip_load_std : float, ndarray or None
        Standard deviations of the two [-], like the others.

    References
    ----------
    arXiv:2412.02021, Eqs. (5), (S1) and (S2).

    Examples
    --------
    >>> contact = contact_functions(10.0, 2.0, model="eq13")
    >>> print(f"{2 * contact.arc:.3f} {2 * contact.normal_load:.3f} {contact.delta:.3f}")
    4.000 14.000 1.000
    """

    arc: FloatOrArray
    normal_load: FloatOrArray
    delta: FloatOrArray
    arc_std: FloatOrArray | None
    normal_load_std: FloatOrArray | None
    delta_std: FloatOrArray | None
    in_domain: bool | NDArray[np.bool_]
    model: str
    chosen: str | NDArray[np.str_]
    slip_arc: FloatOrArray | None = None
    slip_load: FloatOrArray | None = None
    slip_arc_std: FloatOrArray | None = None
    slip_load_std: FloatOrArray | None = None


def contact_functions(
    g: ArrayLike,
    alpha: ArrayLike,
    model: str = "table",
    rtol: float | None = None,
    extrapolate: bool = False,
) -> ContactFunctions:
    """Return A, B and the distance of the crack tip, with which Eq. (S2) gives the force.

    Parameters
    ----------
    g : float or array_like
        Dimensionless toughness Gamma_o/(mu R_w) [-], finite.
    alpha : float or array_like
        Stiffening exponent [-], positive.
    model : str, default "table"
        Name of a model, see `models`; "auto" for the cheapest one that meets `rtol`.
    rtol : float, optional
        Largest relative error of A, B and delta that will do [-]; None for any, which with "auto"
        is 0.02. A* and B* do not count.
    extrapolate : bool, default False
        Whether to continue a fitted model outside its domain: with the asymptotes in g, and with
        the nearest alpha.

    Returns
    -------
    ContactFunctions
        A, B and delta/R_w, and the slip arc A* and the slip load B* [-].

    Raises
    ------
    InputError
        If an argument is out of range, if the shapes do not broadcast, or a fitted model's
        file is missing.
    AccuracyError
        If the model, or with "auto" every model, may err by more than `rtol`.
    UnknownModelError
        If there is no such model.
    DomainError
        If g or alpha is outside the domain of a fitted model and `extrapolate` is not set, or
        alpha outside Table 1 for "eq9".

    Notes
    -----
    Range of validity: that of the model, see `models`. The paper's closed forms take delta from
    Eq. (5), as max(1, g^(-1/2)).

    References
    ----------
    arXiv:2412.02021, Eqs. (5), (9), (11), (13), (S1) and (S2).

    Examples
    --------
    >>> contact = contact_functions([0.04, 4.0], 2.0, model="eq13")
    >>> print(contact.normal_load, contact.delta)
    [2.02 4.  ] [5. 1.]
    """
    extrapolate = flag("extrapolate", extrapolate)
    tolerance = None if rtol is None else one_number(RTOL, rtol)
    if isinstance(model, str) and model == "auto":
        values = _points(force_model("table"), g, alpha, extrapolate)
        return _automatic(values, DEFAULT_RTOL if tolerance is None else tolerance)
    chosen = force_model(model)
    values = _points(chosen, g, alpha, extrapolate)
    if tolerance is not None:
        from surrogate.choosing.choice import require_accuracy

        require_accuracy(chosen, *values, tolerance)
    return _evaluated(chosen, values)


def _automatic(values: tuple[Any, Any], rtol: float) -> ContactFunctions:
    """Return each point by the cheapest model that is exact enough."""
    from surrogate.choosing.auto import automatic_contact

    names, shape, found = automatic_contact(_evaluated, values, rtol)

    def together(name: str) -> Any:
        parts = [(here, getattr(each, name)) for here, each in found]
        if all(part is None for _, part in parts):
            return None
        whole = np.full(names.size, np.nan)
        for here, part in parts:
            whole[here] = np.nan if part is None else part
        return scalar(np.reshape(whole, shape))

    columns = {name: together(name) for name in _FLOATS}
    inside = np.zeros(names.size, bool)
    for here, each in found:
        inside[here] = each.in_domain
    by_point = scalar(np.reshape(names, shape))
    model = one_name(by_point)
    return ContactFunctions(
        **columns, in_domain=scalar(np.reshape(inside, shape)), model=model, chosen=by_point
    )


def scalar(values: Any) -> Any:
    """Return an array of no axes as the Python number or text that it holds.

    Examples
    --------
    >>> scalar(np.array(2.5))
    2.5
    """
    return values.item() if np.ndim(values) == 0 else values


def _points(chosen: ForceModel, g: object, alpha: object, extrapolate: bool) -> tuple[Any, Any]:
    """Return validated g and alpha that broadcast together."""
    in_g, in_alpha = chosen.accepted(extrapolate)
    values = in_g.checked(g), replace(in_alpha, name="alpha").checked(alpha)
    broadcast_shape(("g", "alpha"), values)
    if not extrapolate:
        require_below_highest(chosen, *values)
    return values


def _evaluated(chosen: ForceModel, values: tuple[Any, Any]) -> ContactFunctions:
    names = chosen.functions

    def functions(g: Any, alpha: Any) -> tuple[Any, ...]:
        return *chosen.contact(names, g, alpha), chosen.holds(g, alpha)

    def stds_of(g: Any, alpha: Any) -> tuple[Any, ...]:
        return tuple(chosen.stds(names, g, alpha))

    kinds = (float,) * len(names)
    *found, inside = apply(functions, values, (*kinds, bool))
    stds = apply(stds_of, values, kinds) if chosen.uncertain else (None,) * len(names)
    columns = dict(zip(map(_column, names), found, strict=True))
    columns.update((f"{_column(name)}_std", std) for name, std in zip(names, stds, strict=True))
    return ContactFunctions(**columns, in_domain=inside, model=chosen.name, chosen=chosen.name)


def _column(name: str) -> str:
    return "delta" if name == "distance" else name


def energy_release_rate(
    delta: ArrayLike, alpha: ArrayLike, model: str = "table", extrapolate: bool = False
) -> FloatOrArray:
    """Return the energy release rate of a crack whose tip is at a distance, Eq. (5).

    Parameters
    ----------
    delta : float or array_like
        Deformed distance of the crack tip from the wire's centre over R_w [-], more than 1.
    alpha : float or array_like
        Stiffening exponent [-], positive.
    model : str, default "table"
        Name of a model, see `models`.
    extrapolate : bool, default False
        Whether to continue a fitted model outside its domain.

    Returns
    -------
    float or ndarray
        J/(mu R_w) [-].

    Raises
    ------
    InputError
        If an argument is out of range, or the shapes do not broadcast.
    UnknownModelError
        If there is no such model.
    DomainError
        If delta is 1, where J has no single value: the tip touches the wire, and J rises while
        delta stays. Or if J or alpha is outside the domain of a fitted model and `extrapolate` is
        not set.

    Notes
    -----
    Range of validity: that of the model, see `models`.

    References
    ----------
    arXiv:2412.02021, Eq. (5) and Fig. 2c.

    Examples
    --------
    >>> print(f"{energy_release_rate(5.0, 2.0, model='eq13'):.4f}")
    0.0400
    """
    extrapolate = flag("extrapolate", extrapolate)
    chosen = force_model(model)
    _, in_alpha = chosen.accepted(extrapolate)
    values = DISTANCE.checked(delta), replace(in_alpha, name="alpha").checked(alpha)
    broadcast_shape(("delta", "alpha"), values)
    touching = np.equal(values[0], 1.0)
    if np.any(touching):
        touch = np.broadcast_to(chosen.touch(values[1]), np.broadcast(*values).shape)
        first = np.broadcast_to(touching, touch.shape).argmax()
        raise DomainError(
            "delta must be more than 1, but it is 1, where J has no single value: the tip touches "
            f"the wire from J = {touch.flat[first]:.4g} mu R_w on, and stays there while J rises; "
            "give a larger delta, or the toughness itself."
        )
    found: FloatOrArray = apply(chosen.energy_release_rate, values)
    if not extrapolate:
        replace(chosen.g, name="J/(mu R_w) at this delta").checked(_inside_digits(chosen, found))
    return found


def _inside_digits(chosen: ForceModel, g: FloatOrArray) -> FloatOrArray:
    """Return g, moved to the ends of the domain where it differs from them by rounding only."""
    for end in (chosen.g.lower, chosen.g.upper):
        near = np.abs(np.subtract(g, end)) <= 1e-9 * end
        g = np.where(near, end, g) if isinstance(g, np.ndarray) else (end if near else g)
    return g

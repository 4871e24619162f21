"""The force with its standard deviation, from those of the quantities and of the model."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from surrogate.basics.checks import (
    FloatOrArray,
    Quantity,
    broadcast_shape,
    mapping,
    one_number,
    shown,
)
from surrogate.basics.elementwise import apply, quotient
from surrogate.basics.records import Shown
from surrogate.choosing.accuracy import contact_bounds, contact_std, std_of_bound
from surrogate.choosing.by_name import AUTO
from surrogate.choosing.laws import COUPLED, PROJECTED
from surrogate.choosing.parted import parted
from surrogate.contact.base import ForceModel
from surrogate.coupling.notched import NotchedModel
from surrogate.cutting.force import force_of, warn_if_other_law
from surrogate.cutting.gradient import force_gradient
from surrogate.cutting.other_law import law_for
from surrogate.errors import InputError
from surrogate.scene import NAMES, QUANTITIES, Scene, require_scene

__all__ = ["UncertainForce", "correlation_matrix", "propagate"]

Correlations = Mapping[tuple[str, str], float]

CORRELATION = Quantity(
    "correlation", "", "give the correlation of two errors, from -1 to 1", lower=-1.0, upper=1.0
)
_STD = {
    quantity.name: replace(
        quantity,
        name=f"std of {quantity.name}",
        lower=0.0,
        remedy="give the standard error in the unit of the quantity, or leave it out where exact",
    )
    for quantity in QUANTITIES
}


@dataclass(frozen=True, slots=True, eq=False)
class UncertainForce(Shown):
    """A steady cutting force per unit thickness with its standard deviation.

    Parameters
    ----------
    total : float or ndarray
        Steady cutting force F_ss/T [N/m].
    std : float or ndarray
        Its standard deviation, from the parameters and the model together [N/m].
    contributions : mapping of str to float or ndarray
        Standard deviation that each uncertain quantity would cause alone [N/m].
    model_std : float, ndarray or None
        Standard deviation that the model's own error causes [N/m]; None for closed forms, which
        know none, which does not mean that they are exact; nan outside a fitted model's domain.
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
    >>> gel = Scene(685.0, 1.6, 0.25e-3, wear_strength=7750.0)
    >>> force = propagate(gel, {"toughness": 0.2, "wear_strength": 500.0}, "eq13")
    >>> {name: round(std, 3) for name, std in force.contributions.items()}
    {'toughness': 0.2, 'wear_strength': 0.5}
    """

    total: FloatOrArray
    std: FloatOrArray
    contributions: Mapping[str, FloatOrArray]
    model_std: FloatOrArray | None
    model: str
    law: str = PROJECTED
    laws: str | NDArray[np.str_] = PROJECTED
    doubts: tuple[str, ...] = ()


def propagate(
    scene: Scene,
    std: Mapping[str, ArrayLike],
    model: str | ForceModel = AUTO,
    rtol: float | None = None,
    extrapolate: bool = False,
    *,
    correlation: Correlations | None = None,
    law: str = AUTO,
    notch_radius: float | None = None,
    outside: str = "raise",
) -> UncertainForce:
    """Return the cutting force with its standard deviation, from those of the scene's quantities.

    To first order, with the derivatives of `force_gradient`: the variance is the sum of
    (dF/dp)^2 std(p)^2 over the quantities p, plus 2 rho (dF/dp) (dF/dq) std(p) std(q) for each
    pair of correlated ones, plus the variance of a fitted model's own A and B: those of "gp"
    itself; of the others those of an error of any size up to the measured bound, bound^2/3.

    Parameters
    ----------
    scene : Scene
        What is cut and with which wire, in SI units.
    std : mapping of str to float or array_like
        Standard error of each uncertain quantity, by its name in `Scene` and in its unit
        [Pa, J/m^2, m or -]; what is left out is taken as exact. Arrays broadcast with the scene.
    model : str, default "auto"
        As in `force_gradient`.
    rtol : float, optional
        Relative error of A and B that will do with "auto" [-]; by default 0.02 where
        a model is as exact, else that of the most exact one.
    extrapolate : bool, default False
        Whether to continue a fitted model outside its domain, as in `cutting_force`; what error
        it has there is not known, and std is nan.
    correlation : mapping of (str, str) to float, optional
        Correlation of the errors of pairs of these quantities [-]; 0 for those left out. From
        an `Identification`, that of toughness and wear strength is its `correlation`.
    law : str, default "auto"
        Which functions of the contact wear and friction follow, as in `force_gradient`. Where
        nobody knows the error of the law, `std` is without it, and `doubts` says so.
    notch_radius : float, optional
        Radius of the crack's tip [m], with law="slip", as in `cutting_force`.
    outside : str, default "raise"
        As in `cutting_force`: "nan" for nan where the model does not hold, and not an error.

    Returns
    -------
    UncertainForce
        The force, its standard deviation and what each source contributes [N/m].

    Raises
    ------
    InputError
        If `scene` is not a `Scene`, a name is not one of its quantities, a standard error is
        negative or not a number, the shapes do not broadcast, or the correlations contradict
        each other.
    UnknownModelError
        If there is no such model.
    DomainError, AccuracyError
        As `force_gradient`.

    Warns
    -----
    ImplausibleInputWarning
        If a quantity is hardly that of a soft solid's cut.

    Notes
    -----
    Range of validity: that of the model, and standard errors over which the force is close to a
    straight line. In Eq. (13) the force is linear in every quantity but for the products
    xi mu R_w, xi Gamma_o and tau_w R_w, so that only products of relative errors are left out.
    The errors of the model's A and B are taken as independent of each other.

    References
    ----------
    arXiv:2412.02021, Eqs. (13), (S1) and (S2).
    JCGM 100:2008, Guide to the expression of uncertainty in measurement, sections 4.3.7 and 5.

    Examples
    --------
    >>> gel = Scene(685.0, 1.6, 0.25e-3, wear_strength=7750.0)
    >>> errors = {"toughness": 0.2, "wear_strength": 500.0}
    >>> force = propagate(gel, errors)
    >>> print(f"{force.total:.0f} +- {force.std:.1f} N/m by the model {force.model!r}")
    7 +- 0.4 N/m by the model 'table'
    >>> force = propagate(gel, errors, "eq13")
    >>> print(f"{force.total:.3f} +- {force.std:.3f} N/m")
    9.350 +- 0.539 N/m
    >>> force = propagate(gel, errors, "eq13", correlation={("toughness", "wear_strength"): -0.9})
    >>> print(f"{force.total:.3f} +- {force.std:.3f} N/m")
    9.350 +- 0.332 N/m
    """
    require_scene(scene)
    law = law_for(scene, law)
    warn_if_other_law(scene, model, law)
    scene = replace(scene, law=None)  # which is warned of already
    by_law = parted(model, law, rtol, scene.values(), notch_radius)
    errors = _checked(std)
    rho = correlation_matrix(list(errors), {} if correlation is None else correlation)
    gradient = force_gradient(scene, model, rtol, extrapolate, law, notch_radius, outside)
    broadcast_shape(
        ("scene", *(f"std of {name}" for name in errors)),
        (np.zeros(scene.shape) if scene.shape else 0.0, *errors.values()),
    )
    signed = {name: _times(getattr(gradient, name), error) for name, error in errors.items()}
    stds = by_law.evaluate(_model_std)
    model_std = None if stds is None else stds[0]
    (total,) = by_law.evaluate(lambda one, part: (_total(one, part, extrapolate, outside),))
    return UncertainForce(
        _number(total),
        _combined(list(signed.values()), rho, model_std, scene.shape),
        {name: _number(np.abs(each)) for name, each in signed.items()},
        None if model_std is None else _number(model_std),
        gradient.model,
        gradient.law,
        gradient.laws,
        gradient.doubts,
    )


def _total(
    model: ForceModel, scene: tuple[Any, ...], extrapolate: bool, outside: str
) -> FloatOrArray:
    return force_of(Scene(*scene), model, None, extrapolate, outside).total


def _checked(std: object) -> dict[str, FloatOrArray]:
    given = mapping("std", std, "{'toughness': 0.2}")
    for name in given:
        _check_name(name, NAMES, "std")
    return {name: _STD[name].checked(given[name]) for name in NAMES if name in given}


def _check_name(name: object, names: tuple[str, ...] | list[str], where: str) -> None:
    if name not in names:
        raise InputError(
            f"{where} must name uncertain quantities of the scene, but names {shown(name)}; "
            f"choose from {', '.join(names) or 'those in std, which is empty'}."
        )


def correlation_matrix(names: list[str], correlation: object) -> NDArray[np.float64]:
    """Return the correlations of uncertain quantities as a matrix, in the order of their names.

    Raises
    ------
    InputError
        If a pair is none of these quantities, a number is beyond -1 to 1, or they contradict each
        other.

    Examples
    --------
    >>> correlation_matrix(["toughness", "wear_strength"], {("toughness", "wear_strength"): -0.5})
    array([[ 1. , -0.5],
           [-0.5,  1. ]])
    """
    rho = np.eye(len(names))
    example = "{('toughness', 'wear_strength'): -0.9}"
    for pair, value in mapping("correlation", correlation, example).items():
        if not isinstance(pair, tuple) or len(pair) != 2 or pair[0] == pair[1]:
            raise InputError(
                f"correlation must be given for pairs, but has {shown(pair)}; "
                f"give for instance {example}."
            )
        for name in pair:
            _check_name(name, names, "correlation")
        i, j = map(names.index, pair)
        rho[i, j] = rho[j, i] = one_number(CORRELATION, value)
    smallest = float(np.linalg.eigvalsh(rho).min(initial=0.0))
    if smallest < -len(names) * np.finfo(float).eps:
        raise InputError(
            "the correlations must be possible together, but they contradict each other (their "
            f"matrix has the eigenvalue {smallest:.3g}); check their signs."
        )
    return rho


def _times(slope: FloatOrArray, error: FloatOrArray) -> Any:
    """Return the change of force, 0 where the error is 0 and the slope perhaps infinite."""
    with np.errstate(all="ignore"):
        return np.where(np.equal(error, 0.0), 0.0, np.multiply(slope, error))


def _model_std(chosen: ForceModel, scene: tuple[Any, ...]) -> Any:
    """Return the force's standard deviation from those of A and B, or None where there are none."""
    mu, gamma, radius, xi, wear, alpha = scene
    with np.errstate(all="ignore"):
        g = apply(quotient, (gamma, mu, radius))
        if isinstance(chosen, NotchedModel):
            return (_of_bounds(chosen, scene, contact_bounds(chosen, g, alpha)),)
        stds = contact_std(chosen, g, alpha)
        if stds is None:
            return None
        arc, load = np.multiply(2.0 * radius, wear), np.multiply(2.0 * radius, xi) * mu
        first = np.hypot(_times(stds[0], arc), _times(stds[1], load))
        if chosen.law == COUPLED:
            first = np.hypot(*_amplified(chosen, scene, first))
        return (first + np.zeros(np.broadcast_shapes(*map(np.shape, scene))),)


def _of_bounds(chosen: NotchedModel, scene: tuple[Any, ...], measured: Any) -> Any:
    """Return the deviation of a force whose terms have a bound each, nan where that is unknown."""
    friction, wear = chosen.terms(*scene)
    stds = [
        np.where(np.isfinite(bound), std_of_bound(bound), np.nan)
        for bound in chosen.bounds_of(scene, measured)
    ]
    return np.hypot(_times(stds[0], wear), _times(stds[1], friction))


def _amplified(chosen: Any, scene: tuple[Any, ...], first: Any) -> tuple[Any, Any]:
    """Return the deviation of the first order times kappa, and that of kappa itself."""
    mu, gamma, radius, xi, wear, alpha = scene
    load = apply(quotient, (gamma, mu, radius)), alpha, xi, np.divide(wear, mu)
    kappa = np.exp(chosen.amplification.log_factor(*load))
    drag = np.add(*chosen.terms(*scene))
    return first * kappa, drag * std_of_bound(np.expm1(chosen.amplification.error(*load)))


def _combined(
    signed: list[Any], rho: NDArray[np.float64], model_std: Any, shape: tuple[int, ...]
) -> FloatOrArray:
    """Return the root of the quadratic form, in units of its largest term so as not to overflow."""
    changes = np.broadcast_arrays(*signed, 0.0 if model_std is None else model_std, np.zeros(shape))
    stacked = np.stack(changes[:-1])
    largest = np.abs(stacked).max(axis=0)
    with np.errstate(all="ignore"):
        unit = np.where(largest > 0.0, stacked / largest, 0.0)
        of_parameters = _quadratic_form(rho, unit[:-1])
        std = largest * np.sqrt(np.maximum(of_parameters, 0.0) + unit[-1] * unit[-1])
    return _number(np.where(np.isinf(largest), np.inf, std))


def _quadratic_form(matrix: NDArray[np.float64], columns: Any) -> Any:
    """Return the sum over i and j of matrix_ij columns_i columns_j, each point by itself.

    Added in one order whatever the number of points, so that no bit depends on their company.
    """
    total: Any = 0.0
    for i, one in enumerate(columns):
        total = total + one * one
        for j in range(i):
            total = total + 2.0 * matrix[i, j] * (one * columns[j])
    return total


def _number(value: Any) -> FloatOrArray:
    return np.asarray(value) if np.ndim(value) else float(value)

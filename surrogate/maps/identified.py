"""What an identification puts on a map: its cuts, and how the errors of its numbers go together."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.checks import shown
from surrogate.choosing.by_name import force_model
from surrogate.choosing.laws import PROJECTED
from surrogate.cutting.gradient import force_gradient
from surrogate.errors import InputError
from surrogate.identification.fit import Identification
from surrogate.inference.continuation import is_continued
from surrogate.scene import Scene

__all__ = ["admitted_modes", "identified_scene"]

_STATED = {
    "shear_modulus": "shear_modulus_std",
    "friction_coefficient": "friction_std",
    "stiffening_exponent": "stiffening_std",
}
_ESTIMATES = ("toughness", "wear_strength")
_UNKNOWN = " (errors unknown)"


def admitted_modes(fit: Identification) -> list[int]:
    """Return the numbers of the materials that the forces admit, the estimate first.

    Examples
    --------
    >>> from surrogate.identification.fit import identify
    >>> admitted_modes(identify([1e-4, 2e-4, 4e-4], [4.7, 7.9, 13.9], 685.0, model="eq13"))
    [0]
    """
    modes = fit.profile.modes if fit.profile is not None else ()
    return [0, *(i for i, mode in enumerate(modes) if i and mode.admitted)]


def identified_scene(
    fit: object, mode: int = 0
) -> tuple[Scene, dict[str, float], dict[tuple[str, str], float], str]:
    """Return what was cut, standard errors, their correlations and what these do not tell.

    Parameters
    ----------
    fit : Identification
        What `identify` returned.
    mode : int
        Which of the materials that it admits.

    Raises
    ------
    InputError
        If `fit` is no identification or has objections or no modulus, or does not admit the mode.

    Examples
    --------
    >>> from surrogate.identification.fit import identify
    >>> fit = identify([1e-4, 2e-4, 4e-4], [4.7, 7.9, 13.9], 685.0, model="eq13")
    >>> scene, std, correlation, remark = identified_scene(fit)
    >>> print(f"{correlation['toughness', 'wear_strength']:.2f}")
    -0.88
    """
    if not isinstance(fit, Identification):
        raise InputError(
            f"identification must be what identify returned, but is {shown(fit)}; give such a one."
        )
    _check(fit, mode)
    gamma, tau, std, rho = _estimates(fit, mode)
    scene = Scene(
        fit.shear_modulus,
        gamma,
        np.unique(fit.wire_radius),
        fit.friction_coefficient,
        tau,
        fit.stiffening_exponent,
    )
    stds = {name: getattr(fit, _STATED[name]) for name in _STATED}
    stds |= dict(zip(_ESTIMATES, std, strict=True))
    known = {name: float(value) for name, value in stds.items() if value > 0.0}  # nan is not
    pairs = {_ESTIMATES: rho, **_with_stated(fit, scene)} if mode == 0 else {_ESTIMATES: rho}
    correlation = {
        pair: value
        for pair, value in pairs.items()
        if set(pair) <= set(known) and np.isfinite(value)
    }
    return scene, known, correlation, _remark(fit, mode, std)


def _check(fit: Identification, mode: int) -> None:
    if against := next(iter(fit.objections), None):
        raise InputError(
            f"the cuts must be of an identification that may be used, but {against}; mend that "
            "first."
        )
    if "shear_modulus" in fit.assumed:
        raise InputError(
            "the cuts must be of a known shear modulus to have a place on a map, but were "
            "identified without one; identify with shear_modulus."
        )
    admitted = admitted_modes(fit)
    if isinstance(mode, bool) or mode not in admitted:
        raise InputError(
            f"mode must be one of the materials that the forces admit, {admitted}, but is "
            f"{shown(mode)}; choose one."
        )
    if not fit.is_physical:
        raise InputError(
            f"the cuts must be of a toughness and a wear strength of 0 or more, but these are "
            f"{fit.toughness:.4g} J/m2 and {fit.wear_strength:.4g} Pa; cut with thinner and "
            "thicker wires."
        )


def _estimates(fit: Identification, mode: int) -> tuple[float, float, tuple[float, float], float]:
    """Return Gamma_o, tau_w, their standard errors and correlation at a minimum of the misfit.

    Of another than the best one, those of a parabola with the interval's width: the derivatives of
    the force say little where the arc of contact turns, where such minima are.
    """
    if mode == 0 or fit.profile is None:
        errors = (fit.toughness_std, fit.wear_strength_std)
        return fit.toughness, fit.wear_strength, errors, fit.correlation
    one = fit.profile.modes[mode]
    if np.isnan(fit.profile.threshold):  # two forces, of unknown scatter
        return one.toughness, one.wear_strength, (np.nan, np.nan), np.nan
    heights = (fit.profile.threshold - one.misfit) / _variance(fit)
    gamma, tau = (
        min(pieces, key=lambda ends: max(ends[0] - value, value - ends[1]))
        for pieces, value in (
            (fit.profile.toughness_intervals, one.toughness),
            (fit.profile.wear_strength_intervals, one.wear_strength),
        )
    )
    errors = tuple(0.5 * (high - low) / np.sqrt(heights) for low, high in (gamma, tau))
    best = fit.misfit.at(np.array(gamma)).wear_strength
    with np.errstate(all="ignore"):  # nan of a wear strength that was given
        slope = np.divide(best[1] - best[0], gamma[1] - gamma[0]) * np.divide(errors[0], errors[1])
    return one.toughness, one.wear_strength, errors, float(np.clip(slope, -1.0, 1.0))


def _variance(fit: Identification) -> float:
    """Return the squared standard error of a force of weight 1, the unit of the misfit."""
    assert fit.profile is not None
    if fit.force_std is not None:
        return 1.0
    return fit.scale**2 if fit.scale else fit.profile.modes[0].misfit / fit.dof


def _with_stated(fit: Identification, scene: Scene) -> dict[tuple[str, str], float]:
    """Return how the errors of the estimates go with those stated of mu, xi and alpha.

    How much of a variance comes from each is in `contributions`; the sign is that of the shift of
    the estimates by which the forces stay what they are.
    """
    pairs = {}
    stds = dict(zip(_ESTIMATES, (fit.toughness_std, fit.wear_strength_std), strict=True))
    for name in _STATED:
        if name not in fit.contributions:
            continue
        signs = np.sign(_shift(fit, scene, name))
        for i, estimate in enumerate(_ESTIMATES):
            part, whole = fit.contributions[name][i], stds[estimate]
            if part > 0.0 and whole > 0.0:
                pairs[estimate, name] = float(signs[i] * min(part / whole, 1.0))
    return pairs


def _shift(fit: Identification, scene: Scene, name: str) -> NDArray[np.float64]:
    """Return the change of both estimates with a stated quantity, to first order."""
    continued = is_continued(force_model(fit.model))
    by_all = force_gradient(scene, fit.model, extrapolate=continued, law=PROJECTED)  # or its own
    gradient = getattr(by_all, name)
    radii, places = np.unique(fit.wire_radius, return_inverse=True)
    slopes = np.broadcast_to(gradient, radii.shape)[places.reshape(-1)] * fit.cuts.weight
    design = fit.force_slopes(fit.wire_radius) * fit.cuts.weight[:, np.newaxis]
    free = slice(0, 1 if fit.known.wear_strength is not None else 2)
    shift = np.zeros(2)
    if np.all(np.isfinite(design)) and np.all(np.isfinite(slopes)):
        shift[free] = -np.linalg.lstsq(design[:, free], slopes, rcond=None)[0]
    return shift


def _remark(fit: Identification, mode: int, std: tuple[float, float]) -> str:
    """Return what a legend has to say besides the name."""
    several = len(admitted_modes(fit))
    words = f" ({admitted_modes(fit).index(mode) + 1} of {several} materials)"
    unknown = np.isnan(std[0]) or np.isnan(std[1])
    return (words if several > 1 else "") + (_UNKNOWN if unknown else "")

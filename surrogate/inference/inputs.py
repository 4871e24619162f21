"""A series of cuts with wires of several radii, validated."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from surrogate.basics import checks
from surrogate.basics.checks import Quantity, one_number, shown
from surrogate.contact.base import ForceModel
from surrogate.errors import InputError

__all__ = [
    "FORCE",
    "FORCE_STD",
    "FRICTION_COEFFICIENT",
    "NOTHING_KNOWN",
    "PREDICTED_RADIUS",
    "SHEAR_MODULUS",
    "WIRE_DIAMETER",
    "WIRE_RADIUS",
    "Array",
    "Cuts",
    "Known",
    "column",
    "known",
    "limited",
    "series_of_cuts",
]

Array = NDArray[np.float64]

# Within these limits no square or product of a fit leaves the range of a float.
_SMALLEST, _LARGEST = 1e-30, 1e30


def limited(quantity: Quantity, smallest: float = _SMALLEST) -> Quantity:
    """Return a quantity that admits only what a fit can square and multiply.

    Examples
    --------
    >>> limited(Quantity("force", "N/m", "give a force")).upper
    1e+30
    """
    return replace(quantity, lower=smallest, upper=_LARGEST)


WIRE_RADIUS = limited(checks.WIRE_RADIUS)
PREDICTED_RADIUS = limited(checks.WIRE_RADIUS, smallest=0.0)
WIRE_DIAMETER = limited(Quantity("wire_diameter", "m", "give the wire's diameter in metres"))
FORCE = limited(
    Quantity(
        "force", "N/m", "give the steady cutting force per thickness, cutting counted positive"
    )
)
FORCE_STD = limited(Quantity("force_std", "N/m", "give the standard error of each force"))
SHEAR_MODULUS = limited(checks.SHEAR_MODULUS)
FRICTION_COEFFICIENT = limited(checks.FRICTION_COEFFICIENT, smallest=0.0)


@dataclass(frozen=True, eq=False)
class Cuts:
    """Steady forces of several cuts in one material.

    Parameters
    ----------
    wire_radius, force : ndarray, shape (n,)
        R_w [m] and F_ss/T [N/m] of each cut.
    force_std : ndarray, shape (n,), or None
        Standard error of each force [N/m].
    shear_modulus, friction_coefficient, stiffening_exponent : float
        mu [Pa], xi [-] and alpha [-] of the material.
    shear_modulus_std, friction_std, stiffening_std : float, default 0
        Their standard errors [Pa], [-], [-].
    sample : ndarray of int, shape (n,), or None
        Number of the sample that each cut was made in.
    sample_ratio : float, default 0
        Standard deviation between samples over that of the forces within one [-].
    weights : ndarray, shape (n,), or None
        One over the standard error of each force but for a common factor, where it is estimated.
    """

    wire_radius: Array
    force: Array
    force_std: Array | None
    shear_modulus: float
    friction_coefficient: float
    stiffening_exponent: float
    shear_modulus_std: float = 0.0
    friction_std: float = 0.0
    stiffening_std: float = 0.0
    sample: NDArray[np.int64] | None = None
    sample_ratio: float = 0.0
    weights: Array | None = None

    @property
    def weight(self) -> Array:
        """One over the standard error of each force [m/N], or 1 where none is known."""
        if self.weights is not None:
            return self.weights
        return np.ones_like(self.force) if self.force_std is None else 1.0 / self.force_std


def series_of_cuts(
    wire_radius: ArrayLike | None,
    wire_diameter: ArrayLike | None,
    force: ArrayLike,
    force_std: ArrayLike | None,
    material: tuple[float, float, float],
    fewest_radii: int,
    stds: tuple[float, float, float] = (0.0, 0.0, 0.0),
    sample: ArrayLike | None = None,
) -> Cuts:
    """Return a validated series of cuts.

    Parameters
    ----------
    wire_radius, wire_diameter : array_like, shape (n,), or None
        R_w or 2 R_w [m]; exactly one of them.
    force : array_like, shape (n,)
        F_ss/T [N/m].
    force_std : array_like, shape (n,) or scalar, or None
        Standard error of each force [N/m].
    material : tuple of float
        mu [Pa], xi [-] and alpha [-].
    fewest_radii : int
        Different radii that are needed.
    stds : tuple of float
        Standard errors of mu [Pa], xi [-] and alpha [-].
    sample : array_like, shape (n,), optional
        Name of the sample of each cut.

    Raises
    ------
    InputError
        If a number is out of range, the lengths differ, or there are too few radii.

    Examples
    --------
    >>> cuts = series_of_cuts(None, [2e-4, 4e-4], [4.7, 7.9], 0.1, (685.0, 0.0, 2.0), 2)
    >>> cuts.wire_radius, cuts.force_std
    (array([0.0001, 0.0002]), array([0.1, 0.1]))
    """
    radius = _radius(wire_radius, wire_diameter)
    forces = column(FORCE, force)
    std = None if force_std is None else column(FORCE_STD, force_std)
    if std is not None and std.size == 1:
        std = np.full(forces.shape, std[0])
    _check_shapes(radius, forces, std, fewest_radii)
    modulus, friction, exponent = material
    values = (
        one_number(SHEAR_MODULUS, modulus),
        one_number(FRICTION_COEFFICIENT, friction),
        one_number(checks.STIFFENING_EXPONENT, exponent),
    )
    mu_std, xi_std, alpha_std = map(one_number, _STDS, stds)
    _require_below("shear_modulus_std", "shear_modulus", values[0], mu_std)
    _require_below("stiffening_std", "stiffening_exponent", values[2], alpha_std)
    numbers = _sample(sample, forces.size)
    return Cuts(radius, forces, std, *values, mu_std, xi_std, alpha_std, numbers)


def _std(name: str, unit: str) -> Quantity:
    return Quantity(f"{name}_std", unit, "give a standard error of 0 or more", 0.0, _LARGEST)


def _is_label(label: object) -> bool:
    """Whether something can name a sample."""
    if isinstance(label, str):
        return len(label) < 1000
    return isinstance(label, (int, np.integer)) and abs(int(label)) < 10**9


def _require_below(name: str, of: str, value: float, std: float) -> None:
    if std > value:
        raise InputError(
            f"{name} must be at most {of} itself, {value:g}, but is {std:g}; "
            "give the standard error of what was measured."
        )


_STDS = (_std("shear_modulus", "Pa"), _std("friction", ""), _std("stiffening", ""))
RELATIVE_ERROR = Quantity("relative_error", "", "give 0.05 for forces known to 5 %", 1e-30, 10.0)


def _sample(names: ArrayLike | None, cuts: int) -> NDArray[np.int64] | None:
    if names is None:
        return None
    plain = names.tolist() if isinstance(names, np.ndarray) else names
    labels = checks.items("sample", plain, "['a', 'a', 'b']")
    if not all(map(_is_label, labels)):
        raise InputError("sample must hold short texts or whole numbers; give one name a cut.")
    numbers = np.unique([str(label) for label in labels], return_inverse=True)[1].reshape(-1)
    if numbers.size != cuts:
        raise InputError(
            f"sample must name the sample of each cut, but names {numbers.size} for {cuts} cuts; "
            "give one name a cut."
        )
    return None if np.unique(numbers).size < 2 else numbers.astype(np.int64)


def stated_errors(
    force: ArrayLike, force_std: ArrayLike | None, relative_error: float | None
) -> ArrayLike | None:
    """Return the standard errors of forces [N/m], or None where neither argument states them.

    Raises
    ------
    InputError
        If both are given, or the relative one is out of range.

    Examples
    --------
    >>> stated_errors([4.0, 8.0], None, 0.05)
    array([0.2, 0.4])
    """
    if relative_error is None:
        return force_std
    if force_std is not None:
        raise InputError(
            "force_std and relative_error both state the errors of the forces; give one of them."
        )
    return np.asarray(one_number(RELATIVE_ERROR, relative_error) * column(FORCE, force))


def material_of(
    model: str | ForceModel, modulus: float | None, friction: float | None, exponent: float | None
) -> tuple[float, tuple[float, float], tuple[str, ...]]:
    """Return mu, (xi, |alpha|), and the names of those that are assumed.

    In plane strain the incompressible Ogden solid has l_1 = 1/l_2, so that alpha and -alpha are
    the same solid. Eq. (13) without friction has no modulus: any will do, and 1 Pa is taken.

    Raises
    ------
    InputError
        If the modulus is missing where the forces depend on it.

    Examples
    --------
    >>> material_of("table", 685.0, None, -3.0)
    (685.0, (0.0, 3.0), ('friction_coefficient',))
    """
    values = {"friction_coefficient": friction, "stiffening_exponent": exponent}
    assumed = tuple(name for name, value in values.items() if value is None)
    xi = 0.0 if friction is None else friction
    alpha = (
        DEFAULT_STIFFENING if exponent is None else one_number(checks.STIFFENING_EXPONENT, exponent)
    )
    if modulus is not None:
        return modulus, (xi, alpha), assumed
    if model not in WITHOUT_MODULUS or xi != 0.0:
        raise InputError(
            f"the shear modulus is missing, on which model {model!r} depends; give shear_modulus, "
            "or model='eq13' without friction, which needs none."
        )
    return 1.0, (xi, alpha), ("shear_modulus", *assumed)


DEFAULT_STIFFENING = 2.0
"""Of a neo-Hookean solid."""

WITHOUT_MODULUS = ("eq13", "low-toughness", "friction-free")


def column(quantity: Quantity, values: ArrayLike) -> Array:
    """Return validated numbers as a read-only array of one axis, one number a cut.

    Examples
    --------
    >>> column(WIRE_RADIUS, 1e-4)
    array([0.0001])
    """
    numbers = np.array(quantity.checked(values), ndmin=1)  # a copy: the caller's may change
    if numbers.ndim > 1:
        raise InputError(
            f"{quantity.name} must be a list of numbers, but has the shape {numbers.shape}; "
            "give one number a cut."
        )
    numbers.flags.writeable = False
    return numbers


def _radius(wire_radius: ArrayLike | None, wire_diameter: ArrayLike | None) -> Array:
    if wire_radius is not None and wire_diameter is None:
        return column(WIRE_RADIUS, wire_radius)
    if wire_diameter is not None and wire_radius is None:
        return column(WIRE_DIAMETER, wire_diameter) / 2.0
    state = "neither is given" if wire_radius is None else "both are given"
    raise InputError(
        f"wire_radius or wire_diameter is needed, but {state}; give exactly one, and None for "
        "wire_radius where the diameter is given."
    )


def _check_shapes(radius: Array, force: Array, std: Array | None, fewest_radii: int) -> None:
    sizes = {"radii": radius.size, "forces": force.size}
    if std is not None:
        sizes["standard errors"] = std.size
    if len(set(sizes.values())) > 1:
        listed = ", ".join(f"{size} {name}" for name, size in sizes.items())
        raise InputError(f"there are {listed}; give one of each a cut.")
    if radius.size == 0:
        raise InputError("there are no measurements; give one radius and one force a cut.")
    if np.unique(radius).size < fewest_radii:
        raise InputError(
            f"one wire, of radius {radius[0]:.4g} m, cannot tell toughness from wear; "
            "cut with at least two different wires, better three."
        )


Normal = tuple[float, float]

_TOUGHNESS = limited(checks.TOUGHNESS, smallest=0.0)
_WEAR_STRENGTH = limited(checks.WEAR_STRENGTH, smallest=0.0)
TOUGHNESS_MAX = replace(
    limited(checks.TOUGHNESS),
    name="toughness_max",
    remedy="give the toughness that Gamma_o cannot exceed, for instance that of pure shear",
)


@dataclass(frozen=True)
class Known:
    """Facts besides the forces.

    Parameters
    ----------
    toughness_max : float
        Largest Gamma_o that is admitted [J/m2]; infinite where none is known.
    wear_strength : float or None
        tau_w where it is known [Pa].
    toughness_prior, wear_strength_prior : tuple of float, or None
        Mean and standard deviation of a normal distribution [J/m2], [Pa].

    Examples
    --------
    >>> Known(wear_strength=7e3, toughness_prior=(2.0, 0.5)).facts
    2
    """

    toughness_max: float = math.inf
    wear_strength: float | None = None
    toughness_prior: Normal | None = None
    wear_strength_prior: Normal | None = None

    @property
    def facts(self) -> int:
        """How many equations it adds to those of the forces."""
        given = (self.wear_strength, self.toughness_prior, self.wear_strength_prior)
        return sum(fact is not None for fact in given)


NOTHING_KNOWN = Known()


def known(
    toughness_max: object,
    wear_strength: object,
    toughness_prior: object,
    wear_strength_prior: object,
    has_std: bool,
) -> Known:
    """Return validated facts; None means that there is none.

    Raises
    ------
    InputError
        If a number is out of range, a prior is not a pair, tau_w is given twice, or a prior is
        to be weighed against forces of unknown standard error.

    Examples
    --------
    >>> known(2.6, None, None, None, has_std=False).toughness_max
    2.6
    """
    if wear_strength is not None and wear_strength_prior is not None:
        raise InputError(
            "wear_strength and wear_strength_prior must not both be given: the one says that "
            "tau_w is known, the other that it is not; give one of them."
        )
    priors = (toughness_prior, wear_strength_prior)
    if any(prior is not None for prior in priors) and not has_std:
        raise InputError(
            "a prior needs force_std: without the forces' standard errors there is no saying how "
            "much it counts beside them; give force_std, or a bound instead of the prior."
        )
    return Known(
        math.inf if toughness_max is None else one_number(TOUGHNESS_MAX, toughness_max),
        None if wear_strength is None else one_number(_WEAR_STRENGTH, wear_strength),
        _normal("toughness_prior", _TOUGHNESS, toughness_prior),
        _normal("wear_strength_prior", _WEAR_STRENGTH, wear_strength_prior),
    )


def _normal(name: str, quantity: checks.Quantity, prior: object) -> Normal | None:
    if prior is None:
        return None
    if not isinstance(prior, (tuple, list)) or len(prior) != 2:
        raise InputError(
            f"{name} must be a pair, but {name} = {shown(prior)}; give mean and standard deviation."
        )
    remedy = "give mean and standard deviation"
    mean = replace(quantity, name=f"mean of {name}", remedy=remedy)
    std = limited(replace(quantity, name=f"standard deviation of {name}", remedy=remedy))
    return one_number(mean, prior[0]), one_number(std, prior[1])

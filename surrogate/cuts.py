"""A series of cuts with wires of several radii, validated."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from surrogate import validation
from surrogate.errors import InputError
from surrogate.validation import Quantity, one_number

__all__ = [
    "FORCE",
    "FORCE_STD",
    "FRICTION_COEFFICIENT",
    "PREDICTED_RADIUS",
    "SHEAR_MODULUS",
    "WIRE_DIAMETER",
    "WIRE_RADIUS",
    "Array",
    "Cuts",
    "column",
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


WIRE_RADIUS = limited(validation.WIRE_RADIUS)
PREDICTED_RADIUS = limited(validation.WIRE_RADIUS, smallest=0.0)
WIRE_DIAMETER = limited(Quantity("wire_diameter", "m", "give the wire's diameter in metres"))
FORCE = limited(
    Quantity(
        "force", "N/m", "give the steady cutting force per thickness, cutting counted positive"
    )
)
FORCE_STD = limited(Quantity("force_std", "N/m", "give the standard error of each force"))
SHEAR_MODULUS = limited(validation.SHEAR_MODULUS)
FRICTION_COEFFICIENT = limited(validation.FRICTION_COEFFICIENT, smallest=0.0)


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
    """

    wire_radius: Array
    force: Array
    force_std: Array | None
    shear_modulus: float
    friction_coefficient: float
    stiffening_exponent: float

    @property
    def weight(self) -> Array:
        """One over the standard error of each force [m/N], or 1 where none is known."""
        return np.ones_like(self.force) if self.force_std is None else 1.0 / self.force_std


def series_of_cuts(
    wire_radius: ArrayLike | None,
    wire_diameter: ArrayLike | None,
    force: ArrayLike,
    force_std: ArrayLike | None,
    material: tuple[float, float, float],
    fewest_radii: int,
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
    return Cuts(
        radius,
        forces,
        std,
        one_number(SHEAR_MODULUS, modulus),
        one_number(FRICTION_COEFFICIENT, friction),
        one_number(validation.STIFFENING_EXPONENT, exponent),
    )


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

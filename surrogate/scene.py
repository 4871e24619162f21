"""What is cut, and with which wire."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from numpy.typing import ArrayLike

from surrogate.basics.checks import (
    FRICTION_COEFFICIENT,
    LAWS,
    SHEAR_MODULUS,
    STIFFENING_EXPONENT,
    TOUGHNESS,
    WEAR_STRENGTH,
    WIRE_RADIUS,
    FloatOrArray,
    Quantity,
    broadcast_shape,
    common_shape,
    defined,
    shown,
)
from surrogate.basics.elementwise import apply, quotient, ratio
from surrogate.basics.records import Record
from surrogate.errors import InputError

if TYPE_CHECKING:
    from surrogate.reading.material import Material

__all__ = ["Scene", "require_scene"]

QUANTITIES: tuple[Quantity, ...] = (
    SHEAR_MODULUS,
    TOUGHNESS,
    WIRE_RADIUS,
    FRICTION_COEFFICIENT,
    WEAR_STRENGTH,
    STIFFENING_EXPONENT,
)

NAMES = tuple(quantity.name for quantity in QUANTITIES)


@dataclass(frozen=True, slots=True, init=False, eq=False)
class Scene(Record):
    """A soft solid and the wire that cuts it, in SI units.

    Numbers become Python floats. Arrays become read-only copies of float64, so that a scene stays
    as it was when the caller's arrays change; what is read-only already and owns its numbers is
    kept, not copied. Arrays broadcast together. What is derived has the common shape of what it
    depends on.

    Parameters
    ----------
    shear_modulus : float or array_like
        Small-strain shear modulus mu [Pa].
    toughness : float or array_like
        Cleavage toughness Gamma_o [J/m^2].
    wire_radius : float or array_like
        Radius of the wire R_w [m]; half its diameter.
    friction_coefficient : float or array_like, default 0
        Friction coefficient xi between wire and solid [-].
    wear_strength : float or array_like, default 0
        Shear strength tau_w of interface and solid [Pa].
    stiffening_exponent : float or array_like, default 2
        Exponent alpha of the Ogden solid, Eq. (1) [-]; 2 is neo-Hookean. A negative one becomes its
        absolute value: in plane strain an incompressible solid has l_1 = 1/l_2, so that both are
        the same solid.
    law : str, optional
        The law of dissipation that toughness and wear strength were identified under,
        "projected", "slip" or "coupled"; None where they are of no law in particular. Functions
        whose law is "auto" keep to it, and warn where another is asked for.

    Raises
    ------
    InputError
        If a quantity is not a real number or an array of them, is nan, infinite or negative, or
        alpha is 0, if the shapes do not broadcast, or if there is no such law.

    References
    ----------
    arXiv:2412.02021, Eqs. (1), (4), (8), (14) and (15).

    Examples
    --------
    >>> scene = Scene(shear_modulus=685.0, toughness=1.6, wire_radius=[1e-4, 4e-4])
    >>> print(scene.dimensionless_toughness.round(4))
    [23.3577  5.8394]
    >>> print(f"{scene.elasto_cohesive_length:.4e} m")
    2.3358e-03 m
    """

    shear_modulus: FloatOrArray
    toughness: FloatOrArray
    wire_radius: FloatOrArray
    friction_coefficient: FloatOrArray
    wear_strength: FloatOrArray
    stiffening_exponent: FloatOrArray
    law: str | None

    def __init__(
        self,
        shear_modulus: ArrayLike,
        toughness: ArrayLike,
        wire_radius: ArrayLike,
        friction_coefficient: ArrayLike = 0.0,
        wear_strength: ArrayLike = 0.0,
        stiffening_exponent: ArrayLike = 2.0,
        law: str | None = None,
    ) -> None:
        given = (
            shear_modulus,
            toughness,
            wire_radius,
            friction_coefficient,
            wear_strength,
            stiffening_exponent,
        )
        for quantity, value in zip(QUANTITIES, given):  # noqa: B905 (twice the speed)
            checked = quantity.checked(value)
            if type(checked) is not float:
                checked = _frozen(checked)
            object.__setattr__(self, quantity.name, checked)
        if not all(type(value) is float for value in self.values()):
            broadcast_shape(NAMES, self.values())
        if law is not None and law not in LAWS:
            raise InputError(
                f"law must be one of {', '.join(LAWS)}, or None, but is {shown(law)}; choose one."
            )
        object.__setattr__(self, "law", law)

    def __reduce__(self) -> Any:
        return type(self), (
            *self.values(),
            self.law,
        )  # by __init__, whose arrays are read-only

    @classmethod
    def of_material(cls, material: Material, wire_radius: ArrayLike) -> Scene:
        """Return the scene of a material that was read or identified, and wires.

        Parameters
        ----------
        material : Material
            With shear modulus and toughness; unknown friction and wear are none, an unknown alpha
            is 2. A force of the scene is by the material's law.
        wire_radius : float or array_like
            R_w [m].

        Raises
        ------
        InputError
            If shear modulus or toughness is unknown.

        Examples
        --------
        >>> from surrogate import Material
        >>> gel = Material(shear_modulus=685.0, toughness=1.6, wear_strength=7750.0, law="slip")
        >>> Scene.of_material(gel, 1e-4).law
        'slip'
        """
        for name in ("shear_modulus", "toughness"):
            if getattr(material, name) is None:
                raise InputError(
                    f"a scene must have shear_modulus and toughness, but the material has no "
                    f"{name}; give it, or identify it from cuts."
                )
        return cls(
            material.shear_modulus,  # type: ignore[arg-type]
            material.toughness,  # type: ignore[arg-type]
            wire_radius,
            material.friction_coefficient or 0.0,
            material.wear_strength or 0.0,
            2.0 if material.stiffening_exponent is None else material.stiffening_exponent,
            material.law,
        )

    def values(self) -> tuple[FloatOrArray, ...]:
        """Return the six quantities in the order of the parameters."""
        return (
            self.shear_modulus,
            self.toughness,
            self.wire_radius,
            self.friction_coefficient,
            self.wear_strength,
            self.stiffening_exponent,
        )

    @property
    def shape(self) -> tuple[int, ...]:
        """Common shape of the quantities; () where all are numbers."""
        return common_shape(self.values())

    @property
    def dimensionless_toughness(self) -> FloatOrArray:
        """g = Gamma_o/(mu R_w) [-]; infinite where mu R_w = 0, a `DomainError` if 0/0."""
        g = apply(quotient, (self.toughness, self.shear_modulus, self.wire_radius))
        return defined("dimensionless_toughness", g, "give a toughness, or a modulus and a radius")

    @property
    def elasto_cohesive_length(self) -> FloatOrArray:
        """l_e = Gamma_o/mu [m]; infinite where mu = 0, a `DomainError` if 0/0."""
        length = apply(ratio, (self.toughness, self.shear_modulus))
        return defined("elasto_cohesive_length", length, "give a toughness or a modulus")

    @property
    def wear_length(self) -> FloatOrArray:
        """l_w = Gamma_o/tau_w [m]; infinite where tau_w = 0, a `DomainError` if 0/0."""
        length = apply(ratio, (self.toughness, self.wear_strength))
        return defined("wear_length", length, "give a toughness or a wear strength")


def _frozen(array: Any) -> Any:
    """Return the numbers as a read-only array that shares them with nobody who may write."""
    if array.flags.owndata and not array.flags.writeable:
        return array
    array = array.copy()
    array.flags.writeable = False
    return array


def require_scene(value: object, name: str = "scene") -> None:
    """Raise an `InputError` unless the value is a `Scene`.

    Examples
    --------
    >>> require_scene(685.0)
    Traceback (most recent call last):
        ...
    surrogate.errors.InputError: scene must be a Scene, but scene = 685.0 (float); \
give Scene(shear_modulus, toughness, wire_radius, ...).
    """
    if not isinstance(value, Scene):
        raise InputError(
            f"{name} must be a Scene, but {name} = {shown(value)} ({type(value).__name__}); "
            "give Scene(shear_modulus, toughness, wire_radius, ...)."
        )

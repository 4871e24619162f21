"""The one home of input validation: any input becomes a Python float or a float64 array.

Accepted are real numbers and whatever numpy reads as an array of integers or floats.
Scalars and 0-d arrays become Python floats, everything else a float64 array, which is the
caller's own array wherever that already is one. Refused, with an `InputError`, are booleans,
text, None, complex numbers, objects, masked arrays, ragged lists, nan, and numbers outside
the range of the quantity, infinity included unless the quantity allows it.

Every message has one shape: what must hold, where it does not and with which number and
unit, and the remedy.
"""

from __future__ import annotations

import reprlib
import sys
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from surrogate.errors import DomainError, InputError

__all__ = [
    "ABOVE_HALF",
    "FRICTION_COEFFICIENT",
    "LARGEST",
    "LAWS",
    "RTOL",
    "SHEAR_MODULUS",
    "SMALLEST",
    "STIFFENING_EXPONENT",
    "TOUGHNESS",
    "WEAR_STRENGTH",
    "WIRE_RADIUS",
    "WORK_OF_FRACTURE",
    "FloatOrArray",
    "Quantity",
    "broadcast_shape",
    "common_shape",
    "defined",
    "flag",
    "items",
    "mapping",
    "one_number",
    "shown",
    "text",
]

FloatOrArray: TypeAlias = "float | NDArray[np.float64]"

LARGEST = sys.float_info.max
SMALLEST = 5e-324  # a lower bound of SMALLEST reads as "positive"
ABOVE_HALF = 0.5 + sys.float_info.epsilon / 2.0  # and this one as "more than 0.5"
INFINITY = float("inf")


@dataclass(frozen=True, slots=True)
class Quantity:
    """A named physical quantity with its unit, the range it may take, and what to do otherwise.

    The bounds are inclusive; nan is never inside. Of an `even` quantity only the size counts: where
    a number is outside, all are taken without their signs.

    Examples
    --------
    >>> width = Quantity("width", "m", "give the width in metres", lower=SMALLEST)
    >>> width.checked(2)
    2.0
    >>> width.checked([0.5, -3.0])
    Traceback (most recent call last):
        ...
    surrogate.errors.InputError: width must be finite and positive, but width[1] = -3.0 m \
(1 of 2 values); give the width in metres.
    """

    name: str
    unit: str
    remedy: str
    lower: float = 0.0
    upper: float = LARGEST
    error: type[InputError] = InputError
    even: bool = False

    def checked(self, value: object) -> FloatOrArray:
        """Return `value` as a float or a float64 array, or raise an error that says why not."""
        if type(value) is not float:
            if type(value) is np.ndarray and value.dtype == np.float64 and value.ndim:
                return self._checked_array(value)  # as _converted would return it, only sooner
            converted = self._converted(value)
            if not isinstance(converted, float):
                return self._checked_array(converted)
            value = converted
        if not self.lower <= value <= self.upper:
            if self.even and self.lower <= abs(value) <= self.upper:
                return abs(value)
            raise self._out_of_range(f"{self.name} = {value!r}", "")
        return value

    def _converted(self, value: object) -> FloatOrArray:
        """Return `value` as a float or a float64 array, whatever its numbers."""
        if "pint" in sys.modules:
            from surrogate.basics.pint_quantities import without_units

            value = without_units(value, self.name, self.unit, self.remedy)
        array = _plain_array(value)
        if array is None or array.dtype.kind not in "iuf":
            raise self._refused(value, array)
        with np.errstate(all="ignore"):  # a wider float may overflow: infinity tells
            array = array.astype(np.float64, copy=False)
        return float(array) if array.ndim == 0 else array

    def _checked_array(self, array: NDArray[np.float64]) -> NDArray[np.float64]:
        # Extrema carry nan along and need no full-size temporary.
        if array.size and not (self.lower <= array.min() and array.max() <= self.upper):
            if self.even and array.min() < 0.0:
                return self._checked_array(np.abs(array))
            outside = ~((array >= self.lower) & (array <= self.upper))
            index = tuple(int(i) for i in np.argwhere(outside)[0])
            place = ", ".join(map(str, index))
            raise self._out_of_range(
                f"{self.name}[{place}] = {float(array[index])!r}",
                f" ({np.count_nonzero(outside)} of {array.size} values)",
            )
        return array

    def _out_of_range(self, what: str, how_many: str) -> InputError:
        unit = f" {self.unit}" if self.unit else ""
        return self.error(
            f"{self.name} must be {self._range()}, but {what}{unit}{how_many}; {self.remedy}."
        )

    def _refused(self, value: object, array: NDArray[Any] | None) -> InputError:
        kind = type(value).__name__
        if array is not None and array.ndim:
            kind += f" of {array.dtype}"
        return InputError(
            f"{self.name} must be a real number or an array of real numbers, "
            f"but {self.name} = {shown(value)} ({kind}); {self.remedy}."
        )

    def _range(self) -> str:
        limits = []
        if self.upper < INFINITY:
            limits.append("finite" if self.upper == LARGEST else f"at most {self.upper:g}")
        if self.lower > -LARGEST:
            names = {0.0: "not negative", SMALLEST: "positive", ABOVE_HALF: "more than 0.5"}
            limits.append(names.get(self.lower, f"at least {self.lower:g}"))
        return " and ".join(limits) or "a number"


def _plain_array(value: object) -> NDArray[Any] | None:
    """Return `value` as numpy reads it, or None where it reads no plain array."""
    masked = sys.modules.get("numpy.ma")  # which numpy itself may not have loaded
    if masked and isinstance(value, masked.MaskedArray):  # hidden entries have no value to use
        return None
    try:
        return np.asarray(value)
    except Exception:  # ragged lists, and whatever an object's own conversion raises
        return None


def shown(value: object) -> str:
    """Return a representation on one short line, for messages.

    Examples
    --------
    >>> shown("a model with a very long name, such as nobody would give one")
    "'a model with...ould give one'"
    """
    try:
        return " ".join(reprlib.repr(value).split())
    except Exception:  # integers of thousands of digits have none, and anything may lack one
        return "..."


def broadcast_shape(names: tuple[str, ...], values: tuple[FloatOrArray, ...]) -> tuple[int, ...]:
    """Return the common shape of checked values, or raise an `InputError` that names the shapes.

    Examples
    --------
    >>> broadcast_shape(("x", "y"), (1.0, np.zeros(3)))
    (3,)
    """
    try:
        return common_shape(values)
    except ValueError:
        shapes = map(np.shape, values)
        listed = ", ".join(f"{n} {s}" for n, s in zip(names, shapes, strict=True) if s)
        raise InputError(
            f"arguments must broadcast together, but their shapes are {listed}; "
            "give arrays of one shape, or insert axes of length 1."
        ) from None


def common_shape(values: Iterable[FloatOrArray]) -> tuple[int, ...]:
    """Return the shape that checked values broadcast to; a `ValueError` where they do not.

    Examples
    --------
    >>> common_shape((1.0, np.zeros(3), np.zeros((2, 1))))
    (2, 3)
    """
    shapes = {value.shape for value in values if type(value) is not float}  # type: ignore[union-attr]
    return shapes.pop() if len(shapes) == 1 else np.broadcast_shapes(*shapes)


def one_number(quantity: Quantity, value: object) -> float:
    """Return one validated number, or raise an error that says that one number is meant.

    Examples
    --------
    >>> one_number(WIRE_RADIUS, [1e-4, 2e-4])
    Traceback (most recent call last):
        ...
    surrogate.errors.InputError: wire_radius must be one number, but is an array of shape (2,); \
give the radius of the wire in metres.
    """
    checked = quantity.checked(value)
    if isinstance(checked, float):
        return checked
    raise InputError(
        f"{quantity.name} must be one number, but is an array of shape {checked.shape}; "
        f"{quantity.remedy}."
    )


def defined(name: str, value: FloatOrArray, remedy: str) -> FloatOrArray:
    """Return a computed value, or raise a `DomainError` where it has no limit, that is, is nan.

    Examples
    --------
    >>> defined("wear_length", 2e-4, "give a toughness")
    0.0002
    """
    if isinstance(value, float):
        if value == value:
            return value
        where = ""
    else:
        if not value.size or value.min() == value.min():
            return value
        where = f" at index [{', '.join(map(str, np.argwhere(np.isnan(value))[0]))}]"
    raise DomainError(f"{name} must be a ratio with a limit, but it is 0/0{where}; {remedy}.")


SHEAR_MODULUS = Quantity("shear_modulus", "Pa", "give the small-strain shear modulus in pascals")
TOUGHNESS = Quantity("toughness", "J/m^2", "give the cleavage toughness in joules a square metre")
WIRE_RADIUS = Quantity("wire_radius", "m", "give the radius of the wire in metres")
FRICTION_COEFFICIENT = Quantity(
    "friction_coefficient", "", "give 0 where friction is to be neglected"
)
WEAR_STRENGTH = Quantity(
    "wear_strength", "Pa", "give the shear strength in pascals, or 0 where wear is to be neglected"
)
LAWS = ("projected", "slip", "coupled")
"""Names of the laws of dissipation."""

STIFFENING_EXPONENT = Quantity(
    "stiffening_exponent",
    "",
    "give the Ogden exponent alpha, which is 2 for a neo-Hookean solid",
    lower=SMALLEST,
    even=True,
)
"""In plane strain the incompressible solid has l_1 = 1/l_2: alpha and -alpha are the same solid."""
WORK_OF_FRACTURE = Quantity(
    "work_of_fracture",
    "J/m^3",
    "give the strain energy density at tensile failure in joules a cubic metre",
)
#: Where numbers can be believed to be those of a cut, in the order of a scene [SI].
BELIEVABLE = ((1.0, 1e8), (1e-3, 1e6), (1e-6, 1e-2), (0.0, 2.0), (1.0, 1e9))
LONGEST_COHESIVE = 1.0
"""The longest Gamma_o/mu that can be believed [m]."""

RTOL = Quantity("rtol", "", "give the relative error that will do, such as 0.02", lower=SMALLEST)


def flag(name: str, value: object) -> bool:
    """Return a validated choice of yes or no, numpy's own included.

    Examples
    --------
    >>> flag("extrapolate", np.bool_(True))
    True
    >>> flag("extrapolate", "no")
    Traceback (most recent call last):
        ...
    surrogate.errors.InputError: extrapolate must be True or False, but extrapolate = 'no' (str); \
give one of them.
    """
    if value is True or value is False:
        return value
    if isinstance(value, np.bool_):
        return bool(value)
    raise _refused(name, "True or False", value, "give one of them")


def text(name: str, value: object, remedy: str) -> str:
    """Return a validated text.

    Examples
    --------
    >>> text("label", 3.0, "give the name in the legend")
    Traceback (most recent call last):
        ...
    surrogate.errors.InputError: label must be text, but label = 3.0 (float); give the name in the \
legend.
    """
    if isinstance(value, str):
        return value
    raise _refused(name, "text", value, remedy)


def mapping(name: str, value: object, example: str) -> Mapping[Any, Any]:
    """Return a validated mapping, of which the entries are not looked at.

    Examples
    --------
    >>> mapping("std", 0.2, "{'toughness': 0.2}")
    Traceback (most recent call last):
        ...
    surrogate.errors.InputError: std must be a mapping, but std = 0.2 (float); give for instance \
{'toughness': 0.2}.
    """
    if isinstance(value, Mapping):
        return value
    raise _refused(name, "a mapping", value, f"give for instance {example}")


def items(name: str, value: object, example: str) -> tuple[Any, ...]:
    """Return the entries of a list, tuple or other sequence, which are not looked at.

    A text is none, although Python would take it as a sequence of letters.

    Examples
    --------
    >>> items("limits", "eq13", "['eq13']")
    Traceback (most recent call last):
        ...
    surrogate.errors.InputError: limits must be a list, but limits = 'eq13' (str); give for \
instance ['eq13'].
    """
    if not isinstance(value, (str, bytes, Mapping)):
        try:
            return tuple(value)  # type: ignore[arg-type]
        except TypeError:
            pass
    raise _refused(name, "a list", value, f"give for instance {example}")


def _refused(name: str, what: str, value: object, remedy: str) -> InputError:
    return InputError(
        f"{name} must be {what}, but {name} = {shown(value)} ({type(value).__name__}); {remedy}."
    )

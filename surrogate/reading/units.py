"""The units that people may write at the command line and in files; inside, all is SI."""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass, field
from typing import NamedTuple

from surrogate.errors import InputError

_NUMBER = (
    r"(?P<mantissa>[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+))"
    r"(?:[eE](?P<exponent>[+-]?[0-9]{1,4}))?"
)
_PLAIN_NUMBER = re.compile(_NUMBER)
_QUANTITY = re.compile(_NUMBER + r"\s*(?P<unit>[^\W\d_].*|\".*)?", re.DOTALL)

GRAVITY = 9.80665
"""Standard gravity, by which a gram-force is what a gram weighs [m/s^2]."""


class Unit(NamedTuple):
    """A unit as a multiple of the SI unit: ten to a power, times a factor."""

    power: int = 0
    factor: float = 1.0


SI = Unit()


@dataclass(frozen=True)
class Dimension:
    """A kind of quantity, and its units as powers of ten of the SI unit or as other multiples."""

    name: str
    powers: dict[str, int]
    others: dict[str, Unit] = field(default_factory=dict)

    def unit(self, text: str) -> Unit | None:
        """Return a unit by its spelling: N/m, N_per_m, N m^-1, J/m²; None if unknown.

        Capitals matter (mN is no MN), but for those that can mean one thing only, such as MM.
        """
        spelled = _spelled(text)
        for name in (spelled, SYNONYMS.get(spelled.lower(), spelled)):
            if name in self.powers:
                return Unit(self.powers[name])
            if name in self.others:
                return self.others[name]
        return None

    @property
    def remedy(self) -> str:
        """What to write at the command line."""
        units = ", ".join((*self.powers, *self.others))
        return f"write digits with a decimal point and {f'one of {units}' if units else 'no unit'}"

    def spellings(self, quantity: str) -> str:
        """What a quantity's name may be in a file."""
        units = [unit.replace("/", "_per_") for unit in self.powers]
        return ", ".join(f"{quantity}_{unit}" if unit else quantity for unit in units)


_SUPERSCRIPTS = str.maketrans(
    {"²": "2", "³": "3", "¹": "1", "⁻": "-", "−": "-", "µ": "u", "μ": "u"}
)
_CYRILLIC = str.maketrans("мсНПакгМн", "mcNPakgMn")
"""Letters of units in Russian: мм, Н/м, кПа."""
SYNONYMS = {
    **{name: name for name in ("mm", "cm", "um", "in", "gf", "kgf", "lbf", "g", "kg", "s", "min")},
    **{"kn": "kN", "n": "N", "kpa": "kPa", "n/mm": "N/mm", "n/m": "N/m"},
    **{"kn/m": "kN/m", "n/cm": "N/cm", "gf/mm": "gf/mm", "gf/cm": "gf/cm"},
    **{"inch": "in", "inches": "in", '"': "in", "zoll": "in", "lb": "lbf", "lbs": "lbf"},
    **{"sec": "s", "sek": "s", "second": "s", "seconds": "s", "secs": "s", "sekunden": "s"},
    **{"kp": "kgf", "pond": "gf", "newton": "N", "newtons": "N", "millinewton": "mN"},
    **{"kilonewton": "kN", "gram": "g", "grams": "g", "gramm": "g", "meter": "m", "metre": "m"},
    **{"millimeter": "mm", "millimetre": "mm", "millimeters": "mm", "micron": "um"},
    **{f"{one}/sec": f"{one}/s" for one in ("mm", "cm", "m", "in")},
    **{name: name for name in ("mm/s", "mm/min", "cm/min", "in/min")},
    **{
        "mils": "mil",
        "thou": "mil",
        "dyne": "dyn",
        "dynes": "dyn",
        **{"mkm": "um", "n/m2": "Pa", "kn/m2": "kPa", "n/mm2": "MPa"},
        "dyne/cm": "dyn/cm",
    },
    **{"microns": "um", "micrometer": "um", "micrometre": "um", "minutes": "min", "msec": "ms"},
}


def _spelled(text: str) -> str:
    """Return a unit's text in one spelling: N_per_m, N m-1 and N·m⁻¹ as N/m, J/m² as J/m2."""
    text = text.strip().translate(_SUPERSCRIPTS)
    if not text.isascii():
        text = unicodedata.normalize("NFKC", text).translate(_CYRILLIC)
    text = re.sub(r"[_\s]*\bper\b[_\s]*|_per_", "/", text).replace("^", "").replace("**", "")
    text = re.sub(r"[\s·*.]*\b([a-zA-Z]+)-([123])$", _divided, text)
    return text.replace(" ", "")


def _divided(match: re.Match[str]) -> str:
    return f"/{match[1]}{match[2] if match[2] != '1' else ''}"


_STRESS_POWERS = {"Pa": 0, "kPa": 3, "MPa": 6}
_LINE_FORCE_POWERS = {"N/m": 0, "mN/m": -3, "kN/m": 3, "N/cm": 2, "N/mm": 3, "mN/mm": 0}
_SURFACE_ENERGY_POWERS = {"J/m2": 0, "mJ/m2": -3, "kJ/m2": 3}
_INCH, _POUND = 0.0254, 0.45359237 * GRAVITY
_INCHES = {"in": Unit(0, _INCH), "mil": Unit(-3, _INCH)}
_WEIGHTS = {
    "gf": Unit(-3, GRAVITY),
    "g": Unit(-3, GRAVITY),
    "kgf": Unit(0, GRAVITY),
    "kg": Unit(0, GRAVITY),
    "lbf": Unit(0, _POUND),
    "ozf": Unit(0, _POUND / 16.0),
    "dyn": Unit(-5),
}
_LINE_WEIGHTS = {
    "gf/mm": Unit(0, GRAVITY),
    "gf/cm": Unit(-1, GRAVITY),
    "kgf/m": Unit(0, GRAVITY),
    "lbf/in": Unit(0, _POUND / _INCH),
    "dyn/cm": Unit(-3),
}

LENGTH = Dimension("a length", {"m": 0, "cm": -2, "mm": -3, "um": -6, "nm": -9}, _INCHES)
FORCE = Dimension("a force", {"N": 0, "mN": -3, "uN": -6, "cN": -2, "kN": 3}, _WEIGHTS)
TIME = Dimension("a time", {"s": 0, "ms": -3}, {"min": Unit(0, 60.0), "h": Unit(0, 3600.0)})
_MINUTE = 1.0 / 60.0
SPEED = Dimension(
    "a speed",
    {"m/s": 0, "cm/s": -2, "mm/s": -3, "um/s": -6},
    {
        "m/min": Unit(0, _MINUTE),
        "cm/min": Unit(-2, _MINUTE),
        "mm/min": Unit(-3, _MINUTE),
        "um/min": Unit(-6, _MINUTE),
        "in/s": Unit(0, _INCH),
        "in/min": Unit(0, _INCH * _MINUTE),
    },
)
STRESS = Dimension("a stress", _STRESS_POWERS)
LINE_FORCE = Dimension(
    "a force per thickness", _LINE_FORCE_POWERS | _SURFACE_ENERGY_POWERS, _LINE_WEIGHTS
)
TOUGHNESS = Dimension("a toughness", _SURFACE_ENERGY_POWERS | _LINE_FORCE_POWERS)
ENERGY_DENSITY = Dimension(
    "an energy per volume", {"J/m3": 0, "kJ/m3": 3, "MJ/m3": 6} | _STRESS_POWERS
)
NUMBER = Dimension("a plain number", {"": 0})


def parse_number(text: str, unit: Unit = SI) -> float | None:
    """Read a decimal number times a unit, a power of ten rounded once; None if it is not a number.

    Parameters
    ----------
    text : str
        Digits with a decimal point, optionally a sign and an exponent.
    unit : Unit, optional
        What to multiply with.

    Returns
    -------
    float or None
        The value; inf where the number is too large for a float.

    Examples
    --------
    >>> parse_number("0.21", Unit(-3))
    0.00021
    >>> parse_number("0,21") is None
    True
    """
    match = _PLAIN_NUMBER.fullmatch(text)
    return _scaled(match, unit) if match else None


def parse_quantity(text: str, dimension: Dimension) -> float:
    """Read a number with its unit; a number alone is in SI units.

    Parameters
    ----------
    text : str
        For instance ``0.2mm``, ``7.75 kPa``, ``1.6 J/m^2`` or ``2e-4``.
    dimension : Dimension
        What kind of quantity it is.

    Returns
    -------
    float
        The value in the SI unit of `dimension`.

    Raises
    ------
    InputError
        If the text is not a number with one of the dimension's units.

    Examples
    --------
    >>> parse_quantity("0.2mm", LENGTH)
    0.0002
    """
    match = _QUANTITY.fullmatch(text.strip())
    unit = dimension.unit(match["unit"]) if match and match["unit"] else SI
    if match is None and text.strip() and dimension.unit(text):
        unit_alone = text.strip()
        raise InputError(
            f"{text!r} is a unit without its number; write both as one, such as 1.5{unit_alone}."
        )
    if match is None or unit is None:
        raise InputError(f"{text!r} is not {dimension.name}; {dimension.remedy}.")
    return _scaled(match, unit)


def _scaled(match: re.Match[str], unit: Unit) -> float:
    value = float(f"{match['mantissa']}e{int(match['exponent'] or 0) + unit.power}")
    return value * unit.factor


def quantity_and_unit(place: str, name: str, quantities: dict[str, Dimension]) -> tuple[str, Unit]:
    """Split a name such as wire_radius_mm into its quantity and its unit."""
    if not name:
        raise InputError(f"{place} has no name; name its quantity and unit, or delete it.")
    for quantity in sorted(quantities, key=len, reverse=True):
        if name == quantity or name.startswith(quantity + "_"):
            unit = quantities[quantity].unit(name[len(quantity) + 1 :])
            if unit is not None:
                return quantity, unit
            raise InputError(
                f"{place} ({name}) does not end with a unit of {quantity}; "
                f"write {quantities[quantity].spellings(quantity)}."
            )
    raise InputError(
        f"{place} ({name!r}) is not known; write one of {', '.join(quantities)} and its unit, "
        f"such as {next(iter(quantities.values())).spellings(next(iter(quantities)))}."
    )

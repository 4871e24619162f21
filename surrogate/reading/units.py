"""The units that people may write at the command line and in files; inside, all is SI."""

from __future__ import annotations

import re
from dataclasses import dataclass

from surrogate.errors import InputError

_NUMBER = (
    r"(?P<mantissa>[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+))"
    r"(?:[eE](?P<exponent>[+-]?[0-9]{1,4}))?"
)
_PLAIN_NUMBER = re.compile(_NUMBER)
_QUANTITY = re.compile(_NUMBER + r"\s*(?P<unit>[^\W\d_].*)?", re.DOTALL)


@dataclass(frozen=True)
class Dimension:
    """A kind of quantity, and its units as powers of ten of the SI unit."""

    name: str
    powers: dict[str, int]

    def power(self, unit: str) -> int | None:
        """Power of ten of a unit, written as N/m or N_per_m, J/m2 or J/m^2; None if unknown."""
        return self.powers.get(unit.replace("_per_", "/").replace("^", ""))

    @property
    def remedy(self) -> str:
        """What to write at the command line."""
        units = ", ".join(unit for unit in self.powers if unit.isascii())
        return f"write digits with a decimal point and {f'one of {units}' if units else 'no unit'}"

    def spellings(self, quantity: str) -> str:
        """What a quantity's name may be in a file."""
        units = [unit.replace("/", "_per_") for unit in self.powers if unit.isascii()]
        return ", ".join(f"{quantity}_{unit}" if unit else quantity for unit in units)


_STRESS_POWERS = {"Pa": 0, "kPa": 3, "MPa": 6}
_LINE_FORCE_POWERS = {"N/m": 0, "mN/m": -3, "kN/m": 3, "N/cm": 2, "N/mm": 3, "mN/mm": 0}
_SURFACE_ENERGY_POWERS = {"J/m2": 0, "mJ/m2": -3, "kJ/m2": 3}

LENGTH = Dimension("a length", {"m": 0, "cm": -2, "mm": -3, "um": -6, "µm": -6, "μm": -6})
STRESS = Dimension("a stress", _STRESS_POWERS)
LINE_FORCE = Dimension("a force per thickness", _LINE_FORCE_POWERS | _SURFACE_ENERGY_POWERS)
TOUGHNESS = Dimension("a toughness", _SURFACE_ENERGY_POWERS | _LINE_FORCE_POWERS)
ENERGY_DENSITY = Dimension(
    "an energy per volume", {"J/m3": 0, "kJ/m3": 3, "MJ/m3": 6} | _STRESS_POWERS
)
NUMBER = Dimension("a plain number", {"": 0})


def parse_number(text: str, power: int = 0) -> float | None:
    """Read a decimal number times a power of ten, rounded once; None if it is not a number.

    Parameters
    ----------
    text : str
        Digits with a decimal point, optionally a sign and an exponent.
    power : int, default 0
        Power of ten to multiply with.

    Returns
    -------
    float or None
        The value; inf where the number is too large for a float.

    Examples
    --------
    >>> parse_number("0.21", -3)
    0.00021
    >>> parse_number("0,21") is None
    True
    """
    match = _PLAIN_NUMBER.fullmatch(text)
    return _scaled(match, power) if match else None


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
    power = dimension.power(match["unit"]) if match and match["unit"] else 0
    if match is None or power is None:
        raise InputError(f"{text!r} is not {dimension.name}; {dimension.remedy}.")
    return _scaled(match, power)


def _scaled(match: re.Match[str], power: int) -> float:
    return float(f"{match['mantissa']}e{int(match['exponent'] or 0) + power}")


def quantity_and_power(place: str, name: str, quantities: dict[str, Dimension]) -> tuple[str, int]:
    """Split a name such as wire_radius_mm into its quantity and its unit's power of ten."""
    if not name:
        raise InputError(f"{place} has no name; name its quantity and unit, or delete it.")
    for quantity in sorted(quantities, key=len, reverse=True):
        if name == quantity or name.startswith(quantity + "_"):
            unit = name[len(quantity) + 1 :]
            power = quantities[quantity].power(unit)
            if power is not None:
                return quantity, power
            raise InputError(
                f"{place} ({name}) does not end with a unit of {quantity}; "
                f"write {quantities[quantity].spellings(quantity)}."
            )
    raise InputError(
        f"{place} ({name!r}) is not known; write one of {', '.join(quantities)} and its unit, "
        f"such as {next(iter(quantities.values())).spellings(next(iter(quantities)))}."
    )

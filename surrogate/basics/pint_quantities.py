"""Quantities of pint, where a caller uses it, as plain numbers in the units that are used here.

Nothing here imports pint: a quantity of pint can only be met where the caller has imported it.
"""

from __future__ import annotations

import sys
from typing import Any

from surrogate.errors import InputError

__all__ = ["without_units"]


def without_units(value: Any, name: str, unit: str, remedy: str) -> Any:
    """Return a value with every quantity of pint in it as a number in a unit.

    Parameters
    ----------
    value : object
        A quantity, a list or tuple that may hold some, or anything else, which comes back as it is.
    name, unit, remedy : str
        Of what is wanted, for the message; the unit is empty for a number without one.

    Returns
    -------
    object
        Numbers where there were quantities.

    Raises
    ------
    InputError
        If a quantity has another dimension.

    Examples
    --------
    >>> import pint
    >>> without_units(0.2 * pint.UnitRegistry().mm, "wire_radius", "m", "")
    0.0002
    """
    pint = sys.modules.get("pint")
    if pint is None:
        return value
    if isinstance(value, pint.Quantity):
        try:
            return value.to(unit or "dimensionless").magnitude
        except pint.PintError:
            wanted = f"a quantity in {unit}" if unit else "a number without unit"
            raise InputError(
                f"{name} must be {wanted}, but is in {value.units}; {remedy}."
            ) from None
    if type(value) in (list, tuple):
        return [without_units(one, name, unit, remedy) for one in value]
    return value

"""The properties of a material in a JSON file whose names carry the units."""

from __future__ import annotations

import json
from dataclasses import dataclass
from os import PathLike
from typing import Any

import numpy as np

from surrogate.basics.checks import LAWS
from surrogate.basics.files import file_name, opened
from surrogate.errors import InputError
from surrogate.reading import plausibility
from surrogate.reading.plausibility import doubts
from surrogate.reading.units import (
    ENERGY_DENSITY,
    NUMBER,
    STRESS,
    TOUGHNESS,
    Dimension,
    parse_number,
    quantity_and_unit,
)

__all__ = ["Material", "read_material"]

_LARGEST_MATERIAL_FILE = 100_000
_MATERIAL_SCHEMA = "wirecut-material-1"

PROPERTIES: dict[str, Dimension] = {
    "shear_modulus": STRESS,
    "shear_modulus_std": STRESS,
    "pure_shear_toughness": TOUGHNESS,
    "pure_shear_toughness_std": TOUGHNESS,
    "work_of_fracture": ENERGY_DENSITY,
    "work_of_fracture_std": ENERGY_DENSITY,
    "friction_coefficient": NUMBER,
    "stiffening_exponent": NUMBER,
    "toughness": TOUGHNESS,
    "toughness_std": TOUGHNESS,
    "wear_strength": STRESS,
    "wear_strength_std": STRESS,
}
"""Quantities that a file of material properties may hold."""

_SI = {STRESS.name: "Pa", TOUGHNESS.name: "J_per_m2", ENERGY_DENSITY.name: "J_per_m3"}


@dataclass(frozen=True)
class Material:
    """Properties of a gel, by other tests and as identified from cuts; None where unknown.

    Parameters
    ----------
    shear_modulus, shear_modulus_std : float or None
        mu and its standard error [Pa].
    pure_shear_toughness, pure_shear_toughness_std : float or None
        Gamma from a fracture test, cleavage and process zone together [J/m2].
    work_of_fracture, work_of_fracture_std : float or None
        W_f, energy density at failure in uniaxial tension [J/m3].
    friction_coefficient : float or None
        xi [-].
    stiffening_exponent : float or None
        alpha of the Ogden solid, Eq. (1) [-].
    toughness, toughness_std : float or None
        Gamma_o as identified from cuts, and its standard error [J/m2].
    wear_strength, wear_strength_std : float or None
        tau_w as identified from cuts, and its standard error [Pa].
    law : str or None
        The law of dissipation that these two were identified under, "projected", "slip" or
        "coupled".

    Examples
    --------
    >>> Material(shear_modulus=685.0, shear_modulus_std=30.0).shear_modulus_std
    30.0
    """

    shear_modulus: float | None = None
    shear_modulus_std: float | None = None
    pure_shear_toughness: float | None = None
    pure_shear_toughness_std: float | None = None
    work_of_fracture: float | None = None
    work_of_fracture_std: float | None = None
    friction_coefficient: float | None = None
    stiffening_exponent: float | None = None
    toughness: float | None = None
    toughness_std: float | None = None
    wear_strength: float | None = None
    wear_strength_std: float | None = None
    law: str | None = None

    def to_json(self, name: str = "", source: str = "") -> str:
        """Return the content of a file that `read_material` reads, in SI units.

        Examples
        --------
        >>> print(Material(shear_modulus=685.0, law="slip").to_json("a gel"))
        {
         "schema": "wirecut-material-1",
         "name": "a gel",
         "shear_modulus_Pa": 685.0,
         "law": "slip"
        }
        """
        told: dict[str, Any] = {"schema": _MATERIAL_SCHEMA, "name": name, "source": source}
        for quantity, dimension in PROPERTIES.items():
            unit = _SI.get(dimension.name, "")
            told[f"{quantity}_{unit}" if unit else quantity] = getattr(self, quantity)
        told["law"] = self.law
        return json.dumps({k: each for k, each in told.items() if each not in (None, "")}, indent=1)

    @property
    def warnings(self) -> tuple[str, ...]:
        """What can hardly be meant, in words: see `surrogate.reading.plausibility`."""
        return tuple(
            sentence
            for quantity, value in (
                (plausibility.SHEAR_MODULUS, self.shear_modulus),
                (plausibility.TOUGHNESS, self.pure_shear_toughness),
                (plausibility.WORK_OF_FRACTURE, self.work_of_fracture),
                (plausibility.TOUGHNESS, self.toughness),
            )
            if value is not None
            for sentence in doubts(quantity, value)
        )


def read_material(path: str | PathLike[str]) -> Material:
    """Read material properties from a JSON file whose keys name quantity and unit.

    Keys are ``schema`` ("wirecut-material-1"), ``name`` and ``source`` (text), and any of
    ``shear_modulus_<unit>``, ``pure_shear_toughness_<unit>``, ``work_of_fracture_<unit>``,
    ``toughness_<unit>``, ``wear_strength_<unit>``, each with ``..._std_<unit>``,
    ``friction_coefficient``, ``stiffening_exponent``, whose sign plays no part, and ``law``, under
    which toughness and wear strength were identified.

    Parameters
    ----------
    path : str or path-like
        The file.

    Returns
    -------
    Material
        The properties in SI units.

    Raises
    ------
    InputError
        If the file cannot be read, is not such a JSON object, or holds an unknown or repeated
        key or a value that is not a number of 0 or more.

    Examples
    --------
    >>> from surrogate.basics.files import model_file
    >>> material = read_material(model_file("paam-material.json"))
    >>> material.shear_modulus, material.work_of_fracture
    (685.0, 6973.0)
    """
    file = file_name(path)
    properties: dict[str, Any] = {}
    for key, value in _read_json_object(file):
        if key in ("name", "source"):
            continue
        if key == "schema":
            if value != _MATERIAL_SCHEMA:
                raise InputError(
                    f"{file}: schema is {value!r} where only {_MATERIAL_SCHEMA!r} is known."
                )
            continue
        if key == "law":
            if isinstance(value, _Literal) or value not in LAWS:
                raise InputError(
                    f"{file}, key (law): {value!r:.40} is not one of {', '.join(LAWS)}; write one."
                )
            if "law" in properties:
                raise InputError(f"{file}, key (law) gives the law again; keep one of them.")
            properties["law"] = value
            continue
        quantity, unit = quantity_and_unit(f"{file}, key", key, PROPERTIES)
        if quantity in properties:
            raise InputError(f"{file}, key ({key}) gives {quantity} again; keep one of them.")
        number = parse_number(value, unit) if isinstance(value, _Literal) else None
        if quantity == "stiffening_exponent" and number is not None:
            number = abs(number)  # in plane strain alpha and -alpha are the same solid
        if number is None or not 0.0 <= number < np.inf:
            raise InputError(
                f"{file}, key ({key}): {value!r:.40} is not a number of 0 or more; "
                "write digits without quotes."
            )
        properties[quantity] = number
    return Material(**properties)


class _Literal(str):
    """A JSON number as it is written, so that the unit's power joins before rounding."""


def _read_json_object(file: str) -> list[tuple[str, Any]]:
    with opened(file) as stream:
        raw = stream.read(_LARGEST_MATERIAL_FILE)
    try:
        pairs = json.loads(
            raw.decode("utf-8-sig"),
            parse_int=_Literal,
            parse_float=_Literal,
            object_pairs_hook=list,
        )
    except (ValueError, RecursionError) as error:
        raise InputError(f"{file} is not JSON ({error}); see models/paam-material.json.") from None
    if not isinstance(pairs, list) or not all(isinstance(pair, tuple) for pair in pairs):
        raise InputError(f"{file} is not a JSON object; write {{...}} with one key a property.")
    return pairs

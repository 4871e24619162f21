"""Measurements out of tables whose names carry the units."""

from __future__ import annotations

from array import array
from collections.abc import Iterator
from dataclasses import dataclass, field
from os import PathLike
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.files import file_name, opened
from surrogate.errors import InputError
from surrogate.reading import plausibility
from surrogate.reading.plausibility import doubts
from surrogate.reading.units import (
    LENGTH,
    LINE_FORCE,
    Dimension,
    parse_number,
    quantity_and_power,
)

__all__ = ["Measurements", "read_measurements"]

_LONGEST_LINE = 10_000

COLUMNS: dict[str, Dimension] = {
    "wire_radius": LENGTH,
    "wire_diameter": LENGTH,
    "force_per_thickness": LINE_FORCE,
    "force_std": LINE_FORCE,
}
"""Quantities that a table of measurements may hold, one column each."""


@dataclass(frozen=True, eq=False)
class Measurements:
    """Steady-state cutting forces measured with wires of several radii.

    Parameters
    ----------
    wire_radius : ndarray, shape (n,)
        R_w [m].
    force : ndarray, shape (n,)
        F_ss/T [N/m].
    force_std : ndarray, shape (n,), or None
        Standard error of each force [N/m].

    Examples
    --------
    >>> cuts = Measurements(np.array([1e-4, 4e-4]), np.array([4.7, 13.9]))
    >>> cuts.force_std is None
    True
    """

    wire_radius: NDArray[np.float64]
    force: NDArray[np.float64]
    force_std: NDArray[np.float64] | None = None

    @property
    def warnings(self) -> tuple[str, ...]:
        """What can hardly be meant, in words: see `surrogate.reading.plausibility`."""
        return (
            *doubts(plausibility.RADIUS, self.wire_radius),
            *doubts(plausibility.FORCE, self.force),
        )


def read_measurements(path: str | PathLike[str]) -> Measurements:
    """Read a table of measurements from a CSV file.

    The header names quantity and unit of each column: ``wire_radius_<unit>`` or
    ``wire_diameter_<unit>`` (one of the two; m, cm, mm, um), ``force_per_thickness_<unit>``
    and, where known, its standard error ``force_std_<unit>`` (N_per_m, mN_per_m, kN_per_m,
    N_per_cm, N_per_mm, mN_per_mm, J_per_m2, ...). Values are separated by commas and are
    positive numbers with a decimal point. Lines that are empty or start with ``#`` are skipped.

    Parameters
    ----------
    path : str or path-like
        The file, UTF-8 text with or without a byte-order mark.

    Returns
    -------
    Measurements
        The columns in SI units, a diameter as the radius that it names.

    Raises
    ------
    InputError
        If the file cannot be read or anything in it is missing, twice there, unknown or not a
        positive number; the message names file, line and column and says what to mend.

    Examples
    --------
    >>> from surrogate.basics.files import model_file
    >>> measurements = read_measurements(model_file("paam-wire-cutting.csv"))
    >>> print(measurements.wire_radius)
    [0.000125 0.00021  0.000275 0.00039  0.00047 ]
    >>> print(measurements.force)
    [ 5.475  8.11  10.125 13.69  16.17 ]
    """
    file = file_name(path)
    with opened(file) as stream:
        columns = _read_table(file, stream)
    radius = columns.get("wire_radius")
    if radius is None:
        radius = columns["wire_diameter"] / 2.0
    return Measurements(radius, columns["force_per_thickness"], columns.get("force_std"))


@dataclass(frozen=True)
class _Column:
    """One column of an open table: how to name it in errors, read it, and what it holds."""

    number: int
    name: str
    quantity: str
    power: int
    values: array[float] = field(default_factory=lambda: array("d"))


def _read_table(file: str, stream: BinaryIO) -> dict[str, NDArray[np.float64]]:
    rows = _rows(file, stream)
    first = next(rows, None)
    if first is None:
        raise InputError(
            f"{file} is empty; write a header such as "
            "wire_radius_mm,force_per_thickness_N_per_m and one line a wire."
        )
    header_line, names = first
    columns = _read_header(f"{file}, line {header_line}", names)
    for line, cells in rows:
        if len(cells) != len(columns):
            values = "1 value" if len(cells) == 1 else f"{len(cells)} values"
            raise InputError(
                f"{file}, line {line} has {values} where the header names {len(columns)} columns; "
                "give one a column, with a decimal point where there is a decimal comma."
            )
        for column, cell in zip(columns, cells, strict=True):
            value = parse_number(cell, column.power)
            if value is None or not 0.0 < value < np.inf:
                place = f"{file}, line {line}, column {column.number} ({column.name})"
                raise _refused(place, column.quantity, cell, value)
            column.values.append(value)
    if not columns[0].values:
        raise InputError(
            f"{file}, line {header_line} is a header without measurements; write one line a wire."
        )
    return {column.quantity: np.array(column.values) for column in columns}


def _rows(file: str, stream: BinaryIO) -> Iterator[tuple[int, list[str]]]:
    """Yield line number and cells, one bounded line in memory at a time."""
    line = 0
    while raw := stream.readline(_LONGEST_LINE):
        line += 1
        place = f"{file}, line {line}"
        if len(raw) == _LONGEST_LINE:
            raise InputError(f"{place} has {_LONGEST_LINE} characters or more; is it a CSV table?")
        try:
            text = raw.decode("utf-8-sig" if line == 1 else "utf-8").strip()
        except UnicodeDecodeError as error:
            raise InputError(
                f"{place}, byte {error.start + 1} is not UTF-8 text; save the table as 'CSV UTF-8'."
            ) from None
        if not text or text.lstrip('"').startswith("#"):
            continue
        for mark, name in ((";", "semicolon"), ("\t", "tab")):
            if mark in text:
                raise InputError(
                    f"{place}, character {text.index(mark) + 1} is a {name}; separate columns by "
                    "commas and write decimals with a point."
                )
        yield line, [_unquoted(cell) for cell in text.split(",")]


def _unquoted(cell: str) -> str:
    cell = cell.strip()
    return cell[1:-1].strip() if len(cell) > 1 and cell[0] == cell[-1] == '"' else cell


def _read_header(place: str, names: list[str]) -> list[_Column]:
    columns: dict[str, _Column] = {}
    for number, name in enumerate(names, start=1):
        quantity, power = quantity_and_power(f"{place}, column {number}", name, COLUMNS)
        if quantity in columns:
            raise InputError(
                f"{place}, column {number} ({name}) gives {quantity} again after column "
                f"{columns[quantity].number} ({columns[quantity].name}); keep one of them."
            )
        columns[quantity] = _Column(number, name, quantity, power)
    if ("wire_radius" in columns) == ("wire_diameter" in columns):
        state = "both a radius and a diameter" if "wire_radius" in columns else "no wire radius"
        raise InputError(f"{place} names {state}; keep wire_radius_<unit> or wire_diameter_<unit>.")
    if "force_per_thickness" not in columns:
        raise InputError(
            f"{place} names no force_per_thickness_<unit>; divide the steady force by the "
            "sample's thickness and give it in one of the units N_per_m, mN_per_mm, J_per_m2."
        )
    return list(columns.values())


_REMEDIES = {
    "force_per_thickness": "turn the sign if your machine counts compression as negative",
    "force_std": "delete the column where standard errors are not known",
}


def _refused(place: str, quantity: str, cell: str, value: float | None) -> InputError:
    if not cell:
        return InputError(f"{place} is empty; fill the gap or delete the line.")
    if value is None:
        return InputError(
            f"{place}: {cell[:40]!r} is not a number; write digits with a decimal point."
        )
    return InputError(
        f"{place}: {cell[:40]} is not a positive number within a computer's range; "
        f"{_REMEDIES.get(quantity, 'correct it or delete the line')}."
    )

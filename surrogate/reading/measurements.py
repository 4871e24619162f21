"""Measurements out of tables, as laboratories have them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.checks import SMALLEST, Quantity, one_number, text
from surrogate.errors import InputError
from surrogate.reading import plausibility
from surrogate.reading.headings import Heading
from surrogate.reading.plausibility import doubts
from surrogate.reading.sheet import EMPTY, Row, Sheet, read_sheets
from surrogate.reading.wire_table import Table, find_table, has_table
from surrogate.reading.words.wire_words import COLUMNS

__all__ = ["COLUMNS", "Measurements", "read_measurements"]

THICKNESS = Quantity("thickness", "m", "give the sample's thickness in metres", lower=SMALLEST)

AGREE = 0.02
"""How far a force over its thickness may be from the force per thickness beside it."""


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
    samples : tuple of str, length n, or None
        Name of the sample that each was measured on, where the table has such a column.
    notes : tuple of str
        What of the table was not used or how it was taken, in words.
    gels : tuple of str, length n, or None
        Name of the gel that each is of, where a column was named that tells it.

    Examples
    --------
    >>> cuts = Measurements(np.array([1e-4, 4e-4]), np.array([4.7, 13.9]))
    >>> cuts.force_std is None
    True
    """

    wire_radius: NDArray[np.float64]
    force: NDArray[np.float64]
    force_std: NDArray[np.float64] | None = None
    samples: tuple[str, ...] | None = None
    notes: tuple[str, ...] = ()
    gels: tuple[str, ...] | None = None

    def of_each_gel(self) -> dict[str, Measurements]:
        """Return the measurements of each gel by its name, in the order of the table.

        Examples
        --------
        >>> cuts = Measurements(np.array([1e-4, 4e-4]), np.array([4.7, 13.9]), gels=("B", "A"))
        >>> {name: gel.force.tolist() for name, gel in cuts.of_each_gel().items()}
        {'B': [4.7], 'A': [13.9]}
        """
        names = self.gels or ("",) * self.force.size
        apart = {}
        for name in dict.fromkeys(names):
            of = np.array([each == name for each in names])
            rows = np.flatnonzero(of).tolist()
            apart[name] = Measurements(
                self.wire_radius[of],
                self.force[of],
                None if self.force_std is None else self.force_std[of],
                None if self.samples is None else tuple(self.samples[i] for i in rows),
            )
        return apart

    @property
    def warnings(self) -> tuple[str, ...]:
        """What can hardly be meant, in words: see `surrogate.reading.plausibility`."""
        return (
            *doubts(plausibility.RADIUS, self.wire_radius),
            *doubts(plausibility.FORCE, self.force),
        )


def read_measurements(
    path: Any,
    thickness: float | None = None,
    *,
    decimal: str | None = None,
    delimiter: str | None = None,
    encoding: str | None = None,
    by: str | None = None,
) -> Measurements:
    """Read a table of measurements from a text file, a spreadsheet or a data frame.

    The header names quantity and unit of each column: ``wire_radius_<unit>`` or
    ``wire_diameter_<unit>`` (m, cm, mm, um, in), ``force_per_thickness_<unit>`` (N_per_m,
    mN_per_mm, J_per_m2, ...) or ``force_<unit>`` (N, mN, gf, ...) with ``thickness_<unit>``,
    and, where known, the force's standard error ``force_std_<unit>``. Capitals, blanks, units in
    brackets or in a row below the names, and usual names such as ``d (mm)`` and ``F_ss/T [N/m]``
    are understood. Repeats stand in rows, or in columns that are numbered (``trial1_N_per_m``).
    Cells may hold a unit, or an error behind ±. A standard deviation beside a column n, the number
    of cuts, becomes the standard error of their mean. Columns that are not known are not used, and
    rows without a radius or a force, or that begin with a word such as Mean, are skipped; the
    `notes` name them. Lines that are empty or start with ``#`` are left out.

    Parameters
    ----------
    path : str, path-like or pandas.DataFrame
        Text with commas, semicolons or tabs, in UTF-8, UTF-16 or CP1252; or .xlsx, of which the
        first sheet that has such a table is read; or a data frame.
    thickness : float, optional
        Thickness of the sample [m], where forces are not divided by it and no column has it.
    decimal, delimiter, encoding : str, optional
        Those of a text file; by default they are read off it.
    by : str, optional
        Name of the column that names the gel of each row, where a table is of several; see
        `Measurements.of_each_gel`.

    Returns
    -------
    Measurements
        The columns in SI units, a diameter as the radius that it names.

    Raises
    ------
    InputError
        If the file cannot be read or anything in it is missing, twice there, ambiguous or not a
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
    if thickness is not None:
        thickness = one_number(THICKNESS, thickness)
    if by is not None:
        text("by", by, "give the name of the column that names the gels")
    sheets = read_sheets(path, encoding, delimiter, decimal)
    return _measurements(*find_table(_with_table(sheets), by), thickness)


def _with_table(sheets: list[Sheet]) -> Sheet:
    """Return the first sheet that holds a table of measurements; of none, the first."""
    first = next(filter(has_table, sheets), sheets[0])
    return first.beside([one for one in sheets if one is not first])


def _measurements(sheet: Sheet, table: Table, thickness: float | None) -> Measurements:
    reader = _Reader(sheet, table, thickness)
    lines = [line for row in table.rows for line in reader.lines(row)]
    if not lines:
        raise InputError(
            f"{sheet.place(table.header)} is a header without measurements; "
            f"write one line a wire{'; ' + reader.skipped[0] if reader.skipped else ''}."
        )
    radius, force, std, samples, gels = zip(*lines, strict=True)
    different = tuple(dict.fromkeys(samples))
    notes = [*table.notes, *reader.skipped]
    if table.sample is not None and len(different) > 1 and "" in different:
        column = f"column {table.sample + 1} ({table.header.cells[table.sample]})"
        raise InputError(
            f"{sheet.file}, {column} is empty in some lines; write the name of the sample in each "
            "(merged cells have it in their first alone), or in none."
        )
    if table.sample is not None and len(different) > 1:
        column = table.header.cells[table.sample]
        notes.append(
            f"{sheet.file}: {len(different)} samples of one gel together: {', '.join(different)}; "
            f"where each is a gel of its own, say so by --by {column!r}"
        )
    return Measurements(
        np.array(radius),
        np.array(force),
        np.array(std) if reader.std else None,
        samples if table.sample is not None else None,
        tuple(notes),
        gels if table.gel is not None else None,
    )


class _Reader:
    """Reads the lines of a table; what it skips is named in `skipped`."""

    def __init__(self, sheet: Sheet, table: Table, thickness: float | None) -> None:
        self.sheet, self.table, self.option = sheet, table, thickness
        self.skipped: list[str] = []
        columns = table.columns
        self.wire = (columns.get("wire_radius") or columns["wire_diameter"])[0]
        self.forces = columns.get("force_per_thickness") or columns["force"]
        self.std = next((columns[q][0] for q in ("force_std", "total_std") if q in columns), None)
        self.last = max(one.number for listed in columns.values() for one in listed)
        if self.std and len(self.forces) > 1:
            table.notes.append(f"{sheet.file}: not used beside several trials: {self.std}")
            self.std = None
        elif self.std and table.count is not None:
            table.notes.append(
                f"{sheet.file}: {self.std} is the scatter of cuts, and divided by the square root "
                f"of their number in column {table.count + 1} ({table.header.cells[table.count]})"
            )
        elif self.std and "std" not in self.std.name:
            table.notes.append(
                f"{sheet.file}: {self.std} is taken for the standard error of each force; what is "
                "the scatter of m cuts must be divided by the square root of m"
            )
        if "force_per_thickness" in columns and "force" in columns and "thickness" not in columns:
            unused = ", ".join(map(str, columns["force"]))
            table.notes.append(f"{sheet.file}: not used beside force per thickness: {unused}")

    def lines(self, row: Row) -> Iterator[tuple[float, float, float, str, str]]:
        """Yield radius, force, its standard error, sample and gel of each force in a row."""
        row = self._whole(row)
        if not any(row.cells[one.number - 1] for one in (self.wire, *self.forces)):
            self._skip(row, self.wire, "has neither a wire nor a force")
            return
        radius = self._positive(row, self.wire)
        if self.wire.quantity == "wire_diameter" and radius is not None:
            radius /= 2.0
        sample = row.cells[self.table.sample] if self.table.sample is not None else ""
        std = self._standard_error(row) if self.std else np.inf
        for one in self.forces:
            force = self._over_thickness(row, one)
            if radius is None or force is None or std is None:
                gap = self.wire if radius is None else one if force is None else self.std
                self._skip(row, gap, "is empty")
            else:
                self._compare(row, force)
                yield radius, force, std, sample, self._gel(row)

    def _gel(self, row: Row) -> str:
        if self.table.gel is None:
            return ""
        name = row.cells[self.table.gel].strip()
        if not name:
            raise InputError(
                f"{self.sheet.place(row)}, column {self.table.gel + 1} "
                f"({self.table.header.cells[self.table.gel]}) is empty; write the name of the gel "
                "in each line (merged cells have it in their first alone)."
            )
        return name

    def _standard_error(self, row: Row) -> float | None:
        assert self.std is not None
        std = self._over_thickness(row, self.std)
        if std is None or self.table.count is None:
            return std
        cell = row.cells[self.table.count]
        number = self.sheet.number(cell)
        if number is None or not 1.0 <= number < np.inf:
            raise InputError(
                f"{self.sheet.place(row)}, column {self.table.count + 1} "
                f"({self.table.header.cells[self.table.count]}): {cell[:40]!r} is no number of "
                "cuts; correct it or delete the column."
            )
        return float(std / np.sqrt(number))

    def _whole(self, row: Row) -> Row:
        width, cells = self.table.width, row.cells
        if len(cells) < self.last or any(cells[width:]):
            values = "1 value" if len(cells) == 1 else f"{len(cells)} values"
            raise InputError(
                f"{self.sheet.place(row)} has {values} where the header names {width} columns; "
                "give one a column, and where commas separate columns no decimal comma."
            )
        return Row(row.line, cells + [""] * (width - len(cells)))

    def _skip(self, row: Row, gap: Heading | None, why: str) -> None:
        where = f", {gap}" if why == "is empty" else ""
        self.skipped.append(f"{self.sheet.place(row)}{where} {why}: skipped")

    def _over_thickness(self, row: Row, one: Heading) -> float | None:
        value = self._positive(row, one)
        if value is None or one.quantity in ("force_per_thickness", "force_std"):
            return value
        return value / self._thickness(row, one)

    def _thickness(self, row: Row, one: Heading) -> float:
        columns = self.table.columns.get("thickness")
        stated = self._positive(row, columns[0]) if columns else None
        if stated is None and self.table.thickness and not columns:
            stated = self.table.thickness[0]
        if stated is None and self.option is None:
            raise InputError(
                f"{self.sheet.place(row)}, {one} is a force, and the sample's thickness is "
                "missing; give it with --thickness 20mm (thickness= in Python), or in a column "
                f"thickness_mm{self._unused()}."
            )
        if stated is not None and self.option is not None and stated != self.option:
            raise InputError(
                f"{self.sheet.place(row)}: the table says that the sample is {1e3 * stated:g} mm "
                f"thick, and the option {1e3 * self.option:g} mm; leave the option out or correct "
                "one of them."
            )
        return stated if stated is not None else self.option or np.nan

    def _unused(self) -> str:
        """Return the columns that are not used: one of them may be what is missing."""
        names = [note.partition("not used: ")[2] for note in self.table.notes]
        names = [name for name in names if name]
        return f" (not used: {', '.join(names)})" if names else ""

    def _compare(self, row: Row, force: float) -> None:
        """Refuse a force over its thickness that is not the force per thickness beside it."""
        columns = self.table.columns
        if "force_per_thickness" not in columns or not {"force", "thickness"} <= set(columns):
            return
        if len(columns["force"]) > 1 or len(self.forces) > 1:
            return
        other = self._over_thickness(row, columns["force"][0])
        if other is not None and abs(other - force) > AGREE * force:
            raise InputError(
                f"{self.sheet.place(row)} gives {force:g} N/m, but its force over its thickness is "
                f"{other:g} N/m; correct one of them or delete the column."
            )

    def _positive(self, row: Row, one: Heading) -> float | None:
        """Return a cell in SI units, None where it is empty, or raise an error with its place."""
        cell = row.cells[one.number - 1]
        if cell.casefold() in EMPTY:
            return None
        assert one.unit is not None
        value = self.sheet.number(cell, one.unit)
        place = f"{self.sheet.place(row)}, {one}"
        if value is None:
            sign = "point" if self.sheet.decimal == "." else "comma"
            raise InputError(
                f"{place}: {cell[:40]!r} is not a number; write digits with a decimal {sign}."
            )
        if not 0.0 < value < np.inf:
            raise InputError(
                f"{place}: {cell[:40]} is not a positive number within a computer's range; "
                f"{_REMEDIES.get(one.quantity, 'correct it or delete the line')}."
            )
        return value


_REMEDIES = {
    "force_per_thickness": "turn the sign if your machine counts compression as negative",
    "force": "turn the sign if your machine counts compression as negative",
    "force_std": "delete the column where standard errors are not known",
    "total_std": "delete the column where standard errors are not known",
}

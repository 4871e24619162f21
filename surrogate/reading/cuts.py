"""From the records of many cuts to steady forces per thickness, one row a cut."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from os import PathLike
from typing import Any

import numpy as np

from surrogate.basics.checks import SMALLEST, Quantity, one_number
from surrogate.basics.files import file_name
from surrogate.errors import InputError
from surrogate.reading.measurements import Measurements
from surrogate.reading.plateau import SteadyForce, steady_force
from surrogate.reading.records import CutRecord, read_records
from surrogate.reading.wires import Wire

__all__ = ["Cut", "cuts_of", "measurements_of", "record_files"]

ENDINGS = (".csv", ".txt", ".tsv", ".dat", ".asc", ".tra", ".xlsx", ".xlsm")
"""Of files in a folder that are taken as records."""

AGREE = 0.01
"""By how much two statements of a thickness may differ."""

_THICKNESS = Quantity("thickness", "m", "give the sample's thickness in metres", SMALLEST, 1e30)


@dataclass(frozen=True, eq=False)
class Cut:
    """One record and what became of it; a reason where it gave no steady force.

    Parameters
    ----------
    file : str
        Where it is from.
    specimen : int
        Which one of the file, from 1.
    record : CutRecord or None
        Displacement and force.
    steady : SteadyForce or None
        The steady force.
    wire : Wire or None
        The wire, where it is known.
    thickness : float or None
        Of the sample [m].
    reason : str
        Why there is no steady force or no wire; empty where there is.
    notes : tuple of str
        What to look at.
    """

    file: str
    specimen: int = 1
    record: CutRecord | None = None
    steady: SteadyForce | None = None
    wire: Wire | None = None
    thickness: float | None = None
    reason: str = ""
    notes: tuple[str, ...] = ()

    @property
    def force_per_thickness(self) -> float:
        """F_ss/T [N/m]; nan where it is not known."""
        if self.steady is None or self.thickness is None:
            return float("nan")
        return self.steady.mean / self.thickness


OWN_TABLES = (b"# steady forces by wirecut", b"# identification by ")
"""How tables begin that the commands write: they may lie beside the records, and are none."""


def record_files(
    paths: Sequence[str | PathLike[str]], besides: Sequence[str | None] = ()
) -> tuple[list[str], list[str]]:
    """Return the files of records and, of folders among the paths, what is passed over.

    Parameters
    ----------
    paths : sequence of str or path-like
        Files, and folders of them.
    besides : sequence of str or None
        Files in these folders that are read as something else, such as the table of wires.

    Raises
    ------
    InputError
        If there is no file.
    """
    files: list[str] = []
    over: list[str] = []
    other = {os.path.realpath(name) for name in besides if name}
    for path in map(file_name, paths):
        if not os.path.isdir(path):
            files.append(path)
            continue
        for name in _listed(path):
            full = os.path.join(path, name)
            if os.path.realpath(full) in other:
                continue
            is_record = name.lower().endswith(ENDINGS) and not _is_own_table(full)
            (files if is_record else over).append(full)
    if not files:
        raise InputError(
            f"{', '.join(map(file_name, paths))}: no record with one of the endings "
            f"{' '.join(ENDINGS)}; give files, or the folder that holds them."
        )
    return files, over


def _is_own_table(file: str) -> bool:
    try:
        with open(file, "rb") as stream:
            return stream.read(100).startswith(OWN_TABLES)
    except OSError:
        return False


def _listed(folder: str) -> list[str]:
    try:
        names = sorted(os.listdir(folder))
    except OSError as error:
        raise InputError(f"{folder} cannot be read ({error.strerror}); give another.") from None
    return [
        name
        for name in names
        if not name.startswith((".", "~$")) and os.path.isfile(os.path.join(folder, name))
    ]


def cuts_of(
    files: Sequence[str],
    wire_of: Callable[[str, int], Wire] | None = None,
    thickness: float | None = None,
    plateau: dict[str, Any] | None = None,
    **reading: Any,
) -> list[Cut]:
    """Read records and take their steady forces; what fails is a row with its reason.

    Parameters
    ----------
    files : sequence of str
        The records.
    wire_of : callable, optional
        Finds the wire of a file and specimen, see `surrogate.reading.wires`.
    thickness : float, optional
        Of all samples [m]; by default what the file's name, the table of wires or the file tells.
    plateau : dict, optional
        Options of `steady_force`.
    **reading
        Options of `read_records`.

    Raises
    ------
    InputError
        If no record at all gives a steady force; it is the reason of the first.
    """
    common = None if thickness is None else one_number(_THICKNESS, thickness)
    cuts = [
        cut for file in files for cut in _of_file(file, wire_of, common, plateau or {}, reading)
    ]
    if all(cut.steady is None for cut in cuts):
        more = f" (and {len(cuts) - 1} more)" if len(cuts) > 1 else ""
        raise InputError(f"{cuts[0].reason}{more}")
    return cuts


def _of_file(
    file: str,
    wire_of: Callable[[str, int], Wire] | None,
    thickness: float | None,
    plateau: dict[str, Any],
    reading: dict[str, Any],
) -> Iterator[Cut]:
    try:
        records = read_records(file, **reading)
    except InputError as error:
        yield Cut(file, reason=str(error))
        return
    for record in records:
        wire = None
        steady = None
        reason = ""
        try:
            steady = steady_force(record.displacement, record.force, **plateau)
            wire = wire_of(file, record.specimen) if wire_of else None
        except InputError as error:
            reason = str(error) if str(error).startswith(file) else f"{file}: {error}"
        size, notes = _thickness(thickness, wire, record)
        said = (*record.notes, *notes, *(steady.warnings if steady else ()))
        yield Cut(file, record.specimen, record, steady, wire, size, reason, said)


def _thickness(
    common: float | None, wire: Wire | None, record: CutRecord
) -> tuple[float | None, list[str]]:
    """Return the thickness by the first that tells it, and what contradicts it."""
    told = [
        (words, value)
        for words, value in (
            ("--thickness", common),
            ("the name or table of wires", wire.thickness if wire else None),
            ("the file", record.thickness),
        )
        if value is not None
    ]
    if not told:
        return None, []
    words, size = told[0]
    against = [
        f"the thickness is {1e3 * size:.4g} mm by {words}, but {1e3 * value:.4g} mm by {other}"
        for other, value in told[1:]
        if abs(value - size) > AGREE * size
    ]
    return size, against


def measurements_of(cuts: Sequence[Cut]) -> Measurements:
    """Return the steady forces per thickness as `identify` takes them, repeats as they are.

    Raises
    ------
    InputError
        If the wire or the thickness of a steady force is not known, or it is not positive.
    """
    kept = [cut for cut in cuts if cut.steady is not None]
    for cut in kept:
        _check_whole(cut)
    samples = tuple(cut.wire.sample for cut in kept if cut.wire)
    notes = [
        f"{len(kept)} of {len(cuts)} records have a steady force",
        *(f"left out: {cut.reason}" for cut in cuts if cut.steady is None),
    ]
    return Measurements(
        np.array([cut.wire.radius for cut in kept if cut.wire]),
        np.array([cut.force_per_thickness for cut in kept]),
        samples=samples if any(samples) else None,
        notes=tuple(notes),
    )


def _check_whole(cut: Cut) -> None:
    place = f"{cut.file}, specimen {cut.specimen}"
    if cut.wire is None:
        raise InputError(
            cut.reason
            or f"{place}: the wire is not known; give --name 'wire_{{diameter}}mm_{{trial}}', as "
            "the files are named, or a table by --wires."
        )
    if cut.thickness is None:
        raise InputError(f"{place}: the sample's thickness is not known; give --thickness.")
    if not cut.force_per_thickness > 0.0:
        raise InputError(
            f"{place}: the steady force is {cut.force_per_thickness:.3g} N/m, not positive; "
            "correct the tare, or say how the file counts it (--sign)."
        )

"""The rows of the campaign with friction and wear as one HDF5 file, with units and evidence."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fe_training.campaign.dataset import require_checksum
from fe_training.campaign.store import write_atomically
from fe_training.coupled.design import CoupledDesign
from fe_training.coupled.store import CoupledStore
from fe_training.sliding.record import SlidingOutcome, SlidingRecord
from surrogate.basics.files import checksum_line, file_name
from surrogate.errors import InputError

_SCHEMA = "wirecut-coupled-data-1"

#: Unit and description of each column.
COLUMNS: dict[str, tuple[str, str]] = {
    "alpha": ("-", "strain-stiffening exponent"),
    "target": ("-", "wanted g = J/(mu R_w)"),
    "target_friction": ("-", "wanted coefficient of friction xi"),
    "target_wear": ("-", "wanted tau_w/mu"),
    "outcome": ("-", "how the computation ended, a name of SlidingOutcome"),
    "reason": ("-", "why the load was not reached, else empty"),
    "friction": ("-", "xi of the numbers in this row: of the last equilibrium where it ended"),
    "wear": ("-", "tau_w/mu of the numbers in this row"),
    "ramp": ("mu", "pressure over which wear rises at the ends of the contact"),
    "energy_release_rate": ("mu R_w", "J of the whole body"),
    "steady_force": ("mu R_w", "F_ss per thickness, both halves"),
    "slip_power": ("mu R_w", "2 int tau lambda ds"),
    "first_arc": ("-", "A* of the frictionless configuration at this g on this mesh"),
    "first_load": ("-", "B* of the frictionless configuration at this g on this mesh"),
    "theta_1": ("rad", "front end of the contact arc, from the cutting direction"),
    "theta_2": ("rad", "rear end of the contact arc"),
    "horizontal_force": ("mu R_w", "normal forces along the cut, half model"),
    "vertical_force": ("mu R_w", "normal forces that open the cut, half model"),
    "slip_arc": ("-", "int lambda dtheta of this configuration"),
    "slip_load": ("-", "int P lambda dtheta of this configuration"),
    "distance": ("R_w", "deformed distance from the wire's centre to the tip"),
    "insertion": ("R_w", "wire's centre relative to the tip's reference position"),
    "energy_release_rate_across": ("mu R_w", "J on wider supports, nearest first; nan pads"),
    "least_stretch": ("-", "smallest stretch of the crack face beyond the notch"),
    "least_stretch_angle": ("rad", "where it is, about the wire's centre"),
    "position_rate": ("mu", "dJ/dx_w at a constant load; a limit point of the load makes it 0"),
    "touches_tip": ("-", "whether the wire touches the tip"),
    "touches_plane": ("-", "whether the crack face touches the symmetry plane"),
    "grazing": ("-", "nodes that touch without pressure, with a part of tau_w"),
    "pull": ("-", "largest pull on a node held to the wire, relative to the contact force"),
    "residual": ("-", "residual relative to the contact force"),
    "iterations": ("-", "Newton iterations of the last step"),
    "steps": ("-", "steps of the load since the frictionless configuration"),
    "min_determinant": ("-", "smallest det F beyond the notch"),
    "max_stretch": ("-", "largest principal stretch"),
    "notch_radius": ("R_w", "radius of the notch at the tip"),
    "unknowns": ("-", "free unknowns"),
    "mesh_error": ("-", "relative difference of kappa from a finer mesh; nan if not made"),
    "processor_time": ("s", "processor time since the row before"),
    "base": ("-", "number of the base in the design"),
    "held_out": ("-", "whether no fit sees the row"),
}


@dataclass(frozen=True, slots=True, eq=False)
class CoupledData:
    """The rows as columns.

    Parameters
    ----------
    columns : dict of str to ndarray
        See :data:`COLUMNS`.
    attributes : dict of str to str
        Schema, design and software.
    """

    columns: Mapping[str, NDArray[Any]]
    attributes: Mapping[str, str]

    def __getitem__(self, name: str) -> NDArray[Any]:
        return self.columns[name]

    def __len__(self) -> int:
        return len(self.columns["alpha"])

    @property
    def amplification(self) -> NDArray[np.float64]:
        """kappa: tau_w/mu times A* and xi times B* over what they are without load [-].

        See `SlidingRecord.amplification`.
        """
        first = self["wear"] * self["first_arc"] + self["friction"] * self["first_load"]
        drag = self["wear"] * self["slip_arc"] + self["friction"] * self["slip_load"]
        ratio = np.divide(drag, first, out=np.ones_like(drag), where=first > 0.0)
        return np.asarray(ratio)

    @property
    def balance_error(self) -> NDArray[np.float64]:
        """|F_ss - J - 2 int tau lambda ds| / F_ss [-]."""
        force = self["steady_force"]
        error = np.abs(force - self["energy_release_rate"] - self["slip_power"])
        return np.asarray(error / force)

    @property
    def converged(self) -> NDArray[np.bool_]:
        """Rows at the load that was wanted with all evidence within its bounds.

        And with the whole of tau_w wherever there is contact.
        """
        return np.asarray((self["outcome"] == SlidingOutcome.CONVERGED.name) & ~self.tapered)

    @property
    def tapered(self) -> NDArray[np.bool_]:
        """Rows in which wear rises over some pressure at the ends of the contact."""
        return np.asarray(self["ramp"] > 0.0)


def collected(
    design: CoupledDesign, store: CoupledStore, finer: CoupledStore | None = None
) -> CoupledData:
    """Return the rows that a store has of a design, failed ones included.

    Parameters
    ----------
    design : CoupledDesign
    store : CoupledStore
        The rows of the campaign.
    finer : CoupledStore, optional
        Some of them on a finer mesh, for the column ``mesh_error``.
    """
    records: list[SlidingRecord] = []
    bases: list[tuple[int, bool]] = []
    software: list[str] = []
    for base in design.all_bases():
        rows = store.read(base)
        for record in rows.records if rows is not None else ():
            records.append(record)
            bases.append((base.number, base.held_out))
        if rows is not None:
            software.append(json.dumps(dict(rows.software), sort_keys=True))
    columns: dict[str, NDArray[Any]] = {
        field.name: _column([getattr(record, field.name) for record in records])
        for field in fields(SlidingRecord)
        if field.name in COLUMNS
    }
    if finer is not None:
        columns["mesh_error"] = _mesh_errors(records, [n for n, _ in bases], design, finer)
    columns["base"] = np.array([number for number, _ in bases], dtype=np.int64)
    columns["held_out"] = np.array([held for _, held in bases], dtype=bool)
    attributes = {
        "schema": _SCHEMA,
        "design": design.hash,
        "software": json.dumps(sorted(set(software))),
    }
    return CoupledData(columns, attributes)


def _mesh_errors(
    records: list[SlidingRecord], numbers: list[int], design: CoupledDesign, finer: CoupledStore
) -> NDArray[np.float64]:
    """Return how far kappa is from that of the finer mesh, relatively; nan where there is none."""
    again = {}
    for base in design.all_bases():
        rows = finer.read(base)
        for record in rows.records if rows else ():
            if record.outcome is SlidingOutcome.CONVERGED:
                again[base.number, record.friction, record.wear] = record.amplification
    errors = np.full(len(records), np.nan)
    for i, (record, number) in enumerate(zip(records, numbers, strict=True)):
        other = again.get((number, record.friction, record.wear))
        if other is not None and record.outcome is SlidingOutcome.CONVERGED:
            errors[i] = abs(record.amplification / other - 1.0)
    return errors


def _column(values: list[Any]) -> NDArray[Any]:
    if values and isinstance(values[0], SlidingOutcome):
        return np.array([value.name for value in values])
    if values and isinstance(values[0], tuple):
        padded = np.full((len(values), max(map(len, values))), np.nan)
        for row, value in zip(padded, values, strict=True):
            row[: len(value)] = value
        return padded
    return np.array(values)


def write_coupled(data: CoupledData, path: str | os.PathLike[str]) -> None:
    """Write the rows to an HDF5 file, whole or not at all, and its checksum beside it.

    The same rows make the same bytes.
    """
    import h5py

    with TemporaryDirectory() as folder:
        draft = Path(folder) / "data.h5"
        with h5py.File(draft, "w", track_order=True) as file:
            file.attrs.update(data.attributes)
            for name, (unit, description) in COLUMNS.items():
                values = data[name]
                kind = h5py.string_dtype() if values.dtype.kind == "U" else values.dtype
                column = file.create_dataset(
                    name,
                    data=values.astype(object) if values.dtype.kind == "U" else values,
                    dtype=kind,
                    compression="gzip",
                    shuffle=True,
                    track_times=False,
                )
                column.attrs.update({"unit": unit, "description": description})
        content = draft.read_bytes()
    name = os.path.basename(os.fspath(path))
    write_atomically(Path(path), content)
    write_atomically(Path(f"{os.fspath(path)}.sha256"), checksum_line(name, content))


def read_coupled(path: str | os.PathLike[str]) -> CoupledData:
    """Return the rows of a file.

    Raises
    ------
    InputError
        If the file cannot be read, is not what its checksum says, or is no such data set.
    """
    import h5py

    require_checksum(Path(path))
    try:
        with h5py.File(path, "r") as file:
            attributes = {name: str(value) for name, value in file.attrs.items()}
            if attributes.get("schema") != _SCHEMA:
                raise InputError(
                    f"{file_name(path)} is no data set of a campaign with friction and wear"
                )
            columns = {name: _read(file[name]) for name in _known(file, COLUMNS)}
    except (OSError, KeyError) as error:
        raise InputError(f"{file_name(path)} cannot be read as HDF5: {error}") from None
    return CoupledData(columns, attributes)


def _known(file: Mapping[str, Any], names: Iterable[str]) -> list[str]:
    missing = [name for name in names if name not in file]
    if missing:
        raise KeyError(f"no column {', '.join(missing)}")
    return list(names)


def _read(column: Any) -> NDArray[Any]:
    import h5py

    if h5py.check_string_dtype(column.dtype):
        return np.array(column.asstr()[:], dtype=str)
    return np.asarray(column[:])

"""The campaign's data set: one HDF5 file with its evidence, errors, units and provenance."""

from __future__ import annotations

import hashlib
import json
import os
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from datetime import datetime, timezone
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fe_training.campaign.columns import INNER, POINT_COLUMNS, PROFILES, ROW_COLUMNS
from fe_training.campaign.design import CampaignDesign
from fe_training.campaign.evidence import point_columns
from fe_training.campaign.store import Row, write_atomically
from fe_training.solver.record import Outcome, Record
from surrogate.basics.files import checksum_line, file_name, models_folder
from surrogate.errors import InputError, MissingExtraError

if TYPE_CHECKING:
    import pandas
    import xarray

__all__ = [
    "Campaign",
    "DissipativeForce",
    "Table",
    "dissipative_force_table",
    "load_campaign",
    "require_checksum",
    "write_campaign",
]

Array = NDArray[Any]
Floats = NDArray[np.float64]

SCHEMA = "wirecut-campaign-data-1"

#: Profiles with more points are interpolated at this many, spaced evenly in the index.
PROFILE_POINTS = 96


@dataclass(frozen=True, slots=True, eq=False)
class Table:
    """Columns of equal length with their units and descriptions.

    Parameters
    ----------
    columns : mapping of str to ndarray
        The columns, read-only; the first axis counts the entries.
    units, descriptions : mapping of str to str
        Of each column.
    """

    columns: Mapping[str, Array]
    units: Mapping[str, str]
    descriptions: Mapping[str, str]

    def __getitem__(self, name: str) -> Array:
        try:
            return self.columns[name]
        except KeyError:
            raise InputError(
                f"there is no column {name!r}; the columns are {', '.join(self.columns)}."
            ) from None

    def __len__(self) -> int:
        return len(next(iter(self.columns.values())))


@dataclass(frozen=True, slots=True, eq=False)
class Campaign:
    """A campaign's data.

    Parameters
    ----------
    rows : Table
        Every configuration that was solved or failed, with its evidence and profiles.
    points : Table
        A, B and delta over (alpha, g), with errors, and whether and why not to use them.
    design : CampaignDesign
        What was wanted.
    provenance : mapping of str to str
        Schema, date, design hash and units.
    software : tuple of mapping of str to str
        What made the rows; their column ``software`` is an index into it.
    """

    rows: Table
    points: Table
    design: CampaignDesign
    provenance: Mapping[str, str]
    software: tuple[Mapping[str, str], ...]

    def to_pandas(self, table: str = "points") -> pandas.DataFrame:
        """Return the columns of one table that have a single value an entry.

        Parameters
        ----------
        table : str
            ``"points"`` or ``"rows"``.

        Returns
        -------
        pandas.DataFrame
            Units are in its ``attrs``.

        Raises
        ------
        MissingExtraError
            If pandas is not installed.
        """
        try:
            import pandas
        except ImportError:
            raise _missing("pandas") from None
        chosen = {"points": self.points, "rows": self.rows}[table]
        flat = {name: values for name, values in chosen.columns.items() if values.ndim == 1}
        frame = pandas.DataFrame(flat)
        frame.attrs["units"] = {name: chosen.units[name] for name in flat}
        return frame

    def to_xarray(self) -> xarray.Dataset:
        """Return both tables, profiles included, as one labelled data set.

        Returns
        -------
        xarray.Dataset
            Variables named ``row_...`` over the dimension ``row`` and ``point_...`` over
            ``point``, with units and descriptions.

        Raises
        ------
        MissingExtraError
            If xarray is not installed.
        """
        try:
            import xarray
        except ImportError:
            raise _missing("xarray") from None
        variables = {}
        for dimension, table in (("row", self.rows), ("point", self.points)):
            for name, values in table.columns.items():
                inner = () if values.ndim == 1 else (INNER[name],)
                attributes = {"units": table.units[name], "description": table.descriptions[name]}
                variables[f"{dimension}_{name}"] = ((dimension, *inner), values, attributes)
        return xarray.Dataset(variables, attrs=dict(self.provenance))


def _missing(package: str) -> MissingExtraError:
    return MissingExtraError(
        f"{package} is not installed; get it with: pip install 'wirecut[tables]'"
    )


def write_campaign(
    path: str | os.PathLike[str], design: CampaignDesign, rows: Sequence[Row]
) -> Path:
    """Write the data set of a campaign, and its checksum beside it.

    Parameters
    ----------
    path : str or path-like
        The HDF5 file; an existing one is replaced. The checksum is in the same name with
        ``.sha256`` added, as ``sha256sum --check`` reads it.
    design : CampaignDesign
        The design.
    rows : sequence of Row
        Its finished rows.

    Returns
    -------
    pathlib.Path
        The file.

    Raises
    ------
    InputError
        If there are no rows, or if the file cannot be written.
    """
    import h5py

    path = Path(file_name(path))
    if not rows:
        raise InputError("no configuration is finished yet, so there is no data set; run it first.")
    order = {one: index for index, one in enumerate(design.configurations())}
    rows = sorted(rows, key=lambda row: order[row.configuration])
    made_by = list({json.dumps(row.software): row.software for row in rows}.values())
    tables = {
        "rows": (_row_columns(rows, made_by), ROW_COLUMNS),
        "points": (point_columns(design, rows), POINT_COLUMNS),
    }
    with tempfile.TemporaryFile() as buffer:
        with h5py.File(buffer, "w") as file:
            file.attrs["schema"] = SCHEMA
            file.attrs["date"] = datetime.now(timezone.utc).isoformat(timespec="seconds")
            file.attrs["units"] = "R_w = 1, mu = 1, forces and energies per unit thickness"
            file.attrs["design_hash"] = design.hash
            file.attrs["design"] = json.dumps(design.as_dict())
            file.attrs["software"] = json.dumps(made_by)
            for name, (columns, about) in tables.items():
                group = file.create_group(name, track_order=True)
                for column, values in columns.items():
                    _write_column(group, column, values, *about[column])
        buffer.seek(0)
        content = buffer.read()
    write_atomically(path, content)
    write_atomically(_checksum_file(path), checksum_line(path.name, content))
    return path


def _write_column(group: Any, name: str, values: Array, unit: str, description: str) -> None:
    import h5py

    packed: dict[str, Any] = {"compression": "gzip", "compression_opts": 9, "shuffle": True}
    if values.dtype.kind == "U":
        text = np.char.encode(values, "utf-8")
        kind = h5py.string_dtype("utf-8", max(text.dtype.itemsize, 1))
        column = group.create_dataset(name, data=text.astype(kind), dtype=kind, **packed)
    else:
        column = group.create_dataset(name, data=values, **packed)
    column.attrs["unit"], column.attrs["description"] = unit, description


def _checksum_file(path: Path) -> Path:
    return path.with_name(path.name + ".sha256")


def _row_columns(rows: Sequence[Row], made_by: list[Mapping[str, str]]) -> dict[str, Array]:
    records = [row.record for row in rows]
    columns = {
        field.name: _column(field.name, [getattr(record, field.name) for record in records])
        for field in fields(Record)
    }
    return {
        **columns,
        "alpha": np.array([row.configuration.alpha for row in rows]),
        "target": np.array([row.configuration.target for row in rows]),
        "level": np.array([row.configuration.level for row in rows]),
        "attempt": np.array([row.attempt for row in rows]),
        "tried": np.array([row.tried for row in rows]),
        "software": np.array([made_by.index(row.software) for row in rows]),
    }


def _column(name: str, values: list[Any]) -> Array:
    """Return a field of all records as an array."""
    first = values[0]
    if isinstance(first, Outcome):
        return np.array([value.name for value in values])
    if isinstance(first, dict):
        return np.array([json.dumps(value) for value in values])
    if name in PROFILES:
        return _padded([_resampled(value) for value in values]).astype(np.float32)
    if isinstance(first, (tuple, np.ndarray)):
        return _padded([np.asarray(value, dtype=float) for value in values])
    return np.array(values)


def _resampled(values: Floats) -> Floats:
    if len(values) <= PROFILE_POINTS:
        return values
    places = np.linspace(0.0, len(values) - 1.0, PROFILE_POINTS)
    return np.interp(places, np.arange(len(values)), values)


def _padded(rows: Sequence[Floats]) -> Floats:
    padded = np.full((len(rows), max(1, *(len(row) for row in rows))), np.nan)
    for line, row in zip(padded, rows, strict=True):
        line[: len(row)] = row
    return padded


def load_campaign(path: str | os.PathLike[str] | None = None) -> Campaign:
    """Return a campaign's data.

    Parameters
    ----------
    path : str or path-like, optional
        The HDF5 file, with its checksum beside it; the shipped one by default.

    Returns
    -------
    Campaign
        Arrays are read-only.

    Raises
    ------
    InputError
        If the file or its checksum is missing, if they do not fit together, or if the file has
        another schema.
    """
    import h5py

    file = Path(file_name(path)) if path is not None else Path(models_folder()) / "campaign.h5"
    require_checksum(file)
    try:
        with h5py.File(file, "r") as content:
            _require_schema(file, content.attrs.get("schema"))
            attributes = {name: str(value) for name, value in content.attrs.items()}
            tables = [_read_table(content[name]) for name in ("rows", "points")]
        design = CampaignDesign.from_dict(json.loads(attributes.pop("design")))
        software = tuple(MappingProxyType(one) for one in json.loads(attributes.pop("software")))
    except InputError:
        raise
    except (OSError, LookupError, ValueError, TypeError, RuntimeError, AttributeError) as error:
        raise InputError(
            f"{file} is no data set of a campaign ({error}); make it anew with regen-surrogate."
        ) from None
    return Campaign(tables[0], tables[1], design, MappingProxyType(attributes), software)


def _require_schema(file: Path, schema: object) -> None:
    if schema != SCHEMA:
        raise InputError(
            f"{file} has the schema {schema!r}, but {SCHEMA!r} is read here; make it anew with "
            "regen-surrogate, or take the version of wirecut that made it."
        )


def require_checksum(file: Path) -> None:
    """Refuse a file that does not match the checksum beside it.

    Raises
    ------
    InputError
        If it does not, or if one of the two cannot be read.
    """
    beside = _checksum_file(file)
    try:
        checksum = hashlib.sha256(file.read_bytes()).hexdigest().encode()
        expected = beside.read_bytes().split()[:1]
    except OSError as error:
        raise InputError(
            f"{error.filename} cannot be read ({error.strerror}); a data set is two files. A wheel "
            "has none: take a clone or the source distribution (pip download --no-deps --no-binary "
            ":all: wirecut), or make them anew with regen-surrogate."
        ) from None
    if [checksum] != expected:
        raise InputError(
            f"{file} does not match its checksum in {beside.name}: it is damaged or incomplete; "
            "get both files again, or make them anew with regen-surrogate."
        )


def _read_table(group: Any) -> Table:
    columns, units, descriptions = {}, {}, {}
    for name, column in group.items():
        values = column[()]
        if values.dtype.kind in "SO":
            values = np.char.decode(values.astype(bytes), "utf-8")
        values.flags.writeable = False
        columns[name] = values
        units[name], descriptions[name] = column.attrs["unit"], column.attrs["description"]
    return Table(*map(MappingProxyType, (columns, units, descriptions)))


@dataclass(frozen=True, slots=True, eq=False)
class DissipativeForce:
    """The dissipative force over toughness, wear and stiffening.

    Parameters
    ----------
    alpha, g : ndarray, shape (points,)
        Strain-stiffening exponent and Gamma_o/(mu R_w) [-].
    wear_to_friction : ndarray, shape (ratios,)
        tau_w/(mu xi) [-].
    force : ndarray, shape (points, ratios)
        F_d/(xi mu R_w T) [-]; times xi it is F_d/(mu R_w T).
    error : ndarray, shape (points, ratios)
        Absolute error of `force` from the differences between the mesh levels and the truncation.
    """

    alpha: Floats
    g: Floats
    wear_to_friction: Floats
    force: Floats
    error: Floats


def dissipative_force_table(
    campaign: Campaign, wear_to_friction: ArrayLike = (0.0, 0.1, 1.0, 10.0, 100.0)
) -> DissipativeForce:
    """Return F_d/(xi mu R_w T) = 2 [(tau_w/(mu xi)) A + B] at the points that may be used.

    Eq. (S2) of the paper; it is linear in tau_w/(mu xi), so nothing has to be solved for it.

    Parameters
    ----------
    campaign : Campaign
        The data.
    wear_to_friction : array_like, shape (ratios,)
        tau_w/(mu xi), zero or positive [-].

    Returns
    -------
    DissipativeForce

    Raises
    ------
    InputError
        If a ratio is negative or no number.

    References
    ----------
    B. Antarvedi Goda, Z. Ma, S. Fregonese and M. Bacca, arXiv:2412.02021.
    """
    ratio = np.atleast_1d(np.asarray(wear_to_friction, dtype=float))
    if not np.all((ratio >= 0.0) & np.isfinite(ratio)):
        raise InputError(f"wear_to_friction is {ratio}; give tau_w/(mu xi) from 0 on.")
    points, use = campaign.points, campaign.points["use"].astype(bool)
    arc, load = points["arc"][use, None], points["normal_load"][use, None]
    relative = points["normal_load_error"][use, None] + points["truncation_error"][use, None]
    return DissipativeForce(
        alpha=points["alpha"][use],
        g=points["g"][use],
        wear_to_friction=ratio,
        force=2.0 * (ratio * arc + load),
        error=2.0 * (ratio * points["arc_error"][use, None] + load * relative),
    )

"""The fitted models of one file, and the shipped ones among them."""

from __future__ import annotations

import hashlib
import io
import json
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache, cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.files import file_name, models_folder, read_archive
from surrogate.contact.bounds import Bounds
from surrogate.contact.coordinates import QUANTITIES, coordinates
from surrogate.contact.domain import Domain
from surrogate.contact.fitted import FittedModel
from surrogate.contact.formula import BlendModel
from surrogate.contact.grid import Grid
from surrogate.contact.process import GaussianProcess, ProcessModel
from surrogate.contact.table import CellTable, TableModel
from surrogate.errors import InputError

__all__ = [
    "FILE",
    "SCHEMA",
    "Fitted",
    "content_of",
    "fitted_from",
    "read",
    "read_fitted",
    "shipped",
    "to_file",
]

FILE = "surrogates.npz"
_FAMILY, _VERSION = "wirecut-surrogates-", 1
SCHEMA = f"{_FAMILY}{_VERSION}"
_ABOUT = "about"
_REMEDY = "install wirecut again, or make the file anew with regen-surrogate"


def content_of(about: Mapping[str, Any], arrays: Mapping[str, Any]) -> bytes:
    """Return the content of a file: what is said about the arrays, and the arrays.

    Equal numbers give equal bytes.

    Examples
    --------
    >>> len(content_of({}, {"x": np.zeros(2)})) > 100
    True
    """
    text = json.dumps({"schema": SCHEMA, **about}, sort_keys=True, allow_nan=False)
    columns = {_ABOUT: np.frombuffer(text.encode(), dtype=np.uint8), **arrays}
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, values in columns.items():
            member = io.BytesIO()
            np.lib.format.write_array(member, np.asarray(values), allow_pickle=False)
            entry = zipfile.ZipInfo(f"{name}.npy")  # of a fixed date
            archive.writestr(entry, member.getvalue(), zipfile.ZIP_DEFLATED)
    return buffer.getvalue()


def read_fitted(path: object) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
    """Return what a file says about its arrays, and the arrays.

    Parameters
    ----------
    path : str or path-like
        The file, with its checksum beside it.

    Returns
    -------
    about : dict
        Schema, domain, units, errors, provenance.
    arrays : dict of str to ndarray
        The arrays, all of them finite.

    Raises
    ------
    InputError
        If a file is missing, damaged, of a newer schema, or holds what is no number.
    """
    file = Path(file_name(path))
    content = _verified(file)
    about, arrays = _decoded(file, content)
    for name, values in arrays.items():
        if values.dtype.kind not in "fiu" or not np.all(np.isfinite(values)):
            raise InputError(
                f"{file} must hold finite numbers only, but {name} has others; {_REMEDY}."
            )
        values.flags.writeable = False
    return about, arrays


def _verified(file: Path) -> bytes:
    try:
        content = file.read_bytes()
        expected = file.with_name(file.name + ".sha256").read_bytes().split()[:1]
    except OSError as error:
        raise InputError(
            f"the fitted models must be read, but {error.filename} cannot be "
            f"({error.strerror}); {_REMEDY}."
        ) from None
    if [hashlib.sha256(content).hexdigest().encode()] != expected:
        raise InputError(
            f"{file} must match the checksum beside it, but it does not: it is damaged or "
            f"incomplete; {_REMEDY}."
        )
    return content


def _decoded(file: Path, content: bytes) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
    try:
        arrays = read_archive(content)
        about = json.loads(arrays.pop(_ABOUT).tobytes(), parse_constant=_no_number)
        schema = str(about["schema"])
    except (KeyError, ValueError, TypeError, RecursionError) as error:
        raise InputError(
            f"{file} must be a file of fitted models, but it cannot be decoded ({error}); "
            f"{_REMEDY}."
        ) from None
    _require_schema(file, schema)
    return about, arrays


def _no_number(name: str) -> float:
    raise ValueError(f"{name} is no number")


def _require_schema(file: Path, schema: str) -> None:
    if schema == SCHEMA:
        return
    version = schema.removeprefix(_FAMILY)
    newer = schema.startswith(_FAMILY) and version.isdigit() and int(version) > _VERSION
    raise InputError(
        f"{file} must have the schema {SCHEMA!r}, but it has {schema!r}; "
        f"{'upgrade wirecut' if newer else _REMEDY}."
    )


@dataclass(frozen=True, eq=False)
class Fitted:
    """Everything that was fitted to one data set.

    Parameters
    ----------
    limits : Domain
        The domain of all models.
    processes : mapping of str to GaussianProcess
        Of the quantities of `surrogate.contact.coordinates`.
    table : CellTable
        Of A, B and (delta/R_w - 1)/|x|^(7/4).
    constants : mapping of str to tuple of float
        Those of the formula of `BlendModel`.
    touch_error : float
        Standard error of ln g_touch [-].
    about : mapping
        Errors, power laws of single alphas, provenance: what is told, not computed with.
    """

    limits: Domain
    processes: Mapping[str, GaussianProcess] = field(repr=False)
    table: CellTable = field(repr=False)
    constants: Mapping[str, tuple[float, ...]]
    touch_error: float
    about: Mapping[str, Any] = field(repr=False)

    @cached_property
    def bounds(self) -> Bounds:
        """The measured errors."""
        return Bounds.from_dict(self.about["bounds"])

    @cached_property
    def models(self) -> dict[str, FittedModel]:
        """The models by their names."""
        models = (
            BlendModel(self.limits, self.constants),
            TableModel(self.limits, self.table),
            ProcessModel(self.limits, self.processes, self.touch_error),
        )
        return {model.name: model for model in models}


def to_file(fitted: Fitted) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return what `fitted_from` makes the same models of: numbers with names, and arrays."""
    limits, grid = fitted.limits, fitted.table.grid
    about: dict[str, Any] = {
        **fitted.about,
        "units": "R_w = 1, mu = 1, forces and energies per unit thickness",
        "domain": {"g": limits.g, "alpha": limits.alpha},
        "touch": limits.touch,
        "touch_error": fitted.touch_error,
        "growth": limits.growth,
        "constants": {name: list(values) for name, values in fitted.constants.items()},
        "grid": {name: getattr(grid, name) for name in ("beyond", "short", "past", "stiffening")},
        "prior": {
            name: {
                "mean": p.mean,
                "variance": p.variance,
                "lengths": p.lengths.tolist(),
                "calibration": p.calibration,
            }
            for name, p in fitted.processes.items()
        },
    }
    arrays: dict[str, Any] = {}
    for name in QUANTITIES:
        process = fitted.processes[name]
        arrays[f"{name}.points"] = process.inputs[:, :2]
        arrays[f"{name}.values"] = process.values
        arrays[f"{name}.noise"] = process.noise.astype(np.float32)
        arrays[f"{name}.active"] = process.active.astype(np.uint16)
        for side, nodes in zip(("short", "past"), fitted.table.nodes[name], strict=True):
            arrays[f"{name}.{side}"] = nodes.astype(np.float32)
    return about, arrays


def fitted_from(about: Mapping[str, Any], arrays: Mapping[str, Any]) -> Fitted:
    """Return the fitted models that `to_file` took apart.

    Raises
    ------
    InputError
        If something is missing or of the wrong shape.
    """
    try:
        ends = about["domain"]
        limits = Domain(
            _pair(ends["g"]),
            _pair(ends["alpha"]),
            _floats(about["touch"]),
            _floats(about["growth"]),
        )
        grid = Grid(
            limits.log_g[0], log_alpha=limits.log_alpha, touch=limits.touch, **about["grid"]
        )
        return Fitted(
            limits,
            {name: _process(name, limits, about["prior"][name], arrays) for name in QUANTITIES},
            CellTable(grid, {name: _nodes(name, grid, arrays) for name in QUANTITIES}),
            {name: _floats(values) for name, values in about["constants"].items()},
            float(about["touch_error"]),
            about,
        )
    except (KeyError, ValueError, TypeError, IndexError, AttributeError) as error:
        raise InputError(
            f"the fitted models must be complete, but {error!r} was met; install wirecut again, "
            "or make the file anew with regen-surrogate."
        ) from None


def _process(
    name: str, limits: Domain, prior: Mapping[str, Any], arrays: Mapping[str, Any]
) -> GaussianProcess:
    points = arrays[f"{name}.points"]
    return GaussianProcess(
        inputs=coordinates(points[:, 0], points[:, 1], limits.log_touch(points[:, 1])),
        values=arrays[f"{name}.values"],
        noise=arrays[f"{name}.noise"].astype(float),
        active=arrays[f"{name}.active"].astype(np.intp),
        mean=float(prior["mean"]),
        variance=float(prior["variance"]),
        lengths=np.array(prior["lengths"], dtype=float),
        calibration=float(prior["calibration"]),
    )


def _nodes(name: str, grid: Grid, arrays: Mapping[str, Any]) -> tuple[Any, Any]:
    short, past = (arrays[f"{name}.{side}"].astype(float) for side in ("short", "past"))
    for nodes, rows in ((short, grid.short + 1), (past, grid.past + 1)):
        if nodes.shape != (rows, grid.stiffening + 1):
            raise ValueError(f"the table of {name} has the shape {nodes.shape}")
    return short, past


def _floats(values: Any) -> tuple[float, ...]:
    return tuple(map(float, values))


def _pair(values: Any) -> tuple[float, float]:
    low, high = map(float, values)
    return low, high


@cache
def read(path: str) -> Fitted:
    """Return the fitted models of a file, read once.

    Raises
    ------
    InputError
        As `read_fitted` and `fitted_from`.
    """
    return fitted_from(*read_fitted(path))


def shipped() -> Fitted:
    """Return the fitted models that this installation ships.

    Raises
    ------
    InputError
        If it ships none, or their file is damaged.
    """
    return _in(models_folder())


@cache
def _in(folder: Path) -> Fitted:
    file = folder / FILE
    if not file.is_file():
        raise InputError(
            f"a fitted model must have the file {FILE}, but the fitted models are not shipped with "
            "this version; make the file with regen-surrogate, or choose a closed form such as "
            "model='eq13'."
        )
    return read(str(file))

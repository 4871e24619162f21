"""The fitted models of one file, and those that are in use: the shipped ones, or one's own."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cache, cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.files import file_name, models_folder
from surrogate.contact.archive import FILE, SCHEMA, complete, content_of, file_in, read_fitted
from surrogate.contact.bounds import Bounds
from surrogate.contact.coordinates import (
    AT_THE_TIP,
    QUANTITIES,
    RISE,
    SLIP_QUANTITIES,
    STEP,
    WITHIN,
    coordinates_of,
)
from surrogate.contact.domain import Domain
from surrogate.contact.fitted import FittedModel
from surrogate.contact.formula import BlendModel
from surrogate.contact.grid import Grid
from surrogate.contact.process_model import ProcessModel
from surrogate.contact.table import CellTable, TableModel

if TYPE_CHECKING:
    from surrogate.contact.process import GaussianProcess

__all__ = [
    "FILE",
    "SCHEMA",
    "VARIABLE",
    "Fitted",
    "content_of",
    "fitted_from",
    "folder_in_use",
    "in_use",
    "location",
    "read",
    "read_fitted",
    "shipped",
    "to_file",
    "use",
]

VARIABLE = "WIRECUT_MODELS"
"""The environment variable that names a file of models, or its folder, to be used."""


@dataclass(frozen=True, eq=False)
class Fitted:
    """Everything that was fitted to one data set.

    Parameters
    ----------
    limits : Domain
        The domain of all models.
    processes : mapping of str to GaussianProcess
        Of the quantities of `surrogate.contact.coordinates`; those of slip may be missing.
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
    def slip_bounds(self) -> Bounds | None:
        """The measured errors of A* and B*; None where the file has none."""
        told = self.about.get("slip_bounds")
        return None if told is None else Bounds.from_dict(told)

    @cached_property
    def models(self) -> dict[str, FittedModel]:
        """The models by their names."""
        models = (
            BlendModel(self.limits, self.constants),
            TableModel(self.limits, self.table),
            ProcessModel(
                self.limits,
                self.processes,
                self.touch_error,
                float(self.about.get("truncation", 0.0)),
            ),
        )
        return {model.name: model for model in models}


def to_file(fitted: Fitted) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return what `fitted_from` makes the same models of: numbers with names, and arrays."""
    limits, grid = fitted.limits, fitted.table.grid
    about: dict[str, Any] = {
        **fitted.about,
        "units": "R_w = 1, mu = 1, forces and energies per unit thickness",
        "domain": {"g": limits.g, "alpha": limits.alpha, "highest": limits.highest},
        "touch": limits.touch,
        "touch_error": fitted.touch_error,
        "tip": [RISE, WITHIN, STEP],
        "growth": dict(limits.growth),
        "constants": {name: list(values) for name, values in fitted.constants.items()},
        "answers": _answers(fitted),
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
    inputs = [process.inputs[:, :2] for process in fitted.processes.values()]
    points, rows = np.unique(np.concatenate(inputs), axis=0, return_inverse=True)
    parts = np.split(rows.ravel().astype(np.uint16), np.cumsum([len(some) for some in inputs])[:-1])
    arrays: dict[str, Any] = {"points": points}  # of most processes the same
    for (name, process), part in zip(fitted.processes.items(), parts, strict=True):
        arrays[f"{name}.rows"] = part
        arrays[f"{name}.values"] = process.values.astype(np.float32)  # they scatter by far more
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
    with complete("the fitted models", "regen-surrogate"):
        ends = about["domain"]
        limits = Domain(
            _pair(ends["g"]),
            _pair(ends["alpha"]),
            _floats(about["touch"]),
            {name: _floats(powers) for name, powers in _growth(about["growth"]).items()},
            tuple(_pair(each) for each in ends.get("highest", ())),
        )
        names = tuple(n for n in (*QUANTITIES, *SLIP_QUANTITIES) if n in about["prior"])
        if not {*QUANTITIES} <= {*names}:
            raise ValueError(f"processes of {', '.join(names)}")
        if {*AT_THE_TIP} & {*names} and about.get("tip") != [RISE, WITHIN, STEP]:
            raise ValueError("A* fitted in a coordinate of an earlier version")
        grid = Grid(
            limits.log_g[0], log_alpha=limits.log_alpha, touch=limits.touch, **about["grid"]
        )
        fitted = Fitted(
            limits,
            _Processes(names, limits, about["prior"], arrays),
            CellTable(grid, {name: _nodes(name, grid, arrays) for name in names}),
            {name: _floats(values) for name, values in about["constants"].items()},
            float(about["touch_error"]),
            about,
        )
        _require_answers(fitted)
        return fitted


#: Where the answers of a file are compared: shares of the domain in ln g and in ln alpha.
_ASKED = ((0.02, 0.05), (0.3, 0.5), (0.55, 0.0), (0.75, 0.95), (0.6, 0.3))


def _answers(fitted: Fitted) -> dict[str, list[list[float]]]:
    """Return the functions of the formula at a few points, and of the table at some of its nodes.

    Elsewhere the table has to make its cells first, and the process to be solved: for whoever
    loads a file to compute one force either would take longer than everything else.
    """
    (low, high), (first, last) = fitted.limits.log_g, fitted.limits.log_alpha
    points = [
        (float(np.exp(low + g * (high - low))), float(np.exp(first + a * (last - first))))
        for g, a in _ASKED
    ]
    names, formula = tuple(fitted.processes), fitted.models["power-law"]
    sides = [side for name in names for side in fitted.table.nodes[name]]
    return {
        "power-law": [list(map(float, formula.contact(names, *at))) for at in points],
        "table": [
            [float(side[int(g * (len(side) - 1)), int(a * (side.shape[1] - 1))]) for side in sides]
            for g, a in _ASKED
        ],
    }


def _require_answers(fitted: Fitted) -> None:
    if fitted.about.get("schema") != SCHEMA:
        return
    told = fitted.about["answers"]
    for model, answers in _answers(fitted).items():
        if not np.allclose(answers, told[model], rtol=1e-9, atol=0.0):
            raise ValueError(f"other answers of {model!r} than those that the file names")


def _growth(told: Any) -> Mapping[str, Any]:
    """Return the growth by function; the first version of the file has that of B alone."""
    return told if isinstance(told, Mapping) else {"normal_load": told}


class _Processes(Mapping[str, "GaussianProcess"]):
    """The processes of a file, made when they are asked for, as the table needs none of them."""

    def __init__(
        self, names: tuple[str, ...], limits: Domain, priors: Any, arrays: Mapping[str, Any]
    ) -> None:
        self._names, self._limits, self._priors = names, limits, priors
        self._arrays, self._made = arrays, dict[str, Any]()
        for name in names:
            _require_process(name, priors[name], arrays)

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def __getitem__(self, name: str) -> GaussianProcess:
        if name not in self._made:
            self._made[name] = _process(name, self._limits, self._priors[name], self._arrays)
        return self._made[name]  # type: ignore[no-any-return]


def _require_process(name: str, prior: Mapping[str, Any], arrays: Mapping[str, Any]) -> None:
    points = _points(name, arrays)
    others = [arrays[f"{name}.{part}"] for part in ("values", "noise")]
    known = len(points), *map(len, others)
    if len(set(known)) != 1 or np.max(arrays[f"{name}.active"], initial=0) >= known[0]:
        raise ValueError(f"the process of {name} has arrays of {known} points")
    numbers = float(prior["mean"]), float(prior["variance"]), float(prior["calibration"])
    if points.shape[1] != 2 or not np.all(np.isfinite(numbers)):
        raise ValueError(f"the process of {name} has other points or numbers than one has")
    if not (np.all(others[1] > 0.0) and np.all(np.array(prior["lengths"]) > 0.0)):
        raise ValueError(f"the process of {name} has a noise or a length that is not positive")


def _points(name: str, arrays: Mapping[str, Any]) -> NDArray[np.float64]:
    """Return ln g and ln alpha of the points of a process; in the first version it has its own."""
    if f"{name}.points" in arrays:
        return np.asarray(arrays[f"{name}.points"])
    points, rows = arrays["points"], arrays[f"{name}.rows"]
    if rows.dtype.kind != "u" or np.max(rows, initial=0) >= len(points):
        raise ValueError(f"the process of {name} has other points than the file")
    return np.asarray(points[rows])


def _process(
    name: str, limits: Domain, prior: Mapping[str, Any], arrays: Mapping[str, Any]
) -> GaussianProcess:
    from surrogate.contact.process import GaussianProcess

    points = _points(name, arrays)
    return GaussianProcess(
        inputs=coordinates_of(name, points[:, 0], points[:, 1], limits.log_touch(points[:, 1])),
        values=arrays[f"{name}.values"].astype(float),
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
    """Return the fitted models in use: those of `use` or of the environment, or the shipped ones.

    Raises
    ------
    InputError
        If there are none, or their file is damaged.
    """
    named = _in_use or os.environ.get(VARIABLE)
    return read(_file_at(named)) if named else _in(models_folder())


def folder_in_use() -> str:
    """Return the folder of the file that `shipped` reads."""
    named, folder = location()
    return os.path.dirname(_file_at(named)) if named else folder


def location() -> tuple[str | None, str]:
    """Return the path that was named for the models, None if none was, and the shipped folder."""
    return _in_use or os.environ.get(VARIABLE), models_folder()


_in_use: str | None = None


def use(path: object = None) -> Fitted:
    """Take the fitted models of a file from now on, everywhere; without a path the shipped ones.

    Parameters
    ----------
    path : str or path-like, optional
        The file, or the folder that holds it.

    Returns
    -------
    Fitted
        What is in use now.

    Raises
    ------
    InputError
        If they cannot be read; those in use before stay.
    """
    global _in_use
    if path is None:
        _in_use = None
        return shipped()
    file = os.path.abspath(_file_at(file_name(path)))
    fitted = read(file)
    _in_use = file
    return fitted


@contextmanager
def in_use(path: object) -> Iterator[Fitted]:
    """Take the fitted models of a file for a while."""
    global _in_use
    before = _in_use
    try:
        yield use(path)
    finally:
        _in_use = before


def _file_at(path: str) -> str:
    """Return the file of models at a path, which may be its folder."""
    return os.path.join(path, FILE) if os.path.isdir(path) else path


@cache
def _in(folder: str) -> Fitted:
    remedy = "make it with regen-surrogate, or choose a closed form such as model='eq13'"
    return read(file_in(folder, FILE, "a fitted model", remedy))

"""A regime map as tables and as a labelled data set."""

from __future__ import annotations

from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np

from surrogate.basics.extras import require_extra
from surrogate.basics.files import write_csv
from surrogate.maps.axes import COORDINATES, MapAxis
from surrogate.version import __version__

if TYPE_CHECKING:
    import xarray

    from surrogate.maps.record import MapRecord

__all__ = ["about_map", "map_dataset", "map_summary", "write_boundaries", "write_map"]


def about_map(made: MapRecord) -> list[str]:
    """Return what a map is, one line each."""
    fixed = ", ".join(
        f"{name} = {value!r} {COORDINATES[name].unit}".strip() for name, value in made.fixed.items()
    )
    return [
        f"regime map by model {made.model}, wirecut {__version__}",
        f"fixed: {fixed or 'nothing'}",
        *([f"units: {' = '.join(made.units)} = 1"] if made.units else []),
        f"a term dominates from {made.regime.threshold!r} of the force on",
    ]


def _columns(made: MapRecord) -> dict[tuple[str, str], Any]:
    """Return every field on the nodes by its name and unit."""
    force, unit = made.force, made.force_unit
    errors = {
        (name, ""): np.nan if (error := getattr(force, name)) is None else error
        for name in ("relative_error", "fit_error", "law_error")
    }
    columns: dict[tuple[str, str], Any] = {
        ("force_per_thickness", unit): force.total,
        ("cleavage", unit): force.cleavage,
        ("friction", unit): force.friction,
        ("wear", unit): force.wear,
        ("cleavage_share", ""): made.cleavage_share,
        ("friction_share", ""): made.friction_share,
        ("wear_share", ""): made.wear_share,
        **errors,
        ("law", ""): force.laws,
        ("in_domain", ""): force.in_domain,
        ("dominant", ""): made.regime.dominant,
        ("contact", ""): made.regime.contact,
    }
    shape = made.y.values.size, made.x.values.size
    return {key: np.broadcast_to(values, shape) for key, values in columns.items()}


def write_map(made: MapRecord, file: str | PathLike[str]) -> None:
    """Write one line a node."""
    axes = {
        (made.x.name, made.x.unit): made.x.values,
        (made.y.name, made.y.unit): made.y.values[:, np.newaxis],
    }
    write_csv(file, {**axes, **_columns(made)}, about_map(made))


def write_boundaries(made: MapRecord, file: str | PathLike[str]) -> None:
    """Write one line a point of the boundaries; `line` counts the polylines."""
    lines = [(one, line) for one in made.boundaries for line in one.lines]
    sizes = [len(line) for _, line in lines]
    points = np.concatenate([line for _, line in lines]) if lines else np.empty((0, 2))

    def repeated(values: list[Any], kind: type) -> Any:
        return np.repeat(np.array(values, dtype=kind), sizes)

    columns = {
        ("line", ""): repeated(list(range(1, len(lines) + 1)), int),
        ("kind", ""): repeated([one.kind for one, _ in lines], str),
        ("equation", ""): repeated([one.equation for one, _ in lines], str),
        ("exact", ""): repeated([one.exact for one, _ in lines], bool),
        (made.x.name, made.x.unit): points[:, 0],
        (made.y.name, made.y.unit): points[:, 1],
    }
    write_csv(file, columns, about_map(made))


def map_dataset(made: MapRecord) -> xarray.Dataset:
    """Return the fields over both axes, with units; xarray is needed."""
    require_extra("xarray", "a labelled data set", "tables")
    import xarray

    axes = {
        axis.name: (axis.name, axis.values, {"units": axis.unit, "description": words})
        for axis in (made.y, made.x)
        for words in (axis.coordinate.words,)
    }
    fields = {
        name: ((made.y.name, made.x.name), values, {"units": unit})
        for (name, unit), values in _columns(made).items()
    }
    return xarray.Dataset(fields, coords=axes, attrs={"about": "; ".join(about_map(made))})


def map_summary(made: MapRecord) -> dict[str, Any]:
    """Return a map's regimes and boundaries as numbers and words."""
    regimes = np.unique(made.regime.dominant, return_counts=True)
    laws = np.unique(made.force.laws, return_counts=True)
    total = made.regime.dominant.size  # type: ignore[union-attr]
    return {
        "model": str(made.model),
        "laws": {str(n): int(c) / laws[1].sum() for n, c in zip(*laws, strict=True)},
        "x": _axis_record(made.x),
        "y": _axis_record(made.y),
        "fixed": dict(made.fixed),
        "threshold": made.regime.threshold,
        "regimes": {str(n): int(c) / total for n, c in zip(*regimes, strict=True)},
        "in_domain": float(np.mean(made.force.in_domain)),
        "boundaries": [
            {
                "kind": one.kind,
                "equation": one.equation,
                "exact": one.exact,
                "lines": [
                    {"start": line[0].tolist(), "end": line[-1].tolist()} for line in one.lines
                ],
            }
            for one in made.boundaries
        ],
    }


def _axis_record(axis: MapAxis) -> dict[str, Any]:
    return {
        "name": axis.name,
        "unit": axis.unit,
        "low": float(axis.values[0]),
        "high": float(axis.values[-1]),
        "scale": axis.scale,
    }

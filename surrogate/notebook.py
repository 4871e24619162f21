"""Results as tables of HTML, which notebooks show."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import fields
from html import escape
from typing import TYPE_CHECKING, Any

import numpy as np

from surrogate.tables import number
from surrogate.validation import shown

if TYPE_CHECKING:
    from surrogate.map_record import MapRecord

__all__ = ["html_of_map", "html_of_record", "html_table"]

_MOST_WORDS = 4


def html_table(title: str, rows: Iterable[tuple[str, str, str]]) -> str:
    """Return a table of name, value and unit.

    Examples
    --------
    >>> html_table("Scene", [("toughness", "1.6", "J/m^2")])[:48]
    '<table><caption>Scene</caption><tr><td>toughness'
    """
    lines = "".join(
        "<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in row) + "</tr>" for row in rows
    )
    return f"<table><caption>{escape(title)}</caption>{lines}</table>"


def html_of_record(record: Any) -> str:
    """Return the fields of a dataclass with the units that its documentation gives.

    Examples
    --------
    >>> from surrogate import Scene
    >>> "<td>shear_modulus</td><td>685</td><td>Pa</td>" in html_of_record(Scene(685.0, 1.6, 1e-4))
    True
    """
    units = _units(type(record))
    rows = []
    for field in fields(record):
        value, unit = getattr(record, field.name), units.get(field.name, "")
        if isinstance(value, Mapping):
            rows += [(f"{field.name}: {key}", _short(part), unit) for key, part in value.items()]
        else:
            rows.append((field.name, _short(value), unit))
    return html_table(type(record).__name__, rows)


def html_of_map(made: MapRecord) -> str:
    """Return a map's regimes and boundaries, and its picture where matplotlib is installed."""
    from importlib.util import find_spec

    from surrogate.map_axes import COORDINATES
    from surrogate.map_export import map_summary

    told = map_summary(made)
    rows = [
        ("model", told["model"], ""),
        *(
            (axis, f"{told[axis]['name']} {_pair(told[axis])}", told[axis]["unit"])
            for axis in ("x", "y")
        ),
        *((name, number(value), COORDINATES[name].unit) for name, value in told["fixed"].items()),
        *(
            (name, f"{100.0 * share:.1f} % of the map", "")
            for name, share in told["regimes"].items()
        ),
        *((one["kind"], one["equation"], "") for one in told["boundaries"]),
    ]
    table = html_table("RegimeMap", rows)
    return table + _picture(made) if find_spec("matplotlib") else table


def _pair(axis: Mapping[str, Any]) -> str:
    return f"{number(axis['low'])} to {number(axis['high'])}"


def _picture(made: MapRecord) -> str:
    from io import StringIO

    from surrogate.figures import new_figure, write_svg
    from surrogate.map_plots import plot_regime_map

    figure = new_figure((3.4, 3.5))
    plot_regime_map(made, figure.add_subplot())
    stream = StringIO()
    write_svg(figure, stream)
    return stream.getvalue()[stream.getvalue().index("<svg") :]


def _units(kind: type) -> dict[str, str]:
    """Return the units in square brackets of the documented parameters."""
    found: dict[str, str] = {}
    entries = re.split(r"^ {4}(?=\w[\w, ]* : )", kind.__doc__ or "", flags=re.MULTILINE)
    for entry in entries[1:]:
        names, _, text = entry.partition(" : ")
        unit = re.search(r"\[([^\]]*)\]", text)
        for name in names.split(", "):
            if unit and unit[1] != "-":
                found[name] = unit[1]
    return found


def _short(value: Any) -> str:
    """Return a value in one short line; of an array its shape and range."""
    if isinstance(value, float):
        return number(value)
    if not isinstance(value, np.ndarray):
        return (
            "unknown" if value is None else str(value) if isinstance(value, str) else shown(value)
        )
    shape = " x ".join(map(str, value.shape))
    if not value.size:
        return f"{shape} values"
    if value.dtype.kind in "Ub":
        kinds = [str(one) for one in np.unique(value)]
        words = ", ".join(kinds[:_MOST_WORDS])
        return f"{shape} values: {words}"
    with np.errstate(all="ignore"):
        finite = value[np.isfinite(value)]
    if not finite.size:
        return f"{shape} values, none finite"
    return f"{shape} values, {number(float(finite.min()))} to {number(float(finite.max()))}"

"""The artists of a regime map: fills, hatches, lines and points."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.figures import (
    FILLS,
    GREY,
    LARGEST_SHOWN,
    MEDIUM,
    SMALL,
    plain_log_ticks,
)
from surrogate.basics.picture_form import picture_form
from surrogate.basics.records import number, share
from surrogate.choosing.laws import AnyLaw
from surrogate.contact.closed_forms import formula_name
from surrogate.errors import InputError
from surrogate.maps.axes import COORDINATES, MapAxis
from surrogate.maps.lines import Boundary
from surrogate.maps.points import MapPoints
from surrogate.maps.record import MapRecord

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = [
    "ERROR_COLOURS",
    "ERROR_LEVELS",
    "LINES",
    "POINT_MARKERS",
    "axis_label",
    "bars",
    "draw_boundaries",
    "draw_points",
    "fill_error",
    "fill_regions",
    "hatch_outside",
    "patch",
    "set_up",
    "tell_fixed",
]

LINES = ("-", (0, (3.5, 1.7)), (0, (4, 1.5, 1, 1.5)))
"""Dashes of the lines on which terms are equal."""

LIMIT_LINES = {
    "high-toughness": ("#8c1d18", (0, (1, 1))),
    "low-toughness": ("#0b5345", (0, (3, 1, 1, 1, 1, 1))),
    "friction-free": ("#4a235a", (0, (5, 1))),
    "eq13": ("#1b4f72", (0, (2, 2))),
}
"""Colour and dashes of the line on which a limit formula is off."""

POINT_MARKERS = ("s", "o", "D", "^", "v", "P")

ERROR_LEVELS = (0.0, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0)
"""Steps of the map of an error [%]."""

ERROR_COLOURS = ("#ffffff", "#fdf0d5", "#f9d99a", "#f2b45c", "#dd8a3c", "#b8612c", "#8a3f1f")
"""From no error to more than the largest step, darker with each."""

SHOWN_UNITS = {"m": (1e3, "mm"), "Pa": (1e-3, "kPa"), "J/m^2": (1.0, "J/m$^2$"), "": (1.0, "-")}
"""Factor and unit in which figures show a quantity in SI units."""


def axis_label(axis: MapAxis) -> str:
    """Return the words, symbol and unit of an axis as figures show them.

    Examples
    --------
    >>> from surrogate.maps.axes import map_axis
    >>> axis_label(map_axis("wire_radius", (1e-5, 1e-3), "log", 3))
    'wire radius $R_w$ [mm]'
    """
    one = axis.coordinate
    if one.name == "wire_radius" and picture_form().diameters:
        return "wire diameter $2R_w$ [mm]"
    return f"{one.words} ${one.symbol}$ [{SHOWN_UNITS[one.unit][1]}]"


Array = NDArray[np.float64]

_SMOOTHINGS = 4
_DECADE = 10.0
_CONTACT, _HATCH = "#333333", "#909090"


def set_up(ax: Axes, made: MapRecord) -> None:
    """Give the axes the map's scales, limits and labels.

    Raises
    ------
    InputError
        If an axis has numbers for which there are no ticks.
    """
    for axis, which in ((made.x, "x"), (made.y, "y")):
        getattr(ax, f"set_{which}scale")(axis.scale)
        low, high = _drawable(axis)
        getattr(ax, f"set_{which}lim")(low, high)
        if axis.scale == "log" and high < 1.01 * _DECADE * low:  # too few powers of ten to read
            plain_log_ticks(getattr(ax, f"{which}axis"), (1.0, 2.0, 3.0, 5.0))
        getattr(ax, f"set_{which}label")(axis_label(axis), fontsize=MEDIUM)
    ax.tick_params(which="both", labelsize=SMALL)
    ax.set_facecolor(FILLS["transition"])


def _shown(axis: MapAxis, values: Any) -> Any:
    """Return values of an axis in the unit that figures show."""
    twice = axis.name == "wire_radius" and picture_form().diameters
    return SHOWN_UNITS[axis.unit][0] * (2.0 if twice else 1.0) * np.asarray(values)


def _drawable(axis: MapAxis) -> Array:
    """Return the ends of an axis as shown, if ticks can be placed around them."""
    ends: Array = _shown(axis, axis.values[[0, -1]])
    if ends[-1] > LARGEST_SHOWN or 0.0 < ends[0] < 1.0 / LARGEST_SHOWN:
        unit = f" {axis.unit}" if axis.unit else ""
        raise InputError(
            f"a figure's numbers must be between {1.0 / LARGEST_SHOWN:g} and {LARGEST_SHOWN:g}, "
            f"but the map's {axis.name} goes from {axis.values[0]:.4g} to "
            f"{axis.values[-1]:.4g}{unit}; narrow the range, or take the numbers by to_csv."
        )
    return ends


def _mesh(made: MapRecord) -> tuple[Array, Array]:
    return _shown(made.x, made.x.values), _shown(made.y, made.y.values)


def _whole(made: MapRecord, values: Any) -> Array:
    shape = made.y.values.size, made.x.values.size
    return np.array(np.broadcast_to(np.asarray(values, dtype=float), shape))


def fill_regions(ax: Axes, made: MapRecord) -> None:
    """Fill where a term dominates."""
    for name, part in made.term_shares.items():
        values = _whole(made, part)
        if np.any(values >= made.regime.threshold):
            levels = [made.regime.threshold, 2.0]
            ax.contourf(*_mesh(made), values, levels=levels, colors=[FILLS[name]], zorder=0)


def fill_error(ax: Axes, made: MapRecord, model: str) -> None:
    """Colour the map by another model's error, with a bar of colours."""
    error = 100.0 * np.abs(_whole(made, made.difference(model)))
    filled = ax.contourf(
        *_mesh(made),
        np.where(np.isfinite(error), error, np.nan),
        levels=ERROR_LEVELS,
        colors=ERROR_COLOURS,
        extend="max",
        zorder=0,
    )
    bar = ax.figure.colorbar(filled, ax=ax, shrink=0.85, pad=0.02)
    bar.set_label(f"error of {formula_name(model)} [%]", fontsize=MEDIUM)
    bar.ax.tick_params(labelsize=SMALL)


def hatch_outside(ax: Axes, made: MapRecord) -> Iterator[Any]:
    """Hatch where model or law are not known to hold; yield the handles for the legend."""
    outside = 1.0 - _whole(made, made.force.in_domain)
    if _has_area(outside):
        yield _hatch(ax, made, outside, "////", "outside the domain")
    unknown = _whole(made, _law_is_unknown(made))
    if _has_area(unknown) and _has_area(1.0 - unknown):  # of all the map `tell_fixed` says it
        yield _hatch(ax, made, unknown * (1.0 - outside), "....", "projected law, error unknown")


def _law_is_unknown(made: MapRecord) -> Any:
    """Return where the law was to be chosen, and nobody knows the error of any."""
    error = made.force.law_error
    return np.isnan(error) if isinstance(made.model, AnyLaw) and error is not None else False


def _has_area(mask: Array) -> bool:
    """Return whether it is more than single nodes, such as rounding puts beyond an edge."""
    return bool((mask[1:, 1:] * mask[1:, :-1] * mask[:-1, 1:] * mask[:-1, :-1]).any())


def _hatch(ax: Axes, made: MapRecord, where: Array, hatch: str, label: str) -> Any:
    hatched: Any = ax.contourf(
        *_mesh(made),
        _smooth(where),
        levels=[0.5, 2.0],
        colors="none",
        hatches=[hatch],
        zorder=0.5,
    )
    one_artist = hasattr(hatched, "set_edgecolor")  # since matplotlib 3.8
    artists = [hatched] if one_artist else hatched.collections
    for artist in artists:
        artist.set_edgecolor(_HATCH)
        artist.set_linewidth(0.0)
    return patch(label, "white", hatch=hatch, ec=_HATCH)


def _smooth(field: Array) -> Array:
    """Return the mean of each node and its neighbours, so that an edge has no steps of nodes."""
    for axis in (0, 1):
        for _ in range(_SMOOTHINGS):
            ends = np.take(field, [0], axis), np.take(field, [-1], axis)
            padded = np.concatenate([ends[0], field, ends[1]], axis)
            count = field.shape[axis]
            field = np.mean([np.take(padded, range(i, i + count), axis) for i in range(3)], axis=0)
    return field


def tell_fixed(ax: Axes, made: MapRecord) -> None:
    """Write what a map fixes below it, at the right; nothing where nothing is fixed."""
    words = []
    for name, value in made.fixed.items():
        one = COORDINATES[name]
        factor, unit = SHOWN_UNITS[one.unit]
        shown_unit = "" if unit == "-" else f" {unit}"
        words.append(f"${one.symbol}$ = {number(factor * value)}{shown_unit}")
    tip = getattr(made.model, "notch_radius", None)
    if tip is not None:
        unit = "$R_w$" if "wire_radius" in made.units else "m"
        words.append(rf"$r_{{\mathrm{{tip}}}}$ = {number(tip)} {unit}")
    if np.all(_law_is_unknown(made)):
        words.append("projected law, error unknown")
    ax.annotate(
        ", ".join(words),
        (1.0, 0.0),
        (0.0, -30.0),
        xycoords="axes fraction",
        textcoords="offset points",
        ha="right",
        va="top",
        fontsize=SMALL,
        color=GREY,
        gid="fixed",
    )


def draw_boundaries(
    ax: Axes, made: MapRecord, limits: set[str], contact: bool
) -> Iterator[tuple[Any, list[Array]]]:
    """Draw the lines; yield one handle for the legend and the lines of each boundary."""
    equal, thin = 0, None
    for one in made.boundaries:
        style: dict[str, Any]
        if one.kind == "dominance":
            handle = _lines(ax, made, one, color="black", lw=0.5)
            if thin is None:  # one entry of the legend stands for all of them
                thin = handle
                yield thin, []
            continue
        if one.kind == "equal-terms":
            style = {"color": "black", "lw": 1.2, "ls": LINES[equal % len(LINES)]}
            equal += 1
        elif one.kind == "limit" and one.about[0] in limits:
            colour, dashes = LIMIT_LINES[one.about[0]]
            style = {"color": colour, "lw": 1.0, "ls": dashes}
        elif one.kind == "contact" and contact:
            style = {"color": _CONTACT, "lw": 0.8, "path_effects": [_ticks()]}
        else:
            continue
        yield _lines(ax, made, one, **style), list(one.lines)


def _lines(ax: Axes, made: MapRecord, one: Boundary, **style: Any) -> Any:
    handle = None
    for line in one.lines:
        if one.kind == "contact":
            line = _with_indentation_left(made, line)
        label = _legend_text(one, made) if handle is None else None
        xy = _shown(made.x, line[:, 0]), _shown(made.y, line[:, 1])
        (drawn,) = ax.plot(*xy, label=label, zorder=2, **style)
        handle = handle or drawn
    return handle


def _legend_text(one: Boundary, made: MapRecord) -> str:
    if one.kind == "dominance":
        return rf"a term$={share(made.regime.threshold)}\,F_{{ss}}/T$"
    if one.kind == "limit":
        return one.equation.replace("is off by", "off by")
    if one.kind == "contact":
        return f"${one.symbol}$, ticks: indentation"
    return f"${one.symbol}$"


def _ticks() -> Any:
    from matplotlib.patheffects import TickedStroke

    class _Ticks(TickedStroke):
        """Ticks to the left of the line, and the line itself."""

        def draw_path(self, renderer: Any, gc: Any, *args: Any) -> None:
            super().draw_path(renderer, gc, *args)
            renderer.draw_path(gc, *args)

    return _Ticks(spacing=7.0, length=0.6, angle=90)


def _with_indentation_left(made: MapRecord, line: Array) -> Array:
    """Return the line in the direction that has indentation, larger g, on its left side."""
    middle = len(line) // 2
    (x0, x1), (y0, y1) = (
        axis.to_scale(line[middle - 1 : middle + 1, i]) for i, axis in enumerate((made.x, made.y))
    )
    left = np.array([-(y1 - y0), x1 - x0])  # of the direction along the line
    g = (
        made.quantities["toughness"]
        * (made.quantities["shear_modulus"] * made.quantities["wire_radius"]) ** -1
    )
    rising = np.array([g.p, g.q])  # of ln g, by the signs along the axes
    return line if left @ rising > 0.0 else line[::-1]


def draw_points(
    ax: Axes, made: MapRecord, points: MapPoints, centre: Array, error: Array, marker: str
) -> Any:
    """Draw points with bars of one standard error; return the handle for the legend."""
    x, y = _shown(made.x, centre[0]), _shown(made.y, centre[1])
    bars = _shown(made.x, error[0]), _shown(made.y, error[1])
    # a bar to below 0 has no end on a log scale
    low = [np.minimum(bar, 0.999 * value) for bar, value in zip(bars, (x, y), strict=True)]
    return ax.errorbar(
        x,
        y,
        xerr=[low[0], bars[0]] if bars[0].any() else None,
        yerr=[low[1], bars[1]] if bars[1].any() else None,
        fmt=marker,
        ms=4,
        color="black",
        mec="white",
        mew=0.5,
        capsize=2,
        elinewidth=0.8,
        zorder=4,
        label=points.label,
    )


def bars(centre: Array, error: Array) -> list[Array]:
    """Return the bars of points as lines, a marker's own place included."""
    low, high = np.maximum(centre - error, 1e-3 * centre), centre + error
    horizontal = [
        np.array([[a, y], [b, y]]) for a, b, y in zip(low[0], high[0], centre[1], strict=True)
    ]
    vertical = [
        np.array([[x, a], [x, b]]) for x, a, b in zip(centre[0], low[1], high[1], strict=True)
    ]
    return horizontal + vertical


def patch(label: str, colour: str, **style: Any) -> Any:
    """Return a handle for the legend that stands for a region."""
    from matplotlib.patches import Patch

    return Patch(fc=colour, lw=0.5, label=label, **{"ec": GREY, **style})

"""Figures of regime maps; matplotlib is imported by the functions that need it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from surrogate.boundaries import Boundary
from surrogate.errors import InputError
from surrogate.figures import (
    GREY,
    MEDIUM,
    SMALL,
    figure_width,
    legend_above,
    new_axes,
    new_figure,
    picture_file,
    save_figure,
)
from surrogate.force_models import force_model
from surrogate.label_places import GRID, best_place, blocked_by_line
from surrogate.map_axes import MapAxis
from surrogate.map_boundaries import formula_name
from surrogate.map_points import MapPoints, places
from surrogate.map_style import (
    ERROR_COLOURS,
    ERROR_LEVELS,
    FILLS,
    LIMIT_LINES,
    LINES,
    NAMES,
    POINT_MARKERS,
    SHOWN_UNITS,
    axis_label,
)
from surrogate.maps import RegimeMap
from surrogate.validation import shown

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["plot_regime_map", "save_regime_map"]

Array = NDArray[np.float64]

_HEIGHTS = {"single": 3.5, "double": 5.0}
_COLUMNS = {"single": 2, "double": 3}
_CONTACT, _HATCH = "#333333", "#909090"


def plot_regime_map(
    made: RegimeMap,
    ax: Axes | None = None,
    points: Sequence[MapPoints] = (),
    *,
    limits: Sequence[str] = (),
    contact: bool = True,
    error_of: str | None = None,
    width: str = "single",
) -> Axes:
    """Draw a regime map: named regions, boundaries with their equations, and experiments on it.

    Regions are filled where a term has the threshold's share of the force or more; between them
    is the transition. Lines show where terms are equal. Where the model's own condition does not
    hold, the map is hatched. Lengths are shown in mm and stresses in kPa. Changes nothing outside
    its axes but their figure's layout, and shows nothing on the screen.

    Parameters
    ----------
    made : RegimeMap
        What `regime_map` returned.
    ax : matplotlib.axes.Axes, optional
        Where to draw; a new figure by default.
    points : sequence of MapPoints, optional
        Materials or experiments, with bars of one standard error where known.
    limits : sequence of str, optional
        Limit formulas, by the names of their models, of which to draw the line on which they miss
        the map's model by `made.miss`.
    contact : bool, default True
        Whether to draw where the wire begins to touch the crack tip, with ticks on the side of
        indentation cutting.
    error_of : str, optional
        A model of which to show the error beside the map's model, by colour, instead of the fills.
    width : str, default "single"
        "single" or "double": columns of a journal that a new figure fills, and of the legend.

    Returns
    -------
    matplotlib.axes.Axes
        The axes, for instance for ``ax.figure.savefig("map.pdf")``; `save_regime_map` writes files
        that do not change from run to run.

    Raises
    ------
    InputError
        If `made` is no map, the width has no such name, a limit has no line of that name, or a
        point is outside the map.
    UnknownModelError
        If there is no model `error_of`.
    WirecutError
        If matplotlib is not installed.

    References
    ----------
    arXiv:2412.02021, Eqs. (10) to (15).

    Examples
    --------
    >>> import matplotlib.figure
    >>> from surrogate.maps import regime_map
    >>> made = regime_map("R_w/l_e", "R_w/l_w", ((1e-4, 10), (0.01, 100)), {"xi": 0.1}, nodes=51)
    >>> ax = plot_regime_map(made, matplotlib.figure.Figure().add_subplot())
    >>> ax.get_xlabel()
    'radius over elasto-cohesive length $R_w/l_e$ [-]'
    """
    size = (figure_width(width), _HEIGHTS[width])
    wanted = _checked(made, limits, error_of)
    located = [(one, *places(one, made)) for one in points]
    if ax is None:
        ax = new_axes(size)
    _set_up(ax, made)
    if error_of is None:
        _fill_regions(ax, made)
    else:
        _fill_error(ax, made, error_of)
    outside = list(_hatch_outside(ax, made))
    handles, drawn = [], []
    for line_handle, lines in _draw_boundaries(ax, made, wanted, contact):
        handles.append(line_handle)
        drawn += lines
    for i, (one, centre, error) in enumerate(located):
        handles.append(_draw_points(ax, made, one, centre, error, POINT_MARKERS[i % 6]))
        drawn += _bars(centre, error)
    columns = _add_legend(ax, _COLUMNS[width], handles + outside)
    if nameless := _name_regions(ax, made, drawn, error_of is not None):
        regions = [_patch(NAMES[name].replace("\n", " "), FILLS[name]) for name in nameless]
        _add_legend(ax, columns, handles + outside + regions)
    return ax


def save_regime_map(
    made: RegimeMap,
    file: str | PathLike[str],
    points: Sequence[MapPoints] = (),
    **options: Any,
) -> None:
    """Write the picture of `plot_regime_map` to a file; equal maps give equal files.

    Parameters
    ----------
    made : RegimeMap
        What `regime_map` returned.
    file : str or path-like
        Where to write; the ending chooses the format (.png, .pdf, .svg). Text stays text.
    points : sequence of MapPoints, optional
        As in `plot_regime_map`.
    **options
        The other options of `plot_regime_map`, without axes.

    Raises
    ------
    InputError
        If the format is unknown, the file cannot be written, or an option is out of range.
    WirecutError
        If matplotlib is not installed.

    Examples
    --------
    >>> from surrogate.maps import regime_map
    >>> made = regime_map("g", "xi", ((0.1, 10), (0.1, 10)), {"tau_w/mu": 1}, nodes=5)
    >>> save_regime_map(made, "map.doc")
    Traceback (most recent call last):
        ...
    surrogate.errors.InputError: map.doc has no picture's ending; choose .png, .pdf or .svg.
    """
    file = picture_file(file)
    width = options.get("width", "single")
    figure = new_figure((figure_width(width), _HEIGHTS[width]))
    plot_regime_map(made, figure.add_subplot(), points, **options)
    save_figure(figure, file)


def _checked(made: object, limits: Sequence[str], error_of: str | None) -> set[str]:
    if not isinstance(made, RegimeMap):
        raise InputError(
            f"a map must be what regime_map returned, but is {shown(made)} "
            f"({type(made).__name__}); give regime_map(x, y, ranges, fixed, model)."
        )
    known = [one.about[0] for one in made.boundaries if one.kind == "limit"]
    for limit in limits:
        force_model(limit)
        if limit not in LIMIT_LINES:
            raise InputError(
                f"a limit must be one of {', '.join(LIMIT_LINES)}, but is {shown(limit)}; "
                f"this map has {', '.join(known) or 'none'}."
            )
    if error_of is not None:
        force_model(error_of)
    return set(limits)


def _set_up(ax: Axes, made: RegimeMap) -> None:
    for axis, which in ((made.x, "x"), (made.y, "y")):
        getattr(ax, f"set_{which}scale")(axis.scale)
        getattr(ax, f"set_{which}lim")(*_shown(axis, axis.values[[0, -1]]))
        getattr(ax, f"set_{which}label")(axis_label(axis), fontsize=MEDIUM)
    ax.tick_params(which="both", labelsize=SMALL)
    ax.set_facecolor(FILLS["transition"])


def _shown(axis: MapAxis, values: Any) -> Any:
    """Return values of an axis in the unit that figures show."""
    return SHOWN_UNITS[axis.unit][0] * np.asarray(values)


def _mesh(made: RegimeMap) -> tuple[Array, Array]:
    return _shown(made.x, made.x.values), _shown(made.y, made.y.values)


def _whole(made: RegimeMap, values: Any) -> Array:
    shape = made.y.values.size, made.x.values.size
    return np.array(np.broadcast_to(np.asarray(values, dtype=float), shape))


def _fill_regions(ax: Axes, made: RegimeMap) -> None:
    for name, share in made.term_shares.items():
        values = _whole(made, share)
        if np.any(values >= made.regime.threshold):
            levels = [made.regime.threshold, 2.0]
            ax.contourf(*_mesh(made), values, levels=levels, colors=[FILLS[name]], zorder=0)


def _fill_error(ax: Axes, made: RegimeMap, model: str) -> None:
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


def _hatch_outside(ax: Axes, made: RegimeMap) -> Iterator[Any]:
    """Hatch where the model does not hold; yield the handle for the legend."""
    outside = 1.0 - _whole(made, made.force.in_domain)
    if outside.any():
        hatched: Any = ax.contourf(
            *_mesh(made), outside, levels=[0.5, 2.0], colors="none", hatches=["////"], zorder=0.5
        )
        one_artist = hasattr(hatched, "set_edgecolor")  # since matplotlib 3.8
        artists = [hatched] if one_artist else hatched.collections
        for artist in artists:
            artist.set_edgecolor(_HATCH)
            artist.set_linewidth(0.0)
        yield _patch("outside the domain", "white", hatch="////", ec=_HATCH)


def _draw_boundaries(
    ax: Axes, made: RegimeMap, limits: set[str], contact: bool
) -> Iterator[tuple[Any, list[Array]]]:
    """Draw the lines; yield one handle for the legend and the lines of each boundary."""
    equal = 0
    for one in made.boundaries:
        style: dict[str, Any]
        if one.kind == "dominance":
            _lines(ax, made, one, color=GREY, lw=0.4)
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


def _lines(ax: Axes, made: RegimeMap, one: Boundary, **style: Any) -> Any:
    handle = None
    for line in one.lines:
        if one.kind == "contact":
            line = _with_indentation_left(made, line)
        label = _legend_text(one) if handle is None else None
        xy = _shown(made.x, line[:, 0]), _shown(made.y, line[:, 1])
        (drawn,) = ax.plot(*xy, label=label, zorder=2, **style)
        handle = handle or drawn
    return handle


def _legend_text(one: Boundary) -> str:
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


def _with_indentation_left(made: RegimeMap, line: Array) -> Array:
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


def _draw_points(
    ax: Axes, made: RegimeMap, points: MapPoints, centre: Array, error: Array, marker: str
) -> Any:
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


def _bars(centre: Array, error: Array) -> list[Array]:
    """Return the bars of points as lines, a marker's own place included."""
    low, high = np.maximum(centre - error, 1e-3 * centre), centre + error
    horizontal = [
        np.array([[a, y], [b, y]]) for a, b, y in zip(low[0], high[0], centre[1], strict=True)
    ]
    vertical = [
        np.array([[x, a], [x, b]]) for x, a, b in zip(centre[0], low[1], high[1], strict=True)
    ]
    return horizontal + vertical


def _add_legend(ax: Axes, columns: int, handles: list[Any]) -> int:
    """Put a legend above the axes that is no wider than they are; return its columns."""
    root = ax.figure.canvas.figure
    if old := ax.get_legend():
        old.remove()
    root.draw_without_rendering()
    room = 1.1 * ax.get_window_extent().width
    for number in range(columns, 0, -1):
        legend_above(ax, number, handles)
        legend = ax.get_legend()
        if legend is None or legend.get_window_extent().width <= room:
            break
    return number


def _patch(label: str, colour: str, **style: Any) -> Any:
    from matplotlib.patches import Patch

    return Patch(fc=colour, lw=0.5, label=label, **{"ec": GREY, **style})


def _name_regions(ax: Axes, made: RegimeMap, lines: Sequence[Array], coloured: bool) -> list[str]:
    """Write each region's name where nothing is, upright where it fits only so.

    Return the names of regions that are too small.
    """
    root = ax.figure.canvas.figure
    root.draw_without_rendering()
    window = ax.get_window_extent()
    blocked = np.zeros((GRID, GRID), dtype=bool)
    for line in lines:
        blocked |= blocked_by_line(_fraction(made.x, line[:, 0]), _fraction(made.y, line[:, 1]))
    centres = (np.arange(GRID) + 0.5) / GRID
    columns, rows = (
        np.rint(centres * (axis.values.size - 1)).astype(int) for axis in (made.x, made.y)
    )
    labels = np.broadcast_to(made.regime.dominant, (made.y.values.size, made.x.values.size))
    region = labels[np.ix_(rows, columns)]
    busy = coloured or not np.all(made.force.in_domain)
    nameless = []
    for name in np.unique(region):
        text = ax.text(
            0.5,
            0.5,
            NAMES[name],
            transform=ax.transAxes,
            ha="center",
            va="center",
            fontsize=SMALL,
            style="italic" if name == "transition" else "normal",
            zorder=3,
            bbox={"fc": "white", "ec": "none", "alpha": 0.8, "pad": 1.0} if busy else None,
        )
        box = text.get_window_extent()
        size = box.width / window.width, box.height / window.height
        turned = box.height / window.width, box.width / window.height
        free = (region == name) & ~blocked
        if place := best_place(free, *size):
            text.set_position(place)
        elif place := best_place(free, *turned):
            text.set_position(place)
            text.set_rotation(90)
        else:
            text.remove()
            nameless.append(str(name))
    return nameless


def _fraction(axis: MapAxis, values: Any) -> Array:
    low, high = axis.to_scale(axis.values[[0, -1]])
    return np.asarray((axis.to_scale(values) - low) / (high - low))

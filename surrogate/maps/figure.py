"""Figures of regime maps; matplotlib is imported by the functions that need it."""

from __future__ import annotations

from collections.abc import Sequence
from os import PathLike
from typing import TYPE_CHECKING, Any

from surrogate.basics.checks import flag, items, shown
from surrogate.basics.figures import (
    FILLS,
    figure_width,
    in_style,
    new_axes,
    new_figure,
    picture_file,
    require_axes,
    save_figure,
)
from surrogate.choosing.by_name import force_model
from surrogate.errors import InputError
from surrogate.maps.belonging import require_the_same
from surrogate.maps.boundaries import limit_names
from surrogate.maps.drawing import (
    LIMIT_LINES,
    POINT_MARKERS,
    bars,
    draw_boundaries,
    draw_points,
    fill_error,
    fill_regions,
    hatch_outside,
    patch,
    set_up,
    tell_fixed,
)
from surrogate.maps.labels import NAMES, add_legend, name_regions
from surrogate.maps.points import MapPoints, places
from surrogate.maps.record import MapRecord

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["plot_regime_map", "save_regime_map"]

_HEIGHTS = {"single": 3.5, "double": 5.0}
_COLUMNS = {"single": 2, "double": 3}


def plot_regime_map(
    made: MapRecord,
    ax: Axes | None = None,
    points: Sequence[MapPoints] = (),
    *,
    limits: Sequence[str] = (),
    contact: bool = True,
    error_of: str | None = None,
    width: str = "single",
) -> Axes:
    """Draw a regime map: named regions, boundaries with their equations, and experiments on it.

    Regions are filled where a term has the threshold's share of the force or more, which ends on
    thin lines; between them is the transition. Thick lines show where terms are equal. Where the
    model's own condition does not hold, the map is hatched. Lengths are shown in mm and stresses in
    kPa. Changes nothing outside its axes but their figure's layout, and shows nothing on the
    screen.

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
        If `made` is no map or ends beyond 1e100, the width has no such name, a limit has no line
        of that name, a point is outside the map or not of what it fixes, or an argument of another
        kind than is asked for.
    UnknownModelError
        If there is no model `error_of`, or a limit is none.
    DomainError
        If the model `error_of` has no answer at a node.
    WirecutError
        If matplotlib is not installed.

    References
    ----------
    arXiv:2412.02021, Eqs. (10) to (15).

    Examples
    --------
    >>> import matplotlib.figure
    >>> from surrogate.maps.make import regime_map
    >>> made = regime_map("R_w/l_e", "R_w/l_w", ((1e-4, 10), (0.01, 100)), {"xi": 0.1}, nodes=51)
    >>> ax = plot_regime_map(made, matplotlib.figure.Figure().add_subplot())
    >>> ax.get_xlabel()
    'radius over elasto-cohesive length $R_w/l_e$ [-]'
    """
    size = (figure_width(width), _HEIGHTS[width])
    wanted = _checked(made, limits, error_of)
    contact = flag("contact", contact)
    for one in _map_points(points):
        require_the_same(one, made)
    located = [(one, *places(one, made)) for one in _map_points(points)]
    ax = new_axes(size) if ax is None else require_axes(ax)
    set_up(ax, made)
    if error_of is None:
        fill_regions(ax, made)
    else:
        fill_error(ax, made, error_of)
    outside = list(hatch_outside(ax, made))
    handles, drawn, marks = [], [], []
    for line_handle, lines in draw_boundaries(ax, made, wanted, contact):
        handles.append(line_handle)
        drawn += lines
    for i, (one, centre, error) in enumerate(located):
        handles.append(draw_points(ax, made, one, centre, error, POINT_MARKERS[i % 6]))
        marks += bars(centre, error)
    tell_fixed(ax, made)
    columns = add_legend(ax, _COLUMNS[width], handles + outside)
    nameless = name_regions(ax, made, drawn, marks, error_of is not None)
    if nameless and error_of is None:  # else no region has a colour of its own
        regions = [patch(NAMES[name].replace("\n", " "), FILLS[name]) for name in nameless]
        add_legend(ax, columns, handles + outside + regions)
    return ax


@in_style
def save_regime_map(
    made: MapRecord,
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
    >>> from surrogate.maps.make import regime_map
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


def _checked(made: object, limits: object, error_of: object) -> set[str]:
    if not isinstance(made, MapRecord):
        raise InputError(
            f"a map must be what regime_map returned, but is {shown(made)} "
            f"({type(made).__name__}); give regime_map(x, y, ranges, fixed, model)."
        )
    known = [one.about[0] for one in made.boundaries if one.kind == "limit"]
    names = limit_names(limits)
    for limit in names:
        if limit not in LIMIT_LINES:
            raise InputError(
                f"limits must be some of {', '.join(LIMIT_LINES)}, but one is {shown(limit)}; "
                f"this map has {', '.join(known) or 'none'}."
            )
    if error_of is not None:
        force_model(error_of, "error_of")
    return set(names)


def _map_points(points: object) -> tuple[MapPoints, ...]:
    found = items("points", points, "[MapPoints(scene, 'gel')]")
    for one in found:
        if not isinstance(one, MapPoints):
            raise InputError(
                f"points must be MapPoints, but one is {shown(one)} ({type(one).__name__}); give "
                "for instance [MapPoints(scene, 'gel')]."
            )
    return found

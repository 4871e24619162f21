"""What all figures have in common: sizes, colours, files; matplotlib is imported where needed."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import wraps
from io import BytesIO
from os import PathLike
from pathlib import Path, PurePath
from string import ascii_lowercase
from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.checks import shown
from surrogate.basics.extras import require_extra
from surrogate.basics.files import file_name, written_whole
from surrogate.basics.picture_form import picture_form
from surrogate.errors import InputError

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.figure import Figure

__all__ = [
    "BLUE",
    "COLOURS",
    "ENDINGS",
    "FILLS",
    "GREY",
    "MARKERS",
    "MEDIUM",
    "RED",
    "SINGLE_COLUMN",
    "SMALL",
    "WIDTHS",
    "figure_width",
    "in_style",
    "label_at_right",
    "label_axes",
    "legend_above",
    "legend_over",
    "new_axes",
    "new_figure",
    "panels",
    "picture_file",
    "plain_log_ticks",
    "require_axes",
    "require_matplotlib",
    "save_figure",
    "style",
    "write_svg",
]

Arguments = ParamSpec("Arguments")
Result = TypeVar("Result")

SINGLE_COLUMN = (3.4, 2.9)
"""Width and height of a figure that fills one column of a journal [inch]."""

WIDTHS = {"single": 3.4, "double": 7.0}
"""Width of a figure over one and over two columns [inch]."""

SMALL, MEDIUM = 7.0, 8.0
BLUE, RED, GREY = "#1f5fa8", "#c0392b", "#555555"

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000")
"""Okabe and Ito's colours, which the colour-blind tell apart, without the yellow."""

MARKERS = ("o", "s", "^", "D", "v", "P", "X")

FILLS = {
    "transition": "#ffffff",
    "toughness-and-friction": "#cfe4f2",
    "cleavage": "#cfe4f2",
    "wear": "#efb37c",
    "friction-stiffness": "#6f9fc0",
    "friction": "#6f9fc0",
}
"""Fill of each term of the force: told apart by the colour-blind, and by lightness in grey."""

ENDINGS = (".png", ".pdf", ".svg", ".tif", ".tiff")

# Text that journals can edit, and nothing that changes from run to run.
_STYLE: Any = {
    "pdf.fonttype": 42,
    "ps.fonttype": 42,
    "svg.fonttype": "none",
    "svg.hashsalt": "wirecut",
}
_METADATA: dict[str, dict[str, Any]] = {
    ".pdf": {"CreationDate": None, "ModDate": None},
    ".svg": {"Date": None},
    ".png": {},
    ".tif": {},
    ".tiff": {},
}


def require_matplotlib() -> None:
    """Raise a `WirecutError` with the remedy unless matplotlib is installed.

    Examples
    --------
    >>> require_matplotlib()
    """
    require_extra("matplotlib", "drawing", "plot")


def picture_file(file: str | PathLike[str]) -> str:
    """Return the name of a picture's file, whose ending chooses the format.

    Raises
    ------
    InputError
        If it is no path, or ends otherwise than in .png, .pdf or .svg.

    Examples
    --------
    >>> picture_file("map.doc")
    Traceback (most recent call last):
        ...
    surrogate.errors.InputError: map.doc has no picture's ending; choose .png, .pdf or .svg.
    """
    name = file_name(file)
    if PurePath(name).suffix.lower() not in ENDINGS:
        raise InputError(f"{name} has no picture's ending; choose .png, .pdf or .svg.")
    return name


def new_figure(size: tuple[float, float]) -> Figure:
    """Return an empty figure of a size [inch] that no window knows of."""
    require_matplotlib()
    from matplotlib.figure import Figure

    width = picture_form().width
    if width is not None:  # a wider one need not be as much higher
        size = width, size[1] * (width / size[0]) ** 0.5
    return Figure(figsize=size, layout="constrained")


def new_axes(size: tuple[float, float]) -> Axes:
    """Return the axes of a new figure of a size [inch] that notebooks show."""
    require_matplotlib()
    import matplotlib.pyplot as plt

    return plt.subplots(figsize=size, layout="constrained")[1]


def require_axes(ax: object) -> Axes:
    """Return axes of matplotlib, or raise an `InputError` that says what is one.

    Examples
    --------
    >>> require_axes("left")
    Traceback (most recent call last):
        ...
    surrogate.errors.InputError: ax must be axes of matplotlib, but ax = 'left' (str); give for \
instance figure.add_subplot(), or None for a new figure.
    """
    require_matplotlib()
    from matplotlib.axes import Axes

    if isinstance(ax, Axes):
        return ax
    raise InputError(
        f"ax must be axes of matplotlib, but ax = {shown(ax)} ({type(ax).__name__}); give for "
        "instance figure.add_subplot(), or None for a new figure."
    )


def figure_width(width: object) -> float:
    """Return the width of a figure [inch] by its name.

    Examples
    --------
    >>> figure_width("double")
    7.0
    """
    if isinstance(width, str) and width in WIDTHS:
        return WIDTHS[width]
    raise InputError(f"width must be 'single' or 'double', but is {shown(width)}; choose one.")


@contextmanager
def style() -> Iterator[None]:
    """Have figures drawn and written in this style, whatever the user's settings of matplotlib are.

    Examples
    --------
    >>> import matplotlib
    >>> with matplotlib.rc_context({"text.usetex": True}), style():
    ...     matplotlib.rcParams["text.usetex"]
    False
    """
    require_matplotlib()
    import matplotlib

    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(_STYLE)
        yield


def in_style(function: Callable[Arguments, Result]) -> Callable[Arguments, Result]:
    """Return a function that draws and writes whole figures, so that it does it in `style`."""

    @wraps(function)
    def drawn(*args: Arguments.args, **kwargs: Arguments.kwargs) -> Result:
        with style():
            return function(*args, **kwargs)

    return drawn


def save_figure(figure: Figure, file: str | PathLike[str]) -> None:
    """Write a figure: equal figures give equal files, with text that stays text.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        The figure.
    file : str or path-like
        Where to write; the ending chooses the format (.png, .pdf, .svg).

    Raises
    ------
    InputError
        If the format is unknown or the file cannot be written.
    """
    name = picture_file(file)
    content = BytesIO()  # because matplotlib's PDF does not get over a full disk
    _write(figure, content, PurePath(name).suffix.lower())
    with written_whole(name) as temporary:
        Path(temporary).write_bytes(content.getvalue())


def write_svg(figure: Figure, stream: Any) -> None:
    """Write a figure as SVG into an open stream of text."""
    _write(figure, stream, ".svg")


def _write(figure: Figure, file: Any, ending: str) -> None:
    from matplotlib import rc_context

    options: dict[str, Any] = {"metadata": _METADATA[ending]}
    if ending in (".tif", ".tiff"):
        options = {"pil_kwargs": {"compression": "tiff_lzw"}}
    with rc_context(_STYLE):
        figure.savefig(file, format=ending[1:], dpi=picture_form().dpi, **options)


LARGEST_SHOWN = 1e100
"""Ticks go decades beyond the ends of an axis, and must stay floating-point numbers."""


def legend_above(
    ax: Axes,
    columns: int,
    handles: list[Any] | None = None,
    left: float = -0.1,
    inside: tuple[float, float] | None = None,
) -> None:
    """Put the legend above the axes, where no data can be, from a fraction of their width on.

    Axes of somebody else's figure, which nothing makes room in, have it inside: above it would be
    cut off, or cover another panel. There its upper left corner is at a fraction of the axes, or
    where it covers least.
    """
    if handles is None:
        handles = ax.get_legend_handles_labels()[0]
    if not handles or not picture_form().legend:
        return
    if ax.figure.canvas.figure.get_layout_engine() is None:
        place: Any = {"loc": "upper left", "bbox_to_anchor": inside} if inside else {"loc": "best"}
        ax.legend(handles=handles, fontsize=SMALL, framealpha=0.85, handlelength=1.6, **place)
        return
    ax.legend(
        handles=handles,
        loc="lower left",
        bbox_to_anchor=(left, 1.0),
        ncols=columns,
        fontsize=SMALL,
        frameon=False,
        handlelength=1.6,
        columnspacing=1.0,
        borderaxespad=0.2,
    )


def legend_over(figure: Figure, handles: Sequence[Any], columns: int) -> None:
    """Put one legend over all panels of a figure, where no data can be."""
    if picture_form().legend and handles:
        figure.legend(
            handles=handles,
            loc="outside upper left",
            ncols=columns,
            fontsize=SMALL,
            frameon=False,
            handlelength=1.8,
            columnspacing=1.2,
        )


def plain_log_ticks(axis: Axis, subs: Sequence[float]) -> None:
    """Number a logarithmic axis at multiples of the powers of ten, without exponents."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    axis.set_major_locator(LogLocator(subs=tuple(subs)))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_formatter(NullFormatter())


def label_axes(ax: Axes, x: str, y: str) -> None:
    """Name both axes, and leave the box around them open."""
    ax.set_xlabel(x, fontsize=MEDIUM)
    ax.set_ylabel(y, fontsize=MEDIUM)
    ax.tick_params(which="both", labelsize=SMALL)
    ax.spines[["top", "right"]].set_visible(False)


def panels(figure: Figure, columns: int, rows: int = 1, **options: Any) -> NDArray[Any]:
    """Return the axes of panels, rows by columns, lettered where there are several."""
    axes = figure.subplots(rows, columns, squeeze=False, **options)
    for letter, ax in zip(ascii_lowercase, axes.flat, strict=False):
        ax.tick_params(which="both", labelsize=SMALL)
        ax.spines[["top", "right"]].set_visible(False)
        if axes.size > 1:
            ax.set_title(f"({letter})", fontsize=MEDIUM, loc="left")
    return np.asarray(axes)


def label_at_right(
    ax: Axes, labels: Sequence[tuple[float, str]], colours: Mapping[str, str] | None = None
) -> None:
    """Write words outside the right edge, at heights in data and a line's height apart."""
    low, high = ax.get_ylim()
    height = float(ax.figure.canvas.figure.get_size_inches()[1]) * 72.0 * 0.75  # of the axes
    room = 1.15 * SMALL * (high - low) / height
    least = low
    for at, words in sorted(labels):
        at = max(at, least)
        least = at + room
        ax.annotate(
            words,
            (1.0, at),
            xycoords=("axes fraction", "data"),
            xytext=(3.0, 0.0),
            textcoords="offset points",
            va="center",
            fontsize=SMALL,
            color=(colours or {}).get(words, "black"),
            annotation_clip=False,
        )

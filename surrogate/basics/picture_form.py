"""How pictures are wanted that are written to files: width, dots, legend, diameters."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass

__all__ = ["PictureForm", "picture_form", "pictures_as"]


@dataclass(frozen=True)
class PictureForm:
    """How pictures are wanted that are written to files.

    Parameters
    ----------
    width : float or None
        Width [inch] in place of each figure's own.
    dpi : int
        Points an inch of pictures made of points (.png, .tif).
    legend : bool
        Whether to draw legends.
    diameters : bool
        Whether to show diameters of wires in place of radii.
    single_panel : bool
        Whether to draw the first panel alone of a figure that has several.
    """

    width: float | None = None
    dpi: int = 300
    legend: bool = True
    diameters: bool = False
    single_panel: bool = False


_FORM: ContextVar[PictureForm] = ContextVar("picture_form", default=PictureForm())  # noqa: B039


def picture_form() -> PictureForm:
    """Return how pictures are wanted here."""
    return _FORM.get()


@contextmanager
def pictures_as(form: PictureForm) -> Iterator[None]:
    """Have pictures written as somebody wants them.

    Examples
    --------
    >>> with pictures_as(PictureForm(legend=False)):
    ...     picture_form().legend
    False
    """
    token = _FORM.set(form)
    try:
        yield
    finally:
        _FORM.reset(token)

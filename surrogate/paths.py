"""Where the shipped data and fitted models are: in a wheel, an editable install or a checkout."""

from __future__ import annotations

import os
from functools import cache
from pathlib import Path

from surrogate.errors import InputError
from surrogate.validation import shown

__all__ = ["file_name", "model_file", "models_folder"]

_PACKAGE = Path(__file__).resolve().parent


def file_name(path: object) -> str:
    """Return a path as text.

    Parameters
    ----------
    path : str or path-like
        A file.

    Returns
    -------
    str
        Its name, with folders as given.

    Raises
    ------
    InputError
        If it is no path.

    Examples
    --------
    >>> file_name(Path("cuts.csv"))
    'cuts.csv'
    """
    try:
        return os.fsdecode(path)  # type: ignore[arg-type]
    except TypeError:
        raise InputError(
            f"a file must be named by text or a path, but is {shown(path)} "
            f"({type(path).__name__}); give the path of a file."
        ) from None


@cache
def models_folder() -> Path:
    """Return the folder of shipped data and models.

    A wheel carries it inside the package; a checkout, and an editable install of it, beside
    the package.

    Returns
    -------
    pathlib.Path
        The folder `models`.

    Raises
    ------
    InputError
        If the installation lacks it.

    Examples
    --------
    >>> models_folder().name
    'models'
    """
    for folder in (_PACKAGE / "models", _PACKAGE.parent / "models"):
        if folder.is_dir():
            return folder
    raise InputError(
        f"the folder 'models' is neither in {_PACKAGE} nor beside it, "
        "the installation is incomplete; install wirecut again."
    )


def model_file(name: str) -> Path:
    """Return the path of one shipped file.

    Parameters
    ----------
    name : str
        Name of the file, without folders.

    Returns
    -------
    pathlib.Path
        The file's path.

    Raises
    ------
    InputError
        If no file of this name is shipped.

    Examples
    --------
    >>> model_file("paam-wire-cutting.csv").name
    'paam-wire-cutting.csv'
    """
    folder = models_folder()
    shipped = {path.name: path for path in folder.iterdir() if path.is_file()}
    if name not in shipped:
        raise InputError(
            f"no file {name!r} is shipped; choose one of {', '.join(sorted(shipped))}."
        )
    return shipped[name]

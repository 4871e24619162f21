"""The file of fitted models as such: numbers with names, arrays, and whether they are intact.

Beside the file stands its checksum. Inside, every array has a digest of its own, so that a file in
which some numbers were changed is told from one that was fitted, whatever its checksum says.
"""

from __future__ import annotations

import io
import json
import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.files import file_name, read_archive, sha256
from surrogate.errors import InputError

__all__ = ["FILE", "REMEDY", "SCHEMA", "complete", "content_of", "file_in", "read_fitted"]

FILE = "surrogates.npz"
_FAMILY, _VERSION = "wirecut-surrogates-", 2
SCHEMA = f"{_FAMILY}{_VERSION}"
_READ = ("1", "2")  # the first version has neither A* nor B*, nor digests
_ABOUT, _DIGESTS = "about", "digests"
REMEDY = "install wirecut again, or make the file anew with regen-surrogate"


@contextmanager
def complete(what: str, command: str) -> Iterator[None]:
    """Raise an `InputError` where what a file holds turns out to lack something.

    Parameters
    ----------
    what : str
        What it is of, with "must be complete".
    command : str
        What makes the file anew.

    Examples
    --------
    >>> with complete("kappa", "a command"):
    ...     float({}["radius"])
    Traceback (most recent call last):
        ...
    surrogate.errors.InputError: kappa must be complete, but KeyError('radius') was met; install \
wirecut again, or make the file anew with a command.
    """
    try:
        yield
    except (KeyError, ValueError, TypeError, IndexError, AttributeError) as error:
        raise InputError(
            f"{what} must be complete, but {error!r} was met; install wirecut again, or make the "
            f"file anew with {command}."
        ) from None


def content_of(about: Mapping[str, Any], arrays: Mapping[str, Any]) -> bytes:
    """Return the content of a file: what is said about the arrays, and the arrays.

    Equal numbers give equal bytes.

    Examples
    --------
    >>> len(content_of({}, {"x": np.zeros(2)})) > 100
    True
    """
    digests = {name: _digest(np.asarray(values)) for name, values in arrays.items()}
    told = {"schema": SCHEMA, **about, _DIGESTS: digests}
    text = json.dumps(told, sort_keys=True, allow_nan=False)
    columns = {_ABOUT: np.frombuffer(text.encode(), dtype=np.uint8), **arrays}
    import zipfile  # which whoever only reads need not load

    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, values in columns.items():
            member = io.BytesIO()
            np.lib.format.write_array(member, np.asarray(values), allow_pickle=False)
            entry = zipfile.ZipInfo(f"{name}.npy")  # of a fixed date
            archive.writestr(entry, member.getvalue(), zipfile.ZIP_DEFLATED)
    return buffer.getvalue()


def file_in(
    folder: str, name: str, what: str, remedy: str, error: type[InputError] = InputError
) -> str:
    """Return the path of a file of models in a folder.

    Parameters
    ----------
    folder, name : str
        Where the models in use are, and the file.
    what : str
        What needs the file, with "must have".
    remedy : str
        What to do without it.
    error : type
        The kind of the error where there is none.

    Examples
    --------
    >>> file_in("/", "kappa.npz", "a law", "choose another law")
    Traceback (most recent call last):
        ...
    surrogate.errors.InputError: a law must have the file kappa.npz among the models in use, but / \
has none; choose another law.
    """
    file = os.path.join(folder, name)
    if os.path.isfile(file):
        return file
    raise error(
        f"{what} must have the file {name} among the models in use, but {folder} has none; "
        f"{remedy}."
    )


def _digest(values: NDArray[Any]) -> str:
    """Return the digest of an array: of its type, its shape and its numbers."""
    about = f"{values.dtype.str} {values.shape} ".encode()
    return sha256(about + np.ascontiguousarray(values).tobytes())[:16]


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
    file = file_name(path)
    content = _verified(file)
    about, arrays = _decoded(file, content)
    for name, values in arrays.items():
        if values.dtype.kind not in "fiu" or not np.all(np.isfinite(values)):
            raise InputError(
                f"{file} must hold finite numbers only, but {name} has others; {REMEDY}."
            )
        values.flags.writeable = False
    if about["schema"] == SCHEMA:
        _require_digests(file, about, arrays)
    return about, arrays


def _require_digests(
    file: str, about: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]
) -> None:
    found = {name: _digest(values) for name, values in arrays.items()}
    told = about.get(_DIGESTS)
    told = told if isinstance(told, dict) else {}
    changed = sorted(name for name in {*found, *told} if found.get(name) != told.get(name))
    if changed:
        raise InputError(
            f"{file} must hold what was fitted, but changed since: {', '.join(changed)}; {REMEDY}."
        )


def _verified(file: str) -> bytes:
    try:
        content, expected = _content(file), _content(f"{file}.sha256").split()[:1]
    except OSError as error:
        raise InputError(
            f"the fitted models must be read, but {error.filename} cannot be "
            f"({error.strerror}); {REMEDY}."
        ) from None
    except ValueError as error:
        raise InputError(f"{file} must name a file, but it cannot ({error}); {REMEDY}.") from None
    if [sha256(content).encode()] != expected:
        raise InputError(
            f"{file} must match the checksum beside it, but it does not: it is damaged or "
            f"incomplete; {REMEDY}."
        )
    return content


def _content(file: str) -> bytes:
    with open(file, "rb") as reader:
        return reader.read()


def _decoded(file: str, content: bytes) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
    try:
        arrays = read_archive(content)
        about = json.loads(arrays.pop(_ABOUT).tobytes(), parse_constant=_no_number)
        schema = str(about["schema"])
    except (KeyError, ValueError, TypeError, RecursionError) as error:
        raise InputError(
            f"{file} must be a file of fitted models, but it cannot be decoded ({error}); {REMEDY}."
        ) from None
    _require_schema(file, schema)
    return about, arrays


def _no_number(name: str) -> float:
    raise ValueError(f"{name} is no number")


def _require_schema(file: str, schema: str) -> None:
    version = schema.removeprefix(_FAMILY)
    if schema.startswith(_FAMILY) and version in _READ:
        return
    newer = schema.startswith(_FAMILY) and version.isdigit() and int(version) > _VERSION
    raise InputError(
        f"{file} must have the schema {SCHEMA!r}, but it has {schema!r}; "
        f"{'upgrade wirecut' if newer else REMEDY}."
    )

"""The file of fitted models: arrays with schema, domain, errors, provenance and a checksum."""

from __future__ import annotations

import hashlib
import io
import json
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from surrogate.archive import read_archive
from surrogate.errors import InputError
from surrogate.paths import file_name

__all__ = ["FILE", "SCHEMA", "checksum_line", "content_of", "read_fitted"]

FILE = "surrogates.npz"
_FAMILY, _VERSION = "wirecut-surrogates-", 1
SCHEMA = f"{_FAMILY}{_VERSION}"
_ABOUT = "about"
_REMEDY = "install wirecut again, or make the file anew with regen-surrogate"


def content_of(about: Mapping[str, Any], arrays: Mapping[str, Any]) -> bytes:
    """Return the content of a file: what is said about the arrays, and the arrays.

    Equal numbers give equal bytes.

    Examples
    --------
    >>> len(content_of({}, {"x": np.zeros(2)})) > 100
    True
    """
    text = json.dumps({"schema": SCHEMA, **about}, sort_keys=True, allow_nan=False)
    columns = {_ABOUT: np.frombuffer(text.encode(), dtype=np.uint8), **arrays}
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, values in columns.items():
            member = io.BytesIO()
            np.lib.format.write_array(member, np.asarray(values), allow_pickle=False)
            entry = zipfile.ZipInfo(f"{name}.npy")  # of a fixed date
            archive.writestr(entry, member.getvalue(), zipfile.ZIP_DEFLATED)
    return buffer.getvalue()


def checksum_line(name: str, content: bytes) -> bytes:
    """Return the line that goes beside a file: its SHA-256, as ``sha256sum --check`` reads it.

    Examples
    --------
    >>> checksum_line("surrogates.npz", b"")[-16:]
    b' surrogates.npz\\n'
    """
    return f"{hashlib.sha256(content).hexdigest()}  {name}\n".encode()


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
    file = Path(file_name(path))
    content = _verified(file)
    about, arrays = _decoded(file, content)
    for name, values in arrays.items():
        if values.dtype.kind not in "fiu" or not np.all(np.isfinite(values)):
            raise InputError(
                f"{file} must hold finite numbers only, but {name} has others; {_REMEDY}."
            )
        values.flags.writeable = False
    return about, arrays


def _verified(file: Path) -> bytes:
    try:
        content = file.read_bytes()
        expected = file.with_name(file.name + ".sha256").read_bytes().split()[:1]
    except OSError as error:
        raise InputError(
            f"the fitted models must be read, but {error.filename} cannot be "
            f"({error.strerror}); {_REMEDY}."
        ) from None
    if [hashlib.sha256(content).hexdigest().encode()] != expected:
        raise InputError(
            f"{file} must match the checksum beside it, but it does not: it is damaged or "
            f"incomplete; {_REMEDY}."
        )
    return content


def _decoded(file: Path, content: bytes) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
    try:
        arrays = read_archive(content)
        about = json.loads(arrays.pop(_ABOUT).tobytes(), parse_constant=_no_number)
        schema = str(about["schema"])
    except (KeyError, ValueError, TypeError, RecursionError) as error:
        raise InputError(
            f"{file} must be a file of fitted models, but it cannot be decoded ({error}); "
            f"{_REMEDY}."
        ) from None
    _require_schema(file, schema)
    return about, arrays


def _no_number(name: str) -> float:
    raise ValueError(f"{name} is no number")


def _require_schema(file: Path, schema: str) -> None:
    if schema == SCHEMA:
        return
    version = schema.removeprefix(_FAMILY)
    newer = schema.startswith(_FAMILY) and version.isdigit() and int(version) > _VERSION
    raise InputError(
        f"{file} must have the schema {SCHEMA!r}, but it has {schema!r}; "
        f"{'upgrade wirecut' if newer else _REMEDY}."
    )

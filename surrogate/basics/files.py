"""Files: where the shipped ones are, archives that may be damaged, tables, checksums."""

from __future__ import annotations

import io
import os
import struct
import zlib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from functools import cache
from importlib import import_module
from os import PathLike
from typing import TYPE_CHECKING, Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from surrogate.basics.checks import shown
from surrogate.errors import InputError

if TYPE_CHECKING:
    from pathlib import Path  # with hashlib and zipfile a good part of the time of a first force

__all__ = [
    "check_outputs",
    "checksum_line",
    "column_name",
    "file_name",
    "model_file",
    "models_folder",
    "read_archive",
    "sha256",
    "write_csv",
    "written_whole",
]

_PACKAGE = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))


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
    >>> from pathlib import Path
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
def models_folder() -> str:
    """Return the folder of shipped data and models.

    A wheel carries it inside the package; a checkout, and an editable install of it, beside
    the package.

    Returns
    -------
    str
        The folder `models`.

    Raises
    ------
    InputError
        If the installation lacks it.

    Examples
    --------
    >>> os.path.basename(models_folder())
    'models'
    """
    for parent in (_PACKAGE, os.path.dirname(_PACKAGE)):
        folder = os.path.join(parent, "models")
        if os.path.isdir(folder):
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
    from pathlib import Path

    folder = Path(models_folder())
    shipped = {path.name: path for path in folder.iterdir() if path.is_file()}
    if name not in shipped:
        raise InputError(
            f"no file {name!r} is shipped; choose one of {', '.join(sorted(shipped))}."
        )
    return shipped[name]


def opened(file: str) -> BinaryIO:
    try:
        return open(file, "rb")
    except OSError as error:
        raise InputError(
            f"{file} cannot be read ({error.strerror}); give the path of a file."
        ) from None
    except ValueError as error:
        raise InputError(
            f"{file!r} is not a file name ({error}); give the path of a file."
        ) from None


def read_archive(content: bytes) -> dict[str, NDArray[Any]]:
    """Return the arrays in the content of an npz file by their names; nothing is unpickled.

    Parameters
    ----------
    content : bytes
        The whole file.

    Returns
    -------
    dict of str to ndarray
        The arrays.

    Raises
    ------
    ValueError
        If it is no such file, or damaged, whatever numpy and zipfile make of that.

    Examples
    --------
    >>> buffer = io.BytesIO()
    >>> np.savez(buffer, x=np.arange(3))
    >>> read_archive(buffer.getvalue())
    {'x': array([0, 1, 2])}
    >>> read_archive(b"x")
    Traceback (most recent call last):
        ...
    ValueError: no archive of arrays: ...
    """
    try:
        return {name.removesuffix(".npy"): _array(member) for name, member in _members(content)}
    except Exception as error:  # numpy raises a dozen kinds, tokenize's among them
        raise ValueError(f"no archive of arrays: {error}") from None


def _array(member: bytes) -> NDArray[Any]:
    """Return the array of an npy file; a plain head is read without Python's own parser."""
    end = 10 + int.from_bytes(member[8:10], "little")
    between, words = (member[10:end].decode("latin-1").split("'")[i::2] for i in (0, 1))
    *start, shape = [part.strip() for part in between]
    plain = member[:8] == b"\x93NUMPY\1\0" and start == ["{", ":", ",", ": False,"]
    bounds = shape[:3], shape[-4:]
    if not plain or words[1][1:2] not in "fiu" or bounds != (": (", "), }") or "-" in shape:
        return np.lib.format.read_array(io.BytesIO(member), allow_pickle=False)
    lengths = tuple(int(length) for length in shape[3:-4].split(",") if length.strip())
    return np.frombuffer(member, words[1], offset=end).reshape(lengths).copy()


_ENTRY = struct.Struct("<10xH4xIIIHHH8xI")
"""Of the directory of a zip file: method, checksum, sizes packed and whole, lengths, start."""


def _members(content: bytes) -> Iterator[tuple[str, bytes]]:
    """Yield the members of a zip file by its directory.

    `zipfile` would do the same, and takes as long to be imported as everything else of the file.
    """
    end = content.rindex(b"PK\5\6")
    members, _, at = struct.unpack_from("<HII", content, end + 10)
    for _ in range(members):
        method, checksum, size, whole, *lengths, start = _ENTRY.unpack_from(content, at)
        at += _ENTRY.size
        name = content[at : at + lengths[0]].decode()
        at += sum(lengths)
        begin = start + 30 + sum(struct.unpack_from("<HH", content, start + 26))
        if method not in (0, 8):
            raise ValueError(f"{name} is compressed by an unknown method, {method}")
        member = content[begin : begin + size]
        member = zlib.decompress(member, -zlib.MAX_WBITS) if method else member
        if len(member) != whole or zlib.crc32(member) != checksum:
            raise ValueError(f"{name} is damaged")
        yield name, member


def column_name(quantity: str, unit: str) -> str:
    """Return the name of a column, as the library's own files spell it.

    Examples
    --------
    >>> column_name("toughness", "J/m^2"), column_name("g", "")
    ('toughness_J_per_m2', 'g')
    """
    spelled = unit.replace("/", "_per_").replace("^", "").replace(" ", "_")
    return f"{quantity}_{spelled}" if spelled else quantity


@contextmanager
def written_whole(file: str | PathLike[str]) -> Iterator[str]:
    """Give the name of a new file beside another, which it replaces once it is whole.

    Whatever goes wrong meanwhile, the other stays as it was and nothing is left beside it. What
    is no ordinary file, such as /dev/stdout, is written directly.

    Parameters
    ----------
    file : str or path-like
        What to write.

    Yields
    ------
    str
        The name to write to, with the same ending.

    Raises
    ------
    InputError
        If the file cannot be written.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     with written_whole(f"{folder}/x.csv") as name:
    ...         with open(name, "w") as file:
    ...             _ = file.write("a,b")
    ...     print(*os.listdir(folder))
    x.csv
    """
    name = file_name(file)
    try:
        target = os.path.realpath(name)
        if os.path.exists(target) and not os.path.isfile(target):
            yield name
            return
        folder, last = os.path.split(target)
        temporary = os.path.join(folder, f".{os.getpid()}-{last}")
        try:
            yield temporary
            if os.path.exists(target):
                os.chmod(temporary, os.stat(target).st_mode & 0o7777)
            os.replace(temporary, target)
        finally:
            with suppress(OSError):
                os.remove(temporary)
    except (OSError, ValueError) as error:
        if isinstance(error, InputError):
            raise
        reason = getattr(error, "strerror", None) or error
        raise InputError(f"{name} cannot be written ({reason}); choose another.") from None


def check_outputs(
    outputs: Mapping[str, str | None], inputs: Iterable[str | PathLike[str] | None] = ()
) -> None:
    """Refuse outputs that would overwrite an input or each other.

    Parameters
    ----------
    outputs : mapping of str to str or None
        Files to write by the options that name them.
    inputs : iterable of str or None
        Files that are read.

    Raises
    ------
    InputError
        If two of them are one file, by whatever names and links.

    Examples
    --------
    >>> check_outputs({"--csv": "a.csv", "--plot": "./a.csv"})
    Traceback (most recent call last):
        ...
    surrogate.errors.InputError: --csv a.csv and --plot ./a.csv are one file; give them two names.
    """
    read = {_identity(file): file_name(file) for file in inputs if file}
    written: dict[object, str] = {}
    for option, file in outputs.items():
        if not file:
            continue
        identity, shown_name = _identity(file), f"{option} {file}"
        if identity in read:
            raise InputError(
                f"{shown_name} would overwrite what is read, {read[identity]}; "
                "give it another name."
            )
        if identity in written:
            raise InputError(
                f"{written[identity]} and {shown_name} are one file; give them two names."
            )
        written[identity] = shown_name


def _identity(file: str | PathLike[str]) -> object:
    try:
        status = os.stat(file)
        return status.st_dev, status.st_ino
    except (OSError, ValueError):
        return os.path.normcase(os.path.realpath(file))


def write_csv(
    file: str | PathLike[str],
    columns: Mapping[tuple[str, str], Any],
    about: Iterable[str] = (),
) -> None:
    """Write columns of equal length to a CSV file, each number with all its digits.

    Parameters
    ----------
    file : str or path-like
        Where to write; an existing file is replaced.
    columns : mapping of (quantity, unit) to array_like
        One column each; numbers and words, flattened, broadcast together.
    about : iterable of str, optional
        Lines of comment above the header.

    Raises
    ------
    InputError
        If the file cannot be written.
    """
    names = [column_name(*key) for key in columns]
    arrays = [np.ravel(each) for each in np.broadcast_arrays(*columns.values())]
    lines = [*(f"# {line}" for line in about), ",".join(map(_cell, names))]
    lines += _rows(arrays)
    path = file_name(file)
    content = ("\n".join(lines) + "\n").encode()
    with written_whole(path) as temporary, open(temporary, "wb") as writer:
        writer.write(content)


def _rows(arrays: Sequence[Any]) -> list[str]:
    cells = [[_cell(value) for value in array.tolist()] for array in arrays]
    return [",".join(row) for row in zip(*cells, strict=True)]


def _cell(value: Any) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    text = value if isinstance(value, str) else repr(value)
    if any(mark in text for mark in ',"\n'):
        return '"' + text.replace('"', '""') + '"'
    return text


def sha256(content: bytes) -> str:
    """Return the SHA-256 of a content in hexadecimal, by Python's own code where it has one.

    For files of some hundred kilobytes it is done before OpenSSL, which hashlib takes, is loaded.

    Examples
    --------
    >>> sha256(b"")[:16]
    'e3b0c44298fc1c14'
    """
    return str(_hashing().sha256(content).hexdigest())


@cache
def _hashing() -> Any:
    for module in ("_sha2", "_sha256"):  # of Python 3.12 on, and of older ones
        with suppress(ImportError):
            return import_module(module)
    return import_module("hashlib")


def checksum_line(name: str, content: bytes) -> bytes:
    """Return the line that goes beside a file: its SHA-256, as ``sha256sum --check`` reads it.

    Examples
    --------
    >>> checksum_line("surrogates.npz", b"")[-16:]
    b' surrogates.npz\\n'
    """
    return f"{sha256(content)}  {name}\n".encode()

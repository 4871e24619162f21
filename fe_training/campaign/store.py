"""A store of finished configurations: a folder with one small, checksummed file for each.

A row is written to a temporary file, flushed to the disk and renamed, so a file under its final
name is whole, whatever happens to the process. The name is that of the configuration: a row that
is solved twice replaces itself. Nothing is pickled.
"""

from __future__ import annotations

import hashlib
import io
import json
import logging
import os
import socket
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any, get_origin, get_type_hints

import numpy as np

from fe_training.campaign.design import CampaignDesign, Configuration
from fe_training.solver.record import Outcome, Record
from surrogate.basics.files import read_archive
from surrogate.errors import InputError

__all__ = ["DamagedRowError", "Row", "Store", "write_atomically"]

try:
    import fcntl
except ImportError:  # Windows
    fcntl = None  # type: ignore[assignment]

_log = logging.getLogger(__name__)
_MAGIC = b"wirecut-row-1"
_RECORD_TYPES = get_type_hints(Record)


class DamagedRowError(Exception):
    """A file of the store is not what was written."""


@dataclass(frozen=True, slots=True, eq=False)
class Row:
    """One finished configuration, solved or failed.

    Parameters
    ----------
    configuration : Configuration
        What was asked for.
    attempt : int
        The strategy that made the record, from 0.
    tried : int
        How many strategies have been tried; more than `attempt + 1` where later ones did no better.
    software : dict of str to str
        What made the record, see :func:`fe_training.campaign.software.software`.
    record : Record
        The result with its evidence.
    """

    configuration: Configuration
    attempt: int
    tried: int
    software: Mapping[str, str]
    record: Record

    @property
    def converged(self) -> bool:
        """Whether nothing is left to try for."""
        return self.record.outcome is Outcome.CONVERGED

    @property
    def _quality(self) -> tuple[bool, float]:
        """Larger for better records."""
        reached = bool(np.isfinite(self.record.energy_release_rate))
        return self.converged, -self.record.force_mismatch if reached else -np.inf

    def better(self, earlier: Row | None) -> Row:
        """Return the better one of this row and an earlier one, knowing of both attempts."""
        if earlier is None or self._quality > earlier._quality:
            return self
        return Row(
            earlier.configuration, earlier.attempt, self.tried, earlier.software, earlier.record
        )


class Store:
    """The rows of one campaign in a folder.

    Parameters
    ----------
    folder : str or path-like
        Where the rows are; made by `open` where it does not exist.

    Notes
    -----
    The folder holds ``design.json`` with the numbers of the design and their hash, ``rows``, and
    ``damaged`` with the files that were set aside.
    """

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        self.folder = Path(folder).resolve()
        self._rows = self.folder / "rows"
        self._design = self.folder / "design.json"

    def design_hash(self) -> str | None:
        """Return the hash of the design that the store belongs to; None for a new store."""
        try:
            return str(json.loads(self._design.read_text(encoding="utf-8"))["hash"])
        except FileNotFoundError:
            return None
        except (ValueError, KeyError, TypeError):
            raise InputError(
                f"{self._design} is damaged; restore it, or run with --adopt if the rows belong "
                "to the design at hand."
            ) from None

    @contextmanager
    def opened(self, design: CampaignDesign, adopt: bool = False) -> Iterator[None]:
        """Drive the store alone, for a design.

        Parameters
        ----------
        design : CampaignDesign
            The design whose rows are made; it is written into a new store.
        adopt : bool
            Take over the rows of a store that belongs to another design: those whose
            configuration is in `design` count as finished, the others are left alone.

        Raises
        ------
        InputError
            If another process drives the store, if it belongs to another design, or if it cannot
            be written.
        """
        try:
            self._rows.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise InputError(
                f"the store {self.folder} cannot be made ({error.strerror}); choose another folder."
            ) from None
        with locked(self.folder / "lock", self.folder):
            known = None if adopt else self.design_hash()
            if known not in (None, design.hash):
                raise InputError(
                    f"the store {self.folder} belongs to the design {known}, not to {design.hash}; "
                    "choose another --store, or take its rows over with --adopt."
                )
            if known is None:
                content = {"hash": design.hash, "design": design.as_dict()}
                write_atomically(self._design, json.dumps(content, indent=1).encode())
            for left in self._rows.glob(".*.tmp"):  # of a writer that was killed
                left.unlink(missing_ok=True)
            yield

    def path(self, configuration: Configuration) -> Path:
        """Return the file of a configuration's row."""
        return self._rows / f"{configuration}.row"

    def write(self, row: Row) -> None:
        """Make a row durable; it replaces an earlier one of the same configuration."""
        write_atomically(self.path(row.configuration), encode_row(row))

    def read(self, configuration: Configuration) -> Row | None:
        """Return the row of a configuration, or None if it is not finished.

        A damaged file is moved to the folder ``damaged``, with a message; its configuration is
        then not finished.
        """
        path = self.path(configuration)
        try:
            row = decode_row(path.read_bytes())
            if row.configuration != configuration:
                raise DamagedRowError(f"it holds {row.configuration}")
            return row
        except FileNotFoundError:
            return None
        except DamagedRowError as error:
            self._set_aside(path, error)
            return None
        except OSError as error:
            raise InputError(
                f"{path} cannot be read ({error.strerror}); see that the store can be read."
            ) from None

    def _set_aside(self, path: Path, damage: DamagedRowError) -> None:
        aside = self.folder / "damaged" / path.name
        try:
            aside.parent.mkdir(exist_ok=True)
            with suppress(FileNotFoundError):  # another reader was quicker
                os.replace(path, aside)
        except OSError as error:
            raise InputError(
                f"{path} is damaged ({damage}) and cannot be set aside ({error.strerror}); "
                "move it away."
            ) from None
        _log.warning("%s is damaged (%s); moved to %s", path.name, damage, aside.parent)

    def rows(self, configurations: Iterable[Configuration]) -> list[Row]:
        """Return the rows of those configurations that are finished."""
        return [row for one in configurations if (row := self.read(one))]

    def stamp(self, configuration: Configuration) -> int:
        """Return a number that changes when a configuration's row is written; 0 for no row."""
        try:
            status = self.path(configuration).stat()
        except FileNotFoundError:
            return 0
        return hash((status.st_mtime_ns, status.st_ino))


def encode_row(row: Row) -> bytes:
    """Return the content of a row's file: a line with the checksum, then an npz archive."""
    one = row.configuration
    columns: dict[str, Any] = {
        "level": one.level,
        "alpha": one.alpha,
        "target": one.target,
        "attempt": row.attempt,
        "tried": row.tried,
        "software": json.dumps(row.software),
    }
    for field in fields(Record):
        columns[f"record.{field.name}"] = _plain(getattr(row.record, field.name))
    buffer = io.BytesIO()
    np.savez_compressed(buffer, allow_pickle=False, **columns)
    payload = buffer.getvalue()
    return b"%s %s\n%s" % (_MAGIC, hashlib.sha256(payload).hexdigest().encode(), payload)


def decode_row(content: bytes) -> Row:
    """Return the row in the content of a file.

    Raises
    ------
    DamagedRowError
        If the content is not what was written.
    """
    head, _, payload = content.partition(b"\n")
    magic, _, checksum = head.partition(b" ")
    if magic != _MAGIC:
        raise DamagedRowError("it is no row of a campaign")
    if checksum != hashlib.sha256(payload).hexdigest().encode():
        raise DamagedRowError("its checksum does not match")
    try:
        columns = read_archive(payload)
        configuration = Configuration(
            str(columns["level"]), float(columns["alpha"]), float(columns["target"])
        )
        values = {
            name: _restored(columns[key], kind)
            for name, kind in _RECORD_TYPES.items()
            if (key := f"record.{name}") in columns
        }
        return Row(
            configuration,
            int(columns["attempt"]),
            int(columns["tried"]),
            json.loads(str(columns["software"])),
            Record(**values),
        )
    except (KeyError, ValueError, TypeError, AttributeError, OverflowError) as error:
        raise DamagedRowError(f"it cannot be decoded: {error}") from None


def _plain(value: Any) -> Any:
    """Return what an npz archive holds without pickling."""
    if isinstance(value, Outcome):
        return value.name
    if isinstance(value, dict):
        return json.dumps(value)
    if isinstance(value, tuple):
        return np.asarray(value, dtype=float)
    return value


def _restored(value: np.ndarray[Any, Any], kind: Any) -> Any:
    """Return a field of the record from its column; `kind` is the field's type."""
    if kind is Outcome:
        return Outcome[str(value)]
    if get_origin(kind) is dict:
        return json.loads(str(value))
    if get_origin(kind) is tuple:
        return tuple(value.tolist())
    return kind(value.item()) if isinstance(kind, type) and get_origin(kind) is None else value


def write_atomically(path: Path, content: bytes) -> None:
    """Write a file that is there as a whole or not at all, whatever happens to the process."""
    temporary = path.with_name(f".{path.name}.{socket.gethostname()}-{os.getpid()}.tmp")
    try:
        with open(temporary, "wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        os.replace(temporary, path)
    except OSError as error:
        temporary.unlink(missing_ok=True)
        raise InputError(
            f"{path} cannot be written ({error.strerror}); free the disk or choose another folder."
        ) from None
    if os.name == "posix":
        folder = os.open(path.parent, os.O_RDONLY)
        try:
            os.fsync(folder)
        finally:
            os.close(folder)


@contextmanager
def locked(path: Path, store: Path) -> Iterator[None]:
    """Hold the lock of a store; where there is no flock, a file that must not exist beforehand."""
    try:
        descriptor = _lock(path, store)
    except OSError as error:
        raise InputError(
            f"the store {store} cannot be locked ({error.strerror}: {path}); see that it can be "
            "written, or choose another --store."
        ) from None
    try:
        with suppress(OSError):  # who holds it is said for people; a full disk is met later
            os.truncate(descriptor, 0)
            os.write(descriptor, f"process {os.getpid()} on {socket.gethostname()}".encode())
        yield
    finally:
        os.close(descriptor)
        if fcntl is None:
            path.unlink(missing_ok=True)


def _lock(path: Path, store: Path) -> int:
    """Return the descriptor of a file that no other process holds."""
    if fcntl is None:
        try:
            return os.open(path, os.O_CREAT | os.O_EXCL | os.O_RDWR, 0o644)
        except FileExistsError:
            raise _busy(path, store, "; if no such process runs, delete that file") from None
    descriptor = os.open(path, os.O_CREAT | os.O_RDWR, 0o644)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        os.close(descriptor)
        if isinstance(error, BlockingIOError):
            raise _busy(path, store, "") from None
        raise
    return descriptor


def _busy(path: Path, store: Path, remedy: str) -> InputError:
    try:
        holder = path.read_text(encoding="utf-8", errors="replace") or "another process"
    except OSError:
        holder = "another process"
    return InputError(
        f"the store {store} is driven by {holder} (lock file {path}); wait for it or choose "
        f"another --store{remedy}."
    )

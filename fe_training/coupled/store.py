"""Finished rows of the campaign with friction and wear: one checksummed file for each base.

The file of a base is replaced as a whole after each row, so that a process that dies loses the
row in progress only.  A base whose last ray is not finished is solved again.
"""

from __future__ import annotations

import hashlib
import json
import logging
import os
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import Any

from fe_training.campaign.store import locked, write_atomically
from fe_training.coupled.design import Base, CoupledDesign
from fe_training.sliding.record import SlidingOutcome, SlidingRecord
from surrogate.errors import InputError

_log = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True, eq=False)
class BaseRows:
    """The rows of one base.

    Parameters
    ----------
    records : tuple of SlidingRecord
        In the order of its rays.
    software : dict of str to str
        What made them.
    """

    records: tuple[SlidingRecord, ...]
    software: Mapping[str, str]


class CoupledStore:
    """The rows of one campaign in a folder.

    Parameters
    ----------
    folder : str or path-like
        Where the files are.
    """

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        self.folder = Path(folder).resolve()

    @contextmanager
    def opened(self, design: CoupledDesign) -> Iterator[None]:
        """Drive the store alone, for a design.

        Raises
        ------
        InputError
            If another process drives the store, or if it belongs to another design.
        """
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise InputError(
                f"the store {self.folder} cannot be made ({error.strerror}); choose another folder."
            ) from None
        with locked(self.folder / "lock", self.folder):
            marker = self.folder / "design.hash"
            known = marker.read_text(encoding="utf-8").strip() if marker.exists() else None
            if known not in (None, design.hash):
                raise InputError(
                    f"the store {self.folder} belongs to the design {known}, not to "
                    f"{design.hash}; choose another --store."
                )
            if known is None:
                write_atomically(marker, design.hash.encode())
            yield

    def _path(self, base: Base) -> Path:
        return self.folder / f"base-{base.number:04d}.json"

    def write(
        self, base: Base, records: Sequence[SlidingRecord], software: Mapping[str, str]
    ) -> None:
        """Make the rows of a base durable; they replace earlier ones."""
        content = json.dumps(
            {
                "base": asdict(base),
                "software": dict(software),
                "rows": [_plain(record) for record in records],
            }
        )
        self.folder.mkdir(parents=True, exist_ok=True)
        digest = hashlib.sha256(content.encode()).hexdigest()
        write_atomically(self._path(base), f"{digest}\n{content}\n".encode())

    def read(self, base: Base) -> BaseRows | None:
        """Return the rows of a base; None if there are none, or if they are damaged."""
        path = self._path(base)
        try:
            digest, content = path.read_text(encoding="utf-8").split("\n")[:2]
            if hashlib.sha256(content.encode()).hexdigest() != digest:
                raise ValueError("its checksum does not match")
            values = json.loads(content)
            if (values["base"]["alpha"], values["base"]["g"]) != (base.alpha, base.g):
                raise ValueError("it is of another base")
            records = tuple(_record(row) for row in values["rows"])
            return BaseRows(records, values["software"])
        except FileNotFoundError:
            return None
        except OSError as error:
            raise InputError(f"{path} cannot be read ({error.strerror})") from None
        except (ValueError, KeyError, TypeError) as error:
            _log.warning("%s cannot be used (%s) and is solved again", path.name, error)
            return None

    def is_finished(self, base: Base) -> bool:
        """Return whether every load of a base has its row."""
        rows = self.read(base)
        there = [(row.target_friction, row.target_wear) for row in rows.records] if rows else []
        return there == [load for ray in base.rays for load in ray]


def _plain(record: SlidingRecord) -> dict[str, Any]:
    values = {field.name: getattr(record, field.name) for field in fields(SlidingRecord)}
    return {**values, "outcome": record.outcome.name}


def _record(row: Mapping[str, Any]) -> SlidingRecord:
    return SlidingRecord(
        **{
            **row,
            "outcome": SlidingOutcome[row["outcome"]],
            "energy_release_rate_across": tuple(row["energy_release_rate_across"]),
        }
    )

"""What the frozen records of floats and arrays have in common."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

import numpy as np

__all__ = ["Record", "Shown"]


class Shown:
    """Base of dataclasses that notebooks show as a table of their fields."""

    __slots__ = ()

    def _repr_html_(self) -> str:
        """What notebooks show."""
        from surrogate.notebook import html_of_record

        return html_of_record(self)


class Record(Shown):
    """Base of frozen dataclasses whose fields may be arrays: equal where all fields are.

    The comparison that a dataclass would write itself fails on arrays. Hashing works where all
    fields are hashable, which arrays are not.
    """

    __slots__ = ()

    def _values(self) -> tuple[Any, ...]:
        return tuple(getattr(self, field.name) for field in fields(self))  # type: ignore[arg-type]

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        return all(map(np.array_equal, self._values(), other._values()))

    def __hash__(self) -> int:
        return hash(self._values())

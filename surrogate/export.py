"""Tables of numbers as CSV files whose header names quantity and unit of each column."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from os import PathLike
from typing import Any

import numpy as np

from surrogate.errors import InputError
from surrogate.paths import file_name

__all__ = ["column_name", "write_csv"]


def column_name(quantity: str, unit: str) -> str:
    """Return the name of a column, as the library's own files spell it.

    Examples
    --------
    >>> column_name("toughness", "J/m^2"), column_name("g", "")
    ('toughness_J_per_m2', 'g')
    """
    spelled = unit.replace("/", "_per_").replace("^", "").replace(" ", "_")
    return f"{quantity}_{spelled}" if spelled else quantity


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
    try:
        with open(path, "w", encoding="utf-8", newline="\n") as stream:
            stream.write("\n".join(lines) + "\n")
    except OSError as error:
        raise InputError(f"{path} cannot be written ({error.strerror}); choose another.") from None


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

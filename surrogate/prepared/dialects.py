"""How the four languages write what an exported force needs: numbers, arrays and indices."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

__all__ = ["DIALECTS", "Dialect"]

_WIDTH = 96


@dataclass(frozen=True)
class Dialect:
    """A language.

    Parameters
    ----------
    name : str
        Its name.
    comment : str
        What begins a line of comment.
    log, lowest, highest, floor, exp, log1p : str
        Its logarithm, minimum, maximum, rounding down, exponential and logarithm of 1 and more, as
        functions.
    declare : str
        What declares a local number.
    integer : str
        What declares a local index.
    end : str
        What ends a statement.
    array : str
        How an array is written, with {name} and {values}.
    nan : str
        No number.
    first : int
        Number of the first entry of an array.
    """

    name: str
    comment: str
    log: str
    lowest: str
    highest: str
    floor: str
    exp: str
    log1p: str
    declare: str
    integer: str
    end: str
    array: str
    nan: str
    first: int = 0

    def item(self, array: str, index: str) -> str:
        """Return an entry of an array by an index that counts from 0."""
        return f"{array}({index} + 1)" if self.first else f"{array}[{index}]"

    def numbers(self, name: str, values: Iterable[float]) -> str:
        """Return the definition of an array of numbers, each to its last digit."""
        written = [f"{value!r}" for value in values]
        lines: list[list[str]] = [[]]
        for value in written:
            if sum(len(each) + 2 for each in lines[-1]) + len(value) > _WIDTH:
                lines.append([])
            lines[-1].append(value)
        separator = ", ...\n  " if self.first else ",\n  "
        text = separator.join(", ".join(line) for line in lines)
        return self.array.format(name=name, values=text)

    def remarks(self, lines: Sequence[str]) -> str:
        """Return lines of comment."""
        return "\n".join(f"{self.comment} {line}".rstrip() for line in lines)


DIALECTS = {
    each.name: each
    for each in (
        Dialect(
            *("c", "//", "log", "fmin", "fmax", "floor", "exp", "log1p", "double ", "int ", ";"),
            "static const double {name}[] = {{\n  {values}\n}};",
            "NAN",
        ),
        Dialect(
            *(
                "javascript",
                "//",
                "Math.log",
                "Math.min",
                "Math.max",
                "Math.floor",
                "Math.exp",
                "Math.log1p",
            ),
            *("let ", "let ", ";"),
            "const {name} = [\n  {values}\n];",
            "NaN",
        ),
        Dialect(
            *("matlab", "%", "log", "min", "max", "floor", "exp", "log1p", "", "", ";"),
            "{name} = [ ...\n  {values} ];",
            "NaN",
            1,
        ),
        Dialect(
            *("python", "#", "log", "min", "max", "floor", "exp", "log1p", "", "", ""),
            "{name} = (\n  {values},\n)",
            "nan",
        ),
    )
}

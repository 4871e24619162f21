"""Lines of a table that are no measurements: means, remarks, and what is another table."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

from surrogate.errors import InputError
from surrogate.reading.forms.merged import cell_of
from surrogate.reading.sheet import Row, Sheet
from surrogate.reading.words.spelling import plain

__all__ = ["SUMMARY", "measurements_apart", "sums_up"]

_SUMS = (
    "mean|average|median|std|sd|stdev|st dev|std dev|standard deviation|standard error|sem|cov|cv|"
    "rsd|coefficient of variation|minimum|maximum|min|max|range|sum|total|summe|gesamt|somme|suma|"
    "somma|totale|mittel|mittelwert|standardabweichung|variationskoeffizient|spannweite|moyenne|"
    "ecart type|media|mediana|promedio|desviacion estandar|deviazione standard|desvio padrao|"
    "gemiddelde|srednia|среднее|平均|平均値|标准差|標準偏差|x quer|n|x̄"
)
SUMMARY = re.compile(
    rf"({_SUMS})( [±+-] .*| of [^0-9]*| (der|aller|de|di|values?|all)( [^0-9]*)?)?"
)
"""First cells of lines below a table that sum it up, and are no measurements."""


def sums_up(row: Row, wire: int | None = None) -> bool:
    """Whether a row begins with a word such as Mean, or has one in place of its wire."""
    first = next(filter(None, row.cells), "")
    cells = [first] if wire is None else [first, cell_of(row, wire)]
    return any(SUMMARY.fullmatch(plain(cell)) for cell in cells)


def measurements_apart(
    sheet: Sheet,
    rows: Sequence[Row],
    wire: int,
    forces: Sequence[int],
    is_header: Callable[[Row], bool],
) -> tuple[list[Row], list[str]]:
    """Return the rows without those that are remarks, and what these say.

    A remark has words in place of the wire, and no force.

    Raises
    ------
    InputError
        If a second table follows.
    """
    kept: list[Row] = []
    notes: list[str] = []
    for row in rows:
        if sheet.is_number(cell_of(row, wire)):
            kept.append(row)
        elif is_header(row) or all(_is_word(sheet, row, one) for one in (wire, *forces)):
            raise InputError(
                f"{sheet.place(row)} begins another table; keep one table a file, or write the "
                "cuts below one header with the name of the gel in a column of its own (--by)."
            )
        elif _is_remark(sheet, row, wire, forces):
            text = " ".join(filter(None, row.cells))
            notes.append(f"{sheet.place(row)} is a remark and not read: {text[:60]!r}")
        else:
            kept.append(row)
    return kept, notes


def _is_word(sheet: Sheet, row: Row, index: int) -> bool:
    return re.match(r"[^\W\d]", cell_of(row, index)) is not None


def _is_remark(sheet: Sheet, row: Row, wire: int, forces: Sequence[int]) -> bool:
    place = cell_of(row, wire)
    words = place or (next(filter(None, row.cells), "") if len(row.cells) <= wire else "")
    if not words or re.match(r"[+-]?[.,]?[0-9]", words):
        return False
    return not any(sheet.is_number(cell_of(row, one)) for one in forces)

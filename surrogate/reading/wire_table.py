"""Tables of wires and forces: their header, whatever it is called, and what is below it."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from surrogate.errors import InputError
from surrogate.reading.before import thickness_before
from surrogate.reading.headings import (
    Heading,
    headings,
    is_units_row,
    meaning,
    plain,
    split_unit,
    vocabulary,
)
from surrogate.reading.sheet import Row, Sheet
from surrogate.reading.units import FORCE, LENGTH, LINE_FORCE, Dimension

__all__ = [
    "COLUMNS",
    "COUNT",
    "DEVIATION",
    "SUMMARY",
    "WORDS",
    "Table",
    "find_table",
    "has_table",
]

COLUMNS: dict[str, Dimension] = {
    "wire_radius": LENGTH,
    "wire_diameter": LENGTH,
    "force_per_thickness": LINE_FORCE,
    "force_std": LINE_FORCE,
    "force": FORCE,
    "thickness": LENGTH,
}
"""Quantities that a table of measurements may hold."""

_FORCES = (("force_per_thickness", LINE_FORCE), ("force", FORCE))
_SPREAD = (
    "std,stdev,std dev,st dev,sd,se,sem,stderr,std err,standard error,standard deviation,error,"
    "std error,uncertainty,+/-,±,fehler,standardfehler,standardabweichung,ecart type,erreur type,"
    "desviacion estandar,error estandar,deviazione standard,errore standard,desvio padrao,"
    "standaardafwijking,odchylenie standardowe,标准差,標準偏差,標準誤差"
)
WORDS = vocabulary(
    {
        "wire_radius": [("wire_radius", LENGTH)],
        "wire_diameter": [("wire_diameter", LENGTH)],
        "force_per_thickness": [("force_per_thickness", LINE_FORCE)],
        "force": [("force", FORCE), ("force_per_thickness", LINE_FORCE)],
        "force_std": [("force_std", LINE_FORCE), ("total_std", FORCE)],
        "thickness": [("thickness", LENGTH)],
        "trial": _FORCES,
    },
    {
        "wire_radius": "wire_radius,radius,r,r_w,rw,radius of wire,drahtradius,radius wire,"
        "needle radius,blade radius,fiber radius,fibre radius,rayon,rayon du fil,radio,"
        "radio del alambre,radio del hilo,raggio,raggio filo,raggio del filo,raio,raio do fio,"
        "straal,promien,promien drutu,半径",
        "wire_diameter": "wire_diameter,diameter,d,d_w,dw,dia,wire dia,wire diam,wire,wire size,"
        "diameter of wire,drahtdurchmesser,durchmesser,draht,needle diameter,ø,wire ø,draht ø,"
        "fiber diameter,fibre diameter,⌀,diametre,diametre du fil,diametre fil,fil,diametro,"
        "diametro del alambre,diametro alambre,diametro del hilo,diametro hilo,diametro filo,"
        "diametro del filo,diametro do fio,diametro fio,draaddiameter,diameter draad,srednica,"
        "srednica drutu,tråddiameter,线径,丝径,直径,线直径,線径,ワイヤ径,ワイヤー径",
        "force_per_thickness": "force_per_thickness,f_ss/t,fss/t,f/t,f_ss per t,force/thickness,"
        "steady force per thickness,cutting force per thickness,mean force per thickness,"
        "steady state force per thickness,force per width,line force,f/b,f/w,"
        "kraft pro dicke,kraft je dicke,kraft/dicke,linienkraft,force par epaisseur,"
        "force/epaisseur,f/e,fuerza por espesor,fuerza/espesor,forza per spessore,"
        "forza/spessore,f/s,forca/espessura,kracht/dikte,kracht per dikte,siła/grubosc",
        "force": "force,f,f_ss,fss,steady force,steady state force,cutting force,mean force,"
        "average force,steady_state_force,plateau force,load,mean load,steady load,kraft,"
        "schnittkraft,mittlere kraft,last,force mean,force de coupe,fuerza,fuerza de corte,carga,"
        "forza,forza di taglio,forca,forca de corte,kracht,snijkracht,siła,siła ciecia,skärkraft,"
        "力,切割力,切断力,荷重,切断荷重,載荷,载荷",
        "force_std": ",".join(
            f"{quantity}{words}"
            for words in _SPREAD.split(",")
            for quantity in ("", "force ", "load ", "f/t ", "f_ss/t ", "force per thickness ")
        ),
        "thickness": "thickness,sample thickness,specimen thickness,t,gel thickness,dicke,"
        "probendicke,thickness of sample,thickness of the sample,epaisseur,espesor,spessore,"
        "espessura,dikte,grubosc,tjocklek,厚度,厚さ,厚み",
        "trial": "trial n,run n,repeat n,rep n,replicate n,test n,measurement n,messung n,"
        "versuch n,cut n,schnitt n,wiederholung n,essai n,ensayo n,prova n,meting n",
    },
)
SUMMARY = re.compile(
    r"(mean|average|median|std|sd|stdev|st dev|standard deviation|standard error|sem|cov|cv|"
    r"coefficient of variation|minimum|maximum|min|max|range|sum|"
    r"mittelwert|standardabweichung|variationskoeffizient|spannweite|moyenne|ecart type|"
    r"media|mediana|desviacion estandar|deviazione standard|x quer|n|x̄)( [±+-] .*)?"
)
"""First cells of lines below a table that sum it up, and are no measurements."""
COUNT = {"n", "count", "number", "anzahl", "number of cuts", "number of tests", "repeats", "cuts"}
DEVIATION = re.compile(
    r"\b(sd|stdev|std dev|st dev|standard deviation|standardabweichung|ecart type|"
    r"desviacion estandar|deviazione standard|desvio padrao|standaardafwijking|"
    r"odchylenie standardowe|标准差|標準偏差)\b"
)
_WITH_ERROR = re.compile(r"(.*[0-9.,])\s*(?:±|\+/?-)\s*([0-9.,].*)")
_WITH_UNIT = re.compile(r"([+-]?[0-9.,]*[0-9][0-9.,]*(?:[eE][+-]?[0-9]+)?)\s*([^\W\d].*|\")")
_OF_STEADY = re.compile(
    "file|specimen number|trial|within record error of force|plateau (from|to|drift)|"
    "peak of force|stick slip drop|(offset|tare) subtracted"
)
"""Columns of `wirecut steady` that say how a force was taken."""
_SAMPLE = {
    *("sample", "gel", "specimen", "material", "probe", "batch", "sample id", "charge", "hydrogel"),
    *(
        "echantillon",
        "eprouvette",
        "muestra",
        "campione",
        "provino",
        "amostra",
        "monster",
        "probka",
    ),
    *("试样", "样品", "試料", "試験片", "サンプル"),
}


@dataclass(frozen=True)
class Table:
    """The columns of a table by quantity, its rows, and what of it is not used.

    Parameters
    ----------
    header : Row
        The names.
    columns : dict of str to list of Heading
        Those that are understood.
    rows : list of Row
        Those below the header, without that of units.
    width : int
        Number of columns.
    thickness : (float, str) or None
        That of the sample [m] and where it stands, above the header.
    sample, count, gel : int or None
        Indices of the columns that name samples, that count what a standard deviation is of, and
        that name gels where a column was asked for.
    notes : list of str
        What is not used.
    """

    header: Row
    columns: dict[str, list[Heading]]
    rows: list[Row]
    width: int
    thickness: tuple[float, str] | None
    sample: int | None
    count: int | None = None
    gel: int | None = None
    notes: list[str] = field(default_factory=list)


def has_table(sheet: Sheet) -> bool:
    """Whether a row or a column of a sheet names a wire."""
    return any(
        one[0][0] in ("wire_radius", "wire_diameter")
        for row in sheet.rows[:200]
        for cell in row.cells
        if (one := meaning(split_unit(cell, WORDS)[0], WORDS)[0])
    )


def find_table(sheet: Sheet, by: str | None = None) -> tuple[Sheet, Table]:
    """Return the table of measurements in a sheet, which it may turn by a quarter.

    Parameters
    ----------
    sheet : Sheet
        What was read.
    by : str, optional
        Name of the column that names the gel of each row.

    Raises
    ------
    InputError
        If it has no wire or no force, or one of them twice or without a unit, or no column `by`.
    """
    if not sheet.rows:
        raise InputError(
            f"{sheet.file} is empty; write a header such as "
            "wire_radius_mm,force_per_thickness_N_per_m and one line a wire."
        )
    start = _header(sheet)
    first, *others = [cell for cell in sheet.rows[start].cells if cell] or [""]
    if others and _known(first) and any(map(sheet.is_number, others)) and not _names(others):
        sheet = sheet.on_its_side()
        start = _header(sheet)
    header, body = sheet.rows[start], sheet.rows[start + 1 :]
    units = body.pop(0) if body and is_units_row(sheet, body[0]) else None
    summary = [row for row in body if _sums_up(row)]
    header, units, body = _tidied(header, units, [row for row in body if row not in summary])
    listed = headings(sheet, header, WORDS, units)
    gel = None if by is None else _named(sheet, header, listed, by)
    named = [one.number - 1 for one in listed if plain(one.name) in _SAMPLE]
    sample = next((index for index in named if index != gel), None)
    before = thickness_before(sheet, sheet.rows[:start])
    columns = _by_quantity(sheet, header, listed)
    table = Table(header, columns, body, len(listed), before, sample, gel=gel)
    table.notes.extend(sheet.notes)
    if summary:
        lines = ", ".join(f"{row.line} ({next(filter(None, row.cells))})" for row in summary)
        table.notes.append(f"{sheet.file}: sums up and not read: {sheet.line} {lines}")
    table = replace(table, count=_count(table, listed))
    besides = (table.sample, table.count, table.gel)
    unknown = [one for one in listed if not one.quantity and one.number - 1 not in besides]
    names = [str(one) for one in unknown if one.name or _filled(one, body)]
    _check_columns(sheet, table, names)
    names = [one for one in names if not _is_of_steady(one)]
    if names:
        table.notes.append(f"{sheet.file}: not used: {', '.join(names)}")
    return sheet, table


def _named(sheet: Sheet, header: Row, listed: list[Heading], name: str) -> int:
    """Return the index of the column of a name."""
    for one in listed:
        if plain(one.name) == plain(name):
            return one.number - 1
    names = ", ".join(one.name for one in listed if one.name)
    raise InputError(
        f"{sheet.place(header)} has no column {name!r}; name one of {names} by --by (by= in "
        "Python), or leave it out where the table is of one gel."
    )


def _is_of_steady(column: str) -> bool:
    name = plain(column.partition("(")[2].removesuffix(")"))
    return any(_OF_STEADY.fullmatch(one) for one in (name, name.rpartition(" ")[0]))


def _sums_up(row: Row) -> bool:
    """Whether a row begins with a word such as Mean."""
    first = next(filter(None, row.cells), "")
    return SUMMARY.fullmatch(plain(first)) is not None


def _count(table: Table, listed: list[Heading]) -> int | None:
    """Return the index of the column that tells how many cuts a standard deviation is of."""
    stds = [one for kind in ("force_std", "total_std") for one in table.columns.get(kind, ())]
    if not any(DEVIATION.search(plain(one.name)) for one in stds):
        return None
    return next((one.number - 1 for one in listed if plain(one.name) in COUNT), None)


def _tidied(header: Row, units: Row | None, body: list[Row]) -> tuple[Row, Row | None, list[Row]]:
    """Return a table whose cells hold a number alone: no unit with it, and no error behind it."""
    names, below = list(header.cells), list(units.cells if units else [])
    below += [""] * (len(names) - len(below))
    rows = [list(row.cells) for row in body]
    for column in range(len(names)):
        errors = _errors_apart(rows, column)
        unit = _unit_apart(rows, column, names[column])
        below[column] = unit or below[column]
        if errors and _is_force(names[column]):
            text = split_unit(names[column], WORDS)[1] or below[column]
            names.append(f"± [{text}]")
            below.append(text)
            for row, error in zip(rows, errors, strict=True):
                row += [""] * (len(names) - 1 - len(row)) + [error]
    tidy = [  # a row that was tidy is kept, which large tables are full of
        row if row.cells == cells else Row(row.line, cells)
        for row, cells in zip(body, rows, strict=True)
    ]
    line = units.line if units else header.line
    return Row(header.line, names), Row(line, below) if any(below) else None, tidy


def _is_force(name: str) -> bool:
    meanings, _ = meaning(split_unit(name, WORDS)[0], WORDS)
    return any(quantity in ("force", "force_per_thickness") for quantity, _ in meanings)


def _errors_apart(rows: list[list[str]], column: int) -> list[str]:
    """Take what stands behind ± out of a column and return it; nothing where nothing does."""
    matches = [_WITH_ERROR.fullmatch("".join(row[column : column + 1])) for row in rows]
    for row, match in zip(rows, matches, strict=True):
        if match:
            tail = _WITH_UNIT.fullmatch(match[2])
            row[column] = f"{match[1]} {tail[2]}" if tail else match[1]
    if not any(matches):
        return []
    return [_WITH_UNIT.sub(r"\1", match[2]) if match else "" for match in matches]


def _unit_apart(rows: list[list[str]], column: int, name: str) -> str:
    """Take the unit out of the cells of a column where all have the same, and return it."""
    cells = [row[column] for row in rows if len(row) > column and row[column]]
    matches = [_WITH_UNIT.fullmatch(cell) for cell in cells]
    units = {match[2].strip() if match else "" for match in matches}
    if len(units) != 1 or "" in units:
        return ""
    (unit,) = units
    stated = split_unit(name, WORDS)[1]
    known = any(kind.unit(unit) for kind in (LENGTH, FORCE, LINE_FORCE))
    if not known or stated not in (None, unit):
        return ""
    for row in rows:
        if len(row) > column:
            row[column] = _WITH_UNIT.sub(r"\1", row[column])
    return unit


def _filled(heading: Heading, body: list[Row]) -> bool:
    index = heading.number - 1
    return any(len(row.cells) > index and row.cells[index] for row in body)


def _known(name: str) -> bool:
    return bool(meaning(split_unit(name, WORDS)[0], WORDS)[0])


def _names(cells: Sequence[str]) -> bool:
    return any(map(_known, cells))


def _header(sheet: Sheet) -> int:
    """Return the index of the header: the row that names a wire, or else any quantity."""
    for wanted in ({"wire_radius", "wire_diameter"}, set(COLUMNS)):
        for index, row in enumerate(sheet.rows[:200]):
            means = [meaning(split_unit(cell, WORDS)[0], WORDS)[0] for cell in row.cells]
            if len(row.cells) > 1 and any(one[0][0] in wanted for one in means if one):
                return index
    return 0


def _by_quantity(sheet: Sheet, header: Row, listed: list[Heading]) -> dict[str, list[Heading]]:
    columns: dict[str, list[Heading]] = {}
    for one in listed:
        if not one.quantity:
            continue
        earlier = columns.setdefault(one.quantity, [])
        if earlier and not (one.trial and earlier[0].trial):
            raise InputError(
                f"{sheet.place(header)}, {one} gives {one.quantity} again after {earlier[0]}; "
                "keep one of them."
            )
        earlier.append(one)
    return columns


def _check_columns(sheet: Sheet, table: Table, unknown: list[str]) -> None:
    columns, place = table.columns, sheet.place(table.header)
    others = f" (not known: {', '.join(unknown)})" if unknown else ""
    if ("wire_radius" in columns) == ("wire_diameter" in columns):
        state = "both a radius and a diameter" if "wire_radius" in columns else "no wire radius"
        raise InputError(
            f"{place} names {state}{others}; keep wire_radius_<unit> or wire_diameter_<unit>."
        )
    if "force_per_thickness" not in columns and "force" not in columns:
        raise InputError(
            f"{place} names no force_per_thickness_<unit>{others}; divide the steady force by the "
            "sample's thickness and give it in one of the units N_per_m, mN_per_mm, J_per_m2, or "
            "give force_<unit> and thickness_<unit>; where each column is a gel of its own, write "
            "one line a cut with the gel's name in a column gel."
        )

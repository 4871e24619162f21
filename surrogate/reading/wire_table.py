"""Tables of wires and forces: their header, whatever it is called, and what is below it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from surrogate.errors import InputError
from surrogate.reading.headings import (
    Heading,
    headings,
    is_units_row,
    meaning,
    plain,
    split_unit,
    thickness_before,
    vocabulary,
)
from surrogate.reading.sheet import Row, Sheet
from surrogate.reading.units import FORCE, LENGTH, LINE_FORCE, Dimension

__all__ = ["COLUMNS", "Table", "find_table"]

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
_WORDS = vocabulary(
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
        "needle radius,blade radius,fiber radius,fibre radius",
        "wire_diameter": "wire_diameter,diameter,d,d_w,dw,dia,wire dia,wire diam,wire,wire size,"
        "diameter of wire,drahtdurchmesser,durchmesser,draht,needle diameter,ø,wire ø,draht ø,"
        "fiber diameter,fibre diameter",
        "force_per_thickness": "force_per_thickness,f_ss/t,fss/t,f/t,f_ss per t,force/thickness,"
        "steady force per thickness,cutting force per thickness,mean force per thickness,"
        "steady state force per thickness,force per width,line force,f/b,f/w,"
        "kraft pro dicke,kraft je dicke,kraft/dicke,linienkraft",
        "force": "force,f,f_ss,fss,steady force,steady state force,cutting force,mean force,"
        "average force,steady_state_force,plateau force,load,mean load,steady load,kraft,"
        "schnittkraft,mittlere kraft,last,force mean",
        "force_std": "force_std,std,stdev,std dev,sd,se,sem,stderr,std err,standard error,"
        "standard deviation,error,force error,force se,force sem,force sd,std error,force_stderr,"
        "force_per_thickness_std,force per thickness std,f_ss/t std,f/t std,fehler,"
        "standardfehler,standardabweichung,uncertainty,+/-,±",
        "thickness": "thickness,sample thickness,specimen thickness,t,gel thickness,dicke,"
        "probendicke,thickness of sample,thickness of the sample",
        "trial": "trial n,run n,repeat n,rep n,replicate n,test n,measurement n,messung n,"
        "versuch n,cut n,schnitt n,wiederholung n",
    },
)
_SAMPLE = {"sample", "gel", "specimen", "material", "probe", "batch", "sample id", "charge"}


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
    sample : int or None
        Index of the column that names samples.
    notes : list of str
        What is not used.
    """

    header: Row
    columns: dict[str, list[Heading]]
    rows: list[Row]
    width: int
    thickness: tuple[float, str] | None
    sample: int | None
    notes: list[str] = field(default_factory=list)


def find_table(sheet: Sheet) -> tuple[Sheet, Table]:
    """Return the table of measurements in a sheet, which it may turn by a quarter.

    Raises
    ------
    InputError
        If it has no wire or no force, or one of them twice or without a unit.
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
    listed = headings(sheet, header, _WORDS, units)
    sample = next((one.number - 1 for one in listed if plain(one.name) in _SAMPLE), None)
    before = thickness_before(sheet, sheet.rows[:start])
    table = Table(header, _by_quantity(sheet, header, listed), body, len(listed), before, sample)
    table.notes.extend(sheet.notes)
    unknown = [str(one) for one in listed if not one.quantity and one.number - 1 != sample]
    unknown = [one for one in unknown if not one.endswith("()") or _filled(one, body)]
    _check_columns(sheet, table, unknown)
    if unknown:
        table.notes.append(f"{sheet.file}: not used: {', '.join(unknown)}")
    return sheet, table


def _filled(heading: str, body: list[Row]) -> bool:
    index = int(heading.split()[1]) - 1
    return any(len(row.cells) > index and row.cells[index] for row in body)


def _known(name: str) -> bool:
    return bool(meaning(split_unit(name, _WORDS)[0], _WORDS)[0])


def _names(cells: Sequence[str]) -> bool:
    return any(map(_known, cells))


def _header(sheet: Sheet) -> int:
    """Return the index of the header: the row that names a wire, or else any quantity."""
    for wanted in ({"wire_radius", "wire_diameter"}, set(COLUMNS)):
        for index, row in enumerate(sheet.rows[:200]):
            means = [meaning(split_unit(cell, _WORDS)[0], _WORDS)[0] for cell in row.cells]
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
            "give force_<unit> and thickness_<unit>."
        )

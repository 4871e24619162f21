"""The command `wirecut steady`: from the records of a testing machine to steady forces."""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from surrogate.basics.figures import (
    GREY,
    RED,
    SMALL,
    WIDTHS,
    in_style,
    new_figure,
    picture_file,
    save_figure,
)
from surrogate.basics.files import check_outputs, write_csv
from surrogate.basics.records import number, table
from surrogate.cli.common import DOUBTED, Record, print_record, quantity, share
from surrogate.errors import InputError
from surrogate.reading.cuts import Cut, cuts_of, measurements_of, record_files
from surrogate.reading.units import FORCE, LENGTH, SPEED
from surrogate.reading.wires import Wire, wires_by_name, wires_by_table

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["add_record_options", "add_steady_options", "cuts_by_options", "run_steady"]


def add_record_options(command: argparse.ArgumentParser) -> None:
    """Add what tells of records: wires, tare, range, and how the files are written."""
    add = command.add_argument
    add("--name", metavar="PATTERN", help="how files are named: 'wire_{diameter}mm_{trial}'")
    add("--wires", metavar="TABLE", help="table of file and wire_diameter_mm, instead of --name")
    add(
        "--tare",
        type=quantity(FORCE, signed=True),
        metavar="F",
        help="constant force to subtract (default 0)",
    )
    add(
        "--from",
        dest="start",
        type=quantity(LENGTH, signed=True),
        metavar="X",
        help="begin of the plateau",
    )
    add(
        "--to",
        dest="end",
        type=quantity(LENGTH, signed=True),
        metavar="X",
        help="end of the plateau",
    )
    add(
        "--tolerance",
        type=share,
        default=0.05,
        metavar="PART",
        help="change of force along a plateau that counts as none (default 0.05)",
    )
    add("--sign", choices=("positive", "negative"), help="how files count the force that cuts")
    add("--speed", type=quantity(SPEED), metavar="V", help="of the cut, for files without travel")
    add("--columns", metavar="NAMES", help="names of all columns: time_s,displacement_mm,force_N")


def add_steady_options(command: argparse.ArgumentParser) -> None:
    """Add the options of `wirecut steady`."""
    add = command.add_argument
    add("paths", nargs="+", metavar="FILE", help="records, or a folder of them")
    add("--thickness", type=quantity(LENGTH), metavar="T", help="thickness of the sample")
    add_record_options(command)
    add("--decimal", metavar="SIGN", help="decimal sign of the files: . or ,")
    add("--delimiter", metavar="SIGN", help="what separates columns: , ; tab | or blank")
    add("--encoding", metavar="NAME", help="encoding of the files, such as utf-16")
    add("--out", metavar="TABLE", help="write the table that 'wirecut identify' reads (.csv)")
    add("--plot", metavar="PICTURE", help="draw every record with its plateau (.png, .pdf, .svg)")


def cuts_by_options(
    options: argparse.Namespace, paths: Sequence[str], outputs: Mapping[str, str | None]
) -> tuple[list[Cut], list[str]]:
    """Return the cuts in the records that the options name, and the files passed over."""
    if options.name and options.wires:
        raise InputError("--name and --wires both tell the wires; give one of them.")
    wire_of: Callable[[str, int], Wire] | None = None
    if options.name:
        wire_of = wires_by_name(options.name)
    elif options.wires:
        wire_of = wires_by_table(options.wires)
    files, over = record_files(paths, [options.wires])
    check_outputs(outputs, [*files, options.wires])
    plateau = {"start": options.start, "end": options.end, "tolerance": options.tolerance}
    cuts = cuts_of(
        files,
        wire_of,
        options.thickness,
        plateau | {"tare": options.tare or 0.0},
        columns=options.columns,
        sign=options.sign,
        speed=options.speed,
        decimal=options.decimal,
        delimiter=options.delimiter,
        encoding=options.encoding,
    )
    return cuts, over


def run_steady(options: argparse.Namespace) -> int:
    """Print the steady forces, write their table and figure, and return the exit code."""
    outputs = {"--out": options.out, "--plot": options.plot}
    if options.plot:
        picture_file(options.plot)
    cuts, over = cuts_by_options(options, options.paths, outputs)
    if options.out:
        _write(cuts, options.out)
    if options.plot:
        _save_picture(cuts, options.plot)
    record = {
        "cuts": [_row(cut) for cut in cuts],
        "not_steady": [cut.reason for cut in cuts if cut.reason],
        "passed_over": over,
        "table": options.out,
        "picture": options.plot,
    }
    print_record(options, record, _text)
    return DOUBTED if record["not_steady"] else 0


_STEADY = (
    *("mean", "std", "standard_error", "start", "end", "samples", "drift", "peak", "stick_slip"),
    *("offset", "tare"),
)


def _row(cut: Cut) -> Record:
    nan = float("nan")
    row: Record = {
        "file": os.path.basename(cut.file),
        "specimen": cut.specimen,
        "wire_radius": cut.wire.radius if cut.wire else nan,
        "trial": cut.wire.trial if cut.wire else "",
        "sample": cut.wire.sample if cut.wire else "",
        "thickness": nan if cut.thickness is None else cut.thickness,
        "force_per_thickness": cut.force_per_thickness,
    }
    row |= {name: getattr(cut.steady, name) if cut.steady else nan for name in _STEADY}
    understood = cut.record.understood if cut.record else ""
    return row | {"understood": understood, "reason": cut.reason, "notes": list(cut.notes)}


def _write(cuts: list[Cut], file: str) -> None:
    """Write one row a cut; what gave no steady force is named above them."""
    measurements_of(cuts)  # refuses what lacks its wire or thickness
    rows = [_row(cut) for cut in cuts if cut.steady]

    def column(name: str, factor: float = 1.0) -> list[float]:
        return [float(f"{factor * row[name]:.12g}") for row in rows]

    columns: dict[tuple[str, str], Any] = {
        ("wire_diameter", "mm"): column("wire_radius", 2e3),
        ("force_per_thickness", "N/m"): column("force_per_thickness"),
        ("force", "N"): column("mean"),
        ("thickness", "mm"): column("thickness", 1e3),
        ("file", ""): [row["file"] for row in rows],
        ("specimen_number", ""): [str(row["specimen"]) for row in rows],
    }
    for name in ("trial", "sample"):
        if any(row[name] for row in rows):
            columns[name, ""] = [row[name] for row in rows]
    columns |= {
        ("within_record_error_of_force", "N"): column("standard_error"),
        ("plateau_from", "mm"): column("start", 1e3),
        ("plateau_to", "mm"): column("end", 1e3),
        ("plateau_drift", ""): column("drift"),
        ("peak_of_force", "N"): column("peak"),
        ("stick_slip_drop", "N"): column("stick_slip"),
        ("offset_subtracted", "N"): column("offset"),
        ("tare_subtracted", "N"): column("tare"),
    }
    about = [f"not steady: {cut.reason}" for cut in cuts if cut.steady is None]
    write_csv(file, columns, ["steady forces by wirecut steady", *about])


_HEADER = ("file", "2 R_w [mm]", "F_ss/T [N/m]", "F_ss [N]", "+-", "from-to [mm]", "drift", "peak")


def _text(record: Record) -> str:
    rows = [row for row in record["cuts"] if not np.isnan(row["mean"])]
    parts = [table((*_HEADER, "slip [N]"), [_cells(row) for row in rows]), *_by_wire(rows)]
    if record["not_steady"]:
        parts.append(f"{len(record['not_steady'])} of {len(record['cuts'])} records are not used:")
        parts += [f"  {reason}" for reason in record["not_steady"]]
    parts += _notes(record["cuts"])
    parts += ["How the files were understood:"]
    parts += _understood(record["cuts"])
    parts += [f"not a record: {', '.join(record['passed_over'])}"] * bool(record["passed_over"])
    parts += [f"Written: {record[name]}" for name in ("table", "picture") if record[name]]
    return "\n".join(parts)


def _understood(rows: list[Record]) -> list[str]:
    """Return how files were understood, once for all that were understood alike."""
    places: dict[str, list[str]] = {}
    for row in rows:
        place, colon, text = row["understood"].partition(": ")
        if colon:
            places.setdefault(text, []).append(place)
    return [
        f"  {first}{f' and {len(others)} more' if others else ''}: {text}"
        for text, (first, *others) in places.items()
    ]


def _cells(row: Record) -> list[str]:
    name = row["file"] + (f", {row['specimen']}" if row["specimen"] > 1 else "")
    return [
        name,
        number(2e3 * row["wire_radius"]),
        number(row["force_per_thickness"]),
        number(row["mean"]),
        number(row["standard_error"], 2),
        f"{1e3 * row['start']:.2f}-{1e3 * row['end']:.2f}",
        f"{100.0 * row['drift']:+.1f} %",
        number(row["peak"], 3),
        number(row["stick_slip"], 2) if row["stick_slip"] else "0",
    ]


def _by_wire(rows: list[Record]) -> list[str]:
    """Return one line a wire with the mean and the scatter of its cuts."""
    lines = []
    for radius in sorted({row["wire_radius"] for row in rows if row["wire_radius"] > 0.0}):
        forces = np.array(
            [row["force_per_thickness"] for row in rows if row["wire_radius"] == radius]
        )
        if forces.size < 2 or np.isnan(forces).any():
            continue
        lines.append(
            f"{number(2e3 * radius)} mm: {number(float(np.mean(forces)))} N/m, standard deviation "
            f"{number(float(np.std(forces, ddof=1)), 2)} N/m over {forces.size} cuts"
        )
    return lines


def _notes(rows: list[Record]) -> list[str]:
    """Return every note once, with the number of records that it is about."""
    count: dict[str, int] = {}
    for row in rows:
        for note in row["notes"]:
            count[note] = count.get(note, 0) + 1
    return [f"Note: {note}" + (f" ({n} records)" if n > 1 else "") for note, n in count.items()]


_COLUMNS, _HEIGHT = 4, 1.45


@in_style
def _save_picture(cuts: Sequence[Cut], file: str) -> None:
    """Draw the force over the displacement of every record that could be read."""
    shown = [cut for cut in cuts if cut.record is not None]
    columns = min(_COLUMNS, len(shown))
    rows = -(-len(shown) // columns)
    width = WIDTHS["double"] if columns > 2 else WIDTHS["single"]
    figure = new_figure((width, 0.5 + _HEIGHT * rows))
    for place, cut in enumerate(shown):
        ax = figure.add_subplot(rows, columns, place + 1)
        _draw(ax, cut)
        if place % columns == 0:
            ax.set_ylabel("force [N]", fontsize=SMALL)
        if place >= len(shown) - columns:
            ax.set_xlabel("displacement [mm]", fontsize=SMALL)
    save_figure(figure, file)


def _draw(ax: Axes, cut: Cut) -> None:
    record, steady = cut.record, cut.steady
    assert record is not None
    net = record.force - (steady.offset + steady.tare if steady else 0.0)
    ax.plot(1e3 * record.displacement, net, color=GREY, linewidth=0.6)
    if steady is not None:
        ends = 1e3 * np.array([steady.start, steady.end])
        ax.plot(ends, [steady.mean] * 2, color=RED, linewidth=1.4)
        ax.axvspan(*ends, color=RED, alpha=0.08, linewidth=0.0)
    name = os.path.splitext(os.path.basename(cut.file))[0]
    if cut.specimen > 1:
        name += f", {cut.specimen}"
    ax.set_title(name if steady else f"{name}: not steady", fontsize=SMALL)
    ax.tick_params(labelsize=SMALL)

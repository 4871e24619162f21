"""The command `python -m fe_training`: configurations of the wire without writing Python."""

from __future__ import annotations

import argparse
import math
import os
import sys
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from surrogate.basics.command import OneLineParser, run_command
from surrogate.basics.figures import in_style
from surrogate.errors import InputError

if TYPE_CHECKING:
    from fe_training.mechanics.body import Body
    from fe_training.solver.cut import Settings
    from fe_training.solver.equilibrium import State
    from fe_training.solver.record import Record

from fe_training.solver.json_file import write_json

__all__ = ["main"]

_NAME = "python -m fe_training"


_RESOLUTIONS = ("coarse", "standard", "fine")


_PICTURES = (".png", ".pdf", ".svg")


_STUDIES = ("range", "mesh", "truncation", "contact", "parameters", "checks")


#: Packages of the extra `train`.
_EXTRA = {"scipy", "skfem", "sklearn", "joblib", "h5py", "tqdm", "matplotlib"}


#: Relative difference between the wanted and the reached g that is pointed out.
_CLOSE = 1e-3


_OVERVIEW = """\
Finite-element solutions of a rigid wire in the crack of a soft solid (arXiv:2412.02021)."""


_SOLVE = """\
Solve configurations of a rigid wire in the crack of an incompressible Ogden solid.

Lengths are in wire radii R_w, stresses in the shear modulus mu.  A configuration is chosen by
  g = J/(mu R_w)   energy release rate; in steady cutting the dimensionless toughness
  distance         delta/R_w, from the wire's centre to the crack tip, deformed
  insertion        x_w/R_w, position of the wire's centre; the unloaded tip is at 0
"""


_EXAMPLE = """\
examples:
  python -m fe_training solve --alpha 9 --g 1 --resolution coarse
      one configuration in some ten seconds; then a whole path, with its records and a picture:
  python -m fe_training solve --alpha 5 --g 0.8 1.2 2 --json path.json --plot path.png

the table:
  g          J/(mu R_w), by the domain integral next to the tip (the wanted one if not reached)
  delta/R_w  deformed distance from the wire's centre to the tip
  A          cos(theta_1) - cos(theta_2), of the ends of the contact arc
  B          F_v/(mu R_w T), the force that opens one half of the cut
  |J-2F_h|/J the evidence: zero in exact equilibrium of a large body
  -2dU/dc    J/(mu R_w) once more, by a true shift of the tip; with --shift
  time       seconds since the configuration before

exit codes: 0 all reached, 1 some not reached, 2 bad input or a package missing
"""


_VERIFY = """\
Verify the engine by its own studies, each one held against its bounds.

  range       J = 2 F_h over all exponents and toughnesses, and what happens beyond them
  mesh        standard mesh against a finer one
  truncation  radius of the body, and the law of the error that it makes
  contact     spacing of the nodes under the contact
  parameters  bulk term, polar interpolation, notch, refinement along the path
  checks      J by a true shift of the tip; far field against linear elasticity

Every solution is written to records.jsonl in the folder as soon as it is there: stop the command
whenever you like and give it again, and it goes on where it was.  Tables, figures and summary.md
are made of that file.  Studies that compare take their reference from `range`."""


_VERIFY_EXAMPLE = """\
examples:
  python -m fe_training verify --quick
      every study on coarse meshes in about a minute; not all bounds are kept on them
  python -m fe_training verify --dry-run
      how many configurations the full studies solve, and about how long that takes
  python -m fe_training verify --study mesh truncation --alpha 2 --jobs 2
      two studies at one exponent, on two processes of one thread each
  python -m fe_training verify --no-solve
      tables and figures of what is solved so far

exit codes: 0 all bounds kept, 1 a bound broken or something not solved, 2 bad input or a package
missing, 130 interrupted
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit code.

    Parameters
    ----------
    arguments : sequence of str, optional
        The arguments after the command's name; those of the process by default.

    Returns
    -------
    int
        0, or 1 if a configuration was not reached, or 2 after bad input or where a package is
        missing, with the reason in one line on the standard error stream.

    Examples
    --------
    >>> main(["solve", "--alpha", "5"]) == 2  # neither g nor distance nor insertion
    True
    """

    def action() -> int:
        options = _parser().parse_args(arguments)
        return _verify(options) if options.command == "verify" else _solve(options)

    return run_command("fe_training", action, _EXTRA, "wirecut[train]")


def _number(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not a number") from None
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"{text!r} is not a finite number")
    return value


def _parser() -> argparse.ArgumentParser:
    shape: dict[str, Any] = {
        "formatter_class": argparse.RawDescriptionHelpFormatter,
        "epilog": _EXAMPLE,
        "allow_abbrev": False,
    }
    parser = OneLineParser(prog=_NAME, description=_OVERVIEW, **shape)
    commands = parser.add_subparsers(dest="command", required=True, metavar="command")
    solve = commands.add_parser(
        "solve", help="solve one configuration or a path of them", description=_SOLVE, **shape
    )
    add = solve.add_argument
    add("--alpha", type=_number, required=True, help="stiffening exponent of the solid, 2 to 9")
    where = solve.add_mutually_exclusive_group(required=True)
    where.add_argument(
        "--g", type=_number, nargs="+", metavar="G", help="values of J/(mu R_w), 2.5e-3 to 100"
    )
    where.add_argument("--distance", type=_number, metavar="X", help="delta/R_w, above 1")
    where.add_argument("--insertion", type=_number, metavar="X", help="x_w/R_w, such as -1.2")
    add(
        "--resolution",
        choices=_RESOLUTIONS,
        default="standard",
        help="how fine the mesh is; standard unless given",
    )
    add("--shift", action="store_true", help="J once more, by a true shift of the tip: -2 dU/dc")
    add(
        "--mesh-error",
        action="store_true",
        help="B on a coarser mesh too; the difference goes into the JSON file (with --g)",
    )
    add("--json", metavar="FILE", help="write the records with their profiles to this file")
    add("--plot", metavar="FILE", help="draw mesh, J and stress ahead (.png, .pdf, .svg)")
    shape["epilog"] = _VERIFY_EXAMPLE
    _add_verify(
        commands.add_parser("verify", help="verify the engine", description=_VERIFY, **shape)
    )
    return parser


def _add_verify(verify: argparse.ArgumentParser) -> None:
    add = verify.add_argument
    add("--quick", action="store_true", help="coarse meshes and few configurations, a minute or so")
    add("--study", nargs="+", choices=_STUDIES, metavar="NAME", help="only these studies")
    add(
        "--alpha",
        type=_number,
        nargs="+",
        metavar="A",
        help="these exponents; outside 2 to 9 they are for the study range only",
    )
    add("--jobs", type=_count, default=1, metavar="N", help="processes, each with one thread (1)")
    add("--out", metavar="DIR", help="where solutions, tables and figures go (output/verify)")
    add("--retry", action="store_true", help="solve again what was not reached")
    how = verify.add_mutually_exclusive_group()
    how.add_argument("--dry-run", action="store_true", help="say what would run, solve nothing")
    how.add_argument("--no-solve", action="store_true", help="tables of what is solved so far")


def _count(text: str) -> int:
    value = _number(text)
    if value < 1 or value != int(value):
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number from 1 on")
    return int(value)


def _verify(options: argparse.Namespace) -> int:
    from fe_training.solver.solve import ALPHA_RANGE
    from fe_training.verification.cases import cases_of, full_scope, quick_scope
    from fe_training.verification.report import summary_table, write_report
    from fe_training.verification.run import estimated_seconds, read_solved, solve_cases
    from fe_training.verification.studies import judged

    scope = quick_scope() if options.quick else full_scope()
    if options.alpha:
        for value in options.alpha:
            low, high = ALPHA_RANGE
            if not low <= value <= high:
                raise InputError(f"alpha = {value:g} is out of range; give {low:g} to {high:g}.")
        scope = scope.of(options.alpha)
    studies = [name for name in _STUDIES if name in (options.study or _STUDIES)]
    folder = Path(options.out or Path("output") / ("verify-quick" if options.quick else "verify"))
    cases, file = cases_of(studies, scope), folder / "records.jsonl"
    solved = read_solved(file)
    left = [
        case
        for case in cases
        if case.key not in solved or (options.retry and not solved[case.key].reached)
    ]
    hours = estimated_seconds(left) / 3600
    _write(f"{len(left)} of {len(cases)} configurations to solve, about {hours:.2f} h of one core")
    if options.dry_run:
        return 0
    if not options.no_solve:
        solve_cases(left, file, options.jobs, options.retry)
    solved = read_solved(file)
    results = [judged(name, scope, solved) for name in studies]
    files = write_report(folder, scope, results, solved)
    _write(summary_table(results) + f"\nwritten: {files[-1]} and {len(files) - 1} more beside it")
    return 0 if all(result.passed for result in results) else 1


def _solve(options: argparse.Namespace) -> int:
    _check_files(options)
    _check_ranges(options)
    from fe_training.solver.cut import RESOLUTIONS

    settings = RESOLUTIONS[options.resolution]
    records = _records(options, settings)
    wanted = _wanted(options)
    _write(_table(records, wanted))
    if options.json:
        write_json(options.json, options.resolution, records, wanted)
    if options.plot:
        _draw(options.plot, records, settings)
    for record, target in zip(records, wanted, strict=True):
        _remark(record, target)
    return 0 if all(record.is_reached for record in records) else 1


def _wanted(options: argparse.Namespace) -> list[tuple[str, float]]:
    """Return name and value of what was asked for, in the order of the records."""
    if options.g is not None:
        return [("g", value) for value in sorted(options.g)]
    name = "distance" if options.distance is not None else "insertion"
    return [(name, getattr(options, name))]


def _records(options: argparse.Namespace, settings: Settings) -> list[Record]:
    """Solve, with a bar of progress for several values of g."""
    from fe_training.solver.solve import solve, solve_path

    if options.g is None:
        record = solve(
            options.alpha,
            distance=options.distance,
            insertion=options.insertion,
            settings=settings,
            shift=options.shift,
            mesh_error=options.mesh_error,
        )
        return [record]
    if len(options.g) == 1:
        return solve_path(
            options.alpha, options.g, settings, shift=options.shift, mesh_error=options.mesh_error
        )
    from tqdm import tqdm

    with tqdm(total=len(options.g), desc=f"alpha = {options.alpha:g}", unit="conf") as bar:

        def report(record: Record) -> None:
            if record.is_reached:
                bar.set_postfix_str(f"g = {record.energy_release_rate:.4g}")
            bar.update()

        return solve_path(
            options.alpha, options.g, settings, report, options.shift, options.mesh_error
        )


def _write(text: str) -> None:
    sys.stdout.write(text + "\n")


def _table(records: Sequence[Record], wanted: Sequence[tuple[str, float]]) -> str:
    """Return the records as lines of aligned columns, numbers to their right ends."""
    head = ("g", "delta/R_w", "A", "B", "|J-2F_h|/J", "-2dU/dc", "time [s]", "outcome")
    rows = [head]
    for record, (name, value) in zip(records, wanted, strict=True):
        outcome = record.outcome.name.lower().replace("_", " ")
        if not record.is_reached:
            rows.append((f"{value:.4g}" if name == "g" else "-", *6 * ("-",), outcome))
            continue
        rows.append(
            (
                f"{record.energy_release_rate:.4g}",
                f"{record.distance:.4f}",
                f"{record.arc:.4f}",
                f"{record.normal_load:.4f}",
                f"{record.force_mismatch:.1e}",
                f"{record.energy_release_rate_shift:.4g}".replace("nan", "-"),
                f"{record.wall_time:.1f}",
                outcome,
            )
        )
    widths = [max(len(row[i]) for row in rows) for i in range(len(head))]
    return "\n".join(
        "  ".join([*(cell.rjust(w) for cell, w in zip(row[:-1], widths, strict=False)), row[-1]])
        for row in rows
    )


def _remark(record: Record, wanted: tuple[str, float]) -> None:
    """Say on the error stream what is wrong with a configuration and what to do about it."""
    name, value = wanted
    outcome, remarks = record.outcome, []
    if outcome.remedy:
        reason = f" ({record.reason})" if record.reason else ""
        remarks.append(f"{outcome.meaning}{reason}; {outcome.remedy}")
    J = record.energy_release_rate
    if name == "g" and record.is_reached and abs(J / value - 1.0) > _CLOSE:
        remarks.append(f"J/(mu R_w) = {J:.6g} is what the search ended with")
    for remark in remarks:
        sys.stderr.write(f"fe_training: {name} = {value:g}: {remark}\n")


def _check_ranges(options: argparse.Namespace) -> None:
    """Refuse numbers out of range before a bar of progress begins."""
    from fe_training.solver.solve import ALPHA_RANGE, G_RANGE

    values = [("alpha", options.alpha, *ALPHA_RANGE)]
    values += [("g", value, *G_RANGE) for value in options.g or []]
    for name, value, low, high in values:
        if not low <= value <= high:
            raise InputError(f"{name} = {value:g} is out of range; give {low:g} to {high:g}.")


def _check_files(options: argparse.Namespace) -> None:
    """Refuse, before anything is solved, files that could not be written afterwards."""
    for file in (options.json, options.plot):
        if file is None:
            continue
        folder = Path(file).parent
        if Path(file).is_dir() or not folder.is_dir() or not os.access(folder, os.W_OK):
            raise InputError(f"{file} cannot be written; choose a file in an existing folder.")
    if options.plot and Path(options.plot).suffix.lower() not in _PICTURES:
        raise InputError(f"{options.plot} has no picture's ending; choose .png, .pdf or .svg.")
    if options.plot:
        from surrogate.basics.figures import require_matplotlib

        require_matplotlib()


@in_style
def _draw(file: str, records: Sequence[Record], settings: Settings) -> None:
    """Draw the configuration of the largest g, J against distance, and the stress ahead."""
    reached = [record for record in records if record.is_reached]
    if not reached:
        sys.stderr.write(f"fe_training: nothing was reached, {file} is not drawn\n")
        return
    from fe_training.solver.path import PathStalledError
    from fe_training.solver.pictures import (
        plot_configuration,
        plot_energy_release_rate,
        plot_stress_ahead,
    )
    from surrogate.basics.figures import SINGLE_COLUMN, new_figure, panels, save_figure

    width = SINGLE_COLUMN[0]
    figure = new_figure((width, 2.5 * width))
    places = panels(figure, 1, 3, height_ratios=[1.2, 0.8, 0.8])[:, 0]
    with suppress(PathStalledError):
        ax = plot_configuration(*_again(reached[-1], settings), places[0])
        chosen = rf"$\alpha$ = {reached[-1].alpha:g}, $g$ = {reached[-1].energy_release_rate:.3g}"
        ax.set_title(f"{chosen}; {ax.get_title()}", fontsize=ax.title.get_fontsize(), pad=3)
    plot_energy_release_rate(reached, places[1])
    plot_stress_ahead(reached, places[2])
    save_figure(figure, file)


def _again(record: Record, settings: Settings) -> tuple[Body, State]:
    """Solve the configuration of a record once more, for its displacements."""
    from fe_training.mechanics.mesh import MeshSpec
    from fe_training.solver.cut import Cut
    from fe_training.solver.equilibrium import Control
    from fe_training.solver.path import Steps
    from fe_training.solver.solve import indentation_states

    cut = Cut(record.alpha, MeshSpec(**record.mesh), settings)
    if cut.spec.contact_start > 0:
        return cut.body, cut.raised(record.insertion)
    previous = None
    for state in indentation_states(cut):
        if state.centre[0] >= record.insertion:
            break
        previous = state
    start = previous or state
    return cut.body, cut.last(start, Control.POSITION, record.insertion, Steps(0.1, 0.2))


if __name__ == "__main__":
    sys.exit(main())

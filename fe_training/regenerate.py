"""The command `regen-surrogate`: from the design of a campaign to the files in `models`."""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from surrogate.basics.command import OneLineParser, run_command
from surrogate.basics.files import model_file, models_folder
from surrogate.errors import InputError

if TYPE_CHECKING:
    from fe_training.campaign.dataset import Campaign
    from fe_training.campaign.design import CampaignDesign, Configuration
    from fe_training.campaign.run import Plan
    from fe_training.campaign.store import Store
    from fe_training.campaign.workers import Workers

__all__ = ["main"]

_NAME = "regen-surrogate"

#: Packages of the extra `train`.
_EXTRA = {"scipy", "sklearn", "skfem", "joblib", "h5py", "tqdm", "threadpoolctl", "tomli"}

_FULL, _QUICK, _OFF_GRID = "campaign.toml", "campaign-quick.toml", "off-grid.toml"

_DATA, _OFF_GRID_DATA = "campaign.h5", "off-grid.h5"

_CHECKED_ROWS, _NO_MODEL = 5, 4

_DESCRIPTION = """\
Make the files in `models` anew: campaign -> data set -> fit -> validation.

The campaign solves the wire in the crack over the stiffening exponent alpha and the dimensionless
toughness g = J/(mu R_w), on two meshes, as models/campaign.toml says. Every finished row is on the
disk at once: stop it whenever you like, kill it, run the same command again, and it goes on where
it was. A rerun tries failed rows again with a finer mesh."""

_EXAMPLES = """\
examples:
  regen-surrogate --quick
      every step on a coarse design in minutes; the models go to output/campaign-quick/models
  regen-surrogate --dry-run
      what would be solved, and about how long that takes
  wirecut force --models output/campaign-quick/models ...
      use models of your own, here or with surrogate.load_models in Python
  regen-surrogate --jobs 8
      the full campaign on this machine; again after any interruption
  regen-surrogate --only alpha=2 --only level=fine --jobs 2
      a part of it; the data set is made of all rows there are
  regen-surrogate --backend dask --scheduler tcp://10.0.0.1:8786 --store /shared/campaign
      on the workers of a Dask scheduler, which share the folder of the store
  regen-surrogate --no-solve
      the data set of the rows that are finished
  regen-surrogate --continue-from models/campaign.h5 --jobs 2
      go on with an unfinished data set where its store is gone, on another machine say
  regen-surrogate --design mine.toml --continue-from models/campaign.h5 --out my-models
      extend or restrict the campaign: only what the shipped rows lack is solved
  regen-surrogate --off-grid --jobs 2
      solutions that no fit has seen, for the validation: models/off-grid.h5
  regen-surrogate --fit-only
      fit and validate the models from the data sets in --out, and write their file and their card
  regen-surrogate --check 10
      solve ten rows of the shipped data again and compare

exit codes: 0 done, 1 rows of --check differ, 2 bad input or a package missing, 4 the rows are saved
but too few for a model, 130 interrupted
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
        0, or 1 if rows that were checked differ, or 2 after bad input or where a package is
        missing, with the reason in one line on the standard error stream, or 4 if the rows were
        too few for a model.

    Examples
    --------
    >>> main(["--jobs", "0"]) == 2  # no process at all
    True
    """
    return run_command(
        _NAME, lambda: _regenerate(_parser().parse_args(arguments)), _EXTRA, "wirecut[train]"
    )


def _parser() -> argparse.ArgumentParser:
    parser = OneLineParser(
        prog=_NAME,
        description=_DESCRIPTION,
        epilog=_EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    add = parser.add_argument
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--quick", action="store_true", help=f"take the design models/{_QUICK}")
    what.add_argument("--design", metavar="FILE", help=f"take another design than models/{_FULL}")
    what.add_argument(
        "--off-grid",
        action="store_true",
        help=f"solve models/{_OFF_GRID} into {_OFF_GRID_DATA}, for the validation; fit nothing",
    )
    add(
        "--only",
        action="append",
        default=[],
        metavar="NAME=VALUE",
        help="solve only this alpha or level, such as alpha=2; may be repeated",
    )
    how = parser.add_mutually_exclusive_group()
    how.add_argument("--dry-run", action="store_true", help="say what would run, solve nothing")
    how.add_argument("--no-solve", action="store_true", help="make the files of the finished rows")
    how.add_argument("--fit-only", action="store_true", help="fit the data set in --out")
    how.add_argument(
        "--check",
        nargs="?",
        type=_count,
        const=_CHECKED_ROWS,
        metavar="N",
        help=f"solve N rows of the data set in --out again and compare ({_CHECKED_ROWS})",
    )
    add("--single-mesh", action="store_true", help="fit points of one mesh too, to try it out")
    add("--no-retry", action="store_true", help="leave failed rows as they are")
    add("--jobs", type=_count, default=1, metavar="N", help="processes on this machine (1)")
    add("--backend", choices=("local", "dask"), default="local", help="where to solve (local)")
    add("--scheduler", metavar="ADDRESS", help="of a Dask scheduler, such as tcp://10.0.0.1:8786")
    add("--store", metavar="DIR", help="finished rows (output/campaign)")
    add("--adopt", action="store_true", help="take over a store of another design")
    add("--continue-from", metavar="FILE", help="take rows that the design has from this data set")
    add("--out", metavar="DIR", help="where the files go (models; with --quick beside the store)")
    add("--seed", type=int, default=0, metavar="N", help="of the random sample of --check (0)")
    return parser


def _count(text: str) -> int:
    try:
        value = int(text)
    except ValueError:
        value = 0
    if value < 1:
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number from 1 on")
    return value


def _regenerate(options: argparse.Namespace) -> int:
    if (options.backend == "dask") != (options.scheduler is not None):
        raise InputError("--backend dask and --scheduler ADDRESS need each other; give both.")
    from fe_training.campaign.design_file import read_design
    from fe_training.campaign.refill import refill
    from fe_training.campaign.run import plan
    from fe_training.campaign.store import Store
    from fe_training.campaign.workers import Workers

    workers = Workers(options.jobs, options.scheduler)
    name = "campaign-quick" if options.quick else "off-grid" if options.off_grid else "campaign"
    store = Store(options.store or Path("output") / name)
    out = Path(options.out or (store.folder / "models" if options.quick else models_folder()))
    if options.check:
        return _check(out / _DATA, options.check, options.seed, workers)
    if options.fit_only:
        _fit_only(out, options.single_mesh)
        return 0
    file = _QUICK if options.quick else _OFF_GRID if options.off_grid else _FULL
    design = read_design(options.design or model_file(file))
    chosen = _chosen(design, options.only)
    if options.dry_run:
        _say_plan(design, plan(design, store, chosen, not options.no_retry), workers)
        return 0
    known = _continued(design, options.continue_from) if options.continue_from else None
    with store.opened(design, options.adopt):
        if known is not None:
            _say(f"    {refill(store, design, known)} rows taken from {options.continue_from}")
        if not options.no_solve:
            _campaign(design, store, chosen, workers, not options.no_retry)
        data = _data_set(design, store, out / (_OFF_GRID_DATA if options.off_grid else _DATA))
    _say_points(data)
    if options.off_grid:
        return 0
    return 0 if _fit(data, out, options.single_mesh) else _NO_MODEL


def _say(text: str) -> None:
    sys.stdout.write(text + "\n")
    sys.stdout.flush()


def _chosen(design: CampaignDesign, only: Sequence[str]) -> list[Configuration]:
    """Return the configurations that all filters of different names let through."""
    allowed: dict[str, set[Any]] = {}
    for text in only:
        name, _, value = text.partition("=")
        known: dict[str, tuple[Callable[[str], Any], Sequence[Any]]] = {
            "alpha": (float, design.alpha),
            "level": (str, design.names),
        }
        if name not in known:
            raise InputError(f"--only {text} is not understood; give alpha=VALUE or level=NAME.")
        kind, values = known[name]
        try:
            wanted = kind(value)
        except ValueError:
            wanted = None
        if wanted not in values:
            there = ", ".join(f"{v:g}" if kind is float else v for v in values)
            raise InputError(f"--only {text} is not in the design, which has {name} {there}.")
        allowed.setdefault(name, set()).add(wanted)
    return [
        one
        for one in design.configurations()
        if all(getattr(one, name) in values for name, values in allowed.items())
    ]


def _continued(design: CampaignDesign, file: str) -> Campaign:
    """Return the data set to go on with, refused before a store is made."""
    from fe_training.campaign.dataset import load_campaign
    from fe_training.campaign.refill import require_same_meshes

    known = load_campaign(file)
    require_same_meshes(design, known)
    return known


def _campaign(
    design: CampaignDesign,
    store: Store,
    chosen: Sequence[Configuration],
    workers: Workers,
    retry: bool,
) -> None:
    from fe_training.campaign.run import plan, run_campaign

    todo = plan(design, store, chosen, retry)
    _say(f"1/4 campaign: {len(todo.waiting)} of {len(chosen)} configurations to solve")
    run_campaign(design, store, todo, workers)
    failed = [row for row in store.rows(chosen) if not row.converged]
    if failed:
        count = Counter(row.record.outcome.name.lower().replace("_", " ") for row in failed)
        what = ", ".join(f"{number} {outcome}" for outcome, number in count.items())
        _say(f"    {what}; run again to try them with a finer mesh")


def _data_set(design: CampaignDesign, store: Store, file: Path) -> Campaign:
    from fe_training.campaign.dataset import load_campaign, write_campaign

    try:
        file.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(
            f"{file.parent} cannot be made ({error.strerror}); choose another --out."
        ) from None
    rows = store.rows(design.configurations())
    write_campaign(file, design, rows)
    size = file.stat().st_size / 1e6
    _say(f"2/4 data set: {file}, {len(rows)} rows, {size:.2f} MB, checksum beside it")
    return load_campaign(file)


def _say_points(data: Campaign) -> None:
    """Say how many points may be used, and why the others may not."""
    points = data.points
    use = points["use"].astype(bool)
    wanted = data.design.points
    _say(f"    {use.sum()} of {wanted} points within the bounds of their evidence")
    left_out = zip(points["alpha"][~use], points["g"][~use], points["reason"][~use], strict=True)
    for alpha, g, reason in left_out:
        _say(f"    alpha = {alpha:g}, g = {g:g}: {reason}")


def _fit(data: Campaign, out: Path, single_mesh: bool) -> bool:
    """Fit, validate and write the models, or say why they cannot be made yet; return whether."""
    _say("3/4 fit")
    try:
        _make(data, out, single_mesh)
    except InputError as error:
        _say(f"    no model was made, as {error}")
        _say("4/4 validation: there is nothing to validate")
        return False
    return True


def _fit_only(out: Path, single_mesh: bool) -> None:
    from fe_training.campaign.dataset import load_campaign

    _make(load_campaign(out / _DATA), out, single_mesh)


def _make(data: Campaign, out: Path, single_mesh: bool) -> None:
    from fe_training.campaign.dataset import load_campaign
    from fe_training.validation.surrogates import make_surrogates

    others = out / _OFF_GRID_DATA
    if not others.is_file():
        _say(f"    {others} is not there, so that no point off the grid is in the validation")
    off_grid = load_campaign(others) if others.is_file() else None
    make_surrogates(data, out, off_grid, single_mesh, _say)


def _say_plan(design: CampaignDesign, todo: Plan, workers: Workers) -> None:
    finished = sum(row.converged for row in todo.rows)
    _say(f"design {design.hash}: {len(todo.waiting)} configurations to solve, {finished} finished")
    groups: dict[tuple[str, float, int], list[float]] = {}
    for one, attempt in todo.waiting:
        groups.setdefault((one.level, one.alpha, attempt), []).append(todo.seconds[one])
    for (level, alpha, attempt), seconds in groups.items():
        again = f", attempt {attempt + 1}" if attempt else ""
        _say(f"    {level}, alpha = {alpha:g}: {len(seconds)}, {_hours(sum(seconds))}{again}")
    total = sum(todo.seconds.values())
    _say(f"about {_hours(total)} on one process")
    if workers.jobs > 1:
        _say(f"about {_hours(total / workers.jobs)} on {workers.jobs}, if all stay busy")


def _hours(seconds: float) -> str:
    return f"{seconds / 3600:.1f} h" if seconds > 3600 else f"{seconds / 60:.1f} min"


def _check(file: Path, number: int, seed: int, workers: Workers) -> int:
    """Solve a random sample of the rows again and compare; return the exit code."""
    from fe_training.campaign.check import check_rows
    from fe_training.campaign.dataset import load_campaign

    with tempfile.TemporaryDirectory() as folder:
        checks = check_rows(load_campaign(file), number, seed, workers, folder)
    for check in checks:
        _say(str(check))
    agreeing = sum(check.agrees for check in checks)
    _say(f"{agreeing} of {len(checks)} rows agree with {file}")
    return 0 if agreeing == len(checks) else 1


if __name__ == "__main__":
    sys.exit(main())

"""The command `python -m fe_training.coupled`: the campaign with friction and wear."""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from surrogate.basics.command import OneLineParser, run_command

if TYPE_CHECKING:
    from fe_training.coupled.design import CoupledDesign
    from fe_training.coupled.store import CoupledStore

DATA = "coupled.h5"
_EXTRA = {"scipy", "skfem", "joblib", "tqdm", "h5py", "matplotlib"}

_HELP = """\
Solve the wire in the crack with friction xi and wear tau_w acting on the body, over toughness,
stiffening, friction and wear, as a design file says.  Every finished row is on the disk at once:
stop the command whenever you like and give it again, and it goes on where it was."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit code."""

    def action() -> int:
        return _run(_parser().parse_args(arguments))

    return run_command("fe_training.coupled", action, _EXTRA, "wirecut[train]")


def _parser() -> argparse.ArgumentParser:
    parser = OneLineParser(prog="python -m fe_training.coupled", description=_HELP)
    add = parser.add_argument
    add("design", help="the design file, such as models/coupled.toml")
    add("--store", metavar="DIR", default="output/coupled", help="finished rows (output/coupled)")
    add("--jobs", type=int, default=1, metavar="N", help="processes of this machine (1)")
    add(
        "--scheduler",
        metavar="ADDRESS",
        help="of a Dask scheduler, whose workers solve instead; they need the folder of --store "
        "under the same path",
    )
    add("--bases", type=int, metavar="N", help="only the first N bases")
    add("--write", metavar="FILE", help="write the finished rows to an HDF5 file at the end")
    add(
        "--finer",
        action="store_true",
        help="solve first rays of the bases that no fit sees a second time, on the finer mesh",
    )
    add("--check", action="store_true", help="tell what is finished, and solve nothing")
    add(
        "--fit",
        metavar="FOLDER",
        help="fit kappa to the rows of coupled.h5 in a folder, and write coupled.npz and its card "
        "there; solves nothing",
    )
    add(
        "--figures",
        metavar="FOLDER",
        help="draw the rows of coupled.h5 beside the models in use, and kappa, into a folder; "
        "solves nothing",
    )
    return parser


def _run(options: argparse.Namespace) -> int:
    from fe_training.coupled.dataset import collected, write_coupled
    from fe_training.coupled.design import read_design
    from fe_training.coupled.run import waiting
    from fe_training.coupled.store import CoupledStore

    design, store = read_design(options.design), CoupledStore(options.store)
    if options.fit:
        return _fit(Path(options.fit))
    if options.figures:
        return _draw(Path(options.figures))
    finer = CoupledStore(store.folder / "finer")
    if not options.check:
        _solve(design, store, finer, options)
    if options.write:
        write_coupled(collected(design, store, finer), options.write)
    outcomes: Counter[str] = Counter()
    for base in design.all_bases():
        rows = store.read(base)
        for record in rows.records if rows else ():
            outcomes[("held out, " if base.held_out else "") + record.outcome.name] += 1
    lines = [f"{count:6d} {name}" for name, count in sorted(outcomes.items())]
    lines.append(
        f"{len(waiting(design, store)):6d} of {len(design.all_bases())} bases are not finished"
    )
    sys.stdout.write("\n".join(lines) + "\n")
    return 0


def _solve(
    design: CoupledDesign, store: CoupledStore, finer: CoupledStore, options: argparse.Namespace
) -> None:
    from fe_training.campaign.workers import Workers
    from fe_training.coupled.run import again, run_coupled, waiting

    workers = Workers(options.jobs, options.scheduler)
    if options.finer:
        other = design.on_finer_mesh()
        todo = [base for base in again(design, store) if not finer.is_finished(base)]
        with finer.opened(other):
            run_coupled(other, finer, todo[: options.bases], workers)
        return
    with store.opened(design):
        run_coupled(design, store, waiting(design, store)[: options.bases], workers)


def _fit(folder: Path) -> int:
    from fe_training.coupled.card import CARD, make_amplification
    from fe_training.coupled.dataset import read_coupled
    from surrogate.contact.shipped import shipped

    data = read_coupled(folder / DATA)
    make_amplification(data, shipped().limits.touch, folder)
    sys.stdout.write(f"{folder / CARD}\n")
    return 0


def _draw(folder: Path) -> int:
    """Draw the pictures; the data set is that beside the models in use."""
    from fe_training.campaign.dataset import load_campaign
    from fe_training.coupled.dataset import read_coupled
    from fe_training.coupled.pictures.solutions import PICTURES, draw_pictures
    from surrogate.contact.shipped import folder_in_use
    from surrogate.coupling.shipped import amplification

    campaign = load_campaign()
    draw_pictures(read_coupled(Path(folder_in_use()) / DATA), amplification(), campaign, folder)
    sys.stdout.write("".join(f"{folder / name}.png\n" for name in PICTURES))
    return 0


if __name__ == "__main__":
    sys.exit(main())

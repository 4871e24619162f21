"""A campaign that is killed, starved, locked out or told a wrong time: nothing is lost or changed.

The engine is the made-up one of tests/campaign; a campaign is the shipped quick design.
"""

import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import replace
from pathlib import Path
from unittest import mock

from fe_training.campaign.design_file import read_design
from fe_training.campaign.store import DamagedRowError, decode_row, encode_row
from surrogate.basics.files import model_file
from surrogate.errors import WirecutError

from .part import Part

__all__ = ["faults"]

HELPERS = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(HELPERS))

from fake_engine import run  # noqa: E402 (found by the line above)

ENGINE = HELPERS / "fake_engine.py"
MEMORY = Path("/dev/shm")
"""Where stores are kept if possible: rows are flushed to the disk one by one, which takes time."""
SECONDS, PAUSE, SLOW = 120, "0.04", "0.5"


def faults(kills=25, seed=0, budget=420.0):
    """Run campaigns into every fault.

    Parameters
    ----------
    kills : int
        Random moments at which a campaign is killed; a worker of it at a fifth as many.
    seed : int
        Of the moments.
    budget : float
        Seconds after which no further campaign is killed.
    """
    part = Part("faults", "Campaigns with faults: rows intact, and the same bits after a rerun")
    start = time.monotonic()
    design = model_file("campaign-quick.toml")
    with tempfile.TemporaryDirectory(dir=MEMORY if MEMORY.is_dir() else None) as folder:
        reference = Path(folder, "reference")
        run(read_design(design), reference)
        trial = Trial(part, design, Path(folder), rows_of(reference))
        moments = random.Random(seed)
        duration = trial.duration() if kills else 0.0
        for i in range(kills):
            if time.monotonic() - start > budget:
                part.notes.append(f"{kills - i} of {kills} kills were left out after {budget:g} s")
                break
            trial.killed(moments.uniform(0.0, duration))
            if i % 5 == 0:
                trial.worker_killed(moments.uniform(0.3, 0.9) * duration)
        if kills:
            trial.two_writers()
            part.notes.append(
                f"at most {trial.orphans} idle processes were left a second after their campaign "
                "was killed; they end by themselves after five minutes and write nothing"
            )
        trial.disk_full()
        trial.read_only()
        trial.clock_jumps(seed)
    part.seconds = time.monotonic() - start
    return part


def rows_of(store):
    """Return every row of a store by the name of its file: its bits, or how it is damaged.

    The commit of the code is left out, which may change while the faults go on.
    """
    rows = {}
    for path in sorted(Path(store, "rows").glob("*.row")):
        try:
            row = decode_row(path.read_bytes())
            rows[path.name] = encode_row(replace(row, software={}))
        except DamagedRowError as error:
            rows[path.name] = error
    return rows


class Trial:
    """What the faults share: the design, a folder for stores, and how the rows have to be."""

    def __init__(self, part, design, folder, wanted):
        self.part, self.design, self.folder, self.wanted = part, design, folder, wanted
        self.number, self.said, self.orphans = 0, folder / "said", 0

    def store(self):
        """Return a new place for a store."""
        self.number += 1
        return self.folder / f"store-{self.number}"

    def start(self, store, seconds=PAUSE):
        """Start a campaign on two processes as the leader of a group."""
        with open(self.said, "wb") as said:  # no pipe: idle workers of a killed one would hold it
            return subprocess.Popen(
                [sys.executable, str(ENGINE), str(self.design), str(store), "2"],
                env={**os.environ, "FAKE_SECONDS": seconds},
                stdout=subprocess.DEVNULL,
                stderr=said,
                cwd=HELPERS.parent,
                start_new_session=True,
            )

    def finished(self, process):
        """Return exit code and what was said on the standard error stream."""
        try:
            process.wait(SECONDS)
        except subprocess.TimeoutExpired:
            self.swept(process)
            return None, f"hangs for more than {SECONDS} s"
        return process.returncode, self.said.read_text(errors="replace")

    def swept(self, process):
        """End what is left of a campaign's processes, and return how many there were."""
        left = len(_of_group(process.pid))
        with suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        return left

    def duration(self):
        """Return the time of a campaign without a fault [s]."""
        start = time.monotonic()
        self.finished(self.start(self.store()))
        return time.monotonic() - start

    def intact(self, fault, store):
        """Fail unless every row there is as it has to be."""
        for name, content in rows_of(store).items():
            if isinstance(content, DamagedRowError):
                self.part.fail(fault, "row damaged", f"{name}: {content}")
                return False
            if self.wanted.get(name) != content:
                self.part.fail(fault, "row changed", name)
                return False
        return True

    def resumed(self, fault, store):
        """Run the campaign to its end and compare."""
        try:
            run(read_design(self.design), store)
        except WirecutError as error:
            self.part.fail(fault, "no rerun", str(error))
        if rows_of(store) != self.wanted:
            self.part.fail(fault, "other rows after a rerun", f"{len(rows_of(store))} rows")
        elif list(store.glob("rows/.*")) or (store / "damaged").exists():
            self.part.fail(fault, "leftovers", str(sorted(store.rglob("*")))[-300:])
        else:
            self.part.count(fault, "intact, same bits after a rerun")

    def killed(self, moment):
        """Kill the campaign, every other time with its workers, at a moment after its start."""
        store = self.store()
        process = self.start(store)
        time.sleep(moment)
        if self.number % 2:
            self.swept(process)
        else:
            process.kill()  # workers end at their next row, idle ones after five minutes
            process.wait()
            time.sleep(1.0)
            self.orphans = max(self.orphans, self.swept(process))
        fault = "killed before its first row" if not rows_of(store) else "killed"
        if self.intact(fault, store):
            self.resumed(fault, store)

    def worker_killed(self, moment):
        """Kill one worker; the campaign says so and ends, or goes on without it."""
        store, fault = self.store(), "worker killed"
        process = self.start(store)
        time.sleep(moment)
        workers = _children(process.pid)
        if workers:
            os.kill(workers[-1], signal.SIGKILL)
        code, said = self.finished(process)
        if code is None or (code and "WirecutError" not in said):
            self.part.fail(fault, "no word about it", said[-300:])
        elif self.intact(fault, store):
            self.resumed(fault, store)

    def two_writers(self):
        """Start two campaigns on one store: the second is told, the first not disturbed."""
        store, fault = self.store(), "two writers"
        first = self.start(store, SLOW)  # at work for longer than the second needs to start
        while not rows_of(store) and first.poll() is None:
            time.sleep(0.02)
        code, said = self.finished(self.start(store))
        if code != 1 or "is driven by process" not in said:
            self.part.fail(fault, "second one not refused", f"{code}: {said[-300:]}")
        code, said = self.finished(first)
        if code != 0 or rows_of(store) != self.wanted:
            self.part.fail(fault, "first one disturbed", f"{code}: {said[-300:]}")
        else:
            self.part.count(fault, "second one refused, first one complete")

    def refused(self, fault, store, words):
        """Run in this process and fail unless it ends in an error of the library with words."""
        try:
            run(read_design(self.design), store)
        except WirecutError as error:
            if words in str(error):
                self.part.count(fault, "refused in words")
                return
            self.part.fail(fault, "other words", str(error))
        except Exception as error:
            self.part.fail(fault, "other error", f"{type(error).__name__}: {error}")
        else:
            self.part.fail(fault, "not noticed", str(store))

    def disk_full(self):
        """Fill a small disk at the rows, then before the first one; then make it larger."""
        for fault, size in (("disk full", "100k"), ("disk full from the start", "4k")):
            with small_disk(self.part, fault, self.folder, size) as disk:
                if disk is None:
                    return
                store = disk / "store"
                if size == "4k":
                    (disk / "filling").write_bytes(bytes(4096))
                self.refused(fault, store, "No space left" if size == "100k" else "")
                if self.intact(fault, store):
                    _remounted(disk, "size=20m")
                    self.resumed(fault, store)

    def read_only(self):
        """Take the right to write away, half way and before the first row; then give it back."""
        for fault, begun in (("read-only store", True), ("read-only new store", False)):
            with small_disk(self.part, fault, self.folder, "20m") as disk:
                if disk is None:
                    return
                store = disk / "store"
                if begun:
                    run(read_design(self.design), store)
                    for path in list(store.glob("rows/*.row"))[::2]:
                        path.unlink()
                _remounted(disk, "ro")
                self.refused(fault, store, "cannot be")
                _remounted(disk, "rw")
                if self.intact(fault, store):
                    self.resumed(fault, store)

    def clock_jumps(self, seed):
        """Let the clock jump by up to fifty years either way at every look, and files' times."""
        jumps, store, fault = random.Random(seed), self.store(), "clock jumps"
        real = time.time

        def wrong():
            return max(0.0, real() + jumps.uniform(-1.5e9, 1.5e9))

        with mock.patch.object(time, "time", wrong):
            run(read_design(self.design), store)
        if not self.intact(fault, store):
            return
        for path in list(store.glob("rows/*.row")):
            if jumps.random() < 0.5:
                path.unlink()
            else:
                os.utime(path, (jumps.uniform(0.0, 4e9),) * 2)
        with mock.patch.object(time, "time", wrong):
            run(read_design(self.design), store)
        self.resumed(fault, store)


def _of_group(group):
    """Return the processes of a group that are alive."""
    found = []
    for status in Path("/proc").glob("[0-9]*/stat"):
        with suppress(OSError, ValueError):
            fields = status.read_text().rpartition(")")[2].split()
            if int(fields[2]) == group and fields[0] != "Z":
                found.append(int(status.parent.name))
    return found


def _children(parent):
    """Return the processes that a process has started, workers last."""
    try:
        text = Path(f"/proc/{parent}/task/{parent}/children").read_text()
    except OSError:
        return []
    return sorted(map(int, text.split()))


@contextmanager
def small_disk(part, fault, folder, size):
    """Yield a folder on a file system of its own, or None, with a note, where there can be none."""
    disk = Path(tempfile.mkdtemp(dir=folder))
    command = ["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", str(disk)]
    with ExitStack() as stack:
        root = hasattr(os, "geteuid") and os.geteuid() == 0 and shutil.which("mount")
        if not root or subprocess.run(command, capture_output=True, check=False).returncode:
            part.notes.append(f"{fault}: skipped, for it takes the right to mount a file system")
            yield None
            return
        stack.callback(subprocess.run, ["umount", str(disk)], check=True)
        yield disk


def _remounted(disk, options):
    subprocess.run(["mount", "-o", f"remount,{options}", str(disk)], check=True)

"""Damaged and hostile files: refused in words, and nothing in them is executed."""

import hashlib
import io
import random
import shutil
import sys
import tempfile
import time
import zipfile
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from fe_training.campaign.dataset import load_campaign, require_checksum
from fe_training.campaign.design_file import read_design
from fe_training.campaign.store import DamagedRowError, Row, decode_row, encode_row
from fe_training.coupled.dataset import read_coupled as read_rows
from fe_training.coupled.design import read_design as read_coupled
from fe_training.paper.specimen import read_results
from surrogate import read_material, read_measurements
from surrogate.basics.files import models_folder
from surrogate.contact.shipped import fitted_from, read_fitted
from surrogate.coupling.notched import NOTCH_FILE, notch_slip_of
from surrogate.coupling.shipped import AMPLIFICATION_FILE, amplification_of
from surrogate.errors import WirecutError

from .part import Part

__all__ = ["damage", "kinds"]

HELPERS = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(HELPERS))

from fake_engine import record  # noqa: E402 (found by the line above)

EXECUTION = (
    "pickle.find_class",
    "exec",
    "os.system",
    "subprocess.Popen",
    "os.exec",
    "os.posix_spawn",
)
"""Events of Python's audit hooks that no file may cause."""


class _Audit:
    """Remembers forbidden events while it is switched on; a hook cannot be taken away again."""

    on, seen, installed = False, [], False

    @classmethod
    def hook(cls, event, arguments):
        if cls.on and event in EXECUTION:
            code = arguments[0] if arguments else None
            if event == "exec" and _of_the_library(code):
                return
            cls.seen.append(f"{event} {arguments!r:.80}")

    @classmethod
    @contextmanager
    def watching(cls):
        """Yield the list of what was executed."""
        if not cls.installed:
            sys.addaudithook(cls.hook)
            cls.installed = True
        cls.on, cls.seen = True, []
        try:
            yield cls.seen
        finally:
            cls.on = False


def _of_the_library(code):
    """Return whether code is that of a module that is imported at its first use."""
    return getattr(code, "co_name", "") == "<module>" and Path(code.co_filename).suffix == ".py"


def kinds(folder):
    """Return, by name, a sound file, the function that reads it, and whether it has a checksum.

    Every shipped file is there; where there are no fitted models and no data set yet, made-up ones.
    """
    sound = {
        path.name: (path, *_reader(path))
        for path in sorted(Path(models_folder()).iterdir())
        if _reader(path)
    }
    row = Path(folder, "made-up.row")
    from fe_training.campaign.design import Configuration

    one = Configuration("coarse", 2.0, 0.1)
    row.write_bytes(encode_row(Row(one, 0, 1, {"wirecut": "0"}, record(2.0, 0.1))))
    sound[row.name] = row, lambda file: decode_row(file.read_bytes()), True
    return sound


def _reader(path):
    """Return the function that reads a shipped file, and whether a checksum is beside it."""
    summed = path.with_name(path.name + ".sha256").is_file()
    made_of = {AMPLIFICATION_FILE: amplification_of, NOTCH_FILE: _tip_of}.get(
        path.name, fitted_from
    )
    readers = {
        ".h5": read_rows if path.name == "coupled.h5" else load_campaign,
        ".npz": lambda file: made_of(*read_fitted(file)),
        ".toml": read_coupled if path.name == "coupled.toml" else read_design,
        ".csv": read_measurements,
    }
    if path.name.endswith("material.json"):
        return read_material, summed
    if path.name == "specimens.csv":
        return _specimens, summed
    if path.suffix == ".csv" and "wire-cutting" not in path.name:
        return None  # tables of results, which people read
    return (readers[path.suffix], summed) if path.suffix in readers else None


def _tip_of(about, _):
    return notch_slip_of(about)


def _specimens(file):
    require_checksum(file)
    return read_results(file)


def damage(number=2000, seed=0, extra=()):
    """Read files with single bytes flipped, cut short, and of random bytes.

    Parameters
    ----------
    number : int
        Positions of each file; a tenth as many truncations and files of random bytes.
    seed : int
        Of the positions.
    extra : iterable of Path
        Further files to damage, such as fitted models that are not shipped.
    """
    part = Part("damage", "Files with a byte flipped, cut short, or of random bytes")
    start = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        files = kinds(folder)
        files |= {f"made-up {path.name}": (path, *_reader(path)) for path in extra}
        for name, (path, read, summed) in files.items():
            _damaged(part, name, path, read, summed, Path(folder, "damaged"), number, seed)
    part.seconds = time.monotonic() - start
    return part


def _damaged(part, name, path, read, summed, folder, number, seed):
    content, chance = path.read_bytes(), random.Random(seed)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    victim = folder / path.name
    beside = path.with_name(path.name + ".sha256")
    if beside.is_file():
        shutil.copy(beside, folder)
    victim.write_bytes(content)
    read(victim)  # the sound file is read
    places = chance.sample(range(len(content)), min(number, len(content)))
    for place in places:
        bad = bytearray(content)
        bad[place] ^= 1 << chance.randrange(8)
        _try(part, f"{name}, flipped", victim, bytes(bad), read, must_refuse=summed)
    few = max(number // 10, 3)
    for _ in range(few):
        cut = content[: chance.randrange(len(content))]
        _try(part, f"{name}, cut short", victim, cut, read, must_refuse=summed)
        noise = chance.randbytes(chance.randrange(2 * len(content)))
        _try(part, f"{name}, random", victim, noise, read, must_refuse=True)
    if not summed:
        return
    for place in places[: max(number // 4, 3)]:
        bad = bytearray(content)
        bad[place] = chance.randrange(256)
        _try(part, f"{name}, hostile", victim, _summed(bytes(bad), victim), read, must_refuse=False)
    for bad in (*_bombs(), chance.randbytes(500)):
        _try(part, f"{name}, hostile", victim, _summed(bad, victim), read, must_refuse=True)
    if beside.is_file():
        for bad in (b"", b"\xff\xfe", b"0 x\n", chance.randbytes(64)):
            victim.write_bytes(content)
            (folder / beside.name).write_bytes(bad)
            _try(part, f"{name}, checksum", victim, content, read, must_refuse=True)


def _summed(content, victim):
    """Return content with its own, right checksum: in the file or beside it."""
    if victim.suffix == ".row":
        payload = content.partition(b"\n")[2] or content
        return b"wirecut-row-1 %s\n%s" % (hashlib.sha256(payload).hexdigest().encode(), payload)
    line = f"{hashlib.sha256(content).hexdigest()}  {victim.name}\n"
    victim.with_name(victim.name + ".sha256").write_text(line)
    return content


def _bombs():
    """Yield archives that ask to be unpickled, to be enormous, or to write elsewhere."""

    class Harm:
        def __reduce__(self):
            return print, ("executed",)

    for name, values in (
        ("about", np.array([Harm()], dtype=object)),
        ("../../escaped", np.zeros(1)),
        ("/escaped", np.zeros(1)),
    ):
        buffer = io.BytesIO()
        np.savez(buffer, **{name: values})
        yield buffer.getvalue()
    head = b"{'descr': '<f8', 'fortran_order': False, 'shape': (1000000000000,), }"
    head += b" " * (-(len(head) + 11) % 64) + b"\n"
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        archive.writestr("about.npy", b"\x93NUMPY\x01\x00" + len(head).to_bytes(2, "little") + head)
    yield buffer.getvalue()


def _try(part, row, victim, content, read, must_refuse):
    victim.write_bytes(content)
    before = set(victim.parent.parent.iterdir())
    with _Audit.watching() as executed:
        try:
            read(victim)
            outcome, what = "read", ""
        except (WirecutError, DamagedRowError):
            outcome, what = "refused", ""
        except Exception as error:
            outcome, what = "other error", f"{type(error).__name__}: {error}"
    if executed:
        outcome, what = "executed", executed[0]
    elif set(victim.parent.parent.iterdir()) != before:
        outcome, what = "escaped", str(set(victim.parent.parent.iterdir()) - before)
    elif outcome == "read" and must_refuse:
        outcome, what = "not noticed", f"{len(content)} bytes"
    if outcome in ("read", "refused"):
        part.count(row, outcome)
    else:
        part.fail(row, outcome, what)

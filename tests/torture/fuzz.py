"""Tables and properties out of any bytes: read or refused in words, in little memory."""

import json
import random
import tempfile
import time
import tracemalloc
from pathlib import Path

from hypothesis import HealthCheck, Phase, given, seed, settings
from hypothesis import strategies as st

from surrogate import read_material, read_measurements
from surrogate.basics.files import model_file
from surrogate.errors import WirecutError

from .part import Part

__all__ = ["fuzz"]

TIMES, LINE, FLOOR = 10, 500, 200_000
"""Memory that reading may take: times the size of the file, a line, and besides [bytes].

The delimiter and the decimal sign are read off all lines, so that a line is held as text (60 bytes
and its letters) and as a row (list, tuple and number, 200 bytes, and 60 a cell) at the same time.
"""

ODD_CELLS = (
    *("1", "0.5", "-1", "0", "1e999", "1e-999", "nan", "inf", "", " ", "1_0", "١", "0x1", "1e"),
    *("=1+1", '"1"', '"', "1;5", "1,5", "\t", "#", "9" * 400, "1e" + "9" * 30, "\0", "\ufeff"),
)
ODD_NAMES = (
    *("wire_radius_mm", "wire_diameter_um", "force_per_thickness_N_per_m", "force_std_N_per_m"),
    *("wire_radius", "wire_radius_furlong", "wire_radius_", "force", "../../etc/passwd", "$(x)"),
)
ODD_KEYS = "schema", "name", "shear_modulus_kPa", "shear_modulus_Pa", "stiffening_exponent"
CELLS = st.sampled_from(ODD_CELLS) | st.text(max_size=20) | st.floats(width=64).map(repr)
NAMES = st.sampled_from(ODD_NAMES) | st.text(max_size=20)
LINES = st.lists(CELLS, max_size=5).map(",".join)
TABLES = st.builds(
    lambda names, lines, end: end.join([",".join(names), *lines]).encode("utf-8", "surrogatepass"),
    st.lists(NAMES, max_size=5),
    st.lists(LINES, max_size=20),
    st.sampled_from(["\n", "\r\n", "\r", "\n\n", "\0"]),
)
VALUES = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=20),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner),
    max_leaves=8,
)
KEYS = st.sampled_from(ODD_KEYS) | st.text(max_size=20)


def _json(properties):
    return json.dumps(dict(properties)).encode()


PROPERTIES = st.lists(st.tuples(KEYS, VALUES), max_size=6).map(_json)


def fuzz(number=3000, size=5_000_000, start_at=0):
    """Read made-up files.

    Parameters
    ----------
    number : int
        Files of each kind.
    size : int
        Bytes of the large files.
    start_at : int
        Seed.
    """
    part = Part("fuzz", "Tables and properties out of any bytes")
    begun = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "file")
        for row, read, contents in (
            ("table", read_measurements, TABLES | st.binary(max_size=400)),
            ("properties", read_material, PROPERTIES | st.binary(max_size=400)),
        ):
            _made_up(part, row, read, contents, file, number, start_at)
        for name, read in (
            ("paam-wire-cutting.csv", read_measurements),
            ("paam-material.json", read_material),
        ):
            _changed(part, name, read, file, number, start_at)
        for name, content in _large(size):
            for read in (read_measurements, read_material):
                _read(part, f"large: {name}", read, file, content)
    part.seconds = time.monotonic() - begun
    return part


def _made_up(part, row, read, contents, file, number, start_at):
    @seed(start_at)
    @settings(
        max_examples=number,
        database=None,
        deadline=None,
        phases=[Phase.generate],
        suppress_health_check=list(HealthCheck),
    )
    @given(contents)
    def one(content):
        _read(part, f"made up: {row}", read, file, content)

    one()


def _changed(part, name, read, file, number, start_at):
    """Change a sound file in a few places: bytes overwritten, put in, taken out, doubled."""
    sound, chance = model_file(name).read_bytes(), random.Random(start_at)
    for _ in range(number):
        content = bytearray(sound)
        for _ in range(chance.randint(1, 4)):
            place = chance.randrange(len(content) + 1)
            piece = chance.choice(
                [b"", b"\0", b",", b"\n", b'"', b"-", b"e", b"\xff", content[:place], b"9" * 50]
            )
            content[place : place + chance.randint(0, 3)] = piece
        _read(part, f"changed: {name}", read, file, bytes(content[:100_000]))


def _large(size):
    """Yield names and contents of large files, most of them no tables at all."""
    head = b"wire_radius_mm,force_per_thickness_N_per_m\n"
    yield "one line", b"1" * size
    yield "empty lines", b"\n" * size
    yield "comments", b"# comment\n" * (size // 10)
    yield "commas", head + b"," * size
    yield "quotes", head + b'"' * size
    yield "numbers", head + b"1,2\n" * (size // 4)
    yield "brackets", b"[" * size
    yield "braces", b'{"a":' * (size // 5)
    yield "zeros", bytes(size)
    yield "no text", b"\xff" * size
    yield "columns", b",".join([b"wire_radius_mm"] * (size // 15))


def _read(part, row, read, file, content):
    file.write_bytes(content)
    tracemalloc.start()
    try:
        read(file)
        outcome, what = "read", ""
    except WirecutError as error:
        outcome = "refused"
        what = "" if len(str(error)) < 2000 else f"{len(str(error))} characters of message"
    except Exception as error:
        outcome, what = "other error", f"{type(error).__name__}: {error}, {content[:80]!r}"
    memory = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    lines = len(content.splitlines())
    if memory > TIMES * len(content) + LINE * lines + FLOOR:
        outcome, what = "too much memory", f"{memory} for {len(content)} bytes"
    if what:
        part.fail(row, outcome if outcome != "refused" else "long message", what)
    else:
        part.count(row, outcome)

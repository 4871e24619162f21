"""The same numbers whatever the company they come in: alone, in arrays, threads and processes."""

import os
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

import surrogate
import surrogate.contact.shipped
from surrogate.errors import InputError

from .cases import cases
from .cells import REFUSED, attempt, numbers_in
from .part import Part

__all__ = ["invariances"]

RANGES = {"g": (1e-3, 1e3), "delta": (1.01, 1e3), "relative_distance": (1.0, 1e3)}
BATCHES = (1, 2, 3, 7, 64, 1000)
THREADS, SECONDS = 8, 600
HERE = Path(__file__).resolve().parent


def arguments_of(case, number, seed=0):
    """Return arrays of random sound arguments, and the arguments that are none."""
    random = np.random.default_rng(seed)
    given = dict(case.arguments)
    for name in case.numeric:
        if name in ("alpha", "stiffening_exponent"):
            given[name] = random.uniform(2.0, 9.0, number)
            continue
        sound = case.arguments[name]
        low, high = RANGES.get(name, (0.1 * sound, 10.0 * sound))
        given[name] = np.exp(random.uniform(np.log(low), np.log(high), number))
    if "extrapolate" in given:
        given["extrapolate"] = True  # so that nothing random is refused
    return given


def tortured(drawn=False):
    """Return the cases that answer for each entry of an array."""
    return [case for case in cases(drawn) if case.numeric and "scene" not in case.arguments]


def file_of(label):
    """Return the name of the file in which another process leaves its results."""
    return f"{label.replace(': ', '-')}.npz"


def flat(result):
    """Return the floats of a result, one row for each of its parts."""
    if isinstance(result, surrogate.Regime):
        return [np.ravel(result.dominant), np.ravel(result.contact)]
    return [np.ravel(one) for one in numbers_in(result)]


def same(a, b):
    """Return whether arrays of numbers or words are the same, nan being nan."""
    return np.array_equal(a, b, equal_nan=a.dtype.kind == "f")


def _first_difference(a, b):
    if a.shape != b.shape:
        return f"shape {a.shape} for {b.shape}"
    i = np.flatnonzero((a != b) & ~((a != a) & (b != b)))[0]
    return f"entry {i}, {a[i]!r} for {b[i]!r}"


def invariances(number=2000, processes=True):
    """Evaluate random points in every way and compare bit for bit with each point alone."""
    part = Part("invariances", "Random points in every company, bit for bit")
    start = time.monotonic()
    expected = {}
    for case in tortured():
        given = arguments_of(case, number)
        whole, ended = attempt(case.call, given)
        if ended is not None and ended[0] == REFUSED:  # a model that does not reach so far
            part.count("all at once", REFUSED)
            continue
        if ended is not None:
            part.fail("all at once", ended[0], f"{case.label}: {ended[1]}")
            continue
        expected[case.label] = flat(whole)
        for way, differs in _ways(case, given, flat(whole), number):
            if differs:
                part.fail(way, "differs", f"{case.label}: {differs}")
            else:
                part.count(way, "same bits")
    if processes:
        _in_processes(part, expected, number)
    part.seconds = time.monotonic() - start
    return part


def _ways(case, given, whole, number):
    """Yield each way of evaluation and what is different in it."""
    names = case.numeric

    def some(index):
        return {**given, **{n: given[n][index] for n in names}}

    def changed(change):
        return {**given, **{n: change(given[n]) for n in names}}

    def differs(arguments, wanted):
        result, ended = attempt(case.call, arguments)
        if ended is not None:
            return f"{ended[0]} ({ended[1]})"
        parts = flat(result)
        if len(parts) == len(wanted) and all(map(same, parts, wanted)):
            return ""
        return next(
            _first_difference(a, b) for a, b in zip(parts, wanted, strict=True) if not same(a, b)
        )

    def at(index):
        return [one[index] for one in whole]

    random = np.random.default_rng(1)
    for i in random.choice(number, min(number, 100), replace=False):
        alone = {**given, **{n: float(given[n][i]) for n in names}}
        yield "alone", differs(alone, at([i]))
    for size in BATCHES:
        first = int(random.integers(0, max(number - size, 1)))
        batch = slice(first, first + size)
        yield f"in batches of {size}", differs(some(batch), at(batch))
    order = random.permutation(number)
    yield "in another order", differs(some(order), at(order))
    yield "reversed view", differs(some(slice(None, None, -1)), at(slice(None, None, -1)))
    yield "every other one, strided", differs(some(slice(None, None, 2)), at(slice(None, None, 2)))
    yield "big-endian", differs(changed(lambda v: v.astype(">f8")), whole)
    yield "little-endian", differs(changed(lambda v: v.astype("<f8")), whole)
    yield "longdouble", differs(changed(lambda v: v.astype(np.longdouble)), whole)
    yield (
        "columns first",
        differs(changed(lambda v: np.asfortranarray(v.reshape(number // 2, 2))), whole),
    )
    single = changed(lambda v: v.astype(np.float32))
    as_double, _ = attempt(case.call, changed(lambda v: v.astype(np.float32).astype(float)))
    yield "float32", differs(single, flat(as_double))
    masked, ended = attempt(case.call, changed(np.ma.masked_array))
    refused = ended is not None and ended[0] == REFUSED
    yield "masked, refused", "" if refused else f"taken as {masked!r:.80}"
    with ThreadPoolExecutor(THREADS) as pool:
        found = list(pool.map(lambda _: flat(case.call(**given)), range(THREADS)))
    agree = all(all(map(same, each, whole)) for each in found)
    yield f"in {THREADS} threads", "" if agree else "threads disagree"


def _in_processes(part, expected, number):
    """Compare with what another process finds, started afresh."""
    with tempfile.TemporaryDirectory() as folder:
        try:
            surrogate.contact.shipped.shipped()
            models = str(surrogate.contact.shipped.models_folder())
        except InputError:
            models = ""
        path = os.pathsep.join([str(HERE.parent), str(HERE.parent.parent)])
        command = [sys.executable, "-m", "torture.elsewhere", folder, str(number), models]
        done = subprocess.run(
            command,
            env={**os.environ, "PYTHONPATH": path},
            capture_output=True,
            text=True,
            check=False,
            timeout=SECONDS,
        )
        if done.returncode:
            part.fail("in another process", "other error", done.stderr[-300:])
            return
        for label, wanted in expected.items():
            with np.load(Path(folder, file_of(label)), allow_pickle=False) as archive:
                found = [archive[name] for name in archive.files]
            if len(found) == len(wanted) and all(map(same, found, wanted)):
                part.count("in another process", "same bits")
            else:
                part.fail("in another process", "differs", label)

"""The matrix of extreme values: function x argument x value, each cell with one outcome."""

import signal
import sys
import time
import warnings
from contextlib import contextmanager
from dataclasses import fields, is_dataclass
from itertools import islice

import numpy as np

from surrogate.errors import ImplausibleInputWarning, WirecutError

from .cases import cases
from .exact import close
from .part import Part
from .values import LONG, NOT_NUMBERS, NUMBERS, SIZES, arrays_of, kinds_of

__all__ = ["corners", "extremes"]

SECONDS = 60
WAITING = 15
"""Times as long by the clock, for what waits and does not compute."""
CHECKED, SOUND, REFUSED = "value as exact", "value", "refused by name"
PHRASES = ("must be a ratio with a limit", "has no limit", "has no answer", "must broadcast")
"""In errors about several arguments together, none of which is wrong by itself."""
WRONG = ("other error", "warning", "wrong value", "nan", "argument not named", "hangs", "differs")
MAY_BE_NAN = {  # by the documentation of each result
    "friction_sensitivity",
    *("r_squared", "correlation", "reduced_chi_squared", "profile", "covariance", "leverage"),
    *("condition", "further_wire", "relative_error", "term_shares", "boundaries", "relative_force"),
    *("fit_error", "law_error"),
}


class Hang(Exception):
    """A call took too long."""


@contextmanager
def _limited():
    """Stop what takes too long: by the processor's time, which no other process adds to."""

    def stop(*_):
        raise Hang

    timers = {
        signal.SIGPROF: (signal.ITIMER_PROF, 1),
        signal.SIGALRM: (signal.ITIMER_REAL, WAITING),
    }
    before = {number: signal.signal(number, stop) for number in timers}
    for timer, factor in timers.values():
        signal.setitimer(timer, factor * SECONDS)
    try:
        yield
    finally:
        for number, (timer, _) in timers.items():
            signal.setitimer(timer, 0.0)
            signal.signal(number, before[number])


def attempt(call, arguments):
    """Return result and None, or None and how the call ended instead."""
    with warnings.catch_warnings(record=True) as caught, _limited():
        warnings.simplefilter("always")
        warnings.simplefilter("ignore", ImplausibleInputWarning)  # tortures are implausible
        try:
            result = call(**arguments)
        except WirecutError as error:
            if caught:
                return None, ("warning", str(caught[0].message))
            return None, (REFUSED, str(error))
        except Hang:
            return None, ("hangs", f"more than {SECONDS} s")
        except Exception as error:
            return None, ("other error", f"{type(error).__name__}: {error}"[:200])
    if caught:
        return None, ("warning", str(caught[0].message))
    return result, None


def numbers_in(result):
    """Yield the floats and arrays of floats in a result, but those that may be nan."""
    if isinstance(result, (bool, str, int)) or result is None:
        return
    if isinstance(result, (float, np.floating)):
        yield result
    elif isinstance(result, np.ndarray):
        if result.dtype.kind == "f":
            yield result
    elif is_dataclass(result):
        for one in fields(result):
            if one.name not in MAY_BE_NAN:
                yield from numbers_in(getattr(result, one.name))
    elif isinstance(result, (tuple, list)):
        for one in result:
            yield from numbers_in(one)
    elif isinstance(result, dict):
        for one in result.values():
            yield from numbers_in(one)


def _judged(case, arguments, result):
    """Return outcome and what is wrong of a result, with the exact one where there is one."""
    if any(np.isnan(one).any() for one in numbers_in(result)):
        return "nan", f"{result!r:.200}"
    if case.exact is None or not all(type(arguments[n]) in (float, int) for n in case.numeric):
        return SOUND, ""
    wanted = case.exact(**arguments)
    for value, exactly in zip(case.values(result), wanted, strict=True):
        if not close(value, exactly, case.tolerance):
            return "wrong value", f"{value!r} where {exactly} is exact"
    return CHECKED, ""


def _named(case, argument, message):
    first = argument.partition("_")[0]
    return (
        argument in message
        or any(alias in message for alias in case.aliases)
        or any(phrase in message for phrase in PHRASES)
        or f"{first} " in message
    )


def cell(part, case, argument, kind, value):
    """Run one cell; return its result, or None where there is none."""
    arguments = {**case.arguments, argument: value}
    where = f"{case.label}({argument} = {kind})"
    result, ended = attempt(case.call, arguments)
    _close_figures()
    if ended is None:
        outcome, what = _judged(case, arguments, result)
        if outcome in WRONG:
            part.fail(case.label.partition(":")[0], outcome, f"{where}: {what}")
        else:
            part.count(case.label.partition(":")[0], outcome)
        return result
    outcome, what = ended
    if outcome == REFUSED and not _named(case, argument, what):
        outcome = "argument not named"
    if outcome == REFUSED:
        part.count(case.label.partition(":")[0], outcome)
    else:
        part.fail(case.label.partition(":")[0], outcome, f"{where}: {what}")
    return None


def _close_figures():
    if pyplot := sys.modules.get("matplotlib.pyplot"):
        pyplot.close("all")


def _equal(a, b):
    """Return whether results agree to the last bit; entries of arrays with a scalar."""
    pairs = list(zip(numbers_in(a), numbers_in(b), strict=True))
    return all(np.array_equal(np.ravel(x)[:1], np.ravel(y)[:1]) for x, y in pairs)


def extremes(every=1):
    """Run the matrix.

    Parameters
    ----------
    every : int
        Run only every so many cells of a function's argument, others for the next argument, and
        then without figures and very long arrays.
    """
    part = Part("cells", "Every public function, every argument, every kind of value")
    start = time.monotonic()
    arguments = [(case, name) for case in cases(drawn=every == 1) for name in case.arguments]
    for turn, (case, argument) in enumerate(arguments):
        _row(part, case, argument, turn, every)
    part.seconds = time.monotonic() - start
    return part


def _row(part, case, argument, turn, every):
    def some(kinds):
        return list(kinds.items())[turn % every :: every]

    for kind, value in some(NOT_NUMBERS):
        cell(part, case, argument, kind, value)
    for kind, value in some(NUMBERS):
        alone = cell(part, case, argument, kind, value)
        if argument in case.numeric:
            together = cell(part, case, argument, f"array of {kind}", np.array([value]))
            _compare(part, case, argument, kind, alone, together)
    if argument not in case.numeric:
        for kind, value in some(arrays_of(3.0, 2)):
            cell(part, case, argument, kind, value)
        return
    expected, _ = attempt(case.call, {**case.arguments, argument: 3.0})
    for kind, value in some({**kinds_of(3.0), **arrays_of(3.0, 8)}):
        _compare(part, case, argument, kind, expected, cell(part, case, argument, kind, value))
    sound = case.arguments[argument]
    for shape in ((0,), (2, 0, 3), (1, 2, 1)):
        cell(part, case, argument, f"array of shape {shape}", np.full(shape, sound))
    if every == 1 and not case.slow:
        cell(part, case, argument, "very long array", np.full(LONG, sound))


def _compare(part, case, argument, kind, one, other):
    """Fail where results differ in a bit, or only one of them is there."""
    same = one is other if one is None or other is None else _equal(one, other)
    if not same:
        where = f"{case.label}({argument} = {kind}) from the plain number"
        part.fail(case.label.partition(":")[0], "differs", where)


def corners(number=2000, seed=0):
    """Compare with the exact values where all arguments are extreme at once."""
    part = Part("corners", "Closed forms where all arguments are extreme at once")
    start = time.monotonic()
    random = np.random.default_rng(seed)
    for case in cases(drawn=False):
        if case.exact is None:
            continue
        for arguments in islice(_drawn(case, random), number):
            result, ended = attempt(case.call, arguments)
            label = case.label.partition(":")[0]
            where = f"{case.label}({_shown(case, arguments)})"
            if ended is None:
                outcome, what = _judged(case, arguments, result)
            else:
                outcome, what = ended
            if outcome in WRONG:
                part.fail(label, outcome, f"{where}: {what}")
            else:
                part.count(label, outcome)
    part.seconds = time.monotonic() - start
    return part


def _drawn(case, random):
    """Yield arguments of any size: half of them from the list, half of any power of ten."""
    sizes = list(SIZES.values())
    while True:
        yield {
            **case.arguments,
            **{
                name: (
                    sizes[random.integers(len(sizes))]
                    if random.random() < 0.5
                    else float(10.0 ** random.uniform(-307, 308))
                )
                if name not in ("alpha", "stiffening_exponent") or random.random() < 0.2
                else float(random.uniform(2.0, 9.0))
                for name in case.numeric
            },
        }


def _shown(case, arguments):
    return ", ".join(f"{name}={arguments[name]!r}" for name in case.numeric)

"""What one force costs in a loop at 1 kHz, and 1e6 of them: prepared, public, by other libraries.

All ways are called once a millisecond, one after the other, as a control loop would, and each call
is timed by the clock: whatever the machine does in between is in the worst of them, and an empty
function beside them tells how much that is. What takes longer than a part of the millisecond is
called at once, fewer times. CoolProp's tabulated backends answer another question, the temperature
of water from enthalpy and pressure, by the same kind of table.
"""

import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.util import find_spec
from typing import Any

import numpy as np
from contenders import Contender
from measuring import NUMBERS, least, plain

from fe_training.markdown import markdown_table
from surrogate import Scene, cutting_force, prepare
from surrogate.contact.shipped import shipped

TICK = 1e-3
#: Longest call that the loop has room for [s], and how often others are called.
ROOM, FEW = 1e-4, 1000
ALPHA, RANGE = 2.5, (1e-4, 1e-3)
EMPTY, PREPARED = "empty function", "prepared"
MANY = 10**6


@dataclass
class Way:
    """A way to a force: of one radius, and of many where it can."""

    name: str
    one: Callable[[float], Any]
    many: Callable[[Any], Any] | None = None
    compiled: bool = False


def ways(others: Sequence[Contender]) -> list[Way]:
    """Return the ways that are installed, all for the radius of the wire."""
    mu, gamma, _, xi, wear = NUMBERS
    gel = Scene(*NUMBERS, ALPHA)
    ready = prepare(gel, ranges={"wire_radius": RANGE}, model="table")
    found = [
        Way(EMPTY, lambda radius: None),
        Way("plain Eq. (13)", *[lambda radius: plain(mu, gamma, radius, xi, wear)] * 2),
        Way(PREPARED, ready, ready),
    ]
    if find_spec("numba"):
        found.append(Way("prepared, numba", ready, ready, compiled=True))
    for model, words in (("eq13", "eq13"), ("table", "table"), ("auto", "auto")):

        def public(radius: Any, model: str = model) -> Any:
            scene = Scene(mu, gamma, radius, xi, wear, ALPHA)
            return cutting_force(scene, model, law="projected").total  # as `prepare` has it

        found.append(Way(f"cutting_force, {words}", public, public))
    if find_spec("numba"):
        by_hand = bicubic_by_hand()
        found.append(Way("bicubic by hand, numba", by_hand[0], by_hand[1], compiled=True))
    found += [_force_of(other) for other in others]
    return [*found, *coolprop()]


def _force_of(other: Contender) -> Way:
    """Return the force by A and B of another library."""
    mu, gamma, _, xi, wear = NUMBERS

    def force(radius: Any) -> Any:
        radius = np.atleast_1d(radius)
        g = gamma / (mu * radius)
        arc, load = other.functions(g, np.full(g.shape, ALPHA), ("arc", "normal_load"))
        return gamma + 2.0 * radius * (wear * arc + xi * mu * load)

    return Way(other.name, force, force)


def bicubic_by_hand() -> tuple[Callable[[float], float], Callable[[Any], Any]]:
    """Return the force by cubic convolution of A and B on an even grid, as one would write it."""
    from numba import njit

    mu, gamma, _, xi, wear = NUMBERS
    limits, rows, columns = shipped().limits, 200, 50
    (low, _), (first, last) = limits.log_g, limits.log_alpha
    high = float(np.log(limits.highest_g(limits.alpha[0])))
    log_g, log_alpha = np.linspace(low, high, rows), np.linspace(first, last, columns)
    at = (np.exp(each) for each in np.meshgrid(log_g, log_alpha, indexing="ij"))
    arc, load = shipped().models["table"].contact(("arc", "normal_load"), *at)
    per_g, per_alpha = (rows - 1) / (high - low), (columns - 1) / (last - first)
    row = float(np.log(ALPHA))

    @njit(error_model="numpy")
    def weights(t: float) -> Any:
        return (
            t * (-0.5 + t * (1.0 - 0.5 * t)),
            1.0 + t * t * (-2.5 + 1.5 * t),
            t * (0.5 + t * (2.0 - 1.5 * t)),
            t * t * (-0.5 + 0.5 * t),
        )

    @njit(error_model="numpy")
    def one(radius: float) -> float:
        x = (np.log(gamma / (mu * radius)) - low) * per_g
        y = (row - first) * per_alpha
        i, j = min(max(int(x), 1), rows - 3), min(max(int(y), 1), columns - 3)
        u, v = weights(x - i), weights(y - j)
        a = b = 0.0
        for k in range(4):
            for m in range(4):
                a += u[k] * v[m] * arc[i - 1 + k, j - 1 + m]
                b += u[k] * v[m] * load[i - 1 + k, j - 1 + m]
        return gamma + 2.0 * radius * (wear * a + xi * mu * b)

    @njit(error_model="numpy")
    def many(radii: Any) -> Any:
        result = np.empty(radii.size)
        for n in range(radii.size):
            result[n] = one(radii[n])
        return result

    return one, many


def coolprop() -> Iterator[Way]:
    """Yield CoolProp's tabulated backends, where it is installed."""
    if not find_spec("CoolProp"):
        return
    import CoolProp
    from CoolProp import CoolProp as library

    folder = tempfile.mkdtemp()  # where it keeps its tables
    library.set_config_string(library.ALTERNATIVE_TABLES_DIRECTORY, folder)
    for backend in ("BICUBIC", "TTSE"):
        water = CoolProp.AbstractState(f"{backend}&HEOS", "Water")

        def temperature(radius: float, water: Any = water) -> float:
            water.update(CoolProp.HmassP_INPUTS, 4e5 + 1e8 * radius, 1e6)
            return float(water.T())

        yield Way(f"CoolProp {backend}, water", temperature)


@dataclass
class Loop:
    """What was measured of a way: percentiles of its calls [us], and of many values [ns each]."""

    name: str
    middle: float
    rare: float
    worst: float
    calls: int
    many: float = float("nan")


def measure(others: Sequence[Contender], ticks: int, longest: float) -> list[Loop]:
    """Return what all ways cost; those that take more than `longest` seconds for many have none."""
    every = ways(others)
    radii = np.random.default_rng(2).uniform(*RANGE, max(ticks, FEW)).tolist()
    for way in every:
        way.one(radii[0])  # which may compile or prepare something
    quick = [way for way in every if least(lambda way=way: way.one(radii[1]), 5, 0.02) <= ROOM]
    times = _at_ticks(quick, radii[:ticks])
    for way in every:
        if way not in quick:
            times[way.name] = _at_once(way, radii[: min(ticks, FEW)])
    found = []
    for way in every:
        us = 1e-3 * times[way.name]
        middle, rare = np.percentile(us, (50.0, 99.0))
        found.append(Loop(way.name, middle, rare, us.max(), us.size, _many(way, longest)))
    return found


def _at_ticks(some: Sequence[Way], radii: Sequence[float]) -> dict[str, Any]:
    """Call all ways once a tick; return the times of the calls [ns]."""
    times = {way.name: np.empty(len(radii)) for way in some}
    calls = [(way.one, times[way.name]) for way in some]
    clock, begin = time.perf_counter_ns, time.perf_counter()
    for tick, radius in enumerate(radii):
        time.sleep(max(0.0, begin + tick * TICK - time.perf_counter()))
        for one, kept in calls:
            before = clock()
            one(radius)
            kept[tick] = clock() - before
    return times


def _at_once(way: Way, radii: Sequence[float]) -> Any:
    times = np.empty(len(radii))
    for number, radius in enumerate(radii):
        before = time.perf_counter_ns()
        way.one(radius)
        times[number] = time.perf_counter_ns() - before
    return times


def _many(way: Way, longest: float) -> float:
    """Return the time of a value of many [ns], nan where that would take too long."""
    if way.many is None:
        return float("nan")
    radii = np.random.default_rng(3).uniform(*RANGE, MANY)
    with _numba_as_if(way.compiled):
        part = radii[: MANY // 100]
        way.many(part)
        if least(lambda: way.many(part), 1, 0.0) * 100 > longest:  # type: ignore[misc]
            return float("nan")
        return 1e9 * least(lambda: way.many(radii), 1, longest) / MANY  # type: ignore[misc]


@contextmanager
def _numba_as_if(loaded: bool) -> Iterator[None]:
    """Let the library believe that numba is not loaded, where it is not to be used."""
    module = None if loaded else sys.modules.pop("numba", None)
    try:
        yield
    finally:
        if module is not None:
            sys.modules["numba"] = module


def page(found: Sequence[Loop], machine: str) -> str:
    """Return what goes into the documentation."""
    head = ("", "p50, us", "p99, us", "worst, us", "calls", "1e6 forces, ns each", "/ prepared")
    base = next(loop.many for loop in found if loop.name == PREPARED)
    rows = [
        (
            *(f"{value:.3g}" for value in (way.middle, way.rare, way.worst)),
            str(way.calls),
            *("-" if value != value else f"{value:.3g}" for value in (way.many, way.many / base)),
        )
        for way in found
    ]
    table = markdown_table(head, [(w.name, *row) for w, row in zip(found, rows, strict=True)])
    return f"""\
Written by `scripts/bench-tradeoff`, on {machine}; your machine differs, the ratios less so.

One force of one radius, called once a millisecond as a control loop would, by the clock: the
middle, the 99th percentile and the worst call, in which whatever else the machine did is contained,
as the empty function shows. What takes more than {1e6 * ROOM:.0f} us is called without the loop.
The other libraries evaluate A and B from the same data; CoolProp's tables give a temperature.

{table}"""

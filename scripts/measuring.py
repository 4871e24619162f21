"""What the scripts that measure have in common: best times, cold processes, memory."""

import os
import platform
import statistics
import subprocess
import sys
import tracemalloc
from collections.abc import Callable, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time
from typing import Any

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
#: A scene: mu, Gamma_o, R_w, xi and tau_w.
NUMBERS = (685.0, 1.6, 0.25e-3, 0.1, 7750.0)

#: Prints the time `e` and the most memory that the process had; Linux counts that of the process
#: which started it, too, but for one line of its status.
PEAK = """
from pathlib import Path
import resource
import sys
unit = 1 if sys.platform == "darwin" else 1024
peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit
status = Path("/proc/self/status")
if status.is_file():
    lines = [line for line in status.read_text().splitlines() if line.startswith("VmHWM:")]
    peak = 1024 * int(lines[0].split()[1]) if lines else peak
print(e, peak)
"""


def machine() -> str:
    return f"{platform.machine()} with Python {platform.python_version()}, numpy {np.__version__}"


def plain(mu: Any, gamma: Any, radius: Any, xi: Any, wear: Any) -> Any:
    """Return Eq. (13) by the plain expression, the reference of all times."""
    return (1 + xi) * gamma + 4 * (xi * mu + wear) * radius


def seconds(
    function: Callable[[], object], reference: Callable[[], object], calls: int, repeats: int = 15
) -> tuple[float, float]:
    """Return the best mean time of one call of each, which take turns."""
    best = [float("inf")] * 2
    for _ in range(repeats):
        for i, called in enumerate((function, reference)):
            start = process_time()
            for _ in range(calls):
                called()
            best[i] = min(best[i], (process_time() - start) / calls)
    return best[0], best[1]


def least(function: Callable[[], object], calls: int, budget: float, repeats: int = 60) -> float:
    """Return the least mean processor time of one call [s], of as many as the budget [s] allows.

    Processor time leaves out what other processes use, but not that they slow down the memory.
    """
    best, start = float("inf"), process_time()
    for _ in range(repeats):
        before = process_time()
        for _ in range(calls):
            function()
        now = process_time()
        best = min(best, (now - before) / calls)
        if now - start > budget:
            break
    return best


def cold(codes: Sequence[str], processes: int) -> list[tuple[float, float]]:
    """Return the median processor time [s] and peak memory [MB] of codes in fresh processes.

    The processes take turns. All is compiled beforehand, as an installer does.
    """
    found: list[list[tuple[float, float]]] = [[] for _ in codes]
    with TemporaryDirectory() as compiled:
        environment = {**os.environ, "PYTHONPYCACHEPREFIX": compiled}
        environment.pop("PYTHONDONTWRITEBYTECODE", None)
        for turn in range(processes + 1):
            for code, measured in zip(codes, found, strict=True):
                timed = f"from time import process_time as t; s = t()\n{code}\ne = t() - s\n{PEAK}"
                done = subprocess.run(
                    [sys.executable, "-c", timed],
                    capture_output=True,
                    text=True,
                    check=True,
                    cwd=ROOT,
                    env=environment,
                )
                if turn:  # the first compiles
                    time, peak = map(float, done.stdout.split())
                    measured.append((time, peak / 1e6))
    return [
        (statistics.median(t for t, _ in each), statistics.median(m for _, m in each))
        for each in found
    ]


def working_memory(function: Callable[[], object], result_bytes: int) -> float:
    """Return the peak memory of a call beyond its result [B]."""
    tracemalloc.start()
    try:
        before = tracemalloc.get_traced_memory()[0]
        result = function()
        peak = tracemalloc.get_traced_memory()[1]
        del result
    finally:
        tracemalloc.stop()
    return float(peak - before - result_bytes)

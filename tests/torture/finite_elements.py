"""The finite elements where they are not made for: each case has a time limit and a named outcome.

Every case runs in a process of its own, with one thread, and is ended after its time. A case that
is marked good has to be within the evidence bounds once more when they are worked out here.
"""

import json
import os
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

from .part import Part

__all__ = ["CASES", "finite_elements"]

ROOT = Path(__file__).resolve().parents[2]
MINUTES = 15.0
COARSEST = {"sectors": 8, "contact_spacing": 0.4}
COARSE = {"sectors": 14, "contact_spacing": 0.18}
STARTS, SAME_LOAD = 20, 2e-3
"""Starts with a random approach, and how far apart in B their solutions may be at one g."""


@dataclass(frozen=True)
class Case:
    """One configuration: alpha with g or distance, and changed settings."""

    study: str
    alpha: float
    g: float | None = None
    distance: float | None = None
    settings: dict = field(default_factory=dict)
    minutes: float = MINUTES
    start: int | None = None

    def __str__(self):
        where = f"g = {self.g:g}" if self.g is not None else f"delta = {self.distance:g}"
        return ", ".join(
            [f"alpha = {self.alpha:g}", where, *(f"{k} = {v:g}" for k, v in self.settings.items())]
            + ([] if self.start is None else [f"start {self.start}"])
        )


def _cases():
    for alpha in (1.0, 2.0, 3.0, 9.0, 15.0, 20.0):
        yield Case("stiffening", alpha, g=1.0)
        yield Case("smallest toughness", alpha, g=1e-4)
        yield Case("largest toughness", alpha, g=300.0, minutes=6.0)
    for alpha in (2.0, 9.0):
        yield Case("far away", alpha, distance=200.0)
        for radius in (1e2, 1e3, 1e4, 1e5, 1e6):
            yield Case("small bodies", alpha, g=0.5, settings={"outer_radius": radius})
        for g in (0.01, 1.0, 20.0):
            yield Case("coarsest mesh", alpha, g=g, settings=COARSEST, minutes=5.0)
    for start in range(STARTS):
        yield Case("perturbed starts", 3.0, g=2.0, settings=COARSE, minutes=10.0, start=start)


CASES = tuple(_cases())

SOLVE = """
import json, random, sys
from fe_training import solve as engine
from fe_training.solver.cut import Settings
from fe_training.solver.path import Steps

case = json.loads(sys.argv[1])
if case["start"] is not None:
    chance = random.Random(case["start"])
    engine._START *= chance.uniform(0.8, 1.3)
    engine._APPROACH = Steps(0.1 * chance.uniform(0.3, 2.0), 0.2 * chance.uniform(0.5, 2.0))
given = {name: case[name] for name in ("g", "distance") if case[name] is not None}
record = engine.solve(case["alpha"], **given, settings=Settings(**case["settings"]))
print(json.dumps({
    "outcome": record.outcome.name,
    "reason": record.reason,
    "g": record.energy_release_rate,
    "load": record.vertical_force,
    "mismatch": record.force_mismatch,
    "residual": record.residual,
    "distance": record.distance,
    "good": record.within_evidence,
}))
"""


def finite_elements(only=None, most=None, jobs=1, tell=str):
    """Run the cases.

    Parameters
    ----------
    only : str, optional
        Run the cases of one study.
    most : int, optional
        Run no more than so many.
    jobs : int
        Cases at a time.
    tell : callable
        Called with a line on each case as soon as it is done.
    """
    part = Part("finite-elements", "Finite elements at their extremes")
    start, loads = time.monotonic(), []
    cases = [case for case in CASES if only in (None, case.study)][:most]
    with ThreadPoolExecutor(jobs) as pool:
        solutions = list(pool.map(lambda case: _timed(case, tell), cases))
    for case, (found, seconds) in zip(cases, solutions, strict=True):
        _judge(part, case, found, seconds)
        if case.study == "perturbed starts" and found.get("outcome") == "CONVERGED":
            loads.append(found["load"] / found["g"])
    if loads:
        apart = max(loads) / min(loads) - 1.0
        part.notes.append(f"{len(loads)} perturbed starts agree in B/g within {apart:.2g}")
        if apart > SAME_LOAD:
            part.fail("perturbed starts", "another solution", f"B/g apart by {apart:.3g}")
    part.seconds = time.monotonic() - start
    return part


def _timed(case, tell):
    begun = time.monotonic()
    found = solved(case)
    seconds = time.monotonic() - begun
    tell(f"{case.study}, {case}: {found['outcome']} ({seconds:.0f} s)")
    return found, seconds


def solved(case):
    """Return what a case came to: numbers of its record, or "outcome" and "reason" alone."""
    content = {n: getattr(case, n) for n in ("alpha", "g", "distance", "settings", "start")}
    environment = {f"{n}_NUM_THREADS": "1" for n in ("OMP", "MKL", "OPENBLAS", "NUMBA")}
    try:
        done = subprocess.run(
            [sys.executable, "-c", SOLVE, json.dumps(content)],
            env={**os.environ, **environment},
            cwd=ROOT,
            capture_output=True,
            text=True,
            check=False,
            timeout=60.0 * case.minutes,
        )
    except subprocess.TimeoutExpired:
        return {"outcome": "OUT_OF_TIME", "reason": f"more than {case.minutes:g} min"}
    if done.returncode:
        return {"outcome": "ERROR", "reason": done.stderr.strip().rpartition("\n")[2]}
    return json.loads(done.stdout.strip().rpartition("\n")[2])


def _judge(part, case, found, seconds):
    outcome, reason = found["outcome"], found.get("reason", "")
    what = f"{case}: {reason}"
    if outcome == "ERROR":
        part.fail(case.study, "no named outcome", what)
        return
    if outcome == "CONVERGED":
        wanted = case.g is None or abs(found["g"] / case.g - 1.0) < 0.02
        if not (found["good"] and wanted and found["residual"] < 1e-6):
            part.fail(case.study, "wrongly marked good", f"{case}: {found}")
            return
    part.count(case.study, outcome.lower().replace("_", " "))
    if outcome == "CONVERGED":
        told = f"B = {found['load']:.5g}, |J - 2 F_h|/J = {found['mismatch']:.1e}"
    elif outcome == "OUTSIDE_EVIDENCE":
        told = f"outside evidence, |J - 2 F_h|/J = {found['mismatch']:.1e}"
    else:
        told = f"{outcome.lower().replace('_', ' ')}: {reason}"
    part.notes.append(f"{case}: {told} ({seconds:.0f} s)")

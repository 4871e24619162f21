"""What is installed: versions of the library and its data, optional packages, a self-test."""

from __future__ import annotations

import hashlib
import json
import re
import sys
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass
from functools import partial
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from surrogate.basics.files import model_file, models_folder
from surrogate.basics.records import table
from surrogate.errors import InputError, WirecutError
from surrogate.version import __version__

__all__ = ["Check", "check_installation", "doctor_record", "doctor_text", "version_text"]

OK, ABSENT, FAILED = "ok", "absent", "failed"

PACKAGES = (
    ("matplotlib", "matplotlib", "plot", "figures"),
    ("contourpy", "contourpy", "plot", "boundaries of fitted models"),
    ("numba", "numba", "fast", "compiled loops"),
    ("pint", "pint", "units", "quantities with units"),
    ("argcomplete", "argcomplete", "complete", "tab completion"),
    ("pandas", "pandas", "tables", "tables"),
    ("xarray", "xarray", "tables", "labelled data sets"),
    ("skfem", "scikit-fem", "train", "finite elements"),
    ("sklearn", "scikit-learn", "train", "fitting of models"),
    ("h5py", "h5py", "train", "campaign data"),
    ("pypardiso", "pypardiso", "pardiso", "linear solver PARDISO"),
    ("mumps", "python-mumps", "mumps", "linear solver MUMPS"),
    ("distributed", "distributed", "cluster", "campaigns on a cluster"),
)
"""Module, distribution, extra and use of every optional package."""

_SCHEMA = re.compile(rb'schema"?\s*[=:]\s*"([\w-]+)"')
_HEAD = 4096


@dataclass(frozen=True)
class Check:
    """One thing that was looked at.

    Parameters
    ----------
    subject : str
        What it is about.
    outcome : str
        "ok", "absent" for an optional package that is not there, or "failed".
    detail : str
        What was found, or what to do.
    """

    subject: str
    outcome: str
    detail: str


def version_text() -> str:
    """Return the versions of the library and of each shipped file: its schema and SHA-256.

    Examples
    --------
    >>> version_text().splitlines()[0] == f"wirecut {__version__}"
    True
    """
    rows = [
        (f"  {path.name}", _schema(path) or "-", f"sha256 {_checksum(path)[:12]}")
        for path in _shipped()
    ]
    return f"wirecut {__version__}\n{table(('shipped file', 'schema', 'content'), rows)}"


def check_installation() -> list[Check]:
    """Return what was found: versions, checksums, optional packages, and a self-test.

    Examples
    --------
    >>> {check.outcome for check in check_installation()} <= {"ok", "absent"}
    True
    """
    found = [
        Check("wirecut", OK, __version__),
        Check("Python", OK, ".".join(map(str, sys.version_info[:3]))),
        Check("numpy", OK, np.__version__),
    ]
    found += [_guarded(f"file {path.name}", partial(_look, path)) for path in _shipped()]
    found += [_package(*package) for package in PACKAGES]
    found += [_guarded(name, test) for name, test in _SELF_TESTS.items()]
    return found


def doctor_record() -> dict[str, Any]:
    """Return the checks and the time they took [s]."""
    start = time.perf_counter()
    checks = check_installation()
    return {
        "healthy": all(check.outcome != FAILED for check in checks),
        "seconds": round(time.perf_counter() - start, 3),
        "checks": [asdict(check) for check in checks],
    }


def doctor_text(record: dict[str, Any]) -> str:
    """Return what `doctor_record` says, for people."""
    rows = [(one["subject"], one["outcome"], one["detail"]) for one in record["checks"]]
    failed = sum(one["outcome"] == FAILED for one in record["checks"])
    verdict = (
        "Everything that is installed works."
        if record["healthy"]
        else f"{failed} of {len(rows)} checks failed; install wirecut again."
    )
    return f"{table(('checked', 'outcome', 'detail'), rows)}\n\n{verdict}"


def _shipped() -> list[Path]:
    """Return the shipped files of data, without what only describes them."""
    return sorted(
        path
        for path in Path(models_folder()).iterdir()
        if path.is_file() and path.suffix not in (".md", ".sha256")
    )


def _checksum(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def _schema(path: Path) -> str:
    """Return the schema that a text file names; other files say theirs when they are read."""
    with path.open("rb") as stream:
        found = _SCHEMA.search(stream.read(_HEAD))
    return found[1].decode() if found else ""


def _look(path: Path) -> str:
    """Return what a shipped file is, after having looked whether it is whole."""
    beside = path.with_name(path.name + ".sha256")
    if beside.is_file():
        if beside.read_text(encoding="utf-8").split()[:1] != [_checksum(path)]:
            raise InputError("does not match its checksum; install wirecut again")
        return "matches its checksum"
    if path.suffix == ".json":
        json.loads(path.read_text(encoding="utf-8"))
    return f"{_schema(path) or 'readable'}, sha256 {_checksum(path)[:12]}"


def _package(module: str, distribution: str, extra: str, use: str) -> Check:
    if find_spec(module) is None:
        return Check(distribution, ABSENT, f"for {use}: pip install 'wirecut[{extra}]'")
    try:
        return Check(distribution, OK, f"{version(distribution)}, for {use}")
    except PackageNotFoundError:
        return Check(distribution, OK, f"of unknown version, for {use}")


def _guarded(subject: str, look: Callable[[], str]) -> Check:
    try:
        return Check(subject, OK, look())
    except (WirecutError, OSError, ValueError, ArithmeticError) as error:
        return Check(subject, FAILED, " ".join(str(error).split()))


def _expect(name: str, found: float, expected: float, tolerance: float = 1e-12) -> None:
    if not abs(found - expected) <= tolerance * abs(expected):
        raise ArithmeticError(f"{name} is {found!r} instead of {expected!r}")


def _test_closed_forms() -> str:
    from surrogate import Scene, cutting_force

    scene = Scene(685.0, 1.6, 0.25e-3, 0.1, 7750.0)
    force = cutting_force(scene, "eq13").total
    _expect("Eq. (13)", float(force), 1.1 * 1.6 + 4.0 * (0.1 * 685.0 + 7750.0) * 0.25e-3)
    many = cutting_force(Scene(685.0, 1.6, np.full(3, 0.25e-3), 0.1, 7750.0), "eq13").total
    _expect("Eq. (13) of an array", float(np.max(many)), float(force), 0.0)
    return f"F_ss/T = {force:.4f} N/m"


def _test_identification() -> str:
    from surrogate import identify, read_measurements

    cuts = read_measurements(model_file("paam-wire-cutting.csv"))
    fit = identify(cuts.wire_radius, cuts.force, 685.0, model="eq13")
    _expect("Gamma_o", fit.toughness, 1.6, 1e-9)
    _expect("tau_w", fit.wear_strength, 7750.0, 1e-9)
    return f"Gamma_o = {fit.toughness:.4f} J/m2, tau_w = {fit.wear_strength:.1f} Pa"


def _test_maps() -> str:
    from surrogate import regime_map

    made = regime_map("R_w/l_e", "R_w/l_w", ((0.1, 10.0), (0.01, 1.0)), {"xi": 0.1}, nodes=11)
    line = next(one.lines[0] for one in made.boundaries if one.kind == "equal-terms")
    _expect("the transition", float(line[0, 1]), 1.1 / 4.0)
    return f"transition at R_w/l_w = {line[0, 1]:.4f}"


def _test_models() -> str:
    from surrogate import Scene, cutting_force, models

    scene = Scene(685.0, 1.6, 0.25e-3, 0.1, 7750.0, 2.0)
    names = [model.name for model in models() if model.available]
    for name in names:
        force = cutting_force(scene, model=name)
        parts = force.cleavage + force.friction + force.wear
        _expect(f"the sum of the parts of {name}", float(parts), float(force.total), 0.0)
    if "gp" in names:
        chosen, process = (cutting_force(scene, name, law="projected") for name in ("auto", "gp"))
        bound = 2.0 * float(chosen.fit_error or 0.0)
        _expect(f"the force by {chosen.model}", float(chosen.total), float(process.total), bound)
    return ", ".join(names)


_SELF_TESTS = {
    "self-test: closed forms": _test_closed_forms,
    "self-test: identification": _test_identification,
    "self-test: maps": _test_maps,
    "self-test: force models": _test_models,
}

"""Which software made a result."""

from __future__ import annotations

import functools
import os
import platform
import subprocess
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from surrogate import __version__

__all__ = ["software"]

_PACKAGES = ("numpy", "scipy", "scikit-fem", "numba", "pypardiso", "mkl")


@functools.cache
def software() -> dict[str, str]:
    """Return versions of this code and of what it computes with, and the platform.

    Returns
    -------
    dict of str to str
        ``commit`` is the git commit of the code, with "-dirty" after changes; it is left out where
        there is none, as packages that are not installed are.

    Examples
    --------
    >>> sorted(software())[-3:]
    ['scikit-fem', 'scipy', 'wirecut']
    """
    found = {"wirecut": __version__, "commit": _commit()}
    found["python"] = platform.python_version()
    found["platform"] = f"{platform.system()} {platform.machine()}"
    for package in _PACKAGES:
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            continue
    return {name: value for name, value in found.items() if value}


def _commit() -> str:
    folder = Path(__file__).resolve().parents[2]
    if not (folder / ".git").exists():
        return ""
    command = ["git", "describe", "--always", "--dirty", "--abbrev=12", "--exclude=*"]
    environment = {**os.environ, "GIT_OPTIONAL_LOCKS": "0"}
    try:
        done = subprocess.run(
            command, cwd=folder, env=environment, capture_output=True, text=True, check=True
        )
    except (OSError, subprocess.CalledProcessError):
        return ""
    return done.stdout.strip()

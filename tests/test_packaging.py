"""The shipped files are found from a wheel, an editable install and a bare checkout alike."""

import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import numpy as np
import pytest

import surrogate

ROOT = Path(__file__).resolve().parent.parent
PROBE = """
import surrogate
from surrogate import identify, read_measurements
from surrogate.basics.files import model_file
cuts = read_measurements(model_file("paam-wire-cutting.csv"))
print(surrogate.__file__)
print(model_file("paam-wire-cutting.csv"))
print(identify(cuts.wire_radius, cuts.force, 685.0, model="eq13").toughness)
"""


@pytest.fixture(scope="module")
def checkout(tmp_path_factory):
    """The files that a clone has, away from this one."""
    folder = tmp_path_factory.mktemp("checkout") / "wirecut"
    ignored = shutil.ignore_patterns(".*", "__pycache__", "build", "dist", "output")
    shutil.copytree(ROOT, folder, ignore=ignored)
    return folder


def build(hook, checkout, folder):
    """Build with the project's own backend and no network; return the wheel."""
    script = f"import hatchling.build as b; print(b.{hook}({str(folder)!r}))"
    done = subprocess.run(
        [sys.executable, "-c", script], cwd=checkout, capture_output=True, text=True, check=True
    )
    return folder / done.stdout.split()[-1]


def probe(setup, folder):
    """Run the probe in a fresh process that has numpy but not this checkout; return its answer."""
    numpy_home = str(Path(np.__file__).parent.parent)
    program = f"import sys; sys.path.append({numpy_home!r})\n{setup}\n{PROBE}"
    environment = {key: os.environ[key] for key in os.environ if not key.startswith("PYTHON")}
    done = subprocess.run(
        [sys.executable, "-I", "-S", "-c", program],
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    module, file, toughness = done.stdout.splitlines()
    assert float(toughness) == pytest.approx(1.6)
    return Path(module), Path(file)


def test_wheel(checkout, tmp_path):
    pytest.importorskip("hatchling")
    wheel = build("build_wheel", checkout, tmp_path)
    assert wheel.name.startswith(f"wirecut-{surrogate.__version__}-py3-")
    site = tmp_path / "site"
    with zipfile.ZipFile(wheel) as archive:
        names = set(archive.namelist())
        archive.extractall(site)
    assert {"surrogate/py.typed", "surrogate/models/paam-material.json"} <= names
    page = ROOT / "surrogate" / "explorer" / "page"
    assert {f"surrogate/explorer/page/{part.name}" for part in page.iterdir()} <= names
    assert not [name for name in names if name.startswith(("tests", "models", "scripts"))]
    assert not [name for name in names if name.endswith(".h5")]
    shipped = {file.name for file in (checkout / "models").iterdir() if ".h5" not in file.name}
    assert {f"surrogate/models/{name}" for name in shipped} <= names
    assert wheel.stat().st_size < 1_100_000  # code and 0.2 MB of models; the data sets have 5 MB
    module, file = probe(f"sys.path.insert(0, {str(site)!r})", tmp_path)
    assert module.is_relative_to(site)
    assert file == site / "surrogate" / "models" / "paam-wire-cutting.csv"


def test_editable_install(checkout, tmp_path):
    pytest.importorskip("hatchling")
    wheel = build("build_editable", checkout, tmp_path)
    site = tmp_path / "site"
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(site)
    module, file = probe(f"import site; site.addsitedir({str(site)!r})", tmp_path)
    assert module.is_relative_to(checkout)
    assert file == checkout / "models" / "paam-wire-cutting.csv"


def test_bare_checkout(checkout, tmp_path):
    module, file = probe(f"sys.path.insert(0, {str(checkout)!r})", tmp_path)
    assert module.is_relative_to(checkout)
    assert file == checkout / "models" / "paam-wire-cutting.csv"

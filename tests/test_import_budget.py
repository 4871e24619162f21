"""`import surrogate` loads numpy and the standard library, and only the part in use."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

import surrogate

LOADED_BY_IMPORT = """
import sys
import numpy
before = set(sys.modules)
import surrogate
print(*sorted(set(sys.modules) - before))
"""


def loaded(code):
    command = [sys.executable, "-W", "error", "-c", code]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.split()


def test_nothing_but_the_standard_library_and_numpy_is_loaded():
    packages = {module.partition(".")[0] for module in loaded(LOADED_BY_IMPORT)}
    assert packages - set(sys.stdlib_module_names) <= {"surrogate", "numpy"}


def test_what_is_not_asked_for_is_not_loaded():
    modules = set(loaded(LOADED_BY_IMPORT))
    heavy = {"numpy.ma", "argparse", "json", "csv", "importlib.metadata", "asyncio", "unittest"}
    assert not modules & heavy
    ours = {name for name in modules if name.startswith("surrogate.")}
    assert ours == {"surrogate.errors", "surrogate.version"}


FORCE = """
import sys
from surrogate import Scene, cutting_force
cutting_force(Scene(685.0, 1.6, 0.25e-3, 0.1, 7750.0), {model!r})
print(*sys.modules)
"""


def test_a_force_loads_what_it_needs():
    by_formula, by_default = (set(loaded(FORCE.format(model=m))) for m in ("eq13", "auto"))
    assert not by_formula & {
        "json",
        "surrogate.contact.shipped",
        "surrogate.coupling.amplification",
    }
    assert "surrogate.contact.table" in by_default
    unused = {"contact.process", "choosing.common_choice", "choosing.catalogue", "contact.compiled"}
    assert not by_default & {f"surrogate.{name}" for name in unused}


def test_every_public_name_is_there():
    for name in surrogate.__all__:
        assert getattr(surrogate, name) is not None
    assert set(surrogate.__all__) <= set(dir(surrogate))
    assert not hasattr(surrogate, "no_such_name")


@pytest.mark.parametrize(
    ("file", "pattern"), [("CITATION.cff", r"^version: (.+)$"), ("CHANGELOG.md", r"^## (\S+)")]
)
def test_the_version_is_the_one_cited_and_the_latest_in_the_changelog(file, pattern):
    text = (Path(__file__).parent.parent / file).read_text(encoding="utf-8")
    stated = re.search(pattern, text, re.MULTILINE)
    assert stated
    assert surrogate.__version__ == stated[1]

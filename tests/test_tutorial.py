"""The tutorial runs from the start and prints what it says."""

import json
import re
import runpy
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
NOTEBOOK = ROOT / "docs" / "tutorial.ipynb"


def outputs(notebook):
    """Return what each cell prints, and which kinds of pictures it shows."""
    shown = []
    for cell in notebook["cells"]:
        for one in cell.get("outputs", ()):
            assert one["output_type"] != "error"
            text = one.get("text", "")
            shown.append("".join(text) or sorted(one["data"]))
    return shown


@pytest.mark.filterwarnings("ignore")  # those of the kernel's own machinery
def test_the_tutorial_prints_what_it_says(tmp_path):
    nbformat = pytest.importorskip("nbformat")
    pytest.importorskip("nbclient")
    pytest.importorskip("ipykernel")
    pytest.importorskip("matplotlib")
    script = runpy.run_path(str(ROOT / "scripts" / "refresh-tutorial"))
    notebook = script["run"](nbformat.read(NOTEBOOK, as_version=4), tmp_path)
    assert outputs(notebook) == outputs(json.loads(NOTEBOOK.read_text(encoding="utf-8")))


def test_the_tutorial_ends_with_the_truth_inside_its_intervals():
    shown = "".join(
        one for one in outputs(json.loads(NOTEBOOK.read_text("utf-8"))) if isinstance(one, str)
    )
    assert re.search(r"Gamma_o from .* J/m2: True", shown)
    assert re.search(r"tau_w from .* kPa: True", shown)
    assert "/tmp" not in shown

"""The costs of the models: measured by a script, complete, and what "auto" goes by."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

import surrogate.choosing.costs
from surrogate import InputError, models
from surrogate.choosing.by_name import FITTED_NAMES, force_model
from surrogate.choosing.candidates import available
from surrogate.choosing.costs import COSTS_FILE, COSTS_SCHEMA, by_cost, read_costs
from surrogate.contact.closed_forms import FORCE_MODELS

ROOT = Path(__file__).resolve().parent.parent


@pytest.fixture
def costs_file(tmp_path, monkeypatch):
    monkeypatch.setattr(surrogate.choosing.costs, "models_folder", lambda: tmp_path)
    return tmp_path / COSTS_FILE


def written(**bulk):
    each = {name: {"bulk_ns": value, "scalar_us": 1.0} for name, value in bulk.items()}
    return json.dumps({"schema": COSTS_SCHEMA, "models": each})


def test_every_model_has_its_measured_costs():
    costs = read_costs()
    assert set(costs) == {*FORCE_MODELS, *FITTED_NAMES}
    for model in models():
        assert (model.cost, model.latency) == tuple(costs[model.name].values())


def test_auto_tries_the_cheapest_first():
    order = [model.name for model in available()[0]]
    assert order[0] == "eq13"
    assert set(order[1:]) == set(FITTED_NAMES)
    costs = [read_costs()[name]["bulk_ns"] for name in order[1:]]
    assert costs == sorted(costs)


def test_models_without_a_cost_are_last(costs_file):
    known = [force_model(name) for name in ("eq9", "eq13", "low-toughness")]
    assert [model.name for model in by_cost(known)] == ["eq9", "eq13", "low-toughness"]
    costs_file.write_text(written(**{"low-toughness": 1.0, "eq13": 2.0}))
    surrogate.choosing.costs._read.cache_clear()
    assert [model.name for model in by_cost(known)] == ["low-toughness", "eq13", "eq9"]


@pytest.mark.parametrize(
    "text",
    ["{", "[]", '{"schema": "other", "models": {}}', written(eq13=0.0), written(eq13=float("nan"))],
)
def test_a_damaged_file_is_refused_in_words(costs_file, text):
    costs_file.write_text(text)
    with pytest.raises(InputError, match="must hold the measured costs of the models, but"):
        read_costs()


def test_the_script_writes_page_figure_and_costs(tmp_path):
    for module in ("h5py", "sklearn", "matplotlib"):
        pytest.importorskip(module)
    command = [sys.executable, ROOT / "scripts" / "bench-tradeoff", "--quick", "--out", tmp_path]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout.count(": met") + done.stdout.count(": missed") >= 5
    page = (tmp_path / "models.md").read_text(encoding="utf-8")
    for name in (*FORCE_MODELS, *FITTED_NAMES, "auto", "scikit-learn GPR", "finite elements"):
        assert f"| {name} |" in page
    for law, model in (("projected", "eq13"), ("coupled", "table"), ("auto", "auto")):
        assert f"| {law} | {model} |" in page
    assert "Forces beyond what is stated" in page
    assert (tmp_path / "law-tradeoff.png").stat().st_size > 5000
    loop = (tmp_path / "prepare.md").read_text(encoding="utf-8")
    for way in ("empty function", "prepared", "cutting_force, auto", "RectBivariateSpline"):
        assert f"| {way} |" in loop
    content = json.loads((tmp_path / COSTS_FILE).read_text(encoding="utf-8"))
    assert content["schema"] == COSTS_SCHEMA
    assert set(content["models"]) == {*FORCE_MODELS, *FITTED_NAMES}
    assert all(
        (tmp_path / f"tradeoff{ending}").stat().st_size > 5000 for ending in (".svg", ".png")
    )


def test_the_script_of_the_runtime_writes_its_table(tmp_path):
    out = tmp_path / "prepare.md"
    command = [sys.executable, ROOT / "scripts" / "bench-runtime", "--quick", "--out", out]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    page = out.read_text(encoding="utf-8")
    assert page.count("\n| ") > 20
    for words in ("first force of a process", "prepared force of the radius, coupled", "which cho"):
        assert f"| {words}" in page or words in page
    assert "| 8 ns |" in page
    page = (ROOT / "docs" / "prepare.md").read_text(encoding="utf-8")
    for part in ("the calls", "the loop"):
        assert page.count(f"<!-- {part}: begin -->") == page.count(f"<!-- {part}: end -->") == 1

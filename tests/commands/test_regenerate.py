"""The command: every step once, what is refused, and whether solved rows come out again."""

import json
import os
import re
import shlex
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from fake_engine import record, run, solve_path

from fe_training import regenerate
from fe_training.campaign import check as checking
from fe_training.campaign import run as running
from fe_training.campaign.check import check_rows
from fe_training.campaign.dataset import load_campaign, write_campaign
from fe_training.campaign.design_file import read_design
from fe_training.campaign.store import Store
from fe_training.campaign.workers import Workers
from fe_training.regenerate import main
from fe_training.solver.record import Outcome, Record
from surrogate.basics.files import model_file
from surrogate.cli.main import main as wirecut

ROOT = Path(__file__).resolve().parents[2]
NO_MODEL = 4

#: Two configurations on one path; meshes as coarse as the engine endures.
TINY = """\
schema = "wirecut-campaign-1"
alpha = [9]
path_from = 0.7

[g]
lowest = 0.8
highest = 1.2
count = 2

[g.denser]
alpha = [2, 9]
touch = [1.6, 100]
peak = 2
width = 0.5

[levels.coarse]
sectors = 12
contact_spacing = 0.2
notch_radius = 0.02
outer_radius = 1e4

[levels.less-coarse]
sectors = 14
contact_spacing = 0.18
notch_radius = 0.02
outer_radius = 1e4
"""


@pytest.fixture
def at(tmp_path):
    """The options that keep everything in the test's folder."""
    return ["--store", str(tmp_path / "store"), "--out", str(tmp_path / "models")]


@pytest.fixture
def made_up(monkeypatch, small_file):
    """Put the made-up engine and the small design in the place of the real ones."""

    def run_campaign(*arguments, **options):
        options.setdefault("solve", solve_path)
        return run_for_real(*arguments, **options)

    run_for_real = running.run_campaign
    monkeypatch.setattr(running, "run_campaign", run_campaign)
    monkeypatch.setattr(regenerate, "model_file", lambda name: small_file)
    return small_file


def test_quick_takes_every_step_with_the_real_engine(tmp_path, at, capsys, monkeypatch):
    tiny = tmp_path / "tiny.toml"
    tiny.write_text(TINY)
    monkeypatch.setattr(regenerate, "model_file", lambda name: tiny)
    assert main(["--quick", *at]) == NO_MODEL
    out = capsys.readouterr().out
    assert [line[:3] for line in out.splitlines() if "/4 " in line[:4]] == [
        "1/4", "2/4", "3/4", "4/4",
    ]  # fmt: skip
    data = load_campaign(tmp_path / "models" / "campaign.h5")
    assert len(data.rows) == 4
    assert data.rows["energy_release_rate"] == pytest.approx(data.rows["target"], rel=1e-3)
    assert np.all(data.points["normal_load_error"] < 0.02)
    assert np.all((data.points["arc"] > 0.5) & (data.points["arc"] < 2.0))


def test_the_chain_and_its_rerun(made_up, at, tmp_path, capsys):
    assert main(at) == NO_MODEL
    out, err = capsys.readouterr()
    assert "24 of 24 configurations to solve" in out
    assert "24/24 rows 100%" in err
    assert "12 of 12 points" in out
    assert re.search(
        r"(?s)3/4 fit\n.*\n    no model was made, as the models must be fitted to .*", out
    )
    assert not (tmp_path / "models" / "surrogates.npz").exists()
    first = load_campaign(tmp_path / "models" / "campaign.h5")
    assert main(at) == NO_MODEL
    out, _ = capsys.readouterr()
    assert "0 of 24 configurations to solve" in out
    again = load_campaign(tmp_path / "models" / "campaign.h5")
    for name, values in first.rows.columns.items():
        assert np.array_equal(values, again.rows[name], equal_nan=values.dtype.kind == "f"), name


def test_quick_keeps_away_from_the_shipped_files(made_up, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["--quick"]) == NO_MODEL
    made = {str(p.relative_to(tmp_path)) for p in tmp_path.rglob("campaign.h5*")}
    assert made == {f"output/campaign-quick/models/campaign.h5{end}" for end in ("", ".sha256")}


def test_only_a_part(made_up, at, capsys):
    assert main([*at, "--only", "alpha=5", "--only", "level=coarse"]) == NO_MODEL
    assert "6 of 6 configurations to solve" in capsys.readouterr().out
    assert main([*at, "--only", "alpha=2", "--only", "alpha=5", "--dry-run"]) == 0
    assert "18 configurations to solve, 6 finished" in capsys.readouterr().out


def test_dry_run_solves_and_writes_nothing(made_up, at, tmp_path, capsys):
    assert main([*at, "--dry-run", "--jobs", "2"]) == 0
    out = capsys.readouterr().out
    assert "24 configurations to solve, 0 finished" in out
    assert re.search(r"coarse, alpha = 2: 6, [\d.]+ min", out)
    assert re.search(r"about [\d.]+ (min|h) on one process\nabout [\d.]+ (min|h) on 2", out)
    assert not (tmp_path / "store").exists()
    assert not (tmp_path / "models").exists()


def test_the_data_set_of_a_part_without_solving(made_up, at, tmp_path, capsys):
    main([*at, "--only", "alpha=5"])
    capsys.readouterr()
    assert main([*at, "--no-solve"]) == NO_MODEL
    out = capsys.readouterr().out
    assert "1/4" not in out
    assert "12 rows" in out
    assert "6 of 12 points" in out


def test_the_full_design_is_the_shipped_one(at, capsys):
    assert main([*at, "--dry-run"]) == 0
    full = read_design(model_file("campaign.toml"))
    assert f"{len(full.configurations())} configurations to solve" in capsys.readouterr().out


BAD = [
    "--jobs 0",
    "--jobs many",
    "--check 0",
    "--backend dask",
    "--scheduler tcp://127.0.0.1:1",
    "--backend cloud",
    "--quick --design a.toml",
    "--design no-such.toml",
    "--dry-run --no-solve",
    "--only beta=2",
    "--only alpha=3",
    "--only alpha=two",
    "--only alpha",
    "--no-solve",
    "solve",
]


@pytest.mark.parametrize("arguments", BAD)
def test_bad_input_is_exit_code_2_and_one_line(arguments, at, capsys):
    assert main([*shlex.split(arguments), *at]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert re.fullmatch(r"regen-surrogate: [^\n]+\n", err), err


def test_another_design_is_refused_unless_adopted(made_up, at, tmp_path, capsys):
    main(at)
    other = tmp_path / "other.toml"
    other.write_text(made_up.read_text().replace("alpha = [2, 5]", "alpha = [2, 5, 9]", 1))
    capsys.readouterr()
    assert main([*at, "--design", str(other)]) == 2
    assert "--adopt" in capsys.readouterr().err
    assert main([*at, "--design", str(other), "--adopt"]) == NO_MODEL
    assert "12 of 36 configurations to solve" in capsys.readouterr().out


def test_check_compares_within_error_bars(made_up, at, tmp_path, capsys, monkeypatch):
    main(at)
    capsys.readouterr()

    def checked(*arguments, solve=solve_path):
        return check_rows(*arguments, solve=solve)

    monkeypatch.setattr(checking, "check_rows", checked)
    assert main([*at, "--check", "3"]) == 0
    assert "3 of 3 rows agree" in capsys.readouterr().out

    for change in ({"vertical_force": 9.0}, {"slip_arc": 9.0}):

        def another(alpha, targets, settings, report, change=change):
            for g in targets:
                report(record(alpha, g, settings.sectors, **change))

        def differently(*arguments, solve=another):
            return check_rows(*arguments, solve=solve)

        monkeypatch.setattr(checking, "check_rows", differently)
        assert main([*at, "--check", "3"]) == 1
        out = capsys.readouterr().out
        assert out.count("DIFFERS") == 3
        assert "0 of 3 rows agree" in out


def test_a_sample_is_never_larger_than_the_data(small, tmp_path):
    data = load_campaign(
        write_campaign(tmp_path / "campaign.h5", small, run(small, tmp_path / "store"))
    )
    checks = check_rows(data, 100, 0, Workers(), tmp_path / "again", solve=solve_path)
    assert len(checks) == 12
    assert all(check.agrees for check in checks)


@pytest.mark.parametrize("program", [["-m", "fe_training.regenerate"], ["scripts/regen-surrogate"]])
def test_help_teaches_with_examples_that_the_parser_takes(program):
    command = [sys.executable, *program, "--help"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    examples = re.findall(r"^  regen-surrogate (.*)$", done.stdout, re.MULTILINE)
    assert len(examples) == 11
    for example in examples:
        regenerate._parser().parse_args(shlex.split(example))


def test_help_is_there_before_the_engine_is_loaded():
    code = (
        "import sys\n"
        "from fe_training.regenerate import main\n"
        "try: main(['--help'])\n"
        "except SystemExit: pass\n"
        "sys.exit('scipy' in sys.modules)"
    )
    subprocess.run([sys.executable, "-c", code], capture_output=True, check=True)


def test_the_names_of_the_extra_are_those_that_are_imported():
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    train = re.search(r"^train = \[(.*?)^\]", text, re.DOTALL | re.MULTILINE)[1]
    other = {"scikit-fem": "skfem", "scikit-learn": "sklearn"}
    names = {other.get(name, name) for name in re.findall(r'"([\w-]+)>', train)}
    assert names >= regenerate._EXTRA


@pytest.mark.slow
@pytest.mark.skipif(os.name != "posix", reason="SIGKILL")
def test_the_real_engine_gives_the_same_bits_after_a_kill(tmp_path):
    """The states of a path do not depend on which values are left to find on it."""
    tiny = tmp_path / "tiny.toml"
    tiny.write_text(TINY.replace("count = 2", "count = 4"))
    stores = [tmp_path / "whole", tmp_path / "killed"]

    def start(store):
        options = ["--design", tiny, "--store", store, "--out", tmp_path / "models", "--jobs", "2"]
        command = [sys.executable, "scripts/regen-surrogate", *map(str, options)]
        return subprocess.Popen(command, cwd=ROOT, stderr=subprocess.DEVNULL)

    no_model = 4  # so few rows make none
    assert start(stores[0]).wait() == no_model
    first = start(stores[1])
    while len(list((stores[1] / "rows").glob("*.row"))) < 2:
        time.sleep(0.05)
    first.kill()
    first.wait()
    assert start(stores[1]).wait() == no_model
    rows = [Store(store).rows(read_design(tiny).configurations()) for store in stores]
    assert len(rows[0]) == len(rows[1]) == 8
    for a, b in zip(*rows, strict=True):
        for name in a.record.__dataclass_fields__:
            if name != "wall_time":
                x, y = getattr(a.record, name), getattr(b.record, name)
                assert np.array_equal(x, y, equal_nan=isinstance(x, float | np.ndarray)), (
                    str(a.configuration),
                    name,
                )


@pytest.mark.slow
def test_the_quick_campaign_makes_models_that_give_forces(tmp_path, capsys):
    options = ["--store", str(tmp_path / "store"), "--out", str(tmp_path)]
    assert main(["--quick", *options]) == 0
    points = load_campaign(tmp_path / "campaign.h5").points
    assert points["use"].sum() >= 30
    command = ["force", "--shear-modulus", "1kPa", "--toughness", "1J/m2", "--wire-radius", "1mm"]
    command += ["--wear-strength", "1kPa", "--model", "table", "--json"]
    capsys.readouterr()
    forces = []
    for models in ([], ["--models", str(tmp_path)]):
        assert wirecut([*command, *models]) == 0
        forces.append(json.loads(capsys.readouterr().out)["wires"][0]["total"])
    assert forces[0] != forces[1]
    assert forces[1] == pytest.approx(forces[0], rel=0.02)


REPORT = [sys.executable, "-W", "error", "scripts/report-campaign"]


def test_the_report_is_written_between_its_marks(small, tmp_path):
    rows = run(small, tmp_path / "store")
    rows[3] = replace(rows[3], record=Record(2.0, Outcome.STALLED, reason="no more"))
    rows[20] = replace(rows[20], record=record(5.0, 1.0, truncation_error=0.02))
    write_campaign(tmp_path / "campaign.h5", small, rows)
    marks = "<!-- campaign report: begin -->\nold\n<!-- campaign report: end -->"
    readme = tmp_path / "README.md"
    readme.write_text(f"before\n{marks}\nafter\n")
    options = [
        "--data",
        tmp_path / "campaign.h5",
        "--readme",
        readme,
        "--figures",
        tmp_path / "fig",
    ]
    for _ in range(2):  # the second run replaces what the first wrote
        subprocess.run([*REPORT, *map(str, options)], cwd=ROOT, check=True)
    text = readme.read_text()
    assert text.startswith("before\n<!--")
    assert text.endswith("-->\nafter\n")
    assert "old" not in text
    assert text.count("points (alpha, g) are within all bounds") == 1
    assert f"| coarse | 1 | {Outcome.STALLED.meaning} |" in text
    assert "| B is truncated by the finite body | 5 | 1 |" in text
    for picture in re.findall(r"\]\((fig/.*?\.png)\)", text):
        assert (tmp_path / picture).read_bytes().startswith(b"\x89PNG")
    assert len(list((tmp_path / "fig").iterdir())) == 2


def test_a_readme_without_marks_is_refused(small, tmp_path):
    write_campaign(tmp_path / "campaign.h5", small, run(small, tmp_path / "store"))
    options = ["--data", str(tmp_path / "campaign.h5"), "--readme", str(tmp_path / "none.md")]
    done = subprocess.run(
        [*REPORT, *options], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert done.returncode == 2
    assert re.fullmatch(r"report-campaign: .* lacks the lines [^\n]*\n", done.stderr)


def test_the_shipped_readme_has_the_marks():
    text = (ROOT / "models" / "README.md").read_text(encoding="utf-8")
    assert text.count("<!-- campaign report: begin -->") == 1
    assert text.count("<!-- campaign report: end -->") == 1


def test_extending_and_restricting_need_one_command(made_up, at, tmp_path, capsys):
    main(at)
    shipped = str(tmp_path / "models" / "campaign.h5")
    for alpha, taken, left in (("[2, 5, 12]", 24, 12), ("[5]", 12, 0)):
        mine = tmp_path / f"mine-{taken}.toml"
        mine.write_text(made_up.read_text().replace("alpha = [2, 5]", f"alpha = {alpha}", 1))
        there = [
            "--store",
            str(tmp_path / f"store-{taken}"),
            "--out",
            str(tmp_path / f"out-{taken}"),
        ]
        capsys.readouterr()
        assert main(["--design", str(mine), "--continue-from", shipped, *there]) == NO_MODEL
        out = capsys.readouterr().out
        assert f"{taken} rows taken from {shipped}" in out
        assert f"{left} of {taken + left} configurations to solve" in out


def test_rows_of_other_meshes_are_refused_and_nothing_is_left_behind(made_up, at, tmp_path, capsys):
    main(at)
    mine = tmp_path / "mine.toml"
    mine.write_text(made_up.read_text().replace("sectors = 12", "sectors = 10", 1))
    there = ["--store", str(tmp_path / "other"), "--out", str(tmp_path / "other-models")]
    capsys.readouterr()
    shipped = str(tmp_path / "models" / "campaign.h5")
    assert main(["--design", str(mine), "--continue-from", shipped, *there]) == 2
    assert "the mesh of the level 'coarse' differs" in capsys.readouterr().err
    assert not (tmp_path / "other").exists()
    assert not (tmp_path / "other-models").exists()


def test_going_on_from_a_data_set_whose_store_is_gone(made_up, at, tmp_path, capsys):
    main([*at, "--only", "alpha=5"])
    capsys.readouterr()
    elsewhere = ["--store", str(tmp_path / "new"), "--out", str(tmp_path / "new-models")]
    half = str(tmp_path / "models" / "campaign.h5")
    assert main([*elsewhere, "--continue-from", half]) == NO_MODEL
    out = capsys.readouterr().out
    assert f"12 rows taken from {half}" in out
    assert "12 of 24 configurations to solve" in out
    assert "12 of 12 points" in out

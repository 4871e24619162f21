"""What is installed: versions, `wirecut doctor`, and completion by the shell."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from surrogate import __version__
from surrogate.basics.files import models_folder
from surrogate.cli.doctor import PACKAGES, check_installation, version_text
from surrogate.cli.main import main


@pytest.fixture
def copied_models(tmp_path, monkeypatch):
    """A copy of the shipped files that may be spoilt."""
    folder = tmp_path / "models"
    shutil.copytree(models_folder(), folder)
    monkeypatch.setattr("surrogate.cli.doctor.models_folder", lambda: folder)
    return folder


def outcomes():
    return {check.subject: check.outcome for check in check_installation()}


def test_the_version_names_every_shipped_file_with_its_content():
    lines = version_text().splitlines()
    assert lines[0] == f"wirecut {__version__}"
    names = {line.split()[0] for line in lines[2:]}
    shipped = {
        p.name for p in Path(models_folder()).iterdir() if p.suffix not in (".md", ".sha256")
    }
    assert names == shipped
    material = next(line for line in lines if "paam-material.json" in line)
    assert "wirecut-material-1" in material


def test_the_version_changes_with_the_content(copied_models):
    before = version_text()
    (copied_models / "paam-wire-cutting.csv").write_text("wire_radius_mm\n")
    assert version_text() != before


def test_a_sound_installation_is_healthy(capsys):
    assert main(["doctor", "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    assert record["healthy"]
    found = {check["subject"] for check in record["checks"]}
    assert {distribution for _, distribution, _, _ in PACKAGES} <= found
    assert sum(subject.startswith("self-test") for subject in found) == 4
    assert main(["doctor"]) == 0
    assert "Everything that is installed works." in capsys.readouterr().out


def test_a_damaged_file_is_found(copied_models, capsys):
    (copied_models / "fit.npz").write_bytes(b"numbers")
    (copied_models / "fit.npz.sha256").write_text(f"{'0' * 64}  fit.npz\n")
    (copied_models / "paam-material.json").write_text("{")
    found = outcomes()
    assert found["file fit.npz"] == "failed"
    assert found["file paam-material.json"] == "failed"
    assert found["file campaign.toml"] == "ok"
    assert main(["doctor"]) == 1
    assert "2 of" in capsys.readouterr().out


def test_a_wrong_number_is_found(monkeypatch):
    monkeypatch.setattr("surrogate.identify", lambda *a, **k: _Wrong())
    found = outcomes()
    assert found["self-test: identification"] == "failed"
    assert found["self-test: closed forms"] == "ok"


class _Wrong:
    toughness, wear_strength = float("nan"), 7750.0


def test_a_missing_package_is_named_with_its_extra(monkeypatch):
    monkeypatch.setattr("surrogate.cli.doctor.find_spec", lambda name: None)
    checks = {check.subject: check for check in check_installation()}
    assert checks["matplotlib"].outcome == "absent"
    assert "pip install 'wirecut[plot]'" in checks["matplotlib"].detail


@pytest.mark.parametrize(
    ("line", "answers"),
    [("wirecut ma", {"map"}), ("wirecut map --preset le", {"lengths"}), ("wirecut do", {"doctor"})],
)
def test_the_shell_completes(line, answers, tmp_path):
    pytest.importorskip("argcomplete")
    out = tmp_path / "answers"
    environment = {
        **os.environ,
        "_ARGCOMPLETE": "1",
        "_ARGCOMPLETE_IFS": "\n",
        "_ARGCOMPLETE_STDOUT_FILENAME": str(out),
        "COMP_LINE": line,
        "COMP_POINT": str(len(line)),
    }
    command = [sys.executable, "-m", "surrogate.cli.main"]
    subprocess.run(command, env=environment, check=True, capture_output=True)
    assert {answer.strip() for answer in out.read_text().split("\n")} == answers

"""`wirecut explore`: with what the page begins, and what is said of it."""

import json
import shutil
from pathlib import Path

import pytest

from surrogate.basics.files import model_file
from surrogate.cli.main import main
from surrogate.contact.shipped import FILE, VARIABLE, folder_in_use

CUTS, GEL = str(model_file("paam-wire-cutting.csv")), str(model_file("paam-material.json"))


def start_of(file):
    text = file.read_text(encoding="utf-8")
    data = text.partition('type="application/json">')[2].partition("</script>")[0]
    return json.loads(data)["start"]


def test_without_anything_it_begins_with_the_gel_of_the_paper(tmp_path, capsys):
    file = tmp_path / "explorer.html"
    assert main(["explore", "--out", str(file)]) == 0
    assert "Gamma_o = 1.6 J/m2, tau_w = 7.75 kPa" in capsys.readouterr().out
    assert start_of(file)["cuts"] == []


def test_cuts_and_a_material_are_identified(tmp_path, capsys):
    file = tmp_path / "explorer.html"
    # these wires can hardly tell toughness from wear, which is a warning
    assert main(["explore", "--material", GEL, "--cuts", CUTS, "--out", str(file), "--json"]) == 3
    record, start = json.loads(capsys.readouterr().out), start_of(file)
    identify = ["identify", CUTS, "--shear-modulus", "685Pa", "--model", "table", "--json"]
    main(identify)
    told = json.loads(capsys.readouterr().out)
    assert record["identified"] is True
    assert start["Gamma_o"] == record["toughness"] == pytest.approx(told["toughness"])
    assert start["tau_w"] == pytest.approx(told["wear_strength"])
    assert len(start["cuts"]) == 5
    assert main(["explore", "--material", GEL, "--cuts", CUTS, "--out", str(file)]) == 3
    assert "'wirecut identify' tells their intervals" in " ".join(capsys.readouterr().out.split())


def test_options_are_taken_before_the_material(tmp_path):
    file = tmp_path / "explorer.html"
    files = ["--material", GEL, "--cuts", CUTS, "--out", str(file)]
    solid = "--shear-modulus 2kPa --toughness 3J/m2 --wear-strength 0"
    command = ["explore", *files, *solid.split(), "--wire-radius", "0.1mm", "--law", "slip"]
    assert main(command) == 0
    start = start_of(file)
    assert (start["mu"], start["Gamma_o"], start["tau_w"], start["R_w"]) == (2e3, 3.0, 0.0, 1e-4)
    assert start["law"] == "slip"


def test_the_law_of_coupled_solutions_is_shown_if_the_models_have_it(tmp_path, monkeypatch, capsys):
    file = tmp_path / "explorer.html"
    light = "--stiffening-exponent 4 --friction-coefficient 0.004 --wear-strength 20Pa"
    command = ["explore", *light.split(), "--law", "coupled", "--out", str(file)]
    assert main(command) == 0
    assert start_of(file)["law"] == "coupled"
    for name in (FILE, f"{FILE}.sha256"):
        shutil.copy(Path(folder_in_use()) / name, tmp_path / name)
    monkeypatch.setenv(VARIABLE, str(tmp_path))
    capsys.readouterr()
    assert main(command) == 2
    assert "must have the file coupled.npz" in capsys.readouterr().err


def test_what_is_doubted_is_said(tmp_path, capsys):
    file = str(tmp_path / "explorer.html")
    assert main(["explore", "--wire-radius", "0.4m", "--out", file]) == 3
    assert "hardly that of a soft solid's cut" in " ".join(capsys.readouterr().out.split())


def test_what_is_read_is_not_overwritten(capsys):
    assert main(["explore", "--cuts", CUTS, "--out", CUTS]) == 2
    assert "would overwrite" in capsys.readouterr().err
    assert main(["explore", "--thickness", "2cm", "--out", "x.html"]) == 2
    assert "--cuts" in capsys.readouterr().err

"""`wirecut identify`: tables of every kind and folders of records, and what it says of them."""

import json

import numpy as np
import pytest

from surrogate.cli.main import main

WIRE = ["--wire-radius", "1mm", "--toughness", "2J/m2"]
LINE = ["--shear-modulus", "30kPa", "--model", "eq13"]


@pytest.fixture
def run(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)

    def run(*arguments):
        code = main([*arguments, *LINE])
        out, err = capsys.readouterr()
        return code, out, err

    return run


def write_records(folder, thickness=0.02):
    """Write records of wires whose force is that of Eq. (13) for 2 J/m^2 and 15 kPa."""
    folder.mkdir()
    x = np.linspace(0.0, 30.0, 601)  # mm
    rng = np.random.default_rng(1)
    for diameter in (0.1, 0.2, 0.4, 0.8):
        for trial in (1, 2):
            steady = thickness * (2.0 + 4.0 * 15e3 * 0.5e-3 * diameter)
            shape = 1.0 - np.exp(-x) + 0.5 * x * np.exp(1.0 - x)
            force = steady * (shape + 0.01 * rng.standard_normal(x.size))
            rows = [f"{a:.4f};{-b:.6f}".replace(".", ",") for a, b in zip(x, force, strict=True)]
            text = "\r\n".join(["Traversenweg;Standardkraft", "mm;N", *rows])
            name = folder / f"wire_{diameter}mm_{trial}.csv"
            name.write_text(text, encoding="utf-16")


def test_a_folder_of_records(run, tmp_path):
    write_records(tmp_path / "cuts")
    name = ["--name", "wire_{diameter}mm_{trial}"]
    code, out, err = run("identify", "cuts/", *name, "--thickness", "20mm", "--json")
    assert code == 0
    record = json.loads(out)
    assert record["file"] == "cuts"
    assert record["toughness"] == pytest.approx(2.0, rel=0.01)
    assert record["wear_strength"] == pytest.approx(15e3, rel=0.01)
    assert "8 of 8 records have a steady force" in err
    code, _, err = run("identify", "cuts/", *name)
    assert code == 2
    assert "give --thickness" in err
    code, _, err = run("identify", "cuts/", "--thickness", "20mm")
    assert code == 2
    assert "--name" in err


def test_the_two_steps_give_what_one_gives(run, tmp_path, capsys):
    write_records(tmp_path / "cuts")
    options = ["--name", "wire_{diameter}mm_{trial}", "--thickness", "20mm"]
    once = json.loads(run("identify", "cuts", *options, "--json")[1])
    assert main(["steady", "cuts", *options, "--out", "cuts.csv"]) == 0
    capsys.readouterr()
    twice = json.loads(run("identify", "cuts.csv", "--json")[1])
    assert twice["toughness"] == pytest.approx(once["toughness"], rel=1e-9)
    # the table has twelve digits of each force, of which a residual keeps eight
    assert twice["wear_strength_std"] == pytest.approx(once["wear_strength_std"], rel=1e-7)


def test_forces_in_newtons_and_what_was_not_used(run, tmp_path):
    table = "d [mm];F [mN];remark\n0,2;94;a\n0,4;156;b\n0,6;;c\n0,8;274;d\n"
    (tmp_path / "cuts.csv").write_bytes(table.encode("cp1252"))
    code, out, err = run("identify", "cuts.csv", "--thickness", "20mm", "--json")
    assert code == 0
    assert json.loads(out)["notes"] == [line[6:] for line in err.splitlines()]
    assert "note: cuts.csv: not used: column 3 (remark)" in err
    assert "note: cuts.csv, line 4, column 2 (F [mN]) is empty: skipped" in err
    code, _, err = run("identify", "cuts.csv")
    assert code == 2
    assert "--thickness 20mm" in err


def test_what_is_for_records_is_no_option_of_a_table(run, tmp_path):
    (tmp_path / "cuts.csv").write_text("d_mm,F/T_N_per_m\n0.2,4.7\n0.4,7.8\n0.8,13.7\n")
    code, _, err = run("identify", "cuts.csv", "--from", "3mm", "--name", "x")
    assert code == 2
    assert "--name, --from: for a folder of records, but cuts.csv is a table" in err


def test_a_number_that_is_open_is_decided_by_the_option(run, tmp_path):
    (tmp_path / "cuts.csv").write_text("d_mm;F/T_N_per_m\n1,250;2,850\n1,500;3,110\n1,750;3,350\n")
    code, _, err = run("identify", "cuts.csv")
    assert (code, "--decimal" in err) == (2, True)
    assert run("identify", "cuts.csv", "--decimal", ",")[0] == 0


def test_units_after_a_blank_and_negative_quantities(run):
    code, _, err = run("force", "--shear-modulus", "685", "Pa", *WIRE)
    assert code == 2
    assert "a unit goes with its number, as in 685Pa" in err
    wrong = ["--shear-modulus", "685 Pa", "--toughness", "-1.6J/m2", "--wire-radius", "1mm"]
    code, _, err = run("force", *wrong)
    assert code == 2
    assert "'-1.6J/m2' is negative" in err


@pytest.mark.parametrize("command", ["identify", "steady"])
@pytest.mark.parametrize("where", ["cuts", "."])
def test_no_record_in_a_folder_is_overwritten(run, tmp_path, monkeypatch, command, where, capsys):
    write_records(tmp_path / "cuts")
    monkeypatch.chdir(tmp_path / "cuts" if where == "." else tmp_path)
    before = {file.name: file.read_bytes() for file in (tmp_path / "cuts").iterdir()}
    out = "--csv" if command == "identify" else "--out"
    given = ["--name", "wire_{diameter}mm_{trial}", "--thickness", "20mm"]
    target = f"{where}/wire_0.1mm_1.csv"
    last = LINE if command == "identify" else []
    assert main([command, where, *given, out, target, *last]) == 2
    assert "would overwrite what is read" in capsys.readouterr().err
    assert {file.name: file.read_bytes() for file in (tmp_path / "cuts").iterdir()} == before
    for _ in range(2):  # an earlier table of ours may be replaced, and is no record
        assert main([command, where, *given, out, f"{where}/table.csv", *last]) == 0


def test_named_samples_reach_the_fit(run, tmp_path):
    rows = [
        f"{sample},{d},{force + shift + more}"
        for sample, shift in (("gel A", -0.3), ("gel B", 0.3), ("gel C", 0.05))
        for d, force in ((0.2, 4.7), (0.4, 7.8), (0.8, 13.7))
        for more in (-0.02, 0.02)
    ]
    header = "sample,wire_diameter_mm,force_per_thickness_N_per_m\n"
    (tmp_path / "cuts.csv").write_text(header + "\n".join(rows) + "\n")
    code, out, _ = run("identify", "cuts.csv", "--json")
    assert code == 0
    assert json.loads(out)["contributions"]["sample"][0] > 0.05

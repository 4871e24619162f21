"""`wirecut steady`: from a folder of records to the table that `identify` reads."""

import json

import numpy as np
import pytest
from made_up_records import cut

from surrogate import read_measurements
from surrogate.cli.main import main

FORCES = {0.2: 0.08, 0.4: 0.14, 0.8: 0.23}
NAME = ["--thickness", "20mm", "--name", "wire_{diameter}mm_{trial}"]


def write(file, x, f):
    rows = [f"{1e3 * a:.4f},{b:.6f}" for a, b in zip(x, f, strict=True)]
    file.write_text("\n".join(["Extension (mm),Load (N)", *rows]) + "\n")


@pytest.fixture
def folder(tmp_path):
    folder = tmp_path / "cuts"
    folder.mkdir()
    for diameter, force in FORCES.items():
        for trial in (1, 2):
            x, f = cut(level=force, seed=trial)
            write(folder / f"wire_{diameter}mm_{trial}.csv", x, f)
    return folder


def test_a_folder_becomes_the_table_of_identify(folder, tmp_path, capsys):
    out = tmp_path / "cuts.csv"
    assert main(["steady", str(folder), *NAME, "--out", str(out)]) == 0
    printed = capsys.readouterr().out
    assert "standard deviation" in printed
    assert "displacement from 'Extension (mm)' in mm" in printed
    measurements = read_measurements(out)
    assert measurements.wire_radius.tolist() == [1e-4, 1e-4, 2e-4, 2e-4, 4e-4, 4e-4]
    expected = np.repeat(list(FORCES.values()), 2) / 0.02
    np.testing.assert_allclose(measurements.force, expected, rtol=0.05 / 6.0)
    assert measurements.force_std is None  # the error within a record is not that of a force


def test_what_is_not_steady_is_named_and_the_exit_code_is_3(folder, tmp_path, capsys):
    x = cut()[0]
    write(folder / "wire_0.6mm_1.csv", x, x)
    (folder / "wire_0.6mm_2.csv").write_text("no record\n")
    (folder / "notes.doc").write_text("x")
    out = folder / "table.csv"
    assert main(["steady", str(folder), *NAME, "--out", str(out)]) == 3
    printed = capsys.readouterr().out
    assert "2 of 8 records are not used" in printed
    assert "still rises" in printed
    assert "notes.doc" in printed
    table = out.read_text()
    assert table.count("# not steady") == 2
    assert len(read_measurements(out).force) == 6
    # again, with its own table in the folder
    assert main(["steady", str(folder), *NAME, "--out", str(out), "--json"]) == 3
    record = json.loads(capsys.readouterr().out)
    assert len(record["cuts"]) == 8
    assert len(record["not_steady"]) == 2


def test_range_and_tare(folder, capsys):
    file = str(folder / "wire_0.2mm_1.csv")
    options = ["--from", "10mm", "--to", "20mm", "--tare", "10mN", "--json"]
    assert main(["steady", file, *options]) == 0
    (row,) = json.loads(capsys.readouterr().out)["cuts"]
    assert (row["start"], row["end"], row["tare"]) == (0.01, 0.02, 0.01)
    assert row["mean"] == pytest.approx(0.07, rel=0.01)
    assert row["force_per_thickness"] is None


def test_the_table_of_wires(folder, tmp_path, capsys):
    wires = tmp_path / "wires.csv"
    wires.write_text("file,wire_diameter_mm,thickness_mm\nwire_0.2mm_1.csv,0.3,10\n")
    file = str(folder / "wire_0.2mm_1.csv")
    assert main(["steady", file, "--wires", str(wires), "--json"]) == 0
    (row,) = json.loads(capsys.readouterr().out)["cuts"]
    assert (row["wire_radius"], row["thickness"]) == (1.5e-4, 0.01)


@pytest.mark.parametrize(
    ("options", "reason"),
    [
        (["--out", "{file}"], "would overwrite what is read"),
        (["--out", "{folder}/a.pdf", "--plot", "{folder}/a.pdf"], "are one file"),
        (["--plot", "{folder}/a.doc"], "no picture's ending"),
        (["--out", "{folder}/a.csv"], "give --name"),
        (["--out", "{folder}/a.csv", *NAME[2:]], "give --thickness"),
        ([*NAME, "--wires", "x.csv"], "give one of them"),
        (["--name", "{{diameter}}"], "unit of length"),
        (["--columns", "a,b"], "name no force, or neither"),
    ],
)
def test_refused_before_anything_is_written(folder, options, reason, capsys):
    file = folder / "wire_0.2mm_1.csv"
    before = sorted(folder.iterdir()), file.read_bytes()
    filled = [
        text.format(file=file, folder=folder) if text not in NAME else text for text in options
    ]
    assert main(["steady", str(file), *filled]) == 2
    assert reason in capsys.readouterr().err
    assert (sorted(folder.iterdir()), file.read_bytes()) == before


def test_an_empty_folder_is_said(tmp_path, capsys):
    assert main(["steady", str(tmp_path)]) == 2
    assert "no record" in capsys.readouterr().err


def test_the_figure_has_every_record(folder, tmp_path, capsys):
    pytest.importorskip("matplotlib")
    picture = tmp_path / "steady.svg"
    write(folder / "wire_0.6mm_1.csv", *[cut()[0]] * 2)
    assert main(["steady", str(folder), *NAME, "--plot", str(picture)]) == 3
    text = picture.read_text()
    assert text.count("wire_0.") == 7
    assert text.count("not steady") == 1


def test_an_answer_that_should_not_be_used_has_the_exit_code_3(tmp_path, capsys):
    file = tmp_path / "cuts.csv"
    table = "wire_diameter_{},force_per_thickness_N_per_m\n0.1,2.9\n0.2,4.7\n0.4,7.8\n0.8,13.7\n"
    for unit, code in (("mm", 0), ("m", 3)):
        file.write_text(table.format(unit))
        assert main(["identify", str(file), "--shear-modulus", "685Pa"]) == code
    assert "likely mm given as m" in " ".join(capsys.readouterr().out.split())

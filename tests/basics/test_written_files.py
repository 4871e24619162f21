"""Files are written whole or not at all, and never over what is read or over each other."""

import os
from pathlib import Path

import pytest

from surrogate.basics.files import check_outputs, write_csv, written_whole
from surrogate.cli.main import main
from surrogate.errors import InputError

TABLE = "wire_radius_mm,force_per_thickness_N_per_m\n0.1,4.7\n0.2,7.9\n0.4,13.9\n0.5,17.2\n"


def test_what_goes_wrong_leaves_the_old_file_and_nothing_beside_it(tmp_path):
    file = tmp_path / "a.csv"
    file.write_text("old")
    with pytest.raises(ZeroDivisionError), written_whole(file) as name:
        Path(name).write_text("new" + str(Path(name).touch() or 1 / 0))
    assert file.read_text() == "old"
    with pytest.raises(InputError, match="No space left"), written_whole(file) as name:
        raise OSError(28, "No space left on device")
    assert os.listdir(tmp_path) == ["a.csv"]


def test_a_link_stays_a_link_and_permissions_stay(tmp_path):
    file, link = tmp_path / "a.csv", tmp_path / "b.csv"
    file.write_text("old")
    file.chmod(0o640)
    link.symlink_to(file)
    write_csv(link, {("x", "m"): [1.0]})
    assert link.is_symlink()
    assert file.read_text() == "x_m\n1.0\n"
    assert file.stat().st_mode & 0o777 == 0o640


def test_what_is_no_ordinary_file_is_written_directly():
    write_csv("/dev/null", {("x", "m"): [1.0]})
    assert not os.path.isfile("/dev/null")


@pytest.mark.parametrize("name", ["no/such/folder/a.csv", "nul\0byte"])
def test_what_cannot_be_written(tmp_path, name):
    with pytest.raises(InputError, match="cannot be written"):
        write_csv(f"{tmp_path}/{name}", {("x", "m"): [1.0]})


def test_one_file_by_two_names(tmp_path):
    (tmp_path / "a.csv").touch()
    os.link(tmp_path / "a.csv", tmp_path / "hard.csv")
    (tmp_path / "soft.csv").symlink_to(tmp_path / "a.csv")
    for other in ("hard.csv", "soft.csv", f"../{tmp_path.name}/a.csv"):
        with pytest.raises(InputError, match="would overwrite what is read"):
            check_outputs({"--csv": str(tmp_path / other)}, [tmp_path / "a.csv"])
    check_outputs({"--csv": str(tmp_path / "b.csv"), "--plot": None}, [tmp_path / "a.csv", None])


def test_identify_does_not_destroy_the_measurements(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "x.csv").write_text(TABLE)
    arguments = ["identify", "x.csv", "--shear-modulus", "30kPa", "--model", "eq13"]
    assert main([*arguments, "--csv", "./x.csv"]) == 2
    assert "--csv ./x.csv would overwrite what is read, x.csv" in capsys.readouterr().err
    assert (tmp_path / "x.csv").read_text() == TABLE
    assert main([*arguments, "--csv", "y.svg", "--plot", "y.svg"]) == 2
    assert "--plot y.svg and --csv y.svg are one file" in capsys.readouterr().err
    assert os.listdir(tmp_path) == ["x.csv"]


def test_map_does_not_lose_a_table(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    arguments = ["map", "--preset", "gel", "--csv", "a", "--boundaries-csv", "a"]
    assert main(arguments) == 2
    assert "--csv a and --boundaries-csv a are one file" in capsys.readouterr().err
    assert os.listdir(tmp_path) == []

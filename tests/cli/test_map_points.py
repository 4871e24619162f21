"""`wirecut map --points`: a lab's own cuts on a map, from their table or an earlier result."""

import json
import shlex

import numpy as np
import pytest

from surrogate import Scene, cutting_force
from surrogate.cli.main import main

RADII = np.array([0.05, 0.1, 0.2, 0.3, 0.4])


def forces(mu=30e3, gamma=2.0, tau=12e3, xi=0.0, model="table"):
    scene = Scene(mu, gamma, 1e-3 * RADII, xi, tau)
    return np.asarray(cutting_force(scene, model).total) * [1.02, 0.98, 1.01, 0.99, 1.01]


def write(file, force):
    cuts = zip(RADII, force, strict=True)
    lines = [f"{radius},{value:.4f},{0.03 * value:.4f}" for radius, value in cuts]
    header = "wire_radius_mm,force_per_thickness_N_per_m,force_std_N_per_m"
    file.write_text("\n".join([header, *lines]) + "\n")


@pytest.fixture
def lab(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write(tmp_path / "cuts.csv", forces())
    write(tmp_path / "falling.csv", forces()[::-1])
    properties = {"schema": "wirecut-material-1", "shear_modulus_kPa": 30}
    (tmp_path / "gel.json").write_text(json.dumps(properties))
    return tmp_path


@pytest.fixture
def run(lab, capsys):
    def run(command):
        code = main(shlex.split(command))
        out, err = capsys.readouterr()
        return code, out, err

    return run


def test_the_map_of_a_table_is_that_of_its_gel(run, lab):
    code, out, _ = run("map --points cuts.csv --material gel.json --nodes 21 --json")
    assert code == 0
    made = json.loads(out)
    fit = json.loads(run("identify cuts.csv --material gel.json --json")[1])
    assert made["model"] == fit["model"]
    assert made["fixed"]["wear_strength"] == fit["wear_strength"]
    assert made["fixed"]["shear_modulus"] == 30e3
    assert [row["x"] for row in made["points"]] == pytest.approx(1e-3 * RADII)
    assert {row["y"] for row in made["points"]} == {fit["toughness"]}
    assert {row["y_std"] for row in made["points"]} == {fit["toughness_std"]}
    assert [row["dominant"] for row in made["points"]] == [w["dominant"] for w in fit["wires"]]


def test_a_result_gives_the_map_that_its_table_gives(run, lab):
    options = "--shear-modulus 30+-1kPa --friction-coefficient 0.1 --friction-std 0.03"
    result = run(f"identify cuts.csv {options} --toughness-max 5J/m2 --json")[1]
    (lab / "result.json").write_text(result)
    made = json.loads(run("map --points result.json --nodes 21 --json")[1])
    fit = json.loads(result)
    assert made["points"][0]["y"] == pytest.approx(fit["toughness"], rel=1e-9)
    assert made["points"][0]["points"] == "cuts"
    assert made["fixed"]["friction_coefficient"] == 0.1
    # as PowerShell writes what it prints
    (lab / "utf16.json").write_bytes(result.encode("utf-16"))
    again = json.loads(run("map --points utf16.json --nodes 21 --json")[1])
    assert again["points"][0]["y"] == made["points"][0]["y"]


def test_the_points_are_in_the_picture_and_told(run, lab):
    pytest.importorskip("matplotlib")
    code, out, _ = run("map --points cuts.csv --fix mu=30kPa --nodes 31 --out map.svg")
    assert code == 0
    assert "\nPoints  wire_radius [m]  toughness [J/m^2]  dominant term\n" in out
    assert out.count("\ncuts ") == RADII.size
    assert ">cuts<" in (lab / "map.svg").read_text()


def test_the_model_and_law_that_are_named_hold_for_points_and_map(run, lab):
    (lab / "result.json").write_text(run("identify cuts.csv --material gel.json --json")[1])
    for options, model in (("--model eq13", "eq13"), ("--law slip", "table, law slip")):
        made = json.loads(run(f"map --points result.json {options} --nodes 11 --json")[1])
        assert made["model"] == model
        fit = json.loads(run(f"identify cuts.csv --material gel.json {options} --json")[1])
        assert made["points"][0]["y"] == pytest.approx(fit["toughness"], rel=1e-9)


def test_several_gels_share_a_map_of_groups(run, lab):
    write(lab / "soft.csv", forces(mu=10e3, tau=4e3))
    for name, modulus in (("cuts", "30kPa"), ("soft", "10kPa")):
        result = run(f"identify {name}.csv --shear-modulus {modulus} --json")[1]
        (lab / f"{name}.json").write_text(result)
    gels = "map --points cuts.json soft.json --nodes 21"
    made = json.loads(run(f"{gels} --json")[1])
    assert (made["x"]["name"], made["y"]["name"]) == ("R_w/l_e", "R_w/l_w")
    assert {row["points"] for row in made["points"]} == {"cuts", "soft"}
    code, _, err = run(f"{gels} --x R_w 10um 5mm --y Gamma_o 0.1 50")
    assert code == 2
    assert "soft must be of what the map is drawn for, but its shear modulus is 1e+04 Pa" in err
    (lab / "line.json").write_text(
        run("identify soft.csv --shear-modulus 10kPa --model eq13 --json")[1]
    )
    code, _, err = run("map --points cuts.json line.json")
    assert code == 2
    assert "cuts.json is of the model table and line.json of eq13; name by --model" in err


@pytest.mark.parametrize(
    ("command", "words"),
    [
        ("--points cuts.csv", "cuts.csv: the shear modulus is missing; give --material FILE or"),
        ("--points gel.json", "gel.json: is neither a table of cuts nor a result"),
        ("--points none.csv", "none.csv cannot be read"),
        ("--points .", ". is a folder; write the table of its records by 'wirecut steady"),
        ("--points cuts.csv --material gel.json --fix mu=20kPa", "20000 Pa by --fix; give it once"),
        ("--points cuts.csv --material gel.json --preset gel", "where the map fixes 685 Pa"),
        ("--points cuts.csv --material gel.json --fix tau_w=1kPa", "where the map fixes 1000 Pa"),
        ("--preset gel --material gel.json", "--material is for the table of --points"),
        ("--preset gel --thickness 20mm", "--thickness is for the table of --points"),
        ("--points falling.csv --fix mu=30kPa", "falling.csv: the cuts must be of an identif"),
        ("--points cuts.csv --fix mu=30kPa --x R_w 1mm 2mm --y Gamma_o 1 9", "outside"),
        ("--points cuts.csv --material gel.json --csv cuts.csv", "cuts.csv"),
    ],
)
def test_what_does_not_belong_is_refused_in_the_commands_words(command, words, run, lab):
    before = (lab / "cuts.csv").read_text()
    code, out, err = run(f"map {command} --nodes 11")
    assert (code, out) == (2, "")
    assert words in err
    assert err.count("\n") == 1
    assert (lab / "cuts.csv").read_text() == before


def test_a_result_without_what_it_rests_on_is_not_used(run, lab):
    record = json.loads(run("identify cuts.csv --material gel.json --json")[1])
    for wire in record["wires"]:
        del wire["force_std"]
    (lab / "old.json").write_text(json.dumps(record))
    code, _, err = run("map --points old.json")
    assert code == 2
    assert "old.json: is a result without all that it rests on; write it anew" in err


def test_a_result_of_the_other_law_gives_a_map_of_that_law(run, lab):
    result = run("identify cuts.csv --material gel.json --law slip --json")[1]
    (lab / "slip.json").write_text(result)
    made = json.loads(run("map --points slip.json --nodes 11 --json")[1])
    assert made["model"] == "table, law slip"
    assert made["points"][0]["y"] == pytest.approx(json.loads(result)["toughness"], rel=1e-9)
    designed = json.loads(run("design --result slip.json --cuts 3 --json")[1])
    assert (designed["law"], designed["model"]) == ("slip", "table")
    assert run("design --result slip.json --law slip --cuts 3")[0] == 0
    code, _, err = run("design --result slip.json --law coupled")
    assert code == 2
    assert "was identified by the law 'slip', whose wear strength is not that of another" in err


@pytest.mark.parametrize("std", [0.3, 0.6])
def test_another_material_that_fits_is_left_out_of_a_map_that_is_not_its_own(run, lab, std):
    (lab / "two.csv").write_text(
        "wire_radius_mm,force_per_thickness_N_per_m,force_std_N_per_m\n"
        f"0.1,4.7,{std}\n0.2,7.9,{std}\n0.4,13.9,{std}\n0.5,17.2,{std}\n"
    )
    fit = json.loads(run("identify two.csv --shear-modulus 685Pa --json")[1])
    others = [mode["wear_strength"] for mode in fit["modes"][1:] if mode["admitted"]]
    assert others
    code, out, _ = run("map --points two.csv --fix mu=685Pa --nodes 21 --json")
    made = json.loads(out)
    assert code == 0
    assert {row["y"] for row in made["points"]} >= {fit["toughness"]}
    left = [note for note in made["notes"] if note.startswith("another material that fits is left")]
    shown = {row["points"] for row in made["points"]}
    assert len(shown) == 1  # also where the errors of the wear strengths overlap
    assert len(left) == len(others)

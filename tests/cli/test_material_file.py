"""What was identified, in a file of the material, and the force under its law."""

import json
import shlex

import pytest

from surrogate import (
    InputError,
    Material,
    OtherLawWarning,
    Scene,
    cutting_force,
    identify,
    read_material,
    read_measurements,
)
from surrogate.cli.main import main

TISSUE = "--shear-modulus 10+-0.5kPa --friction-coefficient 0.02 --stiffening-exponent 5"
ROWS = "0.2,6.05\n0.4,6.28\n0.6,6.63\n0.8,6.86\n1,7.21\n"


@pytest.fixture
def run(capsys):
    def run(command):
        code = main(shlex.split(command))
        printed = capsys.readouterr()
        return code, printed.out, printed.err

    return run


@pytest.fixture
def cuts(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "cuts.csv").write_text("wire_radius_mm,force_per_thickness_N_per_m\n" + ROWS)
    return tmp_path / "cuts.csv"


@pytest.mark.parametrize("law", ["projected", "slip", "coupled"])
def test_a_force_of_the_file_is_by_the_law_of_the_file(run, cuts, law):
    code, _, _ = run(f"identify cuts.csv {TISSUE} --law {law} --write-material gel.json --json")
    assert code == 0
    material = read_material("gel.json")
    known = read_measurements(cuts)
    fit = identify(
        known.wire_radius,
        known.force,
        10e3,
        friction_coefficient=0.02,
        stiffening_exponent=5.0,
        shear_modulus_std=500.0,
        law=law,
    )
    assert (material.law, material.toughness, material.wear_strength) == (
        law,
        fit.toughness,
        fit.wear_strength,
    )
    assert (material.shear_modulus_std, material.toughness_std) == (500.0, fit.toughness_std)
    expected = cutting_force(fit.scene(3e-4))
    assert cutting_force(Scene.of_material(material, 3e-4)).total == expected.total
    record = json.loads(run("force --material gel.json --wire-radius 0.3mm --json")[1])
    assert record["wires"][0]["total"] == expected.total
    assert record["notes"] == []
    assert "any_law" not in record
    designed = json.loads(run("design --material gel.json --relative-error 5% --cuts 3 --json")[1])
    assert designed["law"] == law


def test_another_law_is_said_with_how_far_it_moves_the_force(run, cuts):
    assert run(f"identify cuts.csv {TISSUE} --law slip --write-material gel.json")[0] == 0
    for command in ("force", "regime"):
        code, out, err = run(f"{command} --material gel.json --wire-radius 0.3mm --law projected")
        assert (code, err) == (0, "")
        words = " ".join(out.split())
        assert "were identified under the law 'slip', but the force is taken under 'projec" in words
        assert "give --law slip" in words
    with pytest.warns(OtherLawWarning, match="identified under the law 'slip'"):
        cutting_force(Scene.of_material(read_material("gel.json"), 3e-4), law="projected")
    own = run("force --material gel.json --wire-radius 0.3mm --toughness 3J/m2 --law projected")[1]
    assert "identified under" not in own  # another toughness is of no law in particular


def test_a_file_is_what_it_was_written_from(tmp_path):
    whole = Material(685.0, 30.0, 2.6, 0.2, 6973.0, 500.0, 0.0, 2.0, 1.6, 0.1, 0.0, 5.0, "coupled")
    (tmp_path / "gel.json").write_text(whole.to_json("a gel", "made up"))
    assert read_material(tmp_path / "gel.json") == whole
    (tmp_path / "bare.json").write_text(Material().to_json())
    assert read_material(tmp_path / "bare.json") == Material()
    with pytest.raises(InputError, match="the material has no shear_modulus"):
        Scene.of_material(Material(toughness=1.0), 1e-4)
    with pytest.raises(InputError, match="the material has no toughness"):
        Scene.of_material(Material(685.0), 1e-4)


@pytest.mark.parametrize("law", ['"auto"', "3", "null", '["slip"]', '"slip", "law": "slip"'])
def test_a_law_that_is_none_is_refused(law, tmp_path):
    (tmp_path / "gel.json").write_text(f'{{"schema": "wirecut-material-1", "law": {law}}}')
    with pytest.raises(InputError, match=r"key \(law\)"):
        read_material(tmp_path / "gel.json")


def test_what_cannot_be_written_or_is_missing_is_said(run, cuts):
    code, _, err = run(f"identify cuts.csv cuts.csv {TISSUE} --write-material gel.json")
    assert code == 2
    assert "--write-material is for one gel" in err
    code, _, err = run(f"identify cuts.csv {TISSUE} --write-material cuts.csv")
    assert code == 2
    code, _, err = run("force --wire-radius 0.3mm --toughness 3J/m2")
    assert (code, err) == (
        2,
        "wirecut: --shear-modulus is missing; give it, or --material FILE with it.\n",
    )
    (cuts.parent / "falling.csv").write_text(
        "wire_radius_mm,force_per_thickness_N_per_m\n0.1,9\n0.2,8\n0.4,7\n"
    )
    code, _, err = run(
        "identify falling.csv --shear-modulus 10kPa --model eq13 --write-material gel.json"
    )
    assert code == 2
    assert "is not written, as an estimate is negative" in err

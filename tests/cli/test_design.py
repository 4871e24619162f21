"""The command `wirecut design`."""

import json
import shlex

import pytest

from surrogate.cli.main import main

GUESS = "--shear-modulus 30kPa --toughness 1.6J/m2 --wear-strength 12kPa"


@pytest.fixture
def run(capsys):
    def run(options):
        code = main(shlex.split(f"design {options}"))
        printed = capsys.readouterr()
        return code, printed.out, printed.err

    return run


def test_wires_and_what_they_promise_are_printed(run):
    code, printed, _ = run(f"{GUESS} --relative-error 5% --thickness 20mm")
    assert code == 0
    assert printed.startswith("Cut 4 with 0.02 mm, ")
    assert "they promise Gamma_o = 1.6" in printed.splitlines()[0]
    assert printed.splitlines()[1].endswith("breaks at [N]  F_ss [N]")
    record = json.loads(run(f"{GUESS} --relative-error 5% --json")[1], parse_constant=pytest.fail)
    assert sum(wire["cuts"] for wire in record["wires"]) == 8
    assert record["relative_force_std"] == 0.05


def test_an_earlier_result_brings_material_model_and_scatter(run, tmp_path, capsys):
    cuts, result = tmp_path / "cuts.csv", tmp_path / "gel.json"
    rows = "0.1,4.7\n0.2,8.1\n0.4,13.7\n0.5,17.2\n"
    cuts.write_text("wire_radius_mm,force_per_thickness_N_per_m\n" + rows)
    assert main(shlex.split(f"identify {cuts} --shear-modulus 30kPa --json")) == 0
    result.write_text(capsys.readouterr().out)
    earlier = json.loads(result.read_text())
    record = json.loads(run(f"--result {result} --cuts 6 --json")[1])
    assert record["model"] == earlier["model"]
    assert record["toughness"] == earlier["toughness"]
    shares = [wire["residual"] / wire["force"] for wire in earlier["wires"]]
    assert record["relative_force_std"] == pytest.approx((sum(s**2 for s in shares) / 2) ** 0.5)
    assert len(record["others"]) >= 2
    printed = run(f"--result {result} --sizes 0.1mm 0.3mm 1mm --between 0.09mm 1mm")[1]
    assert "If Gamma_o = " in printed


TISSUE = "--shear-modulus 10kPa --friction-coefficient 0.02 --stiffening-exponent 5"


def test_a_result_of_the_coupled_law_is_taken_as_it_is(run, tmp_path, capsys):
    cuts, result = tmp_path / "cuts.csv", tmp_path / "gel.json"
    rows = "0.2,6.05\n0.4,6.28\n0.6,6.63\n0.8,6.86\n1,7.21\n"
    cuts.write_text("wire_radius_mm,force_per_thickness_N_per_m\n" + rows)
    assert main(shlex.split(f"identify {cuts} {TISSUE} --json")) == 0
    result.write_text(capsys.readouterr().out)
    earlier = json.loads(result.read_text())
    assert earlier["law"] == "coupled"
    code, printed, _ = run(f"--result {result} --cuts 3 --json")
    record = json.loads(printed)
    assert (code, record["law"], record["model"]) == (0, "coupled", "table")
    assert record["toughness"] == earlier["toughness"]
    assert any("no coupled solution is near" in words for words in record["left_out"])
    guess = f"{TISSUE} --toughness 5J/m2 --wear-strength 800Pa --relative-error 5% --cuts 3"
    assert "model table, law coupled" in run(f"{guess} --law coupled")[1]


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (GUESS, "give --relative-error"),
        ("--shear-modulus 30kPa --relative-error 5%", "give --toughness"),
        (f"{GUESS} --relative-error 5% --between 3mm 4mm", "no wire is from 3 to 4 mm"),
        (f"{GUESS} --relative-error 5% --cuts 2", "from 3 to 100"),
        (f"{GUESS} --relative-error 5% --force-std 1N/m", "exactly one"),
        ("--result nowhere.json", "cannot be read"),
        (f"--result {__file__} --relative-error 5%", "is no result"),
        (f"{GUESS} --result {__file__}", "leave out one of them"),
    ],
)
def test_bad_options_end_in_one_line(run, options, words):
    code, _, error = run(options)
    assert code == 2
    assert error.count("\n") == 1
    assert words in error

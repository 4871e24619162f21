"""The command `wirecut map`: what it prints, what it writes, and what it refuses."""

import json
import shlex

import pytest

from surrogate import regime_map
from surrogate.cli.main import main
from surrogate.cli.map import PRESETS


def run(command):
    return main(["map", *shlex.split(command)])


@pytest.mark.parametrize("preset", PRESETS)
def test_presets_are_maps_with_several_regimes(preset, capsys):
    assert run(f"--preset {preset} --nodes 31 --json") == 0
    record = json.loads(capsys.readouterr().out)
    assert len(record["regimes"]) >= 3
    assert sum(record["regimes"].values()) == pytest.approx(1.0)
    one = PRESETS[preset]
    made = regime_map(one.x, one.y, one.ranges, one.fixed, nodes=31)
    assert [b["equation"] for b in record["boundaries"]] == [b.equation for b in made.boundaries]
    assert all(b["exact"] for b in record["boundaries"])


def test_axes_with_units_and_what_is_fixed(capsys):
    options = "--x R_w 10um 1mm --y tau_w 1kPa 0.1MPa --fix mu=685Pa Gamma_o=1.6J/m2 --nodes 5"
    assert run(f"{options} --json") == 0
    record = json.loads(capsys.readouterr().out)
    assert record["x"] == {
        "name": "wire_radius", "unit": "m", "low": 1e-5, "high": 1e-3, "scale": "log",
    }  # fmt: skip
    assert (record["y"]["low"], record["y"]["high"]) == (1e3, 1e5)
    assert record["fixed"] == {"shear_modulus": 685.0, "toughness": 1.6}
    assert run(f"{options} --linear x") == 0
    printed = capsys.readouterr().out
    assert "Map over wire_radius 1e-05 to 0.001 m and wear_strength 1000 to 100000 Pa" in printed
    assert "(1 + xi) Gamma_o = 4 tau_w R_w" in printed
    assert printed.isascii()
    assert run("--preset friction --fix alpha=3 --nodes 5") == 0
    assert "\nfixed: tau_w/mu = 0.1, stiffening_exponent = 3\n" in capsys.readouterr().out


def test_a_preset_can_be_changed(capsys):
    assert run("--preset lengths --fix xi=0 --y R_w/l_w 0.1 1 --model friction-free --json") == 0
    record = json.loads(capsys.readouterr().out)
    assert record["fixed"] == {"friction_coefficient": 0.0}
    assert record["y"]["low"] == 0.1
    assert record["model"] == "friction-free"


@pytest.mark.parametrize("ending", ["png", "pdf", "svg"])
def test_pictures(ending, capsys, tmp_path):
    pytest.importorskip("matplotlib")
    out = tmp_path / f"map.{ending}"
    options = "--nodes 31 --limits high-toughness --width double"
    assert run(f"--preset gel --out {out} {options}") == 0
    assert out.stat().st_size > 5000
    assert f"Written: {out}" in capsys.readouterr().out


def test_tables(capsys, tmp_path):
    nodes, lines = tmp_path / "map.csv", tmp_path / "lines.csv"
    assert run(f"--preset gel --nodes 4 --csv {nodes} --boundaries-csv {lines}") == 0
    assert sum(not line.startswith("#") for line in nodes.read_text().splitlines()) == 17
    assert "equal-terms" in lines.read_text()
    capsys.readouterr()


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ("", "the map's x is missing; give --x or --preset"),
        ("--preset moon", "invalid choice: 'moon'"),
        ("--x sharpness 1 2 --y xi 1 2", "choose one of shear_modulus"),
        ("--x R_w 1um 1kPa --y xi 1 2", "'1kPa' is not a length"),
        ("--x R_w 1um 1mm --y xi 1 2", "lacks"),
        ("--preset gel --fix mu", "'mu' fixes nothing"),
        ("--preset gel --fix mu=1mm", "'1mm' is not a stress"),
        ("--preset gel --fix R_w=1mm", "is an axis and fixed"),
        ("--preset gel --model eq99", "eq99"),
        ("--preset gel --nodes 1", "nodes must be a whole number"),
        ("--preset gel --out map.doc", "choose .png, .pdf or .svg"),
        ("--preset gel --nodes 5 --csv missing/map.csv", "cannot be written"),
    ],
)
def test_bad_input_ends_in_one_line_and_code_2(options, words, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert run(options) == 2
    streams = capsys.readouterr()
    assert streams.out == ""
    assert streams.err.startswith("wirecut: ")
    assert streams.err.count("\n") == 1
    assert words in streams.err


def test_a_map_on_which_the_model_holds_nowhere_is_doubted(capsys):
    ranges = "--x R_w 0.1um 1um --y tau_w 1kPa 2kPa --fix mu=685Pa Gamma_o=1.6J/m2 --nodes 11"
    assert main(["map", *ranges.split(), "--model", "table"]) == 3
    said = " ".join(capsys.readouterr().out.split())
    assert "The model holds on 0.0 % of the map; elsewhere it is continued" in said
    assert "holds nowhere on the map" in said

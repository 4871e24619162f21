"""The command line as its users meet it: its own examples, its numbers, its complaints."""

import io
import json
import os
import re
import shlex
import subprocess
import sys
from dataclasses import asdict

import numpy as np
import pytest

from surrogate import FORCE_MODELS, Scene, __version__, classify, cutting_force, models
from surrogate.basics.files import model_file
from surrogate.choosing.by_name import FITTED_NAMES
from surrogate.cli.main import main

COMMANDS = ["force", "identify", "regime", "models"]
SCENE = "--shear-modulus 685Pa --toughness 1.6J/m2 --wear-strength 7.75kPa"


def run(command):
    return main(shlex.split(command))


def help_text(command, capsys):
    with pytest.raises(SystemExit) as stop:
        run(f"{command} --help")
    assert stop.value.code == 0
    return capsys.readouterr().out


@pytest.mark.parametrize("command", ["", *COMMANDS])
def test_examples_of_the_help_work(command, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    text = help_text(command, capsys)
    if table := re.search(r"for instance (\S+):\n\n((?:  \S+\n)+)", text):
        for name in (table[1], "soft.csv", "stiff.csv"):
            (tmp_path / name).write_text(table[2].replace("  ", ""))
    (tmp_path / "cuts").mkdir()
    for diameter, force in ((0.2, 0.094), (0.4, 0.158), (0.8, 0.276)):
        rows = [f"{0.1 * i:.1f},{force * min(i / 50, 1) + 0.001 * (i % 3):.4f}" for i in range(200)]
        text_of = "\n".join(["displacement_mm,force_N", *rows])
        (tmp_path / "cuts" / f"wire_{diameter}mm_1.csv").write_text(text_of)
    examples = re.findall(r"^  wirecut (.+)$", text.replace("\\\n", ""), flags=re.MULTILINE)
    assert examples
    for example in examples:
        assert run(example) == 0
        assert capsys.readouterr().out


def test_example_prints_the_papers_numbers(capsys):
    assert run("identify --example --model eq13 --verbose") == 0
    printed = capsys.readouterr().out
    for line in (
        r"^Gamma_o = 1\.6 \(interval unknown\) J/m2, tau_w = 7\.75 \(interval unknown\) kPa",
        r"Warning: the forces of the example are read from the line that the paper publishes",
        "5 forces, read from the published line, from paam-wire-cutting.csv",
        r"cleavage toughness Gamma_o +1\.6 +J/m2",
        r"wear strength tau_w +7\.75 +kPa",
        r"l_w = Gamma_o/tau_w +206\.5 +no scatter",
        r"l_f = Gamma_o/W_f +229\.5 +unknown",
        r"l_f = Gamma/W_f +372\.9 +39",
        r"l_e = Gamma_o/mu +2336",
        r"l_e = Gamma/mu +3796",
        r"Eq\. \(13\), both terms equal +51\.61",
        r"l_w/4 +51\.61",
        r"l_f/4 with Gamma +93\.22",
        r"0\.125 +18\.69 +5\.475 +0 +wear +indentation",
        r"Warning: 5 of 5 wires cut at g",
    ):
        assert re.search(line, printed), line


def test_forces_on_a_line_that_nobody_explains_are_not_to_be_used(capsys, tmp_path):
    copy = tmp_path / "cuts.csv"
    copy.write_bytes(model_file("paam-wire-cutting.csv").read_bytes())
    assert run(f"identify {copy} --shear-modulus 685Pa --model eq13") == 3
    printed = capsys.readouterr().out
    assert printed.startswith("Do not use the numbers below: the forces lie on the line to the")


def test_json_of_identify_holds_the_same_in_si_units(capsys):
    assert run("identify --example --model eq13 --json") == 0
    record = json.loads(capsys.readouterr().out)
    assert record["toughness"] == pytest.approx(1.6)
    assert record["wear_strength"] == pytest.approx(7750.0)
    radii, lengths = record["transition_radii"], record["lengths"]
    assert radii["fracto_cohesive"]["value"] == pytest.approx(93.2e-6, rel=1e-3)
    assert radii["eq13"]["value"] == pytest.approx(51.6e-6, rel=1e-3)
    l_f = lengths["fracto_cohesive_pure_shear"]
    relative = (0.2 / 2.6) ** 2 + (0.5 / 6.973) ** 2  # squares of the published standard errors
    assert l_f["std"] == pytest.approx(l_f["value"] * relative**0.5)
    assert lengths["fracto_cohesive"]["std"] is None  # the forces have no scatter
    assert record["toughness_std"] is record["wear_strength_interval"] is None
    assert [wire["wire_radius"] for wire in record["wires"]][-1] == 0.47e-3


def test_json_knows_no_nan(capsys, tmp_path):
    file = tmp_path / "two.csv"
    file.write_text("wire_radius_mm,force_per_thickness_N_per_m\n0.1,2\n0.2,3\n")
    assert run(f"identify {file} --shear-modulus 685 --model eq13 --json") == 0
    record = json.loads(capsys.readouterr().out, parse_constant=pytest.fail)
    assert record["toughness"] == pytest.approx(1.0)
    assert record["toughness_std"] is None


def test_force_and_regime_of_several_wires(capsys):
    assert run(f"force {SCENE} --wire-radius 0.2mm 0.4mm --model eq13 --json") == 0
    wires = json.loads(capsys.readouterr().out)["wires"]
    assert [wire["total"] for wire in wires] == pytest.approx([1.6 + 6.2, 1.6 + 12.4])
    assert [wire["relative_error"] for wire in wires] == [None, None]  # nobody knows one
    assert run(f"regime {SCENE} --wire-diameter 50um 0.5mm --model eq13 --json") == 0
    wires = json.loads(capsys.readouterr().out)["wires"]
    assert [wire["wire_radius"] for wire in wires] == [25e-6, 0.25e-3]
    assert [wire["dominant"] for wire in wires] == ["toughness-and-friction", "wear"]


def test_forces_and_regimes_are_by_default_those_of_the_library(capsys):
    wires = f"{SCENE} --wire-radius 25um 0.2mm 2mm"
    scene = Scene(685.0, 1.6, [25e-6, 0.2e-3, 2e-3], wear_strength=7750.0)
    assert run(f"force {wires} --json") == 0
    record, force = json.loads(capsys.readouterr().out), cutting_force(scene)
    assert record["model"] == force.model
    assert [wire["total"] for wire in record["wires"]] == force.total.tolist()
    assert [wire["relative_error"] for wire in record["wires"]] == [None] * 3  # that of the law
    assert np.isnan(force.relative_error).all()
    assert [wire["law"] for wire in record["wires"]] == ["projected"] * 3
    assert record["notes"] == list(force.doubts)
    assert record["warnings"] == []
    assert run(f"regime {wires} --json") == 0
    record = json.loads(capsys.readouterr().out)
    assert record["model"] == "auto"
    assert [wire["dominant"] for wire in record["wires"]] == classify(scene).dominant.tolist()
    assert run(f"force {wires} --rtol 0.5 --law projected") == 0
    assert re.search(r"\d %  +unknown  +yes\n", capsys.readouterr().out)


@pytest.mark.parametrize("name", [*FORCE_MODELS, *FITTED_NAMES, "auto"])
def test_every_model_can_be_named(name, capsys):
    wire = f"{SCENE} --wire-radius 0.2mm --model {name}"
    assert run(f"force {wire}") == 0
    assert run(f"regime {wire}") == 0
    assert run(f"force {SCENE} --wire-radius 1um --extrapolate --model {name}") == 0
    assert f"Model {name}" in capsys.readouterr().out or name == "auto"


def test_the_models_are_listed_with_domain_error_and_cost(capsys):
    assert run("models --json") == 0
    listed = json.loads(capsys.readouterr().out)["models"]
    assert listed == [asdict(model) for model in models()]
    assert run("models") == 0
    printed = capsys.readouterr().out
    for model in models():
        line = next(each for each in printed.splitlines() if each.startswith(model.name))
        assert model.domain in line
        assert ("%" in line) == (model.error is not None)


@pytest.mark.parametrize("law", ["projected", "slip", "coupled"])
def test_the_models_of_a_law_are_listed_with_their_errors_beside_coupled_solutions(law, capsys):
    assert run(f"models --law {law} --json") == 0
    listed = json.loads(capsys.readouterr().out)["models"]
    assert listed == [asdict(model) for model in models(law)]
    assert {model["law"] for model in listed} == {law}
    assert ({model["name"] for model in listed} == {*FITTED_NAMES}) == (law != "projected")
    assert run(f"models --law {law}") == 0
    printed = capsys.readouterr().out
    assert f"Law {law}: how far F_ss may be off" in " ".join(printed.split())
    assert "models/coupled-card.md" in " ".join(printed.split())


def test_options_replace_the_properties_of_a_file(capsys):
    material = model_file("paam-material.json")
    table = model_file("paam-wire-cutting.csv")
    command = f"identify {table} --material {material} --shear-modulus 1kPa --json"
    assert run(command) == 0
    record = json.loads(capsys.readouterr().out)
    assert (record["shear_modulus"], record["shear_modulus_std"]) == (1000.0, None)
    assert (record["work_of_fracture"], record["work_of_fracture_std"]) == (6973.0, 500.0)


def test_a_wire_and_a_toughness_of_nothing_have_a_force(capsys):
    nothing = "--shear-modulus 0 --toughness 0 --wear-strength 1kPa --wire-radius 1mm"
    assert run(f"force {nothing} --model eq13") == 0
    printed = capsys.readouterr().out
    assert re.search(r"\n1 +unknown +4 +0 +0 +4 +eq13 +unknown +unknown +yes", printed)


def test_the_threshold_of_regimes(capsys):
    wires = f"{SCENE} --wire-radius 0.1mm --model eq13"  # wear is 66.0 % of the force
    for options, dominant in (("", "transition"), ("--threshold 0.65", "wear")):
        assert run(f"regime {wires} {options} --json") == 0
        assert json.loads(capsys.readouterr().out)["wires"][0]["dominant"] == dominant


def test_two_forces_have_no_known_error(capsys, tmp_path):
    file = tmp_path / "two.csv"
    file.write_text("wire_radius_mm,force_per_thickness_N_per_m\n0.1,2\n0.2,3\n")
    assert run(f"identify {file} --shear-modulus 685 --model eq13 --verbose") == 0
    printed = capsys.readouterr().out
    assert re.search(r"Gamma_o +1 +J/m2 +unknown +unknown\n", printed)
    assert re.search(r"l_w = Gamma_o/tau_w +400 +unknown\n", printed)
    assert not re.search(r"\bnan\b", printed)


@pytest.mark.parametrize("ending", ["png", "pdf", "svg"])
def test_plot(ending, capsys, tmp_path):
    pytest.importorskip("matplotlib")
    picture = tmp_path / f"fit.{ending}"
    assert run(f"identify --example --plot {picture}") == 0
    assert picture.stat().st_size > 5000
    assert f"Figure written to {picture}" in capsys.readouterr().out


def test_version(capsys):
    with pytest.raises(SystemExit) as stop:
        run("--version")
    assert stop.value.code == 0
    assert capsys.readouterr().out.startswith(f"wirecut {__version__}\n")


@pytest.mark.parametrize(
    ("command", "words"),
    [
        ("--json", "COMMAND"),
        ("cut", "invalid choice: 'cut'"),
        ("force", "--wire-radius"),
        (f"force {SCENE}", "--wire-radius"),
        (f"force {SCENE} --wire-radius 1mm --wire-diameter 2mm", "not allowed with"),
        (f"force {SCENE} --wire-radius 1furlong", "one of m, cm, mm, um"),
        (f"force {SCENE} --wire-radius 1kPa", "not a length"),
        (f"force {SCENE} --wire-radius 1mm --friction-coefficient 10%", "no unit"),
        (f"force {SCENE} --wire-radius 1mm --model eq99", "eq99"),
        (f"force {SCENE} --wire-radius 1e400", "beyond a computer's range"),
        ("force --shear 685Pa --toughness 1 --wire-radius 1mm", "arguments: --shear"),
        ("identify", "FILE"),
        ("identify missing.csv --shear-modulus 1Pa", "missing.csv cannot be read"),
        (f"identify {model_file('paam-wire-cutting.csv')}", "shear modulus is missing"),
        (f"regime {SCENE} --wire-radius 1mm --threshold 0.5", "more than 0.5"),
        ("identify --example --confidence 95", "0.95 for 95 %"),
        ("identify --example --model eq9", "not linear"),
        ("identify --example --law projected --rtol 1e-9", "give --rtol 0.0"),
        (f"force {SCENE} --wire-radius 1um", "give --extrapolate to"),
        (f"regime {SCENE} --wire-radius 1mm --model eq99", "eq99"),
        ("identify --example --plot fit.doc", "choose .png, .pdf or .svg"),
        ("identify --example --plot missing/fit.png", "cannot be written"),
        ("identify --example --material missing.json", "missing.json cannot be read"),
    ],
)
def test_bad_input_ends_in_one_line_and_code_2(command, words, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert run(command) == 2
    streams = capsys.readouterr()
    assert streams.out == ""
    assert streams.err.startswith("wirecut: ")
    assert streams.err.count("\n") == 1
    assert words in streams.err


@pytest.mark.parametrize("arguments", ["identify --example --json", "identify --help"])
@pytest.mark.parametrize("unbuffered", ["", "1"])
def test_a_reader_that_leaves_early_meets_no_traceback(arguments, unbuffered):
    process = subprocess.Popen(
        [sys.executable, "-m", "surrogate.cli.main", *arguments.split()],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env={**os.environ, "PYTHONUNBUFFERED": unbuffered},
    )
    process.stdout.close()
    _, errors = process.communicate(timeout=60)
    assert errors == b""


def test_output_is_ascii(capsys):
    """So that it can be printed on any terminal."""
    for command in ("identify --example", "models", f"regime {SCENE} --wire-radius 1mm"):
        run(command)
    assert io.StringIO(capsys.readouterr().out).read().isascii()


RUBBING = (
    "--shear-modulus 3kPa --toughness 1.6J/m2 --wire-diameter 3um 0.2mm --friction-coefficient 0.2"
)


def test_wires_that_a_model_does_not_reach_are_left_out(capsys, tmp_path):
    picture = tmp_path / "force.png"
    assert run(f"force {RUBBING} --outside nan --json --plot {picture}") == 0
    told = json.loads(capsys.readouterr().out)
    thin, thick = told["wires"]
    assert thin["total"] is thin["fit_error"] is thin["law_error"] is None
    assert run(f"force {RUBBING.replace('3um ', '')} --json") == 0
    (alone,) = json.loads(capsys.readouterr().out)["wires"]
    assert thick == alone
    assert any("no answer for 1 of 2 wires (g = 355.6)" in note for note in told["notes"])
    assert picture.exists()
    assert run(f"regime {RUBBING} --outside nan --model table --json") == 0
    told = json.loads(capsys.readouterr().out)
    assert next(wire["dominant"] for wire in told["wires"]) == "unknown"
    assert any("no answer for 1 of 2 wires" in note for note in told["notes"])


@pytest.mark.parametrize("wires", ["3um 0.2mm", "3um"])
def test_a_refusal_teaches_the_option_where_it_helps(capsys, wires):
    assert run(f"force {RUBBING.replace('3um 0.2mm', wires)}") == 2
    helps = "With --outside nan the other wires are answered." in capsys.readouterr().err
    assert helps == (wires != "3um")


def test_what_is_outside_is_continued_or_left_out(capsys):
    assert run(f"force {RUBBING} --outside nan --extrapolate") == 2
    assert "give one of them" in capsys.readouterr().err
    assert run(f"force {RUBBING.replace(' 0.2mm', '')} --outside nan --plot force.png") == 2
    assert "no wire has a force to draw" in capsys.readouterr().err

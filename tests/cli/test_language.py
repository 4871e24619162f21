"""Bad calls at the command line are answered in its own language: options, and no Python."""

import argparse
import re

import pytest

from surrogate.basics.files import model_file
from surrogate.cli.main import _parser, main

SCENE = ["--shear-modulus", "685Pa", "--toughness", "1.6J/m2", "--wear-strength", "7.75kPa"]
TABLE = str(model_file("paam-wire-cutting.csv"))
WIRE = ["--wire-radius", "0.2mm"]
CALLS = {
    "force": [*SCENE, "--wire-radius", "0.2mm"],
    "regime": [*SCENE, "--wire-radius", "0.2mm"],
    "map": ["--preset", "gel", "--nodes", "5"],
    "identify": [TABLE, "--shear-modulus", "685Pa", "--model", "eq13"],
    "steady": ["record.csv"],
}
VALUES = [
    *("", "x", "-1", "0", "1e400", "nan", "inf", "1e-320", "1e300", "0,2mm", "3 parsecs", "5%"),
    *("685 Pa", "-1.6J/m2", "J/m²", "1.6 J/m²", "[1]", "0x10", "mu=1"),
]
PYTHON = re.compile(
    r"\b\w+=(True|False|None|'|[0-9])|\b[a-z_]+\[[0-9]|\bin Python\b|\w\(\)|\bdtype|ndarray|"
    r"\bNone\b|\b(True|False)\b|\bNumPy|Traceback|Error\b"
)
COORDINATES = r"choose one of shear_modulus, toughness,.*"
COLUMNS = r"\w+_(mm|m|s|N|N_per_m|mN_per_mm|J_per_m2|<unit>)\b"


def parsers():
    (action,) = [a for a in _parser()._actions if isinstance(a, argparse._SubParsersAction)]
    return action.choices


OPTIONS = {
    name: {text for action in parsers()[name]._actions for text in action.option_strings}
    for name in CALLS
}
BAD = [
    (name, action.option_strings[0], action.nargs)
    for name in CALLS
    for action in parsers()[name]._actions
    if action.option_strings and action.dest != "help" and action.nargs != 0
]


@pytest.fixture(autouse=True)
def record(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    rows = "".join(f"{0.1 * i:.2f},{0.08 if i > 50 else i / 500:.4f}\n" for i in range(200))
    (tmp_path / "record.csv").write_text("displacement_mm,force_N\n" + rows)


def answer(capsys, *arguments):
    code = main(list(arguments))
    return code, capsys.readouterr().err


@pytest.mark.parametrize(("name", "option", "count"), BAD)
def test_no_answer_to_a_bad_value_speaks_python(name, option, count, capsys):
    call = CALLS[name]
    if option == "--wire-diameter":
        call = SCENE
    if option in ("--limits", "--error-of"):
        call = [*call, "--out", "map.svg"]
    refused = 0
    for value in VALUES:
        values = [value] * (count if isinstance(count, int) else 1)
        if "plot" in option or option in ("--out", "--csv", "--boundaries-csv", "--preset"):
            values = [value or "missing/x.png"]
        code, said = answer(capsys, name, *call, option, *values)
        assert code in (0, 2, 3)
        refused += code == 2
        if code == 2:
            assert said.startswith("wirecut: ")
            assert said.count("\n") == 1
        plain = said.replace(repr(value), "VALUE").replace("for instance mu=685Pa", "")
        assert not PYTHON.search(plain), said
        names = re.sub(COLUMNS, "", re.sub(COORDINATES, "", plain))
        assert not re.search(r"\b[a-z]+(_[a-z]+)+\b", names.replace("g_e", "")), said
        for mentioned in re.findall(r"(?<!\w)--[a-z][a-z-]+", plain):
            assert mentioned in OPTIONS[name], said
    assert refused, "no value was refused: are these tests of anything?"


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["force", *SCENE, "--wire-radius", "1um"], "give --extrapolate to continue"),
        (["force", *SCENE, "--wire-radius", "1um", "1mm"], "but g of wire 1 ="),
        (["force", *SCENE, "--wire-radius", "1mm", "1um"], "but g of wire 2 ="),
        (["force", *SCENE, "--wire-radius", "1um"], "choose --model eq13"),
        (["force", *SCENE, "--wire-radius", "0.2", "mm"], "a unit without its number"),
        (
            ["force", "--shear-modulus", "685", "Pa", *SCENE[2:], *WIRE],
            "a unit goes with its number",
        ),
        (["map", "--preset", "gel", "--limits", "eq13"], "give --out as well"),
        (["force", *SCENE, "--wire-radius", "-1mm"], "'-1mm' is negative"),
        (["identify", TABLE, "--shear-modulus", "685 Pascal"], "one of Pa, kPa, MPa"),
        (["identify", TABLE, "--shear-modulus", "1", "--stiffening-exponent", "1"], "--model eq13"),
        (["map", "--preset", "gel", "--fix", "mu"], "for instance mu=685Pa"),
        (["map", "--preset", "gel", "--rtol", "1e-9", "--model", "auto"], "--rtol"),
    ],
)
def test_answers_name_the_options(arguments, words, capsys):
    code, said = answer(capsys, *arguments)
    assert code == 2
    assert words in said
    for mentioned in re.findall(r"(?<!\w)--[a-z][a-z-]+", said):
        assert mentioned in {*OPTIONS[arguments[0]], "--help"}, said


@pytest.mark.parametrize("text", ["1.6 J/m²", "1.6J/m^2", "1.6 J m^-2", "1.6N/m", "1.6"])
def test_units_as_people_write_them(text, capsys):
    wire = ["--wire-radius", "0.2mm", "--model", "eq13", "--wear-strength", "0"]
    assert main(["force", "--shear-modulus", "685 Pa", "--toughness", text, *wire]) == 0
    assert re.search(r"\n0\.2 +11\.68 +1\.6 ", capsys.readouterr().out)


def test_a_share_may_be_in_percent(capsys):
    law = ["--law", "projected"]
    for rtol in ("5%", "5 %", "0.05"):
        assert main(["force", *SCENE, "--wire-radius", "0.2mm", "--rtol", rtol, *law]) == 0
    printed = capsys.readouterr().out
    assert printed == 3 * printed[: len(printed) // 3]

"""`wirecut export`: what it writes, and what it refuses in the words of the command line."""

import json

import pytest

from surrogate import Scene, prepare
from surrogate.cli.main import main
from surrogate.prepared.whole_table import whole_table

GEL = ["--shear-modulus", "685Pa", "--toughness", "1.6J/m2", "--wear-strength", "7.75kPa"]
RADIUS = ["--wire-radius", "0.1mm", "1mm"]


def test_it_prints_the_source_of_the_prepared_force(capsys):
    force = prepare(Scene(685.0, 1.6, 1.0, 0.0, 7750.0), ranges={"wire_radius": (1e-4, 1e-3)})
    for language in ("c", "python"):
        assert main(["export", "--format", language, *GEL, *RADIUS]) == 0
        assert capsys.readouterr().out == force.source(language)


def test_it_writes_a_file_and_says_what_it_is(tmp_path, capsys):
    out = tmp_path / "force.js"
    assert main(["export", "--format", "javascript", *GEL, *RADIUS, "--out", str(out)]) == 0
    text = capsys.readouterr().out
    assert (
        "F_ss/T over wire_radius from 0.0001 to 0.001; wear by table, projected law; error "
        "unknown, of the models alone up to"
    ) in text
    assert out.read_text().startswith("// Steady cutting force")
    assert main(["export", "--format", "javascript", "--table", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["source"] == whole_table("javascript")


def test_the_law_is_an_option(capsys):
    scene, ranges = Scene(685.0, 1.6, 1.0, 0.0, 7750.0), {"wire_radius": (1e-4, 1e-3)}
    for law in ("projected", "auto"):
        assert main(["export", "--format", "c", "--law", law, *GEL, *RADIUS]) == 0
        assert capsys.readouterr().out == prepare(scene, ranges=ranges, law=law).source("c")
    assert main(["export", "--format", "c", "--law", "coupled", *GEL, *RADIUS]) == 2
    assert "where no coupled solution is near" in capsys.readouterr().err
    for law in ("slip", "coupled"):
        assert main(["export", "--format", "c", "--law", law, "--table"]) == 0
        assert capsys.readouterr().out == whole_table("c", law)
    command = ["export", "--format", "c", "--law", "slip"]
    assert main([*command, *GEL, *RADIUS]) == 0
    assert capsys.readouterr().out == prepare(scene, ranges=ranges, law="slip").source("c")
    assert main([*command, *GEL, *RADIUS, "--rtol", "0.02"]) == 2
    assert "where the crack's tip touches the wire" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ([*GEL, "--wire-radius", "1mm"], "a quantity must vary"),
        ([*GEL, "--wire-radius", "1mm", "2mm", "3mm"], "--wire-radius must have one value, or two"),
        ([*RADIUS, "--toughness", "1.6J/m2"], "--shear-modulus must be given"),
        ([*GEL, *RADIUS, "--table"], "--table must stand without quantities"),
        ([*GEL, "--wire-radius", "0.001um", "1mm"], "all over the ranges"),
        ([*GEL, *RADIUS, "--model", "gp"], "neither the table nor a closed form"),
        ([*GEL, *RADIUS, "--format", "fortran"], "invalid choice: 'fortran'"),
    ],
)
def test_what_cannot_be_exported_is_refused_in_one_line(options, words, capsys):
    assert main(["export", "--format", "c", *options]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert words in printed.err
    assert printed.err.count("\n") == 1

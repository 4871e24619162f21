"""The laws of dissipation: what each sums up, its slopes, and who refuses it."""

import json
from dataclasses import replace

import numpy as np
import pytest

import surrogate
from surrogate import InputError, Scene, classify, cutting_force, force_gradient
from surrogate.cli.main import main
from surrogate.scene import NAMES

GEL = Scene(1000.0, 1.0, [0.2e-3, 1e-3, 20e-3], 0.1, 1000.0, 3.0)


@pytest.mark.parametrize("model", ["power-law", "table", "gp"])
def test_slip_takes_the_slip_arc_and_load_where_projected_takes_their_projections(installed, model):
    g = GEL.toughness / (GEL.shear_modulus * GEL.wire_radius)
    contact = surrogate.contact_functions(g, 3.0, model=model)
    for law, arc, load in (
        ("projected", contact.arc, contact.normal_load),
        ("slip", contact.slip_arc, contact.slip_load),
    ):
        force = cutting_force(GEL, model=model, law=law)
        assert force.law == law
        assert force.wear == pytest.approx(2.0 * GEL.wire_radius * 1000.0 * arc, rel=1e-13)
        assert force.friction == pytest.approx(2.0 * GEL.wire_radius * 100.0 * load, rel=1e-13)


def test_closed_forms_are_of_the_projected_law_whether_it_is_named_or_not(installed):
    plain, named = (cutting_force(GEL, "eq13", **law) for law in ({}, {"law": "projected"}))
    assert plain == named
    assert (plain.law, plain.law_error, plain.doubts) == ("projected", None, ())
    assert classify(GEL, model="eq13") == classify(GEL, model="eq13", law="projected")
    made = surrogate.regime_map("g", "xi", ((0.1, 10.0), (0.1, 10.0)), nodes=3)
    assert (made.model, made.force.law) == ("eq13", "projected")


def test_slip_by_auto_is_the_table_with_its_bound(installed):
    gel = replace(GEL, stiffening_exponent=2.5)
    force = cutting_force(gel, law="slip")
    assert force.model == "table"
    assert np.array_equal(force.total, cutting_force(gel, "table", law="slip").total)
    bounds = installed.slip_bounds
    g = gel.toughness / (gel.shear_modulus * gel.wire_radius)
    off = [np.expm1(bounds.at("table", n, g, np.full(3, 2.5))) for n in ("slip_arc", "slip_load")]
    expected = (force.wear * off[0] + force.friction * off[1]) / force.total
    touches = g >= installed.models["table"].touch(2.5)
    assert touches.tolist() == [True, False, False]
    expected = np.where(touches, np.nan, expected)  # which the sharpness of the tip decides
    assert force.fit_error == pytest.approx(expected, rel=1e-12, nan_ok=True)


def test_slip_exceeds_projected(installed):
    slip, projected = (cutting_force(GEL, "table", law=law) for law in ("slip", "projected"))
    assert np.all(slip.total > projected.total)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("model", ["power-law", "table", "gp"])
def test_slopes_of_slip_are_those_of_its_force(installed, model, name):
    scene = replace(GEL, wire_radius=1.3e-3)
    h = 1e-4 * getattr(scene, name)  # below, the rounding of a process shows
    beside = [
        cutting_force(replace(scene, **{name: getattr(scene, name) + s * h}), model, law="slip")
        for s in (-1.0, 1.0)
    ]
    slope = (beside[1].total - beside[0].total) / (2.0 * h)
    found = getattr(force_gradient(scene, model, law="slip"), name)
    assert found == pytest.approx(slope, rel=5e-6)


def test_every_call_knows_the_law(installed):
    scene = replace(GEL, wire_radius=1e-3)
    assert classify(scene, law="slip") != classify(scene, model="eq13")
    by_law = [surrogate.transition_radius(scene, law=law) for law in ("projected", "slip")]
    assert by_law[0] != by_law[1]
    spread = surrogate.propagate(scene, {"toughness": 0.1}, law="slip")
    assert spread.total == cutting_force(scene, law="slip").total
    slip = surrogate.dissipative_force(1.0, 3.0, 0.1, 1.0, law="slip")
    assert slip == pytest.approx(cutting_force(scene, law="slip").total / 1.0 - 1.0, rel=1e-12)
    ranges = ((0.2, 2.0), (0.01, 10.0))
    drawn = surrogate.regime_map(
        "R_w/l_e", "R_w/l_w", ranges, {"alpha": 3.0}, "table", law="slip", nodes=5
    )
    assert str(drawn.model) == "table, law slip"


def test_who_has_no_slip_refuses_it(installed):
    with pytest.raises(InputError, match="'eq13' is of the law 'projected'"):
        cutting_force(GEL, "eq13", law="slip")
    for law in ("couple", "", None, 3):
        with pytest.raises(InputError, match="law must be one of projected, slip, coupled, auto"):
            cutting_force(GEL, law=law)


def test_the_command_names_the_law(installed, capsys):
    command = ["force", "--shear-modulus", "1kPa", "--toughness", "1J/m2", "--wire-radius", "1mm"]
    command += ["--wear-strength", "1kPa", "--stiffening-exponent", "3", "--law", "slip"]
    assert main([*command, "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["law"] == "slip"
    scene = Scene(1000.0, 1.0, 1e-3, 0.0, 1000.0, 3.0)
    assert told["wires"][0]["total"] == cutting_force(scene, law="slip").total
    assert main(command) == 0
    assert "law of slip" in capsys.readouterr().out


def test_the_command_says_where_the_tip_decides(installed, capsys):
    command = [
        "force",
        "--shear-modulus",
        "1kPa",
        "--toughness",
        "1J/m2",
        "--wear-strength",
        "1kPa",
    ]
    command += ["--stiffening-exponent", "2.5", "--law", "slip", "--wire-radius"]
    assert main([*command, "0.1mm"]) == 0
    assert "how sharp the tip is" in capsys.readouterr().out
    assert main([*command, "10mm"]) == 0
    assert "sharp" not in capsys.readouterr().out

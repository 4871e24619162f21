"""Implausible input: a warning of its own kind from Python, words and exit code 3 from commands."""

import json
import re
import warnings

import numpy as np
import pytest

from surrogate import (
    ImplausibleInputWarning,
    Scene,
    classify,
    cutting_force,
    force_gradient,
    identify,
    propagate,
    regime_map,
    transition_radius,
    wear_transition_radius,
)
from surrogate.cli.main import main
from surrogate.cutting.believable import are_believable
from surrogate.reading import plausibility
from surrogate.reading.plausibility import (
    COHESIVE_LENGTH,
    SCENE,
    doubts_of_scene,
)

GEL = {"mu": 685.0, "gamma": 1.6, "radius": 0.2e-3, "xi": 0.1, "tau": 7750.0}
SLIPS = [
    ("radius", 0.2, "likely mm given as m"),
    ("mu", 0.3, "likely kPa given as Pa"),
    ("xi", 3.0, "likely percent given as a number"),
    ("tau", 7.75e9, "likely Pa given as kPa"),
    ("gamma", 1.6e7, "likely mJ/m^2 given as J/m^2"),
]
CALLS = {
    "cutting_force": lambda scene: cutting_force(scene, "eq13"),
    "classify": lambda scene: classify(scene, model="eq13"),
    "force_gradient": lambda scene: force_gradient(scene, "eq13"),
    "propagate": lambda scene: propagate(scene, {"toughness": 0.1}, "eq13"),
}


RADII = {
    "transition_radius": lambda scene: transition_radius(scene, "eq13"),
    "wear_transition_radius": wear_transition_radius,
}
"""Calls on which the wire has no influence."""


def scene(**changes):
    values = GEL | changes
    return Scene(*(values[name] for name in ("mu", "gamma", "radius", "xi", "tau")))


@pytest.mark.parametrize("call", CALLS.values(), ids=CALLS)
@pytest.mark.parametrize(("name", "value", "words"), SLIPS)
def test_calls_warn_of_a_slip_and_answer_all_the_same(call, name, value, words):
    with pytest.warns(ImplausibleInputWarning, match=re.escape(words)):
        call(scene(**{name: value}))
    with warnings.catch_warnings():
        warnings.simplefilter("error", ImplausibleInputWarning)
        call(scene())
        call(scene(radius=[1e-4, 2e-4]))
        call(scene(**{name: 0.0})) if name in ("xi", "tau") else None


def test_arrays_are_looked_at_as_a_whole():
    with pytest.warns(ImplausibleInputWarning, match=r"0\.0002 to 0\.2 m"):
        cutting_force(scene(radius=[0.2e-3, 0.2]), "eq13")
    with warnings.catch_warnings():
        warnings.simplefilter("error", ImplausibleInputWarning)
        cutting_force(scene(radius=np.empty(0)), "eq13")


def test_the_warning_names_the_line_of_the_call():
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", ImplausibleInputWarning)
        cutting_force(scene(radius=0.2), "eq13")
        classify(scene(radius=0.2), model="eq13")
    assert [one.filename for one in caught] == [__file__, __file__]


@pytest.mark.parametrize("number", range(5))
def test_the_quick_look_is_the_thorough_one(number):
    """At, just within and just beyond each end of each range, and at 0."""
    low, high = SCENE[number].low, SCENE[number].high
    for end in (low, high, 0.0):
        for value in (end, np.nextafter(end, -np.inf), np.nextafter(end, np.inf)):
            values = [685.0, 1.6, 0.2e-3, 0.1, 7750.0]
            values[number] = max(float(value), 0.0)
            assert are_believable(*values) == (not doubts_of_scene(values)), values


def test_the_quick_look_sees_a_modulus_in_the_wrong_unit():
    for mu, gamma in ((3.0, 10.0), (3e3, 10.0), (1.5, 1.5)):
        values = mu, gamma, 0.2e-3, 0.0, 0.0
        assert are_believable(*values) == (not doubts_of_scene(values))
    assert COHESIVE_LENGTH.high == 1.0
    assert plausibility.doubts_of_scene((3.0, 10.0, 0.2e-3, 0.0, 0.0))


def test_a_map_is_doubted_by_what_it_fixes_and_by_an_axis_nobody_has():
    x, y = (1e-5, 1e-2), (0.05, 50.0)
    fixed = {"shear_modulus": 0.3, "wear_strength": 7750.0}
    with pytest.warns(ImplausibleInputWarning, match=r"shear modulus \(0\.3 Pa\)"):
        regime_map("wire_radius", "toughness", (x, y), fixed, nodes=5)
    fixed["shear_modulus"] = 685.0
    with pytest.warns(ImplausibleInputWarning, match=r"wire radius \(1 to 10 m\)"):
        regime_map("wire_radius", "toughness", ((1.0, 10.0), y), fixed, nodes=5)
    with warnings.catch_warnings():
        warnings.simplefilter("error", ImplausibleInputWarning)
        regime_map("wire_radius", "toughness", (x, y), fixed, nodes=5)
        regime_map("R_w/l_e", "R_w/l_w", ((1e-4, 1e2), (1e-2, 1e2)), {"xi": 0.1}, nodes=5)


COMMAND = ["--shear-modulus", "685Pa", "--toughness", "1.6J/m2", "--model", "eq13"]


@pytest.mark.parametrize("command", ["force", "regime"])
def test_commands_print_the_doubt_and_leave_with_3(command, capsys):
    for radius, code in (("0.2mm", 0), ("0.2", 3)):
        assert main([command, *COMMAND, "--wire-radius", radius]) == code
        printed = " ".join(capsys.readouterr().out.split())
        assert ("Warning: the wire radius (0.2 m) is hardly" in printed) == (code == 3)
        assert main([command, *COMMAND, "--wire-radius", radius, "--json"]) == code
        assert len(json.loads(capsys.readouterr().out)["warnings"]) == (code == 3)


def test_the_command_map_prints_the_doubt_and_leaves_with_3(capsys):
    for mu, code in (("685Pa", 0), ("0.3", 3)):
        assert main(["map", "--preset", "gel", "--nodes", "5", "--fix", f"mu={mu}"]) == code
    assert "the shear modulus (0.3 Pa) is hardly" in capsys.readouterr().out


@pytest.mark.parametrize("command", ["force", "regime", "map", "identify", "steady"])
def test_the_exit_codes_are_in_the_help(command, capsys):
    with pytest.raises(SystemExit):
        main([command, "--help"])
    assert "3 where a printed warning says not to use the answer" in capsys.readouterr().out


@pytest.mark.parametrize("name", RADII)
def test_transition_radii_warn_of_what_they_depend_on(name):
    call = RADII[name]
    with pytest.warns(ImplausibleInputWarning, match="wear strength") as caught:
        answer = call(scene(tau=7.75e9))
    assert caught[0].filename == __file__
    assert answer > 0.0
    with warnings.catch_warnings():
        warnings.simplefilter("error", ImplausibleInputWarning)
        assert call(scene(radius=0.2)) == call(scene())
        call(scene(tau=[5e3, 7e3]))


def test_an_identification_doubts_in_its_own_words_alone():
    """Its lengths are asked of a scene that no caller gave."""
    fit = identify([1e-4, 2e-4, 4e-4], [4.7e3, 7.9e3, 13.9e3], 685.0, model="eq13")
    with warnings.catch_warnings():
        warnings.simplefilter("error", ImplausibleInputWarning)
        assert fit.model_transition_radius > 0.0
        assert fit.wear_length > 0.0
    assert fit.objections

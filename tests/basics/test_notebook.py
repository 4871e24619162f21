"""What notebooks show of results."""

import re
from functools import partial
from xml.etree import ElementTree

import numpy as np
import pytest

import surrogate
from surrogate import Scene, regime_map
from surrogate.basics.records import html_table

identify = partial(surrogate.identify, model="eq13")
cutting_force = partial(surrogate.cutting_force, model="eq13")
classify = partial(surrogate.classify, model="eq13")

GEL = Scene(685.0, 1.6, [1e-5, 2e-4], wear_strength=7750.0)


def cells(html):
    table = ElementTree.fromstring(html[: html.index("</table>") + len("</table>")])
    return [[cell.text or "" for cell in row] for row in table if row.tag == "tr"]


def test_a_scene_with_units():
    rows = {name: (value, unit) for name, value, unit in cells(GEL._repr_html_())}
    assert rows["shear_modulus"] == ("685", "Pa")
    assert rows["toughness"] == ("1.6", "J/m^2")
    assert rows["wire_radius"] == (
        "2 values, 1e-05 to 0.0002",
        "m",
    )
    assert rows["stiffening_exponent"] == ("2", "")


def test_a_force_and_a_regime():
    rows = {name: (value, unit) for name, value, unit in cells(cutting_force(GEL)._repr_html_())}
    assert rows["total"] == ("2 values, 1.91 to 7.8", "N/m")
    assert rows["relative_error"][0] == "unknown"
    assert rows["model"][0] == "eq13"
    rows = {name: value for name, value, _ in cells(classify(GEL)._repr_html_())}
    assert rows["dominant"] == "2 values: toughness-and-friction, wear"


def test_a_force_with_its_standard_deviation_and_a_choice_of_wires():
    force = surrogate.propagate(GEL, {"toughness": 0.2, "wear_strength": 500.0}, "eq13")
    rows = {name: (value, unit) for name, value, unit in cells(force._repr_html_())}
    assert rows["total"] == ("2 values, 1.91 to 7.8", "N/m")
    assert rows["contributions: toughness"] == ("2 values, 0.2 to 0.2", "N/m")
    design = surrogate.design_radii(1e-4, 5e-4, cuts=5, force_std=0.5)
    rows = {name: (value, unit) for name, value, unit in cells(design._repr_html_())}
    assert rows["wire_radius"] == ("5 values, 0.0001 to 0.0005", "m")
    assert rows["toughness_std"] == (f"{design.toughness_std:.4g}", "J/m2")


def test_arrays_without_numbers():
    empty = Scene(1.0, np.empty(0), 1.0)
    rows = {name: value for name, value, _ in cells(empty._repr_html_())}
    assert rows["toughness"] == "0 values"
    infinite = cutting_force(Scene(1.0, [1e308, 1e308], 1.0, 10.0))
    rows = {name: value for name, value, _ in cells(infinite._repr_html_())}
    assert rows["total"] == "2 values, none finite"


def test_an_identification_with_its_intervals_and_warnings():
    fit = identify([1e-4, 2e-4, 4e-4, 5e-4], [4.7, 7.9, 13.9, 17.2], shear_modulus=685.0)
    rows = cells(fit._repr_html_())
    assert rows[1][0] == "cleavage toughness"
    assert rows[1][1].startswith("1.625 (95 %: ")
    assert [text for name, text, _ in rows if name == "warning"] == list(fit.warnings)
    assert len(fit.warnings) > 0
    bounded = identify([1e-4, 2e-4], [4.7, 7.9], 685.0, toughness_max=5.0)
    assert "undecided" in [row[0] for row in cells(bounded._repr_html_())] or not bounded.undecided


def test_markup_in_values_is_escaped():
    assert cells(html_table("<x>", [("a<b", "&", "")])) == [["a<b", "&", ""]]


def test_a_map_with_its_picture():
    pytest.importorskip("matplotlib")
    made = regime_map("R_w/l_e", "R_w/l_w", ((1e-2, 10), (1e-2, 10)), {"xi": 0.1}, nodes=31)
    html = made._repr_html_()
    rows = cells(html)
    assert ["x", "R_w/l_e 0.01 to 10", ""] in rows
    assert ["equal-terms", "(1 + xi) Gamma_o = 4 tau_w R_w", ""] in rows
    gel = regime_map("R_w", "Gamma_o", ((1e-5, 1e-3), (1, 9)), {"mu": 685, "tau_w": 9}, nodes=5)
    assert ["shear_modulus", "685", "Pa"] in cells(gel._repr_html_())
    assert re.search(r"<svg[\s\S]*wear[\s\S]*</svg>", html)
    assert html == made._repr_html_()


def test_a_map_without_matplotlib(monkeypatch):
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    made = regime_map("R_w/l_e", "R_w/l_w", ((1e-2, 10), (1e-2, 10)), {"xi": 0.1}, nodes=5)
    assert "<svg" not in made._repr_html_()

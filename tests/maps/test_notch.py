"""Maps under the law "slip" with a crack's tip of a stated radius."""

import numpy as np
import pytest

from surrogate import DomainError, InputError, Scene, classify, cutting_force, regime_map
from surrogate.cli.main import main

GEL = {"shear_modulus": 685.0, "toughness": 1.6, "stiffening_exponent": 2.0}
AXES = ("R_w", "tau_w", ((1e-4, 1e-3), (1.0, 2000.0)))


def of_tip(notch_radius, axes=AXES, fixed=GEL):
    return regime_map(*axes, fixed, "table", law="slip", nodes=9, notch_radius=notch_radius)


def test_its_nodes_are_those_of_the_force_and_of_the_regime():
    made = of_tip(1e-6)
    radius, wear = made.x.values, made.y.values[:, np.newaxis]
    cuts = Scene(685.0, 1.6, radius, 0.0, wear)
    force = cutting_force(cuts, "table", law="slip", notch_radius=1e-6)
    regime = classify(cuts, model="table", law="slip", notch_radius=1e-6)
    assert np.array_equal(made.force.total, force.total)
    assert np.array_equal(made.force.fit_error, force.fit_error, equal_nan=True)
    assert np.array_equal(made.regime.dominant, regime.dominant)
    assert np.all(made.force.wear < of_tip(1e-7).force.wear)  # a sharper tip slips farther


def test_it_is_in_radii_where_the_radius_is_the_unit():
    made = of_tip(1e-3, ("g", "tau_w/mu", ((2.0, 20.0), (1e-3, 1.0))), {"alpha": 2.0})
    g, wear = made.x.values, made.y.values[:, np.newaxis]
    gel = Scene(1e3, 1e3 * 1e-4 * g, 1e-4, 0.0, 1e3 * wear)
    force = cutting_force(gel, "table", law="slip", notch_radius=1e-7)
    np.testing.assert_allclose(made.force.total, force.total / (1e3 * 1e-4), rtol=1e-13)


def test_a_tip_that_nobody_solved_and_another_law_are_refused():
    with pytest.raises(DomainError, match="notch_radius must be one whose slip was computed"):
        of_tip(1e-4)
    with pytest.raises(InputError, match="notch_radius must be given with law='slip'"):
        regime_map(*AXES, GEL, notch_radius=1e-6)


def test_table_and_picture_say_the_radius(tmp_path, capsys):
    made = of_tip(1e-6)
    made.to_csv(tmp_path / "map.csv")
    first = (tmp_path / "map.csv").read_text(encoding="utf-8").splitlines()[0]
    assert "model table, law slip, notch_radius 1e-06" in first
    pytest.importorskip("matplotlib")
    from matplotlib.figure import Figure

    from surrogate import plot_regime_map

    ax = plot_regime_map(made, Figure(layout="constrained").add_subplot())
    assert any("tip" in text.get_text() for text in ax.texts)
    x, y = ["--x", "R_w", "0.1mm", "1mm"], ["--y", "tau_w", "1Pa", "2kPa"]
    fixed = ["--fix", "mu=685Pa", "Gamma_o=1.6J/m2", "--model", "table", "--nodes", "9"]
    assert main(["map", *x, *y, *fixed, "--law", "slip", "--notch-radius", "1um"]) == 0
    assert "notch_radius 1e-06" in capsys.readouterr().out

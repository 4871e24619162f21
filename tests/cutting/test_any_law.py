"""The law "auto", the default: what each function makes of it, and what it says where it fails."""

import copy
import pickle
import re
from dataclasses import replace

import numpy as np
import pytest

import surrogate.choosing.auto_law
import surrogate.choosing.beside
from surrogate import (
    AccuracyError,
    MapPoints,
    Scene,
    UnknownErrorWarning,
    classify,
    cutting_force,
    dissipative_force,
    force_gradient,
    plot_force,
    propagate,
    regime_map,
    transition_radius,
)
from surrogate.choosing.by_name import force_model
from surrogate.cli.main import main
from surrogate.contact.shipped import location
from surrogate.maps.belonging import require_the_same
from surrogate.maps.figure import save_regime_map
from surrogate.scene import NAMES

# the first wire is beyond the made-up solutions by its g, the others are not
WIRES = Scene(5e3, 1.0, [0.01e-3, 0.5e-3, 2e-3, 8e-3], 0.02, 500.0, 4.0)
BEYOND = replace(WIRES, friction_coefficient=0.4)
NAMED = ("power-law", "table", "gp")


@pytest.fixture
def unknown(coupled):
    """Which of the wires no solution is near to."""
    g = WIRES.toughness / (WIRES.shear_modulus * WIRES.wire_radius)
    outside = ~(coupled.share(g, 4.0, 0.02, 0.1) <= 1.0)
    assert outside.tolist() == [True, False, False, False]
    return outside


@pytest.mark.parametrize("model", NAMED)
def test_a_named_model_has_its_law_chosen(unknown, model):
    force = cutting_force(WIRES, model)
    assert force.chosen.tolist() == [model] * 4
    assert force.laws[0] == "projected"
    assert set(force.laws[1:]) <= {"slip", "coupled"}
    for law in set(force.laws.tolist()):
        here = force.laws == law
        named = cutting_force(WIRES, model, law=law, outside="nan")
        for part in ("total", "friction", "wear"):
            assert np.array_equal(getattr(force, part)[here], getattr(named, part)[here])
    for i, radius in enumerate(WIRES.wire_radius.tolist()):
        one = cutting_force(replace(WIRES, wire_radius=radius), model)
        assert (one.total, one.laws) == (force.total[i], force.laws[i])
        for error in ("fit_error", "law_error", "relative_error"):
            assert np.array_equal(getattr(one, error), getattr(force, error)[i], equal_nan=True)


def test_where_two_percent_cannot_be_had_the_law_of_the_smaller_error_is_taken(
    coupled, monkeypatch
):
    rough = replace(coupled, errors=coupled.errors + 0.2)
    in_use = surrogate.choosing.auto_law._at(*location())._replace(kappa=rough)
    monkeypatch.setattr(surrogate.choosing.auto_law, "_at", lambda *_: in_use)
    rng = np.random.default_rng(5)
    short = 0
    for _ in range(10):
        scene = Scene(
            5e3,
            1.0,
            10.0 ** rng.uniform(-3.0, -1.0, 30),
            rng.uniform(0.0, 0.05),
            rng.uniform(0.0, 4e3),
            float(rng.uniform(2.5, 8.0)),
        )
        force = cutting_force(scene, "table", outside="nan")
        known = np.isfinite(force.law_error)
        slip, full = (
            cutting_force(scene, "table", law=law, outside="nan") for law in ("slip", "coupled")
        )
        more = known & (force.relative_error > 0.02)
        short += more.sum()
        kappa = (full.friction + full.wear) / (slip.friction + slip.wear)
        share = (full.friction + full.wear) / full.total
        g = scene.toughness / (scene.shear_modulus * scene.wire_radius)
        load = scene.friction_coefficient, scene.wear_strength / scene.shear_modulus
        own = share * np.expm1(rough.error(g, scene.stiffening_exponent, *load))
        most = slip.fit_error * np.maximum(1.0, kappa) + own
        assert np.all(force.relative_error[more] <= most[more] * (1.0 + 1e-9))
        full_law = more & (force.laws == "coupled")
        np.testing.assert_allclose(force.relative_error[full_law], most[full_law], rtol=1e-9)
    assert short > 20


def test_errors_of_named_laws_are_evaluated_when_they_are_asked_for(coupled, monkeypatch):
    asked = []
    bound = surrogate.choosing.beside.force_bound
    monkeypatch.setattr(
        surrogate.choosing.beside, "force_bound", lambda *a: asked.append(a) or bound(*a)
    )
    wires = np.array([0.5e-3, 2e-3])
    force = cutting_force(replace(WIRES, wire_radius=wires), "table", law="slip")
    assert not asked
    wires[:] = force.wear[:] = force.friction[:] = 1.0  # of which no error may be
    assert np.all(force.law_error > 0.0)
    assert len(asked) == 1
    again = cutting_force(replace(WIRES, wire_radius=[0.5e-3, 2e-3]), "table", law="slip")
    assert np.array_equal(force.relative_error, again.relative_error)
    assert pickle.loads(pickle.dumps(again)) == copy.deepcopy(again) == again
    with pytest.raises(AttributeError, match="has no attribute 'nothing'"):
        again.nothing  # noqa: B018


def test_the_law_error_is_unknown_where_no_solution_is_near_and_none_where_nothing_rubs(unknown):
    for law in ("projected", "slip"):
        force = cutting_force(WIRES, "table", law=law)
        assert np.isnan(force.law_error).tolist() == unknown.tolist()
        bare = replace(WIRES, friction_coefficient=0.0, wear_strength=0.0)
        assert cutting_force(bare, law=law).law_error.tolist() == [0.0] * 4
    assert np.all(cutting_force(WIRES, "table", law="slip").law_error[1:] > 0.0)
    with_closed_form = cutting_force(WIRES, "eq13", law="projected")
    assert with_closed_form.law_error is with_closed_form.relative_error is None


def test_the_fallback_is_told_once_in_words(unknown):
    force = cutting_force(WIRES)
    (doubt,) = force.doubts
    assert doubt.startswith("at 1 of 4 points the error of the force is unknown")
    assert "effective strengths" in doubt
    assert np.isnan(force.relative_error).tolist() == unknown.tolist()
    assert cutting_force(replace(WIRES, wire_radius=2e-3)).doubts == ()
    assert classify(WIRES).doubts == force.doubts
    assert classify(WIRES).laws.tolist() == force.laws.tolist()
    assert force_gradient(WIRES).doubts == propagate(WIRES, {}).doubts == force.doubts
    for law in ("projected", "slip"):
        assert cutting_force(WIRES, law=law, outside="nan").doubts == ()


def test_bare_numbers_warn_once(coupled):
    with pytest.warns(UnknownErrorWarning, match="at 2 of 4 points .* dissipative") as caught:
        dissipative_force(1.0, 4.0, [0.01, 0.01, 0.4, 0.45], 0.1)
    assert len(caught) == 1
    assert caught[0].filename == __file__
    with pytest.warns(UnknownErrorWarning, match="of the transition radius") as caught:
        transition_radius(BEYOND)
    assert len(caught) == 1
    assert caught[0].filename == __file__


def test_nothing_that_rubs_has_no_doubt(coupled):
    bare = replace(WIRES, friction_coefficient=0.0, wear_strength=0.0)
    far = replace(bare, wire_radius=1e-9)
    for scene in (bare, far):
        for model in ("auto", *NAMED):
            force = cutting_force(scene, model, extrapolate=True)
            assert np.all(force.total == 1.0)
            assert np.all(force.relative_error == 0.0)
            assert force.doubts == ()


@pytest.mark.parametrize("name", NAMES)
def test_slopes_are_those_of_the_law_at_the_point(unknown, name):
    slope = force_gradient(WIRES, "table")
    assert slope.laws.tolist() == ["projected", "coupled", "coupled", "coupled"]
    assert slope.law == "auto"
    found = getattr(slope, name)
    parts = [replace(WIRES, wire_radius=WIRES.wire_radius[mask]) for mask in (unknown, ~unknown)]
    for law, mask, part in zip(("projected", "coupled"), (unknown, ~unknown), parts, strict=True):
        assert np.array_equal(found[mask], getattr(force_gradient(part, "table", law=law), name))
    one = force_gradient(replace(WIRES, wire_radius=8e-3), "table")
    assert (getattr(one, name), one.laws) == (found[3], "coupled")


def test_a_slope_at_no_load_is_that_of_the_first_order_where_solutions_reach(coupled):
    bare = Scene(5e3, 1.0, 2e-3, 0.0, 0.0, 4.0)
    slope = force_gradient(bare, "table")
    assert slope.laws == "coupled"
    slip = force_gradient(bare, "table", law="slip")
    assert slope.wear_strength == pytest.approx(slip.wear_strength, rel=1e-12)
    assert slope.friction_coefficient == pytest.approx(slip.friction_coefficient, rel=1e-12)


def test_propagation_has_the_law_of_each_point(unknown):
    std = {"toughness": 0.05, "wear_strength": 30.0}
    spread = propagate(WIRES, std, "table")
    for law, mask in (("projected", unknown), ("coupled", ~unknown)):
        part = replace(WIRES, wire_radius=WIRES.wire_radius[mask])
        named = propagate(part, std, "table", law=law)
        assert np.array_equal(spread.total[mask], named.total)
        assert np.array_equal(spread.std[mask], named.std)
    assert np.all(np.isfinite(spread.std))
    assert propagate(WIRES, std, "eq13").law == "projected"


def test_the_transition_radius_is_of_the_coupled_law_where_that_reaches_to_it(coupled):
    scene = replace(WIRES, wire_radius=1e-3)
    assert transition_radius(scene, "table") == transition_radius(scene, "table", law="coupled")
    far = replace(BEYOND, wire_radius=1e-3)
    with pytest.warns(UnknownErrorWarning):
        radius = transition_radius(far, "table")
    assert radius == transition_radius(far, "table", law="projected")
    both = replace(scene, friction_coefficient=[0.02, 0.4])
    with pytest.warns(UnknownErrorWarning, match="at 1 of 2 points"):
        radii = transition_radius(both, "table")
    assert radii.tolist() == [transition_radius(scene, "table"), radius]
    assert transition_radius(Scene(5e3, 1.0, 1e-3)) == np.inf
    assert transition_radius(Scene(5e3, 0.0, 1e-3, 0.1, 10.0)) == 0.0


def test_a_map_has_a_law_at_each_node_and_draws_where_it_is_unknown(coupled, tmp_path):
    fixed = {"alpha": 4.0, "tau_w/mu": 0.1}
    made = regime_map("g", "xi", ((0.01, 10.0), (1e-3, 1.0)), fixed, "table", nodes=31)
    assert str(made.model) == "table, law auto"
    assert set(np.unique(made.force.laws)) == {"projected", "slip", "coupled"}
    unknown = np.isnan(made.force.law_error)
    assert np.array_equal(unknown, made.force.laws == "projected")
    i, j = np.argwhere(~unknown)[7]
    here = made.scene_at(made.x.values[j], made.y.values[i])
    force = cutting_force(here, "table")
    assert (made.force.total[i, j], made.force.laws[i, j]) == (force.total, force.laws)
    made.to_csv(tmp_path / "map.csv")
    header = [line for line in (tmp_path / "map.csv").read_text().splitlines() if line[0] != "#"]
    assert "law" in header[0].split(",")
    pytest.importorskip("matplotlib")
    save_regime_map(made, tmp_path / "map.svg")
    assert "projected law, error unknown" in (tmp_path / "map.svg").read_text()
    named = regime_map("g", "xi", ((0.01, 10.0), (1e-3, 1.0)), fixed, "table", nodes=31, law="slip")
    save_regime_map(named, tmp_path / "map.svg")
    assert "error unknown" not in (tmp_path / "map.svg").read_text()


def test_points_belong_on_a_map_whose_law_there_is_theirs(coupled):
    fixed = {"alpha": 4.0, "tau_w/mu": 0.1}
    made = regime_map("g", "xi", ((0.01, 10.0), (1e-3, 1.0)), fixed, "table", nodes=5)
    near = Scene(5e3, 1.0, [0.5e-3, 2e-3], 0.02, 500.0, 4.0)
    far = replace(near, friction_coefficient=0.8)
    for scene, law in ((near, "slip"), (near, "coupled"), (far, "projected"), (near, "auto")):
        require_the_same(MapPoints(scene, "gel", law=law), made)
    for scene, law in ((near, "projected"), (far, "slip"), (far, "coupled")):
        with pytest.raises(ValueError, match=f"identified by the law '{law}'"):
            require_the_same(MapPoints(scene, "gel", law=law), made)


def test_a_figure_is_dotted_where_the_law_is_unknown(coupled):
    figure = pytest.importorskip("matplotlib.figure")
    scene = replace(WIRES, wire_radius=2e-3, friction_coefficient=0.15)
    ax = plot_force(scene, figure.Figure().add_subplot(), model="table")
    lines = {one.get_label(): one.get_data() for one in ax.lines}
    x, y = lines["projected, error unknown"]
    shown = np.isfinite(y)
    assert shown.any()
    force = cutting_force(replace(scene, wire_radius=1e-3 * x[shown]), "table")
    np.testing.assert_allclose(y[shown], force.total, rtol=1e-12)
    assert np.isnan(force.law_error).all()


def test_a_promise_of_the_unknown_is_refused_and_the_other_laws_promise_named(unknown):
    with pytest.raises(AccuracyError, match=r"known to nobody; give law='projected'"):
        cutting_force(WIRES, rtol=0.5)
    assert np.all(cutting_force(WIRES, rtol=0.5, law="projected").fit_error <= 0.5)


def test_the_commands_print_law_error_and_doubt(coupled, capsys):
    common = ["--shear-modulus", "5kPa", "--toughness", "1J/m2", "--wear-strength", "0.5kPa"]
    common += ["--friction-coefficient", "0.02", "--stiffening-exponent", "4"]
    wires = ["--wire-radius", "0.01mm", "2mm"]
    assert main(["force", *common, *wires]) == 0
    said = capsys.readouterr().out
    assert "law chosen for each wire" in said
    assert re.search(r"projected  [0-9.]+ % +unknown", said)
    assert "Note: at 1 of 2 points the error of the force is unknown" in said
    assert main(["force", *common, *wires, "--model", "eq13"]) == 0
    assert "Note" not in capsys.readouterr().out
    assert main(["regime", *common, *wires]) == 0
    assert "Note: at 1 of 2 points" in capsys.readouterr().out
    axes = ["--x", "g", "0.01", "10", "--y", "xi", "0.001", "1", "--fix", "alpha=4", "tau_w/mu=0.1"]
    assert main(["map", *axes, "--model", "table", "--nodes", "11"]) == 0
    said = capsys.readouterr().out
    assert "law" in said
    assert "points the error of the force is unknown" in said


def test_one_scene_has_the_law_of_the_same_scene_among_others():
    dice = np.random.default_rng(8)
    limits = force_model("table").limits
    alpha = dice.uniform(2.4, 9.0, 300)
    g = np.exp(dice.uniform(np.log(limits.g[0] * 1.01), np.log(30.0), 300))
    wear, xi = 10 ** dice.uniform(-3, 0, 300), 10 ** dice.uniform(-4, -1.3, 300)
    many = cutting_force(Scene(1.0, g, 1.0, xi, wear, alpha), "table")
    for i in range(300):
        one = cutting_force(Scene(1.0, g[i], 1.0, xi[i], wear[i], alpha[i]), "table")
        assert one.laws == many.laws[i]
        assert one.total == pytest.approx(many.total[i], rel=1e-12)
    assert set(many.laws) == {"projected", "slip", "coupled"}

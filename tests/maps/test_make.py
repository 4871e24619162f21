"""Regime maps: they agree with `classify`, and their boundaries are where they say."""

import math

import numpy as np
import pytest

from surrogate import (
    DomainError,
    InputError,
    Scene,
    UnknownModelError,
    WirecutError,
    classify,
    cutting_force,
    transition_radius,
)
from surrogate.cutting.regimes import DOMINANCES, PARTS, term_shares
from surrogate.maps.axes import COORDINATES, map_axis
from surrogate.maps.lines import contours, exact_lines
from surrogate.maps.make import regime_map
from surrogate.maps.scenes import Monomial

GEL = {"shear_modulus": 685.0, "wear_strength": 7750.0, "friction_coefficient": 0.1}
LOG = ("log", "log")
CASES = {
    "gel": ("wire_radius", "toughness", ((1e-6, 1e-2), (0.01, 100.0)), GEL, LOG),
    "lengths": ("R_w/l_e", "R_w/l_w", ((1e-4, 10.0), (1e-2, 100.0)), {"xi": 0.1}, LOG),
    "groups": ("g", "tau_w/(xi mu)", ((1e-2, 1e2), (1e-2, 1e2)), {"xi": 0.3}, LOG),
    "friction": ("xi", "g", ((1e-2, 10.0), (1e-2, 1e2)), {"tau_w/mu": 0.5}, LOG),
    "linear": (
        "R_w",
        "tau_w",
        ((0.0, 5e-4), (0.0, 1e4)),
        {"mu": 685, "Gamma_o": 1.6},
        ("linear",) * 2,
    ),
    "stiffening": (
        "alpha",
        "g",
        ((2.0, 9.0), (0.01, 10.0)),
        {"xi": 1, "tau_w/mu": 1},
        ("linear", "log"),
    ),
}


def make(case, **options):
    x, y, ranges, fixed, scales = CASES[case]
    return regime_map(x, y, ranges, fixed, **{"scales": scales, "nodes": 41, **options})


def boundaries(made, kind, about=None):
    return [b for b in made.boundaries if b.kind == kind and about in (None, b.about)]


def share_of(scene, name, model):
    """The share of a term in the force, from the equation rather than from the map."""
    if model != "eq13":
        force = cutting_force(scene, model=model)
        return getattr(force, name) / force.total
    gamma, xi, radius = scene.toughness, scene.friction_coefficient, scene.wire_radius
    terms = {
        "toughness-and-friction": (1.0 + xi) * gamma,
        "wear": 4.0 * scene.wear_strength * radius,
        "friction-stiffness": 4.0 * xi * scene.shear_modulus * radius,
    }
    return terms[name] / sum(terms.values())


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("model", ["eq13", "low-toughness", "eq9"])
def test_a_map_never_disagrees_with_classify(case, model):
    made = make(case, model=model)
    rng = np.random.default_rng(7)
    for _ in range(25):
        i, j = rng.integers(made.y.values.size), rng.integers(made.x.values.size)
        here = made.scene_at(made.x.values[j], made.y.values[i])
        regime = classify(here, model=model)
        assert made.regime.dominant[i, j] == regime.dominant
        assert made.regime.contact[i, j] == regime.contact
        force = cutting_force(here, model=model)
        assert made.force.total[i, j] == pytest.approx(force.total, rel=1e-13)
        assert made.force.in_domain[i, j] == force.in_domain


@pytest.mark.parametrize("case", CASES)
def test_the_scenes_have_the_coordinates_of_the_map(case):
    made = make(case)
    x, y = made.locate(made.scene)
    shape = made.y.values.size, made.x.values.size
    np.testing.assert_allclose(np.broadcast_to(x, shape), made.x.values + np.zeros(shape), 1e-13)
    np.testing.assert_allclose(
        np.broadcast_to(y, shape), made.y.values[:, None] + np.zeros(shape), 1e-13
    )
    for name, value in made.fixed.items():
        powers = COORDINATES[name].powers
        found = math.prod(getattr(made.scene, one) ** float(p) for one, p in powers.items())
        np.testing.assert_allclose(found, value, rtol=1e-13)


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("model", ["eq13", "low-toughness", "eq9"])
def test_on_its_boundary_a_term_has_its_share(case, model):
    made = make(case, model=model)
    for one in made.boundaries:
        for line in one.lines:
            scene = made.scene_at(*line[1:-1].T)
            tolerance = 1e-9 if one.exact else 2e-2
            if one.kind == "equal-terms":
                shares = [share_of(scene, name, model) for name in one.about]
                np.testing.assert_allclose(*shares, rtol=tolerance)
            elif one.kind == "dominance":
                np.testing.assert_allclose(share_of(scene, *one.about, model), 2 / 3, tolerance)
            elif one.kind == "limit":
                limit = cutting_force(scene, model=one.about[0]).total
                off = limit / cutting_force(scene, model=model).total - 1.0
                np.testing.assert_allclose(np.abs(off), 0.1, rtol=tolerance * 10)
            else:
                np.testing.assert_allclose(scene.dimensionless_toughness, 1.0, tolerance)


@pytest.mark.parametrize("case", ["gel", "lengths", "groups", "friction"])
def test_the_regime_changes_across_a_boundary_of_dominance(case):
    made = make(case)
    assert boundaries(made, "dominance")
    for one in boundaries(made, "dominance"):
        for line in one.lines:
            middle = line[len(line) // 2]
            steps = np.array([[1, 1], [1, -1], [-1, 1], [-1, -1], [1, 0], [0, 1], [-1, 0], [0, -1]])
            around = middle * (1.0 + 1e-6 * steps)
            found = set(classify(made.scene_at(*around.T), model="eq13").dominant)
            assert found == {"transition", *one.about}


def test_the_transition_radius_is_on_the_map():
    made = make("gel")
    (line,) = boundaries(made, "equal-terms", ("toughness-and-friction", "wear"))[0].lines
    # with stiffness added to wear, the radius is a little smaller than this line's
    scene = Scene(685.0, line[3, 1], 1.0, 0.0, 7750.0)
    assert line[3, 0] == pytest.approx(1.1 * transition_radius(scene, "eq13"), rel=1e-12)


def test_exact_lines_and_contours_agree():
    made = make("lengths", nodes=201)
    one = boundaries(made, "dominance", ("toughness-and-friction",))[0]
    traced = contours(made.term_shares["toughness-and-friction"], 2 / 3, made.x, made.y)
    (line,), (exact,) = traced, one.lines
    order = np.argsort(line[:, 0])
    inner = (exact[:, 1] > 0.0101) & (exact[:, 0] > 1.01e-4)
    x = np.log(exact[inner, 0])
    y = np.interp(x, np.log(line[order, 0]), np.log(line[order, 1]))
    away = np.abs(y - np.log(exact[inner, 1])) < 0.02
    flat = exact[inner, 1] > 0.03  # a steep line is no function of x
    assert flat.sum() > 50
    assert away[flat].all()


def test_what_two_powers_cannot_solve_is_a_contour():
    made = regime_map(
        "tau_w/(xi mu)",
        "R_w",
        ((0.01, 100.0), (1e-5, 1.0)),
        {"mu": 685.0, "tau_w": 7750.0, "Gamma_o": 1.6},
        nodes=61,
    )  # xi is 1/x here: (1 + xi) Gamma_o and 4 xi mu R_w still solve for R_w
    assert all(one.exact for one in boundaries(made, "equal-terms"))
    x = map_axis("g", (0.1, 10.0), "log", 31)
    three = tuple(Monomial(c, p, p) for c, p in ((1.0, 1), (-3.0, 0), (1.0, 2)))
    assert exact_lines(three, x, x) is None


def test_lines_end_on_the_edge_of_the_map():
    made = make("lengths")
    for one in made.boundaries:
        for line in one.lines:
            for x, y in (line[0], line[-1]):
                at_edge = [
                    min(abs(math.log(v / axis.values[0])), abs(math.log(v / axis.values[-1])))
                    for v, axis in ((x, made.x), (y, made.y))
                ]
                assert min(at_edge) < 1e-9, one.equation


def test_shares_add_up_and_know_their_terms():
    made = make("gel")
    total = made.cleavage_share + made.friction_share + made.wear_share
    np.testing.assert_allclose(total, 1.0, rtol=1e-14)
    assert tuple(made.term_shares) == DOMINANCES[1:]
    other = make("gel", model="low-toughness")
    assert tuple(other.term_shares) == PARTS[1:]
    np.testing.assert_array_equal(other.term_shares["wear"], other.wear_share)
    np.testing.assert_allclose(
        sum(term_shares(made.scene, made.force, "eq13").values()), 1.0, rtol=1e-14
    )
    np.testing.assert_allclose(
        made.relative_force, made.force.total / made.scene.toughness, rtol=1e-15
    )


def test_validity_and_difference_of_a_limit():
    made = make("gel", model="low-toughness")
    assert made.force.relative_error is None
    g = made.scene.dimensionless_toughness
    np.testing.assert_array_equal(made.force.in_domain, g <= 1.0)
    expected = cutting_force(made.scene, "eq13").total / made.force.total - 1.0
    np.testing.assert_array_equal(made.difference("eq13"), expected)
    assert made.force.in_domain.any()
    assert not made.force.in_domain.all()


def test_groups_alone_give_forces_in_their_own_units():
    assert make("lengths").force_unit == "mu R_w"
    assert make("gel").force_unit == "N/m"
    half = regime_map("R_w", "g", ((1e-4, 1e-3), (1, 10)), {"tau_w/mu": 1}, nodes=3)
    assert (half.units, half.force_unit) == (("shear_modulus",), "mu m")


def test_without_friction_there_is_no_boundary_of_friction():
    made = regime_map("R_w", "Gamma_o", ((1e-5, 1e-3), (0.1, 10)), {"mu": 685.0, "tau_w": 7750.0})
    assert [b.about for b in made.boundaries if b.kind == "equal-terms"] == [DOMINANCES[1:3]]
    nothing = regime_map("R_w", "Gamma_o", ((1e-5, 1e-3), (0.1, 10)), {"mu": 685.0})
    assert [b.kind for b in nothing.boundaries] == ["contact"]
    assert set(nothing.regime.dominant.flat) == {"toughness-and-friction"}


def test_terms_that_are_equal_everywhere_have_no_line():
    made = regime_map("g", "xi", ((0.1, 10), (0.1, 10)), {"tau_w/(xi mu)": 1.0})
    assert not boundaries(made, "equal-terms", ("wear", "friction-stiffness"))


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("sharpness", "g", ((1, 2), (1, 2))), "choose one of shear_modulus"),
        (("g", "g", ((1, 2), (1, 2))), "two different axes"),
        (("g", "R_w/l_e", ((1, 2), (1, 2))), "R_w/l_e must be free"),
        (("R_w", "tau_w", ((1, 2), (1, 2))), "lacks shear_modulus and toughness"),
        (("g", "xi", ((2, 1), (1, 2))), "the range of g must rise"),
        (("g", "xi", ((0, 1), (1, 2))), "g must be finite and positive"),
        (("g", "xi", ((1, 2), (0, 2))), "positive on a log scale"),
        (("g", "xi", ((1, 2), (1, math.nan))), "friction_coefficient must be finite"),
        (("g", "xi", ((1, 2), (1, math.inf))), "friction_coefficient must be finite"),
        (("g", "xi", ((1, 2), 3)), "the range of friction_coefficient must be two numbers"),
        (("g", "xi", (1, 2, 3)), "ranges and scales must be pairs"),
        (("g", "xi", ((1, math.nextafter(1, 2)), (1, 2))), "hold 201 different nodes"),
        (("g", "xi", ((1, 2), (1, 2)), {"g": 3}), "is an axis and fixed"),
        (("g", "mu", ((1, 2), (1, 2)), {"xi": 1, "friction_coefficient": 1}), "fixed twice"),
        (("g", "mu", ((1, 2), (1, 2)), {"R_w": -1}), "wire_radius"),
        (("g", "mu", ((1, 2), (1, 2)), [1]), "fixed must be a mapping"),
        (("g", "tau_w/(xi mu)", ((1, 2), (1, 2)), {"xi": 0.0}), "must be positive where"),
        (("g", "mu", ((1e-300, 1e300), (1e-300, 1e300)), {"R_w": 1e-20}), "range of numbers"),
    ],
)
def test_what_makes_no_map_is_refused_in_words(arguments, words):
    with pytest.raises(InputError, match=words.replace("(", r"\(")):
        regime_map(*arguments)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"scales": ("log", "lin")}, "must be 'log' or 'linear'"),
        ({"scales": "log"}, "must be pairs"),
        ({"nodes": 2}, "whole number from 3"),
        ({"nodes": 1e3}, "whole number from 3"),
        ({"miss": 0.0}, "miss must be"),
        ({"miss": 1.0}, "miss must be"),
        ({"threshold": 0.5}, "more than 0.5"),
    ],
)
def test_options_out_of_range(options, words):
    with pytest.raises(InputError, match=words):
        make("gel", **options)


def test_unknown_models_and_alphas_without_answer():
    with pytest.raises(UnknownModelError, match="eq99"):
        make("gel", model="eq99")
    with pytest.raises(UnknownModelError, match="eq99"):
        make("gel", limits=("eq99",))
    with pytest.raises(DomainError, match="Table 1"):
        regime_map("alpha", "g", ((1, 9), (1, 9)), {"xi": 1}, "eq9")


def test_extreme_but_sound_ranges():
    made = regime_map("g", "xi", ((1e-300, 1e300), (1e-300, 1e300)), {"tau_w/mu": 1.0}, nodes=25)
    assert set(made.regime.dominant.flat) <= set(DOMINANCES)
    assert all(np.isfinite(line).all() for one in made.boundaries for line in one.lines)


def test_contours_without_contourpy_name_the_remedy(monkeypatch):
    monkeypatch.setattr("surrogate.basics.extras.find_spec", lambda name: None)
    assert make("gel").boundaries
    with pytest.raises(WirecutError, match=r"pip install 'wirecut\[plot\]'"):
        make("gel", model="eq9")


def test_csv_and_xarray_hold_the_same_numbers(tmp_path):
    made = make("gel", nodes=5)
    made.to_csv(tmp_path / "map.csv")
    lines = (tmp_path / "map.csv").read_text().splitlines()
    comments = [line for line in lines if line.startswith("# ")]
    assert "shear_modulus = 685.0 Pa" in comments[1]
    header = lines[len(comments)].split(",")
    assert header[:3] == ["wire_radius_m", "toughness_J_per_m2", "force_per_thickness_N_per_m"]
    cells = [line.split(",") for line in lines[len(comments) + 1 :]]
    assert len(cells) == 25
    table = dict(zip(header, zip(*cells, strict=True), strict=True))
    force = np.array(table["force_per_thickness_N_per_m"], dtype=float).reshape(5, 5)
    np.testing.assert_array_equal(force, made.force.total)
    assert list(table["dominant"]) == made.regime.dominant.ravel().tolist()
    assert set(table["in_domain"]) == {"yes"}

    pytest.importorskip("xarray")
    data = made.to_xarray()
    np.testing.assert_array_equal(data["force_per_thickness"], made.force.total)
    assert data["force_per_thickness"].attrs["units"] == "N/m"
    assert data["wire_radius"].attrs["units"] == "m"
    assert data["wear_share"].dims == ("toughness", "wire_radius")


def test_the_csv_of_the_boundaries(tmp_path):
    made = make("gel", nodes=5)
    made.boundaries_to_csv(tmp_path / "lines.csv")
    lines = [line for line in (tmp_path / "lines.csv").read_text().splitlines() if line[0] != "#"]
    assert lines[0] == "line,kind,equation,exact,wire_radius_m,toughness_J_per_m2"
    assert len(lines) - 1 == sum(len(line) for one in made.boundaries for line in one.lines)
    assert lines[1].startswith("1,equal-terms,(1 + xi) Gamma_o = 4 tau_w R_w,yes,")
    with pytest.raises(InputError, match="cannot be written"):
        made.to_csv(tmp_path / "missing" / "map.csv")

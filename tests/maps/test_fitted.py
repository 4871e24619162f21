"""Regime maps of fitted models: contours, the touch of the tip, and what is outside the domain."""

import numpy as np
import pytest

from surrogate import Scene, classify, cutting_force, regime_map
from surrogate.cutting.regimes import PARTS, touching_toughness

MODELS = ("power-law", "table", "gp", "auto")
INSIDE = ((1e-2, 50.0), (1e-2, 100.0))


def groups(model, ranges=INSIDE, **options):
    return regime_map("g", "tau_w/(xi mu)", ranges, {"xi": 0.3}, model, nodes=61, **options)


@pytest.mark.parametrize("law", ["projected", "slip", "auto"])
@pytest.mark.parametrize("model", MODELS)
def test_a_map_never_disagrees_with_classify(installed, model, law):
    made = groups(model, law=law)
    rng = np.random.default_rng(3)
    for _ in range(20):
        i, j = rng.integers(61), rng.integers(61)
        here = made.scene_at(made.x.values[j], made.y.values[i])
        regime = classify(here, model=model, law=law)
        assert (made.regime.dominant[i, j], made.regime.contact[i, j]) == (
            regime.dominant,
            regime.contact,
        )
        total = cutting_force(here, model, law=law).total
        assert made.force.total[i, j] == pytest.approx(total, rel=1e-12)
    assert set(made.regime.dominant.flat) <= set(PARTS)
    assert np.all(made.force.in_domain)


@pytest.mark.parametrize("model", ["power-law", "table", "gp"])
def test_boundaries_are_contours_on_which_the_model_says_so(installed, model):
    made = groups(model)
    kinds = set()
    for one in made.boundaries:
        for line in one.lines:
            scene = made.scene_at(*line[1:-1].T)
            force = cutting_force(scene, model)
            kinds.add(one.kind)
            if one.kind == "equal-terms":
                left, right = (getattr(force, name) for name in one.about)
                np.testing.assert_allclose(left, right, rtol=3e-3)
            elif one.kind == "dominance":
                np.testing.assert_allclose(getattr(force, *one.about) / force.total, 2 / 3, 3e-3)
            elif one.kind == "limit":
                limit = cutting_force(scene, one.about[0])
                np.testing.assert_allclose(np.abs(limit.total / force.total - 1), 0.1, atol=3e-3)
            else:
                g_touch = touching_toughness(model, 2.0)
                assert 1.0 < g_touch < 5.0
                np.testing.assert_allclose(scene.dimensionless_toughness, g_touch, rtol=1e-9)
    assert kinds == {"equal-terms", "dominance", "limit", "contact"}
    assert any(one.about == ("eq13",) for one in made.boundaries)


def test_the_touch_changes_with_alpha(installed):
    fixed = {"xi": 0.3, "tau_w/mu": 1.0}
    made = regime_map(
        "alpha", "g", ((2.0, 9.0), (0.1, 50.0)), fixed, "table", scales=("linear", "log")
    )
    (one,) = [each for each in made.boundaries if each.kind == "contact"]
    assert (one.exact, one.equation) == (False, "g = g_touch")
    for alpha, g in one.lines[0][1:-1:20]:
        below, above = (Scene(1.0, g * f, 1.0, stiffening_exponent=alpha) for f in (0.99, 1.01))
        assert classify(below, model="table").contact == "far-field"
        assert classify(above, model="table").contact == "indentation"


def test_outside_its_domain_a_map_goes_on_and_says_so(installed):
    made = groups("table", ((1e-4, 1e4), (1e-2, 100.0)))
    inside = made.force.in_domain
    assert 0.2 < inside.mean() < 0.8
    assert np.all(np.isfinite(made.force.total))
    g = np.broadcast_to(made.scene.dimensionless_toughness, inside.shape)
    assert g[inside].min() > 4e-3
    assert g[inside].max() < 61.0


def test_the_error_bound_of_auto_is_on_the_map(installed):
    made = groups("auto", rtol=0.3, law="projected")
    assert made.force.fit_error.shape == (61, 61)
    assert np.nanmax(made.force.fit_error) <= 0.3


def test_pictures(installed, tmp_path):
    pytest.importorskip("matplotlib")
    from surrogate.maps.figure import save_regime_map

    made = groups("table", ((1e-3, 1e3), (1e-2, 100.0)))
    save_regime_map(made, tmp_path / "map.png", error_of="eq13")
    save_regime_map(made, tmp_path / "limits.png", limits=("eq13", "high-toughness"))
    assert (tmp_path / "limits.png").stat().st_size > 10000

"""The figure: what it shows, what it leaves alone, and that nothing lies on anything else."""

from functools import partial

import numpy as np
import pytest

import surrogate
from surrogate import plot_identification
from surrogate.errors import InputError, WirecutError
from surrogate.identification.figure import SINGLE_COLUMN, save_identification

identify = partial(surrogate.identify, model="eq13")

matplotlib = pytest.importorskip("matplotlib")
Figure = pytest.importorskip("matplotlib.figure").Figure
matplotlib.use("agg")

RADIUS = np.array([0.1, 0.2, 0.3, 0.5]) * 1e-3
RISING = [4.9, 7.2, 11.8, 16.5]
FALLING = [9.0, 7.2, 6.1, 3.9]


def draw(force, **options):
    fit = identify(RADIUS, force, 685.0, **options)
    ax = Figure(figsize=SINGLE_COLUMN, layout="constrained").add_subplot()
    return fit, plot_identification(fit, ax, pure_shear_toughness=2.6)


def labels(ax):
    return [text.get_text() for text in ax.get_legend().get_texts()]


def test_fit_band_references_and_measurements_are_shown():
    fit, ax = draw(RISING, force_std=0.5)
    shown = labels(ax)
    assert shown[0] == "measured"
    assert f"{fit.toughness:.3g} J/m" in shown[1]
    assert shown[2] == "95 % band"
    assert "2.6 J/m" in shown[3]
    assert f"{1e6 * fit.transition_radius:.3g} µm" in shown[4]
    drawn = [line.get_ydata() for line in ax.get_lines() if len(line.get_ydata()) > 100]
    assert len(drawn) == 1
    assert drawn[0][0] == pytest.approx(fit.toughness, rel=1e-4)


def test_no_transition_radius_where_an_estimate_is_negative():
    _, ax = draw(FALLING)
    assert not any("R_w^*" in label for label in labels(ax))


@pytest.mark.parametrize("force", [RISING, FALLING])
def test_nothing_overlaps_and_nothing_is_cut_off(force):
    _, ax = draw(force, force_std=0.5)
    figure = ax.figure
    figure.draw_without_rendering()
    legend = ax.get_legend().get_window_extent()
    assert not legend.overlaps(ax.get_window_extent())
    whole = figure.bbox
    for box in (legend, ax.get_tightbbox()):
        assert whole.x0 <= box.x0
        assert box.x1 <= whole.x1
        assert whole.y0 <= box.y0
        assert box.y1 <= whole.y1
    assert ax.get_ylim()[0] <= 0.0
    assert ax.get_xlim()[1] > 1e3 * RADIUS.max()


def test_returns_the_axes_given_and_leaves_the_rest_alone():
    before = matplotlib.rcParams.copy()
    _, ax = draw(RISING)
    assert matplotlib.rcParams == before
    new = plot_identification(identify(RADIUS, RISING, 685.0))
    assert new is not ax
    matplotlib.pyplot.close(new.figure)


def test_what_cannot_be_drawn_is_refused_before_drawing():
    fit, ax = draw(RISING)
    with pytest.raises(InputError, match=r"must be what identify returned, but is 1\.6"):
        plot_identification(1.6, ax)
    with pytest.raises(InputError, match=r"pure_shear_toughness = -2.6 J/m\^2"):
        plot_identification(fit, ax, pure_shear_toughness=-2.6)
    with pytest.raises(InputError, match="a file must be named by text or a path"):
        save_identification(fit, None)


def test_missing_matplotlib_is_told_with_the_remedy(monkeypatch, tmp_path):
    monkeypatch.setattr("surrogate.basics.extras.find_spec", lambda name: None)
    with pytest.raises(WirecutError, match=r"pip install 'wirecut\[plot\]'"):
        save_identification(identify(RADIUS, RISING, 685.0), tmp_path / "fit.png")


def test_the_other_materials_that_fit_are_drawn_too():
    radius = np.array([0.125e-3, 0.21e-3, 0.275e-3, 0.39e-3, 0.47e-3])
    fit = surrogate.identify(radius, 1.6 + 31e3 * radius, 685.0)
    ax = Figure(layout="constrained").add_subplot()
    plot_identification(fit, ax)
    others = [mode for mode in fit.profile.modes[1:] if mode.admitted]
    assert others
    shown = [label for label in labels(ax) if label.startswith("or ")]
    assert len(shown) == len(others)
    assert all(f"{m.toughness:.2g}" in label for m, label in zip(others, shown, strict=True))
    assert any(f"{1e6 * fit.model_transition_radius:.3g} µm" in label for label in labels(ax))

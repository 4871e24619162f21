"""Pictures of the coupled solutions: which rows are on them, and that the command draws them."""

from types import SimpleNamespace

import numpy as np
import pytest
from made_up_coupled import LARGEST, SHARES

from fe_training.coupled.__main__ import main
from fe_training.coupled.pictures.balance import balance_figure
from fe_training.coupled.pictures.solutions import (
    PICTURES,
    draw_pictures,
    ends_figure,
    kappa_figure,
    rays,
)
from fe_training.coupled.pictures.tip import friction_limits, places_with_notches, tip_figure
from surrogate import InputError
from surrogate.basics.figures import new_figure
from surrogate.contact.archive import read_fitted
from surrogate.coupling.shipped import AMPLIFICATION_FILE, amplification_of

pytest.importorskip("matplotlib")


def changed(data, rows, **values):
    columns = {name: column.copy() for name, column in data.columns.items()}
    for name, value in values.items():
        columns[name][rows] = value
    return type(data)(columns, data.attributes)


def test_a_ray_has_its_equilibria_once_in_the_order_of_their_loads(made_up):
    paths = rays(made_up, LARGEST)
    assert len(paths) == 45
    for ray in paths:
        assert len(ray.kappa) == len(SHARES)
        assert (np.diff(ray.friction + ray.wear) > 0.0).all()
        assert 0.0 <= ray.direction <= 1.0
    assert {ray.base for ray in paths if ray.held_out} == {4, 9, 14}


def test_a_path_that_ended_shows_its_last_equilibrium_once(made_up):
    columns = made_up.columns
    last = {name: columns[name][1] for name in ("friction", "wear", "slip_arc", "slip_load")}
    ended = changed(made_up, [2], outcome="LIMIT", **last)
    first = rays(ended, LARGEST)[0]
    assert first.outcome == "LIMIT"
    assert len(first.kappa) == 2
    assert first.friction[-1] == columns["friction"][1]


def test_a_path_without_an_equilibrium_is_not_drawn(made_up):
    lost = changed(made_up, [0, 1, 2], friction=np.nan, wear=np.nan, steady_force=np.nan)
    assert len(rays(lost, LARGEST)) == 44
    with pytest.raises(InputError, match="no equilibrium to draw"):
        draw_pictures(
            changed(made_up, slice(None), friction=np.nan),
            SimpleNamespace(load_unit=LARGEST),
            None,
            None,
        )


def with_three_notches(data):
    """Made-up rows of one place with the notches of three bases, and the limits of friction."""
    rows = np.flatnonzero(data["base"] < 3)
    notch = np.array([1e-2, 1e-3, 1e-4])[data["base"][rows]]
    here = changed(data, rows, alpha=2.0, target=3.0, notch_radius=notch, wear=0.0)
    friction = np.array([0.04, 0.03, 0.02])
    ends = [np.flatnonzero(here["base"] == i)[-1] for i in range(3)]
    return changed(here, ends, outcome="LIMIT", friction=friction, wear=0.0)


def test_the_limit_of_friction_is_shown_over_the_radius_of_the_notch(made_up):
    data = with_three_notches(made_up)
    ((place, radii),) = places_with_notches(data).items()
    assert place == (2.0, 3.0)
    assert radii.tolist() == [1e-2, 1e-3, 1e-4]
    assert friction_limits(data, place, radii).tolist() == [0.04, 0.03, 0.02]
    figure = new_figure((7.0, 3.0))
    tip_figure(data, figure)
    line = figure.axes[0].lines[0]
    assert line.get_ydata().tolist() == [0.04, 0.03, 0.02]
    assert not places_with_notches(made_up)


def test_the_marks_of_kappa_are_the_rows(made_up, fitted_folder):
    kappa = amplification_of(*read_fitted(str(fitted_folder.path / AMPLIFICATION_FILE)))
    figure = new_figure((7.0, 3.0))
    kappa_figure(made_up, kappa, figure)
    left = figure.axes[0]
    everything = made_up.amplification
    drawn = [line for line in left.lines if len(line.get_xdata())]
    marks = [line for line in drawn if line.get_linestyle() == "None"]
    assert len(marks) >= 6
    for line in marks:
        for x, y in zip(*line.get_data(), strict=True):
            assert np.isclose(everything[np.isclose(made_up["friction"], x)], y).any()
    curves = [line for line in drawn if line.get_linestyle() == "-"]
    assert curves
    assert all(np.isfinite(line.get_ydata()).all() for line in curves)


def test_each_end_is_marked_once_over_the_loads(made_up, fitted_folder):
    kappa = amplification_of(*read_fitted(str(fitted_folder.path / AMPLIFICATION_FILE)))
    figure = new_figure((7.0, 3.0))
    ends_figure(changed(made_up, [2], outcome="CREASED"), kappa, figure)
    loads = figure.axes[2]
    assert sum(len(line.get_xdata()) for line in loads.lines) == 45
    words = [text.get_text() for text in figure.legends[0].get_texts()]
    assert "creased" in words
    assert "stalled" not in words


def test_the_picture_of_the_balance_is_of_the_shipped_rows():
    from fe_training.campaign.dataset import load_campaign

    campaign = load_campaign()
    figure = new_figure((7.0, 3.0))
    balance_figure(campaign, figure)
    curves = [line for line in figure.axes[1].lines if "lambda" in line.get_label()]
    assert len(curves) == 3
    for line in curves:
        degrees, stretch = line.get_data()
        inside = np.isfinite(degrees)
        # the surface slips farther than its projection all along the contact
        assert (stretch[inside] > np.sin(np.radians(degrees[inside]))).all()


def test_the_command_draws_the_models_in_use(fitted_folder, tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("WIRECUT_MODELS", str(fitted_folder.path))
    assert main(["models/coupled.toml", "--figures", str(tmp_path / "pictures")]) == 0
    files = capsys.readouterr().out.split()
    assert [file.rpartition("/")[2] for file in files] == [f"{name}.png" for name in PICTURES]
    assert all((tmp_path / "pictures" / f"{name}.png").stat().st_size > 5000 for name in PICTURES)

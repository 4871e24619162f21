"""All figures of both packages are made, lettered and written by one module."""

import re
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("matplotlib")

from surrogate import identify
from surrogate.basics.figures import label_at_right, new_figure, panels, style
from surrogate.basics.picture_form import PictureForm, pictures_as
from surrogate.identification.figure import save_identification

ROOT = Path(__file__).resolve().parent.parent.parent
FORCES = [4.7, 7.9, 13.9, 17.2]
RADII = [1e-4, 2e-4, 4e-4, 5e-4]


def test_nobody_else_writes_figures_or_sets_their_style():
    home = ROOT / "surrogate" / "basics" / "figures.py"
    for package in ("surrogate", "fe_training"):
        for path in (ROOT / package).rglob("*.py"):
            text = re.sub(r'"""(?s:.*?)"""', "", path.read_text(encoding="utf-8"))
            written = re.search(r"\.savefig\(|rcParams|rc_context|font\.size", text)
            assert path == home or not written, path


@pytest.mark.parametrize(("columns", "rows", "letters"), [(1, 1, ""), (2, 1, "ab"), (2, 2, "abcd")])
def test_panels_are_lettered_where_there_are_several(columns, rows, letters):
    with style():
        axes = panels(new_figure((4.0, 3.0)), columns, rows)
    assert axes.shape == (rows, columns)
    titles = [ax.get_title("left") for ax in axes.flat]
    assert titles == [f"({letter})" for letter in letters] or (titles == [""] and not letters)


def test_words_at_the_right_keep_a_lines_height_apart():
    figure = new_figure((3.4, 2.9))
    ax = figure.add_subplot()
    ax.set_ylim(0.0, 1.0)
    label_at_right(ax, [(0.5, "a"), (0.5, "b"), (0.51, "c"), (0.9, "d")])
    figure.draw_without_rendering()
    boxes = sorted((text.get_window_extent() for text in ax.texts), key=lambda box: box.y0)
    assert all(low.y1 <= high.y0 + 1.0 for low, high in pairwise(boxes))
    assert all(box.x1 <= figure.bbox.x1 for box in boxes)


def test_one_panel_on_request_and_repeats_that_do_not_hide_each_other(tmp_path):
    fit = identify([*RADII, *RADII], [*FORCES, *np.add(FORCES, 0.1)], 685.0)
    for single in (False, True):
        with pictures_as(PictureForm(single_panel=single)):
            save_identification(fit, tmp_path / f"{single}.svg")
    two, one = ((tmp_path / f"{single}.svg").read_text() for single in (False, True))
    assert two.count('id="axes_') == 2
    assert one.count('id="axes_') == 1
    assert "(b)" in two
    assert "(a)" not in one


def test_a_legend_in_somebody_elses_figure_stands_inside_its_axes():
    pytest.importorskip("matplotlib")
    from matplotlib.figure import Figure

    from surrogate.basics.figures import legend_above

    for layout, inside in (("constrained", False), (None, True)):
        figure = Figure(figsize=(6.0, 3.0), layout=layout)
        ax = figure.subplots(1, 2)[0]
        ax.plot([0.0, 1.0], [0.0, 1.0], label="a line")
        legend_above(ax, 2)
        figure.draw_without_rendering()
        legend, window = ax.get_legend().get_window_extent(), ax.get_window_extent()
        assert bool(legend.y1 <= window.y1) is inside
        assert legend.y1 <= figure.bbox.y1

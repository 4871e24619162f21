"""Figures of regime maps: what they show, that nothing overlaps, and that files do not change."""

import re
import zlib
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from surrogate import InputError, Scene, UnknownModelError, WirecutError, regime_map
from surrogate.basics.figures import FILLS
from surrogate.cutting.regimes import DOMINANCES, PARTS
from surrogate.maps.drawing import ERROR_COLOURS
from surrogate.maps.figure import plot_regime_map, save_regime_map
from surrogate.maps.labels import GRID, NAMES, best_place, best_turned_place, blocked_by_line
from surrogate.maps.points import MapPoints, places

matplotlib = pytest.importorskip("matplotlib")
Figure = pytest.importorskip("matplotlib.figure").Figure
matplotlib.use("agg")

PAAM = Scene(685.0, 1.6, [0.125e-3, 0.210e-3, 0.275e-3, 0.390e-3, 0.470e-3], 0.0, 7750.0)
EXPERIMENT = MapPoints(PAAM, "PAAm", std={"toughness": 0.2})


def lengths(**options):
    ranges = ((1e-4, 100.0), (1e-2, 100.0))
    return regime_map("R_w/l_e", "R_w/l_w", ranges, {"xi": 0.1}, **{"nodes": 61, **options})


def gel(**options):
    ranges, fixed = ((1e-5, 1e-2), (0.05, 50.0)), {"mu": 685.0, "tau_w": 7750.0}
    return regime_map("R_w", "Gamma_o", ranges, fixed, **{"nodes": 61, **options})


def draw(made, *arguments, **options):
    figure = Figure(figsize=(3.4, 3.5), layout="constrained")
    return plot_regime_map(made, figure.add_subplot(), *arguments, **options)


def legend(ax):
    return [text.get_text() for text in ax.get_legend().get_texts()]


def written(ax):
    return {text.get_text() for text in inside(ax)}


def inside(ax):
    """Return the words on the map, without those below it that tell what it fixes."""
    return [text for text in ax.texts if text.get_gid() != "fixed"]


def inside_text(text, points):
    """Which points of the screen [pixel] are in the box of a text, turned as it is."""
    whole, angle = text.get_window_extent(), np.radians(text.get_rotation())
    text.set_rotation(0.0)
    box = text.get_window_extent()
    text.set_rotation(np.degrees(angle))  # that of the screen, where the axes' is another
    if text.get_transform_rotates_text():
        text.set_transform_rotates_text(False)
    np.testing.assert_allclose(text.get_window_extent().extents, whole.extents, atol=0.5)
    away = points - np.mean([[whole.x0, whole.y0], [whole.x1, whole.y1]], axis=0)
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    return (np.abs(away @ turn) < [0.5 * box.width, 0.5 * box.height]).all(1)


def test_regions_are_named_and_lines_carry_their_equation():
    ax = draw(lengths())
    assert written(ax) == {NAMES[name] for name in DOMINANCES}
    assert [text for text in legend(ax) if "Gamma_o=4" in text.replace(r"\,", "")]
    assert any("g=1" in text for text in legend(ax))
    assert not any("Eq." in text for text in legend(ax))
    assert not any("g=1" in text for text in legend(draw(lengths(), contact=False)))
    assert legend(draw(lengths(threshold=0.75))).count(r"a term$=0.75\,F_{ss}/T$") == 1


def test_a_region_too_small_for_its_name_is_in_the_legend():
    narrow = regime_map("R_w", "Gamma_o", ((1e-6, 1e-2), (1e-5, 1e4)), {"mu": 685, "tau_w": 7750})
    ax = draw(narrow)
    assert "transition" not in written(ax)
    assert "transition" in legend(ax)
    of_errors = draw(narrow, error_of="low-toughness")  # where its colour means an error
    assert "transition" not in legend(of_errors)


@pytest.mark.parametrize("width", ["single", "double"])
def test_a_narrow_region_is_named_along_its_boundary(width, tmp_path):
    figure = Figure(figsize=(3.4, 3.5) if width == "single" else (7.0, 5.0), layout="constrained")
    ax = plot_regime_map(gel(), figure.add_subplot(), width=width)
    name = next(text for text in ax.texts if text.get_text() == "transition")
    line = next(line for line in ax.get_lines() if line.get_linewidth() > 1.0)
    first, last = ax.transData.transform(line.get_xydata()[[0, -1]])
    angle = np.degrees(np.arctan2(*(last - first)[::-1]))
    assert name.get_rotation() == pytest.approx(angle, abs=0.5)
    assert 20.0 < angle < 60.0


def test_names_keep_away_from_experiments():
    ax = draw(gel(), [EXPERIMENT])
    wear = next(text for text in ax.texts if text.get_text() == "wear").get_window_extent()
    assert ax.containers
    points = ax.transData.transform(ax.containers[0][0].get_xydata())
    gap = np.maximum([wear.x0, wear.y0] - points, points - [wear.x1, wear.y1]).max(axis=1)
    assert gap.min() > 0.03 * ax.get_window_extent().height


def test_limits_are_drawn_where_asked_for():
    ax = draw(lengths(miss=0.05), limits=("high-toughness", "friction-free"))
    assert {"Eq. (10) off by 5 %", "Eq. (15) off by 5 %"} <= set(legend(ax))


def test_lengths_are_shown_in_mm_and_points_with_their_bars():
    ax = draw(gel(), [EXPERIMENT])
    assert ax.get_xlabel() == "wire radius $R_w$ [mm]"
    np.testing.assert_allclose(ax.get_xlim(), [1e-2, 10.0])
    assert "PAAm" in legend(ax)
    (container,) = ax.containers
    np.testing.assert_allclose(container[0].get_xdata(), 1e3 * PAAM.wire_radius)
    segments = container[2][0].get_segments()
    np.testing.assert_allclose([s[:, 1] for s in segments], [[1.4, 1.8]] * 5, rtol=1e-12)


def test_error_bars_are_those_of_a_product_of_powers():
    made = regime_map("g", "R_w/l_w", ((1e-2, 1e3), (1e-2, 100.0)), {"xi": 0.1}, nodes=5)
    std = {"toughness": 0.2, "shear_modulus": 30.0, "wear_strength": 500.0}
    centre, error = places(MapPoints(PAAM, "PAAm", std), made)
    np.testing.assert_allclose(centre[0], PAAM.dimensionless_toughness, rtol=1e-14)
    np.testing.assert_allclose(error[0] / centre[0], np.hypot(0.2 / 1.6, 30 / 685), rtol=1e-12)
    np.testing.assert_allclose(error[1] / centre[1], np.hypot(0.2 / 1.6, 500 / 7750), rtol=1e-12)


def test_outside_its_domain_a_model_is_hatched():
    ax = draw(gel(model="low-toughness"))
    assert "outside the domain" in legend(ax)
    assert "outside the domain" not in legend(draw(gel()))


def test_nodes_that_rounding_puts_beyond_an_edge_are_not_hatched():
    made = gel()
    for rows, hatched in ((1, False), (2, True)):
        holds = np.ones((61, 61), dtype=bool)
        holds[:rows, 10:20] = False
        force = replace(made.force, in_domain=holds)
        words = legend(draw(replace(made, force=force)))
        assert ("outside the domain" in words) is hatched


def test_an_axis_of_a_decade_has_numbers_without_powers():
    made = regime_map("R_w", "Gamma_o", ((1e-4, 1e-3), (1e-3, 1e2)), {"mu": 685, "tau_w": 7750})
    ax = draw(made)
    ax.figure.draw_without_rendering()
    words = [one.get_text() for one in ax.get_xticklabels() if 0.1 <= one.get_position()[0] <= 1.0]
    assert words == ["0.1", "0.2", "0.3", "0.5", "1"]
    assert not any(one.get_text() for one in ax.get_xticklabels(minor=True))
    assert any("10^" in one.get_text() for one in ax.get_yticklabels())


def test_the_error_of_a_formula_has_a_bar_of_colours():
    ax = draw(gel(model="low-toughness"), error_of="eq13")
    assert ax.figure.axes[1].get_ylabel() == "error of Eq. (13) [%]"


@pytest.mark.parametrize("width", ["single", "double"])
@pytest.mark.parametrize("case", ["lengths", "gel", "low-toughness", "error"])
def test_nothing_overlaps_and_nothing_is_cut_off(case, width):
    pytest.importorskip("matplotlib.pyplot")
    limited = {"low-toughness": "low-toughness", "error": "low-toughness"}
    made = gel() if case == "gel" else lengths(model=limited.get(case, "eq13"))
    ax = plot_regime_map(
        made,
        points=[EXPERIMENT] if case == "gel" else [],
        width=width,
        limits=("high-toughness",),
        error_of="eq13" if case == "error" else None,
    )
    figure = ax.figure
    figure.draw_without_rendering()
    axes, whole = ax.get_window_extent(), figure.bbox
    assert axes.width > 0.55 * whole.width
    assert not ax.get_legend().get_window_extent().overlaps(axes)
    for box in (ax.get_legend().get_window_extent(), ax.get_tightbbox()):
        assert whole.x0 <= box.x0
        assert box.x1 <= whole.x1
        assert whole.y0 <= box.y0
        assert box.y1 <= whole.y1
    (fixed,) = (text for text in ax.texts if text.get_gid() == "fixed")
    below = fixed.get_window_extent()
    assert whole.x0 <= below.x0
    assert whole.y0 <= below.y0
    assert not below.overlaps(ax.xaxis.label.get_window_extent())
    boxes = [text.get_window_extent() for text in inside(ax)]
    assert boxes
    for i, box in enumerate(boxes):
        assert axes.x0 < box.x0 < box.x1 < axes.x1
        assert axes.y0 < box.y0 < box.y1 < axes.y1
        assert not any(box.overlaps(other) for other in boxes[i + 1 :])
        for line in ax.get_lines():
            xy = ax.transData.transform(np.asarray(line.get_xydata(), dtype=float))
            joined = line.get_linestyle() != "None"
            if joined and line.get_linewidth() > 0.5 and len(xy) > 1:
                along = np.linspace(0.0, 1.0, 50)[:, None]
                dense = np.concatenate([a + along * (b - a) for a, b in pairwise(xy)])
                assert not inside_text(inside(ax)[i], dense).any(), inside(ax)[i].get_text()
    matplotlib.pyplot.close(figure)


@pytest.mark.parametrize("ending", ["png", "pdf", "svg"])
def test_two_runs_write_the_same_bytes(ending, tmp_path):
    for name in ("one", "two"):
        save_regime_map(gel(model="low-toughness"), tmp_path / f"{name}.{ending}", [EXPERIMENT])
    one, two = (tmp_path / f"{name}.{ending}" for name in ("one", "two"))
    assert one.read_bytes() == two.read_bytes()


def test_text_stays_text_and_fonts_are_embedded(tmp_path):
    save_regime_map(lengths(), tmp_path / "map.svg")
    svg = (tmp_path / "map.svg").read_text(encoding="utf-8")
    assert re.search(r"<text[^>]*>\s*wear\s*</text>", svg)
    save_regime_map(lengths(), tmp_path / "map.pdf")
    pdf = (tmp_path / "map.pdf").read_bytes()
    pdf += b"".join(
        zlib.decompress(stream)
        for stream in re.findall(rb"/FlateDecode.*?stream\r?\n(.*?)\r?\nendstream", pdf, re.DOTALL)
        if stream[:1] == b"\x78"
    )
    assert b"/FontFile2" in pdf
    assert b"/Type3" not in pdf


def luminance(colour):
    """Lightness L* of a colour, from 0 to 100."""
    rgb = np.array([int(colour[i : i + 2], 16) for i in (1, 3, 5)]) / 255.0
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    y = linear @ [0.2126, 0.7152, 0.0722]
    return 116.0 * np.cbrt(y) - 16.0 if y > 0.008856 else 903.3 * y


@pytest.mark.parametrize("names", [DOMINANCES, PARTS])
def test_regions_are_told_apart_in_grey(names):
    lightness = sorted(luminance(FILLS[name]) for name in names)
    assert np.diff(lightness).min() > 8.0  # well above the 2 or 3 that an eye sees side by side
    assert lightness[0] > 55.0  # black names are readable on all of them


def test_the_map_of_errors_darkens_with_the_error():
    assert np.diff([luminance(colour) for colour in ERROR_COLOURS]).max() < -3.0


# G. M. Machado, M. M. Oliveira and L. A. F. Fernandes, IEEE Trans. Vis. Comput. Graph. 15 (2009)
# 1291, severity 1: what protanopes, deuteranopes and tritanopes see.
MACHADO = {
    "protan": (0.152286, 1.052583, -0.204868,
               0.114503, 0.786281, 0.099216, -0.003882, -0.048116, 1.051998),
    "deutan": (0.367322, 0.860646, -0.227968,
               0.280085, 0.672501, 0.047413, -0.011820, 0.042940, 0.968881),
    "tritan": (1.255528, -0.076749, -0.178779,
               -0.078411, 0.930809, 0.147602, 0.004733, 0.691367, 0.303900),
}  # fmt: skip


@pytest.mark.parametrize("kind", MACHADO)
@pytest.mark.parametrize("names", [DOMINANCES, PARTS])
def test_regions_are_told_apart_by_the_colour_blind(kind, names):
    seen = [
        np.clip(
            np.reshape(MACHADO[kind], (3, 3))
            @ (np.array([int(FILLS[n][i : i + 2], 16) for i in (1, 3, 5)]) / 255),
            0,
            1,
        )
        for n in names
    ]
    for i, one in enumerate(seen):
        for other in seen[i + 1 :]:
            assert np.linalg.norm(one - other) > 0.15


def test_returns_the_axes_given_shows_nothing_and_leaves_the_rest_alone(monkeypatch, tmp_path):
    pyplot = pytest.importorskip("matplotlib.pyplot")
    monkeypatch.setattr(pyplot, "show", lambda *a, **k: pytest.fail("show() was called"))
    before, numbers = matplotlib.rcParams.copy(), pyplot.get_fignums()
    figure = Figure()
    ax = figure.add_subplot()
    assert plot_regime_map(lengths(), ax) is ax
    save_regime_map(lengths(), tmp_path / "map.png", width="double")
    assert matplotlib.rcParams == before
    assert pyplot.get_fignums() == numbers


def test_what_cannot_be_drawn_is_refused():
    made = gel()
    with pytest.raises(InputError, match=r"must be what regime_map returned, but is 1\.6"):
        plot_regime_map(1.6)
    with pytest.raises(InputError, match="'single' or 'double'"):
        draw(made, width="triple")
    with pytest.raises(InputError, match="limits must be some of high-toughness"):
        draw(made, limits=("eq9",))
    with pytest.raises(UnknownModelError, match="eq99"):
        draw(made, error_of="eq99")
    huge = regime_map("R_w", "Gamma_o", ((1, 9), (1e-3, 1e300)), {"mu": 1, "tau_w": 1}, nodes=5)
    with pytest.raises(InputError, match=r"toughness goes from 0\.001 to 1e\+300 J/m\^2; narrow"):
        draw(huge)
    thick = MapPoints(Scene(685.0, 1.6, 0.02, 0.0, 7750.0), "rope")
    with pytest.raises(InputError, match=r"rope must be on the map, but wire_radius = 0\.02 m"):
        draw(made, [thick])
    with pytest.raises(InputError, match="std must name quantities"):
        MapPoints(PAAM, "PAAm", std={"stiffness": 1.0})
    with pytest.raises(InputError, match="standard error of toughness must be finite"):
        MapPoints(PAAM, "PAAm", std={"toughness": -1.0})
    with pytest.raises(InputError, match="must be a Scene"):
        MapPoints(1.6, "PAAm")


def test_missing_matplotlib_is_told_with_the_remedy(monkeypatch, tmp_path):
    monkeypatch.setattr("surrogate.basics.extras.find_spec", lambda name: None)
    with pytest.raises(WirecutError, match=r"pip install 'wirecut\[plot\]'"):
        save_regime_map(gel(), tmp_path / "map.png")


def test_a_box_is_placed_where_it_touches_nothing():
    free = np.ones((GRID, GRID), dtype=bool)
    free &= ~blocked_by_line(np.array([0.0, 1.0]), np.array([0.3, 0.6]))
    x, y = best_place(free, 0.3, 0.1)
    rows, columns = (np.arange(GRID) + 0.5) / GRID, (np.arange(GRID) + 0.5) / GRID
    box = np.ix_(np.abs(rows - y) < 0.05, np.abs(columns - x) < 0.15)
    assert free[box].all()
    assert free[box].size > 500
    assert best_place(np.zeros((GRID, GRID), dtype=bool), 0.1, 0.1) is None


@pytest.mark.parametrize("angle", [-0.7, 0.4, 1.2])
def test_a_turned_box_is_placed_where_it_touches_nothing(angle):
    window, box = (300.0, 200.0), (90.0, 15.0)
    rows, columns = np.meshgrid(*[(np.arange(GRID) + 0.5) / GRID] * 2, indexing="ij")
    along = np.array([np.cos(angle), np.sin(angle)])
    across = np.array([-along[1], along[0]])
    cells = np.stack([columns * window[0], rows * window[1]], axis=-1)
    free = np.abs((cells - [140.0, 110.0]) @ across) < 14.0
    place = best_turned_place(free, box, window, angle)
    away = cells - np.multiply(place, window)
    covered = (np.abs(away @ along) < 0.5 * box[0]) & (np.abs(away @ across) < 0.5 * box[1])
    assert covered.sum() > 100
    assert free[covered].all()
    assert best_turned_place(free, (90.0, 30.0), window, angle) is None

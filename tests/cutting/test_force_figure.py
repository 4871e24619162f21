"""The figure of a force: its numbers are those of the model, and nothing is off the picture."""

import numpy as np
import pytest

pytest.importorskip("matplotlib")

from matplotlib.figure import Figure

from surrogate import InputError, Scene, cutting_force, plot_force
from surrogate.basics.picture_form import PictureForm, pictures_as
from surrogate.cli.main import main
from surrogate.cutting.figure import save_force

GEL = Scene(685.0, 1.6, [0.1e-3, 0.4e-3], 0.1, 7750.0)
SCENE = ["--shear-modulus", "685Pa", "--toughness", "1.6J/m2", "--wear-strength", "7.75kPa"]


def drawn(scene=GEL, law="projected", **options):
    axes = Figure(figsize=(3.4, 2.9), layout="constrained").add_subplot()
    return plot_force(scene, axes, law=law, **options)


def line(ax, label):
    return next(one for one in ax.lines if one.get_label() == label)


@pytest.mark.parametrize("model", ["auto", "eq13", "gp"])
@pytest.mark.parametrize("thickness", [None, 0.02])
def test_line_parts_and_wires_are_the_models(model, thickness):
    ax = drawn(model=model, thickness=thickness)
    size = thickness or 1.0
    label = f"model {model}"
    x, y = line(ax, label).get_data()
    shown = np.isfinite(y)
    law = "projected"
    wanted = cutting_force(Scene(685.0, 1.6, 1e-3 * x[shown], 0.1, 7750.0), model, law=law)
    # x in mm rounds g, and the process multiplies roundings by the sizes of its weights, some 1e5
    rtol = 1e-10 if model == "gp" else 1e-12
    np.testing.assert_allclose(y[shown], size * wanted.total, rtol=rtol)
    at, force = line(ax, "the wires").get_data()
    np.testing.assert_allclose(at, [0.1, 0.4])
    np.testing.assert_allclose(force, size * cutting_force(GEL, model, law=law).total, rtol=1e-12)
    stacked = [one.get_paths()[0].vertices[:, 1].max() for one in ax.collections[:3]]
    parts = cutting_force(Scene(685.0, 1.6, 1e-3 * x[-1], 0.1, 7750.0), model, law=law)
    heights = np.cumsum([parts.cleavage, parts.friction, parts.wear])
    np.testing.assert_allclose(stacked[2], size * heights[2], rtol=1e-9)
    assert stacked[0] == pytest.approx(size * 1.6)
    assert [text.get_text() for text in ax.texts][1:] == [
        r"cleavage $\Gamma_o$",
        "friction",
        "wear",
    ]


@pytest.mark.parametrize(
    "scene", [GEL, Scene(10e3, 5.0, [1e-4, 2e-3], 0.02, 2e3, 6.0)], ids=["gel", "tissue"]
)
@pytest.mark.parametrize("law", ["auto", "projected", "slip"])
def test_no_word_of_the_legend_is_cut_off(scene, law):
    ax = drawn(scene, law)
    figure = ax.figure
    figure.draw_without_rendering()
    box = ax.get_legend().get_window_extent()
    assert figure.bbox.x0 <= box.x0
    assert box.x1 <= figure.bbox.x1


def test_the_band_is_the_bound_of_the_model():
    ax = drawn()
    (band,) = [one for one in ax.collections if "fit's error" in str(one.get_label())]
    wanted = cutting_force(Scene(685.0, 1.6, 0.432e-3, 0.1, 7750.0), law="projected")
    top = band.get_paths()[0].vertices[:, 1].max()
    assert top == pytest.approx(wanted.total * (1.0 + wanted.fit_error), rel=1e-9)
    assert not [one for one in drawn(model="eq13").collections if "error" in str(one.get_label())]


def test_beyond_the_range_it_is_dashed_and_told():
    x, y = line(drawn(), "beyond its range").get_data()
    beyond = x[np.isfinite(y)]
    assert 1.6 / (685.0 * 1e-3 * beyond[-1]) == pytest.approx(100.0, rel=0.1)  # g at its end
    assert "beyond its range" not in [one.get_label() for one in drawn(model="eq13").lines]


def test_words_are_on_the_picture_and_apart():
    for scene in (GEL, Scene(685.0, 160.0, 0.1e-3, 0.01, 100.0), Scene(685.0, 1.6, 1e-3)):
        figure = Figure(figsize=(3.4, 2.9), layout="constrained")
        ax = plot_force(scene, figure.add_subplot(), model="eq13")
        figure.draw_without_rendering()
        boxes = [text.get_window_extent() for text in ax.texts]
        for i, box in enumerate(boxes):
            assert figure.bbox.x0 <= box.x0 <= box.x1 <= figure.bbox.x1
            assert not any(box.overlaps(other) for other in boxes[i + 1 :])
        curve = ax.transData.transform(line(ax, "model eq13").get_xydata())
        assert not any(boxes[0].contains(*point) for point in curve)


@pytest.mark.parametrize(
    ("scene", "options", "words"),
    [
        (Scene([1.0, 2.0], 1.6, 1e-4), {}, "one material"),
        (Scene(685.0, 1.6, 0.0), {}, "a wire with a radius"),
        (Scene(685.0, 1.6, []), {}, "a wire with a radius"),
        (GEL, {"thickness": 0.0}, "thickness must be"),
        (Scene(685.0, 1e200, 1e-4), {"model": "eq13"}, "check the units"),
        (GEL, {"ax": 3}, "ax must be axes"),
    ],
)
def test_what_cannot_be_drawn_is_refused(scene, options, words):
    with pytest.raises(InputError, match=words):
        plot_force(scene, **{"ax": Figure().add_subplot(), **options})


def test_diameters_on_request():
    with pictures_as(PictureForm(diameters=True)):
        ax = drawn()
    assert ax.get_xlabel() == "wire diameter $2R_w$ [mm]"
    np.testing.assert_allclose(line(ax, "the wires").get_xdata(), [0.2, 0.8])


@pytest.mark.parametrize("ending", ["png", "pdf", "svg", "tif", "tiff"])
def test_files_of_every_kind_are_written_alike_twice(ending, tmp_path):
    for name in "ab":
        save_force(GEL, tmp_path / f"{name}.{ending}")
    assert (tmp_path / f"a.{ending}").read_bytes() == (tmp_path / f"b.{ending}").read_bytes()


def size_of(file):
    image = pytest.importorskip("PIL.Image")
    with image.open(file) as picture:
        return picture.size


def test_width_and_dots_of_pictures(tmp_path, capsys):
    for options, width in (
        ([], 3.4 * 300),
        (["--width", "double", "--dpi", "100"], 700),
        (["--width", "254mm", "--dpi", "50"], 500),
    ):
        for ending in ("png", "tif"):
            file = tmp_path / f"f.{ending}"
            assert (
                main(["force", *SCENE, "--wire-radius", "0.2mm", "--plot", str(file), *options])
                == 0
            )
            assert size_of(file)[0] == pytest.approx(width, abs=1)
    capsys.readouterr()
    for bad in (["--width", "wide"], ["--width", "3m"], ["--dpi", "1"], ["--dpi", "x"]):
        assert main(["force", *SCENE, "--wire-radius", "0.2mm", *bad]) == 2
        assert bad[0] in capsys.readouterr().err


@pytest.mark.parametrize("command", ["force", "map", "identify"])
def test_a_picture_without_a_legend(command, tmp_path):
    arguments = {
        "force": [*SCENE, "--wire-radius", "0.2mm", "--plot"],
        "map": ["--preset", "gel", "--nodes", "11", "--out"],
        "identify": ["--example", "--plot"],
    }[command]
    for option in ([], ["--no-legend"]):
        file = tmp_path / "picture.svg"
        assert main([command, *arguments, str(file), *option]) == 0
        assert ('id="legend' in file.read_text()) == (not option)


def test_diameters_and_newtons_at_the_command_line(capsys):
    assert main(["force", *SCENE, "--wire-diameter", "0.4mm", "--thickness", "20mm"]) == 0
    header, row = (one.split() for one in capsys.readouterr().out.splitlines()[1:3])
    assert header[:3] == ["2", "R_w", "[mm]"]
    total = cutting_force(Scene(685.0, 1.6, 0.2e-3, 0.0, 7750.0)).total
    assert float(row[0]) == 0.4
    assert float(row[2]) == pytest.approx(total, rel=1e-3)
    assert float(row[3]) == pytest.approx(0.02 * total, rel=1e-3)
    assert main(["regime", *SCENE, "--wire-radius", "0.4mm", "--diameters"]) == 0
    assert "2 R_w [mm]" in capsys.readouterr().out


def test_a_map_in_diameters(tmp_path, capsys):
    axis = ["--x", "wire_diameter", "20um", "2mm", "--preset", "gel", "--nodes", "11"]
    picture = tmp_path / "map.svg"
    assert main(["map", *axis, "--diameters", "--out", str(picture)]) == 0
    assert "wire_diameter 2e-05 to 0.002 m" in capsys.readouterr().out
    assert "wire diameter" in picture.read_text()
    assert main(["map", *axis]) == 0
    assert "wire_radius 1e-05 to 0.001 m" in capsys.readouterr().out


def test_the_bare_command_helps(capsys):
    assert main([]) == 0
    printed = capsys.readouterr().out
    for words in ("forces of several wires", "I want to know a force", "I want a map"):
        assert words in printed


def test_parameters_of_a_law_are_drawn_by_it():
    gel = Scene(685.0, 1.6, [0.1e-3, 0.4e-3], wear_strength=7750.0, law="projected")
    ax = plot_force(gel, Figure().add_subplot())
    assert "projected, error unknown" not in [one.get_label() for one in ax.lines]

"""Several gels in one panel: named at their curves, and none drawn that should not be used."""

import numpy as np
import pytest

pytest.importorskip("matplotlib")

from matplotlib.figure import Figure

from surrogate import InputError, identify, plot_gels
from surrogate.comparing.figure import save_gels

RADII = [1e-4, 2e-4, 4e-4, 5e-4]


def fit(factor=1.0, **options):
    forces = factor * np.array([4.7, 7.9, 13.9, 17.2])
    return identify(RADII, forces, 685.0, model="eq13", **options)


FALLING = identify(RADII, [9.0, 7.0, 4.0, 2.0], 685.0, model="eq13")


def test_each_gel_has_its_name_in_the_colour_of_its_curve():
    ax = plot_gels({"soft": fit(), "tough": fit(1.5)}, Figure().add_subplot())
    colours = {text.get_text(): text.get_color() for text in ax.texts}
    assert list(colours) == ["soft", "tough"]  # from below
    curves = [line for line in ax.lines if len(line.get_xdata()) > 50]
    assert [line.get_color() for line in curves] == list(colours.values())
    assert curves[1].get_ydata()[-1] == pytest.approx(1.5 * curves[0].get_ydata()[-1])
    assert ax.get_legend() is None


def test_what_should_not_be_used_has_no_curve():
    ax = plot_gels({"soft": fit(), "odd": FALLING}, Figure().add_subplot())
    assert {text.get_text() for text in ax.texts} == {"soft", "odd (not used)"}
    assert sum(len(line.get_xdata()) > 50 for line in ax.lines) == 1


def test_names_are_no_formulas_and_files_do_not_change(tmp_path):
    gels = {"a$b$c_1^2": fit(), "Gel \N{GREEK SMALL LETTER ALPHA}": fit(1.3)}
    for ending in ("png", "svg", "pdf", "tif"):
        files = [tmp_path / f"{i}.{ending}" for i in (1, 2)]
        for file in files:
            save_gels(gels, file)
        assert files[0].read_bytes() == files[1].read_bytes()
    assert "a$b$c_1^2" in (tmp_path / "1.svg").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("gels", "words"),
    [
        ({}, "must be from 1 to 14, but are 0"),
        ({str(i): FALLING for i in range(15)}, "must be from 1 to 14, but are 15"),
        ({"a": 1.0}, "must be names with what identify returned"),
    ],
)
def test_what_cannot_be_drawn_is_refused(gels, words):
    with pytest.raises(InputError, match=words):
        plot_gels(gels, Figure().add_subplot())

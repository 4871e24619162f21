"""What a nonlinear identification prints and draws."""

import json
import re
import shlex
from functools import partial

import numpy as np
import pytest

import surrogate
from surrogate.cli.main import main
from surrogate.errors import InputError
from surrogate.identification.figure import plot_profile

identify = partial(surrogate.identify, model="eq13")

RADII = np.array([0.125e-3, 0.275e-3, 0.470e-3])
FORCES = [1.85, 4.29, 5.67]  # with the bump's two minima
MODULUS = 685.0


@pytest.fixture
def cuts(tmp_path):
    file = tmp_path / "cuts.csv"
    rows = [f"{1e3 * r:.3f},{f},0.6\n" for r, f in zip(RADII, FORCES, strict=True)]
    header = "wire_radius_mm,force_per_thickness_N_per_m,force_std_N_per_m\n"
    file.write_text(header + "".join(rows))
    return file


def run(cuts, options, capsys, code=0):
    assert main(shlex.split(f"identify {cuts} --shear-modulus 685Pa {options}")) == code
    return capsys.readouterr().out


def test_minima_intervals_and_the_further_wire_are_printed(cuts, capsys, bump):
    printed = run(cuts, "--model bump --verbose", capsys)
    fit = identify(RADII, FORCES, MODULUS, force_std=0.6, model="bump")
    first, second = fit.profile.modes[:2]
    assert re.search(rf"\n1 +{first.toughness:.4g} .* the estimate\n", printed)
    assert re.search(rf"\n2 +{second.toughness:.4g} .* possible\n", printed)
    assert "Gamma_o is in one of 2 intervals: 0 to" in printed
    assert "Undecided: 2 materials fit the forces" in printed
    text = " ".join(printed.split())
    assert f"To decide: a wire {2e3 * fit.further_wire.wire_radius:.3g} mm across" in text
    assert "model 'bump'" in printed
    assert printed.isascii()


def test_the_same_for_machines(cuts, capsys, bump):
    record = json.loads(run(cuts, "--model bump --json", capsys), parse_constant=pytest.fail)
    fit = identify(RADII, FORCES, MODULUS, force_std=0.6, model="bump")
    assert [mode["toughness"] for mode in record["modes"]] == [
        mode.toughness for mode in fit.profile.modes
    ]
    assert record["toughness_intervals"] == [list(i) for i in fit.profile.toughness_intervals]
    assert record["further_wire"]["wire_radius"] == fit.further_wire.wire_radius
    assert record["misfit"] == "chi^2"
    assert "model" in record["transition_radii"]


def test_facts_reach_the_fit(cuts, capsys, elements):
    options = "--model elements --toughness-max 0.5J/m2 --further-radii 0.2mm 0.3mm --json"
    record = json.loads(run(cuts, options, capsys))
    assert record["toughness"] <= 0.5
    assert record["known"]["toughness_max"] == 0.5
    assert record["further_wire"]["searched"] == [2e-4, 3e-4]
    record = json.loads(run(cuts, "--wear-strength 2kPa --json", capsys))
    assert record["wear_strength"] == 2000.0
    options = "--toughness-prior 1J/m2 0.1J/m2 --wear-strength-prior 2kPa 1kPa --json"
    record = json.loads(run(cuts, options, capsys))
    assert record["known"]["toughness_prior"] == [1.0, 0.1]
    assert record["known"]["wear_strength_prior"] == [2000.0, 1000.0]


def test_a_linear_fit_prints_nothing_of_it(cuts, capsys):
    printed = run(cuts, "--model eq13", capsys)
    for word in ("Minimum", "Undecided", "To know more", "\nmodel"):
        assert word not in printed
    assert "modes" not in json.loads(run(cuts, "--model eq13 --json", capsys))


def test_two_panels_without_overlaps(cuts, capsys, bump, tmp_path):
    pytest.importorskip("matplotlib")
    picture = tmp_path / "fit.png"
    run(cuts, f"--model bump --plot {picture}", capsys)
    assert picture.stat().st_size > 5000


@pytest.mark.parametrize("std", [0.6, None])
def test_the_profiles_figure(bump, std):
    figure = pytest.importorskip("matplotlib.figure").Figure(
        figsize=(3.4, 2.9), layout="constrained"
    )
    fit = identify(RADII, FORCES, MODULUS, force_std=std, model="bump")
    ax = plot_profile(fit, figure.add_subplot())
    curve = ax.get_lines()[0]
    np.testing.assert_array_equal(curve.get_xdata(), fit.profile.toughness)
    np.testing.assert_array_equal(curve.get_ydata(), fit.profile.misfit)
    low, high = ax.get_ylim()
    assert low < 0.0 < fit.profile.threshold < high
    figure.draw_without_rendering()
    whole, legend = figure.bbox, ax.get_legend().get_window_extent()
    assert not legend.overlaps(ax.get_window_extent())
    for box in (legend, ax.get_tightbbox()):
        assert whole.x0 <= box.x0 <= box.x1 <= whole.x1
        assert whole.y0 <= box.y0 <= box.y1 <= whole.y1


def test_figures_without_scatter_or_interval(elements):
    figure = pytest.importorskip("matplotlib.figure").Figure()
    for radii, forces in (([1e-4, 3e-4], [4.0, 9.0]), ([1e-4, 2e-4, 3e-4], [4.0, 7.0, 9.0])):
        fit = identify(radii, forces, MODULUS, model="elements")
        low, high = plot_profile(fit, figure.add_subplot()).get_ylim()
        assert low < fit.profile.modes[0].misfit < high


def test_a_minimum_at_the_end_of_the_search_is_drawn_whole():
    figure = pytest.importorskip("matplotlib.figure").Figure()
    radius = np.array([0.125e-3, 0.21e-3, 0.275e-3, 0.39e-3, 0.47e-3])
    fit = surrogate.identify(radius, 1.6 + 31e3 * radius, MODULUS, toughness_max=1.0, model="eq13")
    ax = plot_profile(fit, figure.add_subplot())
    (left, right), (low, high) = ax.get_xlim(), ax.get_ylim()
    assert any(mode.toughness == 1.0 for mode in fit.profile.modes), fit.profile.modes
    minima = [line for line in ax.get_lines() if "minimum" in line.get_label()]
    x, y = np.concatenate([line.get_xydata() for line in minima]).T
    shown = {mode.toughness for mode in fit.profile.modes if left <= mode.toughness <= right}
    assert 1.0 in shown
    assert set(x) == {one for one in shown if one in x}
    assert not any(line.get_clip_on() for line in minima)
    assert np.all((left <= x) & (x <= right) & (low <= y) & (y <= high))
    assert "95 % interval" in [text.get_text() for text in ax.get_legend().get_texts()]


def test_what_has_no_profile_is_refused():
    fit = identify(RADII, FORCES, MODULUS)
    for value in (fit, 1.6):
        with pytest.raises(InputError, match="give such a one"):
            plot_profile(value)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ("--toughness-max 0", "--toughness-max must be"),
        ("--toughness-max 1kPa", "not a toughness"),
        ("--toughness-prior 1J/m2", "expected 2 arguments"),
        ("--wear-strength 1kPa --wear-strength-prior 1kPa 1kPa", "must not both be given"),
        ("--further-radii 1mm 0.1mm --toughness-max 2", "smaller one"),
    ],
)
def test_bad_options_end_in_one_line(cuts, options, words, capsys):
    assert main(shlex.split(f"identify {cuts} --shear-modulus 685Pa {options}")) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert words in error


def test_the_answer_comes_first_in_at_most_25_lines(cuts, capsys, bump):
    printed = run(cuts, "--model bump", capsys)
    assert printed.startswith("2 materials fit: Gamma_o = 1 J/m2 with tau_w = 3 kPa; or")
    assert len(printed.splitlines()) <= 25
    printed = run(cuts, "--model eq13 --friction-coefficient 0", capsys)
    assert re.match(r"Gamma_o = \S+ \(\S+ to \S+\) J/m2, tau_w ", printed)
    assert "assumed" not in printed.split("alpha")[0]


def test_what_is_stated_of_the_modulus_reaches_the_fit(cuts, capsys):
    def record(options, code=0):
        assert main(shlex.split(f"identify {cuts} {options} --json")) == code
        return json.loads(capsys.readouterr().out)

    stated = record("--shear-modulus 0.685+-0.03kPa")
    assert (stated["shear_modulus"], stated["shear_modulus_std"]) == (685.0, pytest.approx(30.0))
    assert stated["contributions"]["shear_modulus"][0] > 0.0
    assert record("--youngs-modulus 2055Pa")["shear_modulus"] == pytest.approx(685.0)
    assert record("--model eq13")["assumed"][0] == "shear_modulus"
    poor = record("--model eq13 --relative-error 5%", code=3)
    assert "chi^2/dof" in poor["objections"][0]
    assert poor["warnings"][0] == poor["objections"][0]
    assert main(shlex.split(f"identify {cuts} --model eq13 --friction-coefficient 0.1")) == 2
    assert "shear modulus is missing" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("radii", "forces", "options", "words"),
    [
        ((100, 200, 400), (4.7, 8.1, 13.9), "--shear-modulus 30kPa", "mm given as m"),
        ((0.1, 0.2, 0.4), (4.7, 12.0, 13.9), "--relative-error 1%", "chi^2/dof"),
        ((0.1, 0.2, 0.4), (14.0, 8.0, 2.0), "", "above the smallest force"),
        ((0.1, 0.2, 0.4), (14.0, 8.1, 2.0), "--relative-error 5%", "is negative"),
        ((0.1, 0.2, 0.4), (5.0, 5.0, 5.0), "", "to the last digit"),
    ],
)
def test_what_forbids_the_numbers_comes_before_them(
    tmp_path, capsys, radii, forces, options, words
):
    file = tmp_path / "cuts.csv"
    rows = [f"{r},{f}\n" for r, f in zip(radii, forces, strict=True)]
    file.write_text("wire_radius_mm,force_per_thickness_N_per_m\n" + "".join(rows))
    assert main(shlex.split(f"identify {file} --model eq13 {options}")) == 3
    printed = " ".join(capsys.readouterr().out.split())
    assert printed.startswith("Do not use the numbers below: ")
    assert words in printed[: printed.index(" Gamma_o = ")]


def test_an_end_below_the_digits_is_an_upper_limit():
    radius = np.array([0.125e-3, 0.21e-3, 0.275e-3, 0.39e-3, 0.47e-3])
    fit = surrogate.identify(radius, 1.6 + 31e3 * radius, MODULUS)
    low, high = fit.toughness_interval
    assert 0.0 < low < 1e-3 * high
    assert f"Gamma_o < {high:.1f} J/m2" in fit.summary()
    assert "0.0 to" not in fit.summary()
    assert not any("e-" in sentence for sentence in fit.undecided[:-1])


def test_a_toughness_far_above_pure_shear_is_doubted(cuts, capsys):
    options = "--model eq13 --pure-shear-toughness 0.001J/m2 --relative-error 1%"
    printed = " ".join(run(cuts, options, capsys, code=3).split())
    assert re.match("Do not use the numbers below: .* far above the toughness of pure", printed)
    assert printed.index("Do not use") < printed.index("Gamma_o = ")


def test_wires_beyond_the_range_are_printed_and_drawn(tmp_path, capsys):
    pytest.importorskip("matplotlib")
    file, picture, line = tmp_path / "cuts.csv", tmp_path / "fit.png", tmp_path / "fit.csv"
    rows = [f"{d},{f},9\n" for d, f in ((0.7, 172), (1.0, 175), (1.4, 181), (2.1, 186))]
    header = "wire_diameter_mm,force_per_thickness_N_per_m,force_std_N_per_m\n"
    file.write_text(header + "".join(rows))
    options = f"--shear-modulus 3kPa --plot {picture} --csv {line}"
    assert main(shlex.split(f"identify {file} {options}")) == 0
    answer, warning = capsys.readouterr().out.split("\n")[:2]
    assert re.match(r"Gamma_o = 1\d\d \(\d+ to \d+\) J/m2", answer)
    assert warning.startswith("Warning: 2 of 4 cuts (R_w = 0.35, 0.5 mm) are at g = ")
    assert picture.stat().st_size > 0
    assert "nan" not in line.read_text()
    assert main(shlex.split(f"identify {file} --shear-modulus 3kPa --verbose --json")) == 0
    record = json.loads(capsys.readouterr().out, parse_constant=pytest.fail)
    assert record["wear_strength_limited_by"][0] == "zero"

"""The paper's figures: what is drawn is what the data say, and missing data are told."""

import csv
import os
import re
import runpy
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from fake_engine import run

from fe_training.campaign.dataset import load_campaign, write_campaign
from fe_training.campaign.design_file import read_design
from fe_training.paper.curve import Curve
from fe_training.paper.figures import (
    RATIOS,
    dissipation_figure,
    energy_release_figure,
    exponent_figure,
    stress_figure,
    stress_records,
)
from fe_training.paper.own_figures import contact_figure, eq13_figure
from surrogate.errors import InputError

ROOT = Path(__file__).resolve().parent.parent.parent
FITTED = ("1c", "map", "misfit")
FIGURES = ("2c", "3a", "4", "table-1", "contact", "eq13", "eq13-coupled", "specimens", *FITTED)
PARTS = (
    *(
        "experiment",
        "laws",
        "distance",
        "plateau",
        "contact",
        "exponents",
        "local exponents",
        "eq13",
        "eq13 coupled",
    ),
    *("evidence", "blocks", "sizes"),
)

pytest.importorskip("matplotlib")
from matplotlib.figure import Figure  # noqa: E402


@pytest.fixture(scope="module")
def data_file(tmp_path_factory):
    """A data set of made-up numbers with the paper's exponents."""
    folder = tmp_path_factory.mktemp("made-up")
    text = (Path(__file__).parents[1] / "designs.py").read_text().partition('SMALL = """\\\n')[2]
    (folder / "design.toml").write_text(text.partition('"""')[0].replace("[2, 5]", "[2, 5, 9]"))
    design = read_design(folder / "design.toml")
    return write_campaign(folder / "campaign.h5", design, run(design, folder / "store"))


@pytest.fixture(scope="module")
def data(data_file):
    return load_campaign(data_file)


@pytest.fixture(scope="module")
def script():
    return runpy.run_path(str(ROOT / "scripts" / "compare-paper"))


def curves(data):
    return [Curve.of(data, alpha) for alpha in (2.0, 5.0, 9.0)]


def figure():
    return Figure(figsize=(7.0, 3.0), layout="constrained")


def test_a_curve_rises_and_holds_what_may_be_used(data):
    one = Curve.of(data, 5.0)
    assert np.all(np.diff(one.g) > 0.0)
    np.testing.assert_allclose(one.normal_load, 2.0 + 0.3 * one.g, rtol=2e-3)
    with pytest.raises(InputError, match="0 points of alpha = 3"):
        Curve.of(data, 3.0)


def test_figure_2c_has_the_data_and_both_laws(data):
    drawn_on = figure()
    columns = energy_release_figure(curves(data), drawn_on)
    at = columns["delta_over_R_w", ""]
    np.testing.assert_allclose(columns["Eq_5", ""], at**-2.0, rtol=1e-12)
    left = drawn_on.axes[0]
    assert (left.get_xscale(), left.get_yscale()) == ("linear", "log")
    labels = [text.get_text() for text in drawn_on.legends[0].get_texts()]
    assert labels == ["Eq. (5)", "linear wedge", *(rf"$\alpha$ = {a}" for a in (2, 5, 9))]
    drawn = sum(len(line.get_xdata()) for line in left.get_lines() if line.get_marker() != "None")
    assert drawn == at.size
    slope = columns["local_exponent", ""]
    assert np.all(slope[np.isfinite(slope)] < 0.0)
    assert np.isnan(slope[at < 1.002]).all()


def test_figure_3a_takes_the_rows_nearest_to_the_distances(data):
    records = stress_records(data, 2.0, (1.05, 1.5))
    g = [one.energy_release_rate for one in records]
    assert g[0] > g[1]
    distances = data.rows["distance"][data.rows["alpha"] == 2.0]
    assert abs(records[1].distance - 1.5) == pytest.approx(np.abs(distances - 1.5).min(), abs=1e-2)
    columns = stress_figure(records, figure().add_subplot())
    assert columns["sigma_22_over_mu", ""].size == columns["r_over_R_w", ""].size == 60
    with pytest.raises(InputError, match="no row of alpha = 2 near delta = 15"):
        stress_records(data, 2.0)
    with pytest.raises(InputError, match="no solved row of alpha = 3"):
        stress_records(data, 3.0)


def test_figure_4_is_eq_s2_beside_eq_13_and_eq_9(data):
    drawn_on = figure()
    columns = dissipation_figure(curves(data), drawn_on)
    ratio, g = columns["tau_w_over_mu_xi", ""], columns["g", ""]
    assert set(ratio) == set(RATIOS)
    np.testing.assert_allclose(columns["Eq_13", ""], g + 4.0 * (1.0 + ratio), rtol=1e-14)
    one = Curve.of(data, 9.0)
    chosen = (columns["alpha", ""] == 9.0) & (ratio == 10.0)
    np.testing.assert_allclose(
        columns["finite_elements", ""][chosen], 20.0 * one.arc + 2.0 * one.normal_load, rtol=1e-14
    )
    np.testing.assert_allclose(columns["Eq_9", ""][chosen], one.g**0.96, rtol=1e-14)
    assert [ax.get_title() for ax in drawn_on.axes] == [rf"$\alpha$ = {a}" for a in (2, 5, 9)]
    for ax in drawn_on.axes:  # nothing leaves the picture at its top
        assert ax.get_ylim()[1] > max(
            line.get_ydata().max() for line in ax.lines if line.get_xdata().size
        )


def test_table_1_is_a_fit_over_named_ranges(data):
    table = exponent_figure(curves(data), figure())
    assert set(table["n_table_1", ""]) == {1.18, 1.06, 0.96}
    assert np.all(table["g_from", ""] < table["g_to", ""])
    # 2B = 4 + 0.6 g of the made-up engine: between a constant and a line
    assert np.all((table["n", ""] > 0.0) & (table["n", ""] < 1.0))


def test_a_and_b_and_the_error_of_eq_13_are_those_of_the_data(data):
    one = Curve.of(data, 5.0)
    columns = contact_figure([one], figure())
    np.testing.assert_array_equal(columns["A", ""], one.arc)
    columns = eq13_figure([one], figure())
    xi, ratio, g = (columns[name, ""] for name in ("xi", "tau_w_over_mu_xi", "g"))
    i = int(np.flatnonzero((xi == 0.5) & (ratio > 1.0))[0])
    at = np.flatnonzero(one.g == g[i])[0]
    truth = g[i] + 2.0 * xi[i] * (ratio[i] * one.arc[at] + one.normal_load[at])
    paper = (1.0 + xi[i]) * g[i] + 4.0 * xi[i] * (1.0 + ratio[i])
    assert columns["error_of_Eq_13", ""][i] == pytest.approx(paper / truth - 1.0)


def test_without_the_campaign_it_says_so_in_one_line(tmp_path):
    command = [sys.executable, "scripts/compare-paper", "--data", "missing.h5", "--out", tmp_path]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert done.stdout == ""
    assert done.stderr.startswith("compare-paper: ")
    assert done.stderr.count("\n") == 1


def test_everything_with_fitted_models(data_file, script, tmp_path, monkeypatch, capsys):
    import surrogate.contact.shipped
    from fe_training.fitting.fit import fit, write_fitted

    points = runpy.run_path(str(ROOT / "tests" / "made_up.py"))["points"]
    (tmp_path / "models").mkdir()
    fitted = write_fitted(tmp_path / "models", fit(points(), {"origin": "made up"}))
    monkeypatch.setattr(surrogate.contact.shipped, "models_folder", lambda: fitted.parent)
    out, page, pictures = tmp_path / "paper", tmp_path / "page.md", tmp_path / "pictures"
    page.write_text("\n".join(f"<!-- {n}: begin -->\nold\n<!-- {n}: end -->" for n in PARTS))
    readme = tmp_path / "README.md"
    readme.write_text("<!-- laws: begin -->\nold\n<!-- laws: end -->\n")
    options = ["--data", data_file, "--out", out, "--page", page, "--figures", pictures]
    options += ["--readme", readme]
    assert script["run"]([str(option) for option in options]) == 1
    printed = capsys.readouterr().out
    assert "3a: not made: the data have no row" in printed  # made-up distances end at 2 R_w
    made = {path.name for folder in (out, pictures) for path in folder.iterdir()}
    assert made == {
        f"paper-{name}.{ending}"
        for name in set(FIGURES) - {"3a", "eq13-coupled"}
        for ending in ("csv", "pdf", "png")
    }
    assert "eq13-coupled: not made: the law 'coupled' must have the file" in printed
    assert page.read_text().count("old") == 1  # the table of that law
    # 2B = 4 + 0.6 g of the made-up engine at g = 1 ... 10
    assert re.search(r"\| 2 \| 1 to 100 \| 1\.18 \| 0\.\d+ \|", page.read_text())
    with (out / "paper-1c.csv").open() as stream:
        last = list(csv.DictReader(stream))[-1]
    expected = 1.6 + 31e3 * float(last["wire_radius_m"])
    assert float(last["eq13_N_per_m"]) == pytest.approx(expected)
    # the made-up A is less than 2: the same forces need more wear
    (name,) = (name for name in last if name.startswith("table_at_"))
    assert float(last[name]) == pytest.approx(expected, rel=0.02)
    if keep := os.environ.get("KEEP_PICTURES"):
        shutil.copytree(pictures, keep, dirs_exist_ok=True)


def test_what_is_missing_is_named_and_the_rest_is_made(
    data_file, script, tmp_path, monkeypatch, capsys
):
    monkeypatch.setitem(script["draw"].__globals__, "save_figure", lambda figure, file: None)
    page = tmp_path / "page.md"
    page.write_text("\n".join(f"<!-- {n}: begin -->\nold\n<!-- {n}: end -->" for n in PARTS))
    readme = tmp_path / "README.md"
    readme.write_text("as it was")
    options = ["--data", data_file, "--out", tmp_path, "--page", page, "--figures", tmp_path]
    options += ["--readme", readme]
    options += ["--specimens", tmp_path / "none.csv", "--model", "nonsense"]
    assert script["run"]([str(option) for option in options]) == 1
    printed = capsys.readouterr().out
    for name in (*FITTED, "specimens"):
        assert f"{name}: not made: " in printed
    for name in ("2c", "4", "table-1", "contact", "eq13", "eq13-coupled"):
        assert f"{name}: written" in printed
    assert page.read_text().count("old") == 5  # experiment, laws, evidence, blocks, sizes

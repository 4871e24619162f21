"""Curves of an identification as tables."""

import csv
from functools import partial

import numpy as np
import pytest

import surrogate
from surrogate import InputError, WirecutError
from surrogate.cli.main import main
from surrogate.identification.curves import curve_dataset, write_curve, write_profile

identify = partial(surrogate.identify, model="eq13")

RADIUS, FORCE = np.array([0.1, 0.2, 0.4, 0.5]) * 1e-3, [4.7, 7.9, 13.9, 17.2]
FIT = identify(RADIUS, FORCE, 685.0)


def table(file):
    with open(file, encoding="utf-8") as stream:
        rows = list(csv.DictReader(line for line in stream if line[0] != "#"))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def test_the_line_and_its_band(tmp_path):
    write_curve(FIT, tmp_path / "fit.csv")
    columns = table(tmp_path / "fit.csv")
    radius = columns["wire_radius_m"]
    assert (radius.size, radius[-1]) == (200, 0.5e-3)
    np.testing.assert_array_equal(columns["force_per_thickness_N_per_m"], FIT.predict(radius))
    low, high = FIT.band(radius)
    np.testing.assert_array_equal(columns["band_low_N_per_m"], low)
    np.testing.assert_array_equal(columns["band_high_N_per_m"], high)
    assert repr(FIT.toughness) in (tmp_path / "fit.csv").read_text()


def test_radii_of_ones_own(tmp_path):
    write_curve(FIT, tmp_path / "fit.csv", 0.3e-3)
    assert table(tmp_path / "fit.csv")["wire_radius_m"].tolist() == [0.3e-3]
    with pytest.raises(InputError, match="wire_radius"):
        write_curve(FIT, tmp_path / "fit.csv", [-1.0])


def test_the_labelled_data_set():
    pytest.importorskip("xarray")
    data = curve_dataset(FIT, [1e-4, 2e-4])
    np.testing.assert_array_equal(data["force_per_thickness"], FIT.predict([1e-4, 2e-4]))
    assert data["band_low"].attrs["units"] == "N/m"
    assert data["wire_radius"].attrs["units"] == "m"


def test_the_misfit(tmp_path):
    bounded = identify(RADIUS, FORCE, 685.0, toughness_max=5.0)
    write_profile(bounded, tmp_path / "misfit.csv")
    columns = table(tmp_path / "misfit.csv")
    np.testing.assert_array_equal(columns["toughness_J_per_m2"], bounded.profile.toughness)
    np.testing.assert_array_equal(columns["misfit_N2_per_m2"], bounded.profile.misfit)
    with pytest.raises(InputError, match="needs an identification with a profile"):
        write_profile(FIT, tmp_path / "misfit.csv")


@pytest.mark.parametrize("write", [write_curve, write_profile])
def test_what_is_no_identification_is_refused(write, tmp_path):
    with pytest.raises(InputError, match="must be what identify returned"):
        write(1.6, tmp_path / "fit.csv")


def test_without_xarray_the_remedy_is_told(monkeypatch):
    import sys

    monkeypatch.setitem(sys.modules, "xarray", None)
    with pytest.raises(WirecutError, match=r"pip install 'wirecut\[tables\]'"):
        curve_dataset(FIT)


def test_the_command_writes_the_line(tmp_path, capsys):
    options = ["identify", "--example", "--model", "eq13", "--csv", str(tmp_path / "fit.csv")]
    assert main(options) == 0
    columns = table(tmp_path / "fit.csv")
    expected = 1.6 + 31e3 * columns["wire_radius_m"]
    np.testing.assert_allclose(columns["force_per_thickness_N_per_m"], expected, rtol=1e-9)
    capsys.readouterr()


def test_the_line_of_a_fitted_model_ends_where_the_model_does(tmp_path, capsys):
    assert main([*["identify", "--example", "--csv"], str(tmp_path / "fit.csv")]) == 0
    radius = table(tmp_path / "fit.csv")["wire_radius_m"]
    assert 0.0 < radius[0] < 0.125e-3
    assert radius[-1] == pytest.approx(0.47e-3)
    capsys.readouterr()

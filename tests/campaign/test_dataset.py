"""The data set: what goes in comes out, errors between levels, doubts, damage, units."""

import hashlib
import re
from dataclasses import fields, replace

import h5py
import numpy as np
import pytest
from fake_engine import record, run

from fe_training.campaign import dataset
from fe_training.campaign.columns import POINT_COLUMNS, PROFILES, ROW_COLUMNS
from fe_training.campaign.dataset import (
    PROFILE_POINTS,
    dissipative_force_table,
    load_campaign,
    write_campaign,
)
from fe_training.solver.record import Outcome, Record
from surrogate.errors import InputError, MissingExtraError


@pytest.fixture
def rows(small, tmp_path):
    """The made-up rows of the small design."""
    return run(small, tmp_path / "store")


@pytest.fixture
def file(small, rows, tmp_path):
    """Their data set."""
    return write_campaign(tmp_path / "campaign.h5", small, rows)


def with_record(rows, index, **changed):
    """Return the rows, one of them with changes in its record."""
    rows = list(rows)
    rows[index] = replace(rows[index], record=replace(rows[index].record, **changed))
    return rows


def reloaded(small, rows, tmp_path):
    return load_campaign(write_campaign(tmp_path / "changed.h5", small, rows))


def test_every_field_of_a_record_has_unit_and_description():
    assert {field.name for field in fields(Record)} <= set(ROW_COLUMNS)
    arrays = {
        f.name for f in fields(Record) if isinstance(getattr(record(2, 1), f.name), np.ndarray)
    }
    assert arrays == set(PROFILES)


def test_every_column_of_the_file_has_unit_and_description(file):
    with h5py.File(file) as content:
        for group, about in (("rows", ROW_COLUMNS), ("points", POINT_COLUMNS)):
            assert {"unit", "description"} <= set(content[group]["alpha"].attrs)
            assert set(content[group]) == set(about)
            for column in content[group].values():
                assert column.attrs["unit"]
                assert len(column.attrs["description"]) > 5


def test_rows_come_back(small, rows, file):
    table = load_campaign(file).rows
    assert len(table) == len(rows)
    assert table["level"].tolist() == [row.configuration.level for row in rows]
    for field in fields(Record):
        values = [getattr(row.record, field.name) for row in rows]
        if isinstance(values[0], float | bool | int):
            assert np.array_equal(table[field.name], values, equal_nan=True), field.name
        elif isinstance(values[0], Outcome):
            assert table[field.name].tolist() == [value.name for value in values]
        elif isinstance(values[0], str):
            assert table[field.name].tolist() == values
    across = np.array([row.record.energy_release_rate_across for row in rows])
    assert np.array_equal(table["energy_release_rate_across"], across)


def test_profiles_keep_ends_and_shape_when_resampled(rows, file):
    table = load_campaign(file).rows
    assert table["pressure"].dtype == np.float32
    assert table["pressure"].shape == (len(rows), PROFILE_POINTS)
    for i, row in enumerate(rows):
        theta, pressure = table["pressure_angle"][i], table["pressure"][i]
        there = np.isfinite(theta)
        full = len(row.record.pressure)
        assert there.sum() == min(full, PROFILE_POINTS)
        assert theta[there][[0, -1]] == pytest.approx(row.record.pressure_angle[[0, -1]])
        exact = np.interp(theta[there], row.record.pressure_angle, row.record.pressure)
        assert pressure[there] == pytest.approx(exact, abs=1e-3 * exact.max())


def test_provenance(small, file):
    campaign = load_campaign(file)
    assert campaign.design == small
    assert campaign.provenance["schema"] == dataset.SCHEMA
    assert campaign.provenance["design_hash"] == small.hash
    assert re.match(r"\d{4}-\d\d-\d\dT", campaign.provenance["date"])
    (made_by,) = campaign.software
    assert {"wirecut", "numpy", "scipy", "scikit-fem", "python", "platform"} <= set(made_by)
    assert set(campaign.rows["software"]) == {0}
    assert set(campaign.rows["solver"]) == {"made-up"}


def test_points_take_the_finer_level_at_the_target_and_the_difference_as_error(small, file):
    points = load_campaign(file).points
    assert len(points) == 12
    for i, (alpha, g) in enumerate(zip(points["alpha"], points["g"], strict=True)):
        fine, coarse = 1 + 0.5 / 16**2, 1 + 0.5 / 12**2
        # J is up to 1e-5 off its target in the made-up rows; the slope takes most of that away
        assert points["normal_load"][i] == pytest.approx((2 + 0.3 * g) * fine, rel=1e-5)
        assert points["normal_load_error"][i] == pytest.approx(coarse / fine - 1, rel=1e-2)
        assert points["distance"][i] == pytest.approx((1 + 1 / (1 + alpha * g)) * fine, rel=1e-5)
    assert points["use"].all()
    assert not any(points["reason"])


def test_a_row_that_ended_beside_its_target_is_moved_along_the_slope(small, rows, tmp_path):
    i = next(i for i, row in enumerate(rows) if row.configuration.level == "less-coarse") + 3
    g = rows[i].configuration.target
    off = g * 1.005
    load = rows[i].record.vertical_force + 0.3 * 0.005 * g
    beside = with_record(
        rows, i, energy_release_rate=off, vertical_force=load, horizontal_force=0.5 * off
    )
    points = reloaded(small, beside, tmp_path).points
    (j,) = np.flatnonzero(points["row"] == i)
    moved = abs(points["normal_load"][j] / rows[i].record.vertical_force - 1)
    assert moved < 0.2 * abs(load / rows[i].record.vertical_force - 1)
    assert points["use"][j]


FINE = 12  # index of the first row of the finer level


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"horizontal_force": 0.06}, "|J - 2 F_h|/J is above its bound (2.0e-01)"),
        ({"outcome": Outcome.FOLDED}, Outcome.FOLDED.meaning),
        ({"vertical_force": 2.1}, "B differs between the meshes ("),
        ({"theta_1": 0.6}, "A differs between the meshes ("),
        ({"truncation_error": 0.02}, "finite body (2 %)"),
        ({"truncation_error": np.nan}, "finite body (nan %)"),
        ({"energy_release_rate": 0.105, "horizontal_force": 0.0525}, "J is off its target (5 %)"),
    ],
)
def test_doubtful_points_are_flagged_with_their_reason(small, rows, tmp_path, changed, words):
    points = reloaded(small, with_record(rows, FINE, **changed), tmp_path).points
    (i,) = np.flatnonzero(points["row"] == FINE)
    assert not points["use"][i]
    assert words in points["reason"][i]
    assert points["use"].sum() == 11


def test_a_failed_fine_row_leaves_the_coarse_value_without_error(small, rows, tmp_path):
    failed = list(rows)
    failed[FINE] = replace(rows[FINE], record=Record(2.0, Outcome.STALLED, reason="no more"))
    points = reloaded(small, failed, tmp_path).points
    i = 0
    assert points["row"][i] == 0
    assert points["normal_load"][i] == pytest.approx(rows[0].record.vertical_force, rel=1e-4)
    assert np.isnan(points["normal_load_error"][i])
    assert points["reason"][i] == "only one mesh level was reached"


def test_a_configuration_that_failed_on_both_levels_is_a_point_with_its_reason(
    small, rows, tmp_path
):
    failed = list(rows)
    for i in (0, FINE):
        failed[i] = replace(rows[i], record=Record(2.0, Outcome.FOLDED, reason="no more"))
    points = reloaded(small, failed, tmp_path).points
    assert np.isnan(points["normal_load"][0])
    assert points["reason"][0] == Outcome.FOLDED.meaning
    assert not points["use"][0]


def test_a_part_of_the_rows_makes_a_data_set(small, rows, tmp_path):
    campaign = reloaded(small, rows[:5], tmp_path)
    assert len(campaign.rows) == len(campaign.points) == 5
    assert not campaign.points["use"].any()
    one = reloaded(small, rows[:1], tmp_path)
    assert len(one.rows) == 1


def test_no_rows_make_no_data_set(small, tmp_path):
    with pytest.raises(InputError, match="run it first"):
        write_campaign(tmp_path / "none.h5", small, [])


def test_the_checksum_is_what_sha256sum_reads(file):
    digest, name = file.with_name("campaign.h5.sha256").read_text().split()
    assert digest == hashlib.sha256(file.read_bytes()).hexdigest()
    assert name == file.name


@pytest.mark.parametrize("keep", [0.0, 0.5, 0.999])
def test_a_truncated_file_is_refused(file, keep):
    content = file.read_bytes()
    file.write_bytes(content[: int(keep * len(content))])
    with pytest.raises(InputError, match="damaged or incomplete"):
        load_campaign(file)


@pytest.mark.parametrize("gone", ["campaign.h5", "campaign.h5.sha256"])
def test_a_missing_file_is_refused(file, gone):
    file.with_name(gone).unlink()
    with pytest.raises(InputError, match="two files"):
        load_campaign(file)


def test_another_schema_is_refused(file):
    with h5py.File(file, "r+") as content:
        content.attrs["schema"] = "wirecut-campaign-data-9"
    digest = hashlib.sha256(file.read_bytes()).hexdigest()
    file.with_name("campaign.h5.sha256").write_text(f"{digest}  {file.name}\n")
    with pytest.raises(InputError, match="wirecut-campaign-data-9"):
        load_campaign(file)


def test_arrays_are_read_only_and_unknown_columns_named(file):
    campaign = load_campaign(file)
    with pytest.raises(ValueError, match="read-only"):
        campaign.points["g"][0] = 1.0
    with pytest.raises(InputError, match="no column 'G'"):
        campaign.points["G"]


def test_pandas_view(file):
    pytest.importorskip("pandas", reason="pandas is not installed")
    campaign = load_campaign(file)
    points, rows = campaign.to_pandas(), campaign.to_pandas("rows")
    assert len(points) == 12
    assert len(rows) == 24
    assert points.groupby("alpha").size().to_dict() == {2.0: 6, 5.0: 6}
    assert rows.attrs["units"]["strain_energy"] == "mu R_w^2"
    assert "pressure" not in rows


def test_xarray_view(file):
    pytest.importorskip("xarray", reason="xarray is not installed")
    campaign = load_campaign(file)
    view = campaign.to_xarray()
    sizes = {"row": 24, "arc": PROFILE_POINTS, "ahead": 30, "support": 2, "point": 12}
    assert dict(view.sizes) == sizes
    assert view["row_pressure"].dims == ("row", "arc")
    assert view["point_distance"].attrs["units"] == "R_w"
    assert view.attrs["design_hash"] == campaign.design.hash


@pytest.mark.parametrize(("package", "view"), [("pandas", "to_pandas"), ("xarray", "to_xarray")])
def test_without_the_package_the_extra_is_named(file, monkeypatch, package, view):
    monkeypatch.setitem(__import__("sys").modules, package, None)
    with pytest.raises(MissingExtraError, match=r"wirecut\[tables\]"):
        getattr(load_campaign(file), view)()


def test_the_dissipative_force_is_that_of_the_paper_in_its_limits(file):
    campaign = load_campaign(file)
    points = campaign.points
    table = dissipative_force_table(campaign, [0.0, 1e9])
    assert table.force.shape == (12, 2)
    assert table.force[:, 0] == pytest.approx(2 * points["normal_load"])
    assert table.force[:, 1] == pytest.approx(2e9 * points["arc"], rel=1e-6)
    assert np.all(table.error[:, 0] >= 2 * points["normal_load"] * points["normal_load_error"])


@pytest.mark.parametrize("ratio", [-1.0, np.nan, [1.0, np.inf]])
def test_unusable_ratios_are_refused(file, ratio):
    with pytest.raises(InputError, match="wear_to_friction"):
        dissipative_force_table(load_campaign(file), ratio)


def test_a_thousand_rows_stay_below_ten_megabytes(tmp_path, small, rows):
    noise = np.random.default_rng(1)
    many = []
    wide = replace(small, count=250)
    profile = {name: noise.normal(size=300) for name in PROFILES}
    for one in wide.configurations():
        many.append(
            replace(
                rows[0],
                configuration=one,
                record=record(one.alpha, one.target, vertical_force=noise.normal(), **profile),
            )
        )
    assert len(many) == 1000
    assert write_campaign(tmp_path / "large.h5", wide, many).stat().st_size < 10e6

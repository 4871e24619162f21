"""The campaign with friction and wear: its design, its store, and going on after an end."""

from dataclasses import fields, replace
from pathlib import Path

import h5py
import numpy as np
import pytest

from fe_training.campaign.workers import Workers
from fe_training.coupled.__main__ import main
from fe_training.coupled.dataset import COLUMNS, collected, read_coupled
from fe_training.coupled.design import Placed, read_design
from fe_training.coupled.run import again, run_base, run_coupled, waiting
from fe_training.coupled.store import CoupledStore
from fe_training.sliding.record import SlidingOutcome, SlidingRecord
from fe_training.solver.cut import Settings
from surrogate.basics.files import checksum_line
from surrogate.errors import InputError

SHIPPED = Path(__file__).resolve().parents[2] / "models" / "coupled.toml"


@pytest.fixture
def design():
    """Five bases of the shipped design, one of them held out."""
    return replace(read_design(SHIPPED), bases=5, placed=())


def solved(alpha, g, rays, settings, report, taper):
    """Report records without solving anything."""
    for ray in rays:
        for friction, wear in ray:
            report(record(alpha, g, friction, wear, taper))


def record(alpha, g, friction, wear, taper=0.0):
    return SlidingRecord(
        alpha=alpha,
        target=g,
        target_friction=friction,
        target_wear=wear,
        outcome=SlidingOutcome.CONVERGED,
        friction=friction,
        ramp=taper * wear,
        energy_release_rate_across=(g, 1.1 * g),
    )


def test_rows_come_back_as_they_were_written(design, tmp_path):
    store, base = CoupledStore(tmp_path), design.all_bases()[0]
    run_base(base, design.settings, str(tmp_path), solved)
    rows = store.read(base).records
    loads = [load for ray in base.rays for load in ray]
    assert [(row.target_friction, row.target_wear) for row in rows] == loads
    assert rows[0].energy_release_rate_across == (base.g, 1.1 * base.g)
    assert np.isnan(rows[0].steady_force)
    assert waiting(design, store) == design.all_bases()[1:]


def test_a_base_that_was_interrupted_or_damaged_is_solved_again(design, tmp_path):
    store, (first, second, *_) = CoupledStore(tmp_path), design.all_bases()
    store.write(first, [record(first.alpha, first.g, 0.1, 0.0)], {})
    assert len(store.read(first).records) == 1
    run_base(second, design.settings, str(tmp_path), solved)
    (path,) = tmp_path.glob("base-0001.json")
    path.write_bytes(path.read_bytes().replace(b"CONVERGED", b"CONVERGEE", 1))
    assert store.read(second) is None
    assert waiting(design, store) == design.all_bases()


def test_a_load_that_raised_is_a_row_with_its_reason(design, tmp_path):
    base = design.all_bases()[0]

    def broken(alpha, g, rays, settings, report, taper):
        report(record(alpha, g, *rays[0][0]))
        raise ValueError("no such luck")

    run_base(base, design.settings, str(tmp_path), broken)
    first, *others = CoupledStore(tmp_path).read(base).records
    assert first.outcome is SlidingOutcome.CONVERGED
    assert len(others) == sum(map(len, base.rays)) - 1
    assert {row.outcome for row in others} == {SlidingOutcome.STALLED}
    assert {row.reason for row in others} == {"ValueError: no such luck"}


def test_bases_fill_the_ranges_and_more_of_them_keep_the_first(design):
    bases = replace(design, bases=64).all_bases()
    assert bases[:5] == design.all_bases()
    for values, (low, high) in (
        ([base.alpha for base in bases], design.alpha),
        (np.log([base.g for base in bases]), np.log(design.g)),
    ):
        counts, _ = np.histogram(values, bins=8, range=(low, high))
        assert counts.min() >= 7  # a Sobol sequence has 8 of 64 in each eighth, before rounding
    held = [base for base in bases if base.held_out]
    assert len(held) == 12
    counts, _ = np.histogram([base.alpha for base in held], bins=3, range=design.alpha)
    assert counts.min() >= 2
    ends = np.array([ray[-1] for base in bases for ray in base.rays])
    assert (np.isclose(ends[:, 0], 0.5) | np.isclose(ends[:, 1], 10.0)).all()


def test_placed_bases_stand_behind_the_sequence_with_rays_and_a_mesh_of_their_own(design):
    placed = Placed(
        bases=((2.0, 0.01), (3.0, 4.0)),
        ends=((0.5, 0.0), (0.1, 1.0)),
        wear=((0.5, 0.0), (1.5, 0.5)),
        most=2.0,
        shares=(0.1, 1.0),
        settings=replace(design.settings, contact_spacing=0.05),
        finer=replace(design.settings, contact_spacing=0.02),
        taper=0.5,
    )
    longer = replace(design, placed=(placed, placed))
    assert longer.hash == design.hash
    *sequence, _, last, third, _ = longer.all_bases()
    assert sequence == design.all_bases()
    assert (last.number, third.number) == (10_001, 11_000)
    assert (last.alpha, last.g, last.taper) == (3.0, 4.0, 0.5)
    assert last.rays == (((0.05, 0.0), (0.5, 0.0)), ((pytest.approx(0.01), 0.2), (0.1, 2.0)))
    assert third.rays[1][1] == (0.1, 0.5)
    assert longer.settings_of(last).contact_spacing == 0.05
    assert longer.settings_of(sequence[0]) == design.settings
    assert longer.on_finer_mesh().settings_of(last).contact_spacing == 0.02


def test_tapered_bases_are_solved_so_and_no_fit_sees_them(design, tmp_path):
    (first, *_) = design.all_bases()
    run_base(replace(first, taper=0.5), design.settings, str(tmp_path), solved)
    data = collected(design, CoupledStore(tmp_path))
    assert data["ramp"] == pytest.approx(0.5 * data["target_wear"])
    assert data.tapered[data["target_wear"] > 0.0].all()
    assert not data.converged[data.tapered].any()


def test_dask_workers_write_the_rows(design, tmp_path):
    distributed = pytest.importorskip("distributed")
    bases = design.all_bases()
    with distributed.LocalCluster(n_workers=2, processes=False, dashboard_address=None) as cluster:
        run_coupled(
            design,
            CoupledStore(tmp_path),
            bases,
            Workers(scheduler=cluster.scheduler_address),
            solved,
        )
    assert not waiting(design, CoupledStore(tmp_path))


def test_a_base_whose_loads_changed_is_solved_again(design, tmp_path):
    store, base = CoupledStore(tmp_path), design.all_bases()[0]
    run_base(base, design.settings, str(tmp_path), solved)
    assert store.is_finished(base)
    assert not store.is_finished(replace(base, rays=base.rays[::-1]))


def test_a_store_of_another_design_is_refused(design, tmp_path):
    store = CoupledStore(tmp_path)
    with store.opened(design):
        pass
    with store.opened(replace(design, bases=9)):  # more bases are the same design, longer
        pass
    with (
        pytest.raises(InputError, match="belongs to the design"),
        store.opened(replace(design, settings=Settings())),
    ):
        pass


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("wirecut-coupled-1", "wirecut-coupled-0"),
        ("bases = 28", "bases = 0"),
        ("g = [2.5e-3, 100]", "g = [0, 100]"),
        ("friction = 0.5", "friction = -0.5"),
        ("0.8, 1]", "0.8, 0.9]"),
        ("sectors = 22", "sektors = 22"),
        ("0.75, 1]", "0.75]"),
    ],
)
def test_a_design_that_is_none_is_refused_in_one_line(tmp_path, capsys, old, new):
    text = SHIPPED.read_text(encoding="utf-8")
    assert old in text
    path = tmp_path / "design.toml"
    path.write_text(text.replace(old, new), encoding="utf-8")
    assert main([str(path), "--store", str(tmp_path / "store"), "--check"]) == 2
    error = capsys.readouterr().err
    assert "design.toml" in error
    assert error.count("\n") == 1


def test_check_tells_the_counts(design, tmp_path, capsys):
    for base in design.all_bases():
        run_base(base, design.settings, str(tmp_path), solved)
    assert main([str(SHIPPED), "--store", str(tmp_path), "--check"]) == 0
    out = capsys.readouterr().out.split("\n")
    of_all = len(read_design(SHIPPED).all_bases())
    assert out[:3] == [
        "   108 CONVERGED",
        "    27 held out, CONVERGED",
        f"{of_all - 5:6d} of {of_all} bases are not finished",
    ]


def test_the_file_has_every_row_with_its_units(design, tmp_path, capsys):
    for base in design.all_bases():
        run_base(base, design.settings, str(tmp_path / "store"), solved)
    files = [tmp_path / "one.h5", tmp_path / "two.h5"]
    for path in files:
        arguments = ["--store", str(tmp_path / "store"), "--check", "--write", str(path)]
        assert main([str(SHIPPED), *arguments]) == 0
    assert files[0].read_bytes() == files[1].read_bytes()
    data, original = read_coupled(files[0]), collected(design, CoupledStore(tmp_path / "store"))
    assert len(data) == 135
    assert data.converged.all()
    assert data["held_out"].sum() == 27
    for name in COLUMNS:
        np.testing.assert_array_equal(data[name], original[name])
    with h5py.File(files[0]) as file:
        assert {name: file[name].attrs["unit"] for name in COLUMNS} == {
            name: unit for name, (unit, _) in COLUMNS.items()
        }


def test_every_number_of_a_record_has_its_column():
    names = {field.name for field in fields(SlidingRecord)}
    assert names == set(COLUMNS) - {"base", "held_out"}


def test_a_file_that_is_no_data_set_is_refused(tmp_path):
    path = tmp_path / "other.h5"
    path.write_text("no HDF5")
    with pytest.raises(InputError, match=r"other\.h5"):
        read_coupled(path)
    with h5py.File(path, "w") as file:
        file.attrs["schema"] = "another"
    digest = checksum_line(path.name, path.read_bytes())
    path.with_name("other.h5.sha256").write_bytes(digest)
    with pytest.raises(InputError, match="no data set"):
        read_coupled(path)


def test_what_a_finer_mesh_makes_of_loads_is_the_error_of_the_mesh(design, tmp_path):
    store, finer = CoupledStore(tmp_path), CoupledStore(tmp_path / "finer")
    held_out = next(base for base in design.all_bases() if base.held_out)
    ray = held_out.rays[0]

    def sliding(arc, loads):
        return [
            replace(
                record(held_out.alpha, held_out.g, friction, wear),
                wear=wear,
                slip_arc=arc,
                slip_load=0.0,
                first_arc=1.0,
                first_load=0.0,
            )
            for friction, wear in loads
        ]

    stalled = replace(sliding(1.0, ray[2:3])[0], outcome=SlidingOutcome.STALLED)
    store.write(held_out, [*sliding(1.1, ray[:2]), stalled], {})
    (twice,) = again(design, store)
    assert (twice.number, twice.rays) == (held_out.number, (ray[:2],))
    finer.write(twice, sliding(1.0, ray[:2]), {})
    data = collected(design, store, finer)
    assert data["mesh_error"] == pytest.approx([0.1, 0.1, np.nan], nan_ok=True)
    assert np.isnan(collected(design, store)["mesh_error"]).all()
    assert design.on_finer_mesh().settings.contact_spacing < design.settings.contact_spacing
    assert design.on_finer_mesh().hash != design.hash

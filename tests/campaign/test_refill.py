"""A store made again from a data set: the same data come out, and nothing is overwritten."""

from dataclasses import replace

import numpy as np
import pytest
from fake_engine import run

from fe_training.campaign.dataset import load_campaign, write_campaign
from fe_training.campaign.refill import refill, rows_of
from fe_training.campaign.store import Store
from fe_training.solver.record import Outcome
from surrogate.errors import InputError


@pytest.fixture
def rows(small, tmp_path):
    """Made-up rows, one of them failed."""
    rows = run(small, tmp_path / "store")
    failed = replace(rows[3].record, outcome=Outcome.STALLED, reason="it stalled", distance=np.nan)
    rows[3] = replace(rows[3], record=failed, tried=2)
    return rows


@pytest.fixture
def campaign(small, rows, tmp_path):
    return load_campaign(write_campaign(tmp_path / "campaign.h5", small, rows))


def test_the_same_data_set_comes_out(small, campaign, tmp_path):
    again = load_campaign(write_campaign(tmp_path / "again.h5", small, rows_of(campaign)))
    assert again.software == campaign.software
    for before, after in ((campaign.rows, again.rows), (campaign.points, again.points)):
        for name, values in before.columns.items():
            np.testing.assert_array_equal(after[name], values, err_msg=name, strict=True)


def test_rows_have_the_values_that_were_solved(rows, campaign):
    for before, after in zip(rows, rows_of(campaign), strict=True):
        assert after.configuration == before.configuration
        assert (after.attempt, after.tried) == (before.attempt, before.tried)
        assert after.software == before.software
        one, other = before.record, after.record
        assert (other.outcome, other.reason, other.mesh) == (one.outcome, one.reason, one.mesh)
        assert other.energy_release_rate_across == one.energy_release_rate_across
        assert other.touches_plane is one.touches_plane
        assert other.vertical_force == one.vertical_force


def test_only_what_a_store_lacks_is_put_in(small, rows, campaign, tmp_path, row_bytes):
    store = Store(tmp_path / "new")
    with store.opened(small):
        store.write(rows[0])
        mine = row_bytes(store.folder)
        assert refill(store, small, campaign) == len(rows) - 1
        assert refill(store, small, campaign) == 0
    found = row_bytes(store.folder)
    assert len(found) == len(rows)
    assert found.items() >= mine.items()


def test_a_data_set_on_other_meshes_is_refused(small, campaign, tmp_path):
    (name, coarse), *others = small.levels.items()
    finer = replace(coarse, sectors=coarse.sectors + 1)
    other = replace(small, levels={name: finer, **dict(others)})
    store = Store(tmp_path / "new")
    with store.opened(other), pytest.raises(InputError, match=f"the mesh of the level '{name}'"):
        refill(store, other, campaign)


def test_of_a_data_set_of_another_design_the_common_rows_are_taken(small, campaign, tmp_path):
    other = replace(small, alpha=small.alpha[:1])
    store = Store(tmp_path / "new")
    with store.opened(other):
        assert refill(store, other, campaign) == len(other.configurations())
        assert {row.configuration.alpha for row in store.rows(other.configurations())} == {
            small.alpha[0]
        }

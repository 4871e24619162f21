"""The promise of the law "auto", judged by every coupled solution that is shipped."""

import numpy as np
import pytest

from fe_training.coupled.judged import judged_rows
from surrogate import cutting_force
from surrogate.basics.files import model_file
from surrogate.coupling.shipped import amplification


@pytest.fixture(scope="module")
def rows():
    return judged_rows(model_file("coupled.h5"))


@pytest.mark.parametrize("model", ["auto", "table", "gp", "power-law"])
def test_no_force_is_beyond_its_bound_and_the_error_bar_of_the_finite_elements(rows, model):
    force = cutting_force(rows.scene, model, outside="nan")
    known = np.isfinite(force.relative_error)
    off = np.abs(force.total / rows.force - 1.0)
    assert np.all(off[known] <= (force.relative_error + rows.error_bar)[known])
    assert (known & rows.held_out).any()


@pytest.mark.parametrize("law", ["projected", "slip", "coupled"])
@pytest.mark.parametrize("model", ["auto", "table", "power-law"])
def test_a_named_law_is_off_by_what_it_says(rows, model, law):
    force = cutting_force(rows.scene, model, law=law, outside="nan")
    known = np.isfinite(force.relative_error)
    off = np.abs(force.total / rows.force - 1.0)
    assert np.all(off[known] <= (force.relative_error + rows.error_bar)[known])
    assert np.array_equal(force.relative_error, force.fit_error + force.law_error, equal_nan=True)
    assert (known & rows.held_out).any()


def test_a_bound_is_where_solutions_reach_and_nowhere_else(rows):
    _, g, _, xi, wear, alpha = rows.scene.values()
    reached = amplification().share(g, alpha, xi, wear) <= 1.0
    assert np.array_equal(np.isfinite(cutting_force(rows.scene, outside="nan").law_error), reached)


@pytest.mark.parametrize("rtol", [0.3, 0.1, 0.02])
def test_an_rtol_is_met_or_refused(rows, rtol):
    for i in range(0, len(rows), 7):
        one = rows.taken(slice(i, i + 1))
        try:
            force = cutting_force(one.scene, rtol=rtol)
        except ValueError:
            continue
        assert abs(force.total / one.force - 1.0) <= rtol + one.error_bar


def test_the_error_bar_counts_sums_and_meshes(rows):
    assert np.all(rows.error_bar >= 0.0)
    assert np.median(rows.error_bar) < 1e-2
    assert rows.held_out.any()
    assert not rows.held_out.all()

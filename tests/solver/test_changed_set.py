"""Factors that serve a state at which other nodes touch: held against factors made for it."""

from dataclasses import replace

import numpy as np
import pytest

from fe_training.mechanics.active_set import ActiveSet
from fe_training.solver.cut import Settings
from fe_training.solver.equilibrium import ChangedSet, Linearisation, Residual
from fe_training.solver.solve import indentation_cut

AXIS = np.array([1.0, 0.0])


@pytest.fixture(scope="module")
def near():
    cut = indentation_cut(
        5.0, Settings(sectors=12, contact_spacing=0.2, notch_radius=0.02, outer_radius=1e4)
    )
    return cut, cut.at(cut.raised(-2.2), 0.5)


def with_nodes(state, met, left):
    """Return the state with nodes more before the contact, and fewer at its end."""
    wire = state.active.wire.copy()
    first, last = np.flatnonzero(wire)[[0, -1]]
    wire[first - met : first] = True
    wire[last - left + 1 : last + 1] = False
    return replace(state, active=ActiveSet(wire, state.active.plane))


def bare(lin):
    """Take the wire's curvature out of a linearisation, the one term that the factors keep."""
    lin.curvature = np.zeros_like(lin.curvature)
    return lin


@pytest.mark.parametrize(("met", "left"), [(2, 0), (0, 2), (3, 1)])
def test_the_step_is_that_of_factors_made_for_the_nodes(near, met, left, monkeypatch):
    cut, state = near
    monkeypatch.setattr(Linearisation, "_bend_elements", lambda self, tangent: bare(self))
    other = with_nodes(state, met, left)
    fresh = Linearisation(cut.body, other, AXIS)
    newton, move = fresh.directions(cut.solver)
    lin = Linearisation(cut.body, state, AXIS)
    lin.directions(cut.solver)
    at = Residual(cut.body, other)
    changed = ChangedSet(lin, cut.solver, at)
    for direction, exact in ((changed.correction(at), newton), (changed.response(at), move)):
        for name in ("u", "p", "force"):
            a, b = getattr(direction, name), getattr(exact, name)
            assert a == pytest.approx(b, rel=0.0, abs=1e-7 * np.abs(b).max()), name


def test_nodes_that_stay_need_no_columns(near):
    cut, state = near
    lin = Linearisation(cut.body, state, AXIS)
    lin.directions(cut.solver)
    at = Residual(cut.body, state)
    plain, by_columns = lin.correction(cut.solver, at), ChangedSet(lin, cut.solver, at)
    assert by_columns.x.shape[1] == 0
    assert by_columns.correction(at).u == pytest.approx(plain.u, abs=1e-14)

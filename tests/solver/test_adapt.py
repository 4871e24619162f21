"""States carried from one mesh to another that is not nested in it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fe_training.mechanics.body import Body
from fe_training.mechanics.mesh import MeshSpec, crack_mesh
from fe_training.solver.adapt import transferred
from fe_training.solver.cut import Settings
from fe_training.solver.equilibrium import Control, control_value, undeformed
from fe_training.solver.path import Steps
from fe_training.solver.solve import far_field_cut

ROUGH = MeshSpec(notch_radius=0.01, outer_radius=1e3, sectors=8, contact_spacing=0.4)
FINE = Settings(sectors=20, contact_spacing=0.07, outer_radius=1e5)


def test_quadratic_displacements_and_linear_pressures_are_carried_exactly():
    body, other = (
        Body(crack_mesh(spec), 2.0) for spec in (ROUGH, replace(ROUGH, sectors=10, contact_end=5.0))
    )

    def u(places):
        x, y = places.T
        return np.stack([0.1 * x * y + y**2, y * (0.2 * x - 0.3)], axis=1)

    def p(places):
        return 0.3 + places @ [0.2, -0.1]

    state = replace(undeformed(body, -2.0), u=u(body.nodes), p=p(body.pressure_places))
    carried = transferred(body, state, other)
    expected = np.where(other.held, 0.0, u(other.nodes))
    # relative to the size of the field where it is: it grows with the square of the distance
    size = 1.0 + np.hypot(*other.nodes.T) ** 2
    assert np.abs((carried.u - expected) / size[:, None]).max() < 1e-10
    size = 1.0 + np.hypot(*other.pressure_places.T)
    assert np.abs((carried.p - p(other.pressure_places)) / size).max() < 1e-10
    assert carried.tangent is None


def test_touching_nodes_are_those_in_the_same_place():
    body, other = (Body(crack_mesh(replace(ROUGH, sectors=n)), 2.0) for n in (8, 20))
    wire = np.abs(body.along_face - 2.0) < 0.5
    state = undeformed(body, -2.0)
    state = replace(state, active=replace(state.active, wire=wire))
    found = other.along_face[transferred(body, state, other).active.wire]
    assert found.min() == pytest.approx(body.along_face[wire].min(), abs=0.2)
    assert found.max() == pytest.approx(body.along_face[wire].max(), abs=0.2)


def test_a_wire_that_was_raised_on_a_rough_mesh_is_where_it_would_have_been():
    cut = far_field_cut(5.0, 6.0, FINE)
    rough = cut.rough()
    assert rough is not None
    assert rough.body.free.sum() < 0.7 * cut.body.free.sum()
    assert rough.rough() is None
    state = cut.raised(-6.0)
    assert control_value(cut.body, state, Control.POSITION) == -6.0
    assert control_value(cut.body, state, Control.HEIGHT) == 0.0
    direct = cut.last(undeformed(cut.body, -6.0), Control.HEIGHT, 0.0, Steps(0.15, 0.35))
    assert state.vertical_force == pytest.approx(direct.vertical_force, rel=1e-8)
    assert np.abs(state.u - direct.u).max() < 1e-7

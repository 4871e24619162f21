"""Contact as an exact bound: derivatives, Newton's order, complementarity, Hertz."""

import numpy as np
import pytest

from fe_training.mechanics import active_set as contact
from fe_training.mechanics import analytic as reference
from fe_training.mechanics.body import Body
from fe_training.mechanics.mesh import MeshSpec, crack_mesh
from fe_training.solver.equilibrium import (
    Control,
    Linearisation,
    NewtonOutcome,
    control_value,
    equilibrate,
    undeformed,
)
from fe_training.solver.linear_solvers import make_solver

CONTROLS = {
    Control.HEIGHT: 1e-4,
    Control.POSITION: 1e-4,
    Control.DISTANCE: 1e-4,
    Control.FORCE: 1e-5,
}


@pytest.mark.parametrize("touching", [True, False])
def test_matrix_is_the_derivative_of_the_residual_along_the_obstacle(cut, touching, places):
    """Touching nodes move on their circle: its curvature must be in the matrix.

    The rate of the energy along a path is R(u) . u'; its derivative at 0 is x . K x, with x the
    free part of the path's direction.  The central difference of fourth order with step 1e-4
    leaves 1e-10 relative.
    """
    body, state = cut.body, cut.state
    rng = np.random.default_rng(12)
    if not touching:
        state = undeformed(body, -1.2)
    lin = Linearisation(body, state, np.array([1.0, 0.0]))
    assert len(lin.nodes) == touching * state.active.any.sum()
    r = np.hypot(*places(body).T)[:, None]
    du = 1e-3 * np.minimum(r, 1.0) * rng.normal(size=state.u.shape)
    du[body.held] = 0.0
    dp = 1e-2 * rng.normal(size=state.p.shape)
    angle = 1.0 + 0.1 * rng.normal(size=len(lin.nodes))
    arm = body.nodes[lin.nodes] + state.u[lin.nodes] - state.centre

    def rate(t):
        u, rotated = state.u + t * du, du.copy()
        cos, sin = np.cos(t * angle), np.sin(t * angle)
        x, y = arm.T
        turned = np.stack([x * cos - y * sin, x * sin + y * cos], axis=1)
        u[lin.nodes] = state.centre + turned - body.nodes[lin.nodes]
        rotated[lin.nodes] = np.stack([-turned[:, 1], turned[:, 0]], axis=1) * angle[:, None]
        residual = body.gather(body.element_forces(u, state.p + t * dp)[0])
        return residual @ np.concatenate([rotated.ravel(), dp])

    h = 1e-4
    slope = (rate(-2 * h) - 8 * rate(-h) + 8 * rate(h) - rate(2 * h)) / (12 * h)
    x = np.concatenate([du.ravel(), dp])
    pairs = x[: body.displacements].reshape(-1, 2)
    pairs[lin.nodes] = np.stack([0 * angle, angle * np.hypot(*arm.T)], axis=1)
    x = x[body.free] / body.scale[body.free]
    assert x @ (lin.matrix @ x) == pytest.approx(slope, rel=1e-7)
    if touching:  # and the wire's curvature is a part that would be missed
        bent = lin.curvature @ (angle * np.hypot(*arm.T)) ** 2
        assert abs(bent) > 1e-4 * abs(slope)


@pytest.mark.parametrize("control", list(CONTROLS))
def test_tangent_is_the_derivative_of_the_equilibrium(cut, control):
    """The bordered system's direction against two equilibria on either side.

    Central difference of step h: the truncation is h^2 times the third derivative, which is of
    the order of the first per unit of the control, so 1e-6 leaves two digits.
    """
    step = CONTROLS[control]
    target = control_value(cut.body, cut.state, control)
    settled = cut.moved(control, target)
    assert settled.tangent is not None
    ahead, behind = (cut.moved(control, target + sign * step) for sign in (1, -1))
    assert ahead.active.same(settled.active)
    assert behind.active.same(settled.active)
    for name in ("u", "p", "centre"):
        expected = (getattr(ahead, name) - getattr(behind, name)) / (2 * step)
        actual = getattr(settled.tangent, name)
        assert np.abs(actual - expected).max() < 1e-6 * max(np.abs(expected).max(), 1e-3), name


def test_newton_converges_quadratically_at_a_fixed_active_set(cut):
    target = cut.state.centre[0] + 0.004
    exact = cut.moved(Control.POSITION, target)
    start = cut.moved(Control.POSITION, cut.state.centre[0])
    assert exact.active.same(start.active)
    # without the predictor, so that there is a distance to go
    plain = type(start)(start.u, start.p, start.centre, start.active, start.force, start.normal)
    errors = []
    for iterations in (1, 2, 3):
        state, _ = equilibrate(
            cut.body, plain, Control.POSITION, target, make_solver(), max_iterations=iterations
        )
        assert state.active.same(exact.active)
        errors.append(float(np.abs(state.u - exact.u).max()))
    orders = [
        np.log(b / c) / np.log(a / b)
        for a, b, c in zip(errors, errors[1:], errors[2:], strict=False)
        if c > 1e-12
    ]
    assert errors[-1] < 1e-8
    # an order below 1.7 would mean that a derivative is missing
    assert not orders or min(orders) > 1.7, errors


def states(cut):
    yield cut.state
    yield cut.moved(Control.POSITION, -0.8)
    yield cut.moved(Control.HEIGHT, -0.1)


def test_contact_pushes_nothing_passes_and_a_force_needs_a_touch(cut):
    """Complementarity, with the tolerances that the active set itself uses."""
    for state in states(cut):
        body = cut.body
        geo = contact.geometry(body, state.u, state.centre, state.active)
        total = state.force.sum()
        assert state.force.min() >= -1e-9 * total
        assert geo.wire_distance.min() >= 1.0 - 1e-11
        assert np.abs(geo.gap[state.active.any]).max() <= 1e-10 * max(1.0, state.residual)
        assert not state.force[~state.active.any].any()
        near = body.nodes[body.face, 0] > -100.0
        assert (body.nodes + state.u)[body.face[near], 1].min() >= -1e-11


def test_contact_force_balances_the_held_boundary_and_nothing_else(cut):
    """Internal forces add up to nothing; free nodes have none; the rest is contact."""
    body, state = cut.body, cut.state
    forces = body.gather(body.element_forces(state.u, state.p)[0])[: body.displacements]
    forces = forces.reshape(-1, 2)
    rigid = np.ones(len(body.nodes), dtype=bool)
    rigid[np.unique(body.connectivity[:, 6:])] = False
    size = state.force.sum()
    assert np.abs(forces[rigid].sum(axis=0)).max() < 1e-10 * size
    touching = body.face[state.active.any]
    loose = ~body.held.copy()
    loose[touching] = False
    assert np.abs(forces[loose]).max() < 1e-9 * size
    assert state.horizontal_force == pytest.approx(
        forces[body.face[state.active.wire], 0].sum(), rel=1e-9
    )
    assert state.vertical_force == pytest.approx(
        forces[body.face[state.active.wire], 1].sum(), rel=1e-9
    )


def test_an_untouched_body_stays_at_rest(cut):
    state, outcome = equilibrate(
        cut.body, undeformed(cut.body, -1.2), Control.HEIGHT, -1.01, make_solver()
    )
    assert outcome is NewtonOutcome.CONVERGED
    assert not state.u.any()
    assert not state.force.any()


def test_two_routes_lead_to_one_configuration(cut):
    """Height then position, against position then height."""
    body, solver = cut.body, make_solver()
    there = cut.moved(Control.POSITION, -1.1)
    low, outcome = equilibrate(body, cut.state, Control.HEIGHT, -0.1, solver)
    assert outcome is NewtonOutcome.CONVERGED
    low, outcome = equilibrate(body, low, Control.POSITION, -1.1, solver)
    assert outcome is NewtonOutcome.CONVERGED
    back, outcome = equilibrate(body, low, Control.HEIGHT, 0.0, solver)
    assert outcome is NewtonOutcome.CONVERGED
    assert back.active.same(there.active)
    # both hold the residual below 1e-6 of the force; lengths are of order 1
    np.testing.assert_allclose(back.u, there.u, rtol=0, atol=1e-7)
    assert back.vertical_force == pytest.approx(there.vertical_force, rel=1e-7)


@pytest.mark.parametrize("alpha", [2.0, 9.0])
def test_a_shallow_wire_far_from_the_tip_presses_as_hertz_says(alpha):
    """Width and distribution of the pressure of a wire 5 radii behind the tip.

    The second moment of Hertz's pressure about its middle is ``a^2/4``; nodal forces of quadratic
    elements keep it exactly.  What is left is finite strain and the height of the arc, of order
    a^2, which two depths eliminate, the tip, (a/delta)^2, and the end of the contact lying between
    two nodes, of order (spacing/a)^1.5 times its small share of the moment: 0.3 % together.
    """
    position = -5.0
    spec = MeshSpec(
        sectors=12,
        notch_radius=0.2,
        outer_radius=1e5,
        contact_start=4.7,
        contact_end=5.3,
        contact_spacing=0.03,
    )
    body = Body(crack_mesh(spec), alpha)
    solver, state = make_solver(), undeformed(body, position)
    squares, excess = [], []
    for height in (-0.995, -0.98, -0.95, -0.9):
        state, outcome = equilibrate(body, state, Control.HEIGHT, height, solver)
        assert outcome is NewtonOutcome.CONVERGED
        touching = state.active.wire
        x = (body.nodes + state.u)[body.face[touching], 0]
        force = state.force[touching]
        total = force.sum()
        middle = force @ x / total
        a = reference.hertz_line_contact(state.vertical_force).half_width
        width = 2 * np.sqrt(force @ (x - middle) ** 2 / total)
        squares.append(a**2)
        excess.append(width / a - 1)
    assert middle == pytest.approx(position, abs=0.01 * a)
    # fourth moment a^4/8: the shape, that is the peak at a given width
    assert force @ (x - middle) ** 4 / total == pytest.approx(width**4 / 8, rel=a**2)
    slope = (excess[-1] - excess[-2]) / (squares[-1] - squares[-2])
    assert abs(slope) < 1.0
    assert excess[-2] - slope * squares[-2] == pytest.approx(0.0, abs=3e-3)


@pytest.mark.parametrize("distance", [50.0])
def test_far_field_wedge(distance):
    """B, A and J of a wire far behind the tip against the linear solution.

    The linear solution leaves out the strain under the wire, a/R = 0.5, and the finite height of
    the contact's ends: B and the height of the wire agree to order a^2/4 = 7 %.  The relation of
    J and F_v knows nothing of the contact's details and holds to 1 %.
    """
    from fe_training.solver.energy_release import domain_integral

    spec = MeshSpec(
        sectors=14,
        notch_radius=1.0,
        outer_radius=1e7,
        contact_start=distance - 1.5,
        contact_end=distance + 1.5,
        contact_spacing=0.15,
    )
    body = Body(crack_mesh(spec), 2.0)
    solver, state = make_solver(), undeformed(body, -distance)
    for height in (-0.95, -0.85, -0.7, -0.5, -0.25, 0.0):
        state, outcome = equilibrate(body, state, Control.HEIGHT, height, solver)
        assert outcome is NewtonOutcome.CONVERGED
    delta = control_value(body, state, Control.DISTANCE)
    rate = domain_integral(body, state, 5.0, 40.0)
    pointed = reference.point_force_energy_release_rate(state.vertical_force, delta)
    assert rate == pytest.approx(pointed, rel=0.01)
    wedge = reference.far_field_wedge(delta)
    assert state.vertical_force == pytest.approx(wedge.vertical_force, rel=0.07)
    normals = state.normal[state.active.wire, 0]
    assert normals.max() - normals.min() == pytest.approx(wedge.contact_width, rel=0.07)

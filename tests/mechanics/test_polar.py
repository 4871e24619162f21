"""Elements that interpolate polar coordinates about the wire, and bodies refined on their path."""

import numpy as np
import pytest

from fe_training.mechanics import kernels, ogden
from fe_training.mechanics.active_set import no_contact
from fe_training.mechanics.body import Body
from fe_training.mechanics.mesh import MeshSpec, crack_mesh
from fe_training.solver import adapt
from fe_training.solver.equilibrium import State

CENTRE = np.array([-1.2, -0.9])
SPEC = MeshSpec(notch_radius=0.05, outer_radius=10.0, sectors=8, contact_spacing=0.5)


@pytest.fixture
def disturbed():
    """A body whose elements near the tip are polar, and random displacements, pressures, rates."""
    body = Body(crack_mesh(SPEC), 3.0, bulk=2.0, polar=5.0)
    assert 0 < body.polar.sum() < len(body.polar)
    rng = np.random.default_rng(0)
    r = np.minimum(np.hypot(*body.nodes.T), 1.0)[:, None]
    u = 0.03 * r * rng.normal(size=body.nodes.shape)
    p = rng.normal(size=len(body.pressure_places))
    return body, u, p, r * rng.normal(size=u.shape), rng.normal(size=p.shape)


def slope(f, h=1e-4):
    """Central difference of fourth order: h^4 = 1e-16 of the fifth derivative, rounding 1e-12."""
    return (f(-2 * h) - 8 * f(-h) + 8 * f(h) - f(2 * h)) / (12 * h)


def energy(body, u, p, centre):
    H = body.displacement_gradient(u, centre=centre)
    W = ogden.energy(H, body.alpha, body.bulk[:, None])
    return float(((W + body.pressure_at_points(p) * ogden.volume_change(H)) * body.dx).sum())


def test_loop_and_twin_agree(disturbed):
    body, u, p, _, _ = disturbed
    if kernels._compiled() is None:
        pytest.skip("numba is not installed")
    elements = np.flatnonzero(body.polar)
    arguments = (
        body.about(u, CENTRE, elements),
        p[body.triangles[elements]],
        body.shape,
        body.grad[elements],
        body.psi,
        body.dx[elements],
        body.alpha,
        body.bulk[elements],
    )
    loop, twin = body._polar_arrays(*arguments), kernels.polar_arrays_numpy(*arguments)
    for actual, expected in zip(loop, twin, strict=True):
        np.testing.assert_allclose(actual, expected, rtol=0, atol=1e-12 * np.abs(expected).max())


def test_residual_tangent_and_centre_are_derivatives(disturbed):
    body, u, p, du, dp = disturbed
    R, K = body.element_forces(u, p, CENTRE)
    v = np.concatenate([du.ravel(), dp])
    rate = slope(lambda t: energy(body, u + t * du, p + t * dp, CENTRE))
    assert body.gather(R) @ v == pytest.approx(rate, rel=1e-8)

    def along(t):
        return body.gather(body.element_forces(u + t * du, p + t * dp, CENTRE)[0]) @ v

    local = v[body.element_unknowns]
    assert np.einsum("ei,eij,ej", local, K, local) == pytest.approx(slope(along), rel=1e-8)
    axis = np.array([0.7, 0.3])
    moving = slope(lambda t: body.gather(body.element_forces(u, p, CENTRE + t * axis)[0]) @ v)
    assert body.centre_rate(K, axis) @ v == pytest.approx(moving, rel=1e-8)


def test_a_rotation_about_the_wire_is_exact(disturbed):
    """The angle grows by a constant: an incompressible element sees nothing of it."""
    body = disturbed[0]
    at_rest = body.displacement_gradient(np.zeros_like(body.nodes), centre=CENTRE)
    turn = np.array([[np.cos(0.3), -np.sin(0.3)], [np.sin(0.3), np.cos(0.3)]])
    arm = body.nodes - CENTRE
    turned = body.displacement_gradient(arm @ turn.T - arm, centre=CENTRE)
    np.testing.assert_allclose(
        turned[:, :, body.polar], at_rest[:, :, body.polar], rtol=0, atol=1e-12
    )


def test_refinement_carries_the_deformation_over(disturbed):
    """The finer mesh is nested: each of its nodes lies on the coarse interpolation.

    A second refinement of everything from the first one, or at once, meets the same function, so
    the energies agree to the quadrature's error, which falls with its order, 4, or faster.
    """
    body, u, p, _, _ = disturbed
    u[body.held] = 0.0
    n = len(body.face)
    state = State(u, p, CENTRE, no_contact(body), np.zeros(n), np.zeros((n, 2)))
    energies = [energy(body, u, p, CENTRE)]
    for _ in range(3):
        body, state = adapt.refined(body, state, np.arange(len(body.polar)))
        energies.append(energy(body, state.u, state.p, state.centre))
    changes = np.abs(np.diff(energies))
    assert changes[2] < 1e-6 * energies[0]
    assert changes[2] < changes[0]


def test_scatter_is_nothing_where_areas_are_kept():
    body = Body(crack_mesh(SPEC), 3.0)
    x, y = body.nodes.T
    u = np.stack([0.4 * y, 0.0 * x], axis=1)  # simple shear
    n = len(body.face)
    state = State(u, np.zeros(1), CENTRE, no_contact(body), np.zeros(n), np.zeros((n, 2)))
    assert adapt.determinant_scatter(body, state).max() < 1e-12

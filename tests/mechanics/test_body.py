"""The discretised body: derivatives of its energy, the patch test and convergence rates."""

import numpy as np
import pytest
from skfem import Basis, LinearForm, MeshTri

from fe_training.mechanics import ogden
from fe_training.mechanics.body import ELEMENTS, Body
from fe_training.mechanics.mesh import MeshSpec, crack_mesh
from fe_training.solver.energy_release import strain_energy
from fe_training.solver.equilibrium import State

ALPHAS = [2.0, 5.0, 9.0]
each_element = pytest.mark.parametrize("element", sorted(ELEMENTS))


def unstructured_square(n, seed=0):
    """Return triangles of the unit square with their inner vertices moved about."""
    mesh = MeshTri.init_tensor(np.linspace(0, 1, n + 1), np.linspace(0, 1, n + 1))
    points = mesh.p.copy()
    inner = ((points > 0) & (points < 1)).all(axis=0)
    shift = np.random.default_rng(seed).uniform(-0.2, 0.2, points.shape) / n
    points[:, inner] += shift[:, inner]
    return MeshTri(points, mesh.t)


def all_but_the_right_side(nodes):
    held = (nodes[:, 0] < 1e-12) | (nodes[:, 1] < 1e-12) | (nodes[:, 1] > 1 - 1e-12)
    return np.stack([held, held], axis=1)


def virtual_work(body, element, nominal_stress, degree=10):
    """Return the load int P : grad v of a stress field that is given as P(X, Y)."""
    basis = Basis(body.mesh, ELEMENTS[element][0](), intorder=degree)
    load = np.zeros(body.size)
    for i in range(2):

        @LinearForm
        def work(v, w, i=i):
            P = nominal_stress(*w.x)
            return P[i, 0] * v.grad[0] + P[i, 1] * v.grad[1]

        load[i : body.displacements : 2] = work.assemble(basis)
    return load


@pytest.fixture(scope="module", params=[*((a, "taylor-hood") for a in ALPHAS), (5.0, None)])
def disturbed(request, places):
    """A half body of any shape of strain, some elements inverted, and its unknowns."""
    alpha, element = request.param
    body = Body(
        crack_mesh(MeshSpec(notch_radius=0.05, outer_radius=30.0, sectors=8, contact_spacing=2.0)),
        alpha,
        bulk=3.0,
        **({"element": element} if element else {}),
    )
    rng = np.random.default_rng(10)
    r = np.hypot(*places(body).T)[:, None]
    u = 0.04 * r * rng.normal(size=body.nodes.shape)
    p = rng.normal(size=body.size - body.displacements)
    directions = (r * rng.normal(size=u.shape), rng.normal(size=p.shape))
    return body, u, p, directions


def five_point(function, step):
    """Return the derivative at 0 by the central difference of fourth order."""
    values = [function(k * step) for k in (-2, -1, 1, 2)]
    return (values[0] - 8 * values[1] + 8 * values[2] - values[3]) / (12 * step)


def test_residual_is_the_derivative_of_the_energy(disturbed):
    """Fourth order with a step of 1e-4 relative: truncation 1e-14 (alpha large), rounding 1e-11."""
    body, u, p, (du, dp) = disturbed

    def energy(t):
        zero = np.zeros((0, 2))
        return strain_energy(body, State(u + t * du, p + t * dp, zero, None, zero, zero))

    residual = body.gather(body.element_forces(u, p)[0])
    slope = residual @ np.concatenate([du.ravel(), dp])
    assert five_point(energy, 1e-4) == pytest.approx(slope, rel=1e-8)


def test_matrix_is_the_derivative_of_the_residual(disturbed):
    body, u, p, (du, dp) = disturbed
    direction = np.concatenate([du.ravel(), dp])
    direction[~body.free] = 0.0
    du, dp = direction[: body.displacements].reshape(-1, 2), direction[body.displacements :]

    def residual(t):
        return body.gather(body.element_forces(u + t * du, p + t * dp)[0])

    matrix = body.matrix(body.element_forces(u, p)[1])
    scale = body.scale[body.free]
    product = matrix @ (direction[body.free] / scale) / scale
    expected = five_point(residual, 1e-4)[body.free]
    assert np.abs(product - expected).max() < 1e-8 * np.abs(expected).max()
    assert abs(matrix - matrix.T).max() <= 1e-13 * abs(matrix).max()


def test_eliminated_rows_and_columns_are_the_identity(disturbed):
    body, u, p, _ = disturbed
    matrix = body.matrix(body.element_forces(u, p)[1])
    fixed = np.random.default_rng(11).random(matrix.shape[0]) < 0.2
    reduced = body.eliminate(matrix, fixed)
    dense, plain = reduced.toarray(), matrix.toarray()
    np.testing.assert_array_equal(dense[fixed][:, fixed], np.eye(fixed.sum()))
    assert not dense[fixed][:, ~fixed].any()
    assert not dense[~fixed][:, fixed].any()
    np.testing.assert_array_equal(dense[~fixed][:, ~fixed], plain[~fixed][:, ~fixed])


def test_a_rigid_motion_has_no_force(disturbed):
    body = disturbed[0]
    turn = np.array([[0.0, -1.0], [1.0, 0.0]])
    u = body.nodes @ (turn - np.eye(2)).T + [3.0, -7.0]
    u[np.unique(body.connectivity[:, 6:])] = 0.0  # a bubble takes no part in it
    forces, _ = body.element_forces(u, np.zeros(body.size - body.displacements))
    # nodal forces are stress times length; rounding of positions of size r is eps r
    assert np.abs(body.gather(forces)).max() < 1e-13 * body.outer_radius


@each_element
@pytest.mark.parametrize("alpha", ALPHAS)
def test_a_homogeneous_finite_deformation_is_reproduced(alpha, element, framed_body, relaxed):
    """Patch test: sides held in the deformation, the right one under its dead load."""
    body = framed_body(unstructured_square(5), alpha, all_but_the_right_side, element=element)
    H = np.array([[0.4, 0.3], [-0.2, (1 + 0.3 * -0.2) / 1.4 - 1]])
    assert ogden.volume_change(H) == pytest.approx(0.0, abs=1e-15)
    pressure = 0.7
    P = ogden.stress(H, np.array(pressure), alpha)
    exact = body.nodal(lambda *x: np.tensordot(H, x, 1))
    load = virtual_work(body, element, lambda x, y: P[:, :, None, None] + 0 * x)
    start = np.where(body.held, exact, 0.9 * exact)
    found = relaxed(body, start, load=load)
    np.testing.assert_allclose(found.u, exact, rtol=0, atol=1e-11)
    np.testing.assert_allclose(found.p, pressure, rtol=0, atol=1e-9)


# An incompressible deformation by two shears in turn, x = X + g(Y), y = Y + h(x), and a pressure.


def shears(X, Y):
    """Return displacements and their gradient."""
    g, dg = 0.2 * np.sin(2 * Y), 0.4 * np.cos(2 * Y)
    x = X + g
    h, dh = 0.25 * np.sin(2.5 * x + 0.3), 0.625 * np.cos(2.5 * x + 0.3)
    zero = np.zeros_like(g)
    return np.array([g, h]), np.array([[zero, dg], [dh, dh * dg]])


def pressure_field(X, Y):
    return np.cos(2 * X) * np.sin(1.5 * Y + 0.2)


def neo_hookean_stress(X, Y):
    """P = F - cof F + p cof F, written out apart from the engine."""
    H = shears(X, Y)[1]
    F = H + np.eye(2).reshape(2, 2, *(1,) * X.ndim)
    cofactor = np.array([[F[1, 1], -F[1, 0]], [-F[0, 1], F[0, 0]]])
    return F - cofactor + pressure_field(X, Y) * cofactor


def errors(body, element, found):
    """Return L2 and H1 errors of the displacements and the L2 error of the pressure."""
    basis, pressures = (Basis(body.mesh, each(), intorder=8) for each in ELEMENTS[element])
    x = basis.global_coordinates()
    exact, gradient = shears(*np.asarray(x))
    value = slope = 0.0
    for i in range(2):
        field = basis.interpolate(found.u[:, i])
        value += np.sum((np.asarray(field) - exact[i]) ** 2 * basis.dx)
        slope += np.sum((field.grad - gradient[i]) ** 2 * basis.dx)
    p = np.asarray(pressures.interpolate(found.p)) - pressure_field(*np.asarray(x))
    return np.sqrt([value, slope, np.sum(p**2 * basis.dx)])


@each_element
@pytest.mark.parametrize("alpha", [2.0, 5.0])
def test_convergence_rates_are_those_of_the_element(alpha, element, framed_body, relaxed):
    """Displacements converge with 3 in L2 and 2 in H1, pressures with 2 in L2.

    The sides but one are held in the exact finite deformation; the body force and the traction
    of the remaining side enter as the virtual work of the exact stress.
    """

    def stress(X, Y):
        if alpha == 2.0:
            return neo_hookean_stress(X, Y)
        return ogden.stress(shears(X, Y)[1], pressure_field(X, Y), alpha)

    found = []
    for n in (8, 16, 32, 64):
        body = framed_body(unstructured_square(n), alpha, all_but_the_right_side, element=element)
        start = body.nodal(lambda *x: shears(*x)[0])
        state = relaxed(body, start, load=virtual_work(body, element, stress))
        found.append(errors(body, element, state))
    rates = np.log2(np.array(found[:-1]) / found[1:])
    # the mesh's own irregularity differs from size to size: a tenth of an order
    np.testing.assert_array_less([2.9, 1.9, 1.9], rates[-1])


def test_held_nodes_follow_the_choice_of_arc():
    mesh = crack_mesh(MeshSpec(notch_radius=0.05, outer_radius=30.0, sectors=8))
    bodies = {hold: Body(mesh, 2.0, hold=hold) for hold in ("right", "all", "none")}
    nodes = bodies["all"].nodes
    arc = np.hypot(*nodes.T) > 0.95 * 30
    ligament = (nodes[:, 1] == 0) & (nodes[:, 0] > 0)
    for body in bodies.values():
        assert body.held[ligament, 1].all()
        assert not body.held[~arc, 0].any()
        assert not body.held[~arc & ~ligament].any()
    assert bodies["all"].held[arc].all()
    np.testing.assert_array_equal(bodies["right"].held[arc, 0], nodes[arc, 0] >= 0)
    assert not bodies["none"].held[:, 0].any()


def test_face_runs_from_the_tip_backwards():
    body = Body(crack_mesh(MeshSpec(notch_radius=0.05, outer_radius=30.0, sectors=8)), 2.0)
    x, y = body.nodes[body.face].T
    assert (x[0], y[0]) == pytest.approx((0.05, 0.0))
    assert (np.diff(x) < 0).all()
    assert x[-1] == pytest.approx(-30.0)
    assert (y[x < -0.05] == 0).all()

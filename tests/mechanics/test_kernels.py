"""The compiled element loop and its numpy twin are one function.

Both evaluate the same formulas in another order.  The tolerance of 1e-12, relative to the largest
entry of the element, leaves room for the sum over quadrature points; 1e-13 is seen.
"""

import numpy as np
import pytest

from fe_training.mechanics import kernels, ogden
from fe_training.mechanics.body import Body
from fe_training.mechanics.mesh import MeshSpec, crack_mesh

TOLERANCE = 1e-12
compiled, compiled_polar = kernels._compiled() or (None, None)
needs_numba = pytest.mark.skipif(compiled is None, reason="numba is not installed")


def assert_same(arguments):
    for actual, expected in zip(
        compiled(*arguments), kernels.element_arrays_numpy(*arguments), strict=True
    ):
        assert np.isfinite(actual).all()
        axes = tuple(range(1, expected.ndim))
        error = np.abs(actual - expected).max(axis=axes)
        size = np.abs(expected).max(axis=axes)
        assert (error <= TOLERANCE * size).all(), (error / size).max()


def one_point(gradients, pressures, alpha, kappa):
    """Return arguments of two-node elements whose one point has these displacement gradients."""
    n = len(gradients)
    u = np.ascontiguousarray(np.transpose(gradients, (0, 2, 1)))
    grad = np.broadcast_to(np.eye(2), (n, 1, 2, 2)).copy()
    return u, pressures[:, None], grad, np.ones((1, 1)), np.ones((n, 1)), alpha, kappa


def turned(l1, l2, rng):
    (a, b) = rng.uniform(0, 2 * np.pi, 2)

    def turn(x):
        return np.array([[np.cos(x), -np.sin(x)], [np.sin(x), np.cos(x)]])

    return turn(a) @ np.diag([l1, l2]) @ turn(b) - np.eye(2)


def extremes():
    rng = np.random.default_rng(3)
    pairs = [
        (1.0, 1.0),
        (1 + 1e-8, 1 - 1e-8),
        (1.5, 1.5),
        (1.5 + 1e-9, 1.5),
        (1.5 + 1e-5, 1.5),
        (3.0, 1 / 3),
        (1e3, 1e-3),
        (1e3, 0.9e3),
        (2.0, 1e-4),
        (2.0, 0.21),
        (2.0, 0.19),
        (1.4, -0.3),
        (30.0, -10.0),
        (1e3, -1.0),
    ]
    exact = [np.zeros((2, 2)), 0.5 * np.eye(2), np.diag([0.2, -2.2]), np.diag([1.0, -0.75])]
    return np.array([turned(*pair, rng) for pair in pairs] + exact)


@needs_numba
@pytest.mark.parametrize("alpha", [1.5, 2.0, 5.0, 9.0])
@pytest.mark.parametrize("kappa", [0.0, 20.0])
def test_loop_and_twin_agree_at_extremes(alpha, kappa):
    H = extremes()
    p = np.random.default_rng(4).normal(size=len(H))
    assert_same(one_point(H, p, alpha, np.full(len(H), kappa)))


@needs_numba
@pytest.mark.parametrize("alpha", [2.0, 9.0])
@pytest.mark.parametrize("size", [1e-9, 1e-3, 0.3])
def test_loop_and_twin_agree_on_a_mesh(alpha, size, places):
    """Displacements that scale with the distance: strains of `size` at all radii."""
    body = Body(crack_mesh(MeshSpec(notch_radius=0.02, outer_radius=1e3, sectors=12)), alpha)
    rng = np.random.default_rng(5)
    r = np.hypot(*places(body).T)[:, None]
    u = size * r * rng.normal(size=body.nodes.shape)
    p = rng.normal(size=body.size - body.displacements)
    arguments = (u[body.connectivity], p[body.triangles], body.grad, body.psi, body.dx)
    assert_same((*arguments, alpha, rng.uniform(0, 9, len(body.dx))))


@pytest.mark.parametrize("loop", [pytest.param(compiled, marks=needs_numba), "twin"])
def test_element_arrays_are_the_material_point_by_point(loop):
    """One point of unit weight returns stress, cofactor and tangent themselves."""
    arrays = kernels.element_arrays_numpy if loop == "twin" else loop
    H = extremes()
    alpha, p, kappa = 5.0, np.linspace(-1, 1, len(H)), np.full(len(H), 3.0)
    residual, K = arrays(*one_point(H, p, alpha, kappa))
    for i, h in enumerate(H):
        P, A = ogden.stress(h, p[i], alpha, 3.0), ogden.tangent(h, p[i], alpha, 3.0)
        # unknowns are ordered node by node: component k of node j stands for F[k, j]
        np.testing.assert_allclose(
            residual[i, :4], P.T.ravel(), rtol=0, atol=TOLERANCE * np.abs(P).max()
        )
        assert residual[i, 4] == pytest.approx(ogden.volume_change(h), rel=1e-14, abs=1e-15)
        np.testing.assert_allclose(
            K[i, :4, :4],
            A.transpose(1, 0, 3, 2).reshape(4, 4),
            rtol=0,
            atol=TOLERANCE * np.abs(A).max(),
        )
        np.testing.assert_allclose(K[i, :4, 4], ogden.cofactor(h).T.ravel(), rtol=1e-15)
        np.testing.assert_array_equal(K[i, 4, :4], K[i, :4, 4])
        assert K[i, 4, 4] == 0.0


def test_twin_stands_in_where_numba_is_missing(monkeypatch):
    monkeypatch.setattr(kernels, "find_spec", lambda name: None)
    monkeypatch.setattr(kernels, "_compiled", kernels._compiled.__wrapped__)
    assert kernels.element_arrays() == (kernels.element_arrays_numpy, kernels.polar_arrays_numpy)


def test_twin_is_taken_on_request():
    plain, polar = kernels.element_arrays(compiled=False)
    assert plain is kernels.element_arrays_numpy
    assert polar is kernels.polar_arrays_numpy

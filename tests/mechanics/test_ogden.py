"""Energy, stress and tangent of the solid against 60-digit arithmetic on the energy alone.

The reference evaluates ``W`` from the principal stretches with mpmath and differentiates it by
central differences of step 1e-15 at 60 digits, whose error (1e-30 relative) does not count.

Tolerances: a power l^m is formed as exp(m log l), whose exponent is at most 8 log(1e3) = 55, so
that rounding costs 55 eps = 1e-14; some tens of operations follow.  1e-13 of the largest
component is asked for throughout.
"""

import mpmath
import numpy as np
import pytest

from fe_training.mechanics import ogden

TOLERANCE = 1e-13
ALPHAS = [2.0, 3.5, 5.0, 9.0]


def rotation(angle):
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


def stretched(l1, l2, before=0.4, after=1.1):
    return rotation(after) @ np.diag([l1, l2]) @ rotation(before) - np.eye(2)


RANDOM = np.array([[0.31, -0.72], [0.55, 0.18]])
GRADIENTS = {
    "rest": np.zeros((2, 2)),
    "strain 1e-8": 1e-8 * RANDOM,
    "strain 1e-4": 1e-4 * RANDOM,
    "below the series' end": 0.03 * RANDOM,
    "moderate": RANDOM,
    "incompressible": stretched(3.0, 1 / 3.0),
    "rigid quarter turn": np.array([[-1.0, -1.0], [1.0, -1.0]]),
    "coalescing": 1.5 * np.eye(2) - np.eye(2),
    "nearly coalescing": stretched(1.5, 1.5 * (1 + 1e-9)),
    "close to coalescing": stretched(1.5, 1.5 * (1 + 1e-5)),
    "stretch 1e3": stretched(1e3, 1e-3),
    "stretch 1e3 both ways": stretched(1e3, 0.9e3),
    "flattened": stretched(2.0, 1e-4),
    "inverted": stretched(1.4, -0.3),
    "inverted far": stretched(30.0, -10.0),
    "reflected": np.array([[1.3, 0.2], [0.3, -2.9]]),
    "mirrored exactly": np.diag([0.2, -2.2]),
}


def exact_energy(F, alpha, kappa, pressure):
    a, b = F[0] + F[3], F[2] - F[1]
    c, e = F[0] - F[3], F[2] + F[1]
    s, d = mpmath.sqrt(a * a + b * b), mpmath.sqrt(c * c + e * e)
    l1, l2 = (s + d) / 2, abs(s - d) / 2
    change = F[0] * F[3] - F[1] * F[2] - 1
    alpha = mpmath.mpf(alpha)
    power = l1**alpha + (l2**alpha if l2 else 0) - 2
    return (
        2 / alpha**2 * power
        - 2 / alpha * change
        + mpmath.mpf(kappa) / 2 * change**2
        + mpmath.mpf(pressure) * change
    )


def exact(H, alpha, kappa, pressure):
    """Return energy (without the pressure's), stress and tangent at 60 digits, rounded."""
    with mpmath.workdps(60):
        step = mpmath.mpf("1e-15")
        F = [mpmath.mpf(float(h)) for h in H.ravel()]
        F[0] += 1
        F[3] += 1

        def at(*moves):
            G = list(F)
            for i, sign in moves:
                G[i] += sign * step
            return exact_energy(G, alpha, kappa, pressure)

        W = exact_energy(F, alpha, kappa, 0)
        P = [(at((i, 1)) - at((i, -1))) / (2 * step) for i in range(4)]
        A = [
            [
                (
                    at((i, 1), (j, 1))
                    - at((i, 1), (j, -1))
                    - at((i, -1), (j, 1))
                    + at((i, -1), (j, -1))
                )
                / (4 * step**2)
                for j in range(4)
            ]
            for i in range(4)
        ]
        return (
            float(W),
            np.array(P, dtype=float).reshape(2, 2),
            np.array(A, dtype=float).reshape(2, 2, 2, 2),
        )


def assert_close(actual, expected, scale=None):
    scale = np.abs(expected).max() if scale is None else scale
    assert np.abs(actual - expected).max() <= TOLERANCE * scale


@pytest.mark.parametrize("alpha", ALPHAS)
@pytest.mark.parametrize("name", GRADIENTS)
@pytest.mark.parametrize(("kappa", "pressure"), [(0.0, 0.0), (7.0, -1.7)])
def test_energy_stress_and_tangent_are_exact(name, alpha, kappa, pressure):
    H = GRADIENTS[name]
    W, P, A = exact(H, alpha, kappa, pressure)
    strain = np.linalg.svd(np.eye(2) + H, compute_uv=False) - 1
    # relative to W up to what rounding of H's own entries changes in it, |P| eps |F|
    assert ogden.energy(H, alpha, kappa) == pytest.approx(
        W, rel=TOLERANCE, abs=TOLERANCE * (strain @ strain) + 1e-30
    )
    p = np.array(pressure)
    assert_close(ogden.tangent(H, p, alpha, kappa), A)
    # an unstressed but turned solid has its stress from rounding of F, times the stiffness
    slack = np.abs(A).max() * 4e-16 / TOLERANCE * np.abs(H).max()
    assert_close(ogden.stress(H, p, alpha, kappa), P, max(np.abs(P).max(), slack, 1e-15))


@pytest.mark.parametrize("alpha", ALPHAS)
@pytest.mark.parametrize("strain", [1e-12, 1e-8, 1e-5, 1e-3, 0.029, 0.031, 0.3])
def test_energy_keeps_its_digits_at_small_strain(alpha, strain):
    H = strain * RANDOM
    W, P, _ = exact(H, alpha, 0.0, 0.0)
    assert ogden.energy(H, alpha) == pytest.approx(W, rel=TOLERANCE)
    assert_close(ogden.stress(H, np.array(0.0), alpha), P)


@pytest.mark.parametrize("alpha", ALPHAS)
def test_arrays_give_what_single_gradients_give(alpha):
    H = np.stack(list(GRADIENTS.values()), axis=-1)
    p = np.linspace(-1.0, 1.0, H.shape[-1])
    P, A = ogden.stress(H, p, alpha, 3.0), ogden.tangent(H, p, alpha, 3.0)
    W = ogden.energy(H, alpha, 3.0)
    for i in range(H.shape[-1]):
        single = H[:, :, i]
        assert_close(P[..., i], ogden.stress(single, p[i], alpha, 3.0), np.abs(P[..., i]).max())
        assert_close(A[..., i], ogden.tangent(single, p[i], alpha, 3.0))
        assert W[i] == pytest.approx(float(ogden.energy(single, alpha, 3.0)), rel=TOLERANCE)


@pytest.mark.parametrize("alpha", ALPHAS)
@pytest.mark.parametrize("name", ["strain 1e-4", "moderate", "stretch 1e3", "inverted"])
def test_objective_isotropic_and_symmetric(name, alpha):
    F = np.eye(2) + GRADIENTS[name]
    Q, p = rotation(0.83), np.array(0.6)
    W, P = ogden.energy(F - np.eye(2), alpha, 2.0), ogden.stress(F - np.eye(2), p, alpha, 2.0)
    A = ogden.tangent(F - np.eye(2), p, alpha, 2.0)
    # rounding of the product Q F, relative eps, changes P by the stiffness times it
    slack = 20 * 2.2e-16 * np.abs(A).max() * np.abs(F).max()
    for turned, expected in [(Q @ F, Q @ P), (F @ Q, P @ Q)]:
        H = turned - np.eye(2)
        np.testing.assert_allclose(ogden.stress(H, p, alpha, 2.0), expected, rtol=0, atol=slack)
        np.testing.assert_allclose(
            ogden.energy(H, alpha, 2.0), W, rtol=0, atol=slack * np.abs(F).max()
        )
    cauchy = P @ F.T
    assert abs(cauchy[0, 1] - cauchy[1, 0]) <= TOLERANCE * (np.abs(P) @ np.abs(F.T)).max()
    assert_close(A, A.transpose(2, 3, 0, 1))


@pytest.mark.parametrize("alpha", [1.5, *ALPHAS, 15.0])
def test_small_strain_moduli_do_not_depend_on_alpha(alpha):
    A = ogden.tangent(np.zeros((2, 2)), np.array(0.0), alpha)
    shear = A[0, 1, 0, 1] + A[0, 1, 1, 0]  # a symmetric shear of both components
    assert shear == pytest.approx(2.0, rel=1e-14)
    assert A[0, 1, 0, 1] - A[0, 1, 1, 0] == pytest.approx(0.0, abs=1e-14)

    def pulled(strain):  # P11 with P22 = 0 through the pressure
        H = np.diag([strain, -strain / (1 + strain)])
        P = ogden.stress(H, np.array(0.0), alpha)
        pressure = -P[1, 1] / (1 + strain)
        return ogden.stress(H, np.array(pressure), alpha)[0, 0]

    # symmetric difference: the error is third order, strain^2 alpha^2
    modulus = (pulled(1e-6) - pulled(-1e-6)) / 2e-6
    assert modulus == pytest.approx(4.0, rel=1e-9)


def test_neo_hookean_energy_is_that_of_the_strain_tensor():
    H = np.random.default_rng(1).normal(size=(2, 2, 50))
    F = H + np.eye(2)[:, :, None]
    det = F[0, 0] * F[1, 1] - F[0, 1] * F[1, 0]
    expected = 0.5 * (F**2).sum(axis=(0, 1)) - 1.0 - (det - 1.0)
    np.testing.assert_allclose(ogden.energy(H, 2.0), expected, atol=1e-14, rtol=1e-13)
    cofactor = ogden.cofactor(H)
    np.testing.assert_allclose(
        ogden.stress(H, np.ones(50), 2.0), F, atol=1e-14 * np.abs(cofactor).max()
    )


def test_volume_change_keeps_its_digits_and_has_the_cofactor_as_derivative():
    H = 1e-9 * RANDOM
    with mpmath.workdps(40):
        h = [mpmath.mpf(float(x)) for x in H.ravel()]
        expected = float((1 + h[0]) * (1 + h[3]) - h[1] * h[2] - 1)
    assert ogden.volume_change(H) == pytest.approx(expected, rel=1e-15)
    step = np.random.default_rng(2).normal(size=(2, 2))
    # the determinant is quadratic: the central difference is exact
    slope = (ogden.volume_change(RANDOM + step) - ogden.volume_change(RANDOM - step)) / 2
    assert slope == pytest.approx((ogden.cofactor(RANDOM) * step).sum(), rel=1e-14)


@pytest.mark.parametrize("m", [0.5, 1.0, 4.0, 8.0])
@pytest.mark.parametrize("d", [0.0, 1e-14, 9e-6, 1.1e-5, 1e-3, 2.0, 1e3, 1e4])
def test_divided_difference_is_smooth_where_stretches_coalesce(m, d):
    e2 = 0.25
    e1 = e2 + d
    value = ogden.divided_difference(np.array(e1), np.array(e2), np.array(d), m)
    with mpmath.workdps(60):
        l1, l2 = 1 + mpmath.mpf(e2) + mpmath.mpf(d), 1 + mpmath.mpf(e2)
        exact_ = m * l2 ** (m - 1) if d == 0 else (l1**m - l2**m) / (l1 - l2)
        expected = float(exact_)
    assert value == pytest.approx(expected, rel=TOLERANCE)

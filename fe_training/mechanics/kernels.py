"""Element residuals and tangents: a compiled loop, and its numpy twin.

Both integrate, on every triangle, the weak form

    R(v) = int P(H, p) : grad v,        R(q) = int (det F - 1) q,

and its linearisation.  The compiled loop is used where numba is installed; the twin calls
:mod:`fe_training.mechanics.ogden` on whole arrays.  They agree to rounding.  More than 450 lines
because the twins stand side by side.

Local unknowns of a triangle: the two displacement components of each of its nodes, node by node,
then its pressures.

Polar elements, those that the wire stretches most, interpolate other coordinates of their nodes:
``sigma = (rho^2 - 1)/2`` and the angle ``phi`` about the wire's centre.  The map to them keeps
areas and the wire is ``sigma = 0``, so a layer that is wrapped around the wire is a thin straight
one, whose determinant keeps its digits.  Their deformation gradient, up to a rotation, has the rows

    grad sigma / rho,    rho grad phi.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from importlib.util import find_spec

import numpy as np
from numpy.typing import NDArray

from fe_training.mechanics import ogden

Array = NDArray[np.float64]
ElementArrays = Callable[..., tuple[Array, Array]]


def element_arrays_numpy(
    u: Array,
    p: Array,
    grad: Array,
    psi: Array,
    dx: Array,
    alpha: float,
    kappa: Array,
    tangents: bool = True,
) -> tuple[Array, Array]:
    """Return element residuals and tangents.

    Parameters
    ----------
    u : ndarray, shape (elements, nodes, 2)
        Nodal displacements [R_w].
    p : ndarray, shape (elements, pressures)
        Nodal pressures [mu].
    grad : ndarray, shape (elements, points, nodes, 2)
        Gradients of the displacement shape functions [1/R_w].
    psi : ndarray, shape (points, pressures)
        Pressure shape functions [-].
    dx : ndarray, shape (elements, points)
        Quadrature weights [R_w^2].
    alpha : float
        Strain-stiffening exponent [-].
    kappa : ndarray, shape (elements,)
        Bulk term of each element [mu].
    tangents : bool
        Whether the tangents are wanted.

    Returns
    -------
    residual : ndarray, shape (elements, unknowns)
    tangent : ndarray, shape (elements, unknowns, unknowns)
        Empty where it is not wanted.
    """
    H = np.einsum("eni,eqnj->ijeq", u, grad)
    pressure = np.einsum("em,qm->eq", p, psi)
    bulk = kappa[:, None]
    P = ogden.stress(H, pressure, alpha, bulk)
    n, nodes, pressures = len(u), u.shape[1], p.shape[1]
    nu = 2 * nodes
    residual = np.empty((n, nu + pressures))
    residual[:, :nu] = np.einsum("ijeq,eqnj,eq->eni", P, grad, dx).reshape(n, nu)
    residual[:, nu:] = np.einsum("eq,qm,eq->em", ogden.volume_change(H), psi, dx)
    if not tangents:
        return residual, np.empty((0, nu + pressures, nu + pressures))
    A = ogden.tangent(H, pressure, alpha, bulk)
    cof = ogden.cofactor(H)
    K = np.zeros((n, nu + pressures, nu + pressures))
    weighted = np.einsum("ijkleq,eqml,eq->eqijmk", A, grad, dx)
    K[:, :nu, :nu] = np.einsum("eqnj,eqijmk->enimk", grad, weighted).reshape(n, nu, nu)
    coupling = np.einsum("ijeq,eqnj,qm,eq->enim", cof, grad, psi, dx).reshape(n, nu, pressures)
    K[:, :nu, nu:] = coupling
    K[:, nu:, :nu] = coupling.transpose(0, 2, 1)
    return residual, K


def polar_coordinates(y: Array) -> tuple[Array, Array]:
    """Return sigma = (rho^2 - 1)/2 and the angle phi of places relative to the wire's centre.

    Parameters
    ----------
    y : ndarray, shape (..., 2)
        Places relative to the wire's centre [R_w].

    Returns
    -------
    sigma, phi : ndarray, shape (...)
        [R_w^2], zero on the wire; [rad], without a jump for places above the wire's centre.
    """
    sigma = 0.5 * (np.einsum("...i,...i->...", y, y) - 1.0)
    return sigma, 0.5 * np.pi - np.arctan2(y[..., 0], y[..., 1])


def polar_gradient(y: Array, shape: Array, grad: Array) -> Array:
    """Return F - I, up to a rotation, of elements that interpolate polar coordinates.

    Parameters
    ----------
    y : ndarray, shape (elements, nodes, 2)
        Nodes relative to the wire's centre [R_w].
    shape : ndarray, shape (points, nodes)
        Shape functions [-].
    grad : ndarray, shape (elements, points, nodes, 2)
        Their gradients [1/R_w].

    Returns
    -------
    ndarray, shape (2, 2, elements, points)
    """
    H, *_ = _polar_kinematics(y, shape, grad)
    return H


def _polar_kinematics(y: Array, shape: Array, grad: Array) -> tuple[Array, ...]:
    sigma, phi = polar_coordinates(y)
    rho = np.sqrt(1.0 + 2.0 * (sigma @ shape.T))
    along = np.einsum("en,eqnj->jeq", sigma, grad)
    around = np.einsum("en,eqnj->jeq", phi, grad)
    H = np.array([along / rho, around * rho])
    H[0, 0] -= 1.0
    H[1, 1] -= 1.0
    return H, rho, along, around


def polar_arrays_numpy(
    y: Array,
    p: Array,
    shape: Array,
    grad: Array,
    psi: Array,
    dx: Array,
    alpha: float,
    kappa: Array,
    tangents: bool = True,
) -> tuple[Array, Array]:
    """Return residuals and tangents of elements that interpolate polar coordinates.

    Parameters
    ----------
    y : ndarray, shape (elements, nodes, 2)
        Nodes relative to the wire's centre [R_w].
    shape : ndarray, shape (points, nodes)
        Displacement shape functions [-].
    p, grad, psi, dx, alpha, kappa, tangents
        As in :func:`element_arrays_numpy`.

    Returns
    -------
    residual : ndarray, shape (elements, unknowns)
        With respect to the displacements of the nodes and the pressures.
    tangent : ndarray, shape (elements, unknowns, unknowns)
    """
    H, rho, along, around = _polar_kinematics(y, shape, grad)
    pressure = np.einsum("em,qm->eq", p, psi)
    bulk = kappa[:, None]
    P = ogden.stress(H, pressure, alpha, bulk)
    A = ogden.tangent(H, pressure, alpha, bulk)
    n, nodes, pressures = len(y), y.shape[1], p.shape[1]
    nu, points = 2 * nodes, len(shape)
    # B[i, j] is the derivative of F[i, j] with respect to sigma and phi of each node
    B = np.zeros((2, 2, n, points, nodes, 2))
    N = np.broadcast_to(shape, (n, points, nodes))
    slope = np.moveaxis(grad, 3, 0)
    r1 = rho[..., None]
    B[0, ..., 0] = slope / r1 - along[..., None] * N / r1**3
    B[1, ..., 0] = around[..., None] * N / r1
    B[1, ..., 1] = slope * r1
    local = np.einsum("ijeq,ijeqnc,eq->enc", P, B, dx)
    K = np.einsum("ijeqnc,ijkleq,kleqmd,eq->encmd", B, A, B, dx, optimize=True)
    # second derivatives of F
    row = np.einsum("jeq,jeqn->eqn", P[0], slope) / r1**3
    both = np.einsum("eqn,qm->eqnm", row, shape)
    second = (
        3.0 * np.einsum("jeq,jeq->eq", P[0], along) / rho**5
        - np.einsum("jeq,jeq->eq", P[1], around) / rho**3
    )
    ss = np.einsum("eq,qn,qm->eqnm", second, shape, shape) - both - both.transpose(0, 1, 3, 2)
    sp = np.einsum("qn,jeq,jeqm,eq->eqnm", shape, P[1], slope, 1.0 / rho)
    K[:, :, 0, :, 0] += np.einsum("eqnm,eq->enm", ss, dx)
    sp = np.einsum("eqnm,eq->enm", sp, dx)
    K[:, :, 0, :, 1] += sp
    K[:, :, 1, :, 0] += sp.transpose(0, 2, 1)
    area = np.empty((n, points, nodes, 2))
    area[..., 0] = slope[0] * around[1][..., None] - slope[1] * around[0][..., None]
    area[..., 1] = slope[1] * along[0][..., None] - slope[0] * along[1][..., None]
    coupling = np.einsum("eqnc,qm,eq->encm", area, psi, dx)
    # from sigma and phi of the nodes to their displacements
    square = np.einsum("eni,eni->en", y, y)
    J = np.empty((n, nodes, 2, 2))
    J[:, :, 0] = y
    J[:, :, 1, 0], J[:, :, 1, 1] = -y[..., 1] / square, y[..., 0] / square
    K = np.einsum("enci,encmd,emdj->enimj", J, K, J, optimize=True)
    diagonal = np.arange(nodes)
    x0, x1 = y[..., 0], y[..., 1]
    bend = local[..., 1] / square**2
    curved = np.empty((n, nodes, 2, 2))
    curved[..., 0, 0] = local[..., 0] + bend * 2.0 * x0 * x1
    curved[..., 1, 1] = local[..., 0] - bend * 2.0 * x0 * x1
    curved[..., 0, 1] = curved[..., 1, 0] = bend * (x1 * x1 - x0 * x0)
    K[:, diagonal, :, diagonal, :] += curved.transpose(1, 0, 2, 3)
    residual = np.empty((n, nu + pressures))
    residual[:, :nu] = np.einsum("enci,enc->eni", J, local).reshape(n, nu)
    residual[:, nu:] = np.einsum("eq,qm,eq->em", ogden.volume_change(H), psi, dx)
    full = np.zeros((n, nu + pressures, nu + pressures))
    full[:, :nu, :nu] = K.reshape(n, nu, nu)
    full[:, :nu, nu:] = np.einsum("enci,encm->enim", J, coupling).reshape(n, nu, pressures)
    full[:, nu:, :nu] = full[:, :nu, nu:].transpose(0, 2, 1)
    return residual, full if tangents else full[:0]


#: Relative difference of the stretches below which their powers are not subtracted.
_NEAR = 0.05


def _power_strain(e: float, m: float) -> float:
    """Return sign(1 + e) |1 + e|^m - 1."""
    if m == 1.0:
        return e
    if e > -1.0:
        return math.expm1(m * math.log1p(max(e, -1.0 + 1e-12)))
    return float(-((-1.0 - e) ** m) - 1.0)


def _divided_difference(e1: float, e2: float, f1: float, f2: float, d: float, m: float) -> float:
    """Return (l1^m - l2^m)/(l1 - l2) for l = 1 + e, l^m = 1 + f and d = l1 - l2 >= 0."""
    l2 = 1.0 + e2
    if d < _NEAR * (1.0 + e1):  # the difference would lose digits
        t = math.log1p(d / l2)
        quotient = m if t < 1e-18 else math.expm1(m * t) / math.expm1(t)
        return float(l2 ** (m - 1.0) * quotient)
    return (f1 - f2) / d


def _point(
    H: Array, p: float, alpha: float, kappa: float, tangents: bool, P: Array, A: Array
) -> float:
    """Write stress P[4] and, where wanted, tangent A[4, 4] at a point; return det F - 1."""
    tr = H[0] + H[3]
    a, b, c, e = 2.0 + tr, H[2] - H[1], H[0] - H[3], H[2] + H[1]
    s, d = math.hypot(a, b), math.hypot(c, e)
    dj = tr + H[0] * H[3] - H[1] * H[2]
    excess = (4.0 * tr + tr * tr + b * b) / (s + 2.0)
    e1, e2 = 0.5 * (excess + d), 0.5 * (excess - d)
    sa, sb = (a / s, b / s) if s > 0.0 else (1.0, 0.0)
    dc, de = (c / d, e / d) if d > 0.0 else (1.0, 0.0)
    m = alpha - 1.0
    f1, f2 = _power_strain(e1, m), _power_strain(e2, m)
    ws = (f1 - e1 + f2 - e2) / alpha
    ratio = 2.0 / alpha * _divided_difference(e1, e2, f1, f2, d, m)
    q = p + kappa * dj
    cs = ws + 0.5 * q * s
    cd = (0.5 * ratio + 1.0 / alpha - 0.5 * q) * d
    ga, gb, gc, ge = cs * sa, cs * sb, cd * dc, cd * de
    P[0], P[1], P[2], P[3] = ga + gc, ge - gb, gb + ge, ga - gc
    if not tangents:
        return float(dj)
    l1, l2 = max(abs(1.0 + e1), 1e-12), max(abs(1.0 + e2), 1e-12)
    h1, h2 = 2.0 * m / alpha * abs(1.0 + f1) / l1, 2.0 * m / alpha * abs(1.0 + f2) / l2
    if e2 < -1.0:  # l2 < 0: the sum over l1 + l2 is the divided difference of l1 and -l2
        s_over = _divided_difference(e1, -2.0 - e2, f1, -2.0 - f2, s, m) / alpha
    else:
        s_over = ws / max(s, 1e-12) + 1.0 / alpha
    det_part = q - 2.0 / alpha
    one_s = s_over + 0.5 * det_part
    one_d = 0.5 * ratio - 0.5 * det_part
    mean = 0.25 * (h1 + h2)
    ts, td, sd = mean + 0.5 * det_part - one_s, mean - 0.5 * det_part - one_d, 0.25 * (h1 - h2)
    ja, jb, jc, je = 0.5 * s * sa, 0.5 * s * sb, -0.5 * d * dc, -0.5 * d * de
    maa = ts * sa * sa + one_s + kappa * ja * ja
    mab = ts * sa * sb + kappa * ja * jb
    mbb = ts * sb * sb + one_s + kappa * jb * jb
    mcc = td * dc * dc + one_d + kappa * jc * jc
    mce = td * dc * de + kappa * jc * je
    mee = td * de * de + one_d + kappa * je * je
    mac, mae = sd * sa * dc + kappa * ja * jc, sd * sa * de + kappa * ja * je
    mbc, mbe = sd * sb * dc + kappa * jb * jc, sd * sb * de + kappa * jb * je
    # back from the modes (a, b, c, e) to F11, F12, F21, F22
    A[0, 0] = maa + 2.0 * mac + mcc
    A[0, 1] = mae - mab + mce - mbc
    A[0, 2] = mab + mae + mbc + mce
    A[0, 3] = maa - mcc
    A[1, 1] = mbb - 2.0 * mbe + mee
    A[1, 2] = mee - mbb
    A[1, 3] = mae - mce - mab + mbc
    A[2, 2] = mbb + 2.0 * mbe + mee
    A[2, 3] = mab - mbc + mae - mce
    A[3, 3] = maa - 2.0 * mac + mcc
    for i in range(4):
        for j in range(i):
            A[i, j] = A[j, i]
    return float(dj)


def _element_loop(
    u: Array,
    p: Array,
    grad: Array,
    psi: Array,
    dx: Array,
    alpha: float,
    kappa: Array,
    tangents: bool = True,
) -> tuple[Array, Array]:
    n, points, nodes, _ = grad.shape
    pressures = psi.shape[1]
    nu = 2 * nodes
    residual = np.zeros((n, nu + pressures))
    K = np.zeros((n if tangents else 1, nu + pressures, nu + pressures))
    H, P, A, Ag = np.empty(4), np.empty(4), np.empty((4, 4)), np.empty((4, 2))
    for el in range(n):
        R, Ke = residual[el], K[el if tangents else 0]
        for q in range(points):
            g, w = grad[el, q], dx[el, q]
            H[:] = 0.0
            for a in range(nodes):
                for j in range(2):
                    H[j] += u[el, a, 0] * g[a, j]
                    H[2 + j] += u[el, a, 1] * g[a, j]
            pressure = 0.0
            for a in range(pressures):
                pressure += p[el, a] * psi[q, a]
            dj = _point(H, pressure, alpha, kappa[el], tangents, P, A)
            for a in range(nodes):
                R[2 * a] += w * (P[0] * g[a, 0] + P[1] * g[a, 1])
                R[2 * a + 1] += w * (P[2] * g[a, 0] + P[3] * g[a, 1])
            for a in range(pressures):
                R[nu + a] += w * dj * psi[q, a]
            if not tangents:
                continue
            for b in range(nodes):
                for r in range(4):
                    Ag[r, 0] = w * (A[r, 0] * g[b, 0] + A[r, 1] * g[b, 1])
                    Ag[r, 1] = w * (A[r, 2] * g[b, 0] + A[r, 3] * g[b, 1])
                for a in range(b + 1):
                    for k in range(2):
                        Ke[2 * a, 2 * b + k] += g[a, 0] * Ag[0, k] + g[a, 1] * Ag[1, k]
                        Ke[2 * a + 1, 2 * b + k] += g[a, 0] * Ag[2, k] + g[a, 1] * Ag[3, k]
                c0 = w * ((1.0 + H[3]) * g[b, 0] - H[2] * g[b, 1])
                c1 = w * ((1.0 + H[0]) * g[b, 1] - H[1] * g[b, 0])
                for m in range(pressures):
                    Ke[2 * b, nu + m] += c0 * psi[q, m]
                    Ke[2 * b + 1, nu + m] += c1 * psi[q, m]
        for i in range(nu + pressures):
            for j in range(i):
                Ke[i, j] = Ke[j, i]
    return residual, K[: n if tangents else 0]


def _polar_loop(
    y: Array,
    p: Array,
    shape: Array,
    grad: Array,
    psi: Array,
    dx: Array,
    alpha: float,
    kappa: Array,
    tangents: bool = True,
) -> tuple[Array, Array]:
    n, points, nodes, _ = grad.shape
    pressures = psi.shape[1]
    nu = 2 * nodes
    residual = np.zeros((n, nu + pressures))
    K = np.zeros((n if tangents else 1, nu + pressures, nu + pressures))
    H, P, A = np.empty(4), np.empty(4), np.empty((4, 4))
    B, AB, area = np.empty((4, nu)), np.empty((4, nu)), np.empty(nu)
    sigma, phi, J = np.empty(nodes), np.empty(nodes), np.empty((nodes, 2, 2))
    Q, block = np.empty((nu, nu)), np.empty((2, 2))
    for el in range(n):
        R, Ke = np.zeros(nu), K[el if tangents else 0]
        Q[:] = 0.0
        for a in range(nodes):
            y0, y1 = y[el, a, 0], y[el, a, 1]
            square = y0 * y0 + y1 * y1
            sigma[a], phi[a] = 0.5 * (square - 1.0), 0.5 * math.pi - math.atan2(y0, y1)
            J[a, 0, 0], J[a, 0, 1] = y0, y1
            J[a, 1, 0], J[a, 1, 1] = -y1 / square, y0 / square
        for q in range(points):
            g, w = grad[el, q], dx[el, q]
            s, s0, s1, f0, f1 = 0.0, 0.0, 0.0, 0.0, 0.0
            for a in range(nodes):
                s += sigma[a] * shape[q, a]
                s0 += sigma[a] * g[a, 0]
                s1 += sigma[a] * g[a, 1]
                f0 += phi[a] * g[a, 0]
                f1 += phi[a] * g[a, 1]
            rho = math.sqrt(1.0 + 2.0 * s)
            H[0], H[1], H[2], H[3] = s0 / rho - 1.0, s1 / rho, rho * f0, rho * f1 - 1.0
            pressure = 0.0
            for a in range(pressures):
                pressure += p[el, a] * psi[q, a]
            dj = _point(H, pressure, alpha, kappa[el], tangents, P, A)
            for m in range(pressures):
                residual[el, nu + m] += w * dj * psi[q, m]
            # dF/dsigma of a node besides its slope is N of it times this
            lean = (P[2] * f0 + P[3] * f1) / rho - (P[0] * s0 + P[1] * s1) / rho**3
            for a in range(nodes):
                N, g0, g1 = shape[q, a], g[a, 0], g[a, 1]
                R[2 * a] += w * ((P[0] * g0 + P[1] * g1) / rho + N * lean)
                R[2 * a + 1] += w * rho * (P[2] * g0 + P[3] * g1)
            if not tangents:
                continue
            for a in range(nodes):
                N, g0, g1 = shape[q, a], g[a, 0], g[a, 1]
                B[0, 2 * a], B[1, 2 * a] = (
                    (g0 - s0 * N / rho**2) / rho,
                    (g1 - s1 * N / rho**2) / rho,
                )
                B[2, 2 * a], B[3, 2 * a] = f0 * N / rho, f1 * N / rho
                B[0, 2 * a + 1], B[1, 2 * a + 1] = 0.0, 0.0
                B[2, 2 * a + 1], B[3, 2 * a + 1] = rho * g0, rho * g1
                area[2 * a], area[2 * a + 1] = g0 * f1 - g1 * f0, g1 * s0 - g0 * s1
            for b in range(nu):
                for i in range(4):
                    AB[i, b] = w * (
                        A[i, 0] * B[0, b]
                        + A[i, 1] * B[1, b]
                        + A[i, 2] * B[2, b]
                        + A[i, 3] * B[3, b]
                    )
                for a in range(b + 1):
                    Q[a, b] += (
                        B[0, a] * AB[0, b]
                        + B[1, a] * AB[1, b]
                        + B[2, a] * AB[2, b]
                        + B[3, a] * AB[3, b]
                    )
                for m in range(pressures):
                    Ke[b, nu + m] += w * area[b] * psi[q, m]
            second = w * (3.0 * (P[0] * s0 + P[1] * s1) / rho**5 - (P[2] * f0 + P[3] * f1) / rho**3)
            for b in range(nodes):
                Nb, row_b = shape[q, b], w * (P[0] * g[b, 0] + P[1] * g[b, 1]) / rho**3
                turn_b = w * (P[2] * g[b, 0] + P[3] * g[b, 1]) / rho
                for a in range(b + 1):
                    Na, row_a = shape[q, a], w * (P[0] * g[a, 0] + P[1] * g[a, 1]) / rho**3
                    Q[2 * a, 2 * b] += second * Na * Nb - row_a * Nb - row_b * Na
                    Q[2 * a, 2 * b + 1] += Na * turn_b
                    if a < b:
                        turn_a = w * (P[2] * g[a, 0] + P[3] * g[a, 1]) / rho
                        Q[2 * a + 1, 2 * b] += turn_a * Nb
        # from sigma and phi of the nodes to their displacements
        for b in range(nodes):
            for i in range(2):
                residual[el, 2 * b + i] = J[b, 0, i] * R[2 * b] + J[b, 1, i] * R[2 * b + 1]
        if not tangents:
            continue
        for b in range(nodes):
            for m in range(nu, nu + pressures):
                c0, c1 = Ke[2 * b, m], Ke[2 * b + 1, m]
                Ke[2 * b, m] = J[b, 0, 0] * c0 + J[b, 1, 0] * c1
                Ke[2 * b + 1, m] = J[b, 0, 1] * c0 + J[b, 1, 1] * c1
            Q[2 * b + 1, 2 * b] = Q[2 * b, 2 * b + 1]
            for a in range(b + 1):
                for c in range(2):
                    for j in range(2):
                        block[c, j] = (
                            Q[2 * a + c, 2 * b] * J[b, 0, j] + Q[2 * a + c, 2 * b + 1] * J[b, 1, j]
                        )
                for i in range(2):
                    for j in range(2):
                        Ke[2 * a + i, 2 * b + j] = (
                            J[a, 0, i] * block[0, j] + J[a, 1, i] * block[1, j]
                        )
            y0, y1 = y[el, b, 0], y[el, b, 1]
            bend = R[2 * b + 1] / (y0 * y0 + y1 * y1) ** 2
            Ke[2 * b, 2 * b] += R[2 * b] + 2.0 * bend * y0 * y1
            Ke[2 * b + 1, 2 * b + 1] += R[2 * b] - 2.0 * bend * y0 * y1
            Ke[2 * b, 2 * b + 1] += bend * (y1 * y1 - y0 * y0)
        for i in range(nu + pressures):
            for j in range(i):
                Ke[i, j] = Ke[j, i]
    return residual, K[: n if tangents else 0]


@functools.cache
def _compiled() -> tuple[ElementArrays, ElementArrays] | None:
    """Return the compiled loops, or None where numba is not installed."""
    if find_spec("numba") is None:
        return None
    import numba

    compile_ = numba.njit(cache=True, error_model="numpy")
    # numba resolves the helpers by their module names when it compiles the loop
    scope = globals()
    for helper in ("_power_strain", "_divided_difference", "_point"):
        scope[helper] = compile_(scope[helper])
    return compile_(_element_loop), compile_(_polar_loop)


def element_arrays(compiled: bool = True) -> tuple[ElementArrays, ElementArrays]:
    """Return the functions for plain and for polar elements.

    Compiled loops where they can be had and are wanted, else their numpy twins.
    """
    loops = _compiled() if compiled else None
    return loops or (element_arrays_numpy, polar_arrays_numpy)

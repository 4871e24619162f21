"""Element residuals and tangents: a compiled loop, and its numpy twin.

Both integrate, on every triangle, the weak form

    R(v) = int P(H, p) : grad v,        R(q) = int (det F - 1) q,

and its linearisation.  The compiled loop is used where numba is installed; the twin calls
:mod:`fe_training.ogden` on whole arrays.  They agree to rounding.

Local unknowns of a triangle: the two displacement components of each of its nodes, node by node,
then its pressures.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from importlib.util import find_spec
from typing import cast

import numpy as np
from numpy.typing import NDArray

from . import ogden

Array = NDArray[np.float64]
ElementArrays = Callable[[Array, Array, Array, Array, Array, float, Array], tuple[Array, Array]]


def element_arrays_numpy(
    u: Array, p: Array, grad: Array, psi: Array, dx: Array, alpha: float, kappa: Array
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

    Returns
    -------
    residual : ndarray, shape (elements, unknowns)
    tangent : ndarray, shape (elements, unknowns, unknowns)
    """
    H = np.einsum("eni,eqnj->ijeq", u, grad)
    pressure = np.einsum("em,qm->eq", p, psi)
    bulk = kappa[:, None]
    P = ogden.stress(H, pressure, alpha, bulk)
    A = ogden.tangent(H, pressure, alpha, bulk)
    cof = ogden.cofactor(H)
    n, nodes, pressures = len(u), u.shape[1], p.shape[1]
    nu = 2 * nodes
    residual = np.empty((n, nu + pressures))
    residual[:, :nu] = np.einsum("ijeq,eqnj,eq->eni", P, grad, dx).reshape(n, nu)
    residual[:, nu:] = np.einsum("eq,qm,eq->em", ogden.volume_change(H), psi, dx)
    K = np.zeros((n, nu + pressures, nu + pressures))
    weighted = np.einsum("ijkleq,eqml,eq->eqijmk", A, grad, dx)
    K[:, :nu, :nu] = np.einsum("eqnj,eqijmk->enimk", grad, weighted).reshape(n, nu, nu)
    coupling = np.einsum("ijeq,eqnj,qm,eq->enim", cof, grad, psi, dx).reshape(n, nu, pressures)
    K[:, :nu, nu:] = coupling
    K[:, nu:, :nu] = coupling.transpose(0, 2, 1)
    return residual, K


def _power_strain(e: float, m: float) -> float:
    """Return sign(1 + e) |1 + e|^m - 1."""
    if e > -1.0:
        return math.expm1(m * math.log1p(max(e, -1.0 + 1e-12)))
    return float(-((-1.0 - e) ** m) - 1.0)


def _divided_difference(e1: float, e2: float, d: float, m: float) -> float:
    """Return (l1^m - l2^m)/(l1 - l2) for l = 1 + e and d = l1 - l2 >= 0."""
    l2 = 1.0 + e2
    if l2 > 0.1 * (1.0 + e1):
        t = math.log1p(d / l2)
        quotient = m if t < 1e-18 else math.expm1(m * t) / math.expm1(t)
        return float(l2 ** (m - 1.0) * quotient)
    return (_power_strain(e1, m) - _power_strain(e2, m)) / d


def _point(H: Array, p: float, alpha: float, kappa: float, P: Array, A: Array) -> float:
    """Write stress P[4] and tangent A[4, 4] at one point and return det F - 1."""
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
    l1, l2 = max(abs(1.0 + e1), 1e-12), max(abs(1.0 + e2), 1e-12)
    h1, h2 = 2.0 * m / alpha * l1 ** (m - 1.0), 2.0 * m / alpha * l2 ** (m - 1.0)
    ratio = 2.0 / alpha * _divided_difference(e1, e2, d, m)
    if e2 < -1.0:  # l2 < 0: the sum over l1 + l2 is the divided difference of l1 and -l2
        s_over = _divided_difference(e1, -2.0 - e2, s, m) / alpha
    else:
        s_over = ws / max(s, 1e-12) + 1.0 / alpha
    q = p + kappa * dj
    cs = ws + 0.5 * q * s
    cd = (0.5 * ratio + 1.0 / alpha - 0.5 * q) * d
    ga, gb, gc, ge = cs * sa, cs * sb, cd * dc, cd * de
    P[0], P[1], P[2], P[3] = ga + gc, ge - gb, gb + ge, ga - gc
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
    u: Array, p: Array, grad: Array, psi: Array, dx: Array, alpha: float, kappa: Array
) -> tuple[Array, Array]:
    n, points, nodes, _ = grad.shape
    pressures = psi.shape[1]
    nu = 2 * nodes
    residual = np.zeros((n, nu + pressures))
    K = np.zeros((n, nu + pressures, nu + pressures))
    H, P, A, Ag = np.empty(4), np.empty(4), np.empty((4, 4)), np.empty((4, 2))
    for el in range(n):
        R, Ke = residual[el], K[el]
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
            dj = _point(H, pressure, alpha, kappa[el], P, A)
            for a in range(nodes):
                R[2 * a] += w * (P[0] * g[a, 0] + P[1] * g[a, 1])
                R[2 * a + 1] += w * (P[2] * g[a, 0] + P[3] * g[a, 1])
            for a in range(pressures):
                R[nu + a] += w * dj * psi[q, a]
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
    return residual, K


@functools.cache
def compiled_loop() -> ElementArrays | None:
    """Return the compiled element loop, or None where numba is not installed."""
    if find_spec("numba") is None:
        return None
    import numba

    compile_ = numba.njit(cache=True, error_model="numpy")
    # numba resolves the helpers by their module names when it compiles the loop
    scope = globals()
    scope["_power_strain"] = compile_(_power_strain)
    scope["_divided_difference"] = compile_(_divided_difference)
    scope["_point"] = compile_(_point)
    return cast(ElementArrays, compile_(_element_loop))


def element_arrays(compiled: bool = True) -> ElementArrays:
    """Return the compiled element loop where it can be had and is wanted, else its numpy twin."""
    return (compiled and compiled_loop()) or element_arrays_numpy

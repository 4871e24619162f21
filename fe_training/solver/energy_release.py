"""Energy release rate of the whole body from configurational forces.

With the deformed positions x as unknowns, a frictionless contact sees x alone.  A shift of the
reference crack tip by a field ``q e_1`` at fixed x therefore changes the energy of the half body by

    -dU = dc int (F^T P - W I) e_1 . grad q,

whatever the support of q holds, contact included: tractions normal to the deformed face do no
work on F e_1, which is tangent to it.  J counts both halves.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fe_training.mechanics import ogden
from fe_training.mechanics.body import Body
from fe_training.solver.equilibrium import State

Array = NDArray[np.float64]


def plateau(body: Body, inner: float, outer: float) -> Array:
    """Return q at the vertices: 1 within `inner`, 0 beyond `outer`, falling with log r."""
    r = np.hypot(*body.mesh.p)
    q: Array = np.clip(np.log(outer / r) / np.log(outer / inner), 0.0, 1.0)
    return q


def domain_integral(body: Body, state: State, inner: float, outer: float) -> float:
    """Return J of the whole body by a domain integral.

    Parameters
    ----------
    body : Body
    state : State
        An equilibrium.
    inner, outer : float
        The field q falls from 1 to 0 between these distances from the tip [R_w].

    Returns
    -------
    float
        J/(mu R_w) [-].
    """
    q = plateau(body, inner, outer)
    corners, values = body.mesh.p[:, body.mesh.t], q[body.mesh.t]
    (a, b), (dq1, dq2) = corners[:, 1:] - corners[:, :1], values[1:] - values[0]
    det = a[0] * b[1] - a[1] * b[0]
    slope = np.array([dq1 * b[1] - dq2 * b[0], dq2 * a[0] - dq1 * a[1]]) / det
    elements = np.flatnonzero(np.abs(slope).sum(axis=0) > 0)
    H = body.displacement_gradient(state.u, elements, state.centre)
    p = body.pressure_at_points(state.p, elements)
    bulk = body.bulk[elements, None]
    P = ogden.stress(H, p, body.alpha, bulk)
    W = ogden.energy(H, body.alpha, bulk) + p * ogden.volume_change(H)
    # F^T P = H^T P + P; adding the small part last keeps the digits of the far field
    shift = np.einsum("ieq,ijeq->jeq", H[:, 0], P) + P[0]
    shift[0] -= W
    return float(2.0 * np.einsum("jeq,je,eq->", shift, slope[:, elements], body.dx[elements]))


def strain_energy(body: Body, state: State) -> float:
    """Return the strain energy U of the half body [mu R_w^2 per unit thickness]."""
    H = body.displacement_gradient(state.u, centre=state.centre)
    p = body.pressure_at_points(state.p)
    W = ogden.energy(H, body.alpha, body.bulk[:, None]) + p * ogden.volume_change(H)
    return float(np.einsum("eq,eq->", W, body.dx))

"""Refinement of a body along its path: where det F scatters, the mesh is too coarse.

The exact solution has det F = 1 everywhere; the discrete one keeps it on the average of patches.
Its scatter within an element is the error of the deformation gradient as the material feels it,
amplified by the stretch.  Elements are split where it is large, and the state is carried over
exactly, since the new mesh is nested in the old one.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from . import kernels, ogden
from .body import Body
from .contact import ActiveSet
from .equilibrium import State

Array = NDArray[np.float64]
Index = NDArray[np.int64]

#: Neighbours among which the element that holds a place is looked for; doubled until it is found.
_CANDIDATES = 8
_INSIDE = 1e-6


def determinant_scatter(body: Body, state: State) -> Array:
    """Return the root mean square of det F - 1 over each element's quadrature points [-]."""
    H = body.displacement_gradient(state.u, centre=state.centre)
    return np.asarray(np.sqrt((ogden.volume_change(H) ** 2).mean(axis=1)))


def refined(body: Body, state: State, elements: Index) -> tuple[Body, State]:
    """Return the body with some elements split, and the state carried over to it.

    Parameters
    ----------
    body : Body
    state : State
    elements : ndarray of int
        The elements to split; neighbours are split where the mesh would not fit otherwise.

    Returns
    -------
    body : Body
    state : State
        The same deformation, not yet in equilibrium on the finer body; it has no tangent.
    """
    finer = body.on(body.mesh.refined(elements))
    parents = _parents(body, finer)
    u, p = np.empty((len(finer.nodes), 2)), np.empty(len(finer.pressure_places))
    shape = body.displacement_shape(_local(body, parents, finer.nodes[finer.connectivity]))
    moved = np.einsum("eak,ekj->eaj", shape, state.u[body.connectivity[parents]])
    polar = np.flatnonzero(body.polar[parents])
    if len(polar):
        sigma, phi = kernels.polar_coordinates(body.about(state.u, state.centre, parents[polar]))
        sigma, phi = (np.einsum("eak,ek->ea", shape[polar], x) for x in (sigma, phi))
        rho = np.sqrt(1.0 + 2.0 * sigma)
        place = state.centre + np.stack([rho * np.cos(phi), rho * np.sin(phi)], axis=-1)
        moved[polar] = place - finer.nodes[finer.connectivity[polar]]
    u[finer.connectivity] = moved
    u[finer.held] = 0.0
    shape = body.pressure_shape(_local(body, parents, finer.pressure_places[finer.triangles]))
    p[finer.triangles] = np.einsum("eak,ek->ea", shape, state.p[body.triangles[parents]])
    n = len(finer.face)
    carried = replace(
        state,
        u=u,
        p=p,
        active=ActiveSet(
            _between(body, finer, state.active.wire), _between(body, finer, state.active.plane)
        ),
        force=np.zeros(n),
        normal=np.zeros((n, 2)),
        tangent=None,
    )
    return finer, carried


def _local(body: Body, elements: Index, places: Array) -> Array:
    """Return the local coordinates in given elements of places, shape (2, elements, places)."""
    a, b, c = body.mesh.p.T[body.mesh.t[:, elements]]
    side1, side2, arm = (b - a)[:, None], (c - a)[:, None], places - a[:, None]
    area = side1[..., 0] * side2[..., 1] - side1[..., 1] * side2[..., 0]
    first = arm[..., 0] * side2[..., 1] - arm[..., 1] * side2[..., 0]
    second = side1[..., 0] * arm[..., 1] - side1[..., 1] * arm[..., 0]
    return np.array([first / area, second / area])


def _parents(coarse: Body, fine: Body) -> Index:
    """Return the element of the coarse mesh that holds each element of the nested fine one."""

    def logarithmic(points: Array) -> Array:
        return np.stack([np.log(np.hypot(*points)), np.arctan2(points[1], points[0])], axis=-1)

    old, new = (body.mesh.p[:, body.mesh.t].mean(axis=1) for body in (coarse, fine))
    tree = cKDTree(logarithmic(old))
    parents = np.full(new.shape[1], -1)
    lost, k = np.arange(new.shape[1]), _CANDIDATES
    while len(lost):
        candidates = tree.query(logarithmic(new[:, lost]), k=min(k, old.shape[1]))[1]
        for candidate in candidates.T:
            x, y = _local(coarse, candidate, new[:, lost].T[:, None])[:, :, 0]
            held = np.minimum(np.minimum(x, y), 1.0 - x - y) > _INSIDE
            parents[lost[held]] = candidate[held]
        lost, k = lost[parents[lost] < 0], 2 * k
        assert k < 4 * old.shape[1], "the fine mesh is not nested in the coarse one"
    return parents


def _between(coarse: Body, fine: Body, touching: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return the nodes of the fine face that lie on or between touching nodes of the coarse one."""
    known, wanted = coarse.along_face, fine.along_face
    return np.asarray(np.interp(wanted, known, touching.astype(float)) > 1.0 - 1e-9)

"""Refinement of a body along its path: where det F scatters, the mesh is too coarse.

The exact solution has det F = 1 everywhere; the discrete one keeps it on the average of patches.
Its scatter within an element is the error of the deformation gradient as the material feels it,
amplified by the stretch.  Elements are split where it is large, and the state is carried over
exactly, since the new mesh is nested in the old one.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree
from skfem import MeshTri

from fe_training.mechanics import kernels, ogden
from fe_training.mechanics.active_set import ActiveSet
from fe_training.mechanics.body import Body
from fe_training.solver.equilibrium import State

Array = NDArray[np.float64]
Index = NDArray[np.int64]

#: Neighbours among which the element that holds a place is looked for; doubled until it is found,
#: or there are this many.
_CANDIDATES, _MOST_CANDIDATES = 8, 128
_INSIDE = 1e-6

#: A mesh follows another one in as many rounds of splits as this at most, where its elements are
#: longer by this factor.
_ROUNDS, _LONGER = 8, 1.5


#: Ends are sharp if this many intervals to either side are shorter than the longest by this factor.
_BESIDE, _SHARP = 3, 0.3


def determinant_scatter(body: Body, state: State) -> Array:
    """Return the root mean square of det F - 1 over each element's quadrature points [-]."""
    H = body.displacement_gradient(state.u, centre=state.centre)
    return np.asarray(np.sqrt((ogden.volume_change(H) ** 2).mean(axis=1)))


def ends_are_sharp(body: Body, state: State) -> bool:
    """Return whether the face nodes at both ends of the contact are denser than between them."""
    touching = np.flatnonzero(state.active.wire)
    spacing = np.diff(body.along_face)
    widest = spacing[touching[0] : touching[-1]].max()
    at = [spacing[max(i - _BESIDE, 0) : i + _BESIDE].max() for i in (touching[0], touching[-1])]
    return bool(max(at) < _SHARP * widest)


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
    places = finer.nodes[finer.connectivity]
    u[finer.connectivity] = _displaced(body, state, parents, places)
    u[finer.held] = 0.0
    p[finer.triangles] = _pressures(body, state, parents, finer.pressure_places[finer.triangles])
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


def _displaced(body: Body, state: State, elements: Index, places: Array) -> Array:
    """Return displacements at places (elements, places, 2) by the shape functions of elements."""
    shape = body.displacement_shape(_local(body, elements, places))
    u = np.einsum("eak,ekj->eaj", shape, state.u[body.connectivity[elements]])
    polar = np.flatnonzero(body.polar[elements])
    if len(polar):
        sigma, phi = kernels.polar_coordinates(body.about(state.u, state.centre, elements[polar]))
        sigma, phi = (np.einsum("eak,ek->ea", shape[polar], x) for x in (sigma, phi))
        rho = np.sqrt(np.maximum(1.0 + 2.0 * sigma, 0.0))
        around = np.stack([rho * np.cos(phi), rho * np.sin(phi)], axis=-1)
        u[polar] = state.centre + around - places[polar]
    return np.asarray(u)


def _pressures(body: Body, state: State, elements: Index, places: Array) -> Array:
    """Return pressures at places (elements, places, 2) by the shape functions of elements."""
    shape = body.pressure_shape(_local(body, elements, places))
    return np.asarray(np.einsum("eak,ek->ea", shape, state.p[body.triangles[elements]]))


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
    return _holding(coarse, fine.mesh.p[:, fine.mesh.t].mean(axis=1))


def _holding(body: Body, points: Array) -> Index:
    """Return the element of a body that holds each of some points, shape (2, points).

    The outer arc is a polygon, and the notch another one: a point that no element near it holds
    belongs to the one that it is least outside of.
    """

    def logarithmic(points: Array) -> Array:
        return np.stack([np.log(np.hypot(*points)), np.arctan2(points[1], points[0])], axis=-1)

    tree = cKDTree(logarithmic(body.mesh.p[:, body.mesh.t].mean(axis=1)))
    count, most = points.shape[1], body.mesh.t.shape[1]
    found, depth = np.zeros(count, dtype=np.int64), np.full(count, -np.inf)
    lost, k = np.arange(count), min(_CANDIDATES, most)
    while len(lost):
        candidates = tree.query(logarithmic(points[:, lost]), k=k)[1]
        for candidate in candidates.T:
            x, y = _local(body, candidate, points[:, lost].T[:, None])[:, :, 0]
            inside = np.minimum(np.minimum(x, y), 1.0 - x - y)
            better = inside > depth[lost]
            found[lost[better]], depth[lost[better]] = candidate[better], inside[better]
        if k == min(_MOST_CANDIDATES, most):
            break
        lost, k = lost[depth[lost] < -_INSIDE], min(2 * k, _MOST_CANDIDATES, most)
    return found


def transferred(body: Body, state: State, other: Body) -> State:
    """Return a state carried over to another mesh of the same body, as a start for Newton's method.

    Parameters
    ----------
    body : Body
    state : State
        An equilibrium.
    other : Body
        The body on another mesh, finer where the solution is to be.

    Returns
    -------
    State
        About the same deformation, interpolated node by node; it has no tangent.
    """
    n = len(other.face)
    places = other.along_face
    return replace(
        state,
        u=np.where(other.held, 0.0, _at(_displaced, body, state, other.nodes)),
        p=_at(_pressures, body, state, other.pressure_places),
        active=ActiveSet(
            *(
                np.interp(places, body.along_face, touching.astype(float)) > 0.5
                for touching in (state.active.wire, state.active.plane)
            )
        ),
        force=np.zeros(n),
        normal=np.zeros((n, 2)),
        tangent=None,
    )


def as_fine_as(body: Body, other: Body) -> Body:
    """Return the body on a mesh split where another one was: nowhere much longer elements than its.

    The body itself where it is fine enough.
    """
    mesh = body.mesh
    for _ in range(_ROUNDS):
        there = _longest(other.mesh)[_holding(other, mesh.p[:, mesh.t].mean(axis=1))]
        split = np.flatnonzero(_longest(mesh) > _LONGER * there)
        if not len(split):
            break
        mesh = mesh.refined(split)
    return body if mesh is body.mesh else body.on(mesh)


def _longest(mesh: MeshTri) -> Array:
    """Return the longest side of each element [R_w]."""
    corners = mesh.p[:, mesh.t]
    return np.asarray(np.hypot(*(corners - np.roll(corners, 1, axis=1))).max(axis=0))


def _at(values: Callable[..., Array], body: Body, state: State, places: Array) -> Array:
    """Return values at places, shape (places, 2), by the element that holds each of them."""
    return values(body, state, _holding(body, places.T), places[:, None])[:, 0]


def _between(coarse: Body, fine: Body, touching: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return the nodes of the fine face that lie on or between touching nodes of the coarse one."""
    known, wanted = coarse.along_face, fine.along_face
    return np.asarray(np.interp(wanted, known, touching.astype(float)) > 1.0 - 1e-9)

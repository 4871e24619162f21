"""The half body: unknowns, constraints and internal forces on P2/P1 (Taylor-Hood) triangles."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray
from skfem import (
    Basis,
    ElementTriCCR,
    ElementTriP1,
    ElementTriP1DG,
    ElementTriP2,
    MeshTri,
)

from fe_training.mechanics import kernels

Array = NDArray[np.float64]
Index = NDArray[np.int64]
Flags = NDArray[np.bool_]

#: Quadrature exact for polynomials of this degree.
_DEGREE = 4

#: Displacement and pressure elements.  Crouzeix-Raviart (quadratics with a bubble, discontinuous
#: linear pressure) keeps the area of every element; Taylor-Hood keeps it on patches only, and
#: leaks along the sheared layer behind the contact when the toughness is high.
ELEMENTS = {
    "crouzeix-raviart": (ElementTriCCR, ElementTriP1DG),
    "taylor-hood": (ElementTriP2, ElementTriP1),
}

#: Nodes of a triangle that share the motion of a rigid translation; a bubble does not.
_RIGID = 6

#: Elements within this many notch radii may be inverted on the way to equilibrium.
NOTCH_REACH = 10.0


def row_entries(pointers: Index, rows: Index) -> Index:
    """Return the places of the entries of some rows of a matrix in compressed form."""
    first, count = pointers[rows], np.diff(pointers)[rows]
    offset = np.cumsum(count) - count
    return np.repeat(first - offset, count) + np.arange(count.sum())


@dataclass(frozen=True, slots=True)
class _Pattern:
    """Compressed rows of the free block.

    Parameters
    ----------
    columns, pointers : ndarray of int
    diagonal : ndarray of int
        Places of the diagonal entries.
    transposed : ndarray of int
        For each entry the place of the one across the diagonal.
    sums : csr_matrix
        Makes scaled entries of the matrix of the entries of all elements.
    """

    columns: Index
    pointers: Index
    diagonal: Index
    transposed: Index
    sums: sp.csr_matrix


class Body:
    """A discretised half body of one material.

    Unknowns are the two displacement components of every node, then the pressure of every
    vertex.  The ligament slides on the symmetry plane; of the outer arc the right half is held,
    the left half is free, so that the volume of the wire can leave the body.

    Parameters
    ----------
    mesh : skfem.MeshTri
        From :func:`fe_training.mechanics.mesh.crack_mesh`.
    alpha : float
        Strain-stiffening exponent [-].
    bulk : float
        Bulk term kappa beside the pressure [mu].
    hold : {"right", "all", "none"}
        The part of the outer arc that is held.
    compiled : bool
        Use the compiled element loops where numba is installed.
    element : {"taylor-hood", "crouzeix-raviart"}
        Shape functions.
    polar : float
        Elements within this distance from the tip interpolate polar coordinates about the wire's
        centre [R_w]; see :mod:`fe_training.mechanics.kernels`.
    """

    def __init__(
        self,
        mesh: MeshTri,
        alpha: float,
        bulk: float = 0.0,
        hold: str = "right",
        compiled: bool = True,
        element: str = "taylor-hood",
        polar: float = 0.0,
    ) -> None:
        self.mesh, self.alpha = mesh, float(alpha)
        self._options = (alpha, bulk, hold, compiled, element, polar)
        self._plain_arrays, self._polar_arrays = kernels.element_arrays(compiled)
        self._elements = tuple(kind() for kind in ELEMENTS[element])
        basis = Basis(mesh, self._elements[0], intorder=_DEGREE)
        pressure = basis.with_element(self._elements[1])
        self.nodes: Array = basis.doflocs.T.copy()
        self.connectivity: Index = basis.element_dofs.T.astype(np.int64)
        self.triangles: Index = pressure.element_dofs.T.astype(np.int64)
        self.grad: Array = np.ascontiguousarray(
            np.array([shape[0].grad for shape in basis.basis]).transpose(2, 3, 0, 1)
        )
        self.shape: Array = np.array([np.asarray(shape[0])[0] for shape in basis.basis]).T.copy()
        self.psi: Array = np.array([np.asarray(shape[0])[0] for shape in pressure.basis]).T.copy()
        self.dx: Array = basis.dx.copy()
        self.pressure_places: Array = pressure.doflocs.T.copy()
        self.bulk: Array = np.full(len(self.connectivity), float(bulk))
        self.polar: Flags = np.hypot(*mesh.p)[mesh.t].max(axis=0) < polar
        self._number_unknowns(basis, hold)

    def on(self, mesh: MeshTri) -> Body:
        """Return a body of the same material, elements and support on another mesh."""
        return type(self)(mesh, *self._options)

    def at(self, points: Array) -> Body:
        """Return the body with the vertices of its mesh elsewhere, all else as it is."""
        moved = self.on(MeshTri(points, self.mesh.t))
        moved.polar, moved.face, moved.held, moved.free = (
            self.polar,
            self.face,
            self.held,
            self.free,
        )
        return moved

    def displacement_shape(self, local: Array) -> Array:
        """Return the displacement shape functions at local coordinates (2, ...), last axis."""
        count = self.connectivity.shape[1]
        return np.stack([self._elements[0].lbasis(local, i)[0] for i in range(count)], axis=-1)

    def pressure_shape(self, local: Array) -> Array:
        """Return the pressure shape functions at local coordinates (2, ...), last axis."""
        count = self.triangles.shape[1]
        return np.stack([self._elements[1].lbasis(local, i)[0] for i in range(count)], axis=-1)

    @property
    def displacements(self) -> int:
        """Number of displacement unknowns, held ones included."""
        return 2 * len(self.nodes)

    @property
    def size(self) -> int:
        """Number of unknowns, held ones included."""
        return self.displacements + len(self.pressure_places)

    @property
    def notch_radius(self) -> float:
        """Radius of the notch, where it meets the ligament [R_w]."""
        x, y = self.mesh.p
        return float(x[(y == 0) & (x > 0)].min())

    @property
    def outer_radius(self) -> float:
        """Radius of the body [R_w]."""
        return float(np.hypot(*self.mesh.p).max())

    def _number_unknowns(self, basis: Basis, hold: str) -> None:
        facets = self.mesh.boundary_facets()
        middle = self.mesh.p[:, self.mesh.facets[:, facets]].mean(axis=1)
        radius = np.hypot(*middle)
        on_notch = (middle[1] > 0) & (radius < np.sqrt(self.notch_radius * self.outer_radius))
        on_arc = (middle[1] > 0) & ~on_notch
        on_face = on_notch | ((middle[1] == 0) & (middle[0] < 0))
        face = np.unique(basis.get_dofs(facets=facets[on_face]).flatten())
        self.face: Index = face[self._from_tip(face)]
        held = np.zeros((len(self.nodes), 2), dtype=bool)
        held[basis.get_dofs(facets=facets[~on_face & ~on_arc]).flatten(), 1] = True
        arc = basis.get_dofs(facets=facets[on_arc]).flatten()
        x = self.nodes[arc, 0]
        keep = {"right": x >= 0, "all": x > -np.inf, "none": x > np.inf}[hold]
        held[arc[keep]] = True
        self.held = held
        self.free: NDArray[np.bool_] = np.concatenate(
            [~held.ravel(), np.ones(len(self.pressure_places), dtype=bool)]
        )

    def _from_tip(self, face: Index) -> Index:
        """Return the order of face nodes along the boundary, from the tip backwards."""
        x, y = self.nodes[face].T
        along_notch = np.where(np.hypot(x, y) < 1.001 * self.notch_radius, np.arctan2(y, x), np.pi)
        return np.lexsort((-x, along_notch))

    @cached_property
    def along_face(self) -> Array:
        """Reference distance of face nodes from the tip along the boundary [R_w]."""
        steps = np.hypot(*np.diff(self.nodes[self.face], axis=0).T)
        distance: Array = np.concatenate([[0.0], np.cumsum(steps)])
        return distance

    @cached_property
    def beyond_notch(self) -> Index:
        """Elements outside the first rings, where det F is kept positive on the way."""
        centre = self.mesh.p[:, self.mesh.t].mean(axis=1)
        return np.flatnonzero(np.hypot(*centre) > NOTCH_REACH * self.notch_radius)

    @cached_property
    def element_unknowns(self) -> Index:
        """Global unknowns of each element, shape (elements, 15)."""
        pairs = 2 * self.connectivity[:, :, None] + np.arange(2)
        return np.hstack([pairs.reshape(len(pairs), -1), self.displacements + self.triangles])

    @cached_property
    def scale(self) -> Array:
        """Factors that bring displacement and pressure equations to one size."""
        radius = np.maximum(np.hypot(*self.pressure_places.T), self.notch_radius)
        return np.concatenate([np.ones(self.displacements), 1.0 / radius])

    @cached_property
    def _pattern(self) -> _Pattern:
        """Where entries of the free block are, and what element entries they are the sums of."""
        number = np.full(self.size, -1, dtype=np.int64)
        count = int(self.free.sum())
        number[self.free] = np.arange(count)
        local = number[self.element_unknowns]
        n, m = local.shape
        i = np.broadcast_to(local[:, :, None], (n, m, m)).ravel()
        j = np.broadcast_to(local[:, None, :], (n, m, m)).ravel()
        inside = np.flatnonzero((i >= 0) & (j >= 0))
        i, j = i[inside], j[inside]
        pattern = sp.csr_matrix((np.ones(len(i), dtype=np.int8), (i, j)), shape=(count, count))
        pattern.sum_duplicates()
        pattern.data = np.arange(pattern.nnz)
        target = np.asarray(pattern[i, j]).ravel()
        scale = self.scale[self.free]
        shape = (pattern.nnz, n * m * m)
        return _Pattern(
            pattern.indices,
            pattern.indptr,
            pattern.diagonal(),
            pattern.T.tocsr().data,
            sp.csr_matrix((scale[i] * scale[j], (target, inside)), shape=shape),
        )

    def element_forces(
        self, u: Array, p: Array, centre: Array | None = None, tangents: bool = True
    ) -> tuple[Array, Array]:
        """Return residual and tangent of every element.

        Parameters
        ----------
        u : ndarray, shape (nodes, 2)
            Displacements [R_w].
        p : ndarray, shape (vertices,)
            Pressures [mu].
        centre : ndarray, shape (2,), optional
            Centre of the wire [R_w]; needed where there are polar elements.
        tangents : bool
            Whether the tangents are wanted; residuals alone take a small part of the time.

        Returns
        -------
        residual : ndarray, shape (elements, 15)
        tangent : ndarray, shape (elements, 15, 15)
            Empty where it is not wanted.
        """
        if not self.polar.any():
            return self._plain(u, p, slice(None), tangents)
        assert centre is not None, "polar elements need the wire's centre"
        plain, polar = np.flatnonzero(~self.polar), np.flatnonzero(self.polar)
        m = self.element_unknowns.shape[1]
        residual, tangent = np.empty((len(self.polar), m)), np.empty((0, m, m))
        residual[plain], of_plain = self._plain(u, p, plain, tangents)
        residual[polar], of_polar = self._polar_arrays(
            self.about(u, centre, polar),
            p[self.triangles[polar]],
            self.shape,
            self.grad[polar],
            self.psi,
            self.dx[polar],
            self.alpha,
            self.bulk[polar],
            tangents,
        )
        if tangents:
            tangent = np.empty((len(self.polar), m, m))
            tangent[plain], tangent[polar] = of_plain, of_polar
        return residual, tangent

    def _plain(
        self, u: Array, p: Array, elements: Index | slice, tangents: bool
    ) -> tuple[Array, Array]:
        return self._plain_arrays(
            self._local(u, elements),
            p[self.triangles[elements]],
            self.grad[elements],
            self.psi,
            self.dx[elements],
            self.alpha,
            self.bulk[elements],
            tangents,
        )

    def about(self, u: Array, centre: Array, elements: Index) -> Array:
        """Return the nodes of elements relative to the wire's centre."""
        nodes = self.connectivity[elements]
        relative: Array = self.nodes[nodes] + u[nodes] - centre
        return relative

    def centre_rate(self, tangent: Array, axis: Array) -> Array:
        """Return the derivative of the residual as the wire's centre moves along `axis`.

        Only polar elements see the centre; they see its move as that of their own nodes backwards.
        """
        elements = np.flatnonzero(self.polar)
        nodes = self.connectivity.shape[1]
        moved = np.concatenate([np.tile(axis, nodes), np.zeros(self.triangles.shape[1])])
        rate = np.bincount(
            self.element_unknowns[elements].ravel(),
            -(tangent[elements] @ moved).ravel(),
            minlength=self.size,
        )
        return np.asarray(rate, dtype=np.float64)

    def _local(self, u: Array, elements: Index | slice = slice(None)) -> Array:
        """Return the displacements of each element's nodes relative to its first node.

        Gradients of a rigid translation cancel; taking it out first keeps their digits.
        """
        local = u[self.connectivity[elements]]
        local[:, :_RIGID] -= local[:, :1].copy()
        return local

    def gather(self, residual: Array) -> Array:
        """Return the global residual, held unknowns included."""
        total: Array = np.bincount(
            self.element_unknowns.ravel(), residual.ravel(), minlength=self.size
        ).astype(np.float64, copy=False)
        return total

    def matrix(self, tangent: Array) -> sp.csr_matrix:
        """Return the scaled tangent of the free unknowns."""
        pattern = self._pattern
        data = pattern.sums @ tangent.ravel()
        return self._of_pattern(data)

    def _of_pattern(self, data: Array) -> sp.csr_matrix:
        pattern = self._pattern
        count = len(pattern.pointers) - 1
        return sp.csr_matrix((data, pattern.columns, pattern.pointers), shape=(count, count))

    def eliminate(self, matrix: sp.csr_matrix, fixed: NDArray[np.bool_]) -> sp.csr_matrix:
        """Return the matrix with rows and columns of `fixed` free unknowns made the identity."""
        pattern, data = self._pattern, matrix.data.copy()
        rows = np.flatnonzero(fixed)
        off = row_entries(pattern.pointers, rows)
        data[off] = 0.0
        data[pattern.transposed[off]] = 0.0
        data[pattern.diagonal[rows]] = 1.0
        return self._of_pattern(data)

    def displacement_gradient(
        self, u: Array, elements: Index | slice = slice(None), centre: Array | None = None
    ) -> Array:
        """Return F - I at the quadrature points, up to a rotation of polar elements.

        Parameters
        ----------
        u : ndarray, shape (nodes, 2)
            Displacements [R_w].
        elements : ndarray of int or slice
            Which elements, by default all.
        centre : ndarray, shape (2,), optional
            Centre of the wire [R_w]; needed where there are polar elements.

        Returns
        -------
        ndarray, shape (2, 2, elements, points)
        """
        arm = self._local(u, elements).transpose(0, 2, 1)[:, None]
        gradient: Array = np.moveaxis(arm @ self.grad[elements], (2, 3), (0, 1))
        which = np.arange(len(self.polar))[elements]
        polar = np.flatnonzero(self.polar[which])
        if len(polar):
            assert centre is not None, "polar elements need the wire's centre"
            chosen = which[polar]
            gradient[:, :, polar] = kernels.polar_gradient(
                self.about(u, centre, chosen), self.shape, self.grad[chosen]
            )
        return gradient

    def pressure_at_points(self, p: Array, elements: Index | slice = slice(None)) -> Array:
        """Return the pressure at the quadrature points, shape (elements, points)."""
        values: Array = np.einsum("em,qm->eq", p[self.triangles[elements]], self.psi)
        return values

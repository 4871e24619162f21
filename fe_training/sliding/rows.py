"""Linear systems that differ from a symmetric one in a few rows.

Friction and wear change the tangential rows of the touching nodes alone, but what they add grows
with the load.  Processor time of one iteration's factors and three solutions (53,000 unknowns,
150 touching nodes, one thread, alpha = g = 5), by what is factorised:

=============================================  ===================  ===============
                                               xi 0.02, tau_w 0.2   xi 0.5, tau_w 5
=============================================  ===================  ===============
the unsymmetric matrix, PARDISO                0.17 s               0.17 s
the symmetric one, with conjugate residuals    0.48 s               1.90 s
the symmetric one, and a system for the rows   2.0 s                2.0 s
=============================================  ===================  ===============

(the frictionless matrix: 0.14 s).  So the whole matrix is factorised, by scipy's SuperLU where
PARDISO is not installed.
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray
from scipy.sparse.linalg import splu

from fe_training.solver.linear_solvers import Pardiso, available_solvers

Array = NDArray[np.float64]
Index = NDArray[np.int64]


class _UnsymmetricPardiso(Pardiso):
    """PARDISO for matrices of which the pattern alone is symmetric."""

    _SYMMETRIC_INDEFINITE = 1

    def __init__(self) -> None:
        super().__init__()
        self._analysed = False

    def factorize(self, matrix: sp.csr_matrix) -> None:
        """Factorise a new matrix; the first one fixes the ordering."""
        self._matrix = matrix
        self._call(22 if self._analysed else 12, np.zeros((matrix.shape[0], 1), order="F"))
        self._analysed = True


class _UnsymmetricSuperLU:
    """SuperLU with diagonal pivots wherever they are not small, as for the symmetric matrix."""

    def factorize(self, matrix: sp.csr_matrix) -> None:
        """Factorise a new matrix."""
        self._lu = splu(
            matrix.tocsc(),
            permc_spec="MMD_AT_PLUS_A",
            diag_pivot_thresh=1e-3,
            options={"SymmetricMode": True},
        )

    def solve(self, right: Array) -> Array:
        """Return the solutions for the columns of `right`."""
        return np.asarray(self._lu.solve(np.ascontiguousarray(right)))


class ChangedRows:
    """Solves with symmetric matrices of one pattern, some rows of which have additions.

    Parameters
    ----------
    name : str, optional
        As of :func:`fe_training.solver.linear_solvers.make_solver`; all but ``"pardiso"`` mean
        SuperLU.
    """

    def __init__(self, name: str | None = None) -> None:
        pardiso = (name or available_solvers()[0]) == "pardiso"
        self.name = "pardiso" if pardiso else "superlu"
        self._factors = _UnsymmetricPardiso() if pardiso else _UnsymmetricSuperLU()

    def factorize(self, matrix: sp.csr_matrix, rows: Index, additions: sp.csr_matrix) -> None:
        """Factorise a symmetric matrix with `additions`, of its own pattern, to some `rows`."""
        self._factors.factorize(_added(matrix, rows, additions))

    def solve(self, right: Array) -> Array:
        """Return the solutions for the columns of `right`."""
        return self._factors.solve(right)


def _added(matrix: sp.csr_matrix, rows: Index, additions: sp.csr_matrix) -> sp.csr_matrix:
    """Return a matrix with additions to some of its rows, with all of its own entries."""
    additions.sum_duplicates()
    data, pointers, ends = matrix.data.copy(), matrix.indptr, additions.indptr
    for i, row in enumerate(rows):
        own, more = slice(pointers[row], pointers[row + 1]), slice(ends[i], ends[i + 1])
        places = np.searchsorted(matrix.indices[own], additions.indices[more])
        data[own][places] += additions.data[more]
    return sp.csr_matrix((data, matrix.indices, pointers), shape=matrix.shape)

"""Linear systems that differ from a symmetric one in a few rows.

Friction and wear change the tangential rows of the touching nodes alone: the matrix is
``A + E C``, where E puts m rows into their places.  With the symmetric factors of A,

    (A + E C) x = b   <=>   x = z - A^-1 E y,   z = A^-1 b,   (I + C A^-1 E) y = C z,

a dense system with as many unknowns as rows.
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray
from scipy.linalg import lu_factor, lu_solve

from fe_training.solver.linear_solvers import LinearSolver

Array = NDArray[np.float64]
Index = NDArray[np.int64]


class ChangedRows:
    """Solves with a symmetric matrix some rows of which have additions.

    Parameters
    ----------
    solver : LinearSolver
        Used for the symmetric matrix; its analysis is reused.
    """

    def __init__(self, solver: LinearSolver) -> None:
        self._solver = solver

    def factorize(self, matrix: sp.csr_matrix, rows: Index, additions: sp.csr_matrix) -> None:
        """Factorise a symmetric matrix, and the one with `additions` to `rows`."""
        self._solver.factorize(matrix)
        self._additions, self._none = additions, not len(rows)
        if self._none:
            return
        places = np.zeros((matrix.shape[0], len(rows)), order="F")
        places[rows, np.arange(len(rows))] = 1.0
        self._responses = self._solver.solve(places)
        self._reduced = lu_factor(np.eye(len(rows)) + additions @ self._responses)

    def solve(self, right: Array) -> Array:
        """Return the solutions for the columns of `right`."""
        x = self._solver.solve(right)
        if self._none:
            return x
        return np.asarray(x - self._responses @ lu_solve(self._reduced, self._additions @ x))

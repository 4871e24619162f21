"""Direct linear solvers behind one small interface.

A solver is made for one sparsity pattern and then given one matrix after another: the symbolic
analysis is done once.  SuperLU from scipy always works; PARDISO is taken where pypardiso is
installed, MUMPS where python-mumps is.
"""

from __future__ import annotations

import weakref
from abc import ABC, abstractmethod
from importlib.util import find_spec
from typing import Any

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray
from scipy.sparse.linalg import splu

from .errors import InputError, MissingExtraError

Array = NDArray[np.float64]


class LinearSolver(ABC):
    """Factorises matrices of one sparsity pattern and solves with them."""

    name: str

    @abstractmethod
    def factorize(self, matrix: sp.csr_matrix) -> None:
        """Factorise a new matrix of the same pattern."""

    @abstractmethod
    def solve(self, right: Array) -> Array:
        """Return the solutions for the columns of `right`."""


class SuperLU(LinearSolver):
    """scipy's SuperLU: slow, but always there."""

    name = "superlu"

    def factorize(self, matrix: sp.csr_matrix) -> None:
        """Factorise a new matrix."""
        # the matrix is structurally symmetric; ordering A^T + A halves the fill of COLAMD
        self._lu = splu(
            matrix.tocsc(),
            permc_spec="MMD_AT_PLUS_A",
            diag_pivot_thresh=0.001,
            options={"SymmetricMode": True},
        )

    def solve(self, right: Array) -> Array:
        """Return the solutions for the columns of `right`."""
        return np.asarray(self._lu.solve(np.ascontiguousarray(right)))


class Pardiso(LinearSolver):
    """Intel's PARDISO through pypardiso: symmetric indefinite, its analysis reused."""

    name = "pardiso"
    _SYMMETRIC_INDEFINITE = -2

    def __init__(self) -> None:
        import pypardiso

        self._solver: Any = pypardiso.PyPardisoSolver(mtype=self._SYMMETRIC_INDEFINITE)
        self._upper: NDArray[np.int64] | None = None
        weakref.finalize(self, self._solver.free_memory, everything=True)

    def _call(self, phase: int, right: Array) -> Array:
        self._solver.set_phase(phase)
        return np.asarray(self._solver._call_pardiso(self._matrix, right))

    def factorize(self, matrix: sp.csr_matrix) -> None:
        """Factorise a new matrix; the first one fixes the ordering."""
        first = self._upper is None
        if first:
            rows = np.repeat(np.arange(matrix.shape[0]), np.diff(matrix.indptr))
            self._upper = np.flatnonzero(matrix.indices >= rows)
            self._pattern = sp.triu(matrix, format="csr")
        self._matrix = sp.csr_matrix(
            (matrix.data[self._upper], self._pattern.indices, self._pattern.indptr),
            shape=matrix.shape,
        )
        self._call(12 if first else 22, np.zeros((matrix.shape[0], 1), order="F"))

    def solve(self, right: Array) -> Array:
        """Return the solutions for the columns of `right`."""
        return self._call(33, np.asfortranarray(right))


class Mumps(LinearSolver):
    """MUMPS through python-mumps, its analysis reused from matrix to matrix."""

    name = "mumps"

    def __init__(self) -> None:
        import mumps

        self._context: Any = mumps.Context()
        self._analysed = False

    def factorize(self, matrix: sp.csr_matrix) -> None:
        """Factorise a new matrix; the first one fixes the ordering."""
        self._context.set_matrix(matrix.tocoo(), symmetric=False)
        if not self._analysed:
            self._context.analyze()
            self._analysed = True
        self._context.factor(reuse_analysis=True)

    def solve(self, right: Array) -> Array:
        """Return the solutions for the columns of `right`."""
        columns = [self._context.solve(column) for column in np.atleast_2d(right.T)]
        return np.stack(columns, axis=-1).reshape(right.shape)


_SOLVERS: dict[str, tuple[str, type[LinearSolver]]] = {
    "pardiso": ("pypardiso", Pardiso),
    "mumps": ("mumps", Mumps),
    "superlu": ("scipy", SuperLU),
}


def available_solvers() -> tuple[str, ...]:
    """Return the names of the solvers installed here, fastest first."""
    return tuple(name for name, (package, _) in _SOLVERS.items() if find_spec(package))


def make_solver(name: str | None = None) -> LinearSolver:
    """Return a new solver.

    Parameters
    ----------
    name : str, optional
        ``"pardiso"``, ``"mumps"`` or ``"superlu"``; the fastest one installed by default.

    Returns
    -------
    LinearSolver
        Ready for :meth:`LinearSolver.factorize`.

    Raises
    ------
    InputError
        If the name is unknown.
    MissingExtraError
        If the solver named is not installed.

    Examples
    --------
    >>> make_solver("superlu").name
    'superlu'
    """
    usable = available_solvers()
    if name is None:
        name = usable[0]
    if name not in _SOLVERS:
        raise InputError(f"solver = {name!r} is unknown; known: {', '.join(_SOLVERS)}")
    if name not in usable:
        known = ", ".join(usable)
        raise MissingExtraError(
            f"linear solver {name!r} is not installed here; installed: {known}. "
            "`pip install 'wirecut[pardiso]'` adds PARDISO on Linux x86-64."
        )
    return _SOLVERS[name][1]()

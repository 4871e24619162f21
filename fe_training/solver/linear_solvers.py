"""Direct linear solvers behind one small interface.

A solver is made for one sparsity pattern and then given one matrix after another: PARDISO and
MUMPS do their symbolic analysis once.

Without a name the first one installed of PARDISO, MUMPS and SuperLU is taken.  The order is that
of the processor time of one factorisation and one solution with two right-hand sides (alpha = 2,
tangents of the raised wire, one thread; the least of twelve on a machine with other work; every
backward error below 1e-14):

=======  =======================  ===============  ===============  ====================
solver   package                  37,000 unknowns  71,000 unknowns  and once, analysis
=======  =======================  ===============  ===============  ====================
PARDISO  pypardiso                0.08 s           0.18 s           0.2 s, 0.4 s
MUMPS    python-mumps             0.16 s           0.39 s           0.1 s, 0.3 s
SuperLU  scipy, always installed  0.39 s           0.94 s           none
=======  =======================  ===============  ===============  ====================

MUMPS was built on a plain, unoptimised BLAS; with another one the times may be closer.
"""

from __future__ import annotations

import os
import weakref
from abc import ABC, abstractmethod
from importlib.util import find_spec
from types import MappingProxyType
from typing import Any

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray
from scipy.sparse.linalg import splu

from surrogate.errors import InputError, MissingExtraError

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


class _UpperTriangle:
    """Takes the upper triangles out of symmetric matrices of one pattern."""

    def __init__(self, matrix: sp.csr_matrix) -> None:
        rows = np.repeat(np.arange(matrix.shape[0]), np.diff(matrix.indptr))
        self._entries = np.flatnonzero(matrix.indices >= rows)
        self._pattern = sp.triu(matrix, format="csr")

    def __call__(self, matrix: sp.csr_matrix) -> sp.csr_matrix:
        pattern = self._pattern
        return sp.csr_matrix(
            (matrix.data[self._entries], pattern.indices, pattern.indptr), shape=matrix.shape
        )


class SuperLU(LinearSolver):
    """scipy's SuperLU: the slowest, but always there.

    It knows no symmetric factorisation; its symmetric mode keeps to diagonal pivots, in an order
    for A + A^T, as long as they are not below `_PIVOT_THRESHOLD` times the largest of their column.
    The fill grows steeply with that threshold: at 27,000 unknowns 4 million entries with 1e-3 (and
    with 0), 11 million with 1e-2 and 85 million, a minute's work, with 0.1.  Column ordering with
    full pivoting (COLAMD) takes three times as long.
    """

    name = "superlu"
    _PIVOT_THRESHOLD = 1e-3

    def factorize(self, matrix: sp.csr_matrix) -> None:
        """Factorise a new matrix."""
        self._lu = splu(
            matrix.tocsc(),
            permc_spec="MMD_AT_PLUS_A",
            diag_pivot_thresh=self._PIVOT_THRESHOLD,
            options={"SymmetricMode": True},
        )

    def solve(self, right: Array) -> Array:
        """Return the solutions for the columns of `right`."""
        return np.asarray(self._lu.solve(np.ascontiguousarray(right)))


class Pardiso(LinearSolver):
    """Intel's PARDISO through pypardiso: symmetric indefinite, its analysis reused.

    Its settings are MKL's own for such matrices, with three exceptions.  Solutions are refined only
    where pivots had to be perturbed, which backward errors below 1e-14 show to be enough.  Its
    two-level algorithms take 0.75 of the time for a factorisation and 0.6 for two solutions.  And
    pivots count as zero below 1e-10 of the matrix, not below 1e-8: pressures of short elements far
    from the tip have such pivots, sound ones, and their replacement made Newton's method crawl.
    """

    name = "pardiso"
    _SYMMETRIC_INDEFINITE = -2
    #: Settings given: nested dissection, refinements, perturbation 10^-10, Bunch-Kaufman pivots,
    #: two-level factorisation, solution of several columns at once.
    _SETTINGS = MappingProxyType({1: 1, 2: 2, 8: 0, 10: 10, 21: 1, 24: 10, 25: 2})

    def __init__(self) -> None:
        import pypardiso
        from pypardiso.scipy_aliases import pypardiso_solver

        # its own first solver has searched the whole installation for MKL; each would again
        os.environ.setdefault("PYPARDISO_MKL_RT", pypardiso_solver.libmkl._name)
        self._solver: Any = pypardiso.PyPardisoSolver(mtype=self._SYMMETRIC_INDEFINITE)
        for number, value in self._SETTINGS.items():
            self._solver.set_iparm(number, value)
        self._upper: _UpperTriangle | None = None
        weakref.finalize(self, self._solver.free_memory, everything=True)

    def _call(self, phase: int, right: Array) -> Array:
        self._solver.set_phase(phase)
        return np.asarray(self._solver._call_pardiso(self._matrix, right))

    def factorize(self, matrix: sp.csr_matrix) -> None:
        """Factorise a new matrix; the first one fixes the ordering."""
        first = self._upper is None
        if self._upper is None:
            self._upper = _UpperTriangle(matrix)
        self._matrix = self._upper(matrix)
        self._call(12 if first else 22, np.zeros((matrix.shape[0], 1), order="F"))

    def solve(self, right: Array) -> Array:
        """Return the solutions for the columns of `right`."""
        return self._call(33, np.asfortranarray(right))


class Mumps(LinearSolver):
    """MUMPS through python-mumps: symmetric indefinite, its analysis reused.

    The analysis looks at the pattern alone.  What MUMPS does by default for symmetric matrices,
    pairing rows by the values of the first matrix, fits the later ones no better than no pairing.
    """

    name = "mumps"
    _ORDERING = "pord"
    _PAIRING, _NO_PAIRING = 12, 1

    def __init__(self) -> None:
        import mumps

        self._context: Any = mumps.Context()
        self._upper: _UpperTriangle | None = None

    def factorize(self, matrix: sp.csr_matrix) -> None:
        """Factorise a new matrix; the first one fixes the ordering."""
        first = self._upper is None
        if self._upper is None:
            self._upper = _UpperTriangle(matrix)
        self._context.set_matrix(self._upper(matrix).tocoo(), symmetric=True)
        if first:
            self._context.mumps_instance.icntl[self._PAIRING] = self._NO_PAIRING
            self._context.analyze(ordering=self._ORDERING)
        self._context.factor(reuse_analysis=True)

    def solve(self, right: Array) -> Array:
        """Return the solutions for the columns of `right`."""
        return np.asarray(self._context.solve(np.asfortranarray(right)))


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
            "`pip install 'wirecut[pardiso]'` adds PARDISO on Linux x86-64, "
            "`pip install 'wirecut[mumps]'` MUMPS where its library is installed."
        )
    return _SOLVERS[name][1]()

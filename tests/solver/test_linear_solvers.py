"""Linear solvers: they agree on the engine's matrices, reuse their analysis, and name a remedy."""

from dataclasses import replace

import numpy as np
import pytest

from fe_training.mechanics.active_set import ActiveSet
from fe_training.mechanics.mesh import MeshSpec, crack_mesh
from fe_training.solver import linear_solvers as solvers
from fe_training.solver.adapt import refined
from fe_training.solver.cut import Settings, at_ends
from fe_training.solver.equilibrium import Linearisation, undeformed
from fe_training.solver.solve import far_field_cut
from surrogate.errors import InputError, MissingExtraError

SPEC = MeshSpec(notch_radius=0.05, outer_radius=3.0, sectors=5, contact_spacing=1.0)
NAMES = sorted(solvers._SOLVERS)


@pytest.fixture(params=NAMES)
def solver(request):
    if request.param not in solvers.available_solvers():
        pytest.skip(f"{request.param} is not installed")
    return solvers.make_solver(request.param)


@pytest.fixture(scope="module")
def matrices(places):
    """Tangents of one body in three states: symmetric, indefinite, with a zero block."""
    from fe_training.mechanics.body import Body

    body = Body(crack_mesh(SPEC), 3.0)
    rng = np.random.default_rng(6)
    return [
        body.matrix(
            body.element_forces(
                size * np.hypot(*places(body).T)[:, None] * rng.normal(size=body.nodes.shape),
                rng.normal(size=body.size - body.displacements),
            )[1]
        )
        for size in (0.0, 0.01, 0.1)
    ]


def backward_error(matrix, x, right):
    """Return the residual relative to what the products A x and b are made of, by columns."""
    return np.abs(right - matrix @ x).max() / (abs(matrix) @ np.abs(x) + np.abs(right)).max()


def test_solutions_of_two_right_sides_are_backward_stable(solver, matrices):
    """Pivoting is restricted to keep the fill down, so growth costs some of the 16 digits.

    Newton's method needs a direction, not the last digit: 1e-10 leaves its convergence quadratic
    down to the residual asked for.
    """
    right = np.random.default_rng(7).normal(size=(matrices[0].shape[0], 2))
    for matrix in matrices:
        solver.factorize(matrix)
        x = solver.solve(right)
        assert x.shape == right.shape
        assert backward_error(matrix, x, right) < 1e-10


@pytest.mark.parametrize("name", NAMES)
def test_solvers_agree(name, matrices):
    if name not in solvers.available_solvers():
        pytest.skip(f"{name} is not installed")
    right = np.random.default_rng(8).normal(size=(matrices[0].shape[0], 2))
    for matrix in matrices:
        dense = np.linalg.solve(matrix.toarray(), right)
        one = solvers.make_solver(name)
        one.factorize(matrix)
        bound = 1e-10 * np.linalg.cond(matrix.toarray(), np.inf)
        error = np.abs(one.solve(right) - dense).max() / np.abs(dense).max()
        assert error < min(bound, 1e-6)


def test_analysis_is_done_once(solver, matrices):
    """A solver given a sequence of matrices returns what a fresh one does for each."""
    right = np.random.default_rng(9).normal(size=(matrices[0].shape[0], 1))
    for matrix in [*matrices, *matrices]:
        solver.factorize(matrix)
        fresh = solvers.make_solver(solver.name)
        fresh.factorize(matrix)
        expected = fresh.solve(right)
        np.testing.assert_allclose(
            solver.solve(right), expected, rtol=0, atol=1e-7 * np.abs(expected).max()
        )


def test_pardiso_is_told_to_keep_its_analysis(matrices, monkeypatch):
    if "pardiso" not in solvers.available_solvers():
        pytest.skip("pypardiso is not installed")
    phases = []
    plain = solvers.Pardiso._call

    def recorded(self, phase, right):
        phases.append(phase)
        return plain(self, phase, right)

    monkeypatch.setattr(solvers.Pardiso, "_call", recorded)
    solver = solvers.make_solver("pardiso")
    right = np.ones((matrices[0].shape[0], 1))
    for matrix in matrices:
        solver.factorize(matrix)
        solver.solve(right)
    # 12: analysis and factorisation, 22: factorisation alone, 33: solution
    assert phases == [12, 33, 22, 33, 22, 33]


def test_mumps_keeps_its_analysis_and_solves_all_columns_at_once(matrices, monkeypatch):
    if "mumps" not in solvers.available_solvers():
        pytest.skip("python-mumps is not installed")
    import mumps

    done = []
    for job in ("analyze", "factor", "solve"):
        plain = getattr(mumps.Context, job)

        def recorded(*args, plain=plain, job=job, **options):
            done.append(job)
            return plain(*args, **options)

        monkeypatch.setattr(mumps.Context, job, recorded)
    solver = solvers.make_solver("mumps")
    right = np.ones((matrices[0].shape[0], 3))
    for matrix in matrices:
        solver.factorize(matrix)
        solver.solve(right)
    assert done == ["analyze", "factor", "solve", "factor", "solve", "factor", "solve"]


def test_superlu_is_always_there_and_the_fastest_is_chosen(monkeypatch):
    assert "superlu" in solvers.available_solvers()
    assert solvers.make_solver().name == solvers.available_solvers()[0]
    monkeypatch.setattr(solvers, "find_spec", lambda package: package == "scipy" or None)
    assert solvers.available_solvers() == ("superlu",)
    assert solvers.make_solver().name == "superlu"


@pytest.mark.parametrize("name", ["pardiso", "mumps"])
def test_a_missing_solver_is_named_with_a_remedy(name, monkeypatch):
    monkeypatch.setattr(solvers, "find_spec", lambda package: package == "scipy" or None)
    with pytest.raises(MissingExtraError, match=rf"'{name}'.*superlu.*pip install"):
        solvers.make_solver(name)


def test_an_unknown_solver_is_named_with_those_that_exist():
    with pytest.raises(InputError, match=r"'mystery' is unknown.*superlu"):
        solvers.make_solver("mystery")


def test_short_elements_far_from_the_tip_cost_no_digits(solver):
    """Pivots of their pressures are small but sound: none of them may be replaced."""
    cut = far_field_cut(5.0, 50.0, Settings(sectors=12))
    state = undeformed(cut.body, -50.0)
    touching = np.abs(cut.body.along_face - 50.0) < 0.5
    state = replace(state, active=ActiveSet(touching, np.zeros_like(touching)))
    body, state = refined(cut.body, state, at_ends(cut.body, state))
    lin = Linearisation(body, state, np.array([0.0, 1.0]))
    matrix = body.eliminate(lin.matrix, lin.fixed)
    right = np.random.default_rng(9).normal(size=(matrix.shape[0], 1))
    solver.factorize(matrix)
    assert np.abs(right - matrix @ solver.solve(right)).max() < 1e-6

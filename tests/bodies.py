"""Coarse bodies, and a plain Newton's method for bodies without contact."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
import pytest

from fe_training.mechanics.body import Body
from fe_training.mechanics.mesh import MeshSpec, crack_mesh
from fe_training.solver.equilibrium import (
    Control,
    NewtonOutcome,
    State,
    equilibrate,
    undeformed,
)
from fe_training.solver.linear_solvers import make_solver

RISE = (-0.9, -0.77, -0.6, -0.4, -0.2, 0.0)


class FramedBody(Body):
    """A body of any shape around a tip at the origin, with its own held displacements.

    `hold` maps node coordinates of shape (nodes, 2) to held components of the same shape; held
    components keep the value that they have in the displacements given to `relaxed`.
    """

    def __init__(self, mesh, alpha, hold: Callable, **options):
        self._hold = hold
        super().__init__(mesh, alpha, **options)

    def nodal(self, function: Callable):
        """Return displacements with the values of `function(X, Y)`; bubbles have none."""
        u = np.array(function(*places_(self).T), dtype=float).T
        u[np.unique(self.connectivity[:, 6:])] = 0.0
        return u

    @property
    def notch_radius(self):
        """Distance that stands for the radius of the notch; the mesh has a sharp tip or none."""
        return 1e-3

    def _number_unknowns(self, basis, hold):
        self.face = np.array([], dtype=np.int64)
        self.held = np.asarray(self._hold(self.nodes), dtype=bool)
        self.free = np.concatenate(
            [~self.held.ravel(), np.ones(self.size - self.displacements, dtype=bool)]
        )


def places_(body):
    """Return where each displacement unknown sits: nodes, and centroids for bubbles."""
    places = body.nodes.copy()
    for bubble in body.connectivity[:, 6:].T:
        places[bubble] = body.mesh.p[:, body.mesh.t].mean(axis=1).T
    return places


@pytest.fixture(scope="session")
def places():
    """Where each displacement unknown sits."""
    return places_


@dataclass(frozen=True)
class Relaxed:
    """An equilibrium without contact."""

    u: np.ndarray
    p: np.ndarray
    residuals: tuple[float, ...]

    @property
    def state(self):
        """The equilibrium as the engine's own record."""
        return State(self.u, self.p, np.zeros(2), None, np.zeros(0), np.zeros((0, 2)))


def relaxed_(body, u, p=None, load=0.0, goal=1e-13, iterations=25):
    """Return the equilibrium under a dead load, from `u` with its held values, by full steps."""
    solver = make_solver()
    u = u.copy()
    p = np.zeros(body.size - body.displacements) if p is None else p.copy()
    scale = body.scale[body.free]
    residuals = []
    for _ in range(iterations):
        forces, tangents = body.element_forces(u, p)
        internal = body.gather(forces)
        out = (internal - load)[body.free] * scale
        # the largest nodal force that the elements exchange says what rounding is
        size = np.abs(forces).max()
        residuals.append(float(np.abs(out).max() / size))
        if residuals[-1] < goal:
            return Relaxed(u, p, tuple(residuals))
        solver.factorize(body.matrix(tangents))
        step = np.zeros(body.size)
        step[body.free] = solver.solve(-out[:, None])[:, 0] * scale
        u += step[: body.displacements].reshape(-1, 2)
        p += step[body.displacements :]
    raise AssertionError(f"no equilibrium without contact: residuals {residuals}")


@pytest.fixture(scope="session")
def framed_body():
    """The class of bodies with explicit boundary conditions."""
    return FramedBody


@pytest.fixture(scope="session")
def relaxed():
    """Newton's method for a body without contact."""
    return relaxed_


def raised_(body, position, heights=RISE):
    """Return the equilibrium with the wire raised to the last height at `position`."""
    solver = make_solver()
    state = undeformed(body, position)
    for height in heights:
        state, outcome = equilibrate(body, state, Control.HEIGHT, height, solver)
        assert outcome is NewtonOutcome.CONVERGED, (height, outcome)
    return state


@pytest.fixture(scope="session")
def raised():
    """Raise the wire behind the tip of an unloaded body."""
    return raised_


@dataclass(frozen=True)
class Cut:
    """A coarse half body with the wire at y = 0."""

    body: Body
    state: State

    def moved(self, control, target):
        """Return the equilibrium at another value of a control."""
        state, outcome = equilibrate(self.body, self.state, control, target, make_solver())
        assert outcome is NewtonOutcome.CONVERGED
        return state


def cut_(alpha, sectors=14, compiled=True):
    spec = MeshSpec(
        sectors=sectors,
        notch_radius=0.02,
        outer_radius=1e4,
        contact_spacing=0.15 * 14 / sectors,
    )
    body = Body(crack_mesh(spec), alpha=alpha, compiled=compiled)
    return Cut(body, raised_(body, -1.2))


@pytest.fixture(scope="session")
def cut() -> Iterator[Cut]:
    """The neo-Hookean body with the wire at x = -1.2, far enough not to touch the tip."""
    return cut_(2.0)


@pytest.fixture(scope="session")
def stiffening_cut():
    """The same with alpha = 5."""
    return cut_(5.0)


@pytest.fixture(scope="session")
def cut_of():
    """Return a raised cut of given alpha and number of sectors."""
    return cut_

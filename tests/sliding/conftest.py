"""A coarse body of alpha = 5 that is cut at g = 2, without friction and wear."""

from dataclasses import dataclass, replace

import pytest

from fe_training.sliding.balance import Support
from fe_training.sliding.equilibrium import Problem, equilibrate
from fe_training.sliding.leg import Leg, Point
from fe_training.sliding.path import Steps, follow
from fe_training.sliding.rows import ChangedRows
from fe_training.sliding.state import without_shear
from fe_training.solver.cut import Cut as FrictionlessCut
from fe_training.solver.cut import Settings
from fe_training.solver.observe import contact_arc
from fe_training.solver.solve import indentation_cut
from fe_training.solver.state import NewtonOutcome

COARSE = Settings(sectors=14, contact_spacing=0.15, notch_radius=5e-3, outer_radius=1e5)


@dataclass(frozen=True)
class Sliding:
    """A frictionless equilibrium to begin from."""

    problem: Problem
    state: object
    start: Point
    cut: FrictionlessCut

    @property
    def arc(self):
        """The frictionless contact."""
        return contact_arc(self.problem.body, self.state)

    def at(self, load, first=0.1, begin=None):
        """Return the equilibrium at a load, on a straight path from here or from `begin`."""
        point, state = begin or (self.start, self.state)
        end = Point(self.start.g, load)
        state, outcome = equilibrate(
            self.problem, replace(state, tangent=None, step=0.0), Leg(point, end), 0.0
        )
        assert outcome is NewtonOutcome.CONVERGED
        *_, last = follow(self.problem, state, Leg(point, end), Steps(first))
        return end, last


@pytest.fixture(scope="session")
def sliding():
    """A frictionless equilibrium to begin from."""
    cut = indentation_cut(5.0, COARSE)
    state = without_shear(cut.body, cut.at(cut.raised(-2.2), 2.0))
    support = Support(*cut.supports(state)[0])
    problem = Problem(cut.body, support, ChangedRows())
    start = Point(support.energy_release_rate(cut.body, state))
    return Sliding(problem, state, start, cut)

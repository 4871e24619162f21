"""The unsymmetric tangent against differences, of the residual and of equilibria."""

from dataclasses import replace

import numpy as np
import pytest

from fe_training.sliding.equilibrium import equilibrate
from fe_training.sliding.leg import Leg, Point
from fe_training.sliding.shear import Load
from fe_training.sliding.tangent import SlidingLinearisation, SlidingResidual
from fe_training.solver.state import NewtonOutcome

LOADS = [Load(0.2, 0.7), Load(0.2, 0.7, taper=0.5)]


def moved(lin, du, angle, t):
    """Return the state with free nodes moved by `t du` and touching ones along the wire."""
    body, state = lin.body, lin.state
    u = state.u + t * du
    arm = state.about(body, lin.nodes)
    cos, sin = np.cos(t * angle), np.sin(t * angle)
    x, y = arm.T
    turned = np.stack([x * cos - y * sin, x * sin + y * cos], axis=1)
    u[lin.nodes] = state.centre + turned - body.nodes[lin.nodes]
    return replace(state, u=u)


@pytest.mark.parametrize("load", LOADS)
def test_matrix_is_the_derivative_of_the_sliding_residual(sliding, load):
    """Central differences of fourth order with step 1e-4 leave about 1e-9 of the largest entry."""
    body = sliding.problem.body
    _, state = sliding.at(load)
    lin = SlidingLinearisation(body, state, load)
    rng = np.random.default_rng(3)
    r = np.hypot(*body.nodes.T)[:, None]
    du = 1e-3 * np.minimum(r, 1.0) * rng.normal(size=state.u.shape)
    du[body.held] = 0.0
    dp = 1e-2 * rng.normal(size=state.p.shape)
    angle = 1e-3 * (1.0 + rng.normal(size=len(lin.nodes)))

    def residual(t):
        at = replace(moved(lin, du, angle, t), p=state.p + t * dp)
        return SlidingResidual(body, at, load).residual

    h = 1e-3
    slope = (residual(-2 * h) - 8 * residual(-h) + 8 * residual(h) - residual(2 * h)) / (12 * h)
    x = np.concatenate([du.ravel(), dp])
    pairs = x[: body.displacements].reshape(-1, 2)
    pairs[lin.nodes] = np.stack([0 * angle, angle], axis=1)
    scale = body.scale[body.free]
    product = lin.matrix @ (x[body.free] / scale)
    product[lin.places] += lin.additions @ (x[body.free] / scale)
    rows = np.zeros(body.size, dtype=bool)
    rows[lin.shear.rows] = True
    rows &= body.free
    expected = slope[rows]
    assert product[rows[body.free]] == pytest.approx(expected, abs=1e-7 * np.abs(expected).max())
    # and the additions are a part that would be missed
    without = (lin.matrix @ (x[body.free] / scale))[rows[body.free]]
    assert np.abs(without - expected).max() > 0.01 * np.abs(expected).max()


@pytest.mark.parametrize("load", LOADS)
@pytest.mark.parametrize("end", [Load(0.3, 0.7), Load(0.2, 1.0)])
@pytest.mark.parametrize("toughening", [1.0, 1.3])
def test_tangent_is_the_derivative_of_the_equilibrium(sliding, load, end, toughening):
    """Two equilibria on either side: the second difference leaves h^2 of the tangent."""
    here, state = sliding.at(load)
    leg = Leg(here, Point(here.g * toughening, replace(end, taper=load.taper)))
    state, outcome = equilibrate(sliding.problem, replace(state, tangent=None), leg, 0.0)
    assert outcome is NewtonOutcome.CONVERGED
    h = 1e-4
    there, back = (equilibrate(sliding.problem, state, leg, t)[0] for t in (h, -h))
    assert (there.active.wire == back.active.wire).all()
    tangent = state.tangent
    for slope, differences in (
        (tangent.u, (there.u - back.u) / (2 * h)),
        (tangent.force, (there.force - back.force) / (2 * h)),
        (tangent.centre, (there.centre - back.centre) / (2 * h)),
    ):
        assert slope == pytest.approx(differences, abs=1e-5 * np.abs(differences).max())

"""Where a path goes next: the state extrapolated along its tangent, and how far that is good."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from fe_training.mechanics import active_set as contact
from fe_training.mechanics import ogden
from fe_training.mechanics.active_set import ActiveSet
from fe_training.mechanics.body import Body
from fe_training.mechanics.kernels import polar_coordinates
from fe_training.solver.state import Control, Direction, State, control_rate, control_value

Array = NDArray[np.float64]

#: Share of det F that a quadrature point keeps in one step, and halvings tried for it.
_LEAST_SHARE, _HALVINGS = 0.2, 6

#: Extrapolated nodes stay this far from the wire's centre [R_w].
_NEAREST = 0.5


def predicted(body: Body, state: State, control: Control, target: float) -> State:
    """Return the state moved along its tangent towards the target, as a starting point.

    Nodes near the wire move in coordinates about its centre, so that those that touch it stay on
    it.  Those that will touch it count as touching at once, and the first iteration puts them there
    together with the elements below them.
    """
    t = tangent_of(body, state, control)
    if t is None:
        return state
    state = replace(state, tangent=t, control=control)
    step = target - control_value(body, state, control)
    if control is not Control.FORCE:
        step *= admissible(body, state, step * t.u, step * t.centre)
        u, active = state.u + step * t.u, state.active
    else:
        u = moved_around(body, state, step)
        share = admissible(body, state, u - state.u, step * t.centre)
        if share < 1.0:
            step *= share
            u = moved_around(body, state, step)
        active = will_touch(body, state, step)
    return replace(
        state,
        u=u,
        p=state.p + step * t.p,
        centre=state.centre + step * t.centre,
        active=active,
    )


def tangent_of(body: Body, state: State, control: Control) -> State | None:
    """Return the derivative of a state with respect to a control, if its tangent has it.

    All controls but the height move the wire along the cut: one tangent serves them all.
    """
    t = state.tangent
    if t is None or state.control is control:
        return t
    if Control.HEIGHT in (state.control, control):
        return None
    geo = contact.geometry(body, state.u, state.centre, state.active)
    along = Direction(t.u, t.p, t.force)
    rate = control_rate(body, control, along, t.centre, geo, state)
    return replace(t, u=t.u / rate, p=t.p / rate, centre=t.centre / rate, force=t.force / rate)


def will_touch(body: Body, state: State, step: float) -> ActiveSet:
    """Return the nodes that touch the wire a step of the control later."""
    changes = _changes(body, state, float(np.sign(step))) <= abs(step)
    return ActiveSet(state.active.wire ^ changes, state.active.plane)


def _changes(body: Body, state: State, sign: float) -> Array:
    """Return the step of the control, in one direction, at which each face node meets or leaves.

    Near the end of a contact the pressure is as the square root of the distance from it, and the
    gap beyond as its power of 3/2: the powers that are linear there are extrapolated.
    """
    t = state.tangent
    assert t is not None
    y = state.about(body, body.face)
    gap = 0.5 * (np.einsum("ni,ni->n", y, y) - 1.0)
    closing = -sign * np.einsum("ni,ni->n", y, t.u[body.face] - t.centre)
    wire, never = state.active.wire, np.full(len(gap), np.inf)
    free = ~state.active.any & (closing > 0.0)
    fading = wire & (sign * t.force < 0.0)
    np.divide(1.5 * gap, closing, out=never, where=free)
    np.divide(-0.5 * sign * state.force, t.force, out=never, where=fading)
    return never


def contact_step(body: Body, state: State, control: Control, sign: float, share: float) -> float:
    """Return the step of a control in which a share of the touching nodes change.

    Parameters
    ----------
    body : Body
    state : State
        An equilibrium with the tangent of the control; without it the step is infinite.
    control : Control
    sign : float
        Direction of the step.
    share : float
        Nodes that meet or leave the wire, relative to those that touch it now.
    """
    tangent = tangent_of(body, state, control)
    if tangent is None:
        return np.inf
    return share_step(body, replace(state, tangent=tangent), sign, share)


def share_step(body: Body, state: State, sign: float, share: float) -> float:
    """Return the step along a state's own tangent in which a share of the touching nodes change."""
    count = int(share * state.active.wire.sum())
    changes = _changes(body, state, sign)
    return float(np.partition(changes, count)[count])


def moved_around(body: Body, state: State, step: float) -> Array:
    """Return the displacements a step of the control later, in polar coordinates near the wire."""
    t = state.tangent
    assert t is not None
    u, centre = state.u + step * t.u, state.centre + step * t.centre
    near = np.zeros(len(body.nodes), dtype=bool)
    near[body.connectivity[body.polar]] = True
    near[body.face[state.active.wire]] = True
    y, rate = state.about(body, near), step * (t.u[near] - t.centre)
    sigma, phi = polar_coordinates(y)
    sigma = sigma + np.einsum("ni,ni->n", y, rate)
    turned = y[:, 0] * rate[:, 1] - y[:, 1] * rate[:, 0]
    phi = phi + turned / np.einsum("ni,ni->n", y, y)
    rho = np.sqrt(np.maximum(1.0 + 2.0 * sigma, _NEAREST**2))
    place = centre + rho[:, None] * np.stack([np.cos(phi), np.sin(phi)], axis=1)
    u[near] = place - body.nodes[near]
    u[body.held] = 0.0  # an exact arc leaves the plane by rounding
    return np.asarray(u)


def admissible(body: Body, state: State, step: Array, move: Array) -> float:
    """Return the length of a step that leaves every element a share of its area.

    It is needed where steps are large, as while the wire is raised.  At high toughness it does
    harm: elements at the end of the contact that fold for an iteration make it crawl.  Each
    quadrature point may lose at most most of its determinant in one step; the determinant is
    smooth in the length, so a few halvings suffice.
    """
    watched = body.beyond_notch
    u, centre = state.u, state.centre
    before = ogden.volume_change(body.displacement_gradient(u, watched, centre)) + 1.0
    # where an element is folded already, all that is asked for is that it stays near
    floor = np.where(before > 0.0, np.minimum(_LEAST_SHARE * before, _LEAST_SHARE), before - 1.0)
    t = 1.0
    for _ in range(_HALVINGS):
        there = body.displacement_gradient(u + t * step, watched, centre + t * move)
        after = ogden.volume_change(there) + 1.0
        if (after > floor).all():
            return t
        t *= 0.5
    return t

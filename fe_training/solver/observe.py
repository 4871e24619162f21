"""What an equilibrium tells: the contact arc, the pressure on the wire, the stress ahead."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import trapezoid
from skfem import ElementTriP1, ElementTriP2, FacetBasis

from fe_training.mechanics import ogden
from fe_training.mechanics.body import Body
from fe_training.solver.equilibrium import State

__all__ = [
    "ContactArc",
    "contact_arc",
    "contact_ends",
    "face_stretch",
    "principal_stretch",
    "stress_ahead",
]

Floats = NDArray[np.float64]

#: Nodes that tell an end, the degree of theta as a polynomial of the pressure's square, and how
#: far beyond the last node the end may be, in distances of the last two nodes.
_NODES, _DEGREE, _FARTHEST = 10, 2, 2.5


def contact_ends(theta: Floats, pressure: Floats) -> tuple[float, float]:
    """Return theta_1 and theta_2, where the contact pressure vanishes.

    Parameters
    ----------
    theta, pressure : ndarray, shape (nodes,)
        Angles from the cutting direction, rising [rad], and pressures there.

    Returns
    -------
    tuple of float
        The first one is not negative [rad]; nan with fewer than two nodes.

    Examples
    --------
    >>> theta = np.linspace(0.81, 2.19, 60)
    >>> ends = contact_ends(theta, np.sqrt((theta - 0.8) * (2.2 - theta)))
    >>> print("{:.2f} {:.2f}".format(*ends))
    0.80 2.20
    """
    if len(theta) < 2:
        return np.nan, np.nan
    return max(_end(theta, pressure), 0.0), _end(theta[::-1], pressure[::-1])


def _end(theta: Floats, pressure: Floats) -> float:
    """Return where the pressure vanishes, for nodes ordered from that end."""
    square = pressure[:_NODES] ** 2
    if not np.max(square) > 0.0:
        return float(theta[0])
    degree = min(_DEGREE, len(square) - 1)
    beyond = np.polyfit(square / np.max(square), theta[:_NODES] - theta[0], degree)[-1]
    farthest = _FARTHEST * abs(theta[1] - theta[0])
    return float(theta[0] + np.clip(beyond, -farthest, farthest))


Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class ContactArc:
    """The part of the wire that touches the body.

    Parameters
    ----------
    theta_1, theta_2 : float
        Its ends, from the cutting direction about the wire's centre [rad].
    theta, pressure : ndarray
        Angles of the touching nodes [rad] and the contact pressure there [mu].
    stretch : ndarray
        lambda = |F e_1| there, the stretch of the face's line element: how far the solid slips
        over the wire while the wire advances by one [-].
    force : ndarray
        Normal forces of these nodes [mu R_w].
    """

    theta_1: float
    theta_2: float
    theta: Array
    pressure: Array
    stretch: Array
    force: Array

    @property
    def length(self) -> float:
        """A = cos(theta_1) - cos(theta_2) [-]."""
        return float(np.cos(self.theta_1) - np.cos(self.theta_2))

    @property
    def slip_arc(self) -> float:
        """A* = int lambda dtheta from one end of the contact to the other [-].

        Straight between the nodes; beyond the last ones the stretch keeps their slope.
        """
        if len(self.theta) < 2:
            return np.nan
        ends = np.array([self.theta_1, self.theta_2])
        theta, stretch = self.theta, self.stretch
        slope = np.diff(stretch)[[0, -1]] / np.diff(theta)[[0, -1]]
        at_ends = stretch[[0, -1]] + slope * (ends - theta[[0, -1]])
        inside = (theta > ends[0]) & (theta < ends[1])
        angles = np.concatenate([ends[:1], theta[inside], ends[1:]])
        values = np.concatenate([at_ends[:1], stretch[inside], at_ends[1:]])
        return float(trapezoid(values, angles))

    @property
    def slip_load(self) -> float:
        """B* = int P lambda dtheta [-]: the nodes' forces, each times its stretch."""
        return float(self.force @ self.stretch)


def contact_arc(body: Body, state: State) -> ContactArc:
    """Return the contact arc and the pressure on it."""
    position = body.nodes[body.face] + state.u[body.face]
    touching = np.flatnonzero(state.active.wire)
    theta = np.arctan2(position[:, 1], position[:, 0] - state.centre[0])[touching]
    pressure = (state.force / _tributary(position))[touching]
    stretch = face_stretch(body, state)[touching]
    theta_1, theta_2 = contact_ends(theta, pressure)
    if state.active.wire[0]:  # the tip itself, where by symmetry no pressure ends
        theta_1 = 0.0
    return ContactArc(theta_1, theta_2, theta, pressure, stretch, state.force[touching])


def face_stretch(body: Body, state: State) -> Array:
    """Return lambda = |F e_1| at the nodes of the crack face [-].

    From differences of second order of the polar coordinates about the wire's centre, in which
    the face under the contact is straight.
    """
    reference = body.nodes[body.face]
    arm = reference + state.u[body.face] - state.centre
    length = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(reference, axis=0).T))])
    radius, angle = np.hypot(*arm.T), np.unwrap(np.arctan2(arm[:, 1], arm[:, 0]))
    rates = np.gradient(radius, length), radius * np.gradient(angle, length)
    return np.asarray(np.hypot(*rates))


def _tributary(position: Array) -> Array:
    """Return the deformed length that belongs to each face node of the quadratic edges."""
    half = np.hypot(*np.diff(position, axis=0).T)
    edge = half[0::2] + half[1::2]
    length = np.zeros(len(position))
    length[:-2:2] += edge / 6.0
    length[1::2] += edge * (4.0 / 6.0)
    length[2::2] += edge / 6.0
    return length


@dataclass(frozen=True, slots=True, eq=False)
class StressAhead:
    """Cauchy stress on the ligament.

    Parameters
    ----------
    reference, deformed : ndarray
        Distance from the tip before and after deformation [R_w].
    opening : ndarray
        sigma_22, the stress that opens the crack [mu].
    """

    reference: Array
    deformed: Array
    opening: Array


def stress_ahead(body: Body, state: State, reach: float = 100.0) -> StressAhead:
    """Return the opening stress on the ligament up to `reach` wire radii before deformation."""
    facets = body.mesh.boundary_facets()
    middle = body.mesh.p[:, body.mesh.facets[:, facets]].mean(axis=1)
    ligament = facets[(middle[1] == 0) & (middle[0] > 0) & (middle[0] < reach)]
    basis = FacetBasis(body.mesh, ElementTriP2(), facets=ligament, intorder=2)
    pressure = np.asarray(basis.with_element(ElementTriP1()).interpolate(state.p))
    components = [basis.interpolate(np.ascontiguousarray(state.u[:, i])) for i in (0, 1)]
    H = np.array([component.grad for component in components])
    P = ogden.stress(H, pressure, body.alpha)
    F22 = 1.0 + H[1, 1]
    sigma = (P[1, 0] * H[1, 0] + P[1, 1] * F22) / (1.0 + ogden.volume_change(H))
    X = np.asarray(basis.global_coordinates())[0].ravel()
    x = X + np.asarray(components[0]).ravel()
    tip = body.face[0]
    order = np.argsort(X)
    start = body.nodes[tip, 0]
    return StressAhead(
        (X - start)[order], (x - start - state.u[tip, 0])[order], sigma.ravel()[order]
    )


def principal_stretch(body: Body, state: State) -> Array:
    """Return the larger principal stretch at the quadrature points, shape (elements, points)."""
    H = body.displacement_gradient(state.u, centre=state.centre)
    s = np.hypot(2.0 + H[0, 0] + H[1, 1], H[1, 0] - H[0, 1])
    d = np.hypot(H[0, 0] - H[1, 1], H[1, 0] + H[0, 1])
    return np.asarray(0.5 * (s + d))

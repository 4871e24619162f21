"""The record of one configuration: its results and the evidence that they can be believed."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class ToldOutcome(Enum):
    """An end of a computation; each member's value is its meaning and its remedy."""

    @property
    def meaning(self) -> str:
        """What happened."""
        return str(self.value[0])

    @property
    def remedy(self) -> str:
        """What to do about it; empty where nothing is wrong."""
        return str(self.value[1])


class Outcome(ToldOutcome):
    """How a configuration ended, with what to do about it."""

    CONVERGED = (
        "equilibrium found, evidence within bounds",
        "",
    )
    OUTSIDE_EVIDENCE = (
        "equilibrium found, but |J - 2 F_h|/J or the spread of J is above its bound",
        "refine the mesh: more sectors, a smaller contact_spacing or a smaller notch_radius",
    )
    STALLED = (
        "the path to the configuration stalled at its smallest step",
        "refine the mesh, or approach the configuration from another one",
    )
    FOLDED = (
        "the only equilibria found have folded elements",
        "refine the mesh behind the contact, or take smaller steps",
    )
    TOO_LARGE = (
        "the path needs a larger mesh than the engine allows itself",
        "ask for a smaller g or a larger scatter; solver.cut.MOST_UNKNOWNS is the limit",
    )
    NOT_REACHED = (
        "the root search did not meet the wanted value",
        "ask for a path of several values around it",
    )


#: Bounds on |J - 2 F_h|/J: above and below this g (small forces along the cut are differences of
#: large ones in the far field).
EVIDENCE_G, EVIDENCE_BOUND, FAR_FIELD_BOUND = 0.05, 1e-3, 3e-3


@dataclass(frozen=True, slots=True, eq=False)
class Record:
    """One configuration of the wire in the crack; lengths in R_w, stresses in mu.

    Parameters
    ----------
    alpha : float
        Strain-stiffening exponent [-].
    outcome : Outcome
        How the computation ended.
    target : float
        The J/(mu R_w) that was wanted, nan where the configuration was chosen otherwise.
    reason : str
        The last message of a failed computation, empty otherwise.
    energy_release_rate : float
        J/(mu R_w) of the whole body, from the domain integral nearest to the tip: the
        dimensionless toughness g of a material that is cut in this configuration.
    distance : float
        delta, deformed distance from the wire's centre to the tip [R_w].
    insertion : float
        x_w, position of the wire's centre; the tip's reference position is 0 [R_w].
    horizontal_force, vertical_force : float
        F_h and F_v of the half model [mu R_w per unit thickness]; B = F_v.
    theta_1, theta_2 : float
        Ends of the contact arc [rad].
    slip_arc, slip_load : float
        A* = int lambda dtheta and B* = int P lambda dtheta of the half model [-]: with wear
        tau_w and friction xi the force grows by 2 [(tau_w/mu) A* + xi B*] to first order; where
        the tip touches the wire, for the notch radius of the mesh.
    strain_energy : float
        U of the half body [mu R_w^2 per unit thickness].
    tip_position : float
        Deformed position of the tip [R_w].
    energy_release_rate_across : tuple of float
        J/(mu R_w) on wider supports, which hold contact.
    energy_release_rate_shift : float
        -2 dU/dc by a true shift of the tip, where asked for, else nan.
    residual : float
        Residual relative to the contact force [-].
    iterations : int
        Newton iterations of the last step.
    min_determinant : float
        Smallest det F beyond the notch [-].
    max_stretch : float
        Largest principal stretch [-].
    touches_plane : bool
        Whether the crack face touches the symmetry plane.
    unknowns : int
        Free unknowns.
    mesh : dict
        The fields of the mesh specification.
    bulk : float
        Bulk term [mu].
    solver : str
        Linear solver.
    mesh_error, truncation_error : float
        Estimated relative errors of F_v at this g, nan where not estimated.
    wall_time : float
        Seconds since the start of the path or the last record of it.
    pressure_angle, pressure : ndarray
        Profile of the contact pressure over the arc [rad], [mu].
    stretch : ndarray
        Stretch lambda = |F e_1| of the crack face at the same angles [-].
    ahead_reference, ahead_deformed, ahead_stress : ndarray
        Distance from the tip before and after deformation [R_w] and sigma_22 [mu].
    """

    alpha: float
    outcome: Outcome
    target: float = np.nan
    reason: str = ""
    energy_release_rate: float = np.nan
    distance: float = np.nan
    insertion: float = np.nan
    horizontal_force: float = np.nan
    vertical_force: float = np.nan
    theta_1: float = np.nan
    theta_2: float = np.nan
    slip_arc: float = np.nan
    slip_load: float = np.nan
    strain_energy: float = np.nan
    tip_position: float = np.nan
    energy_release_rate_across: tuple[float, ...] = ()
    energy_release_rate_shift: float = np.nan
    residual: float = np.nan
    iterations: int = 0
    min_determinant: float = np.nan
    max_stretch: float = np.nan
    touches_plane: bool = False
    unknowns: int = 0
    mesh: dict[str, Any] = field(default_factory=dict)
    bulk: float = 0.0
    solver: str = ""
    mesh_error: float = np.nan
    truncation_error: float = np.nan
    wall_time: float = np.nan
    pressure_angle: Array = field(default_factory=lambda: np.empty(0))
    pressure: Array = field(default_factory=lambda: np.empty(0))
    stretch: Array = field(default_factory=lambda: np.empty(0))
    ahead_reference: Array = field(default_factory=lambda: np.empty(0))
    ahead_deformed: Array = field(default_factory=lambda: np.empty(0))
    ahead_stress: Array = field(default_factory=lambda: np.empty(0))

    @property
    def is_reached(self) -> bool:
        """Whether there is an equilibrium, within its evidence or not."""
        return bool(np.isfinite(self.energy_release_rate))

    @property
    def arc(self) -> float:
        """A = cos(theta_1) - cos(theta_2) [-]."""
        return float(np.cos(self.theta_1) - np.cos(self.theta_2))

    @property
    def normal_load(self) -> float:
        """B = F_v/(mu R_w T) [-]."""
        return self.vertical_force

    @property
    def force_mismatch(self) -> float:
        """|J - 2 F_h|/J [-]."""
        J = self.energy_release_rate
        return abs(J - 2.0 * self.horizontal_force) / J

    @property
    def support_spread(self) -> float:
        """Largest relative difference of J between the supports [-]."""
        J = self.energy_release_rate
        return max((abs(other / J - 1.0) for other in self.energy_release_rate_across), default=0.0)

    @property
    def within_evidence(self) -> bool:
        """Whether |J - 2 F_h|/J is within its bound."""
        bound = EVIDENCE_BOUND if self.energy_release_rate >= EVIDENCE_G else FAR_FIELD_BOUND
        return bool(self.force_mismatch <= bound)

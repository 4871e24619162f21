"""The record of one configuration that slides: its results, and the evidence for them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fe_training.solver.record import ToldOutcome


class SlidingOutcome(ToldOutcome):
    """How a configuration ended, with what to do about it."""

    CONVERGED = ("equilibrium found, the balance within its bound", "")
    OUTSIDE_EVIDENCE = (
        "equilibrium found, but |F_ss - J - 2 int tau lambda ds| is above its bound",
        "refine the mesh: more sectors or a smaller contact_spacing",
    )
    CREASED = (
        "the face beside the contact is compressed so far that its surface creases: steady "
        "sliding on a smooth face ends on the way to this load",
        "ask for less friction or wear",
    )
    LIMIT = (
        "the load has its limit on the way: the position of the wire no longer decides J, and no "
        "steady cut is found beyond",
        "ask for less friction or wear",
    )
    STALLED = (
        "the path to the configuration stalled at its smallest step",
        "refine the mesh, or ask for less friction or wear",
    )
    FOLDED = (
        "the only equilibria found have folded elements",
        "refine the mesh, or ask for less friction or wear",
    )
    TOO_LARGE = (
        "the path needs a larger mesh than the engine allows itself",
        "ask for less friction or wear",
    )
    NOT_REACHED = (
        "the frictionless configuration that the path begins from was not reached",
        "ask for another g or alpha",
    )


#: Bound on |F_ss - J - 2 int tau lambda ds|, relative to F_ss.
BALANCE_BOUND = 1e-3

#: Plane-strain stretch along the surface at which a compressed neo-Hookean half space creases
#: (Hong, Zhao & Suo 2009). For other exponents it marks where to look.
CREASE_STRETCH = 0.65


@dataclass(frozen=True, slots=True, eq=False)
class SlidingRecord:
    """One configuration of a wire that rubs; lengths in R_w, stresses in mu.

    Parameters
    ----------
    alpha : float
        Strain-stiffening exponent [-].
    target, target_friction, target_wear : float
        What was asked for: g, xi and tau_w/mu [-].
    outcome : SlidingOutcome
        How the computation ended.
    reason : str
        The last message of a failed computation, empty otherwise.
    friction, wear, ramp : float
        The load that was reached: xi [-], tau_w/mu [-] and the pressure over which wear rises at
        the ends of the contact [mu].
    energy_release_rate : float
        J/(mu R_w) of the whole body: the toughness g [-].
    steady_force : float
        F_ss of both halves [mu R_w per unit thickness].
    slip_power : float
        2 int tau lambda ds [mu R_w].
    first_arc, first_load : float
        A* and B* of the frictionless configuration at the same g on the same mesh [-].
    theta_1, theta_2 : float
        Ends of the contact arc [rad].
    horizontal_force, vertical_force : float
        Components of the normal forces of the half model [mu R_w].
    slip_arc, slip_load : float
        int lambda dtheta and int P lambda dtheta of this configuration [-].
    distance, insertion : float
        Deformed distance to the tip, and position of the wire [R_w].
    energy_release_rate_across : tuple of float
        J/(mu R_w) on wider supports, which hold contact.
    least_stretch, least_stretch_angle : float
        Smallest stretch of the crack face beyond the notch [-], and where it is about the wire's
        centre, from the cutting direction [rad].
    position_rate : float
        dJ/dx_w at a constant load [mu]: it vanishes where the load has a limit point.
    touches_tip, touches_plane : bool
        Whether the wire touches the tip, and the crack face the symmetry plane.
    grazing : int
        Nodes that touch without pressure, with a part of tau_w.
    pull : float
        Largest pull on a node that is held to the wire, relative to the contact force [-].
    residual : float
        Residual relative to the contact force [-].
    iterations : int
        Newton iterations of the last step.
    steps : int
        Steps of the load since the frictionless configuration.
    min_determinant, max_stretch : float
        Smallest det F beyond the notch, largest principal stretch [-].
    notch_radius : float
        Radius of the notch [R_w].
    unknowns : int
        Free unknowns.
    mesh_error : float
        Relative difference of kappa from a finer mesh; nan where not estimated.
    processor_time : float
        Processor seconds since the last record of the path.
    """

    alpha: float
    target: float
    target_friction: float
    target_wear: float
    outcome: SlidingOutcome
    reason: str = ""
    friction: float = np.nan
    wear: float = np.nan
    ramp: float = 0.0
    energy_release_rate: float = np.nan
    steady_force: float = np.nan
    slip_power: float = np.nan
    first_arc: float = np.nan
    first_load: float = np.nan
    theta_1: float = np.nan
    theta_2: float = np.nan
    horizontal_force: float = np.nan
    vertical_force: float = np.nan
    slip_arc: float = np.nan
    slip_load: float = np.nan
    distance: float = np.nan
    insertion: float = np.nan
    energy_release_rate_across: tuple[float, ...] = ()
    least_stretch: float = np.nan
    least_stretch_angle: float = np.nan
    position_rate: float = np.nan
    touches_tip: bool = False
    touches_plane: bool = False
    grazing: int = 0
    pull: float = np.nan
    residual: float = np.nan
    iterations: int = 0
    steps: int = 0
    min_determinant: float = np.nan
    max_stretch: float = np.nan
    notch_radius: float = np.nan
    unknowns: int = 0
    mesh_error: float = np.nan
    processor_time: float = np.nan

    @property
    def is_reached(self) -> bool:
        """Whether there is an equilibrium at the load that was asked for."""
        return self.outcome in (SlidingOutcome.CONVERGED, SlidingOutcome.OUTSIDE_EVIDENCE)

    @property
    def amplification(self) -> float:
        """kappa: the force of friction and wear over its first order; 1 without any load [-].

        By the integrals between the zeros of the pressure. Sums over touching nodes, of which
        F_ss - J consists to the last digits, end between nodes: on a contact of 90 nodes they were
        off by up to 3 % where the integrals were off by 0.2 %.
        """
        first = self.wear * self.first_arc + self.friction * self.first_load
        return (
            (self.wear * self.slip_arc + self.friction * self.slip_load) / first if first else 1.0
        )

    @property
    def balance_error(self) -> float:
        """|F_ss - J - 2 int tau lambda ds| / F_ss [-]."""
        whole = self.energy_release_rate + self.slip_power
        return abs(self.steady_force - whole) / self.steady_force

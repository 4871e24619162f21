"""Unit and description of every column of the campaign's data set."""

from __future__ import annotations

__all__ = ["INNER", "POINT_COLUMNS", "PROFILES", "ROW_COLUMNS"]

#: Rows: one for each configuration of the design that was solved or failed. The fields of
#: `fe_training.solver.record.Record` first, then what the campaign adds.
ROW_COLUMNS: dict[str, tuple[str, str]] = {
    "alpha": ("-", "strain-stiffening exponent"),
    "outcome": ("-", "how the computation ended, a name of fe_training.solver.record.Outcome"),
    "reason": ("-", "last message of a failed computation, else empty"),
    "target": ("-", "wanted g = J/(mu R_w)"),
    "energy_release_rate": ("mu R_w", "J of the whole body; divided by mu R_w it is g"),
    "distance": ("R_w", "delta, deformed distance from the wire's centre to the tip"),
    "insertion": ("R_w", "x_w, wire's centre relative to the tip's reference position"),
    "horizontal_force": ("mu R_w", "F_h of the half model per thickness"),
    "vertical_force": ("mu R_w", "F_v of the half model per thickness; B = F_v/(mu R_w T)"),
    "theta_1": ("rad", "front end of the contact arc, from the cutting direction"),
    "theta_2": ("rad", "rear end of the contact arc, from the cutting direction"),
    "slip_arc": ("-", "A* = int lambda dtheta over the contact arc, at the mesh's notch radius"),
    "slip_load": ("-", "B* = int P lambda dtheta over the contact arc, at the mesh's notch radius"),
    "strain_energy": ("mu R_w^2", "U of the half body per thickness"),
    "tip_position": ("R_w", "deformed position of the tip along the cut"),
    "energy_release_rate_across": ("mu R_w", "J on wider supports, nearest first; nan pads"),
    "energy_release_rate_shift": ("mu R_w", "-2 dU/dc by a shift of the tip; nan if not asked for"),
    "residual": ("-", "residual relative to the contact force"),
    "iterations": ("-", "Newton iterations of the last step"),
    "min_determinant": ("-", "smallest det F beyond the notch"),
    "max_stretch": ("-", "largest principal stretch"),
    "touches_plane": ("-", "whether the crack face touches the symmetry plane"),
    "unknowns": ("-", "free unknowns"),
    "mesh": ("R_w", "specification of the mesh, JSON"),
    "bulk": ("mu", "bulk term"),
    "solver": ("-", "linear solver"),
    "mesh_error": ("-", "relative error of F_v that the engine estimates; nan if it does not"),
    "truncation_error": ("-", "estimated relative error of F_v from the finite body"),
    "wall_time": ("s", "time since the start of the path or its last record"),
    "pressure_angle": ("rad", "angles of the contact pressure's profile; nan pads"),
    "pressure": ("mu", "contact pressure P(theta) at these angles; nan pads"),
    "stretch": ("-", "stretch lambda of the crack face at these angles; nan pads"),
    "ahead_reference": ("R_w", "distances ahead of the tip before deformation; nan pads"),
    "ahead_deformed": ("R_w", "the same distances after deformation; nan pads"),
    "ahead_stress": ("mu", "opening stress sigma_22 at these distances; nan pads"),
    "level": ("-", "mesh level of the design"),
    "attempt": ("-", "strategy that made the row: 0 is the level's settings, then finer ones"),
    "tried": ("-", "number of strategies tried"),
    "software": ("-", "index into the list of software in the file's attributes"),
}

#: The columns of the rows that hold several numbers an entry, with what counts these.
INNER: dict[str, str] = {
    "energy_release_rate_across": "support",
    "pressure_angle": "arc",
    "pressure": "arc",
    "stretch": "arc",
    "ahead_reference": "ahead",
    "ahead_deformed": "ahead",
    "ahead_stress": "ahead",
}

#: Those of them that are profiles.
PROFILES = tuple(name for name, inner in INNER.items() if inner != "support")

#: Points: one for each (alpha, g) of the design with a row, from both mesh levels; nan where the
#: configuration was not reached.
POINT_COLUMNS: dict[str, tuple[str, str]] = {
    "alpha": ("-", "strain-stiffening exponent"),
    "g": ("-", "J/(mu R_w), dimensionless toughness"),
    "arc": ("-", "A = cos theta_1 - cos theta_2 at this g"),
    "normal_load": ("-", "B = F_v/(mu R_w T) at this g"),
    "distance": ("R_w", "delta at this g"),
    "slip_arc": ("-", "A* = int lambda dtheta at this g"),
    "slip_load": ("-", "B* = int P lambda dtheta at this g"),
    "arc_error": ("-", "absolute difference of A between the mesh levels at this g"),
    "normal_load_error": ("-", "relative difference of B between the mesh levels at this g"),
    "distance_error": ("-", "relative difference of delta between the mesh levels at this g"),
    "slip_arc_error": ("-", "relative difference of A* between the mesh levels at this g"),
    "slip_load_error": ("-", "relative difference of B* between the mesh levels at this g"),
    "slip_arc_notch_slope": ("-", "dA*/d ln(1/r), r the notch radius; nan where not solved"),
    "slip_load_notch_slope": ("-", "dB*/d ln(1/r), r the notch radius; nan where not solved"),
    "truncation_error": ("-", "estimated relative error of B from the finite body"),
    "force_mismatch": ("-", "|J - 2 F_h|/J of the row"),
    "support_spread": ("-", "largest relative difference of J between supports, of the row"),
    "row": ("-", "index of the row that gave the values"),
    "use": ("-", "whether all evidence is within its bounds"),
    "reason": ("-", "why the point is not to be used, else empty"),
}

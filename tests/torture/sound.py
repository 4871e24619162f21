"""Sound values of every parameter of the public functions, by name."""

import tempfile
from pathlib import Path

from surrogate.basics.files import model_file
from surrogate.scene import NAMES, Scene

__all__ = ["ALIASES", "ARRAYS", "BASE", "CHOICES", "FORCES", "OWN", "RADII", "SCENE", "STD"]

SCENE = dict(zip(NAMES, (685.0, 1.6, 0.25e-3, 0.1, 7750.0, 3.0), strict=True))
RADII, FORCES, STD = [1e-4, 2e-4, 4e-4, 5e-4], [4.7, 7.9, 13.9, 17.2], [0.2, 0.3, 0.2, 0.4]

TRAVEL = [0.1e-3 * i for i in range(300)]
PULL = [0.0] * 10 + [0.12] + [0.08 + 1e-4 * (i % 3) for i in range(289)]
"""A made-up cut: nothing before contact, a peak, and a steady force [m], [N]."""

RECORD = Path(tempfile.mkdtemp(prefix="wirecut-torture-"), "wire_0.2mm_1.csv")
RECORD.write_text(
    "Extension (mm),Load (N)\n"
    + "".join(f"{1e3 * x:.4f},{y:.5f}\n" for x, y in zip(TRAVEL, PULL, strict=True))
)

BASE = {
    **SCENE,
    "g": 9.0,
    "alpha": 3.0,
    "relative_wear_strength": 11.0,
    "relative_distance": 2.0,
    "exponent": 1.1,
    "delta": 2.0,
    "elasto_cohesive_length": 2e-3,
    "wear_length": 2e-4,
    "work_of_fracture": 7e3,
    "smallest_radius": 1e-4,
    "largest_radius": 5e-4,
    "cuts": 5,
    "line_test_cuts": 1,
    "goal": "both",
    "force": FORCES,
    "force_std": STD,
    "confidence": 0.95,
    "threshold": 2.0 / 3.0,
    "rtol": 0.05,
    "extrapolate": False,
    "law": "projected",
    "outside": "raise",
    "notch_radius": None,
    "std": {"toughness": 0.2, "wear_strength": 500.0},
    "correlation": {("toughness", "wear_strength"): -0.5},
    "x": "wire_radius",
    "y": "toughness",
    "ranges": ((1e-5, 1e-3), (0.1, 10.0)),
    "fixed": {"shear_modulus": 685.0, "wear_strength": 7750.0, "friction_coefficient": 0.1},
    "scales": ("log", "log"),
    "nodes": 5,
    "limits": ("high-toughness",),
    "miss": 0.1,
    "force_label": "measured",
    "width": "single",
    "contact": True,
}
"""Sound values by the names of parameters."""

OWN = {
    "identify": {
        **{"wire_radius": RADII, "wire_diameter": None, "toughness_max": None},
        **{"wear_strength": None, "toughness_prior": None, "wear_strength_prior": None},
        **{"further_radii": None, "relative_error": None, "sample": None},
        **{"shear_modulus_std": 30.0, "friction_std": 0.02, "stiffening_std": 0.1},
    },
    "design_radii": {"force_std": 0.5, "relative_force_std": None, "expected": None},
    "design_wires": {
        **{"expected": Scene(**SCENE), "cuts": 8, "force_std": None, "relative_force_std": 0.05},
        **{"rtol": None, "diameters": None, "thickness": None, "goal": "both"},
    },
    "read_measurements": {
        "path": str(model_file("paam-wire-cutting.csv")),
        **dict.fromkeys(("thickness", "decimal", "delimiter", "encoding", "by")),
    },
    "read_record": {
        "path": str(RECORD),
        **dict.fromkeys(
            ("specimen", "columns", "sign", "speed", "decimal", "delimiter", "encoding")
        ),
    },
    "read_records": {
        "path": str(RECORD),
        **dict.fromkeys(("columns", "sign", "speed", "decimal", "delimiter", "encoding")),
    },
    "steady_force": {
        **{"displacement": TRAVEL, "force": PULL, "start": None, "end": None},
        **{"tare": 0.0, "tolerance": 0.05},
    },
    "read_material": {"path": str(model_file("paam-material.json"))},
    "load_models": {"path": None},
    "contact_functions": {"rtol": None},
    "plot_force": {"ax": None, "thickness": None},
    "write_explorer": {
        **{"file": str(RECORD.with_name("explorer.html")), "cuts": None, "diameters": False},
    },
    "plot_gels": {"ax": None},
    "prepare": {
        **{"fixed": Scene(**SCENE), "varying": ("wire_radius",), "rtol": None},
        "ranges": {"wire_radius": (1e-4, 1e-3)},
    },
    "plot_identification": {"ax": None, "pure_shear_toughness": None},
    "plot_regime_map": {"ax": None, "points": (), "error_of": None, "limits": ()},
}
"""Sound values of single functions, where the name alone does not tell."""

CHOICES = {
    "identify": {
        "wire_diameter": {"wire_radius": None, "wire_diameter": [2e-4, 4e-4, 8e-4, 1e-3]},
        "toughness_max": {"toughness_max": 5.0},
        "wear_strength": {"wear_strength": 7e3},
        "toughness_prior": {"toughness_prior": (1.5, 0.5)},
        "wear_strength_prior": {"wear_strength_prior": (7e3, 1e3)},
        "relative_error": {"force_std": None, "relative_error": 0.05},
        "sample": {"sample": ["a", "a", "b", "b"]},
        "further_radii": {"toughness_max": 5.0, "further_radii": (1e-5, 1e-3)},
    },
    "design_radii": {
        "relative_force_std": {
            "force_std": None,
            "relative_force_std": 0.05,
            "expected": Scene(**SCENE),
        },
        "expected": {"expected": Scene(**SCENE)},
    },
}
"""What else has to change for an optional argument to be in use."""

ARRAYS = {
    *NAMES,
    *("g", "alpha", "relative_wear_strength", "relative_distance", "exponent", "delta"),
    *("elasto_cohesive_length", "wear_length", "work_of_fracture"),
}
"""Parameters that are numbers or arrays, one result for each entry."""

ALIASES = {
    "identify": ("radii", "forces", "wire", "standard errors", "measurements", "prior"),
    "design_radii": ("radius", "scatter", "range", "cuts", "weight"),
    "design_wires": ("wire_diameter", "expected", "toughness", "exactly one", "carry", "wires"),
    "regime_map": ("coordinate", "range", "axis", "scale", "fixed", "map", "node", "limit"),
    "propagate": ("uncertain quantities", "correlations", "standard error", "dimensionless"),
    "read_measurements": ("file",),
    "load_models": ("the fitted models must be read",),
    "write_explorer": ("scene", "wire", "material", "cannot be written"),
    "read_record": ("file", "record", "specimen", "column"),
    "read_records": ("file", "record", "column"),
    "steady_force": ("record", "displacement", "force", "range", "plateau"),
    "read_material": ("file",),
    "plot_force": ("force", "dimensionless"),
    "compare_gels": ("gels",),
    "plot_gels": ("gels",),
    "prepare": ("fixed", "range", "model must be one that a force can be prepared by"),
    "plot_regime_map": ("map", "points", "limit", "width"),
    "plot_identification": ("identification",),
}

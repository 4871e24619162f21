"""Cutting forces, regimes and material identification for wire cutting of soft solids.

>>> import surrogate
>>> scene = surrogate.Scene(
...     shear_modulus=685.0, toughness=1.6, wire_radius=0.25e-3, wear_strength=7750.0
... )
>>> print(f"{surrogate.cutting_force(scene).total:.0f} N/m")
7 N/m
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from surrogate.errors import (
    AccuracyError,
    DomainError,
    ImplausibleInputWarning,
    InputError,
    OtherLawWarning,
    UnknownErrorWarning,
    UnknownModelError,
    WirecutError,
)
from surrogate.version import __version__ as __version__

if TYPE_CHECKING:
    from surrogate.choosing.catalogue import ModelInfo, load_models, models
    from surrogate.comparing.figure import plot_gels
    from surrogate.comparing.gels import Comparison, compare_gels
    from surrogate.contact.closed_forms import FORCE_MODELS
    from surrogate.cutting.contact_functions import (
        ContactFunctions,
        contact_functions,
        energy_release_rate,
    )
    from surrogate.cutting.dissipation import dissipative_force
    from surrogate.cutting.figure import plot_force
    from surrogate.cutting.force import CuttingForce, cutting_force
    from surrogate.cutting.gradient import ForceGradient, force_gradient
    from surrogate.cutting.regimes import Regime, classify
    from surrogate.cutting.transition_radius import (
        fracto_cohesive_transition_radius,
        transition_radius,
        wear_transition_radius,
    )
    from surrogate.cutting.uncertainty import UncertainForce, propagate
    from surrogate.equations import (
        far_field_energy_release_rate,
        friction_free_relative_force,
        general_force,
        high_toughness_force,
        low_toughness_dissipation,
        low_toughness_force,
        power_law_dissipation,
        power_law_exponent,
        relative_force,
    )
    from surrogate.explorer.page import write_explorer
    from surrogate.identification.experiment_design import Design, design_radii
    from surrogate.identification.figure import plot_identification
    from surrogate.identification.fit import Identification, identify
    from surrogate.identification.wire_design import WireDesign, design_wires
    from surrogate.maps.figure import plot_regime_map
    from surrogate.maps.make import RegimeMap, regime_map
    from surrogate.maps.points import MapPoints
    from surrogate.prepared.function import ForceFunction
    from surrogate.prepared.preparing import prepare
    from surrogate.reading.material import Material, read_material
    from surrogate.reading.measurements import Measurements, read_measurements
    from surrogate.reading.plateau import SteadyForce, steady_force
    from surrogate.reading.records import CutRecord, read_record, read_records
    from surrogate.scene import Scene

__all__ = [
    "FORCE_MODELS",
    "AccuracyError",
    "Comparison",
    "ContactFunctions",
    "CutRecord",
    "CuttingForce",
    "Design",
    "DomainError",
    "ForceFunction",
    "ForceGradient",
    "Identification",
    "ImplausibleInputWarning",
    "InputError",
    "MapPoints",
    "Material",
    "Measurements",
    "ModelInfo",
    "OtherLawWarning",
    "Regime",
    "RegimeMap",
    "Scene",
    "SteadyForce",
    "UncertainForce",
    "UnknownErrorWarning",
    "UnknownModelError",
    "WireDesign",
    "WirecutError",
    "classify",
    "compare_gels",
    "contact_functions",
    "cutting_force",
    "design_radii",
    "design_wires",
    "dissipative_force",
    "energy_release_rate",
    "far_field_energy_release_rate",
    "force_gradient",
    "fracto_cohesive_transition_radius",
    "friction_free_relative_force",
    "general_force",
    "high_toughness_force",
    "identify",
    "load_models",
    "low_toughness_dissipation",
    "low_toughness_force",
    "models",
    "plot_force",
    "plot_gels",
    "plot_identification",
    "plot_regime_map",
    "power_law_dissipation",
    "power_law_exponent",
    "prepare",
    "propagate",
    "read_material",
    "read_measurements",
    "read_record",
    "read_records",
    "regime_map",
    "relative_force",
    "steady_force",
    "transition_radius",
    "wear_transition_radius",
    "write_explorer",
]

# Loaded at first use, so that nobody waits for what is not needed.
_MODULES = {
    "choosing.catalogue": "ModelInfo load_models models",
    "comparing.figure": "plot_gels",
    "comparing.gels": "Comparison compare_gels",
    "contact.closed_forms": "FORCE_MODELS",
    "cutting.contact_functions": "ContactFunctions contact_functions energy_release_rate",
    "cutting.figure": "plot_force",
    "cutting.dissipation": "dissipative_force",
    "cutting.force": "CuttingForce cutting_force",
    "cutting.gradient": "ForceGradient force_gradient",
    "cutting.regimes": "Regime classify",
    "cutting.transition_radius": "fracto_cohesive_transition_radius transition_radius "
    "wear_transition_radius",
    "cutting.uncertainty": "UncertainForce propagate",
    "equations": "far_field_energy_release_rate friction_free_relative_force "
    "general_force high_toughness_force low_toughness_dissipation "
    "low_toughness_force power_law_dissipation power_law_exponent "
    "relative_force",
    "explorer.page": "write_explorer",
    "identification.experiment_design": "Design design_radii",
    "identification.figure": "plot_identification",
    "identification.fit": "Identification identify",
    "identification.wire_design": "WireDesign design_wires",
    "maps.figure": "plot_regime_map",
    "maps.make": "RegimeMap regime_map",
    "maps.points": "MapPoints",
    "prepared.function": "ForceFunction",
    "prepared.preparing": "prepare",
    "reading.material": "Material read_material",
    "reading.measurements": "Measurements read_measurements",
    "reading.plateau": "SteadyForce steady_force",
    "reading.records": "CutRecord read_record read_records",
    "scene": "Scene",
}
_HOME = {name: module for module, names in _MODULES.items() for name in names.split()}


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(f"{__name__}.{_HOME[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})

"""What is found and not mended yet: each with a figure or a reason, and none of them silent.

An entry is a regular expression on `case: outcome: what`; entries that nothing matches any more are
named by a full run, so that they are dropped.
"""

import re

__all__ = ["KNOWN", "reason_of"]

KNOWN = {
    r"contact_functions: wrong value: .*\(g ?=.*-inf where inf": "delta at g = -0 is -inf",
    r"contact_functions: (warning|differs): .*eq9": "B of eq9 overflows with a warning, alone",
    r"eq9: warning: alpha = .*overflow": "B of eq9 overflows with a warning, alone",
    r"table: other error: slopes at .*ArrayType": "its slopes at many g and one alpha",
    r"energy_release_rate: other error: .*\(extrapolate": "extrapolate may be no bool",
    r"force_gradient: wrong value: .*eq9": (
        "derivatives of eq9 leave the range of numbers before their product with xi does"
    ),
    r"transition_radius: wrong value: .*(low-toughness|friction-free)": (
        "4 tau_w or 4 xi mu overflows: the radius, below 1e-307 Gamma_o, comes out as 0"
    ),
    r"transition_radius: warning: .*eq9": "xi mu overflows with numpy's warning",
    r"(alone|in .*): differs: propagate: .*": "the last bit of std depends on the company",
    r"columns first: differs: force_gradient: gp": "its slopes take arrays of one axis only",
    r"propagate: other error: .*\(correlation": "correlation may be no mapping",
    r"MapPoints: other error: .*\(std": "std may be no mapping",
    r"MapPoints: nan: .*\(label": "label may be no text",
    r"regime_map: argument not named: .*\(limits": "an unknown model among the limits is 'model'",
    r"regime_map: other error: .*\(scales = structured": "structured arrays as scales",
    r"regime_map: (other error|warning): .*\(limits": "limits may be no sequence",
    r"plot_regime_map: argument not named: .*\((limits|error_of)": "an unknown model is 'model'",
    r"plot_regime_map: other error: .*\((points|limits|contact)": "no check of these arguments",
    r"plot_\w+: other error: .*\(ax": "ax may be no axes",
    r"plot_identification: other error: .*\(force_label = unwilling": "a label without text",
}


def reason_of(failure):
    """Return the entry that a failure matches, or None."""
    return next((p for p in KNOWN if re.match(p, failure, re.DOTALL)), None)

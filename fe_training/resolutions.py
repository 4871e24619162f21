"""Names for how finely a configuration is solved."""

from __future__ import annotations

from .cut import Settings

#: From quick looks to convergence checks.  A coarse mesh has a blunt notch in a small body: its
#: |J - 2 F_h|/J may be above the bounds of the evidence.
RESOLUTIONS: dict[str, Settings] = {
    "coarse": Settings(sectors=16, contact_spacing=0.15, notch_radius=5e-3, outer_radius=1e5),
    "standard": Settings(),
    "fine": Settings().refined(),
}

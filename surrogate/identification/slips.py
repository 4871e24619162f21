"""Which slip of a unit would explain forces that the model does not meet."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from surrogate.errors import WirecutError
from surrogate.identification.estimate import Estimate
from surrogate.inference.inputs import Cuts
from surrogate.inference.profile import smallest_misfit

__all__ = ["slip_in_words"]


Change = Callable[[Cuts], Cuts]


def _scaled(
    radius: float = 1.0, force: float = 1.0, modulus: float = 1.0
) -> Callable[[Cuts], Cuts]:
    def change(cuts: Cuts) -> Cuts:
        return replace(
            cuts,
            wire_radius=cuts.wire_radius * radius,
            force=cuts.force * force,
            force_std=None if cuts.force_std is None else cuts.force_std * force,
            shear_modulus=cuts.shear_modulus * modulus,
            shear_modulus_std=cuts.shear_modulus_std * modulus,
        )

    return change


SLIPS: tuple[tuple[str, Change], ...] = (
    ("the radii are diameters", _scaled(radius=0.5)),
    ("the diameters are radii", _scaled(radius=2.0)),
    ("the shear modulus is 1000 times too large (Pa given as kPa)", _scaled(modulus=1e-3)),
    ("the shear modulus is 1000 times too small (kPa given as Pa)", _scaled(modulus=1e3)),
    ("the shear modulus is Young's modulus E = 3 mu", _scaled(modulus=1.0 / 3.0)),
    ("the forces are in N/mm, not N/m", _scaled(force=1e3)),
    ("the forces are in mN/m, not N/m", _scaled(force=1e-3)),
    ("the forces are in N and the sample is 1 cm thick", _scaled(force=1e2)),
)
"""The likeliest first; what is right once they are undone."""

BETTER = 10.0
"""Times smaller that the misfit is, before a slip counts as what explains it."""


def slip_in_words(fit: Estimate, acceptable: float) -> str | None:
    """Return the likeliest slip that brings the misfit down to what is acceptable, or None.

    Only what was computed is said: each slip is undone, and the forces are identified again.

    Parameters
    ----------
    fit : Estimate
        An identification whose misfit is too large.
    acceptable : float
        Largest misfit that the forces' own scatter explains, in units of `fit.profile`'s.
    """
    if fit.profile is None:
        return None
    best = fit.profile.modes[0].misfit
    for words, undone in SLIPS:
        cuts = undone(fit.cuts)
        size = 1.0 if fit.force_std is not None else float(np.mean(cuts.force / fit.force))
        scale = None if fit.scale is None else fit.scale * size
        misfit = replace(fit.misfit, cuts=cuts, scale=scale)
        try:
            again = smallest_misfit(misfit)[0] / size**2
        except WirecutError:
            continue
        if again <= acceptable and again * BETTER <= best:
            return words
    return None

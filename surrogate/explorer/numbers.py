"""What the page is told: ends and errors of the table, quantities with their units, the start."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from surrogate.choosing.accuracy import DEFAULT_RTOL
from surrogate.choosing.candidates import OUTSIDE, Candidates, candidates
from surrogate.choosing.laws import COUPLED, PROJECTED, SLIP
from surrogate.contact.bounds import Bounds
from surrogate.contact.fitted import TERMS_OF_LAW
from surrogate.contact.shipped import folder_in_use
from surrogate.coupling.amplification import LEAST_SHARE
from surrogate.coupling.shipped import AMPLIFICATION_FILE, amplification
from surrogate.cutting.regimes import DOMINANT_SHARE, PARTS
from surrogate.explorer.reading import reading
from surrogate.reading import plausibility
from surrogate.reading.measurements import Measurements
from surrogate.reading.plausibility import Plausible
from surrogate.scene import NAMES, Scene
from surrogate.version import __version__

__all__ = ["GEL", "functions_of", "page_numbers"]

MU, GAMMA, RADIUS, XI, WEAR, ALPHA = NAMES

GEL = Scene(685.0, 1.6, 0.25e-3, wear_strength=7750.0)
"""The gel of the paper, which the page shows where nothing else is told."""

KEYS = dict(zip(NAMES, ("mu", "Gamma_o", "R_w", "xi", "tau_w", "alpha"), strict=True))
"""The names that the address of the page has for the quantities of a scene."""

_SHOWN: tuple[tuple[str, str, str, str, float, Plausible | None], ...] = (
    (MU, "μ", "shear modulus", "kPa", 1e3, plausibility.SHEAR_MODULUS),
    (GAMMA, "Γ_o", "cleavage toughness", "J/m²", 1.0, plausibility.TOUGHNESS),
    (WEAR, "τ_w", "wear strength", "kPa", 1e3, plausibility.WEAR_STRENGTH),
    (XI, "ξ", "friction coefficient", "", 1.0, plausibility.FRICTION),
    (ALPHA, "α", "stiffening exponent", "", 1.0, None),
    (RADIUS, "R_w", "wire radius", "mm", 1e-3, plausibility.RADIUS),
)


def functions_of(known: Candidates) -> tuple[str, ...]:
    """Return the functions of the table whose errors are known, which the laws follow."""
    return tuple(name for law in _laws_of(known) for name in TERMS_OF_LAW[law])


def _laws_of(known: Candidates) -> tuple[str, ...]:
    """Return the laws with functions of their own that the models have, with their errors."""
    return (PROJECTED,) if known.fitted.slip_bounds is None else (PROJECTED, SLIP)


def page_numbers(
    known: Candidates, scene: Scene, cuts: Measurements | None, law: str, diameters: bool
) -> dict[str, Any]:
    """Return what the page is told.

    Parameters
    ----------
    known : Candidates
        The models in use.
    scene : Scene
        What the page shows first, of single numbers.
    cuts : Measurements or None
        What the page draws over its curves.
    law : str
        The law that it shows first.
    diameters : bool
        Whether it shows diameters of wires instead of radii.
    """
    limits = known.limits
    return {
        **_of_coupled(known),
        "version": __version__,
        "data_date": data_date(known),
        "domain": {"g": limits.g, "alpha": limits.alpha, "highest": limits.highest},
        "bounds": {
            name: _bounds(candidates(known.fitted, law).bounds, name)
            for law in _laws_of(known)
            for name in TERMS_OF_LAW[law]
        },
        "threshold": DOMINANT_SHARE,
        "rtol": DEFAULT_RTOL,
        "transition": PARTS[0],
        "parts": PARTS[1:],
        "reading": reading(),
        "quantities": [_quantity(*one, alpha=limits.alpha) for one in _SHOWN],
        "start": {
            **{KEYS[name]: float(value) for name, value in zip(NAMES, scene.values(), strict=True)},
            "law": law,
            "diameters": diameters,
            "cuts": _cuts(cuts),
        },
    }


def _bounds(bounds: Bounds, name: str) -> dict[str, Any]:
    """Return the bounds of a function of the table, None where they are infinite."""
    errors = bounds.errors[OUTSIDE][name]
    return {
        "g": bounds.g,
        "alpha": bounds.alpha,
        "touch": bounds.touch,
        "errors": [[float(x) if np.isfinite(x) else None for x in row] for row in errors],
    }


def _of_coupled(known: Candidates) -> dict[str, Any]:
    """Return kappa of the models in use; nothing where they have none."""
    file = Path(folder_in_use()) / AMPLIFICATION_FILE
    if SLIP not in _laws_of(known) or not file.is_file():
        return {}
    kappa = amplification()
    reach, places = np.unique(kappa.reach, return_inverse=True)  # few loads were tried
    terms = zip(kappa.polynomial.powers, kappa.polynomial.coefficients, strict=True)
    return {
        COUPLED: {
            "touch": kappa.touch,
            "terms": [[*map(int, powers), float(c)] for powers, c in terms],
            "axes": [axis.tolist() for axis in kappa.axes],
            "reach": {"values": reach.tolist(), "places": places.ravel().tolist()},
            "loadUnit": kappa.load_unit,
            "edges": kappa.edges,
            "errors": kappa.errors.tolist(),
            "growth": kappa.growth.tolist(),
            "lowest": kappa.lowest,
            "highest": kappa.highest,
            "leastShare": LEAST_SHARE,
        }
    }


def data_date(known: Candidates) -> str:
    """Return the day on which the finite elements were computed, or "unknown"."""
    told = known.fitted.about.get("provenance", {})
    return str(told.get("data_date", "unknown"))[:10]


def _quantity(
    name: str,
    symbol: str,
    words: str,
    unit: str,
    size: float,
    plausible: Plausible | None,
    alpha: tuple[float, float],
) -> dict[str, Any]:
    return {
        "key": KEYS[name],
        "symbol": symbol,
        "words": words,
        "unit": unit,
        "size": size,
        "log": name not in (XI, ALPHA),
        "ends": alpha if plausible is None else (plausible.low, plausible.high),
        "plausible": None if plausible is None else (plausible.low, plausible.high),
    }


def _cuts(cuts: Measurements | None) -> list[tuple[float, float, float | None]]:
    if cuts is None:
        return []
    stds = np.full(cuts.force.shape, np.nan) if cuts.force_std is None else cuts.force_std
    return [
        (float(radius), float(force), float(std) if std > 0.0 else None)
        for radius, force, std in zip(cuts.wire_radius, cuts.force, stds, strict=True)
    ]

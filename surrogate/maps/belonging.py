"""Whether points belong on a map: what it fixes must be theirs, or its regimes are not."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from surrogate.choosing.by_name import AUTO
from surrogate.choosing.laws import PROJECTED, AnyLaw, law_of
from surrogate.contact.closed_forms import FORCE_MODELS, ClosedForm
from surrogate.cutting.force import force_of
from surrogate.errors import InputError
from surrogate.maps.axes import COORDINATES
from surrogate.maps.points import relative_std, value_of
from surrogate.maps.scenes import DEFAULTS

if TYPE_CHECKING:
    from surrogate.maps.points import MapPoints
    from surrogate.maps.record import MapRecord

__all__ = ["SAME", "require_the_same"]

SAME = 0.05
"""By how much a point may differ from what its map fixes: a node of some decades [-]."""


def require_the_same(points: MapPoints, made: MapRecord) -> None:
    """Refuse points of which a quantity or group is not what the map is drawn for.

    Parameters
    ----------
    points : MapPoints
        What is to be drawn.
    made : MapRecord
        The map.

    Raises
    ------
    InputError
        If what the map fixes, or takes where nothing fixes it, differs by more than `SAME` and by
        more than two of the points' standard errors, or the law is another.
    """
    law = _law_at(points, made)
    if points.law not in (None, AUTO, law):
        raise InputError(
            f"{points.label} must be of the map's law, {law!r}, but its wear strength was "
            f"identified by the law {points.law!r}; draw the map by law={points.law!r}, or leave "
            "the points out."
        )
    for name, fixed in [*made.fixed.items(), *_taken(made)]:
        group = COORDINATES[name]
        with np.errstate(all="ignore"):
            value = value_of(points, group)
            std = np.where(value == 0.0, 0.0, value * relative_std(points, group))
            allowed = np.fmax(SAME * fixed, 2.0 * std)
            off = ~((np.abs(value - fixed) <= allowed) | np.equal(value, fixed))
        if np.any(off):
            unit = f" {group.unit}" if group.unit else ""
            other = np.ravel(np.broadcast_to(value, np.shape(off)))[np.argmax(np.ravel(off))]
            fixes = "fixes" if name in made.fixed else "has, as nothing fixes it,"
            raise InputError(
                f"{points.label} must be of what the map is drawn for, but its {group.words} is "
                f"{other:.4g}{unit} where the map {fixes} {fixed:.4g}{unit}; draw the map for it, "
                "or leave the points out."
            )


def _law_at(points: MapPoints, made: MapRecord) -> str:
    """Return the law that a map has at points; theirs where it is one with the map's.

    Where the law is chosen, "slip" and "coupled" differ by less than the error that will do.
    """
    if not isinstance(made.model, AnyLaw):
        return law_of(made.model)
    error: Any = force_of(points.scene, made.model, extrapolate=True).law_error
    unknown = np.isnan(error)
    same = unknown.all() if points.law == PROJECTED else not unknown.any()
    return str(points.law) if same else AUTO


def _taken(made: MapRecord) -> list[tuple[str, float]]:
    """Return what a map takes for quantities that nothing given depends on, if it matters."""
    given = [*made.fixed, made.x.name, made.y.name]
    touched = {quantity for name in given for quantity in COORDINATES[name].powers}
    if isinstance(made.model, ClosedForm) or made.model in FORCE_MODELS:
        touched.add("stiffening_exponent")  # on which no closed form depends
    return [(name, value) for name, value in DEFAULTS.items() if name not in touched]

"""The tip in contact in one picture: what its radius does to friction and to wear."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from fe_training.coupled.dataset import CoupledData
from fe_training.sliding.record import SlidingOutcome
from surrogate.basics.figures import (
    COLOURS,
    GREY,
    SMALL,
    label_axes,
    legend_over,
    panels,
    plain_log_ticks,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["SIZE", "friction_limits", "places_with_notches", "tip_figure", "wear_forces"]

Array = NDArray[np.float64]
Place = tuple[float, float]

SIZE = (7.0, 2.9)
"""Size of the figure [inch]."""

#: Ratio from which on radii are different ones.
_APART = 2.0

_MARKERS = ("o", "s", "^")


def places_with_notches(data: CoupledData) -> dict[Place, Array]:
    """Return the radii of the notch [R_w] at each (alpha, g) that has several, largest first."""
    pairs = np.stack([data["alpha"], data["target"]], axis=1)
    places = {}
    for alpha, g in np.unique(pairs, axis=0).tolist():
        radii = np.unique(data["notch_radius"][_at(data, (alpha, g))])
        radii = radii[np.isfinite(radii)]
        radii = radii[np.insert(radii[1:] > _APART * radii[:-1], 0, True)] if len(radii) else radii
        if len(radii) > 1:
            places[alpha, g] = radii[::-1]
    return places


def _at(data: CoupledData, place: Place, radius: float | None = None) -> NDArray[np.bool_]:
    here = (data["alpha"] == place[0]) & (data["target"] == place[1])
    return np.asarray(here if radius is None else here & (data["notch_radius"] == radius))


def friction_limits(data: CoupledData, place: Place, radii: Array) -> Array:
    """Return xi at the maximum of friction alone for radii of the notch; nan where none was met."""
    limits = np.full(len(radii), np.nan)
    for i, radius in enumerate(radii):
        rows = _at(data, place, radius) & (data["wear"] == 0.0)
        rows &= data["outcome"] == SlidingOutcome.LIMIT.name
        if rows.any():
            limits[i] = data["friction"][rows].max()
    return limits


def wear_forces(data: CoupledData, place: Place, radius: float) -> tuple[Array, Array]:
    """Return tau_w/mu and F_ss/(mu R_w) of wear alone, with the taper of 1 that all radii have."""
    rows = _at(data, place, radius) & (data["friction"] == 0.0)
    rows &= np.isclose(data["ramp"], data["wear"])
    rows &= data["outcome"] == SlidingOutcome.CONVERGED.name
    wear, first = np.unique(data["wear"][rows], return_index=True)
    return wear, data["steady_force"][rows][first]


def tip_figure(data: CoupledData, figure: Figure) -> None:
    """Draw the limit of friction over the radius of the notch, and the force over wear.

    Parameters
    ----------
    data : CoupledData
        The rows, with several radii of the notch at some (alpha, g).
    figure : matplotlib.figure.Figure
        Where to draw.
    """
    left, right = panels(figure, 2)[0]
    handles: list[Any] = []
    places = places_with_notches(data)
    for (place, radii), colour, marker in zip(places.items(), COLOURS, _MARKERS, strict=False):
        name = rf"$\alpha$ = {place[0]:g}, $g$ = {place[1]:g}"
        form: dict[str, Any] = {"color": colour, "marker": marker, "ms": 3.8}
        handles += left.plot(radii, friction_limits(data, place, radii), lw=1.1, label=name, **form)
        for radius, line in zip(radii, ("-", "--", ":"), strict=False):
            wear, force = wear_forces(data, place, radius)
            right.plot(wear, force / place[1], line, lw=1.1, **form | {"ms": 2.6})
    radii = max(places.values(), key=len, default=np.empty(0))
    for radius, line in zip(radii, ("-", "--", ":"), strict=False):
        name = rf"notch {radius:g} $R_w$ in (b)"
        handles += right.plot([], [], line, color=GREY, lw=1.1, label=name)
    left.set(xscale="log", yscale="log")
    right.set_yscale("log")
    for ax in (left, right):
        plain_log_ticks(ax.yaxis, (1.0, 2.0, 3.0, 5.0))
        ax.tick_params(labelsize=SMALL)
    label_axes(left, r"radius of the notch [$R_w$]", r"$\xi$ at the maximum, no wear [-]")
    label_axes(right, r"$\tau_w/\mu$, no friction [-]", r"$F_{ss}/(\mu R_w g)$ [-]")
    legend_over(figure, handles, 3)

"""The law "slip" of a tip whose radius is stated, and not that of the finite elements' notch."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from surrogate.basics.checks import SMALLEST, Quantity
from surrogate.basics.elementwise import product, quotient, ratio, where
from surrogate.contact.archive import complete, file_in, read_fitted
from surrogate.contact.fitted import SLIP, FittedModel
from surrogate.contact.shipped import folder_in_use
from surrogate.coupling.model import OverSlip
from surrogate.coupling.notch import NotchSlip
from surrogate.errors import DomainError

__all__ = [
    "NOTCH_FILE",
    "NOTCH_RADIUS",
    "NotchedModel",
    "notch_slip",
    "notch_slip_of",
    "notched",
]

NOTCH_FILE = "notches.npz"

NOTCH_RADIUS = Quantity(
    "notch_radius", "m", "give the radius of the crack's tip, such as 1e-7", lower=SMALLEST
)


@dataclass(frozen=True, eq=False)
class NotchedModel(OverSlip):
    """A model of the law "slip" with the crack's tip of a stated radius.

    Parameters
    ----------
    slip : FittedModel
        The model under the law "slip", with the notch of the finite elements.
    tip : NotchSlip
        What another radius adds.
    notch_radius : float
        The radius of the tip [m].
    """

    tip: NotchSlip
    notch_radius: float
    law: str = SLIP

    def __str__(self) -> str:
        return f"{super().__str__()}, notch_radius {self.notch_radius:g}"

    def _relative(self, radius: Any) -> Any:
        with np.errstate(all="ignore"):
            return np.divide(self.notch_radius, radius)

    def terms_at(
        self, g: Any, mu: Any, gamma: Any, radius: Any, xi: Any, wear: Any, alpha: Any
    ) -> tuple[Any, Any]:
        """Return friction and wear at a known g."""
        friction, worn = self.slip.terms_at(g, mu, gamma, radius, xi, wear, alpha)
        with np.errstate(all="ignore"):
            arc, load = self.tip.added(g, alpha, self._relative(radius))
            return (
                _like(friction + 2.0 * product(radius, xi, mu) * load),
                _like(worn + 2.0 * product(wear, radius, arc)),
            )

    def gradient(
        self, mu: Any, gamma: Any, radius: Any, xi: Any, wear: Any, alpha: Any
    ) -> tuple[Any, ...]:
        """Return the derivatives of F_ss/T by the six quantities, in their order."""
        first = self.slip.gradient(mu, gamma, radius, xi, wear, alpha)
        g, worn = quotient(gamma, mu, radius), ratio(wear, mu)
        with np.errstate(all="ignore"):
            relative = self._relative(radius)
            arc, load = self.tip.added(g, alpha, relative)
            (arc_g, arc_alpha, arc_size), (load_g, load_alpha, load_size) = self.tip.slopes(
                g, alpha, relative
            )
            by_g = where(np.equal(g, 0.0), 0.0, (worn * arc_g + xi * load_g) / g)
            more = (
                2.0 * radius * (xi * (load - load_g) - worn * arc_g),
                2.0 * by_g,
                2.0 * (wear * (arc - arc_g + arc_size) + xi * mu * (load - load_g + load_size)),
                2.0 * product(radius, mu, load),
                2.0 * radius * arc,
                2.0 * radius * (wear * arc_alpha + xi * mu * load_alpha),
            )
            return tuple(_like(a + b) for a, b in zip(first, more, strict=True))

    def evaluated(self, mu: Any, gamma: Any, radius: Any, xi: Any, wear: Any, alpha: Any) -> Any:
        scene = mu, gamma, radius, xi, wear, alpha
        return *self.terms(*scene), self.in_domain(*scene)

    def in_domain(self, mu: Any, gamma: Any, radius: Any, xi: Any, wear: Any, alpha: Any) -> Any:
        """Return whether A* and B* are known, and what the tip adds to them."""
        g = quotient(gamma, mu, radius)
        with np.errstate(all="ignore"):
            known = self.tip.known(g, alpha, self._relative(radius))
        inside = self.limits.holds(g, alpha) & known
        return bool(inside) if np.ndim(inside) == 0 else inside

    def bounds_of(self, scene: tuple[Any, ...], measured: tuple[Any, Any]) -> tuple[Any, Any]:
        """Return bounds of the relative errors of A* and B*: those of the tip where it touches."""
        mu, gamma, radius, *_, alpha = scene
        g = quotient(gamma, mu, radius)
        with np.errstate(all="ignore"):
            touches = self.tip.touches(g, alpha)
            own = self.tip.bounds(self.name, g, alpha, self._relative(radius))
        arc, load = (np.where(touches, a, b) for a, b in zip(own, measured, strict=True))
        return arc, load

    def require_known(self, scene: tuple[Any, ...]) -> None:
        """Raise a `DomainError` where it is not known what the tip of a scene adds."""
        require_known_notch(self, scene)


def _like(value: Any) -> Any:
    return float(value) if np.ndim(value) == 0 else value


def require_known_notch(model: NotchedModel, scene: tuple[Any, ...]) -> None:
    """Raise a `DomainError` where it is not known what the tip of a scene adds.

    It does not matter where neither friction nor wear has a strength.
    """
    mu, gamma, radius, xi, wear, alpha = scene
    shape = np.broadcast_shapes(*map(np.shape, scene))
    with np.errstate(all="ignore"):
        g, relative = quotient(gamma, mu, radius), model._relative(radius)
        known = model.tip.known(g, alpha, relative)
    rubs = np.not_equal(xi, 0.0) | np.not_equal(wear, 0.0)
    unknown = np.broadcast_to(~np.asarray(known) & rubs, shape).ravel()
    if not unknown.any():
        return
    first = int(np.argmax(unknown))
    g, alpha, relative, radius = (
        float(np.broadcast_to(each, shape).flat[first]) for each in (g, alpha, relative, radius)
    )
    tip = model.tip
    if not 2.0 <= alpha <= tip.alpha or g > tip.highest_g:
        remedy = (
            "the slip of a tip that touches the wire is known for alpha from 2 to "
            f"{tip.alpha:g} and g up to {tip.highest_g:g}; leave notch_radius out, or give "
            "outside='nan' where a function has it"
        )
    else:
        ends = tip.radii[0], min(tip.radii[-1], tip.most / g)
        remedy = (
            f"it must be from {ends[0]:.3g} to {ends[1]:.3g} of the wire's radius, that is "
            f"{radius * ends[0]:.3g} to {radius * ends[1]:.3g} m here; give another radius"
        )
    raise DomainError(
        f"notch_radius must be one whose slip was computed, but notch_radius = "
        f"{model.notch_radius:.4g} m is {relative:.3g} of the wire's radius at g = {g:.4g}, "
        f"alpha = {alpha:.4g}: {remedy}."
    )


def notched(slip: FittedModel, notch_radius: float) -> NotchedModel:
    """Return a model of the law "slip" with a tip of a radius [m]."""
    return NotchedModel(slip, notch_slip(), notch_radius)


def notch_slip() -> NotchSlip:
    """Return what the radius of the tip adds to A* and B* of the models in use.

    Raises
    ------
    InputError
        If they have no file that says so, or it is damaged.
    """
    return _in(folder_in_use())


@cache
def _in(folder: str) -> NotchSlip:
    remedy = "leave notch_radius out, or make it with scripts/study-notches"
    return notch_slip_of(read_fitted(file_in(folder, NOTCH_FILE, "notch_radius", remedy))[0])


def notch_slip_of(about: Mapping[str, Any]) -> NotchSlip:
    """Return what a file says.

    Raises
    ------
    InputError
        If something is missing.
    """
    with complete(NOTCH_FILE, "scripts/study-notches"):
        a, b, c = map(float, about["pressure"])
        return NotchSlip(
            float(about["radius"]),
            tuple(map(float, about["stretch"])),
            (a, b, c),
            tuple(map(float, about["touch"])),
            float(about["alpha"]),
            float(about["highest_g"]),
            float(about["most"]),
            tuple(map(float, about["radii"])),
            {
                str(name): [(float(a), float(b)) for a, b in each]
                for name, each in about["errors"].items()
            },
        )

"""One model under the best law at each point: coupled where solutions reach, else projected.

What needs the force's derivatives asks for one model and one law around each point, not for the
cheapest that will do. The slip law is the coupled one's first order, which a load of 0 has.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from surrogate.basics.elementwise import quotient, ratio, taken
from surrogate.choosing.accuracy import one_model
from surrogate.choosing.auto_law import amplification_of_models
from surrogate.choosing.by_name import AUTO
from surrogate.choosing.effective import doubt_of_law
from surrogate.choosing.laws import COUPLED, PROJECTED, AnyLaw, coupled, of_law
from surrogate.contact.base import ForceModel
from surrogate.contact.fitted import SLIP, FittedModel

__all__ = ["Parted", "best_law", "parted"]


@dataclass(frozen=True, eq=False)
class Parted:
    """A model at a number of scenes, at each under its own law.

    Parameters
    ----------
    model : ForceModel
        The model; under the projected law where it has several.
    scene : tuple
        The six quantities.
    known : ndarray of bool or None
        Where the law is "coupled", and elsewhere "projected"; None where it is the model's own.
    """

    model: ForceModel
    scene: tuple[Any, ...]
    known: Any = None

    @property
    def laws(self) -> Any:
        """The law at each point."""
        if self.known is None:
            return self.model.law
        laws = np.where(self.known, COUPLED, PROJECTED)
        return laws if laws.ndim else str(laws)

    @property
    def law(self) -> str:
        """The law that all points have, or else "auto"."""
        if self.known is None:
            return self.model.law
        if not self.known.any():
            return PROJECTED
        return COUPLED if self.known.all() else AUTO

    @property
    def doubts(self) -> tuple[str, ...]:
        """What to say of the points at which nobody knows the error of any law."""
        if self.known is None:
            return ()
        rubs = np.not_equal(self.scene[3], 0.0) | np.not_equal(self.scene[4], 0.0)
        doubt = doubt_of_law(~self.known & rubs)
        return () if doubt is None else (doubt,)

    def evaluate(self, function: Callable[[Any, tuple[Any, ...]], tuple[Any, ...]]) -> Any:
        """Return the floats that a function has of a model and scenes, each by its own law."""
        if self.known is None or not self.known.any():
            return function(self.model, self.scene)
        assert isinstance(self.model, FittedModel)
        rubbing = coupled(self.model.under(SLIP))
        if self.known.all():
            return function(rubbing, self.scene)
        found: list[Any] = []
        for mask, model in ((self.known, rubbing), (~self.known, self.model)):
            parts = function(model, taken(self.scene, mask))
            found = found or [np.empty(mask.shape) for _ in parts]
            for column, part in zip(found, parts, strict=True):
                column[mask] = part
        return tuple(found)


def parted(
    model: Any,
    law: object,
    rtol: float | None,
    scene: tuple[Any, ...],
    notch_radius: float | None = None,
) -> Parted:
    """Return the one model that is meant, under the law, or with "auto" the best of each scene.

    Parameters
    ----------
    model : str or ForceModel
        As in `force_gradient`.
    law : str
        "projected", "slip", "coupled" or "auto".
    rtol : float or None
        As in `force_gradient`.
    scene : tuple
        The six quantities.
    notch_radius : float, optional
        Radius of the crack's tip [m], of the law "slip" alone.

    Examples
    --------
    >>> scene = 10e3, 5.0, np.array([0.2e-3, 0.5e-3]), 0.01, 1e3, np.array([2.0, 6.0])
    >>> parted("table", "auto", None, scene).laws.tolist()
    ['projected', 'coupled']
    """
    wanted = of_law(model, law, True, notch_radius)
    if not isinstance(wanted, AnyLaw):
        return Parted(one_model(wanted, rtol), scene)
    one = one_model(wanted.named or AUTO, rtol)
    if not isinstance(one, FittedModel):
        return Parted(one, scene)
    return Parted(one, scene, best_law(one, scene))


def best_law(model: FittedModel, scene: tuple[Any, ...]) -> Any:
    """Return to the loads of which scenes coupled solutions reach."""
    mu, gamma, radius, xi, wear, alpha = scene
    kappa, known = amplification_of_models(model), False
    if kappa is not None:
        with np.errstate(all="ignore"):
            known = kappa.place(quotient(gamma, mu, radius), alpha, xi, ratio(wear, mu)).known
    return np.broadcast_to(known, np.broadcast_shapes(*map(np.shape, scene)))

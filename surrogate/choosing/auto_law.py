"""Friction and wear by the cheapest law and model whose error beside coupled solutions will do.

First the terms of the slip law by the cheapest model. Where the measured bound of what the load
does to its own force is small enough they stay; elsewhere they are multiplied by kappa. Where
nobody knows that bound, outside the coupled solutions or where the size of the tip decides, the
terms are those of the projected law, whose tau_w and xi are effective numbers there.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from surrogate.basics.checks import FloatOrArray
from surrogate.basics.elementwise import exp, quotient, ratio
from surrogate.choosing.accuracy import DEFAULT_RTOL
from surrogate.choosing.auto import AutomaticTerms
from surrogate.choosing.candidates import candidates
from surrogate.choosing.choice import rounded_up
from surrogate.contact.domain import require_inside
from surrogate.contact.fitted import COUPLED, PROJECTED, SLIP
from surrogate.coupling.shipped import amplification
from surrogate.errors import AccuracyError

__all__ = ["LawfulTerms"]

_CODES = (PROJECTED, SLIP, COUPLED)
_FIT_PART = 0.6
"""Part of rtol that the model of the slip law may take; the law itself has the rest."""


class LawfulTerms:
    """Friction, wear, where in the domain, numbers of model and law, and errors: a kernel.

    Parameters
    ----------
    values : tuple
        The six quantities of a scene.
    rtol : float or None
        Relative error of the force, beside coupled finite elements, that will do [-]; None for 0.02
        where it can be had.
    of_dissipation : bool
        Whether `rtol` is relative to friction and wear alone.

    Examples
    --------
    >>> scene = 5e3, 20.0, 0.1e-3, 0.05, 1e3, 6.0
    >>> friction, wear, inside, model, law, fit, of_law = LawfulTerms(scene, None)(*scene)
    >>> inside, fit >= 0.0
    (True, True)
    """

    dtypes = (float, float, bool, np.uint8, np.uint8, float, float)

    def __init__(
        self, values: tuple[FloatOrArray, ...], rtol: float | None, of_dissipation: bool = False
    ) -> None:
        self.values, self.of_dissipation = values, of_dissipation
        self.rtol, self.promised = DEFAULT_RTOL if rtol is None else rtol, rtol is not None
        self.known, self.kappa = candidates(law=SLIP), amplification()
        self.surrounded = True
        self._worst: tuple[float, float, float] | None = None

    def __call__(self, *scene: Any) -> tuple[Any, ...]:
        mu, gamma, radius, xi, wear, alpha = scene
        one = all(type(value) is float for value in scene)
        slip = AutomaticTerms(scene, _FIT_PART * self.rtol, self.of_dissipation, self.known)
        friction, worn, holds, number, fit = slip(*scene)
        self.surrounded = self.surrounded and bool(np.all(holds))
        g, relative = quotient(gamma, mu, radius), ratio(wear, mu)
        rest = 0.0 if self.of_dissipation else gamma
        law, of_law = self._first_order(number, friction + worn, rest, (g, alpha, xi, relative))
        together = fit + of_law
        if one:
            if together <= self.rtol:
                return friction, worn, bool(holds), number, law, fit, of_law
            if together == together:
                terms = self._amplified(scene, (friction, worn), (g, alpha, xi, relative), fit)
                found = (*terms[:2], bool(holds), number, 2, terms[2], 0.0)
            else:
                found = self._projected(scene)
            self._look(found[5] + found[6], g, alpha)
            return found
        return self._by_masks(
            scene, (friction, worn, holds, number, law, fit, of_law), (g, alpha, xi, relative)
        )

    def _first_order(
        self, number: Any, drag: Any, rest: Any, load: tuple[Any, ...]
    ) -> tuple[Any, Any]:
        """Return the law of the first order, and the bound of what it lacks."""
        most = self.kappa.most(*load)
        with np.errstate(all="ignore"):
            swing = np.expm1(most)  # for kappa as small, and as large, as it may be
            error = np.maximum(
                drag * swing / (rest * (1.0 + swing) + drag),
                drag * swing / (rest + drag * (1.0 + swing)),
            )
            error = np.where(np.equal(drag, 0.0), 0.0, error)
        law = np.where(np.equal(number, 0), 0, 1)
        return (int(law), float(error)) if np.ndim(error) == 0 else (law, error)

    def _amplified(
        self, scene: tuple[Any, ...], terms: tuple[Any, Any], load: tuple[Any, ...], fit: Any
    ) -> tuple[Any, Any, Any]:
        """Return the terms times kappa, and the bound of their error."""
        kappa = exp(self.kappa.log_factor(*load))
        friction, worn = terms[0] * kappa, terms[1] * kappa
        rest = 0.0 if self.of_dissipation else scene[1]
        drag = friction + worn
        own = drag / (rest + drag) * np.expm1(self.kappa.error(*load))
        # the slip terms may be a larger share of the amplified force than they were of their own
        larger = np.maximum(1.0, kappa)
        error = fit * larger + own
        return friction, worn, float(error) if type(kappa) is float else error

    def _projected(self, scene: tuple[Any, ...]) -> tuple[Any, ...]:
        """Return the terms of the projected law, whose error nobody knows."""
        terms = AutomaticTerms(scene, None, self.of_dissipation)
        friction, worn, holds, number, fit = terms(*scene)
        number = self._renumbered(number)
        one = all(type(value) is float for value in scene)
        unknown = np.nan if one else np.full(np.shape(friction), np.nan)
        return friction, worn, holds, number, 0, fit, unknown

    def _renumbered(self, number: Any) -> Any:
        """Return the numbers among the models of slip of models of the projected law."""
        places = [self.known.names.index(name) for name in candidates().names]
        return places[number] if np.ndim(number) == 0 else np.array(places)[number]

    def _by_masks(
        self, scene: tuple[Any, ...], found: tuple[Any, ...], load: tuple[Any, ...]
    ) -> tuple[Any, ...]:
        shape = np.broadcast_shapes(*map(np.shape, scene))
        columns = [np.array(np.broadcast_to(each, shape)) for each in found]
        friction, worn, _, _, law, fit, of_law = columns
        together = fit + of_law
        more, unknown = together > self.rtol, np.isnan(together)
        if more.any():
            some = tuple(_taken(value, more) for value in scene)
            part = tuple(_taken(value, more) for value in load)
            terms = self._amplified(some, (friction[more], worn[more]), part, fit[more])
            friction[more], worn[more], fit[more] = terms
            law[more], of_law[more] = 2, 0.0
        if unknown.any():
            some = tuple(_taken(value, unknown) for value in scene)
            for column, values in zip(columns, self._projected(some), strict=True):
                column[unknown] = values
        self._look(fit + of_law, load[0], load[1])
        return tuple(columns)

    def _look(self, error: Any, g: Any, alpha: Any) -> None:
        """Keep in mind a point whose error is more than asked for."""
        if self._worst is None and self.promised:
            short = np.atleast_1d(~np.less_equal(error, self.rtol))
            if short.any():
                first = int(np.argmax(short))
                at = (np.broadcast_to(each, short.shape).flat[first] for each in (error, g, alpha))
                self._worst = tuple(map(float, at))  # type: ignore[assignment]

    def finish(self, extrapolate: bool) -> None:
        """Raise what is to be refused, after all points are done.

        Raises
        ------
        DomainError
            If a point whose contact matters is outside the domain and `extrapolate` is not set.
        AccuracyError
            If rtol was given and is not met.
        """
        if not (self.surrounded or extrapolate):
            require_inside(self.known.models[1], self.values)
        if self._worst is None:
            return
        error, g, alpha = self._worst
        known = f"is up to {error:.2g}" if error == error else "is known to nobody"
        remedy = f"rtol={rounded_up(error)} or more, or " if error == error else ""
        raise AccuracyError(
            f"rtol must be met beside finite elements on which the wire rubs, but rtol = "
            f"{self.rtol:g} is not at g = {g:.4g}, alpha = {alpha:.4g}, where the error of the "
            f"best law {known}; give {remedy}rtol=None for the best there is."
        )

    def names(self, number: Any) -> Any:
        """Return the names of the models of these numbers."""
        return _named(self.known.names, number)

    def laws(self, number: Any) -> Any:
        """Return the names of the laws of these numbers."""
        return _named(_CODES, number)


def _named(names: Any, number: Any) -> Any:
    return names[number] if type(number) is int else np.array(names)[number]


def _taken(value: Any, mask: Any) -> Any:
    return value if type(value) is float else np.broadcast_to(value, mask.shape)[mask]

"""Friction and wear by the cheapest law and model whose error beside coupled solutions will do.

Where solutions with friction and wear reach to a point: first the terms of the slip law by the
cheapest model. Where the measured bound of what the load does to its own force is small enough
they stay; elsewhere they are multiplied by kappa. Where none reaches, or where the size of the tip
decides, nobody knows that bound: the terms are those of the projected law, whose tau_w and xi are
effective numbers there.
"""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from surrogate.basics.checks import FloatOrArray
from surrogate.basics.digits import rounded_up
from surrogate.basics.elementwise import exp, expm1, larger, quotient, ratio, taken, where
from surrogate.choosing.accuracy import DEFAULT_RTOL
from surrogate.choosing.auto import AutomaticTerms, named, terms_of_one
from surrogate.choosing.candidates import OUTSIDE, Candidates, candidates
from surrogate.choosing.laws import force_bound
from surrogate.contact.domain import require_inside
from surrogate.contact.fitted import COUPLED, PROJECTED, SLIP, TERMS_OF_LAW, FittedModel
from surrogate.contact.shipped import Fitted, location, shipped
from surrogate.coupling.amplification import Amplification, Place
from surrogate.coupling.shipped import amplification_if_any
from surrogate.errors import AccuracyError

if TYPE_CHECKING:
    from surrogate.choosing.common_choice import CommonTerms

__all__ = ["LawfulTerms", "amplification_of_models", "common_terms"]

_CODES = (PROJECTED, SLIP, COUPLED)
_FIT_PART = 0.6
"""Part of rtol that the model of the slip law may take; the law itself has the rest."""

Terms = tuple[Any, ...]


class _InUse(NamedTuple):
    """What the law is chosen among: kappa, where all models have what it needs, and the models."""

    kappa: Amplification | None
    names: list[str]
    of_law: dict[str, Candidates]


@lru_cache(16)
def _at(named: str | None, folder: str) -> _InUse:
    """Return what there is at a `location`, for which one look-up has to do."""
    fitted = shipped()
    kappa = amplification_if_any() if _all_slip(fitted) else None
    laws = (PROJECTED, SLIP) if kappa else (PROJECTED,)
    of_law = {law: candidates(fitted, law) for law in laws}
    return _InUse(kappa, of_law[PROJECTED].names, of_law)


def amplification_of_models(named: FittedModel | None = None) -> Amplification | None:
    """Return kappa of the models in use; None where they, or the named one, lack what it needs."""
    return _at(*location()).kappa if named is None or _slips(named) else None


def _all_slip(fitted: Fitted) -> bool:
    """Return whether all models of a file have the slip law, with measured errors."""
    return fitted.slip_bounds is not None and all(map(_slips, fitted.models.values()))


def _slips(model: FittedModel) -> bool:
    """Return whether a model has the functions of the slip law."""
    return {*TERMS_OF_LAW[SLIP]} <= {*model.functions}


def common_terms(values: tuple[FloatOrArray, ...], rtol: float | None) -> CommonTerms | None:
    """Return the law and model of many scenes, if `LawfulTerms` chooses the same at all of them.

    None where only a look at each of them tells, or an error that was asked for has to be met.

    Examples
    --------
    >>> radii = np.linspace(2e-4, 3e-4, 20_000)
    >>> terms = common_terms((685.0, 1.6, radii, 0.1, 7750.0, 2.5), None)
    >>> str(terms.model)
    'table'
    """
    if rtol is not None:
        return None
    from surrogate.choosing import common_choice as common  # which one scene need not load

    box = common.box_of(values)
    if box is None:
        return None
    kappa, _, of_law = _at(*location())
    if kappa is None or common.is_beyond(kappa, box):
        return common.common_model(of_law[PROJECTED], box, DEFAULT_RTOL)
    return common.common_slip(kappa, of_law[SLIP], box, DEFAULT_RTOL, _FIT_PART)


class LawfulTerms:
    """Friction, wear, where in the domain, numbers of model and law, and errors: a kernel.

    Parameters
    ----------
    values : tuple
        The six quantities of a scene.
    rtol : float or None
        Relative error of the force, beside coupled finite elements, that will do [-]; None for 0.02
        where it can be had, and else the best there is.
    of_dissipation : bool
        Whether `rtol` is relative to friction and wear alone.
    named : FittedModel, optional
        The model, where it is not to be chosen.

    Examples
    --------
    >>> scene = 5e3, 20.0, 0.1e-3, 0.05, 1e3, 6.0
    >>> friction, wear, inside, model, law, fit, of_law = LawfulTerms(scene, None)(*scene)
    >>> inside, fit >= 0.0
    (True, True)
    """

    dtypes = (float, float, bool, np.uint8, np.uint8, float, float)

    def __init__(
        self,
        values: tuple[FloatOrArray, ...],
        rtol: float | None,
        of_dissipation: bool = False,
        named: FittedModel | None = None,
    ) -> None:
        self.values, self.of_dissipation, self.named = values, of_dissipation, named
        self.single = {*map(type, values)} == {float}
        self.rtol, self.promised = DEFAULT_RTOL if rtol is None else rtol, rtol is not None
        self.known = _at(*location())
        self.kappa = self.known.kappa if named is None or _slips(named) else None
        self.names_of_models = self.known.names if named is None else [named.name]
        self.surrounded = True
        self._worst: tuple[float, float, float] | None = None

    def __call__(self, *scene: Any) -> Terms:
        mu, gamma, radius, _, wear, alpha = scene
        g, relative = quotient(gamma, mu, radius), ratio(wear, mu)
        terms = self._of_place(scene, g, relative)
        if terms[2] is not True:
            self.surrounded = self.surrounded and bool(np.all(terms[2]))
        if self.promised and self._worst is None:
            self._look(terms[5] + terms[6], g, alpha)
        return terms

    def _of_place(self, scene: tuple[Any, ...], g: Any, relative: Any) -> Terms:
        if self.kappa is None:
            return self._projected(scene)
        place = self.kappa.place(g, scene[5], scene[3], relative)
        if place.known is False:
            return self._projected(scene)
        if self.single:
            return self._of_one(scene, place)
        return self._of_many(scene, place)

    def _of_one(self, scene: tuple[float, ...], place: Place) -> Terms:
        """Return the terms of one scene to whose load solutions reach."""
        first = self._slip(scene, place, self.named)
        if first[5] + first[6] <= self.rtol:
            return first
        if first[5] != first[5]:
            return self._projected(scene)
        kappa = self._factor(place)
        best = self._better(scene, first, kappa)
        if best[5] + best[6] > self.rtol and self.named is None:
            finer = self._better(scene, self._slip(scene, place, _table()), kappa)
            return finer if finer[5] + finer[6] < best[5] + best[6] else best
        return best

    def _of_many(self, scene: tuple[Any, ...], place: Place) -> Terms:
        """Return the terms of scenes, to the loads of some of which solutions reach."""
        shape = np.broadcast_shapes(*map(np.shape, scene))
        known = np.broadcast_to(place.known, shape)
        everywhere = bool(known.all())
        some = scene if everywhere else taken(scene, known)
        here = place if everywhere else place.at(known)
        terms = self._judged(some, here)
        if everywhere:
            return terms
        columns = tuple(np.empty(shape, kind) for kind in self.dtypes)
        for mask, part in ((known, terms), (~known, self._projected(taken(scene, ~known)))):
            _put(columns, mask, part)
        return columns

    def _judged(self, scene: tuple[Any, ...], place: Place) -> Terms:
        """Return the terms of scenes to whose loads solutions reach."""
        shape = np.broadcast_shapes(*map(np.shape, scene))
        first = self._slip(scene, place, self.named)
        fits = np.broadcast_to(np.equal(first[5], first[5]), shape)
        met = np.broadcast_to(np.less_equal(first[5] + first[6], self.rtol), shape)
        if met.all():
            return first
        columns = tuple(np.array(np.broadcast_to(each, shape)) for each in first)
        if (short := ~met & fits).any():
            _put(columns, short, self._bettered(taken(scene, short), columns, short, place))
        if not fits.all():
            _put(columns, ~fits, self._projected(taken(scene, ~fits)))
        return columns

    def _bettered(self, scene: Any, columns: Terms, mask: Any, place: Place) -> Terms:
        """Return terms of the best law, and where none will do by the best model of slip."""
        first, here = tuple(column[mask] for column in columns), place.at(mask)
        kappa = self._factor(here)
        best = self._better(scene, first, kappa)
        short = best[5] + best[6] > self.rtol
        if self.named is None and short.any():
            some, there = taken(scene, short), here.at(short)
            factors = kappa[0][short], kappa[1][short]
            finer = self._better(some, self._slip(some, there, _table()), factors)
            before = tuple(column[short] for column in best)
            less = finer[5] + finer[6] < before[5] + before[6]
            _put(
                best,
                short,
                tuple(np.where(less, a, b) for a, b in zip(finer, before, strict=True)),
            )
        return best

    def _slip(self, scene: tuple[Any, ...], place: Place, model: FittedModel | None) -> Terms:
        """Return the terms of the slip law, by a model or the cheapest, and what the law lacks."""
        assert self.kappa is not None
        friction, worn, holds, number, fit = self._terms(scene, SLIP, model)
        drag, rest = friction + worn, self._rest(scene)
        swing = expm1(self.kappa.most_at(place))  # kappa as small, and as large, as may be
        unloaded = drag == 0.0
        other = where(unloaded, 1.0, drag)
        error = larger(
            other * swing / (rest * (1.0 + swing) + other),
            other * swing / (rest + other * (1.0 + swing)),
        )
        closed = unloaded if model else number == 0  # Eq. (13) is of the projected law
        law = np.where(closed, 0, 1) if isinstance(closed, np.ndarray) else int(not closed)
        return friction, worn, holds, number, law, fit, where(unloaded, 0.0, error)

    def _better(self, scene: tuple[Any, ...], first: Terms, factors: tuple[Any, Any]) -> Terms:
        """Return the terms times kappa where their error then will do or is the smaller one."""
        friction, worn, holds, number, _, fit, of_law = first
        kappa, unsure = factors
        drag = (friction + worn) * kappa
        # the slip terms may be a larger share of the amplified force than they were of their own
        error = fit * larger(1.0, kappa) + drag / (self._rest(scene) + drag) * unsure
        better = (error <= self.rtol) | ((fit + of_law <= error) ^ True)
        terms = friction * kappa, worn * kappa, holds, number, 2, error, 0.0
        if type(better) is bool:
            return terms if better else first
        return tuple(np.where(better, a, b) for a, b in zip(terms, first, strict=True))

    def _factor(self, place: Place) -> tuple[Any, Any]:
        """Return kappa, and the bound of its relative error."""
        assert self.kappa is not None
        kappa, unsure = exp(self.kappa.log_at(place)), expm1(self.kappa.error_at(place))
        return kappa, unsure if type(kappa) is float else np.broadcast_to(unsure, np.shape(kappa))

    def _projected(self, scene: tuple[Any, ...]) -> Terms:
        """Return the terms of the projected law, whose error nobody knows where anything rubs."""
        friction, worn, holds, number, fit = self._terms(scene, PROJECTED, self.named)
        unknown = where(friction + worn == 0.0, 0.0, np.nan)
        return friction, worn, holds, number, 0, fit, unknown

    def _terms(self, scene: tuple[Any, ...], law: str, model: FittedModel | None) -> Terms:
        """Return friction, wear, where in the domain, number of the model and bound under a law."""
        if model is None:
            rtol = _FIT_PART * self.rtol if law == SLIP else DEFAULT_RTOL
            known = self.known.of_law[law]
            if self.single:
                g, rest = quotient(scene[1], scene[0], scene[2]), self._rest(scene)
                if (one := terms_of_one(known, g, scene, rest, rtol)) is not None:
                    return one[0], one[1], True, one[2], one[3]
            return AutomaticTerms(scene, rtol, self.of_dissipation, known)(*scene)
        model = model.under(law)
        friction, worn, holds = model.evaluated(*scene)
        drag, parts = friction + worn, (self._rest(scene), friction, worn)
        known = self.known.of_law[law]
        fit = where(drag == 0.0, 0.0, force_bound(model, scene, parts, known))
        return friction, worn, holds, self.names_of_models.index(model.name), fit

    def _rest(self, scene: tuple[Any, ...]) -> Any:
        return 0.0 if self.of_dissipation else scene[1]

    def _look(self, error: Any, g: Any, alpha: Any) -> None:
        """Keep in mind a point whose error is more than asked for."""
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
            require_inside(self.named or self.known.of_law[PROJECTED].models[1], self.values)
        if self._worst is None:
            return
        error, g, alpha = self._worst
        known = f"is up to {error:.2g}" if error == error else "is known to nobody"
        remedy = f"rtol={rounded_up(error)} or more, or " if error == error else ""
        raise AccuracyError(
            f"rtol must be met beside finite elements on which the wire rubs, but rtol = "
            f"{self.rtol:g} is not at g = {g:.4g}, alpha = {alpha:.4g}, where the error of the "
            f"best law {known}; give {remedy}law='projected' for an rtol beside finite elements of "
            "that law, or leave rtol out for the best there is."
        )

    def names(self, number: Any) -> Any:
        """Return the names of the models of these numbers."""
        return named(self.names_of_models, number)

    def laws(self, number: Any) -> Any:
        """Return the names of the laws of these numbers."""
        return named(_CODES, number)


def _table() -> FittedModel:
    """Return the model with the smallest bounds: the gp's are no smaller."""
    table = shipped().models[OUTSIDE]
    assert isinstance(table, FittedModel)
    return table


def _put(columns: Terms, mask: Any, values: Terms) -> None:
    for column, value in zip(columns, values, strict=True):
        column[mask] = value

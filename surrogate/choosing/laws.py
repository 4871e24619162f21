"""The laws of dissipation: which functions of the contact wear and friction follow.

"projected" is the paper's Eq. (S2): the shear stress counts by its component along the cut, A and
B, while the normal forces stay what they are without it. "slip" is the balance of energy to first
order in tau_w and xi: shear stress times the way that the solid slips, A* and B*. Eq. (S2) leaves
out that the normal forces grow as well, and so gives too small a force. "coupled" lets the shear
stress act on the body: kappa times the slip law.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from surrogate.basics.checks import LAWS, one_number, shown
from surrogate.basics.elementwise import quotient, ratio, where
from surrogate.choosing.accuracy import contact_bounds
from surrogate.choosing.by_name import AUTO, force_model, is_auto
from surrogate.contact.fitted import COUPLED, PROJECTED, SLIP, TERMS_OF_LAW, FittedModel
from surrogate.errors import DomainError, InputError

if TYPE_CHECKING:
    from surrogate.choosing.candidates import Candidates

__all__ = [
    "COUPLED",
    "LAWS",
    "PROJECTED",
    "SLIP",
    "AnyLaw",
    "coupled",
    "force_bound",
    "is_chosen",
    "law_of",
    "of_law",
    "require_known_load",
]

_BEST = "table"


@dataclass(frozen=True)
class AnyLaw:
    """A model whose law is chosen point by point.

    Parameters
    ----------
    named : FittedModel or None
        The model that somebody named; None where it is chosen as well.

    Examples
    --------
    >>> str(AnyLaw()), AnyLaw().law
    ('auto, law auto', 'auto')
    """

    named: FittedModel | None = None
    law = AUTO

    @property
    def name(self) -> str:
        """Name of the model, or "auto"."""
        return AUTO if self.named is None else self.named.name

    @property
    def contact(self) -> FittedModel:
        """The model that tells of the contact without friction and wear."""
        model = force_model(_BEST) if self.named is None else self.named
        assert isinstance(model, FittedModel)
        return model

    def __str__(self) -> str:
        return f"{self.name}, law {self.law}"


_ANY = AnyLaw()


def is_chosen(model: object) -> bool:
    """Return whether the model or its law is chosen point by point.

    Examples
    --------
    >>> is_chosen("auto"), is_chosen(AnyLaw()), is_chosen("table")
    (True, True, False)
    """
    return is_auto(model) or isinstance(model, AnyLaw)


def law_of(model: Any) -> str:
    """Return the law of a model or of a model's name.

    Examples
    --------
    >>> law_of("auto"), law_of("eq13"), law_of(AnyLaw())
    ('projected', 'projected', 'auto')
    """
    return PROJECTED if is_auto(model) else getattr(model, "law", PROJECTED)


def of_law(
    model: Any, law: object, any_law: bool = False, notch_radius: float | None = None
) -> Any:
    """Return what `model` is to be under a law: itself for "projected", else a model's object.

    Under "slip" and "coupled" the name "auto" is the table, the quickest of the fitted models at
    many points. Under "auto" a closed form is itself, as all are of the projected law, and so is
    a model that was put under a law already.

    Parameters
    ----------
    model : str or ForceModel
        A model, or "auto".
    law : str
        "projected", "slip", "coupled", or "auto" where `any_law`.
    any_law : bool, default False
        Whether the caller can choose the law point by point.
    notch_radius : float, optional
        Radius of the crack's tip [m], of the law "slip" alone.

    Raises
    ------
    InputError
        If there is no such law, or the model does not have it.
    UnknownModelError
        If there is no such model.

    Examples
    --------
    >>> of_law("eq13", "projected"), of_law("eq13", "auto", any_law=True)
    ('eq13', 'eq13')
    >>> str(of_law("table", "auto", any_law=True))
    'table, law auto'
    """
    known = (*LAWS, AUTO) if any_law else LAWS
    if not isinstance(law, str) or law not in known:
        raise InputError(f"law must be one of {', '.join(known)}, but is {shown(law)}; choose one.")
    if notch_radius is not None and law != SLIP:
        raise InputError(
            "notch_radius must be given with law='slip', whose slip depends on the tip where it "
            f"touches the wire, but the law is {law!r}; give law='slip', or leave it out."
        )
    if law == PROJECTED or (law == AUTO and isinstance(model, AnyLaw)):
        return model
    if law == AUTO and is_auto(model):
        return _ANY
    chosen = force_model(_BEST if is_auto(model) else model)
    if law == AUTO:
        if isinstance(chosen, FittedModel) and chosen.law == PROJECTED:
            return AnyLaw(chosen)
        return model
    if not isinstance(chosen, FittedModel):
        raise InputError(
            f"law={law!r} must have a model fitted to finite elements, but {chosen.name!r} is of "
            f"the law {PROJECTED!r}; choose model='auto', or law={PROJECTED!r}."
        )
    if not {*TERMS_OF_LAW[law]} <= {*chosen.functions}:
        raise InputError(
            f"law={law!r} must have A* and B*, but the file of {chosen.name!r} has none; make it "
            "anew with regen-surrogate, or take the models that wirecut ships."
        )
    if law == COUPLED:
        return coupled(chosen.under(SLIP))
    return chosen.under(law) if notch_radius is None else _notched(chosen.under(law), notch_radius)


def _notched(slip: FittedModel, notch_radius: object) -> FittedModel:
    """Return a model of the slip law with a tip of its own radius."""
    from surrogate.coupling.notched import NOTCH_RADIUS, notched

    return notched(slip, one_number(NOTCH_RADIUS, notch_radius))


def coupled(slip: FittedModel) -> FittedModel:
    """Return a model of the slip law under the law "coupled"."""
    model, kappa_in_use = _coupling()
    return model(slip, kappa_in_use())  # type: ignore[no-any-return]


@cache
def _coupling() -> tuple[Callable[..., Any], Callable[[], Any]]:
    """Return what makes a coupled model, and kappa: loaded where somebody asks for that law."""
    from surrogate.coupling.model import CoupledModel
    from surrogate.coupling.shipped import amplification

    return lru_cache(16)(CoupledModel), amplification


def require_known_load(model: Any, values: tuple[Any, ...]) -> None:
    """Raise a `DomainError` where a scene's load or tip is one that no solution tells of."""
    model.require_known(values)
    if model.law != COUPLED:
        return
    shape = np.broadcast_shapes(*map(np.shape, values))
    loaded = np.not_equal(values[3], 0.0) | np.not_equal(values[4], 0.0)
    outside = np.broadcast_to(~np.asarray(model.in_domain(*values)) & loaded, shape)
    if not outside.any():
        return
    first = int(np.argmax(outside.ravel()))
    mu, gamma, radius, xi, wear, alpha = (
        float(np.broadcast_to(value, shape).flat[first]) for value in values
    )
    with np.errstate(all="ignore"):
        g, relative = np.divide(gamma, mu * radius), np.divide(wear, mu)
        share = model.amplification.share(float(g), alpha, xi, float(relative))
    where = "where no coupled solution is near" if share == np.inf else f"{share:.3g} times it"
    most = model.amplification.most_wear(alpha)
    if relative > most:
        where += f", and no wire slid steadily above tau_w/mu = {most:.3g} near this alpha"
    raise DomainError(
        "friction and wear must be at most the load that coupled solutions reach before the tip "
        f"touches the wire, but xi = {xi:.4g}, tau_w/mu = {relative:.4g} at g = {g:.4g}, alpha = "
        f"{alpha:.4g} is {where}; give less of them, extrapolate=True for kappa of the nearest "
        "load, or law='slip' or 'projected'."
    )


def force_bound(
    model: FittedModel,
    scene: tuple[Any, ...],
    parts: tuple[Any, Any, Any],
    known: Candidates | None = None,
) -> Any:
    """Return the bound of the relative error of a force beside finite elements of its law.

    Parameters
    ----------
    model : FittedModel
        The model, under its law.
    scene : tuple
        Its six quantities.
    parts : tuple
        Cleavage, friction and wear [N/m].
    known : Candidates, optional
        The models of its law; by default those in use.

    Returns
    -------
    float or ndarray
        The bound [-]; nan outside the domain, and under "slip" where the tip touches the wire and
        the slip there depends on how sharp it is.
    """
    mu, gamma, radius, xi, tau, alpha = scene
    cleavage, friction, wear = parts
    with np.errstate(all="ignore"):
        g, relative = quotient(gamma, mu, radius), ratio(tau, mu)
        own = _own_error(model, g, alpha, xi, relative)
        bounds = contact_bounds(model, g, alpha, known)
        assert bounds is not None  # of a fitted model
        bounds = model.bounds_of(scene, bounds)
        off = where(friction == 0.0, 0.0, friction * (bounds[1] + own))
        off = off + where(wear == 0.0, 0.0, wear * (bounds[0] + own))
        smooth = (friction == 0.0) & (wear == 0.0)
        share = ratio(off, cleavage + friction + wear)
        return where((off < np.inf) | smooth, share, np.nan)


def _own_error(model: Any, g: Any, alpha: Any, xi: Any, relative: Any) -> Any:
    """Return the bound of the relative error of kappa; 0 where the law has none."""
    if model.law != COUPLED:
        return 0.0
    return np.expm1(model.amplification.error(g, alpha, xi, relative))

"""The law and the model that all points of many share, where the ends of their ranges tell.

What is chosen at a point depends on the cell of (g, alpha) that it is in and, in units of
Gamma_o, on the estimates 4 (tau_w/mu)/g and xi (1 + 4/g) of wear and friction. At one alpha the
range of g is cut into pieces that stay in one cell. In each of them the estimates, and with them
all errors, are between numbers that its ends give, so that a comparison which is the same for
both is so for all points. Where one is not, nothing is said, and every point is looked at.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from surrogate.basics.checks import common_shape
from surrogate.basics.elementwise import log
from surrogate.choosing.candidates import FREE, Candidates
from surrogate.choosing.choice import NEGLIGIBLE
from surrogate.contact.closed_forms import FORCE_MODELS
from surrogate.contact.coordinates import log_touch
from surrogate.contact.domain import g_range
from surrogate.coupling.amplification import Amplification
from surrogate.coupling.coverage import bounds_over, is_beyond, uncovered
from surrogate.scene import NAMES

__all__ = ["MANY", "CommonTerms", "box_of", "common_model", "common_slip", "is_beyond"]

MANY = 2**14
"""Points from which to look for a common choice takes less time than to choose for each."""
_PIECES = 48
_ROUNDING = 1e-9  # relative, of all that is compared

Ends = tuple[Any, Any]
Box = dict[str, tuple[float, float]]


class CommonTerms(NamedTuple):
    """A kernel: friction and wear of one model at all points, or one of them at Eq. (13).

    Parameters
    ----------
    model : ForceModel
        The model, under its law.
    arc, load : bool
        Whether it gives wear, and friction.
    bound : float
        What the bound of its error is at most [-].
    """

    model: Any
    arc: bool
    load: bool
    bound: float

    @property
    def dtypes(self) -> tuple[Any, ...]:
        """What the kernel returns: friction, wear, and whether in the domain."""
        return float, float, bool

    def __call__(
        self, mu: Any, gamma: Any, radius: Any, xi: Any, wear: Any, alpha: Any
    ) -> tuple[Any, ...]:
        strengths = xi if self.load else 0.0, wear if self.arc else 0.0
        friction, worn = self.model.terms(mu, gamma, radius, *strengths, alpha)
        if not (self.load and self.arc):
            rubbed, estimate = FORCE_MODELS[FREE].terms(mu, gamma, radius, xi, wear, alpha)
            friction, worn = friction if self.load else rubbed, worn if self.arc else estimate
        return friction, worn, True


def box_of(values: tuple[Any, ...]) -> Box | None:
    """Return the ends of many scenes of one alpha; None of others, and where g has no limit.

    Examples
    --------
    >>> radii = np.linspace(1e-4, 2e-4, MANY)
    >>> box_of((685.0, 1.6, radii, 0.1, 7750.0, 2.0))["wire_radius"]
    (0.0001, 0.0002)
    >>> box_of((685.0, 1.6, radii[:9], 0.1, 7750.0, 2.0)) is None
    True
    """
    if type(values[5]) is not float or np.prod(common_shape(values)) < MANY:
        return None
    ends = ((v, v) if type(v) is float else (float(v.min()), float(v.max())) for v in values)
    box = dict(zip(NAMES, ends, strict=True))
    low, high = g_range(box)
    return box if box["shear_modulus"][0] > 0.0 and 0.0 < low <= high < np.inf else None


def common_model(known: Candidates, box: Box, rtol: float) -> CommonTerms | None:
    """Return the cheapest model that is exact enough, if that is one and the same at all points.

    Examples
    --------
    >>> from surrogate.choosing.candidates import candidates
    >>> box = box_of((685.0, 1.6, np.linspace(2e-4, 3e-4, MANY), 0.1, 7750.0, 2.5))
    >>> terms = common_model(candidates(), box, 0.02)
    >>> terms.model.name, terms.arc, terms.load
    ('table', True, True)
    """
    pieces = _Pieces.of(known, box)
    return None if pieces is None else _common(pieces, rtol)


def _common(pieces: _Pieces, rtol: float) -> CommonTerms | None:
    models, shares = pieces.known.models, pieces.shares()
    worst = [_times(*each) for each in zip(shares, pieces.errors(FREE), strict=True)]
    together = _plus(*worst)
    free = _is_below(together, rtol)
    if free:
        return CommonTerms(models[0], False, False, float(together[1].max()))
    alone = [_is_below(each, NEGLIGIBLE * rtol) for each in worst]
    if free is None or None in alone:
        return None
    left = _plus(*(_times(*each) for each in zip(worst, map(float, alone), strict=True)))  # type: ignore[arg-type]
    needed, most = [not each for each in alone], pieces.most(shares)
    for model in models[1:]:
        errors = pieces.errors(model.name)
        of: list[Any] = [e if need else 0.0 for e, need in zip(errors, needed, strict=True)]
        parts = _plus(*(_times(*each) for each in zip(most, of, strict=True)))
        worse = np.maximum(of[0], of[1])
        mean = np.minimum(parts[0], worse), np.minimum(parts[1], worse)
        bound = _plus(mean, left)
        met = _is_below(bound, rtol)
        if met:
            arc, load = needed
            return CommonTerms(model, arc, load, float(bound[1].max()))
        if met is None:
            return None
    return None


def common_slip(
    kappa: Amplification, known: Candidates, box: Box, rtol: float, part: float
) -> CommonTerms | None:
    """Return the model of the slip law, if that will do at all points, and solutions reach there.

    Parameters
    ----------
    kappa : Amplification
        What the law leaves out.
    known : Candidates
        The models of the slip law.
    box : dict
        See `box_of`.
    rtol, part : float
        Relative error that will do [-], and the share of it that the model may have.
    """
    pieces = _Pieces.of(known, box)
    terms = None if pieces is None else _common(pieces, part * rtol)
    if pieces is None or terms is None or uncovered(kappa, box) is not None:
        return None
    g, alpha = g_range(box), box["stiffening_exponent"]
    swing = np.expm1(bounds_over(kappa, g, alpha, box)[1])
    arc, load = (_times(*each) for each in zip(pieces.estimates, pieces.mosts(), strict=True))
    drag = arc[1] + load[1]
    error = np.maximum(
        drag * swing / (1.0 + swing + drag), drag * swing / (1.0 + drag * (1.0 + swing))
    )
    return terms if _is_below((error, error + terms.bound), rtol) else None


class _Pieces(NamedTuple):
    """Pieces of the range of g in a box: their cells, and the estimates of wear and friction."""

    known: Candidates
    cell: Any
    estimates: tuple[Ends, Ends]

    @classmethod
    def of(cls, known: Candidates, box: Box) -> _Pieces | None:
        """Return the pieces; None where they are not all inside the domain."""
        alpha, ends = box["stiffening_exponent"][0], g_range(box)
        low, high = ends[0] * (1.0 - _ROUNDING), ends[1] * (1.0 + _ROUNDING)
        if not all(known.limits.all_hold(g, alpha) is True for g in (low, high)):
            return None
        touch = known.bounds.touch
        inner = np.asarray(known.bounds.g[1:-1])
        inner = inner * np.exp(log_touch(touch, log(alpha))) if touch else inner
        inner = inner[(inner > low) & (inner < high)]
        edges = np.unique([*inner, *np.geomspace(low, high, _PIECES)])
        middle = np.sqrt(edges[:-1] * edges[1:])
        # so wide that what is rounded across an edge is in the pieces on either side
        far, near = 4.0 / (edges[:-1] * (1.0 - _ROUNDING)), 4.0 / (edges[1:] * (1.0 + _ROUNDING))
        tau, mu, xi = box["wear_strength"], box["shear_modulus"], box["friction_coefficient"]
        wear = near * (tau[0] / mu[1]), far * (tau[1] / mu[0])
        friction = (1.0 + near) * xi[0], (1.0 + far) * xi[1]
        return cls(known, known.bounds.cell(middle, np.full(middle.shape, alpha)), (wear, friction))

    def errors(self, model: str) -> list[Any]:
        """Return exp(e) - 1 of a model's two terms."""
        return [self.known.error(model, name)[self.cell] for name in self.known.terms]

    def mosts(self) -> list[Any]:
        """Return exp(e) of the estimates."""
        return [self.known.most(name)[self.cell] for name in self.known.terms]

    def shares(self) -> list[Ends]:
        """Return the estimates over the least that the force can be."""
        least = [self.known.least(name)[self.cell] for name in self.known.terms]
        (arc, load), (of_arc, of_load) = self.estimates, least
        return [_over(arc, load, of_arc, of_load), _over(load, arc, of_load, of_arc)]

    def most(self, shares: list[Ends]) -> list[Ends]:
        """Return the largest shares of the force that the terms can be."""
        ends = (_times(*each) for each in zip(shares, self.mosts(), strict=True))
        return [(np.minimum(low, 1.0), np.minimum(high, 1.0)) for low, high in ends]


def _over(own: Ends, other: Ends, of_own: Any, of_other: Any) -> Ends:
    """Return own/(1 + own of_own + other of_other), which rises with own and falls with other."""
    low, high = (
        mine / (1.0 + mine * of_own + others * of_other)
        for mine, others in zip(own, reversed(other), strict=True)
    )
    return low, high


def _times(ends: Ends, factor: Any) -> Ends:
    """Return the products, 0 where an end is and the factor perhaps infinite."""
    with np.errstate(invalid="ignore"):
        low, high = (np.where(np.equal(end, 0.0), 0.0, end * factor) for end in ends)
    return low, high


def _plus(first: Ends, second: Ends) -> Ends:
    return first[0] + second[0], first[1] + second[1]


def _is_below(ends: Ends, limit: float) -> bool | None:
    """Return whether numbers between ends are at most a limit, None where only some are."""
    if np.all(ends[1] <= limit * (1.0 - _ROUNDING)):
        return True
    return False if np.all(ends[0] > limit * (1.0 + _ROUNDING)) else None

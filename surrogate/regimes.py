"""Which term of Eq. (13) dominates a cut, and whether the wire touches the crack tip."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from surrogate.elementwise import apply, product, ratio
from surrogate.records import Record
from surrogate.scene import Scene, require_scene
from surrogate.validation import ABOVE_HALF, Quantity, one_number

__all__ = ["CONTACTS", "DOMINANCES", "Regime", "classify"]

DOMINANCES = ("transition", "toughness-and-friction", "wear", "friction-stiffness")
CONTACTS = ("far-field", "indentation")

DOMINANT_SHARE = 2.0 / 3.0
"""Share of the force from which a term dominates: twice as much as the others together."""

TOUCHING_TOUGHNESS = 1.0
"""g above which the wire touches the crack tip: J > mu R_w, below Eq. (5)."""

THRESHOLD = Quantity(
    "threshold", "", "give a share that only one term can have", lower=ABOVE_HALF, upper=1.0
)


@dataclass(frozen=True, slots=True, eq=False)
class Regime(Record):
    """The regime of a cut; see `classify`.

    Parameters
    ----------
    dominant : str or ndarray of str
        One of `DOMINANCES`: "toughness-and-friction", "wear", "friction-stiffness", or
        "transition" where no term dominates.
    contact : str or ndarray of str
        One of `CONTACTS`: "indentation" where the wire touches the crack tip, else "far-field".
    threshold : float
        Share of the force from which a term was taken to dominate [-].

    References
    ----------
    arXiv:2412.02021, sections 3 to 6.

    Examples
    --------
    >>> regime = classify(Scene(685.0, 1.6, [1e-6, 5e-5, 1e-2], wear_strength=7750.0))
    >>> regime.dominant.tolist()
    ['toughness-and-friction', 'transition', 'wear']
    >>> regime.contact.tolist()
    ['indentation', 'indentation', 'far-field']
    """

    dominant: str | NDArray[np.str_]
    contact: str | NDArray[np.str_]
    threshold: float


def classify(scene: Scene, threshold: float = DOMINANT_SHARE) -> Regime:
    """Return which term of Eq. (13) dominates, and whether the wire touches the crack tip.

    Parameters
    ----------
    scene : Scene
        What is cut and with which wire, in SI units.
    threshold : float, default 2/3
        Share of the force from which a term dominates [-]: more than 0.5, so that only one can,
        up to 1. The default asks for twice as much as the other terms together.

    Returns
    -------
    Regime
        `dominant` is "toughness-and-friction" for (1 + xi) Gamma_o, which the radius does not
        change, "wear" for 4 tau_w R_w, "friction-stiffness" for 4 xi mu R_w, and "transition"
        where none reaches the threshold or the force is 0 or overflows. `contact` is
        "indentation" for Gamma_o > mu R_w and "far-field" otherwise.

    Raises
    ------
    InputError
        If `scene` is not a `Scene`, or the threshold not a number above 0.5 and at most 1.

    Notes
    -----
    Range of validity: that of Eq. (13). The two answers do not depend on each other: the
    paper's gel is cut by wear while the wire indents the crack tip.

    References
    ----------
    arXiv:2412.02021, Eqs. (5) and (13), sections 4 to 6.

    Examples
    --------
    >>> regime = classify(Scene(685.0, 1.6, 0.25e-3, wear_strength=7750.0))
    >>> regime.dominant, regime.contact
    ('wear', 'indentation')
    >>> share = 4 * 7750.0 * 0.25e-3 / (1.6 + 4 * 7750.0 * 0.25e-3)
    >>> print(f"{share:.3f}")
    0.829
    """
    require_scene(scene)
    share = one_number(THRESHOLD, threshold)

    def codes(mu: Any, gamma: Any, radius: Any, xi: Any, wear: Any, alpha: Any) -> tuple[Any, Any]:
        terms = (gamma + xi * gamma, 4.0 * (wear * radius), 4.0 * product(radius, xi, mu))
        total = terms[0] + terms[1] + terms[2]
        # At most one comparison holds; 0/0 and inf/inf are nan, which makes none hold.
        dominant = sum(i * (ratio(term, total) >= share) for i, term in enumerate(terms, start=1))
        return dominant, gamma > TOUCHING_TOUGHNESS * (mu * radius)

    dominant, touching = apply(codes, scene.values(), (np.int8, bool))
    return Regime(_labels(DOMINANCES, dominant), _labels(CONTACTS, touching), share)


def _labels(names: tuple[str, ...], codes: Any) -> Any:
    if isinstance(codes, np.ndarray):
        return np.array(names)[codes.astype(np.intp)]
    return names[codes]

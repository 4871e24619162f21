"""What is known of a material besides the forces of its cuts: bounds, values, priors."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from surrogate import validation
from surrogate.cuts import limited
from surrogate.errors import InputError
from surrogate.validation import one_number, shown

__all__ = ["NOTHING_KNOWN", "Known", "known"]

Normal = tuple[float, float]

_TOUGHNESS = limited(validation.TOUGHNESS, smallest=0.0)
_WEAR_STRENGTH = limited(validation.WEAR_STRENGTH, smallest=0.0)
TOUGHNESS_MAX = replace(
    limited(validation.TOUGHNESS),
    name="toughness_max",
    remedy="give the toughness that Gamma_o cannot exceed, for instance that of pure shear",
)


@dataclass(frozen=True)
class Known:
    """Facts besides the forces.

    Parameters
    ----------
    toughness_max : float
        Largest Gamma_o that is admitted [J/m2]; infinite where none is known.
    wear_strength : float or None
        tau_w where it is known [Pa].
    toughness_prior, wear_strength_prior : tuple of float, or None
        Mean and standard deviation of a normal distribution [J/m2], [Pa].

    Examples
    --------
    >>> Known(wear_strength=7e3, toughness_prior=(2.0, 0.5)).facts
    2
    """

    toughness_max: float = math.inf
    wear_strength: float | None = None
    toughness_prior: Normal | None = None
    wear_strength_prior: Normal | None = None

    @property
    def facts(self) -> int:
        """How many equations it adds to those of the forces."""
        given = (self.wear_strength, self.toughness_prior, self.wear_strength_prior)
        return sum(fact is not None for fact in given)


NOTHING_KNOWN = Known()


def known(
    toughness_max: object,
    wear_strength: object,
    toughness_prior: object,
    wear_strength_prior: object,
    has_std: bool,
) -> Known:
    """Return validated facts; None means that there is none.

    Raises
    ------
    InputError
        If a number is out of range, a prior is not a pair, tau_w is given twice, or a prior is
        to be weighed against forces of unknown standard error.

    Examples
    --------
    >>> known(2.6, None, None, None, has_std=False).toughness_max
    2.6
    """
    if wear_strength is not None and wear_strength_prior is not None:
        raise InputError(
            "wear_strength and wear_strength_prior must not both be given: the one says that "
            "tau_w is known, the other that it is not; give one of them."
        )
    priors = (toughness_prior, wear_strength_prior)
    if any(prior is not None for prior in priors) and not has_std:
        raise InputError(
            "a prior needs force_std: without the forces' standard errors there is no saying how "
            "much it counts beside them; give force_std, or a bound instead of the prior."
        )
    return Known(
        math.inf if toughness_max is None else one_number(TOUGHNESS_MAX, toughness_max),
        None if wear_strength is None else one_number(_WEAR_STRENGTH, wear_strength),
        _normal("toughness_prior", _TOUGHNESS, toughness_prior),
        _normal("wear_strength_prior", _WEAR_STRENGTH, wear_strength_prior),
    )


def _normal(name: str, quantity: validation.Quantity, prior: object) -> Normal | None:
    if prior is None:
        return None
    if not isinstance(prior, (tuple, list)) or len(prior) != 2:
        raise InputError(
            f"{name} must be a pair, but {name} = {shown(prior)}; give mean and standard deviation."
        )
    remedy = "give mean and standard deviation"
    mean = replace(quantity, name=f"mean of {name}", remedy=remedy)
    std = limited(replace(quantity, name=f"standard deviation of {name}", remedy=remedy))
    return one_number(mean, prior[0]), one_number(std, prior[1])

"""What the forces leave open, in words, and the further wire that would tell most about it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from surrogate.basics.digits import below_digits
from surrogate.identification.estimate import Estimate
from surrogate.identification.further_wire import FurtherWire
from surrogate.inference.profile import Mode, Profile

__all__ = ["undecided", "wire_in_words"]

VAGUE = 3.0
"""Ratio of an interval's ends from which its quantity counts as undecided."""


NOTHING = 1e-6
"""Share of the larger toughness below which the smaller one is as good as 0."""


def undecided(fit: Estimate) -> Iterator[str]:
    """Yield one sentence for each question that the forces leave open.

    Parameters
    ----------
    fit : Estimate
        The identification to look at; without a `profile` there is nothing to say.

    Yields
    ------
    str
        What is not decided, with the numbers; last, the further wire that would tell most.
    """
    if fit.profile is None or (fit.is_exact and not fit.has_scatter):
        return
    sentences = [
        *_several(fit, fit.profile),
        *_toughness_ends(fit, fit.profile),
        *_wear_ends(fit, fit.profile),
        *_wide(fit),
    ]
    yield from sentences
    if sentences and fit.further_wire is not None:
        yield wire_in_words(fit.further_wire)


def wire_in_words(wire: FurtherWire) -> str:
    """Return which further wire would tell most, and how clearly."""
    low, high = wire.forces
    kind = "both materials" if wire.modes else "the ends of the toughness's interval"
    sentence = (
        f"a wire {2e3 * wire.wire_radius:.3g} mm across would tell most: {low:.4g} N/m for "
        f"Gamma_o = {_toughness(wire)} J/m2, {high:.4g} N/m for {wire.toughnesses[1]:.3g} "
        f"J/m2 ({kind}; a steel wire breaks at {wire.breaking_force:.2g} N; of those sold from "
        f"{2e3 * wire.searched[0]:.3g} to {2e3 * wire.searched[1]:.3g} mm)"
    )
    if np.isinf(wire.separation):
        return sentence
    if wire.separation >= 2.0:
        return f"{sentence}, {wire.separation:.1f} standard errors of one cut apart"
    if wire.cuts <= 1000:
        return (
            f"{sentence}, but only {wire.separation:.2g} standard errors of one cut apart: it "
            f"takes the mean of {wire.cuts:.0f} cuts to tell them by two"
        )
    return f"{sentence}, but no wire in that range tells them apart with a thousand cuts"


def _toughness(wire: FurtherWire) -> str:
    """Return the lower of the two toughnesses, 0 where it is next to nothing."""
    low, high = wire.toughnesses
    return f"{low:.3g}" if low > NOTHING * high else "0"


def _several(fit: Estimate, profile: Profile) -> Iterator[str]:
    admitted = [mode for mode in profile.modes if mode.admitted]
    if len(admitted) > 1:
        listed = "; ".join(_mode_in_words(fit, mode) for mode in admitted)
        yield f"{len(admitted)} materials fit the forces within the confidence asked for: {listed}"


def _mode_in_words(fit: Estimate, mode: Mode) -> str:
    misfit = "sum of squares" if fit.force_std is None else "chi^2"
    return (
        f"Gamma_o = {mode.toughness:.4g} J/m2 with tau_w = {1e-3 * mode.wear_strength:.4g} kPa "
        f"({misfit} {mode.misfit:.3g})"
    )


def _toughness_ends(fit: Estimate, profile: Profile) -> Iterator[str]:
    if not profile.toughness_intervals:
        return
    high = fit.toughness_interval[1]
    (first, last), (below, above) = profile.searched, fit.toughness_limited_by
    if below == "zero":
        up_to = profile.toughness_intervals[0][1]
        yield (
            f"the forces set no lower limit to the toughness: anything up to {up_to:.3g} J/m2 fits"
        )
    if below == "model":
        yield (
            f"the toughness may be smaller than {first:.3g} J/m2, where model '{fit.model}' ends "
            "for the thickest wire"
        )
    if above == "model":
        yield (
            f"the toughness may be larger than {last:.3g} J/m2, where model '{fit.model}' ends for "
            "the thinnest wire"
        )
    elif above == "bound":
        yield f"it is the bound of {high:.4g} J/m2, not the forces, that limits the toughness above"


def _wear_ends(fit: Estimate, profile: Profile) -> Iterator[str]:
    low, high = fit.wear_strength_interval
    if fit.known.wear_strength is not None:
        return
    if low == 0.0:
        up_to = 1e-3 * profile.wear_strength_intervals[0][1]
        yield f"whether the solid wears at all: any tau_w up to {up_to:.3g} kPa fits"
    if np.isinf(high):
        yield "the forces set no upper limit to the wear strength"


def _wide(fit: Estimate) -> Iterator[str]:
    for name, scale, unit, (low, high) in (
        ("toughness", 1.0, "J/m2", fit.toughness_interval),
        ("wear strength", 1e-3, "kPa", fit.wear_strength_interval),
    ):
        if VAGUE * low < high < np.inf and low > 0.0:
            lowest = "" if below_digits(low, 0.5 * (high - low)) else f"{scale * low:.3g}"
            yield (
                f"the {name} is only known to be "
                + (f"between {lowest} and" if lowest else "below")
                + f" {scale * high:.3g} {unit}"
            )

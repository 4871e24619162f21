"""An identification in a few lines: the answer first, with no more digits than it has."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from textwrap import wrap
from typing import Any

import numpy as np

from surrogate.basics.digits import below_digits, rounded, rounded_up
from surrogate.basics.records import number
from surrogate.choosing.by_name import FITTED_NAMES
from surrogate.choosing.laws import COUPLED, PROJECTED, SLIP
from surrogate.identification.doubts import fit_warnings, objections
from surrogate.identification.estimate import Estimate
from surrogate.identification.friction import forgotten_friction_in_words
from surrogate.identification.further_wire import forces_of
from surrogate.identification.open_questions import undecided
from surrogate.inference.inputs import DEFAULT_STIFFENING, NOTHING_KNOWN

__all__ = [
    "MOST_LINES",
    "against_use",
    "answer",
    "assumptions",
    "brief",
    "budget",
    "errors_of_wires",
    "is_answer",
    "law_in_words",
    "quantity_ranges",
    "rests_on",
    "summary",
]

MOST_LINES = 25
WIDTH = 96

SOURCES = {
    "scatter": "scatter",
    "model": "model",
    "shear_modulus": "mu",
    "friction_coefficient": "xi",
    "stiffening_exponent": "alpha",
    "sample": "samples",
}


def answer(fit: Estimate) -> str:
    """Return what goes into a paper.

    Examples
    --------
    >>> from surrogate.identification.fit import identify
    >>> print(answer(identify([1e-4, 2e-4, 4e-4, 5e-4], [4.7, 7.9, 13.9, 17.2], model="eq13")))
    Gamma_o = 1.63 (1.08 to 2.17) J/m2, tau_w = 7.75 (7.35 to 8.15) kPa, 95 %, 4 wires, model eq13
    """
    wires = np.unique(fit.wire_radius).size
    count = f"{wires} wire{'s' if wires > 1 else ''}"
    if fit.force.size > wires:
        count += f", {fit.force.size} cuts"
    about = f"{100.0 * fit.confidence:.4g} %, {count}, model {fit.model}{_law_of_name(fit)}"
    admitted = [mode for mode in fit.profile.modes if mode.admitted] if fit.profile else []
    if len(admitted) > 1:
        several = "; or ".join(
            f"Gamma_o = {number(mode.toughness, 3)} J/m2 with tau_w = "
            f"{number(1e-3 * mode.wear_strength, 3)} kPa"
            for mode in admitted
        )
        ranges = ", ".join(_quantities(fit))
        return f"{len(admitted)} materials fit: {several} (all that fits: {ranges}), {about}"
    return f"{', '.join(_quantities(fit))}, {about}"


def _law_of_name(fit: Estimate) -> str:
    """Return the law of a model that is a name and could be of another."""
    return ", law projected" if fit.model in FITTED_NAMES else ""


def _quantities(fit: Estimate) -> Iterator[str]:
    for symbol, unit, words in quantity_ranges(fit):
        yield f"{symbol} {words} {unit}"


def quantity_ranges(fit: Estimate) -> Iterator[tuple[str, str, str]]:
    """Yield symbol, unit and range in words of both quantities.

    Examples
    --------
    >>> from surrogate.identification.fit import identify
    >>> next(quantity_ranges(identify([1e-4, 2e-4, 4e-4], [4.7, 7.9, 13.8], model="eq13")))
    ('Gamma_o', 'J/m2', '= 1.7 (-0.3 to 3.8)')
    """
    several = fit.profile is not None and sum(mode.admitted for mode in fit.profile.modes) > 1
    for symbol, unit, scale, value, interval, limits in (
        ("Gamma_o", "J/m2", 1.0, fit.toughness, fit.toughness_interval, fit.toughness_limited_by),
        (
            "tau_w",
            "kPa",
            1e-3,
            fit.wear_strength,
            fit.wear_strength_interval,
            fit.wear_strength_limited_by,
        ),
    ):
        low, high = (scale * end for end in interval)
        if not fit.has_scatter and "given" not in limits:
            limits = ("unknown", "unknown")
        yield symbol, unit, _range(scale * value, low, high, limits, several)


def _range(value: float, low: float, high: float, limits: tuple[str, str], several: bool) -> str:
    """Return a value with its interval, or the one end that the forces decide."""
    below, above = limits[0] == "forces", limits[1] in ("forces", "zero")
    error = 0.5 * (high - low) if math.isfinite(high - low) else 0.5 * (value - low)
    if "given" in limits:
        return f"= {number(value)} (given)"
    if "unknown" in limits:
        return f"= {number(value)} (interval unknown)"
    if (not below and low <= 0.0) or (low < value and below_digits(low, error)):
        return f"< {rounded(high, error)}" if above or math.isfinite(high) else "is undecided:"
    if not above and not math.isfinite(high):
        return f"> {rounded(low, error)}"
    ends = f"{rounded(low, error)} to {rounded(high, error)}"
    if not above:
        ends += f", {limits[1]}"
    return ends if several else f"= {rounded(value, error)} ({ends})"


def assumptions(fit: Estimate) -> str:
    """Return what was given and what was assumed."""
    xi = "friction_coefficient" in fit.assumed
    parts = []
    if "shear_modulus" not in fit.assumed:
        parts.append(f"mu = {number(fit.shear_modulus)}{_plus(fit.shear_modulus_std)} Pa")
    parts.append(
        f"xi = {number(fit.friction_coefficient)}{_plus(fit.friction_std)}"
        + (" (assumed)" if xi else "")
    )
    alpha = " (assumed)" if "stiffening_exponent" in fit.assumed else ""
    parts.append(f"alpha = {number(fit.stiffening_exponent)}{_plus(fit.stiffening_std)}{alpha}")
    return f"With {', '.join(parts)}."


def _plus(std: float) -> str:
    return f" +- {number(std, 2)}" if std > 0.0 else ""


_LAWS = {
    PROJECTED: "projected, that of the paper",
    SLIP: "slip, to first order in friction and wear",
    COUPLED: "coupled, with friction and wear acting on the gel",
}


_ASSUMED = f"alpha was taken to be {number(DEFAULT_STIFFENING)}"


def law_in_words(fit: Estimate) -> str:
    """Return which law of friction and wear the numbers belong to, why, and how far it is off.

    Examples
    --------
    >>> from surrogate.identification.fit import identify
    >>> words = law_in_words(identify([1e-4, 2e-4, 4e-4], [4.7, 7.9, 13.8], model="eq13"))
    >>> print(words[:72])
    Law: projected, that of the paper; model 'eq13' has no other. How far it
    """
    head = f"Law: {_LAWS[fit.law]}; {fit.law_reason}"
    if "stiffening_exponent" in fit.assumed:
        head = head.replace(f"alpha = {number(fit.stiffening_exponent)} here", _ASSUMED)
    return f"{head}. {_law_error_in_words(fit)}."


def _law_error_in_words(fit: Estimate) -> str:
    if fit.known.wear_strength == 0.0 and fit.friction_coefficient == 0.0:
        return "Without friction and wear all laws are the same"
    if fit.law == COUPLED:
        return "The error of these solutions is part of the intervals"
    if fit.law_error > 0.0:
        share = rounded_up(100.0 * fit.law_error)
        return (
            f"Its forces are up to {share} % off beside coupled solutions, which is part of no "
            "interval"
        )
    return (
        "How far it is off nobody knows, and no interval contains it: tau_w is an effective "
        "strength, to be compared only with others of this law"
    )


def budget(fit: Estimate) -> str:
    """Return how much each source of error adds to the standard errors; empty where unknown."""
    parts = [
        f"{SOURCES[name]} {number(gamma, 2)} J/m2 and {number(1e-3 * tau, 2)} kPa"
        for name, (gamma, tau) in fit.contributions.items()
        if math.isfinite(gamma)
    ]
    if not parts or fit.at_limit or not fit.has_scatter:
        return ""
    return f"Standard errors come from: {'; '.join(parts)}.{_wires_apart(fit)}"


def errors_of_wires(fit: Estimate, share: float) -> tuple[float, float]:
    """Return standard errors of Gamma_o [J/m2] and tau_w [Pa] if wires are not as thick as told.

    Parameters
    ----------
    fit : Estimate
        An identification.
    share : float
        Standard error of each wire's radius over it [-], one for all of its cuts.

    Returns
    -------
    (float, float)
        To first order, nan where the force has no derivative.

    Examples
    --------
    >>> from surrogate.identification.fit import identify
    >>> fit = identify([1e-4, 4e-4], [4.7, 13.9], 685.0, model="eq13", force_std=[0.1, 0.3])
    >>> [round(error, 3) for error in errors_of_wires(fit, 0.02)]
    [0.116, 210.737]
    """
    gamma, tau = np.array([fit.toughness]), np.array([fit.wear_strength])
    radius, weight, model = fit.wire_radius, fit.cuts.weight, fit.tangent

    def of(gamma: Any, tau: Any, radius: Any) -> Any:
        return forces_of(model, fit.cuts, gamma, tau, radius)[0]

    def slope(step: float, other: Any) -> Any:
        return (other(1.0 + step) - other(1.0 - step)) / (2.0 * step)

    design = np.stack(
        [
            slope(_STEP, lambda by: of(by * gamma, tau, radius)) / gamma,
            slope(_STEP, lambda by: of(gamma, by * tau, radius)) / tau,
        ],
        axis=1,
    )
    along = slope(_STEP, lambda by: of(gamma, tau, by * radius))
    wires = np.stack([along * (radius == one) for one in np.unique(radius)], axis=1)
    columns = design * weight[:, np.newaxis]
    if not (np.isfinite(columns).all() and np.isfinite(wires).all()):
        return math.nan, math.nan
    moved = np.linalg.lstsq(columns, wires * weight[:, np.newaxis], rcond=None)[0]
    of_gamma, of_tau = share * np.linalg.norm(moved, axis=1)
    return float(of_gamma), float(of_tau)


def _wires_apart(fit: Estimate) -> str:
    """Say what the wires' own errors would add, where that is not little beside the rest.

    Where the scatter is that of one cut with each wire it has them in it.
    """
    if fit.known != NOTHING_KNOWN or min(fit.toughness, fit.wear_strength) <= 0.0:
        return ""
    if fit.force_std is None and fit.scatter is None:
        return ""
    errors = errors_of_wires(fit, _OF_WIRES)
    stds = np.sqrt(np.diag(fit.covariance))
    if not np.any(np.asarray(errors) > 0.5 * stds):
        return ""
    gamma, tau = errors
    return (
        f" Radii are taken as exact: if each wire's had a standard error of {100 * _OF_WIRES:g} %, "
        f"that would bring {number(gamma, 2)} J/m2 and {number(1e-3 * tau, 2)} kPa besides"
        f"{', however often you cut with it' if fit.scatter else ''}."
    )


_STEP = 1e-4
_OF_WIRES = 0.02
"""Standard error of a wire's radius that is usual [-]: 2 um of a wire 0.1 mm across."""


def against_use(sentences: Iterable[str]) -> list[str]:
    """Return what is printed before an answer that should not be used.

    Examples
    --------
    >>> against_use(["the toughness is negative"])
    ['Do not use the numbers below: the toughness is negative.']
    """
    return [f"Do not use the numbers below: {sentence}." for sentence in sentences]


def summary(fit: Estimate) -> str:
    """Return the answer, then doubts, then what it rests on, in at most 25 lines.

    What says that the answer should not be used comes before it.
    """
    against = list(objections(fit))
    remarks = [f"Warning: {s}." for s in fit_warnings(fit) if s not in against]
    remarks += [f"Undecided: {sentence}." for sentence in undecided(fit) if not against]
    return brief(
        [*against_use(against), f"{answer(fit)}.", *remarks],
        rests_on(fit),
        "fit.warnings and fit.undecided tell",
    )


def is_answer(sentence: str) -> bool:
    """Return whether a sentence on what is undecided says again what the answer says."""
    return "materials fit the forces" in sentence


def rests_on(fit: Estimate) -> list[str]:
    """Return sentences on the scatter, what was given or assumed, and the sources of error."""
    scatter = "" if fit.scatter is None else f"Scatter of a cut: {fit.scatter.words}."
    sentences = (
        law_in_words(fit),
        scatter,
        assumptions(fit),
        forgotten_friction_in_words(fit),
        budget(fit),
    )
    return [sentence for sentence in sentences if sentence]


def brief(first: list[str], last: list[str], where: str, most: int = MOST_LINES) -> str:
    """Return sentences as lines: as many of the first as there is room for, and all the last.

    Examples
    --------
    >>> print(brief(["a"] * 5, ["z"], "--verbose tells", most=4))
    a
    a
    ... and 3 more remarks, which --verbose tells.
    z
    """
    end = [line for sentence in last for line in _wrapped(sentence)]
    blocks = [_wrapped(sentence) for sentence in first]
    if sum(map(len, blocks)) + len(end) <= most:
        return "\n".join([line for block in blocks for line in block] + end)
    shown: list[str] = []
    count = 0
    for count, block in enumerate(blocks):  # noqa: B007
        if len(shown) + len(block) + 1 + len(end) > most:
            break
        shown += block
    left = len(blocks) - count
    return "\n".join([*shown, f"... and {left} more remarks, which {where}.", *end])


def _wrapped(sentence: str) -> list[str]:
    return wrap(sentence, WIDTH, subsequent_indent="  ")

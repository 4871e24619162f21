"""What each law of dissipation makes of the paper's forces, and which of its claims survive."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from textwrap import fill

import numpy as np

from fe_training.markdown import markdown_table
from surrogate import Identification
from surrogate.errors import InputError
from surrogate.inference.profile import Mode
from surrogate.reading.material import Material

__all__ = ["Verdict", "laws_sentences", "laws_table", "verdicts"]

NAMED = ("projected", "slip", "coupled")
Interval = tuple[float, float]


@dataclass(frozen=True)
class Verdict:
    """What one law says of a gel.

    Parameters
    ----------
    law : str
        What was asked for.
    used : str
        What was taken; empty where there is no answer.
    reason : str
        Why that, or why there is no answer.
    modes : tuple of Mode
        The materials that the forces admit.
    relative_wear : tuple of float
        tau_w/mu of each [-].
    is_work : str
        Whether tau_w = W_f is admitted.
    is_below : str
        Whether Gamma_o is below the toughness of pure shear.
    """

    law: str
    used: str
    reason: str
    modes: tuple[Mode, ...] = ()
    relative_wear: tuple[float, ...] = ()
    is_work: str = ""
    is_below: str = ""


def verdicts(
    identified: Callable[[str], Identification],
    modes: Callable[[Identification], Sequence[Mode]],
    gel: Material,
) -> list[Verdict]:
    """Return what every law says, "auto" last.

    Parameters
    ----------
    identified : callable
        Identifies the gel under a law.
    modes : callable
        Returns the minima that count.
    gel : Material
        With the toughness of pure shear and the work of fracture.
    """
    return [_verdict(law, identified, modes, gel) for law in (*NAMED, "auto")]


def _verdict(
    law: str,
    identified: Callable[[str], Identification],
    modes: Callable[[Identification], Sequence[Mode]],
    gel: Material,
) -> Verdict:
    try:
        fit = identified(law)
    except InputError as error:
        return Verdict(law, "", str(error).rpartition("; ")[0])
    profile = fit.profile
    assert profile is not None  # a fitted model is not linear
    known = tuple(modes(fit))
    return Verdict(
        law,
        fit.law,
        fit.law_reason,
        known,
        tuple(mode.wear_strength / fit.shear_modulus for mode in known),
        _is_admitted(profile.wear_strength_intervals, gel.work_of_fracture),
        _is_below(profile.toughness_intervals, gel.pure_shear_toughness),
    )


def _is_admitted(intervals: Sequence[Interval], value: float | None) -> str:
    if value is None:
        return "unknown"
    return "admitted" if any(low <= value <= high for low, high in intervals) else "excluded"


def _is_below(intervals: Sequence[Interval], value: float | None) -> str:
    if value is None:
        return "unknown"
    sides = {low < value for low, _ in intervals} | {high < value for _, high in intervals}
    return "open" if len(sides) > 1 else "yes" if True in sides else "no"


def laws_table(told: Sequence[Verdict]) -> str:
    """Return one line for each law, and why "auto" takes the one that it takes."""
    head = [r"$\Gamma_o$ [J/m²]", r"$\tau_w$ [kPa]", r"$\tau_w/\mu$"]
    rows = [
        [
            one.law if one.law == one.used or not one.used else f"{one.law}: {one.used}",
            *(cell or "-" for cell in (*_numbers(one), one.is_work, one.is_below)),
        ]
        for one in told
    ]
    table = markdown_table(["law", *head, r"$\tau_w = W_f$", r"$\Gamma_o < \Gamma$"], rows)
    auto = told[-1]
    why = f"`auto` takes {auto.used}: {auto.reason}."
    return f"{table}\n\n{why}"


def laws_sentences(told: Sequence[Verdict]) -> str:
    """Return the same in two sentences."""
    parts, without = [], []
    for one in told[:-1]:
        if not one.used:
            without.append(f"by {one.law} there is no answer, as {one.reason}")
            continue
        gamma, tau, _ = _numbers(one)
        parts.append(f"by {one.law} Gamma_o = {gamma} J/m2 with tau_w = {tau} kPa")
    auto, answers = told[-1], [one for one in told[:-1] if one.used]
    share = " or ".join(f"{x:.2g}" for x in auto.relative_wear)
    kind = ", an effective strength of unknown error" if auto.used == "projected" else ""
    words = (
        f"The same forces give {', '.join([*parts, *without])}. So `auto` takes {auto.used}, whose "
        f"tau_w is {share} mu{kind}; tau_w = W_f is "
        f"{_by_law({one.law: one.is_work for one in answers})}, and whether Gamma_o < Gamma "
        f"{_by_law({one.law: _IN_WORDS[one.is_below] for one in answers})}."
    )
    return fill(words, 100, break_on_hyphens=False)


_IN_WORDS = {"open": "is open", "yes": "is affirmed", "no": "is denied", "unknown": "is unknown"}


def _by_law(told: Mapping[str, str]) -> str:
    """Return what is told under which laws, once where it is the same under all."""
    same = set(told.values())
    if len(same) == 1:
        return f"{same.pop()} under {' and '.join(told)}"
    return ", ".join(f"{words} under {law}" for law, words in told.items())


def _numbers(one: Verdict) -> tuple[str, str, str]:
    gamma, tau = ([getattr(mode, name) for mode in one.modes] for name in _NAMES)
    return (
        " or ".join(f"{value:.3g}" for value in gamma),
        " or ".join(f"{value:.3g}" for value in 1e-3 * np.asarray(tau)),
        " or ".join(f"{value:.3g}" for value in one.relative_wear),
    )


_NAMES = ("toughness", "wear_strength")

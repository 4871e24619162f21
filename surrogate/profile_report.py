"""The minima of an identification, what it leaves open and the further wire, for both readers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict
from textwrap import fill
from typing import Any

from surrogate.identification import Identification
from surrogate.tables import number, table
from surrogate.undecided import wire_in_words

__all__ = ["profile_record", "profile_text"]


def profile_record(fit: Identification) -> dict[str, Any]:
    """Return minima, pieces of the intervals, what is undecided and the further wire.

    Examples
    --------
    >>> from surrogate.identification import identify
    >>> fit = identify([1e-4, 2e-4, 4e-4], [4.7, 7.9, 13.9], 685.0, model="eq13", toughness_max=1.0)
    >>> [round(mode["toughness"], 3) for mode in profile_record(fit)["modes"]]
    [1.0]
    """
    if fit.profile is None:
        return {}
    wire = fit.further_wire
    words = None if wire is None else wire_in_words(wire)
    return {
        "modes": [asdict(mode) for mode in fit.profile.modes],
        "misfit": "sum of squares" if fit.force_std is None else "chi^2",
        "toughness_intervals": fit.profile.toughness_intervals,
        "wear_strength_intervals": fit.profile.wear_strength_intervals,
        "known": asdict(fit.known),
        "undecided": [sentence for sentence in fit.undecided if sentence != words],
        "further_wire": None if wire is None else asdict(wire) | {"cuts": wire.cuts},
        "further_wire_words": words,
    }


def profile_text(record: Mapping[str, Any]) -> str:
    """Return what `profile_record` says, for people; nothing where it is empty."""
    if "modes" not in record:
        return ""
    sections = [_modes_text(record)]
    if pieces := _pieces_text(record):
        sections.append(pieces)
    sentences = [f"Undecided: {sentence}." for sentence in record["undecided"]]
    if record["further_wire_words"]:
        purpose = "To decide" if sentences else "To know more"
        sentences.append(f"{purpose}: {record['further_wire_words']}.")
    sections += [fill(sentence, 96, subsequent_indent="  ") for sentence in sentences]
    return "\n".join(sections)


def _modes_text(record: Mapping[str, Any]) -> str:
    header = ("Minimum of the misfit", "Gamma_o [J/m2]", "tau_w [kPa]", record["misfit"], "")
    rows = [
        (
            str(place),
            number(mode["toughness"]),
            number(1e-3 * mode["wear_strength"]),
            number(mode["misfit"]),
            _remark(place, mode),
        )
        for place, mode in enumerate(record["modes"], start=1)
    ]
    return table(header, rows)


def _remark(place: int, mode: Mapping[str, Any]) -> str:
    remark = "the estimate" if place == 1 else "possible" if mode["admitted"] else "excluded"
    return f"{remark}, at the end of the search" if mode["at_end"] else remark


def _pieces_text(record: Mapping[str, Any]) -> str:
    lines = []
    for name, unit, scale, key in (
        ("Gamma_o", "J/m2", 1.0, "toughness_intervals"),
        ("tau_w", "kPa", 1e-3, "wear_strength_intervals"),
    ):
        pieces: Sequence[tuple[float, float]] = record[key]
        if len(pieces) > 1:
            listed = " or ".join(
                f"{number(scale * low)} to {number(scale * high)}" for low, high in pieces
            )
            lines.append(f"{name} is in one of {len(pieces)} intervals: {listed} {unit}")
    return "\n".join(lines)

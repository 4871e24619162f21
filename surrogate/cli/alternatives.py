"""What other assumptions make of the same forces: Eq. (13), Gamma_o <= Gamma, tau_w = W_f.

The paper takes A = 2 at every toughness and finds Gamma_o below the toughness Gamma of pure shear
and tau_w close to the work of fracture W_f. Another A may say otherwise.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import asdict
from typing import Any

from surrogate.basics.records import UNKNOWN, number, table
from surrogate.choosing.by_name import force_model
from surrogate.choosing.laws import LAWS, PROJECTED
from surrogate.contact.base import ForceModel
from surrogate.contact.fitted import FittedModel
from surrogate.errors import DomainError, InputError
from surrogate.identification.fit import Identification, identify
from surrogate.identification.friction import SUPPOSED
from surrogate.inference.inputs import NOTHING_KNOWN
from surrogate.reading.material import Material

__all__ = ["alternatives_record", "alternatives_text", "friction_records"]

Intervals = tuple[tuple[float, float], ...]

PAPER = "eq13"


def alternatives_record(fit: Identification, material: Material) -> dict[str, Any]:
    """Return the same forces identified under other assumptions, and what that says in words.

    Parameters
    ----------
    fit : Identification
        By any model but the paper's own, with nothing known besides the forces.
    material : Material
        With Gamma and W_f, as far as they are known.

    Returns
    -------
    dict
        Empty where there is nothing to compare with.

    Examples
    --------
    >>> radius, force = [1e-4, 2e-4, 4e-4, 5e-4], [4.7, 7.9, 13.9, 17.2]
    >>> fit = identify(radius, force, 685.0)
    >>> record = alternatives_record(fit, Material(work_of_fracture=7e3))
    >>> [one["assumption"] for one in record["alternatives"]]
    ['Eq. (13)', 'law slip', 'tau_w = W_f = 7 kPa']
    """
    if fit.profile is None or fit.model == PAPER or fit.known != NOTHING_KNOWN:
        return {}
    paper = _again(fit, PAPER, PROJECTED)
    alternatives = [_row("Eq. (13)", paper, None)]
    verdicts: list[str] = []
    for law in LAWS:
        if law != fit.law and isinstance(force_model(fit.model), FittedModel):
            with suppress(InputError):  # the models in use do not know it, or not these loads
                other = _again(fit, force_model(fit.model).name, law)
                alternatives.append(_row(f"law {law}", other, None))
    if (gamma := material.pure_shear_toughness) is not None and gamma > 0.0:
        words = f"Gamma_o <= Gamma = {number(gamma)} J/m2"
        alternatives += _rows(words, fit, verdicts, toughness_max=gamma)
        verdicts.extend(_of_toughness(fit.profile.toughness_intervals, gamma))
    if (work := material.work_of_fracture) is not None and work > 0.0:
        words = f"tau_w = W_f = {number(1e-3 * work)} kPa"
        alternatives += _rows(words, fit, verdicts, wear_strength=work)
        verdicts.extend(_of_wear(fit.profile.wear_strength_intervals, work))
    return {"alternatives": alternatives, "verdicts": verdicts}


def _rows(
    words: str, fit: Identification, verdicts: list[str], **known: float
) -> Iterator[dict[str, Any]]:
    """Yield the same law with something known, or say that its solutions do not reach there."""
    try:
        yield _row(words, _again(fit, fit.model, fit.law, **known), fit)
    except DomainError:
        verdicts.append(f"With {words} some cuts are beyond what coupled solutions reach")


def friction_records(fit: Identification) -> list[dict[str, Any]]:
    """Return what other friction coefficients would make of forces that have a modulus.

    Examples
    --------
    >>> fit = identify([1e-4, 2e-4, 4e-4, 5e-4], [4.7, 7.9, 13.9, 17.2], 30e3, model="eq13")
    >>> [record["fits"] for record in friction_records(fit)]
    [True, False]
    """
    if "shear_modulus" in fit.assumed:
        return []
    records = []
    for xi in SUPPOSED:
        with suppress(DomainError):  # where coupled solutions do not reach with this friction
            records.append(asdict(fit.with_friction(xi)))
    return records


def alternatives_text(record: Mapping[str, Any]) -> str:
    """Return what `alternatives_record` says, for people; nothing where it is empty."""
    if "alternatives" not in record:
        return ""
    header = ("The same forces under", "Gamma_o [J/m2]", "tau_w [kPa]", record["misfit"], "")
    rows = [
        (
            one["assumption"],
            number(one["toughness"]),
            number(1e-3 * one["wear_strength"]),
            number(one["misfit"], digits=3),
            _remark(one),
        )
        for one in record["alternatives"]
    ]
    return "\n".join([table(header, rows), *(f"{verdict}." for verdict in record["verdicts"])])


def _remark(one: Mapping[str, Any]) -> str:
    if one["model"] == PAPER:
        return "another model"
    if one["assumption"] == f"law {one['law']}":
        return "another law"
    return {None: UNKNOWN, True: "possible", False: "excluded"}[one["admitted"]]


def _again(fit: Identification, model: str | ForceModel, law: str, **known: Any) -> Identification:
    cuts = fit.cuts
    return identify(
        cuts.wire_radius,
        cuts.force,
        cuts.shear_modulus,
        friction_coefficient=cuts.friction_coefficient,
        stiffening_exponent=cuts.stiffening_exponent,
        shear_modulus_std=cuts.shear_modulus_std,
        friction_std=cuts.friction_std,
        stiffening_std=cuts.stiffening_std,
        sample=cuts.sample,
        force_std=cuts.force_std,
        model=model,
        confidence=fit.confidence,
        law=law,
        **known,
    )


def _row(words: str, other: Identification, free: Identification | None) -> dict[str, Any]:
    """Return an alternative; whether it is admitted beside the free fit of the same model."""
    misfit = float(((other.cuts.weight * other.residuals) ** 2).sum())
    if other.profile is not None:  # with what the forces share, as the threshold has it
        misfit = other.profile.modes[0].misfit
    if misfit <= 1e-24 * float(((other.cuts.weight * other.force) ** 2).sum()):
        misfit = 0.0  # nothing but rounding
    admitted = None
    if free is not None and free.profile is not None and not math.isnan(free.profile.threshold):
        admitted = misfit <= free.profile.threshold
    return {
        "assumption": words,
        "model": str(other.model),
        "law": other.law,
        "toughness": other.toughness,
        "toughness_interval": other.toughness_interval,
        "wear_strength": other.wear_strength,
        "wear_strength_interval": other.wear_strength_interval,
        "misfit": misfit,
        "admitted": admitted,
    }


def _of_toughness(intervals: Intervals, gamma: float) -> Iterator[str]:
    if not intervals:
        return
    below = any(low < gamma for low, _ in intervals)
    above = any(high > gamma for _, high in intervals)
    symbol = f"Gamma = {number(gamma)} J/m2"
    if below and above:
        yield f"Whether Gamma_o is below {symbol} is not decided: the forces admit both"
    else:
        yield f"Gamma_o is {'below' if below else 'above'} {symbol}, as far as the model holds"


def _of_wear(intervals: Intervals, work: float) -> Iterator[str]:
    if not intervals:
        return
    symbol = f"tau_w = W_f = {number(1e-3 * work)} kPa"
    if any(low <= work <= high for low, high in intervals):
        yield f"{symbol} is among what the forces admit"
        return
    low, high = intervals[0][0], intervals[-1][1]
    yield (
        f"{symbol} is not among what the forces admit: tau_w is {number(low / work, digits=3)} to "
        f"{number(high / work, digits=3)} times W_f"
    )

"""The engine's own studies: what each of them solves, and what it holds against which bound.

A study is a list of cases, configurations with the settings to solve them with, and findings made
of their records.  Studies that compare settings share their reference with the study `range`: the
default settings at the same g.  Nothing is solved here, see :mod:`fe_training.verification.run`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from fe_training.mechanics.analytic import (
    far_field_wedge,
    point_force_energy_release_rate,
)
from fe_training.solver.cut import Settings
from fe_training.solver.record import (
    EVIDENCE_BOUND,
    EVIDENCE_G,
    FAR_FIELD_BOUND,
    Outcome,
    Record,
)
from fe_training.verification.cases import (
    HIGHEST_ALPHA,
    LARGEST_G,
    LOWEST_ALPHA,
    Case,
    Scope,
    Solved,
    check_cases,
    extent,
    range_cases,
    variants,
)

__all__ = ["Finding", "Measure", "StudyResult", "judged"]

#: Largest relative difference between the wanted and the reached g.
_G_BOUND = 1e-3


#: Between two meshes: relative in B, absolute in A, relative in J at equal distance up to a g.
_MESH_B, _MESH_A, _MESH_J, _MESH_J_LARGEST_G = 5e-3, 0.01, 3e-3, 1.0


#: Between the two largest bodies, relative in B.
_TRUNCATION_B = 3e-3


#: Between spacings of the contact, absolute in A.
_CONTACT_A = 5e-3


#: Relative, of -2 dU/dc and of the point force's J in the far field.
_SHIFT_J, _POINT_FORCE_J = 1e-2, 1e-2


#: Differences of B below this are within what the search for g leaves open.
_NOISE = 2e-4


_EQUAL_FORCES, _SPREAD = "|J-2F_h|/J", "spread of J"


@dataclass(frozen=True, slots=True)
class Measure:
    """One number of a finding, with its bound.

    Parameters
    ----------
    name : str
        What was measured.
    value : float
        The number, nan where it could not be measured.
    bound : float, optional
        The largest value allowed; without one the number is only reported.

    Examples
    --------
    >>> Measure("B", 0.004, 0.005).passed, Measure("B", math.nan, 0.005).passed
    (True, False)
    """

    name: str
    value: float
    bound: float | None = None

    @property
    def passed(self) -> bool | None:
        """Whether the bound is kept; None without a bound."""
        return None if self.bound is None else bool(self.value <= self.bound)


@dataclass(frozen=True, slots=True)
class Finding:
    """One row of a study's table.

    Parameters
    ----------
    study : str
        The study.
    variant : str
        What is compared with the default settings, or what is checked.
    alpha, g : float
        The configuration; g is the wanted one, nan where a distance was wanted.
    outcome : str
        How the computation ended, the worse one of two.
    measures : tuple of Measure
        What was measured.
    passed : bool or None
        Whether all bounds are kept; None where there are none, or where nothing is solved yet.
    data : dict of str to float
        Further columns.
    note : str
        The engine's reason where the configuration was not reached.
    """

    study: str
    variant: str
    alpha: float
    g: float
    outcome: str
    measures: tuple[Measure, ...]
    passed: bool | None
    data: Mapping[str, float] = field(default_factory=dict)
    note: str = ""

    @property
    def solved(self) -> bool:
        """Whether all that the finding needs has been solved."""
        return self.outcome != _NOT_SOLVED


@dataclass(frozen=True, slots=True)
class StudyResult:
    """The findings of a study.

    Parameters
    ----------
    name : str
        The study.
    findings : tuple of Finding
        One for each row.
    facts : dict of str to float
        Numbers that were fitted to all rows.
    """

    name: str
    findings: tuple[Finding, ...]
    facts: Mapping[str, float] = field(default_factory=dict)

    @property
    def passed(self) -> bool:
        """Whether all is solved and no bound is broken."""
        return all(one.solved and one.passed is not False for one in self.findings)


_NOT_SOLVED = "not solved"


def judged(study: str, scope: Scope, solved: Mapping[str, Solved]) -> StudyResult:
    """Return the findings of a study.

    Parameters
    ----------
    study : str
        Its name.
    scope : Scope
        What it covers.
    solved : dict of str to Solved
        The solutions by the keys of their cases; what is missing is named in the findings.

    Returns
    -------
    StudyResult
    """
    if study == "range":
        return StudyResult(study, tuple(_in_range(case, solved) for case in range_cases(scope)))
    if study == "checks":
        return StudyResult(study, tuple(_checked(case, solved) for case in check_cases(scope)))
    findings = tuple(_compared(study, scope, solved))
    facts = _truncation_facts(findings) if study == "truncation" else {}
    return StudyResult(study, findings, facts)


def _all_passed(measures: Iterable[Measure]) -> bool | None:
    verdicts = [one.passed for one in measures if one.passed is not None]
    return all(verdicts) if verdicts else None


def _in_range(case: Case, solved: Mapping[str, Solved]) -> Finding:
    """Return the finding on one configuration of the range or beyond it."""
    assert case.g is not None
    inside = LOWEST_ALPHA <= case.alpha <= HIGHEST_ALPHA and case.g <= LARGEST_G
    row, variant = solved.get(case.key), "" if inside else "beyond the range"
    if row is None:
        return Finding("range", variant, case.alpha, case.g, _NOT_SOLVED, (), None)
    record = row.record
    bound = EVIDENCE_BOUND if case.g >= EVIDENCE_G else FAR_FIELD_BOUND
    mismatch = record.force_mismatch if row.reached else math.nan
    measures = (
        Measure(_EQUAL_FORCES, mismatch, bound if inside else None),
        Measure("|J/g-1|", abs(record.energy_release_rate / case.g - 1), _G_BOUND * inside or None),
        Measure(_SPREAD, record.support_spread if row.reached else math.nan),
    )
    converged = record.outcome is Outcome.CONVERGED
    if inside:
        passed = bool(_all_passed(measures)) and converged
    else:  # an outcome that says what is wrong will do
        passed = not row.error and (not converged or mismatch <= bound)
    data = {
        "A": record.arc,
        "B": record.normal_load,
        "delta/R_w": record.distance,
        "iterations": record.iterations,
        "unknowns": record.unknowns,
        "time [s]": record.wall_time,
        "min det F": record.min_determinant,
        "max stretch": record.max_stretch,
    }
    return Finding(
        "range", variant, case.alpha, case.g, row.outcome, measures, passed, data, record.reason
    )


class _Curve:
    """The records of a path by their wanted g, to be compared with those of another path."""

    def __init__(self, records: Mapping[float, Record]) -> None:
        self.records = dict(sorted(records.items()))

    def slope(self, y: Callable[[Record], float], x: Callable[[Record], float], g: float) -> float:
        """Return dy/dx at a wanted g; nan on a path of a single record, or where x stands still."""
        if len(self.records) < 2:
            return math.nan
        ys, xs = ([of(one) for one in self.records.values()] for of in (y, x))
        with np.errstate(divide="ignore", invalid="ignore"):
            return float(np.gradient(ys, xs)[list(self.records).index(g)])

    def at(self, y: Callable[[Record], float], g: float) -> float:
        """Return y at exactly the wanted g: what the search left open is taken out."""
        record = self.records[g]
        slope = self.slope(y, _log_rate, g)
        left = math.log(g) - _log_rate(record)
        return y(record) + (slope * left if math.isfinite(slope) else 0.0)


def _log_rate(record: Record) -> float:
    return math.log(record.energy_release_rate)


def _log_distance(record: Record) -> float:
    return math.log(record.distance)


def _log_load(record: Record) -> float:
    return math.log(record.normal_load)


def _arc(record: Record) -> float:
    return record.arc


def _compared(study: str, scope: Scope, solved: Mapping[str, Solved]) -> Iterator[Finding]:
    """Yield the findings of a study that compares settings, one for each variant, alpha and g."""
    alphas, gs = extent(study, scope)

    def rows(name: str, alpha: float, settings: Settings) -> dict[float, Solved]:
        keys = {g: Case(name, alpha, settings, g).key for g in gs}
        return {g: solved[key] for g, key in keys.items() if key in solved}

    for number, (variant, settings) in enumerate(variants(study, scope)):
        for alpha in alphas:
            sides = [rows("range", alpha, scope.base), rows(study, alpha, settings)]
            curves = [
                _Curve({g: one.record for g, one in side.items() if one.reached}) for side in sides
            ]
            for g in gs:
                found = [side.get(g) for side in sides]
                measures, data = _differences(curves[0], curves[1], g)
                measures = _bounded(study, number, g, measures)
                if study == "truncation":
                    data["L/R_w"] = settings.outer_radius
                    data["L/R_w of the default"] = scope.base.outer_radius
                names = ("default", variant)
                outcome, note = _worse(names, found)
                passed = None if outcome == _NOT_SOLVED else _all_passed(measures)
                yield Finding(study, variant, alpha, g, outcome, measures, passed, data, note)


def _differences(
    base: _Curve, other: _Curve, g: float
) -> tuple[tuple[Measure, ...], dict[str, float]]:
    """Return how far two paths are apart at a wanted g, and what they have there."""
    if g not in base.records or g not in other.records:
        return tuple(Measure(name, math.nan) for name in _COMPARED), {}
    first, second = base.records[g], other.records[g]
    log_B = other.at(_log_load, g) - base.at(_log_load, g)
    # J of the other path carried along the base path to the distance that the base has
    log_J = _log_rate(second) - _log_rate(first)
    log_J -= base.slope(_log_rate, _log_distance, g) * (
        _log_distance(second) - _log_distance(first)
    )
    values = (
        abs(math.expm1(log_B)),
        abs(other.at(_arc, g) - base.at(_arc, g)),
        abs(math.expm1(log_J)),
        second.force_mismatch,
    )
    data = {
        "signed dB/B": math.expm1(log_B),
        "A": second.arc,
        "B": second.normal_load,
        "delta/R_w": second.distance,
        "unknowns": second.unknowns,
        "time [s]": second.wall_time,
    }
    return tuple(map(Measure, _COMPARED, values)), data


_COMPARED = ("|dB|/B", "|dA|", "|dJ|/J at equal delta", _EQUAL_FORCES)


def _bounded(study: str, number: int, g: float, measures: Sequence[Measure]) -> tuple[Measure, ...]:
    """Return the measures with the bounds of the study; `number` counts its variants."""
    load, arc, rate, _ = _COMPARED
    bounds: dict[str, float] = {}
    if study == "mesh":
        bounds = {load: _MESH_B, arc: _MESH_A}
        if g <= _MESH_J_LARGEST_G:
            bounds[rate] = _MESH_J
    elif study == "truncation" and number == 0:  # the two largest bodies
        bounds = {load: _TRUNCATION_B}
    elif study == "contact":
        bounds = {arc: _CONTACT_A}
    return tuple(replace(one, bound=bounds.get(one.name)) for one in measures)


def _worse(names: Sequence[str], rows: Sequence[Solved | None]) -> tuple[str, str]:
    """Return the outcome of two solutions, with the name and reason of one that was not reached."""
    outcome = "converged"
    for name, row in zip(names, rows, strict=True):
        if row is None:
            return _NOT_SOLVED, ""
        if not row.reached:
            return row.outcome, f"{name}: {row.record.reason}"
        if row.record.outcome is not Outcome.CONVERGED:
            outcome = row.outcome
    return outcome, ""


def _truncation_facts(findings: Sequence[Finding]) -> dict[str, float]:
    """Return the factor c of |dB|/B = c sqrt(g R_w/L) and the exponent that the data have.

    A body of radius L is compared with a larger one, which has an error of its own: both are in
    the fit.  Differences that the search for g leaves open are left out.
    """
    rows = []
    for one in findings:
        value = one.measures[0].value if one.measures else math.nan
        if value > _NOISE:
            small, large = one.data["L/R_w"], one.data["L/R_w of the default"]
            rows.append((value, one.g / small, one.g / large))
    if not rows:
        return {}
    change, ratio, left = np.array(rows).T
    law = np.sqrt(ratio) - np.sqrt(left)
    factors = change / law
    facts = {
        "factor c, median": float(np.median(factors)),
        "factor c, smallest": float(factors.min()),
        "factor c, largest": float(factors.max()),
        "rows in the fit": len(rows),
    }
    if np.ptp(np.log(law)) > 0.5:
        slope = float(np.polyfit(np.log(law), np.log(change), 1)[0])
        facts["exponent of g R_w/L, 0.5 in the law"] = 0.5 * slope
    return facts


def _checked(case: Case, solved: Mapping[str, Solved]) -> Finding:
    """Return the finding on J by a true shift, or on the far field."""
    g = math.nan if case.g is None else case.g
    variant = "shift of the tip" if case.shift else f"delta = {case.distance:g} R_w"
    row = solved.get(case.key)
    if row is None:
        return Finding("checks", variant, case.alpha, g, _NOT_SOLVED, (), None)
    record = row.record
    J, delta = record.energy_release_rate, record.distance
    if case.shift:
        shifted = record.energy_release_rate_shift
        measures = [Measure("|-2dU/dc / J - 1|", abs(shifted / J - 1), _SHIFT_J)]
    else:
        if row.reached:
            point = float(np.asarray(point_force_energy_release_rate(record.normal_load, delta)))
            wedge = far_field_wedge(delta)
            limits = [
                float(np.asarray(value))
                for value in (wedge.vertical_force, wedge.contact_width, wedge.energy_release_rate)
            ]
        else:
            point, limits = math.nan, [math.nan] * 3
        measures = [Measure("|J / (F_v^2/(2 pi delta)) - 1|", abs(J / point - 1), _POINT_FORCE_J)]
        results = zip("BAJ", (record.normal_load, record.arc, J), limits, strict=True)
        measures += [
            Measure(f"|{name} / wedge - 1|", abs(value / limit - 1))
            for name, value, limit in results
        ]
    data = {
        "J/(mu R_w)": J,
        "A": record.arc,
        "B": record.normal_load,
        "delta/R_w": delta,
        "time [s]": record.wall_time,
    }
    verdict = _all_passed(measures)
    return Finding(
        "checks", variant, case.alpha, g, row.outcome, tuple(measures), verdict, data, record.reason
    )

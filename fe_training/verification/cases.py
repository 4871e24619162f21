"""What the studies solve: cases with their settings, the scope, and what was solved of them."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import asdict, dataclass, replace
from typing import Any

from fe_training.solver.cut import RESOLUTIONS, Settings
from fe_training.solver.record import (
    Record,
)
from surrogate.errors import InputError

__all__ = [
    "HIGHEST_ALPHA",
    "LARGEST_G",
    "LOWEST_ALPHA",
    "STUDIES",
    "Case",
    "Scope",
    "Solved",
    "cases_of",
    "check_cases",
    "extent",
    "full_scope",
    "quick_scope",
    "range_cases",
    "variants",
]

#: Names of the studies with what each one asks.
STUDIES: Mapping[str, str] = {
    "range": "Is every exponent and toughness reached, with J = 2 F_h?",
    "mesh": "Do the standard and the fine mesh agree?",
    "truncation": "Does the radius of the body matter?",
    "contact": "Does the spacing of the nodes under the contact matter?",
    "parameters": "Do the other parameters of the discretisation matter?",
    "checks": "Do a true shift of the tip and the far field confirm J?",
}


#: Exponents for which the bounds are meant.
LOWEST_ALPHA, HIGHEST_ALPHA = 2.0, 9.0


LARGEST_G = 100.0


@dataclass(frozen=True, slots=True)
class Case:
    """One configuration to be solved for a study.

    Parameters
    ----------
    study : str
        The study that the solution belongs to.
    alpha : float
        Strain-stiffening exponent [-].
    settings : Settings
        How it is solved.
    g : float, optional
        Wanted J/(mu R_w) [-]; or
    distance : float, optional
        wanted distance delta from the wire's centre to the tip [R_w].
    shift : bool
        Whether -2 dU/dc is wanted as well.

    Examples
    --------
    >>> Case("range", 5.0, Settings(), g=1.0).key == Case("mesh", 5.0, Settings(), g=1.0).key
    False
    """

    study: str
    alpha: float
    settings: Settings
    g: float | None = None
    distance: float | None = None
    shift: bool = False

    @property
    def key(self) -> str:
        """All fields, those of the settings included, as a line of JSON."""
        return json.dumps(asdict(self), sort_keys=True)


@dataclass(frozen=True, slots=True)
class Solved:
    """What came of a case.

    Parameters
    ----------
    record : Record
        The record, without its profiles.
    engine : str
        Fingerprint of the engine that solved it.
    error : bool
        Whether the engine raised an error instead of returning a named outcome.
    """

    record: Record
    engine: str = ""
    error: bool = False

    @property
    def reached(self) -> bool:
        """Whether there is an equilibrium."""
        return math.isfinite(self.record.energy_release_rate)

    @property
    def outcome(self) -> str:
        """How it ended, in lower case."""
        return "error" if self.error else self.record.outcome.name.lower().replace("_", " ")


@dataclass(frozen=True, slots=True)
class Scope:
    """What the studies cover.

    Parameters
    ----------
    base : Settings
        The settings that are verified.
    alphas, gs : tuple of float
        The range.
    beyond_gs : tuple of float
        Toughnesses beyond the range, for each of `alphas`.
    beyond_alphas, beyond_alpha_gs : tuple of float
        Exponents beyond the range and the toughnesses for them.
    mesh_alphas, mesh_gs : tuple of float
        Exponents and toughnesses of the study `mesh`; all toughnesses that are compared are
        among `gs`.
    compared_alphas, compared_gs : tuple of float
        Those of `truncation` and `contact`; the exponents are also those of `checks`.
    parameter_alphas, parameter_gs : tuple of float
        Those of `parameters`.
    shift_gs : tuple of float
        Toughnesses of the shift in `checks`.
    radii : tuple of float
        Radii of the body to compare with, relative to that of `base`.
    spacings : tuple of float
        The same for the spacing of the contact.
    parameters : tuple of (str, float)
        Fields of the settings and their values, relative to those of `base`.
    far_distance : float
        Distance of the far field's check [R_w].
    """

    base: Settings
    alphas: tuple[float, ...]
    gs: tuple[float, ...]
    beyond_gs: tuple[float, ...]
    beyond_alphas: tuple[float, ...]
    beyond_alpha_gs: tuple[float, ...]
    mesh_alphas: tuple[float, ...]
    mesh_gs: tuple[float, ...]
    compared_alphas: tuple[float, ...]
    compared_gs: tuple[float, ...]
    parameter_alphas: tuple[float, ...]
    parameter_gs: tuple[float, ...]
    shift_gs: tuple[float, ...]
    radii: tuple[float, ...]
    spacings: tuple[float, ...]
    parameters: tuple[tuple[str, float], ...]
    far_distance: float = 50.0

    def of(self, alphas: Iterable[float]) -> Scope:
        """Return the scope with these exponents instead of its own.

        Those beyond the range are for the study `range` only.
        """
        chosen = sorted(set(alphas))
        inside = tuple(a for a in chosen if LOWEST_ALPHA <= a <= HIGHEST_ALPHA)
        return replace(
            self,
            alphas=inside,
            mesh_alphas=inside,
            compared_alphas=inside,
            parameter_alphas=inside,
            beyond_alphas=tuple(a for a in chosen if a not in inside),
            beyond_alpha_gs=self.beyond_alpha_gs or self.gs,
        )


def full_scope(base: Settings | None = None) -> Scope:
    """Return what the studies cover, with the engine's default settings unless others are given."""
    return Scope(
        base=base or Settings(),
        alphas=(2.0, 3.0, 5.0, 9.0),
        gs=(0.0025, 0.02, 0.05, 0.5, 1.0, 5.0, 10.0, 30.0, 100.0),
        beyond_gs=(300.0,),
        beyond_alphas=(1.5, 12.0, 15.0),
        beyond_alpha_gs=(0.1, 1.0, 10.0),
        mesh_alphas=(2.0, 5.0, 9.0),
        mesh_gs=(0.0025, 0.05, 0.5, 1.0, 10.0, 30.0),
        compared_alphas=(2.0, 5.0, 9.0),
        compared_gs=(0.0025, 0.05, 1.0, 10.0, 30.0),
        parameter_alphas=(2.0, 9.0),
        parameter_gs=(0.05, 1.0, 10.0),
        shift_gs=(0.02, 0.5, 10.0),
        radii=(0.1, 0.01, 0.001),
        spacings=(0.7, 2.0),
        parameters=(
            *(("bulk", 0.5), ("bulk", 2.0), ("polar", 0.5), ("polar", 2.0)),
            *(("notch_radius", 0.4), ("scatter", 0.5)),
        ),
    )


def quick_scope() -> Scope:
    """Return a scope of coarse meshes and few configurations, which need not keep the bounds."""
    gs = (0.5, 2.0)
    return Scope(
        base=RESOLUTIONS["coarse"],
        alphas=(5.0,),
        gs=gs,
        beyond_gs=(),
        beyond_alphas=(),
        beyond_alpha_gs=(),
        mesh_alphas=(5.0,),
        mesh_gs=gs,
        compared_alphas=(5.0,),
        compared_gs=gs,
        parameter_alphas=(5.0,),
        parameter_gs=gs,
        shift_gs=gs[1:],
        radii=(0.1,),
        spacings=(0.7,),
        parameters=(("bulk", 2.0),),
    )


def variants(study: str, scope: Scope) -> list[tuple[str, Settings]]:
    """Return names and settings that a study compares with the default ones."""
    base = scope.base
    if study == "mesh":
        return [("fine", base.refined())]
    changed: list[tuple[str, float]] = {
        "truncation": [("outer_radius", factor) for factor in scope.radii],
        "contact": [("contact_spacing", factor) for factor in scope.spacings],
        "parameters": list(scope.parameters),
    }[study]
    variants = []
    for name, factor in changed:
        value = float(f"{getattr(base, name) * factor:.6g}")
        changes: dict[str, Any] = {name: value}
        variants.append((f"{name} = {value:.3g}", replace(base, **changes)))
    return variants


def extent(study: str, scope: Scope) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Return exponents and toughnesses of a study that compares settings."""
    if study == "mesh":
        return scope.mesh_alphas, scope.mesh_gs
    if study == "parameters":
        return scope.parameter_alphas, scope.parameter_gs
    return scope.compared_alphas, scope.compared_gs


def range_cases(scope: Scope) -> Iterator[Case]:
    """Yield one configuration for each exponent and toughness of the range."""
    for alpha in scope.alphas:
        for g in (*scope.gs, *scope.beyond_gs):
            yield Case("range", alpha, scope.base, g)
    for alpha in scope.beyond_alphas:
        for g in scope.beyond_alpha_gs:
            yield Case("range", alpha, scope.base, g)


def _comparison_cases(study: str, scope: Scope) -> Iterator[Case]:
    alphas, gs = extent(study, scope)
    sides = [("range", scope.base)]
    sides += [(study, settings) for _, settings in variants(study, scope)]
    for alpha in alphas:
        for name, settings in sides:
            for g in gs:
                yield Case(name, alpha, settings, g)


def check_cases(scope: Scope) -> Iterator[Case]:
    """Yield the configurations whose J is checked by a shift of the tip, and far-field ones."""
    for alpha in scope.compared_alphas:
        for g in scope.shift_gs:
            yield Case("checks", alpha, scope.base, g, shift=True)
        yield Case("checks", alpha, scope.base, distance=scope.far_distance)


def cases_of(studies: Iterable[str], scope: Scope) -> list[Case]:
    """Return the cases that studies need, each of them once.

    Raises
    ------
    InputError
        If there is no such study.

    Examples
    --------
    >>> {case.study for case in cases_of(["mesh"], quick_scope())} == {"range", "mesh"}
    True
    """
    found: dict[Case, None] = {}
    for study in studies:
        if study not in STUDIES:
            raise InputError(f"there is no study {study!r}; give one of {', '.join(STUDIES)}")
        if study == "range":
            found.update(dict.fromkeys(range_cases(scope)))
        elif study == "checks":
            found.update(dict.fromkeys(check_cases(scope)))
        else:
            found.update(dict.fromkeys(_comparison_cases(study, scope)))
    return list(found)

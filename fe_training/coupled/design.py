"""What the campaign with friction and wear solves: bases, and rays of loads from each of them."""

from __future__ import annotations

import hashlib
import json
import os
import sys
from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from itertools import count
from pathlib import Path
from typing import Any

import numpy as np

from fe_training.solver.cut import Settings
from surrogate.basics.files import file_name
from surrogate.errors import InputError

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

_SCHEMA = "wirecut-coupled-1"

#: The number of the first base that is placed by hand, and of how many more the next set of them
#: begins: the sequence and each set can grow.
FIRST_PLACED, MOST_PLACED = 10_000, 1_000


@dataclass(frozen=True, slots=True)
class Base:
    """A frictionless configuration, and the loads along the rays from it.

    Parameters
    ----------
    number : int
        Its place in the sequence, from 0.
    alpha, g : float
        Strain-stiffening exponent and J/(mu R_w) [-].
    rays : tuple of tuple of (float, float)
        (xi, tau_w/mu) along each ray [-].
    held_out : bool
        Whether no fit sees its rows.
    taper : float
        How gently wear rises at the ends of the contact [-].
    """

    number: int
    alpha: float
    g: float
    rays: tuple[tuple[tuple[float, float], ...], ...]
    held_out: bool
    taper: float = 0.0


@dataclass(frozen=True)
class Placed:
    """Bases that are named one by one, where the sequence leaves kappa unknown.

    Parameters
    ----------
    bases : tuple of (float, float)
        (alpha, g) of each [-].
    ends : tuple of (float, float)
        Where the rays of each end: xi [-], and tau_w as a share of the largest.
    wear : tuple of (float, float)
        The largest tau_w/mu is the largest of the terms ``factor g**power`` of these [-].
    most : float
        But at most this [-].
    shares : tuple of float
        Where on a ray rows are made, rising to 1.
    settings, finer : Settings
        The mesh, and that on which some loads are solved a second time.
    taper : float
        How gently wear rises at the ends of the contact [-].
    """

    bases: tuple[tuple[float, float], ...]
    ends: tuple[tuple[float, float], ...]
    wear: tuple[tuple[float, float], ...]
    most: float
    shares: tuple[float, ...]
    settings: Settings
    finer: Settings
    taper: float = 0.0

    def rays(self, g: float) -> tuple[tuple[tuple[float, float], ...], ...]:
        """Return the loads along each ray at one g."""
        largest = min(max(factor * g**power for factor, power in self.wear), self.most)
        return tuple(
            tuple((share * friction, share * part * largest) for share in self.shares)
            for friction, part in self.ends
        )


@dataclass(frozen=True)
class CoupledDesign:
    """The numbers that determine the campaign; lengths in R_w, stresses in mu.

    Parameters
    ----------
    bases : int
        Number of bases.
    seed : int
        Of the scrambled Sobol sequence.
    held_out_every : int
        One base of so many is held out.
    alpha, g : tuple of float
        Ranges [-].
    friction, wear : float
        Largest xi and tau_w/mu [-].
    rays : int
        Rays of each base.
    shares : tuple of float
        Where on a ray rows are made, rising to 1.
    settings : Settings
        The mesh.
    finer : Settings
        The mesh on which some loads are solved a second time; not part of the hash.
    placed : tuple of Placed
        More bases, after those of the sequence; not part of the hash.
    """

    bases: int
    seed: int
    held_out_every: int
    alpha: tuple[float, float]
    g: tuple[float, float]
    friction: float
    wear: float
    rays: int
    shares: tuple[float, ...]
    settings: Settings
    finer: Settings
    placed: tuple[Placed, ...] = ()

    @property
    def hash(self) -> str:
        """Sixteen hexadecimal digits that two designs share only if all their numbers agree.

        But for the number of bases, those that are placed and the finer mesh: more of them is the
        same design, longer.
        """
        besides = "bases", "finer", "placed"
        content = {key: value for key, value in asdict(self).items() if key not in besides}
        return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()[:16]

    def all_bases(self) -> list[Base]:
        """Return the bases, in the order in which they fill space."""
        from scipy.stats import qmc

        sequence = qmc.Sobol(3, seed=self.seed)
        points = sequence.random_base2(int(np.ceil(np.log2(self.bases))))[: self.bases]
        bases = [self._base(number, *map(float, point)) for number, point in enumerate(points)]
        return bases + self._placed()

    def settings_of(self, base: Base) -> Settings:
        """Return the mesh of a base."""
        if base.number < FIRST_PLACED:
            return self.settings
        return self.placed[(base.number - FIRST_PLACED) // MOST_PLACED].settings

    def on_finer_mesh(self) -> CoupledDesign:
        """Return the design of the loads that are solved a second time: another mesh."""
        placed = tuple(replace(some, settings=some.finer) for some in self.placed)
        return replace(self, settings=self.finer, placed=placed)

    def _placed(self) -> list[Base]:
        return [
            Base(first + n, alpha, g, some.rays(g), self._is_held_out(n), some.taper)
            for first, some in zip(count(FIRST_PLACED, MOST_PLACED), self.placed)
            for n, (alpha, g) in enumerate(some.bases)
        ]

    def _is_held_out(self, number: int) -> bool:
        return number % self.held_out_every == self.held_out_every - 1

    def _base(self, number: int, x: float, y: float, z: float) -> Base:
        low, high = self.alpha
        weak, tough = np.log(self.g)
        rays = tuple(self._ray((z + k / self.rays) % 1.0) for k in range(self.rays))
        return Base(
            number,
            round(low + x * (high - low), 4),
            float(f"{np.exp(weak + y * (tough - weak)):.4g}"),
            rays,
            self._is_held_out(number),
        )

    def _ray(self, place: float) -> tuple[tuple[float, float], ...]:
        """Return the loads of the ray to a place on the outer edge: friction alone 0, wear 1."""
        friction = self.friction * min(1.0, 2.0 * (1.0 - place))
        wear = self.wear * min(1.0, 2.0 * place)
        return tuple((share * friction, share * wear) for share in self.shares)


def read_design(path: str | os.PathLike[str]) -> CoupledDesign:
    """Read a design from a TOML file.

    Raises
    ------
    InputError
        If the file cannot be read or is no such design.
    """
    try:
        content = tomllib.loads(Path(path).read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise InputError(f"{file_name(path)} cannot be read as a design: {error}") from None
    try:
        return _checked(_design(content))
    except (KeyError, TypeError, ValueError) as error:
        raise InputError(
            f"{file_name(path)} is no design of a campaign with friction and wear: "
            f"{type(error).__name__} {error}; models/coupled.toml is one"
        ) from None


def _design(content: Mapping[str, Any]) -> CoupledDesign:
    if content["schema"] != _SCHEMA:
        raise ValueError(f"schema is {content['schema']!r}, not {_SCHEMA!r}")
    limits, rays = content["range"], content["rays"]
    settings, finer = content["settings"], content.get("finer", {})
    return CoupledDesign(
        bases=int(content["bases"]),
        seed=int(content["seed"]),
        held_out_every=int(content["held_out_every"]),
        alpha=_pair(limits["alpha"]),
        g=_pair(limits["g"]),
        friction=float(limits["friction"]),
        wear=float(limits["wear"]),
        rays=int(rays["count"]),
        shares=tuple(float(share) for share in rays["shares"]),
        settings=Settings(**settings),
        finer=Settings(**{**settings, **finer}),
        placed=tuple(
            _placed(some, settings, float(limits["wear"])) for some in content.get("placed", ())
        ),
    )


def _placed(content: Mapping[str, Any], settings: Mapping[str, Any], most: float) -> Placed:
    own = {**settings, **content.get("settings", {})}
    return Placed(
        bases=tuple(_pair(base) for base in content["bases"]),
        ends=tuple(_pair(end) for end in content["ends"]),
        wear=tuple(_pair(term) for term in content["wear"]),
        most=most,
        shares=tuple(float(share) for share in content["shares"]),
        settings=Settings(**own),
        finer=Settings(**{**own, **content.get("finer", {})}),
        taper=float(content.get("taper", 0.0)),
    )


def _pair(values: Any) -> tuple[float, float]:
    low, high = values
    return float(low), float(high)


def _checked(design: CoupledDesign) -> CoupledDesign:
    if not 1 <= design.bases <= 4096 or design.rays < 1 or design.held_out_every < 2:
        raise ValueError("bases must be 1 to 4096, rays at least 1, held_out_every at least 2")
    if not 0 < design.g[0] < design.g[1] < np.inf or not 0 < design.alpha[0] <= design.alpha[1]:
        raise ValueError("the ranges of g and alpha must be positive and rising")
    if not (0 <= design.friction < np.inf and 0 <= design.wear < np.inf):
        raise ValueError("friction and wear must be finite and not negative")
    if any(len(some.bases) > MOST_PLACED for some in design.placed):
        raise ValueError(f"a set of placed bases must have at most {MOST_PLACED}")
    for shares in (design.shares, *(some.shares for some in design.placed)):
        rising = np.diff((0.0, *shares))
        if not len(rising) or not (rising > 0).all() or shares[-1] != 1.0:
            raise ValueError("shares must rise from above 0 to 1")
    return design

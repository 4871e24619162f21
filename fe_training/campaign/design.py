"""What a campaign solves: its design, its configurations and its tasks."""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import asdict, dataclass, fields, replace
from typing import Any

import numpy as np

from fe_training.solver.cut import Settings

__all__ = [
    "BLUNT",
    "STRATEGIES",
    "Beyond",
    "Blunt",
    "CampaignDesign",
    "Configuration",
    "Denser",
    "Task",
    "Touching",
]

#: Name of the level with a larger notch.
BLUNT = "blunt"

#: How the settings of a level are changed at each attempt: a failed configuration is tried again
#: with the next one when the campaign is run again. The second one keeps the notch, on which
#: A* and B* depend where the tip touches.
STRATEGIES: tuple[Callable[[Settings], Settings], ...] = (
    lambda settings: settings,
    lambda settings: settings.refined(1.25),
    lambda settings: replace(settings.refined(1.5), notch_radius=settings.notch_radius / 4),
)


@dataclass(frozen=True, slots=True, order=True)
class Configuration:
    """One entry of a campaign.

    Parameters
    ----------
    level : str
        Name of the mesh level.
    alpha : float
        Strain-stiffening exponent [-].
    target : float
        Wanted g = J/(mu R_w) [-].
    """

    level: str
    alpha: float
    target: float

    def __str__(self) -> str:
        return f"alpha={self.alpha:.12g},g={self.target:.12g},level={self.level}"


@dataclass(frozen=True, slots=True)
class Task:
    """Configurations of one alpha and level that are solved in one go, with the same strategy.

    Parameters
    ----------
    configurations : tuple of Configuration
        In rising order of g.
    attempt : int
        Which of the strategies to take, from 0.
    """

    configurations: tuple[Configuration, ...]
    attempt: int = 0


@dataclass(frozen=True, slots=True)
class Denser:
    """Where the nodes in g are denser: around the touch of the tip.

    Parameters
    ----------
    alpha, touch : tuple of float
        Stiffening exponents in rising order and g at which the tip touches the wire [-].
    peak : float
        Surplus density at the touch, relative to that far away [-].
    width : float
        Width of the surplus [decades of g].
    """

    alpha: tuple[float, ...]
    touch: tuple[float, ...]
    peak: float
    width: float

    def density(self, alpha: float, log_g: Any) -> Any:
        """Return the density of nodes at log10 g, relative to that far from the touch."""
        return 1.0 + self.peak * np.exp(-(((log_g - np.log10(self.at(alpha))) / self.width) ** 2))

    def at(self, alpha: float) -> float:
        """Return g at which the tip touches, log g interpolated linearly [-]."""
        return float(10.0 ** np.interp(alpha, self.alpha, np.log10(self.touch)))


@dataclass(frozen=True, slots=True)
class Beyond:
    """How far the nodes in g go on above the highest one that all alphas share.

    Parameters
    ----------
    alpha : tuple of float
        Stiffening exponents in rising order, from each of which on ... [-]
    highest : tuple of float
        ... g goes this far [-].
    per_decade : int
        Nodes in a decade of g there, evenly spaced in log g.
    """

    alpha: tuple[float, ...]
    highest: tuple[float, ...]
    per_decade: int

    def nodes(self, alpha: float, above: float) -> tuple[float, ...]:
        """Return the nodes of one alpha above a g, rising, none below the first exponent."""
        pairs = zip(self.alpha, self.highest, strict=True)
        reached = [highest for start, highest in pairs if alpha >= start]
        if not reached:
            return ()
        decades = math.log10(reached[-1] / above)
        count = max(1, round(self.per_decade * decades))
        return tuple(
            float(f"{above * 10.0 ** (decades * (i + 1) / count):.4g}") for i in range(count)
        )


@dataclass(frozen=True, slots=True)
class Touching:
    """Nodes in g on either side of the touch of the tip, near enough to find it between them.

    Parameters
    ----------
    alpha : tuple of float
        The stiffening exponents that have them [-].
    touch : tuple of float
        About where the tip begins to touch the wire, for each of these exponents [-].
    offsets : tuple of float
        ln(g/touch) of the nodes, rising [-].
    """

    alpha: tuple[float, ...]
    touch: tuple[float, ...]
    offsets: tuple[float, ...]

    def nodes(self, alpha: float) -> tuple[float, ...]:
        """Return the nodes of one alpha."""
        if alpha not in self.alpha:
            return ()
        touch = self.touch[self.alpha.index(alpha)]
        return tuple(float(f"{touch * math.exp(offset):.4g}") for offset in self.offsets)


@dataclass(frozen=True, slots=True)
class Blunt:
    """A third level: the coarser mesh with a larger notch, for what depends on the size of the tip.

    Parameters
    ----------
    notch_radius : float
        Its notch [R_w].
    share : float
        It is solved from this share of the g on at which the tip begins to touch [-].
    """

    notch_radius: float
    share: float


@dataclass(frozen=True)
class CampaignDesign:
    """The numbers that determine a campaign; lengths in R_w, g = J/(mu R_w).

    Parameters
    ----------
    alpha : tuple of float
        Stiffening exponents, rising [-].
    lowest, highest : float
        Ends of the range of g [-].
    count : int
        Nodes in g for each alpha.
    denser : Denser
        Where they are denser.
    path_from : float
        From this g on, the configurations of one alpha and level are solved along one path [-].
    levels : dict of str to Settings
        The two meshes, the coarser one first.
    nodes : tuple of tuple of float, optional
        The nodes in g of each alpha, rising, where they are given one by one.
    beyond : Beyond, optional
        Nodes above `highest`, further for larger exponents.
    blunt : Blunt, optional
        The level with a larger notch, named "blunt".
    touching : Touching, optional
        Nodes near the touch of the tip.
    """

    alpha: tuple[float, ...]
    lowest: float
    highest: float
    count: int
    denser: Denser
    path_from: float
    levels: Mapping[str, Settings]
    nodes: tuple[tuple[float, ...], ...] | None = None
    beyond: Beyond | None = None
    blunt: Blunt | None = None
    touching: Touching | None = None

    @property
    def hash(self) -> str:
        """Sixteen hexadecimal digits that two designs share only if all their numbers agree."""
        text = json.dumps(self.as_dict(), sort_keys=True)
        return hashlib.sha256(text.encode()).hexdigest()[:16]

    def as_dict(self) -> dict[str, Any]:
        """Return all numbers, defaults of the settings included, as plain dictionaries."""
        levels = [[name, asdict(settings)] for name, settings in self.levels.items()]
        numbers = {field.name: getattr(self, field.name) for field in fields(self)}
        for name in ("nodes", "beyond", "blunt", "touching"):
            if numbers[name] is None:
                del numbers[name]  # as if there were no such field, for the hash
            elif name != "nodes":
                numbers[name] = asdict(numbers[name])
        return {**numbers, "denser": asdict(self.denser), "levels": levels}

    @classmethod
    def from_dict(cls, numbers: Mapping[str, Any]) -> CampaignDesign:
        """Return the design of which `as_dict` gave the numbers."""
        levels = {name: Settings(**values) for name, values in numbers["levels"]}
        rest = {name: _plain(value) for name, value in numbers.items()}
        if "nodes" in numbers:
            rest["nodes"] = tuple(map(tuple, numbers["nodes"]))
        for part, kind in _PARTS.items():
            if part in numbers:
                rest[part] = kind(**{name: _plain(value) for name, value in numbers[part].items()})
        return cls(**{**rest, "levels": levels})

    def g(self, alpha: float) -> tuple[float, ...]:
        """Return the nodes in g of one alpha, rising, rounded to four digits where computed."""
        if self.nodes is not None:
            return self.nodes[self.alpha.index(alpha)]
        beyond = self.beyond.nodes(alpha, self.highest) if self.beyond else ()
        touching = self.touching.nodes(alpha) if self.touching else ()
        return tuple(sorted({*self.shared(alpha), *beyond, *touching}))

    def shared(self, alpha: float) -> tuple[float, ...]:
        """Return the nodes in g of one alpha that are spaced up to `highest`, rounded."""
        fine = np.linspace(np.log10(self.lowest), np.log10(self.highest), 4001)
        density = self.denser.density(alpha, fine)
        share = np.concatenate([[0.0], np.cumsum(0.5 * (density[1:] + density[:-1]))])
        nodes = np.interp(np.linspace(0.0, share[-1], self.count), share, fine)
        return tuple(float(f"{10.0**node:.4g}") for node in nodes)

    @property
    def points(self) -> int:
        """Number of pairs of alpha and g."""
        return sum(len(self.g(alpha)) for alpha in self.alpha)

    def configurations(self) -> list[Configuration]:
        """Return all configurations: level by level, in rising order of alpha and g."""
        return [
            Configuration(level, alpha, g)
            for level in self.names
            for alpha in self.alpha
            for g in self._g_of(level, alpha)
        ]

    @property
    def names(self) -> tuple[str, ...]:
        """Names of all levels: the two meshes, the coarser one first, and the blunt one."""
        return (*self.levels, *((BLUNT,) if self.blunt else ()))

    def _g_of(self, level: str, alpha: float) -> tuple[float, ...]:
        """Return the nodes in g of one alpha that a level solves."""
        if level in self.levels or self.blunt is None:
            return self.g(alpha)
        lowest = max(self.blunt.share * self.denser.at(alpha), self.path_from)
        return tuple(g for g in self.g(alpha) if g >= lowest)

    def together(self, one: Configuration) -> list[Configuration]:
        """Return the configurations that are solved along one path with a given one, it included.

        They are those of the same level and alpha from `path_from` on; below, it is alone.
        """
        if one.target < self.path_from:
            return [one]
        path = [Configuration(one.level, one.alpha, g) for g in self._g_of(one.level, one.alpha)]
        return [other for other in path if other.target >= self.path_from]

    def settings(self, level: str, attempt: int) -> Settings:
        """Return the settings of a level at an attempt."""
        if level == BLUNT and self.blunt:
            first = next(iter(self.levels.values()))
            return STRATEGIES[attempt](replace(first, notch_radius=self.blunt.notch_radius))
        return STRATEGIES[attempt](self.levels[level])

    def tasks(self, wanted: Iterable[tuple[Configuration, int]]) -> list[Task]:
        """Return the tasks that solve configurations, each with its attempt; long ones first.

        Those at and above `path_from` that share alpha, level and attempt are one task, as one
        path passes them all; every other one is a task of its own.
        """
        paths: dict[tuple[int, str, float], list[Configuration]] = {}
        alone = []
        for one, attempt in sorted(wanted):
            if one.target >= self.path_from:
                paths.setdefault((attempt, one.level, one.alpha), []).append(one)
            else:
                alone.append(Task((one,), attempt))
        order = self.names
        tasks = [Task(tuple(several), key[0]) for key, several in paths.items()] + alone
        return sorted(
            tasks,
            key=lambda task: (
                task.configurations[0].target < self.path_from,
                -order.index(task.configurations[0].level),
            ),
        )


_PARTS = {"denser": Denser, "beyond": Beyond, "blunt": Blunt, "touching": Touching}
"""Parts of a design, each of numbers of its own."""


def _plain(value: Any) -> Any:
    return tuple(value) if isinstance(value, list) else value

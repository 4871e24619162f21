"""Reading a design from its TOML file, with a word about everything that is wrong in it."""

from __future__ import annotations

import math
import os
import sys
from collections.abc import Mapping
from dataclasses import fields
from itertools import pairwise
from pathlib import Path
from typing import Any

from fe_training.campaign.design import Beyond, Blunt, CampaignDesign, Denser, Touching
from fe_training.solver.cut import Settings
from fe_training.solver.solve import ALPHA_RANGE, G_RANGE
from surrogate.basics.files import file_name
from surrogate.errors import InputError

__all__ = ["read_design"]

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

_SCHEMA = "wirecut-campaign-1"
_MOST_NODES = 10_000


def read_design(path: str | os.PathLike[str]) -> CampaignDesign:
    """Return the design in a TOML file.

    Parameters
    ----------
    path : str or path-like
        A file like ``models/campaign.toml``.

    Returns
    -------
    CampaignDesign

    Raises
    ------
    InputError
        If the file cannot be read or a number in it is missing or unusable.

    Examples
    --------
    >>> from surrogate.basics.files import model_file
    >>> design = read_design(model_file("campaign.toml"))
    >>> len(design.alpha), len(design.configurations())
    (16, 2136)
    """
    name = file_name(path)
    try:
        table = tomllib.loads(Path(name).read_text(encoding="utf-8"))
    except OSError as error:
        raise InputError(f"the design {name} cannot be read ({error.strerror}).") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise InputError(f"the design {name} is no TOML: {error}.") from None
    try:
        return _checked(_Table("", table))
    except InputError as error:
        raise InputError(f"the design {name}: {error}") from None


class _Table:
    """A table of the design; taking from it what is expected finds what is missing or unknown."""

    def __init__(self, name: str, content: Mapping[str, Any]) -> None:
        self.name, self._left = name, dict(content)

    def _take(self, key: str, kind: type | tuple[type, ...], what: str) -> Any:
        name = f"{self.name}{key}"
        if key not in self._left:
            raise InputError(f"{name} is missing; give {what}.")
        value = self._left.pop(key)
        if not isinstance(value, kind) or isinstance(value, bool):
            raise InputError(f"{name} is {value!r}; give {what}.")
        return value

    def number(self, key: str, lower: float, upper: float) -> float:
        what = f"a number from {lower:g} to {upper:g}"
        return _inside(f"{self.name}{key}", self._take(key, (int, float), what), lower, upper)

    def integer(self, key: str, lower: int, upper: int) -> int:
        value = self._take(key, int, f"a whole number from {lower} to {upper}")
        return int(_inside(f"{self.name}{key}", value, lower, upper))

    def numbers(self, key: str, lower: float, upper: float, rising: bool) -> tuple[float, ...]:
        name, order = f"{self.name}{key}", "rising " if rising else ""
        what = f"a list of {order}numbers from {lower:g} to {upper:g}"
        values = self._take(key, list, what)
        if not values or not all(isinstance(v, (int, float)) for v in values):
            raise InputError(f"{name} is {values!r}; give {what}.")
        checked = tuple(_inside(name, value, lower, upper) for value in values)
        if rising and any(b <= a for a, b in pairwise(checked)):
            raise InputError(f"{name} is {values!r}, which does not rise; give {what}.")
        return checked

    def lists(self, key: str, lower: float, upper: float) -> tuple[tuple[float, ...], ...]:
        values = self._take(key, list, "a list of lists of numbers")
        within = _Table(f"{self.name}{key} ", {str(i): v for i, v in enumerate(values)})
        return tuple(within.numbers(str(i), lower, upper, True) for i in range(len(values)))

    def has(self, key: str) -> bool:
        return key in self._left

    def text(self, key: str, expected: str) -> None:
        if self._take(key, str, repr(expected)) != expected:
            raise InputError(f"{self.name}{key} is not {expected!r}; no other is known.")

    def table(self, key: str) -> _Table:
        return _Table(f"{self.name}{key}.", self._take(key, dict, "a table"))

    def rest(self) -> dict[str, Any]:
        left, self._left = self._left, {}
        return left

    def end(self) -> None:
        if self._left:
            names = ", ".join(f"{self.name}{key}" for key in self._left)
            raise InputError(f"{names} is unknown; leave it out.")


def _checked(table: _Table) -> CampaignDesign:
    table.text("schema", _SCHEMA)
    alpha = table.numbers("alpha", *ALPHA_RANGE, rising=True)
    path_from = table.number("path_from", 0.0, math.inf)
    g, levels = table.table("g"), table.table("levels")
    blunt = _blunt(table.table("blunt")) if table.has("blunt") else None
    table.end()
    if g.has("nodes"):
        return _listed(alpha, path_from, g, _levels(levels))
    lowest = g.number("lowest", *G_RANGE)
    highest = g.number("highest", *G_RANGE)
    if highest <= lowest:
        raise InputError(f"g.highest = {highest:g} is not above g.lowest = {lowest:g}.")
    count = g.integer("count", 2, _MOST_NODES)
    denser = g.table("denser")
    beyond = _beyond(g.table("beyond"), highest) if g.has("beyond") else None
    touching = _touching(g.table("touching")) if g.has("touching") else None
    g.end()
    at, touch = _touches(denser)
    peak, width = denser.number("peak", 0.0, 100.0), denser.number("width", 0.01, 10.0)
    denser.end()
    design = CampaignDesign(
        alpha,
        lowest,
        highest,
        count,
        Denser(at, touch, peak, width),
        path_from,
        _levels(levels),
        beyond=beyond,
        blunt=blunt,
        touching=touching,
    )
    for value in alpha:
        if len(set(design.shared(value))) < count:
            raise InputError(
                f"g.count = {count} nodes between {lowest:g} and {highest:g} coincide in four "
                "digits; give fewer."
            )
    return design


def _beyond(table: _Table, above: float) -> Beyond:
    alpha = table.numbers("alpha", *ALPHA_RANGE, rising=True)
    highest = table.numbers("highest", above, G_RANGE[1], rising=False)
    per_decade = table.integer("per_decade", 1, 100)
    table.end()
    if len(highest) != len(alpha) or min(highest) <= above:
        raise InputError(
            f"g.beyond.highest is {list(highest)}; give one number above g.highest = {above:g} "
            "for each of g.beyond.alpha."
        )
    return Beyond(alpha, highest, per_decade)


def _touches(table: _Table) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Return exponents and the g of the touch at each."""
    alpha = table.numbers("alpha", *ALPHA_RANGE, rising=True)
    touch = table.numbers("touch", *G_RANGE, rising=False)
    if len(touch) != len(alpha):
        raise InputError(
            f"{table.name}touch has {len(touch)} numbers and {table.name}alpha {len(alpha)}; "
            "give one for each alpha."
        )
    return alpha, touch


def _touching(table: _Table) -> Touching:
    touching = Touching(*_touches(table), table.numbers("offsets", -3.0, 3.0, rising=True))
    table.end()
    return touching


def _blunt(table: _Table) -> Blunt:
    blunt = Blunt(table.number("notch_radius", 1e-6, 0.1), table.number("share", 1e-3, 1e3))
    table.end()
    return blunt


def _listed(
    alpha: tuple[float, ...], path_from: float, g: _Table, levels: dict[str, Settings]
) -> CampaignDesign:
    """Return the design whose nodes in g are given one by one for each alpha."""
    nodes = g.lists("nodes", *G_RANGE)
    g.end()
    if len(nodes) != len(alpha):
        raise InputError(
            f"g.nodes has {len(nodes)} lists and alpha {len(alpha)} values; give one for each."
        )
    every = [node for each in nodes for node in each]
    nowhere = Denser((2.0,), (1.0,), 0.0, 1.0)
    count = max(map(len, nodes))
    return CampaignDesign(alpha, min(every), max(every), count, nowhere, path_from, levels, nodes)


def _levels(table: _Table) -> dict[str, Settings]:
    known = {field.name: field for field in fields(Settings)}
    levels = {}
    for name, values in table.rest().items():
        where = f"levels.{name}"
        if not name.replace("-", "").replace("_", "").isalnum():
            raise InputError(f"{where} names a level; use letters, digits, '-' and '_' only.")
        if not isinstance(values, dict):
            raise InputError(f"{where} is {values!r}; give a table of settings.")
        for key, value in values.items():
            if key not in known:
                raise InputError(f"{where}.{key} is unknown; the settings are {', '.join(known)}.")
            default = known[key].default
            kinds = {int: (int,), float: (int, float), bool: (bool,)}.get(type(default), (str,))
            if type(value) not in kinds:
                raise InputError(f"{where}.{key} is {value!r}; give something like {default!r}.")
            if type(value) in (int, float) and not 0 <= value < math.inf:
                raise InputError(f"{where}.{key} is {value!r}; give a number from 0 on.")
            values[key] = float(value) if type(default) is float else value
        levels[name] = Settings(**values)
    if len(levels) != 2:
        raise InputError(f"levels has {len(levels)} tables; give two, the coarser one first.")
    (first, coarse), (second, fine) = levels.items()
    if fine.sectors <= coarse.sectors or fine.contact_spacing >= coarse.contact_spacing:
        raise InputError(
            f"levels.{second} is not finer than levels.{first}; give it more sectors and a "
            "smaller contact_spacing."
        )
    return levels


def _inside(name: str, value: float, lower: float, upper: float) -> float:
    if not lower <= value <= upper or not math.isfinite(value):
        raise InputError(f"{name} = {value!r}; give {lower:g} to {upper:g}.")
    return float(value)

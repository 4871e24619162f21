"""What `bench-tradeoff` writes: tables, goals, the figure and the file of costs."""

import json
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from measuring import machine

from fe_training.markdown import markdown_table
from surrogate.basics.figures import (
    BLUE,
    GREY,
    RED,
    SMALL,
    WIDTHS,
    in_style,
    label_axes,
    legend_over,
    new_figure,
    panels,
    save_figure,
)
from surrogate.choosing.by_name import FITTED_NAMES
from surrogate.choosing.costs import BULK, COSTS_SCHEMA, ONE
from surrogate.contact.closed_forms import FORCE_MODELS

FIGURE = "tradeoff"
REFERENCE, ENGINE = "plain Eq. (13)", "finite elements"
NUMBA, GP_STD, THEIR_STD = "table, numba", "gp with std", "scikit-learn GPR with std"
OURS = (*FORCE_MODELS, *FITTED_NAMES, "auto", NUMBA, GP_STD)


@dataclass
class Measured:
    """What was measured of one way to A, B and delta; nan where nothing was."""

    name: str
    latency: float = np.nan  # of one number by the low-level function [us]
    facade: float = np.nan  # of one number by the public function, all three [us]
    bulk: dict[int, float] = field(default_factory=dict)  # by points [ns a point and output]
    one_alpha: float = np.nan  # the same with alpha one number, at the largest size but 1e7
    start: float = np.nan  # first value in a fresh process / import numpy
    resident: float = np.nan  # memory of that process beyond numpy's [MB]
    working: float = np.nan  # memory beyond the result at the last but one size [MB]
    kilobytes: float = np.nan
    force: Any = None
    delta: Any = None

    @property
    def cost(self) -> float:
        """ns a point and output, of 1e6 points where they were measured."""
        sizes = [size for size in self.bulk if size <= 10**6]
        return self.bulk[max(sizes)] if sizes else np.nan


def digits(value: float, form: str = ".3g") -> str:
    return f"{value:{form}}" if np.isfinite(value) else "-"


def percent(errors: Any) -> str:
    return f"{errors.largest:.2%} / {errors.most:.2%}" if errors else "-"


def speed_table(found: Sequence[Measured], sizes: Sequence[int]) -> str:
    """Return the table of times."""
    plainly = found[0]
    head = ("", "one float, us", "/ plain", "public, us")
    head += tuple(f"{size:.0e} points, ns" for size in sizes)
    head += ("/ plain", "one alpha, ns")
    rows = [
        (
            *(m.name, digits(m.latency), digits(m.latency / plainly.latency), digits(m.facade)),
            *(digits(m.bulk.get(size, np.nan)) for size in sizes),
            *(digits(m.cost / plainly.cost), digits(m.one_alpha)),
        )
        for m in found
        if m.name != ENGINE
    ]
    return markdown_table(head, rows)


def size_table(found: Sequence[Measured]) -> str:
    """Return the table of start, memory, size and error."""
    head = ("", "start / numpy's", "memory, MB", "working, MB", "size, kB", "F_ss error", "delta")
    rows = [
        (
            *(m.name, digits(m.start), digits(m.resident, ".1f"), digits(m.working, ".1f")),
            *(digits(m.kilobytes, ".0f"), percent(m.force), percent(m.delta)),
        )
        for m in found
    ]
    return markdown_table(head, rows)


def goals(found: Sequence[Measured]) -> list[tuple[str, float, float, bool]]:
    """Return what was aimed at: words, what was found, the goal, and whether it is met."""
    by_name = {m.name: m for m in found}
    table = by_name["table"]
    theirs = by_name[THEIR_STD]
    ours = by_name[GP_STD]
    size = max(set(ours.bulk) & set(theirs.bulk))
    aims = [
        ("table, scattered points, ns a point and output", table.cost, 30.0, -1),
        ("table, one alpha, ns a point and output", table.one_alpha, 20.0, -1),
        ("table, one float, us", table.latency, 3.0, -1),
        ("table, cold start to the first value / import numpy", table.start, 1.3, -1),
        (
            f"scikit-learn / gp, with std, {size:.0e} points",
            theirs.bulk[size] / ours.bulk[size],
            10.0,
            1,
        ),
    ]
    if NUMBA in by_name:
        aims.insert(1, ("table with numba, scattered points, ns", by_name[NUMBA].cost, 10.0, -1))
    return [(words, value, goal, sign * (value - goal) >= 0) for words, value, goal, sign in aims]


def page(
    found: Sequence[Measured], judged: str, sizes: Sequence[int], longest: float, link: str
) -> str:
    """Return what goes into the documentation."""
    rows = [(w, digits(v), f"{g:g}", "yes" if met else "no") for w, v, g, met in goals(found)]
    fe = next(m for m in found if m.name == ENGINE)
    by_name = {m.name: m for m in found}
    return f"""\
Written by `scripts/bench-tradeoff`, on {machine()}; your machine differs, the ratios less so.

![Cost of a value against the largest error of the force]({link}/{FIGURE}.png)

Processor time of one thread, for A, B and delta together and divided by three ("one float" is B
alone by the low-level function, or all three of the other libraries). "Plain" is Eq. (13) written
in numpy. A dash: not measured, or a call of more than {longest:g} s. "With std" are mean and
standard deviation together.

{speed_table(found, sizes)}

One finite-element solution takes {fe.latency / 1e6:.1f} s of one core, the median row of the finest
mesh: {fe.cost / by_name["table"].cost:.1e} values of the table.

Start is a fresh process up to its first value (of the other libraries: their import alone), memory
what it holds beyond `import numpy`, working what a call on many points needs beyond its results.
Size is that of the file, which all fitted models share, or of the arrays. Errors are the largest /
95 % relative ones of the force over tau_w/(mu xi) and xi, and of delta, at
{judged}; those of the finite elements are their own error bars.

{size_table(found)}

{markdown_table(("what", "found", "goal", "met"), rows)}"""


def costs(found: Sequence[Measured]) -> str:
    """Return the text of the file of costs."""
    by_name = {m.name: m for m in found}
    models: dict[str, dict[str, float]] = {}
    for name in (*FORCE_MODELS, *FITTED_NAMES):
        m = by_name[name]
        models[name] = {BULK: float(f"{m.cost:.3g}"), ONE: float(f"{m.latency:.3g}")}
    return (
        json.dumps({"schema": COSTS_SCHEMA, "measured_on": machine(), "models": models}, indent=1)
        + "\n"
    )


@in_style
def draw(found: Sequence[Measured], folder: Path) -> None:
    """Draw cost against error; the line joins what nothing else beats in both."""
    shown = sorted((m for m in found if m.force), key=lambda m: m.cost)
    figure = new_figure((WIDTHS["single"] * 1.6, 3.2))
    ax = panels(figure, 1)[0, 0]
    for m in shown:
        error = 100.0 * m.force.largest
        ours = m.name in OURS
        ax.plot(m.cost, error, "o" if ours else "D", color=BLUE if ours else RED, ms=4.5)
    edge: list[Measured] = []
    for m in shown:
        if not edge or m.force.largest < 0.999 * edge[-1].force.largest:
            edge.append(m)
    ends = [m.cost for m in edge], [100.0 * m.force.largest for m in edge]
    ax.plot(*ends, color=GREY, linewidth=0.8, zorder=0)
    for number, m in enumerate(shown):
        _name(ax, m, below=number % 2 == 0 and m.force.largest < 0.01)
    ax.set(xscale="log", yscale="log", xlim=(0.5 * shown[0].cost, 3e10), ylim=(0.02, 600.0))
    label_axes(ax, "processor time of a value [ns]", r"largest error of $F_{ss}$ [%]")
    handles = ax.plot([], [], "o", color=BLUE, ms=4.5, label="this library")
    handles += ax.plot([], [], "D", color=RED, ms=4.5, label="other libraries, finite elements")
    legend_over(figure, handles, 2)
    for ending in (".svg", ".png"):
        save_figure(figure, folder / f"{FIGURE}{ending}")


def _name(ax: Any, m: Measured, below: bool) -> None:
    """Write a name beside its point, on a slant, so that neighbours do not meet."""
    ax.annotate(
        m.name,
        (m.cost, 100.0 * m.force.largest),
        (3.0, -4.0 if below else 4.0),
        textcoords="offset points",
        rotation=-40.0 if below else 40.0,
        rotation_mode="anchor",
        va="top" if below else "bottom",
        fontsize=SMALL,
    )

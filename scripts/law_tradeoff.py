"""What laws and models of the force cost, and how far they are off beside coupled solutions."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from measuring import least

from fe_training.coupled.judged import JudgedRows, judged_rows
from fe_training.markdown import markdown_table
from surrogate import Scene, cutting_force
from surrogate.basics.figures import (
    BLUE,
    GREY,
    RED,
    WIDTHS,
    in_style,
    label_axes,
    legend_over,
    new_figure,
    panels,
    save_figure,
)

FIGURE = "law-tradeoff"
WAYS = (
    *(("projected", model) for model in ("eq13", "power-law", "table", "gp", "auto")),
    *(("slip", model) for model in ("power-law", "table", "gp")),
    *(("coupled", model) for model in ("power-law", "table", "gp")),
    *(("auto", model) for model in ("power-law", "table", "gp", "auto")),
)
COLOURS = {"projected": RED, "slip": GREY, "coupled": BLUE, "auto": "black"}

MARKERS = {"eq13": "D", "power-law": "s", "table": "o", "gp": "^", "auto": "P"}


@dataclass
class Way:
    """A law and a model: times [s] and relative errors beside coupled solutions."""

    law: str
    model: str
    one: float
    many: float
    off: Any
    held_out: Any

    @property
    def largest(self) -> float:
        return float(np.max(self.off))


@dataclass
class Promise:
    """What the law "auto" says of its error, by the rows."""

    rows: int
    bounded: int
    within: int
    beyond: int
    held_out: int
    elsewhere: float


def measure(models: Path, points: int) -> tuple[list[Way], Promise]:
    """Return all laws and models, judged where an error is known, and what "auto" says of it."""
    rows = _of_a_gel(judged_rows(models / "coupled.h5"))
    force = cutting_force(rows.scene, outside="nan")
    known = np.isfinite(force.relative_error)
    off = np.abs(force.total / rows.force - 1.0)
    promise = Promise(
        len(rows),
        int(known.sum()),
        int((known & (force.relative_error <= 0.02)).sum()),
        int((off > force.relative_error + rows.error_bar)[known].sum()),
        int((known & rows.held_out).sum()),
        float(np.median(off[~known])) if not known.all() else np.nan,
    )
    judged = rows.taken(known)
    many = judged.taken(np.arange(points) % len(judged)).scene
    return [_way(law, model, judged, many, points) for law, model in WAYS], promise


def _of_a_gel(rows: JudgedRows) -> JudgedRows:
    """Return the rows in units that nobody doubts."""
    mu, radius = 2e4, 1e-3
    _, g, _, xi, wear, alpha = rows.scene.values()
    scene = Scene(mu, mu * radius * g, radius, xi, mu * wear, alpha)
    return JudgedRows(scene, mu * radius * rows.force, rows.error_bar, rows.held_out)


def _way(law: str, model: str, judged: JudgedRows, many: Any, points: int) -> Way:
    one = judged.taken(len(judged) // 2).scene
    off = np.abs(cutting_force(judged.scene, model, law=law).total / judged.force - 1.0)
    single = least(lambda: cutting_force(one, model, law=law), 30, 0.5)
    bulk = least(lambda: cutting_force(many, model, law=law), 1, 0.5)
    return Way(law, model, single, bulk / points, off, off[judged.held_out])


def page(ways: Sequence[Way], promise: Promise, link: str) -> str:
    """Return what goes into the documentation."""
    rows = [
        (
            *(way.law, way.model, f"{1e6 * way.one:.3g}", f"{1e9 * way.many:.3g}"),
            *(_percent(way.off), _percent(way.held_out)),
        )
        for way in ways
    ]
    head = ("law", "model", "one force, us", "many, ns", "F_ss error", "of held-out bases")
    return f"""\
![Cost of a force by each law and model against its largest error]({link}/{FIGURE}.png)

Processor time of `cutting_force`, and the largest / 95 % relative errors of $F_{{ss}}$ beside the
{promise.bounded} coupled finite-element solutions at which `auto` knows its error,
{promise.held_out} of them of bases that no fit saw.

{markdown_table(head, rows)}

Of all {promise.rows} loads that were reached, `auto` states an error for {promise.bounded}, for
{promise.within} of them one within 2 %. Forces beyond what is stated and the finite elements' own
error bar: {promise.beyond or "none"}. At the other loads, where it falls back to the paper's law
with an unknown error, the median of the error is {promise.elsewhere:.0%}."""


def _percent(off: Any) -> str:
    return f"{np.max(off):.2%} / {np.quantile(off, 0.95):.2%}" if np.size(off) else "-"


@in_style
def draw(ways: Sequence[Way], folder: Path) -> None:
    """Draw cost against error; the line joins what nothing else beats in both."""
    shown = sorted(ways, key=lambda way: way.many)
    figure = new_figure((WIDTHS["single"] * 1.6, 3.2))
    ax = panels(figure, 1)[0, 0]
    edge: list[Way] = []
    for way in shown:
        at = 1e9 * way.many, 100.0 * way.largest
        ax.plot(*at, MARKERS[way.model], color=COLOURS[way.law], ms=5.0)
        if not edge or way.largest < 0.999 * edge[-1].largest:
            edge.append(way)
    ends = [1e9 * way.many for way in edge], [100.0 * way.largest for way in edge]
    ax.plot(*ends, color=GREY, linewidth=0.8, zorder=0)
    ax.set(xscale="log", yscale="log")
    ax.margins(x=0.15, y=0.1)
    label_axes(ax, "processor time of a force among many [ns]", r"largest error of $F_{ss}$ [%]")
    handles = [
        ax.plot([], [], "_", color=colour, ms=9.0, mew=4.0, label=f"law {law}")[0]
        for law, colour in COLOURS.items()
    ]
    handles += [
        ax.plot([], [], marker, color="white", mec="black", ms=5.0, label=model)[0]
        for model, marker in MARKERS.items()
    ]
    legend_over(figure, handles, 5)
    for ending in (".svg", ".png"):
        save_figure(figure, folder / f"{FIGURE}{ending}")

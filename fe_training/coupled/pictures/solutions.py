"""Pictures of the coupled solutions: kappa with its rows, the three laws, where paths end."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from fe_training.campaign.dataset import Campaign
from fe_training.coupled.dataset import CoupledData
from fe_training.coupled.pictures.balance import SIZE, balance_figure
from fe_training.coupled.pictures.tip import SIZE as TIP_SIZE
from fe_training.coupled.pictures.tip import tip_figure
from fe_training.figure_style import TOUGHNESS
from fe_training.sliding.record import SlidingOutcome
from surrogate import contact_functions
from surrogate.basics.figures import (
    COLOURS,
    GREY,
    SMALL,
    in_style,
    label_axes,
    legend_over,
    new_figure,
    panels,
    plain_log_ticks,
    save_figure,
)
from surrogate.coupling.amplification import Amplification, load_of
from surrogate.errors import InputError

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["PICTURES", "Ray", "draw_pictures", "ends_figure", "kappa_figure", "laws_figure", "rays"]

Array = NDArray[np.float64]

PICTURES = ("coupled-balance", "coupled-kappa", "coupled-laws", "coupled-ends", "coupled-tip")
"""Names of the pictures' files."""

#: Marks of bases; a cross is where the tip touches the wire.
_MARKERS = ("o", "s", "^", "D", "v", "<", ">")

#: Bases that are drawn: fitted ones, and held-out ones.
_FITTED, _HELD_OUT = 4, 3

#: Exponents and toughnesses at which the laws are compared, and the load of the last panel.
_ALPHAS, _TOUGHNESSES, _LOAD = (3.0, 6.0), (0.01, 1.0), (0.01, 0.1)
_WIDTHS = 0.9, 2.0

_OUTCOMES = {
    SlidingOutcome.CONVERGED.name: ("largest load reached", COLOURS[2], "o"),
    SlidingOutcome.LIMIT.name: ("limit of the load", COLOURS[1], "s"),
    SlidingOutcome.CREASED.name: ("creased", COLOURS[3], "^"),
    SlidingOutcome.STALLED.name: ("stalled", COLOURS[0], "v"),
}
_OTHER = ("ended otherwise", COLOURS[-1], "P")

#: Sizes of loads between the greys of the reach.
_LEVELS = (0.03, 0.1, 0.3, 0.7)
_GREYS = ("#ffffff", "#ededed", "#d9d9d9", "#bdbdbd", "#969696")

XI, WEAR = r"friction $\xi$ [-]", r"wear $\tau_w/\mu$ [-]"


@dataclass(frozen=True, eq=False)
class Ray:
    """The equilibria of one path, from the smallest load on.

    Parameters
    ----------
    base : int
        The number of the base.
    g, alpha : float
        J/(mu R_w) and the stiffening exponent [-].
    direction : float
        0 for friction alone, 1 for wear alone.
    held_out : bool
        Whether no fit sees it.
    outcome : str
        How it ended.
    tapered : bool
        Whether wear rises from nothing at the ends of the contact.
    friction, wear, kappa : ndarray
        xi, tau_w/mu and kappa [-].
    touches : ndarray of bool
        Where the tip touches the wire.
    """

    base: int
    g: float
    alpha: float
    direction: float
    held_out: bool
    outcome: str
    tapered: bool
    friction: Array
    wear: Array
    kappa: Array
    touches: NDArray[np.bool_]


def rays(data: CoupledData, largest: tuple[float, float]) -> list[Ray]:
    """Return the paths of a data set that have an equilibrium.

    Parameters
    ----------
    data : CoupledData
        The rows.
    largest : tuple of float
        The largest xi and tau_w/mu of the campaign [-].
    """
    direction = load_of(data["target_friction"], data["target_wear"], largest)[1]
    keys = list(zip(data["base"].tolist(), direction.round(4).tolist(), strict=True))
    paths = [
        np.array(list(rows)) for _, rows in itertools.groupby(range(len(data)), keys.__getitem__)
    ]
    drawn = (_ray(data, rows, float(direction[rows[0]])) for rows in paths)
    return [ray for ray in drawn if ray is not None]


def _ray(data: CoupledData, rows: NDArray[np.int64], direction: float) -> Ray | None:
    last = rows[-1]
    friction, wear = data["friction"][rows], data["wear"][rows]
    size = np.hypot(friction, wear)
    solved = np.isfinite(size) & (size > 0.0) & np.isfinite(data["steady_force"][rows])
    some = rows[solved][np.unique(size[solved], return_index=True)[1]]
    if not len(some):
        return None
    return Ray(
        int(data["base"][last]),
        float(data["target"][last]),
        float(data["alpha"][last]),
        direction,
        bool(data["held_out"][last]),
        str(data["outcome"][last]),
        bool(data.tapered[some].any()),
        data["friction"][some],
        data["wear"][some],
        data.amplification[some],
        data["touches_tip"][some].astype(bool),
    )


def _nearest(paths: list[Ray], direction: float) -> list[Ray]:
    """Return of every base the path whose direction is nearest to one."""
    ordered = sorted(paths, key=lambda ray: (ray.base, abs(ray.direction - direction)))
    return [next(group) for _, group in itertools.groupby(ordered, lambda ray: ray.base)]


def _apart(paths: list[Ray], count: int) -> list[Ray]:
    """Return paths of bases that are far from each other in ln g and ln alpha."""
    if len(paths) <= count:
        return paths
    places = np.array([(np.log(ray.g), 4.0 * np.log(ray.alpha)) for ray in paths])
    picked = [int(np.argmin(places[:, 0]))]
    while len(picked) < count:
        gaps = np.linalg.norm(places[:, None] - places[picked], axis=2).min(axis=1)
        picked.append(int(np.argmax(gaps)))
    return [paths[i] for i in sorted(picked, key=lambda i: paths[i].g)]


def kappa_figure(data: CoupledData, kappa: Amplification, figure: Figure) -> None:
    """Draw kappa over friction and over wear: rows as marks, the model as far as it is known.

    Parameters
    ----------
    data : CoupledData
        The rows.
    kappa : Amplification
        The model.
    figure : matplotlib.figure.Figure
        Where to draw.
    """
    paths = rays(data, kappa.load_unit)
    worn = {ray.base for ray in paths if ray.wear.any() and not ray.tapered}
    paths = [ray for ray in paths if ray.base in worn]
    left, right = panels(figure, 2)[0]
    places = _places_drawn(paths)
    handles: list[Any] = []
    for ax, direction in ((left, 0.0), (right, 1.0)):
        shown = [ray for ray in _nearest(paths, direction) if ray.base in places]
        shown.sort(key=lambda ray: (ray.held_out, ray.g))
        for ray, colour, marker in zip(shown, COLOURS, _MARKERS, strict=False):
            marks = _draw_ray(ax, ray, kappa, direction, (colour, marker))
            if direction == 0.0:
                name = rf"$g$ = {ray.g:.3g}, $\alpha$ = {ray.alpha:.3g}"
                marks.set_label(f"{name}, held out" if ray.held_out else name)
                handles.append(marks)
        ax.set_yscale("log")
        _plain_ticks(ax)
    handles += left.plot([], [], "-", color=GREY, lw=1.1, label=r"$\kappa$ as far as it is known")
    handles += left.plot([], [], "x", color=GREY, ms=3.5, label="the tip touches the wire")
    label_axes(left, f"{XI} with the wear of the path", r"$\kappa$ [-]")
    label_axes(right, f"{WEAR} with the friction of the path", r"$\kappa$ [-]")
    legend_over(figure, handles, 3)


def _places_drawn(paths: list[Ray]) -> set[int]:
    """Return the bases of the picture: apart from each other, where the tip does not touch."""
    free = [ray for ray in _nearest(paths, 0.0) if (~ray.touches).sum() >= 3]
    seen = _apart([ray for ray in free if not ray.held_out], _FITTED)
    others = _apart([ray for ray in free if ray.held_out], _HELD_OUT)
    return {ray.base for ray in (*seen, *others)}


def _draw_ray(
    ax: Axes, ray: Ray, kappa: Amplification, direction: float, style: tuple[str, str]
) -> Any:
    colour, marker = style
    at = ray.friction if direction == 0.0 else ray.wear
    form: dict[str, Any] = {"ls": "", "color": colour, "ms": 3.6}
    (marks,) = ax.plot(
        at[~ray.touches],
        ray.kappa[~ray.touches],
        marker=marker,
        mfc="none" if ray.held_out else colour,
        **form,
    )
    ax.plot(at[ray.touches], ray.kappa[ray.touches], marker="x", mew=0.7, **form)
    share = np.linspace(0.0, 1.0, 200)
    xi, wear = share * ray.friction[-1], share * ray.wear[-1]
    known = kappa.share(ray.g, ray.alpha, xi, wear) <= 1.0
    curve = np.exp(kappa.log_factor(ray.g, ray.alpha, xi, wear))
    over = xi if direction == 0.0 else wear
    ax.plot(over[known], curve[known], "-", color=colour, lw=1.1)
    return marks


def _plain_ticks(ax: Axes) -> None:
    low, high = ax.get_ylim()
    if high < 2.0 * low:
        ax.set_yscale("linear")
    else:
        plain_log_ticks(ax.yaxis, (1.0, 1.5, 2.0, 3.0, 5.0, 7.0))


def laws_figure(kappa: Amplification, figure: Figure) -> None:
    """Draw the force of friction and wear of the other laws over that of the coupled one.

    Parameters
    ----------
    kappa : Amplification
        The model; the frictionless functions are those of the fitted models in use.
    figure : matplotlib.figure.Figure
        Where to draw.
    """
    axes = panels(figure, 3, sharey=True)[0]
    shares = np.linspace(1e-3, 1.0, 400)
    zero = np.zeros_like(shares)
    friction, wear = shares * kappa.load_unit[0], shares * kappa.load_unit[1]
    over = np.geomspace(1e-3, 1e3, 600)
    handles: list[Any] = []
    for alpha, colour in zip(_ALPHAS, COLOURS, strict=False):
        name = rf"$\alpha$ = {alpha:g}"
        handles += axes[0].plot([], [], "-", color=colour, lw=1.2, label=name)
        for g, width in zip(_TOUGHNESSES, _WIDTHS, strict=True):
            at = np.full_like(shares, g)
            _draw_laws(axes[0], kappa, friction, (at, alpha, friction, zero), (colour, width))
            _draw_laws(axes[1], kappa, wear, (at, alpha, zero, wear), (colour, width))
        _draw_laws(axes[2], kappa, over, (over, alpha, *_LOAD), (colour, 1.2))
    for g, width in zip(_TOUGHNESSES, _WIDTHS, strict=True):
        handles += axes[0].plot([], [], color=GREY, lw=width, label=rf"$g$ = {g:g} in (a), (b)")
    for line, law in (("-", "slip"), ("--", "projected")):
        handles += axes[0].plot([], [], line, color=GREY, lw=1.2, label=law)
    axes[2].set_xscale("log")
    for ax, name in zip(axes, (f"{XI}, no wear", f"{WEAR}, no friction", TOUGHNESS), strict=True):
        ax.axhline(1.0, color=GREY, lw=0.6, zorder=1)
        label_axes(ax, name, "" if ax is not axes[0] else r"$F_d$ over that of coupled [-]")
    title = rf"$\xi$ = {_LOAD[0]:g}, $\tau_w/\mu$ = {_LOAD[1]:g}"
    axes[2].set_title(title, fontsize=SMALL, loc="right")
    legend_over(figure, handles, 6)


def _draw_laws(
    ax: Axes, kappa: Amplification, at: Array, load: tuple[Any, ...], form: tuple[str, float]
) -> None:
    """Draw both laws over what varies, as far as kappa is known."""
    g, alpha, xi, wear = load
    known = kappa.share(g, alpha, xi, wear) <= 1.0
    if not known.any():
        return
    contact = contact_functions(g, alpha, extrapolate=True)
    slip = wear * contact.slip_arc + xi * contact.slip_load
    projected = wear * contact.arc + xi * contact.normal_load
    coupled = slip * np.exp(kappa.log_factor(g, alpha, xi, wear))
    for values, line in ((slip, "-"), (projected, "--")):
        ax.plot(at[known], (values / coupled)[known], line, color=form[0], lw=form[1])


def ends_figure(data: CoupledData, kappa: Amplification, figure: Figure) -> None:
    """Draw where paths end: over g and alpha upon the reach of kappa, and over the loads.

    Parameters
    ----------
    data : CoupledData
        The rows.
    kappa : Amplification
        The model.
    figure : matplotlib.figure.Figure
        Where to draw.
    """
    paths = rays(data, kappa.load_unit)
    axes = panels(figure, 3)[0]
    names = (r"largest $\xi$ known, no wear", r"largest $\tau_w/\mu$ known, no friction")
    for ax, direction, largest, name in zip(axes, (0.0, 1.0), kappa.load_unit, names, strict=False):
        shown = _reach_map(ax, kappa, direction, largest)
        bar = figure.colorbar(shown, ax=ax, location="bottom", pad=0.02, aspect=30)
        bar.set_label(name, fontsize=SMALL)
        bar.ax.tick_params(labelsize=SMALL)
        for ray in _nearest(paths, direction):
            _mark_end(ax, ray, ray.g, ray.alpha)
        ax.set_xscale("log")
        low, high = min(ray.alpha for ray in paths), max(ray.alpha for ray in paths)
        ax.set_ylim(low - 0.3, high + 0.3)
        weak, tough = min(ray.g for ray in paths), max(ray.g for ray in paths)
        ax.set_xlim(0.5 * weak, 10.0 * tough)
        label_axes(ax, TOUGHNESS, r"$\alpha$ [-]")
    for ray in paths:
        _mark_end(axes[2], ray, ray.friction[-1], ray.wear[-1])
    axes[2].set(xscale="log", yscale="log")
    label_axes(axes[2], f"{XI} at the end", f"{WEAR} at the end")
    legend_over(figure, _keys(axes[2], {ray.outcome for ray in paths}), 3)


def _reach_map(ax: Axes, kappa: Amplification, direction: float, largest: float) -> Any:
    """Draw the largest load that is known over g and alpha, up to where the tip touches."""
    x, y, _ = kappa.axes
    columns, rows = np.linspace(x[0], x[-1], 60), np.linspace(y[0], y[-1], 40)
    places = np.meshgrid(columns, rows)
    reach = largest * kappa.reach_at(*places, np.full_like(places[0], direction))
    touch = np.polynomial.polynomial.polyval(places[1], kappa.touch)
    g = np.exp(places[0] + touch)
    reach[(g < kappa.lowest) | (g > kappa.highest)] = np.nan
    levels = largest * np.array(_LEVELS)
    shown = ax.contourf(g, np.exp(places[1]), reach, levels, colors=_GREYS, extend="both")
    ax.plot(np.exp(touch[:, 0]), np.exp(rows), "k:", lw=0.9)
    return shown


def _mark_end(ax: Axes, ray: Ray, x: float, y: float) -> None:
    _, colour, marker = _OUTCOMES.get(ray.outcome, _OTHER)
    fill = colour if ray.touches[-1] else "none"
    ax.plot(x, y, marker=marker, color=colour, mfc=fill, mew=0.9, ms=3.8, ls="")


def _keys(ax: Axes, outcomes: set[str]) -> list[Any]:
    keys: list[Any] = []
    named = [_OUTCOMES[name] for name in _OUTCOMES if name in outcomes]
    named += [_OTHER] if outcomes - set(_OUTCOMES) else []
    for label, colour, marker in named:
        keys += ax.plot([], [], marker, color=colour, mfc="none", ms=3.8, label=label)
    keys += ax.plot([], [], "D", color=GREY, ms=3.8, label="filled: the tip touches the wire")
    keys += ax.plot([], [], "k:", lw=0.9, label="touches without load to the right")
    return keys


@in_style
def draw_pictures(
    data: CoupledData, kappa: Amplification, campaign: Campaign, folder: Path
) -> None:
    """Draw all pictures into a folder.

    Parameters
    ----------
    data : CoupledData
        The rows.
    kappa : Amplification
        The model that was fitted to them.
    campaign : Campaign
        Frictionless configurations, for the picture of the balance.
    folder : Path
        Where to; made where there is none.

    Raises
    ------
    InputError
        If there is no equilibrium to draw, or a file cannot be written.
    """
    if not rays(data, kappa.load_unit):
        raise InputError("the data set has no equilibrium to draw; go on with the campaign.")
    folder.mkdir(parents=True, exist_ok=True)
    pictures: dict[str, tuple[tuple[float, float], Callable[[Figure], None]]] = {
        "coupled-balance": (SIZE, partial(balance_figure, campaign)),
        "coupled-kappa": ((7.0, 3.3), partial(kappa_figure, data, kappa)),
        "coupled-laws": ((7.0, 2.7), partial(laws_figure, kappa)),
        "coupled-ends": ((7.0, 3.0), partial(ends_figure, data, kappa)),
        "coupled-tip": (TIP_SIZE, partial(tip_figure, data)),
    }
    for name in PICTURES:
        size, draw = pictures[name]
        figure = new_figure(size)
        draw(figure)
        save_figure(figure, folder / f"{name}.png")

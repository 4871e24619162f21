"""kappa from the rows of the campaign with friction and wear: a process, and what is shipped of it.

The rows are those in which the tip does not touch the wire, the last equilibria before the ends of
paths among them. ln kappa is that of the integrals between the zeros of the pressure: sums over
touching nodes, which the balance is made of, miss the ends of the contact by parts of an element
(their difference is the error that a row is taken to have).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fe_training.coupled.dataset import CoupledData
from fe_training.coupled.process import LoadProcess, fit_process, variables
from fe_training.sliding.record import BALANCE_BOUND
from surrogate.contact.coordinates import log_touch
from surrogate.coupling.amplification import LEAST_SHARE, Amplification, load_of
from surrogate.coupling.polynomial import Polynomial
from surrogate.errors import InputError

__all__ = ["FitRows", "fit_amplification", "rows_of"]

Array = NDArray[np.float64]

#: Fewest bases and rows of a fit.
FEWEST_BASES, FEWEST_ROWS = 6, 60

#: The part of the difference between the integrals and the sums over nodes that remains in the
#: integrals.
_LEFT = 0.2

#: Standard deviation of ln kappa up to which it counts as known.
KNOWN = 0.01

#: The same with the base of a row left out, up to which its error counts.
LEFT_OUT_KNOWN = 2.0 * KNOWN

#: Bound of the error of ln kappa from which on the reach is taken back, by how much at a time, and
#: how often at most.
MOST_ERROR, _TAKEN_BACK, _ROUNDS = 0.03, 0.8, 25

#: Largest |ln kappa| of a row that is used. Towards the limit of the load it grows without end, and
#: rows there would make the process expect as much everywhere.
MOST = 0.5

#: Factor of the largest error of the rows of a cell, and of the standard deviation where there are
#: none.
SAFETY, _DEVIATIONS = 1.5, 3.0

#: Degrees of the polynomial: of x and y together, of xi and w together, and of all four.
_PLACES, _LOADS, _ALL = 8, 3, 9

#: xi and tau_w/mu in units of which a load has a size and a direction.
LOAD_UNIT = (0.5, 1.0)

#: Part of the samples that are put on either end of g, and of alpha.
_MARGIN = 0.06

_NODES = (16, 9, 9)
_STEPS = 60
_X_EDGES, _ALPHA_EDGES = (-9.0, -5.0, -2.5, -1.0), (3.0, 5.0)


@dataclass(frozen=True, eq=False)
class FitRows:
    """What the fit sees of the rows.

    Parameters
    ----------
    inputs : ndarray, shape (rows, 4)
        x = ln(g/g_touch), y = ln alpha, xi, w = ln(1 + tau_w/mu).
    values, noise : ndarray, shape (rows,)
        ln kappa and the variance of its error.
    drag : ndarray, shape (rows,)
        The part of F_ss that is friction and wear [-].
    base : ndarray of int, shape (rows,)
        The number of the base.
    held_out : ndarray of bool, shape (rows,)
        Whether no fit sees the row.
    """

    inputs: Array
    values: Array
    noise: Array
    drag: Array
    base: NDArray[np.int64]
    held_out: NDArray[np.bool_]

    def taken(self, chosen: Any) -> FitRows:
        """Return some of the rows."""
        columns = self.inputs, self.values, self.noise, self.drag, self.base, self.held_out
        return FitRows(*(column[chosen] for column in columns))

    def __len__(self) -> int:
        return len(self.values)


def rows_of(data: CoupledData, touch: tuple[float, ...]) -> FitRows:
    """Return the equilibria of a data set in which the tip does not touch the wire.

    Parameters
    ----------
    data : CoupledData
        The rows.
    touch : tuple of float
        Coefficients of ln g_touch in powers of ln alpha.
    """
    friction, wear = data["friction"], data["wear"]
    first = 2.0 * (wear * data["first_arc"] + friction * data["first_load"])
    with np.errstate(all="ignore"):
        values = np.log(data.amplification)
        sums = np.log((data["steady_force"] - data["energy_release_rate"]) / first)
        drag = first * np.exp(values)
        noise = (_LEFT * np.abs(values - sums)) ** 2
        usable = np.isfinite(noise) & (data.balance_error <= BALANCE_BOUND)
        usable &= np.abs(values) <= MOST
    usable &= ~data["touches_tip"] & (friction + wear > 0.0)
    y = np.log(data["alpha"])
    x = np.log(data["target"]) - log_touch(touch, y)
    inputs = np.stack([x, y, friction, np.log1p(wear)], axis=1)
    share = drag / (data["target"] + drag)
    rows = FitRows(inputs, values, noise, share, data["base"], data["held_out"]).taken(usable)
    _, different = np.unique(
        np.column_stack([rows.base, rows.inputs]).round(9), axis=0, return_index=True
    )
    return rows.taken(np.sort(different))


def fit_amplification(
    rows: FitRows,
    touch: tuple[float, ...],
    about: dict[str, Any],
    unit: tuple[float, float] = LOAD_UNIT,
) -> tuple[Amplification, LoadProcess, dict[str, float]]:
    """Return kappa, the process behind it, and its errors at rows that no fit sees.

    Parameters
    ----------
    rows : FitRows
        All usable rows.
    touch : tuple of float
        Coefficients of ln g_touch.
    about : dict
        What is to be told of the data.
    unit : tuple of float
        xi and tau_w/mu of a load of size 1 [-].

    Raises
    ------
    InputError
        If there are too few rows.
    """
    seen = rows.taken(~rows.held_out)
    if len(np.unique(seen.base)) < FEWEST_BASES or len(seen) < FEWEST_ROWS:
        raise InputError(
            f"kappa must be fitted to {FEWEST_ROWS} rows of {FEWEST_BASES} bases or more, but "
            f"there are {len(seen)} rows of {len(np.unique(seen.base))}; go on with the campaign."
        )
    process = fit_process(seen.inputs, seen.values, seen.noise, touch)
    left = process.left_out(seen.base)
    process = replace(process, calibration=float(np.sqrt(np.mean((left[0] / left[1]) ** 2))))
    axes, reach = _reach(process, seen, unit)
    g = np.exp(seen.inputs[:, 0] + log_touch(touch, seen.inputs[:, 1]))
    bare = Amplification(
        touch,
        Polynomial(np.array([[0, 0, 1, 0]]), np.zeros(1)),
        axes,
        reach,
        unit,
        ((axes[0][0], *_X_EDGES, axes[0][-1]), (axes[1][0], *np.log(_ALPHA_EDGES), axes[1][-1])),
        np.zeros((len(_X_EDGES) + 1, len(_ALPHA_EDGES) + 1)),
        np.zeros((len(_X_EDGES) + 1, len(_ALPHA_EDGES) + 1)),
        about,
        lowest=float(g.min()),
        highest=float(g.max()),
    )
    kappa = _trimmed(bare, process, seen)
    kappa = replace(kappa, errors=_errors(kappa, process, seen), growth=_growth(kappa))
    return kappa, process, _told(kappa, process, rows, left)


def _reach(
    process: LoadProcess, rows: FitRows, unit: tuple[float, float]
) -> tuple[tuple[Array, Array, Array], Array]:
    """Return the nodes, and the largest load of each up to which the process knows ln kappa."""
    x, y = rows.inputs[:, 0], rows.inputs[:, 1]
    axes = (
        np.linspace(x.min(), min(x.max(), 0.0), _NODES[0]),
        np.linspace(y.min(), y.max(), _NODES[1]),
        np.linspace(0.0, 1.0, _NODES[2]),
    )
    size, direction = load_of(rows.inputs[:, 2], np.expm1(rows.inputs[:, 3]), unit)
    reach = np.zeros(_NODES)
    shares = np.geomspace(1e-3, size.max(), _STEPS)
    for i, j, k in np.ndindex(*_NODES):
        xi, wear = _edge(float(axes[2][k]), unit)
        ray = np.column_stack(
            [
                np.full(_STEPS, axes[0][i]),
                np.full(_STEPS, axes[1][j]),
                shares * xi,
                np.log1p(shares * wear),
            ]
        )
        std = process.predict(ray)[1]
        known = np.flatnonzero(std > KNOWN)
        last = (
            shares[known[0] - 1] if len(known) and known[0] else (0.0 if len(known) else shares[-1])
        )
        place = float(axes[0][i]), float(axes[1][j]), float(axes[2][k])
        near = _nearby(rows, size, direction, place, process)
        reach[i, j, k] = min(last, near)
    return axes, reach


def _nearby(
    rows: FitRows,
    size: Array,
    direction: Array,
    place: tuple[float, float, float],
    process: LoadProcess,
) -> float:
    """Return the load that the nearest rays reached, weighted by their nearness."""
    lengths = np.sqrt(process.lengths[0, :3] * process.lengths[1, :3])
    there = variables(np.array([[*place[:2], 0.0, 0.0]]), process.touch)[0, :3]
    found: list[tuple[float, float]] = []
    for base in np.unique(rows.base):
        here = rows.base == base
        gap = (variables(rows.inputs[here][:1], process.touch)[0, :3] - there) / lengths
        for ray in np.unique(direction[here].round(3)):
            on = here & (np.abs(direction - ray) < 2e-3)
            found.append((float((gap**2).sum() + (4.0 * (ray - place[2])) ** 2), size[on].max()))
    found.sort()
    weights = np.array([1.0 / (1e-3 + square) for square, _ in found[:6]])
    sizes = np.log([reached for _, reached in found[:6]])
    return float(np.exp(weights @ sizes / weights.sum()))


def _edge(direction: float, unit: tuple[float, float]) -> tuple[float, float]:
    """Return the load of size 1 in a direction."""
    return (
        unit[0] * min(1.0, 2.0 * (1.0 - direction)),
        unit[1] * min(1.0, 2.0 * direction),
    )


def _powers() -> NDArray[np.int64]:
    """Return the powers of the terms of the polynomial, none of them free of the load."""
    return np.array(
        [
            (a, b, c, d)
            for a in range(_PLACES + 1)
            for b in range(_PLACES + 1 - a)
            for c in range(_LOADS + 1)
            for d in range(_LOADS + 1 - c)
            if c + d > 0 and a + b + c + d <= _ALL
        ]
    )


def _samples(kappa: Amplification, count: int, seed: int = 1) -> Array:
    """Return points that fill the known loads, the ends of g and alpha among them."""
    from scipy.stats import qmc

    unit = qmc.Sobol(4, seed=seed).random_base2(int(np.log2(count)))
    place = np.clip((1.0 + 2.0 * _MARGIN) * unit[:, :2] - _MARGIN, 0.0, 1.0)
    y = kappa.axes[1][0] + place[:, 1] * (kappa.axes[1][-1] - kappa.axes[1][0])
    touch = log_touch(kappa.touch, y)
    low = np.maximum(np.log(kappa.lowest), kappa.axes[0][0] + touch)
    high = np.minimum(np.log(kappa.highest), kappa.axes[0][-1] + touch)
    x = low + place[:, 0] * (high - low) - touch
    edges = np.array([_edge(z, kappa.largest) for z in unit[:, 2]])
    reach = kappa.reach_at(x, y, unit[:, 2])
    part = (reach * np.sqrt(unit[:, 3]))[:, None]
    xi, wear = (part * edges).T
    return np.column_stack([x, y, xi, np.log1p(wear)])


def _polynomial(kappa: Amplification, process: LoadProcess, rows: FitRows) -> Polynomial:
    """Return the polynomial that meets the process all over the known loads, and the rows."""
    powers = _powers()
    there = _samples(kappa, 8192)
    mean, std = process.predict(there)
    points = np.vstack([there, rows.inputs])
    values = np.concatenate([mean, rows.values])
    spread = np.concatenate([np.hypot(std, 2e-3), np.sqrt(rows.noise + process.scatter**2) / 2.0])
    low, span = points.min(axis=0), np.ptp(points, axis=0)
    low[2:], center = 0.0, low + 0.5 * span
    center[2:] = 0.0
    half = 0.5 * span
    half[2:] = span[2:]
    terms = np.prod(((points - center) / half)[:, None, :] ** powers[None], axis=2)
    weighted = terms / spread[:, None]
    ridge = 1e-4 * np.eye(len(powers)) * np.sqrt(len(points))
    solution = np.linalg.lstsq(
        np.vstack([weighted, ridge]),
        np.concatenate([values / spread, np.zeros(len(powers))]),
        rcond=None,
    )[0]
    return _unscaled(powers, solution, center, half)


def _unscaled(
    powers: NDArray[np.int64], coefficients: Array, center: Array, half: Array
) -> Polynomial:
    """Return a polynomial of the variables from one of (variable - center)/half."""
    from math import comb

    total: dict[tuple[int, ...], float] = {}
    for row, value in zip(powers.tolist(), coefficients, strict=True):
        for a in range(row[0] + 1):
            for b in range(row[1] + 1):
                part = value * comb(row[0], a) * (-center[0]) ** (row[0] - a)
                part *= comb(row[1], b) * (-center[1]) ** (row[1] - b)
                key = (a, b, row[2], row[3])
                total[key] = total.get(key, 0.0) + part / float(np.prod(half ** np.array(row)))
    return Polynomial(np.array(list(total)), np.array(list(total.values())))


def _share(kappa: Amplification, rows: FitRows) -> Array:
    """Return the loads of rows over the largest ones that are known there."""
    x, y, xi, w = rows.inputs.T
    return np.asarray(kappa.share_at(x, y, xi, np.expm1(w)))


def _trimmed(bare: Amplification, process: LoadProcess, rows: FitRows) -> Amplification:
    """Return kappa with its polynomial, the reach taken back from where it may be far off."""
    kappa = bare
    for _ in range(_ROUNDS):
        kappa = replace(kappa, polynomial=_polynomial(kappa, process, rows))
        points, bound = _bounds(kappa, process, rows)
        bad = points[bound > MOST_ERROR]
        if not len(bad):
            break
        reach = kappa.reach.copy()
        _, direction = load_of(bad[:, 2], np.expm1(bad[:, 3]), kappa.largest)
        nodes = [
            np.clip(np.searchsorted(axis, at, side="right") - 1, 0, len(axis) - 2)
            for axis, at in zip(kappa.axes, (bad[:, 0], bad[:, 1], direction), strict=True)
        ]
        for corner in np.ndindex(2, 2, 2):
            around = tuple(np.add(nodes, np.array(corner)[:, None]))
            np.minimum.at(reach, around, _TAKEN_BACK * kappa.reach[around])
        kappa = replace(kappa, reach=reach)
    return kappa


def _bounds(
    kappa: Amplification, process: LoadProcess, rows: FitRows, seed: int = 3
) -> tuple[Array, Array]:
    """Return rows and other known loads, and bounds of |ln kappa - that of finite elements| there.

    The error of a row is that of the process to which its whole base is not known, where that is
    not extrapolation, and how far the polynomial is from the process; anywhere else it is three
    standard deviations and that. It counts in proportion to the share of the reach that its load
    is.
    """
    error, std = process.left_out(rows.base)
    left_out = SAFETY * np.where(std <= LEFT_OUT_KNOWN, np.abs(error), 0.0)
    points = np.vstack([rows.inputs, _samples(kappa, 4096, seed)])
    mean, own = process.predict(points)
    own[: len(rows)] = np.maximum(left_out, own[: len(rows)])
    own[len(rows) :] *= _DEVIATIONS
    x, y, xi, w = points.T
    share = np.asarray(kappa.share_at(x, y, xi, np.expm1(w)))
    bound = (own + np.abs(kappa.polynomial(x, y, xi, w) - mean)) / np.clip(share, LEAST_SHARE, 1.0)
    known = share <= 1.0
    return points[known], bound[known]


def _errors(kappa: Amplification, process: LoadProcess, rows: FitRows) -> Array:
    """Return the largest bounds by cell; the largest of all where a cell has no known load."""
    points, bound = _bounds(kappa, process, rows)
    table = np.zeros(kappa.errors.shape)
    for cell in np.ndindex(table.shape):
        table[cell] = bound[kappa.in_cell(cell, points[:, 0], points[:, 1])].max(initial=0.0)
    return np.where(table == 0.0, table.max(), table)


def _growth(kappa: Amplification) -> Array:
    """Return the largest |ln kappa| over xi + w/10 by cell."""
    points = _samples(kappa, 8192, seed=2)
    load = points[:, 2] + 0.1 * points[:, 3]
    with np.errstate(all="ignore"):
        rate = np.where(load > 0.0, np.abs(kappa.polynomial(*points.T)) / load, 0.0)
    table = np.zeros(kappa.growth.shape)
    for cell in np.ndindex(table.shape):
        here = kappa.in_cell(cell, points[:, 0], points[:, 1])
        table[cell] = 1.1 * rate[here].max(initial=0.0)
    return np.where(table == 0.0, table.max(), table)


def _told(
    kappa: Amplification, process: LoadProcess, rows: FitRows, left: tuple[Array, Array]
) -> dict[str, float]:
    """Return what the card says of the errors: at bases that no fit sees, within the reach."""
    share = _share(kappa, rows)
    others = rows.taken(rows.held_out & (share <= 1.0))
    error = kappa.polynomial(*others.inputs.T) - others.values
    force = np.abs(others.drag * np.expm1(error))
    mean, std = process.predict(others.inputs)
    off = np.abs(mean - others.values) / np.sqrt(std**2 + others.noise + process.scatter**2)
    within = np.abs(left[0]) / (left[1] * process.calibration)
    return {
        "rows": float((~rows.held_out).sum()),
        "bases": float(len(np.unique(rows.base[~rows.held_out]))),
        "held_out_rows": float(rows.held_out.sum()),
        "held_out_within_reach": float(len(others)),
        "force_error_median": _quantile(force, 0.5),
        "force_error_95": _quantile(force, 0.95),
        "force_error_largest": _quantile(force, 1.0),
        "within_one_std": float(np.mean(off <= 1.0)) if len(off) else float("nan"),
        "within_two_std": float(np.mean(off <= 2.0)) if len(off) else float("nan"),
        "left_out_within_one_std": float(np.mean(within <= 1.0)),
        "left_out_within_two_std": float(np.mean(within <= 2.0)),
    }


def _quantile(values: Array, share: float) -> float:
    return float(np.quantile(values, share)) if len(values) else float("nan")

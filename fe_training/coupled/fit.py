"""kappa fitted to the rows of the campaign with friction and wear, with what its errors are."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fe_training.coupled.loads import LOAD_UNIT, samples_of
from fe_training.coupled.process import LoadProcess, fit_process
from fe_training.coupled.reach import bounds_of, first_reach, trimmed
from fe_training.coupled.rows import FitRows
from surrogate.contact.coordinates import log_touch
from surrogate.coupling.amplification import Amplification
from surrogate.coupling.polynomial import Polynomial
from surrogate.errors import InputError

__all__ = ["ALPHA_EDGES", "fit_amplification"]

Array = NDArray[np.float64]

#: Fewest bases and rows of a fit.
FEWEST_BASES, FEWEST_ROWS = 6, 60

_X_EDGES, ALPHA_EDGES = (-9.0, -5.0, -2.5, -1.0), (3.0, 5.0)


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
    process = replace(process, calibration=_calibration(np.abs(left[0]) / left[1]))
    axes, reach = first_reach(process, seen, unit)
    g = np.exp(seen.inputs[:, 0] + log_touch(touch, seen.inputs[:, 1]))
    bare = Amplification(
        touch,
        Polynomial(np.array([[0, 0, 1, 0]]), np.zeros(1)),
        axes,
        reach,
        unit,
        ((axes[0][0], *_X_EDGES, axes[0][-1]), (axes[1][0], *np.log(ALPHA_EDGES), axes[1][-1])),
        np.zeros((len(_X_EDGES) + 1, len(ALPHA_EDGES) + 1)),
        np.zeros((len(_X_EDGES) + 1, len(ALPHA_EDGES) + 1)),
        about,
        lowest=float(g.min()),
        highest=float(g.max()),
    )
    kappa = trimmed(bare, process, seen)
    kappa = replace(kappa, errors=_errors(kappa, process, seen), growth=_growth(kappa))
    return kappa, process, _told(kappa, process, rows, left)


def _calibration(off: Array) -> float:
    """Return the factor of deviations that are off by so many of them.

    Between those by which 68 % are within one and 95 % within two: tails are heavier than normal
    ones. The errors of the rows themselves are in it, as they are in what it is held against.
    """
    one, two = np.quantile(off, (0.683, 0.954))
    return float(np.sqrt(one * two / 2.0))


def _share(kappa: Amplification, rows: FitRows) -> Array:
    """Return the loads of rows over the largest ones that are known there."""
    x, y, xi, w = rows.inputs.T
    return np.asarray(kappa.share_at(x, y, xi, np.expm1(w)))


def _errors(kappa: Amplification, process: LoadProcess, rows: FitRows) -> Array:
    """Return the largest bounds by cell."""
    return _largest(kappa, *bounds_of(kappa, process, rows))


def _growth(kappa: Amplification) -> Array:
    """Return the largest |ln kappa| over xi + w/10 by cell."""
    points = samples_of(kappa, 8192, seed=2)
    load = points[:, 2] + 0.1 * points[:, 3]
    with np.errstate(all="ignore"):
        rate = np.where(load > 0.0, np.abs(kappa.polynomial(*points.T)) / load, 0.0)
    return 1.1 * _largest(kappa, points, rate)


def _largest(kappa: Amplification, points: Array, values: Array) -> Array:
    """Return the largest values by cell; the largest of all where a cell has no point."""
    table = np.zeros(kappa.errors.shape)
    for cell in np.ndindex(table.shape):
        here = kappa.in_cell(cell, points[:, 0], points[:, 1])
        table[cell] = values[here].max(initial=0.0)
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
    off = np.abs(mean - others.values) / std
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

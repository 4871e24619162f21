"""The polynomial that stands for the process of ln kappa."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fe_training.coupled.loads import samples_of
from fe_training.coupled.process import LoadProcess
from fe_training.coupled.rows import FitRows
from surrogate.coupling.amplification import Amplification
from surrogate.coupling.polynomial import Polynomial

__all__ = ["polynomial_of"]

Array = NDArray[np.float64]

#: Degrees of the polynomial: of x and y together, of xi and w together, and of all four.
_PLACES, _LOADS, _ALL = 8, 3, 9


def polynomial_of(kappa: Amplification, process: LoadProcess, rows: FitRows) -> Polynomial:
    """Return the polynomial that meets the process all over the known loads, and the rows."""
    powers = _powers()
    there = samples_of(kappa, 8192)
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

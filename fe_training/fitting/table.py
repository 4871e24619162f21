"""Tables of A, B, delta, A* and B* made from the means of the Gaussian processes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fe_training.fitting.bounds import DOUBT
from surrogate.contact.coordinates import AT_THE_TIP, coordinates_of
from surrogate.contact.grid import Grid
from surrogate.contact.process_model import ProcessModel
from surrogate.contact.table import CellTable
from surrogate.contact.wedge import wedge_functions, wedge_load

__all__ = ["fit_table"]

Floats = NDArray[np.float64]

SHORT, PAST, STIFFENING = 56, 40, 48

#: Where the cells before the touch are held against the process.
_SAMPLES = 200


def fit_table(
    process: ProcessModel, cells: tuple[int, int, int] = (SHORT, PAST, STIFFENING)
) -> CellTable:
    """Return the table of A, B and (delta - 1)/|x|^(7/4) over the domain of the processes.

    Parameters
    ----------
    process : ProcessModel
        The model that the table is to follow.
    cells : tuple of int
        Cells along g short of and past the touch, and along alpha.

    Returns
    -------
    CellTable
    """
    limits = process.limits
    lowest_touch = float(np.min(limits.log_touch(np.linspace(*limits.log_alpha, 101))))
    beyond = max(limits.log_g[1] - lowest_touch, 0.5)
    grid = Grid(limits.log_g[0], beyond, limits.log_alpha, limits.touch, *cells)
    places, rows = grid.nodes()
    log_g = grid.log_g_of(places[:, np.newaxis], rows)
    # beyond the domain, which the last cells overlap, the processes go on smoothly
    log_alpha = np.broadcast_to(rows, log_g.shape)

    def side(name: str, some: slice, past: bool) -> Floats:
        return _function(process, name, log_g[some], log_alpha[some], past)

    # the node at the touch belongs to either side, on which a quantity that jumps differs
    short, past = slice(None, grid.short + 1), slice(grid.short, None)
    sides = {name: (side(name, short, False), side(name, past, True)) for name in process.processes}
    for name in AT_THE_TIP:
        if name in sides:
            sides[name] = _led_to_the_touch(process, grid, name, sides[name])
    # single precision halves the file
    return CellTable(
        grid,
        {name: (_single(before), _single(beyond)) for name, (before, beyond) in sides.items()},
    )


def _function(
    process: ProcessModel, name: str, log_g: Floats, log_alpha: Floats, past: bool
) -> Floats:
    """Return a function by the mean of its process, on one side of the touch."""
    g, alpha = log_g.ravel(), log_alpha.ravel()
    touched = process.limits.log_touch(alpha)
    mean = process.processes[name].predict_mean(coordinates_of(name, g, alpha, touched, past))
    scales = wedge_functions(log_g, wedge_load(log_g))
    return np.asarray(scales[name] * np.exp(mean.reshape(log_g.shape)))


def _led_to_the_touch(
    process: ProcessModel, grid: Grid, name: str, sides: tuple[Floats, Floats]
) -> tuple[Floats, Floats]:
    """Return nodes of which the one at the touch is moved so that the cells before it are followed.

    The function rises within a part of a cell there: the cubic through its end would swing.
    """
    before, beyond = sides
    places, rows = np.linspace(-2.0, 0.0, _SAMPLES)[:, np.newaxis], grid.nodes()[1]
    log_g = grid.log_g_of(places, rows)
    log_alpha = np.broadcast_to(rows, log_g.shape)
    moved = before.copy()
    moved[-1] += 1.0

    def table(nodes: Floats) -> Floats:
        cells = CellTable(grid, {name: (nodes, beyond)})
        at = np.nextafter(log_g.ravel(), -np.inf), log_alpha.ravel()
        return np.asarray(cells.at((name,), *at)[1][0]).reshape(log_g.shape)

    wanted = _function(process, name, log_g, log_alpha, past=False)
    here = table(before)
    known = log_g - process.limits.log_touch(log_alpha) < -DOUBT * process.touch_error
    pull = np.where(known, (table(moved) - here) / wanted, 0.0)
    off = np.where(known, (wanted - here) / wanted, 0.0)
    moved[-1] = before[-1] + np.sum(pull * off, axis=0) / np.sum(pull * pull, axis=0)
    return moved, beyond


def _single(values: Floats) -> Floats:
    return np.asarray(values.astype(np.float32), dtype=float)

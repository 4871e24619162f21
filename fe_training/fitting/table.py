"""Tables of A, B, delta, A* and B* made from the means of the Gaussian processes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from surrogate.contact.coordinates import coordinates_of
from surrogate.contact.grid import Grid
from surrogate.contact.process_model import ProcessModel
from surrogate.contact.table import CellTable
from surrogate.contact.wedge import wedge_functions, wedge_load

__all__ = ["fit_table"]

Floats = NDArray[np.float64]

SHORT, PAST, STIFFENING = 56, 40, 48


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
    touch = limits.log_touch(log_alpha)
    scales = wedge_functions(log_g, wedge_load(log_g))

    def side(name: str, some: slice, past: bool) -> Floats:
        g, alpha, touched = (each[some].ravel() for each in (log_g, log_alpha, touch))
        mean = process.processes[name].predict_mean(coordinates_of(name, g, alpha, touched, past))
        values = scales[name][some] * np.exp(mean.reshape(log_g[some].shape))
        return np.asarray(values.astype(np.float32), dtype=float)  # which halves the file

    # the node at the touch belongs to either side, on which a quantity that jumps differs
    short, past = slice(None, grid.short + 1), slice(grid.short, None)
    return CellTable(
        grid,
        {name: (side(name, short, False), side(name, past, True)) for name in process.processes},
    )

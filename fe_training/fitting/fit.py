"""From the points of a campaign to the fitted models and their file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fe_training.campaign.store import write_atomically
from fe_training.fitting.bounds import fit_bounds, fit_slip_bounds
from fe_training.fitting.formula import eq9_fits, fit_blend
from fe_training.fitting.points import FitPoints
from fe_training.fitting.process import fit_processes
from fe_training.fitting.table import fit_table
from fe_training.fitting.touch import Touch, fit_touch
from surrogate.basics.files import checksum_line
from surrogate.contact.coordinates import SLIP_QUANTITIES
from surrogate.contact.domain import Domain
from surrogate.contact.process_model import ProcessModel
from surrogate.contact.shipped import FILE, Fitted, content_of, to_file
from surrogate.errors import InputError

__all__ = ["fit", "write_fitted"]

Floats = NDArray[np.float64]

#: Fewest stiffening exponents and points that a fit is made from.
FEWEST_ALPHAS, FEWEST_POINTS = 3, 30

#: B, A* and B* as powers g^n(alpha) beyond the highest g have the slopes over the last part of a
#: decade.
GROWING, _LAST_DECADES = ("normal_load", *SLIP_QUANTITIES), 0.4


def fit(points: FitPoints, about: Mapping[str, Any] | None = None) -> Fitted:
    """Return all fitted models.

    Parameters
    ----------
    points : FitPoints
        What was computed.
    about : mapping, optional
        What is to be told with the models, such as where the points are from.

    Returns
    -------
    Fitted

    Raises
    ------
    InputError
        If there are too few points.
    """
    alphas = np.unique(points.alpha)
    if len(alphas) < FEWEST_ALPHAS or len(points) < FEWEST_POINTS:
        raise InputError(
            f"the models must be fitted to {FEWEST_POINTS} points of {FEWEST_ALPHAS} alphas or "
            f"more, but there are {len(points)} points of {len(alphas)}; finish the campaign first."
        )
    touch = fit_touch(points)
    limits = Domain(
        _ends(points.g),
        _ends(points.alpha),
        touch.coefficients,
        {name: _growth(points, name) for name in points.names if name in GROWING},
        highest_g(points),
    )
    processes, hyperparameters = fit_processes(points, touch)
    table = fit_table(ProcessModel(limits, processes, touch.error))
    constants = fit_blend(points, touch)
    told = {**(about or {}), "eq9": eq9_fits(points), "touch_points": _touch_points(touch)}
    told["truncation"] = points.truncation_rate
    told["scatter"] = {name: asdict(one.scatter) for name, one in hyperparameters.items()}
    bare = Fitted(limits, processes, table, constants, touch.error, told)
    told["bounds"] = fit_bounds(points, touch, processes, bare.models).as_dict()
    if {*SLIP_QUANTITIES} <= {*points.names}:
        told["slip_bounds"] = fit_slip_bounds(points, touch, processes, bare.models).as_dict()
    return replace(bare, about=told)


def write_fitted(folder: Path, fitted: Fitted) -> Path:
    """Write the file of fitted models and its checksum beside it; return the file."""
    file = folder / FILE
    content = content_of(*to_file(fitted))
    write_atomically(file, content)
    write_atomically(file.with_name(f"{FILE}.sha256"), checksum_line(FILE, content))
    return file


def _ends(values: Floats) -> tuple[float, float]:
    return float(values.min()), float(values.max())


def highest_g(points: FitPoints) -> tuple[tuple[float, float], ...]:
    """Return the highest g for each alpha, as pairs of the corners of its line.

    Between two alphas whose highest g differ it rises from the lower one on, where both are known.
    """
    alphas = np.unique(points.alpha)
    ends = [float(points.g[points.alpha == alpha].max()) for alpha in alphas]
    if len(set(ends)) == 1:
        return ()
    beside = zip([ends[0], *ends[:-1]], ends, [*ends[1:], ends[-1]], strict=True)
    corners = [before != end or after != end for before, end, after in beside]
    pairs = zip(map(float, alphas), ends, strict=True)
    return tuple(pair for pair, corner in zip(pairs, corners, strict=True) if corner)


def _growth(points: FitPoints, name: str) -> tuple[float, ...]:
    """Return d ln/d ln g of a function at the highest g as a polynomial in ln alpha."""
    found = []
    for alpha in np.unique(points.alpha):
        here = points.taken(points.alpha == alpha)
        last = here.g >= 10.0**-_LAST_DECADES * here.g.max()
        if last.sum() >= 2:
            values = getattr(here, name)[last]
            slope = np.polyfit(np.log(here.g[last]), np.log(values), 1)[0]
            found.append((np.log(alpha), slope))
    if not found:
        raise InputError(
            "no alpha has two points at its highest g, so that B cannot be continued beyond it; "
            "finish the campaign first."
        )
    x, y = np.array(found).T
    degree = min(2, len(x) - 1)
    return tuple(map(float, np.polynomial.polynomial.polyfit(x, y, degree)))


def _touch_points(touch: Touch) -> dict[str, Any]:
    return {
        "alpha": touch.alpha.tolist(),
        "g": touch.g.tolist(),
        "std_of_ln_g": touch.std.tolist(),
        "misfit_of_ln_g": touch.misfit,
    }

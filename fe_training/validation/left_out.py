"""Errors of the models at points of the campaign that they were fitted without."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from fe_training.fitting.formula import fit_blend
from fe_training.fitting.points import FitPoints
from fe_training.fitting.process import leave_out_errors, rows_of
from fe_training.fitting.touch import Touch
from fe_training.validation.model_errors import contact_errors, the_models
from surrogate.contact.formula import BlendModel
from surrogate.contact.process import GaussianProcess
from surrogate.contact.shipped import Fitted

__all__ = ["left_out_of_blend", "left_out_of_process", "left_out_stds"]

Floats = NDArray[np.float64]


def left_out_of_process(fitted: Fitted, points: FitPoints, groups: Floats) -> dict[str, Floats]:
    """Return the relative errors of A, B and delta when each group is predicted from the others.

    Parameters
    ----------
    fitted : Fitted
        The models; their hyperparameters and g_touch(alpha) are kept.
    points : FitPoints
        What they were fitted to.
    groups : ndarray, shape (points,)
        Points with equal numbers are left out together.

    Returns
    -------
    dict of str to ndarray
        Where the process of delta does not have a point, near the touch and beyond, the error is
        that of the model fitted to all.
    """
    all_points = contact_errors(the_models(fitted)["gp"], points)
    found = {}
    for name in fitted.processes:
        rows, error = _left_out(fitted.processes[name], points, groups)[:2]
        factor = np.exp(error)
        if name == "distance":
            factor = 1.0 + (points.distance[rows] - 1.0) * (factor - 1.0) / points.distance[rows]
        full = all_points[name].copy()
        full[rows] = factor - 1.0
        found[name] = full
    return found


def left_out_stds(
    fitted: Fitted, points: FitPoints, groups: Floats
) -> dict[str, tuple[Floats, Floats]]:
    """Return error and standard deviation of each process's quantity, its noise included."""
    return {
        name: _left_out(fitted.processes[name], points, groups)[1:] for name in fitted.processes
    }


def left_out_of_blend(fitted: Fitted, points: FitPoints, touch: Touch) -> dict[str, Floats]:
    """Return the relative errors of the formula at each alpha when it is fitted to the others."""
    found = {name: np.zeros(len(points)) for name in points.names}
    for alpha in np.unique(points.alpha):
        here = points.alpha == alpha
        model = BlendModel(
            fitted.limits, fit_blend(points.taken(~here), touch, start=fitted.constants)
        )
        for name, errors in contact_errors(model, points.taken(here)).items():
            found[name][here] = errors
    return found


def _left_out(
    process: GaussianProcess, points: FitPoints, groups: Floats
) -> tuple[NDArray[np.intp], Floats, Floats]:
    rows = rows_of(process, points)
    return rows, *leave_out_errors(process, groups[rows])

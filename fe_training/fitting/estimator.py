"""The fit of the shipped models as an estimator of scikit-learn, for data of one's own."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from sklearn.base import BaseEstimator, RegressorMixin
from sklearn.utils.validation import check_array, check_is_fitted

from fe_training.fitting.fit import fit
from fe_training.fitting.points import ARC_FLOOR, DISTANCE_FLOOR, LOAD_FLOOR, FitPoints
from surrogate.basics.checks import shown
from surrogate.choosing.by_name import FITTED_NAMES
from surrogate.errors import InputError

__all__ = ["ContactRegressor"]

Floats = NDArray[np.float64]


class ContactRegressor(RegressorMixin, BaseEstimator):  # type: ignore[misc]
    """Regress A, B and delta/R_w on g and alpha, as the shipped models do.

    It works where scikit-learn's own regressors do, in `cross_val_score`, in pipelines, in
    searches over parameters: for instance to see how well whole exponents are predicted that were
    left out. Outside the fitted range it continues as the models do, by their asymptotes in g and
    by the nearest alpha.

    Parameters
    ----------
    model : str, default "table"
        "power-law", "table" or "gp": which of the models answers.

    Examples
    --------
    >>> ContactRegressor(model="gp").get_params()
    {'model': 'gp'}
    """

    def __init__(self, model: str = "table") -> None:
        self.model = model

    def fit(self, X: ArrayLike, y: ArrayLike, std: ArrayLike | None = None) -> ContactRegressor:
        """Fit all models to configurations.

        Parameters
        ----------
        X : array_like, shape (points, 2)
            g = J/(mu R_w) and alpha [-].
        y : array_like, shape (points, 3)
            A, B and delta/R_w [-].
        std : array_like, shape (points, 3), optional
            Standard errors, of A absolute, of B and delta relative [-]; by default the smallest
            that the shipped fit believes.

        Returns
        -------
        ContactRegressor
            Itself; `models_` has what was fitted.

        Raises
        ------
        InputError
            If the model has no such name, an array has the wrong shape or numbers that are not
            positive, or the points are too few.
        """
        if self.model not in FITTED_NAMES:
            raise InputError(
                f"model must be one of {', '.join(FITTED_NAMES)}, but is {shown(self.model)}; "
                "choose one."
            )
        at = _checked("X", X, 2, "g and alpha")
        values = _checked("y", y, 3, "A, B and delta/R_w")
        if std is None:
            std = np.broadcast_to([ARC_FLOOR, LOAD_FLOOR, DISTANCE_FLOOR], values.shape)
        errors = _checked("std", std, 3, "the standard errors of A, B and delta/R_w")
        if not len(at) == len(values) == len(errors):
            raise InputError(
                f"X, y and std must have one row a point, but have {len(at)}, {len(values)} and "
                f"{len(errors)}; give as many of each."
            )
        order = np.lexsort((at[:, 0], at[:, 1]))
        points = FitPoints(at[order, 1], at[order, 0], *values[order].T, *errors[order].T)
        self.models_ = fit(points, {"origin": "fitted by ContactRegressor"}).models
        self.n_features_in_ = 2
        return self

    def predict(self, X: ArrayLike) -> Floats:
        """Return A, B and delta/R_w [-] at g and alpha, in three columns.

        Parameters
        ----------
        X : array_like, shape (points, 2)
            g = J/(mu R_w) and alpha [-].

        Returns
        -------
        ndarray, shape (points, 3)

        Raises
        ------
        InputError
            If X has the wrong shape, or numbers that are not positive.
        """
        check_is_fitted(self)
        g, alpha = np.ascontiguousarray(_checked("X", X, 2, "g and alpha").T)
        model = self.models_[self.model]
        columns = [model.arc(g, alpha), model.normal_load(g, alpha), model.distance(g, alpha)]
        return np.stack(columns, axis=1)


def _checked(name: str, value: Any, columns: int, words: str) -> Floats:
    """Return a table of positive numbers."""
    try:
        array: Floats = check_array(value, dtype=np.float64)
    except ValueError as error:
        reason = str(error).splitlines()[0].rstrip(".")
        raise InputError(
            f"{name} must be a table of numbers, but: {reason}; give {words} in {columns} columns."
        ) from None
    if array.shape[1] != columns or not np.all(array > 0.0):
        raise InputError(
            f"{name} must have {columns} columns of positive numbers, but has the shape "
            f"{array.shape} and numbers from {array.min():.3g}; give {words}."
        )
    return array

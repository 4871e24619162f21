"""Surrogates of other libraries, fitted to the campaign, and the errors of all, for one trade.

Each is a user's plain choice: scikit-learn's Gaussian process has the quantities, kernel and noise
of the shipped "gp", whose accuracy it therefore has; scipy's spline is one over ln g and ln alpha,
through values that cubic splines at each alpha give on a common g; SMT's kriging is fitted by SMT.
The last two are of ln A, ln B and ln(delta/R_w).
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from fe_training.campaign.dataset import load_campaign
from fe_training.fitting.points import FitPoints, points_of
from fe_training.validation.left_out import left_out_of_process
from fe_training.validation.model_errors import (
    Errors,
    contact_errors,
    finite_element_errors,
    force_errors,
    summary,
)
from surrogate.contact.coordinates import QUANTITIES
from surrogate.contact.process_model import ProcessModel
from surrogate.contact.shipped import Fitted, shipped

OFF_GRID = "off-grid.h5"
#: Without points off the grid, every third alpha is left out, but not the ends.
EVERY = 3


@dataclass(frozen=True)
class Contender:
    """A surrogate of another library: its functions of g and alpha, and the size of its arrays.

    `functions` returns A, B and delta, or those of them that a third argument names. `with_std`
    computes means and standard deviations, whatever of them it returns.
    """

    name: str
    module: str
    functions: Callable[..., list[Any]]
    with_std: Callable[[Any, Any], list[Any]] | None
    kilobytes: float


@dataclass(frozen=True)
class Split:
    """Points to fit the others to, and points to judge all by."""

    everything: FitPoints
    judged: FitPoints
    left_out: Any
    words: str

    @property
    def fitted(self) -> FitPoints:
        """What the others are fitted to."""
        return self.everything.taken(~self.left_out)


def split(models: Path) -> Split:
    """Return the points off the grid where there are some, else alphas of the campaign."""
    points = points_of(load_campaign(models / "campaign.h5"))
    file = models / OFF_GRID
    if file.is_file():
        others = points_of(load_campaign(file), single_mesh=True)
        others = others.taken(shipped().limits.holds(others.g, others.alpha))
        nothing = np.zeros(len(points), bool)
        words = f"{len(others)} finite-element solutions off the grid, which no model has seen"
        return Split(points, others, nothing, words)
    left = np.unique(points.alpha)[1:-1][EVERY // 2 :: EVERY]
    mask = np.isin(points.alpha, left)
    named = ", ".join(f"{alpha:g}" for alpha in left)
    words = (
        f"the {mask.sum()} points of the campaign at alpha = {named}, which were left out for the "
        "purpose (`power-law` is the shipped one, which has seen them)"
    )
    return Split(points, points.taken(mask), mask, words)


def contenders(points: FitPoints, gp: ProcessModel, left_out: Any) -> list[Contender]:
    """Return the surrogates of the other libraries that are installed."""
    made = [scikit_learn(gp, points), scipy_spline(points)]
    if find_spec("smt"):
        made.append(smt_kriging(points))
    return made


def scikit_learn(gp: ProcessModel, points: FitPoints) -> Contender:
    """Return the shipped processes as scikit-learn evaluates them, with the same numbers."""
    from dataclasses import replace

    from sklearn.gaussian_process import GaussianProcessRegressor
    from sklearn.gaussian_process.kernels import RBF, ConstantKernel

    pairs = set(zip(np.log(points.g), np.log(points.alpha), strict=True))
    held, evaluated = {}, {}
    for name, process in gp.processes.items():
        rows = np.array([pair in pairs for pair in zip(*process.inputs[:, :2].T, strict=True)])
        kernel = ConstantKernel(process.variance) * RBF(process.lengths)
        regressor = GaussianProcessRegressor(kernel, alpha=process.noise[rows], optimizer=None)
        held[name] = regressor.fit(process.inputs[rows], process.values[rows] - process.mean)
        evaluated[name] = Regressor(regressor, process.mean)
    model = replace(gp, processes=evaluated)
    size = sum(r.X_train_.nbytes + r.L_.nbytes + r.alpha_.nbytes for r in held.values()) / 1e3
    return Contender(
        "scikit-learn GPR",
        "sklearn.gaussian_process",
        lambda g, alpha, names=QUANTITIES: model.contact(names, g, alpha),
        lambda g, alpha: model.stds(QUANTITIES, g, alpha),
        size,
    )


@dataclass(frozen=True)
class Regressor:
    """A regressor of scikit-learn in the place of `surrogate.contact.process`."""

    regressor: Any
    mean: float

    def predict(self, at: Any) -> Any:
        """Return mean and standard deviation."""
        mean, std = self.regressor.predict(at, return_std=True)
        return self.mean + mean, std

    def predict_mean(self, at: Any) -> Any:
        """Return the mean."""
        return self.mean + self.regressor.predict(at)


def scipy_spline(points: FitPoints) -> Contender:
    """Return bicubic splines over ln g and ln alpha."""
    from scipy.interpolate import CubicSpline, RectBivariateSpline

    alphas = np.unique(points.alpha)
    lines = [points.taken(points.alpha == alpha) for alpha in alphas]
    count = min(len(line) for line in lines)
    log_g = np.linspace(np.log(points.g.min()), np.log(points.g.max()), count)
    splines = {}
    for name in QUANTITIES:
        values = [CubicSpline(np.log(line.g), np.log(getattr(line, name)))(log_g) for line in lines]
        splines[name] = RectBivariateSpline(np.log(alphas), log_g, np.array(values))
    size = sum(sum(a.nbytes for a in spline.tck) for spline in splines.values()) / 1e3

    def functions(g: Any, alpha: Any, names: Sequence[str] = QUANTITIES) -> list[Any]:
        at = np.log(alpha), np.log(g)
        return [np.exp(splines[name].ev(*at)) for name in names]

    return Contender("RectBivariateSpline", "scipy.interpolate", functions, None, size)


def smt_kriging(points: FitPoints) -> Contender:
    """Return SMT's ordinary kriging with its own fit."""
    from smt.surrogate_models import KRG

    at = np.column_stack([np.log(points.g), np.log(points.alpha)])
    models = {}
    for name in QUANTITIES:
        models[name] = KRG(print_global=False, n_start=1, nugget=1e-10, seed=0)
        models[name].set_training_values(at, np.log(getattr(points, name)))
        models[name].train()

    def where(g: Any, alpha: Any) -> Any:
        return np.column_stack(np.broadcast_arrays(np.log(g), np.log(alpha)))

    def functions(g: Any, alpha: Any, names: Sequence[str] = QUANTITIES) -> list[Any]:
        x = where(g, alpha)
        return [np.exp(models[name].predict_values(x)[:, 0]) for name in names]

    def stds(g: Any, alpha: Any) -> list[Any]:
        x = where(g, alpha)
        return [(model.predict_values(x), model.predict_variances(x)) for model in models.values()]

    size = sum(
        value.nbytes
        for model in models.values()
        for value in (*vars(model).values(), *model.optimal_par.values())
        if isinstance(value, np.ndarray)
    )
    return Contender("SMT kriging", "smt.surrogate_models", functions, stds, size / 1e3)


def shipped_errors(fitted: Fitted, points: Split) -> dict[str, dict[str, Any]]:
    """Return the errors of A, B and delta of the shipped models at the judged points."""
    from surrogate.contact.closed_forms import FORCE_MODELS

    closed = {name: FORCE_MODELS[name] for name in ("eq13", "eq9")}
    found = {
        name: contact_errors(model, points.judged)
        for name, model in {**closed, **fitted.models}.items()
    }
    if points.left_out.any():
        groups = np.where(points.left_out, 0.0, 1.0 + np.arange(len(points.everything)))
        without = left_out_of_process(fitted, points.everything, groups)
        errors = {name: each[points.left_out] for name, each in without.items()}
        found["gp"] = found["table"] = errors
    return found


def errors_of(functions: Callable[[Any, Any], list[Any]], judged: FitPoints) -> dict[str, Any]:
    """Return the errors of A, B and delta of functions at the judged points."""
    values = functions(judged.g, judged.alpha)
    return {
        name: value / getattr(judged, name) - 1.0
        for name, value in zip(QUANTITIES, values, strict=True)
    }


def finite_elements(judged: FitPoints) -> dict[str, Any]:
    """Return the finite elements' own error bars."""
    return finite_element_errors(judged)


def worst_force(errors: Mapping[str, Any], judged: FitPoints) -> Errors:
    """Return the errors of the force, over all tau_w/(mu xi) and xi of the model card."""
    forces = force_errors(errors["arc"], errors["normal_load"], judged)
    return summary(np.array(list(forces.values())).ravel())

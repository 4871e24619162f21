"""How far the fitted models are from finite elements: left-out points, and points never used."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fe_training.fitting.points import FitPoints
from surrogate.basics.elementwise import apply
from surrogate.choosing.auto import AutomaticTerms
from surrogate.choosing.candidates import candidates
from surrogate.choosing.choice import choose_terms
from surrogate.contact.base import ForceModel
from surrogate.contact.bounds import Bounds
from surrogate.contact.closed_forms import FORCE_MODELS
from surrogate.contact.coordinates import QUANTITIES, log_touch
from surrogate.contact.fitted import FittedModel
from surrogate.contact.shipped import Fitted

__all__ = [
    "FORCE",
    "MODELS",
    "RATIOS",
    "SHORT",
    "XIS",
    "Continued",
    "Errors",
    "Validation",
    "by_strength",
    "calibration",
    "contact_errors",
    "finite_element_errors",
    "force_errors",
    "promises",
    "regions",
    "summary",
    "tables_of",
    "the_models",
]

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]

MODELS = ("eq13", "power-law", "table", "gp")

#: tau_w/(mu xi) and xi at which the force is judged. Infinity is wear alone, without cleavage.
RATIOS = (0.0, 0.1, 1.0, 10.0, 100.0, np.inf)
XIS = (0.0, 0.01, 0.1, 0.5, 1.0)
FORCE = "force"

#: The touch is near within this factor of g_touch.
NEAR = 2.0

#: The region in which A* and B* do not depend on the size of the tip.
SHORT = "tip not in contact"


@dataclass(frozen=True, slots=True)
class Errors:
    """Largest, 95 % and median relative error of a number of points.

    Parameters
    ----------
    count : int
        How many points.
    largest, most, median : float
        The errors [-]; nan without points.
    """

    count: int
    largest: float
    most: float
    median: float


def summary(errors: Floats) -> Errors:
    """Return largest, 95 % and median of absolute errors.

    Examples
    --------
    >>> summary(np.array([-0.3, 0.1, 0.2]))
    Errors(count=3, largest=0.3, most=0.29, median=0.2)
    """
    if not errors.size:
        return Errors(0, np.nan, np.nan, np.nan)
    most, median = np.quantile(np.abs(errors), [0.95, 0.5]).round(12)
    return Errors(errors.size, float(np.max(np.abs(errors))), float(most), float(median))


def the_models(fitted: Fitted) -> dict[str, ForceModel]:
    """Return the models that are compared."""
    return {**{"eq13": FORCE_MODELS["eq13"]}, **fitted.models}


def contact_errors(model: ForceModel, points: FitPoints) -> dict[str, Floats]:
    """Return the relative errors of the functions of a model at points."""
    names = points.names if isinstance(model, FittedModel) else QUANTITIES
    found = model.contact(names, points.g, points.alpha)
    return {
        name: np.broadcast_to(value, points.g.shape) / getattr(points, name) - 1.0
        for name, value in zip(names, found, strict=True)
    }


def force_errors(arc: Floats, load: Floats, points: FitPoints) -> dict[tuple[float, float], Floats]:
    """Return the relative errors of F_ss over tau_w/(mu xi) and xi.

    Parameters
    ----------
    arc, load : ndarray, shape (points,)
        Relative errors of A and B.
    points : FitPoints
        Where.

    Returns
    -------
    dict
        By (ratio, xi). With xi = 0 and a finite ratio the force is Gamma_o, without error; an
        infinite ratio is wear alone, whatever xi, which is worse than any wear beside cleavage.
    """
    worn, loaded = arc * points.arc, load * points.normal_load
    errors = {}
    for ratio in RATIOS:
        for xi in XIS:
            if np.isinf(ratio):
                errors[ratio, xi] = arc
                continue
            force = points.g + 2.0 * xi * (ratio * points.arc + points.normal_load)
            errors[ratio, xi] = 2.0 * xi * (ratio * worn + loaded) / force
    return errors


def finite_element_errors(points: FitPoints) -> dict[str, Floats]:
    """Return the finite elements' own relative error bars of A, B, delta and the worst force."""
    own = {name: points.relative_std(name) for name in points.names}
    return {**own, FORCE: np.maximum(own["arc"], own["normal_load"])}


def regions(fitted: Fitted, points: FitPoints) -> dict[str, Mask]:
    """Return which points are in which region."""
    x = np.log(points.g) - log_touch(fitted.limits.touch, np.log(points.alpha))
    near = np.log(NEAR)
    low, high = points.alpha <= 3.0, points.alpha > 6.0
    return {
        "whole domain": np.ones(len(points), bool),
        f"far field (g < g_touch/{NEAR:g})": x < -near,
        f"near the touch (within a factor of {NEAR:g})": np.abs(x) <= near,
        f"indentation (g > {NEAR:g} g_touch)": x > near,
        SHORT: x < 0.0,
        "alpha up to 3": low,
        "alpha from 3 to 6": ~low & ~high,
        "alpha above 6": high,
    }


def calibration(errors: Floats, std: Floats, own: Floats) -> dict[str, float]:
    """Return the shares of errors within one and two standard deviations.

    Parameters
    ----------
    errors, std, own : ndarray, shape (points,)
        Errors of a prediction, its standard deviations and those of the truth.
    """
    z = np.abs(errors) / np.hypot(std, own)
    if not z.size:
        return {"count": 0, "one": np.nan, "two": np.nan}
    return {"count": z.size, "one": float(np.mean(z <= 1.0)), "two": float(np.mean(z <= 2.0))}


def tables_of(
    fitted: Fitted, points: FitPoints, errors_of: Callable[[str], Mapping[str, Floats]]
) -> dict[str, dict[str, dict[str, Errors]]]:
    """Return the errors of A, B, delta and F_ss by model, region and function.

    Parameters
    ----------
    fitted : Fitted
        The models, for the regions.
    points : FitPoints
        Where.
    errors_of : callable
        Relative errors of A, B and delta by the name of a model.
    """
    where = regions(fitted, points)
    tables: dict[str, dict[str, dict[str, Errors]]] = {}
    for model in MODELS:
        errors = dict(errors_of(model))
        forces = np.array(list(force_errors(errors["arc"], errors["normal_load"], points).values()))
        tables[model] = {
            region: {
                **{name: summary(error[mask]) for name, error in errors.items()},
                FORCE: summary(forces[:, mask].ravel()),
            }
            for region, mask in where.items()
        }
    return tables


def by_strength(
    points: FitPoints, errors: Mapping[str, Floats]
) -> list[tuple[float, float, Errors]]:
    """Return the errors of F_ss for each tau_w/(mu xi) and xi."""
    forces = force_errors(errors["arc"], errors["normal_load"], points)
    return [(ratio, xi, summary(each)) for (ratio, xi), each in forces.items()]


def promises(
    fitted: Fitted, points: FitPoints, rtols: Sequence[float], slack: Floats
) -> list[dict[str, Any]]:
    """Return for each rtol how far "auto" is from what it promised.

    Parameters
    ----------
    fitted : Fitted
        The models.
    points : FitPoints
        Where the truth is known.
    rtols : sequence of float
        What is asked for.
    slack : ndarray, shape (points,)
        The finite elements' own relative error bar, which is reported beside.

    Returns
    -------
    list of dict
        For each rtol: the number of forces, how many were refused, by which models the others
        were computed, the largest error over rtol, and how many were beyond rtol, and beyond it by
        more than the finite elements' own error bar.
    """
    found = []
    for rtol in rtols:
        line: dict[str, Any] = {"rtol": rtol, "forces": 0, "refused": 0, "beyond": 0, "clearly": 0}
        line["worst"], used = 0.0, dict.fromkeys(MODELS, 0)
        for ratio in RATIOS:
            for xi in XIS:
                done, error, names = _promised(fitted, points, ratio, xi, rtol)
                line["forces"] += len(points)
                line["refused"] += int((~done).sum())
                line["beyond"] += int((error > rtol).sum())
                line["clearly"] += int((error > rtol + slack[done]).sum())
                line["worst"] = max(line["worst"], float(np.max(error / rtol, initial=0.0)))
                for name in MODELS:
                    used[name] += int((names == name).sum())
        found.append({**line, "used": used})
    return found


def _promised(
    fitted: Fitted, points: FitPoints, ratio: float, xi: float, rtol: float
) -> tuple[Mask, Floats, NDArray[np.str_]]:
    """Return where rtol can be had, the errors of the forces there, and by which models."""
    one = np.ones(len(points))
    alone = np.isinf(ratio)  # wear alone, without cleavage
    wear, friction = (one, 0.0 * one) if alone else (ratio * xi * one, xi * one)
    free = 4.0 * wear, friction * (4.0 + points.g)
    cleavage = 0.0 * one if alone else points.g
    known = candidates(fitted)
    chosen = choose_terms(points.g, points.alpha, (cleavage, *free), rtol, known, refuse=False)
    done = chosen.bound <= rtol
    if not np.any(done):
        return done, np.zeros(0), np.zeros(0, str)
    scene = one, points.g, one, friction, wear, points.alpha
    some = tuple(values[done] for values in scene)
    automatic = AutomaticTerms(some, rtol, of_dissipation=bool(alone), known=known)
    rubbed, worn, _, number, _ = apply(automatic, some, automatic.dtypes)
    automatic.finish(extrapolate=False)
    true = cleavage + 2.0 * (wear * points.arc + friction * points.normal_load)
    return (
        done,
        np.abs((cleavage[done] + rubbed + worn) / true[done] - 1.0),
        automatic.names(number),
    )


@dataclass(frozen=True, slots=True)
class Continued:
    """How far the models are off above the highest g, where their asymptotes continue them.

    Parameters
    ----------
    count : int
        Solutions there; none of them was used in fitting.
    bounds : Bounds
        By model and function, over g/(highest g) and alpha: the largest relative error of the
        solutions up to there, each with its own error bar [-]; infinite where no solution reaches
        the end of the cell.
    """

    count: int
    bounds: Bounds

    def as_dict(self) -> dict[str, Any]:
        """Return what goes into the file of the models."""
        return {"count": self.count, **self.bounds.as_dict()}


@dataclass(frozen=True, slots=True)
class Validation:
    """All that was found out about the errors of fitted models; see `validation`.

    Parameters
    ----------
    one_out, alpha_out, off_grid : mapping or None
        Errors by model, region and function of points left out alone, with their alpha, and of
        those never used; None where there are none of the last.
    strengths : mapping
        By model, the errors of F_ss for each tau_w/(mu xi) and xi: off the grid, or where there is
        no such point, at the points left out with their alpha.
    finite_elements : mapping
        By sample, the finite elements' own error bars by function.
    calibration : mapping
        By sample and function, the shares within one and two standard deviations.
    promises : list
        Of "auto" for each rtol.
    table_from_process : mapping
        By function, the largest relative difference of the table from the process.
    beyond : Continued or None
        Errors of what continues the models above their highest g; None without such solutions.
    """

    one_out: Mapping[str, Any]
    alpha_out: Mapping[str, Any]
    off_grid: Mapping[str, Any] | None
    strengths: Mapping[str, list[tuple[float, float, Errors]]]
    finite_elements: Mapping[str, Mapping[str, Errors]]
    calibration: Mapping[str, Mapping[str, Mapping[str, float]]]
    promises: list[dict[str, Any]]
    table_from_process: Mapping[str, float]
    beyond: Continued | None = None

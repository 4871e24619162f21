"""From a data set to the shipped models: fit, validation, files."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict, replace
from datetime import datetime, timezone
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from fe_training.campaign.store import write_atomically
from fe_training.fitting.bounds import DOUBT, fit_slip_bounds
from fe_training.fitting.fit import fit, write_fitted
from fe_training.fitting.points import FitPoints, points_of
from fe_training.fitting.process import transformed
from fe_training.fitting.scatter import Scatter
from fe_training.fitting.touch import Touch, fit_touch
from fe_training.validation.continuation import continued
from fe_training.validation.left_out import (
    left_out_of_blend,
    left_out_of_process,
    left_out_stds,
)
from fe_training.validation.model_card import model_card
from fe_training.validation.model_errors import (
    Errors,
    Validation,
    by_strength,
    calibration,
    contact_errors,
    finite_element_errors,
    promises,
    summary,
    tables_of,
    the_models,
)
from surrogate.contact.coordinates import LOADS, SLIP_QUANTITIES
from surrogate.contact.process_model import ProcessModel
from surrogate.contact.shipped import Fitted
from surrogate.errors import InputError

if TYPE_CHECKING:
    from fe_training.campaign.dataset import Campaign

__all__ = ["CARD", "make_surrogates", "validation"]

CARD = "model-card.md"
LARGEST_FILE = 160_000

#: What the finite body may take off B, and J may differ from 2 F_h, at solutions that models are
#: judged by; both are in their error bars.
DOUBTFUL = 0.01
_RTOLS = (0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005)
_RANDOM_POINTS = 20_000


def make_surrogates(
    data: Campaign,
    out: Path,
    off_grid: Campaign | None,
    single_mesh: bool,
    say: Callable[[str], None],
) -> Path:
    """Fit the models to a data set, validate them, and write their file and their card.

    Parameters
    ----------
    data : Campaign
        The campaign.
    out : Path
        Where the files go.
    off_grid : Campaign or None
        Solutions that are not to be used in fitting.
    single_mesh : bool
        Whether points of one mesh level are taken too.
    say : callable
        Tells a line.

    Returns
    -------
    Path
        The file of the models.

    Raises
    ------
    InputError
        If there are too few points, or the file would be too large.
    """
    points = points_of(data, single_mesh)
    wanted = data.design.points
    say(f"    {len(points)} of {wanted} points, {len(np.unique(points.alpha))} alphas")
    fitted = fit(points, _about(data, points, wanted, single_mesh))
    others = points_of(off_grid, single_mesh=True, doubtful=DOUBTFUL) if off_grid else None
    found = validation(fitted, points, others)
    told = {"errors": _told(found), "beyond": found.beyond.as_dict() if found.beyond else None}
    if {*SLIP_QUANTITIES} <= {*points.names}:
        known = fit_touch(points), fitted.processes, fitted.models
        told["slip_bounds"] = fit_slip_bounds(points, *known, others).as_dict()
    fitted = replace(fitted, about={**fitted.about, **told})
    file = write_fitted(out, fitted)
    size = file.stat().st_size
    if size > LARGEST_FILE:
        raise InputError(
            f"{file} has {size} bytes, more than {LARGEST_FILE}; make the table coarser."
        )
    say(f"    {file}, {size / 1e3:.0f} kB, checksum beside it")
    card = model_card(fitted, found)
    write_atomically(out / CARD, card.encode())
    say(f"4/4 validation: {out / CARD}")
    return file


def validation(fitted: Fitted, points: FitPoints, off_grid: FitPoints | None) -> Validation:
    """Return the errors of fitted models.

    Parameters
    ----------
    fitted : Fitted
        The models.
    points : FitPoints
        What they were fitted to.
    off_grid : FitPoints or None
        Points that were not used.

    Returns
    -------
    Validation
    """
    every = np.arange(len(points), dtype=float)
    alone = left_out_of_process(fitted, points, every)
    together = left_out_of_process(fitted, points, points.alpha)
    models = the_models(fitted)
    direct = {name: contact_errors(models[name], points) for name in ("eq13", "power-law")}
    touch = fit_touch(points)
    blend = left_out_of_blend(fitted, points, touch)
    one_out = {**direct, "gp": alone, "table": alone}
    alpha_out = {**direct, "power-law": blend, "gp": together, "table": together}
    shares = {"left out alone": _left_out_shares(fitted, points, every)}
    shares["left out with their alpha"] = _left_out_shares(fitted, points, points.alpha)
    bars = {"campaign": _bars(points)}
    judged, errors = points, alpha_out
    above = None
    if off_grid is not None:
        inside = fitted.limits.holds(off_grid.g, off_grid.alpha)
        above = continued(fitted, off_grid.taken(~inside))
        off_grid = off_grid.taken(inside)
        bars["off the grid"] = _bars(off_grid)
        judged = off_grid
        errors = {name: contact_errors(model, off_grid) for name, model in models.items()}
        shares["off the grid"] = _off_grid_shares(fitted, off_grid, touch)
    slack = finite_element_errors(judged)["force"]
    return Validation(
        one_out=tables_of(fitted, points, one_out.__getitem__),
        alpha_out=tables_of(fitted, points, alpha_out.__getitem__),
        off_grid=tables_of(fitted, off_grid, errors.__getitem__) if off_grid is not None else None,
        strengths={name: by_strength(judged, errors[name]) for name in models},
        finite_elements=bars,
        calibration=shares,
        promises=promises(fitted, judged, _RTOLS, slack),
        table_from_process=_table_from_process(fitted),
        beyond=above,
    )


def _bars(points: FitPoints) -> dict[str, Errors]:
    return {name: summary(bars) for name, bars in finite_element_errors(points).items()}


def _left_out_shares(
    fitted: Fitted, points: FitPoints, groups: Any
) -> dict[str, Mapping[str, float]]:
    return {
        name: calibration(error, std, np.zeros_like(std))
        for name, (error, std) in left_out_stds(fitted, points, groups).items()
    }


def _off_grid_shares(
    fitted: Fitted, points: FitPoints, touch: Touch
) -> dict[str, Mapping[str, float]]:
    found: dict[str, Mapping[str, float]] = {}
    model = fitted.models["gp"]
    assert isinstance(model, ProcessModel)
    for name, (at, values, differences) in transformed(points, touch).items():
        mean, std = fitted.processes[name].predict(at)
        if name in LOADS:
            std = np.hypot(std, model.truncated(at[:, 0]))
        own = np.sqrt(Scatter(**fitted.about["scatter"][name]).of(differences))
        found[name] = calibration(mean - values, std, own)
    return found


def _table_from_process(fitted: Fitted) -> dict[str, float]:
    """Return the largest differences at random points, but for the touch where A* is not known."""
    random = np.random.default_rng(0)
    limits = fitted.limits
    g = np.exp(random.uniform(*limits.log_g, _RANDOM_POINTS))
    alpha = random.uniform(*limits.alpha, _RANDOM_POINTS)
    x = np.log(g) - limits.log_touch(np.log(alpha))
    known = limits.holds(g, alpha) & (np.abs(x) > DOUBT * fitted.touch_error)
    g, alpha = g[known], alpha[known]
    names = tuple(fitted.processes)
    table, process = (fitted.models[name].contact(names, g, alpha) for name in ("table", "gp"))
    return {
        name: float(np.max(np.abs(t / p - 1.0)))
        for name, t, p in zip(names, table, process, strict=True)
    }


def _about(data: Campaign, points: FitPoints, wanted: int, single_mesh: bool) -> dict[str, Any]:
    software = data.software[-1] if data.software else {}
    return {
        "provenance": {
            "design_hash": data.design.hash,
            "data_date": data.provenance["date"],
            "date": datetime.now(timezone.utc).isoformat(timespec="seconds"),
            "points": len(points),
            "points_wanted": wanted,
            "single_mesh": single_mesh,
            "software": dict(software),
        },
        "touch_tip": "g_touch is that of the finite-element tip, with the notch of the design",
    }


def _told(found: Validation) -> dict[str, Any]:
    """Return the errors over the whole domain, as they go into the file."""

    def whole(tables: Mapping[str, Any] | None) -> Any:
        if tables is None:
            return None
        return {
            model: {name: asdict(errors) for name, errors in by_region["whole domain"].items()}
            for model, by_region in tables.items()
        }

    return {
        "left out with their alpha": whole(found.alpha_out),
        "off the grid": whole(found.off_grid),
    }

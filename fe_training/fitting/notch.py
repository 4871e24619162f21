"""What the radius of the tip adds to A* and B* where it touches the wire: solved, fitted, judged.

The campaign has each configuration near the touch and beyond with two notches, of which the slopes
by ln(1/r) are fitted. Solutions with sharper and blunter notches, and at alphas between, are not
fitted: they are what the errors are measured at.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from fe_training.campaign.store import write_atomically
from surrogate.basics.files import checksum_line
from surrogate.contact.archive import content_of, read_fitted
from surrogate.contact.fitted import SLIP, FittedModel
from surrogate.contact.shipped import Fitted
from surrogate.coupling.notch import NEAR, NotchSlip
from surrogate.coupling.notched import NOTCH_FILE

if TYPE_CHECKING:
    from fe_training.campaign.dataset import Campaign

__all__ = ["CASES", "COLUMNS", "Case", "fit_notch", "missing", "read_rows", "solve_case", "write"]

Floats = NDArray[np.float64]
Rows = dict[str, Floats]

COLUMNS = ("alpha", "notch", "g", "slip_arc", "slip_load", "force_mismatch", "reached")

#: Up to this alpha A* depends on the tip by more than the mesh.
HIGHEST_ALPHA = 2.5

#: Up to this g r the tip is small: with 0.3 its stretch opens it to some 0.3 R_w at alpha = 2.
MOST = 0.3

#: Ends of the steps of the errors in the radius of the tip [R_w].
STEPS = (5e-5, 8e-3, 3e-2)


@dataclass(frozen=True)
class Case:
    """A path of one material with one notch.

    Parameters
    ----------
    alpha : float
        Stiffening exponent [-].
    notch : float
        Radius of the notch [R_w].
    g : tuple of float
        Where [-].
    """

    alpha: float
    notch: float
    g: tuple[float, ...]


#: The first radius of each is that of the campaign, beside which the others are.
_DESIGN: tuple[tuple[float, tuple[float, ...], tuple[float, ...]], ...] = (
    (2.0, (5e-4, 1.25e-4, 8e-3, 3e-2), (2.035, 3.413, 9.687)),
    (2.0, (5e-4, 8e-3, 3e-2), (35.92,)),
    (2.0, (5e-4, 5e-5), (2.2, 10.0)),
    (2.06, (5e-4, 2e-3, 8e-3), (2.1, 3.5, 10.0)),
    (2.12, (5e-4, 1.25e-4, 8e-3, 3e-2), (2.175, 3.615, 9.847)),
    (2.12, (5e-4, 5e-5), (2.2, 10.0)),
    (2.25, (5e-4, 1.25e-4, 2e-3, 8e-3), (2.4, 4.0, 10.0)),
    (2.5, (5e-4, 1.25e-4, 8e-3, 3e-2), (2.688, 4.37, 10.6)),
    (2.5, (5e-4, 8e-3, 3e-2), (35.98,)),
)

CASES = tuple(Case(alpha, notch, g) for alpha, radii, g in _DESIGN for notch in radii)


def solve_case(case: Case) -> list[dict[str, float]]:
    """Return the rows of a path, also of what was not reached."""
    from fe_training.solver.cut import Settings
    from fe_training.solver.record import Outcome
    from fe_training.solver.solve import solve_path

    settings = replace(Settings(sectors=20, contact_spacing=0.07), notch_radius=case.notch)
    return [
        {
            "alpha": case.alpha,
            "notch": case.notch,
            "g": record.energy_release_rate,
            "slip_arc": record.slip_arc,
            "slip_load": record.slip_load,
            "force_mismatch": record.force_mismatch,
            "reached": float(record.outcome is Outcome.CONVERGED),
        }
        for record in solve_path(case.alpha, case.g, settings)
    ]


def missing(rows: Rows) -> Iterator[Case]:
    """Yield the cases of the design that have no rows."""
    for case in CASES:
        if not all(len(_at(rows, case.alpha, case.notch, g)) for g in case.g):
            yield case


def _at(rows: Mapping[str, Any], alpha: float, notch: float, g: float) -> NDArray[np.intp]:
    same = (rows["alpha"] == alpha) & (rows["notch"] == notch)
    return np.flatnonzero(same & (np.abs(rows["g"] / g - 1.0) < 3e-3))


def read_rows(folder: Path) -> Rows:
    """Return the rows of a file; none where it is not there."""
    file = folder / NOTCH_FILE
    if not file.is_file():
        return {name: np.empty(0) for name in COLUMNS}
    arrays = read_fitted(file)[1]
    return {name: np.array(arrays[name]) for name in COLUMNS}


def write(folder: Path, about: Mapping[str, Any], rows: Rows) -> Path:
    """Write the file of what was solved and fitted, and its checksum; return the file."""
    file = folder / NOTCH_FILE
    content = content_of(about, rows)
    write_atomically(file, content)
    write_atomically(file.with_name(f"{NOTCH_FILE}.sha256"), checksum_line(NOTCH_FILE, content))
    return file


def fit_notch(fitted: Fitted, campaign: Campaign, others: Campaign, rows: Rows) -> dict[str, Any]:
    """Return what a file says of the tip: fitted numbers, where they hold, and their errors.

    Parameters
    ----------
    fitted : Fitted
        The models, which know g_touch.
    campaign, others : Campaign
        The data set of two notches, and one that no model has seen.
    rows : mapping of str to ndarray
        Solutions with other notches.
    """
    points = _touching(campaign, fitted)
    levels, blunt = campaign.design.levels, campaign.design.blunt
    assert blunt is not None
    radius = next(iter(levels.values())).notch_radius
    bare = NotchSlip(
        radius,
        (0.0, 0.0),
        (0.0, 1.0, 0.0),
        fitted.limits.touch,
        HIGHEST_ALPHA,
        float(points["g"].max()),
        MOST,
        STEPS,
        {},
    )
    tip = _fitted(bare, points, blunt.notch_radius)
    off_grid = _touching(others, fitted)
    errors = {
        name: _errors(tip, model.under(SLIP), [points, off_grid], rows)
        for name, model in fitted.models.items()
    }
    return {
        "radius": radius,
        "stretch": list(tip.stretch),
        "pressure": list(tip.pressure),
        "touch": list(tip.touch),
        "alpha": tip.alpha,
        "highest_g": tip.highest_g,
        "most": tip.most,
        "radii": list(tip.radii),
        "errors": errors,
        "units": "R_w = 1, mu = 1, forces and energies per unit thickness",
    }


def _touching(campaign: Campaign, fitted: Fitted) -> Rows:
    """Return the points of a campaign up to the highest alpha at which the tip touches the wire."""
    columns = campaign.points.columns
    touch = fitted.models["table"].touch(columns["alpha"])
    here = columns["use"].astype(bool) & (columns["alpha"] <= HIGHEST_ALPHA)
    here &= columns["g"] >= NEAR * touch
    names = ("alpha", "g", "slip_arc", "slip_load")
    slopes = ("slip_arc_notch_slope", "slip_load_notch_slope")
    return {name: columns[name][here] for name in (*names, *slopes) if name in columns}


def _fitted(bare: NotchSlip, points: Rows, blunt: float) -> NotchSlip:
    """Return the numbers that give the slopes of the campaign best, relative to A* and B*."""
    from scipy.optimize import least_squares

    known = np.isfinite(points["slip_arc_notch_slope"])
    alpha, g, arc, load, arc_slope, load_slope = (
        points[name][known]
        for name in (
            *("alpha", "g", "slip_arc", "slip_load"),
            *("slip_arc_notch_slope", "slip_load_notch_slope"),
        )
    )
    step = np.log(blunt / bare.radius)

    def off(numbers: Floats, which: int) -> Floats:
        tip = _with(bare, numbers)
        added = -np.array(tip.added(g, alpha, blunt)) / step
        return np.asarray((added[which] - (arc_slope, load_slope)[which]) / (arc, load)[which])

    stretch = least_squares(lambda k: off(np.array([*k, 0.0, 1.0, 0.0]), 0), [-0.3, 0.0]).x
    pressure = least_squares(lambda p: off(np.array([*stretch, *p]), 1), [0.5, 0.5, 0.0]).x
    return _with(bare, np.array([*stretch, *pressure]))


def _with(tip: NotchSlip, numbers: Floats) -> NotchSlip:
    first, second, a, b, c = map(float, numbers)
    return replace(tip, stretch=(first, second), pressure=(a, b, c))


def _errors(
    tip: NotchSlip, model: FittedModel, points: list[Rows], rows: Rows
) -> list[list[float]]:
    """Return bounds of the errors of A* and B* with a tip, in each step of its radius.

    The largest error of the model at the points of the finite elements' own notch, relative to
    what the ends of the step make of it, and the largest of what the tip adds, at rows of other
    notches: which no fit has seen.
    """
    whole = {name: np.concatenate([p[name] for p in points]) for name in ("alpha", "g")}
    bounds = []
    for low, high in zip(tip.radii[:-1], tip.radii[1:], strict=True):
        bound = []
        for which, name in enumerate(("slip_arc", "slip_load")):
            truth = np.concatenate([each[name] for each in points])
            found = model.contact((name,), whole["g"], whole["alpha"])[0]
            blunt = np.minimum(high, tip.most / whole["g"])
            least = truth + tip.added(whole["g"], whole["alpha"], blunt)[which]
            own = float(np.max(np.abs(found - truth) / least))
            bound.append(round(own + _of_tip(tip, name, which, (low, high), rows), 6))
        bounds.append(bound)
    return bounds


def _of_tip(tip: NotchSlip, name: str, which: int, ends: tuple[float, float], rows: Rows) -> float:
    """Return the largest error of what the tip adds, relative to A* or B*, at rows of a step."""
    errors = [0.0]
    for i in np.flatnonzero((rows["notch"] >= ends[0]) & (rows["notch"] <= ends[1])):
        alpha, g = rows["alpha"][i], rows["g"][i]
        beside = _at(rows, alpha, tip.radius, g)
        beside = beside if tip.known(g, alpha, rows["notch"][i]) else beside[:0]
        if rows["notch"][i] != tip.radius and len(beside) and rows["reached"][i]:
            difference = rows[name][i] - rows[name][beside[0]]
            added = float(tip.added(g, alpha, rows["notch"][i])[which])
            errors.append(float(abs(added - difference) / rows[name][i]))
    return max(errors)

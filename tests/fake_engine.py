"""An engine that answers at once with smooth made-up numbers, and a driver of campaigns with it.

As a program: ``fake_engine.py DESIGN STORE JOBS [SCHEDULER]``; the environment variable
FAKE_SECONDS is the time of each configuration.
"""

import math
import os
import sys
import time

import numpy as np

from fe_training.campaign.design_file import read_design
from fe_training.campaign.run import plan, run_campaign
from fe_training.campaign.store import Store
from fe_training.campaign.workers import Workers
from fe_training.solver.record import Outcome, Record


def record(alpha, g, sectors=24, **changed):
    """Return a made-up record whose values depend a little on the mesh."""
    mesh = 1.0 + 0.5 / sectors**2
    theta_1, theta_2 = 0.5, 2.0 + 0.01 * math.tanh(g)
    angle = np.linspace(theta_1, theta_2, 42 + round(100 * g) % 200)[1:-1]
    values = {
        "alpha": alpha,
        "target": g,
        "outcome": Outcome.CONVERGED,
        "energy_release_rate": g * (1 + 1e-5 * math.sin(1e3 * g)),
        "distance": (1.0 + 1.0 / (1.0 + alpha * g)) * mesh,
        "insertion": math.log(g),
        "vertical_force": (2.0 + 0.3 * g) * mesh,
        "horizontal_force": 0.5 * g,
        "theta_1": float(angle[0]),
        "theta_2": float(angle[-1]),
        "slip_arc": 2.0 * mesh,
        "slip_load": (2.5 + 0.6 * g) * mesh,
        "energy_release_rate_across": (g, g * (1 + 1e-6)),
        "residual": 1e-11,
        "iterations": 5,
        "touches_plane": g > 1.6,
        "mesh": {"sectors": sectors, "notch_radius": 5e-4},
        "solver": "made-up",
        "truncation_error": 1e-4,
        "wall_time": 2.0,
        "pressure_angle": angle,
        "pressure": np.sqrt((angle - theta_1) * (theta_2 - angle)) * alpha,
        "stretch": 1.0 / np.sin(angle),
        "ahead_reference": np.geomspace(1e-3, 1.0, 30),
        "ahead_deformed": np.geomspace(1e-3, 1.0, 30) * 1.5,
        "ahead_stress": np.geomspace(1.0, 1e-3, 30),
    }
    return Record(**{**values, **changed})


def solve_path(alpha, targets, settings, report):
    """Answer in the place of the engine's `solve_path`."""
    for g in sorted(targets):
        time.sleep(float(os.environ.get("FAKE_SECONDS", "0")))
        report(record(alpha, g, settings.sectors))
    return []


def run(design, folder, workers=None, solve=solve_path, retry=True, progress=False):
    """Run a campaign with made-up numbers and return its rows."""
    store = Store(folder)
    with store.opened(design):
        todo = plan(design, store, design.configurations(), retry)
        run_campaign(design, store, todo, workers, progress=progress, solve=solve)
        return store.rows(design.configurations())


if __name__ == "__main__":
    file, place, jobs, *scheduler = sys.argv[1:]
    run(read_design(file), place, Workers(int(jobs), *scheduler), progress=True)

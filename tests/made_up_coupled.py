"""Rows of a campaign with friction and wear that follow a made-up kappa."""

import numpy as np

from fe_training.coupled.dataset import COLUMNS, CoupledData
from surrogate.contact.coordinates import log_touch

LARGEST = (0.5, 10.0)
SHARES = (0.02, 0.06, 0.15)


def log_kappa(x, y, xi, w):
    """Return the made-up ln kappa, which the polynomial can be."""
    return xi * (1.2 + 0.1 * x + 0.3 * y + 0.8 * xi) + w * (0.04 * y - 0.1 - 0.02 * xi)


def row(number, g, alpha, load, kappa):
    """Return a row with its evidence in order."""
    xi, wear = load
    drag = 2.0 * (2.1 * wear + 2.5 * xi) * kappa
    values = dict.fromkeys(COLUMNS, 0.0)
    return values | {
        "alpha": alpha,
        "target": g,
        "target_friction": xi,
        "target_wear": wear,
        "outcome": "CONVERGED",
        "reason": "",
        "friction": xi,
        "wear": wear,
        "energy_release_rate": g,
        "steady_force": g + drag,
        "slip_power": drag,
        "first_arc": 2.1,
        "first_load": 2.5,
        "slip_arc": 2.1 * kappa,
        "slip_load": 2.5 * kappa,
        "touches_tip": False,
        "touches_plane": False,
        "base": number,
        "held_out": number % 5 == 4,
    }


def rows_of_base(number, place, touch):
    """Return the rows of one base, three rays of three loads."""
    alpha, x = 2.2 + 6.6 * place[0], -8.0 + 7.5 * place[1]
    y = np.log(alpha)
    g = float(np.exp(x + log_touch(touch, y)))
    for ray in range(3):
        z = (place[2] + ray / 3.0) % 1.0
        edge = LARGEST[0] * min(1.0, 2.0 * (1.0 - z)), LARGEST[1] * min(1.0, 2.0 * z)
        for share in SHARES:
            xi, wear = share * edge[0], share * edge[1]
            kappa = float(np.exp(log_kappa(x, y, xi, np.log1p(wear))))
            yield row(number, g, alpha, (xi, wear), kappa)


def data_of(rows):
    columns = {name: np.array([one[name] for one in rows]) for name in COLUMNS}
    attributes = {"schema": "wirecut-coupled-data-1", "design": "made up", "software": "[]"}
    return CoupledData(columns, attributes)

"""A made-up contact whose functions are known everywhere, and points of it with errors."""

import numpy as np

from fe_training.fitting.points import FitPoints
from surrogate.contact.coordinates import POWER
from surrogate.contact.wedge import wedge_functions, wedge_load

TOUCH = (-0.9, 2.0, 0.05)
ALPHAS = (2.0, 2.4, 3.3, 4.7, 6.5, 8.3, 9.0)
G = np.geomspace(5e-3, 60.0, 24)
NOISE = 1e-4


def log_touch(alpha):
    """Return ln g_touch."""
    return np.polynomial.polynomial.polyval(np.log(alpha), TOUCH)


def truth(g, alpha):
    """Return A, B and delta, which bend at the touch."""
    log_g, log_alpha = np.log(g), np.log(alpha)
    wedge = wedge_functions(log_g, wedge_load(log_g))
    x = log_g - log_touch(alpha)
    past = np.maximum(x, 0.0)
    arc = 0.12 / (1.0 + np.exp(-x - 0.5)) + 0.2 * past / (1.0 + 0.1 * past) + 0.02 * log_alpha
    load = 0.05 * past**2 * np.exp(-0.1 * past) - 0.05 * log_alpha / (1.0 + np.exp(-x))
    gap = (-np.expm1(0.6 * np.minimum(x, 0.0))) ** POWER
    return (
        2.0 * np.tanh(0.5 * wedge["arc"]) * np.exp(-arc),
        wedge["normal_load"] * np.exp(load),
        1.0 + wedge["distance"] * gap,
    )


def slip_truth(g, alpha):
    """Return A* and B*, which grow faster than A and B and bend at the touch as well."""
    arc, load, _ = truth(g, alpha)
    past = np.maximum(np.log(g) - log_touch(alpha), 0.0)
    stretch = 1.0 + 0.3 * np.sqrt(g / (1.0 + g)) / alpha
    return arc * stretch * np.exp(0.3 * past / alpha), load * stretch * np.exp(0.4 * past / alpha)


def points(seed=0, alphas=ALPHAS, g=G, noise=NOISE):
    """Return points with random errors: five times as large of A as of B, none of delta."""
    random = np.random.default_rng(seed)
    alpha, g = (each.ravel() for each in np.meshgrid(alphas, g, indexing="ij"))
    arc, load, distance = truth(g, alpha)
    slip_arc, slip_load = slip_truth(g, alpha)
    size = len(g)
    return FitPoints(
        alpha=alpha,
        g=g,
        arc=arc * (1.0 + 5.0 * noise * random.standard_normal(size)),
        normal_load=load * (1.0 + noise * random.standard_normal(size)),
        distance=distance,
        arc_std=np.full(size, 5.0 * noise),
        normal_load_std=np.full(size, noise),
        distance_std=np.full(size, noise),
        slip_arc=slip_arc * (1.0 + noise * random.standard_normal(size)),
        slip_load=slip_load * (1.0 + noise * random.standard_normal(size)),
        slip_arc_std=np.full(size, noise),
        slip_load_std=np.full(size, noise),
    )

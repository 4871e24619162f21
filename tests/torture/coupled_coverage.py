"""Made-up experiments with a wire that rubs: how often intervals of the law "auto" hold the truth.

The truth is the coupled law of the shipped models, A*, B* and kappa each times a smooth error
within its measured bound, at loads that coupled solutions reach on every wire. Noise may carry an
estimate out of their reach; such an experiment is identified by "projected" and counted by itself.
"""

import math
from dataclasses import dataclass

import numpy as np

import surrogate
from surrogate.choosing.laws import of_law
from surrogate.coupling.frozen import frozen
from surrogate.errors import WirecutError
from surrogate.inference.continuation import contact_error

__all__ = ["Rubbed", "held_by", "rubbed"]

NOISE, SHARES = (0.01, 0.1), (0.1, 0.9)


@dataclass(frozen=True)
class Rubbed:
    """What was drawn, what the user states, and its kinds."""

    toughness: float
    wear_strength: float
    stated: dict
    kinds: dict


def _log_uniform(random, low, high):
    return math.exp(random.uniform(math.log(low), math.log(high)))


def _smooth(random, log_g):
    """Return a smooth error of unit size, cut at the bound that a standard deviation is of."""
    length = _log_uniform(random, 0.3, 3.0)
    apart = (log_g[:, np.newaxis] - log_g) / length
    root = np.linalg.cholesky(np.exp(-(apart**2)) + 1e-9 * np.eye(log_g.size))
    return np.clip(root @ random.standard_normal(log_g.size), -math.sqrt(3.0), math.sqrt(3.0))


def rubbed(random):
    """Return a random experiment whose wires are all at loads that coupled solutions reach."""
    model = of_law("table", "coupled")
    kappa = model.amplification
    while True:
        alpha = _log_uniform(random, *kappa.exponents)
        wires, spread = int(random.integers(3, 9)), _log_uniform(random, 2.0, 8.0)
        middle, mu = _log_uniform(random, 5e-5, 5e-4), _log_uniform(random, 1e3, 1e5)
        gamma = _log_uniform(random, 0.01, 10.0) * mu * middle
        radius = middle * np.geomspace(spread**-0.5, spread**0.5, wires)
        g = gamma / (mu * radius)
        direction, size = random.uniform(), random.uniform(*SHARES)
        xi, relative = kappa.load_unit[0] * (1.0 - direction), kappa.load_unit[1] * direction
        if np.isfinite(np.max(kappa.share(g, alpha, xi, relative))):
            break
    share = float(np.max(kappa.share(g, alpha, xi, relative)))  # in proportion to the load
    xi, relative = size / share * xi, size / share * relative
    at = frozen(model, xi, relative)
    error = contact_error(at, g, alpha)
    errors = [
        np.exp(std * _smooth(random, np.log(g))) for std in (error.arc, error.load, error.factor)
    ]
    arc, load = at.arc(g, alpha) * errors[0], at.normal_load(g, alpha) * errors[1]
    exact = gamma + 2.0 * radius * mu * (relative * arc + xi * load) * errors[2]
    noise = _log_uniform(random, *NOISE)
    std = noise * exact
    friction_std = float(random.choice([0.0, 0.1])) * xi
    modulus_std = float(random.choice([0.0, 0.03]))
    known = bool(random.integers(2))
    stated_modulus = mu * math.exp(modulus_std * random.standard_normal())
    stated = {
        "wire_radius": radius,
        "force": exact + std * random.standard_normal(wires),
        "shear_modulus": stated_modulus,
        "shear_modulus_std": modulus_std * stated_modulus,
        "friction_coefficient": max(xi + friction_std * random.standard_normal(), 0.0),
        "friction_std": friction_std,
        "stiffening_exponent": alpha,
        "force_std": std if known else None,
    }
    kinds = {
        "errors": "force_std" if known else "residuals only",
        "load": "mostly wear" if direction > 0.5 else "mostly friction",
        "friction": "with a standard error" if friction_std else "exact",
        "noise": "1 to 3 %" if noise < 0.03 else "3 to 10 %",
        "share of the reach": "below half" if size < 0.5 else "above half",
    }
    return Rubbed(gamma, relative * mu, stated, kinds)


def held_by(experiment, **changes):
    """Return the law that "auto" took and whether the intervals hold the truth, or None."""
    try:
        fit = surrogate.identify(**{**experiment.stated, **changes})
    except WirecutError:
        return None
    truths = experiment.toughness, experiment.wear_strength
    intervals = fit.toughness_interval, fit.wear_strength_interval
    return fit.law, tuple(
        bool(low <= truth <= high) for truth, (low, high) in zip(truths, intervals, strict=True)
    )

"""Made-up experiments, in and out of a model's range: how often printed intervals hold the truth.

What the user states is true: the stated standard errors are those that the numbers were drawn with.
The truth is the fitted model times a smooth error within its measured bounds. Beyond the range ln A
and ln B drift away from the continuation at a rate in ln g that is drawn evenly from `DRIFTS`,
whatever the fit itself allows for there; no arc is longer than 2.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
from scipy.stats import nct, norm

import surrogate
from surrogate.choosing.by_name import force_model
from surrogate.errors import WirecutError
from surrogate.identification.friction import SUPPOSED
from surrogate.identification.outlier import FALSE_ALARM, outlier
from surrogate.inference.continuation import contact_error
from surrogate.inference.quantiles import normal_quantile, student_quantile

__all__ = [
    "Outcome",
    "drawn",
    "forgotten_friction",
    "gross_error",
    "least_missed",
    "outcome",
]

MODEL = "table"
CONFIDENCE = 0.95
DRIFTS = {"arc": ((-0.01, 0.01), (-0.05, 0.2)), "load": ((-0.005, 0.005), (-0.02, 0.02))}
"""Drift of ln A and of ln B for each factor e below and above the range. Below, the slope of ln A
changes by 0.01 over the last decade inside; above, it may stay flat, fall a little or go on growing
as it last does."""

GROSS = 10.0
"""Standard deviations of one cut that a gross error is off."""


@dataclass(frozen=True)
class Experiment:
    """What was drawn, what the user states, and the forces."""

    toughness: float
    wear_strength: float
    stated: dict
    std: np.ndarray
    g: np.ndarray
    kinds: dict


@dataclass(frozen=True)
class Outcome:
    """Whether the intervals hold the truth, and whether an outlier or a misfit was said."""

    kinds: dict
    inside: tuple[bool, bool]
    one_sided: bool
    outlier: bool
    fit: object


def _log_uniform(random, low, high):
    return math.exp(random.uniform(math.log(low), math.log(high)))


def drawn(random, **fixed):
    """Return a random experiment."""
    model = force_model(MODEL)
    wires, spread = int(random.integers(3, 9)), _log_uniform(random, 1.5, 20.0)
    middle, modulus = _log_uniform(random, 2e-5, 1e-3), _log_uniform(random, 1e2, 1e6)
    alpha = _log_uniform(random, 2.0, 9.0)
    repeats = int(random.choice([1, 1, 4]))
    g_middle = _log_uniform(random, 1e-3, 1e4)
    toughness = g_middle * modulus * middle
    wear = _log_uniform(random, 0.03, 30.0) * toughness / (4.0 * middle)
    friction = fixed.get("friction", random.choice([0.0, random.uniform(0.0, 0.5)]))
    radius = middle * np.geomspace(spread**-0.5, spread**0.5, wires)
    g = toughness / (modulus * radius)
    arc, load = model.contact(("arc", "normal_load"), g, alpha)
    arc, load = (
        arc * _error(random, model, g, alpha, "arc"),
        load * _error(random, model, g, alpha, "load"),
    )
    exact = toughness + 2.0 * radius * (wear * np.minimum(arc, 2.0) + friction * modulus * load)
    noise = _log_uniform(random, 0.01, 0.2)
    proportional = bool(random.integers(2))
    std = noise * (exact if proportional else np.full(wires, exact.mean()))
    radius, exact, std = (np.repeat(each, repeats) for each in (radius, exact, std))
    force = np.maximum(exact + std * random.standard_normal(exact.size), 1e-3 * exact)
    known = bool(random.integers(2))
    friction_std = fixed.get("friction_std", float(random.choice([0.0, 0.05])))
    modulus_std = float(random.choice([0.0, 0.05]))
    stated = {
        "wire_radius": radius,
        "force": force,
        "shear_modulus": modulus * math.exp(modulus_std * random.standard_normal()),
        "friction_coefficient": max(friction + friction_std * random.standard_normal(), 0.0),
        "stiffening_exponent": alpha,
        "friction_std": friction_std,
        "force_std": std if known else None,
        "model": MODEL,
        "law": "projected",
        "confidence": CONFIDENCE,
    }
    stated["shear_modulus_std"] = modulus_std * stated["shear_modulus"]
    low, high = model.ends(stated["stiffening_exponent"])
    outside = np.count_nonzero((g < low) | (g > high))
    kinds = {
        "wires": "all in range" if not outside else "none" if outside == g.size else "some",
        "g": f"1e{math.floor(math.log10(g_middle)):+d}",
        "errors": "force_std" if known else "repeats" if repeats > 1 else "residuals only",
        "scatter": "proportional" if proportional else "constant",
        "friction": "with a standard error" if friction_std else "exact",
        "modulus": "with a standard error" if modulus_std else "exact",
        "noise": "1 to 5 %" if noise < 0.05 else "5 to 20 %",
    }
    return Experiment(toughness, wear, stated, std, g, kinds)


def _error(random, model, g, alpha, which):
    """Return the factor by which the truth differs from the model."""
    near = getattr(contact_error(model, g, alpha), which)
    length = _log_uniform(random, 0.3, 3.0)
    apart = np.abs(np.log(g)[:, np.newaxis] - np.log(g)) / length
    root = np.linalg.cholesky(np.exp(-(apart**2)) + 1e-9 * np.eye(g.size))
    smooth = np.clip(root @ random.standard_normal(g.size), -math.sqrt(3.0), math.sqrt(3.0))
    (low, high), (below, above) = model.limits.g, DRIFTS[which]
    drift = random.uniform(*below) * np.log(np.maximum(low / g, 1.0))
    drift += random.uniform(*above) * np.log(np.maximum(g / high, 1.0))
    return np.exp(near * smooth + drift)


def outcome(experiment, outliers=False, **changes):
    """Identify an experiment, and look for outliers if asked; None where it is refused."""
    try:
        fit = surrogate.identify(**{**experiment.stated, **changes})
    except WirecutError:
        return None
    truths = experiment.toughness, experiment.wear_strength
    intervals = fit.toughness_interval, fit.wear_strength_interval
    inside = tuple(
        bool(low <= truth <= high) for truth, (low, high) in zip(truths, intervals, strict=True)
    )
    ends = (*fit.toughness_limited_by, *fit.wear_strength_limited_by)
    warned = outliers and (outlier(fit) is not None or any("scatter" in s for s in fit.objections))
    return Outcome(experiment.kinds, inside, any(end != "forces" for end in ends), warned, fit)


def gross_error(random, experiment):
    """Return the experiment with one cut off by a gross error, and its place."""
    force = experiment.stated["force"].copy()
    which = int(random.integers(force.size))
    force[which] += random.choice([-1.0, 1.0]) * GROSS * experiment.std[which]
    if force[which] <= 0.0:
        force[which] += 2.0 * GROSS * experiment.std[which]
    return replace(experiment, stated={**experiment.stated, "force": force}), which


def least_missed(experiment, fit, which):
    """Return how often the best test misses a gross error in a cut, at the alarms of `outlier`.

    Of a force that is linear about the clean fit and a scatter whose shape is known: the deleted
    residual then follows a noncentral t distribution, or a normal one where its size is known too,
    and no test of one outlier sees more (Ferguson, as `outlier` cites).
    """
    cuts, dof = experiment.std.size, experiment.std.size - 3
    design = fit.force_slopes(fit.wire_radius) / experiment.std[:, np.newaxis]
    if not np.all(np.isfinite(design)):
        return math.nan
    q, _ = np.linalg.qr(design / np.linalg.norm(design, axis=0))
    off = GROSS * math.sqrt(max(1.0 - float(np.sum(q[which] ** 2)), 0.0))
    confidence = 1.0 - FALSE_ALARM / cuts
    if experiment.stated["force_std"] is not None:
        limit, off_by = normal_quantile(confidence), norm(off)
    elif dof < 1:
        return 1.0
    else:
        limit, off_by = student_quantile(confidence, dof), nct(dof, off)
    return float(off_by.cdf(limit) - off_by.cdf(-limit))


def forgotten_friction(experiment):
    """Return the bias that forgotten friction brings and what is printed of it.

    Both of shape (2,), of Gamma_o and tau_w; None where an estimate is held by a limit. What is
    printed, the fits with xi of `SUPPOSED`, is interpolated, or continued along its last piece.
    """
    xi = experiment.stated["friction_coefficient"]
    told = outcome(experiment)
    forgotten = outcome(experiment, friction_coefficient=None, friction_std=0.0)
    if told is None or forgotten is None or told.fit.at_limit or forgotten.fit.at_limit:
        return None
    zero, first, last = (_pair(one) for one in (forgotten.fit, *_supposed(forgotten.fit)))
    low, high = SUPPOSED
    printed = (
        first + (last - first) * (xi - low) / (high - low)
        if xi > low
        else zero + (first - zero) * xi / low
    )
    return zero - _pair(told.fit), zero - printed


def _supposed(fit):
    return (fit.with_friction(xi) for xi in SUPPOSED)


def _pair(fit):
    return np.array([fit.toughness, fit.wear_strength])

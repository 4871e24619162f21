"""Made-up experiments over the whole domain: are the estimates unbiased and the intervals honest?

A material and its wires are drawn, the forces of a model get random errors, and what `identify`
makes of them is held beside what was drawn.
"""

import math
import time
from dataclasses import dataclass

import numpy as np

import surrogate
from surrogate.choosing.by_name import force_model
from surrogate.contact.closed_forms import FORCE_MODELS

from .cells import attempt
from .part import Part

__all__ = ["experiments"]

CONFIDENCE = 0.95
RADII = (3, 8)
NOISE = (0.01, 0.2)
SPREAD = (1.5, 20.0)
"""Thickest wire over thinnest."""
WEAR = (0.03, 30.0)
"""Wear over toughness at the middle radius, 4 tau_w R_w/Gamma_o."""
SLIPS = 10
"""Of how many experiments one is done with slips of units, too."""
FEWEST, SIGMAS = 200, 3.5
"""Experiments from which a coverage is judged, and standard errors that it may be off."""


@dataclass(frozen=True)
class Experiment:
    """What was drawn, and the forces that came of it."""

    toughness: float
    wear_strength: float
    shear_modulus: float
    friction: float
    alpha: float
    radius: np.ndarray
    force: np.ndarray
    std: np.ndarray
    noise: float
    known: bool


def drawn(model, random):
    """Return a random experiment; half of them with the same error of all forces, not known."""
    chosen = force_model(model)
    fitted = model not in FORCE_MODELS
    low, high = chosen.limits.g if fitted else (1e-2, 1e2)
    first, last = chosen.limits.alpha if fitted else (2.0, 9.0)
    spread = math.exp(random.uniform(*np.log(SPREAD)))
    # g of the middle wire, so that those of all wires are within the model
    room = math.sqrt(spread) * 1.5
    g = math.exp(random.uniform(math.log(low * room), math.log(high / room)))
    middle = math.exp(random.uniform(math.log(2e-5), math.log(2e-3)))
    modulus = math.exp(random.uniform(math.log(1e2), math.log(1e6)))
    toughness = g * modulus * middle
    wear = math.exp(random.uniform(*np.log(WEAR))) * toughness / (4.0 * middle)
    friction = 0.0 if model == "friction-free" else random.choice([0.0, random.uniform(0.0, 0.5)])
    alpha = math.exp(random.uniform(math.log(first), math.log(last)))
    number = int(random.integers(RADII[0], RADII[1] + 1))
    radius = middle * np.geomspace(spread**-0.5, spread**0.5, number)
    scene = surrogate.Scene(modulus, toughness, radius, friction, wear, alpha)
    exactly = surrogate.cutting_force(scene, model, law="projected").total
    noise = math.exp(random.uniform(*np.log(NOISE)))
    known = bool(random.integers(2))
    std = noise * (exactly if known else np.full(number, exactly.mean()))
    force = np.maximum(exactly + std * random.standard_normal(number), 1e-3 * exactly)
    return Experiment(toughness, wear, modulus, friction, alpha, radius, force, std, noise, known)


def experiments(number=10_000, model="eq13", seed=0, budget=300.0):
    """Identify made-up experiments.

    Parameters
    ----------
    number : int
        Experiments.
    model : str
        The model that makes the forces and is fitted to them.
    seed : int
        Of what is drawn.
    budget : float
        Seconds after which no further experiment is made.
    """
    part = Part("inverse", f"Made-up experiments, model {model}: do 95 % intervals hold the truth?")
    start, random = time.monotonic(), np.random.default_rng(seed)
    found = []
    for i in range(number):
        if time.monotonic() - start > budget:
            part.notes.append(f"{number - i} of {number} were left out after {budget:g} s")
            break
        one = drawn(model, random)
        fit, ended = attempt(surrogate.identify, _arguments(one, model))
        if ended is not None:
            part.fail("identify", ended[0], f"{one}: {ended[1]}")
            continue
        found.append((one, fit))
        _warned(part, one, fit)
        if i % SLIPS == 0:
            _slipped(part, one, model)
    for row, some in _groups(found):
        _coverage(part, row, some)
    part.seconds = time.monotonic() - start
    return part


def _arguments(one, model):
    return {
        "wire_radius": one.radius,
        "force": one.force,
        "shear_modulus": one.shear_modulus,
        "friction_coefficient": one.friction,
        "stiffening_exponent": one.alpha,
        "force_std": one.std if one.known else None,
        "model": model,
        "confidence": CONFIDENCE,
    }


def _groups(found):
    """Yield the experiments together and in kinds."""
    yield "all", found
    for known in (True, False):
        row = "errors known" if known else "errors not known"
        yield row, [(e, f) for e, f in found if e.known == known]
    for low, high in ((0.01, 0.03), (0.03, 0.08), (0.08, 0.2)):
        some = [(e, f) for e, f in found if low <= e.noise <= high]
        yield f"noise {100 * low:.0f} to {100 * high:.0f} %", some
    for n in range(RADII[0], RADII[1] + 1):
        yield f"{n} radii", [(e, f) for e, f in found if e.radius.size == n]


def _coverage(part, row, some):
    """Count how often the intervals hold the truth, and note bias in standard errors."""
    for name in ("toughness", "wear_strength"):
        truth = np.array([getattr(e, name) for e, _ in some])
        low, high = np.array([getattr(f, f"{name}_interval") for _, f in some]).reshape(-1, 2).T
        inside = int(np.count_nonzero((low <= truth) & (truth <= high)))
        part.count(f"{row}, {name}", "inside", inside)
        part.count(f"{row}, {name}", "outside", len(some) - inside)
        if len(some) < FEWEST:
            continue
        share = inside / len(some)
        slack = SIGMAS * math.sqrt(CONFIDENCE * (1.0 - CONFIDENCE) / len(some))
        estimate = np.array([getattr(f, name) for _, f in some])
        std = np.array([getattr(f, f"{name}_std") for _, f in some])
        median = float(np.median((estimate - truth) / std))
        part.notes.append(
            f"{row}, {name}: {100 * share:.2f} % inside, median error {median:+.3f} standard errors"
        )
        if abs(share - CONFIDENCE) > max(0.02, slack):
            part.fail(f"{row}, {name}", "coverage", f"{100 * share:.2f} % of {len(some)}")
        if abs(median) > 1.2533 * SIGMAS / math.sqrt(len(some)) + 0.02:
            part.fail(f"{row}, {name}", "bias", f"median {median:.3f} standard errors")


def _slipped(part, one, model):
    """Count the slips of units that are said; one by 1000 has to be for wires of 10 um to 1 mm."""
    usual = one.radius.min() >= 1e-5 and one.radius.max() <= 1e-3
    for slip, name, factor in (
        ("mm given as m", "wire_radius", 1e3),
        ("um given as m", "wire_radius", 1e6),
        ("m given as mm", "wire_radius", 1e-3),
        ("kPa given as Pa", "shear_modulus", 1e-3),
        ("N given as N/m, of 10 mm", "force", 1e-2),
        ("diameter given as radius", "wire_radius", 2.0),
    ):
        given = _arguments(one, model)
        fit, ended = attempt(surrogate.identify, {**given, name: factor * given[name]})
        row = f"slip: {slip}"
        if ended is not None:
            part.count(row, ended[0])  # a fitted model may not reach so far
        elif any("is hardly that" in sentence for sentence in fit.warnings):
            part.count(row, "said")
        elif usual and name == "wire_radius" and factor != 2.0:
            part.fail(row, "not said", repr(one))
        else:
            part.count(row, "not told from the numbers")


def _warned(part, one, fit):
    """Hold every warning that has a plain condition beside that condition."""
    said = " ".join(fit.warnings)
    conditions = {
        "the toughness is negative": fit.toughness_interval[1] < 0.0,
        "the wear strength is negative": fit.wear_strength_interval[1] < 0.0,
        "and can hardly be told": fit.condition > 30.0,
        "different radii": np.unique(one.radius).size < 3,
        "leave no measure of scatter": one.radius.size < 3 and not one.known,
        "the force per thickness (": one.force.min() < 1e-3 or one.force.max() > 1e6,
        "the wire radius (": False,
        "the shear modulus (": False,
        "the elasto-cohesive length": fit.toughness - fit.toughness_std > one.shear_modulus,
    }
    if fit.model in ("eq13", "low-toughness", "friction-free"):
        above = fit.toughness > one.shear_modulus * one.radius.min()
        conditions["comes from Eq. 11"] = above
    for words, due in conditions.items():
        row = f"warning: ... {words} ..."
        if (words in said) == due:
            part.count(row, "raised when due" if due else "not raised, not due")
        else:
            part.fail(row, "raised wrongly" if words in said else "missing", repr(one))
    for words in ("chi^2/dof", "an outlier"):
        part.count(f"warning: ... {words} ...", "false alarm" if words in said else "none")

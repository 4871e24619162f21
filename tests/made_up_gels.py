"""Pairs of made-up gels, cut with wires whose model is off by the same for both.

What the user states is true: the stated standard errors are those that the numbers were drawn with.
The truth is the fitted model times one smooth error within its measured bounds, a function of g for
both gels. A friction with a standard error is the same number for both, and off by the same, which
the comparison does not know.
"""

import math
from dataclasses import dataclass

import numpy as np

import surrogate
from surrogate.choosing.by_name import force_model
from surrogate.errors import WirecutError
from surrogate.inference.continuation import contact_error

MODEL = "table"
BOUND = math.sqrt(3.0)


@dataclass(frozen=True)
class Pair:
    """Two gels as their user states them, and what kind of pair they are."""

    stated: tuple
    kinds: dict


def _log_uniform(random, low, high):
    return math.exp(random.uniform(math.log(low), math.log(high)))


def pair(random, apart=(0.0, 0.0), exact=False):
    """Return a random pair, whose second gel has toughness and wear apart by these shares.

    Where it is exact, forces have no scatter, and their standard errors are stated.
    """
    gammas, taus, noise, proportional, repeats, known, xi, xi_std, mus, mu_std, wires, alphas = (
        _material(random)
    )
    gammas, taus = (
        (value, value * (1.0 + share)) for value, share in zip((gammas, taus), apart, strict=True)
    )
    radii = [
        np.repeat(middle * np.geomspace(spread**-0.5, spread**0.5, count), repeats)
        for middle, spread, count in wires
    ]
    shares = _errors(
        random, [g / (m * r) for g, m, r in zip(gammas, mus, radii, strict=True)], alphas
    )
    stated = []
    for i in range(2):
        g = gammas[i] / (mus[i] * radii[i])
        arc, load = force_model(MODEL).contact(("arc", "normal_load"), g, alphas[i])
        worn = taus[i] * arc * shares[i][0] + xi * mus[i] * load * shares[i][1]
        force = gammas[i] + 2.0 * radii[i] * worn
        std = noise * (force if proportional else np.full(force.size, force.mean()))
        seen = force + (0.0 if exact else std * random.standard_normal(force.size))
        off = random.standard_normal(2)
        stated.append(
            {
                "wire_radius": radii[i],
                "force": np.maximum(seen, 1e-3 * force),
                "shear_modulus": mus[i] * math.exp(mu_std * off[0]),
                "shear_modulus_std": mu_std * mus[i],
                "friction_coefficient": xi,
                "friction_std": xi_std,
                "stiffening_exponent": alphas[i],
                "force_std": std if known or exact else None,
                "model": MODEL,
                "law": "projected",
            }
        )
    if xi_std:
        seen_xi = max(xi + xi_std * random.standard_normal(), 0.0)
        stated = [one | {"friction_coefficient": seen_xi} for one in stated]
    kinds = {
        "errors": "force_std" if known else "repeats" if repeats > 1 else "residuals only",
        "scatter": "proportional" if proportional else "constant",
        "friction": "with one error for both" if xi_std else "exact",
        "modulus": "with a standard error" if mu_std else "exact",
        "alpha": "the same" if alphas[0] == alphas[1] else "two",
    }
    return Pair(tuple(stated), kinds)


def _material(random):
    mu, alpha = _log_uniform(random, 1e3, 1e5), _log_uniform(random, 2.0, 6.0)
    middle = _log_uniform(random, 1e-4, 4e-4)
    gamma = _log_uniform(random, 0.1, 10.0) * mu * middle
    tau = _log_uniform(random, 0.1, 10.0) * gamma / (4.0 * middle)
    wires = [(middle, _log_uniform(random, 3.0, 10.0), int(random.integers(4, 7))) for _ in "12"]
    return (
        gamma,
        tau,
        _log_uniform(random, 0.01, 0.1),
        bool(random.integers(2)),
        int(random.choice([1, 4])),
        bool(random.integers(2)),
        float(random.choice([0.0, 0.2])),
        float(random.choice([0.0, 0.05])),
        (mu, mu * _log_uniform(random, 0.7, 1.4)),
        float(random.choice([0.0, 0.05])),
        wires,
        (alpha, alpha if random.integers(2) else 1.2 * alpha),
    )


def _errors(random, gs, alphas):
    """Return the factors of A and B at the wires of either gel: one function, if alpha is one."""
    length = _log_uniform(random, 0.3, 3.0)
    together = [gs[0].size, gs[0].size + gs[1].size]
    log_g = np.log(np.concatenate(gs))
    apart = np.abs(log_g[:, np.newaxis] - log_g) / length
    same = np.arange(together[1]) < together[0]
    if alphas[0] != alphas[1]:
        apart[same[:, np.newaxis] != same] = 1e3
    root = np.linalg.cholesky(np.exp(-(apart**2)) + 1e-9 * np.eye(together[1]))
    parts = []
    for _ in ("arc", "load"):
        parts.append(np.clip(root @ random.standard_normal(together[1]), -BOUND, BOUND))
    factors = []
    for i, g in enumerate(gs):
        error = contact_error(force_model(MODEL), g, alphas[i])
        of = same if i == 0 else ~same
        factors.append((np.exp(error.arc * parts[0][of]), np.exp(error.load * parts[1][of])))
    return factors


def compared(one):
    """Return the comparison of a pair; None where an identification is refused or objects."""
    try:
        gels = [surrogate.identify(**stated) for stated in one.stated]
    except WirecutError:
        return None
    made = surrogate.compare_gels(dict(zip("AB", gels, strict=True)))
    return made if made.is_usable else None


def standard_errors(one):
    """Return the standard errors of both differences of an exact pair, or None where unknown."""
    made = compared(one)
    if made is None:
        return None
    gels = list(made.gels.values())
    stds = [
        math.hypot(*(getattr(fit, f"{name}_std") for fit in gels))
        for name in ("toughness", "wear_strength")
    ]
    return None if any(math.isnan(std) for std in stds) else stds

"""The closed forms once more, from the paper, in numbers of 50 digits and any size.

Each function takes floats and returns an mpmath number, or None where there is no limit to compare
with. Friction of "eq9" vanishes with Gamma_o, as the library says.
"""

import sys

import mpmath

from surrogate.equations import TABLE_1, power_law_exponent

__all__ = ["CONTACT", "FORCE", "GRADIENT", "RADIUS", "close", "exponent", "mp"]

DIGITS = 50
mpmath.mp.dps = DIGITS
mp = mpmath.mpf
INF = mpmath.inf
LARGEST = mp(sys.float_info.max)
ROUNDS_TO_INFINITY = LARGEST + mp(2) ** 970
SUBNORMALS = mp(4) * mp(5e-324)
"""What rounding may cost where numbers have lost digits: a few of the smallest."""


def close(value, exact, tolerance):
    """Return whether a float is the exact value within a relative error.

    Beyond the largest float infinity is right, and so is a number next to it.
    """
    if exact is None:
        return True
    if value != value:
        return False
    if exact == INF or abs(exact) * (1 + tolerance) >= ROUNDS_TO_INFINITY:
        far = abs(value) == float("inf") and (value > 0) == (exact > 0)
        if exact == INF or far or abs(exact) * (1 - tolerance) > LARGEST:
            return far
    if abs(value) == float("inf"):
        return False
    return abs(mp(value) - exact) <= tolerance * abs(exact) + SUBNORMALS


def exponent(alpha):
    """Return n(alpha), straight between the nodes of Table 1."""
    (a0, n0), (a1, n1), (a2, n2) = ((mp(a), mp(n)) for a, n in TABLE_1.items())
    if mp(alpha) < a1:
        return n0 + (n1 - n0) * (mp(alpha) - a0) / (a1 - a0)
    return n1 + (n2 - n1) * (mp(alpha) - a1) / (a2 - a1)


def rounded_exponent(alpha):
    """Return n(alpha) as the library rounds it: its rounding error is that of `exponent`.

    A power of g multiplies it by ln g, up to 1400.
    """
    return mp(power_law_exponent(float(alpha)))


def over(a, b):
    """Return a/b, infinite where only b is 0, None where both are."""
    if b == 0:
        return None if a == 0 else INF
    return mp(a) / b


def power_friction(mu, gamma, radius, xi, alpha):
    """Return xi Gamma_o g^(n - 1)."""
    if xi == 0 or gamma == 0:
        return mp(0)
    n = rounded_exponent(alpha)
    stiffness = mp(mu) * mp(radius)
    if stiffness == 0:
        return INF if n > 1 else mp(0) if n < 1 else mp(xi) * mp(gamma)
    return mp(xi) * mp(gamma) * (mp(gamma) / stiffness) ** (n - 1)


_LINEAR = {
    "eq13": (4, 4, 1),
    "high-toughness": (0, 0, 1),
    "low-toughness": (4, 4, 0),
    "friction-free": (4, 0, 0),
}
"""2 A, and 2 B at g = 0 and its slope."""


def force_parts(model):
    """Return a function that gives total, cleavage, friction and wear of a scene [N/m]."""

    def parts(mu, gamma, radius, xi, wear, alpha):
        mu, gamma, radius, xi, wear = map(mp, (mu, gamma, radius, xi, wear))
        if model == "eq9":
            friction, worn = power_friction(mu, gamma, radius, xi, alpha), mp(0)
        else:
            arc, load, slope = _LINEAR[model]
            friction = xi * (slope * gamma + load * mu * radius)
            worn = arc * wear * radius
        return gamma + friction + worn, gamma, friction, worn

    return parts


def contact(model):
    """Return a function that gives A, B and delta/R_w at g and alpha."""

    def functions(g, alpha):
        delta = mp(1) if g >= 1 else over(1, mpmath.sqrt(mp(g)))
        if model == "eq9":
            return mp(0), mp(g) ** rounded_exponent(alpha) / 2, delta
        arc, load, slope = _LINEAR[model]
        return mp(arc) / 2, (load + slope * mp(g)) / 2, delta

    return functions


def gradient(model):
    """Return a function that gives the six derivatives; None where there is no number."""

    def slopes(mu, gamma, radius, xi, wear, alpha):
        mu, gamma, radius, xi, wear = map(mp, (mu, gamma, radius, xi, wear))
        if model != "eq9":
            arc, load, slope = _LINEAR[model]
            return (
                load * xi * radius,
                1 + slope * xi,
                load * xi * mu + arc * wear,
                slope * gamma + load * mu * radius,
                arc * radius,
                mp(0),
            )
        n, stiffness = rounded_exponent(alpha), mu * radius
        if stiffness == 0 or gamma == 0:
            return (None,) * 6
        unit = gamma * (gamma / stiffness) ** (n - 1)
        (a0, n0), (a1, n1), (a2, n2) = ((mp(a), mp(b)) for a, b in TABLE_1.items())
        bend = (n1 - n0) / (a1 - a0) if alpha < a1 else (n2 - n1) / (a2 - a1)
        return (
            (1 - n) * xi * unit / mu,
            1 + n * xi * unit / gamma,
            (1 - n) * xi * unit / radius,
            unit,
            mp(0),
            xi * unit * mpmath.log(gamma / stiffness) * bend,
        )

    return slopes


def transition(model):
    """Return a function that gives the transition radius; None where there is no limit."""

    def radius(mu, gamma, xi, wear, alpha):
        mu, gamma, xi, wear = map(mp, (mu, gamma, xi, wear))
        if model == "eq9":
            # wear plays no part, and friction, of one sign with its rate or 1 - n < n, no radius
            return None if gamma == 0 else INF
        arc, load, slope = _LINEAR[model]
        return over(gamma * (1 + slope * xi), load * xi * mu + arc * wear)

    return radius


FORCE = {model: force_parts(model) for model in (*_LINEAR, "eq9")}
CONTACT = {model: contact(model) for model in (*_LINEAR, "eq9")}
GRADIENT = {model: gradient(model) for model in (*_LINEAR, "eq9")}
RADIUS = {model: transition(model) for model in (*_LINEAR, "eq9")}

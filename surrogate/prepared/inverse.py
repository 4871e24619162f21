"""Whether a prepared force is monotonic, proven piece by piece, and its inverse."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from surrogate.basics.checks import FloatOrArray, Quantity
from surrogate.basics.elementwise import log
from surrogate.basics.roots import narrowed
from surrogate.errors import DomainError, InputError
from surrogate.prepared.line import Line
from surrogate.prepared.plan import GAMMA, MU, RADIUS, WEAR, XI, Plan

__all__ = ["inverse", "is_monotonic"]

Array = NDArray[np.float64]
RISING, FALLING, UNKNOWN = "rising", "falling", "unknown"
_DEEPEST = 12


def is_monotonic(plan: Plan) -> str:
    """Return "rising" or "falling" where it is proven, else "unknown".

    Friction and wear rise with their strengths. With ln g = u, F = Gamma_o + R_w C(u) rises with
    R_w where C - C' is positive, which is a cubic in each piece, and with Gamma_o where
    mu g + C' is: signs of polynomials are proven by their Bernstein coefficients.
    """
    (name,) = plan.varying
    if name in (WEAR, XI):
        return RISING
    if not plan.of_table:
        return RISING if name in (RADIUS, MU, GAMMA) else UNKNOWN
    if plan.one_line is None or name not in (RADIUS, GAMMA):
        return UNKNOWN
    signs = set()
    for piece, ends, rate in _pieces(plan, plan.one_line):
        a, b, c, d = plan.one_line.pieces[piece]
        value, slope = np.array([a, b, c, d]), rate * np.array([b, 2.0 * c, 3.0 * d, 0.0])
        if name == RADIUS:
            free = plan.free_slope
            signs.add(_sign(value + np.array([free, 0.0, 0.0, 0.0]) - slope, *ends))
        else:
            least = plan.fixed[MU] * np.exp(_log_g_at(plan.one_line, piece, ends[0], rate))
            signs.add(_sign(slope + np.array([least * plan.free_rise, 0.0, 0.0, 0.0]), *ends))
    if signs == {1}:
        return RISING
    return FALLING if signs == {-1} and name == RADIUS else UNKNOWN


def _pieces(plan: Plan, line: Line) -> Any:
    """Yield each piece in the range, the places where the range begins and ends in it, the rate."""
    low, high = plan.g_ends()
    ends = [line.place(np.array([log(g) - line.touch])) for g in (low, high)]
    first, last = (int(piece[0]) for piece, _ in ends)
    for piece in range(first, last + 1):
        begin = float(ends[0][1][0]) if piece == first else 0.0
        end = float(ends[1][1][0]) if piece == last else 1.0
        yield piece, (begin, end), line.before if piece < line.short else line.after


def _log_g_at(line: Line, piece: int, place: float, rate: float) -> float:
    return line.touch + (piece + place - line.short) / rate


def _sign(powers: Array, begin: float, end: float, depth: int = 0) -> int:
    """Return 1 or -1 where a cubic has this sign all over an interval, else 0."""
    width = end - begin
    a, b, c, d = powers
    shifted = (
        a + begin * (b + begin * (c + begin * d)),
        width * (b + begin * (2.0 * c + 3.0 * begin * d)),
        width**2 * (c + 3.0 * begin * d),
        width**3 * d,
    )
    p, q, r, s = shifted
    bernstein = (p, p + q / 3.0, p + (2.0 * q + r) / 3.0, p + q + r + s)
    if min(bernstein) > 0.0:
        return 1
    if max(bernstein) < 0.0:
        return -1
    if depth == _DEEPEST or width == 0.0 or min(p, bernstein[3]) <= 0.0 <= max(p, bernstein[3]):
        return 0
    middle = begin + 0.5 * width
    left, right = (_sign(powers, *part, depth + 1) for part in ((begin, middle), (middle, end)))
    return left if left == right else 0


def inverse(plan: Plan, monotonic: str, force: ArrayLike) -> FloatOrArray:
    """Return where the one quantity that varies has a force."""
    (name,) = plan.varying
    if monotonic == UNKNOWN:
        raise InputError(
            f"a force must be monotonic to be inverted, but over {name} it is not proven to be; "
            "prepare it over a range in which `monotonic` says so."
        )
    low, high = plan.ranges[name]
    ends = sorted(float(plan.one_number(end)) for end in (low, high))
    remedy = f"give a force that some {name} in the range has"
    quantity = Quantity("force", "N/m", remedy, ends[0], ends[1], DomainError)
    wanted = quantity.checked(force)
    goal = np.atleast_1d(np.asarray(wanted, float)).ravel()
    fixed = plan.fixed

    def below(values: Array) -> NDArray[np.bool_]:
        goals = np.repeat(goal, values.size // max(goal.size, 1))
        forces = plan.of_radii(values) if plan.straight else plan.of(**fixed, **{name: values})
        return np.asarray(forces <= goals if monotonic == RISING else forces >= goals)

    root = narrowed(below, np.full(goal.size, low), np.full(goal.size, high))
    if isinstance(wanted, float):
        return float(root[0])
    return root.reshape(wanted.shape)

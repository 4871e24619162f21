"""Whether a prepared force is monotonic, proven piece by piece, and its inverse."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import ArrayLike, NDArray

from surrogate.basics.checks import FloatOrArray, Quantity
from surrogate.basics.elementwise import log
from surrogate.basics.roots import narrowed
from surrogate.errors import DomainError, InputError
from surrogate.prepared.plan import GAMMA, MU, RADIUS, WEAR, XI, Plan
from surrogate.prepared.straight import Straight

__all__ = ["inverse", "is_monotonic"]

Array = NDArray[np.float64]
RISING, FALLING, UNKNOWN = "rising", "falling", "unknown"
_DEEPEST = 12
CLOSE = 1e-9  # of a value, as a share


def is_monotonic(plan: Plan) -> str:
    """Return "rising" or "falling" where it is proven, else "unknown".

    Friction and wear rise with their strengths. F = constant + v (slope + T(x)), with x the sign s
    of ln v, rises with v where slope + T + s T' is positive, which is a cubic in each piece, and
    F = constant + slope v + P(x) where slope v + s P' is: signs of polynomials are proven by their
    Bernstein coefficients.
    """
    (name,) = plan.varying
    if name in (WEAR, XI):
        return RISING
    if not plan.of_table:
        return RISING if name in (RADIUS, MU, GAMMA) else UNKNOWN
    straight = plan.straight
    if straight is None or (straight.times is not None and straight.plain is not None):
        return UNKNOWN
    pieces = list(_pieces(plan, straight))
    if _jumps(straight, {piece for piece, *_ in pieces}):
        return UNKNOWN  # and there is no inverse of what lies between
    signs = {_sign(_slope(straight, *at), *at[1]) for at in pieces}
    if signs == {1}:
        return RISING
    return FALLING if signs == {-1} and straight.plain is None else UNKNOWN


def _slope(straight: Straight, piece: int, ends: tuple[float, float], rate: float) -> Array:
    """Return powers of what has the sign of dF/dv in a piece; beside P, of what is below it."""
    line = straight.times if straight.plain is None else straight.plain
    assert line is not None
    a, b, c, d = line.pieces[piece]
    by_x = straight.sign * rate * np.array([b, 2.0 * c, 3.0 * d, 0.0])
    if straight.plain is None:
        return np.array([straight.slope + a, b, c, d]) + by_x
    places = ends if straight.sign > 0.0 else ends[::-1]
    x = (piece + places[0] - line.short) / rate
    least = np.exp((x - straight.start) * straight.sign)  # of v in the piece
    return np.array([straight.slope * least, 0.0, 0.0, 0.0]) + by_x


def _jumps(straight: Straight, pieces: set[int]) -> bool:
    """Return whether the force jumps in the range: at the touch, under the law of slip."""
    line = straight.times if straight.times is not None else straight.plain
    assert line is not None
    if not {line.short - 1, line.short} <= pieces:
        return False
    before, after = float(sum(line.pieces[line.short - 1])), float(line.pieces[line.short][0])
    return abs(after - before) > CLOSE * max(abs(before), abs(after))


def _pieces(plan: Plan, straight: Straight) -> Iterator[tuple[int, tuple[float, float], float]]:
    """Yield each piece in the range, the places where the range begins and ends in it, the rate."""
    line = straight.times if straight.times is not None else straight.plain
    assert line is not None
    x = sorted(straight.start + straight.sign * log(v) for v in plan.ranges[plan.varying[0]])
    ends = [line.place(np.array([each])) for each in x]
    first, last = (int(piece[0]) for piece, _ in ends)
    for piece in range(first, last + 1):
        begin = float(ends[0][1][0]) if piece == first else 0.0
        end = float(ends[1][1][0]) if piece == last else 1.0
        yield piece, (begin, end), line.before if piece < line.short else line.after


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
        straight = plan.straight
        forces = straight.of(values) if straight else plan.of(**fixed, **{name: values})
        return np.asarray(forces <= goals if monotonic == RISING else forces >= goals)

    root = narrowed(below, np.full(goal.size, low), np.full(goal.size, high))
    if isinstance(wanted, float):
        return float(root[0])
    return root.reshape(wanted.shape)

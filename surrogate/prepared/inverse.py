"""Whether a prepared force is monotonic, proven piece by piece, and its inverse."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from surrogate.basics.checks import FloatOrArray, Quantity
from surrogate.basics.elementwise import log
from surrogate.basics.intervals import Interval
from surrogate.basics.roots import narrowed
from surrogate.contact.domain import g_range
from surrogate.errors import DomainError, InputError
from surrogate.prepared.plan import ALPHA, FACTORS, GAMMA, MU, RADIUS, WEAR, XI, Plan
from surrogate.prepared.straight import Straight

__all__ = ["inverse", "is_monotonic"]

Array = NDArray[np.float64]
RISING, FALLING, UNKNOWN = "rising", "falling", "unknown"
_DEEPEST = 12
CLOSE = 1e-9  # of a value, as a share
_MOST_INTERVALS = 2**14


def is_monotonic(plan: Plan) -> str:
    """Return "rising" or "falling" where it is proven, else "unknown".

    Friction and wear rise with their strengths. F = constant + v (slope + T(x)), with x the sign s
    of ln v, rises with v where slope + T + s T' is positive, which is a cubic in each piece, and
    F = constant + slope v + P(x) where slope v + s P' is: signs of polynomials are proven by their
    Bernstein coefficients.
    """
    (name,) = plan.varying
    if plan.load is not None:
        return UNKNOWN if name == ALPHA else _amplified(plan)
    if name in (WEAR, XI):
        return RISING
    if not plan.of_table:
        return RISING if name in (RADIUS, MU, GAMMA) else UNKNOWN
    straight = plan.straight
    if not isinstance(straight, Straight) or (straight.times and straight.plain):
        return UNKNOWN
    pieces = list(_pieces(plan, straight))
    if _jumps(straight, {piece for piece, *_ in pieces}):
        return UNKNOWN  # and there is no inverse of what lies between
    signs = {_sign(_slope(straight, *at), *at[1]) for at in pieces}
    if signs == {1}:
        return RISING
    return FALLING if signs == {-1} and straight.plain is None else UNKNOWN


def _amplified(plan: Plan) -> str:
    """Return the same of F = Gamma_o + kappa D, D = 2 R_w (tau_w A + xi mu B).

    With u the logarithm of a quantity that g depends on, and otherwise the strength itself,
    dF/du = dGamma_o/du + kappa (D' + D d ln kappa/du). Its sign is proven in intervals, which are
    halved where it is not.
    """
    (name,) = plan.varying
    first, last = (log(g) - next(iter(plan.lines.values())).touch for g in plan.g_ends())
    if first < 0.0 <= last:
        return UNKNOWN  # as the slip jumps at the touch
    low, high = _intervals(plan, name)
    signs: set[int] = set()
    while low.size:
        slope = _slope_in(plan, name, Interval(low, high))
        rises, falls = slope.low > 0.0, slope.high < 0.0
        signs |= {sign for sign, there in ((1, rises), (-1, falls)) if there.any()}
        low, high = (ends[~(rises | falls)] for ends in (low, high))
        if len(signs) == 2 or low.size > _MOST_INTERVALS or np.any(high - low <= CLOSE * high):
            return UNKNOWN
        middle = 0.5 * (low + high)
        low, high = np.append(low, middle), np.append(middle, high)
    return RISING if signs == {1} else FALLING


def _intervals(plan: Plan, name: str) -> tuple[Array, Array]:
    """Return the parts of the range on the pieces of the table."""
    low, high = plan.ranges[name]
    inner = np.empty(0)
    if name not in (XI, WEAR):
        line = next(iter(plan.lines.values()))
        numbers = np.arange(len(line.pieces)) - line.short
        x = numbers / np.where(numbers < 0, line.before, line.after)
        g = np.exp(x + line.touch)
        rest = g_range({**plan.ranges, name: (1.0, 1.0)})[0]
        inner = g / rest if name == GAMMA else rest / g
    ends = np.unique([low, *inner[(inner > low) & (inner < high)], high])
    return ends[:-1], ends[1:]


def _slope_in(plan: Plan, name: str, v: Interval) -> Interval:
    """Return what has the sign of dF/du in intervals of a quantity."""
    sign = {GAMMA: 1.0, RADIUS: -1.0, MU: -1.0}.get(name, 0.0)
    log_g = _log_g(plan, name, v)
    drag, slope = (Interval(np.zeros(v.low.shape), np.zeros(v.low.shape)) for _ in range(2))
    for term, line in plan.lines.items():
        value, by_x = (Interval(*ends) for ends in line.between(log_g.low, log_g.high))
        factor = plan.factors(name)[term]
        strength: Any = v * factor if name in FACTORS[term] else factor
        drag = drag + value * strength
        slope = slope + by_x * strength * sign
        if name in FACTORS[term]:
            slope = slope + value * (strength if sign else factor)
    variables, by_u = _variables(plan, name, v, log_g, sign)
    assert plan.load is not None
    log_kappa = plan.load.polynomial
    for derivative, rate in zip(log_kappa.derivatives, by_u, strict=True):
        slope = slope + drag * (rate * derivative(*variables))
    if name != GAMMA:
        return slope
    kappa = log_kappa(*variables)
    return v + slope * Interval(np.exp(kappa.low), np.exp(kappa.high))


def _log_g(plan: Plan, name: str, v: Interval) -> Interval:
    if name in (XI, WEAR):
        log_g = np.full(v.low.shape, float(np.log(plan.g_ends()[0])))
        return Interval(log_g, log_g)
    rest = float(np.log(g_range({**plan.ranges, name: (1.0, 1.0)})[0]))
    low, high = np.log(v.low), np.log(v.high)
    return Interval(rest + low, rest + high) if name == GAMMA else Interval(rest - high, rest - low)


def _variables(
    plan: Plan, name: str, v: Interval, log_g: Interval, sign: float
) -> tuple[list[Interval], list[Any]]:
    """Return the variables of ln kappa that vary, and their derivatives by u."""
    assert plan.load is not None
    if name == XI:
        return [v], [1.0]
    variables: list[Interval] = [log_g + -plan.load.touch]
    by_u: list[Any] = [sign]
    if name == WEAR:
        mu = plan.fixed[MU]
        w = Interval(np.log1p(v.low / mu), np.log1p(v.high / mu))
        return [w], [Interval(1.0 / (mu + v.high), 1.0 / (mu + v.low))]
    if name == MU and plan.fixed[WEAR]:
        wear = plan.fixed[WEAR]
        variables += [Interval(np.log1p(wear / v.high), np.log1p(wear / v.low))]
        by_u += [Interval(-wear / (v.low + wear), -wear / (v.high + wear))]
    return variables, by_u


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

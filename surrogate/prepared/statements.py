"""The statements that evaluate a prepared force, in words that all four languages share."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from itertools import pairwise, product
from typing import Any

import numpy as np

from surrogate.contact.domain import Domain
from surrogate.coupling.amplification import Amplification
from surrogate.prepared.dialects import Dialect
from surrogate.prepared.line import Line
from surrogate.prepared.plan import ALPHA, ARC, GAMMA, LOAD, MU, RADIUS, WEAR, XI, Plan
from surrogate.prepared.proof import lowest_of_highest

__all__ = [
    "COEFFICIENTS",
    "arrays_of",
    "cases_of",
    "force_statements",
    "highest_log_g",
    "leaves_table",
    "reach_array",
    "reach_statements",
]

COEFFICIENTS = {ARC: "ARC", LOAD: "LOAD"}
"""Names of the arrays of A and B at one alpha."""

PARTS = {ARC: "a_here", LOAD: "b_here"}
"""Names of A and B in the statements."""


def arrays_of(plan: Plan, dialect: Dialect) -> list[str]:
    """Return the arrays of coefficients at one alpha; none where alpha varies."""
    return [
        dialect.numbers(COEFFICIENTS[term], line.pieces.ravel().tolist())
        for term, line in plan.lines.items()
    ]


def force_statements(plan: Plan, dialect: Dialect) -> tuple[list[str], str]:
    """Return statements, and the expression of the force after them."""
    lines = []
    if plan.lines:
        lines += _place(next(iter(plan.lines.values())), dialect)
        lines += [_let(dialect, PARTS[t], _cubic(dialect, COEFFICIENTS[t])) for t in plan.lines]
    elif plan.of_table:
        g = f"{GAMMA}/({MU}*{RADIUS})"
        functions = {t: COEFFICIENTS[t].lower() for t in plan.of_table}
        lines += [_let(dialect, PARTS[t], _call(dialect, f, g)) for t, f in functions.items()]
    lines += _kappa(plan, dialect) if plan.load else []
    total = " + ".join((GAMMA, *_terms(plan)))
    text = "\n".join((*lines, total))
    constants = {n: v for n, v in plan.fixed.items() if re.search(rf"\b{n}\b", text)}
    return [*(_let(dialect, n, repr(v)) for n, v in constants.items()), *lines], total


def leaves_table(plan: Plan) -> bool:
    """Return whether scenes in the ranges may be outside the domain of the table."""
    if plan.table is None:
        return False
    (low, high), limits = plan.g_ends(), plan.table.limits
    return not (limits.g[0] <= low and high <= lowest_of_highest(limits, plan.ranges[ALPHA]))


def highest_log_g(limits: Domain, dialect: Dialect) -> str:
    """Return the expression of ln of the highest g of the domain at alpha."""
    if not limits.highest:
        return repr(limits.log_g[1])
    rows, values = ([math.log(x) for x in each] for each in zip(*limits.highest, strict=True))
    expression = repr(values[0])
    for (row, after), (value, following) in zip(pairwise(rows), pairwise(values), strict=True):
        if following != value:
            slope = (following - value) / (after - row)
            along = f"{dialect.lowest}({after - row!r}, {dialect.log}({ALPHA}) - {row!r})"
            expression += f" + {slope!r}*{dialect.highest}(0.0, {along})"
    return expression


def _call(dialect: Dialect, name: str, g: str) -> str:
    prefix = "wirecut_" if dialect.name == "c" else ""
    return f"{prefix}{name}({g}, {ALPHA})"


def _terms(plan: Plan) -> Iterator[str]:
    """Yield the terms beside the cleavage."""
    arc, load_2, load_slope = plan.form.arc_2, plan.form.load_2, plan.form.load_2_slope
    times = "*kappa" if plan.load else ""
    if ARC in plan.of_table:
        yield f"2.0*({WEAR}*{RADIUS})*{PARTS[ARC]}{times}"
    elif arc and plan.ranges[WEAR][1]:
        yield f"{arc!r}*({WEAR}*{RADIUS})"
    if LOAD in plan.of_table:
        yield f"2.0*({RADIUS}*({XI}*{MU}))*{PARTS[LOAD]}{times}"
    elif plan.ranges[XI][1]:
        if load_slope:
            yield f"{load_slope!r}*({XI}*{GAMMA})"
        if load_2:
            yield f"{load_2!r}*({RADIUS}*({XI}*{MU}))"


_VARIABLES = {"x": "x_load", "y": "log_alpha", "xi": XI, "w": "w_load"}
"""Names of the variables of ln kappa."""


def _kappa(plan: Plan, dialect: Dialect) -> Iterator[str]:
    """Yield the statements that find kappa."""
    load = plan.load
    assert load is not None
    if "y" in load.varies:
        row = f"{dialect.log}({ALPHA})"
        yield _let(dialect, _VARIABLES["y"], f"{row} - ({load.center['y']!r})")
        touch = f"{_polynomial(list(load.kappa.touch), [row])} + ({load.center['x']!r})"
    else:
        touch = repr(load.touch)
    if "x" in load.varies:
        log_g = f"{dialect.log}({GAMMA}/({MU}*{RADIUS}))"
        yield _let(dialect, _VARIABLES["x"], f"{log_g} - ({touch})")
    if "w" in load.varies:
        yield _let(dialect, _VARIABLES["w"], f"{dialect.log1p}({WEAR}/{MU})")
    first, *others = (_VARIABLES[variable] for variable in load.varies)
    names = []
    for power, row in enumerate(load.polynomial.nested):
        names.append(f"k{power}")
        yield _let(dialect, names[-1], _polynomial(row, others))
    yield _let(dialect, "kappa", f"{dialect.exp}({_sum_of_powers(names, first)})")


def _polynomial(rows: Any, variables: Sequence[str]) -> str:
    """Return a polynomial of variables, by Horner's rule."""
    if isinstance(rows, float):
        return repr(rows)
    return _sum_of_powers([_polynomial(row, variables[1:]) for row in rows], variables[0])


def _sum_of_powers(coefficients: Sequence[str], variable: str) -> str:
    text = coefficients[-1]
    for coefficient in coefficients[-2::-1]:
        text = f"({coefficient} + {variable}*{text})"
    return text


def _let(dialect: Dialect, name: str, expression: str) -> str:
    return f"{dialect.declare}{name} = {expression}{dialect.end}"


def _place(line: Line, dialect: Dialect) -> list[str]:
    """Return the statements that find the piece and the place in it."""
    last = len(line.pieces) - 1
    x = f"{dialect.log}({GAMMA}/({MU}*{RADIUS})) - ({line.touch!r})"
    sides = (
        f"{line.before!r}*{dialect.lowest}(x, 0.0) + {line.after!r}*{dialect.highest}(x, 0.0)"
        f" + {float(line.short)!r}"
    )
    piece = f"{dialect.highest}(0, {dialect.lowest}({last}, {dialect.floor}(t)))"
    cast = "(int)" if dialect.name == "c" else ""
    return [
        _let(dialect, "x", x),
        _let(dialect, "t", sides),
        f"{dialect.integer}piece = {cast}{piece}{dialect.end}",
        f"t = t - piece{dialect.end}",
    ]


def _cubic(dialect: Dialect, array: str) -> str:
    a, b, c, d = (dialect.item(array, f"4*piece + {k}") for k in range(4))
    return f"{a} + t*({b} + t*({c} + t*{d}))"


_REACH = "REACH"
_CALLED = "reach_of_loads"


def reach_array(kappa: Amplification, dialect: Dialect) -> str:
    """Return the largest known loads: an array, in MATLAB a function that returns it."""
    values = kappa.reach.ravel().tolist()
    if not dialect.first:
        return dialect.numbers(_REACH, values)
    return f"function {_REACH} = {_CALLED}()\n{dialect.numbers(_REACH, values)}\nend\n"


def reach_statements(kappa: Amplification, dialect: Dialect) -> tuple[list[str], list[str]]:
    """Return statements, and conditions after them: solutions reach to g, alpha and the load.

    Between its nodes the reach is linear in x, in y and in the direction of the load.
    """
    x, y, _ = ((float(axis[0]), float(axis[-1])) for axis in kappa.axes)
    units = kappa.load_unit
    log_g, row = f"{dialect.log}({GAMMA}/({MU}*{RADIUS}))", f"{dialect.log}({ALPHA})"
    numbers = {
        "x_load": f"{log_g} - ({_polynomial(list(kappa.touch), [row])})",
        "rubbed": f"{XI}/{units[0]!r}",
        "worn": f"{WEAR}/{MU}/{units[1]!r}",
        "size": f"{dialect.highest}(rubbed, worn)",
        "direction": f"0.5 + 0.5*(worn - rubbed)/{dialect.highest}(size, 1e-300)",
    }
    lines = [f"{_REACH} = {_CALLED}(){dialect.end}"] if dialect.first else []
    lines += [_let(dialect, name, expression) for name, expression in numbers.items()]
    for name, place, axis in zip("ijk", ("x_load", row, "direction"), kappa.axes, strict=True):
        along = f"({place} - ({float(axis[0])!r}))/{float(axis[1] - axis[0])!r}"
        lines.append(_let(dialect, f"in_{name}", along))
        number = (
            f"{dialect.highest}(0, {dialect.lowest}({len(axis) - 2}, {dialect.floor}(in_{name})))"
        )
        cast = "(int)" if dialect.name == "c" else ""
        lines.append(f"{dialect.integer}{name} = {cast}{number}{dialect.end}")
        lines.append(f"in_{name} = in_{name} - {name}{dialect.end}")
    lines.append(_let(dialect, "reach", _between_nodes(kappa.reach.shape, dialect)))
    low, high = (float(np.log(end)) for end in (kappa.lowest, kappa.highest))
    ends = [("x_load", *x), (row, *y), (log_g, low, high)]
    inside = [f"{what} >= {a - 1e-9!r}" for what, a, _ in ends]
    inside += [f"{what} <= {b + 1e-9!r}" for what, _, b in ends]
    return lines, [*inside, "size <= reach"]


def _between_nodes(shape: tuple[int, ...], dialect: Dialect) -> str:
    """Return the reach at a place between its eight nearest nodes."""
    terms = []
    for corner in product((0, 1), repeat=3):
        shares = [f"in_{n}" if one else f"(1.0 - in_{n})" for n, one in zip("ijk", corner)]  # noqa: B905
        i, j, k = (f"({n} + {one})" for n, one in zip("ijk", corner))  # noqa: B905
        index = f"({i}*{shape[1]} + {j})*{shape[2]} + {k}"
        terms.append("*".join([*shares, dialect.item(_REACH, index)]))
    return " + ".join(terms)


def cases_of(plan: Plan, count: int = 10) -> np.ndarray:
    """Return values of what varies, the ends of the ranges first, one row for each case."""
    shares = np.linspace(0.0, 1.0, count)
    rows = []
    for k, name in enumerate(plan.varying):
        low, high = plan.ranges[name]
        mixed = np.roll(shares, 3 * k)  # so that the quantities do not rise together
        with np.errstate(all="ignore"):
            rows.append(np.minimum(np.maximum(low + (high - low) * mixed**2, low), high))
    return np.array(rows).T

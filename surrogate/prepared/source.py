"""A prepared force as a program of its own: C, JavaScript, MATLAB (or Octave) and Python.

Every file has the same three functions. `check` returns 0, or the number of the first argument that
is outside its range (one more than there are where g is outside the domain). `force` returns the
force in N/m, and no number where `check` is not 0. `self_test` returns 0, or the number of the
first of its cases that comes out otherwise than in Python.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from surrogate.contact.coordinates import log_touch
from surrogate.contact.fitted import COUPLED, PROJECTED, SLIP
from surrogate.coupling.amplification import Amplification, edge_of
from surrogate.errors import InputError
from surrogate.prepared.dialects import DIALECTS, Dialect
from surrogate.prepared.plan import GAMMA, MU, RADIUS, WEAR, WITHOUT_SHEAR, XI, Plan
from surrogate.prepared.statements import (
    COEFFICIENTS,
    arrays_of,
    cases_of,
    force_statements,
    highest_log_g,
    leaves_table,
    reach_array,
    reach_statements,
)
from surrogate.prepared.table_source import table_part
from surrogate.scene import QUANTITIES
from surrogate.version import __version__

__all__ = ["LANGUAGES", "source_of"]

LANGUAGES = tuple(DIALECTS)
TOLERANCE = 1e-12
CLOSE = 1e-12  # by which ln g may miss the ends of the table's domain, as it is rounded
_UNITS = {quantity.name: quantity.unit or "-" for quantity in QUANTITIES}


def source_of(force: Any, language: str) -> str:
    """Return a prepared force as a program.

    Raises
    ------
    InputError
        If there is no such language.

    Examples
    --------
    >>> from surrogate import Scene, prepare
    >>> force = prepare(Scene(685.0, 1.6, 1e-4), ranges={"wire_radius": (1e-4, 1e-3)})
    >>> "double wirecut_force(double wire_radius)" in source_of(force, "c")
    True
    """
    if language not in DIALECTS:
        raise InputError(
            f"language must be one of {', '.join(DIALECTS)}, but is {language!r}; choose one."
        )
    dialect, plan = DIALECTS[language], force.plan
    needs_g = bool(plan.of_table) and not plan.lines
    parts = {
        "remarks": dialect.remarks(_about(force, dialect)),
        "arguments": ", ".join(f"{'double ' * (language == 'c')}{n}" for n in plan.varying),
        "names": ", ".join(plan.varying),
        "checks": "\n".join(_checks(plan, dialect)),
        "arrays": "\n".join(arrays_of(plan, dialect)),
        "table": _table(plan, dialect) if needs_g else "",
        "cases": _cases(force, dialect),
        "calls": _calls(plan, dialect),
        "columns": str(len(plan.varying) + 1),
        "count": str(len(plan.varying)),
        "tolerance": repr(TOLERANCE),
        "others": ", arc, load, byLogG, logTouch" if needs_g and len(plan.of_table) == 2 else "",
    }
    statements, total = force_statements(plan, dialect)
    parts["body"] = "\n".join(f"  {'  ' * (language == 'python')}{line}" for line in statements)
    parts["total"] = total
    text = _SKELETONS[language]
    for key, value in parts.items():
        text = text.replace(f"<<{key}>>", value)
    return "\n".join(line.rstrip() for line in text.splitlines()).strip("\n") + "\n"


def _table(plan: Plan, dialect: Dialect) -> str:
    table = table_part(plan.table, _functions(plan), dialect)
    if plan.kappa is None or not leaves_table(plan):
        return table
    return f"{table}\n\n{reach_array(plan.kappa, dialect)}"


def _functions(plan: Plan) -> dict[str, str]:
    """Return the table's functions for A and B under the plan's law, by their names."""
    assert plan.table is not None
    names = dict(zip(COEFFICIENTS, plan.table.rubbing, strict=True))
    return {COEFFICIENTS[term]: names[term] for term in plan.of_table}


def _about(force: Any, dialect: Dialect) -> list[str]:
    plan: Plan = force.plan
    ends = [
        f"  {name} from {low!r} to {high!r} [{_UNITS[name]}]"
        for name, (low, high) in force.ranges.items()
    ]
    fixed = [f"  {name} = {value!r} [{_UNITS[name]}]" for name, value in plan.fixed.items()]
    models = ", ".join(f"{term} by {model}" for term, model in force.terms.items())
    where = ["g = toughness/(shear_modulus*wire_radius) in the domain of the table, too."]
    if plan.kappa is not None:
        where += ["Friction and wear up to what coupled solutions reach, short of the tip's touch."]
    return [
        f"Steady cutting force F_ss/T [N/m], exported by wirecut {__version__}. MIT licence.",
        f"Law: {_LAWS[plan.law]}",
        f"Terms: {models or 'cleavage alone'}. Data: {'; '.join(force.data.values())}.",
        *_errors(force),
        "Arguments, in SI units, and their ranges:",
        *ends,
        *(where if leaves_table(plan) else []),
        *(["Fixed:", *fixed] if fixed else []),
        "check returns 0, or the number of the first argument out of range: no number is a force.",
        f"self_test returns 0, or the number of the first case that is not met to {TOLERANCE:g}.",
    ]


_LAWS = {
    PROJECTED: "F_ss/T = Gamma_o + 2 R_w (tau_w A + xi mu B), Eq. (S2) of arXiv:2412.02021.",
    SLIP: "F_ss/T = Gamma_o + 2 R_w (tau_w A* + xi mu B*), energy to first order in tau_w and xi.",
    COUPLED: "F_ss/T = Gamma_o + 2 R_w (tau_w A* + xi mu B*) kappa, stresses acting on the body.",
}
"""The laws in words."""


def _errors(force: Any) -> list[str]:
    """Return the lines that say how far the force may be off, and beside what."""
    lines = [_error(force.relative_error, force.beside)]
    if force.law != COUPLED:
        lines += [_error(force.fit_error, WITHOUT_SHEAR)]
    unknown = force.fit_error != force.fit_error
    if force.law == SLIP and unknown:
        lines += ["Where the crack's tip touches the wire the force depends on how sharp it is."]
    if force.law == PROJECTED and force.relative_error != force.relative_error:
        lines += ["tau_w and xi are effective strengths then: those that this law was fitted with."]
    return lines


def _error(error: float, beside: str) -> str:
    known = f"up to {error:.3g}" if error == error else "unknown"
    return f"Relative error beside finite elements {beside}: {known}."


def _checks(plan: Plan, dialect: Dialect) -> list[str]:
    """Return the lines that return the number of the first argument out of range."""
    joined = _AND[dialect.name]
    conditions = [
        f"{name} >= {low!r} {joined} {name} <= {high!r}"
        for name, (low, high) in ((name, plan.ranges[name]) for name in plan.varying)
    ]
    if plan.table is not None and leaves_table(plan):
        low, g = plan.table.limits.log_g[0], f"{dialect.log}({GAMMA}/({MU}*{RADIUS}))"
        high = highest_log_g(plan.table.limits, dialect)
        conditions.append(f"{g} >= {low - CLOSE!r} {joined} {g} <= {high} + {CLOSE!r}")
    unless = _UNLESS[dialect.name]
    lines = [unless.format(condition=c, number=n) for n, c in enumerate(conditions, start=1)]
    if plan.kappa is not None and leaves_table(plan):
        statements, within = reach_statements(plan.kappa, dialect)
        condition = f" {joined} ".join(within)
        unloaded = f"{XI} == 0.0 {joined} {WEAR} == 0.0"
        either = f"({unloaded}) {_OR[dialect.name]} ({condition})"
        lines += [f"  {'  ' * (dialect.name == 'python')}{line}" for line in statements]
        lines += [unless.format(condition=either, number=len(conditions) + 1)]
    return lines


_OR = {"c": "||", "javascript": "||", "matlab": "||", "python": "or"}
_AND = {"c": "&&", "javascript": "&&", "matlab": "&&", "python": "and"}
_UNLESS = {
    "c": "  if (!({condition})) return {number};",
    "javascript": "  if (!({condition})) return {number};",
    "matlab": "  if ~({condition}), code = {number}; return; end",
    "python": "    if not ({condition}):\n        return {number}",
}


def _cases(force: Any, dialect: Dialect) -> str:
    plan = force.plan
    rows = _whole_cases(plan) if leaves_table(plan) else cases_of(plan)
    expected = [_value(force, row) for row in rows]
    numbers = [[*row.tolist(), value] for row, value in zip(rows, expected, strict=True)]
    flat = [value for row in numbers for value in row]
    return dialect.numbers("CASES" if dialect.name != "matlab" else "cases", flat)


def _value(force: Any, row: Any) -> float:
    return float(
        force.plan.of(**force.plan.fixed, **dict(zip(force.varying, row.tolist(), strict=True)))
    )


def _whole_cases(plan: Plan) -> Any:
    """Return ten scenes in the domain of the table, near its ends and in the middle."""
    assert plan.table is not None
    if plan.kappa is not None:
        return _loaded_cases(plan.kappa)
    limits = plan.table.limits
    alpha = np.linspace(limits.alpha[0], limits.alpha[1], 10)[[3, 0, 6, 9, 1, 8, 2, 5, 7, 4]]
    lowest, highest = 1.001 * limits.g[0], 0.999 * limits.highest_g(alpha)
    g = lowest * (highest / lowest) ** np.linspace(0.0, 1.0, 10)
    mu, radius, one = np.linspace(300.0, 3000.0, 10), np.geomspace(3e-3, 3e-5, 10), np.ones(10)
    return np.array([mu, g * mu * radius, radius, 0.1 * one, 3.0 * mu, alpha]).T


def _loaded_cases(kappa: Amplification) -> Any:
    """Return ten scenes whose loads are a half of the largest ones that are known."""
    (x, y, _), shares = kappa.axes, np.linspace(0.02, 0.98, 10)
    row = (y[0] + shares * (y[-1] - y[0]))[[3, 0, 6, 9, 1, 8, 2, 5, 7, 4]]
    low = np.maximum(x[0], np.log(kappa.lowest) - log_touch(kappa.touch, row))
    high = np.minimum(x[-1], np.log(kappa.highest) - log_touch(kappa.touch, row))
    at = low + shares * (high - low)
    direction = shares[[5, 2, 8, 0, 9, 4, 1, 7, 3, 6]]
    half = 0.5 * kappa.reach_at(at, row, direction)
    xi, relative = (half * part for part in edge_of(direction, kappa.load_unit))
    mu, radius = np.linspace(300.0, 3000.0, 10), np.geomspace(3e-3, 3e-5, 10)
    g, alpha = np.exp(at + log_touch(kappa.touch, row)), np.exp(row)
    return np.array([mu, g * mu * radius, radius, xi, relative * mu, alpha]).T


def _calls(plan: Plan, dialect: Dialect) -> str:
    """Return the arguments of one case."""
    columns = len(plan.varying) + 1
    name = "cases" if dialect.first else "CASES"
    return ", ".join(dialect.item(name, f"{columns}*i + {k}") for k in range(len(plan.varying)))


_C = """
<<remarks>>
#include <math.h>
<<arrays>>
<<table>>

int wirecut_check(<<arguments>>) {
<<checks>>
  return 0;
}

double wirecut_force(<<arguments>>) {
  if (wirecut_check(<<names>>)) return NAN;
<<body>>
  return <<total>>;
}

<<cases>>

int wirecut_self_test(void) {
  for (int i = 0; i < 10; ++i) {
    double expected = CASES[<<columns>>*i + <<count>>];
    double value = wirecut_force(<<calls>>);
    if (!(fabs(value - expected) <= <<tolerance>>*fabs(expected))) return i + 1;
  }
  return 0;
}

#ifdef WIRECUT_MAIN
#include <stdio.h>
int main(void) {
  int wrong = wirecut_self_test();
  printf(wrong ? "case %d is wrong\\n" : "all cases are met\\n", wrong);
  return wrong;
}
#endif
"""

_JAVASCRIPT = """
<<remarks>>
const wirecut = (() => {
"use strict";
<<arrays>>
<<table>>

function check(<<names>>) {
<<checks>>
  return 0;
}

function force(<<names>>) {
  if (check(<<names>>)) return NaN;
<<body>>
  return <<total>>;
}

<<cases>>

function selfTest() {
  for (let i = 0; i < 10; ++i) {
    const expected = CASES[<<columns>>*i + <<count>>];
    if (!(Math.abs(force(<<calls>>) - expected) <= <<tolerance>>*Math.abs(expected))) return i + 1;
  }
  return 0;
}

return {check, force, selfTest<<others>>};
})();
if (typeof module !== "undefined") {
  module.exports = wirecut;
  if (require.main === module) {
    const wrong = wirecut.selfTest();
    console.log(wrong ? `case ${wrong} is wrong` : "all cases are met");
    process.exitCode = wrong;
  }
}
"""

_PYTHON = '''
<<remarks>>
from math import exp, floor, inf, log, log1p, nan

<<arrays>>
<<table>>


def check(<<names>>):
    """Return 0, or the number of the first argument out of range."""
<<checks>>
    return 0


def force(<<names>>):
    """Return the force [N/m], nan out of range."""
    if check(<<names>>):
        return nan
<<body>>
    return <<total>>


<<cases>>


def self_test():
    """Return 0, or the number of the first case that is not met."""
    for i in range(10):
        expected = CASES[<<columns>>*i + <<count>>]
        if not abs(force(<<calls>>) - expected) <= <<tolerance>>*abs(expected):
            return i + 1
    return 0


if __name__ == "__main__":
    wrong = self_test()
    print(f"case {wrong} is wrong" if wrong else "all cases are met")
    raise SystemExit(wrong)
'''

_MATLAB = """
<<remarks>>
% wirecut_force() runs the self-test and returns its code.
function [value, code] = wirecut_force(<<names>>)
  if nargin == 0
    value = self_test(); code = value;
    return
  end
  value = NaN;
  code = check(<<names>>);
  if code == 0
    value = force(<<names>>);
  end
end

function code = check(<<names>>)
<<checks>>
  code = 0;
end

function value = force(<<names>>)
<<arrays>>
<<body>>
  value = <<total>>;
end

function code = self_test()
<<cases>>
  for i = 0:9
    expected = cases(<<columns>>*i + <<count>> + 1);
    if ~(abs(force(<<calls>>) - expected) <= <<tolerance>>*abs(expected))
      code = i + 1;
      return
    end
  end
  code = 0;
end

<<table>>
"""

_SKELETONS = {"c": _C, "javascript": _JAVASCRIPT, "python": _PYTHON, "matlab": _MATLAB}

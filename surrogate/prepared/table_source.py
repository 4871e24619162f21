"""The whole table in other languages: values at the nodes, and splines made of them at the start.

Between nodes all is the cubic of Hermite, along alpha and then along g; the slopes at the nodes are
those of the spline whose third derivative does not jump at the last nodes but one.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from surrogate.contact.grid import Grid
from surrogate.prepared.dialects import Dialect

__all__ = ["table_part"]


def table_part(table: Any, functions: Mapping[str, str], dialect: Dialect) -> str:
    """Return functions of g and alpha that the table gives, as a part of a program.

    Parameters
    ----------
    table : TableModel
        The table.
    functions : mapping of str to str
        By the name in the program, in capitals, that of the table.
    dialect : Dialect
        The language.
    """
    nodes = {
        name: [float(x) for side in table.table.nodes[function] for x in side.flat]
        for name, function in functions.items()
    }
    arrays = "\n".join(_array(dialect, name, values) for name, values in nodes.items())
    grid = table.table.grid
    text = _TEXT[dialect.name]
    head, of_one = text.split("<<each>>")
    numbers = _numbers(grid, table.limits, dialect)
    definitions = "".join(
        of_one.replace("<<NAME>>", name).replace("<<name>>", name.lower()) for name in nodes
    )
    filled = head.replace("<<arrays>>", arrays) + definitions
    for key, value in numbers.items():
        filled = filled.replace(f"<<{key}>>", value)
    return filled.strip("\n")


def _array(dialect: Dialect, name: str, values: list[float]) -> str:
    if dialect.name == "javascript" and (short := _single(values)):
        return dialect.numbers(f"{name}_NODES", short).removesuffix(";") + ".map(Math.fround);"
    if not dialect.first:
        return dialect.numbers(f"{name}_NODES", values)
    return f"function v = {name.lower()}_nodes()\n{dialect.numbers('v', values)}\nend\n"


def _single(values: list[float]) -> list[Any]:
    """Return numbers of single precision, which half the digits tell; nothing if some are not."""
    short = [np.float32(x) for x in values]
    written = [_Written(str(x)) for x in short]
    exact = [float(np.float32(float(x))) for x in written] == values
    return list(written) if exact else []


class _Written(str):
    """A number as it is to be written."""

    def __repr__(self) -> str:
        return str(self)


def _numbers(grid: Grid, limits: Any, dialect: Dialect) -> dict[str, str]:
    low, high = grid.log_alpha
    touch = repr(grid.touch[-1])
    for coefficient in grid.touch[-2::-1]:
        touch = f"({touch})*row + ({coefficient!r})"
    return {
        "short": str(grid.short),
        "short_float": repr(float(grid.short)),
        "past": str(grid.past),
        "last": str(grid.cells - 1),
        "columns": str(grid.stiffening + 1),
        "last_column": str(grid.stiffening - 1),
        "rows_short": str(grid.short + 1),
        "rows_past": str(grid.past + 1),
        "size": str((grid.cells + 2) * (grid.stiffening + 1)),
        "touch": touch,
        "low_g": repr(grid.log_g),
        "after": repr(grid.past / grid.beyond),
        "low_alpha": repr(low),
        "per_alpha": repr(grid.stiffening / (high - low)),
    }


_C = """
<<arrays>>

/* slopes of a cubic spline through evenly spaced values */
static void wirecut_spline(const double *v, double *out, int count, int step) {
  double upper[128], right[128];
  for (int i = 0; i < count; ++i) {
    double below = i == 0 ? 0.0 : i == count - 1 ? 2.0 : 1.0;
    double on = i == 0 || i == count - 1 ? 1.0 : 4.0;
    double above = i == 0 ? 2.0 : i == count - 1 ? 0.0 : 1.0;
    double r = i == 0 ? -2.5*v[0] + 2.0*v[step] + 0.5*v[2*step]
      : i == count - 1 ? -0.5*v[(i-2)*step] - 2.0*v[(i-1)*step] + 2.5*v[i*step]
      : 3.0*(v[(i+1)*step] - v[(i-1)*step]);
    double pivot = on - (i ? below*upper[i-1] : 0.0);
    upper[i] = above/pivot;
    right[i] = (r - (i ? below*right[i-1] : 0.0))/pivot;
  }
  for (int i = count - 1; i >= 0; --i)
    out[i*step] = right[i] - (i < count - 1 ? upper[i]*out[(i+1)*step] : 0.0);
}

static void wirecut_slopes(const double *v, double *along_g, double *along_a, double *mixed) {
  const int c = <<columns>>, past = <<rows_short>>*c;
  for (int j = 0; j < c; ++j) {
    wirecut_spline(v + j, along_g + j, <<rows_short>>, c);
    wirecut_spline(v + past + j, along_g + past + j, <<rows_past>>, c);
  }
  for (int i = 0; i < <<rows_short>> + <<rows_past>>; ++i) {
    wirecut_spline(v + i*c, along_a + i*c, c, 1);
    wirecut_spline(along_g + i*c, mixed + i*c, c, 1);
  }
}

static double wirecut_hermite(double t, double a, double b, double c, double d) {
  return a + t*(c + t*(3.0*(b - a) - 2.0*c - d + t*(2.0*(a - b) + c + d)));
}

static double wirecut_table(const double *v, const double *g1, const double *a1, const double *m,
                            double g, double alpha) {
  double row = log(alpha);
  double touch = <<touch>>;
  double x = log(g) - touch;
  double t = (x < 0.0 ? <<short_float>>/(touch - (<<low_g>>)) : <<after>>)*x + <<short_float>>;
  double s = (row - (<<low_alpha>>))*<<per_alpha>>;
  int i = (int)fmax(0, fmin(<<last>>, floor(t))), j = (int)fmax(0, fmin(<<last_column>>, floor(s)));
  t -= i; s -= j;
  int k = (i + (i >= <<short>>))*<<columns>> + j, n = k + <<columns>>;
  return wirecut_hermite(t,
    wirecut_hermite(s, v[k], v[k+1], a1[k], a1[k+1]),
    wirecut_hermite(s, v[n], v[n+1], a1[n], a1[n+1]),
    wirecut_hermite(s, g1[k], g1[k+1], m[k], m[k+1]),
    wirecut_hermite(s, g1[n], g1[n+1], m[n], m[n+1]));
}
<<each>>
static double wirecut_<<name>>(double g, double alpha) {
  static double along_g[<<size>>], along_a[<<size>>], mixed[<<size>>];
  static int ready = 0;  /* the first call makes the splines: let one thread do it */
  if (!ready) { wirecut_slopes(<<NAME>>_NODES, along_g, along_a, mixed); ready = 1; }
  return wirecut_table(<<NAME>>_NODES, along_g, along_a, mixed, g, alpha);
}
"""

_JAVASCRIPT = """
<<arrays>>

// slopes of a cubic spline through evenly spaced values
function spline(v, out, start, count, step) {
  const upper = [], right = [], at = (i) => v[start + i*step];
  for (let i = 0; i < count; ++i) {
    const first = i === 0, last = i === count - 1;
    const below = first ? 0 : last ? 2 : 1, on = first || last ? 1 : 4;
    const above = first ? 2 : last ? 0 : 1;
    const r = first ? -2.5*at(0) + 2*at(1) + 0.5*at(2)
      : last ? -0.5*at(i-2) - 2*at(i-1) + 2.5*at(i) : 3*(at(i+1) - at(i-1));
    const pivot = on - (first ? 0 : below*upper[i-1]);
    upper.push(above/pivot);
    right.push((r - (first ? 0 : below*right[i-1]))/pivot);
  }
  for (let i = count - 1; i >= 0; --i)
    out[start + i*step] = right[i] - (i < count - 1 ? upper[i]*out[start + (i+1)*step] : 0);
}

function splines(v) {
  const c = <<columns>>, rows = <<rows_short>> + <<rows_past>>;
  const [alongG, alongA, mixed] = [0, 0, 0].map(() => new Float64Array(v.length));
  for (let j = 0; j < c; ++j) {
    spline(v, alongG, j, <<rows_short>>, c);
    spline(v, alongG, <<rows_short>>*c + j, <<rows_past>>, c);
  }
  for (let i = 0; i < rows; ++i) {
    spline(v, alongA, i*c, c, 1);
    spline(alongG, mixed, i*c, c, 1);
  }
  return [v, alongG, alongA, mixed];
}

function hermite(t, a, b, c, d) {
  return a + t*(c + t*(3*(b - a) - 2*c - d + t*(2*(a - b) + c + d)));
}

function hermiteSlope(t, a, b, c, d) {
  return c + t*(2*(3*(b - a) - 2*c - d) + 3*t*(2*(a - b) + c + d));
}

function logTouch(row) { return <<touch>>; }

function cellsPerLogG(x, touch) {
  return x < 0 ? <<short_float>>/(touch - (<<low_g>>)) : <<after>>;
}

function table([v, g1, a1, m], g, alpha, alongG = hermite) {
  const row = Math.log(alpha), touch = logTouch(row), x = Math.log(g) - touch;
  let t = cellsPerLogG(x, touch)*x + <<short_float>>;
  let s = (row - (<<low_alpha>>))*<<per_alpha>>;
  const i = Math.max(0, Math.min(<<last>>, Math.floor(t)));
  const j = Math.max(0, Math.min(<<last_column>>, Math.floor(s)));
  t -= i; s -= j;
  const k = (i + (i >= <<short>> ? 1 : 0))*<<columns>> + j, n = k + <<columns>>;
  return alongG(t,
    hermite(s, v[k], v[k+1], a1[k], a1[k+1]), hermite(s, v[n], v[n+1], a1[n], a1[n+1]),
    hermite(s, g1[k], g1[k+1], m[k], m[k+1]), hermite(s, g1[n], g1[n+1], m[n], m[n+1]));
}

// derivative by ln g of a function of the table
function byLogG(of, g, alpha) {
  const touch = logTouch(Math.log(alpha));
  return of(g, alpha, hermiteSlope)*cellsPerLogG(Math.log(g) - touch, touch);
}
<<each>>
const <<NAME>>_SPLINES = splines(<<NAME>>_NODES);
function <<name>>(g, alpha, alongG) { return table(<<NAME>>_SPLINES, g, alpha, alongG); }
"""

_PYTHON = '''
<<arrays>>


def spline(v):
    """Return slopes of a cubic spline through evenly spaced values."""
    n, upper, right = len(v), [], []
    for i in range(n):
        first, last = i == 0, i == n - 1
        below, on, above = (0, 1, 2) if first else (2, 1, 0) if last else (1, 4, 1)
        if first:
            r = -2.5*v[0] + 2.0*v[1] + 0.5*v[2]
        elif last:
            r = -0.5*v[i-2] - 2.0*v[i-1] + 2.5*v[i]
        else:
            r = 3.0*(v[i+1] - v[i-1])
        pivot = on - (0.0 if first else below*upper[-1])
        upper.append(above/pivot)
        right.append((r - (0.0 if first else below*right[-1]))/pivot)
    out = right[:]
    for i in range(n - 2, -1, -1):
        out[i] = right[i] - upper[i]*out[i+1]
    return out


def splines(nodes):
    c = <<columns>>
    rows = [list(nodes[k:k+c]) for k in range(0, len(nodes), c)]
    columns = [
        spline([row[j] for row in rows[:<<rows_short>>]])
        + spline([row[j] for row in rows[<<rows_short>>:]])
        for j in range(c)
    ]
    along_g = [list(row) for row in zip(*columns)]
    return rows, along_g, [spline(row) for row in rows], [spline(row) for row in along_g]


def hermite(t, a, b, c, d):
    return a + t*(c + t*(3.0*(b - a) - 2.0*c - d + t*(2.0*(a - b) + c + d)))


def table(part, g, alpha):
    v, g1, a1, m = part
    row = log(alpha)
    touch = <<touch>>
    x = log(g) - touch
    t = (<<short_float>>/(touch - (<<low_g>>)) if x < 0.0 else <<after>>)*x + <<short_float>>
    s = (row - (<<low_alpha>>))*<<per_alpha>>
    i, j = max(0, min(<<last>>, floor(t))), max(0, min(<<last_column>>, floor(s)))
    t, s, k = t - i, s - j, i + (i >= <<short>>)
    at = lambda u, w, k: hermite(s, u[k][j], u[k][j+1], w[k][j], w[k][j+1])
    return hermite(t, at(v, a1, k), at(v, a1, k + 1), at(g1, m, k), at(g1, m, k + 1))
<<each>>

<<NAME>>_SPLINES = splines(<<NAME>>_NODES)


def <<name>>(g, alpha):
    return table(<<NAME>>_SPLINES, g, alpha)
'''

_MATLAB = """
<<arrays>>
function d = spline_slopes(v)
  % slopes of cubic splines through the rows of v, which are evenly spaced
  n = size(v, 1);
  left = 4*eye(n) + diag(ones(n-1, 1), 1) + diag(ones(n-1, 1), -1);
  right = 3*diag(ones(n-1, 1), 1) - 3*diag(ones(n-1, 1), -1);
  left(1, :) = 0; left(1, 1:2) = [1 2]; right(1, :) = 0; right(1, 1:3) = [-2.5 2 0.5];
  left(n, :) = 0; left(n, n-1:n) = [2 1]; right(n, :) = 0; right(n, n-2:n) = [-0.5 -2 2.5];
  d = left \\ (right*v);
end

function part = splines(nodes)
  part.v = reshape(nodes, <<columns>>, []).';
  part.g = [spline_slopes(part.v(1:<<rows_short>>, :)); ...
            spline_slopes(part.v(<<rows_short>>+1:end, :))];
  part.a = spline_slopes(part.v.').';
  part.m = spline_slopes(part.g.').';
end

function f = hermite(t, a, b, c, d)
  f = a + t*(c + t*(3*(b - a) - 2*c - d + t*(2*(a - b) + c + d)));
end

function f = table_value(part, g, alpha)
  row = log(alpha);
  touch = <<touch>>;
  x = log(g) - touch;
  if x < 0
    t = <<short_float>>/(touch - (<<low_g>>))*x + <<short_float>>;
  else
    t = <<after>>*x + <<short_float>>;
  end
  s = (row - (<<low_alpha>>))*<<per_alpha>>;
  i = max(0, min(<<last>>, floor(t))); j = max(0, min(<<last_column>>, floor(s))) + 1;
  t = t - i; s = s - j + 1;
  k = i + (i >= <<short>>) + 1; n = k + 1;
  f = hermite(t, ...
    hermite(s, part.v(k, j), part.v(k, j+1), part.a(k, j), part.a(k, j+1)), ...
    hermite(s, part.v(n, j), part.v(n, j+1), part.a(n, j), part.a(n, j+1)), ...
    hermite(s, part.g(k, j), part.g(k, j+1), part.m(k, j), part.m(k, j+1)), ...
    hermite(s, part.g(n, j), part.g(n, j+1), part.m(n, j), part.m(n, j+1)));
end
<<each>>
function f = <<name>>(g, alpha)
  persistent part
  if isempty(part)
    part = splines(<<name>>_nodes());
  end
  f = table_value(part, g, alpha);
end
"""

_TEXT = {"c": _C, "javascript": _JAVASCRIPT, "python": _PYTHON, "matlab": _MATLAB}

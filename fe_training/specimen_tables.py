"""What the study of finite specimens says: J, A and B against the half height of a block."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from .comparison import fit_power, reached_from
from .markdown import markdown_table, plain
from .specimen import Result

__all__ = ["block_table", "evidence", "group", "interpolated", "size_table"]

#: delta/R_w between which the exponent of J is fitted: those of the paper's Fig. 2c.
_FITTED = (1.05, 16.0)
_TOLERANCES = (0.05, 0.01)
_SIDES = ("rollers", "free")
_QUANTITIES: dict[str, tuple[Callable[[Result], float], Callable[[Result], float]]] = {
    "J at delta": (lambda r: r.distance, lambda r: r.energy_release_rate),
    "A at g": (lambda r: r.energy_release_rate, lambda r: r.arc),
    "B at g": (lambda r: r.energy_release_rate, lambda r: r.normal_load),
}
_WANTED = (
    *(("J at delta", x) for x in (2.0, 5.0, 10.0)),
    *((kind, x) for kind in ("A at g", "B at g") for x in (0.02, 0.1, 0.3)),
)


def group(results: Sequence[Result], alpha: float) -> dict[tuple[str, float], list[Result]]:
    """Return the results of one alpha by side and half height, from the tip outwards."""
    found: dict[tuple[str, float], list[Result]] = {}
    for one in results:
        if one.case.alpha == alpha and np.isfinite(one.energy_release_rate):
            found.setdefault((one.case.side, one.case.half_height), []).append(one)
    for rows in found.values():
        rows.sort(key=lambda one: one.distance)
    return dict(sorted(found.items()))


def interpolated(rows: Sequence[Result], kind: str, at: float) -> float:
    """Return a quantity at a distance or a g [-], nan outside what was solved."""
    x_of, y_of = _QUANTITIES[kind]
    pairs = np.array(sorted((x_of(one), y_of(one)) for one in rows))
    if not pairs[0, 0] <= at <= pairs[-1, 0]:
        return float("nan")
    return float(np.exp(np.interp(np.log(at), *np.log(pairs.T))))


def evidence(results: Sequence[Result]) -> str:
    """Return in words how the cases ended, and the largest |J - 2 F_h|/J."""
    reached = [one for one in results if np.isfinite(one.energy_release_rate)]
    mismatch = np.array([one.force_mismatch for one in reached])
    case = reached[int(mismatch.argmax())].case
    size = "in the large body" if np.isinf(case.half_height) else f"at H = {case.half_height:g} R_w"
    return (
        f"{len(reached)} of {len(results)} cases were reached. The median of |J - 2 F_h|/J is "
        f"{np.median(mismatch):.1g}, 95 % are below {np.quantile(mismatch, 0.95):.1g}, and the "
        f"largest is {mismatch.max():.1g}, {size}, {case.side}, alpha = {case.alpha:g}."
    )


def size_table(results: Sequence[Result], alpha: float) -> str:
    """Return H/R_w from which the large body's values hold within 5 % and 1 %."""
    groups = group(results, alpha)
    large = groups["none", np.inf]
    lines = []
    for kind, x in _WANTED:
        limit = interpolated(large, kind, x)
        cells = [f"{kind} = {x:g}"]
        for side in _SIDES:
            pairs = [
                (height, interpolated(rows, kind, x))
                for (held, height), rows in groups.items()
                if held == side
            ]
            known = np.array([pair for pair in pairs if np.isfinite(pair[1])])
            for tolerance in _TOLERANCES:
                enough = len(known) > 1 and np.isfinite(limit)
                size = (
                    reached_from(known[:, 0], known[:, 1], limit, tolerance) if enough else np.nan
                )
                cells.append(_size(size, known))
        lines.append(cells)
    head = [f"{side}, {100 * t:g} %" for side in _SIDES for t in _TOLERANCES]
    return markdown_table(["quantity", *head], lines)


def _size(size: float, known: np.ndarray) -> str:
    if np.isnan(size):
        return "-"
    if np.isinf(size):
        return f"above {known[-1, 0]:g}"
    return plain(size) if size > known[0, 0] else f"up from {size:g}"


def block_table(results: Sequence[Result], alphas: Sequence[float]) -> str:
    """Return, for each block, power laws of J by two definitions of delta, and A and B.

    The distance is that of the deformed tip, or of the tip before deformation.
    """
    lines = []
    for alpha in alphas:
        for (side, height), rows in group(results, alpha).items():
            low, high = _FITTED
            inside = [one for one in rows if low < one.distance < high]
            if len(inside) < 3:
                continue
            J = [one.energy_release_rate for one in inside]
            delta, depth = [one.distance for one in inside], [one.case.depth for one in inside]
            deformed, reference = fit_power(delta, J), fit_power(depth, J)
            A, B = ([getattr(one, name) for one in rows] for name in ("arc", "normal_load"))
            lines.append(
                [
                    f"{alpha:g}",
                    "-" if np.isinf(height) else f"{height:g}",
                    "large body" if np.isinf(height) else side,
                    f"{min(delta):.2f} to {max(delta):.1f}",
                    f"{deformed.exponent:.2f}",
                    f"{deformed.r_squared:.3f}",
                    f"{reference.exponent:.2f}",
                    f"{min(A):.2f} to {max(A):.2f}",
                    f"{min(B):.2f} to {max(B):.2f}",
                ]
            )
    head = ["alpha", "H/R_w", "side", "delta/R_w", "n of J(delta)", "r^2", "n by reference"]
    return markdown_table([*head, "A", "B"], lines)

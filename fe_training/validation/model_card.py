"""The model card: what the fitted models are, where they hold and how far they may be off."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from fe_training.markdown import markdown_table
from fe_training.validation.model_errors import FORCE, MODELS, RATIOS, SHORT, XIS, Errors
from surrogate.contact.coordinates import SLIP_QUANTITIES
from surrogate.contact.shipped import Fitted

if TYPE_CHECKING:
    from fe_training.validation.model_errors import Validation

__all__ = ["model_card"]

_SYMBOLS = {
    "arc": "A",
    "normal_load": "B",
    "distance": "delta",
    "slip_arc": "A*",
    "slip_load": "B*",
    FORCE: "F_ss",
}

#: Goals: F_ss of the formula, F_ss of table and process, table against process.
_FORMULA_GOAL, _FORCE_GOAL, _TABLE_GOAL = 0.05, 5e-3, 1e-4
_SLIP_GOAL = 5e-3  # of A* and B*, where the tip does not touch
_ONE_GOAL, _TWO_GOAL, _POINTS_GOAL = (0.60, 0.76), (0.92, 0.98), 60


def model_card(fitted: Fitted, found: Validation) -> str:
    """Return the card as Markdown; every number in it is computed.

    Parameters
    ----------
    fitted : Fitted
        The models.
    found : Validation
        Their errors.

    Returns
    -------
    str
    """
    parts = [
        "# Model card of the fitted models",
        "Written by `regen-surrogate`; not to be edited.",
        *_origin(fitted),
        "## Goals",
        _goals(fitted, found),
        "## The finite elements' own error bars",
        "Relative differences between the meshes, and of B also what the finite body takes away.",
        _bars(found),
        *_samples(found),
        "## The force by tau_w/(mu xi) and xi",
        "Largest relative error of F_ss"
        + _sample_name(found)
        + ". Infinity is wear alone, without "
        "cleavage; with xi = 0 and a finite ratio the force is Gamma_o, which no model gets wrong.",
        *(f"{model}:\n\n{_strengths(found.strengths[model])}" for model in MODELS),
        "## Standard deviations of `gp`",
        "Share of points within one and two standard deviations, with what the values themselves "
        "scatter by; a normal distribution has 68 % and 95 %.",
        _calibration(found),
        "## What `auto` promises",
        "Its bounds come from the campaign alone, from points left out. Forces"
        + _sample_name(found)
        + ", over all ratios and xi.",
        _promises(found),
        "## Above the highest g",
        *_beyond(found),
        "## The formula",
        *_formula(fitted),
        "## Eq. (9) alpha by alpha",
        "2 B = c g^n by least squares of its logarithm, and n with c = 1 as Eq. (9) has it.",
        _eq9(fitted),
        "## Where the tip touches the wire",
        *_touch(fitted),
    ]
    return "\n\n".join(parts) + "\n"


def _origin(fitted: Fitted) -> Iterable[str]:
    about = fitted.about.get("provenance", {})
    if about:
        yield (
            f"Fitted to {about['points']} of {about['points_wanted']} points of the campaign with "
            f"the design {about['design_hash']}, data of {about['data_date']}."
        )
    if about.get("single_mesh"):
        yield (
            "**For trying out only:** points that one mesh alone has reached were taken as well, "
            "with error bars that nobody measured."
        )
    yield f"Domain: {fitted.limits}."


def _goals(fitted: Fitted, found: Validation) -> str:
    tables, sample = (
        (found.off_grid, "off the grid")
        if found.off_grid
        else (
            found.alpha_out,
            "left out with their alpha; no points off the grid yet",
        )
    )
    constants = sum(len(fitted.constants[name]) for name in ("arc", "normal_load"))

    def worst(model: str) -> float:
        return float(tables[model]["whole domain"][FORCE].largest)

    rows = [
        _goal(f"F_ss of `power-law`, {constants} constants", worst("power-law"), _FORMULA_GOAL),
        _goal("F_ss of `table`", worst("table"), _FORCE_GOAL),
        _goal("F_ss of `gp`", worst("gp"), _FORCE_GOAL),
        _goal("`table` against `gp`", max(found.table_from_process.values()), _TABLE_GOAL),
    ]
    short = tables["table"][SHORT]
    rows += [
        _goal(f"{_SYMBOLS[name]} of `table`, {SHORT}", short[name].largest, _SLIP_GOAL)
        for name in SLIP_QUANTITIES
        if name in short
    ]
    shares = found.calibration.get("off the grid", {})
    for name in shares:
        for key, (low, high) in (("one", _ONE_GOAL), ("two", _TWO_GOAL)):
            share = shares[name][key]
            goal = f"{100 * low:.0f} to {100 * high:.0f} %"
            met = "yes" if low <= share <= high else "no"
            what = f"{_SYMBOLS[name]} within {key} standard deviation{'s' if key == 'two' else ''}"
            rows.append((what, f"{100 * share:.0f} %", goal, met))
    count = tables["gp"]["whole domain"]["arc"].count if found.off_grid else 0
    rows.append(
        (
            "points off the grid",
            f"{count}",
            f"{_POINTS_GOAL}",
            "yes" if count >= _POINTS_GOAL else "no",
        )
    )
    beyond = sum(line["beyond"] for line in found.promises)
    rows.append(("forces of `auto` beyond rtol", f"{beyond}", "0", "no" if beyond else "yes"))
    return f"Errors of points {sample}.\n\n" + markdown_table(
        ("what", "found", "goal", "met"), rows
    )


def _goal(what: str, value: float, goal: float) -> tuple[str, str, str, str]:
    return what, _percent(value), f"{100 * goal:g} %", "yes" if value <= goal else "no"


def _bars(found: Validation) -> str:
    rows = [
        (sample, *(_triple(bars.get(name)) for name in _SYMBOLS))
        for sample, bars in found.finite_elements.items()
    ]
    return markdown_table(("sample", *_headings()), rows)


def _samples(found: Validation) -> Iterable[str]:
    for title, note, tables in (
        ("Points off the grid", "Never used in fitting or choosing.", found.off_grid),
        (
            "Points left out one by one",
            "`gp` with its hyperparameters kept; `table` follows it. `eq13` has nothing fitted, "
            "and one point hardly changes the constants of `power-law`: errors of both are those "
            "of the shipped models.",
            found.one_out,
        ),
        (
            "Points left out with their alpha",
            "The first and the last alpha are then extrapolated to.",
            found.alpha_out,
        ),
    ):
        yield f"## {title}"
        if tables is None:
            yield "There are none yet: `regen-surrogate --off-grid` solves them."
            continue
        yield f"Largest, 95 % and median relative errors. {note}"
        rows = [
            (
                model,
                region,
                f"{errors['arc'].count}",
                *(_triple(errors.get(name)) for name in _SYMBOLS),
            )
            for model in MODELS
            for region, errors in tables[model].items()
        ]
        yield markdown_table(("model", "region", "points", *_headings()), rows)


def _headings() -> list[str]:
    return [f"{symbol} [%]" for symbol in _SYMBOLS.values()]


def _sample_name(found: Validation) -> str:
    return " off the grid" if found.off_grid else " of points left out with their alpha"


def _strengths(lines: Sequence[tuple[float, float, Errors]]) -> str:
    largest = {(ratio, xi): errors.largest for ratio, xi, errors in lines}
    rows = [(f"{r:g}", *(_percent(largest[r, xi]) for xi in XIS)) for r in RATIOS]
    return markdown_table(("tau_w/(mu xi)", *(f"xi = {xi:g}" for xi in XIS)), rows)


def _calibration(found: Validation) -> str:
    rows = [
        (
            sample,
            _SYMBOLS[name],
            f"{share['count']:.0f}",
            f"{100 * share['one']:.0f}",
            f"{100 * share['two']:.0f}",
        )
        for sample, shares in found.calibration.items()
        for name, share in shares.items()
    ]
    return markdown_table(("sample", "of", "points", "one [%]", "two [%]"), rows)


def _promises(found: Validation) -> str:
    head = (
        "rtol",
        "forces",
        "refused",
        *MODELS,
        "beyond rtol",
        "beyond it and error bar",
        "worst/rtol",
    )
    rows = [
        (
            f"{line['rtol']:g}",
            f"{line['forces']}",
            f"{line['refused']}",
            *(f"{line['used'][model]}" for model in MODELS),
            f"{line['beyond']}",
            f"{line['clearly']}",
            f"{line['worst']:.2f}",
        )
        for line in found.promises
    ]
    return markdown_table(head, rows)


def _beyond(found: Validation) -> Iterable[str]:
    yield (
        "There the models are continued: A stays, B, A* and B* go on as powers of g with the slope "
        "that they have at the end, delta goes to R_w."
    )
    if found.beyond is None:
        yield "No solution there says how far that is off; the error is unknown."
        return
    bounds = found.beyond.bounds
    yield (
        f"Largest relative errors, each with the solution's own error bar, at {found.beyond.count} "
        "solutions that no fit has seen; over g/(highest g) and alpha. `auto` with "
        "`extrapolate=True` states twice as much. Elsewhere the error is unknown."
    )
    names = [name for name in _SYMBOLS if name in bounds.errors["table"]]
    rows = [
        (
            model,
            f"{alpha[0]:g} to {alpha[1]:g}",
            f"up to {end:g}",
            *(_percent_or_unknown(errors[name][row, column]) for name in names),
        )
        for model, errors in bounds.errors.items()
        for column, alpha in enumerate(pairwise(bounds.alpha))
        for row, end in enumerate(bounds.g[1:])
        if any(np.isfinite(errors[name][row, column]) for name in names)
    ]
    head = ("model", "alpha", "g/(highest g)", *(_SYMBOLS[name] for name in names))
    yield markdown_table(head, rows)


def _percent_or_unknown(error: float) -> str:
    return _percent(error) if np.isfinite(error) else "unknown"


def _formula(fitted: Fitted) -> Iterable[str]:
    yield (
        "With y = 1 - 2/alpha and the wedge's A_w(g), B_w(g), delta_w(g) of "
        "`surrogate.contact.wedge`:\n\n"
        "    A = (2/k) sin[k A_w(g_A)/2] {1 - d exp[-ln^2(g/g_d)/2]}\n"
        "    g_A = g/[1 + (g/s)^2]^(1/2)\n"
        "    k^2 = 1 + a_1 (alpha^2 - 4),  ln s = a_2 + a_3 y,  d = a_4 (1 - y)\n"
        "    ln g_d = a_5 + a_6 y\n\n"
        "    B = B_w(g/(1 + g/e^b_1)) + b g^n\n"
        "    ln b = b_2 + b_3 y + b_4 y^2,  n = b_5 + b_6 y\n\n"
        "    delta/R_w = 1 + delta_w [1 - (g/g_touch)^c]^q  for g < g_touch, else 1\n"
        "    c = c_1 + c_2 y,  q = c_3 + c_4 y\n\n"
        "    A* = A_w(g/(1 + g/e^d_1)) + d g^n + [g >= g_touch] e^(d_7 + d_8 y) g^m\n"
        "    ln d = d_2 + d_3 y + d_4 y^2,  n = d_5 + d_6 y,  m = d_9 + d_10 y\n\n"
        "    B* = B_w(g/(1 + g/e^e_1)) + e g^n + [g >= g_touch] e^(e_7 + e_8 y) (g^m - g_touch^m)\n"
        "    ln e = e_2 + e_3 y + e_4 y^2,  n = e_5 + e_6 y,  m = e_9 + e_10 y"
    )
    letters = {
        "arc": "a",
        "normal_load": "b",
        "distance": "c",
        "slip_arc": "d",
        "slip_load": "e",
    }
    rows = [
        (f"{letters[name]}_{i}", f"{value:.4g}")
        for name, values in fitted.constants.items()
        for i, value in enumerate(values, start=1)
    ]
    yield markdown_table(("constant", "value"), rows)


def _eq9(fitted: Fitted) -> str:
    rows = [
        (
            f"{line['alpha']:g}",
            f"{line['n']:.3f}",
            f"{line['factor']:.3f}",
            f"{line['r2']:.4f}",
            f"{line['n_without_factor']:.3f}",
            f"{line['r2_without_factor']:.4f}",
            f"{line['lowest_g']:.3g} to {line['highest_g']:.3g}",
        )
        for line in fitted.about.get("eq9", ())
    ]
    return markdown_table(("alpha", "n", "c", "r^2", "n with c = 1", "its r^2", "g"), rows)


def _touch(fitted: Fitted) -> Iterable[str]:
    powers = " + ".join(
        f"({value:.4g}) ln^{i} alpha" if i else f"{value:.4g}"
        for i, value in enumerate(fitted.limits.touch)
    )
    yield f"ln g_touch = {powers}, with a standard error of {fitted.touch_error:.2g}."
    yield (
        "It is that of the finite-element tip, a notch of the radius that the design gives. The "
        "larger alpha is, the slower delta approaches R_w, and the more the touch depends on that "
        "radius; where delta has not met R_w at the highest g, the line goes on straight."
    )
    points: Mapping[str, Any] = fitted.about.get("touch_points", {})
    at = np.array(points.get("alpha", []))
    fit = np.exp(fitted.limits.log_touch(np.log(at))) if at.size else at
    rows = [
        (f"{alpha:g}", f"{g:.4g}", f"{100 * std:.2g} %", f"{curve:.4g}")
        for alpha, g, std, curve in zip(
            at, points.get("g", []), points.get("std_of_ln_g", []), fit, strict=True
        )
    ]
    yield markdown_table(("alpha", "g_touch found", "its standard error", "by the line"), rows)


def _triple(errors: Errors | None) -> str:
    if errors is None or not errors.count:
        return "-"
    return " / ".join(_number(100.0 * e) for e in (errors.largest, errors.most, errors.median))


def _percent(value: float) -> str:
    return f"{_number(100.0 * value)} %"


def _number(value: float) -> str:
    return f"{value:.2g}" if value < 99.5 else f"{value:.0f}"

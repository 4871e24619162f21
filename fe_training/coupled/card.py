"""What was fitted of kappa, in words and numbers, and its file."""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from fe_training.campaign.store import write_atomically
from fe_training.coupled.dataset import CoupledData
from fe_training.coupled.fit import ALPHA_EDGES, fit_amplification
from fe_training.coupled.reach import KNOWN, MOST_ERROR
from fe_training.coupled.rows import FitRows, rows_of
from surrogate.basics.files import checksum_line
from surrogate.coupling.amplification import LEAST_SHARE, Amplification
from surrogate.coupling.shipped import AMPLIFICATION_FILE, content_of_amplification

__all__ = ["CARD", "make_amplification", "most_wear"]

CARD = "coupled-card.md"


def make_amplification(data: CoupledData, touch: tuple[float, ...], out: Path) -> Amplification:
    """Fit kappa to a data set, and write its file, the checksum and the card into a folder.

    Parameters
    ----------
    data : CoupledData
        The rows.
    touch : tuple of float
        Coefficients of ln g_touch in powers of ln alpha.
    out : Path
        The folder.

    Raises
    ------
    InputError
        If there are too few rows.
    """
    rows = rows_of(data, touch)
    about = {"data": dict(data.attributes), "most_wear": most_wear(data)}
    kappa, process, told = fit_amplification(rows, touch, about)
    content = content_of_amplification(kappa)
    write_atomically(out / AMPLIFICATION_FILE, content)
    checksum = checksum_line(AMPLIFICATION_FILE, content)
    write_atomically(out / f"{AMPLIFICATION_FILE}.sha256", checksum)
    card = _card(data, rows, kappa, told, process.calibration, len(content))
    write_atomically(out / CARD, card.encode())
    return kappa


def most_wear(data: CoupledData) -> list[tuple[float, float, float]]:
    """Return ranges of alpha with the largest tau_w/mu of any equilibrium in them.

    Paths with the tip in contact and with tapered wear count as well. A range in which a path came
    to the end of its loads is left out: there wear has not been seen to end.
    """
    ends = data["alpha"].min(), *ALPHA_EDGES, data["alpha"].max()
    wanted, wear = data["target_wear"].max(), np.nan_to_num(data["wear"])
    ranges = []
    for low, high in itertools.pairwise(ends):
        most = wear[(data["alpha"] >= low) & (data["alpha"] <= high)].max(initial=0.0)
        if most < wanted:
            ranges.append((float(low), float(high), float(most)))
    return ranges


def _card(
    data: CoupledData,
    rows: FitRows,
    kappa: Amplification,
    told: Mapping[str, float],
    calibration: float,
    size: int,
) -> str:
    outcomes = Counter(str(name) for name in data["outcome"])
    lines = [
        "# Model card of kappa",
        "",
        "F_d = 2 mu R_w [(tau_w/mu) A* + xi B*] kappa(g, alpha, xi, tau_w/mu): how many times its",
        "first order the force of friction and wear is, as they act on the body. Written by",
        "`python -m fe_training.coupled --fit`.",
        "",
        "| outcome of the wanted loads | rows |",
        "|---|---|",
        *(f"| {name} | {count} |" for name, count in sorted(outcomes.items())),
        "",
        f"- Used: {len(rows)} equilibria of {len(np.unique(rows.base))} bases in which the tip "
        "does not touch the wire, the last ones before the ends of paths among them; "
        f"{int(rows.held_out.sum())} of them are of bases that no fit sees.",
        f"- File: {size / 1e3:.1f} kB, a polynomial of {len(kappa.polynomial.coefficients)} terms.",
        f"- It counts as known where the standard deviation of F_ss is at most {KNOWN:g}, up to",
        "  the loads that the nearest paths reached, as long as the bound of the error of F_ss",
        f"  is at most {MOST_ERROR:g}.",
        "",
        "| error at bases that no fit sees, within reach | |",
        "|---|---|",
        f"| rows | {told['held_out_within_reach']:.0f} |",
        f"| of F_ss, median | {_percent(told['force_error_median'])} (goal 0.3 %) |",
        f"| of F_ss, 95 % | {_percent(told['force_error_95'])} (goal 1 %) |",
        f"| of F_ss, largest | {_percent(told['force_error_largest'])} (goal 3 %) |",
        f"| within one standard deviation | {_percent(told['within_one_std'])} (goal 60 to 76 %) |",
        f"| within two | {_percent(told['within_two_std'])} (goal 92 to 98 %) |",
        "| the same of the fitted rows, their base left out | "
        f"{_percent(told['left_out_within_one_std'])}, "
        f"{_percent(told['left_out_within_two_std'])} |",
        f"| factor of the deviations that leaving bases out gave | {calibration:.2f} |",
        "",
        "Bounds of |ln kappa - that of finite elements| at the largest load that is known, by",
        "cell, rows x = ln(g/g_touch), columns alpha; in proportion to the load down to "
        f"{LEAST_SHARE:g} of it:",
        "",
        *_table(kappa, kappa.errors),
        "",
        "Largest |ln kappa|/(xi + ln(1 + tau_w/mu)/10), by which the law of slip is judged:",
        "",
        *_table(kappa, kappa.growth),
        "",
        "Reach: the largest load that is known, in units of xi = "
        f"{kappa.load_unit[0]:g} and tau_w/mu = {kappa.load_unit[1]:g}, for friction alone / both "
        "/ wear alone:",
        "",
        *_reach(kappa),
        "",
    ]
    return "\n".join(lines)


def _percent(value: float) -> str:
    return "not known" if np.isnan(value) else f"{100.0 * value:.3g} %"


def _table(kappa: Amplification, values: Any) -> list[str]:
    first, second = kappa.edges
    alphas = np.exp(second)
    head = [f"alpha {a:.3g} to {b:.3g}" for a, b in itertools.pairwise(alphas)]
    lines = ["| x | " + " | ".join(head) + " |", "|---" * (len(head) + 1) + "|"]
    for i, (a, b) in enumerate(itertools.pairwise(first)):
        cells = " | ".join(f"{value:.3g}" for value in values[i])
        lines.append(f"| {a:.2f} to {b:.2f} | {cells} |")
    return lines


def _reach(kappa: Amplification) -> list[str]:
    x, y, z = kappa.axes
    some = slice(None, None, 3)
    alphas = [f"alpha {np.exp(value):.2f}" for value in y[some]]
    lines = ["| x | " + " | ".join(alphas) + " |", "|---" * (len(alphas) + 1) + "|"]
    middle = len(z) // 2
    for i in range(0, len(x), 3):
        triples = (kappa.reach[i, j, [0, middle, -1]] for j in range(0, len(y), 3))
        cells = " | ".join(" / ".join(f"{value:.2g}" for value in row) for row in triples)
        lines.append(f"| {x[i]:.2f} | {cells} |")
    return lines

"""Every model along random dense lines: finite, without steps, ripples or wrong slopes."""

import sys
import time

import numpy as np

from surrogate.choosing.auto import available
from surrogate.contact.closed_forms import FORCE_MODELS
from surrogate.contact.coordinates import QUANTITIES
from surrogate.contact.shipped import shipped
from surrogate.errors import WirecutError

from .cells import attempt
from .part import Part

__all__ = ["lines"]

NODES = 2001
STEEP, STEEPER = 5.0, 1.0
"""Largest |d ln f/d ln(g or alpha)| of any function near g = 1, and how that grows with |ln g|: for
steps between nodes."""
DIGITS = 1e-10
"""Largest relative step across a seam, and from rounding between nodes."""


def models():
    """Return the models by name, and the fitted ones with their bounds where there are any."""
    try:
        return {**FORCE_MODELS, **shipped().models}, available()[1]
    except WirecutError:
        return dict(FORCE_MODELS), None


def lines(number=200, seed=0):
    """Follow random lines in (ln g, ln alpha) and the seams of every model."""
    part = Part("lines", "Every model along random dense lines and across its seams")
    start = time.monotonic()
    random = np.random.default_rng(seed)
    known, bounds = models()
    for name, model in known.items():
        for _ in range(number):
            _line(part, name, model, bounds, random)
        _far(part, name, model)
        _seams(part, name, model)
        _compiled(part, name, model)
    part.seconds = time.monotonic() - start
    return part


def _alphas(model):
    low, high = (2.0, 9.0) if model.name in FORCE_MODELS else model.limits.alpha
    return np.log(low), np.log(high)


def _evaluated(part, where, model, g, alpha):
    """Return A, B and delta, or None after a failure."""
    result, ended = attempt(
        lambda: dict(zip(QUANTITIES, model.contact(QUANTITIES, g, alpha), strict=True)), {}
    )
    if ended is not None:
        part.fail(model.name, ended[0], f"{where}: {ended[1]}")
        return None
    return {name: np.broadcast_to(values, np.shape(g)) for name, values in result.items()}


def _line(part, name, model, bounds, random):
    """Check one line: along g, along alpha or across both."""
    first, last = _alphas(model)
    kind = random.integers(3)
    middle, width = random.uniform(-30.0, 30.0), np.exp(random.uniform(-6.0, 4.0))
    ends = random.uniform(first, last, 2)
    log_g = middle + width * np.linspace(-0.5, 0.5, NODES) * (kind != 1)
    log_alpha = np.linspace(*ends, NODES) if kind else np.full(NODES, ends[0])
    g, alpha = np.exp(log_g), np.exp(log_alpha)
    where = f"g {g[0]:.6g} to {g[-1]:.6g}, alpha {alpha[0]:.6g} to {alpha[-1]:.6g}"
    found = _evaluated(part, where, model, g, alpha)
    if found is None:
        return
    step = np.hypot(np.diff(log_g), np.diff(log_alpha)).max()
    for function, values in found.items():
        if not np.all(np.isfinite(values)):
            part.fail(name, "not finite", f"{function} at {where}")
            continue
        with np.errstate(all="ignore"):
            jumps = np.abs(np.diff(np.log(values)))
        jump = np.nanmax(np.where(values[1:] == values[:-1], 0.0, jumps))
        steep = STEEP + STEEPER * np.abs(log_g).max() * (kind != 0)
        if jump > steep * step + DIGITS:
            part.fail(name, "step", f"{function} by {jump:.3g} at {where}, steps of {step:.3g}")
            continue
        part.count(name, "finite, no step")
        if kind == 0 and function != "arc":
            _monotone(part, name, function, values, bounds, g, alpha, where)


def _monotone(part, name, function, values, bounds, g, alpha, where):
    """B rises and delta falls with g; a ripple may not be larger than the stated error."""
    rising = values if function == "normal_load" else 1.0 / values
    if not np.all(rising > 0.0):  # B of limits that leave it out
        return
    ripple = np.max(1.0 - rising / np.maximum.accumulate(rising))
    stated = 0.0
    if bounds is not None and name in bounds.errors:
        at = bounds.at(name, function, g, alpha)
        stated = np.max(at[np.isfinite(at)], initial=0.0)
    if ripple > stated + DIGITS:
        part.fail(name, "ripple", f"{function} by {ripple:.3g}, stated {stated:.3g}, at {where}")
    else:
        part.count(name, "monotone" if ripple <= 1e-15 else "ripple within the stated error")


def _slopes(model, g, alpha):
    return *model.arc_slopes(g, alpha), *model.normal_load_slopes(g, alpha)


def _far(part, name, model):
    """Values and slopes from g = 1e-300 to 1e300 at both ends of alpha, and beyond."""
    g = np.concatenate([[5e-324, 1e-320], np.geomspace(1e-300, 1e300, 1201), [1.7e308]])
    first, last = np.exp(_alphas(model))
    inside = [first, 0.5 * (first + last), last]
    beyond = [] if name == "eq9" else [5e-324, 1e-300, 1.0, 1e20, 1e300]
    for alpha in (*inside, *beyond):
        where = f"alpha = {alpha:g}"
        found = _evaluated(part, where, model, g, alpha)
        if found is None:
            continue
        slopes, ended = attempt(_slopes, {"model": model, "g": g, "alpha": alpha})
        if ended is not None:
            part.fail(name, ended[0], f"slopes at {where}: {ended[1]}")
            continue
        for what, values in [*found.items(), *zip(("A'", "A,", "B'", "B,"), slopes, strict=True)]:
            values = np.broadcast_to(values, g.shape)
            wrong = np.isnan(values) | (np.isinf(values) & (g > 1e-300) & (g < 1e250))
            if np.any(wrong):
                part.fail(name, "not finite", f"{what} at {where}, g = {g[wrong][0]:.3g}")
            else:
                part.count(name, "finite from 1e-323 to 1e308")


def _seams(part, name, model):
    """Steps where the model is put together: at the touch, at the ends in g and in alpha."""
    alphas = np.exp(np.linspace(*_alphas(model), 9))
    touch = np.broadcast_to(model.touch(alphas), alphas.shape)
    seams = {"touch": touch}
    if name not in FORCE_MODELS:
        seams |= {
            "lowest g": np.full(9, model.limits.g[0]),
            "highest g": np.broadcast_to(model.highest_g(alphas), alphas.shape),
        }
    for seam, at in seams.items():
        for alpha, g in zip(alphas.tolist(), np.asarray(at).tolist(), strict=True):
            nearby = [g]
            for side in (0.0, np.inf):
                one = g
                for _ in range(40):
                    one = float(np.nextafter(one, side))
                    nearby.append(one)
            nearby += [g * (1.0 + s * 10.0**-k) for k in range(9, 16) for s in (-1, 1)]
            _seam(part, name, model, seam, sorted(nearby), alpha)


def _seam(part, name, model, seam, g, alpha):
    where = f"{seam}, g = {g[0]:.9g} to {g[-1]:.9g}, alpha = {alpha:.6g}"
    alone = []
    for one in g:
        found = {"names": QUANTITIES, "g": one, "alpha": alpha}
        result, ended = attempt(model.contact, found)
        slopes, wrong = attempt(_slopes, {"model": model, "g": one, "alpha": alpha})
        for end in (ended, wrong):
            if end is not None:
                part.fail(name, end[0], f"{seam}, g = {one!r}, alpha = {alpha!r}: {end[1]}")
                return
        if not np.all(np.isfinite(slopes)):
            part.fail(name, "not finite", f"slopes at {where}")
            return
        alone.append(result)
    columns = np.array(alone, dtype=float)
    steps = np.abs(np.diff(columns, axis=0)).max(axis=0) / columns[0].clip(1e-300)
    allowed = DIGITS + STEEP * np.max(np.diff(np.log(g)))
    if np.any(steps > allowed):
        part.fail(name, "step", f"{steps} at {where}")
    else:
        part.count(name, "no step across a seam")


def _compiled(part, name, model):
    """The table with and without numba."""
    if name != "table":
        return
    try:
        import numba  # noqa: F401 (which the table looks for)
    except ImportError:
        part.notes.append("numba is not installed: its path was not compared")
        return
    random = np.random.default_rng(3)
    g = np.exp(random.uniform(np.log(model.limits.g[0]), np.log(model.limits.g[1]), 20_000))
    alpha = random.uniform(*model.limits.alpha, g.size)
    g = np.minimum(g, model.highest_g(alpha))
    compiled = _evaluated(part, "numba", model, g, alpha)
    loaded = sys.modules.pop("numba")
    try:
        plain = _evaluated(part, "without numba", model, g, alpha)
    finally:
        sys.modules["numba"] = loaded
    if compiled is None or plain is None:
        return
    apart = max(float(np.max(np.abs(compiled[n] / plain[n] - 1.0))) for n in QUANTITIES)
    if apart > 1e-12:
        part.fail(name, "differs", f"numba by {apart:.3g}")
    else:
        part.count(name, "with numba as without")
        part.notes.append(f"numba's path differs by {apart:.2g} at most, over {g.size} points")

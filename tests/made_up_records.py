"""Records of a testing machine, made up so that the steady force is known."""

import numpy as np


def coloured(rng, size, correlation):
    """Noise of unit variance, of which neighbours are correlated."""
    white = rng.normal(size=size)
    noise = np.empty(size)
    noise[0] = white[0]
    for i in range(1, size):
        noise[i] = correlation * noise[i - 1] + np.sqrt(1.0 - correlation**2) * white[i]
    return noise


def cut(
    level=0.08,
    peak=1.5,
    travel=0.03,
    samples=601,
    contact=0.0,
    rise=0.004,
    decay=0.0008,
    noise=0.01,
    correlation=0.0,
    slip=0.0,
    period=0.001,
    drift=0.0,
    offset=0.0,
    exit_at=None,
    seed=0,
):
    """Return displacement [m] and force [N] of a cut whose steady force is `level`.

    The force rises from contact along `rise` to `peak` times the level and decays along `decay`;
    `noise`, `slip` (peak to trough) and `drift` (along the whole travel) are parts of the level.
    """
    rng = np.random.default_rng(seed)
    x = np.linspace(0.0, travel, samples)
    into = x - contact
    after = into - rise
    ramp = peak * np.sin(0.5 * np.pi * np.clip(into / rise, 0.0, 1.0))
    settled = 1.0 + (peak - 1.0) * np.exp(-np.clip(after, 0.0, None) / decay)
    relative = np.where(after < 0.0, ramp, settled)
    cutting = after >= 0.0
    relative = relative + cutting * slip * (0.5 - (after / period) % 1.0)
    relative = relative + cutting * drift * (x / travel - 0.5)
    if exit_at is not None:
        relative = np.where(x > exit_at, 0.0, relative)
    return x, offset + level * (relative + noise * coloured(rng, samples, correlation))


SOUND = {
    "a peak and white noise": {},
    "a slow decay": {"decay": 0.003},
    "no peak": {"peak": 1.0},
    "correlated noise": {"noise": 0.03, "correlation": 0.9},
    "strong noise": {"noise": 0.1},
    "stick-slip": {"slip": 0.2, "noise": 0.005, "samples": 3001},
    "coarse stick-slip": {"slip": 0.3, "period": 0.0021, "noise": 0.005, "samples": 3001},
    "free travel and offset": {"contact": 0.005, "offset": 0.02},
    "the wire leaves the sample": {"exit_at": 0.026},
    "few samples": {"samples": 100},
    "a drift of 3 %": {"drift": 0.03},
}
"""Records with a steady force, by what is difficult about them."""

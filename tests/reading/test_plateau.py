"""The steady force on made-up records: known answers, refusals with their reason, extremes."""

import numpy as np
import pytest
from made_up_records import SOUND, coloured, cut

from surrogate import InputError
from surrogate.reading.plateau import autocorrelation_time, steady_force

LEVEL = 0.08


@pytest.mark.parametrize("name", SOUND)
@pytest.mark.parametrize("seed", range(3))
def test_the_level_is_that_of_the_record(name, seed):
    """Within four standard errors, the tolerance and what a broken period of stick-slip leaves.

    A first quarter above the level by e lifts the mean by e/4 and is allowed to be half the
    tolerance above that mean, so that the mean is off by a sixth of the tolerance at most. A broken
    period of a sawtooth adds an eighth of its height times its share of the length.
    """
    made = SOUND[name]
    steady = steady_force(*cut(**made, seed=seed))
    bent = 0.05 / 6.0 * LEVEL
    broken = made.get("slip", 0.0) * made.get("period", 0.001) / 8.0 / (steady.end - steady.start)
    assert abs(steady.mean - LEVEL) < bent + broken * LEVEL + 4.0 * steady.standard_error
    assert (abs(steady.drift) > 0.05) == any("changes by" in each for each in steady.warnings)
    assert steady.end - steady.start > 0.2 * 0.03


def test_the_range_leaves_out_the_peak_and_the_exit():
    steady = steady_force(*cut(contact=0.005, exit_at=0.026))
    assert 0.009 < steady.start < 0.014
    assert 0.024 < steady.end <= 0.0262
    assert steady.peak == pytest.approx(1.5 * LEVEL, rel=0.03)
    assert steady.peak_displacement == pytest.approx(0.009, abs=4e-4)


def test_offset_and_tare_are_subtracted_and_reported():
    x, f = cut(contact=0.005, offset=0.02)
    plain = steady_force(x, f)
    assert plain.offset == pytest.approx(0.02, abs=5e-4)
    assert plain.mean == pytest.approx(LEVEL, rel=0.01)
    less = steady_force(x, f, tare=0.01)
    assert less.tare == 0.01
    assert less.mean == pytest.approx(plain.mean - 0.01, rel=0.01)
    assert not plain.warnings
    assert "begins in contact" in " ".join(steady_force(*cut()).warnings)


def test_a_slow_rise_from_the_first_sample_on_is_no_offset():
    for samples in (101, 601, 3001):
        assert abs(steady_force(*cut(samples=samples, noise=0.1)).offset) < 0.02 * LEVEL


def test_stick_slip_is_the_drop_and_noise_is_none():
    saw = steady_force(*cut(slip=0.2, noise=0.002, samples=3001))
    assert saw.stick_slip == pytest.approx(0.2 * LEVEL, rel=0.1)
    assert steady_force(*cut(noise=0.03)).stick_slip == 0.0


def test_start_and_end_take_the_range_as_it_is():
    x, f = cut(noise=0.0)
    inside = (x >= 0.01) & (x <= 0.02)
    steady = steady_force(x, f, start=0.01, end=0.02)
    assert (steady.start, steady.end, steady.samples) == (0.01, 0.02, inside.sum())
    assert steady.mean == pytest.approx(np.mean(f[inside]), rel=1e-12)
    assert steady_force(x, f, start=0.02).start == 0.02
    rising = steady_force(x, x, start=0.01, end=0.02)
    assert rising.drift == pytest.approx(0.01 / 0.015, rel=0.01)  # a sample is 0.5 %
    assert any("changes by +6" in sentence for sentence in rising.warnings)


def test_the_way_back_is_left_out():
    x, f = cut()
    back = steady_force(np.r_[x, x[::-1]], np.r_[f, 0.0 * f])
    assert back == steady_force(x, f)


def two_plateaus():
    x, f = cut(noise=0.005)
    return x, np.where(x > 0.018, 1.3 * f, f)


def rising(power):
    x = np.linspace(0.0, 0.03, 601)
    return x, 0.1 * (x / 0.03) ** power + 1e-4 * np.random.default_rng(0).normal(size=x.size)


def falling():
    x, f = cut(decay=0.03, peak=3.0)
    return x, f


def only_noise():
    return np.linspace(0.0, 0.03, 601), 1e-3 * np.random.default_rng(0).normal(size=601)


def waves():
    x = np.linspace(0.0, 0.03, 601)
    return x, 0.1 * np.clip(x / 0.001, 0.0, 1.0) * (1.2 + np.cos(np.pi * x / 0.01))


@pytest.mark.parametrize(
    ("record", "reason"),
    [
        (two_plateaus(), "two plateaus"),
        (rising(1.0), "still rises"),
        (rising(0.5), "still rises"),
        (rising(2.0), "still rises"),
        (cut(drift=0.15, peak=1.0, noise=0.003), "rises along the whole cut"),
        (falling(), "still falls"),
        (only_noise(), "no contact"),
        ((np.linspace(0.0, 0.03, 601), np.full(601, 0.05)), "no contact"),
        ((np.linspace(0.0, 0.03, 601), np.zeros(601)), "no contact"),
        (waves(), "no steady force"),
        (cut(samples=39), "39 samples where 40"),
        (cut(contact=0.029), "too few"),
        ((-np.linspace(0.0, 0.03, 601), cut()[1]), "turn the sign"),
        ((np.zeros(601), cut()[1]), "turn the sign"),
        ((np.zeros((2, 300)), np.zeros((2, 300))), "one number a sample"),
        (([0.0, 1.0], [1.0]), "one number a sample"),
        ((cut()[0], np.full(601, np.nan)), "force"),
        ((np.full(601, np.inf), cut()[1]), "displacement"),
    ],
)
def test_refused_with_the_reason(record, reason):
    with pytest.raises(InputError, match=reason):
        steady_force(*record)


@pytest.mark.parametrize(
    ("options", "reason"),
    [
        ({"start": 0.02, "end": 0.01}, "the range from 20 to 10 mm is empty"),
        ({"start": 0.01, "end": 0.0101}, "choose a range"),
        ({"start": 1.0, "end": 2.0}, "the record is from 0 to 30 mm"),
        ({"tare": np.nan}, "tare"),
        ({"tolerance": 0.0}, "tolerance"),
        ({"tolerance": 0.6}, "tolerance"),
    ],
)
def test_options_are_checked(options, reason):
    with pytest.raises(InputError, match=reason):
        steady_force(*cut(), **options)


@pytest.mark.parametrize("scale", [2.0**-80, 2.0**-30, 2.0**30, 2.0**80])
def test_units_do_not_matter(scale):
    x, f = cut(seed=3)
    one, other = steady_force(x, f), steady_force(x * scale, f * scale)
    assert other.mean == pytest.approx(one.mean * scale, rel=1e-9)
    assert other.samples == one.samples
    assert other.standard_error == pytest.approx(one.standard_error * scale, rel=1e-6)


@pytest.mark.parametrize("correlation", [0.0, 0.5, 0.9])
def test_the_standard_error_is_the_scatter_of_means(correlation):
    """The scatter of 200 means is known to 5 %; the estimate's mean must be within four of that,
    and it is low by the part of the window that is correlated, 2 tau/n, at most 4 % here."""
    rng = np.random.default_rng(0)
    means, errors = [], []
    for _ in range(200):
        noise = coloured(rng, 1000, correlation)
        means.append(np.mean(noise))
        errors.append(np.std(noise) * np.sqrt(autocorrelation_time(noise) / noise.size))
    assert np.mean(errors) == pytest.approx(np.std(means), rel=0.2 + 0.04)


def test_the_autocorrelation_time_is_that_of_the_process():
    """(1 + r)/(1 - r) for neighbours with correlation r; Sokal's error at n = 1e5 is 2 %."""
    noise = coloured(np.random.default_rng(0), 100_000, 0.9)
    assert autocorrelation_time(noise) == pytest.approx(19.0, rel=0.1)
    assert autocorrelation_time(np.ones(50)) == 1.0


def noisy(n=800, level=0.08, drift=0.0):
    """Return travel [m] and force [N] of a cut with free travel, noise and no peak."""
    x = np.linspace(0.0, 0.02, n)
    noise = 5e-4 * np.random.default_rng(7).normal(size=n)
    return x, level * np.clip((x - 0.005) / 0.002, 0.0, 1.0) + drift * x + noise


def test_a_load_cell_at_its_end_gives_no_force():
    x, f = noisy()
    with pytest.raises(InputError, match=r"% of the forces along the plateau are the largest"):
        steady_force(x, np.minimum(f, 0.07))
    with pytest.raises(InputError, match=r"0\.07 N, to the last digit"):
        steady_force(x, np.minimum(f, 0.07), start=0.01, end=0.02)
    # A clean record, and one in coarse steps, stand still without being cut off.
    assert steady_force(x, np.round(f, 2)).mean == pytest.approx(0.08, rel=0.02)
    clean = 0.08 * np.clip((x - 0.005) / 0.002, 0.0, 1.0)
    assert steady_force(x, clean).mean == pytest.approx(0.08, rel=1e-9)


def test_a_peak_that_is_cut_off_is_named():
    x, f = noisy()
    f += 0.1 * np.exp(-(((x - 0.008) / 5e-4) ** 2))
    steady = steady_force(x, np.minimum(f, 0.12))
    assert steady.mean == pytest.approx(0.08, rel=0.01)
    assert any("the peak is cut off by the range" in one for one in steady.warnings)
    assert not any("cut off" in one for one in steady_force(x, f).warnings)


def test_a_few_forces_far_off_do_not_move_the_mean_in_silence():
    x, f = noisy()
    glitches = f.copy()
    glitches[400::120] = 2.0
    with pytest.raises(InputError, match=r"4 of \d+ forces are far off the others \(first 2 N"):
        steady_force(x, glitches, start=0.009, end=0.02)
    one = f.copy()
    one[600] = 50.0
    with pytest.raises(InputError, match=r"1 of \d+ forces are far off .* delete their lines"):
        steady_force(x, one)


@pytest.mark.parametrize(("drift", "said"), [(0.0, False), (0.4, True), (-0.4, True)])
def test_a_zero_that_drifts_before_contact_is_named(drift, said):
    x, f = noisy(4000, drift=drift)
    steady = steady_force(x, f)
    told = [one for one in steady.warnings if "force before contact changes by" in one]
    assert bool(told) == said
    if told:
        off = float(told[0].split("off by ")[1].removesuffix(" %")) / 100.0
        assert off == pytest.approx(steady.mean / 0.08 - 1.0, abs=0.02)

"""The steady force of a record: the level at which it runs after the cut has begun.

The standard error of the mean counts independent samples: their number is that of all over the
integrated autocorrelation time, summed up to the first lag beyond five such times (Sokal's window).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from surrogate.basics.checks import SMALLEST, Quantity, one_number
from surrogate.basics.records import Record
from surrogate.errors import InputError
from surrogate.reading.level import (
    FEWEST_CELLS,
    FEWEST_SAMPLES,
    Contact,
    cells_of,
    contact_of,
    cut_off,
    far_off,
    level_stretch,
    lone_forces,
    noise_of,
)

__all__ = ["SteadyForce", "steady_force"]

Array = NDArray[np.float64]

_LARGEST = 1e30  # no square of it leaves the range of a float
_DISPLACEMENT = Quantity(
    "displacement", "m", "give the travel of the wire in metres", -_LARGEST, _LARGEST
)
_FORCE = Quantity("force", "N", "give the force on the wire in newtons", -_LARGEST, _LARGEST)
_TARE = Quantity("tare", "N", "give a constant force in newtons", -_LARGEST, _LARGEST)
_START = Quantity("start", "m", "give a displacement in metres", -_LARGEST, _LARGEST)
_END = Quantity("end", "m", "give a displacement in metres", -_LARGEST, _LARGEST)
_TOLERANCE = Quantity("tolerance", "", "give a small fraction such as 0.05", SMALLEST, 0.5)

_FEWEST_INDEPENDENT = 5.0
_FEWEST_IN_RANGE = 10
_FAR_BEYOND = 5.0
"""Multiple of the usual force beyond which a single one is no peak."""
_FEWEST_FREE = 20
_MOST_CUT_OFF = 0.1
"""Part of a plateau that may stand at the end of the load cell's range."""
_MOVED = 0.01
"""By which part of it a few forces may move the mean of the others."""
_REMEDY = "; or choose the range yourself (--from and --to, start= and end= in Python)"


@dataclass(frozen=True, eq=False)
class SteadyForce(Record):
    """The steady force of one cut, and how it was taken.

    Parameters
    ----------
    mean : float
        Mean over the plateau, less offset and tare [N].
    std : float
        Standard deviation of the samples about it [N].
    standard_error : float
        Standard error of the mean and the offset, from the number of independent samples [N]. It is
        the error within this record; by how much cuts differ it does not tell.
    start, end : float
        Range of displacement [m].
    samples : int
        Samples in it.
    drift : float
        Change along the range of the line fitted to it, as a part of the mean [-].
    peak : float
        Largest force of the record, less offset and tare [N].
    peak_displacement : float
        Where that is [m].
    stick_slip : float
        Mean drop of force from a maximum to the next minimum [N]; 0 where none stands out from
        the noise.
    offset : float
        Mean force before contact, which was subtracted [N]; 0 where the record has no such part.
    tare : float
        The constant that was subtracted besides [N].
    warnings : tuple of str
        What to look at.

    Examples
    --------
    >>> x = np.linspace(0.0, 0.02, 401)
    >>> steady = steady_force(x, 0.08 * np.minimum(x / 1e-3, 1.0))
    >>> steady.samples, steady.stick_slip, steady.warnings
    (381, 0.0, ('the record begins in contact: no offset of the load cell is subtracted',))
    """

    mean: float
    std: float
    standard_error: float
    start: float
    end: float
    samples: int
    drift: float
    peak: float
    peak_displacement: float
    stick_slip: float
    offset: float
    tare: float
    warnings: tuple[str, ...] = ()


def steady_force(
    displacement: ArrayLike,
    force: ArrayLike,
    *,
    start: float | None = None,
    end: float | None = None,
    tare: float = 0.0,
    tolerance: float = 0.05,
) -> SteadyForce:
    """Return the steady force of a record: of its plateau after cutting has begun.

    The force before contact is subtracted where the record has ten samples of it. What comes after
    contact is divided into at most 120 cells of equal travel. The plateau is the longest stretch of
    them along which a fitted line changes by less than the tolerance, and of which no quarter is
    off the mean by more than half of it, and of that the half or more whose mean is best known.

    Parameters
    ----------
    displacement : array_like, shape (n,)
        Travel of the wire, increasing into the sample [m]. What follows its largest value, the way
        back, is left out.
    force : array_like, shape (n,)
        Force on the wire, cutting counted positive [N].
    start, end : float, optional
        Range to take instead of the plateau [m]; one of them alone leaves the other to the search.
    tare : float, default 0
        Constant force to subtract, such as buoyancy or the friction of the fixture [N].
    tolerance : float, default 0.05
        Change along the plateau that counts as none, as a part of the force, 0.5 at
        most [-].

    Returns
    -------
    SteadyForce
        The mean with its error, the range, and what else there is to know.

    Raises
    ------
    InputError
        If there is no plateau: the force never leaves its noise, rises or falls to the end, has two
        plateaus, or there are too few samples. The message says which.

    Examples
    --------
    >>> x = np.linspace(0.0, 0.02, 401)
    >>> f = 0.08 * (1.0 - np.exp(-x / 5e-4)) + 0.04 * (x / 2e-3) * np.exp(1.0 - x / 5e-4)
    >>> steady = steady_force(x, f)
    >>> print(f"{steady.mean:.4f} N up to {1e3 * steady.end:.1f} mm")
    0.0800 N up to 20.0 mm
    """
    travel, load = _stroke(displacement, force)
    first, last = _ends(start, end)
    constant = one_number(_TARE, tare)
    part = one_number(_TOLERANCE, tolerance)
    _refuse_lone(travel, load)
    contact = contact_of(load)
    net = load - (contact.offset + constant)
    if first is None or last is None:
        low, high = _plateau(travel, net, contact, part)
        first = low if first is None else first
        last = high if last is None else last
    inside = (travel >= first) & (travel <= last)
    if np.count_nonzero(inside) < _FEWEST_IN_RANGE:
        raise InputError(
            f"there are {np.count_nonzero(inside)} samples from {1e3 * first:.4g} to "
            f"{1e3 * last:.4g} mm, where the record is from {1e3 * travel[0]:.4g} to "
            f"{1e3 * travel[-1]:.4g} mm; choose a range with {_FEWEST_IN_RANGE} or more "
            "(a number without its unit is in metres)."
        )
    _refuse_cut_off(load, inside)
    _refuse_far_off(travel[inside], net[inside])
    return _summary(travel, net, inside, (first, last), contact, constant, part)


def _stroke(displacement: ArrayLike, force: ArrayLike) -> tuple[Array, Array]:
    """Return both as arrays up to the largest displacement."""
    travel = np.atleast_1d(_DISPLACEMENT.checked(displacement))
    load = np.atleast_1d(_FORCE.checked(force))
    if travel.ndim != 1 or travel.shape != load.shape:
        raise InputError(
            f"displacement and force must have one number a sample, but have the shapes "
            f"{travel.shape} and {load.shape}; give one column each."
        )
    if travel.size < FEWEST_SAMPLES:
        raise InputError(
            f"the record is too short: {travel.size} samples where {FEWEST_SAMPLES} are needed; "
            "record more points."
        )
    stop = int(np.argmax(travel)) + 1
    if stop < FEWEST_SAMPLES or not travel[stop - 1] > travel[0]:
        raise InputError(
            f"the displacement is largest at sample {stop} of {travel.size}: the wire moves into "
            "the sample over too few of them; turn the sign if it counts downwards."
        )
    return travel[:stop], load[:stop]


def _ends(start: float | None, end: float | None) -> tuple[float | None, float | None]:
    first = None if start is None else one_number(_START, start)
    last = None if end is None else one_number(_END, end)
    if first is not None and last is not None and not first < last:
        raise InputError(
            f"the range from {1e3 * first:.4g} to {1e3 * last:.4g} mm is empty; give the smaller "
            "displacement first."
        )
    return first, last


def _plateau(travel: Array, net: Array, contact: Contact, tolerance: float) -> tuple[float, float]:
    """Return the ends of the plateau, or say why there is none and what can be done."""
    _refuse_without_contact(travel, net, contact, tolerance)
    after, force = travel[contact.index :], net[contact.index :]
    if force.size < 5 * FEWEST_CELLS or not np.max(after) > after[0]:
        raise InputError(f"there are {force.size} samples after contact, too few{_REMEDY}.")
    try:
        return level_stretch(cells_of(after, force), tolerance)
    except InputError as error:
        raise InputError(f"no steady force: {error}{_lone(after, force)}{_REMEDY}.") from None


def _refuse_cut_off(load: Array, inside: NDArray[np.bool_]) -> None:
    """Refuse a plateau that is the end of the load cell's range."""
    part = float(np.mean(cut_off(load)[inside]))
    if part > _MOST_CUT_OFF:
        raise InputError(
            f"no steady force: {100.0 * part:.0f} % of the forces along the plateau are the "
            f"largest of the record, {float(np.max(load)):g} N, to the last digit, while others "
            "scatter: the load cell or its range is at its end; cut again with a larger one."
        )


def _refuse_far_off(travel: Array, net: Array) -> None:
    """Refuse a mean that a few forces move, which are none of the wire."""
    far = far_off(net)
    middle = float(np.median(net))
    if far.any() and abs(float(np.mean(net)) - middle) > _MOVED * abs(middle):
        raise InputError(f"no steady force: {_these(travel, net, far, middle)}.")


def _refuse_lone(travel: Array, load: Array) -> None:
    """Refuse single forces so large that contact and load would be told by them."""
    centred = load - float(np.median(load[: max(5, load.size // 100)]))
    lone = lone_forces(centred, _FAR_BEYOND)
    if lone.any():
        raise InputError(f"no steady force: {_these(travel, load, lone, float(np.median(load)))}.")


def _lone(travel: Array, net: Array) -> str:
    lone = lone_forces(net)
    if not 0 < np.count_nonzero(lone) <= 0.02 * net.size:
        return ""
    return f"; {_these(travel, net, lone, float(np.median(net)))}"


def _these(travel: Array, net: Array, which: NDArray[np.bool_], middle: float) -> str:
    first = int(np.argmax(which))
    return (
        f"{np.count_nonzero(which)} of {net.size} forces are far off the others (first "
        f"{net[first]:.4g} N at {1e3 * travel[first]:.4g} mm beside {middle:.4g} N); delete their "
        "lines if they are none of the wire"
    )


def _refuse_without_contact(travel: Array, net: Array, contact: Contact, tolerance: float) -> None:
    whole = cells_of(travel, net).force
    change = float(np.max(whole) - np.min(whole))
    noise = noise_of(net) / np.sqrt(net.size / whole.size)
    if change <= 8.0 * noise or change <= tolerance * abs(float(np.mean(whole))):
        raise InputError(
            "no contact is seen: the force stays at "
            f"{float(np.mean(net)) + contact.offset:.3g} N within its noise from the beginning on"
            f"{_REMEDY}."
        )


def _summary(
    travel: Array,
    net: Array,
    inside: NDArray[np.bool_],
    ends: tuple[float, float],
    contact: Contact,
    tare: float,
    tolerance: float,
) -> SteadyForce:
    x, f = travel[inside], net[inside]
    mean, std = float(np.mean(f)), float(np.std(f, ddof=1))
    correlated = autocorrelation_time(f)
    peak = int(np.argmax(net))
    drift = _drift(x, f, mean)
    return SteadyForce(
        mean=mean,
        std=std,
        standard_error=float(np.hypot(std * np.sqrt(correlated / f.size), contact.offset_error)),
        start=ends[0],
        end=ends[1],
        samples=int(f.size),
        drift=drift,
        peak=float(net[peak]),
        peak_displacement=float(travel[peak]),
        stick_slip=stick_slip(f, noise_of(f)),
        offset=contact.offset,
        tare=tare,
        warnings=(
            *_warnings(mean, drift, tolerance, f.size / correlated, contact),
            *_peak_cut_off(net),
            *_zero_drift(travel, net, contact, float(np.mean(x)), mean),
        ),
    )


def _drift(x: Array, f: Array, mean: float) -> float:
    """Return the change of the fitted line over the range, as a part of the mean."""
    width = float(x[-1] - x[0])
    if width <= 0.0 or mean == 0.0:
        return 0.0
    centred = (x - np.mean(x)) / width
    return float(np.dot(centred, f - mean) / np.dot(centred, centred)) / mean


def _warnings(
    mean: float, drift: float, tolerance: float, independent: float, contact: Contact
) -> list[str]:
    said = []
    if mean <= 0.0:
        said.append(f"the force is {mean:.3g} N, not positive: check sign, offset and tare")
    if abs(drift) > tolerance:
        said.append(f"the force changes by {100.0 * drift:+.2g} % along the range")
    if independent < _FEWEST_INDEPENDENT:
        said.append(
            f"the range holds {independent:.2g} independent samples, too few for its standard error"
        )
    if contact.offset_error == contact.offset == 0.0:
        said.append("the record begins in contact: no offset of the load cell is subtracted")
    return said


def _zero_drift(
    travel: Array, net: Array, contact: Contact, place: float, mean: float
) -> list[str]:
    """Doubt an offset that changes before contact, by what that would be up to the plateau."""
    free = slice(0, contact.index // 2)  # its second half may be the beginning of contact
    x, f = travel[free], net[free]
    if f.size < _FEWEST_FREE or not x[-1] > x[0] or mean <= 0.0:
        return []
    slope, level = np.polyfit(x - np.mean(x), f, 1)
    scatter = float(np.std(f - level - slope * (x - np.mean(x))))
    error = scatter / float(np.std(x) * np.sqrt(f.size))
    moved = float(slope) * (place - float(np.mean(x)))
    if abs(slope) <= 5.0 * error or abs(moved) <= 2.0 * _MOVED * mean:
        return []
    return [
        f"the force before contact changes by {1e-3 * slope:+.2g} N/mm: if the load cell goes on "
        f"so, the force is off by {100.0 * moved / mean:+.2g} %"
    ]


def _peak_cut_off(net: Array) -> list[str]:
    number = np.count_nonzero(cut_off(net))
    if not number:
        return []
    return [
        f"{number} forces are the largest of the record to the last digit: the peak is cut off by "
        "the range of the load cell"
    ]


def autocorrelation_time(values: Array) -> float:
    """Return how many neighbouring samples count as one, 1 or more.

    Examples
    --------
    >>> rng = np.random.default_rng(1)
    >>> bool(0.8 < autocorrelation_time(rng.normal(size=1000)) < 1.3)
    True
    """
    deviation = values - np.mean(values)
    largest = float(np.max(np.abs(values)))
    spread = float(np.max(np.abs(deviation)))
    if spread <= 1e-12 * largest:
        return 1.0
    size = 1 << int(2 * values.size - 1).bit_length()
    power = np.abs(np.fft.rfft(deviation / spread, size)) ** 2
    covariance = np.fft.irfft(power, size)[: values.size]
    times = 2.0 * np.cumsum(covariance / covariance[0]) - 1.0
    beyond = np.arange(values.size) >= 5.0 * times
    time = float(times[int(np.argmax(beyond))]) if beyond.any() else float(values.size)
    return min(max(time, 1.0), float(values.size))


def stick_slip(force: Array, noise: float) -> float:
    """Return the mean drop from a maximum to the next minimum, of drops above 8 times the noise.

    Examples
    --------
    >>> saw = np.tile(np.r_[np.linspace(0.9, 1.1, 20), 1.0], 8)
    >>> round(stick_slip(saw, 0.0), 3)
    0.2
    >>> stick_slip(np.ones(100), 0.0)
    0.0
    """
    least = max(8.0 * noise, 0.01 * abs(float(np.mean(force))), SMALLEST)
    drops: list[float] = []
    high = low = float(force[0])
    falling = False
    for value in force.tolist():
        if falling:
            low = min(low, value)
            if value - low >= least:
                drops.append(high - low)
                falling, high = False, value
        else:
            high = max(high, value)
            if high - value >= least:
                falling, low = True, value
    return float(np.mean(drops)) if drops else 0.0

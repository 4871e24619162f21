"""The force of one quantity v that varies, alpha being fixed: at most a logarithm and two cubics.

    F_ss/T = constant + v (slope + T(x)) + P(x),  x = start + sign ln v = ln(g/g_touch),

with cubic pieces T and P of the table, as far as the scene needs them. Under the law "coupled" one
of them is there, times kappa, whose logarithm is a polynomial of x.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from surrogate.contact.table import cubics
from surrogate.coupling.polynomial import horner, of_one_number
from surrogate.prepared.line import Line

__all__ = ["Straight"]

Array = NDArray[np.float64]

BLOCK = 2**13
"""Points at a time, whose rows of coefficients stay in the cache."""


@dataclass(frozen=True, eq=False)
class Straight:
    """A force of one quantity.

    Parameters
    ----------
    constant, slope : float
        The force without T and P.
    start, sign : float
        x of ln v.
    times, plain : Line or None
        T and P, on the same pieces.
    side : int
        -1 or 1 where the whole range is short of or past the touch, else 0.
    powers : tuple of float
        ln kappa in rising powers of x + offset; empty where kappa is 1.
    offset : float
        As above.

    Examples
    --------
    >>> force = Straight(1.0, 2.0, 0.0, 1.0, None, None)
    >>> force.number(3.0), force.of(np.array([3.0, 4.0]))
    (7.0, array([7., 9.]))
    """

    constant: float
    slope: float
    start: float
    sign: float
    times: Line | None
    plain: Line | None
    side: int = 0
    powers: tuple[float, ...] = ()
    offset: float = 0.0

    @property
    def number(self) -> Callable[[float], float]:
        """The force of a float."""
        if self.times is None and self.plain is None:
            return lambda value: self.constant + value * self.slope
        if self.powers:
            return self._amplified()
        if self.plain is None:
            return self._of_times()
        return self._of_times(self.plain) if self.times is not None else self._of_plain()

    def _of_times(self, plain: Line | None = None) -> Callable[[float], float]:
        line, start, sign, constant, slope = self._numbers
        rows, before, after, short, ln = line.rows, line.before, line.after, line.short, np.log
        others = plain.rows if plain is not None else None

        def force(value: float) -> float:
            x = start + sign * float(ln(value))
            t = (before if x < 0.0 else after) * x + short
            piece = int(t)
            t -= piece
            a, b, c, d = rows[piece]
            total = constant + value * (slope + (a + t * (b + t * (c + t * d))))
            if others is None:
                return total
            a, b, c, d = others[piece]
            return total + (a + t * (b + t * (c + t * d)))

        return force

    def _amplified(self) -> Callable[[float], float]:
        line, start, sign, constant, slope = self._numbers
        rows, before, after, short, ln = line.rows, line.before, line.after, line.short, np.log
        log_kappa, exp, times = of_one_number(self.powers), np.exp, self.times
        offset = self.offset

        def force(value: float) -> float:
            x = start + sign * float(ln(value))
            t = (before if x < 0.0 else after) * x + short
            piece = int(t)
            t -= piece
            a, b, c, d = rows[piece]
            drag = (a + t * (b + t * (c + t * d))) * float(exp(log_kappa(x + offset)))
            if times is None:
                return value * slope + constant + drag
            return value * (slope + drag) + constant

        return force

    def _of_plain(self) -> Callable[[float], float]:
        line, start, sign, constant, slope = self._numbers
        rows, before, after, short, ln = line.rows, line.before, line.after, line.short, np.log

        def force(value: float) -> float:
            x = start + sign * float(ln(value))
            t = (before if x < 0.0 else after) * x + short
            piece = int(t)
            t -= piece
            a, b, c, d = rows[piece]
            return constant + value * slope + (a + t * (b + t * (c + t * d)))

        return force

    @property
    def _numbers(self) -> tuple[Line, float, float, float, float]:
        line = self.times if self.times is not None else self.plain
        assert line is not None
        return line, self.start, self.sign, self.constant, self.slope

    def of(self, values: Any, out: Any = None) -> Any:
        """Return the forces of an array of float64 or float32, or put them into `out`.

        `out` may be any contiguous array of that size that shares no memory with the values, or
        the values themselves.
        """
        result = np.empty(values.shape) if out is None else out
        flat, target = np.ascontiguousarray(values).reshape(-1), result.reshape(-1)
        room = _Room(min(flat.size, BLOCK), self)
        with np.errstate(all="ignore"):
            for begin in range(0, flat.size, BLOCK):
                some = slice(begin, begin + BLOCK)
                self._block(flat[some], target[some], room)
        return result

    def _block(self, values: Any, target: Any, room: _Room) -> None:
        """Put the forces of some values into `target`, in the order of operations of `number`."""
        v = values.astype(float, copy=False)
        result, extra = room.result[: v.size], room.extra[: v.size]
        if self.times is None and self.plain is None:
            np.multiply(v, self.slope, out=result)
        else:
            of = self._place(v, room)
            if self.times is not None:
                of(self.times, result)
                if self.powers:
                    result *= room.kappa[: v.size]
                if self.slope:
                    result += self.slope
                result *= v
            else:
                np.multiply(v, self.slope, out=result)
        if self.plain is None:
            np.add(result, self.constant, out=target, casting="same_kind")
            return
        result += self.constant
        of(self.plain, extra)
        if self.powers:
            extra *= room.kappa[: v.size]
        np.add(result, extra, out=target, casting="same_kind")

    def _place(self, v: Array, room: _Room) -> Callable[[Line, Array], None]:
        """Return what puts the values of a line at these places into an array."""
        line, x = self._numbers[0], room.x[: v.size]
        np.log(v, out=x)
        start, sign = self.start, self.sign
        if self.powers or not room.compiled:
            (np.add if sign > 0.0 else np.subtract)(start, x, out=x)
            start, sign = 0.0, 1.0
        if self.powers:
            kappa = horner(self.powers, x + self.offset, room.kappa[: v.size])
            np.exp(kappa, out=kappa)
        if room.compiled:
            steps = line.before, line.after, line.short
            return lambda one, out: room.compiled(x, start, sign, *steps, one.pieces, out)
        piece, t = line.place(x, self.side)
        return lambda one, out: cubics(one.pieces, piece, t, out, room.taken[: t.size])


class _Room:
    """Memory of one call, and the compiled loops where numba is loaded."""

    def __init__(self, size: int, force: Straight) -> None:
        self.result, self.x, self.extra = np.empty(size), np.empty(size), np.empty(size)
        self.kappa = np.empty(size if force.powers else 0)
        lines = force.times is not None or force.plain is not None
        self.compiled: Any = None
        if lines and "numba" in sys.modules:
            from surrogate.contact.compiled import along_line

            self.compiled = along_line
        else:
            self.taken = np.empty((size, 4) if lines else (0, 4))

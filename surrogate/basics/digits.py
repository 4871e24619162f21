"""Numbers with as many digits as their errors leave."""

from __future__ import annotations

import math

from surrogate.basics.records import UNKNOWN, number

__all__ = ["below_digits", "rounded", "rounded_up"]


def rounded(value: float, error: float) -> str:
    """Return a number with as many digits as its error leaves, two of the error itself.

    Examples
    --------
    >>> rounded(1.14632, 0.34), rounded(12634.0, 420.0), rounded(1.14632, math.nan)
    ('1.15', '12630', '1.146')
    """
    if not math.isfinite(value):
        return "any" if value > 0.0 else UNKNOWN
    decimals = _decimals(error)
    if decimals is None:
        return number(value)
    if decimals <= 0:
        return f"{round(value, decimals) + 0.0:.0f}"  # no sign of nothing
    return f"{round(value, decimals) + 0.0:.{decimals}f}"


def below_digits(value: float, error: float) -> bool:
    """Return whether nothing but zeros is left of a number.

    Examples
    --------
    >>> below_digits(2.2e-6, 1.7), below_digits(0.35, 0.7)
    (True, False)
    """
    decimals = _decimals(error)
    return decimals is not None and abs(value) < 0.5 * 10.0**-decimals


def rounded_up(error: float) -> str:
    """Return a number in two digits that is not below the error.

    Examples
    --------
    >>> rounded_up(0.01234), rounded_up(0.02)
    ('0.013', '0.02')
    """
    text = f"{error:.1e}"
    return f"{float(text if float(text) >= error else f'{1.05 * error:.1e}'):g}"


def _decimals(error: float) -> int | None:
    """Return the decimal places that are left; None where the error says nothing."""
    if not math.isfinite(error) or not error > 0.0:
        return None
    decimals = 1 - math.floor(math.log10(error))
    return decimals if -6 <= decimals <= 6 else None

"""What an argument is given: numbers of every size, and things that are no numbers."""

import sys
from datetime import date
from decimal import Decimal
from fractions import Fraction

import numpy as np

__all__ = ["KINDS", "LONG", "NOT_NUMBERS", "NUMBERS", "SIZES", "kinds_of"]

LARGEST = sys.float_info.max

SIZES = {
    "0": 0.0,
    "-0": -0.0,
    "smallest subnormal": 5e-324,
    "smallest normal": sys.float_info.min,
    "1e-300": 1e-300,
    "1e-20": 1e-20,
    "1": 1.0,
    "1 less one rounding": np.nextafter(1.0, 0.0).item(),
    "2": 2.0,
    "9": 9.0,
    "1e20": 1e20,
    "1e300": 1e300,
    "largest": LARGEST,
}
"""Numbers that a quantity may have."""

NUMBERS = {
    **SIZES,
    "inf": np.inf,
    "-inf": -np.inf,
    "nan": np.nan,
    "-1": -1.0,
    "negative subnormal": -5e-324,
    "negative largest": -LARGEST,
}
"""Numbers of every size, most of which are refused somewhere."""


class _Unwilling:
    def __array__(self, *_, **__):
        raise RuntimeError("no array of this")

    def __repr__(self):
        raise RuntimeError("no text of this")


class _EndlessName(str):
    def __repr__(self):
        return "x" * 10**6


NOT_NUMBERS = {
    "True": True,
    "numpy bool": np.bool_(True),
    "None": None,
    "text": "1.0",
    "empty text": "",
    "text with zero byte": "a\0b",
    "long text": _EndlessName("x" * 10**5),
    "bytes": b"1.0",
    "complex": 1.0 + 0.0j,
    "object": object(),
    "unwilling object": _Unwilling(),
    "dict": {},
    "set": {1.0},
    "function": max,
    "class": float,
    "date": date(2024, 1, 1),
    "numpy date": np.datetime64("2024-01-01"),
    "integer of 400 digits": 10**400,
    "integer of 5000 digits": 10**5000,
    "masked array": np.ma.masked_array([3.0, 4.0], mask=[True, False]),
    "unmasked masked array": np.ma.masked_array([3.0, 4.0]),
    "masked": np.ma.masked,
    "object array": np.array([3.0, None], dtype=object),
    "array of text": np.array(["1.0"]),
    "array of bools": np.array([True, False]),
    "complex array": np.array([3.0 + 1.0j]),
    "structured array": np.zeros(2, dtype=[("a", float)]),
    "ragged list": [[3.0], [3.0, 4.0]],
    "list with None": [3.0, None],
    "list with nan": [3.0, np.nan],
    "list with -1": [3.0, -1.0],
    "longdouble beyond double": np.longdouble("1e4000"),
}
"""What no quantity takes; bool and text included, which Python would convert."""

UNDECIDED = {"Decimal": Decimal("3"), "Fraction": Fraction(3)}
"""Numbers that numpy reads as objects: refused."""

NOT_NUMBERS.update(UNDECIDED)


def kinds_of(value):
    """Return a number that every type can hold, in all types; the key says which."""
    return {
        "int": int(value) if float(value).is_integer() else value,
        "int64": np.int64(value) if float(value).is_integer() else np.float64(value),
        "float32": np.float32(value),
        "float16": np.float16(value),
        "longdouble": np.longdouble(value),
        "float64": np.float64(value),
        "0-d array": np.array(value),
    }


def arrays_of(value, length):
    """Return arrays in which every entry is that number; the key says of which kind."""
    full = np.full(length, value)
    read_only = full.copy()
    read_only.flags.writeable = False
    whole = float(value).is_integer()
    return {
        "array": full,
        "list": full.tolist(),
        "tuple": tuple(full.tolist()),
        "array of integers": full.astype(np.int64) if whole else full,
        "array of float32": full.astype(np.float32),
        "array of float16": full.astype(np.float16),
        "array of longdouble": full.astype(np.longdouble),
        "big-endian array": full.astype(">f8"),
        "little-endian array": full.astype("<f8"),
        "read-only array": read_only,
        "strided array": np.full(2 * length, value)[::2],
        "reversed array": full[::-1],
        "subclass of array": full.view(_Subclass),
        "unaligned array": _unaligned(full),
    }


class _Subclass(np.ndarray):
    pass


def _unaligned(values):
    place = np.zeros(values.nbytes + 1, dtype=np.uint8)[1:]
    there = place.view(values.dtype)
    there[...] = values
    return there


KINDS = tuple(kinds_of(1.0)), tuple(arrays_of(1.0, 2))
LONG = 2**20 + 3
"""Length of a very long array: more than is evaluated at once."""

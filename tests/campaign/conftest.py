"""What the tests of this room share with others."""

from designs import driver, row_bytes, small, small_file

__all__ = ["driver", "row_bytes", "small", "small_file"]

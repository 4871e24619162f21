"""What the tests of this room share with others."""

from designs import driver, row_bytes, small, small_file
from fitted import fitted_file, installed, one_start

__all__ = ["driver", "fitted_file", "installed", "one_start", "row_bytes", "small", "small_file"]

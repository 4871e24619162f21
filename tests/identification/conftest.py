"""What the tests of this room share with others."""

from fitted import fitted_file, installed, one_start

__all__ = ["fitted_file", "installed", "one_start"]

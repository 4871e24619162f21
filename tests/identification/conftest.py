"""What the tests of this room share with others."""

from fitted import coupled, fitted_file, installed, made_up_kappa, one_start

__all__ = ["coupled", "fitted_file", "installed", "made_up_kappa", "one_start"]

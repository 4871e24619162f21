"""The fitted models of tests, and a made-up kappa beside them."""

from fitted import coupled, fitted_file, installed, made_up_kappa, one_start

__all__ = ["coupled", "fitted_file", "installed", "made_up_kappa", "one_start"]

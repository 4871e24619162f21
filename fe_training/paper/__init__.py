"""The comparison with arXiv:2412.02021."""

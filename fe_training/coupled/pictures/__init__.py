"""Pictures of the coupled solutions: the balance, kappa and the laws, ends of paths, the tip."""

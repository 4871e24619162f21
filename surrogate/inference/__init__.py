"""Forces, their scatter and what is known besides, and the misfit of a model to them."""

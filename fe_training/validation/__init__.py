"""How far the fitted models are from finite elements, and the model card."""

"""The contact between wire and solid: A, B and delta over (g, alpha), one module for each model."""

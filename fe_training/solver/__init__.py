"""From a configuration to its record: equilibria, paths, energy release rates."""

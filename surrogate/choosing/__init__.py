"""Which model answers: by its name, or the cheapest one that is exact enough."""

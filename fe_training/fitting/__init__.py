"""From the points of a data set to the fitted models."""

"""Many configurations, and the data set that is made of them."""

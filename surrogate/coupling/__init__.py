"""What friction and wear do to their own force: the factor of the law "coupled"."""

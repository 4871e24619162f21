"""Several gels beside each other: whether they differ, in one table and one figure."""

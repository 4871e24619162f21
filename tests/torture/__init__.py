"""How the library holds out at its extremes: `scripts/torture` runs all of it, the tests a part.

Each module is one kind of trouble, made by a function that returns a `Part` of the report.
"""

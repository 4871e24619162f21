"""A page for browsers that shows forces, parts and regimes as one moves their quantities."""

"""The engine's own studies."""

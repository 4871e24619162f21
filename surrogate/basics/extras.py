"""Optional packages: what to say where one is missing."""

from __future__ import annotations

from importlib.util import find_spec

from surrogate.errors import WirecutError

__all__ = ["require_extra"]


def require_extra(module: str, use: str, extra: str) -> None:
    """Refuse what needs a package that is not installed.

    Parameters
    ----------
    module : str
        Name by which the package is imported.
    use : str
        What needs it.
    extra : str
        The extra of this distribution that brings it.

    Raises
    ------
    WirecutError
        If there is no such module; the message says how to get it.

    Examples
    --------
    >>> require_extra("numpy", "an array", "plot")
    """
    if find_spec(module) is None:
        raise WirecutError(
            f"{use} needs {module}; install it with: pip install 'wirecut[{extra}]'."
        )

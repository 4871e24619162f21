"""Parameters belong to the law that they were identified under: what another makes of them."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import Any

import numpy as np

from surrogate.basics.digits import rounded_up
from surrogate.choosing.by_name import AUTO
from surrogate.choosing.laws import COUPLED
from surrogate.errors import OtherLawWarning
from surrogate.scene import Scene

__all__ = ["law_for", "warn_of_other_law"]


def law_for(scene: Scene, law: Any) -> Any:
    """Return the law to take: for "auto" that of the scene's parameters, if they are of a law.

    "auto" stays for parameters of the law "coupled", which cheaper laws may stand in for where they
    are known to be as exact.

    Examples
    --------
    >>> gel = Scene(685.0, 1.6, 1e-4, wear_strength=7750.0, law="projected")
    >>> law_for(gel, "auto"), law_for(gel, "slip"), law_for(Scene(685.0, 1.6, 1e-4), "auto")
    ('projected', 'slip', 'auto')
    """
    own = getattr(scene, "law", None)
    keeps = isinstance(law, str) and law == AUTO and own not in (None, COUPLED)
    return own if keeps else law


def warn_of_other_law(
    scene: Scene, law: Any, force: Any, own: Callable[[Scene], Any], depth: int = 3
) -> None:
    """Warn where a force is under another law than the scene's parameters were identified under.

    Parameters
    ----------
    scene : Scene
        The scene.
    law : str
        What was asked for, after `law_for`.
    force : CuttingForce
        Its force under that.
    own : callable
        Returns a scene's total under the law of its parameters [N/m].
    depth : int
        Whose line the warning names: 3 for that of the caller's caller.
    """
    if scene.law is None:
        return
    other = np.broadcast_to(np.not_equal(force.laws, scene.law), np.shape(force.total))
    if law == AUTO:  # what is known to be exact enough stands for the coupled law
        other = other & np.isnan(np.asarray(force.law_error, dtype=float))
    if not np.any(other):
        return
    with np.errstate(all="ignore"):
        moved = np.abs(np.divide(force.total, own(scene)) - 1.0)[other]
    if not np.any(moved > 0.0):
        return
    used = np.unique(np.broadcast_to(force.laws, other.shape)[other])
    warnings.warn(
        f"the toughness and wear strength were identified under the law {scene.law!r}, but the "
        f"force is taken under {' and '.join(map(repr, used.tolist()))}, which moves it by up to "
        f"{rounded_up(100.0 * float(np.nanmax(moved)))} %; give law={scene.law!r}, or identify "
        "again under the other law.",
        OtherLawWarning,
        stacklevel=depth,
    )

"""The file of kappa: read beside the file of fitted models that is in use."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import Any

import numpy as np

from surrogate.contact.archive import complete, content_of, file_in, read_fitted
from surrogate.contact.shipped import folder_in_use
from surrogate.coupling.amplification import Amplification
from surrogate.coupling.polynomial import Polynomial
from surrogate.errors import InputError

__all__ = [
    "AMPLIFICATION_FILE",
    "amplification",
    "amplification_if_any",
    "amplification_of",
    "content_of_amplification",
]

AMPLIFICATION_FILE = "coupled.npz"


def content_of_amplification(kappa: Amplification) -> bytes:
    """Return the content of the file of kappa."""
    about = {
        **kappa.about,
        "touch": list(kappa.touch),
        "largest": list(kappa.load_unit),
        "lowest": kappa.lowest,
        "highest": kappa.highest,
        "edges": [list(each) for each in kappa.edges],
    }
    arrays = {
        "powers": kappa.polynomial.powers.astype(np.uint8),
        "coefficients": kappa.polynomial.coefficients,
        "reach": kappa.reach,
        "errors": kappa.errors,
        "growth": kappa.growth,
        **{f"axis.{name}": axis for name, axis in zip("xyz", kappa.axes, strict=True)},
    }
    return content_of(about, arrays)


def amplification_of(about: Mapping[str, Any], arrays: Mapping[str, Any]) -> Amplification:
    """Return kappa from what a file says and holds.

    Raises
    ------
    InputError
        If something is missing or of the wrong shape.
    """
    with complete(AMPLIFICATION_FILE, "python -m fe_training.coupled --fit"):
        axes = tuple(arrays[f"axis.{name}"] for name in "xyz")
        first, second = (tuple(map(float, each)) for each in about["edges"])
        xi, wear = map(float, about["largest"])
        kappa = Amplification(
            tuple(map(float, about["touch"])),
            Polynomial(arrays["powers"].astype(np.int64), arrays["coefficients"]),
            axes,
            arrays["reach"],
            (xi, wear),
            (first, second),
            arrays["errors"],
            arrays["growth"],
            about,
            float(about["lowest"]),
            float(about["highest"]),
        )
        _require_shapes(kappa)
        return kappa


def _require_shapes(kappa: Amplification) -> None:
    nodes = tuple(len(axis) for axis in kappa.axes)
    cells = tuple(len(edges) - 1 for edges in kappa.edges)
    terms = len(kappa.polynomial.coefficients)
    if kappa.polynomial.powers.shape != (terms, 4):
        raise ValueError(f"powers of the shape {kappa.polynomial.powers.shape}")
    for name, shape in (("reach", nodes), ("errors", cells), ("growth", cells)):
        if getattr(kappa, name).shape != shape:
            raise ValueError(f"{name} of the shape {getattr(kappa, name).shape}")
    free = (kappa.polynomial.powers[:, 2:] == 0).all(axis=1)
    if free.any() or not (kappa.reach >= 0.0).all():
        raise ValueError("kappa that is not 1 without load")


def amplification() -> Amplification:
    """Return kappa of the models in use.

    Raises
    ------
    InputError
        If they have none, or its file is damaged.
    """
    return _in(folder_in_use())


def amplification_if_any() -> Amplification | None:
    """Return kappa of the models in use; None where they have none.

    Raises
    ------
    InputError
        If its file is damaged.
    """
    try:
        return amplification()
    except _MissingError:
        return None


class _MissingError(InputError):
    """The models in use come without kappa."""


@cache
def _in(folder: str) -> Amplification:
    remedy = "choose the law 'slip', or make it with python -m fe_training.coupled --fit"
    file = file_in(folder, AMPLIFICATION_FILE, "the law 'coupled'", remedy, _MissingError)
    return amplification_of(*read_fitted(file))

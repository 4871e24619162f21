"""Coupled solutions as scenes with their forces, by which laws and models are judged."""

from __future__ import annotations

import os
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fe_training.coupled.dataset import read_coupled
from surrogate.scene import NAMES, Scene

__all__ = ["JudgedRows", "judged_rows"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class JudgedRows:
    """The wanted loads that were reached, in units of mu = R_w = 1.

    Parameters
    ----------
    scene : Scene
        What is cut.
    force : ndarray, shape (rows,)
        F_ss, with the integrals of shear stress times slip between the zeros of the pressure.
    error_bar : ndarray, shape (rows,)
        How far that is from the sum over nodes, and from a finer mesh where that was solved [-].
    held_out : ndarray of bool, shape (rows,)
        Whether no fit saw the row.
    """

    scene: Scene
    force: Array
    error_bar: Array
    held_out: NDArray[np.bool_]

    def taken(self, some: Any) -> JudgedRows:
        """Return some of the rows."""
        values: list[Any] = [v if isinstance(v, float) else v[some] for v in self.scene.values()]
        columns = self.force, self.error_bar, self.held_out
        scene = replace(self.scene, **dict(zip(NAMES, values, strict=True)))
        return JudgedRows(scene, *(column[some] for column in columns))

    def __len__(self) -> int:
        return len(self.force)


def judged_rows(path: str | os.PathLike[str]) -> JudgedRows:
    """Return the rows of a file of coupled solutions that reached the friction and wear wanted.

    Parameters
    ----------
    path : path-like
        Where `write_coupled` wrote it.
    """
    data = read_coupled(path)
    rows = data.converged & (data["friction"] + data["wear"] > 0.0)
    g, alpha, xi, wear, arc, load = (
        data[name][rows]
        for name in ("target", "alpha", "friction", "wear", "first_arc", "first_load")
    )
    drag = 2.0 * (wear * arc + xi * load) * data.amplification[rows]
    force = g + drag
    summed = (data["steady_force"] - data["energy_release_rate"])[rows]
    meshes = np.nan_to_num(np.abs(data["mesh_error"][rows]))
    bar = (np.abs(summed - drag) + drag * meshes) / force
    return JudgedRows(Scene(1.0, g, 1.0, xi, wear, alpha), force, bar, data["held_out"][rows])

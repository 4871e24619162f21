"""A scene with ranges of its quantities, and what tests ask of prepared forces there."""

import subprocess
import sys
from dataclasses import dataclass

import numpy as np

from surrogate import Scene
from surrogate.scene import NAMES


@dataclass(frozen=True)
class Box:
    """The ends of all six quantities by name, and a scene for those that are fixed."""

    scene: Scene
    ends: dict[str, tuple[float, float]]

    def of(self, varying):
        """Return the ranges of some quantities."""
        return {name: self.ends[name] for name in varying}

    def points(self, varying, count=1000, seed=1):
        """Return values in the ranges, the ends among them."""
        random = np.random.default_rng(seed)
        values = [random.uniform(*self.ends[name], count) for name in varying]
        for value, name in zip(values, varying, strict=True):
            value[:2] = self.ends[name]
        return values

    def scene_of(self, varying, values, fixed=None):
        """Return scenes of some values, the others as they are fixed."""
        scene = dict(zip(NAMES, (fixed or self.scene).values(), strict=True))
        return Scene(**scene | dict(zip(varying, values, strict=True)))


def prints_alike(code):
    """Return whether a process of its own prints "alike" and nothing else."""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    return (done.stdout, done.stderr) == ("alike\n", "")

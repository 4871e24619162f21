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

    def inner_points(self, varying, count=60):
        """Return values not at the ends, where a number of 32 bits may be outside."""
        shares = np.random.default_rng(1).uniform(0.001, 0.999, (len(varying), count))
        ends = np.array([self.ends[name] for name in varying])
        return list(ends[:, :1] + (ends[:, 1:] - ends[:, :1]) * shares)

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


GEL = Box(
    Scene(685.0, 1.6, 0.25e-3, 0.1, 7750.0, 2.5),
    {
        "shear_modulus": (400.0, 2000.0),
        "toughness": (0.8, 3.0),
        "wire_radius": (1e-4, 1e-3),
        "friction_coefficient": (0.0, 0.3),
        "wear_strength": (100.0, 9000.0),
        "stiffening_exponent": (2.0, 4.0),
    },
)
TISSUE = Box(
    Scene(10e3, 5.0, 0.5e-3, 0.01, 1e3, 6.0),
    {
        "shear_modulus": (8e3, 20e3),
        "toughness": (3.0, 9.0),
        "wire_radius": (4e-4, 2e-3),
        "friction_coefficient": (0.0, 0.01),
        "wear_strength": (1.0, 5e2),
        "stiffening_exponent": (5.5, 7.0),
    },
)
"""Within what coupled solutions reach."""


def prints_alike(code):
    """Return whether a process of its own prints "alike" and nothing else."""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    return (done.stdout, done.stderr) == ("alike\n", "")

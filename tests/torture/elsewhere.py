"""Evaluates random points in a process of its own: ``python -m torture.elsewhere FOLDER NUMBER``.

A third argument names the folder of fitted models.
"""

import sys
from pathlib import Path

import numpy as np

from .cells import attempt
from .invariances import arguments_of, file_of, flat, tortured
from .models import install

if __name__ == "__main__":
    folder, number, *models = sys.argv[1:]
    if models and models[0]:
        install(Path(models[0]))
    for case in tortured():
        result, _ = attempt(case.call, arguments_of(case, int(number)))
        if result is not None:
            np.savez(Path(folder, file_of(case.label)), *flat(result))

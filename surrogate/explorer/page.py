"""The page in one file: its parts, the table as a program, and the numbers that both need."""

from __future__ import annotations

import json
from collections.abc import Mapping
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from surrogate.basics.checks import flag
from surrogate.basics.figures import COLOURS, FILLS
from surrogate.basics.files import file_name, written_whole
from surrogate.choosing.by_name import AUTO
from surrogate.choosing.candidates import OUTSIDE, candidates
from surrogate.choosing.laws import COUPLED, of_law
from surrogate.cutting.other_law import law_for
from surrogate.cutting.regimes import PARTS
from surrogate.errors import InputError
from surrogate.explorer.numbers import GEL, data_date, functions_of, page_numbers
from surrogate.prepared.dialects import DIALECTS
from surrogate.prepared.table_source import table_part
from surrogate.reading.measurements import Measurements
from surrogate.scene import Scene, require_scene
from surrogate.version import __version__

__all__ = ["explorer_page", "write_explorer"]

SCRIPTS = (
    *("physics", "words", "coupled", "auto", "plot", "map", "forces", "table", "controls", "cuts"),
    *("output", "main"),
)
"""The parts of the program, each using what stands before it; that of a law only if it is known."""


def write_explorer(
    file: str | PathLike[str],
    scene: Scene | None = None,
    cuts: Measurements | None = None,
    *,
    law: str = AUTO,
    diameters: bool = False,
) -> Path:
    """Write a page for browsers on which the quantities of a cut can be moved.

    One file, which opens from disk without a network: sliders for all six quantities, the map of
    what dominates with a point to drag, the force over the radius with its parts and by every
    law, the same in words, and how far the number may be off. It computes with the table of the
    models in use, and so with the numbers of ``cutting_force(scene, "table")``.

    Parameters
    ----------
    file : str or path-like
        Where to write, for instance "explorer.html"; an existing file is replaced.
    scene : Scene, optional
        What the page shows first, of single numbers in SI units; by default the paper's gel and a
        wire of 0.25 mm radius.
    cuts : Measurements, optional
        Own cuts, as `read_measurements` returns them, to be drawn over the curves.
    law : str, default "auto"
        The law of wear and friction that is shown first, as in `cutting_force`; with "auto" that of
        the scene's parameters, if they are of a law.
    diameters : bool, default False
        Whether to show diameters of wires instead of radii.

    Returns
    -------
    pathlib.Path
        The file, for instance for ``webbrowser.open(page.as_uri())``.

    Raises
    ------
    InputError
        If `scene` is no `Scene` of single numbers, `cuts` no `Measurements`, there is no such law
        or the models in use do not have it, `diameters` is not True or False, or the file cannot be
        written.

    Notes
    -----
    Range of validity: the page shows no force outside the domain of the table, nor one of the law
    "coupled" beyond the solutions with friction and wear, and says so. It has the laws that the
    models in use have.

    References
    ----------
    arXiv:2412.02021, Eq. (S2).

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     page = write_explorer(f"{folder}/explorer.html", Scene(685.0, 1.6, 0.2e-3))
    ...     page.name, page.read_text(encoding="utf-8")[:15]
    ('explorer.html', '<!doctype html>')
    """
    name = file_name(file)
    if not name:
        raise InputError("file must name a file, but is empty; give for instance 'explorer.html'.")
    content = explorer_page(scene, cuts, law=law, diameters=diameters).encode()
    with written_whole(name) as temporary:
        Path(temporary).write_bytes(content)
    return Path(name).absolute()


def explorer_page(
    scene: Scene | None = None,
    cuts: Measurements | None = None,
    *,
    law: str = AUTO,
    diameters: bool = False,
) -> str:
    """Return the page that `write_explorer` writes.

    Examples
    --------
    >>> len(explorer_page().encode()) < 400_000
    True
    """
    first = GEL if scene is None else _single(scene)
    if cuts is not None and not isinstance(cuts, Measurements):
        raise InputError(
            f"cuts must be Measurements, but is {type(cuts).__name__}; give what read_measurements "
            "returns."
        )
    of_law(AUTO, law, any_law=True)
    known = candidates()
    numbers = page_numbers(known, first, cuts, law_for(first, law), flag("diameters", diameters))
    parts = {
        "page.css": _part("page.css"),
        "plot.css": f"{_part('plot.css')}{_colours()}",
        "version": __version__,
        "data_date": data_date(known),
        "data": _json(numbers),
        "scripts": "\n".join([_program(known), *_scripts(numbers)]),
    }
    page = _part("page.html")
    for name, text in parts.items():
        page = page.replace(f"<<{name}>>", text)
    return page


def _single(scene: Scene) -> Scene:
    require_scene(scene)
    if any(np.ndim(value) for value in scene.values()):
        raise InputError(
            "scene must be of single numbers for its page, but has an array; give one wire in one "
            "material, which the page lets one change."
        )
    return scene


def _part(name: str) -> str:
    return Path(__file__).with_name("page").joinpath(name).read_text(encoding="utf-8")


def _scripts(numbers: Mapping[str, Any]) -> list[str]:
    """Return the parts of the program; that of the law "coupled" only where kappa is known."""
    known = (name for name in SCRIPTS if name != COUPLED or COUPLED in numbers)
    return [_part(f"{name}.js") for name in known]


def _json(numbers: Any) -> str:
    """Return JSON that no word in it can end the script that holds it."""
    return json.dumps(numbers, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c")


def _program(known: Any) -> str:
    """Return the numbers, and the table as the exported program that the page computes with."""
    names = functions_of(known)
    table = known.fitted.models[OUTSIDE]
    text = table_part(table, {name.upper(): name for name in names}, DIALECTS["javascript"])
    return (
        '"use strict";\n'
        'const DATA = JSON.parse(document.getElementById("data").textContent);\n'
        f"const TABLE = (() => {{\n{text}\nreturn {{{', '.join(names)}, byLogG, logTouch}};\n}})();"
    )


def _colours() -> str:
    """Return the colours that all figures of the library share."""
    fills = [f".fill-{part} {{ fill: {FILLS[part]}; }}" for part in PARTS]
    lines = [
        f".other-{i} {{ stroke: {colour}; }}\n"
        f".plot .name.other-{i} {{ stroke: none; fill: {colour}; }}"
        for i, colour in enumerate((COLOURS[1], COLOURS[3], COLOURS[2]))
    ]
    return "\n".join([*fills, *lines, ""])

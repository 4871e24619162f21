"""The rooms of both packages: what each may use, and that no import runs in a circle.

`surrogate`: basics, reading, scene and equations, contact, coupling, choosing, cutting, inference,
then identification and prepared side by side, then comparing and maps side by side, then explorer,
then cli: each uses only what stands before it. `fe_training`: mechanics, solver, sliding, campaign,
coupled, fitting, validation: each uses only what stands before it and `surrogate`; verification and
paper stand beside the last two and nothing uses them but the commands.
"""

import ast
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent

ROOMS = {
    "surrogate": (
        {"errors", "version"},
        {"basics"},
        {"reading"},
        {"scene", "equations"},
        {"contact"},
        {"coupling"},
        {"choosing"},
        {"cutting"},
        {"inference"},
        {"identification", "prepared"},
        {"comparing", "maps"},
        {"explorer"},
        {"cli"},
    ),
    "fe_training": (
        {"markdown", "figure_style"},
        {"mechanics"},
        {"solver"},
        {"sliding"},
        {"campaign"},
        {"coupled"},
        {"fitting"},
        {"validation"},
        {"verification", "paper"},
        {"__main__", "regenerate"},
    ),
}

MOST_MODULES, MOST_LINES = 15, 450


def files():
    return [path for package in ROOMS for path in sorted((ROOT / package).rglob("*.py"))]


def module_of(path):
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


MODULES = {module_of(path): path for path in files()}


def imports(path):
    """Yield every module of ours that a module names in an import, at its top or in a function."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name in MODULES)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path} imports by dots: write the whole name"
            for alias in node.names:
                full = f"{node.module}.{alias.name}"
                yield from {full if full in MODULES else node.module} & set(MODULES)


IMPORTS = {name: set(imports(path)) for name, path in MODULES.items()}


def room_of(module):
    package, _, rest = module.partition(".")
    return package, rest.partition(".")[0]


def floor(module):
    package, room = room_of(module)
    (number,) = [i for i, rooms in enumerate(ROOMS[package]) if room in rooms]
    return number


@pytest.mark.parametrize("module", [name for name in MODULES if "." in name])
def test_a_room_uses_only_what_stands_before_it(module):
    for used in IMPORTS[module]:
        if used == "surrogate":  # its public face, which the other package and the doctor use
            assert module == "surrogate.cli.doctor" or module.startswith("fe_training.")
        elif room_of(used)[0] == room_of(module)[0] and room_of(used) != room_of(module):
            assert floor(used) < floor(module), used
        else:
            assert not (module.startswith("surrogate.") and used.startswith("fe_training")), used


def test_no_import_runs_in_a_circle():
    faces = {name for name in ROOMS if name in IMPORTS}
    inside = {name: used - faces for name, used in IMPORTS.items() if name not in faces}
    try:
        TopologicalSorter(inside).prepare()
    except CycleError as error:
        pytest.fail(" -> ".join(error.args[1]))


def test_folders_and_modules_are_small_or_say_why_not():
    for folder in {path.parent for path in files()}:
        assert len(list(folder.glob("*.py"))) - 1 <= MOST_MODULES, folder
    for path in files():
        text = path.read_text(encoding="utf-8")
        title = ast.get_docstring(ast.parse(text)) or ""
        assert text.count("\n") <= MOST_LINES or "lines because" in " ".join(title.split()), path

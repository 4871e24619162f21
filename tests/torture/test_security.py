"""No input can run code: held by the syntax of every module, whatever calls it."""

import ast
from pathlib import Path

import numpy as np
import pytest

from surrogate.coupling.polynomial import Polynomial, of_one_number

ROOT = Path(__file__).resolve().parents[2]
PACKAGES = ("surrogate", "fe_training", "scripts")
FORBIDDEN_CALLS = {"eval", "exec", "compile", "__import__", "input"}
FORBIDDEN_ATTRIBUTES = {
    *(
        "os.system",
        "os.popen",
        "os.execv",
        "os.execve",
        "os.spawnl",
        "yaml.load",
        "tempfile.mktemp",
    ),
    *("subprocess.getoutput", "subprocess.getstatusoutput", "runpy.run_path", "tempfile.mktemp"),
    *("extractall", "np.fromfile", "np.memmap", "pd.read_pickle", "pandas.read_pickle"),
}
FORBIDDEN_MODULES = {
    "pickle",
    "cPickle",
    "dill",
    "cloudpickle",
    "shelve",
    "marshal",
    "yaml",
    "code",
}
ALLOWED_IMPORTS = {
    "surrogate/__init__.py": "its own submodules, by names in the code",
    "surrogate/basics/files.py": "the standard library's hashes, by names in the code",
}
"""Where `import_module` is called: never with what comes from outside."""

WRITTEN_OUT = {
    "surrogate/coupling/polynomial.py": "polynomials as programs of floats and names in the code"
}
"""Where `exec` and `eval` are called: never with what comes from outside."""

OWN_PYTHONS = {"scripts/torture-numpy": "environments that it has made itself"}
"""What runs other programs than constant ones."""


def modules():
    """Yield every module and script of the project."""
    for package in PACKAGES:
        for path in sorted((ROOT / package).rglob("*")):
            if path.suffix == ".py" or (package == "scripts" and path.is_file()):
                yield path


def called(node):
    """Return the dotted name of what a call calls."""
    return ast.unparse(node.func)


MODULES = [pytest.param(path, id=str(path.relative_to(ROOT))) for path in modules()]
every_module = pytest.mark.parametrize("path", MODULES)


def calls(path):
    tree = ast.parse(path.read_text(encoding="utf-8"))
    return [node for node in ast.walk(tree) if isinstance(node, ast.Call)]


@every_module
def test_nothing_is_evaluated_or_given_to_a_shell(path):
    for call in calls(path):
        name, where = called(call), f"{path.name}:{call.lineno}"
        written_out = name in ("exec", "eval") and path in {ROOT / own for own in WRITTEN_OUT}
        assert written_out or name not in FORBIDDEN_CALLS, where
        assert not any(name == bad or name.endswith(f".{bad}") for bad in FORBIDDEN_ATTRIBUTES), (
            where
        )
        for keyword in call.keywords:
            shell = keyword.arg == "shell"
            assert not shell or ast.unparse(keyword.value) == "False", where
        if name.rpartition(".")[2] == "import_module":
            assert str(path.relative_to(ROOT)) in ALLOWED_IMPORTS, where


@every_module
def test_nothing_is_pickled(path):
    tree = ast.parse(path.read_text(encoding="utf-8"))
    for node in ast.walk(tree):
        names = []
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            names = [node.module or ""]
        assert not {name.partition(".")[0] for name in names} & FORBIDDEN_MODULES, path
    for call in calls(path):
        name = called(call)
        if name in (
            "np.load",
            "numpy.load",
            "np.lib.format.write_array",
            "np.lib.format.read_array",
        ):
            given = {keyword.arg: ast.unparse(keyword.value) for keyword in call.keywords}
            assert given.get("allow_pickle") == "False", f"{path.name}:{call.lineno}: {name}"
        assert name not in ("joblib.load", "joblib.dump", "load_pickle"), path


@every_module
def test_programs_are_named_by_the_code(path):
    """What is run by `subprocess` is a list whose first entry is a constant or this Python."""
    for call in calls(path):
        own = str(path.relative_to(ROOT)) in OWN_PYTHONS if path.is_relative_to(ROOT) else False
        if called(call).partition(".")[0] != "subprocess" or own:
            continue
        command = call.args[0]
        if isinstance(command, ast.Name):
            command = _assigned(path, command.id)
        assert isinstance(command, ast.List), f"{path.name}:{call.lineno}"
        first = command.elts[0]
        constant = isinstance(first, ast.Constant) and isinstance(first.value, str)
        assert constant or ast.unparse(first) == "sys.executable", f"{path.name}:{call.lineno}"


def _assigned(path, name):
    """Return the list that a name is assigned in a module; lists that are used must be literal."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    found = [
        node.value
        for node in ast.walk(tree)
        if isinstance(node, ast.Assign)
        and any(isinstance(target, ast.Name) and target.id == name for target in node.targets)
    ]
    return found[0] if len(found) == 1 else None


def test_the_scan_sees_what_it_looks_for(tmp_path):
    bad = tmp_path / "bad.py"
    for line, check in (
        ("eval('1')", test_nothing_is_evaluated_or_given_to_a_shell),
        ("subprocess.run('ls', shell=True)", test_nothing_is_evaluated_or_given_to_a_shell),
        ("os.system('ls')", test_nothing_is_evaluated_or_given_to_a_shell),
        ("import pickle", test_nothing_is_pickled),
        ("np.load('x')", test_nothing_is_pickled),
        ("np.load('x', allow_pickle=True)", test_nothing_is_pickled),
        ("subprocess.run([name])", test_programs_are_named_by_the_code),
        ("subprocess.run(command)", test_programs_are_named_by_the_code),
    ):
        bad.write_text(line)
        with pytest.raises(AssertionError):
            check(bad)


@pytest.mark.parametrize("name", ["../pyproject.toml", "/etc/passwd", "a/b.csv", "..", "", "x\0y"])
def test_names_of_shipped_files_never_leave_their_folder(name):
    from surrogate.basics.files import model_file
    from surrogate.errors import InputError

    with pytest.raises(InputError, match="is shipped"):
        model_file(name)


def test_names_in_designs_never_leave_the_store(tmp_path):
    pytest.importorskip("joblib", reason="the extra 'train' is not installed")
    from fe_training.campaign.design_file import read_design
    from surrogate.basics.files import model_file
    from surrogate.errors import InputError

    text = model_file("campaign-quick.toml").read_text(encoding="utf-8")
    for level in ("../../escaped", "/escaped", "a/b", "..", "a\\b"):
        file = tmp_path / "design.toml"
        file.write_text(text.replace("[levels.coarse]", f"[levels.'{level}']"))
        try:
            design = read_design(file)
        except InputError:
            continue
        from fe_training.campaign.store import Store

        store = Store(tmp_path / "store")
        for one in design.configurations():
            assert store.path(one).resolve().parent == (tmp_path / "store" / "rows").resolve()


@pytest.mark.parametrize("outside", ["__import__('os').abort()", "1.0", b"1.0", None, [1.0]])
def test_a_polynomial_is_written_out_of_numbers_alone(outside):
    coefficients = np.array([outside, 2.0], object)
    with pytest.raises((TypeError, ValueError)):
        Polynomial(np.array([[0], [1]]), coefficients)(3.0)
    if outside not in ("1.0", b"1.0"):  # of which float makes a number
        with pytest.raises((TypeError, ValueError)):
            of_one_number([outside, 2.0])

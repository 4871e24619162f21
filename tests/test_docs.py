"""The documentation: its links lead somewhere, its examples run and print what it says."""

import ast
import doctest
import importlib
import re
import runpy
import shlex
from pathlib import Path

import pytest

import surrogate
from surrogate.choosing.by_name import AUTO, FITTED_NAMES
from surrogate.cli.main import main

ROOT = Path(__file__).resolve().parent.parent
PAGES = {path.name: path.read_text(encoding="utf-8") for path in sorted(ROOT.glob("docs/*.md"))}
FENCE = re.compile(r"^```(\S*)[^\n]*\n(.*?)^```$", flags=re.MULTILINE | re.DOTALL)
PROGRAMS = ("wirecut", "regen-surrogate", "python", "make", "pip")


def blocks(page, language):
    return [text for name, text in FENCE.findall(PAGES[page]) if name == language]


def without_code(page):
    return re.sub(r"`[^`\n]*`", "", FENCE.sub("", PAGES[page]))


def links(page):
    return re.findall(r"\]\(([^)\s]+)\)", without_code(page))


def anchors(text):
    headings = re.findall(r"^#+ (.*)$", FENCE.sub("", text), flags=re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", each.lower()).strip().replace(" ", "-") for each in headings}


def pictures():
    return runpy.run_path(str(ROOT / "scripts" / "gallery"))["PICTURES"]


def pages_with(language, mark=""):
    return [page for page in PAGES if any(mark in text for text in blocks(page, language))]


@pytest.mark.parametrize("page", PAGES)
def test_links_lead_somewhere(page):
    for link in links(page):
        if link.startswith("https://"):
            continue
        target, _, anchor = link.partition("#")
        if target.startswith("_gallery/"):  # made by scripts/gallery
            assert Path(target).stem in pictures(), link
            continue
        file = ROOT / "docs" / (target or page)
        assert file.is_file(), link
        if anchor:
            assert anchor in anchors(file.read_text(encoding="utf-8")), link


def test_every_page_stands_in_the_navigation_once():
    trees = re.findall(r"^```\{toctree\}\n(.*?)^```$", PAGES["index.md"], re.MULTILINE | re.DOTALL)
    listed = [
        line for tree in trees for line in tree.splitlines() if line and not line.startswith(":")
    ]
    pages = {path.stem for path in (ROOT / "docs").glob("*.md")} - {"index"}
    pages |= {path.stem for path in (ROOT / "docs").glob("*.ipynb")}
    assert sorted(listed) == sorted(pages)
    assert not any("{toctree}" in text for page, text in PAGES.items() if page != "index.md")


def test_users_pages_come_first_and_the_front_page_has_a_picture_and_three_doors():
    page = PAGES["index.md"]
    order = [page.index(f"\n{name}\n") for name in ("measure", "physics", "finite-element-engine")]
    assert order == sorted(order)
    assert page.index("![") < page.index("{grid}")
    assert re.findall(r"\{grid-item-card\} (.*)", page) == [
        "I have forces",
        "I want a force",
        "I want a map",
    ]
    for door in re.findall(r":link: (\w+)", page):
        assert (ROOT / "docs" / f"{door}.md").is_file()


@pytest.mark.parametrize("page", pages_with("python", ">>>"))
def test_examples_run_and_print_what_the_page_says(page, tmp_path, monkeypatch):
    matplotlib = pytest.importorskip("matplotlib")
    pytest.importorskip("pint")
    matplotlib.use("agg")
    monkeypatch.chdir(tmp_path)
    for text in blocks(page, "csv"):
        Path("cuts.csv").write_text(text)
    source = "".join(text for text in blocks(page, "python") if ">>>" in text)
    if "from fe_training" in source:
        pytest.importorskip("skfem")
    test = doctest.DocTestParser().get_doctest(source, {}, page, None, 0)
    report = []
    doctest.DocTestRunner(verbose=False).run(test, out=report.append)
    assert not report, "".join(report)
    importlib.import_module("matplotlib.pyplot").close("all")


@pytest.mark.parametrize("page", pages_with("python"))
def test_code_that_is_not_run_is_python_and_imports_what_there_is(page):
    for text in blocks(page, "python"):
        if ">>>" in text:
            continue
        for node in ast.walk(ast.parse(text)):
            ours = isinstance(node, ast.ImportFrom) and node.module.partition(".")[0]
            if ours == "surrogate" or ours == "fe_training":
                pytest.importorskip("skfem")
                module = importlib.import_module(node.module)
                assert all(hasattr(module, alias.name) for alias in node.names), text


@pytest.mark.parametrize("page", pages_with("console"))
def test_commands_print_what_the_page_says(page, capsys, tmp_path, monkeypatch):
    pytest.importorskip("matplotlib")
    monkeypatch.chdir(tmp_path)
    for text in blocks(page, "csv"):
        Path("cuts.csv").write_text(text)
    source = "".join(blocks(page, "console"))
    for command, expected in re.findall(r"^\$ wirecut (.*)\n((?:(?!\$).*\n)*)", source, re.M):
        assert main(shlex.split(command)) == 0
        printed = capsys.readouterr().out
        beginning, rest, _ = expected.partition("...\n")
        assert printed.startswith(beginning)
        assert rest or not expected or printed == expected


def shell_lines():
    for page in PAGES:
        for text in blocks(page, ""):
            for line in text.splitlines():
                words = shlex.split(line, comments=True)
                if words and words[0] in PROGRAMS:
                    yield page, words


@pytest.mark.parametrize(
    ("page", "words"), list(shell_lines()), ids=lambda x: x if isinstance(x, str) else x[0]
)
def test_commands_and_options_exist(page, words, capsys):
    program, options = words[0], [word for word in words if word.startswith("--")]
    if program == "make":
        assert re.search(rf"^{words[1]}:", (ROOT / "Makefile").read_text(), re.MULTILINE)
    elif program == "pip":
        extras = re.findall(r"\[(.*)\]", " ".join(words))
        stated = re.findall(r"^(\w+) = \[", (ROOT / "pyproject.toml").read_text(), re.MULTILINE)
        assert {one for each in extras for one in each.split(",")} <= set(stated)
    else:
        with pytest.raises(SystemExit):
            helper(words)
        shown = capsys.readouterr().out
        assert all(option in shown for option in options), (page, words)


def helper(words):
    if words[0] == "wirecut":
        main([words[1], "--help"] if len(words) > 1 else ["--help"])
    pytest.importorskip("skfem")
    if words[0] == "regen-surrogate":
        importlib.import_module("fe_training.regenerate").main(["--help"])
    if words[1:3] == ["-m", "fe_training.coupled"]:
        importlib.import_module("fe_training.coupled.__main__").main(["--help"])
    assert words[1:3] == ["-m", "fe_training"]
    importlib.import_module("fe_training.__main__").main([words[3], "--help"])


def test_the_pages_on_models_and_coordinates_name_what_there_is():
    table = re.findall(r"^\| `([\w-]+)` \|", PAGES["models.md"], flags=re.MULTILINE)
    assert set(table) == {*surrogate.FORCE_MODELS, *FITTED_NAMES, AUTO}
    from surrogate.maps.axes import coordinate

    rows = re.findall(r"^\| (`.*?) \| in m|^\| (`.*?) \|", PAGES["maps.md"], flags=re.MULTILINE)
    names = re.findall(r"`([^`]+)`", " ".join(a or b for a, b in rows))
    kinds = {"equal-terms", "limit", "dominance", "contact"}
    assert len(set(names) - kinds) > 8
    for name in set(names) - kinds:
        coordinate(name)


def test_the_gallery_shows_every_picture_with_its_code_and_its_number(tmp_path):
    pytest.importorskip("matplotlib")
    made = pictures()
    page = PAGES["gallery.md"]
    shown = set(re.findall(r"\(_gallery/([\w-]+)\.svg\)", page))
    assert shown == set(made)
    assert set(re.findall(r":pyobject: (\w+)", page)) == {each.__name__ for each in made.values()}
    numbers = {name: draw(tmp_path / f"{name}.svg") for name, draw in made.items()}
    assert all((tmp_path / f"{name}.svg").stat().st_size > 5000 for name in made)
    assert numbers["identification"] == pytest.approx(1.6)
    assert numbers["lengths-map"] == pytest.approx(1.1 / 4)
    # Eq. (12) lacks xi Gamma_o, a third of (1 + xi) Gamma_o where Gamma_o is all and xi is 1/2
    assert 0.32 < numbers["error-map"] < 1 / 3


def test_there_is_something_to_test():
    assert len(pages_with("python", ">>>")) >= 4
    assert len(pages_with("console")) >= 4
    assert len(list(shell_lines())) > 10

"""Sphinx configuration: `make docs`."""

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))

import imagesize  # noqa: E402
from docutils import nodes  # noqa: E402
from pygments.lexers.special import TextLexer  # noqa: E402

import surrogate  # noqa: E402

project = "wirecut"
author = "The wirecut developers"
copyright = author
release = version = surrogate.__version__

extensions = [
    "myst_nb",
    "sphinx_design",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.napoleon",
    "sphinx.ext.viewcode",
    "sphinxcontrib.katex",
]
exclude_patterns = ["_build"]
templates_path = []
default_role = "py:obj"

myst_enable_extensions = ["colon_fence", "deflist", "dollarmath"]
highlight_language = "text"  # commands without a language are no Python
nb_execution_mode = "off"  # what the notebook shows is held by the tests
myst_heading_anchors = 3

autodoc_member_order = "bysource"
autodoc_typehints = "none"  # the docstrings say it, with units
autosummary_generate = False
napoleon_google_docstring = False
napoleon_use_rtype = False
napoleon_use_ivar = True

# Formulas without a network: by the script in the package, which writes MathML that browsers draw.
html_math_renderer = "katex"
katex_options = "output: 'mathml'"
katex_css_path = "katex-math.css"

html_theme = "furo"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_extra_path = ["_gallery/explorer-app.html"]  # made by scripts/gallery
html_title = f"wirecut {release}"
html_copy_source = False
html_show_sphinx = False


SECTIONS = {
    "Regimes and maps": ("cutting.regimes", "cutting.transition_radius", "maps"),
    "Forces": ("scene", "cutting"),
    "From forces to the material": ("identification", "reading"),
    "The paper's equations": ("equations",),
}


def reference() -> str:
    """Return an entry for every public name, by the module that it comes from."""
    listed: dict[str, list[str]] = {title: [] for title in (*SECTIONS, "Models", "Errors")}
    for name in surrogate.__all__:
        value = getattr(surrogate, name)
        if not callable(value):
            continue
        module = value.__module__.removeprefix("surrogate.")
        title = next((t for t, rooms in SECTIONS.items() if module.startswith(rooms)), "Models")
        if isinstance(value, type) and issubclass(value, Exception):
            title = "Errors"
        kind = "autoclass" if isinstance(value, type) else "autofunction"
        members = "   :members:\n" if kind == "autoclass" else ""
        listed[title].append(f".. {kind}:: surrogate.{name}\n{members}")
    parts = [
        f"## {title}\n\n```{{eval-rst}}\n{''.join(entries)}```\n"
        for title, entries in listed.items()
        if entries
    ]
    return "\n".join(parts)


def add_reference(app: object, page: str, source: list[str]) -> None:
    """Add the entries to the reference page."""
    if page == "api":
        source[0] += "\n" + reference()


COLUMN = 1100  # pixels, more than a figure of one column has


def keep_columns(app: object, page: object) -> None:
    """Show figures of one column as wide as a column, not blown up to the width of the page."""
    for image in page.findall(nodes.image):  # type: ignore[attr-defined]
        file = ROOT / "docs" / image["uri"]
        if file.suffix == ".png" and 0 < imagesize.get(file)[0] < COLUMN:
            image["width"] = "28em"


def end_code(app: object, page: object) -> None:
    """Leave out the empty line that ends an example, which its test needs and nobody else."""
    for block in page.findall(nodes.literal_block):  # type: ignore[attr-defined]
        if block.rawsource == block.astext():  # else it is marked up already
            block.rawsource = block.rawsource.rstrip("\n")
            block.children = [nodes.Text(block.rawsource)]


def setup(app: object) -> None:
    """Ask Sphinx to call the functions above, and to print tables as they are."""
    app.connect("doctree-read", keep_columns)  # type: ignore[attr-defined]
    app.connect("doctree-read", end_code)  # type: ignore[attr-defined]
    app.add_lexer("csv", TextLexer)  # type: ignore[attr-defined]
    app.connect("source-read", add_reference)  # type: ignore[attr-defined]

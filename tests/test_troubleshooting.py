"""Every doubt that the code can print has an entry in the page, and every entry a doubt."""

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
PAGE = (ROOT / "docs" / "troubleshooting.md").read_text(encoding="utf-8")
ENTRIES = re.findall(r'^### "(.*)"$', PAGE, flags=re.MULTILINE)
ANY = "…"

SAYING = {
    "identification/doubts.py": ("yield",),
    "identification/open_questions.py": ("yield", "sentence"),
    "reading/plausibility.py": ("yield",),
    "reading/plateau.py": ("append", "raise"),
    "reading/level.py": ("raise", "return"),
    "reading/cuts.py": ("thickness",),
    "reading/records.py": ("append",),
    "reading/measurements.py": ("append",),
    "reading/wire_table.py": ("append",),
    "maps/belonging.py": ("raise",),
}
"""Modules that doubt, and by which statements."""
SKIPPED = re.compile(
    r"skipped$|is not read$|^(displacement|thickness) .*\(…\)$|^no steady force: …*$"
)
"""What of these is a part of a longer line, or about one cell with its place."""


def text_of(node):
    """Return the text of a string with … for what is computed; None of what is none."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return node.value
    if isinstance(node, ast.JoinedStr):
        return "".join(text_of(one) or ANY for one in node.values)
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
        return f"{text_of(node.left) or ANY}{text_of(node.right) or ANY}"
    return None


def said(path, kinds):
    tree = ast.parse((ROOT / "surrogate" / path).read_text(encoding="utf-8"))
    for node in ast.walk(tree):
        text = None
        kind = {ast.Yield: "yield", ast.Return: "return", ast.Assign: "sentence"}.get(type(node))
        if kind in kinds:
            text = text_of(node.value)
        elif isinstance(node, ast.Call):
            name = getattr(node.func, "attr", getattr(node.func, "id", ""))
            if (name == "append" and "append" in kinds) or (
                name == "InputError" and "raise" in kinds
            ):
                text = text_of(node.args[0])
        elif isinstance(node, ast.ListComp) and "thickness" in kinds:
            text = text_of(node.elt)
        if text and len(text.replace(ANY, "").split()) > 2:
            yield " ".join(text.split())


DOUBTS = sorted(
    {
        text
        for path, kinds in SAYING.items()
        for text in said(path, kinds)
        if not SKIPPED.search(text.rstrip("."))
    }
)


def fits(entry, text):
    """Whether an entry's words, with … for anything, are in a text with … for what is computed."""
    pieces = [re.escape(piece.strip()) for piece in entry.split(ANY) if piece.strip(" ")]
    return re.search(".*".join(pieces), text) is not None


def test_the_doubts_of_the_code_are_seen_here():
    assert len(DOUBTS) > 40
    assert any("is hardly that of a soft solid's cut" in text for text in DOUBTS)


@pytest.mark.parametrize("text", DOUBTS)
def test_every_doubt_has_an_entry(text):
    assert any(fits(entry, text) for entry in ENTRIES), text


@pytest.mark.parametrize("entry", ENTRIES)
def test_every_entry_is_a_doubt_of_the_code(entry):
    code = " ".join(
        " ".join(re.sub(r'"\s*\n\s*f?"', "", path.read_text(encoding="utf-8")).split())
        for path in (ROOT / "surrogate").rglob("*.py")
    )
    code = re.sub(r"\{[^{}]*\}", ANY, code)
    assert any(fits(entry, text) for text in DOUBTS) or fits(entry, code), entry


@pytest.mark.parametrize("entry", ENTRIES)
def test_every_entry_has_a_cause_and_a_cure(entry):
    body = PAGE.split(f'### "{entry}"\n', 1)[1].partition("\n#")[0]
    assert "*Cause:*" in body
    assert "*Cure:*" in body


def test_no_entry_stands_twice():
    assert len(ENTRIES) == len(set(ENTRIES))

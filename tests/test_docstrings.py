"""Every public name documents itself: one sentence, its parameters, a reference, an example."""

import inspect
import re

import pytest

import surrogate

PUBLIC = {
    name: value
    for name in surrogate.__all__
    if callable(value := getattr(surrogate, name)) and not inspect.isabstract(value)
}
ERRORS = {
    name
    for name, value in PUBLIC.items()
    if inspect.isclass(value) and issubclass(value, Exception)
}
DOCUMENTED = sorted(set(PUBLIC) - ERRORS)
FUNCTIONS = [name for name in DOCUMENTED if inspect.isfunction(PUBLIC[name])]
EQUATIONS = [
    name
    for name in FUNCTIONS
    if PUBLIC[name].__module__ in ("surrogate.equations", "surrogate.radii")
]


def sections(name):
    """Return the numpydoc sections of a public name, the summary under ''."""
    text = inspect.getdoc(PUBLIC[name]) or ""
    parts = re.split(r"^(\w[\w ]*)\n-{3,}\n", text, flags=re.MULTILINE)
    return {"": parts[0], **dict(zip(parts[1::2], parts[2::2], strict=True))}


def documented_parameters(name):
    """Return {parameter: its description} of a public name."""
    entries = re.findall(
        r"^(\w[\w, ]*?) : .*\n((?:[ \n].*\n?)*)",
        sections(name).get("Parameters", "") + "\n",
        re.MULTILINE,
    )
    return {one: text for names, text in entries for one in names.split(", ")}


@pytest.mark.parametrize("name", sorted(PUBLIC))
def test_the_summary_is_one_sentence(name):
    summary = sections(name)[""].partition("\n\n")[0]
    assert re.fullmatch(r"[A-Z][^\n]*[.]", summary.strip()), summary


@pytest.mark.parametrize("name", DOCUMENTED)
def test_documented_parameters_are_those_of_the_signature(name):
    assert list(documented_parameters(name)) == list(inspect.signature(PUBLIC[name]).parameters)


@pytest.mark.parametrize("name", DOCUMENTED)
def test_numbers_have_a_unit(name):
    for parameter, text in documented_parameters(name).items():
        entry = re.search(rf"\b{parameter}\b.* : (.*)", sections(name)["Parameters"])
        if re.match(r"(float|array_like|ndarray)", entry[1]):
            assert re.search(r"\[[^\]]+\]|nan", text), f"{name}({parameter}) has no [unit]"


@pytest.mark.parametrize("name", FUNCTIONS)
def test_functions_say_what_they_return_and_raise(name):
    assert {"Returns", "Raises"} <= set(sections(name))


@pytest.mark.parametrize("name", EQUATIONS)
def test_equations_have_number_range_and_reference(name):
    text = sections(name)
    assert re.search(r"Eq\. \(\d+\)|Table 1", " ".join(text.values()))
    assert "Range of validity" in text.get("Notes", "") or name == "power_law_exponent"
    assert "arXiv:2412.02021" in text["References"]


@pytest.mark.parametrize("name", DOCUMENTED)
def test_everything_has_an_example(name):
    assert ">>>" in sections(name).get("Examples", "")


@pytest.mark.parametrize("name", EQUATIONS)
def test_examples_of_equations_show_three_digits_or_more(name):
    printed = re.findall(r"^[-+\d.e]+", sections(name)["Examples"], re.MULTILINE)
    digits = [
        re.sub(r"e.*|\D|^0+", "", number.replace("0.", ".").lstrip("0")) for number in printed
    ]
    assert digits
    assert all(len(each) >= 3 for each in digits), printed


def test_every_equation_of_the_paper_is_there():
    text = " ".join(sections(name)[""] for name in EQUATIONS)
    assert {int(n) for n in re.findall(r"Eq\. \((\d+)\)", text)} >= {5, *range(9, 16)}

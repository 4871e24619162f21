"""Every public name documents itself: one sentence, its parameters, a reference, an example."""

import importlib
import inspect
import pkgutil
import re

import pytest

import fe_training
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
    if PUBLIC[name].__module__ in ("surrogate.equations", "surrogate.cutting.transition_radius")
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


def modules():
    """Return the modules of both packages; what a missing extra keeps from loading is left out."""
    for package in (surrogate, fe_training):
        for found in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
            if not found.name.endswith("__main__"):
                try:
                    yield importlib.import_module(found.name)
                except ModuleNotFoundError as error:
                    if error.name.partition(".")[0] in ("surrogate", "fe_training"):
                        raise


def own_names():
    """Return whatever the modules offer to each other, by its full name."""
    return {
        f"{module.__name__}.{name}": value
        for module in modules()
        for name in getattr(module, "__all__", ())
        if inspect.isroutine(value := getattr(module, name)) or inspect.isclass(value)
        if value.__module__ == module.__name__
    }


def members(kind):
    """Return the public methods and properties that a class itself defines."""
    for name, value in vars(kind).items():
        plain = inspect.isfunction(value) or isinstance(
            value, (property, classmethod, staticmethod)
        )
        if plain and not name.startswith("_"):
            yield name, value


def is_one_sentence(text):
    """Return whether a text is one line, from a capital or symbol to a full stop."""
    return re.fullmatch(r"([A-Z]|\w*[_(/]|\w+ = )[^\n]*[.]", text.strip())


def test_everything_that_modules_offer_is_said_in_one_sentence():
    names = own_names()
    assert len(names) > 200
    wordless = [
        name
        for name, value in names.items()
        if not is_one_sentence((inspect.getdoc(value) or "").partition("\n\n")[0])
    ]
    assert not wordless


def test_every_public_member_of_a_class_is_said_in_one_sentence():
    wordless = [
        f"{name}.{member}"
        for name, kind in own_names().items()
        if inspect.isclass(kind)
        for member, _ in members(kind)
        if not is_one_sentence((inspect.getdoc(getattr(kind, member)) or "").partition("\n\n")[0])
    ]
    assert not wordless


def test_parameters_that_are_documented_are_those_of_the_signature():
    wrong = []
    for name, value in own_names().items():
        section = re.search(
            r"^Parameters\n-+\n(.*?)(?=^\w[\w ]*\n-+\n|\Z)",
            inspect.getdoc(value) or "",
            re.MULTILINE | re.DOTALL,
        )
        if section and inspect.isfunction(value):
            entries = re.findall(r"^(\*{0,2}\w[\w, *]*?)(?: :.*)?$", section[1], re.MULTILINE)
            documented = [one.lstrip("*") for entry in entries for one in entry.split(", ")]
            if documented != list(inspect.signature(value).parameters):
                wrong.append(name)
    assert not wrong


@pytest.mark.parametrize("name", [name for name in DOCUMENTED if inspect.isclass(PUBLIC[name])])
def test_numbers_that_a_class_computes_have_a_unit(name):
    for member, value in members(PUBLIC[name]):
        if isinstance(value, property):
            returned = str(value.fget.__annotations__.get("return", ""))
            if re.search(r"float|Array", returned):
                assert re.search(r"\[[^\]]+\]", value.__doc__), f"{name}.{member} has no [unit]"

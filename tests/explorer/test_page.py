"""The page as a file: small, whole, and of the numbers and laws that the library has."""

import json
import re
import shutil
from pathlib import Path

import numpy as np
import pytest

from surrogate import InputError, Scene, read_measurements, write_explorer
from surrogate.basics.files import model_file
from surrogate.choosing.candidates import candidates
from surrogate.choosing.laws import LAWS
from surrogate.contact.fitted import TERMS_OF_LAW
from surrogate.contact.shipped import FILE, folder_in_use, in_use
from surrogate.coupling.shipped import AMPLIFICATION_FILE, amplification
from surrogate.cutting.regimes import PARTS
from surrogate.explorer.page import explorer_page
from surrogate.reading.measurements import Measurements


def data_of(page):
    text = re.search(r'<script id="data" type="application/json">(.*?)</script>', page, re.DOTALL)
    return json.loads(text[1])


def test_it_is_one_small_file_that_asks_for_nothing():
    page = explorer_page()
    assert len(page.encode()) < 400_000
    assert "<<" not in page
    asked = re.findall(r"""\b(?:src|href|url)\s*[=(]\s*["']?([^"')\s>]+)""", page)
    ours = ("data:", "#", "URL.createObjectURL")
    assert all(one.startswith(ours) for one in asked), asked
    for word in ("fetch(", "XMLHttpRequest", "@import", "import(", "WebSocket"):
        assert word not in page
    assert set(re.findall(r"https?://[^\s\"'<]*", page)) == {"http://www.w3.org/2000/svg"}


def test_every_law_of_the_library_is_in_the_page_with_its_functions():
    page = explorer_page()
    entries = re.findall(r'name: "(\w+)".*?arc: "(\w+)", load: "(\w+)"', page, re.DOTALL)
    assert {name: (arc, load) for name, arc, load in entries} == {
        law: TERMS_OF_LAW[law] for law in LAWS
    }


def test_it_is_told_what_python_knows():
    data = data_of(explorer_page())
    known = candidates()
    of_slip = candidates(law="slip")
    assert (data["transition"], *data["parts"]) == PARTS
    assert [*data["bounds"]] == [*known.terms, *of_slip.terms]
    for name, told in data["bounds"].items():
        bounds = (known if name in known.terms else of_slip).bounds
        errors = np.array(told["errors"], float)
        np.testing.assert_array_equal(
            np.where(np.isnan(errors), np.inf, errors), bounds.errors["table"][name]
        )
        assert (told["g"], told["touch"]) == ([*bounds.g], [*bounds.touch])
    assert data["domain"]["highest"] == [list(pair) for pair in known.limits.highest]


def test_kappa_is_written_to_the_last_digit():
    told, kappa = data_of(explorer_page())["coupled"], amplification()
    reach = np.array(told["reach"]["values"])[told["reach"]["places"]]
    np.testing.assert_array_equal(reach.reshape(kappa.reach.shape), kappa.reach)
    *powers, coefficients = zip(*told["terms"], strict=True)
    np.testing.assert_array_equal(np.transpose(powers), kappa.polynomial.powers)
    np.testing.assert_array_equal(coefficients, kappa.polynomial.coefficients)
    np.testing.assert_array_equal(told["errors"], kappa.errors)
    np.testing.assert_array_equal(told["growth"], kappa.growth)


def test_models_without_kappa_make_a_page_without_its_law(tmp_path):
    for name in (FILE, f"{FILE}.sha256"):
        shutil.copy(Path(folder_in_use()) / name, tmp_path / name)
    with in_use(tmp_path / FILE):
        page = explorer_page()
        with pytest.raises(InputError, match=AMPLIFICATION_FILE):
            explorer_page(law="coupled")
    assert 'name: "coupled"' not in page
    assert 'name: "coupled"' in explorer_page()
    (tmp_path / AMPLIFICATION_FILE).write_bytes(b"damaged")
    with in_use(tmp_path / FILE), pytest.raises(InputError, match=AMPLIFICATION_FILE):
        explorer_page()


def test_it_begins_with_what_is_given(tmp_path):
    file = tmp_path / "mine.html"
    cuts = read_measurements(model_file("paam-wire-cutting.csv"))
    write_explorer(file, Scene(5e3, 4.0, 1e-4, 0.2, 1e4, 3.0), cuts, law="slip", diameters=True)
    start = data_of(file.read_text(encoding="utf-8"))["start"]
    assert [start[key] for key in ("mu", "Gamma_o", "R_w", "xi", "tau_w", "alpha")] == [
        *(5e3, 4.0, 1e-4, 0.2, 1e4, 3.0)
    ]
    assert (start["law"], start["diameters"]) == ("slip", True)
    assert start["cuts"] == [
        [float(r), float(f), None] for r, f in zip(cuts.wire_radius, cuts.force, strict=True)
    ]
    with_errors = Measurements(np.array([1e-4]), np.array([5.0]), np.array([0.5]))
    assert data_of(explorer_page(cuts=with_errors))["start"]["cuts"] == [[1e-4, 5.0, 0.5]]


def test_what_is_wrong_is_refused_and_leaves_the_file(tmp_path):
    file = tmp_path / "mine.html"
    file.write_text("mine")
    for wrong, words in (
        ({"scene": Scene(1.0, 1.0, [1e-3, 2e-3])}, "single numbers"),
        ({"scene": 3.0}, "must be a Scene"),
        ({"cuts": [1.0]}, "must be Measurements"),
        ({"law": "none"}, "law must be one of"),
        ({"diameters": "yes"}, "diameters"),
    ):
        with pytest.raises(InputError, match=words):
            write_explorer(file, **wrong)
    assert file.read_text() == "mine"
    with pytest.raises(InputError, match="cannot be written"):
        write_explorer(tmp_path / "nowhere" / "mine.html")

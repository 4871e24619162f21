"""Tables that the page reads: the numbers of read_measurements or words, never other numbers."""

import itertools

import pytest

from surrogate import read_measurements
from surrogate.errors import InputError

POINT = "wire_radius_mm,force_per_thickness_N_per_m\n0.1,4.7\n0.4,13.9\n"
READ = {
    "plain": POINT,
    "remarks and blanks": f"# made up\n\n{POINT}\n",
    "german": "Drahtdurchmesser [mm];Kraft/Dicke [N/m];SE\n;;N/m\n0,2;4,7;0,3\n1,25;13,9;0,5\n",
    "units below": "wire,load,thickness,std\nmm,N,mm,N\n0.2,0.1,20,0.005\n0.4,0.25,20,0.01\n",
    "force and thickness": "d (mm)\tF [mN]\tthickness (cm)\n0.2\t94\t2\n0.8\t278\t2\n",
    "repeats in columns": "D_mm,trial1_N_per_m,trial2_N_per_m\n0.2,4.7,4.9\n0.8,13.9,\n",
    "repeats in rows": "gel,d_mm,F/T [N/m]\nA,0.2,4.7\nA,0.2,4.8\nA,0.8,13.9\n",
    "scatter of n": "d_um,f/t (mN/mm),sd_N_per_m,n\n200,4.7,0.3,4\n800,13.9,0.6,9\n",
    "an empty cell and a sum": f"{POINT}0.6,\nMean,9.3\n",
    "quotes": '"wire diameter, mm","force per thickness, N/m"\n"0.2","4.7"\n"0.8","13.9"\n',
    "thousands": "wire_radius_um;force_per_thickness_N_per_m\n100;1.234,5\n400;2.345,75\n",
    "sep and bars": "sep=|\nradius (in)|f/t (lbf/in)\n0.004|0.027\n0.016|0.08\n",
    "names beside": "Name,r_w [µm],note,F_ss/T [J/m²]\na,100,x,4.7\nb,400,,13.9\n",
    "both forces": "d_mm,force_N,thickness_mm,force_per_thickness_N_per_m\n0.2,0.094,20,4.7\n",
}
REFUSED = {
    "empty": "",
    "no wire": "time_s,force_N\n0,0.1\n1,0.2\n",
    "no unit": "wire,force_per_thickness_N_per_m\n0.2,4.7\n",
    "no thickness": "d_mm,force_N\n0.2,0.1\n",
    "a word": POINT + "0.5,much\n",
    "negative": POINT + "0.5,-3\n",
    "infinite": POINT + "0.5,1e999\n",
    "two decimal signs": "d_mm;f/t (N/m)\n0,2;4.75\n",
    "open": "d_um;f/t (N/m)\n1,234;4\n2,345;5\n",
    "too many cells": POINT + "0.5,1,2\n",
    "twice": "d_mm,d_um,f/t (N/m)\n0.2,200,4.7\n",
    "both": "d_mm,r_mm,f/t (N/m)\n0.2,0.1,4.7\n",
    "they disagree": "d_mm,force_N,thickness_mm,f/t (N/m)\n0.2,0.094,20,5.7\n",
    "names alone": "wire_radius_mm,force_per_thickness_N_per_m\n",
}
ON_ITS_SIDE = "d_mm,0.2,0.8\nf/t (N/m),4.7,13.9\n"
"""What Python reads and the page does not: it says so."""

MARKS = "\t", ";", ",", "|"
NAMES = ("r (mm)", "wire_radius_mm"), ("Diameter [um]", "ø µm"), ("f/t (N/m)", "force_N")
CELLS = (
    "0.2",
    "0,2",
    "1,234",
    "1.234",
    "5e-2",
    "",
    "-",
    "n/a",
    "0.2 mm",
    "4.7 ± 0.1",
    "x",
    "−3",
    "1'234.5",
)


def told(page, text):
    return page.run("return cutsOfNames(arguments[0]);", text)


def pythons(tmp_path, text):
    """Return Python's cuts of a text, None where it refuses it."""
    file = tmp_path / "cuts.csv"
    file.write_text(text, encoding="utf-8")
    try:
        cuts = read_measurements(file)
    except InputError:
        return None
    std = [None] * cuts.force.size if cuts.force_std is None else cuts.force_std.tolist()
    return [
        list(cut) for cut in zip(cuts.wire_radius.tolist(), cuts.force.tolist(), std, strict=True)
    ]


@pytest.mark.parametrize("name", READ)
def test_a_simple_table_is_read_as_python_reads_it(page, tmp_path, name):
    page.open()
    answer = told(page, READ[name])
    assert answer["cuts"] == pythons(tmp_path, READ[name]) is not None
    assert f"{len(answer['cuts'])} cut" in answer["said"]


@pytest.mark.parametrize("name", REFUSED)
def test_what_python_refuses_is_not_understood_either(page, tmp_path, name):
    page.open()
    assert pythons(tmp_path, REFUSED[name]) is None
    answer = told(page, REFUSED[name])
    assert answer["cuts"] is None
    assert answer["said"].startswith("Not understood: ")


def test_a_table_on_its_side_is_left_to_python(page, tmp_path):
    page.open()
    assert len(pythons(tmp_path, ON_ITS_SIDE)) == 2
    answer = told(page, ON_ITS_SIDE)
    assert answer["cuts"] is None
    assert "lies on its side" in answer["said"]


def test_a_table_is_read_as_python_reads_it_or_not_at_all(page, tmp_path):
    headers = [*itertools.product(NAMES[0] + NAMES[1], NAMES[2])]
    texts = [
        f"{mark.join(header)}\n0.5{mark}2\n{first}{mark}{second}\n"
        for mark in MARKS
        for header in headers
        for first, second in itertools.product(CELLS, CELLS[:8])
        if mark not in first + second
    ]
    page.open()
    answers = page.run("return arguments[0].map(cutsOfNames);", texts)
    read = 0
    for text, answer in zip(texts, answers, strict=True):
        if answer["cuts"] is not None:
            assert answer["cuts"] == pythons(tmp_path, text), text
            read += 1
    assert read > 0.05 * len(texts)


def test_a_file_is_chosen(page, tmp_path):
    file = tmp_path / "meine.csv"
    file.write_bytes("Drahtradius [µm];Kraft pro Dicke [N/m]\n100;4,7\n400;13,9\n".encode("cp1252"))
    page.open("cuts=0.001:50")
    page.element("cuts-file").send_keys(str(file))
    page.wait("document.getElementById('cuts-wrong').textContent")
    assert page.text("cuts-wrong") == "meine.csv: 2 cuts are read."
    assert page.run("return state.cuts;") == [[1e-4, 4.7, None], [4e-4, 13.9, None]]
    assert page.run("return document.querySelectorAll('#forces .cut').length;") == 2
    assert page.element("cuts").get_property("value") == "0.1  4.7\n0.4  13.9"
    assert page.complaints() == []


@pytest.mark.parametrize(
    ("name", "content", "words"),
    [
        ("cuts.xlsx", b"PK\x03\x04", "a spreadsheet, which this page does not read"),
        ("cuts.bin", b"\x00\x01\x02", "no text"),
        ("record.csv", b"time_s,force_N\n0,0.1\n", "'wirecut steady'"),
        ("large.csv", b"1,2\n" * 300_000, "too large"),
    ],
)
def test_a_file_that_is_no_table_changes_nothing(page, tmp_path, name, content, words):
    file = tmp_path / name
    file.write_bytes(content)
    page.open("cuts=0.001:50")
    page.element("cuts-file").send_keys(str(file))
    page.wait("document.getElementById('cuts-wrong').textContent")
    assert words in page.text("cuts-wrong")
    assert page.run("return state.cuts;") == [[1e-3, 50, None]]


def test_a_file_is_dropped_on_the_page(page):
    page.open()
    page.run(
        "const data = new DataTransfer();"
        "data.items.add(new File([arguments[0]], 'mine.csv'));"
        "for (const kind of ['dragover', 'drop']) document.getElementById('map').dispatchEvent("
        "new DragEvent(kind, {dataTransfer: data, bubbles: true, cancelable: true}));",
        POINT,
    )
    page.wait("document.getElementById('cuts-wrong').textContent")
    assert page.run("return state.cuts;") == [[1e-4, 4.7, None], [4e-4, 13.9, None]]


def test_a_table_is_pasted_and_what_is_not_understood_stays(page):
    page.open()
    paste = (
        "const box = document.getElementById('cuts');"
        "box.focus(); box.value = arguments[0]; box.dispatchEvent(new Event('input')); box.blur();"
        "change({}); return box.value;"
    )
    torn = POINT.replace("_mm", "")
    assert page.run(paste, torn) == torn
    assert "has no unit" in page.text("cuts-wrong")
    assert len(page.run("return state.cuts;")) == 5
    assert page.run(paste, POINT) == "0.1  4.7\n0.4  13.9"
    assert page.element("cuts").get_attribute("aria-invalid") == "false"

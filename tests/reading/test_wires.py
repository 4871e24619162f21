"""Wires by the names of files and by tables."""

import pytest

from surrogate import InputError
from surrogate.reading.wires import Wire, wires_by_name, wires_by_table


@pytest.mark.parametrize(
    ("pattern", "file", "expected"),
    [
        ("wire_{diameter}mm_{trial}", "a/wire_0.2mm_3.csv", Wire(1e-4, None, "3")),
        ("wire_{diameter}mm_{trial}", "WIRE_0,2MM_a b.txt", Wire(1e-4, None, "a b")),
        ("{sample}-r{radius}um-{trial}", "gel-2-r100um-1.csv", Wire(1e-4, None, "1", "gel-2")),
        ("{}_{diameter}um_{thickness}mm", "x_y_200um_10mm.xlsx", Wire(1e-4, 0.01)),
        ("d{diameter}in", "d0.5in.csv", Wire(0.00635)),
        ("{diameter}mm.csv", "0.2mm.csv", Wire(1e-4)),
    ],
)
def test_names(pattern, file, expected):
    assert wires_by_name(pattern)(file, 1) == expected


def test_a_specimen_is_a_trial_where_the_name_has_none():
    assert wires_by_name("{diameter}mm")("0.2mm.csv", 2).trial == "2"


@pytest.mark.parametrize(
    ("pattern", "file", "reason"),
    [
        ("wire_{trial}", "", "one of {diameter} and {radius}"),
        ("{diameter}mm_{radius}mm", "", "one of {diameter} and {radius}"),
        ("{diameter}_{trial}", "", "not followed by a unit"),
        ("{diameter}Pa", "", "not followed by a unit"),
        ("{diameter}mm_{diameter}mm", "", "comes twice"),
        ("{size}mm", "", "is not known"),
        ("wire_{diameter}mm", "wire_x.csv", "does not fit"),
        ("wire_{diameter}mm", "wire_0mm.csv", "not a positive number"),
    ],
)
def test_patterns_and_names_refused(pattern, file, reason):
    with pytest.raises(InputError, match=reason):
        wires_by_name(pattern)(file, 1)


@pytest.fixture
def table(tmp_path):
    def write(text):
        file = tmp_path / "wires.csv"
        file.write_text(text, encoding="utf-8")
        return file

    return write


def test_table(table):
    find = wires_by_table(
        table(
            "File;Wire diameter (mm);thickness_mm;specimen;sample\n"
            "a.csv;0,2;10;1;gel\na.csv;0,4;10;2;gel\nB;0,8;;;\n"
        )
    )
    assert find("x/a.csv", 1) == Wire(1e-4, 0.01, "", "gel")
    assert find("x/A.CSV", 2) == Wire(2e-4, 0.01, "", "gel")
    assert find("b.txt", 1) == find("b.txt", 2) == Wire(4e-4)
    with pytest.raises(InputError, match="add a line"):
        find("c.csv", 1)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("", "is empty"),
        ("name,d\na.csv,1\n", "no unit of length"),
        ("file,force_N\na.csv,1\n", "must name a column file"),
        ("file,wire_diameter_mm\na.csv,1\na.csv,2\n", "again"),
        ("file,wire_diameter_mm\na.csv,x\n", "not a positive number"),
        ("file,wire_diameter_mm\na.csv,\n", "not a positive number"),
    ],
)
def test_tables_refused(table, text, reason):
    with pytest.raises(InputError, match=reason):
        wires_by_table(table(text))

"""Tables as laboratories have them: every form gives the same numbers, or says what is open."""

import sys

import numpy as np
import pytest

from surrogate import read_measurements
from surrogate.errors import InputError, WirecutError
from surrogate.reading.units import (
    ENERGY_DENSITY,
    FORCE,
    LENGTH,
    LINE_FORCE,
    STRESS,
    TIME,
    TOUGHNESS,
    parse_quantity,
)

DIAMETERS = [0.1, 0.2, 0.4, 0.8]  # mm
FORCES = [2.9, 4.7, 7.8, 13.7]  # N/m
STD = [0.2, 0.25, 0.3, 0.4]


def lines(names, *columns, mark=",", decimal=".", end="\n"):
    rows = [mark.join(f"{x}".replace(".", decimal) for x in row) for row in zip(*columns)]  # noqa: B905
    return end.join([names, *rows, ""])


@pytest.fixture
def read(tmp_path):
    def read(content, name="cuts.csv", **options):
        file = tmp_path / name
        file.write_bytes(content if isinstance(content, bytes) else content.encode())
        return read_measurements(file, **options)

    return read


def same(cuts, std=False):
    np.testing.assert_allclose(cuts.wire_radius, 0.5e-3 * np.array(DIAMETERS), rtol=1e-12)
    np.testing.assert_allclose(cuts.force, FORCES, rtol=1e-12)
    assert (cuts.force_std is None) == (not std)
    if std:
        np.testing.assert_allclose(cuts.force_std, STD, rtol=1e-12)


HEADERS = [
    "wire_diameter_mm,force_per_thickness_N_per_m",
    "Wire diameter (mm),Force per thickness (N/m)",
    "WIRE DIAMETER [MM],F_ss/T [N/m]",
    "d / mm,F/T (N m^-1)",
    "d_w in mm,Fss/T in J/m²",
    '"Wire Dia. (mm)","Steady force per thickness (J·m⁻²)"',
    "Drahtdurchmesser [mm],Kraft pro Dicke [N/m]",
    "  Diameter, mm:".replace(",", " ") + ",Force (N/m)",
]


@pytest.mark.parametrize("header", HEADERS)
def test_names_and_units(read, header):
    same(read(lines(header, DIAMETERS, FORCES)))


@pytest.mark.parametrize("mark", [";", "\t"])
@pytest.mark.parametrize("decimal", [".", ","])
@pytest.mark.parametrize(
    "encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "cp1252"]
)
def test_marks_decimals_and_encodings(read, mark, decimal, encoding):
    header = mark.join(("Drahtdurchmesser [µm]", "Kraft pro Dicke [N/m]", "Standardfehler [N/m]"))
    micrometres = [1e3 * one for one in DIAMETERS]
    text = lines(header, micrometres, FORCES, STD, mark=mark, decimal=decimal, end="\r\n")
    same(read(text.encode(encoding)), std=True)


def test_quoted_decimal_commas_between_commas(read):
    rows = [f'"{d}","{f}"'.replace(".", "§").replace("§", ",") for d, f in zip(DIAMETERS, FORCES)]  # noqa: B905
    same(read("\n".join(["wire diameter (mm),F/T (N/m)", *rows])))


def test_what_a_spreadsheet_adds(read):
    text = lines("wire_diameter_mm;F/T [N/m];;", DIAMETERS, FORCES, [""] * 4, [""] * 4, mark=";")
    cuts = read("sep=;\n" + text + ";;;\n")
    same(cuts)
    assert [note.partition(": ")[2] for note in cuts.notes] == [] or "skipped" in cuts.notes[0]


def test_units_in_a_second_row_and_lines_before_the_header(read):
    body = lines("mm,N/m,N/m", DIAMETERS, FORCES, STD)
    cuts = read("Operator,A. Person\nDate,2024-05-01\n\nwire diameter,F/T,std\n" + body)
    same(cuts, std=True)
    bracketed = read("wire diameter,F/T,std\n" + body.replace("mm,N/m,N/m", "(mm),(N/m),[N/m]"))
    same(bracketed, std=True)


@pytest.mark.parametrize(
    ("unit", "factor"),
    [
        ("N", 1.0),
        ("mN", 1e3),
        ("kN", 1e-3),
        ("gf", 1e3 / 9.80665),
        ("g", 1e3 / 9.80665),
        ("kgf", 1 / 9.80665),
        ("lbf", 1 / 4.4482216152605),
    ],
)
def test_force_and_thickness_apart(read, unit, factor):
    newtons = [0.02 * one for one in FORCES]
    forces = [repr(factor * one) for one in newtons]
    beside = lines(f"wire diameter [mm],force [{unit}],thickness [mm]", DIAMETERS, forces, [20] * 4)
    same(read(beside))
    alone = lines(f"wire_diameter_mm,force_{unit}", DIAMETERS, forces)
    same(read(alone, thickness=0.02))
    same(read("Sample thickness;20;mm\n" + alone.replace(",", ";")))
    same(read("Sample thickness (mm);20\n" + alone.replace(",", ";")))
    inches = lines(f"wire_diameter_in,F [{unit}]", [one / 25.4 for one in DIAMETERS], forces)
    same(read(inches, thickness=0.02))


def test_a_standard_error_in_newtons_is_divided_too(read):
    columns = [0.02 * one for one in FORCES], [0.02 * one for one in STD]
    same(read(lines("d_mm,F_N,SE_N", DIAMETERS, *columns), thickness=0.02), std=True)


def test_thickness_is_said_once(read):
    text = lines("d_mm,F_N,T_mm", DIAMETERS, FORCES, [20] * 4)
    with pytest.raises(InputError, match="20 mm thick, and the option 10 mm"):
        read(text, thickness=0.01)
    with pytest.raises(InputError, match=r"--thickness .*thickness= in Python"):
        read(lines("d_mm,F_N", DIAMETERS, FORCES))
    two = "Thickness;20;mm\nThickness;10;mm\n" + lines("d_mm;F_N", DIAMETERS, FORCES, mark=";")
    with pytest.raises(InputError, match="20 mm in line 1, 10 mm in line 2"):
        read(two)
    with pytest.raises(InputError, match="no unit of length"):
        read("Thickness;20\n" + lines("d_mm;F_N", DIAMETERS, FORCES, mark=";"))


def test_a_force_that_contradicts_the_one_beside_it(read):
    header = "d_mm,F/T_N_per_m,F_N,T_mm"
    good = lines(header, DIAMETERS, FORCES, [0.058, 0.094, 0.156, 0.274], [20] * 4)
    cuts = read(good)
    same(cuts)
    assert cuts.notes == ()  # it agrees
    with pytest.raises(InputError, match=r"line 2 gives 2\.9 N/m, but its force over"):
        read(good.replace("0.058", "0.116"))


@pytest.mark.parametrize(
    "name", ["trial{}_N_per_m", "Trial {} (N/m)", "F/T {} [N/m]", "force_per_thickness_{}_N_per_m"]
)
def test_repeats_in_columns_and_in_rows(read, name):
    twice = [round(one + 0.1, 3) for one in FORCES]
    header = ",".join(("wire_diameter_mm", name.format(1), name.format(2)))
    wide = read(lines(header, DIAMETERS, FORCES, twice))
    rows = read(
        lines(
            "wire_diameter_mm,trial,F/T (N/m)",
            [d for d in DIAMETERS for _ in "12"],
            [1, 2] * 4,
            [f for both in zip(FORCES, twice) for f in both],  # noqa: B905
        )
    )
    assert wide.wire_radius.tolist() == rows.wire_radius.tolist()
    assert wide.force.tolist() == rows.force.tolist()
    assert len(wide.force) == 8


def test_a_missing_trial_is_skipped_and_named(read):
    cuts = read("d_mm,trial1_N_per_m,trial2_N_per_m\n0.1,2.9,\n0.2,4.7,4.8\n")
    assert cuts.force.tolist() == [2.9, 4.7, 4.8]
    assert cuts.notes[0].endswith("line 2, column 3 (trial2_N_per_m) is empty: skipped")


def test_a_table_on_its_side(read):
    text = "wire_diameter_mm," + ",".join(map(str, DIAMETERS))
    same(read(text + "\nforce_per_thickness_N_per_m," + ",".join(map(str, FORCES)) + "\n"))


def test_what_is_not_used_is_named(read):
    text = lines("gel,d_mm,F/T (N/m),remark", ["A", "A", "B", "B"], DIAMETERS, FORCES, ["ok"] * 4)
    cuts = read(text)
    same(cuts)
    assert cuts.samples == ("A", "A", "B", "B")
    assert "not used: column 4 (remark)" in cuts.notes[0]
    assert "2 samples of one gel together: A, B; where each is a gel of its own" in cuts.notes[1]
    assert cuts.notes[1].endswith("say so by --by 'gel'")


@pytest.mark.parametrize(
    ("content", "options", "says"),
    [
        ("d_um;F/T (N/m)\n1,234;2,345\n", {}, "1,234 may be thousands"),
        ("d_um;F/T (N/m)\n1.234;2.345\n", {}, "1.234 may be thousands"),
        ("d_um;F/T (N/m)\n100,5;2.9\n", {}, "two decimal signs"),
        ("d_um;F/T (N/m)\n100,5;2.9\n", {"decimal": ","}, "'2.9' is not a number"),
        ("d_um;F/T (N/m)\n1;2\n", {"decimal": "x"}, "decimal sign 'x' is not known"),
        ("d_um;F/T (N/m)\n1;2\n", {"delimiter": "x"}, "delimiter 'x' is not known"),
        ("d_um;F/T (N/m)\n1;2\n", {"encoding": "x"}, "'x' is no encoding"),
        ("d_µm;F/T (N/m)\n1;2\n".encode("cp1252"), {"encoding": "utf-8"}, "--encoding"),
        (b"d_um;\x81\n1;2\n", {}, "no text in CP1252"),
        ("d_mm,force (oz)\n1,2\n", {}, "does not end with a unit of force"),
        ("d_mm,trial1,trial2\n1,2,3\n", {}, "column 2 (trial1) has no unit"),
    ],
)
def test_what_is_open_is_asked_for(read, content, options, says):
    with pytest.raises(InputError) as caught:
        read(content, **options)
    assert says in str(caught.value)


def test_thousands_where_the_decimal_sign_is_said_or_seen(read):
    text = "d_um;F/T (N/m)\n1,234;2,345\n"
    assert read(text, decimal=",").force.tolist() == [2.345]
    assert read(text, decimal=".").force.tolist() == [2345.0]
    assert read("d_um;F/T (N/m)\n1.234,5;2,9\n").wire_radius[0] == pytest.approx(617.25e-6)


def test_millimetres_under_a_header_of_metres_are_doubted(read):
    cuts = read(lines("wire_diameter_m,force_per_thickness_N_per_m", DIAMETERS, FORCES))
    assert "likely mm given as m" in cuts.warnings[0]


def test_a_data_frame():
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame({"Wire diameter (mm)": DIAMETERS, "F/T [N/m]": FORCES})
    same(read_measurements(frame))
    frame.loc[0, "F/T [N/m]"] = np.nan
    assert read_measurements(frame).notes[0].startswith("the data frame, line 2, column 2")


def test_a_spreadsheet(tmp_path):
    openpyxl = pytest.importorskip("openpyxl")
    book = openpyxl.Workbook()
    for row in [("d (mm)", "F/T (N/m)"), *zip(DIAMETERS, FORCES)]:  # noqa: B905
        book.active.append(row)
    book.create_sheet("notes").append(("by", "hand"))
    book.save(tmp_path / "cuts.xlsx")
    cuts = read_measurements(tmp_path / "cuts.xlsx")
    same(cuts)
    assert "sheet 'notes' is not read" in cuts.notes[0]
    (tmp_path / "bad.xlsx").write_bytes(b"PK no")
    with pytest.raises(InputError, match="cannot be read as a spreadsheet"):
        read_measurements(tmp_path / "bad.xlsx")


def test_a_spreadsheet_without_openpyxl(tmp_path, monkeypatch):
    (tmp_path / "cuts.xlsx").write_bytes(b"PK")
    monkeypatch.setattr("surrogate.basics.extras.find_spec", lambda name: None)
    with pytest.raises(WirecutError, match=r"pip install 'wirecut\[excel\]'"):
        read_measurements(tmp_path / "cuts.xlsx")


def test_plain_tables_need_numpy_alone(read):
    read(lines(HEADERS[0], DIAMETERS, FORCES))
    assert "openpyxl" not in vars(sys.modules["surrogate.reading.sheet"])


@pytest.mark.parametrize(
    ("text", "dimension", "value"),
    [
        ("685 Pa", STRESS, 685.0),
        ("-1.6J/m2", TOUGHNESS, -1.6),
        ("1.6 J/m²", TOUGHNESS, 1.6),
        ("1.6J m-2", TOUGHNESS, 1.6),
        ("1.6 J·m⁻²", TOUGHNESS, 1.6),
        ("1.6 N per m", LINE_FORCE, 1.6),
        ("3 J/m³", ENERGY_DENSITY, 3.0),
        ("200\u00b5m", LENGTH, 200e-6),
        ("200\u03bcm", LENGTH, 200e-6),
        ("2 inch", LENGTH, 0.0508),
        ('2"', LENGTH, 0.0508),
        ("2 MM", LENGTH, 2e-3),
        ("3 KN", FORCE, 3e3),
        ("10 gf", FORCE, 0.0980665),
        ("1 lb", FORCE, 4.4482216152605),
        ("2 min", TIME, 120.0),
    ],
)
def test_units(text, dimension, value):
    assert parse_quantity(text, dimension) == pytest.approx(value, rel=1e-15)


@pytest.mark.parametrize(("text", "dimension"), [("1 MN", FORCE), ("1 mPa", STRESS)])
def test_a_capital_that_would_change_the_size_is_refused(text, dimension):
    with pytest.raises(InputError, match="is not a"):
        parse_quantity(text, dimension)


def test_a_remark_that_could_be_a_quantity(read):
    cuts = read(lines("wire,diameter_mm,force,F/T (N/m)", ["A"] * 4, DIAMETERS, ["ok"] * 4, FORCES))
    same(cuts)
    assert "not used: column 1 (wire), column 3 (force)" in cuts.notes[0]


def test_a_standard_deviation_is_not_taken_in_silence(read):
    cuts = read(lines("d_mm,F/T (N/m),SD (N/m)", DIAMETERS, FORCES, STD))
    same(cuts, std=True)
    assert "divided by the square root of m" in cuts.notes[0]


def test_lines_that_sum_a_table_up_are_named_and_not_read(read):
    below = "Mean,7.3\nStandard deviation,4.7\n"
    cuts = read(lines("d_mm,F/T (N/m)", DIAMETERS, FORCES) + below)
    same(cuts)
    assert "sums up and not read: line 6 (Mean), 7 (Standard deviation)" in cuts.notes[0]
    with pytest.raises(InputError, match=r"line 6, column 1 \(d_mm\): 'thick' is not a number"):
        read(lines("d_mm,F/T (N/m)", DIAMETERS, FORCES) + "thick,7.3\n")


LANGUAGES = [
    ("Diamètre du fil (mm);Force (N);Épaisseur (mm)", "cp1252"),
    ("Diámetro del alambre (mm);Fuerza (N);Espesor (mm)", "cp1252"),
    ("Diametro filo (mm);Forza (N);Spessore (mm)", "utf-8"),
    ("Diâmetro do fio (mm);Força (N);Espessura (mm)", "cp1252"),
    ("Draaddiameter [mm];Kracht [N];Dikte [mm]", "utf-8"),
    ("Średnica drutu [mm];Siła [N];Grubość [mm]", "cp1250"),
    ("线径(mm);力(N);厚度(mm)", "gb18030"),
    ("線径(mm);荷重(N);厚さ(mm)", "cp932"),
    ("線径(mm);荷重(N);厚さ(mm)", "utf-16"),
]


@pytest.mark.parametrize(("header", "encoding"), LANGUAGES)
def test_names_in_other_languages(read, header, encoding):
    newtons = [round(0.02 * one, 6) for one in FORCES]
    text = lines(header, DIAMETERS, newtons, [20] * 4, mark=";", decimal=",")
    same(read(text.encode(encoding)))


@pytest.mark.parametrize(
    ("header", "diameter", "force"),
    [
        ("wire diameter,force per thickness", "{} mm", "{} N/m"),
        ("wire diameter [mm],F/T", "{} mm", "{}N/m"),
        ("wire diameter (mm),F/T (N/m) mean", "{}", "{}"),
        ("Mean diameter [mm],Mittelwert F/T [N/m]", "{}", "{}"),
    ],
)
def test_units_in_cells_and_words_beside_names(read, header, diameter, force):
    columns = [diameter.format(d) for d in DIAMETERS], [force.format(f) for f in FORCES]
    same(read(lines(header, *columns)))
    mixed = lines(header, columns[0], ["2.9 N/m", "4.7 mN/mm", *columns[1][2:]])
    with pytest.raises(InputError):
        read(mixed)


@pytest.mark.parametrize("sign", ["±", "+-", " +/- "])
@pytest.mark.parametrize(
    ("header", "unit"), [("d (mm),F/T (N/m)", ""), ("d (mm),F/T", " N/m"), ("d (mm),F/T", "N/m")]
)
def test_errors_behind_a_force(read, sign, header, unit):
    both = [f"{f}{sign}{s}{unit}" for f, s in zip(FORCES, STD, strict=True)]
    cuts = read(lines(header, DIAMETERS, both))
    same(cuts, std=True)
    assert "is taken for the standard error" in cuts.notes[0]


def test_a_standard_deviation_and_the_number_of_cuts(read):
    scatter = [2.0 * one for one in STD]
    cuts = read(lines("d_mm,F/T (N/m),SD (N/m),n", DIAMETERS, FORCES, scatter, [4] * 4))
    same(cuts, std=True)
    assert "divided by the square root of their number in column 4 (n)" in cuts.notes[0]
    error = read(lines("d_mm,F/T (N/m),SEM (N/m),n", DIAMETERS, FORCES, STD, [4] * 4))
    same(error, std=True)
    with pytest.raises(InputError, match="'0' is no number of cuts"):
        read(lines("d_mm,F/T (N/m),SD (N/m),n", DIAMETERS, FORCES, scatter, [4, 4, 0, 4]))


@pytest.mark.parametrize("mark", ["'", "\u2019", " ", "\u202f"])
def test_thousands_with_a_mark_of_their_own(read, mark):
    text = lines("d_mm;F/T (mN/m)", DIAMETERS, [f"{f:.0f}" for f in FORCES], mark=";")
    for one in FORCES:
        text = text.replace(f";{one:.0f}\n", f";{one:.3f}\n".replace(".", mark))
    same(read(text))


def test_the_sheet_that_has_the_table(tmp_path):
    openpyxl = pytest.importorskip("openpyxl")
    book = openpyxl.Workbook()
    book.active.append(("Operator", "N. N."))
    book.active.title = "about"
    sheet = book.create_sheet("cuts")
    for row in (("d (mm)", "F/T (N/m)"), *zip(DIAMETERS, FORCES, strict=True)):
        sheet.append(row)
    book.save(tmp_path / "cuts.xlsx")
    cuts = read_measurements(tmp_path / "cuts.xlsx")
    same(cuts)
    assert "sheet 'about' is not read" in cuts.notes[0]


def test_merged_cells_are_not_a_sample_without_a_name(tmp_path):
    file = tmp_path / "cuts.csv"
    lines = ["gel,d (mm),F/T (N/m)", "A,0.1,2.9", ",0.2,4.7", "B,0.1,4.1", ",0.2,6.0"]
    file.write_text("\n".join(lines))
    with pytest.raises(
        InputError, match=r"column 1 \(gel\) is empty in some lines; write the name"
    ):
        read_measurements(file)
    file.write_text("\n".join(lines).replace("A,", ",").replace("B,", ","))
    assert len(read_measurements(file).force) == 4


def test_a_column_a_gel_is_answered_with_the_form_that_is_read(tmp_path):
    file = tmp_path / "cuts.csv"
    file.write_text("d (mm),Gel A (N/m),Gel B (N/m)\n0.1,2.9,4.1\n0.2,4.7,6.0\n")
    with pytest.raises(InputError, match="where each column is a gel of its own, write one line a"):
        read_measurements(file)


@pytest.mark.parametrize("name", ["Échantillon", "Muestra", "Próbka", "試料", "Sample ID", "Gel"])
def test_samples_are_known_by_their_name_in_other_languages(name, tmp_path):
    file = tmp_path / "cuts.csv"
    rows = ["A,0.1,2.9", "A,0.2,4.7", "B,0.1,4.1", "B,0.2,6.0"]
    file.write_text("\n".join([f"{name},d (mm),F/T (N/m)", *rows]), encoding="utf-8")
    assert read_measurements(file).samples == ("A", "A", "B", "B")
    apart = read_measurements(file, by=name).of_each_gel()
    assert {gel: one.force.tolist() for gel, one in apart.items()} == {
        "A": [2.9, 4.7],
        "B": [4.1, 6.0],
    }

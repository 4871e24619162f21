"""Exports of testing machines: each of the made-up ones gives the same record, or says why not."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from surrogate.errors import InputError
from surrogate.reading.records import read_record, read_records

N = 40
TIME = [0.5 * i for i in range(N)]  # s
TRAVEL = [0.25 * i for i in range(N)]  # mm
FORCE = [round(0.2 * min(i / 10.0, 1.0) + 0.001 * (i % 3), 4) for i in range(N)]  # N

BOTH_WAYS = [0.2 * (-1) ** (i // 9) for i in range(N)]


def table(columns, mark=",", decimal=".", quote="", digits=6):
    """Return lines of numbers."""
    rows = zip(*columns, strict=True)
    return [
        mark.join(f"{quote}{x:.{digits}f}{quote}".replace(".", decimal) for x in row)
        for row in rows
    ]


def scaled(values, factor):
    return [factor * one for one in values]


def bluehill_english(force=FORCE, specimens=1):
    lines = [
        '"Results Table 1"',
        '"","Maximum Force","Extension at Maximum Force"',
        '"","(N)","(mm)"',
        *(f'"{i + 1}","{0.2 + 0.01 * i:.4f}","3.2"' for i in range(specimens)),
        "",
    ]
    for i in range(specimens):
        lines += [
            f'"Specimen label","gel-{i + 1}"',
            '"Time","Extension","Load"',
            '"(s)","(mm)","(N)"',
        ]
        lines += [*table([TIME, TRAVEL, scaled(force, 1.0 + i)], quote='"'), ""]
    return lines


def bluehill_german():
    return [
        'Texteingaben : Proben-beschriftung;"gel-1"',
        "Abmessung : Dicke;20,00000;mm",
        "Software-Version;4.25",
        "",
        "Zeit;Traversenweg;Last",
        "(sec);(mm);(kN)",
        *table([TIME, TRAVEL, scaled(FORCE, -1e-3)], ";", ",", digits=8),
    ]


def zwick():
    return [
        '"Prüfer";"N. N."',
        '"Probendicke a0";"20";"mm"',
        '"Prüfgeschwindigkeit";"30";"mm/min"',
        '"Prüfzeit";"Standardkraft";"Traversenweg absolut"',
        '"s";"N";"mm"',
        *table([TIME, FORCE, TRAVEL], ";", ","),
    ]


def exponent():
    grams = scaled(FORCE, 1e3 / 9.80665)
    return ["Test 1", "Force\tDistance\tTime", "g\tmm\tsec", *table([grams, TRAVEL, TIME], "\t")]


def exponent_side_by_side():
    grams = scaled(FORCE, 1e3 / 9.80665)
    both = [grams, TRAVEL, TIME, scaled(grams, 2.0), TRAVEL, TIME]
    names = ["Force (g)", "Distance (mm)", "Time (sec)"] * 2
    return ["gel 1\t\t\tgel 2", "\t".join(names), *table(both, "\t")]


def mts():
    return [
        "MTS793|MPT|ENU|1|2|.|/|:|1|0|0|A",
        "Data Acquisition: Timed",
        "Station Name: frame.cfg",
        "Axial Displacement\tAxial Force\tTime",
        "mm\tmN\tSec",
        *table([scaled(TRAVEL, -1.0), scaled(FORCE, -1e3), TIME], "\t"),
    ]


def shimadzu():
    return [
        '"Test Name","gel"',
        '"1 _ 1","","",""',
        '"Time","Force","Stroke"',
        '"(sec)","(N)","(mm)"',
        *table([TIME, FORCE, TRAVEL], quote='"'),
    ]


def plain_columns():
    return ["displacement_mm,force_N", *table([TRAVEL, FORCE])]


def inches_and_pounds():
    columns = [scaled(TRAVEL, 1 / 25.4), scaled(FORCE, 1 / 4.4482216152605)]
    return ["Extension (in),Load (lbf)", *table(columns, digits=9)]


def kilograms():
    return [
        "Position [um];Force [kgf]",
        *table([scaled(TRAVEL, 1e3), scaled(FORCE, 1 / 9.80665)], ";", ",", digits=9),
    ]


def blanks():
    return ["# made by hand", "Position(mm)   Load(N)", *table([TRAVEL, FORCE], "   ")]


def bluehill_french():
    return [
        "Tableau de résultats 1",
        ";Charge maximale;Epaisseur",
        ";(N);(mm)",
        "1;0,202;20,00",
        "Temps;Extension en compression;Charge de compression",
        "(s);(mm);(N)",
        *table([TIME, TRAVEL, FORCE], ";", ",", '"'),
    ]


def over_time():
    return [
        "Approach speed,5,mm/s",
        "Test speed,30,mm/min",
        "Time (s),Load (N)",
        *table([TIME, FORCE]),
    ]


def over_a_german_time():
    return [
        "Prüfgeschwindigkeit;0,5;mm/s",
        "Zeit [s];Kraft [N]",
        *table([TIME, FORCE], ";", ","),
    ]


def two_specimens_with_thickness():
    """Two records below a table of results that has a column of the thickness."""
    table_of_results = [
        '"Results Table 1"',
        '"","Specimen label","Thickness","Maximum Load"',
        '"","","(mm)","(N)"',
        '"1","a","20.0","0.2"',
        '"2","b","10.0","0.4"',
        '"Mean","","15.0","0.3"',
    ]
    return table_of_results + bluehill_english(specimens=2)[4:]


NOT_IN_CP1252 = [
    (["時間,ストローク,試験力", "sec,mm,N"], "cp932", "Shift-JIS"),
    (["试验日期,2026", "时间(s),位移(mm),力(N)"], "gb18030", "GB18030"),
    (["Czas [s],Przemieszczenie [mm],Siła [N]"], "cp1250", "CP1250"),
]

EXPORTS = [
    bluehill_french,
    over_time,
    over_a_german_time,
    bluehill_english,
    bluehill_german,
    zwick,
    exponent,
    mts,
    shimadzu,
    plain_columns,
    inches_and_pounds,
    kilograms,
    blanks,
]


@pytest.fixture
def write(tmp_path):
    def write(lines, encoding="utf-8", end="\n", name="record.csv"):
        file = tmp_path / name
        file.write_bytes(end.join([*lines, ""]).encode(encoding))
        return file

    return write


def same(record, factor=1.0):
    np.testing.assert_allclose(record.displacement, scaled(TRAVEL, 1e-3), atol=1e-9)
    np.testing.assert_allclose(record.force, scaled(FORCE, factor), atol=1e-6)


@pytest.mark.parametrize("export", EXPORTS)
@pytest.mark.parametrize(
    "encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "cp1252"]
)
def test_every_export_in_every_encoding(write, export, encoding):
    record = read_record(write(export(), encoding, "\r\n"))
    same(record)
    assert f"{N} rows from line" in record.understood
    assert "\n" not in record.understood


@pytest.mark.parametrize(("header", "encoding", "name"), NOT_IN_CP1252)
def test_encodings_told_by_a_word(write, header, encoding, name):
    record = read_record(write([*header, *table([TIME, TRAVEL, FORCE])], encoding))
    same(record)
    assert f"; {name}, commas" in record.understood


def test_thickness_of_each_specimen_from_the_results(write):
    records = read_records(write(two_specimens_with_thickness()))
    assert [one.thickness for one in records] == [0.02, 0.01]
    assert "thickness 10 mm (line 5)" in records[1].understood
    assert read_record(write(bluehill_french())).thickness == 0.02
    unknown = [line.replace("(mm)", "(px)", 1) for line in two_specimens_with_thickness()[:6]]
    with pytest.raises(InputError, match="a thickness in no unit of length"):
        read_records(write([*unknown, *plain_columns()]))


def test_travel_from_time_and_speed(write):
    record = read_record(write(over_time()))
    assert "displacement from time at 0.5 mm/s (line 2)" in record.understood
    same(read_record(write(over_time()[2:]), speed=5e-4))
    clock = ["Time (s),Load (N),Heat (C)", *(f"10:00:{i:02d},{0.1 * i:.1f},20" for i in range(N))]
    for lines, options, reason in (
        (over_time()[2:], {}, "give the speed of the cut with --speed"),
        (["Speed,1,mm/s", *over_time()], {}, "two speeds (1 mm/s in line 1, 0.5 mm/s in line 3)"),
        (clock, {"speed": 1e-3}, "the time is no plain number of seconds"),
        (over_time(), {"speed": 0.0}, "speed must be"),
    ):
        with pytest.raises(InputError) as caught:
            read_record(write(lines), **options)
        assert reason in str(caught.value)


def test_records_on_several_sheets(tmp_path):
    openpyxl = pytest.importorskip("openpyxl")
    book = openpyxl.Workbook()
    book.active.append(("Probendicke", 20, "mm"))
    for factor in (1, 2):
        sheet = book.create_sheet(f"Probe {factor}")
        for row in (("Standardweg", "Standardkraft"), ("mm", "N")):
            sheet.append(row)
        for row in zip(TRAVEL, scaled(FORCE, factor), strict=True):
            sheet.append(row)
    book.save(tmp_path / "zwick.xlsx")
    for factor, record in enumerate(read_records(tmp_path / "zwick.xlsx"), start=1):
        same(record, factor)
        assert (record.thickness, record.specimen) == (0.02, factor)
        assert f"sheet 'Probe {factor}'" in record.understood


@pytest.mark.parametrize("export", [bluehill_german, zwick])
def test_thickness_is_taken_from_the_lines_before(write, export):
    record = read_record(write(export()))
    assert record.thickness == 0.02
    assert "thickness 20 mm (line 2)" in record.understood
    assert read_record(write(plain_columns())).thickness is None


def test_what_was_understood_in_one_line(write):
    file = write(bluehill_german())
    assert read_record(file).understood == (
        f"{file}, specimen 1: time from 'Zeit' in s; displacement from 'Traversenweg' in mm; "
        f"force from 'Last' in kN; compression negative, turned; {N} rows from line 7; "
        "thickness 20 mm (line 2); UTF-8, semicolons, decimal comma"
    )


@pytest.mark.parametrize(
    "lines", [bluehill_english(specimens=2), exponent_side_by_side()], ids=["below", "beside"]
)
def test_several_specimens_in_one_file(write, lines):
    file = write(lines)
    records = read_records(file)
    assert [one.specimen for one in records] == [1, 2]
    for factor, record in enumerate(records, start=1):
        same(record, factor)
    same(read_record(file, 2), 2.0)
    with pytest.raises(InputError, match="holds 2 records; say which with specimen=1 to 2"):
        read_record(file)
    with pytest.raises(InputError, match="specimen 3 was asked for"):
        read_record(file, 3)


def test_specimens_side_by_side_of_different_length(write):
    lines = exponent_side_by_side()
    for i in range(30, len(lines)):
        lines[i] = "\t".join([*lines[i].split("\t")[:3], "", "", ""])
    long, short = read_records(write(lines))
    assert (len(long.force), len(short.force)) == (N, 28)
    assert not short.notes


def test_withdrawal_is_left_out_and_named(write):
    travel, force = [*TRAVEL, *TRAVEL[::-1]], [*FORCE, *scaled(FORCE, 0.1)]
    record = read_record(write(["displacement_mm,force_N", *table([travel, force])]))
    same(record)
    assert f"{N} rows after the farthest travel are left out" in record.notes[0]


def test_a_gap_is_skipped_and_named(write):
    lines = plain_columns()
    lines[5] = lines[5].split(",")[0] + ","
    record = read_record(write(lines))
    assert len(record.force) == N - 1


def test_columns_named_by_the_caller(write):
    rows = table([TIME, TRAVEL, FORCE])
    same(read_record(write(rows), columns="time_s,displacement_mm,force_N"))
    two = ["Extension (mm),Load 1 cell (N),Extension gauge (mm),Load (N)", *rows]
    with pytest.raises(InputError, match="name no force, or neither a disp"):
        read_record(write(two), columns="time_s,-,-")


@pytest.mark.parametrize(("begin", "sign"), [(0.0, 1.0), (100.0, 1.0), (100.0, -1.0)])
def test_channels_that_tell_the_same_travel_are_read_once(write, begin, sign):
    names = "Standardweg [mm],Traversenweg absolut [mm],Kraft [N]"
    second = [begin + sign * one for one in TRAVEL]
    record = read_record(write([names, *table([TRAVEL, second, FORCE])]))
    np.testing.assert_allclose(record.displacement, scaled(TRAVEL, 1e-3), atol=1e-9)
    assert "displacement from 'Standardweg [mm]'" in record.understood
    with pytest.raises(InputError, match="several columns of displacement"):
        read_record(write([names, *table([TRAVEL, scaled(TRAVEL, 0.99), FORCE])]))


@pytest.mark.parametrize(
    ("lines", "options", "says"),
    [
        (table([TRAVEL, FORCE]), {}, "--columns"),
        (["Extension,Load", *table([TRAVEL, FORCE])], {}, "has no unit"),
        (["Extension (mm),Load (oz)", *table([TRAVEL, FORCE])], {}, "a unit of force"),
        (
            ["Extension (mm),Crosshead (mm),Load (N)", *table([TRAVEL, FORCE, FORCE])],
            {},
            "several columns of displacement: column 1 (Extension (mm)) and column 2",
        ),
        (
            ["Extension (mm);Load (N)", *(f"{i + 1},000;{i + 1},100" for i in range(30))],
            {},
            "--decimal",
        ),
        (plain_columns(), {"sign": "up"}, "sign 'up' is not known"),
        (["displacement_mm,force_N", *table([[1.0] * N, FORCE])], {}, "nothing was cut"),
        (
            [
                "displacement_mm,force_N",
                *table([TRAVEL, [0.2 * (-1) ** (i // 9) for i in range(N)]]),
            ],
            {},
            "--sign positive or --sign negative",
        ),
        (
            ["Thickness,20,mm", "Thickness,10,mm", *plain_columns()],
            {},
            "two thicknesses (20 mm in line 1, 10 mm in line 2)",
        ),
    ],
)
def test_what_is_not_understood_is_asked_for(write, lines, options, says):
    with pytest.raises(InputError) as caught:
        read_records(write(lines), **options)
    assert says in str(caught.value)


def test_the_sign_may_be_said(write):
    file = write(["displacement_mm,force_N", *table([TRAVEL, BOTH_WAYS])])
    assert read_record(file, sign="positive").force[0] == 0.2
    assert read_record(file, sign="negative").force[0] == -0.2


def test_a_load_cell_that_is_off(write):
    """Compression counts as negative, and the cell reads 0.05 N with nothing on it."""
    off = [0.05 - one for one in FORCE]
    record = read_record(write(["displacement_mm,force_N", *table([TRAVEL, off])]))
    np.testing.assert_allclose(record.force, np.array(FORCE) - 0.05, atol=1e-6)


def test_a_number_that_is_none_in_a_table(write):
    lines = plain_columns()
    lines[9] = lines[9].split(",")[0] + ",overload"
    with pytest.raises(InputError, match=r"line 10, column 2 .*'overload' is not a number"):
        read_record(write(lines))


def test_a_row_that_breaks_a_table(write):
    lines = plain_columns()
    lines[9] = "overload,overload"
    with pytest.raises(InputError, match="line 10 is no row of numbers, and yet such rows follow"):
        read_record(write(lines))


words = st.sampled_from(
    ["Extension", "Load (N)", "Weg [mm]", "Kraft", "(mm)", "(N)", "0,5", "1.5", "-2", "1,234", '"']
)
cells = words | st.text(alphabet='0123456789.,;-\t" eNm', max_size=6)
files = st.lists(st.lists(cells, max_size=4).map(";".join), max_size=12).map("\n".join)
any_file = settings(
    max_examples=300, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


@any_file
@given(st.one_of(files.map(str.encode), st.binary(max_size=200)))
def test_any_file_is_read_or_refused(tmp_path, content):
    file = tmp_path / "any.csv"
    file.write_bytes(content)
    try:
        records = read_records(file)
    except InputError:
        return
    for record in records:
        assert len(record.force) == len(record.displacement) >= 2
        assert np.all(np.isfinite(record.force))
        assert np.all(np.isfinite(record.displacement))


def test_a_load_cell_that_was_not_zeroed_leaves_the_sign_clear(tmp_path):
    file = tmp_path / "offset.csv"
    x = np.linspace(0.0, 10.0, 100)
    for offset in (1.0, -1.0):
        force = offset + np.sign(offset) * 0.1 * np.minimum(x, 1.0)
        rows = "\n".join(f"{a:.3f},{b:.4f}" for a, b in zip(x, force, strict=True))
        file.write_text(f"Extension (mm),Load (N)\n{rows}\n")
        assert read_record(file).force[-1] == pytest.approx(1.1)

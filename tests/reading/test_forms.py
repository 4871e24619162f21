"""Tables as laboratories write them: names put together of words, merged cells, remarks, gauges."""

import numpy as np
import pytest

from surrogate import read_measurements
from surrogate.errors import InputError
from surrogate.reading.words.phrases import is_scatter, record_phrase, table_phrase
from surrogate.reading.words.spelling import plain

DIAMETERS = [0.1, 0.2, 0.4, 0.8]
FORCES = [2.9, 4.7, 7.8, 13.7]
NEWTONS = [0.058, 0.094, 0.156, 0.274]
HEADER = "wire diameter (mm),F/T (N/m)\n"
PLAIN = HEADER + "".join(f"{d},{f}\n" for d, f in zip(DIAMETERS, FORCES, strict=True))


@pytest.fixture
def read(tmp_path):
    def read(text, encoding="utf-8", **options):
        file = tmp_path / "cuts.csv"
        file.write_bytes(text.encode(encoding))
        return read_measurements(file, **options)

    return read


def below(header, *columns, mark=",", decimal="."):
    rows = (mark.join(map(str, row)).replace(".", decimal) for row in zip(*columns, strict=True))
    return "\n".join([header, *rows, ""])


def same(cuts, repeats=1):
    np.testing.assert_allclose(2e3 * cuts.wire_radius, np.repeat(DIAMETERS, repeats), rtol=1e-12)
    np.testing.assert_allclose(cuts.force, np.repeat(FORCES, repeats), rtol=1e-12)


@pytest.mark.parametrize(
    ("header", "encoding"),
    [
        ("Draht-Ø [mm];Mittlere Schnittkraft [N];Dicke der Probe [mm]", "utf-8"),
        ("Durchm. Draht/mm;Schneidkraft/N;Probendicke/mm", "cp850"),
        ("Diamètre du fil (mm);Force de coupe (N);Épaisseur de l'échantillon (mm)", "mac_roman"),
        ("Ø fil (mm);Effort de coupe moyen (N);Épaisseur échantillon (mm)", "latin-1"),
        ("Diametro del filo [mm];Forza di taglio media [N];Spessore campione [mm]", "utf-8"),
        ("Diámetro del hilo (mm);Fuerza media de corte (N);Espesor de la muestra (mm)", "cp1252"),
        ("Diâmetro do fio (mm);Força de corte (N);Espessura da amostra (mm)", "utf-16"),
        ("Draaddiameter (mm);Snijkracht (N);Dikte monster (mm)", "utf-8"),
        ("Średnica drutu [mm];Siła cięcia [N];Grubość próbki [mm]", "cp1250"),
        ("Диаметр проволоки, мм;Сила резания, Н;Толщина образца, мм", "cp1251"),
        ("ワイヤー直径（mm）;切断荷重（Ｎ）;試料厚さ（mm）", "cp932"),
        ("線径(mm);切断力(N);試料厚(mm)", "euc_jp"),
        ("线径（mm）;切割力（N）;样品厚度（mm）", "gb18030"),
        ("와이어 직경 (mm);절단력 (N);두께 (mm)", "cp949"),
        ("2R (mm);F_c (N);T (mm)", "utf-8"),
        ("wire d (mm);steady-state cutting force (N);specimen thickness (mm)", "utf-8"),
    ],
)
def test_names_that_are_put_together(read, header, encoding):
    text = below(header, DIAMETERS, NEWTONS, [20] * 4, mark=";", decimal=",")
    same(read(text, encoding))


@pytest.mark.parametrize(
    "name",
    [
        *("wire length", "peak force", "max. force", "sample diameter", "gel radius", "wire 2 mm"),
        *("thickness std", "wire diameter std", "force time", "sample width", "Kraftsensor", "f s"),
    ],
)
def test_what_is_close_to_a_name_and_none(name):
    assert table_phrase(plain(name)).quantity == ""


@pytest.mark.parametrize(
    ("name", "quantity"),
    [("Kompressionslast", "force"), ("Crosshead travel (corrected)", "displacement")],
)
def test_names_in_records(name, quantity):
    assert record_phrase(plain(name)).quantity == quantity
    assert record_phrase("peak load").quantity == record_phrase("travel time").quantity == ""


@pytest.mark.parametrize("unit", ["mil", "nm", "мкм", "µm"])
def test_units_of_length(read, unit):
    size = {"mil": 1 / 25.4e-3, "nm": 1e6, "мкм": 1e3, "µm": 1e3}[unit]
    same(read(below(f"d ({unit}),F/T (N/m)", [size * d for d in DIAMETERS], FORCES)))


def test_the_american_wire_gauge(read):
    numbers = [38, 34, 30, 26]
    cuts = read(below("Wire (AWG),F/T (N/m)", numbers, FORCES))
    # The table of ASTM B258, in mils with two or three digits.
    np.testing.assert_allclose(2 * cuts.wire_radius / 25.4e-6, [3.97, 6.30, 10.0, 15.9], rtol=4e-3)
    assert "38 is 100.7 um" in " ".join(cuts.notes)
    with pytest.raises(InputError, match=r"line 3, column 1 .*'0\.2' is no number of the American"):
        read(below("AWG,F/T (N/m)", [38, 0.2], FORCES[:2]))
    with pytest.raises(InputError, match="a gauge is no length by itself"):
        read(below("wire gauge,F/T (N/m)", numbers, FORCES))


@pytest.mark.parametrize(
    "names",
    [
        "1st cut (N/m),2nd cut (N/m)",
        "F/T trial A (N/m),F/T trial B (N/m)",
        "essai n°1 (N/m),essai n°2 (N/m)",
    ],
)
def test_trials_by_other_names(read, names):
    same(read(below("d (mm)," + names, DIAMETERS, FORCES, FORCES)), repeats=2)


def test_one_name_above_several_trials(read):
    names = "wire diameter (mm),force per thickness (N/m),,,\n,1,2,mean,SD\n"
    rows = "".join(f"{d},{f},{f},{f},0.1\n" for d, f in zip(DIAMETERS, FORCES, strict=True))
    cuts = read(names + rows)
    same(cuts, repeats=2)
    assert "line 2 is taken for the numbers of trials" in cuts.notes[0]
    with pytest.raises(InputError, match="'gel A' stands below 'force per thickness"):
        read(names.replace(",1,2", ",gel A,gel B") + rows)


def test_a_wire_in_the_first_of_its_lines(read):
    cuts = read(HEADER + "0.1,2.9\n,3.0\n,2.8\n0.2,4.7\n,4.8\n0.4,7.8\n")
    assert (2e3 * cuts.wire_radius).tolist() == [0.1, 0.1, 0.1, 0.2, 0.2, 0.4]
    assert cuts.force.tolist() == [2.9, 3.0, 2.8, 4.7, 4.8, 7.8]
    assert "merged cells: the wire of line 3, 4, 6 is" in cuts.notes[0]
    means = read(HEADER + "0.1,2.9\n0.1,3.1\n,3.0\n0.2,4.7\n0.2,4.9\n,4.8\n")
    assert means.force.tolist() == [2.9, 3.1, 4.7, 4.9]
    assert read(PLAIN + ",29.1\n").force.tolist() == FORCES


@pytest.mark.parametrize(
    "line", ["* the third sample was torn", "Note: cut at 0.5 mm/s, 20 °C", "// end", "Total,40.4"]
)
def test_remarks_below_a_table(read, line):
    cuts = read(PLAIN + line + "\n")
    same(cuts)
    assert "line 6" in cuts.notes[0]


@pytest.mark.parametrize("more", [HEADER, "gel B\n" + HEADER, "speed (mm/s),F (N)\n"])
def test_a_second_table_is_not_taken_for_the_first(read, more):
    with pytest.raises(InputError, match=r"line [67] begins another table"):
        read(PLAIN + more + "0.1,0.2\n")


def test_errors_without_a_unit_and_in_percent(read):
    std = [0.02 * one for one in FORCES]
    cuts = read(below("d (mm),F/T (N/m),SEM", DIAMETERS, FORCES, std))
    np.testing.assert_allclose(cuts.force_std, std)
    assert "taken in that of F/T (N/m)" in " ".join(cuts.notes)
    cuts = read(below("d (mm),F/T (N/m),error (%)", DIAMETERS, FORCES, [2] * 4))
    np.testing.assert_allclose(cuts.force_std, std)
    cuts = read(below("d (mm),F/T (N/m),CV (%),n", DIAMETERS, FORCES, [4] * 4, [4] * 4))
    np.testing.assert_allclose(cuts.force_std, std)


def test_scatter_in_other_languages_is_divided_by_the_number_of_cuts(read):
    cuts = read(below("d (mm),F/T (N/m),dev. std. (N/m),n", DIAMETERS, FORCES, [0.4] * 4, [4] * 4))
    np.testing.assert_allclose(cuts.force_std, 0.2)
    assert is_scatter("Desv. est.")
    assert not is_scatter("errore standard")


@pytest.mark.parametrize(
    "text",
    [
        PLAIN.replace("wire diameter (mm),F/T (N/m)", '"wire diameter\n(mm)","F/T\n(N/m)"'),
        PLAIN.replace(",", "   "),
        PLAIN.replace(",", " "),
        "|"
        + PLAIN.replace(",", "|").replace("\n", "|\n|").replace("(N/m)|\n", "(N/m)|\n|--|:-:|\n"),
        PLAIN.replace("(", "（").replace(")", "）"),
        PLAIN.replace("F/T (N/m)", "F_ss/T / (N/m)"),
        PLAIN.replace("wire diameter (mm)", "wire_diameter:mm"),
    ],
)
def test_lines_of_other_forms(read, text):
    same(read(text.removesuffix("|")))


@pytest.mark.parametrize("blank", [" ", "\xa0", "\u202f"])
def test_blanks_between_thousands_before_a_decimal_comma(read, blank):
    rows = f"100;1{blank}058,5;20\n1{blank}000;3{blank}274,0;20\n"
    cuts = read("wire diameter (um);force (mN);thickness (mm)\n" + rows)
    np.testing.assert_allclose(2 * cuts.wire_radius, [1e-4, 1e-3])
    np.testing.assert_allclose(cuts.force, [1.0585 / 0.02, 3.274 / 0.02])


def test_cells_of_several_units_are_refused(read):
    with pytest.raises(InputError, match=r"\(F/T\) has cells of several units \(N/m, mN/m"):
        read("d (mm),F/T\n0.1,2900 mN/m\n0.2,4.7 N/m\n")


def test_what_may_be_the_missing_thickness_is_named(read):
    with pytest.raises(InputError, match=r"thickness_mm \(not used: column 3 \(width \(mm\)\)\)"):
        read("d (mm),F (N),width (mm)\n0.1,0.1,20\n")


def test_a_picture_is_no_table(tmp_path):
    file = tmp_path / "cuts.csv"
    file.write_bytes(np.random.default_rng(1).bytes(20_000))
    with pytest.raises(InputError, match=r"cuts\.csv is no text .* export the table as CSV"):
        read_measurements(file)

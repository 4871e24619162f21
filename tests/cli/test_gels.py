"""`wirecut identify` with several gels: one table, one figure, and which of them differ."""

import csv
import json
import shlex

import numpy as np
import pytest

from surrogate import Scene, cutting_force
from surrogate.cli.main import main

RADII = np.repeat([0.05, 0.1, 0.2, 0.3, 0.4], 2)
SCATTER = np.array([1.02, 0.98, 1.01, 0.99, 1.03, 0.97, 0.98, 1.01, 1.01, 0.99])


def forces(gamma, tau=12e3, mu=30e3):
    scene = Scene(mu, gamma, 1e-3 * RADII, wear_strength=tau)
    return np.asarray(cutting_force(scene, "table").total) * SCATTER


GELS = {"soft": forces(2.0), "tough": forces(4.0), "other": forces(2.02) * SCATTER[::-1]}


def rows(force, thickness=None):
    unit = "force_per_thickness_N_per_m" if thickness is None else "force_mN"
    factor = 1.0 if thickness is None else 1e3 * thickness
    lines = [f"{r},{factor * f:.5f}" for r, f in zip(RADII, force, strict=True)]
    return "\n".join([f"wire_radius_mm,{unit}", *lines]) + "\n"


@pytest.fixture
def lab(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name, force in GELS.items():
        (tmp_path / f"{name}.csv").write_text(rows(force))
    (tmp_path / "falling.csv").write_text(rows(GELS["soft"][::-1]))
    return tmp_path


@pytest.fixture
def run(lab, capsys):
    def run(command):
        code = main(["identify", *shlex.split(command)])
        out, err = capsys.readouterr()
        return code, out, err

    return run


def test_a_row_a_gel_and_a_sentence_a_pair(run):
    code, out, _ = run("soft.csv tough.csv other.csv --shear-modulus 30kPa")
    assert code == 0
    names = [line.split()[0] for line in out.splitlines()[:4]]
    assert names == ["Gel", "soft", "tough", "other"]
    assert "\nsoft and tough differ (p" in out
    assert "\nsoft and other are not told apart (p" in out
    assert "\ntough and other differ (p" in out
    assert "Holm's correction for 3 pairs" in " ".join(out.split())
    assert "With 95 % intervals, model table, law projected." in out


def test_the_numbers_are_those_of_single_files(run):
    record = json.loads(run("soft.csv tough.csv --shear-modulus 30kPa --json")[1])
    for name in ("soft", "tough"):
        alone = json.loads(run(f"{name}.csv --shear-modulus 30kPa --json")[1])
        for key in ("toughness", "toughness_interval", "wear_strength", "answer", "wires"):
            assert record["gels"][name][key] == alone[key]
    (pair,) = record["comparisons"]
    apart = record["gels"]["soft"]["toughness"] - record["gels"]["tough"]["toughness"]
    assert pair["toughness"]["value"] == pytest.approx(apart)
    assert pair["differ"] is True
    assert pair["toughness"]["differs"] is True
    assert pair["wear_strength"]["differs"] is False


def test_one_figure_and_one_table(run, lab):
    pytest.importorskip("matplotlib")
    code, out, _ = run("soft.csv tough.csv --shear-modulus 30kPa --plot g.svg --csv g.csv")
    assert code == 0
    assert "Written: g.svg, g.csv" in out
    picture = (lab / "g.svg").read_text()
    assert ">soft<" in picture
    assert ">tough<" in picture
    lines = [line for line in (lab / "g.csv").read_text().splitlines() if line[0] != "#"]
    soft, tough = csv.DictReader(lines)
    assert (soft["gel"], soft["file"], soft["cuts"], soft["usable"]) == (
        "soft",
        "soft.csv",
        "10",
        "yes",
    )
    low, value, high = (float(tough[f"toughness{part}_J_per_m2"]) for part in ("_low", "", "_high"))
    assert low < 4.0 < high
    assert low < value < high


def test_what_should_not_be_used_is_neither_shown_nor_compared(run, lab):
    command = "soft.csv falling.csv tough.csv --shear-modulus 30kPa --csv g.csv"
    code, out, _ = run(command)
    assert code == 3
    assert out.startswith("Do not use the numbers of falling: ")
    assert "\nfalling  not to be used" in out
    assert "soft and falling are not compared: falling should not be used (" in " ".join(
        out.split()
    )
    assert "\nsoft and tough differ (p" in out
    lines = [line for line in (lab / "g.csv").read_text().splitlines() if line[0] != "#"]
    row = list(csv.DictReader(lines))[1]
    assert (row["usable"], row["toughness_J_per_m2"], row["wear_strength_Pa"]) == ("no", "", "")
    assert row["doubts"]
    code, out, _ = run(f"{command} --json")
    pairs = json.loads(out)["comparisons"]
    assert code == 3
    assert [pair["p"] is None for pair in pairs] == [True, False, True]
    assert [pair["differ"] for pair in pairs] == [None, True, None]


def test_options_of_the_material_are_given_once_or_for_each(run, lab):
    for name, modulus in (("soft", 30), ("tough", 20)):
        properties = {"schema": "wirecut-material-1", "shear_modulus_kPa": modulus}
        (lab / f"{name}.json").write_text(json.dumps(properties))
    record = json.loads(
        run("soft.csv tough.csv --material soft.json --material tough.json --json")[1]
    )
    assert [gel["shear_modulus"] for gel in record["gels"].values()] == [30e3, 20e3]
    each = "--shear-modulus 30kPa --shear-modulus 20kPa --friction-coefficient 0.1"
    record = json.loads(run(f"soft.csv tough.csv {each} --json")[1])
    assert [gel["shear_modulus"] for gel in record["gels"].values()] == [30e3, 20e3]
    assert [gel["friction_coefficient"] for gel in record["gels"].values()] == [0.1, 0.1]
    (lab / "thick.csv").write_text(rows(GELS["tough"], 0.02))
    (lab / "thin.csv").write_text(rows(GELS["soft"], 0.01))
    thick = "thin.csv thick.csv --shear-modulus 30kPa --thickness 10mm --thickness 20mm"
    record = json.loads(run(f"{thick} --json")[1])
    plain = json.loads(run("soft.csv tough.csv --shear-modulus 30kPa --json")[1])
    for one, other in (("thin", "soft"), ("thick", "tough")):
        expected = plain["gels"][other]["toughness"]
        assert record["gels"][one]["toughness"] == pytest.approx(expected, rel=1e-3)


def test_one_table_may_hold_several_gels(run, lab):
    lines = ["gel;sample;d (mm);F/T (N/m)"]
    for name in ("soft", "tough"):
        lines += [
            f"PAAm {name};{i % 2};{2 * r};{f:.4f}"
            for i, (r, f) in enumerate(zip(RADII, GELS[name], strict=True))
        ]
    (lab / "all.csv").write_text("\n".join(lines))
    code, out, _ = run("all.csv --by Gel --shear-modulus 30kPa --json")
    record = json.loads(out)
    assert code == 0
    assert list(record["gels"]) == ["PAAm soft", "PAAm tough"]
    assert all(len(gel["wires"]) == 10 for gel in record["gels"].values())
    each = "--shear-modulus 30kPa --shear-modulus 20kPa"
    record = json.loads(run(f"all.csv --by gel {each} --json")[1])
    assert [gel["shear_modulus"] for gel in record["gels"].values()] == [30e3, 20e3]
    code, _, err = run("all.csv --by mixture --shear-modulus 30kPa")
    assert code == 2
    assert "has no column 'mixture'; name one of gel, sample, d (mm), F/T (N/m) by --by" in err
    assert "Python" not in err


def test_a_table_of_several_gels_is_not_taken_for_one_without_a_word(run, lab):
    lines = ["gel,wire_radius_mm,force_per_thickness_N_per_m"]
    lines += [
        f"{n},{r},{f:.4f}" for n in ("A", "B") for r, f in zip(RADII, GELS["soft"], strict=True)
    ]
    (lab / "all.csv").write_text("\n".join(lines))
    _, _, err = run("all.csv --shear-modulus 30kPa")
    assert (
        "2 samples of one gel together: A, B; where each is a gel of its own, say so by --by" in err
    )
    lines[3] = "," + lines[3].partition(",")[2]
    (lab / "merged.csv").write_text("\n".join(lines))
    code, _, err = run("merged.csv --by gel --shear-modulus 30kPa")
    assert code == 2
    assert "line 4, column 1 (gel) is empty; write the name of the gel in each line" in err


def test_folders_of_records_are_gels(run, lab):
    for name, factor in (("soft", 1.0), ("tough", 1.5)):
        (lab / name).mkdir()
        for i, (radius, force) in enumerate(zip(RADII, GELS["soft"], strict=True)):
            table = [
                f"{0.1 * k:.1f},{0.01 * factor * force * min(k / 50, 1) + 1e-4 * (k % 3):.5f}"
                for k in range(200)
            ]
            file = lab / name / f"wire_{2 * radius:.1f}mm_{i % 2}.csv"
            file.write_text("\n".join(["displacement_mm,force_N", *table]))
    options = "--shear-modulus 30kPa --thickness 10mm --name 'wire_{diameter}mm_{trial}'"
    code, out, _ = run(f"soft tough {options} --json")
    assert code == 0
    assert json.loads(out)["comparisons"][0]["differ"] is True


@pytest.mark.parametrize(
    ("command", "words"),
    [
        ("soft.csv soft.csv --shear-modulus 30kPa", "soft (soft.csv) is given twice"),
        ("soft.csv tough.csv", "soft: the shear modulus is missing; give --shear-modulus"),
        ("soft.csv none.csv --shear-modulus 30kPa", "none.csv cannot be read"),
        (
            "soft.csv tough.csv other.csv --shear-modulus 1kPa --shear-modulus 2kPa",
            "--shear-modulus is given 2 times for 3 gels; give it once for all, or for each",
        ),
        (
            "soft.csv --shear-modulus 1kPa --shear-modulus 2kPa",
            "--shear-modulus is given 2 times for 1 gel; give it once.",
        ),
        ("soft.csv tough.csv --shear-modulus 30kPa --csv tough.csv", "tough.csv"),
        ("soft.csv tough.csv --shear-modulus 30kPa --plot g.doc", "g.doc has no picture's ending"),
        ("soft.csv --by gel --shear-modulus 30kPa", "has no column 'gel'"),
        ("--example --by gel", "--example is one gel of its own; leave out --by"),
    ],
)
def test_what_does_not_go_is_refused_in_one_line(command, words, run, lab):
    before = (lab / "tough.csv").read_text()
    code, out, err = run(command)
    assert (code, out) == (2, "")
    assert words in err.splitlines()[-1]
    assert (lab / "tough.csv").read_text() == before


def test_verbose_prints_all_tables_of_each(run):
    out = run("soft.csv tough.csv --shear-modulus 30kPa --verbose")[1]
    assert out.count("\nIdentified (table)") == 2
    assert out.count("\nTransition radius R_w*") == 2


def test_gels_of_which_one_is_beyond_coupled_solutions_are_all_by_the_papers_law(run, lab):
    radius = np.repeat([0.1, 0.15, 0.2, 0.3, 0.4], 2)
    for name, wear in (("gentle", 5.0), ("harsh", 5e5)):
        scene = Scene(30e3, 5.0, 1e-3 * radius, wear_strength=wear, stiffening_exponent=5.0)
        force = np.asarray(cutting_force(scene, "table", law="slip").total) * SCATTER
        lines = [f"{r},{f:.5f}" for r, f in zip(radius, force, strict=True)]
        header = "wire_radius_mm,force_per_thickness_N_per_m"
        (lab / f"{name}.csv").write_text("\n".join([header, *lines]) + "\n")
    gel = "--shear-modulus 30kPa --stiffening-exponent 5"
    for name, law in (("gentle", "coupled"), ("harsh", "projected")):
        _, out, _ = run(f"{name}.csv {gel} --json")
        assert json.loads(out)["law"] == law
    _, out, _ = run(f"gentle.csv harsh.csv {gel} --json")
    record = json.loads(out)
    assert record["law"] == "projected"
    for gel_record in record["gels"].values():
        assert gel_record["law"] == "projected"
        assert gel_record["law_reason"].startswith("one law for all gels, and of harsh coupled")
    code, _, err = run(f"gentle.csv harsh.csv {gel} --law coupled")
    assert code == 2
    assert err.startswith("wirecut: harsh: coupled solutions do not reach")
    assert "--law slip" in err


def test_pairs_are_written_beside_the_gels(run, lab):
    code, out, _ = run("soft.csv tough.csv falling.csv --shear-modulus 30kPa --csv gels.csv --json")
    record = json.loads(out)
    assert code == 3
    assert record["written"] == ["gels.csv", "gels-pairs.csv"]
    lines = [x for x in (lab / "gels-pairs.csv").read_text().splitlines() if x[0] != "#"]
    first, *others = csv.DictReader(lines)
    pair = record["comparisons"][0]
    assert (first["first"], first["second"], first["differ"]) == ("soft", "tough", "yes")
    assert float(first["toughness_difference_J_per_m2"]) == pair["toughness"]["value"]
    assert float(first["wear_strength_high_Pa"]) == pair["wear_strength"]["interval"][1]
    assert float(first["p_adjusted"]) == pair["p_adjusted"]
    for other in others:
        assert other["differ"] == other["p"] == other["toughness_low_J_per_m2"] == ""
        assert "falling should not be used" in other["not_compared"]
    (lab / "gels-pairs.csv").write_text((lab / "soft.csv").read_text())
    code, _, err = run("gels-pairs.csv tough.csv --shear-modulus 30kPa --csv gels.csv")
    assert code == 2
    assert "gels-pairs.csv" in err

"""The engine's own studies: what they solve, what they find, and that nothing is solved twice."""

import dataclasses
import json
import math
import re
import shlex
import subprocess
import sys

import numpy as np
import pytest

from fe_training import __main__ as command
from fe_training.__main__ import main
from fe_training.mechanics.analytic import far_field_wedge
from fe_training.solver import solve as engine
from fe_training.solver.cut import Settings
from fe_training.solver.record import EVIDENCE_BOUND, Outcome, Record
from fe_training.verification import figures as verify_figures
from fe_training.verification import report as verify_report
from fe_training.verification import run as verify_run
from fe_training.verification import studies as verify
from fe_training.verification.cases import STUDIES, Case, Solved, cases_of, full_scope, quick_scope
from fe_training.verification.studies import judged
from surrogate.errors import InputError

#: Factor of sqrt(g R_w/L), relative difference of J between meshes, that the fake engine has.
FACTOR, MESH_ERROR = 0.2, 8e-4


def fake(alpha, g, settings, left=0.0, **changes):
    """Return a record that obeys simple laws of g, of the mesh and of the body's radius.

    J misses the wanted one by the relative difference `left`.
    """
    J = g * (1.0 + left)
    error = MESH_ERROR * (28 / settings.sectors) ** 2
    values = {
        "target": g,
        "energy_release_rate": J,
        "distance": (J / (1.0 + error)) ** -0.5,
        "horizontal_force": 0.5 * J * (1.0 + 1e-4),
        "vertical_force": 2.0 * J**0.3 * (1.0 - FACTOR * math.sqrt(J / settings.outer_radius)),
        "theta_1": 0.5,
        "theta_2": 2.0,
        "energy_release_rate_across": (J * (1.0 + 1e-5), J),
        "energy_release_rate_shift": J * (1.0 + 1e-3),
        "mesh": {"sectors": np.int64(settings.sectors)},
        "wall_time": 1.0,
    }
    return Record(alpha, **{"outcome": Outcome.CONVERGED, **values, **changes})


def stalled(alpha, g):
    return Record(alpha, Outcome.STALLED, target=g, reason="no equilibrium | at 3 (diverged)")


class FakeEngine:
    """Stands for `solve_path` and `solve`; remembers what it was asked for."""

    def __init__(self):
        self.asked = []
        self.instead = {}  # by g: a record, or an exception to raise

    def solve_path(self, alpha, gs, settings, report, shift=False):
        for g in sorted(gs):
            self.asked.append((alpha, g, settings))
            other = self.instead.get(g)
            if isinstance(other, BaseException):
                raise other
            report(other or fake(alpha, g, settings))

    def solve(self, alpha, *, distance, settings, shift=False):
        self.asked.append((alpha, distance, settings))
        wedge = far_field_wedge(distance)
        return Record(
            alpha,
            Outcome.CONVERGED,
            energy_release_rate=wedge.energy_release_rate,
            distance=distance,
            vertical_force=wedge.vertical_force,
            theta_1=math.acos(0.5 * wedge.contact_width),
            theta_2=math.acos(-0.5 * wedge.contact_width),
        )


@pytest.fixture
def fakes(monkeypatch):
    """Return a fake engine that is in the place of the engine."""
    fakes = FakeEngine()
    monkeypatch.setattr(engine, "solve_path", fakes.solve_path)
    monkeypatch.setattr(engine, "solve", fakes.solve)
    return fakes


@pytest.fixture
def no_figures(monkeypatch):
    monkeypatch.setattr(verify_report, "draw_study", lambda folder, result: [])


def solutions(studies, scope, of=fake):
    """Return what an engine would give for the cases of studies."""
    return {
        case.key: Solved(of(case.alpha, case.g, case.settings))
        for case in cases_of(studies, scope)
        if case.g is not None
    }


@pytest.mark.parametrize("scope", [full_scope(), quick_scope()])
@pytest.mark.parametrize("study", ["mesh", "truncation", "contact", "parameters"])
def test_the_references_of_a_comparison_are_cases_of_the_range(study, scope):
    references = {case for case in cases_of([study], scope) if case.study != study}
    assert references
    assert references <= set(cases_of(["range"], scope))


def test_the_full_studies_cover_the_range():
    scope = full_scope()
    inside = [c for c in cases_of(["range"], scope) if 2 <= c.alpha <= 9 and c.g <= 100]
    assert min(c.g for c in inside) == 2.5e-3
    assert max(c.g for c in inside) == 100
    assert len(inside) == 4 * 9
    assert all(
        set(gs) <= set(scope.gs) for gs in (scope.mesh_gs, scope.compared_gs, scope.parameter_gs)
    )


def test_every_setting_makes_another_key():
    case = Case("mesh", 2.0, Settings(), g=1.0)
    keys = {case.key}
    for one in dataclasses.fields(Settings):
        value = getattr(case.settings, one.name)
        changed = {one.name: "scipy" if value is None else 2 * value}
        other = dataclasses.replace(case.settings, **changed)
        keys.add(dataclasses.replace(case, settings=other).key)
    assert len(keys) == 1 + len(dataclasses.fields(Settings))


def test_values_of_one_path_are_one_task():
    tasks = verify_run.tasks_of(cases_of(["mesh"], full_scope().of([2.0])))
    assert len(tasks) == 4  # near and far, standard and fine
    assert sorted(len(task) for task in tasks) == [2, 2, 4, 4]


def test_other_exponents_than_those_of_the_studies():
    scope = full_scope().of([3.3, 12.0])
    assert {case.alpha for case in cases_of(["range"], scope)} == {3.3, 12.0}
    assert {case.alpha for case in cases_of(list(STUDIES)[1:], scope)} == {3.3}


def test_no_such_study_is_named():
    with pytest.raises(InputError, match="'ranges'"):
        cases_of(["ranges"], quick_scope())


@pytest.mark.usefixtures("no_figures")
def test_all_studies_of_an_engine_within_its_bounds(fakes, tmp_path, capsys):
    assert main(["verify", "--quick", "--out", str(tmp_path)]) == 0
    out, err = capsys.readouterr()
    count = len(cases_of(STUDIES, quick_scope()))
    assert len(fakes.asked) == count
    assert f"{count}/{count}" in err
    assert "FAIL" not in out
    written = {file.name for file in tmp_path.iterdir()}
    tables = {name + end for name in STUDIES for end in (".csv", ".md")}
    assert written == tables | {"records.jsonl", "summary.md", "verify.json"}
    content = json.loads((tmp_path / "verify.json").read_text(), parse_constant=pytest.fail)
    assert all(content["studies"][name]["passed"] for name in STUDIES)
    assert "Nothing failed" in (tmp_path / "summary.md").read_text()


@pytest.mark.usefixtures("no_figures")
def test_a_rerun_solves_nothing_and_writes_the_same_tables(fakes, tmp_path):
    run = ["verify", "--quick", "--out", str(tmp_path)]
    main(run)
    asked, table = len(fakes.asked), (tmp_path / "mesh.csv").read_bytes()
    (tmp_path / "mesh.csv").unlink()
    assert main(run) == 0
    assert len(fakes.asked) == asked
    assert (tmp_path / "mesh.csv").read_bytes() == table


@pytest.mark.usefixtures("no_figures")
def test_an_interrupted_run_goes_on_where_it_was(fakes, tmp_path):
    run = ["verify", "--quick", "--study", "mesh", "--out", str(tmp_path)]
    fakes.instead[2.0] = KeyboardInterrupt()
    assert main(run) == 130
    with (tmp_path / "records.jsonl").open("a") as stream:
        stream.write('{"case": {"study": "mesh", "al')  # torn by a kill
    fakes.instead.clear()
    fakes.asked.clear()
    assert main(run) == 0
    assert sorted(g for _, g, _ in fakes.asked) == [0.5, 2.0, 2.0]  # 0.5 of one path was kept


@pytest.mark.usefixtures("no_figures")
def test_what_was_not_reached_fails_with_its_reason(fakes, tmp_path, capsys):
    run = ["verify", "--quick", "--study", "range", "mesh", "--out", str(tmp_path)]
    fakes.instead[2.0] = stalled(5.0, 2.0)
    assert main(run) == 1
    page = (tmp_path / "summary.md").read_text()
    assert "- range, alpha = 5, g = 2: stalled; no equilibrium | at 3 (diverged)" in page
    assert "- mesh, fine, alpha = 5, g = 2: stalled; default: no equilibrium" in page
    table = (tmp_path / "range.md").read_text()
    assert r"no equilibrium \| at 3" in table
    assert "1 of 2 | FAIL" in capsys.readouterr().out
    fakes.instead.clear()
    fakes.asked.clear()
    assert main([*run, "--retry"]) == 0
    assert [g for _, g, _ in fakes.asked] == [2.0, 2.0]


@pytest.mark.usefixtures("no_figures")
def test_no_solve_makes_tables_of_what_there_is(fakes, tmp_path, capsys):
    run = ["verify", "--quick", "--out", str(tmp_path)]
    assert main([*run, "--study", "range"]) == 0
    fakes.asked.clear()
    assert main([*run, "--no-solve"]) == 1
    assert not fakes.asked
    assert "not solved" in (tmp_path / "mesh.csv").read_text()
    assert "incomplete" in (tmp_path / "summary.md").read_text()
    assert "FAIL" not in capsys.readouterr().out


def test_a_dry_run_says_how_much_there_is(fakes, tmp_path, capsys):
    assert main(["verify", "--dry-run", "--out", str(tmp_path / "new")]) == 0
    count = len(cases_of(STUDIES, full_scope()))
    assert f"{count} of {count} configurations" in capsys.readouterr().out
    assert not fakes.asked
    assert not (tmp_path / "new").exists()


def test_beyond_the_range_a_named_outcome_will_do_and_an_error_will_not(fakes, tmp_path):
    scope = dataclasses.replace(full_scope().of([12.0]), beyond_alpha_gs=(0.5, 1.0, 2.0))
    fakes.instead = {1.0: stalled(12.0, 1.0), 2.0: ArithmeticError("1 / 0\nsomewhere")}
    file = tmp_path / "records.jsonl"
    verify_run.solve_cases(cases_of(["range"], scope), file)
    result = judged("range", scope, verify_run.read_solved(file))
    assert [one.passed for one in result.findings] == [True, True, False]
    assert [one.outcome for one in result.findings] == ["converged", "stalled", "error"]
    assert result.findings[2].note.startswith("ArithmeticError: 1 / 0")


def test_errors_that_are_no_matter_of_a_case_end_the_run(fakes, tmp_path):
    fakes.instead[0.5] = InputError("alpha is wrong")
    file = tmp_path / "records.jsonl"
    with pytest.raises(InputError, match="alpha is wrong"):
        verify_run.solve_cases(cases_of(["range"], quick_scope()), file)
    assert not verify_run.read_solved(file)


def test_lines_give_back_the_record(tmp_path):
    case = Case("range", 5.0, Settings(), g=1.0)
    record = fake(5.0, 1.0, case.settings, pressure=np.ones(3))
    file = tmp_path / "records.jsonl"
    file.write_bytes(verify_run._line(case, record, error=False))
    found = verify_run.read_solved(file)[case.key]
    assert found.engine == verify_run.fingerprint()
    assert not len(found.record.pressure)
    assert math.isnan(found.record.strain_energy)
    for name in ("outcome", "target", "distance", "energy_release_rate_across", "mesh"):
        assert getattr(found.record, name) == getattr(record, name), name


def test_the_bound_of_the_force_balance_is_applied():
    scope = quick_scope()

    def off(alpha, g, settings):
        mismatch = 1.1 * EVIDENCE_BOUND if g > 1 else 0.9 * EVIDENCE_BOUND
        return fake(alpha, g, settings, horizontal_force=0.5 * g * (1 + mismatch))

    findings = judged("range", scope, solutions(["range"], scope, off)).findings
    assert [one.passed for one in findings] == [True, False]


def test_an_outcome_outside_the_evidence_fails_in_the_range():
    scope = quick_scope()

    def outside(alpha, g, settings):
        return fake(alpha, g, settings, outcome=Outcome.OUTSIDE_EVIDENCE)

    assert not judged("range", scope, solutions(["range"], scope, outside)).passed


def measures(finding):
    return {one.name: one.value for one in finding.measures}


def test_two_meshes_differ_in_J_at_equal_distance_as_they_were_made_to():
    scope = full_scope().of([2.0])
    expected = MESH_ERROR * (1 - (28 / scope.base.refined().sectors) ** 2)
    findings = judged("mesh", scope, solutions(["mesh"], scope)).findings
    assert [one.g for one in findings] == list(scope.mesh_gs)
    for one in findings:
        assert measures(one)["|dJ|/J at equal delta"] == pytest.approx(expected, rel=0.01)
        assert {m.name for m in one.measures if m.bound} == (
            {"|dB|/B", "|dA|", "|dJ|/J at equal delta"} if one.g <= 1 else {"|dB|/B", "|dA|"}
        )


def test_what_the_search_for_g_leaves_open_is_taken_out_of_B():
    """Off by 1e-3 in g, B would be off by 3e-4."""
    scope = full_scope().of([2.0])

    def unequal(alpha, g, settings):
        return fake(alpha, g, settings, left=1e-3 if settings == scope.base else -1e-3)

    for one in judged("mesh", scope, solutions(["mesh"], scope, unequal)).findings:
        assert measures(one)["|dB|/B"] < 1e-5


def test_the_factor_of_the_truncation_is_found():
    scope = full_scope()
    result = judged("truncation", scope, solutions(["truncation"], scope))
    assert result.facts["factor c, median"] == pytest.approx(FACTOR, rel=0.01)
    assert result.facts["factor c, largest"] == pytest.approx(FACTOR, rel=0.05)
    assert result.facts["exponent of g R_w/L, 0.5 in the law"] == pytest.approx(0.5, abs=0.01)
    assert result.passed


@pytest.mark.usefixtures("fakes")
def test_figures_without_warnings(tmp_path):
    run = ["verify", "--quick", "--study", "truncation", "--out", str(tmp_path)]
    assert main(run) == 0
    assert (tmp_path / "truncation.png").read_bytes().startswith(b"\x89PNG")
    assert (tmp_path / "truncation.pdf").read_bytes().startswith(b"%PDF")


def test_a_figure_marks_what_breaks_the_bound_and_what_was_not_reached():
    from matplotlib.figure import Figure

    scope = dataclasses.replace(quick_scope(), gs=(0.5, 1.0, 2.0))

    def mixed(alpha, g, settings):
        off = fake(alpha, g, settings, horizontal_force=0.6 * g)
        return {0.5: fake(alpha, g, settings), 1.0: off, 2.0: stalled(alpha, g)}[g]

    result = judged("range", scope, solutions(["range"], scope, mixed))
    ax = verify_figures.plot_measure(result, "|J-2F_h|/J", Figure().add_subplot())
    hollow = [x for line in ax.lines if line.get_mfc() == "white" for x in line.get_xdata()]
    crosses = [x for line in ax.lines if line.get_marker() == "x" for x in line.get_xdata()]
    assert hollow == [1.0]
    assert crosses == [2.0]
    assert "not reached" in [text.get_text() for text in ax.get_legend().texts]


BAD = [
    "verify --study ranges",
    "verify --alpha 0.5",
    "verify --alpha two",
    "verify --jobs 0",
    "verify --jobs 1.5",
    "verify --dry-run --no-solve",
    "verify --quick --out {file}/below",
]


@pytest.mark.parametrize("arguments", BAD)
@pytest.mark.usefixtures("fakes")
def test_bad_input_is_exit_code_2_and_one_line(arguments, tmp_path, capsys):
    file = tmp_path / "file"
    file.touch()
    assert main(shlex.split(arguments.format(file=file))) == 2
    assert re.fullmatch(r"fe_training: [^\n]+\n", capsys.readouterr().err)


def test_help_has_examples_that_the_parser_takes(capsys):
    with pytest.raises(SystemExit, match="0"):
        main(["verify", "--help"])
    text = capsys.readouterr().out
    examples = re.findall(r"^  python -m fe_training (verify .*)", text, re.MULTILINE)
    assert len(examples) == 4
    for example in examples:
        command._parser().parse_args(shlex.split(example))
    assert all(name in text for name in STUDIES)


def test_the_parser_knows_every_study():
    assert tuple(STUDIES) == command._STUDIES


def test_the_bounds_are_for_the_range_of_the_command():
    assert (verify.LOWEST_ALPHA, verify.HIGHEST_ALPHA, verify.LARGEST_G) == (2.0, 9.0, 100.0)


@pytest.mark.slow
def test_quick_studies_for_real(tmp_path):
    """On coarse meshes bounds may be broken, but all is reached; the far field is met."""
    run = [sys.executable, "-m", "fe_training", "verify", "--quick", "--jobs", "2"]
    process = subprocess.run(
        [*run, "--out", str(tmp_path)], capture_output=True, text=True, check=False
    )
    assert process.returncode in (0, 1), process.stderr
    solved = verify_run.read_solved(tmp_path / "records.jsonl")
    assert len(solved) == len(cases_of(STUDIES, quick_scope()))
    assert all(one.reached for one in solved.values())
    assert judged("checks", quick_scope(), solved).passed
    lines = verify_report.summary([judged(name, quick_scope(), solved) for name in STUDIES])
    loads = [line for line in lines if line.measure == "|dB|/B"]
    assert len(loads) == 4
    assert all(line.worst < 5e-3 for line in loads)

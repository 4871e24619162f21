"""The command: table, files, exit codes, complaints in one line."""

import json
import re
import shlex
import subprocess
import sys

import numpy as np
import pytest

from fe_training import __main__ as command
from fe_training.__main__ import main
from fe_training.solver import solve as solving
from fe_training.solver.cut import RESOLUTIONS
from fe_training.solver.record import Outcome, Record

ONE = ["solve", "--alpha", "9", "--g", "1", "--resolution", "coarse"]
REACHED = Record(
    5.0,
    Outcome.CONVERGED,
    energy_release_rate=0.8,
    distance=1.34,
    horizontal_force=0.4002,
    vertical_force=2.338,
    theta_1=0.5,
    theta_2=2.0,
    wall_time=1.5,
    pressure=np.array([0.5, 1.0]),
)
FAILED = Record(5.0, Outcome.STALLED, reason="no equilibrium at 1.3 (diverged)")


@pytest.fixture(scope="module")
def solved(tmp_path_factory):
    """Return the process of one coarse configuration, and the file of its record."""
    file = tmp_path_factory.mktemp("records") / "one.json"
    run = [sys.executable, "-m", "fe_training", *ONE, "--json", str(file)]
    return subprocess.run(run, capture_output=True, text=True, check=False), file


@pytest.fixture
def canned(monkeypatch):
    """Return a function that makes `solve_path` answer with given records."""

    def answer(*records):
        def solve_path(alpha, g, settings=None, report=None, shift=False, mesh_error=False):
            for record in records:
                if report:
                    report(record)
            return list(records)

        monkeypatch.setattr(solving, "solve_path", solve_path)

    return answer


def test_one_configuration_is_a_table_of_one_row(solved):
    process, _ = solved
    assert process.returncode == 0, process.stderr
    head, row = process.stdout.splitlines()
    assert head.split()[:5] == ["g", "delta/R_w", "A", "B", "|J-2F_h|/J"]
    g, delta, arc, load = (float(cell) for cell in row.split()[:4])
    assert g == pytest.approx(1.0, rel=1e-3)
    assert 1.0 < delta < 2.0
    assert 0.0 < arc < 2.0 < load


def test_the_json_file_has_the_record_with_its_profiles(solved):
    process, file = solved
    content = json.loads(file.read_text(), parse_constant=pytest.fail)
    (one,) = content["configurations"]
    assert one["wanted"] == {"g": 1.0}
    assert one["reached"] is True
    assert one["outcome"] in Outcome.__members__
    assert len(one["pressure"]) == len(one["pressure_angle"]) > 10
    assert one["energy_release_rate_shift"] is None  # nan
    printed = process.stdout.splitlines()[1].split()
    assert f"{one['distance']:.4f}" == printed[1]
    assert f"{one['arc']:.4f}" == printed[2]


def test_the_picture_shows_the_configuration_again(solved, tmp_path, canned, monkeypatch):
    """The state of a record is found once more from its mesh and insertion."""
    _, file = solved
    stored = json.loads(file.read_text())["configurations"][0]
    keys = {"alpha", "energy_release_rate", "distance", "insertion", "mesh"}
    record = Record(
        outcome=Outcome.CONVERGED,
        horizontal_force=0.5,
        ahead_reference=np.array(stored["ahead_reference"]),
        ahead_stress=np.array(stored["ahead_stress"]),
        **{key: stored[key] for key in keys},
    )
    canned(record)
    drawn = []
    again = command._again

    def spied(*arguments):
        drawn.append(again(*arguments))
        return drawn[0]

    monkeypatch.setattr(command, "_again", spied)
    picture = tmp_path / "one.png"
    assert main([*ONE, "--plot", str(picture)]) == 0
    assert picture.read_bytes().startswith(b"\x89PNG")
    body, state = drawn[0]
    tip = body.face[0]
    assert body.nodes[tip, 0] + state.u[tip, 0] - state.centre[0] == pytest.approx(
        record.distance, rel=1e-6
    )


def test_a_path_has_a_bar_on_the_error_stream_and_rows_in_order(canned, capsys):
    canned(REACHED, REACHED)
    assert main(["solve", "--alpha", "5", "--g", "0.8", "0.8"]) == 0
    out, err = capsys.readouterr()
    assert len(out.splitlines()) == 3
    assert "2/2" in err
    assert "%" not in out


def test_not_reached_is_exit_code_1_with_outcome_reason_and_remedy(canned, capsys):
    canned(REACHED, FAILED)
    assert main(["solve", "--alpha", "5", "--g", "2", "0.8"]) == 1
    out, err = capsys.readouterr()
    assert re.search(r"^ +2 .*stalled$", out, re.MULTILINE)
    remark = err.splitlines()[-1]
    assert remark.startswith("fe_training: g = 2: ")
    for part in (Outcome.STALLED.meaning, FAILED.reason, Outcome.STALLED.remedy):
        assert part in remark


def test_a_search_that_ended_elsewhere_is_pointed_out(canned, capsys):
    canned(REACHED)
    assert main(["solve", "--alpha", "5", "--g", "0.81"]) == 0
    assert "J/(mu R_w) = 0.8 is what" in capsys.readouterr().err


def test_a_failed_path_has_no_nan_in_its_file_and_no_picture(canned, capsys, tmp_path):
    canned(FAILED)
    file, picture = tmp_path / "r.json", tmp_path / "r.png"
    arguments = ["solve", "--alpha", "5", "--g", "1", "--json", str(file), "--plot", str(picture)]
    assert main(arguments) == 1
    (one,) = json.loads(file.read_text(), parse_constant=pytest.fail)["configurations"]
    assert one["reached"] is False
    assert one["reason"] == FAILED.reason
    assert not picture.exists()
    assert "is not drawn" in capsys.readouterr().err


BAD = [
    "",
    "solve",
    "solve --alpha 5",
    "solve --alpha five --g 1",
    "solve --alpha nan --g 1",
    "solve --alpha 0.5 --g 1",
    "solve --alpha 5 --g 0",
    "solve --alpha 5 --g 0.1 -1",
    "solve --alpha 5 --g 1 --distance 2",
    "solve --alpha 5 --distance 0.5",
    "solve --alpha 5 --insertion 1e9",
    "solve --alpha 5 --g 1 --resolution finest",
    "solve --alpha 5 --g 1 --plot a.doc",
    "solve --alpha 5 --g 1 --json no/such/folder/a.json",
]


@pytest.mark.parametrize("arguments", BAD)
def test_bad_input_is_exit_code_2_and_one_line(arguments, capsys):
    assert main(shlex.split(arguments)) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert re.fullmatch(r"fe_training: [^\n]+\n", err), err


def test_a_missing_package_is_one_line_that_names_the_extra():
    code = (
        "import sys\n"
        "sys.modules['skfem'] = None\n"
        "from fe_training.__main__ import main\n"
        "sys.exit(main(['solve', '--alpha', '5', '--g', '1']))"
    )
    run = [sys.executable, "-c", code]
    process = subprocess.run(run, capture_output=True, text=True, check=False)
    assert process.returncode == 2
    assert process.stdout == ""
    expected = "fe_training: skfem is not installed; get it with: pip install 'wirecut[train]'\n"
    assert process.stderr == expected


@pytest.mark.parametrize("arguments", [["--help"], ["solve", "--help"]])
def test_help_has_examples_that_the_parser_takes(arguments, capsys):
    with pytest.raises(SystemExit, match="0"):
        main(arguments)
    text = capsys.readouterr().out
    examples = re.findall(r"python -m fe_training (solve --alpha \d.*)", text)
    assert shlex.split(examples[0]) == ONE  # the one that runs above
    for example in examples:
        command._parser().parse_args(shlex.split(example))


def test_the_parser_knows_every_resolution():
    assert tuple(RESOLUTIONS) == command._RESOLUTIONS

"""Running: resuming, killing, retrying, several processes, a Dask cluster that loses a worker."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from fake_engine import record, run, solve_path

from fe_training.campaign.design import STRATEGIES
from fe_training.campaign.run import plan
from fe_training.campaign.store import Store
from fe_training.campaign.workers import Workers
from fe_training.solver.record import Outcome, Record
from surrogate.errors import InputError, MissingExtraError


def wait_until(condition, seconds=60.0):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "waited in vain"
        time.sleep(0.02)


def row_files(store):
    return list(Path(store, "rows").glob("*.row"))


def test_every_configuration_has_its_row(small, tmp_path):
    rows = run(small, tmp_path)
    assert [row.configuration for row in rows] == small.configurations()
    assert all(row.record.alpha == row.configuration.alpha for row in rows)
    assert {row.record.mesh["sectors"] for row in rows} == {12, 16}


def test_what_is_finished_is_not_solved_again(small, tmp_path):
    run(small, tmp_path)

    def refuse(*_):
        raise AssertionError("solved again")

    assert len(run(small, tmp_path, solve=refuse)) == 24


def test_rows_are_durable_one_by_one_and_the_rest_follows(small, tmp_path, row_bytes):
    reference = tmp_path / "reference"
    run(small, reference)
    asked = []

    def interrupted(alpha, targets, settings, report):
        for g in targets:
            if len(asked) == 7:
                raise KeyboardInterrupt
            asked.append(g)
            report(record(alpha, g, settings.sectors))

    with pytest.raises(KeyboardInterrupt):
        run(small, tmp_path / "cut", solve=interrupted)
    assert len(row_files(tmp_path / "cut")) == 7
    run(small, tmp_path / "cut")
    assert row_bytes(tmp_path / "cut") == row_bytes(reference)


@pytest.mark.skipif(os.name != "posix", reason="SIGKILL")
def test_a_run_that_is_killed_goes_on_with_the_same_bits(small, tmp_path, driver, row_bytes):
    reference, killed = tmp_path / "reference", tmp_path / "killed"
    run(small, reference)
    process = driver(killed, 2, FAKE_SECONDS="0.1")
    wait_until(lambda: len(row_files(killed)) >= 5)
    process.kill()
    process.communicate()
    assert process.returncode == -signal.SIGKILL
    time.sleep(1.0)  # processes whose driver is gone end at their next row
    left = row_bytes(killed)
    assert 5 <= len(left) < 24
    assert left.items() <= row_bytes(reference).items()
    time.sleep(0.5)
    assert row_bytes(killed) == left
    second = driver(killed, 2)
    _, err = second.communicate(timeout=60)
    assert second.returncode == 0, err
    assert f"{24 - len(left)}/{24 - len(left)} rows 100%" in err
    assert row_bytes(killed) == row_bytes(reference)


@pytest.mark.parametrize("missing", [-1, 1])
def test_a_path_is_passed_again_up_to_what_was_missing_and_only_that_is_written(
    small, tmp_path, missing
):
    """What an engine makes of a value may depend on the values before it."""
    run(small, tmp_path)
    store, asked = Store(tmp_path), []
    path = small.together(small.configurations()[-1])
    assert len(path) > 2
    stamps = {one: store.stamp(one) for one in path}
    store.path(path[missing]).unlink()

    def asking(alpha, targets, settings, report):
        asked.append(targets)
        solve_path(alpha, targets, settings, report)

    run(small, tmp_path, solve=asking)
    last = path.index(path[missing])
    assert asked == [[one.target for one in path[: last + 1]]]
    changed = [one for one in path if store.stamp(one) != stamps[one]]
    assert changed == [path[missing]]


def test_one_process_and_two_write_the_same(small, tmp_path, row_bytes):
    run(small, tmp_path / "one")
    run(small, tmp_path / "two", Workers(2))
    assert row_bytes(tmp_path / "one") == row_bytes(tmp_path / "two")


def test_failed_rows_are_retried_with_the_next_strategy(small, tmp_path):
    tried = []

    def fussy(alpha, targets, settings, report):
        for g in sorted(targets):
            tried.append((alpha, g, settings.sectors))
            if alpha == 5.0 and g > 5.0 and settings.sectors < 20:
                report(Record(alpha, Outcome.STALLED, reason="no equilibrium"))
            else:
                report(record(alpha, g, settings.sectors))

    failed = [row for row in run(small, tmp_path, solve=fussy) if not row.converged]
    assert {row.configuration.alpha for row in failed} == {5.0}
    assert {row.configuration.level for row in failed} == set(small.levels)
    assert {(row.record.reason, row.attempt, row.tried) for row in failed} == {
        ("no equilibrium", 0, 1)
    }
    run(small, tmp_path, solve=fussy, retry=False)
    assert len(tried) == 24
    again = {row.configuration: row for row in run(small, tmp_path, solve=fussy)}
    fine = {one: row for one, row in again.items() if one.level == "less-coarse"}
    assert all(row.converged for row in fine.values())  # 16 sectors times 1.25
    assert len(tried) == 24 + len(failed)
    still = [row for row in again.values() if not row.converged]
    assert {(row.configuration.level, row.tried) for row in still} == {("coarse", 2)}
    for _ in range(3):
        run(small, tmp_path, solve=lambda *a: solve_failing(*a))
    last = [row for row in run(small, tmp_path) if not row.converged]
    assert {row.tried for row in last} == {len(STRATEGIES)}  # nothing more to try


def solve_failing(alpha, targets, settings, report):
    for _ in targets:
        report(Record(alpha, Outcome.FOLDED, reason="folded"))


def test_an_engine_that_breaks_down_leaves_reasons(small, tmp_path):
    def breaking(alpha, targets, settings, report):
        report(record(alpha, targets[0], settings.sectors))
        raise ZeroDivisionError("one pivot is zero")

    rows = run(small, tmp_path, solve=breaking)
    assert len(rows) == 24
    reasons = {row.record.reason for row in rows if not row.converged}
    assert reasons == {"ZeroDivisionError: one pivot is zero"}


def test_values_that_the_engine_leaves_out_are_failed_rows(small, tmp_path):
    rows = run(small, tmp_path, solve=lambda *_: [])
    assert {row.record.reason for row in rows} == {"the engine left this value out"}


def test_a_mistake_in_the_code_is_no_failed_configuration(small, tmp_path):
    with pytest.raises(TypeError):
        run(small, tmp_path, solve=lambda alpha: [])
    assert not row_files(tmp_path)


def test_records_find_the_configurations_they_answer(small, tmp_path):
    def out_of_order(alpha, targets, settings, report):
        for g in sorted(targets, reverse=True):
            report(record(alpha, g, settings.sectors))

    for row in run(small, tmp_path, solve=out_of_order):
        assert row.record.energy_release_rate == pytest.approx(row.configuration.target, rel=1e-4)


def test_the_estimate_learns_from_finished_rows(small, tmp_path):
    store = Store(tmp_path)
    configurations = small.configurations()
    guessed = plan(small, store, configurations)
    run(small, tmp_path)
    damaged = store.path(configurations[0])
    damaged.unlink()
    learnt = plan(small, store, configurations)
    assert set(guessed.seconds) == set(configurations)
    assert learnt.seconds == {configurations[0]: pytest.approx(2.0)}  # the made-up wall time


DIE = """
import os, signal, sys
sys.path.insert(0, sys.argv[3])
from fake_engine import run
from fe_training.campaign.workers import Workers
from fe_training.campaign.design_file import read_design
from surrogate.errors import WirecutError

def die(*_):
    os.kill(os.getpid(), signal.SIGKILL)

try:
    run(read_design(sys.argv[1]), sys.argv[2], Workers(2), solve=die)
except WirecutError as error:
    print(error)
"""


@pytest.mark.skipif(os.name != "posix", reason="SIGKILL")
def test_a_process_that_dies_is_reported_in_words(small_file, tmp_path):
    here = str(Path(__file__).parents[1])
    command = [sys.executable, "-c", DIE, str(small_file), str(tmp_path / "store"), here]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=60)
    assert "a process died" in done.stdout, done.stderr
    assert "run the same command again" in done.stdout


@pytest.fixture
def dask_process(tmp_path):
    """Return a function that starts a Dask scheduler or worker on the loopback address."""
    pytest.importorskip("distributed", reason="Dask is not installed")
    path = os.pathsep.join([str(Path(__file__).parents[1]), os.environ.get("PYTHONPATH", "")])
    started = []

    def start(kind, *arguments, **environment):
        with open(tmp_path / f"{kind}-{len(started)}.log", "w") as log:
            process = subprocess.Popen(
                [sys.executable, "-m", f"distributed.cli.dask_{kind}", *arguments],
                stdout=log,
                stderr=log,
                env={**os.environ, "PYTHONPATH": path, **environment},
                cwd=tmp_path,
            )
        started.append(process)
        return process

    yield start
    for process in started:
        process.kill()
        process.wait()


@pytest.mark.skipif(os.name != "posix", reason="SIGKILL")
def test_a_dask_cluster_that_loses_a_worker_loses_and_doubles_nothing(
    small, tmp_path, driver, dask_process, row_bytes
):
    reference, store = tmp_path / "reference", tmp_path / "store"
    run(small, reference)
    contact = tmp_path / "scheduler.json"
    dask_process(
        "scheduler", "--host=127.0.0.1", "--port=0", "--no-dashboard", f"--scheduler-file={contact}"
    )
    wait_until(contact.exists)
    address = json.loads(contact.read_text())["address"]
    workers = [
        dask_process(
            "worker",
            address,
            "--host=127.0.0.1",
            "--nthreads=1",
            "--no-nanny",
            "--no-dashboard",
            FAKE_SECONDS="0.2",
        )
        for _ in range(2)
    ]
    process = driver(store, 1, address)
    wait_until(lambda: len(row_files(store)) >= 5)
    workers[0].kill()
    written = {path: path.stat() for path in row_files(store)}
    _, err = process.communicate(timeout=60)
    assert process.returncode == 0, err
    assert row_bytes(store) == row_bytes(reference)
    for path, before in written.items():  # no finished row was written again
        assert (path.stat().st_ino, path.stat().st_mtime_ns) == (before.st_ino, before.st_mtime_ns)
    assert workers[1].poll() is None


def test_a_scheduler_that_does_not_answer_is_named(small, tmp_path, monkeypatch):
    distributed = pytest.importorskip("distributed", reason="Dask is not installed")

    def client(address, **_):
        raise OSError("timed out")

    monkeypatch.setattr(distributed, "Client", client)
    with pytest.raises(InputError, match=r"tcp://127\.0\.0\.1:1'.*give the address"):
        run(small, tmp_path, Workers(scheduler="tcp://127.0.0.1:1"))


def test_without_dask_the_extra_is_named(small, tmp_path, monkeypatch):
    monkeypatch.setattr("fe_training.campaign.workers.find_spec", lambda name: None)
    with pytest.raises(MissingExtraError, match=r"wirecut\[cluster\]"):
        run(small, tmp_path, Workers(scheduler="tcp://127.0.0.1:1"))

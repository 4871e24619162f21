"""The store: rows come back bit for bit, damage is seen, one driver at a time."""

import subprocess
import sys
from dataclasses import fields

import numpy as np
import pytest
from designs import SMALL
from fake_engine import record, run

from fe_training.campaign import store as storing
from fe_training.campaign.design import Configuration
from fe_training.campaign.design_file import read_design
from fe_training.campaign.store import (
    DamagedRowError,
    Row,
    Store,
    decode_row,
    encode_row,
)
from fe_training.solver.record import Outcome, Record
from surrogate.errors import InputError

ONE = Configuration("coarse", 2.0, 0.1)
SOLVED = Row(ONE, 0, 1, {"wirecut": "0"}, record(2.0, 0.1))
FAILED = Row(ONE, 1, 2, {}, Record(2.0, Outcome.STALLED, reason="at α = 2: |r| = 1"))


def same(a, b):
    return all(
        np.array_equal(x, y, equal_nan=isinstance(y, float | np.ndarray)) and type(x) is type(y)
        for field in fields(Record)
        for x, y in [(getattr(a, field.name), getattr(b, field.name))]
    )


@pytest.mark.parametrize("row", [SOLVED, FAILED])
def test_a_row_comes_back_bit_for_bit(row):
    back = decode_row(encode_row(row))
    assert back.configuration == row.configuration
    assert (back.attempt, back.tried, back.software) == (row.attempt, row.tried, row.software)
    assert same(back.record, row.record)
    assert encode_row(back) == encode_row(row)


@pytest.mark.parametrize("damage", [b"", b"x", b"wirecut-row-1 0\n", b"wirecut-row-1"])
def test_what_is_no_row_is_refused(damage):
    with pytest.raises(DamagedRowError):
        decode_row(damage)


def test_every_changed_or_missing_byte_is_seen():
    content = encode_row(SOLVED)
    for i in range(0, len(content), 97):
        with pytest.raises(DamagedRowError):
            decode_row(content[:i])
        with pytest.raises(DamagedRowError):
            decode_row(content[:i] + bytes([content[i] ^ 1]) + content[i + 1 :])


def test_nothing_is_unpickled(monkeypatch):
    seen = []
    load = np.lib.format.read_array
    monkeypatch.setattr(
        np.lib.format, "read_array", lambda *a, **k: seen.append(k) or load(*a, **k)
    )
    decode_row(encode_row(SOLVED))
    assert seen
    assert all(each == {"allow_pickle": False} for each in seen)


def test_a_damaged_row_is_set_aside_with_a_message_and_solved_again(
    small, tmp_path, caplog, row_bytes
):
    run(small, tmp_path)
    before = row_bytes(tmp_path)
    name = sorted(before)[3]
    (tmp_path / "rows" / name).write_bytes(before[name][:-10])
    run(small, tmp_path)
    assert row_bytes(tmp_path) == before
    assert (tmp_path / "damaged" / name).read_bytes() == before[name][:-10]
    (message,) = caplog.messages
    assert name in message
    assert "checksum does not match" in message


def test_a_row_under_a_wrong_name_is_set_aside(small, tmp_path, caplog):
    store = Store(tmp_path)
    with store.opened(small):
        store.write(SOLVED)
        other = Configuration("coarse", 5.0, 0.1)
        store.path(ONE).rename(store.path(other))
        assert store.read(other) is None
    assert "it holds alpha=2" in caplog.text


def test_the_left_overs_of_a_killed_writer_are_swept(small, tmp_path):
    store = Store(tmp_path)
    with store.opened(small):
        pass
    left = tmp_path / "rows" / ".alpha=2.row.host-1.tmp"
    left.write_bytes(b"half")
    with store.opened(small):
        assert not left.exists()


def test_another_design_is_refused_unless_adopted(small, tmp_path):
    run(small, tmp_path)
    file = tmp_path / "other.toml"
    file.write_text(SMALL.replace("alpha = [2, 5]", "alpha = [2, 5, 9]", 1))
    other, store = read_design(file), Store(tmp_path)
    with pytest.raises(InputError, match=rf"{small.hash}, not to {other.hash}.*--adopt"):
        store.opened(other).__enter__()
    with store.opened(other, adopt=True):
        assert len(store.rows(other.configurations())) == len(small.configurations())
    assert store.design_hash() == other.hash


def test_a_damaged_design_is_refused(small, tmp_path):
    run(small, tmp_path)
    (tmp_path / "design.json").write_text("{")
    with pytest.raises(InputError, match="damaged"):
        Store(tmp_path).opened(small).__enter__()


HOLD = """
import sys
from fe_training.campaign.design_file import read_design
from fe_training.campaign.store import Store
with Store(sys.argv[2]).opened(read_design(sys.argv[1])):
    print("open", flush=True)
    sys.stdin.read()
"""


def test_a_second_driver_is_refused_until_the_first_is_gone(small, small_file, tmp_path):
    folder = tmp_path / "store"
    command = [sys.executable, "-c", HOLD, str(small_file), str(folder)]
    first = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    with first:
        assert first.stdout.readline() == "open\n"
        with pytest.raises(InputError, match=rf"process {first.pid} on .*another --store"):
            Store(folder).opened(small).__enter__()
        first.kill()
    with Store(folder).opened(small):  # the lock of a killed process is free
        pass


def test_without_flock_a_file_is_the_lock(small, tmp_path, monkeypatch):
    monkeypatch.setattr(storing, "fcntl", None)
    store = Store(tmp_path)
    with (
        store.opened(small),
        pytest.raises(InputError, match="delete that file"),
        store.opened(small),
    ):
        pass
    with store.opened(small):
        pass


def test_a_folder_that_cannot_be_made_is_refused(small, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="choose another folder"):
        Store(tmp_path / "file" / "store").opened(small).__enter__()


def test_the_better_record_stays():
    outside = Row(ONE, 0, 1, {}, record(2.0, 0.1, outcome=Outcome.OUTSIDE_EVIDENCE))
    assert SOLVED.better(None) is SOLVED
    assert SOLVED.better(outside) is SOLVED
    kept = FAILED.better(outside)
    assert kept.record is outside.record
    assert (kept.attempt, kept.tried) == (0, 2)

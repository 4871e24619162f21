"""The README's examples run and print what it says that they print."""

import doctest
import re
import shlex
from pathlib import Path

import pytest

import surrogate
from surrogate.cli.main import main

README = (Path(__file__).resolve().parent.parent / "README.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"^```(\w*)\n(.*?)^```$", README, flags=re.MULTILINE | re.DOTALL)


def blocks(language):
    return [text for name, text in BLOCKS if name == language]


def test_every_block_is_tested_or_a_set_up_command():
    assert {name for name, _ in BLOCKS} == {"", "csv", "console", "python"}
    assert blocks("") == ["make demo\nmake test\n"]


def test_every_equation_of_the_table_is_public():
    table = re.findall(r"^\| \(\d+\).*\|$", README, flags=re.MULTILINE)
    names = re.findall(r"`(\w+)`", " ".join(table))
    assert len(names) == 9
    assert set(names) <= set(surrogate.__all__)


def test_python_blocks():
    test = doctest.DocTestParser().get_doctest("".join(blocks("python")), {}, "README", None, 0)
    assert len(test.examples) > 10
    report = []
    doctest.DocTestRunner(verbose=False).run(test, out=report.append)
    assert not report, "".join(report)


def test_console_blocks(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    pytest.importorskip("matplotlib")
    (tmp_path / "cuts.csv").write_text(blocks("csv")[0])
    commands = re.findall(r"^\$ wirecut (.*)\n((?:(?!\$).*\n)*)", "".join(blocks("console")), re.M)
    assert len(commands) >= 5
    for command, expected in commands:
        assert main(shlex.split(command)) == 0
        printed = capsys.readouterr().out
        if expected:
            assert printed == expected

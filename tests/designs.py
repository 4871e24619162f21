"""Small designs, and a made-up engine that worker processes can import."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from fe_training.campaign.design_file import read_design

HERE = Path(__file__).resolve().parent

SMALL = """\
schema = "wirecut-campaign-1"
alpha = [2, 5]
path_from = 0.7

[g]
lowest = 0.1
highest = 10
count = 6

[g.denser]
alpha = [2, 9]
touch = [1.6, 100]
peak = 2
width = 0.5

[levels.coarse]
sectors = 12
contact_spacing = 0.2

[levels.less-coarse]
sectors = 16
contact_spacing = 0.15
"""


@pytest.fixture
def small_file(tmp_path):
    """A design of 24 configurations as a file."""
    file = tmp_path / "small.toml"
    file.write_text(SMALL)
    return file


@pytest.fixture
def small(small_file):
    """A design of 24 configurations."""
    return read_design(small_file)


@pytest.fixture
def driver(small_file):
    """Return a function that starts a campaign of the small design in a process of its own."""
    started = []

    def start(store, *arguments, **environment):
        command = [sys.executable, "-W", "error", HERE / "fake_engine.py", small_file, store]
        process = subprocess.Popen(
            [str(part) for part in (*command, *arguments)],
            env={**os.environ, **environment},
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            cwd=HERE.parent,
        )
        started.append(process)
        return process

    yield start
    for process in started:
        process.kill()
        process.communicate()


@pytest.fixture
def row_bytes():
    """Return a function that gives the content of every row of a store by its file's name."""

    def read(store):
        return {path.name: path.read_bytes() for path in sorted(Path(store, "rows").glob("*.row"))}

    return read
